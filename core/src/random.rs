//! Random draws from the caller's generator, the same on every machine.

use rand_core::Rng;

/// A number in [0, 1), in steps of 2^-24.
pub fn unit<R: Rng + ?Sized>(random: &mut R) -> f32 {
    (random.next_u32() >> 8) as f32 * (1.0 / 16_777_216.0)
}

/// A number below `count`, all about equally probable; 0 if `count` is 0.
pub fn below<R: Rng + ?Sized>(count: usize, random: &mut R) -> usize {
    ((u64::from(random.next_u32()) * count.min(u32::MAX as usize) as u64) >> 32) as usize
}
