//! The same log teaches the same in every shell: each belief is compared to the bit. For C see capi/tests/behaviour/recorded.rs, for Python
//! python/tests/test_logs.py. All read tests/fixtures/lesson.jsonl, which has a prior, strategies with lags, answers, ways, a demonstration
//! and a session that continues the one before.

use crate::program::goodbot;

use goodbot_formats::session::{RecordedSession, SessionReader};
use goodbot_wasm::World;

const LOG: &str = include_str!("../../../tests/fixtures/lesson.jsonl");
/// The output of `goodbot replay --json --routes --learner roles tests/fixtures/lesson.jsonl`.
const BELIEFS: &str = include_str!("../../../tests/fixtures/lesson-beliefs.jsonl");

#[test]
fn the_command_line_believes_what_was_recorded() {
    let run = goodbot(&["replay", "--json", "--routes", "--learner", "roles", "-"], LOG.as_bytes());
    assert_eq!((run.code, run.output.as_str()), (0, BELIEFS), "{}", run.messages);
}

/// Replays a session with the page's module, and returns each belief: after the command, and after each step.
fn replayed(world: &mut World, session: &RecordedSession) -> Vec<Vec<f32>> {
    let believed = |world: &World| {
        let agent = world.agent();
        (0..agent.tasks().len()).map(|task| agent.belief().probability(task)).collect::<Vec<f32>>()
    };
    world.tell(session).unwrap();
    let mut all = vec![];
    loop {
        let done = world.replay_on(u32::MAX, session.learn).unwrap();
        if done {
            break;
        }
        all.push(believed(world));
    }
    while !world.learn(u32::MAX) {}
    all
}

#[test]
fn the_page_believes_what_the_command_line_believes() {
    let mut world = World::new(1).unwrap();
    world.set_ways(true).unwrap();
    while !world.learn(u32::MAX) {}
    let mut lines = BELIEFS.lines();
    for session in SessionReader::new(LOG.as_bytes()) {
        let session = session.unwrap();
        // Each event has a belief: the command, and for each step its answers, its plan, and the step itself.
        let all = replayed(&mut world, &session);
        let mut events = all.iter();
        let mut compare = |believed: &Vec<f32>| {
            let line: serde_json::Value = serde_json::from_str(lines.next().unwrap()).unwrap();
            // The file has the shortest decimals that give the same numbers again, so no bit is lost.
            let recorded = line["tasks"].as_object().unwrap().values().map(|share| share.to_string().parse::<f32>().unwrap());
            assert!(recorded.map(f32::to_bits).eq(believed.iter().map(|share| share.to_bits())), "{line}");
        };
        let count = session.steps.len();
        let mut heard = events.next().unwrap();
        if count > 0 {
            compare(heard);
        }
        for done in 0..count {
            let answers = session.answers_after(done).count();
            heard = events.nth(answers + 1).unwrap();
            if done + 1 < count {
                compare(heard);
            }
        }
        // Answers after the last step belong to the last belief.
        compare(events.last().unwrap_or(heard));
    }
    assert_eq!(lines.next(), None);
}
