//! The memory of the layer. It is empty if a caller provides none.

use super::learned::Learned;
use super::network::Network;
use super::speaking::Found;
use super::weights::CELLS;
use crate::capacity::TOKENS_PER_COMMAND;
use crate::language::bitext::{Bitext, BitextRef, Extent, Pair, Span, close_up};
use crate::language::settings::Settings;
use crate::memory::{BitextTables, BitextTablesRef};
use crate::symbols::Symbol;
use alloc::{vec, vec::Vec};

/// Two numbers for each weight of the layer: the weight, and the sum of its squared gradients.
pub const LAYER_WEIGHTS: usize = 2 * CELLS;

/// The memory of the layer: the tasks of all sessions, and the trained weights.
#[derive(Clone, Debug)]
pub struct LayerMemory {
    /// The tasks of all sessions: each session's machine commands, with their prior as weight. The sessions have no words.
    commands: Vec<Span>,
    command_tokens: Vec<Symbol>,
    sessions: Vec<Span>,
    pairs: Vec<Pair>,
    used: Extent,
    /// One entry per pair: the posterior that the session showed.
    shares: Vec<f32>,
    /// One entry per pair: the posterior of a role model that has not seen the session.
    understood: Vec<f32>,
    /// [`LAYER_WEIGHTS`] numbers.
    weights: Vec<f32>,
    learned: Learned,
    /// The tasks that were meant in scenes that were taught often, sorted.
    taught: Vec<u32>,
    network: Network,
    left_out: LeftOut,
    /// One entry per word, while a role model reads sessions that it has not seen: whether the word was heard in its own.
    heard: Vec<bool>,
    found: Found,
}

impl LayerMemory {
    /// No memory.
    pub const NONE: Self = Self {
        commands: Vec::new(),
        command_tokens: Vec::new(),
        sessions: Vec::new(),
        pairs: Vec::new(),
        used: Extent::NONE,
        shares: Vec::new(),
        understood: Vec::new(),
        weights: Vec::new(),
        learned: Learned::NOTHING,
        taught: Vec::new(),
        network: Network::NONE,
        left_out: LeftOut::NONE,
        heard: Vec::new(),
        found: Found::NONE,
    };

    /// The average number of symbols in a task's description, at most.
    const SYMBOLS: usize = 24;

    /// Memory for this many sessions and, in all of them, this many tasks.
    pub(crate) fn new(sessions: usize, tasks: usize) -> Self {
        // More descriptions could not be numbered.
        let commands = tasks.min(usize::from(u16::MAX));
        let tokens = tasks.saturating_mul(Self::SYMBOLS).min(commands.saturating_mul(TOKENS_PER_COMMAND));
        Self {
            commands: vec![Span::UNUSED; commands],
            command_tokens: vec![Symbol::new(0); tokens],
            sessions: vec![Span::UNUSED; sessions],
            pairs: vec![Pair::UNUSED; tasks],
            shares: vec![0.0; tasks],
            understood: vec![0.0; tasks],
            weights: vec![0.0; LAYER_WEIGHTS],
            ..Self::NONE
        }
    }
}

/// Half of the sessions can be left out of a training: every second one.
pub(in crate::language) const FOLDS: usize = 2;

/// The sessions that a training leaves out.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(in crate::language) struct LeftOut(Option<u8>);

impl LeftOut {
    /// No session.
    pub const NONE: Self = Self(None);
    /// The first part.
    pub const FIRST: Self = Self(Some(0));

    /// The next part; no session after the last part.
    pub fn next(self) -> Self {
        Self(self.0.map(|part| part.saturating_add(1)).filter(|&part| usize::from(part) < FOLDS))
    }

    /// The first session left out.
    pub fn first(self) -> Option<u16> {
        self.0.map(u16::from)
    }

    pub fn has(self, session: u16) -> bool {
        self.0.is_some_and(|part| usize::from(session) % FOLDS == usize::from(part))
    }
}

/// The least number of sessions for a layer: with fewer it understands less than the role model alone.
const LEAST_SESSIONS: usize = 8;

/// The layer for training, if there is memory for it.
#[derive(Debug)]
pub(in crate::language) struct Layer<'t> {
    pub room: Option<Room<'t>>,
}

impl<'t> Layer<'t> {
    /// The layer in `memory`, a slice with one element or none.
    pub fn new(memory: &'t mut [LayerMemory]) -> Self {
        Self { room: Room::new(memory) }
    }

    /// The sessions that the role model in training must not see.
    pub fn left_out(&self) -> LeftOut {
        self.room.as_ref().map_or(LeftOut::NONE, |room| *room.left_out)
    }

    /// Begins a training: the old weights are not used any more.
    pub fn begin(&mut self, settings: &Settings) {
        if let Some(room) = &mut self.room {
            let left_out = if room.is_wanted(settings) { LeftOut::FIRST } else { LeftOut::NONE };
            (room.learned.done, *room.left_out) = (false, left_out);
        }
    }

    /// Forgets the tasks of all sessions: another model may have used the memory before.
    pub fn clear(&mut self) {
        if let Some(room) = &mut self.room {
            room.clear();
        }
    }

    /// The tasks of all sessions.
    pub fn possible_mut(&mut self) -> Option<&mut Bitext<'t>> {
        self.room.as_mut().map(|room| &mut room.possible)
    }

    /// The read-only layer, if there is memory for it.
    pub const fn read(&self) -> Option<LayerRef<'_>> {
        match &self.room {
            Some(room) => Some(room.read()),
            None => None,
        }
    }
}

/// The layer in its memory.
#[derive(Debug)]
pub(in crate::language) struct Room<'t> {
    pub possible: Bitext<'t>,
    pub left_out: &'t mut LeftOut,
    pub(super) shares: &'t mut [f32],
    pub(super) understood: &'t mut [f32],
    pub(super) weights: &'t mut [f32],
    pub(super) learned: &'t mut Learned,
    pub(super) taught: &'t mut Vec<u32>,
    pub(super) network: &'t mut Network,
    pub(super) heard: &'t mut Vec<bool>,
    pub(super) found: &'t mut Found,
}

/// The read-only layer in its memory.
#[derive(Clone, Copy, Debug)]
pub(in crate::language) struct LayerRef<'t> {
    pub possible: BitextRef<'t>,
    pub(super) weights: &'t [f32],
    pub(super) learned: Learned,
    pub(super) taught: &'t [u32],
    pub(super) network: &'t Network,
}

impl<'t> LayerRef<'t> {
    /// The read-only layer in `memory`, a slice with one element or none.
    pub fn new(memory: &'t [LayerMemory]) -> Option<Self> {
        let memory = memory.first()?;
        let possible = BitextTablesRef {
            commands: &memory.commands,
            command_tokens: &memory.command_tokens,
            sessions: &memory.sessions,
            sentence_words: &[],
            pairs: &memory.pairs,
        };
        Some(Self {
            possible: BitextRef::new(possible, memory.used),
            weights: &memory.weights,
            learned: memory.learned,
            taught: &memory.taught,
            network: &memory.network,
        })
    }

    /// The tasks of all sessions.
    pub const fn possible(self) -> BitextRef<'t> {
        self.possible
    }
}

impl<'t> Room<'t> {
    fn new(memory: &'t mut [LayerMemory]) -> Option<Self> {
        let memory = memory.first_mut()?;
        let possible = BitextTables {
            commands: &mut memory.commands,
            command_tokens: &mut memory.command_tokens,
            sessions: &mut memory.sessions,
            sentence_words: &mut [],
            pairs: &mut memory.pairs,
        };
        Some(Self {
            possible: Bitext::new(possible, &mut memory.used),
            left_out: &mut memory.left_out,
            shares: &mut memory.shares,
            understood: &mut memory.understood,
            weights: &mut memory.weights,
            learned: &mut memory.learned,
            taught: &mut memory.taught,
            network: &mut memory.network,
            heard: &mut memory.heard,
            found: &mut memory.found,
        })
    }

    /// The same, read-only.
    pub const fn read(&self) -> LayerRef<'_> {
        LayerRef {
            possible: self.possible.read(),
            weights: self.weights,
            learned: *self.learned,
            taught: self.taught.as_slice(),
            network: self.network,
        }
    }

    /// Whether the layer is used and has enough sessions to train on.
    pub fn is_wanted(&self, settings: &Settings) -> bool {
        let is_on = settings.has_layer() && self.weights.len() >= LAYER_WEIGHTS;
        let layer = self.read();
        let teaches = |&session: &u16| layer.tasks(session) > 0;
        is_on && (0..layer.possible.sessions() as u16).filter(teaches).nth(LEAST_SESSIONS.saturating_sub(1)).is_some()
    }

    /// Adjusts the symbols after a machine token was removed. If a session's task uses it, the layer forgets all sessions and learns again
    /// from later ones.
    pub fn remove_token(&mut self, token: Symbol) {
        if self.possible.tokens_mut().contains(&token) {
            self.clear();
        }
        self.possible.tokens_mut().iter_mut().for_each(|other| close_up(other, token));
    }

    /// Forgets all sessions.
    pub fn clear(&mut self) {
        self.possible.rewind(Extent::NONE);
        self.learned.done = false;
    }
}
