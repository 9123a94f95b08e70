//! The end of a session: each machine command gets its share of the posterior, and the language model learns from it.

use super::agent::Agent;
use super::candidates::{Candidates, CandidatesRef};
use super::error::AgentError;
use super::gave_way::GaveWay;
use super::options::Weights;
use super::phase::{Phase, Position, Progressed};
use crate::language::forgetting::{Room, Step};
use crate::memory::{AgentMemory, AgentTables};
use crate::oomdp::{Domain, digest};
use crate::planning::Progress;
use crate::probability::{Scaled, total};
use crate::symbols::Symbol;
use crate::task::GroundedTask;

/// The machine commands that a session is learned as, with their shares of 1: those with more than `least` of the total weight.
fn shares(candidates: CandidatesRef<'_>, least: f32) -> impl Iterator<Item = (&[Symbol], f32)> + Clone {
    let whole = total(candidates.entries().iter().map(|entry| entry.weight));
    let share = move |weight: Scaled| Some(weight.over(whole)).filter(|&share| share > least);
    let kept: f32 = candidates.entries().iter().filter_map(|entry| share(entry.weight)).sum();
    candidates.entries().iter().filter_map(move |entry| share(entry.weight).map(|share| (candidates.tokens(entry), share / kept)))
}

/// The result of ending a session.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[must_use = "other sessions may have given way"]
#[non_exhaustive]
pub struct Finished {
    /// The older sessions that gave way because memory was full.
    pub gave_way: GaveWay,
}

impl<M: AgentMemory> Agent<M> {
    /// Ends the session and forgets all its evidence, also about the trainer. The same command can then be heard and walked through again,
    /// for instance to go one step back.
    pub fn forget_evidence(&mut self) {
        self.forget();
        self.end_session();
        self.belief_mut().forget();
    }

    /// Ends the session without learning from it. Its new words and machine tokens are forgotten only with the next command, so
    /// [`hear_again`](Self::hear_again) can still resume the session.
    pub fn forget(&mut self) {
        match self.progressed {
            // A half-heard command is no session.
            Progressed::Begun(..) | Progressed::Words(..) | Progressed::Opened | Progressed::Hearing(..) => self.end_session(),
            _ => self.complete_joining(),
        }
        self.set_ended();
        self.forget_plan();
    }

    /// Ends the session without learning from it and forgets its tasks, because the robot leaves their environment.
    pub fn leave(&mut self) {
        self.end_session();
    }

    /// Whether the session that is being finished joins the training data already, or another one gives way for it. [`forget`](Self::forget),
    /// a new command and new settings then come too late: they first do at once what is left, which takes long. A control loop goes on with
    /// [`finish_on`](Self::finish_on) instead.
    pub fn is_joining(&self) -> bool {
        matches!(self.progressed, Progressed::Tidying(_)) || self.language().bitext().is_removing()
    }

    /// Whether no complete model can be saved: the last session is in the training data, but its words and tokens do not count as learned
    /// yet, one that gives way is partly removed, or a model is being restored.
    pub(crate) fn is_between_models(&self) -> bool {
        matches!(self.progressed, Progressed::Restoring(_)) || self.is_joining()
    }

    /// Marks the words of a session that has joined the training data as learned. Otherwise they would be forgotten with all new words. A
    /// session that gives way is removed whole.
    #[inline(never)]
    pub(super) fn complete_joining(&mut self) {
        #[cfg(feature = "learning")]
        self.complete_removal();
        #[cfg(feature = "learning")]
        if let Progressed::Tidying(step) = &mut self.progressed {
            // Another session may have been unlearned meanwhile, so the choice starts again.
            *step = Step::Look;
        }
        #[cfg(feature = "learning")]
        while let Progressed::Tidying(step) = self.progressed
            && self.tidy(step).is_ok_and(|room| room != Room::Found)
        {}
    }
}

#[cfg(feature = "learning")]
impl<M: AgentMemory> Agent<M> {
    /// Completes the removal of a session that gives way. Not inlined, because the language model would take room on the caller's stack.
    #[inline(never)]
    fn complete_removal(&mut self) {
        if cfg!(feature = "forgetting") && matches!(self.progressed, Progressed::Keeping(_) | Progressed::Tidying(_)) {
            self.language_mut().complete_removal();
        }
    }

    /// Whether the session's tasks are negated. Their words are not those of the command, so nothing is learned.
    fn is_negated(&self) -> bool {
        self.tasks().iter().any(GroundedTask::is_negated)
    }

    /// Ends the session and learns from it: each machine command joins the training data with its share of the posterior, and training on
    /// all data begins. Call [`learn`](Self::learn) until it is done. If memory is full, older sessions give way, as
    /// [`forgetting`](crate::language::forgetting) describes; the result lists them.
    ///
    /// # Errors
    /// [`AgentError::NotNow`], [`AgentError::OtherDomain`], or [`AgentError::Capacity`] if the session does not fit even alone: it is then
    /// forgotten, and all that was learned before is kept. If none of its words found room when they were heard, other sessions give way,
    /// so that the same command is heard whole when it is said again.
    pub fn finish<D: Domain>(&mut self, domain: &D) -> Result<Finished, AgentError> {
        self.begin_finishing(domain)?;
        loop {
            if let Some(finished) = self.finish_on(domain, u32::MAX)? {
                return Ok(finished);
            }
        }
    }

    /// Ends the session and adds it to the training data, without training. The next [`finish`](Self::finish) or
    /// [`begin_learning`](Self::begin_learning) trains on it too, so several sessions cost one training.
    ///
    /// # Errors
    /// As [`finish`](Self::finish); but no other session gives way: if there is no room, the result is [`AgentError::Capacity`], the
    /// session goes on, and [`finish`](Self::finish) makes room for it.
    pub fn finish_for_later<D: Domain>(&mut self, domain: &D) -> Result<(), AgentError> {
        self.check_session(domain)?;
        if self.is_negated() {
            self.forget();
            return Ok(());
        }
        self.weigh(domain)?;
        let AgentTables { language, session, workspace } = self.memory.lend();
        let candidates = CandidatesRef::new(session.read().candidates, self.candidates);
        self.language.with(language, workspace).add_session(&self.sentence, shares(candidates, self.options.least_weight))?;
        #[cfg(feature = "layer")]
        self.add_possible();
        self.set_ended();
        self.forget_plan();
        self.take_usage();
        Ok(())
    }

    /// Removes one session from the training data, by its position from 0 on, the oldest first, with the words and machine tokens that no
    /// other session has, and begins training on the rest: call [`learn`](Self::learn) until it is done. Returns `false` if there is no
    /// such session. A session under way ends unlearned. The belief about the trainer, and later sessions' weights, are not corrected.
    ///
    /// ```
    /// use goodbot::{Agent, Capacities, HeapMemory, Options, home};
    /// let memory = HeapMemory::new(&Capacities::SMALL);
    /// let mut agent = Agent::new(memory.agent, &home::paper_tasks()?, Options::DEFAULT)?;
    /// assert!(!agent.unlearn(0), "nothing was learned yet");
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn unlearn(&mut self, session: u16) -> bool {
        if usize::from(session) >= self.language().bitext().sessions() {
            return false;
        }
        self.complete_removal();
        // Do this first: the position changes if sessions give way for one that is being finished.
        self.language_mut().remove_session(session);
        self.end_session();
        self.workspace_to_training();
        self.language_mut().forget_unused();
        true
    }

    /// Begins to learn from all sessions so far. Call [`learn`](Self::learn) until it is done.
    pub fn begin_learning(&mut self) {
        self.forget();
        self.workspace_to_training();
        self.language_mut().begin_training();
    }

    /// Begins to end the session in parts, otherwise as [`finish`](Self::finish) does: call [`finish_on`](Self::finish_on) until it is
    /// done.
    ///
    /// # Errors
    /// As [`finish`](Self::finish).
    pub fn begin_finishing<D: Domain>(&mut self, domain: &D) -> Result<(), AgentError> {
        self.check_session(domain)?;
        self.gave_way = GaveWay::NONE;
        self.begin_weighing(self.options.weights);
        Ok(())
    }

    /// Continues to end the session, with at most about `budget` table cells of work (at least one machine command, or a look at one
    /// session that may give way). The budget does not change the result. `None` means: call again.
    ///
    /// # Errors
    /// As [`finish`](Self::finish).
    pub fn finish_on<D: Domain>(&mut self, domain: &D, budget: u32) -> Result<Option<Finished>, AgentError> {
        if self.phase() != Phase::Finishing {
            return Err(AgentError::NotNow(self.phase()));
        }
        if self.domain != digest(domain) {
            return Err(AgentError::OtherDomain);
        }
        let result = self.finish_part(domain, budget.max(1));
        if result.is_err() {
            match self.progressed {
                // Nothing has joined the training data yet: the session goes on.
                Progressed::Weighing(..) => self.progressed = Progressed::Ready,
                _ => self.set_ended(),
            }
        }
        result
    }

    fn finish_part<D: Domain>(&mut self, domain: &D, mut left: u32) -> Result<Option<Finished>, AgentError> {
        while left > 0 {
            match self.progressed {
                // The command "again" has no words for its task.
                Progressed::Weighing(..) if self.is_negated() || self.sentence.is_empty() => {
                    self.forget();
                    return Ok(Some(Finished { gave_way: self.gave_way }));
                }
                Progressed::Weighing(..) => {
                    if self.weigh_on(domain, &mut left)? == Progress::Done {
                        self.workspace_to_training();
                        self.progressed = Progressed::Keeping(Step::Look);
                    }
                }
                Progressed::Keeping(step) => {
                    let room = self.keep(step)?;
                    if room == Room::Found {
                        #[cfg(feature = "layer")]
                        self.add_possible();
                        self.progressed = Progressed::Tidying(Step::Look);
                    }
                    left = left.saturating_sub(self.cells_of(room));
                }
                Progressed::Tidying(step) => {
                    let room = self.tidy(step)?;
                    if room == Room::Found {
                        self.set_ended();
                        return Ok(Some(Finished { gave_way: self.gave_way }));
                    }
                    left = left.saturating_sub(self.cells_of(room));
                }
                _ => return Err(AgentError::NotNow(self.phase())),
            }
        }
        Ok(None)
    }

    /// The approximate work of looking at a session, or of keeping one or making room for it, in table cells.
    fn cells_of(&self, room: Room) -> u32 {
        let data = self.language().bitext();
        (if room == Room::Sought { data.sessions() } else { data.pairs().len() }) as u32
    }

    /// Adds the session's machine commands to the training data by their weights, or continues to make one other session give way.
    #[inline(never)]
    fn keep(&mut self, mut step: Step) -> Result<Room, AgentError> {
        self.forget_plan();
        let AgentTables { language, session, workspace } = self.memory.lend();
        let mut language = self.language.with(language, workspace);
        let candidates = Candidates::new(session.candidates, &mut self.candidates);
        let candidates = candidates.read();
        let pairs = shares(candidates, self.options.least_weight);
        match language.add_session_or_make_room(&self.sentence, candidates.all_tokens(), || pairs.clone(), &mut step) {
            Ok(room) => {
                self.progressed = Progressed::Keeping(step);
                self.gave_way.note(room);
                Ok(room)
            }
            Err(error) => {
                self.start = None;
                language.forget_unlearned();
                // It would fit alone, but none of its words was heard: said again, it is.
                if matches!(step, Step::Take) && self.sentence.iter().all(Option::is_none) {
                    step = Step::Look;
                    while language.tidy_vocabulary(&mut self.sentence, &mut [], &mut step)? != Room::Found {}
                    language.begin_training();
                }
                Err(error.into())
            }
        }
    }

    /// Makes room in the vocabulary, or continues to make one other session give way for that; then training begins.
    #[inline(never)]
    fn tidy(&mut self, mut step: Step) -> Result<Room, AgentError> {
        let AgentTables { language, session, workspace } = self.memory.lend();
        let mut language = self.language.with(language, workspace);
        let mut candidates = Candidates::new(session.candidates, &mut self.candidates);
        let room = language.tidy_vocabulary(&mut self.sentence, candidates.all_tokens_mut(), &mut step)?;
        candidates.renamed();
        if room == Room::Found {
            language.begin_training();
            self.take_usage();
        }
        self.progressed = Progressed::Tidying(step);
        self.gave_way.note(room);
        Ok(room)
    }

    /// Computes the current weight of each machine command in [`candidates`](Self::candidates), for [`finish`](Self::finish) and for
    /// observers. Weights are unnormalised: each command is learned with its share of the sum. If no machine command explains the words,
    /// only the tasks' posterior counts, shared evenly among each task's constraints.
    ///
    /// # Errors
    /// [`AgentError::Capacity`].
    pub fn weigh<D: Domain>(&mut self, domain: &D) -> Result<(), AgentError> {
        let progressed = self.progressed;
        self.begin_weighing(self.options.weights);
        let result = loop {
            match self.weigh_on(domain, &mut { u32::MAX }) {
                Ok(Progress::Working) => {}
                Ok(Progress::Done) => break Ok(()),
                Err(error) => break Err(error),
            }
        };
        // A session that is being finished keeps these weights; weighing on would add them twice.
        if !matches!(progressed, Progressed::Weighing(..)) {
            self.progressed = progressed;
        }
        result
    }

    fn begin_weighing(&mut self, weights: Weights) {
        let session = self.memory.lend().session;
        let mut candidates = Candidates::new(session.candidates, &mut self.candidates);
        for position in 0..candidates.read().entries().len() {
            if let Some(entry) = candidates.entry_mut(position) {
                entry.weight = Scaled::ZERO;
            }
        }
        self.progressed = Progressed::Weighing(Position::of_task(0), weights);
    }

    fn weigh_on<D: Domain>(&mut self, domain: &D, left: &mut u32) -> Result<Progress, AgentError> {
        while let Progressed::Weighing(mut position, weights) = self.progressed {
            if position.task >= self.task_count {
                let unexplained = weights == Weights::Paper && self.candidates().entries().iter().all(|entry| entry.weight.is_zero());
                if !unexplained {
                    return Ok(Progress::Done);
                }
                self.begin_weighing(Weights::Belief);
                continue;
            }
            if *left == 0 {
                break;
            }
            let prior = self.task(position.task).prior;
            let evidence = match weights {
                Weights::Paper | Weights::Evidence => self.belief().evidence(position.task).scaled_by(prior),
                Weights::Belief => self.belief().weight(position.task),
            };
            let mut part = None;
            let done = self.for_each_candidate(domain, &mut position, left, |entry, share| {
                // Equal for all constraints of a task.
                let evidence = *part.get_or_insert_with(|| evidence.scaled_by(share));
                let explained = if weights == Weights::Paper { entry.likelihood } else { Scaled::ONE };
                entry.weight = entry.weight.plus(evidence.times(explained));
            })?;
            if done {
                position = Position::of_task(position.task.saturating_add(1));
            }
            self.progressed = Progressed::Weighing(position, weights);
        }
        Ok(Progress::Working)
    }

    /// Continues to learn, with at most about `budget` table cells of work. The first call also sizes the tables, regardless of the budget.
    pub fn learn(&mut self, budget: u32) -> Progress {
        self.language_mut().train(budget)
    }

    /// Learns until done.
    pub fn learn_fully(&mut self) {
        while self.learn(u32::MAX) == Progress::Working {}
    }
}
