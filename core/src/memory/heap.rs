//! Memory on the heap, for hosts: the same tables, with capacities chosen at run time.

use super::{AgentMemory, AgentTables, AgentTablesRef, HomeMemory};
use crate::Capacities;
use crate::home::{HomeTables, HomeTablesRef};
use alloc::vec;
use alloc::vec::Vec;
use core::fmt;

macro_rules! heap {
    ($(#[$meta:meta])* $Heap:ident $($table:ident: $Element:ty = $empty:expr; $field:ident $(($($call:tt)*))?,)*) => {
        $(#[$meta])*
        pub struct $Heap {
            $($table: Vec<$Element>,)*
        }

        impl $Heap {
            /// Memory that nothing uses yet.
            pub fn new(capacities: &Capacities) -> Self {
                Self { $($table: vec![$empty; capacities.$field $(($($call)*))?],)* }
            }
        }

        impl fmt::Debug for $Heap {
            fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.debug_struct(stringify!($Heap)).finish_non_exhaustive()
            }
        }
    };
}

crate::for_each_home_table! { heap!(
    /// Memory for a home, on the heap.
    HomeHeap
) }
crate::for_each_agent_table! { heap!(
    /// Memory for an agent, on the heap.
    AgentHeap
) }

impl HomeMemory for HomeHeap {
    fn lend(&mut self) -> HomeTables<'_> {
        crate::home_tables!(mut self)
    }

    fn read(&self) -> HomeTablesRef<'_> {
        crate::home_tables!(ref self)
    }
}

impl AgentMemory for AgentHeap {
    fn lend(&mut self) -> AgentTables<'_> {
        crate::agent_tables!(mut self)
    }

    fn read(&self) -> AgentTablesRef<'_> {
        crate::agent_tables!(ref self)
    }
}

/// Memory on the heap for one home and one agent: what [`memory!`](crate::memory!) makes, with capacities chosen at run time.
#[derive(Debug)]
pub struct HeapMemory {
    /// For a home.
    pub home: HomeHeap,
    /// For an agent.
    pub agent: AgentHeap,
}

impl HeapMemory {
    /// Memory that nothing uses yet.
    pub fn new(capacities: &Capacities) -> Self {
        Self { home: HomeHeap::new(capacities), agent: AgentHeap::new(capacities) }
    }
}
