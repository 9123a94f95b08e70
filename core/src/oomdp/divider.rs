//! Repeated exact division by one number.

/// Exact division through a 32-bit reciprocal. It avoids the software division of small controllers such as Cortex-M0.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Divider {
    by: u32,
    /// 2^32 divided by the number, rounded up.
    inverse: u64,
    /// From this dividend on, the quotient from the reciprocal may be one too large.
    limit: u64,
}

impl Divider {
    /// Divides by `number`, or by 1 if that is 0.
    pub const fn new(number: u16) -> Self {
        let by = if number == 0 { 1 } else { number as u32 };
        let most = u32::MAX / by;
        let inverse = (most as u64).wrapping_add(1);
        // A power of two divides 2^32.
        Self { by, inverse, limit: if by.is_power_of_two() { inverse } else { most as u64 } }
    }

    /// Returns the quotient and the remainder.
    #[inline]
    pub const fn split(&self, number: u64) -> (u64, u64) {
        if number < self.limit {
            // Both factors have 32 bits, so one multiplication is enough.
            let quotient = if self.by == 1 { number } else { (number as u32 as u64 * (self.inverse as u32 as u64)) >> 32 };
            (quotient, number.wrapping_sub(quotient.wrapping_mul(self.by as u64)))
        } else {
            self.divided(number)
        }
    }

    /// Divides by hand, 16 bits at a time: a controller divides 32 bits at once, and a division of 64 bits takes half a kilobyte of flash.
    #[inline(never)]
    const fn divided(&self, number: u64) -> (u64, u64) {
        let (mut quotient, mut rest, mut digits) = (0_u64, 0_u32, 4_u32);
        while digits > 0 {
            digits = digits.wrapping_sub(1);
            let part = rest << 16 | number.wrapping_shr(digits.wrapping_mul(16)) as u16 as u32;
            // The divisor is never 0, but the compiler does not know; a checked division keeps the panic message out of the program.
            let digit = match part.checked_div(self.by) {
                Some(digit) => digit,
                None => 0,
            };
            (quotient, rest) = (quotient << 16 | digit as u64, part.wrapping_sub(digit.wrapping_mul(self.by)));
        }
        (quotient, rest as u64)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn quotient_and_rest_are_those_of_a_division() {
        for by in [0, 1, 2, 3, 7, 41, 50, 1_024, 65_534, u16::MAX] {
            let (divider, least) = (Divider::new(by), u64::from(by.max(1)));
            let limit = (1 << 32) / least;
            assert_eq!((divider.inverse, divider.limit), ((1_u64 << 32).div_ceil(least), limit), "by {by}");
            let near = [0, 1, least, limit, limit / least * least, limit / 2 / least * least, 1 << 32, u64::MAX];
            for number in near.into_iter().flat_map(|number| [number.saturating_sub(1), number, number.saturating_add(1)]) {
                let divided = (number / least, number % least);
                assert_eq!(divider.split(number), divided, "{number} / {by}");
                assert_eq!(divider.divided(number), divided, "{number} / {by} by hand");
            }
        }
    }
}
