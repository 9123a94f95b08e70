//! The one list of capacities. The struct, the presets, the enum and every comparison are made from it.

use super::error::CapacityError;
use crate::task::TaskSet;
use core::fmt;
use core::str::FromStr;

/// Passes every capacity to another macro: its documentation, the field's name, the name of its [`Capacity`], and its value in the presets
/// `TINY`, `SMALL` and `STANDARD`.
#[doc(hidden)]
#[macro_export]
macro_rules! for_each_capacity {
    ($($then:ident)::+!($($head:tt)*)) => {
        $($then)::+! {
            $($head)*
            /// Objects of one environment: agent, rooms, doors and blocks together. At most 255; a home has at most 32, and 96 with the
            /// feature `alloc`.
            objects: Objects = 11, 12, 32;
            /// Distinct names and attribute values of one environment.
            names: Names = 18, 24, 96;
            /// Bytes of the names and attribute values of one environment together.
            name_bytes: NameBytesTogether = 96, 160, 1_024;
            /// Cells of a home that are not wall.
            cells: Cells = 41, 64, 1_024;
            /// Grounded tasks of one session. At most [`TaskSet::MOST`](crate::task::TaskSet::MOST): 64, and 256 with the feature `alloc`.
            tasks: Tasks = 10, 12, 64;
            /// Trainer strategies distinguished at once.
            strategies: Strategies = 1, 3, 16;
            /// Joint beliefs: tasks times strategies.
            beliefs: Beliefs = 10, 36, 1_024;
            /// Distinct machine commands that one session's tasks and constraints can express.
            candidates: Candidates = 36, 48, 1_024;
            /// Machine tokens of all candidates together.
            candidate_tokens: CandidateTokens = 240, 320, 16_384;
            /// Distinct ground propositions in one session's tasks.
            ground_propositions: GroundPropositions = 10, 12, 64;
            /// Entries of the table that finds the tasks satisfied by a state: cells times movable pieces, the robot included.
            goal_entries: GoalEntries = 0, 192, 8_192;
            /// States of one search that expands them one by one, if actions cost 1 each and there are at most 8: see
            /// [`Capacities::search_words`](crate::Capacities::search_words), and [`states_needed`](crate::planning::states_needed) for
            /// other robots. Rows of states take less.
            states: States = 1_472, 2_560, 1_048_576;
            /// Visited states of one hashed search, if the state space is larger than `states`. It bounds how far away goals are found
            /// exactly, and the time of a plan. With 0, a home is searched nearby in the memory of `states`, and a robot without a floor of
            /// cells is refused.
            hashed_states: HashedStates = 0, 0, 32_768;
            /// Distinct English words. At most 65,534.
            words: Words = 14, 32, 1_024;
            /// Bytes of those words together.
            word_bytes: WordBytes = 60, 192, 10_240;
            /// Distinct machine tokens. At most 65,534.
            tokens: Tokens = 18, 28, 256;
            /// Bytes of those tokens together.
            token_bytes: TokenBytes = 190, 320, 4_096;
            /// Distinct machine commands in the training data.
            commands: Commands = 56, 64, 2_048;
            /// Machine tokens of those commands together.
            command_tokens: CommandTokens = 380, 448, 24_576;
            /// Sessions learned from.
            sessions: Sessions = 8, 16, 512;
            /// English words of those sessions' commands together.
            sentence_words: SentenceWords = 56, 160, 16_384;
            /// Weighted pairs of an English command and a machine command in the training data.
            pairs: Pairs = 112, 128, 32_768;
            /// Cells of the translation table: (machine tokens + 1) times English words.
            translations: Translations = 266, 640, 263_168;
            /// Cells of all alignment tables together: (l + 1) times n for each pair of lengths. The role model stores all parameters there
            /// except the rows of words: see [`layout`](crate::language::roles::layout).
            alignments: Alignments = 448, 640, 262_144;
            /// Distinct pairs of a machine command's and an English command's length.
            length_pairs: LengthPairs = 8, 16, 1_024;
        }
    };
}

macro_rules! capacities {
    ($($(#[doc = $doc:literal])* $field:ident: $Variant:ident = $tiny:literal, $small:literal, $standard:literal;)*) => {
        /// The size of each table. The unit of every field is entries of that table, unless the field says bytes.
        #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
        pub struct Capacities {
            $($(#[doc = $doc])* pub $field: usize,)*
        }

        impl Capacities {
            /// For the smallest controllers, in little more than 16 KiB of RAM for everything: homes of up to 41 cells with a movable
            /// block, one trainer strategy, and the paper's whole course.
            pub const TINY: Self = Self { $($field: $tiny,)* };

            /// For controllers: homes of one 41-cell floor with a movable block, and the paper's whole course.
            pub const SMALL: Self = Self { $($field: $small,)* };

            /// For hosts and browsers: about seven megabytes, most of them for a million search states. With the feature `alloc` there is
            /// room for larger homes and more tasks.
            pub const STANDARD: Self = Self { $($field: $standard,)* }.for_large_homes();

            /// No room at all: a base for capacities with only some tables.
            pub const NONE: Self = Self { $($field: 0,)* };

            /// Tables of the sizes that `entries` gives.
            pub fn of(entries: impl Fn(Capacity) -> usize) -> Self {
                Self { $($field: entries(Capacity::$Variant),)* }
            }

            /// The size of one table; 0 for a capacity that is a constant.
            pub const fn get(&self, capacity: Capacity) -> usize {
                match capacity {
                    $(Capacity::$Variant => self.$field,)*
                    _ => 0,
                }
            }

            /// Sets the size of one table; does nothing for a capacity that is a constant.
            pub const fn set(&mut self, capacity: Capacity, entries: usize) {
                match capacity {
                    $(Capacity::$Variant => self.$field = entries,)*
                    _ => {}
                }
            }
        }

        /// A capacity that was exceeded: a field of [`Capacities`], or a constant of [`capacity`](crate::capacity).
        #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
        #[non_exhaustive]
        #[repr(u8)]
        pub enum Capacity {
            $($(#[doc = $doc])* $Variant,)*
            /// Words of one English command.
            WordsPerCommand,
            /// Machine tokens of one machine command.
            TokensPerCommand,
            /// Bytes of one word, name or machine token.
            NameBytes,
            /// Arguments of one propositional function.
            Arguments,
            /// Attributes that a domain's objects can carry.
            Attributes,
            /// Propositions of one task's conjunction.
            PropositionsPerTask,
            /// Variables of one lifted task.
            VariablesPerTask,
            /// Attribute propositions of the objects bound by one task, together.
            FactsPerTask,
            /// Lifted tasks of one session.
            LiftedTasks,
            /// Movable blocks of one home.
            Blocks,
        }

        impl Capacity {
            /// The fields of [`Capacities`], in order: the number of each is its position here.
            pub const ALL: [Self; [$(stringify!($field)),*].len()] = [$(Self::$Variant,)*];

            /// The field of [`Capacities`], or the constant, to raise.
            pub const fn field(self) -> &'static str {
                match self {
                    $(Self::$Variant => concat!("Capacities::", stringify!($field)),)*
                    Self::WordsPerCommand => "capacity::WORDS_PER_COMMAND",
                    Self::TokensPerCommand => "capacity::TOKENS_PER_COMMAND",
                    Self::NameBytes => "capacity::NAME_BYTES",
                    Self::Arguments => "capacity::ARGUMENTS",
                    Self::Attributes => "capacity::ATTRIBUTES",
                    Self::PropositionsPerTask => "capacity::PROPOSITIONS_PER_TASK",
                    Self::VariablesPerTask => "capacity::VARIABLES_PER_TASK",
                    Self::FactsPerTask => "capacity::FACTS_PER_TASK",
                    Self::LiftedTasks => "capacity::LIFTED_TASKS",
                    Self::Blocks => "capacity::BLOCKS",
                }
            }
        }
    };
}

for_each_capacity! { capacities!() }

impl Capacities {
    /// The same, with room for the homes and tasks of hosts.
    const fn for_large_homes(self) -> Self {
        if cfg!(feature = "alloc") {
            let tasks = TaskSet::MOST;
            Self {
                objects: 96,
                names: 288,
                name_bytes: 4_096,
                tasks,
                beliefs: 16 * tasks,
                candidates: 16 * tasks,
                candidate_tokens: 256 * tasks,
                ground_propositions: tasks,
                ..self
            }
        } else {
            self
        }
    }

    /// For a robot of your own on a controller, in the memory of `SMALL` and 4 KiB more: 16 tasks of four kinds, 5,888 states, and 24
    /// lessons of 44 different words. It has no cells, so it cannot hold a home.
    pub const OWN: Self = Self {
        objects: 16,
        names: 32,
        name_bytes: 224,
        cells: 0,
        tasks: 16,
        beliefs: 48,
        candidates: 16,
        candidate_tokens: 448,
        ground_propositions: 16,
        goal_entries: 0,
        // The states that fit into the words of the translations and alignments, which share the workspace.
        states: 5_888,
        words: 44,
        word_bytes: 280,
        command_tokens: 896,
        sessions: 24,
        pairs: 192,
        translations: 880,
        alignments: 1_168,
        length_pairs: 0,
        ..Self::SMALL
    };

    /// The larger capacity of each table.
    #[must_use]
    pub const fn at_least(self, other: Self) -> Self {
        self.each(other, true)
    }

    /// The smaller capacity of each table.
    #[must_use]
    pub(crate) const fn at_most(self, other: Self) -> Self {
        self.each(other, false)
    }

    /// The sum of the capacities of each table.
    #[must_use]
    pub const fn plus(mut self, other: Self) -> Self {
        let mut rest: &[Capacity] = &Capacity::ALL;
        while let [capacity, after @ ..] = rest {
            self.set(*capacity, self.get(*capacity).saturating_add(other.get(*capacity)));
            rest = after;
        }
        self
    }

    const fn each(mut self, other: Self, larger: bool) -> Self {
        let mut rest: &[Capacity] = &Capacity::ALL;
        while let [capacity, after @ ..] = rest {
            if (other.get(*capacity) > self.get(*capacity)) == larger {
                self.set(*capacity, other.get(*capacity));
            }
            rest = after;
        }
        self
    }

    /// Checks that tables as full as `self` fit into tables of the sizes `rooms`.
    ///
    /// ```
    /// use goodbot::{Capacities, capacity::Capacity};
    /// let needs = Capacities { words: 40, ..Capacities::NONE };
    /// let error = needs.fits_in(&Capacities::SMALL).unwrap_err();
    /// assert_eq!((error.capacity, error.limit, error.given), (Capacity::Words, 32, 40));
    /// ```
    ///
    /// # Errors
    /// A [`CapacityError`] for the first table that is too small.
    pub fn fits_in(&self, rooms: &Self) -> Result<(), CapacityError> {
        Capacity::ALL.iter().try_for_each(|&capacity| {
            let (limit, given) = (rooms.get(capacity), self.get(capacity));
            capacity.fits(given, limit)
        })
    }

    /// The same without the tables of training data, for a robot that only obeys.
    #[must_use]
    pub const fn obeying(self) -> Self {
        Self { commands: 0, command_tokens: 0, sessions: 0, sentence_words: 0, pairs: 0, length_pairs: 0, ..self }
    }

    /// u64s of the search: for each 64 states eight words of first actions and three of bit sets, with one more bit for each of the latter.
    pub const fn search_words(&self) -> usize {
        Self::words_of(self.states.div_ceil(64))
    }

    /// The least number of states that needs this many words: the inverse of [`search_words`](Self::search_words).
    pub(crate) const fn states_of(search_words: usize) -> usize {
        // At most 707 words for 64 groups, and 3 more.
        let mut groups = (search_words.saturating_sub(3) / 707).saturating_mul(64);
        while Self::words_of(groups) < search_words {
            groups = groups.saturating_add(1);
        }
        groups.saturating_mul(64)
    }

    const fn words_of(groups: usize) -> usize {
        groups.saturating_mul(11).saturating_add(groups.div_ceil(64).saturating_mul(3))
    }

    /// The length of tables that memory has only on request.
    #[doc(hidden)]
    pub const fn none(&self) -> usize {
        0
    }

    /// u64s that planning and training share: the larger of the search's words and the expected counts of all table cells, two to a word.
    pub const fn workspace_words(&self) -> usize {
        let (search, counts) = (self.search_words(), self.translations.saturating_add(self.alignments).div_ceil(2));
        if search > counts || !cfg!(feature = "learning") { search } else { counts }
    }
}

impl Capacity {
    /// Refuses more entries than a limit.
    #[inline(always)]
    pub(crate) const fn fits(self, given: usize, limit: usize) -> Result<(), CapacityError> {
        if given > limit { Err(CapacityError::new(self, limit, given)) } else { Ok(()) }
    }

    /// The name of the field or constant, without its path.
    ///
    /// ```
    /// use goodbot::capacity::Capacity;
    /// assert_eq!(Capacity::NameBytesTogether.name(), "name_bytes");
    /// assert_eq!("name_bytes".parse(), Ok(Capacity::NameBytesTogether));
    /// ```
    pub const fn name(self) -> &'static str {
        let mut path = self.field().as_bytes();
        let mut name = self.field();
        while let [byte, rest @ ..] = path {
            if *byte == b':' {
                // The cut is after an ASCII character.
                name = match core::str::from_utf8(rest) {
                    Ok(rest) => rest,
                    Err(_) => name,
                };
            }
            path = rest;
        }
        name
    }
}

impl fmt::Display for Capacity {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

/// There is no capacity of this name.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error("there is no capacity of this name; the fields of Capacities are the names")]
pub struct UnknownCapacity;

impl FromStr for Capacity {
    type Err = UnknownCapacity;

    fn from_str(name: &str) -> Result<Self, UnknownCapacity> {
        Self::ALL.into_iter().find(|capacity| capacity.name() == name).ok_or(UnknownCapacity)
    }
}
