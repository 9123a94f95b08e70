//! Two robots do the same, one by calls with small budgets, the other by calls that run to the end: they stay the same, bit by bit.

use super::{Bytes, assert_sound};
use crate::school::Lesson;
use goodbot::feedback::Feedback;
use goodbot::home::paper_tasks;
use goodbot::oomdp::{Action, Domain, apply};
use goodbot::planning::Progress;
use goodbot::{Agent, Capacities, HeapMemory, Options};
use rand_pcg::Pcg32;

const COLORS: [&str; 5] = ["red", "green", "blue", "yellow", "purple"];
const SHAPES: [&str; 4] = ["chair", "bag", "backpack", "basket"];
const WORDS: [&str; 12] = ["go", "take", "to", "the", "room", "red", "green", "blue", "yellow", "chair", "bag", "now"];

/// A home and a command as the bytes say.
fn lesson(choices: &mut Bytes<'_>) -> Lesson {
    let rooms = [(); 4].map(|()| choices.one_of(&COLORS));
    let blocks = (0..choices.below(2)).map(|_| (choices.one_of(&COLORS), choices.one_of(&SHAPES))).collect();
    let words: Vec<&str> = (0..1 + choices.below(9)).map(|_| choices.one_of(&WORDS)).collect();
    Lesson { command: words.join(" "), rooms, blocks, intended: (None, 0) }
}

/// A random home, command and feedback, up to three times over.
pub fn budgets(input: &[u8]) {
    let mut choices = Bytes::new(input);
    let mut memories = [HeapMemory::new(&Capacities::SMALL), HeapMemory::new(&Capacities::SMALL)];
    let tasks = paper_tasks().expect("the paper's tasks");
    let [mut parts, mut whole] = memories.each_mut().map(|memory| Agent::new(memory.split().agent, &tasks, Options::PAPER).expect("fits"));
    let budget = 1 + u32::from(choices.byte());
    for _ in 0..3 {
        let lesson = lesson(&mut choices);
        let mut memory = HeapMemory::new(&Capacities::SMALL);
        let (home, mut state) = lesson.home(memory.split().home);
        let heard = parts.hear(&home, &state, &lesson.command);
        assert_eq!(heard, whole.hear(&home, &state, &lesson.command));
        if heard.is_err() {
            continue;
        }
        for _ in 0..choices.below(12) {
            while parts.plan(&home, &state, budget).expect("a session is under way") == Progress::Working {}
            whole.plan_fully(&home, &state).expect("a session is under way");
            let seed = u64::from(choices.byte());
            let decision = parts.decide(Some(&mut Pcg32::new(seed, 1))).expect("the plan is done");
            assert_eq!(decision, whole.decide(Some(&mut Pcg32::new(seed, 1))).expect("the plan is done"));
            let feedback = choices.one_of(&[Feedback::Reward, Feedback::Punish, Feedback::Neutral]);
            let action = choices.one_of(&[decision.action, Action(0), Action(1), Action(2), Action(3), Action::NOOP]);
            assert_eq!(parts.feedback(action, feedback), whole.feedback(action, feedback));
            assert_same(&parts, &whole);
            state = apply(&home, &state, action).filter(|next| home.number(next) < home.state_count()).unwrap_or(state);
        }
        assert_eq!(parts.finish(&home), whole.finish(&home));
        while parts.learn(budget) == Progress::Working {}
        whole.learn_fully();
        assert_same(&parts, &whole);
        assert_sound(&whole);
    }
}

fn assert_same(one: &Agent<'_>, other: &Agent<'_>) {
    let bits = |agent: &Agent<'_>| {
        let (belief, language) = (agent.belief(), agent.language());
        let mut bits: Vec<u32> = (0..belief.tasks()).map(|task| belief.probability(task).to_bits()).collect();
        for (token, _) in language.tokens().iter() {
            bits.extend(language.words().iter().map(|(word, _)| language.tables().translation(word, Some(token)).to_bits()));
        }
        bits
    };
    assert_eq!(bits(one), bits(other));
    assert!((0..one.tasks().len()).all(|task| one.search().optimal(task) == other.search().optimal(task)));
}
