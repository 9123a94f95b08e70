//! Words that correct a robot on its way: "no, the blue one", "not the red one".
//!
//! They are evidence about the session under way. With L(t) the likelihood of the words that name something, as the role model reads them
//! for a task t that needs no word of its own, and M the largest of these, the belief in t is multiplied by e + (1 - e) L(t) / M. For words
//! behind a negation it is 1 - (1 - e) L(t) / M. Words that were never heard fit all tasks alike, and say nothing.

use super::classes::{Class, Classes, ClosedWords};
use super::explained::Explained;
use super::heard::{Heard, Utterance, Words};
use super::place::View;
use super::readings::EITHER;
use super::wording::Wording;
use crate::asking::Asking;
use crate::language::roles::talk::is_of_task;
use crate::language::{for_each_piece, word_form};
use crate::memory::AgentMemory;
use crate::oomdp::Domain;
use crate::probability::Scaled;
use crate::session::{Agent, AgentError, Evidence};
use crate::symbols::Symbol;
use crate::task::{GroundedTask, TaskSet};
use heapless::Vec;

/// How often the words of a correction name a thing that is not meant. Who corrects the robot sees what it does, and chooses the words for that.
const WRONG: f32 = 1e-4;

/// How probable it is that the place is corrected where the thing may be, and that the act is corrected.
const PLACE_CHANGED: f32 = 0.05;
const ACT_CHANGED: f32 = 0.01;

/// The share of the belief in the next task that is left to the task that is corrected.
const LEFT: f32 = 0.05;

/// What a correction was taken for, so that it can be recorded.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Corrected {
    /// The task that the robot was turned from, by its position.
    pub task: usize,
    /// The probability with which the "no" to that task is wrong: the `eta` of [`answered`](Agent::answered).
    pub eta: f32,
}

impl<M: AgentMemory> Agent<M> {
    /// Whether a word says what to do, as "go" does: such words are a command rather than a correction. Known is what was learned; the words
    /// of closed classes never are.
    ///
    /// # Errors
    /// As [`hear`](Self::hear), where the words are too many or too long.
    pub fn is_told_to_act(&self, words: &str, closed: ClosedWords<'_>) -> Result<bool, AgentError> {
        let mut told = false;
        for_each_piece(words, |piece| {
            told |= closed.of(piece).about_commands() == Classes::NONE && is_of_task(self.language().tables(), self.known_word(piece));
            Ok(())
        })?;
        Ok(told)
    }

    /// Whether a word was learned from some command.
    pub fn knows_word(&self, word: &str) -> bool {
        self.known_word(word).is_some()
    }

    /// The learned word that a piece of an utterance is.
    fn known_word(&self, piece: &str) -> Option<Symbol> {
        let (language, learned) = (self.language(), self.language().tables().words());
        let form = word_form(piece, self.options().language.letters_kept());
        language.word_like(piece, learned).or_else(|| language.words().find(form)).filter(|word| word.index() < learned)
    }

    /// Takes in words that correct the robot: "no, the other one", "I meant the blue one", "not the red one". They are an answer "no" to the task
    /// that it follows, which is left with a twentieth of the belief in the next one at most, however sure the robot was; and the words
    /// are [evidence](Self::corrected). `followed` is the task that the last step was for; where it is `None`, the one that the robot has decided for.
    ///
    /// # Errors
    /// As [`corrected`](Self::corrected).
    pub fn correct<D: Domain + ?Sized>(
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

    /// Takes in words that correct the robot on its way, as evidence about the session under way, without the "no" to what it does, which is one of
    /// `turned`. What the words do not name stays as it is there: another thing in the same place, sooner than the same thing elsewhere.
    ///
    /// # Errors
    /// [`AgentError::NotNow`] and [`AgentError::OtherDomain`], and as [`hear`](Self::hear) where the words are too many or too long.
    pub fn corrected<D: Domain + ?Sized>(
        &mut self,
        domain: &D,
        words: &str,
        closed: ClosedWords<'_>,
        turned: TaskSet,
    ) -> Result<Evidence, AgentError> {
        self.check_session(domain)?;
        if self.tasks().iter().any(GroundedTask::is_negated) || self.language().tables().words() == 0 {
            return Ok(Evidence::SaysNothing);
        }
        let (mut meant, mut other): (Utterance, Utterance) = (Vec::new(), Vec::new());
        let mut is_other = false;
        for_each_piece(words, |piece| {
            let classes = closed.of(piece).about_commands();
            // "No" stands for itself; "not" turns round what is behind it.
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
        let mut evidence = Evidence::SaysNothing;
        for (words, is_meant) in [(meant, true), (other, false)] {
            let Some(fits) = self.fits(domain, &words, closed)? else { continue };
            // The words are to fit what keeps the rest, though something else may fit better.
            let (mut kept, mut most): (Vec<f32, { TaskSet::MOST }>, f32) = (Vec::new(), WRONG);
            for (task, &fit) in fits.iter().enumerate() {
                let share = if is_meant { self.kept(domain, task, turned) } else { 1.0 };
                most = if share > ACT_CHANGED { most.max(fit) } else { most };
                let _ = kept.push(share);
            }
            let fit = |task: usize| (1.0 - WRONG) * (fits.get(task).copied().unwrap_or(0.0) / most).min(1.0);
            let kept = |task: usize| kept.get(task).copied().unwrap_or(1.0);
            let possible =
                self.belief_mut().observe_beside(|task| if is_meant { kept(task) * (WRONG + fit(task)) } else { 1.0 - fit(task) });
            evidence = if possible { Evidence::Used } else { Evidence::Impossible };
        }
        Ok(evidence)
    }

    /// How probable a task is where one of these is corrected, by what it has in common with that one.
    fn kept<D: Domain + ?Sized>(&self, domain: &D, task: usize, turned: TaskSet) -> f32 {
        let Some(other) = turned.iter().next() else { return 1.0 };
        let (one, another) = (self.task(task), self.task(other));
        match () {
            () if one.lifted != another.lifted => ACT_CHANGED,
            () if self.place_of_thing(domain, task) == self.place_of_thing(domain, other) => 1.0,
            () => PLACE_CHANGED,
        }
    }

    /// How well each task fits words that name something, against the one that fits best; `None` where all fit alike.
    fn fits<D: Domain + ?Sized>(
        &mut self,
        domain: &D,
        words: &[Heard],
        closed: ClosedWords<'_>,
    ) -> Result<Option<Vec<f32, { TaskSet::MOST }>>, AgentError> {
        if words.is_empty() || words.iter().all(|word| word.is_new) {
            return Ok(None);
        }
        let wording = Wording::of(self.language(), closed, (domain.world().schema.attributes.len() << 1) as u8, &|| true);
        let mut explained = Explained::NEW;
        let view = View { done: EITHER, has_act: true, ..View::PLAIN };
        self.explain_all(domain, Words::new(words, false), &wording, view, &mut explained)?;
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
