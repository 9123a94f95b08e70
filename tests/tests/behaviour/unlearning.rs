//! Any single session can be removed from the model.

use goodbot::feedback::Strategy;
use goodbot::home::paper_tasks;
use goodbot::language::Settings;
use goodbot::memory::AgentHeap;
use goodbot::symbols::Symbol;
use goodbot::{Agent, Capacities, HeapMemory, Options};
use goodbot_tests::school::{lessons, train};
use rand_pcg::Pcg32;

/// A robot after the first lessons of the school, and its model after each.
fn taught(count: usize, options: Options) -> (Agent<AgentHeap>, Vec<Vec<u8>>) {
    let memory = HeapMemory::new(&Capacities::STANDARD).agent;
    let memory = if options.language.layer { goodbot_layer::above(memory, 512) } else { memory };
    let mut agent = Agent::new(memory, &paper_tasks().unwrap(), options).unwrap();
    let (mut random, mut models) = (Pcg32::new(1, 1), vec![agent.saved().unwrap()]);
    for lesson in lessons().iter().take(count) {
        train(&mut agent, lesson, Strategy::BALANCED, &mut random).unwrap();
        models.push(agent.saved().unwrap());
    }
    (agent, models)
}

/// A machine command, and the bits of its weight.
type Weighted = (Vec<String>, u32);

/// The training data: each session's words, and its machine commands with the bits of their weights.
fn data(agent: &Agent<AgentHeap>) -> Vec<(String, Vec<Weighted>)> {
    let language = agent.language();
    let (bitext, words, tokens) = (language.bitext(), language.words(), language.tokens());
    let word = |&word: &Symbol| words.text(word).to_owned();
    let token = |&token: &Symbol| if tokens.text(token).is_empty() { format!("{token:?}") } else { tokens.text(token).to_owned() };
    let session = |session: u16| {
        let pairs = bitext.pairs_of(session).iter();
        let pairs = pairs.map(|pair| (bitext.command(pair.command).iter().map(token).collect(), pair.weight.to_bits())).collect();
        (bitext.sentence(session).iter().map(word).collect::<Vec<_>>().join(" "), pairs)
    };
    (0..bitext.sessions() as u16).map(session).collect()
}

fn all_options() -> [Options; 3] {
    [Options::PAPER, Options::DEFAULT, Options { language: Settings::LAYERED, ..Options::DEFAULT }]
}

#[test]
fn without_its_last_session_a_robot_is_as_it_was_before() {
    for options in all_options() {
        let (mut agent, models) = taught(5, options);
        for before in models.iter().rev().skip(1) {
            let last = agent.language().bitext().sessions() as u16 - 1;
            assert!(agent.unlearn(last));
            agent.learn_fully();
            let (mut as_before, _) = taught(0, options);
            as_before.restore(before).unwrap();
            as_before.learn_fully();
            assert_eq!(data(&agent), data(&as_before), "{last} {options:?}");
            // The role model also keeps machine tokens that no session uses. They go with the session.
            assert!(options != Options::PAPER || agent.saved().unwrap() == *before, "{last}");
        }
        assert!(!agent.unlearn(0));
    }
}

#[test]
fn the_words_of_an_unlearned_session_go_with_it_and_those_of_others_stay() {
    for options in all_options() {
        let (mut agent, _) = taught(5, options);
        let knows = |agent: &Agent<AgentHeap>, word: &str| agent.language().words().iter().any(|(_, known)| word.starts_with(known));
        assert!(knows(&agent, "chair") && knows(&agent, "green"));
        assert!(agent.unlearn(0));
        agent.learn_fully();
        assert!(!knows(&agent, "green") && knows(&agent, "chair"), "{options:?}");
        assert_eq!(agent.language().bitext().sessions(), 4);
        // The remaining model is valid.
        let (mut copy, _) = taught(0, options);
        copy.restore(&agent.saved().unwrap()).unwrap();
        copy.learn_fully();
        assert!(copy.saved().unwrap() == agent.saved().unwrap());
        assert!(!agent.unlearn(4) && !agent.unlearn(u16::MAX));
    }
}
