//! A random generator from a seed.

use rand_pcg::Pcg32;

/// The generator of a seed. Neighbouring seeds give unrelated courses, and a seed gives the same course on every target.
pub fn generator(seed: u64) -> Pcg32 {
    Pcg32::new(mixed(seed), 0x2014)
}

/// SplitMix64's output function: every bit of the seed reaches every bit of the result.
fn mixed(seed: u64) -> u64 {
    let mut bits = seed.wrapping_add(0x9e37_79b9_7f4a_7c15);
    bits = (bits ^ (bits >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    bits = (bits ^ (bits >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    bits ^ (bits >> 31)
}
