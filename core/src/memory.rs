//! Memory that the caller owns, shaped by [`Capacities`](crate::Capacities).
//!
//! [`memory!`](crate::memory!) makes a struct of plain arrays, which a controller puts into a static; with the `std` feature,
//! `HeapMemory` takes the same capacities at run time. Both give a [`Memory`], which lends each part of the library its share.

use crate::home::HomeMemory;
use crate::session::AgentMemory;

/// The memory of one home and one agent.
#[derive(Debug)]
pub struct Memory<'m> {
    /// For a [`HomeBuilder`](crate::home::HomeBuilder).
    pub home: HomeMemory<'m>,
    /// For an [`Agent`](crate::Agent).
    pub agent: AgentMemory<'m>,
}

/// Hands each table's name, field, element type, empty element and length to another macro: the one list of all tables.
#[doc(hidden)]
#[macro_export]
macro_rules! for_each_table {
    ($($then:ident)::+!($($head:tt)*)) => {
        $($then)::+! {
            $($head)*
            objects: $crate::oomdp::Object = $crate::oomdp::Object::UNUSED; objects,
            name_bytes: u8 = 0; name_bytes,
            name_ends: u16 = 0; names,
            areas: $crate::home::layout::StoredArea = $crate::home::layout::StoredArea::UNUSED; objects,
            places: $crate::home::Place = $crate::home::Place::UNUSED; cells,
            word_bytes: u8 = 0; word_bytes,
            word_ends: u16 = 0; words,
            token_bytes: u8 = 0; token_bytes,
            token_ends: u16 = 0; tokens,
            commands: $crate::language::bitext::Span = $crate::language::bitext::Span::UNUSED; commands,
            command_tokens: $crate::symbols::Symbol = $crate::symbols::Symbol(0); command_tokens,
            sessions: $crate::language::bitext::Span = $crate::language::bitext::Span::UNUSED; sessions,
            sentence_words: $crate::symbols::Symbol = $crate::symbols::Symbol(0); sentence_words,
            pairs: $crate::language::bitext::Pair = $crate::language::bitext::Pair::UNUSED; pairs,
            translations: f32 = 0.0; translations,
            alignments: f32 = 0.0; alignments,
            length_pairs: $crate::language::tables::LengthPair = $crate::language::tables::LengthPair::UNUSED; length_pairs,
            grounded: $crate::task::GroundedTask = $crate::task::GroundedTask::UNUSED; tasks,
            candidates: $crate::session::Candidate = $crate::session::Candidate::UNUSED; candidates,
            candidate_tokens: $crate::symbols::Symbol = $crate::symbols::Symbol(0); candidate_tokens,
            joint: $crate::probability::Scaled = $crate::probability::Scaled::ZERO; beliefs,
            settled: $crate::probability::Scaled = $crate::probability::Scaled::ZERO; beliefs,
            priors: $crate::probability::Scaled = $crate::probability::Scaled::ZERO; tasks,
            strategies: ($crate::feedback::Strategy, f32) = ($crate::feedback::Strategy::UNUSED, 0.0); strategies,
            goal_parts: $crate::planning::goals::GoalPart = $crate::planning::goals::GoalPart::UNUSED; ground_propositions,
            goal_entries: $crate::task::TaskSet = $crate::task::TaskSet::EMPTY; goal_entries,
            workspace: u64 = 0; workspace_words(),
            // Takes no bytes: its length says how much of the workspace is for the search.
            search_words: () = (); search_words(),
            hashed: u64 = 0; hashed_states,
            optimal: $crate::oomdp::ActionSet = $crate::oomdp::ActionSet::EMPTY; tasks,
            distances: u32 = 0; tasks,
        }
    };
}

/// Makes the [`Memory`] of a value that has one field for each table.
#[doc(hidden)]
#[macro_export]
macro_rules! split_tables {
    ($it:expr) => {{
        let it = $it;
        $crate::memory::Memory {
            home: $crate::home::HomeMemory {
                objects: $crate::oomdp::objects::ObjectMemory {
                    objects: &mut it.objects[..],
                    name_bytes: &mut it.name_bytes[..],
                    name_ends: &mut it.name_ends[..],
                },
                areas: &mut it.areas[..],
                places: &mut it.places[..],
            },
            agent: $crate::session::AgentMemory {
                language: $crate::language::LanguageMemory {
                    word_bytes: &mut it.word_bytes[..],
                    word_ends: &mut it.word_ends[..],
                    token_bytes: &mut it.token_bytes[..],
                    token_ends: &mut it.token_ends[..],
                    bitext: $crate::language::BitextMemory {
                        commands: &mut it.commands[..],
                        command_tokens: &mut it.command_tokens[..],
                        sessions: &mut it.sessions[..],
                        sentence_words: &mut it.sentence_words[..],
                        pairs: &mut it.pairs[..],
                    },
                    tables: $crate::language::TableMemory {
                        translations: &mut it.translations[..],
                        alignments: &mut it.alignments[..],
                        counts: &mut it.workspace[..],
                        length_pairs: &mut it.length_pairs[..],
                    },
                },
                session: $crate::session::SessionMemory {
                    tasks: &mut it.grounded[..],
                    candidates: $crate::session::CandidateMemory { entries: &mut it.candidates[..], tokens: &mut it.candidate_tokens[..] },
                    belief: $crate::feedback::BeliefMemory {
                        joint: &mut it.joint[..],
                        settled: &mut it.settled[..],
                        priors: &mut it.priors[..],
                        strategies: &mut it.strategies[..],
                    },
                    goals: $crate::planning::GoalMemory { parts: &mut it.goal_parts[..], entries: &mut it.goal_entries[..] },
                    plan: $crate::planning::PlanMemory {
                        words: it.search_words.len(),
                        hashed: &mut it.hashed[..],
                        optimal: &mut it.optimal[..],
                        distances: &mut it.distances[..],
                    },
                },
            },
        }
    }};
}

/// Makes a struct that holds all memory of one home and one agent, in plain arrays: `const`-constructible, so that a controller can put
/// it into a static without building it on the stack first.
///
/// ```
/// goodbot::memory! {
///     /// A robot's memory.
///     pub struct RobotMemory = goodbot::Capacities::SMALL;
/// }
/// let mut memory = RobotMemory::new();
/// let parts = memory.split();
/// assert_eq!(parts.agent.language.word_ends.len(), RobotMemory::CAPACITIES.words);
/// ```
#[macro_export]
macro_rules! memory {
    ($(#[$meta:meta])* $vis:vis struct $Name:ident = $capacities:expr;) => {
        $crate::for_each_table! { $crate::memory_struct!( $(#[$meta])* [$vis] $Name [$capacities]) }
    };
}

/// The struct that `memory!` makes.
#[doc(hidden)]
#[macro_export]
macro_rules! memory_struct {
    ($(#[$meta:meta])* [$vis:vis] $Name:ident [$capacities:expr]
        $($table:ident: $Element:ty = $empty:expr; $field:ident $(($($call:tt)*))?,)*) => {
        $(#[$meta])*
        #[derive(Debug)]
        $vis struct $Name {
            $($table: [$Element; ($capacities).$field $(($($call)*))?],)*
        }

        #[allow(dead_code, missing_docs)]
        impl $Name {
            /// How large each table is.
            $vis const CAPACITIES: $crate::Capacities = $capacities;

            /// Memory that nothing uses yet.
            $vis const fn new() -> Self {
                Self { $($table: [$empty; ($capacities).$field $(($($call)*))?],)* }
            }

            /// Lends each part of the library its share.
            $vis fn split(&mut self) -> $crate::memory::Memory<'_> {
                $crate::split_tables!(self)
            }
        }

        impl Default for $Name {
            fn default() -> Self {
                Self::new()
            }
        }
    };
}

#[cfg(feature = "std")]
mod heap {
    use super::Memory;
    use crate::Capacities;
    use std::vec;
    use std::vec::Vec;

    macro_rules! heap_memory {
        ($($table:ident: $Element:ty = $empty:expr; $field:ident $(($($call:tt)*))?,)*) => {
            /// Memory on the heap, for hosts: the same tables as [`memory!`](crate::memory!) makes, with capacities chosen at run time.
            #[derive(Debug)]
            pub struct HeapMemory {
                $($table: Vec<$Element>,)*
            }

            impl HeapMemory {
                /// Memory that nothing uses yet.
                pub fn new(capacities: &Capacities) -> Self {
                    Self { $($table: vec![$empty; capacities.$field $(($($call)*))?],)* }
                }

                /// Lends each part of the library its share.
                pub fn split(&mut self) -> Memory<'_> {
                    crate::split_tables!(self)
                }
            }
        };
    }
    for_each_table! { heap_memory!() }
}

#[cfg(feature = "std")]
pub use heap::HeapMemory;
