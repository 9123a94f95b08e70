//! Memory on the heap, for hosts: the same tables, with capacities chosen at run time.

use crate::Capacities;
#[cfg(feature = "layer")]
use crate::language::layer::{Layer, LayerMemory};
#[cfg(feature = "layer")]
use alloc::boxed::Box;
use alloc::vec;
use alloc::vec::Vec;
use core::fmt;

macro_rules! tables_on_heap {
    ($(#[$heap_meta:meta])* $Heap:ident $Memory:ident $whole:ident $Whole:ident $WholeRef:ident; $(
        $(#[$meta:meta])* $group:ident: $Tables:ident $TablesRef:ident
        { $($(#[$doc:meta])* $table:ident: $Element:ty = $empty:expr; $field:ident $(($($call:tt)*))?,)* } ($($parts:tt)*)
    )*) => {
        $(#[$heap_meta])*
        pub struct $Heap {
            $($($table: Vec<$Element>,)*)*
        }

        impl $Heap {
            /// Memory that nothing uses yet.
            pub fn new(capacities: &Capacities) -> Self {
                Self { $($($table: vec![$empty; capacities.$field $(($($call)*))?],)*)* }
            }
        }

        impl fmt::Debug for $Heap {
            fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.debug_struct(stringify!($Heap)).finish_non_exhaustive()
            }
        }
    };
}

crate::for_each_home_table! { tables_on_heap!(
    /// Memory for a home, on the heap.
    HomeHeap
) }
crate::for_each_agent_table! { tables_on_heap!(
    /// Memory for an agent, on the heap.
    AgentHeap
) }
crate::for_each_home_table! { crate::lend_tables!(HomeHeap) }
crate::for_each_agent_table! { crate::lend_tables!(AgentHeap) }

#[cfg(feature = "layer")]
impl AgentHeap {
    /// Adds a [layer](crate::language::layer), and memory for what it learns from: `tasks` counts the possible tasks of all sessions
    /// together, also those that were not meant. The crate `goodbot-layer` has a layer.
    #[must_use]
    pub fn with_layer(self, layer: Box<dyn Layer>, tasks: usize) -> Self {
        Self { layer: vec![LayerMemory::new(layer, self.sessions.len(), tasks)], ..self }
    }
}

/// Memory on the heap for one home and one agent: like [`memory!`](crate::memory!), with capacities chosen at run time.
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
