//! Two robots do the same, one in calls with small budgets, the other in calls that run to the end: they stay equal, bit by bit.

use super::{Bytes, assert_sound};
use crate::random_homes::{Size, random_home};
use goodbot::feedback::Feedback;
use goodbot::home::{Moves, paper_tasks};
use goodbot::language::Settings;
use goodbot::memory::AgentMemory;
use goodbot::oomdp::Action;
use goodbot::planning::Progress;
use goodbot::session::Weights;
use goodbot::{Agent, Capacities, HeapMemory, Options};
use rand_pcg::Pcg32;

const WORDS: [&str; 12] = ["go", "take", "to", "the", "room", "red", "green", "blue", "yellow", "chair", "bag", "now"];

/// A robot for small homes: many inputs a second.
const SMALL: Capacities = Capacities { cells: 24, states: 600, ..Capacities::TINY };

/// The ways of planning: with all states at hand, and with visited states hashed.
const ROBOTS: [Capacities; 2] = [SMALL, Capacities { states: 32, hashed_states: 128, ..SMALL }];

/// Options that the bytes choose; the rounds are few.
fn options(choices: &mut Bytes<'_>) -> Options {
    let options = choices.one_of(&[Options::PAPER, Options::DEFAULT]);
    let weights = choices.one_of(&[Weights::Paper, Weights::Belief]);
    let language = Settings { rounds: 1 + choices.below(3) as u32, length: choices.below(2) == 1, ..options.language };
    Options { language, weights, ..options }
}

/// A random home, command and feedback, up to twice over.
pub fn budgets(input: &[u8]) {
    let mut choices = Bytes::new(input);
    let capacities = choices.one_of(&ROBOTS);
    let options = options(&mut choices);
    let mut memories = [HeapMemory::new(&capacities), HeapMemory::new(&capacities)];
    let tasks = paper_tasks().expect("the paper's tasks");
    let [mut parts, mut whole] = memories.each_mut().map(|memory| Agent::new(&mut memory.agent, &tasks, options).expect("fits"));
    let budget = 1 + u32::from(choices.byte());
    for _ in 0..2 {
        let mut memory = HeapMemory::new(&Capacities { states: 0, ..capacities });
        let size =
            Size { columns: 2, rows: 1 + choices.below(2) as i32, side: 1 + choices.below(2) as i32, blocks: choices.below(2) as i32 };
        let moves = choices.one_of(&[Moves::Push, Moves::PushAndPull]);
        let (home, mut state) = random_home(&mut Pcg32::new(u64::from(choices.byte()), 1), size, moves, &mut memory.home);
        let words: Vec<&str> = (0..1 + choices.below(6)).map(|_| choices.one_of(&WORDS)).collect();
        let heard = parts.begin_hearing(&home, &state, &words.join(" ")).and_then(|()| {
            while parts.hear_on(&home, budget)? == Progress::Working {}
            Ok(())
        });
        assert_eq!(heard, whole.hear(&home, &state, &words.join(" ")));
        if heard.is_err() {
            continue;
        }
        for _ in 0..choices.below(8) {
            while parts.plan(&home, &state, budget).expect("a session is under way") == Progress::Working {}
            whole.plan_fully(&home, &state).expect("a session is under way");
            let seed = u64::from(choices.byte());
            let decision = parts.decide_with(&home, &state, &mut Pcg32::new(seed, 1)).expect("the plan is done");
            assert_eq!(decision, whole.decide_with(&home, &state, &mut Pcg32::new(seed, 1)).expect("the plan is done"));
            let feedback = choices.one_of(&[Feedback::Reward, Feedback::Punish, Feedback::Neutral]);
            let action = choices.one_of(&[decision.action, Action::new(0), Action::new(1), Action::new(2), Action::new(3), Action::NOOP]);
            let next = parts.acted(&home, &state, action);
            assert_eq!(next, whole.acted(&home, &state, action));
            assert_eq!(parts.feedback(feedback), whole.feedback(feedback));
            assert_same_beliefs(&parts, &whole);
            state = next.unwrap_or(state);
        }
        let finished = parts.begin_finishing(&home).and_then(|()| {
            loop {
                if let Some(finished) = parts.finish_on(&home, budget)? {
                    return Ok(finished);
                }
            }
        });
        assert_eq!(finished, whole.finish(&home));
        while parts.learn(budget) == Progress::Working {}
        whole.learn_fully();
        assert_same_parameters(&parts, &whole);
        assert_sound(&whole);
    }
}

fn assert_same_beliefs(one: &Agent<impl AgentMemory>, other: &Agent<impl AgentMemory>) {
    assert_eq!(one.tasks(), other.tasks());
    for task in 0..one.tasks().len() {
        assert_eq!(one.belief().probability(task).to_bits(), other.belief().probability(task).to_bits());
        assert_eq!(one.planned().optimal(task), other.planned().optimal(task));
    }
}

fn assert_same_parameters(one: &Agent<impl AgentMemory>, other: &Agent<impl AgentMemory>) {
    let (one, other) = (one.language(), other.language());
    for (token, _) in one.tokens().iter() {
        for (word, _) in one.words().iter() {
            let bits = |model: goodbot::language::LanguageRef<'_>| model.tables().translation(word, Some(token)).to_bits();
            assert_eq!(bits(one), bits(other));
        }
    }
    for lengths in one.tables().length_pairs() {
        let (machine, english) = (usize::from(lengths.machine), usize::from(lengths.english));
        for (i, j) in (0..english).flat_map(|i| (0..=machine).map(move |j| (i, j))) {
            let bits = |model: goodbot::language::LanguageRef<'_>| model.tables().alignment(j, i, machine, english).to_bits();
            assert_eq!(bits(one), bits(other));
        }
    }
}
