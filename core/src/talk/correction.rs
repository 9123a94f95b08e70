//! Words that correct a robot on its way: "no, the blue one", "not the red one".
//!
//! They are evidence about the session under way. Let L(t) be the likelihood of the naming words under task t, which needs no act word, and
//! M the largest one among tasks of the corrected task's kind. The belief in t is multiplied by k(t) (e + (1 - e) min(1, L(t) / M)), where
//! k(t) is the probability of the change from the corrected task to t. For words after a negation the factor is 1 - (1 - e) L(t) / M, with
//! M over all tasks. Words that were never heard fit all tasks alike, and say nothing.

use super::context::{Context, View};
use super::explained::Explained;
use super::heard::{Heard, Utterance};
use super::readings::EITHER;
use super::wording::Wording;
use super::words::Words;
use crate::asking::Asking;
use crate::language::for_each_piece;
use crate::language::roles::talk::is_of_task;
use crate::memory::AgentMemory;
use crate::oomdp::Domain;
use crate::probability::Scaled;
use crate::session::{Agent, AgentError, Evidence};
use crate::task::{GroundedTask, TaskSet};
use crate::voice::classes::{Class, Classes, ClosedWords};
use heapless::Vec;

/// The probability that a correction names an object that is not meant. It is small: who corrects the robot sees it, and chooses words for
/// it.
const WRONG: f32 = 1e-4;

/// The prior probabilities that a correction changes the place rather than the thing, and that it changes the act.
const PLACE_CHANGED: f32 = 0.05;
const ACT_CHANGED: f32 = 0.01;

/// The most belief left to the corrected task, as a share of the belief in the next one.
const LEFT: f32 = 0.05;

/// The result of a correction, for a record.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Corrected {
    /// The corrected task, by its position.
    pub task: usize,
    /// The probability that the "no" to that task is wrong: the `eta` of [`answered`](Agent::answered).
    pub eta: f32,
}

impl<M: AgentMemory> Agent<M> {
    /// Whether some word is an act word, such as "go": such words are a command rather than a correction. Only learned words outside the
    /// closed classes count.
    ///
    /// # Errors
    /// As [`hear`](Self::hear), if there are too many words or one is too long.
    pub fn is_told_to_act(&self, words: &str, closed: ClosedWords<'_>) -> Result<bool, AgentError> {
        let mut told = false;
        for_each_piece(words, |piece| {
            let is_open = !told && closed.of(piece).about_commands() == Classes::NONE;
            told |= is_open && is_of_task(self.language().tables(), self.known_word(piece));
            Ok(())
        })?;
        Ok(told)
    }

    /// Whether a learned word outside the closed classes names something, or all words are in a class: "the blue one", "the other one".
    pub(crate) fn is_named(&self, words: &str, closed: ClosedWords<'_>) -> Result<bool, AgentError> {
        let (mut is_known, mut is_closed) = (false, true);
        for_each_piece(words, |piece| {
            let is_open = closed.of(piece).about_commands() == Classes::NONE;
            is_known |= is_open && !is_known && self.knows_word(piece);
            is_closed &= !is_open;
            Ok(())
        })?;
        Ok(is_known || is_closed)
    }

    /// Updates the belief by words that correct the robot: "no, the other one", "I meant the blue one", "not the red one". They count as
    /// the answer "no" to the task that it follows, which keeps at most a twentieth of the belief in the next one, however sure the robot
    /// was; and the words are [evidence](Self::corrected). `followed` is the task of the last step; `None` stands for the task that the
    /// robot has decided on.
    ///
    /// # Errors
    /// As [`corrected`](Self::corrected).
    pub fn correct<D: Domain>(
        &mut self,
        domain: &D,
        words: &str,
        closed: ClosedWords<'_>,
        followed: Option<usize>,
    ) -> Result<Corrected, AgentError> {
        self.check_session(domain)?;
        let followed = followed.or(self.followed).or_else(|| self.most_likely());
        let task = followed.ok_or(AgentError::NotNow(crate::session::Phase::Idle))?;
        let belief = |task: usize| self.belief().probability(task);
        let next = (0..self.tasks().len()).filter(|&other| other != task).map(belief).fold(0.0, f32::max);
        let eta = (LEFT * next / belief(task)).clamp(f32::MIN_POSITIVE, Asking::DEFAULT.eta);
        self.withdraw_question();
        let _ = self.answered(TaskSet::of(task), false, eta, 1)?;
        let _ = self.corrected(domain, words, closed, TaskSet::of(task))?;
        Ok(Corrected { task, eta })
    }

    /// Updates the belief by words that correct the robot, without the "no" to its present task, which is one of `turned`. Anything that
    /// the words do not name stays the same: another thing in the same place is more probable than the same thing elsewhere.
    ///
    /// # Errors
    /// [`AgentError::NotNow`] and [`AgentError::OtherDomain`], and as [`hear`](Self::hear) if there are too many words or one is too long.
    pub fn corrected<D: Domain>(
        &mut self,
        domain: &D,
        words: &str,
        closed: ClosedWords<'_>,
        turned: TaskSet,
    ) -> Result<Evidence, AgentError> {
        self.check_session(domain)?;
        if self.tasks().iter().any(GroundedTask::is_negated) || self.language().tables().words() == 0 {
            return Ok(Evidence::Uninformative);
        }
        let (mut meant, mut other): (Utterance, Utterance) = (Vec::new(), Vec::new());
        let mut is_other = false;
        for_each_piece(words, |piece| {
            let classes = closed.of(piece).about_commands();
            // "No" is a word of its own; "not" negates the words after it.
            if classes.contains_any(&[Class::But, Class::Connective]) {
                is_other = false;
            } else if classes.contains(Class::Negation) && !classes.contains(Class::No) {
                is_other = true;
            } else if classes == Classes::NONE {
                let heard = Heard::new(self.language(), self.known_word(piece), classes);
                let _ = if is_other { &mut other } else { &mut meant }.push(heard);
            }
            Ok(())
        })?;
        let mut evidence = Evidence::Uninformative;
        for (words, is_meant) in [(&meant, true), (&other, false)] {
            let Some(fits) = self.fits(domain, words, closed)? else { continue };
            // The words are compared with tasks that keep the rest, even if another task fits better.
            let (mut kept, mut most): (Vec<f32, { TaskSet::MOST }>, f32) = (Vec::new(), WRONG);
            for (task, &fit) in fits.iter().enumerate() {
                let share = if is_meant { self.kept(domain, task, turned) } else { 1.0 };
                most = if share > ACT_CHANGED { most.max(fit) } else { most };
                let _ = kept.push(share);
            }
            let fit = |task: usize| (1.0 - WRONG) * (fits.get(task).copied().unwrap_or(0.0) / most).min(1.0);
            let kept = |task: usize| kept.get(task).copied().unwrap_or(1.0);
            let possible =
                self.belief_mut().observe_unrelated(|task| if is_meant { kept(task) * (WRONG + fit(task)) } else { 1.0 - fit(task) });
            evidence = if possible { Evidence::Used } else { Evidence::Impossible };
        }
        Ok(evidence)
    }

    /// The probability of the change from one of the corrected tasks to this task, by what they have in common.
    fn kept<D: Domain>(&self, domain: &D, task: usize, turned: TaskSet) -> f32 {
        let Some(other) = turned.iter().next() else { return 1.0 };
        let (one, another) = (self.task(task), self.task(other));
        match () {
            () if one.lifted != another.lifted => ACT_CHANGED,
            () if self.place_of_thing(domain, task) == self.place_of_thing(domain, other) => 1.0,
            () => PLACE_CHANGED,
        }
    }

    /// How well each task fits words that name something, relative to the best one; `None` if all fit alike.
    fn fits<D: Domain>(
        &mut self,
        domain: &D,
        words: &[Heard],
        closed: ClosedWords<'_>,
    ) -> Result<Option<Vec<f32, { TaskSet::MOST }>>, AgentError> {
        if words.is_empty() || words.iter().all(|word| word.is_new) {
            return Ok(None);
        }
        let wording = Wording::of(self.language(), closed, (domain.world().schema.attributes.len() << 1) as u8, (&|| true, None));
        let mut explained = Explained::NEW;
        self.explain_all(domain, Words::new(words, false), View { done: EITHER, has_act: true }, Context::of(&wording), &mut explained)?;
        self.share(domain, View::PLAIN.done);
        let most =
            explained.likelihoods.iter().fold(Scaled::ZERO, |most, &likelihood| if likelihood.exceeds(most) { likelihood } else { most });
        let mut fits: Vec<f32, { TaskSet::MOST }> = Vec::new();
        for likelihood in &explained.likelihoods {
            let _ = fits.push(likelihood.over(most));
        }
        let is_even = most.is_zero() || fits.iter().all(|&fit| fit == 1.0);
        Ok(Some(fits).filter(|_| !is_even))
    }
}
