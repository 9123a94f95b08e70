//! A task as one description, with all facts about it in the session's start state, for the role model.

use crate::capacity::{Capacities, LIFTED_TASKS, TOKENS_PER_COMMAND};
use crate::feedback::Belief;
use crate::language::roles::Layout;
use crate::language::roles::forward::Reading;
use crate::language::{LanguageMut, Meaning, Model};
use crate::memory::{AgentMemory, AgentTables};
use crate::oomdp::{Action, ActionKind, Domain, GroundProposition, OneByOne, World, digest};
use crate::planning::Progress;
use crate::probability::Scaled;
use crate::session::agent::Agent;
#[cfg(any(feature = "layer", feature = "ways"))]
use crate::session::candidates::CandidatesRef;
use crate::session::candidates::{Candidate, Candidates};
use crate::session::error::AgentError;
use crate::session::least::{Lessons, Survey};
#[cfg(feature = "ways")]
use crate::session::phase::Progressed;
use crate::session::phase::{Phase, Position};
use crate::symbols::{Symbol, listed};
use crate::task::description::{Scene, describe, form_token, groups};
use crate::task::machine_command::Tokens;
use heapless::Vec;

/// With a small budget, a part of the work looks for about this many tokens of values: each is compared with those that are known.
#[cfg(feature = "ways")]
const LOOKED_FOR: u32 = 24;
/// The position in a description that is made at once, because other work took the memory of its first part.
#[cfg(feature = "ways")]
const AT_ONCE: u16 = u16::MAX;

/// The language, a command, and the description of the task for which it is read.
type Read<'a> = (LanguageMut<'a>, &'a [Option<Symbol>], &'a [Symbol]);

/// A domain in which every proposition holds, or none.
struct Constant<'d, D> {
    domain: &'d D,
    holds: bool,
}

impl<D: Domain> Domain for Constant<'_, D> {
    type State = ();
    type Search = OneByOne;

    fn world(&self) -> World<'_> {
        self.domain.world()
    }

    fn actions(&self) -> &[ActionKind<'_>] {
        &[]
    }

    fn step(&self, (): &(), _action: Action) -> Option<()> {
        None
    }

    fn holds(&self, _proposition: &GroundProposition, (): &()) -> bool {
        self.holds
    }

    fn state_count(&self) -> u64 {
        1
    }

    fn number(&self, (): &()) -> u64 {
        0
    }

    fn numbered(&self, _number: u64) {}
}

impl<M: AgentMemory> Agent<M> {
    /// Goes on describing the task at the position. A part that is broken off is kept in the workspace, and the position counts the objects
    /// that it has. Returns whether the description is whole.
    #[cfg_attr(feature = "ways", inline(never))]
    #[cfg_attr(not(feature = "ways"), inline(always))]
    fn describe_on<D: Domain>(
        &mut self,
        domain: &D,
        scene: &mut Scene<D::State>,
        position: &mut Position,
        left: u32,
        description: &mut Tokens,
    ) -> Result<bool, AgentError> {
        let AgentTables { language, session, workspace } = self.memory.lend();
        let Some(task) = session.tasks.get(position.task) else { return Ok(true) };
        // A description needs none of the counts.
        let mut language = self.language.with(language, &mut []);
        #[cfg(feature = "ways")]
        let kept: &mut [u16] = bytemuck::cast_slice_mut(workspace);
        #[cfg(feature = "ways")]
        {
            let is_at_once = position.constraint == AT_ONCE || kept.len() <= TOKENS_PER_COMMAND;
            let written = if is_at_once { 0 } else { position.constraint };
            if written > 0 {
                let length = kept.first().map_or(0, |&length| usize::from(length));
                for &token in kept.iter().skip(1).take(length) {
                    let _ = description.push(Symbol(token));
                }
            }
            scene.describe_on(written, if is_at_once { u32::MAX } else { LOOKED_FOR.max(left) });
        }
        let described = describe(domain, &self.lifted, task, scene, language.tokens_mut(), description);
        #[cfg(feature = "ways")]
        {
            position.constraint = scene.broken_off().unwrap_or(0);
            if position.constraint > 0 {
                let tokens = core::iter::once(description.len() as u16).chain(description.iter().map(|token| token.0));
                kept.iter_mut().zip(tokens).for_each(|(slot, token)| *slot = token);
                // The last plan left its marks there.
                self.planned = None;
                self.planner.release_marks();
                return Ok(false);
            }
        }
        #[cfg(not(feature = "ways"))]
        let _ = (workspace, left);
        Ok(described.map(|()| true)?)
    }

    /// Continues Pr(e|t) for the task at the position. The position keeps the progress: `constraint` counts the words read, `sum` is their
    /// probability. Returns whether it is done.
    #[inline(never)]
    pub(super) fn read_description<D: Domain>(
        &mut self,
        domain: &D,
        scene: &mut Scene<D::State>,
        position: &mut Position,
        left: &mut u32,
    ) -> Result<bool, AgentError> {
        let mut description = Tokens::new();
        let added = self.candidates().added_for(position.task);
        if added.is_none() && !self.describe_on(domain, scene, position, *left, &mut description)? {
            *left = 0;
            return Ok(false);
        }
        let AgentTables { language, session, workspace } = self.memory.lend();
        let mut language = self.language.with(language, workspace);
        let mut candidates = Candidates::new(session.candidates, &mut self.candidates);
        let added = match added {
            Some(added) => added,
            None => {
                *left = left.saturating_sub(description.len() as u32);
                if let Some(found) = candidates.read().find(&description) {
                    candidates.describes(found, position.task);
                    position.sum = candidates.read().entries().get(found).map_or(Scaled::ZERO, |entry| entry.likelihood);
                    return Ok(true);
                }
                let added = candidates.add(position.task, &description, Scaled::ZERO)?;
                candidates.describes(added, position.task);
                if *left == 0 {
                    return Ok(false);
                }
                added
            }
        };
        let mut reading = match position.constraint {
            0 => Reading::START,
            words => Reading { words, probability: position.sum },
        };
        let read = candidates.read();
        let description = read.entries().get(added).map_or(&[][..], |entry| read.tokens(entry));
        let done = language.likelihood_on(&self.sentence, description, &mut reading, left);
        (position.constraint, position.sum) = (reading.words, reading.probability);
        if let Some(entry) = candidates.entry_mut(added).filter(|_| done) {
            entry.likelihood = reading.probability;
        }
        Ok(done)
    }

    /// Begins a description anew that is kept in the workspace, which other work needs now.
    #[cfg(feature = "ways")]
    pub(in crate::session) fn describe_anew(&mut self) {
        let (model, candidates) =
            (self.options.language.model.in_use(), CandidatesRef::new(self.memory.read().session.candidates, self.candidates));
        if let Progressed::Hearing(position, _) = &mut self.progressed
            && model == Model::Roles
            && position.constraint > 0
            && candidates.added_for(position.task).is_none()
        {
            position.constraint = AT_ONCE;
        }
    }

    /// Adds a task's description to the candidates, with Pr(e|t).
    #[cfg(feature = "talk")]
    pub(crate) fn add_description<D: Domain>(
        &mut self,
        domain: &D,
        scene: &mut Option<Scene<D::State>>,
        task: usize,
        likelihood: Scaled,
    ) -> Result<(), AgentError> {
        let AgentTables { language, session, workspace } = self.memory.lend();
        let mut language = self.language.with(language, workspace);
        let (Some(grounded), Some(scene)) = (session.tasks.get(task), scene) else { return Ok(()) };
        let mut candidates = Candidates::new(session.candidates, &mut self.candidates);
        let mut description = Tokens::new();
        describe(domain, &self.lifted, grounded, scene, language.tokens_mut(), &mut description)?;
        let position = match candidates.read().find(&description) {
            Some(found) => found,
            None => candidates.add(task, &description, likelihood)?,
        };
        candidates.describes(position, task);
        Ok(())
    }

    /// Calls `each` with the description of the task at the position.
    pub(super) fn with_description(&mut self, position: &Position, left: &mut u32, each: impl FnOnce(&mut Candidate, f32)) {
        let mut candidates = Candidates::new(self.memory.lend().session.candidates, &mut self.candidates);
        let Some(entry) = candidates.read().of_task(position.task).and_then(|found| candidates.entry_mut(found)) else { return };
        each(entry, 1.0);
        let cells = entry.length().saturating_mul(self.sentence.len().max(1)).saturating_mul(4);
        *left = left.saturating_sub(cells as u32);
    }

    /// Weighs the kinds of task.
    #[inline(never)]
    pub(super) fn weigh_kinds_of_descriptions<D: Domain>(&mut self, domain: &D) {
        let AgentTables { language, session, workspace } = self.memory.lend();
        let mut language = self.language.called_with(language, workspace);
        // The tokens of this session's tasks are interned already. A kind of task that is impossible here does not need its token.
        let form = |lifted| form_token(&domain.world().schema, lifted, language.tokens_mut()).unwrap_or(Symbol(0));
        let forms: Vec<Symbol, LIFTED_TASKS> = listed(self.lifted.iter().map(form));
        let tasks = session.tasks.get(..self.task_count).unwrap_or(&[]);
        let form = |task: usize| {
            let lifted = tasks.get(task).map_or(0, |task| usize::from(task.lifted));
            forms.get(lifted).copied().unwrap_or(Symbol(0))
        };
        let prior = |task: usize| tasks.get(task).map_or(0.0, |task| task.prior);
        let mut belief = Belief::new(session.belief, &mut self.belief);
        language.read().weigh_kinds(&self.sentence, form, prior, belief.priors_mut());
    }

    /// Replaces the tasks' weights by the layer's.
    #[cfg(feature = "layer")]
    #[inline(never)]
    pub(in crate::session) fn weigh_parts(&mut self) {
        if !self.options.language.has_layer() {
            return;
        }
        let AgentTables { language, session, workspace } = self.memory.lend();
        let language = self.language.with(language, workspace);
        let candidates = CandidatesRef::new(session.candidates.read(), self.candidates);
        let mut belief = Belief::new(session.belief, &mut self.belief);
        let same = |task: usize| (0..task).find(|&other| candidates.of_task(other) == candidates.of_task(task)).unwrap_or(task);
        let description = |task: usize| {
            let entry = candidates.of_task(task).and_then(|at| candidates.entries().get(at));
            entry.map_or(&[][..], |entry| candidates.tokens(entry))
        };
        language.read().weigh_parts(&self.sentence, same, description, belief.priors_mut());
    }

    /// Gives the layer the possible tasks of the session that joined the training data last. If it has no room for them, it learns nothing
    /// from the session.
    #[cfg(feature = "layer")]
    pub(in crate::session) fn add_possible(&mut self) {
        if !self.options.language.has_layer() {
            return;
        }
        let AgentTables { language, session, workspace } = self.memory.lend();
        let mut language = self.language.with(language, workspace);
        let candidates = CandidatesRef::new(session.candidates.read(), self.candidates);
        let tasks = session.tasks.get(..self.task_count).unwrap_or(&[]);
        let prior = |at: usize| -> f32 {
            tasks.iter().enumerate().filter(|&(task, _)| candidates.of_task(task) == Some(at)).map(|(_, task)| task.prior).sum()
        };
        let all = candidates.entries().iter().enumerate().map(|(at, entry)| (candidates.tokens(entry), prior(at)));
        let _ = language.add_possible(all);
    }

    /// Calls `tell` for each word of the command, the last word first: its position, a [`Meaning`] that it may have if this task is meant,
    /// and the probability of this meaning. It tells nothing for Model 2 and before anything is learned.
    ///
    /// # Errors
    /// [`AgentError::NotNow`], [`AgentError::OtherDomain`], and [`AgentError::Capacity`].
    pub fn explain<D: Domain>(&mut self, domain: &D, task: usize, mut tell: impl FnMut(usize, Meaning, f32)) -> Result<(), AgentError> {
        while self.explain_on(domain, task, u32::MAX)? == Progress::Working {}
        for position in (0..self.sentence.len()).rev() {
            self.explain_word(domain, task, position, |meaning, share| tell(position, meaning, share))?;
        }
        Ok(())
    }

    /// Reads the command for [`explain_word`](Self::explain_word), if this task is meant, with at most about `budget` table cells of work.
    /// A command that was heard since, or a session that ended, is read anew.
    ///
    /// ```
    /// use goodbot::planning::Progress;
    /// # use goodbot::{Agent, HeapMemory, Options, home::{self, Area, Cell, HomeBuilder, Moves}};
    /// # let mut memory = HeapMemory::new(&goodbot::Capacities::SMALL);
    /// # let mut builder = HomeBuilder::new(&mut memory.home);
    /// # builder.room("room0", Area::new(0, 0, 8, 4), "red")?;
    /// # builder.room("room1", Area::new(0, 4, 8, 8), "blue")?;
    /// # builder.door("door0", Area::new(4, 4, 4, 4))?;
    /// # builder.agent("agent0", Cell::new(4, 2))?;
    /// # let (home, state) = builder.build(Moves::Push)?;
    /// # let mut agent = Agent::new(memory.agent, &home::paper_tasks()?, Options::DEFAULT)?;
    /// agent.hear(&home, &state, "go to the red room")?;
    /// while agent.explain_on(&home, 0, 16)? == Progress::Working {
    ///     // the rest of the control loop
    /// }
    /// agent.explain_word(&home, 0, 3, |meaning, share| println!("red: {meaning:?}, {share}"))?;
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// As [`explain`](Self::explain).
    pub fn explain_on<D: Domain>(&mut self, domain: &D, task: usize, budget: u32) -> Result<Progress, AgentError> {
        match self.read_for(domain, task)? {
            Some((mut language, sentence, description)) => Ok(language.explain_on(sentence, description, budget)?),
            None => Ok(Progress::Done),
        }
    }

    /// As [`explain`](Self::explain), of the word at this position alone. Returns false, and tells nothing, until
    /// [`explain_on`](Self::explain_on) is done for this task.
    ///
    /// # Errors
    /// As [`explain`](Self::explain).
    pub fn explain_word<D: Domain>(
        &mut self,
        domain: &D,
        task: usize,
        position: usize,
        tell: impl FnMut(Meaning, f32),
    ) -> Result<bool, AgentError> {
        let explained = self.read_for(domain, task)?;
        Ok(explained.is_none_or(|(mut language, sentence, description)| language.explain_word(sentence, description, position, tell)))
    }

    /// The language, the command and a task's description; `None` if there is nothing that explains words.
    #[inline(never)]
    fn read_for<D: Domain>(&mut self, domain: &D, task: usize) -> Result<Option<Read<'_>>, AgentError> {
        if self.domain != digest(domain) {
            return Err(AgentError::OtherDomain);
        }
        if let phase @ (Phase::Learning | Phase::Hearing) = self.phase() {
            return Err(AgentError::NotNow(phase));
        }
        if self.start.is_none() {
            return Err(AgentError::NotNow(Phase::Idle));
        }
        let AgentTables { language, session, workspace } = self.memory.lend();
        let language = self.language.with(language, workspace);
        if language.model() != Model::Roles || language.read().tables().words() == 0 || language.read().is_training() {
            return Ok(None);
        }
        let candidates = Candidates::new(session.candidates, &mut self.candidates).into_read();
        let entry = candidates.of_task(task).filter(|_| task < self.task_count).and_then(|found| candidates.entries().get(found));
        Ok(entry.map(|entry| {
            language.training.begin_explaining(task);
            (language, &*self.sentence, candidates.tokens(entry))
        }))
    }

    /// A description depends on the places of the robot and the objects in the start state: each session can have its own.
    pub(super) fn most_descriptions<D: Domain>(
        &mut self,
        domain: &D,
        lessons: &Lessons,
        known: usize,
        survey: &mut Survey,
    ) -> Result<Capacities, AgentError> {
        let (tasks, mut longest) = (self.task_count, 0);
        for task in 0..tasks {
            longest = longest.max(self.longest_description(domain, task, &mut survey.layout)?);
        }
        survey.layout.see_length(lessons.heard_words());
        let tokens = self.language().tokens().len().saturating_sub(known);
        let descriptions = lessons.sessions.saturating_mul(tasks);
        Ok(Capacities {
            candidates: tasks,
            candidate_tokens: tasks.saturating_mul(longest),
            commands: descriptions,
            command_tokens: descriptions.saturating_mul(longest),
            alignments: survey.layout.with(lessons.different_words, tokens).cells(),
            ..Capacities::NONE
        })
    }

    /// The most symbols that a task's description can have in any start state. Adds the descriptions' parts to `layout`.
    fn longest_description<D: Domain>(&mut self, domain: &D, task: usize, layout: &mut Layout) -> Result<usize, AgentError> {
        let AgentTables { language, session, workspace } = self.memory.lend();
        let mut language = self.language.with(language, workspace);
        let Some(task) = session.tasks.get(task) else { return Ok(0) };
        let mut length = 1_usize;
        for holds in [true, false] {
            let mut description = Tokens::new();
            let constant = Constant { domain, holds };
            describe(&constant, &self.lifted, task, &mut Scene::new(()), language.tokens_mut(), &mut description)?;
            layout.see(&description);
            // Objects without a part in the task have the most groups if nothing holds, all others if everything holds.
            let counts = |of_others: bool| of_others != holds;
            let longest = groups(&description).filter(|group| counts(group.marker.role.kind().is_of_others()));
            length = longest.fold(length, |sum, group| sum.saturating_add(group.values.len()).saturating_add(1));
            if description.is_full() {
                length = TOKENS_PER_COMMAND;
            }
        }
        Ok(length.min(TOKENS_PER_COMMAND))
    }
}
