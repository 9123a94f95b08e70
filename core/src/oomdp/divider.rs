//! Exact division by one number, again and again.

/// Exact division through a 32-bit reciprocal. It avoids the software division of small controllers such as Cortex-M0.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Divider {
    by: u64,
    /// 2^32 divided by the number, rounded up.
    inverse: u64,
    /// From this dividend on, the product with the reciprocal may be one too large.
    limit: u64,
}

impl Divider {
    /// Divides by `number`, or by 1 where that is 0.
    pub const fn new(number: usize) -> Self {
        let by = if number == 0 { 1 } else { number as u64 };
        Self { by, inverse: (1_u64 << 32).div_ceil(by), limit: (1_u64 << 32) / by }
    }

    /// Returns the quotient and the remainder.
    #[inline]
    pub const fn split(&self, number: u64) -> (u64, u64) {
        if number < self.limit {
            // Both factors have 32 bits, so one multiplication is enough.
            let quotient = if self.by == 1 { number } else { (number as u32 as u64 * (self.inverse as u32 as u64)) >> 32 };
            (quotient, number.wrapping_sub(quotient.wrapping_mul(self.by)))
        } else {
            // `by` is never 0, but the compiler does not know; a checked division keeps the panic message out of the program.
            match (number.checked_div(self.by), number.checked_rem(self.by)) {
                (Some(quotient), Some(rest)) => (quotient, rest),
                _ => (0, 0),
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn quotient_and_rest_are_those_of_a_division() {
        for by in [0, 1, 2, 3, 7, 41, 50, 1_024, 65_534, 65_537, usize::MAX] {
            let (divider, least) = (Divider::new(by), by.max(1) as u64);
            let limit = (1 << 32) / least;
            let near = [0, 1, least, limit, limit / least * least, limit / 2 / least * least, 1 << 32, u64::MAX];
            for number in near.into_iter().flat_map(|number| [number.saturating_sub(1), number, number.saturating_add(1)]) {
                assert_eq!(divider.split(number), (number / least, number % least), "{number} / {by}");
            }
        }
    }
}
