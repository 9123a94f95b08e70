//! Repeated exact division by one number.

/// Exact division through a 32-bit reciprocal. It avoids the software division of small controllers such as Cortex-M0.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Divider {
    by: u64,
    /// 2^32 divided by the number, rounded up.
    inverse: u64,
    /// From this dividend on, the quotient from the reciprocal may be one too large.
    limit: u64,
}

impl Divider {
    /// Divides by `number`, or by 1 if that is 0.
    pub const fn new(number: usize) -> Self {
        let by = if number == 0 { 1 } else { number as u64 };
        // One division of 32 bits; a division of 64 bits would be linked for this alone.
        let most = if by > u32::MAX as u64 { 0 } else { u32::MAX / by as u32 } as u64;
        // Whether the number divides 2^32.
        let is_even = by.is_power_of_two() && by <= 1 << 32;
        Self { by, inverse: most.wrapping_add(1), limit: if is_even { most.wrapping_add(1) } else { most } }
    }

    /// Returns the quotient and the remainder.
    #[inline]
    pub const fn split(&self, number: u64) -> (u64, u64) {
        if number < self.limit {
            // Both factors have 32 bits, so one multiplication is enough.
            let quotient = if self.by == 1 { number } else { (number as u32 as u64 * (self.inverse as u32 as u64)) >> 32 };
            (quotient, number.wrapping_sub(quotient.wrapping_mul(self.by)))
        } else {
            divided(number, self.by)
        }
    }
}

#[cfg(not(target_os = "none"))]
const fn divided(number: u64, by: u64) -> (u64, u64) {
    // `by` is never 0, but the compiler does not know; a checked division keeps the panic message out of the program.
    match (number.checked_div(by), number.checked_rem(by)) {
        (Some(quotient), Some(rest)) => (quotient, rest),
        _ => (0, 0),
    }
}

/// Bit by bit: no home in a controller's memory has so many states, and a division of 64 bits takes half a kilobyte of flash.
#[cfg(any(test, target_os = "none"))]
#[inline(never)]
const fn bit_by_bit(number: u64, by: u64) -> (u64, u64) {
    let (mut quotient, mut rest, mut bit) = (0_u64, 0_u64, 64_u32);
    while bit > 0 {
        bit = bit.wrapping_sub(1);
        let is_long = rest >> 63 == 1;
        rest = rest << 1 | number.wrapping_shr(bit) & 1;
        quotient <<= 1;
        if is_long || rest >= by {
            (quotient, rest) = (quotient | 1, rest.wrapping_sub(by));
        }
    }
    (quotient, rest)
}
#[cfg(target_os = "none")]
use bit_by_bit as divided;

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn quotient_and_rest_are_those_of_a_division() {
        for by in [0, 1, 2, 3, 7, 41, 50, 1_024, 65_534, 65_537, usize::MAX] {
            let (divider, least) = (Divider::new(by), by.max(1) as u64);
            let limit = (1 << 32) / least;
            assert_eq!((divider.inverse, divider.limit), ((1_u64 << 32).div_ceil(least), limit), "by {by}");
            let near = [0, 1, least, limit, limit / least * least, limit / 2 / least * least, 1 << 32, u64::MAX];
            for number in near.into_iter().flat_map(|number| [number.saturating_sub(1), number, number.saturating_add(1)]) {
                let divided = (number / least, number % least);
                assert_eq!(divider.split(number), divided, "{number} / {by}");
                assert_eq!(bit_by_bit(number, least), divided, "{number} / {by} on a controller");
            }
        }
    }
}
