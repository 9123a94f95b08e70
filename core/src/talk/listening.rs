//! Listening: the verdict on an utterance, and the session that it begins.

use super::acceptance::{ACTS_FROM, Sorts};
use super::context::{Context, DONE, Earlier, View};
use super::explained::Explained;
use super::heard::Utterance;
use super::hypothesis::{Hypothesis, Judged};
use super::mended::mend;
use super::syntax::without_leaving;
use super::verdict::Verdict;
use super::wording::{Observe, Pause, Wording, take_pause};
use super::words::Words;
use crate::language::Model;
use crate::language::tokenizer::{first_words, start_of_piece};
use crate::memory::AgentMemory;
use crate::oomdp::Domain;
use crate::planning::Progress;
use crate::probability::Scaled;
use crate::session::phase::Progressed;
use crate::session::{Agent, AgentError};
use crate::task::grounded::share_with_done;
use crate::task::{GroundedTask, TaskSet};
use crate::voice::classes::ClosedWords;
use heapless::Vec;

/// The probability that a thing already in place is meant when all are to be brought.
const NOT_MEANT: f32 = 1e-4;

/// The result of [`Agent::listen`].
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct Listened {
    /// The verdict on the utterance.
    pub verdict: Verdict,
    /// The most likely hypothesis about the utterance.
    pub hypothesis: Hypothesis,
    /// The most likely task of the session, by its position. If the utterance is negated, the session's tasks are
    /// [negated](crate::task::GroundedTask::is_negated).
    pub task: usize,
    /// All tasks that are meant. There are several if the utterance is about all things of a kind: one for each thing that is not yet in
    /// its place, or, if all are, one for each thing.
    pub tasks: TaskSet,
    /// The probability that these tasks are meant.
    pub probability: f32,
    /// The probability that one of the session's tasks is meant.
    pub command: f32,
    /// The least probability to act on, [`ACTS_FROM`](super::ACTS_FROM); for several commands, of all together.
    pub sure: f32,
    /// The byte where the rest of the utterance begins, if it has several commands. The session is about the first. Pass the rest to
    /// [`Agent::listen_on`], in the state that the first leads to.
    pub rest: Option<usize>,
    /// The byte where the unread words begin: those beyond [`WORDS_PER_COMMAND`](crate::capacity::WORDS_PER_COMMAND). The verdict is then
    /// never sure, unless the rest has them.
    pub unread: Option<usize>,
}

/// Table cells of work, at most about, between two pauses of a robot that takes everything as a command.
const PART: u32 = 1_000;

/// Whether a text ends with a question mark, one more letter on.
const fn ends_with_question_mark(did: bool, letter: char) -> bool {
    matches!(letter, '?' | '？') || did && letter == ' '
}

impl<M: AgentMemory> Agent<M> {
    /// Hears an utterance that may be no command, in the start state of a session, and returns a verdict on it. `words` are the closed
    /// classes of the spoken language. The session's tasks are those that are possible here and, with a small share, those that are done
    /// already. An untrained robot takes everything as a command, and so does Model 2.
    ///
    /// # Errors
    /// As [`hear`](Self::hear).
    pub fn listen<D: Domain>(
        &mut self,
        domain: &D,
        state: &D::State,
        utterance: &str,
        words: ClosedWords<'_>,
    ) -> Result<Listened, AgentError> {
        self.listen_in_parts(domain, state, utterance, words, false, &|| true)
    }

    /// As [`listen`](Self::listen), or, if `is_rest`, as [`listen_on`](Self::listen_on), with a call of `pause` before each task is
    /// compared with the words. There a controller does its other work, feeds its watchdog, or checks the time. The result is the same to
    /// the bit. If `pause` returns `false`, the robot stops listening.
    ///
    /// # Errors
    /// As [`hear`](Self::hear), and [`AgentError::Stopped`]: no session is then under way.
    pub fn listen_in_parts<D: Domain>(
        &mut self,
        domain: &D,
        state: &D::State,
        utterance: &str,
        words: ClosedWords<'_>,
        is_rest: bool,
        pause: &dyn Fn() -> bool,
    ) -> Result<Listened, AgentError> {
        self.listen_and_show(domain, state, utterance, words, is_rest, (pause, None))
    }

    /// As [`listen_in_parts`](Self::listen_in_parts), and shows each reading to `observe` before one is chosen. It is shown also the readings
    /// that are never chosen, because nobody was heard to mean them with such words; with `None` they are not worked out.
    ///
    /// # Errors
    /// As [`listen_in_parts`](Self::listen_in_parts).
    pub fn listen_and_show<D: Domain>(
        &mut self,
        domain: &D,
        state: &D::State,
        utterance: &str,
        words: ClosedWords<'_>,
        is_rest: bool,
        pause: (Pause<'_>, Observe<'_>),
    ) -> Result<Listened, AgentError> {
        let mut conversation = self.conversation.here(domain);
        // Words of the rest may refer to the previous part.
        let part = self.most_likely().filter(|_| is_rest).map(|task| self.task(task));
        let (kind, start) = (part.map(|part| part.lifted), self.started_from(domain));
        if let Some((part, start)) = part.zip(start) {
            conversation = conversation.after(domain, &self.lifted, &start, &part);
        }
        let earlier = Earlier { is_rest, kind, before: conversation.before() };
        self.listen_to(domain, state, utterance, words, earlier, pause)
    }

    /// Hears the rest of an utterance with several commands, from [`Listened::rest`] on, in the state that the previous part leads to. A
    /// command may leave out a word of the previous part: "and then to the red room".
    ///
    /// # Errors
    /// As [`hear`](Self::hear).
    pub fn listen_on<D: Domain>(
        &mut self,
        domain: &D,
        state: &D::State,
        rest: &str,
        words: ClosedWords<'_>,
    ) -> Result<Listened, AgentError> {
        self.listen_in_parts(domain, state, rest, words, true, &|| true)
    }

    /// As [`listen_on`](Self::listen_on), with the previous part's lifted task from a record, by its position. References are to the
    /// [remembered](Self::remember) conversation.
    ///
    /// # Errors
    /// As [`hear`](Self::hear).
    pub fn listen_after<D: Domain>(
        &mut self,
        domain: &D,
        state: &D::State,
        rest: &str,
        words: ClosedWords<'_>,
        kind: Option<u8>,
    ) -> Result<Listened, AgentError> {
        let conversation = self.conversation.here(domain);
        let earlier = Earlier { is_rest: true, kind, before: conversation.before() };
        self.listen_to(domain, state, rest, words, earlier, (&|| true, None))
    }

    fn listen_to<D: Domain>(
        &mut self,
        domain: &D,
        state: &D::State,
        utterance: &str,
        words: ClosedWords<'_>,
        earlier: Earlier<'_>,
        pause: (Pause<'_>, Observe<'_>),
    ) -> Result<Listened, AgentError> {
        let read = first_words(utterance);
        let unread = Some(read.len()).filter(|&end| end < utterance.len());
        let is_of_roles = self.options.language.model.in_use() == Model::Roles;
        self.open(domain, state, read, if is_of_roles { DONE } else { self.options.done }, false)?;
        if !is_of_roles || self.language().tables().words() == 0 {
            self.begin_to_understand()?;
            while self.hear_on(domain, PART)? == Progress::Working {
                take_pause(pause.0).inspect_err(|_| self.leave())?;
            }
            let task = self.most_likely().unwrap_or(0);
            let (hypothesis, probability) = (Hypothesis::Command, self.belief().probability(task));
            let tasks = TaskSet::of(task);
            let (verdict, command) = (Verdict::Unsure, 1.0);
            return Ok(Listened { verdict, hypothesis, task, tasks, probability, command, sure: ACTS_FROM, rest: None, unread });
        }
        let result = self.listen_here(domain, read, words, earlier, unread, pause);
        if result.is_err() {
            (self.start, self.progressed) = (None, Progressed::Idle);
        }
        result
    }

    fn listen_here<D: Domain>(
        &mut self,
        domain: &D,
        utterance: &str,
        closed: ClosedWords<'_>,
        earlier: Earlier<'_>,
        unread: Option<usize>,
        pause: (Pause<'_>, Observe<'_>),
    ) -> Result<Listened, AgentError> {
        self.begin_to_understand()?;
        self.take_up(domain)?;
        let (mut words, mut mended): (Utterance, Utterance) = (Vec::new(), Vec::new());
        let language = self.language();
        let knows = |word: &str| language.words().find(word).is_some_and(|word| word.index() < language.tables().words());
        let closed = closed.spoken(&knows);
        self.hear_words(utterance, closed, &mut words)?;
        let wording = Wording::of(language, closed, (domain.world().schema.attributes.len() << 1) as u8, pause);
        let has_slips = mend(language, closed, utterance, &words, &mut mended)?;
        let sorts = &Sorts::of(utterance, closed.weights, &words, &mended);
        // A question mark is about the whole utterance.
        let is_asked = !earlier.is_rest && utterance.chars().fold(false, ends_with_question_mark);
        let (mut words, mut explained) = (Words::new(&words, is_asked), Explained::NEW);
        let context = Context { earlier, ..Context::of(&wording) };
        self.explain_all(domain, words, View::PLAIN, context, &mut explained)?;
        if has_slips {
            self.try_wording(domain, &mut words, Words::new(&mended, is_asked), context, &mut explained)?;
        }
        let told = self.tell_apart(domain, &mut words, context, &mut explained)?;
        let context = Context { told: told.as_ref(), ..context };
        if told.is_some() {
            self.explain_all(domain, words, View::PLAIN, context, &mut explained)?;
        }
        if let Some(left) = without_leaving(words) {
            self.try_wording(domain, &mut words, left, context, &mut explained)?;
        }
        let judged = self.judge(domain, words, sorts, &mut explained, context)?;
        let done = self.done(domain);
        let is_done = !judged.tasks.is_empty() && judged.tasks.without(done).is_empty();
        let verdict = if judged.is_accepted && (unread.is_none() || judged.rest.is_some()) {
            if is_done { Verdict::Done } else { Verdict::Sure }
        } else {
            match judged.hypothesis {
                Hypothesis::Nothing | Hypothesis::Absent | Hypothesis::Talk(_) => Verdict::None,
                _ => Verdict::Unsure,
            }
        };
        self.believe(domain, judged.words, &explained)?;
        let Judged { hypothesis, task, probability, command, .. } = judged;
        let tasks = if is_done { judged.tasks } else { judged.tasks.without(done) };
        let rest = judged.rest.and_then(|rest| start_of_piece(utterance, rest));
        Ok(Listened { verdict, hypothesis, task, tasks, probability, command, sure: ACTS_FROM, rest, unread })
    }

    /// Takes another wording of the words if it is more probable. Leaves the explanation of the taken words in `explained`.
    fn try_wording<'w, D: Domain>(
        &mut self,
        domain: &D,
        words: &mut Words<'w>,
        other: Words<'w>,
        context: Context<'_>,
        explained: &mut Explained,
    ) -> Result<(), AgentError> {
        let here = explained.here;
        self.explain_all(domain, other, View::PLAIN, context, explained)?;
        if explained.here.exceeds(here) {
            *words = other;
            return Ok(());
        }
        // Computed again rather than kept: two explanations would be too much for a controller's stack.
        self.explain_all(domain, *words, View::PLAIN, context, explained)
    }

    /// The tasks of the session that hold in its start state: for these the robot rests.
    pub fn done<D: Domain>(&self, domain: &D) -> TaskSet {
        let Some(state) = self.started_from(domain) else { return TaskSet::EMPTY };
        let holds = |task: usize| {
            let task = self.task(task);
            let lifted = self.lifted().get(usize::from(task.lifted));
            lifted.is_some_and(|lifted| !lifted.has_way() && task.is_reached(lifted, |part| domain.holds(part, &state)))
        };
        (0..self.tasks().len()).filter(|&task| holds(task)).fold(TaskSet::EMPTY, TaskSet::with)
    }

    /// If all things of a kind are meant, drops those that are in place already.
    ///
    /// # Errors
    /// [`AgentError::NotNow`].
    pub fn leave_out_done<D: Domain>(&mut self, domain: &D, listened: &Listened) -> Result<(), AgentError> {
        let done = self.done(domain);
        let may_be_of_all = matches!(listened.hypothesis, Hypothesis::All | Hypothesis::Several) && listened.verdict != Verdict::Done;
        if may_be_of_all && !done.is_empty() && !self.tasks().iter().any(GroundedTask::is_negated) {
            let _ = self.answered(done, false, NOT_MEANT, 1)?;
        }
        Ok(())
    }

    /// Gives the share `done` of the prior to the tasks that hold already.
    pub(super) fn share<D: Domain>(&mut self, domain: &D, done: f32) {
        if let Some(state) = self.started_from(domain) {
            let tasks = self.memory.lend().session.tasks.get_mut(..self.task_count).unwrap_or(&mut []);
            share_with_done(&self.lifted, tasks, done, |part| domain.holds(part, &state));
        }
    }

    /// Begins the session with the words' likelihood under each task.
    fn believe<D: Domain>(&mut self, domain: &D, words: Words<'_>, all: &Explained) -> Result<(), AgentError> {
        self.share(domain, all.done);
        // The session is learned from the words that were meant.
        self.sentence.clear();
        for word in words.iter() {
            let _ = self.sentence.push(word.said.symbol);
        }
        let mut scene = self.scene(domain);
        for task in 0..self.tasks().len() {
            let likelihood = all.likelihoods.get(task).copied().unwrap_or(Scaled::ZERO);
            self.add_description(domain, &mut scene, task, likelihood)?;
            let weight = all.weights.get(task).copied().unwrap_or(Scaled::ZERO);
            self.belief_mut().set_prior(task, weight);
        }
        if all.weights.iter().all(|weight| weight.is_zero()) {
            for task in 0..self.tasks().len() {
                let prior = Scaled::new(self.task(task).prior);
                self.belief_mut().set_prior(task, prior);
            }
        }
        self.progressed = Progressed::Ready;
        Ok(())
    }
}
