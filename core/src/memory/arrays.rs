//! Memory in plain arrays, whose lengths are known when the program is compiled.

use super::{AgentMemory, HomeMemory};

/// The two parts of a memory in arrays. [`memory!`](crate::memory!) implements it.
#[doc(hidden)]
pub trait Arrays {
    /// For a home.
    type Home: HomeMemory;
    /// For an agent.
    type Agent: AgentMemory;
}

/// The part of the memory `M` that is for a home.
#[doc(hidden)]
pub type HomeArrays<M> = <M as Arrays>::Home;
/// The part of the memory `M` that is for an agent.
#[doc(hidden)]
pub type AgentArrays<M> = <M as Arrays>::Agent;

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
        }

        const _: () = {
            $crate::for_each_home_table! { $crate::tables_in_arrays!(HomeArrays $Name) }
            $crate::for_each_agent_table! { $crate::tables_in_arrays!(AgentArrays $Name) }
            $crate::for_each_home_table! { $crate::lend_tables!(HomeArrays) }
            $crate::for_each_agent_table! { $crate::lend_tables!(AgentArrays) }

            impl $crate::memory::Arrays for $Name {
                type Home = HomeArrays;
                type Agent = AgentArrays;
            }

            #[allow(dead_code, missing_docs)]
            impl $Name {
                /// Memory that nothing uses yet.
                $vis const fn new() -> Self {
                    Self { home: HomeArrays::new(), agent: AgentArrays::new() }
                }
            }
        };
    };
}

/// A struct with an array for each table.
#[doc(hidden)]
#[macro_export]
macro_rules! tables_in_arrays {
    ($Arrays:ident $Name:ident $Memory:ident $whole:ident $Whole:ident $WholeRef:ident; $(
        $(#[$meta:meta])* $group:ident: $Tables:ident $TablesRef:ident
        { $($(#[$doc:meta])* $table:ident: $Element:ty = $empty:expr; $field:ident $(($($call:tt)*))?,)* } ($($parts:tt)*)
    )*) => {
        #[derive(Debug)]
        #[allow(missing_docs, unnameable_types)]
        pub struct $Arrays {
            $($($table: [$Element; $Name::CAPACITIES.$field $(($($call)*))?],)*)*
        }

        impl $Arrays {
            const fn new() -> Self {
                Self { $($($table: [$empty; $Name::CAPACITIES.$field $(($($call)*))?],)*)* }
            }
        }

        impl Default for $Arrays {
            fn default() -> Self {
                Self::new()
            }
        }
    };
}

/// Lends the tables of a struct that has an array or a `Vec` for each.
#[doc(hidden)]
#[macro_export]
macro_rules! lend_tables {
    ($Owner:ident $Memory:ident $whole:ident $Whole:ident $WholeRef:ident; $(
        $(#[$meta:meta])* $group:ident: $Tables:ident $TablesRef:ident
        { $($(#[$doc:meta])* $table:ident: $Element:ty = $empty:expr; $field:ident $(($($call:tt)*))?,)* }
        ($($part:ident: $Part:ident $PartRef:ident,)*)
    )*) => {
        impl $crate::memory::$Memory for $Owner {
            fn lend(&mut self) -> $crate::memory::$Whole<'_> {
                $(let $group = $crate::memory::$Tables { $($table: &mut self.$table,)* $($part,)* };)*
                $whole
            }

            fn read(&self) -> $crate::memory::$WholeRef<'_> {
                $(let $group = $crate::memory::$TablesRef { $($table: &self.$table,)* $($part,)* };)*
                $whole
            }
        }
    };
}
