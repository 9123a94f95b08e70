//! Every capacity, in one place.
//!
//! The core allocates nothing: each table lives in memory that the caller owns, and a [`Capacities`] says how large each one is. Two
//! presets stand ready, [`Capacities::SMALL`] for controllers and [`Capacities::STANDARD`] for hosts and browsers. A controller that
//! needs something else replaces what it needs:
//!
//! ```
//! use goodbot::Capacities;
//! goodbot::memory! {
//!     /// Room for a robot that hears many different words.
//!     struct WordyMemory = Capacities { words: 96, word_bytes: 640, translations: 4_000, ..Capacities::SMALL };
//! }
//! assert_eq!(WordyMemory::new().split().agent.language.word_ends.len(), 96);
//! ```
//!
//! A table that is full is reported by a [`CapacityError`], which names the field to raise.

use core::fmt;

/// How large each table is. The unit of every field is entries of that table, unless the field says bytes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Capacities {
    /// Objects of one environment: agent, rooms, doors and blocks together. At most 255; a home takes 32.
    pub objects: usize,
    /// Distinct names and attribute values of one environment.
    pub names: usize,
    /// Bytes that the names and attribute values of one environment take together.
    pub name_bytes: usize,
    /// Cells of a home that are not wall.
    pub cells: usize,
    /// Grounded tasks of one session. At most 64, one bit each in a [`TaskSet`](crate::task::TaskSet).
    pub tasks: usize,
    /// Trainer strategies told apart at once. At most 8.
    pub strategies: usize,
    /// Joint beliefs: tasks times strategies.
    pub beliefs: usize,
    /// Distinct machine commands that one session's tasks and constraints can express.
    pub candidates: usize,
    /// Machine tokens of all candidates together.
    pub candidate_tokens: usize,
    /// Distinct ground propositions that one session's tasks are made of.
    pub ground_propositions: usize,
    /// Entries of the table that finds the tasks satisfied by a state: cells times movable pieces, the robot included.
    pub goal_entries: usize,
    /// States that one search can hold that expands them one by one, where actions cost 1 each and are at most 8: see
    /// [`search_words`](Self::search_words), and [`states_needed`](crate::planning::states_needed) for other robots. Rows of states take less.
    pub states: usize,
    /// States that one search can hold where the state space is larger than `states` and visited states are hashed: it bounds how far away
    /// goals are found exactly there, and the time of a plan. With 0, a home is searched nearby in the memory of `states`, and a robot
    /// without a floor of cells is refused.
    pub hashed_states: usize,
    /// Distinct English words. At most 65,534.
    pub words: usize,
    /// Bytes that those words take together.
    pub word_bytes: usize,
    /// Distinct machine tokens. At most 65,534.
    pub tokens: usize,
    /// Bytes that those tokens take together.
    pub token_bytes: usize,
    /// Distinct machine commands in the training data.
    pub commands: usize,
    /// Machine tokens of those commands together.
    pub command_tokens: usize,
    /// Sessions learned from.
    pub sessions: usize,
    /// English words of those sessions' commands together.
    pub sentence_words: usize,
    /// Weighted pairs of an English command and a machine command in the training data.
    pub pairs: usize,
    /// Cells of the translation table: (machine tokens + 1) times English words.
    pub translations: usize,
    /// Cells of all alignment tables together: (l + 1) times n for each pair of lengths.
    pub alignments: usize,
    /// Distinct pairs of a machine command's and an English command's length.
    pub length_pairs: usize,
}

impl Capacities {
    /// For controllers: homes of one 41-cell floor with a block that moves, and the paper's whole course.
    pub const SMALL: Self = Self {
        objects: 12,
        names: 24,
        name_bytes: 160,
        cells: 64,
        tasks: 12,
        strategies: 3,
        beliefs: 36,
        candidates: 48,
        candidate_tokens: 320,
        ground_propositions: 12,
        goal_entries: 192,
        states: 2_560,
        hashed_states: 0,
        words: 32,
        word_bytes: 192,
        tokens: 28,
        token_bytes: 320,
        commands: 64,
        command_tokens: 448,
        sessions: 16,
        sentence_words: 160,
        pairs: 128,
        translations: 640,
        alignments: 512,
        length_pairs: 16,
    };

    /// For the smallest controllers, in little more than 16 KiB of RAM with everything else: homes of up to 41 cells with a block that moves, one trainer
    /// strategy, and the paper's whole course.
    pub const TINY: Self = Self {
        objects: 11,
        names: 18,
        name_bytes: 96,
        cells: 41,
        tasks: 10,
        strategies: 1,
        beliefs: 10,
        candidates: 36,
        candidate_tokens: 240,
        ground_propositions: 10,
        goal_entries: 0,
        states: 1_472,
        hashed_states: 0,
        words: 14,
        word_bytes: 60,
        tokens: 18,
        token_bytes: 190,
        commands: 56,
        command_tokens: 380,
        sessions: 8,
        sentence_words: 56,
        pairs: 112,
        translations: 266,
        alignments: 340,
        length_pairs: 8,
    };

    /// u64s of the search: for each 64 states eight words of first actions, and three bit sets with a bit for each of their words.
    pub const fn search_words(&self) -> usize {
        let groups = self.states.div_ceil(64);
        groups.saturating_mul(11).saturating_add(groups.div_ceil(64).saturating_mul(3))
    }

    /// u64s that planning and training have in turn: as many as the search takes, or the expected counts of all table cells, two to each.
    pub const fn workspace_words(&self) -> usize {
        let (search, counts) = (self.search_words(), self.translations.saturating_add(self.alignments).div_ceil(2));
        if search > counts { search } else { counts }
    }

    /// For hosts and browsers: about seven megabytes, most of them for a million search states.
    pub const STANDARD: Self = Self {
        objects: 32,
        names: 96,
        name_bytes: 1_024,
        cells: 1_024,
        tasks: 64,
        strategies: 4,
        beliefs: 256,
        candidates: 1_024,
        candidate_tokens: 16_384,
        ground_propositions: 64,
        goal_entries: 8_192,
        states: 1 << 20,
        hashed_states: 1 << 15,
        words: 1_024,
        word_bytes: 10_240,
        tokens: 256,
        token_bytes: 4_096,
        commands: 2_048,
        command_tokens: 24_576,
        sessions: 512,
        sentence_words: 16_384,
        pairs: 32_768,
        translations: 263_168,
        alignments: 262_144,
        length_pairs: 1_024,
    };
}

/// Words of one English command; more are refused with [`Capacity::WordsPerCommand`].
pub const WORDS_PER_COMMAND: usize = 64;
/// Machine tokens of one machine command.
pub const TOKENS_PER_COMMAND: usize = 32;
/// Bytes of one word, name or machine token.
pub const NAME_BYTES: usize = 48;
/// Arguments of one propositional function.
pub const ARGUMENTS: usize = 3;
/// Attributes that a domain's objects can carry.
pub const ATTRIBUTES: usize = 4;
/// Propositions of one task's conjunction.
pub const PROPOSITIONS_PER_TASK: usize = 4;
/// Variables of one lifted task.
pub const VARIABLES_PER_TASK: usize = 6;
/// Attribute propositions that the objects bound by one task have together.
pub const FACTS_PER_TASK: usize = 8;
/// Lifted tasks of one session.
pub const LIFTED_TASKS: usize = 8;
/// Blocks that can be moved about in one home.
pub const BLOCKS: usize = 8;

/// What was full. Most variants are fields of [`Capacities`], the rest constants of [`capacity`](crate::capacity).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
#[expect(missing_docs, reason = "each variant is the field or constant of the same name")]
pub enum Capacity {
    Objects,
    Names,
    NameBytesTogether,
    Cells,
    Tasks,
    Strategies,
    Beliefs,
    Candidates,
    CandidateTokens,
    States,
    Words,
    WordBytes,
    Tokens,
    TokenBytes,
    Commands,
    CommandTokens,
    Sessions,
    SentenceWords,
    Pairs,
    Translations,
    Alignments,
    LengthPairs,
    WordsPerCommand,
    TokensPerCommand,
    NameBytes,
    Arguments,
    Attributes,
    PropositionsPerTask,
    VariablesPerTask,
    FactsPerTask,
    GroundPropositions,
    LiftedTasks,
    Blocks,
}

impl Capacity {
    /// The field of [`Capacities`], or the constant, to raise.
    pub const fn field(self) -> &'static str {
        match self {
            Self::Objects => "Capacities::objects",
            Self::Names => "Capacities::names",
            Self::NameBytesTogether => "Capacities::name_bytes",
            Self::Cells => "Capacities::cells",
            Self::Tasks => "Capacities::tasks",
            Self::Strategies => "Capacities::strategies",
            Self::Beliefs => "Capacities::beliefs",
            Self::Candidates => "Capacities::candidates",
            Self::CandidateTokens => "Capacities::candidate_tokens",
            Self::States => "Capacities::states",
            Self::Words => "Capacities::words",
            Self::WordBytes => "Capacities::word_bytes",
            Self::Tokens => "Capacities::tokens",
            Self::TokenBytes => "Capacities::token_bytes",
            Self::Commands => "Capacities::commands",
            Self::CommandTokens => "Capacities::command_tokens",
            Self::Sessions => "Capacities::sessions",
            Self::SentenceWords => "Capacities::sentence_words",
            Self::Pairs => "Capacities::pairs",
            Self::Translations => "Capacities::translations",
            Self::Alignments => "Capacities::alignments",
            Self::LengthPairs => "Capacities::length_pairs",
            Self::WordsPerCommand => "capacity::WORDS_PER_COMMAND",
            Self::TokensPerCommand => "capacity::TOKENS_PER_COMMAND",
            Self::NameBytes => "capacity::NAME_BYTES",
            Self::Arguments => "capacity::ARGUMENTS",
            Self::Attributes => "capacity::ATTRIBUTES",
            Self::PropositionsPerTask => "capacity::PROPOSITIONS_PER_TASK",
            Self::VariablesPerTask => "capacity::VARIABLES_PER_TASK",
            Self::FactsPerTask => "capacity::FACTS_PER_TASK",
            Self::GroundPropositions => "Capacities::ground_propositions",
            Self::LiftedTasks => "capacity::LIFTED_TASKS",
            Self::Blocks => "capacity::BLOCKS",
        }
    }
}

/// A table was full: which one, how much it holds, and how much was asked of it (at least).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct CapacityError {
    /// What was full.
    pub capacity: Capacity,
    /// How much it holds.
    pub limit: u32,
    /// How much was asked of it. Where the total was not counted to its end, the first number beyond the limit.
    pub given: u32,
}

impl CapacityError {
    /// The error for a table of `limit` entries that was asked for `given`.
    pub const fn new(capacity: Capacity, limit: usize, given: usize) -> Self {
        Self { capacity, limit: clamp(limit), given: clamp(given) }
    }

    /// The error for the next entry after `limit`.
    pub const fn full(capacity: Capacity, limit: usize) -> Self {
        Self::new(capacity, limit, limit.saturating_add(1))
    }
}

const fn clamp(count: usize) -> u32 {
    if count > u32::MAX as usize { u32::MAX } else { count as u32 }
}

impl fmt::Display for CapacityError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "no room: {} is {}, and {} or more were given; raise it", self.capacity.field(), self.limit, self.given)
    }
}

impl core::error::Error for CapacityError {}
