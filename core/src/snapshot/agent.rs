//! Saving and restoring everything that a robot has learned.

use super::contents::Contents;
use super::error::{RestoreError, SaveError};
use super::restoring::{Restoring, Stage};
use super::saving::{Model, Saving};
use crate::capacity::Capacity;
use crate::feedback::BeliefRef;
use crate::memory::{AgentMemory, AgentTables};
use crate::oomdp::Domain;
use crate::planning::Progress;

use crate::session::phase::Progressed;
use crate::session::{Agent, Options};
#[cfg(feature = "alloc")]
use alloc::{vec, vec::Vec};

impl<M: AgentMemory> Agent<M> {
    /// Saves all that was learned to the front of the buffer: the training data, the options, and the trainer strategies with their present
    /// probabilities. Returns the length. A session under way is not saved; a training under way starts again when restored. While a
    /// session joins the training data in parts ([`finish_on`](Self::finish_on)) there may be no complete model to save: finish it first.
    ///
    /// # Errors
    /// [`SaveError`]; the buffer may then hold anything.
    pub fn save(&self, buffer: &mut [u8]) -> Result<usize, SaveError> {
        self.saving()?.write(buffer)
    }

    /// Saves in parts, otherwise as [`save`](Self::save) does. Each part does at most about `budget` units of work: a unit is one byte
    /// written or eight bytes checked, and a part writes at least one record. Pass the same buffer to all parts. The bytes do not depend on
    /// the budget. Returns the length when all is saved; `None` means: call again. The robot may plan, act and take feedback meanwhile.
    ///
    /// ```
    /// use goodbot::{Agent, Options, home, snapshot::Saving};
    /// goodbot::memory! { struct Memory = goodbot::Capacities::TINY; }
    /// let mut memory = Memory::new();
    /// let agent = Agent::new(&mut memory.agent, &home::paper_tasks()?, Options::DEFAULT)?;
    /// let (mut buffer, mut saving) = ([0; 3_072], Saving::new());
    /// let length = loop {
    ///     if let Some(length) = agent.save_on(&mut saving, &mut buffer, 16)? { break length }
    ///     // the rest of the control loop
    /// };
    /// let mut at_once = [0; 3_072];
    /// assert_eq!(agent.save(&mut at_once)?, length);
    /// assert_eq!(buffer, at_once);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// [`SaveError`], as for [`save`](Self::save), and [`SaveError::Changed`] if a session was learned from meanwhile: start again.
    pub fn save_on(&self, saving: &mut Saving, buffer: &mut [u8], budget: u32) -> Result<Option<usize>, SaveError> {
        self.saving()?.write_on(saving, buffer, budget)
    }

    /// Saves as [`save`](Self::save) does, into the memory that planning and training share, so that no buffer is needed: the plan is
    /// forgotten. That memory has 8 bytes for each of [`workspace_words`](crate::Capacities::workspace_words).
    ///
    /// ```
    /// use goodbot::{Agent, Options, home};
    /// goodbot::memory! { struct Memory = goodbot::Capacities::TINY; }
    /// let mut memory = Memory::new();
    /// let mut agent = Agent::new(&mut memory.agent, &home::paper_tasks()?, Options::DEFAULT)?;
    /// let mut buffer = [0; 3_072];
    /// let length = agent.save(&mut buffer)?;
    /// assert_eq!(agent.save_in_place()?, &buffer[..length]);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// [`SaveError`]: if the model is larger than that memory, and [`SaveError::StillLearning`] while training needs it.
    pub fn save_in_place(&mut self) -> Result<&[u8], SaveError> {
        if self.language().is_training() || self.is_between_models() {
            return Err(SaveError::StillLearning);
        }
        self.workspace_to_training();
        let vocabulary = self.vocabulary();
        let AgentTables { language, session, workspace } = self.memory.lend();
        let model = Model {
            vocabulary,
            options: &self.options,
            language: self.language.read(language.read(), workspace.len()),
            strategies: Some(BeliefRef::new(session.belief.read(), self.belief)),
        };
        let buffer: &mut [u8] = bytemuck::cast_slice_mut(workspace);
        let length = model.write(buffer)?;
        Ok(buffer.get(..length).unwrap_or(&[]))
    }

    /// The number of bytes that [`save`](Self::save) would write now.
    ///
    /// # Errors
    /// [`SaveError::Unsound`] and [`SaveError::StillLearning`].
    pub fn saved_bytes(&self) -> Result<usize, SaveError> {
        self.saving()?.bytes()
    }

    /// A model file on the heap, with the bytes that [`save`](Self::save) writes.
    ///
    /// ```
    /// use goodbot::{Agent, Capacities, HeapMemory, Options, home};
    /// let memory = HeapMemory::new(&Capacities::SMALL);
    /// let agent = Agent::new(memory.agent, &home::paper_tasks()?, Options::DEFAULT)?;
    /// let file: Vec<u8> = agent.saved()?;
    /// assert_eq!(file.len(), agent.saved_bytes()?);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// [`SaveError`], as for [`save`](Self::save).
    #[cfg(feature = "alloc")]
    pub fn saved(&self) -> Result<Vec<u8>, SaveError> {
        self.saved_for(self.vocabulary())
    }

    /// As [`saved`](Self::saved), for robots of another vocabulary, by its digest: an agent without tasks takes the model of any robot, for
    /// example to leave a session out of it, and gives it back for the same robots.
    ///
    /// # Errors
    /// As [`saved`](Self::saved).
    #[cfg(feature = "alloc")]
    pub fn saved_for(&self, vocabulary: u32) -> Result<Vec<u8>, SaveError> {
        let model = Model { vocabulary, ..self.saving()? };
        let mut file = vec![0; model.bytes()?];
        let length = model.write(&mut file)?;
        file.truncate(length);
        Ok(file)
    }

    /// Replaces all that was learned here by a model file, and begins training on it: call [`learn`](Self::learn) until it is done. The
    /// whole file is checked before anything is changed. A session under way ends unlearned. If the memory has no room for the
    /// [layer](crate::language::layer), or the core was built without it, a model with the layer becomes a role model, and is saved again
    /// as one. An agent without tasks takes the model of any robot.
    ///
    /// # Errors
    /// [`RestoreError`]; the agent is then unchanged.
    pub fn restore(&mut self, bytes: &[u8]) -> Result<(), RestoreError> {
        let mut restoring = Restoring::of(bytes);
        while self.restore_on(&mut restoring, u32::MAX)? == Progress::Working {}
        Ok(())
    }

    /// Restores a model as [`restore`](Self::restore) does, also one that was learned with an earlier version of the domain: see
    /// [`Restoring::continue_vocabulary`].
    ///
    /// # Errors
    /// As [`restore`](Self::restore).
    pub fn restore_earlier<D: Domain>(&mut self, domain: &D, bytes: &[u8]) -> Result<(), RestoreError> {
        let mut restoring = Restoring::of(bytes);
        restoring.continue_vocabulary(&domain.world().schema);
        while self.restore_on(&mut restoring, u32::MAX)? == Progress::Working {}
        Ok(())
    }

    /// Restores a model in parts, otherwise as [`restore`](Self::restore) does. Each part does at most about `budget` units of work: a unit
    /// is one entry of a record, or eight bytes while the file is checked, and a part reads at least one record. The result does not depend
    /// on the budget. While the file is checked, the robot is unchanged and may do anything. After that it has learned nothing until the
    /// model is complete; its phase is [`Restoring`](crate::session::Phase::Restoring), and [`leave`](Self::leave) abandons the rest.
    ///
    /// ```
    /// use goodbot::planning::Progress;
    /// use goodbot::{Agent, Options, home, snapshot::Restoring};
    /// goodbot::memory! { struct Memory = goodbot::Capacities::TINY; }
    /// let mut memory = Memory::new();
    /// let mut agent = Agent::new(&mut memory.agent, &home::paper_tasks()?, Options::DEFAULT)?;
    /// let mut model = [0; 3_072];
    /// let length = agent.save(&mut model)?;
    /// let mut restoring = Restoring::of(&model[..length]);
    /// while agent.restore_on(&mut restoring, 16)? == Progress::Working {
    ///     // the rest of the control loop
    /// }
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// As [`restore`](Self::restore), and [`RestoreError::Interrupted`] if something else began before the model was complete: the robot
    /// then has learned nothing of it.
    pub fn restore_on(&mut self, restoring: &mut Restoring<'_>, budget: u32) -> Result<Progress, RestoreError> {
        let mut left = budget.max(1);
        while restoring.stage != Stage::Done {
            if left == 0 {
                return Ok(Progress::Working);
            }
            match restoring.stage {
                Stage::Room => self.check_strategies(restoring)?,
                Stage::Begin => self.begin_restoring(restoring)?,
                _ if restoring.is_taking() && !self.is_restoring(restoring.mark) => return Err(RestoreError::Interrupted),
                _ => {}
            }
            let AgentTables { language, workspace, .. } = self.memory.lend();
            restoring.step(&mut self.language, language, workspace, &mut left)?;
            if restoring.is_taking() {
                restoring.mark = restoring.mark.wrapping_add(1);
                self.progressed = Progressed::Restoring(restoring.mark);
            } else if restoring.stage == Stage::Done {
                self.progressed = Progressed::Idle;
                #[cfg(feature = "layer")]
                {
                    // In memory without room for the layer it is a role model.
                    self.options.language.layer = self.language().settings().layer;
                }
            }
        }
        Ok(Progress::Done)
    }

    /// Checks that this agent's vocabulary and room for strategies fit the model.
    #[inline(never)]
    fn check_strategies(&self, restoring: &Restoring<'_>) -> Result<(), RestoreError> {
        let contents = Contents::of(&restoring.checking)?;
        let (now, earlier) = restoring.continued;
        let is_earlier = earlier != 0 && contents.vocabulary == earlier && self.vocabulary() == now;
        if !(is_earlier || self.takes(contents.vocabulary)) {
            return Err(RestoreError::OtherDomain);
        }
        let limit = self.belief().most_strategies();
        Capacity::Strategies.fits(contents.strategies.len(), limit)?;
        Ok(())
    }

    /// Whether a model of this vocabulary is for this agent. One without tasks hears no command, so that it takes every model.
    pub(super) fn takes(&self, vocabulary: u32) -> bool {
        let own = self.vocabulary();
        own == 0 || vocabulary == 0 || vocabulary == own
    }

    #[inline(never)]
    fn begin_restoring(&mut self, restoring: &mut Restoring<'_>) -> Result<(), RestoreError> {
        let contents = Contents::of(&restoring.checking)?;
        self.end_session();
        let done = if contents.options.language.model == crate::language::Model::Roles { self.options.done } else { 0.0 };
        self.options = Options { done, ..contents.options };
        self.belief_mut().take_over(contents.believed());
        self.workspace_to_training();
        restoring.mark = restoring.checking.mark();
        Ok(())
    }

    /// Whether the agent is still in the midst of this restoring.
    fn is_restoring(&self, mark: u32) -> bool {
        matches!(self.progressed, Progressed::Restoring(now) if now == mark)
    }

    fn saving(&self) -> Result<Model<'_>, SaveError> {
        if self.is_between_models() {
            return Err(SaveError::StillLearning);
        }
        Ok(Model { vocabulary: self.vocabulary(), options: self.options(), language: self.language(), strategies: Some(self.belief()) })
    }
}
