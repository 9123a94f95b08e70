//! Memory that the caller owns and lends for the length of each call, shaped by [`Capacities`](crate::Capacities).
//!
//! [`memory!`](crate::memory!) makes a struct of plain arrays, which a controller puts into a static; with the `alloc` feature,
//! [`HeapMemory`] takes the same capacities at run time. Both have two parts: `home`, for a [`Home`](crate::home::Home), and `agent`, for
//! an [`Agent`](crate::Agent). Either part may be moved in or lent:
//!
//! | what is handed over | who owns the tables |
//! |---|---|
//! | `memory.agent` | the agent |
//! | `&mut memory.agent` | the caller, who can use them again when the agent is gone |
//! | [`AgentTables`] | the caller, table by table: for memory that is dealt out at run time |

mod arrays;
#[cfg(feature = "alloc")]
mod heap;
mod list;

pub use arrays::{AgentArrays, HomeArrays, Shape};
#[cfg(feature = "alloc")]
pub use heap::{AgentHeap, HeapMemory, HomeHeap};

use crate::home::{HomeTables, HomeTablesRef};
use crate::language::{LanguageTables, LanguageTablesRef};
use crate::session::{SessionTables, SessionTablesRef};

/// The tables of one agent.
#[derive(Debug)]
pub struct AgentTables<'t> {
    /// What it learns.
    pub language: LanguageTables<'t>,
    /// What one session needs.
    pub session: SessionTables<'t>,
    /// What planning and training have in turn.
    pub workspace: &'t mut [u64],
}

/// The tables of one agent, to be read.
#[derive(Clone, Copy, Debug)]
pub struct AgentTablesRef<'t> {
    /// What it learns.
    pub language: LanguageTablesRef<'t>,
    /// What one session needs.
    pub session: SessionTablesRef<'t>,
    /// What planning and training have in turn.
    pub workspace: &'t [u64],
}

impl AgentTables<'_> {
    /// The same tables, lent for a shorter time.
    pub fn lend(&mut self) -> AgentTables<'_> {
        AgentTables { language: self.language.lend(), session: self.session.lend(), workspace: self.workspace }
    }

    /// The same tables, to be read.
    pub const fn read(&self) -> AgentTablesRef<'_> {
        AgentTablesRef { language: self.language.read(), session: self.session.read(), workspace: self.workspace }
    }
}

/// Memory for an [`Agent`](crate::Agent). Every call must lend the same tables, and nothing else may write to them in between.
pub trait AgentMemory {
    /// Lends the tables to one call.
    fn lend(&mut self) -> AgentTables<'_>;
    /// Lends the tables to one call that only reads.
    fn read(&self) -> AgentTablesRef<'_>;
}

impl<M: AgentMemory + ?Sized> AgentMemory for &mut M {
    fn lend(&mut self) -> AgentTables<'_> {
        (**self).lend()
    }

    fn read(&self) -> AgentTablesRef<'_> {
        (**self).read()
    }
}

impl AgentMemory for AgentTables<'_> {
    fn lend(&mut self) -> AgentTables<'_> {
        Self::lend(self)
    }

    fn read(&self) -> AgentTablesRef<'_> {
        Self::read(self)
    }
}

/// Memory for a [`Home`](crate::home::Home). Every call must lend the same tables, and nothing else may write to them in between.
pub trait HomeMemory {
    /// Lends the tables to one call.
    fn lend(&mut self) -> HomeTables<'_>;
    /// Lends the tables to one call that only reads.
    fn read(&self) -> HomeTablesRef<'_>;
}

impl<M: HomeMemory + ?Sized> HomeMemory for &mut M {
    fn lend(&mut self) -> HomeTables<'_> {
        (**self).lend()
    }

    fn read(&self) -> HomeTablesRef<'_> {
        (**self).read()
    }
}

impl HomeMemory for HomeTables<'_> {
    fn lend(&mut self) -> HomeTables<'_> {
        Self::lend(self)
    }

    fn read(&self) -> HomeTablesRef<'_> {
        Self::read(self)
    }
}

/// Makes two structs of tables, one to be written and one to be read.
macro_rules! tables {
    ($(#[$meta:meta])* $Tables:ident, $(#[$ref_meta:meta])* $TablesRef:ident { $($(#[$doc:meta])* $table:ident: $Element:ty,)* }) => {
        $(#[$meta])*
        #[derive(Debug, Default)]
        pub struct $Tables<'t> {
            $($(#[$doc])* pub $table: &'t mut [$Element],)*
        }

        $(#[$ref_meta])*
        #[derive(Clone, Copy, Debug, Default)]
        pub struct $TablesRef<'t> {
            $($(#[$doc])* pub $table: &'t [$Element],)*
        }

        impl $Tables<'_> {
            /// The same tables, lent for a shorter time.
            pub fn lend(&mut self) -> $Tables<'_> {
                $Tables { $($table: self.$table,)* }
            }

            /// The same tables, to be read.
            pub const fn read(&self) -> $TablesRef<'_> {
                $TablesRef { $($table: self.$table,)* }
            }
        }
    };
}
pub(crate) use tables;
