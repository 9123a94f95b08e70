//! The trainers. A trainer knows the intended task, takes each action for right or wrong, and says "good bot", "bad bot" or nothing.
//!
//! - [`habits`]: a trainer's habits as numbers;
//! - [`population`]: trainers like real people.

pub mod habits;
pub mod population;

use goodbot::feedback::Strategy;
use goodbot_course::CourseTrainer;
use habits::{Habits, LATEST};
use population::Population;

/// A trainer of the study.
#[derive(Clone, Copy, Debug)]
pub struct Trainer {
    /// Its name, as it is typed.
    pub name: &'static str,
    /// Its description, as the rest of a sentence that begins with its name.
    pub does: &'static str,
    /// The kind of trainer.
    pub who: Who,
}

/// The kind of a trainer.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Who {
    /// A trainer of the course, whose feedback comes at once.
    Course(CourseTrainer),
    /// The balanced trainer, with feedback that comes this many steps late.
    Late(usize),
    /// Silent after any action with the first probability, and mistaken with the second.
    Even(f32, f32),
    /// A different person for each seed.
    Population {
        /// Whether it may leave before the end of a lesson.
        leaves: bool,
    },
}

/// All trainers, in the order of the tables.
pub const TRAINERS: [Trainer; 12] = [
    Trainer {
        name: "balanced",
        does: "is silent seven times out of ten, and mistaken one time in ten",
        who: Who::Course(CourseTrainer::BALANCED),
    },
    Trainer {
        name: "punish-only",
        does: "punishes what it takes for wrong 19 times out of 20, and never rewards",
        who: Who::Course(CourseTrainer::PUNISH_ONLY),
    },
    Trainer {
        name: "reward-only",
        does: "rewards what it takes for right 19 times out of 20, and never punishes",
        who: Who::Course(CourseTrainer::REWARD_ONLY),
    },
    Trainer { name: "silent", does: "speaks after one action in twenty", who: Who::Even(0.95, 0.1) },
    Trainer { name: "mute", does: "never says a word", who: Who::Even(1.0, 0.1) },
    Trainer { name: "late-1", does: "speaks one step late", who: Who::Late(1) },
    Trainer { name: "late-2", does: "speaks two steps late", who: Who::Late(2) },
    Trainer { name: "mistaken", does: "is mistaken 45 times out of 100", who: Who::Even(0.7, 0.45) },
    Trainer {
        name: "population",
        does: "is another person for each seed, like twelve real ones, but stays to the end of each lesson",
        who: Who::Population { leaves: false },
    },
    Trainer { name: "leaving", does: "is the same, but leaves lessons as often as real people", who: Who::Population { leaves: true } },
    Trainer { name: "contrary", does: "says the wrong word each time", who: Who::Even(0.7, 1.0) },
    Trainer { name: "shuffled", does: "throws a coin for good or bad", who: Who::Even(0.7, 0.5) },
];

impl Trainer {
    /// Its habits with this seed.
    pub fn habits(&self, population: &Population, seed: u64) -> Habits {
        match self.who {
            Who::Course(trainer) => Habits::of(trainer),
            Who::Late(steps) => {
                let mut late = [0.0; LATEST + 1];
                late[steps.min(LATEST)] = 1.0;
                Habits { late, ..Habits::of(CourseTrainer::BALANCED) }
            }
            Who::Even(silence, mistaken) => {
                let strategy = Strategy::new(silence, silence, mistaken).unwrap_or(Strategy::BALANCED);
                Habits::of(CourseTrainer::of(strategy))
            }
            Who::Population { leaves: true } => population.person(seed),
            Who::Population { leaves: false } => Habits { leaves: [0.0; 2], ..population.person(seed) },
        }
    }
}
