//! The least capacities for a domain and a number of lessons.

use super::agent::Agent;
use super::error::AgentError;
#[cfg(feature = "alloc")]
use crate::capacity::CapacityError;
use crate::capacity::{Capacities, WORDS_PER_COMMAND};
#[cfg(feature = "alloc")]
use crate::language::for_each_piece;
use crate::language::forgetting::with_free_part;
use crate::language::roles::Layout;
use crate::memory::{AgentMemory, AgentTables};
use crate::oomdp::{Domain, SearchKind};
use crate::planning::Planner;
use crate::task::ground_unless;
#[cfg(feature = "alloc")]
use alloc::{collections::BTreeSet, string::String};

/// The lessons that a robot must be able to learn before older ones give way.
///
/// ```
/// use goodbot::session::Lessons;
/// // Twenty commands of at most eight words, with thirty different words, of 180 bytes together.
/// let lessons = Lessons { different_words: 30, word_bytes: 180, ..Lessons::new(20, 8) };
/// assert_eq!((lessons.sessions, lessons.words), (20, 8));
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Lessons {
    /// The number of sessions.
    pub sessions: usize,
    /// The most words of one command, at most [`WORDS_PER_COMMAND`].
    pub words: usize,
    /// The number of different words in all commands together.
    pub different_words: usize,
    /// Bytes that those words take together.
    pub word_bytes: usize,
}

impl Lessons {
    /// This many sessions, each with a command of at most `words` words. It assumes that no word occurs twice and that a word has 12 bytes
    /// on average. Correct the other fields if you know better: they determine most of the memory.
    pub const fn new(sessions: usize, words: usize) -> Self {
        let different_words = sessions.saturating_mul(words);
        Self { sessions, words, different_words, word_bytes: different_words.saturating_mul(12) }
    }

    /// The most words of one command that are heard.
    pub(super) fn heard_words(&self) -> usize {
        self.words.min(WORDS_PER_COMMAND)
    }

    /// Counts these commands, each of them a session of its own, as the role model hears them.
    ///
    /// ```
    /// use goodbot::session::Lessons;
    /// let lessons = Lessons::of(["go to the red room", "go to the green room"])?;
    /// assert_eq!((lessons.sessions, lessons.words, lessons.different_words, lessons.word_bytes), (2, 5, 6, 19));
    /// # Ok::<(), goodbot::capacity::CapacityError>(())
    /// ```
    ///
    /// # Errors
    /// A [`CapacityError`] if a command or one of its words is too long.
    #[cfg(feature = "alloc")]
    pub fn of<'c>(commands: impl IntoIterator<Item = &'c str>) -> Result<Self, CapacityError> {
        let (mut lessons, mut different) = (Self::new(0, 0), BTreeSet::<String>::new());
        for command in commands {
            let mut words: usize = 0;
            for_each_piece(command, |word| {
                words = words.saturating_add(1);
                different.insert(word.into());
                Ok(())
            })?;
            lessons.words = lessons.words.max(words);
            lessons.sessions = lessons.sessions.saturating_add(1);
        }
        (lessons.different_words, lessons.word_bytes) = (different.len(), different.iter().map(String::len).sum());
        Ok(lessons)
    }
}

/// The needs of the worlds surveyed so far.
pub(super) struct Survey {
    pub(super) least: Capacities,
    /// The parts of the descriptions that size the parameters.
    pub(super) layout: Layout,
}

impl<M: AgentMemory> Agent<M> {
    /// Returns the least capacities with which this robot, with its tasks, options and strategies, refuses no session from any state of the
    /// domain, and no session gives way.
    ///
    /// Uses the agent's tables as scratch space, so call it on a host, in roomy memory. A session under way ends unlearned. [`Lessons::of`]
    /// counts the commands. The result suffices for all sessions of that many words: if few tasks are likely, much of `pairs`, `commands`
    /// and `command_tokens` stays free, as [`most_used`](Self::most_used) shows.
    ///
    /// - With `states`, every plan is exact. A [`PushGrid`](crate::oomdp::PushGrid) works with fewer: its plans are then approximate if the
    ///   goal is far.
    /// - `hashed_states` and `goal_entries` are 0: no robot needs them. The goal entries save time: see
    ///   [`Capacities::goal_entries`].
    /// - For several worlds of one kind, call [`least_capacities_of_all`](Self::least_capacities_of_all). For several kinds, the robot
    ///   needs at most the sum of their capacities ([`Capacities::plus`]), and at least the largest of each ([`Capacities::at_least`]).
    ///
    /// ```
    /// use goodbot::{Agent, Capacities, HeapMemory, Options, home, session::Lessons};
    /// # use goodbot::home::{Area, Cell, HomeBuilder, Moves};
    /// # fn build(memory: &mut goodbot::memory::HomeHeap)
    /// #     -> Result<(home::Home<&mut goodbot::memory::HomeHeap>, home::HomeState), home::HomeError> {
    /// #     let mut builder = HomeBuilder::new(memory);
    /// #     builder.room("room0", Area::new(0, 0, 8, 4), "red")?;
    /// #     builder.agent("agent0", Cell::new(4, 2))?;
    /// #     builder.build(Moves::Push)
    /// # }
    /// let mut roomy = HeapMemory::new(&Capacities::STANDARD);
    /// let (home, _) = build(&mut roomy.home)?;
    /// let mut agent = Agent::new(&mut roomy.agent, &home::paper_tasks()?, Options::PAPER)?;
    /// let least = agent.least_capacities(&home, &Lessons::new(8, 7))?;
    /// assert_eq!((least.objects, least.cells, least.sessions), (2, 21, 8));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// [`AgentError::Capacity`] if the agent's own memory is too small for one session, or if the states cannot be counted: such a domain
    /// is searched with `hashed_states`, as many as you like.
    pub fn least_capacities<D: Domain>(&mut self, domain: &D, lessons: &Lessons) -> Result<Capacities, AgentError> {
        self.least_capacities_of_all(core::iter::once(domain), lessons)
    }

    /// Returns the least capacities with which this robot refuses no session and no session gives way, in any of these worlds. See
    /// [`least_capacities`](Self::least_capacities).
    ///
    /// ```
    /// use goodbot::home::{Area, Cell, HomeBuilder, Moves};
    /// use goodbot::{Agent, Capacities, HeapMemory, Options, home, session::Lessons};
    /// let mut homes = vec![];
    /// for color in ["red", "blue"] {
    ///     let mut builder = HomeBuilder::new(HeapMemory::new(&Capacities::STANDARD).home);
    ///     builder.room("room0", Area::new(0, 0, 8, 4), color)?;
    ///     builder.agent("agent0", Cell::new(4, 2))?;
    ///     homes.push(builder.build(Moves::Push)?.0);
    /// }
    /// let roomy = HeapMemory::new(&Capacities::STANDARD);
    /// let mut agent = Agent::new(roomy.agent, &home::paper_tasks()?, Options::DEFAULT)?;
    /// let (one, both) = (&homes[..1], &homes[..]);
    /// let mut tokens = |homes: &[_]| {
    ///     let least = agent.least_capacities_of_all(homes, &Lessons::new(8, 7));
    ///     least.map(|least| least.tokens)
    /// };
    /// // The second home has one colour that the first has not.
    /// assert_eq!(tokens(both)?, tokens(one)? + 1);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// As [`least_capacities`](Self::least_capacities).
    pub fn least_capacities_of_all<'d, D: Domain + 'd>(
        &mut self,
        worlds: impl IntoIterator<Item = &'d D>,
        lessons: &Lessons,
    ) -> Result<Capacities, AgentError> {
        self.end_session();
        self.language_mut().forget_unlearned();
        let learned = self.language().usage_of_tokens();
        let mut survey = Survey { least: Capacities::NONE, layout: Layout::NONE };
        let result = worlds.into_iter().try_for_each(|domain| self.sum_up(domain, lessons, learned, &mut survey));
        self.end_session();
        self.language_mut().forget_unlearned();
        result.map(|()| survey.least)
    }

    fn sum_up<D: Domain>(
        &mut self,
        domain: &D,
        lessons: &Lessons,
        (known, known_bytes): (usize, usize),
        survey: &mut Survey,
    ) -> Result<(), AgentError> {
        let AgentTables { mut session, .. } = self.memory.lend();
        let tasks = ground_unless(domain.world().objects, &self.lifted, session.tasks, |_, _| false)?;
        let grounded = session.tasks.get(..tasks).unwrap_or(&[]);
        let (ground_propositions, states) = Planner::needs(&mut session.goals, domain, &self.lifted, grounded)?;
        self.task_count = tasks;
        let commands = self.most_machine_commands(domain, lessons, known, survey)?;
        let (tokens, token_bytes) = self.language().usage_of_tokens();
        let (tokens, token_bytes) = (tokens.saturating_sub(known), token_bytes.saturating_sub(known_bytes));
        let strategies = self.belief().strategies().len();
        let before = survey.least;
        let mut least = Capacities {
            cells: D::Search::grid(domain).map_or(0, cells),
            tasks,
            strategies,
            beliefs: tasks.saturating_mul(strategies),
            ground_propositions,
            states,
            words: with_free_part(lessons.different_words),
            word_bytes: with_free_part(lessons.word_bytes),
            tokens: with_free_part(tokens),
            token_bytes: with_free_part(token_bytes),
            sessions: lessons.sessions,
            sentence_words: lessons.sessions.saturating_mul(lessons.heard_words()),
            pairs: lessons.sessions.saturating_mul(commands.candidates),
            translations: tokens.saturating_add(1).saturating_mul(lessons.different_words),
            ..commands
        };
        domain.world().objects.usage(&mut least);
        survey.least = before.at_least(least);
        Ok(())
    }
}

fn cells<G: crate::oomdp::PushGrid>(grid: &G) -> usize {
    grid.floor().cells.len()
}
