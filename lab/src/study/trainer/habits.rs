//! A trainer's habits as numbers, and the feedback that follows from them.

use goodbot::feedback::Feedback;
use goodbot::random::unit;
use goodbot_course::CourseTrainer;
use rand_core::Rng;

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
        let [reward, punish] = match meant {
            Some((_, Some(true))) => self.habits.right,
            Some((_, Some(false))) => self.habits.wrong,
            Some((_, None)) | None => [0.0; 2],
        };
        if draw < reward {
            Feedback::Reward
        } else if draw < reward + punish {
            Feedback::Punish
        } else {
            Feedback::Neutral
        }
    }

    /// Whether the trainer leaves after a step.
    pub fn leaves<R: Rng + ?Sized>(&self, at_goal: bool, random: &mut R) -> bool {
        let [goal, elsewhere] = self.habits.leaves;
        unit(random) < if at_goal { goal } else { elsewhere }
    }
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
