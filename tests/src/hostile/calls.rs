//! Calls in any order, as a program in C may make them: each does what it says or refuses.

use super::{Bytes, assert_sound};
use crate::random_homes::{Size, random_home};
use crate::school;
use goodbot::feedback::{Feedback, Strategy};
use goodbot::home::{Moves, paper_tasks};
use goodbot::memory::HomeHeap;
use goodbot::oomdp::Action;
use goodbot::{Agent, Capacities, HeapMemory, Options};
use rand_pcg::Pcg32;

/// The most calls for one input.
const MOST_CALLS: usize = 100;

/// A robot for small homes: many inputs a second.
const ROBOT: Capacities = Capacities { states: 700, ..Capacities::SMALL };

/// Makes the calls that the bytes choose.
pub fn calls(input: &[u8]) {
    let mut choices = Bytes::new(input);
    let mut memory = HeapMemory::new(&ROBOT);
    let lessons = school::lessons();
    let world = |blocks| {
        random_home(&mut Pcg32::new(1, 1), Size { columns: 2, rows: 2, side: 2, blocks }, Moves::PushAndPull, HomeHeap::new(&ROBOT))
    };
    let mut worlds = [0, 1].map(world);
    let mut agent = Agent::new(&mut memory.agent, &paper_tasks().expect("the paper's tasks"), Options::PAPER).expect("two tasks fit");
    let mut kept = vec![0; 4_096];
    let mut length = agent.save(&mut kept).expect("an empty model is small");
    let mut random = Pcg32::new(1, 1);
    let mut at = 0;
    for _ in 0..MOST_CALLS {
        if choices.is_empty() {
            break;
        }
        let (home, state) = &mut worlds[at];
        match choices.below(14) {
            0 | 1 => drop(agent.hear(home, state, &lessons[usize::from(choices.byte()) % lessons.len()].command)),
            2 => drop(agent.hear(home, state, &choices.text(24))),
            3 => drop(agent.hear_again(home, state)),
            4 => drop(agent.plan(home, state, u32::from(choices.byte()))),
            5 => drop(agent.plan_fully(home, state)),
            6 => {
                if let Ok(decision) = agent.decide_with(home, state, &mut random) {
                    *state = agent.acted(home, state, decision.action).expect("an action that was decided on can be done");
                }
            }
            7 | 8 => {
                let feedback = choices.one_of(&[Feedback::Reward, Feedback::Punish, Feedback::Neutral]);
                // Judges an action that the bytes choose, or else the last one that was done.
                let action = Action::new(choices.byte());
                if (action.index() < 64 || action == Action::NOOP)
                    && let Ok(next) = agent.acted(home, state, action)
                {
                    *state = next;
                }
                let _ = agent.feedback(feedback);
            }
            9 => drop(agent.demonstrated(home, state, Action::new(choices.byte()))),
            10 => drop(agent.finish(home)),
            11 => drop(agent.learn(u32::from(choices.byte()) * 64)),
            12 => match choices.below(6) {
                0 => agent.forget(),
                1 => at = 1 - at,
                2 => {
                    let mu = f32::from(choices.byte()) / 200.0;
                    if let Ok(strategy) = Strategy::new(mu, 1.0 - mu, mu / 2.0) {
                        let _ = agent.set_strategies(&[(strategy, mu), (Strategy::BALANCED, 0.5)]);
                    }
                }
                3 => agent.learn_fully(),
                4 => drop(agent.weigh(home)),
                _ => drop(agent.join(&kept[..length])),
            },
            _ => match choices.below(3) {
                0 => length = agent.save(&mut kept).expect("a small model fits"),
                1 => agent.restore(&kept[..length]).expect("what was saved can be restored"),
                _ => {
                    let mut damaged = kept[..length].to_vec();
                    damaged[usize::from(choices.byte()) % length] ^= 1 << choices.below(8);
                    assert!(agent.restore(&damaged).is_err());
                }
            },
        }
        assert_sound(&agent);
    }
}
