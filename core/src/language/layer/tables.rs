//! The memory of the layer. Without the feature `layer` it has no bytes.

#[cfg(feature = "layer")]
use super::weights::CELLS;
#[cfg(feature = "layer")]
use crate::language::bitext::{Bitext, BitextRef, BitextTables, BitextTablesRef, Extent};
#[cfg(feature = "layer")]
use crate::language::settings::{Model, Settings};
#[cfg(feature = "layer")]
use crate::language::forgetting::close_up;
#[cfg(feature = "layer")]
use crate::symbols::Symbol;
use core::marker::PhantomData;

/// How many numbers the layer learns, three times: each weight, its slope, and the sum of the squares of its slopes.
#[cfg(feature = "layer")]
pub const LAYER_WEIGHTS: usize = 3 * CELLS;

/// The tables of the layer.
#[derive(Debug, Default)]
pub struct LayerTables<'t> {
    /// The tasks of all sessions: each session's machine commands, and the prior of each in place of its weight. The sessions have no words.
    #[cfg(feature = "layer")]
    pub possible: BitextTables<'t>,
    /// One entry a pair of `possible`: the share that the session showed of it.
    #[cfg(feature = "layer")]
    pub shares: &'t mut [f32],
    /// One entry a pair of `possible`: its posterior by a role model that has not seen the session.
    #[cfg(feature = "layer")]
    pub understood: &'t mut [f32],
    /// [`LAYER_WEIGHTS`] numbers.
    #[cfg(feature = "layer")]
    pub weights: &'t mut [f32],
    /// Nothing.
    pub lent: PhantomData<&'t mut ()>,
}

/// The tables of the layer, to be read.
#[derive(Clone, Copy, Debug, Default)]
pub struct LayerTablesRef<'t> {
    /// The tasks of all sessions.
    #[cfg(feature = "layer")]
    pub possible: BitextTablesRef<'t>,
    /// What was learned.
    #[cfg(feature = "layer")]
    pub weights: &'t [f32],
    /// Nothing.
    pub lent: PhantomData<&'t ()>,
}

impl LayerTables<'_> {
    /// The same tables, lent for a shorter time.
    pub fn lend(&mut self) -> LayerTables<'_> {
        LayerTables {
            #[cfg(feature = "layer")]
            possible: self.possible.lend(),
            #[cfg(feature = "layer")]
            shares: self.shares,
            #[cfg(feature = "layer")]
            understood: self.understood,
            #[cfg(feature = "layer")]
            weights: self.weights,
            lent: PhantomData,
        }
    }

    /// The same tables, to be read.
    pub const fn read(&self) -> LayerTablesRef<'_> {
        LayerTablesRef {
            #[cfg(feature = "layer")]
            possible: self.possible.read(),
            #[cfg(feature = "layer")]
            weights: self.weights,
            lent: PhantomData,
        }
    }
}

/// All of the layer that is not in its tables.
#[derive(Clone, Copy, Debug)]
pub(in crate::language) struct LayerState {
    #[cfg(feature = "layer")]
    possible: Extent,
    #[cfg(feature = "layer")]
    learned: Learned,
}

/// What a training left.
#[cfg(feature = "layer")]
#[derive(Clone, Copy, Debug)]
pub(super) struct Learned {
    /// Whether the weights are trained.
    pub done: bool,
    /// How many words were said in the sessions trained on.
    pub said: f32,
}

impl LayerState {
    /// Nothing was learned.
    pub const NEW: Self = Self {
        #[cfg(feature = "layer")]
        possible: Extent::NONE,
        #[cfg(feature = "layer")]
        learned: Learned { done: false, said: 0.0 },
    };

    /// The layer in its tables.
    pub fn with<'t>(&'t mut self, tables: LayerTables<'t>) -> Layer<'t> {
        Layer {
            #[cfg(feature = "layer")]
            possible: Bitext::new(tables.possible, &mut self.possible),
            #[cfg(feature = "layer")]
            shares: tables.shares,
            #[cfg(feature = "layer")]
            understood: tables.understood,
            #[cfg(feature = "layer")]
            weights: tables.weights,
            #[cfg(feature = "layer")]
            learned: &mut self.learned,
            lent: tables.lent,
            state: PhantomData,
        }
    }

    /// The layer in its tables, to be read.
    #[cfg(feature = "layer")]
    pub const fn read<'t>(&'t self, tables: LayerTablesRef<'t>) -> LayerRef<'t> {
        LayerRef {
            possible: BitextRef::new(tables.possible, self.possible),
            weights: tables.weights,
            learned: self.learned,
        }
    }
}

/// The layer, to be taught.
#[derive(Debug)]
pub(in crate::language) struct Layer<'t> {
    #[cfg(feature = "layer")]
    pub possible: Bitext<'t>,
    #[cfg(feature = "layer")]
    pub(super) shares: &'t mut [f32],
    #[cfg(feature = "layer")]
    pub(super) understood: &'t mut [f32],
    #[cfg(feature = "layer")]
    pub(super) weights: &'t mut [f32],
    #[cfg(feature = "layer")]
    pub(super) learned: &'t mut Learned,
    lent: PhantomData<&'t mut ()>,
    state: PhantomData<&'t mut LayerState>,
}

/// The layer, to be read.
#[cfg(feature = "layer")]
#[derive(Clone, Copy, Debug)]
pub(in crate::language) struct LayerRef<'t> {
    pub possible: BitextRef<'t>,
    pub(super) weights: &'t [f32],
    pub(super) learned: Learned,
}

impl Layer<'_> {
    /// Before a training: what was learned says nothing any more.
    #[cfg_attr(not(feature = "layer"), expect(clippy::unused_self, clippy::missing_const_for_fn, reason = "as with the feature"))]
    pub fn begin(&mut self) {
        #[cfg(feature = "layer")]
        {
            self.learned.done = false;
        }
    }
}

#[cfg(feature = "layer")]
impl Layer<'_> {
    /// The layer, to be read.
    pub const fn read(&self) -> LayerRef<'_> {
        LayerRef { possible: self.possible.read(), weights: self.weights, learned: *self.learned }
    }

    /// Whether there is something to train it on. A single session leaves none for the model that has not seen it.
    pub fn is_wanted(&self, settings: &Settings, sessions: usize) -> bool {
        settings.layer && settings.model.in_use() == Model::Roles && sessions > 1 && self.weights.len() >= LAYER_WEIGHTS && !self.possible.read().pairs().is_empty()
    }

    /// A machine token is forgotten, and those after it move up by one. Where a session's task has it, the layer forgets all sessions: it
    /// learns anew from those to come.
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
