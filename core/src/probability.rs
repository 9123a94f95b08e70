//! Probabilities that never underflow, computed with `+ - * /` alone.
//!
//! The probability of a long command, or of the feedback of a long session, is a product of many small factors: far below the smallest f32.
//! A [`Scaled`] has a mantissa and a separate power of two. Powers of two are exact, so rescaling loses nothing, and no logarithm is
//! needed: the same input gives the same bits on every target.

/// A non-negative number `mantissa * 2^exponent`, the mantissa in [0.5, 1) or 0.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Scaled {
    mantissa: f32,
    exponent: i32,
}

impl Scaled {
    /// The number 0.
    pub const ZERO: Self = Self { mantissa: 0.0, exponent: 0 };
    /// The number 1.
    pub const ONE: Self = Self { mantissa: 0.5, exponent: 1 };

    /// The scaled form of `value`; zero for negative numbers and NaN, the largest f32 for infinity.
    pub fn new(value: f32) -> Self {
        Self { mantissa: value, exponent: 0 }.normalised()
    }

    /// e^x of an x of at most 0, also where no f32 is so small; x is limited to -10,000. Zero for negative infinity and NaN.
    pub(crate) fn exp(x: f32) -> Self {
        const PART: f32 = 64.0;
        if x.is_nan() || x < f32::MIN {
            return Self::ZERO;
        }
        let (mut power, mut left) = (Self::ONE, x.max(-10_000.0));
        while left < -PART {
            power = power.scaled_by(libm::expf(-PART));
            left += PART;
        }
        // Not by `exp` below: with one more caller it would be compiled larger where it is in every robot.
        power.scaled_by(libm::expf(left))
    }

    /// Normalises the mantissa. Numbers are compared by their bits, as everywhere here: the bits of non-negative f32s have the same order,
    /// and a processor without floats compares them fast.
    #[inline(never)]
    fn normalised(self) -> Self {
        let (mut bits, mut exponent) = (self.mantissa.to_bits(), self.exponent);
        // Zero, negative numbers and NaN.
        if bits == 0 || bits > f32::INFINITY.to_bits() {
            return Self::ZERO;
        }
        bits = bits.min(f32::MAX.to_bits());
        if bits < f32::MIN_POSITIVE.to_bits() {
            bits = (self.mantissa * 16_777_216.0).to_bits();
            exponent = exponent.saturating_sub(24);
        }
        let biased = (bits >> 23) as i32;
        Self { mantissa: f32::from_bits((bits & 0x007f_ffff) | 0x3f00_0000), exponent: exponent.saturating_add(biased.saturating_sub(126)) }
    }

    /// Whether it is exactly zero.
    pub fn is_zero(self) -> bool {
        self.mantissa.to_bits() == 0
    }

    /// The product.
    pub fn times(self, other: Self) -> Self {
        Self { mantissa: self.mantissa * other.mantissa, exponent: self.exponent.saturating_add(other.exponent) }.normalised()
    }

    /// The product with a plain factor.
    #[inline(never)]
    pub fn scaled_by(self, factor: f32) -> Self {
        // If the product stays within the range of an f32, the factor need not be normalised: the bits are the same.
        if (1.0e-30_f32.to_bits()..=1.0e30_f32.to_bits()).contains(&factor.to_bits()) {
            return Self { mantissa: self.mantissa * factor, ..self }.normalised();
        }
        self.times(Self::new(factor))
    }

    /// The sum.
    #[inline(never)]
    pub fn plus(self, other: Self) -> Self {
        if self.is_zero() {
            return other;
        }
        if other.is_zero() {
            return self;
        }
        let (large, small) = if self.exponent < other.exponent { (other, self) } else { (self, other) };
        let below = large.exponent.saturating_sub(small.exponent).cast_unsigned();
        // A summand below half a unit in the last place changes nothing.
        if below > f32::MANTISSA_DIGITS.wrapping_add(1) {
            return large;
        }
        let small = f32::from_bits(small.mantissa.to_bits().wrapping_sub(below << 23));
        Self { mantissa: large.mantissa + small, ..large }.normalised()
    }

    /// The ratio; 0 if `other` is 0.
    pub fn divided_by(self, other: Self) -> Self {
        if other.is_zero() {
            return Self::ZERO;
        }
        Self { mantissa: self.mantissa / other.mantissa, exponent: self.exponent.saturating_sub(other.exponent) }.normalised()
    }

    /// The ratio `self / whole` as an f32; 0 if the whole is 0.
    #[inline(never)]
    pub fn over(self, whole: Self) -> f32 {
        if whole.is_zero() || self.is_zero() {
            return 0.0;
        }
        (self.mantissa / whole.mantissa) * power_of_two(self.exponent.saturating_sub(whole.exponent))
    }

    /// The square root.
    pub(crate) fn square_root(self) -> Self {
        let (mantissa, exponent) =
            if self.exponent & 1 == 0 { (self.mantissa, self.exponent) } else { (self.mantissa * 2.0, self.exponent.saturating_sub(1)) };
        Self { mantissa: square_root(mantissa), exponent: exponent / 2 }.normalised()
    }

    /// The number as an f32, 0 if it is too small for one.
    pub fn value(self) -> f32 {
        self.mantissa * power_of_two(self.exponent)
    }

    /// Whether this is more than `other`.
    pub fn exceeds(self, other: Self) -> bool {
        if self.is_zero() || other.is_zero() || self.exponent == other.exponent {
            return self.mantissa.to_bits() > other.mantissa.to_bits();
        }
        self.exponent > other.exponent
    }
}

/// e^x by a polynomial and a power of two, within a few units in the last place; x is limited to the range of an f32.
#[doc(hidden)]
pub fn exp(x: f32) -> f32 {
    const LOG2_E: f32 = core::f32::consts::LOG2_E;
    // ln 2 in two parts, the first with few bits, so that its multiples are exact.
    const LN_2: [f32; 2] = [0.693_359_4, -2.121_944_4e-4];
    let x = if x.is_nan() { 0.0 } else { x.clamp(-87.0, 87.0) };
    let scaled = x * LOG2_E;
    let power = (if scaled < 0.0 { scaled - 0.5 } else { scaled + 0.5 }) as i32;
    let [high, low] = LN_2;
    let r = x - power as f32 * high - power as f32 * low;
    let series = [1.0 / 720.0, 1.0 / 120.0, 1.0 / 24.0, 1.0 / 6.0, 0.5, 1.0, 1.0];
    series.iter().fold(0.0, |sum, part| sum * r + part) * power_of_two(power)
}

/// The square root by Newton's method; 0 for negative numbers and NaN. It differs from `libm::sqrtf` by one unit in the last place for a
/// quarter of all mantissas; a replacement would change the role model's parameters, and all published figures.
#[doc(hidden)]
pub fn square_root(x: f32) -> f32 {
    if x.is_nan() || x <= 0.0 {
        return 0.0;
    }
    root(x)
}

/// The same for a positive number. It has no branch, so the compiler can compute several at once.
#[inline]
#[doc(hidden)]
pub fn root(x: f32) -> f32 {
    let x = x.clamp(f32::MIN_POSITIVE, f32::MAX);
    // Halving the exponent gives a start within a few hundredths.
    let mut root = f32::from_bits((x.to_bits() >> 1).wrapping_add(0x1fbb_4f2e));
    for _ in 0..3 {
        root = 0.5 * (root + x / root);
    }
    root
}

/// 2^exponent, 0 below the normal range and the largest power above it.
fn power_of_two(exponent: i32) -> f32 {
    if exponent < -126 {
        return 0.0;
    }
    f32::from_bits((exponent.min(127).saturating_add(127) as u32) << 23)
}

/// The sum of `parts`.
pub fn total(parts: impl Iterator<Item = Scaled>) -> Scaled {
    parts.fold(Scaled::ZERO, Scaled::plus)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn roots_and_powers_are_as_exact_as_single_precision_allows() {
        for step in -400..=400 {
            let x = step as f32 * 0.2;
            let wanted = f64::from(x).exp();
            assert!((f64::from(exp(x)) / wanted - 1.0).abs() < 4e-7, "{x}");
            let y = exp(x);
            assert!((f64::from(square_root(y)) / f64::from(y).sqrt() - 1.0).abs() < 2e-7, "{y}");
        }
        assert_eq!((exp(f32::NAN), square_root(f32::NAN), square_root(-1.0)), (1.0, 0.0, 0.0));
        let small = (0..1_000).fold(Scaled::ONE, |product, _| product.scaled_by(0.25));
        let half = (0..1_000).fold(Scaled::ONE, |product, _| product.scaled_by(0.5));
        assert_eq!((small.square_root().over(half), Scaled::ZERO.square_root()), (1.0, Scaled::ZERO));
    }

    #[test]
    fn a_power_of_e_may_be_smaller_than_any_f32() {
        assert_eq!(Scaled::exp(0.0), Scaled::ONE);
        for x in [-1.0, -64.0, -65.0, -1_000.0, -5_000.0] {
            let ratio = f64::from(Scaled::exp(x - 1.0).over(Scaled::exp(x)));
            assert!((ratio * 1_f64.exp() - 1.0).abs() < 1e-5, "{x}: {ratio}");
        }
        assert_eq!(Scaled::exp(f32::MIN), Scaled::exp(-10_000.0));
        assert!(!Scaled::exp(f32::MIN).is_zero());
        assert_eq!([f32::NEG_INFINITY, f32::NAN].map(Scaled::exp), [Scaled::ZERO; 2]);
    }

    #[test]
    fn a_product_of_ten_thousand_small_factors_keeps_its_ratios() {
        let long = |factor: f32| (0..10_000).fold(Scaled::ONE, |product, _| product.scaled_by(factor));
        let (small, smaller) = (long(0.001), long(0.001).scaled_by(0.25));
        assert!(!small.is_zero());
        assert_eq!(smaller.over(small), 0.25);
        assert_eq!(smaller.over(small.plus(smaller)), 0.2);
    }

    #[test]
    fn what_is_no_probability_counts_as_nothing() {
        assert!(Scaled::new(f32::NAN).is_zero());
        assert!(Scaled::new(-1.0).is_zero());
        assert!(Scaled::new(f32::INFINITY).value().is_finite());
    }

    #[test]
    fn subnormal_numbers_are_kept() {
        let tiny = f32::MIN_POSITIVE / 8.0;
        assert_eq!(Scaled::new(tiny).over(Scaled::new(tiny * 2.0)), 0.5);
    }

    #[test]
    fn order_is_the_order_of_the_numbers() {
        let numbers = [0.0, 1e-30, 0.4, 0.5, 0.75, 3.0];
        for (i, &a) in numbers.iter().enumerate() {
            for (j, &b) in numbers.iter().enumerate() {
                assert_eq!(Scaled::new(a).exceeds(Scaled::new(b)), i > j, "{a} {b}");
            }
        }
    }
}
