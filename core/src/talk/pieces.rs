//! The pieces of an utterance, and the words that they become: "llévalo" is "lleva" and "it".

use super::heard::{Heard, Utterance, is_unknown};
use super::slips::{SLIP, is_plural, slip_for};
use crate::capacity::WORDS_PER_COMMAND;
use crate::language::roles::talk::{is_name, is_of_task};
use crate::language::spelling::is_slip;
use crate::language::tokenizer::start_of_piece;
use crate::language::{LanguageRef, for_each_piece};
use crate::memory::AgentMemory;
use crate::session::{Agent, AgentError};
use crate::symbols::Symbol;
use crate::voice::classes::{Class, Classes, ClosedWords, cut};
use heapless::Vec;

/// The least bytes of a new verb before a pronoun.
const LEAST_VERB: usize = 3;

impl<M: AgentMemory> Agent<M> {
    /// The words of an utterance, with their classes.
    #[inline(never)]
    pub(super) fn hear_words(&self, utterance: &str, closed: ClosedWords<'_>, words: &mut Utterance) -> Result<(), AgentError> {
        let language = self.language.read(self.memory.read().language, self.memory.read().workspace.len());
        let mut signs: Vec<Option<char>, WORDS_PER_COMMAND> = Vec::new();
        for_each_piece(utterance, |piece| {
            let mut letters = piece.chars();
            let sign = letters.next().filter(|sign| !sign.is_ascii() && letters.next().is_none());
            let _ = signs.push(sign);
            Ok(())
        })?;
        let (mut of_word, mut number, mut start) = ((0, Classes::NONE), 0_usize, 0);
        for_each_piece(utterance, |piece| {
            let parts = elided(language, closed, piece);
            let (elided, text) = parts.unwrap_or(("", piece));
            let known = if parts.is_none() { self.sentence.get(number).copied().flatten() } else { language.words().find(text) };
            let ahead = signs.get(number..).unwrap_or(&[]);
            if of_word.0 == 0 {
                of_word = closed.of_signs(ahead).unwrap_or((1, closed.of(text)));
            }
            of_word.0 = usize::saturating_sub(of_word.0, 1);
            let next = start_of_piece(utterance, number).unwrap_or(start);
            let piece = Piece {
                text,
                symbol: known.filter(|&symbol| !is_first(words) || !is_slip_for_name(language, text, symbol)),
                classes: of_word.1,
                elided: closed.of(elided),
                before: utterance.get(start..next).unwrap_or(""),
                number: number as u8,
                is_sign: ahead.first().is_some_and(Option::is_some),
                has_room: words.len().saturating_add(ahead.len()) < WORDS_PER_COMMAND,
            };
            piece.hear(language, closed, words);
            (number, start) = (number.saturating_add(1), next);
            Ok(())
        })?;
        mark_present_place(words);
        mark_verbs_before_way(words);
        unmark_adjectives(words);
        Ok(())
    }
}

/// A piece of an utterance: letters between spaces, or one sign of a script without spaces.
struct Piece<'p> {
    /// Its letters, without an elided word.
    text: &'p str,
    symbol: Option<Symbol>,
    classes: Classes,
    /// The classes of the elided word in it: of "d" in "d'aller".
    elided: Classes,
    /// The piece before it, with the marks between them.
    before: &'p str,
    /// Its number in the utterance, from 0.
    number: u8,
    is_sign: bool,
    /// Whether the utterance may have one more word than it has pieces.
    has_room: bool,
}

impl Piece<'_> {
    /// Adds its words to those before it.
    fn hear(&self, language: LanguageRef<'_>, closed: ClosedWords<'_>, words: &mut Utterance) {
        let elided = Some(self.elided).filter(|&elided| elided != Classes::NONE && self.has_room);
        let elided = elided.map(|elided| Heard::new(language, None, elided));
        let (word, has_it) = self.word_and_it(language, closed, words.last());
        let it = has_it.then(|| Heard::joined(language));
        let phrase = words.last().map_or(0, |last| last.phrase.saturating_add(u8::from(self.before.contains(ends_phrase))));
        for word in [elided, word, it].into_iter().flatten() {
            let _ = words.push(Heard { piece: self.number, phrase, is_sign: self.is_sign, ..word });
        }
    }

    /// Its word, and whether the word "it" follows.
    fn word_and_it(&self, language: LanguageRef<'_>, closed: ClosedWords<'_>, last: Option<&Heard>) -> (Option<Heard>, bool) {
        // "Apporte-le".
        if self.classes.contains(Class::Clitic) && last.is_some_and(Heard::may_act) && is_joined(self.before) {
            return (None, true);
        }
        let mut heard = Heard::new(language, self.symbol, self.classes);
        // German adjectives have the endings of plurals: "grünen".
        let may_be_plural = heard.is_name && self.text.ends_with(['s', 'x']);
        heard.is_plural = may_be_plural && self.symbol.is_some_and(|symbol| is_plural(self.text, language.words().text(symbol)));
        if heard.is_new && self.has_room {
            // "Llévalo".
            if let Some((verb, has_it)) = verb_before_clitic(language, closed, self.text) {
                return (Some(Heard::new(language, Some(verb), Classes::NONE)), has_it);
            }
            // In "y súbela", a new verb.
            let ends_in_it = closed.ends(Class::Clitic, self.text).any(|verb| verb.len() >= LEAST_VERB);
            if last.is_some_and(|word| word.is(Class::Connective)) && ends_in_it {
                return (Some(heard), true);
            }
        }
        let may_be_cue = heard.is_new && !self.classes.contains(Class::Act) && slip_for(language, self.text, SLIP).is_none();
        (Some(if may_be_cue { Heard::new(language, self.symbol, closed.of_slip(self.text)) } else { heard }), false)
    }
}

/// Whether the next word is the first of a command, which names no thing: "range" in "range le panier" is no slip for "orange". "Alle Stühle"
/// has no verb.
fn is_first(before: &Utterance) -> bool {
    before.iter().all(|word| !word.is_open() && !word.is(Class::All))
}

/// Whether a word is a slip for a name, and no plural such as "chairs".
fn is_slip_for_name(language: LanguageRef<'_>, text: &str, symbol: Symbol) -> bool {
    let known = language.words().text(symbol);
    is_name(language.tables(), Some(symbol)) && is_slip(known, text) && !text.starts_with(known)
}

/// Marks words for the present place. After a word such as "stay" or "leave", "where it is" means here; "stay out of the red room" is about
/// no present place.
fn mark_present_place(words: &mut [Heard]) {
    if words.iter().any(|word| word.is_name) && words.iter().any(|word| word.is(Class::Out) && !word.leaves && !word.is(Class::Polite)) {
        words.iter_mut().for_each(|word| word.classes = word.classes.without(Class::Here));
        return;
    }
    let (mut stays, mut is_where) = (false, false);
    for word in words {
        stays |= word.leaves || word.is(Class::Here);
        is_where |= stays && word.is(Class::Asking);
        if is_where && word.is_any(&[Class::Asking, Class::Pronoun, Class::You]) {
            word.classes = Classes::of(Class::Here);
        }
    }
}

/// In "把篮子提到", the new sign before the direction is a verb.
fn mark_verbs_before_way(words: &mut [Heard]) {
    let mut is_named = false;
    for at in 0..words.len() {
        let Some([word, way]) = words.get_mut(at..).and_then(|words| words.first_chunk_mut::<2>()) else { break };
        if way.is_toward && way.is_sign && is_named && word.is_new {
            (word.is_new, word.is_of_task) = (false, true);
        }
        is_named |= word.is_name || word.is(Class::All);
    }
}

/// In "gelbes Zimmer", the ending is no plural's, because the noun has none.
fn unmark_adjectives(words: &mut [Heard]) {
    for at in 0..words.len() {
        let Some([word, noun]) = words.get_mut(at..).and_then(|words| words.first_chunk_mut::<2>()) else { break };
        word.is_plural &= noun.is_plural || !noun.is_noun();
    }
}

/// Whether a letter is a mark between phrases.
const fn ends_phrase(letter: char) -> bool {
    matches!(letter, ',' | '.' | ';' | ':' | '!' | '?' | '…' | '，' | '。' | '；' | '！' | '？' | '、')
}

/// Whether a hyphen joins a piece to the one before it.
fn is_joined(before: &str) -> bool {
    before.ends_with(['-', '\u{2010}', '\u{2011}'])
}

/// The elided word, and the one after it: "d" and "aller" of "d'aller". The longer part is the word: "you" in "you're".
pub(super) fn elided<'p>(language: LanguageRef<'_>, closed: ClosedWords<'_>, piece: &'p str) -> Option<(&'p str, &'p str)> {
    let (front, Some(back)) = cut(piece, b'\'') else { return None };
    let is_known = closed.of(piece) != Classes::NONE || !is_unknown(language, language.words().find(piece));
    let parts = if front.len() < back.len() { (front, back) } else { (back, front) };
    (!is_known).then_some(parts)
}

/// The verb in a word that ends in a pronoun, and whether that is "it": "llévalo" is "lleva" and "lo", "llévame" is "lleva". Accents do not
/// count.
fn verb_before_clitic(language: LanguageRef<'_>, closed: ClosedWords<'_>, word: &str) -> Option<(Symbol, bool)> {
    let plain = |letter: char| match letter {
        'á' => 'a',
        'é' => 'e',
        'í' => 'i',
        'ó' => 'o',
        'ú' => 'u',
        other => other,
    };
    let known = |verb: &str| {
        let is_verb = |known: &str| known.chars().map(plain).eq(verb.chars().map(plain));
        let (symbol, _) = language.words().iter().take(language.tables().words()).find(|&(_, known)| is_verb(known))?;
        is_of_task(language.tables(), Some(symbol)).then_some(symbol)
    };
    let before_polite = |front: &str| closed.ends(Class::Polite, front).find_map(known);
    let with_it = closed.ends(Class::Clitic, word).find_map(|front| known(front).or_else(|| before_polite(front)));
    with_it.map(|verb| (verb, true)).or_else(|| Some((before_polite(word)?, false)))
}

#[cfg(test)]
mod tests {
    use super::super::taught::for_each;

    #[test]
    fn an_adjective_before_a_singular_noun_is_no_plural() {
        let rows = [
            ("en", "take the chairs to the red room", true),
            ("fr", "apporte les chaises dans la salle rouge", true),
            ("de", "zuerst rotes Zimmer", false),
            ("de", "ein gelbes Zimmer", false),
        ];
        for_each(&rows, &|sentence, words, is_plural| {
            assert_eq!(words.any(&|word| word.is_plural), *is_plural, "{sentence}");
        });
    }

    #[test]
    fn a_phrase_has_a_number_of_its_own_after_any_number_of_marks() {
        for marks in [1, 3, 64, 192, 255, 256, 512] {
            let sentence = std::format!("not the yellow chair{} the purple bag, to the green room", "!".repeat(marks));
            for_each(&[("en", sentence.as_str(), ())], &|_, words, ()| {
                let phrases: std::vec::Vec<u8> = words.iter().map(|word| word.phrase).collect();
                assert_eq!(phrases, [0, 0, 0, 0, 1, 1, 1, 2, 2, 2, 2], "{marks} marks");
            });
        }
    }
}
