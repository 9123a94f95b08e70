//! Memory on the heap, for hosts: the same tables, with capacities chosen at run time.

use super::{AgentMemory, AgentTables, AgentTablesRef, HomeMemory};
use crate::Capacities;
use crate::home::{HomeTables, HomeTablesRef};
#[cfg(feature = "layer")]
use crate::language::layer::{LAYER_WEIGHTS, LayerState};
#[cfg(feature = "layer")]
use crate::language::{BitextTables, BitextTablesRef, LanguageTables, LanguageTablesRef, LayerTables, LayerTablesRef, Pair, Span};
#[cfg(feature = "layer")]
use crate::symbols::Symbol;
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
    /// What an agent has in any memory, on the heap.
    CommonHeap
) }

impl HomeMemory for HomeHeap {
    fn lend(&mut self) -> HomeTables<'_> {
        crate::home_tables!(mut self)
    }

    fn read(&self) -> HomeTablesRef<'_> {
        crate::home_tables!(ref self)
    }
}

impl AgentMemory for CommonHeap {
    fn lend(&mut self) -> AgentTables<'_> {
        crate::agent_tables!(mut self)
    }

    fn read(&self) -> AgentTablesRef<'_> {
        crate::agent_tables!(ref self)
    }
}

/// Memory for an agent, on the heap.
#[derive(Debug)]
pub struct AgentHeap {
    common: CommonHeap,
    #[cfg(feature = "layer")]
    layer: LayerHeap,
}

impl AgentHeap {
    /// Memory that nothing uses yet.
    pub fn new(capacities: &Capacities) -> Self {
        Self {
            common: CommonHeap::new(capacities),
            #[cfg(feature = "layer")]
            layer: LayerHeap::default(),
        }
    }

    /// The same, with room for the [layer](crate::language::layer): for so many tasks of all sessions together, those included that were
    /// not meant.
    #[cfg(feature = "layer")]
    #[must_use]
    pub fn with_layer(self, tasks: usize) -> Self {
        let sessions = self.common.read().language.bitext.sessions.len();
        Self { layer: LayerHeap::new(sessions, tasks), ..self }
    }
}

impl AgentMemory for AgentHeap {
    fn lend(&mut self) -> AgentTables<'_> {
        let tables = self.common.lend();
        #[cfg(feature = "layer")]
        let tables = AgentTables { language: LanguageTables { layer: self.layer.lend(), ..tables.language }, ..tables };
        tables
    }

    fn read(&self) -> AgentTablesRef<'_> {
        let tables = self.common.read();
        #[cfg(feature = "layer")]
        let tables = AgentTablesRef { language: LanguageTablesRef { layer: self.layer.read(), ..tables.language }, ..tables };
        tables
    }
}

/// The tables of the layer, on the heap: none, or for so many tasks of so many sessions.
#[cfg(feature = "layer")]
#[derive(Default)]
struct LayerHeap {
    commands: Vec<Span>,
    command_tokens: Vec<Symbol>,
    sessions: Vec<Span>,
    pairs: Vec<Pair>,
    shares: Vec<f32>,
    understood: Vec<f32>,
    weights: Vec<f32>,
    state: Vec<LayerState>,
}

#[cfg(feature = "layer")]
impl LayerHeap {
    /// Symbols that a task's description has on average, at most.
    const SYMBOLS: usize = 24;

    fn new(sessions: usize, tasks: usize) -> Self {
        Self {
            commands: vec![Span::UNUSED; tasks],
            command_tokens: vec![Symbol::new(0); tasks.saturating_mul(Self::SYMBOLS)],
            sessions: vec![Span::UNUSED; sessions],
            pairs: vec![Pair::UNUSED; tasks],
            shares: vec![0.0; tasks],
            understood: vec![0.0; tasks],
            weights: vec![0.0; LAYER_WEIGHTS],
            state: vec![LayerState::UNUSED],
        }
    }

    fn lend(&mut self) -> LayerTables<'_> {
        LayerTables {
            possible: BitextTables {
                commands: &mut self.commands,
                command_tokens: &mut self.command_tokens,
                sessions: &mut self.sessions,
                sentence_words: &mut [],
                pairs: &mut self.pairs,
            },
            shares: &mut self.shares,
            understood: &mut self.understood,
            weights: &mut self.weights,
            state: &mut self.state,
            ..LayerTables::default()
        }
    }

    fn read(&self) -> LayerTablesRef<'_> {
        LayerTablesRef {
            possible: BitextTablesRef {
                commands: &self.commands,
                command_tokens: &self.command_tokens,
                sessions: &self.sessions,
                sentence_words: &[],
                pairs: &self.pairs,
            },
            weights: &self.weights,
            state: &self.state,
            ..LayerTablesRef::default()
        }
    }
}

#[cfg(feature = "layer")]
impl fmt::Debug for LayerHeap {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("LayerHeap").finish_non_exhaustive()
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
