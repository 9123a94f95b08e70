//! A number in a message.

use core::fmt;

/// The units per whole number: six decimal places.
const PARTS: u32 = 1_000_000;

/// A number with at most six decimal places. `core::fmt` for floats would take several kilobytes on a controller and in the page.
pub(crate) struct Decimal(pub f32);

impl fmt::Display for Decimal {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self(number) = *self;
        if number.is_nan() {
            return f.write_str("NaN");
        }
        if number.is_sign_negative() && number != 0.0 {
            f.write_str("-")?;
        }
        let size = number.abs();
        if size.is_infinite() {
            return f.write_str("inf");
        }
        // Numbers beyond a u32 are written as the largest u32.
        let whole = size as u32;
        let parts = ((size - whole as f32) * PARTS as f32 + 0.5) as u32;
        let (whole, mut parts) = if parts < PARTS { (whole, parts) } else { (whole.saturating_add(1), 0) };
        write!(f, "{whole}")?;
        if whole == u32::MAX || parts == 0 {
            return Ok(());
        }
        let mut places = 6;
        while parts.is_multiple_of(10) {
            (parts, places) = (parts / 10, places - 1);
        }
        write!(f, ".{parts:0places$}")
    }
}

#[cfg(test)]
mod tests {
    use super::Decimal;

    #[test]
    fn a_number_is_told_as_people_write_it() {
        let told = |number| std::format!("{}", Decimal(number));
        for (number, text) in
            [(0.0, "0"), (-0.1, "-0.1"), (1.5, "1.5"), (0.05, "0.05"), (12.25, "12.25"), (-3.0, "-3"), (1e6, "1000000"), (0.999_999_9, "1")]
        {
            assert_eq!(told(number), text);
        }
        assert_eq!([told(f32::NAN), told(f32::INFINITY), told(f32::NEG_INFINITY), told(1e20)], ["NaN", "inf", "-inf", "4294967295"]);
    }
}
