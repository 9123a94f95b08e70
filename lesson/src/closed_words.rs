//! The tables of closed words that lessons and logs use.

use goodbot::talk::{ClosedWords, ClosedWordsError};
use std::sync::{Mutex, PoisonError};

/// The closed words of all languages.
pub const CLOSED_WORDS: ClosedWords<'static> = ClosedWords::ALL;

/// The other tables of closed words that lessons and logs use. Each text is kept once, until the program ends.
static TABLES: Mutex<Vec<&str>> = Mutex::new(Vec::new());

/// A table of closed words that is kept until the program ends.
///
/// # Errors
/// A [`ClosedWordsError`] if the text is no table.
pub fn kept_table(text: &str) -> Result<ClosedWords<'static>, ClosedWordsError<'_>> {
    ClosedWords::new(text)?;
    let mut tables = TABLES.lock().unwrap_or_else(PoisonError::into_inner);
    let known = tables.iter().find(|known| **known == text).copied();
    let kept = known.unwrap_or_else(|| {
        let kept: &'static str = Box::leak(text.into());
        tables.push(kept);
        kept
    });
    Ok(ClosedWords::new(kept).unwrap_or(ClosedWords::NONE))
}
