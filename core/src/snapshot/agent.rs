//! Saving and restoring the whole robot's mind.

use super::contents::Contents;
use super::error::{RestoreError, SaveError};
use super::writing::Writing;
use crate::capacity::{Capacity, CapacityError};
use crate::feedback::BeliefRef;
use crate::memory::{AgentMemory, AgentTables};
use crate::session::Agent;
#[cfg(feature = "alloc")]
use alloc::{vec, vec::Vec};

impl<M: AgentMemory> Agent<M> {
    /// Saves all that was learned to the front of the buffer: the training data, the options, and the trainer strategies with what is
    /// believed of them now. Gives the length. A session under way is not saved; a training under way begins anew when restored. While a session
    /// joins the training data in parts ([`finish_on`](Self::finish_on)) there may be nothing whole to save: finish it first.
    ///
    /// # Errors
    /// [`SaveError`]; the buffer may then hold anything.
    pub fn save(&self, buffer: &mut [u8]) -> Result<usize, SaveError> {
        self.writing()?.write(buffer)
    }

    /// Saves as [`save`](Self::save) does, into the memory that planning and training have in turn, so that no buffer is needed: what was
    /// planned is forgotten. That memory has 8 bytes for each of [`workspace_words`](crate::Capacities::workspace_words).
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
    /// [`SaveError`]: where the model takes more than that memory has, and [`SaveError::StillLearning`] while training needs it.
    pub fn save_in_place(&mut self) -> Result<&[u8], SaveError> {
        if self.language().is_training() || self.is_tidying() {
            return Err(SaveError::StillLearning);
        }
        self.workspace_to_training();
        let sizes = self.language().sizes(self.belief().most_strategies());
        let (vocabulary, options) = (self.vocabulary(), self.options);
        let AgentTables { language, session, workspace } = self.memory.lend();
        let writing = Writing {
            vocabulary,
            options,
            language: self.language.read(language.read(), workspace.len()),
            strategies: Some(BeliefRef::new(session.belief.read(), self.belief)),
            sizes,
        };
        let buffer: &mut [u8] = bytemuck::cast_slice_mut(workspace);
        let length = writing.write(buffer)?;
        Ok(buffer.get(..length).unwrap_or(&[]))
    }

    /// Bytes that [`save`](Self::save) would write now.
    ///
    /// # Errors
    /// [`SaveError::Unsound`] and [`SaveError::StillLearning`].
    pub fn saved_bytes(&self) -> Result<usize, SaveError> {
        self.writing()?.bytes()
    }

    /// A model file on the heap, with what [`save`](Self::save) writes.
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
        let mut file = vec![0; self.saved_bytes()?];
        let length = self.save(&mut file)?;
        file.truncate(length);
        Ok(file)
    }

    /// Replaces everything learned here by a model file, and begins training on it: call
    /// [`learn`](Self::learn) until it is done. Everything is checked before anything is changed. A session under way ends unlearned.
    /// A model with the [layer](crate::language::layer) is a role model in memory without room for it, and with a core without the layer:
    /// saved again, it is one.
    ///
    /// # Errors
    /// [`RestoreError`]; the agent is then as before.
    pub fn restore(&mut self, bytes: &[u8]) -> Result<(), RestoreError> {
        let contents = Contents::read(bytes)?;
        if contents.vocabulary != 0 && contents.vocabulary != self.vocabulary() {
            return Err(RestoreError::OtherDomain);
        }
        let limit = self.belief().most_strategies();
        if contents.strategies.len() > limit {
            return Err(CapacityError::new(Capacity::Strategies, limit, contents.strategies.len()).into());
        }
        self.language().check_room(&contents)?;
        self.end_session();
        self.options = contents.options;
        self.belief_mut().take_over(contents.believed());
        self.workspace_to_training();
        self.language_mut().take_over(&contents);
        #[cfg(feature = "layer")]
        {
            // Memory without room for the layer makes it a role model.
            self.options.language.layer = self.language().settings().layer;
        }
        Ok(())
    }

    /// The digest of the vocabulary that the lifted tasks are written in; 0 for an agent without tasks.
    pub fn vocabulary(&self) -> u32 {
        self.lifted().first().map_or(0, |task| task.vocabulary())
    }

    fn writing(&self) -> Result<Writing<'_>, SaveError> {
        if self.is_tidying() {
            return Err(SaveError::StillLearning);
        }
        let sizes = self.language().sizes(self.belief().most_strategies());
        Ok(Writing {
            vocabulary: self.vocabulary(),
            options: *self.options(),
            language: self.language(),
            strategies: Some(self.belief()),
            sizes,
        })
    }
}
