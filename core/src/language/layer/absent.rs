//! What the other modules need to know of the layer where it is left out: it has no memory, so it learns nothing.

use super::bitext::{Bitext, BitextRef};
use super::settings::Settings;
use core::convert::Infallible;
use core::marker::PhantomData;

/// No memory.
#[derive(Clone, Copy, Debug)]
pub struct LayerMemory;

impl LayerMemory {
    /// No memory.
    pub const NONE: Self = Self;
}

/// The sessions that a training leaves out: none.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) struct LeftOut;

#[expect(clippy::unused_self, reason = "as with the layer")]
impl LeftOut {
    pub const NONE: Self = Self;

    pub const fn has(self, _session: u16) -> bool {
        false
    }
}

#[derive(Debug)]
pub(super) struct Above<'t>(PhantomData<&'t mut ()>);

#[expect(clippy::missing_const_for_fn, clippy::unused_self, reason = "as with the layer")]
impl<'t> Above<'t> {
    pub fn new(_: &'t mut [LayerMemory]) -> Self {
        Self(PhantomData)
    }

    pub fn left_out(&self) -> LeftOut {
        LeftOut
    }

    pub fn begin(&mut self, _: &Settings) {}

    pub fn clear(&mut self) {}

    pub fn possible_mut(&mut self) -> Option<&mut Bitext<'t>> {
        None
    }

    pub const fn read(&self) -> Option<AboveRef<'t>> {
        None
    }
}

/// There is none.
#[derive(Clone, Copy, Debug)]
pub(super) struct AboveRef<'t>(Infallible, PhantomData<&'t ()>);

impl<'t> AboveRef<'t> {
    pub const fn new(_: &'t [LayerMemory]) -> Option<Self> {
        None
    }

    pub const fn possible(self) -> BitextRef<'t> {
        match self.0 {}
    }
}
