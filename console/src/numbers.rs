//! Numbers as they are typed, and what to say of those that are none.

/// A whole number of a range.
///
/// # Errors
/// What is wrong with the text, and what to give.
pub fn between(text: &str, least: usize, most: usize) -> Result<usize, String> {
    let number: Option<usize> = text.trim().parse().ok();
    number.filter(|number| (least..=most).contains(number)).ok_or_else(|| format!("give a whole number from {least} to {most}"))
}

/// A seed.
///
/// # Errors
/// What to give.
pub fn seed(text: &str) -> Result<u64, String> {
    text.trim().parse().map_err(|_| format!("give a whole number from 0 to {}", u64::MAX))
}
