//! New words taken for known ones: slips of the pen, and other words of direction, "towards" for "to".

use super::heard::{Heard, Utterance, count, is_unknown};
use super::pieces::elided;
use super::slips::{SLIP, is_plural, slip_for};
use crate::capacity::CapacityError;
use crate::language::roles::talk::is_name;
use crate::language::{LanguageRef, for_each_piece};
use crate::symbols::Symbol;
use crate::voice::classes::{Class, ClosedWords};

/// The probability that a word is mistyped beside another mistyped word.
const ANOTHER_SLIP: f32 = 0.15;

/// The factor of a word of direction ("to") other than the lessons' own.
const OTHER_WAY: f32 = 0.3;

/// Mends the words; returns whether that changed any.
pub(super) fn mend(
    language: LanguageRef<'_>,
    closed: ClosedWords<'_>,
    utterance: &str,
    words: &Utterance,
    mended: &mut Utterance,
) -> Result<bool, CapacityError> {
    mended.clone_from(words);
    let slips = mend_slips(language, closed, utterance, words, mended, SLIP)?;
    // Hasty typing affects a whole sentence.
    if slips > 1 {
        let _ = mend_slips(language, closed, utterance, words, mended, ANOTHER_SLIP)?;
    }
    let mut is_mended = slips > 0;
    for word in mended.iter_mut() {
        if let Some(usual) = as_usual_way(language, closed, word) {
            (*word, is_mended) = (usual, true);
        }
    }
    Ok(is_mended)
}

/// Replaces new words by the known words that they are slips for. Returns the number of slips.
fn mend_slips(
    language: LanguageRef<'_>,
    closed: ClosedWords<'_>,
    utterance: &str,
    words: &Utterance,
    mended: &mut Utterance,
    rate: f32,
) -> Result<usize, CapacityError> {
    // The first word is no slip for the name of a thing.
    let first = words.iter().position(|word| word.is_open() || word.is(Class::All));
    let (mut slips, mut number) = (0_usize, 0_usize);
    for_each_piece(utterance, |piece| {
        let text = elided(language, closed, piece).map_or(piece, |(_, word)| word);
        let at = words.iter().position(|word| usize::from(word.piece) == number && word.is_new);
        if let Some((word, slot)) = at.and_then(|at| words.get(at).zip(mended.get_mut(at)))
            && let Some((symbol, slip)) = slip_for(language, text, rate)
            && !(at == first && is_name(language.tables(), Some(symbol)))
            && !closed.of(text).contains(Class::Act)
        {
            slips = slips.saturating_add(1);
            *slot = word.mended(language, symbol, slip);
            slot.is_plural = slot.is_name && is_plural(text, language.words().text(symbol));
        }
        number = number.saturating_add(1);
        Ok(())
    })?;
    Ok(slips)
}

/// The lessons' own word of direction ("a") for a new one ("hasta").
fn as_usual_way(language: LanguageRef<'_>, closed: ClosedWords<'_>, word: &Heard) -> Option<Heard> {
    let Heard { piece, phrase, is_sign, is_toward, classes, factor, .. } = *word;
    if !is_toward || factor != 1.0 || !is_unknown(language, word.said.symbol) {
        return None;
    }
    let way = usual_way(language, closed)?;
    Some(Heard { piece, phrase, is_sign, is_toward, factor: OTHER_WAY, ..Heard::new(language, Some(way), classes) })
}

/// The most frequent word of direction in the lessons.
fn usual_way(language: LanguageRef<'_>, closed: ClosedWords<'_>) -> Option<Symbol> {
    let learned = language.words().iter().take(language.tables().words());
    let leads = |word: &str| closed.of(word).contains(Class::Toward);
    learned.filter(|(_, word)| leads(word)).map(|(symbol, _)| symbol).max_by_key(|&symbol| count(language.bitext(), symbol))
}
