//! The trainers. A trainer knows the intended task, takes each action for right or wrong, and says "good bot", "bad bot" or nothing.
//!
//! - [`population`]: trainers like real people.

pub mod population;

use goodbot::asking::{Answer, Question};
use goodbot::feedback::{Feedback, Strategy};
use goodbot::random::{below, unit};
use goodbot_course::CourseTrainer;
use goodbot_course::trainer::drawn;
use population::Population;
use rand_core::Rng;

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

/// Feedback comes at most this many steps late.
pub const LATEST: usize = 2;

/// A trainer's habits.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Habits {
    /// The probabilities of reward and punishment after a right action. The rest is silence.
    pub right: [f32; 2],
    /// The same after a wrong action.
    pub wrong: [f32; 2],
    /// The probabilities that feedback is about the last action, the one before, and the one before that.
    pub late: [f32; LATEST + 1],
    /// The probabilities that it ends the lesson after a step at the goal, and after a step elsewhere.
    pub leaves: [f32; 2],
}

impl Habits {
    /// It never says a word, and stays.
    pub const MUTE: Self = Self { right: [0.0; 2], wrong: [0.0; 2], late: [1.0, 0.0, 0.0], leaves: [0.0; 2] };

    /// The habits of a trainer of the course: its feedback comes at once, and it stays to the end.
    pub fn of(trainer: CourseTrainer) -> Self {
        let after = |correct| {
            let said = |feedback, ever: bool| if ever { trainer.strategy.probability(feedback, correct) } else { 0.0 };
            [said(Feedback::Reward, trainer.rewards), said(Feedback::Punish, trainer.punishes)]
        };
        Self { right: after(true), wrong: after(false), late: [1.0, 0.0, 0.0], leaves: [0.0; 2] }
    }

    /// The share of mistaken feedback, if right and wrong actions are equally frequent; `None` if it never speaks.
    pub fn mistaken(&self) -> Option<f32> {
        let ([praise, blame], [spared, blamed]) = (self.right, self.wrong);
        let whole = praise + blame + spared + blamed;
        (whole > 0.0).then(|| (blame + spared) / whole)
    }
}

/// A trainer in a lesson, who remembers the last actions.
#[derive(Clone, Debug)]
pub struct Listening {
    habits: Habits,
    /// Whether the last three actions were right, the last one first; `None` before the first.
    seen: [Option<bool>; LATEST + 1],
}

impl Listening {
    /// A trainer at the beginning of a lesson.
    pub const fn new(habits: Habits) -> Self {
        Self { habits, seen: [None; LATEST + 1] }
    }

    /// The feedback after an action, about this action or an earlier one; silence if there is no such earlier action.
    pub fn says<R: Rng + ?Sized>(&mut self, correct: bool, random: &mut R) -> Feedback {
        self.seen.rotate_right(1);
        self.seen[0] = Some(correct);
        let (draw, mut lag) = (unit(random), unit(random));
        let meant = self.habits.late.iter().zip(self.seen).find(|(share, _)| {
            lag -= **share;
            lag < 0.0
        });
        let probabilities = match meant {
            Some((_, Some(true))) => self.habits.right,
            Some((_, Some(false))) => self.habits.wrong,
            Some((_, None)) | None => [0.0; 2],
        };
        drawn(draw, probabilities)
    }

    /// Whether the trainer leaves after a step.
    pub fn leaves<R: Rng + ?Sized>(&self, at_goal: bool, random: &mut R) -> bool {
        let [goal, elsewhere] = self.habits.leaves;
        unit(random) < if at_goal { goal } else { elsewhere }
    }
}

/// The answer of a trainer with this intended task, who is wrong with probability `eta`.
pub fn answer(question: &Question, intended: usize, eta: f32, random: &mut impl Rng) -> Answer {
    let wrong = unit(random) < eta;
    let count = usize::from(question.subject.choices());
    if count == 0 {
        return if question.yes.contains(intended) != wrong { Answer::Yes } else { Answer::No };
    }
    // One of the choices; after the last, none of them.
    let right = question.choices.iter().take(count).position(|choice| choice.contains(intended)).unwrap_or(count);
    let given = if wrong { (right + 1 + below(count, random)) % (count + 1) } else { right };
    if given == count { Answer::No } else { Answer::This(given as u8) }
}

#[cfg(test)]
mod tests {
    use super::*;
    use goodbot_course::generator;

    #[test]
    fn a_late_trainer_says_what_it_would_have_said_but_later() {
        let at_once = Habits { right: [1.0, 0.0], wrong: [0.0, 1.0], late: [1.0, 0.0, 0.0], leaves: [0.0; 2] };
        let actions = [true, false, false, true, true];
        let said = |late| {
            let (mut trainer, mut random) = (Listening::new(Habits { late, ..at_once }), generator(1));
            actions.map(|correct| trainer.says(correct, &mut random))
        };
        use Feedback::{Neutral, Punish, Reward};
        assert_eq!(said([1.0, 0.0, 0.0]), [Reward, Punish, Punish, Reward, Reward]);
        assert_eq!(said([0.0, 1.0, 0.0]), [Neutral, Reward, Punish, Punish, Reward]);
        assert_eq!(said([0.0, 0.0, 1.0]), [Neutral, Neutral, Reward, Punish, Punish]);
    }

    #[test]
    fn words_are_as_frequent_as_the_course_says() {
        let (mut trainer, mut random) = (Listening::new(Habits::of(CourseTrainer::BALANCED)), generator(2));
        let rewards = (0..20_000).filter(|_| trainer.says(true, &mut random) == Feedback::Reward).count();
        assert!((rewards as f64 / 20_000.0 - 0.27).abs() < 0.01, "{rewards}");
    }

    #[test]
    fn a_trainer_answers_with_its_own_error_and_one_who_never_speaks_does_not_answer() {
        assert_eq!(Habits::MUTE.mistaken(), None);
        let near = |habits: Habits, error: f32| (habits.mistaken().expect("words") - error).abs() < 1e-6;
        assert!(near(Habits::of(CourseTrainer::BALANCED), 0.1));
        assert!(near(Habits::of(CourseTrainer::PUNISH_ONLY), 0.1));
    }
}
