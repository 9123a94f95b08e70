//! Random numbers that go on elsewhere: a pickled agent or trainer draws what the first one would.

use pyo3::prelude::*;
use rand_core::{Rng, TryRng};
use rand_pcg::Pcg32;
use std::convert::Infallible;

/// The random numbers of a seed, and how many of 32 bits were drawn.
#[derive(Clone, Debug)]
pub struct Random {
    seed: u64,
    drawn: u64,
    numbers: Pcg32,
}

/// A seed, and how many numbers were drawn.
#[derive(Clone, Copy, Debug, FromPyObject, IntoPyObject)]
pub struct Drawn(u64, u64);

impl Random {
    pub fn new(seed: u64) -> Self {
        Self { seed, drawn: 0, numbers: goodbot_course::generator(seed) }
    }

    pub const fn drawn(&self) -> Drawn {
        Drawn(self.seed, self.drawn)
    }

    /// Goes on where others were.
    pub fn after(Drawn(seed, drawn): Drawn) -> Self {
        let mut random = Self { drawn, ..Self::new(seed) };
        random.numbers.advance(drawn);
        random
    }
}

impl TryRng for Random {
    type Error = Infallible;

    fn try_next_u32(&mut self) -> Result<u32, Infallible> {
        self.drawn = self.drawn.wrapping_add(1);
        Ok(self.numbers.next_u32())
    }

    fn try_next_u64(&mut self) -> Result<u64, Infallible> {
        self.drawn = self.drawn.wrapping_add(2);
        Ok(self.numbers.next_u64())
    }

    fn try_fill_bytes(&mut self, bytes: &mut [u8]) -> Result<(), Infallible> {
        self.drawn = self.drawn.wrapping_add(bytes.len().div_ceil(4) as u64);
        self.numbers.fill_bytes(bytes);
        Ok(())
    }
}
