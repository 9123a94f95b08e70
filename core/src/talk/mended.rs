//! New words taken for known ones: slips of the pen, a synonym of the noun that lessons put beside names, "chamber" for "room", and other
//! words of direction, "towards" for "to".

use super::classes::{Class, ClosedWords};
use super::heard::{Heard, Utterance, count, is_unknown};
use super::pieces::elided;
use super::slips::{SLIP, is_plural, slip_for};
use crate::capacity::CapacityError;
use crate::language::roles::talk::{is_name, is_of_task};
use crate::language::{LanguageRef, for_each_piece};
use crate::symbols::Symbol;

/// The probability that a word is mistyped beside another mistyped word.
const ANOTHER_SLIP: f32 = 0.15;
/// In tenths: the least number of mentions of the noun per lesson, and the least share of mentions beside a name.
const MOST: usize = 8;
/// The likelihood ratio of a new word as such a synonym, against a word of another meaning.
const RENAMED: f32 = 0.1;

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
    for at in 0..mended.len() {
        let noun = renamed(language, mended, at);
        if let Some((noun, word)) = noun.zip(mended.get_mut(at)) {
            (*word, is_mended) = (word.mended(language, noun, RENAMED), true);
        }
    }
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

/// The lessons' noun that a new word may replace, if a name is beside it on the same side, and the utterance does not have the noun.
fn renamed(language: LanguageRef<'_>, words: &Utterance, at: usize) -> Option<Symbol> {
    // "I want a new blue car" has no act word.
    if !words.get(at)?.is_new || words.iter().any(|word| word.is(Class::Wish)) {
        return None;
    }
    let is_said = |symbol| words.iter().any(|word| word.said.symbol == Some(symbol));
    let sides = [(at.wrapping_sub(1), true), (at.wrapping_add(1), false)].into_iter();
    sides.filter(|&(beside, _)| words.get(beside).is_some_and(|word| word.is_name)).find_map(|(_, is_behind)| {
        let mut learned = (0..language.tables().words()).map(|word| Symbol(word as u16));
        learned.find(|&symbol| !is_said(symbol) && is_noun_of_names(language, symbol, is_behind))
    })
}

/// Whether most lessons have this word, and most often after a name, or before one.
fn is_noun_of_names(language: LanguageRef<'_>, noun: Symbol, is_behind: bool) -> bool {
    let (tables, bitext) = (language.tables(), language.bitext());
    let (sessions, mentions) = (bitext.sessions(), count(bitext, noun));
    if mentions == 0 || mentions.saturating_mul(10) < sessions.saturating_mul(MOST) || is_name(tables, Some(noun)) {
        return false;
    }
    let mut with_name = 0_usize;
    for session in 0..sessions as u16 {
        for pair in bitext.sentence(session).windows(2) {
            let &[before, behind] = pair else { continue };
            let (name, word) = if is_behind { (before, behind) } else { (behind, before) };
            with_name = with_name.saturating_add(usize::from(word == noun && is_name(tables, Some(name))));
        }
    }
    with_name.saturating_mul(10) >= mentions.saturating_mul(MOST) && !is_of_task(tables, Some(noun))
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
