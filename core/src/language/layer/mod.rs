//! A layer above the role model: a host hands it over with an agent's memory, and it learns where the role model is wrong. The core knows
//! none; the crate `goodbot-layer` has one. With the feature `layer`.
//!
//! The core keeps what a layer learns from, beside the training data: the tasks that each session could mean. They are saved, joined and
//! forgotten with their sessions. If there is no memory for them, or it is full, the layer has no effect.
//!
//! A training begins with [`Layer::begin`]. Whenever the role model is trained on all sessions but those of [`Layer::left_out`],
//! [`Layer::advance`] goes on until it is done, or until it wants a role model that has seen other sessions.

mod known;

use super::bitext::{Bitext, BitextRef, Extent, Pair, Span, close_up};
use super::settings::Settings;
use super::tables::TablesRef;
use crate::capacity::TOKENS_PER_COMMAND;
use crate::memory::{BitextTables, BitextTablesRef};
use crate::probability::Scaled;
use crate::symbols::Symbol;
use alloc::{boxed::Box, vec, vec::Vec};
use core::fmt;

pub(in crate::language) use known::CommandIndex;
pub use known::hash;

/// What a layer learns from, and understands commands by.
#[derive(Clone, Copy, Debug)]
pub struct View<'t> {
    /// The role model's parameters.
    pub tables: TablesRef<'t>,
    /// The sessions, each with what it meant.
    pub bitext: BitextRef<'t>,
    /// The tasks that each session could mean, with their prior as weight. Its sessions have no words.
    pub possible: BitextRef<'t>,
}

/// The result of a part of a training.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Step {
    /// More is to do. This part visited about this many table cells.
    Working(usize),
    /// The role model must be trained again, because [`Layer::left_out`] has changed.
    RolesAnew,
    /// The layer is trained, or there is too little to learn from.
    Done,
}

/// A layer above the role model.
pub trait Layer: fmt::Debug + Send + Sync {
    /// Begins a training. `possible` are the tasks of all sessions.
    fn begin(&mut self, possible: BitextRef<'_>);

    /// Forgets what was learned, and breaks off a training.
    fn forget(&mut self);

    /// The sessions that the role model in training must not see.
    fn left_out(&self) -> LeftOut;

    /// Continues a training after the role model's, by a bounded part. `view.bitext` leaves out the sessions of
    /// [`left_out`](Self::left_out).
    fn advance(&mut self, view: View<'_>) -> Step;

    /// Turns the role model's weights of tasks into those of the layer. `same` returns the first task with the same description, and
    /// `description` returns the description of that one. A layer that has not learned leaves the weights unchanged.
    fn weigh<'d>(
        &self,
        view: View<'_>,
        sentence: &[Option<Symbol>],
        same: &dyn Fn(usize) -> usize,
        description: &dyn Fn(usize) -> &'d [Symbol],
        weights: &mut [Scaled],
    );

    /// A copy, for tables that are made of copies.
    fn boxed(&self) -> Box<dyn Layer>;
}

impl Clone for Box<dyn Layer> {
    fn clone(&self) -> Self {
        self.boxed()
    }
}

/// The number of parts into which the sessions are divided. One of them can be left out of a training.
pub const FOLDS: usize = 2;

/// The sessions that a training leaves out.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct LeftOut(Option<u8>);

impl LeftOut {
    /// No session.
    pub const NONE: Self = Self(None);
    /// The first part.
    pub const FIRST: Self = Self(Some(0));

    /// The next part; no session after the last part.
    #[must_use]
    pub fn next(self) -> Self {
        Self(self.0.map(|part| part.saturating_add(1)).filter(|&part| usize::from(part) < FOLDS))
    }

    /// The first session left out.
    pub fn first(self) -> Option<u16> {
        self.0.map(u16::from)
    }

    pub(in crate::language) fn has(self, session: u16) -> bool {
        self.0.is_some_and(|part| usize::from(session) % FOLDS == usize::from(part))
    }
}

/// A layer, with the memory for the tasks of all sessions.
#[derive(Clone, Debug)]
pub struct LayerMemory {
    layer: Option<Box<dyn Layer>>,
    commands: Vec<Span>,
    command_tokens: Vec<Symbol>,
    sessions: Vec<Span>,
    pairs: Vec<Pair>,
    used: Extent,
}

impl LayerMemory {
    /// No layer.
    pub const NONE: Self =
        Self { layer: None, commands: Vec::new(), command_tokens: Vec::new(), sessions: Vec::new(), pairs: Vec::new(), used: Extent::NONE };

    /// The average number of symbols in a task's description, at most.
    const SYMBOLS: usize = 24;

    /// A layer with memory for this many sessions and, in all of them, this many tasks.
    pub(crate) fn new(layer: Box<dyn Layer>, sessions: usize, tasks: usize) -> Self {
        // More descriptions could not be numbered.
        let commands = tasks.min(usize::from(u16::MAX));
        let tokens = tasks.saturating_mul(Self::SYMBOLS).min(commands.saturating_mul(TOKENS_PER_COMMAND));
        Self {
            layer: Some(layer),
            commands: vec![Span::UNUSED; commands],
            command_tokens: vec![Symbol::new(0); tokens],
            sessions: vec![Span::UNUSED; sessions],
            pairs: vec![Pair::UNUSED; tasks],
            used: Extent::NONE,
        }
    }
}

/// A layer and the tasks of all sessions, if a host has handed one over.
#[derive(Debug)]
pub(in crate::language) struct Above<'t>(Option<Room<'t>>);

/// The layer in its memory.
#[derive(Debug)]
pub(in crate::language) struct Room<'t> {
    pub possible: Bitext<'t>,
    layer: &'t mut dyn Layer,
}

impl<'t> Above<'t> {
    /// The layer in `memory`, a slice with one element or none.
    pub fn new(memory: &'t mut [LayerMemory]) -> Self {
        let Some(LayerMemory { layer: Some(layer), commands, command_tokens, sessions, pairs, used }) = memory.first_mut() else {
            return Self(None);
        };
        let tables = BitextTables { commands, command_tokens, sessions, sentence_words: &mut [], pairs };
        Self(Some(Room { possible: Bitext::new(tables, used), layer: &mut **layer }))
    }

    /// The sessions that the role model in training must not see.
    pub fn left_out(&self) -> LeftOut {
        self.0.as_ref().map_or(LeftOut::NONE, |room| room.layer.left_out())
    }

    /// Begins a training: what was learned before is not used any more.
    pub fn begin(&mut self, settings: &Settings) {
        match &mut self.0 {
            Some(room) if settings.has_layer() => room.layer.begin(room.possible.read()),
            Some(room) => room.layer.forget(),
            None => {}
        }
    }

    /// Continues a training, by a bounded part.
    pub fn advance(&mut self, tables: TablesRef<'_>, bitext: BitextRef<'_>) -> Step {
        self.0.as_mut().map_or(Step::Done, |room| room.layer.advance(View { tables, bitext, possible: room.possible.read() }))
    }

    /// Forgets the tasks of all sessions: another model may have used the memory before.
    pub fn clear(&mut self) {
        if let Some(room) = &mut self.0 {
            room.clear();
        }
    }

    /// Adjusts the symbols after a machine token was removed. If a session's task uses it, the layer forgets all sessions and learns again
    /// from later ones.
    pub fn remove_token(&mut self, token: Symbol) {
        let Some(room) = &mut self.0 else { return };
        if room.possible.tokens_mut().contains(&token) {
            room.clear();
        }
        room.possible.tokens_mut().iter_mut().for_each(|other| close_up(other, token));
    }

    /// The tasks of all sessions.
    pub fn possible_mut(&mut self) -> Option<&mut Bitext<'t>> {
        self.0.as_mut().map(|room| &mut room.possible)
    }

    /// The same, read-only.
    pub const fn read(&self) -> Option<AboveRef<'_>> {
        match &self.0 {
            Some(room) => Some(AboveRef { possible: room.possible.read(), layer: room.layer }),
            None => None,
        }
    }
}

impl Room<'_> {
    fn clear(&mut self) {
        self.possible.rewind(Extent::NONE);
        self.layer.forget();
    }
}

/// A layer and the tasks of all sessions, read-only.
#[derive(Clone, Copy, Debug)]
pub(in crate::language) struct AboveRef<'t> {
    pub possible: BitextRef<'t>,
    pub layer: &'t dyn Layer,
}

impl<'t> AboveRef<'t> {
    /// The layer in `memory`, a slice with one element or none.
    pub fn new(memory: &'t [LayerMemory]) -> Option<Self> {
        let LayerMemory { layer, commands, command_tokens, sessions, pairs, used } = memory.first()?;
        let tables = BitextTablesRef { commands, command_tokens, sessions, sentence_words: &[], pairs };
        Some(Self { possible: BitextRef::new(tables, *used), layer: layer.as_deref()? })
    }

    /// The tasks of all sessions.
    pub const fn possible(self) -> BitextRef<'t> {
        self.possible
    }
}
