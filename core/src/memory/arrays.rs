//! Memory in plain arrays, whose lengths are known when the program is compiled.

use super::{AgentMemory, AgentTables, AgentTablesRef, HomeMemory};
use crate::home::{HomeTables, HomeTablesRef};
use core::fmt;

macro_rules! shape {
    ($($table:ident: $Element:ty = $empty:expr; $field:ident $(($($call:tt)*))?,)*) => {
        /// The arrays of a memory. [`memory!`](crate::memory!) implements it.
        #[expect(missing_docs, non_camel_case_types, non_upper_case_globals, reason = "each item is the table of the same name")]
        pub trait Shape: 'static {
            $(
                type $table: AsRef<[$Element]> + AsMut<[$Element]>;
                const $table: Self::$table;
            )*
        }
    };
}

macro_rules! arrays {
    ($(#[$meta:meta])* $Arrays:ident $($table:ident: $Element:ty = $empty:expr; $field:ident $(($($call:tt)*))?,)*) => {
        $(#[$meta])*
        pub struct $Arrays<S: Shape> {
            $($table: S::$table,)*
        }

        impl<S: Shape> $Arrays<S> {
            /// Memory that nothing uses yet.
            pub const fn new() -> Self {
                Self { $($table: S::$table,)* }
            }
        }

        impl<S: Shape> Default for $Arrays<S> {
            fn default() -> Self {
                Self::new()
            }
        }

        impl<S: Shape> fmt::Debug for $Arrays<S> {
            fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.debug_struct(stringify!($Arrays)).finish_non_exhaustive()
            }
        }
    };
}

crate::for_each_home_table! { crate::all_memory!(shape!()) }
crate::for_each_home_table! { arrays!(
    /// Memory for a home, in plain arrays.
    HomeArrays
) }
crate::for_each_agent_table! { arrays!(
    /// Memory for an agent, in plain arrays.
    AgentArrays
) }

impl<S: Shape> HomeMemory for HomeArrays<S> {
    fn lend(&mut self) -> HomeTables<'_> {
        crate::home_tables!(mut self)
    }

    fn read(&self) -> HomeTablesRef<'_> {
        crate::home_tables!(ref self)
    }
}

impl<S: Shape> AgentMemory for AgentArrays<S> {
    fn lend(&mut self) -> AgentTables<'_> {
        crate::agent_tables!(mut self)
    }

    fn read(&self) -> AgentTablesRef<'_> {
        crate::agent_tables!(ref self)
    }
}

/// Makes a struct that holds all memory of one home and one agent, in plain arrays. It starts as zeros, so that a static of it takes no
/// flash and is never built on the stack.
///
/// ```
/// use goodbot::{Agent, Options, home};
/// goodbot::memory! {
///     /// A robot's memory.
///     pub struct RobotMemory = goodbot::Capacities::SMALL;
/// }
/// let mut memory = RobotMemory::new();
/// let agent = Agent::new(&mut memory.agent, &home::paper_tasks()?, Options::PAPER)?;
/// assert_eq!(agent.capacities().words, RobotMemory::CAPACITIES.words);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[macro_export]
macro_rules! memory {
    ($(#[$meta:meta])* $vis:vis struct $Name:ident = $capacities:expr;) => {
        $(#[$meta])*
        #[derive(Debug, Default)]
        $vis struct $Name {
            /// For a home.
            pub home: $crate::memory::HomeArrays<$Name>,
            /// For an agent.
            pub agent: $crate::memory::AgentArrays<$Name>,
        }

        #[allow(dead_code, missing_docs)]
        impl $Name {
            /// How large each table is.
            $vis const CAPACITIES: $crate::Capacities = $capacities;

            /// Memory that nothing uses yet.
            $vis const fn new() -> Self {
                Self { home: $crate::memory::HomeArrays::new(), agent: $crate::memory::AgentArrays::new() }
            }
        }

        $crate::for_each_home_table! { $crate::all_memory!($crate::memory_shape!($Name [$capacities])) }
    };
}

/// The shape that `memory!` makes.
#[doc(hidden)]
#[macro_export]
macro_rules! memory_shape {
    ($Name:ident [$capacities:expr] $($table:ident: $Element:ty = $empty:expr; $field:ident $(($($call:tt)*))?,)*) => {
        #[allow(non_camel_case_types, non_upper_case_globals)]
        impl $crate::memory::Shape for $Name {
            $(
                type $table = [$Element; ($capacities).$field $(($($call)*))?];
                const $table: Self::$table = [$empty; ($capacities).$field $(($($call)*))?];
            )*
        }
    };
}
