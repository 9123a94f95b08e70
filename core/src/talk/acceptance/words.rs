//! The features of an utterance that its words tell: each word that no lesson had, its beginning, and each pair of neighbours with such a
//! word. "Paint" and "nip over to" stand before the same names, and only who has heard many people knows which of the two a robot can do.
//! In a pair each name is "#", because what is said beside one name is said beside any.
//!
//! A feature is known by a hash of its letters (Weinberger et al. 2009, *Feature hashing for large scale multitask learning*), so no text is
//! stored: 2 bytes for each feature that has weights, whatever its language.

use super::clues::KINDS_OF_WORDS as KINDS;
use super::weights::{BLOCKS, Weights};
use crate::capacity::WORDS_PER_COMMAND;
use crate::checksum::fnv;
use crate::language::tokenizer::start_of_piece;
use crate::language::{Word, for_each_piece};
use heapless::Vec;

/// The features' hashes are below this.
pub const HASHED: usize = BLOCKS * 256;

/// The letters of a beginning.
const LETTERS: usize = 4;
/// What stands before the first word.
const BORDER: &str = "^";
/// What stands for each name.
const NAME: &str = "#";
/// What stands before each word between two names, and before those that may turn the order of two commands, which are other features.
pub(in super::super) const BETWEEN: &str = "~";
pub(in super::super) const TURNING: &str = "<";
/// What stands before each word of a command about all things that is not near the name which tells it.
pub(in super::super) const FAR: &str = "*";

/// What stands before each word, if a task of another kind than the likeliest is meant.
pub(in super::super) const OTHER: &str = "+";

/// The words of an utterance.
#[derive(Clone, Copy)]
pub struct Spoken<'u> {
    utterance: &'u str,
    /// The pieces that lessons had, one bit each.
    taught: u64,
    /// The pieces that name something, one bit each.
    names: u64,
    /// What stands before each word.
    of: &'static str,
    /// The pieces before which [`FAR`] stands instead, one bit each.
    far: u64,
    weights: Weights<'u>,
    /// What all words say for each kind of reading, in units of [`Weights::scale_of_words`].
    says: [i16; KINDS],
}

impl<'u> Spoken<'u> {
    /// Of an utterance, and the numbers of its pieces that lessons had, each with whether it names something.
    pub(super) fn of(utterance: &'u str, weights: Weights<'u>, taught: impl Iterator<Item = (u8, bool)>) -> Self {
        let (mut all, mut names) = (0, 0);
        for (piece, is_name) in taught {
            let bit = bit(piece);
            all |= bit;
            names |= if is_name { bit } else { 0 };
        }
        Self { utterance, taught: all, names, of: "", far: 0, weights, says: [0; KINDS] }.weighed()
    }

    /// Of some pieces of the same utterance, with a sign before each of those that are near.
    pub(super) fn between(&self, pieces: impl Iterator<Item = (u8, bool)>, of: &'static str) -> Self {
        let (mut others, mut far) = (u64::MAX, 0);
        for (piece, is_near) in pieces {
            let bit = bit(piece);
            others &= !bit;
            far |= if is_near { 0 } else { bit };
        }
        Self { taught: self.taught | others, of, far, ..*self }.weighed()
    }

    /// With what they say.
    fn weighed(mut self) -> Self {
        let (mut says, mut heard) = ([0_i16; KINDS], Vec::<u32, WORDS_PER_COMMAND>::new());
        self.for_each(&mut |feature, _| {
            let weights = self.weights.of_word(feature);
            if weights == [0; KINDS] || heard.contains(&feature) {
                return;
            }
            // Beyond so many, a repetition counts again.
            let _ = heard.push(feature);
            for (sum, weight) in says.iter_mut().zip(weights) {
                *sum = sum.saturating_add(weight);
            }
        });
        self.says = says;
        self
    }

    /// The weights by which they are weighed.
    pub(super) const fn weights(&self) -> Weights<'u> {
        self.weights
    }

    /// The byte where a piece of the utterance begins.
    pub(super) fn place(&self, piece: usize) -> Option<usize> {
        start_of_piece(self.utterance, piece)
    }

    /// What the words say for a kind of reading, from 1: a part of its log odds.
    pub(super) fn says(&self, kind: usize) -> f32 {
        self.says.get(kind.saturating_sub(1)).map_or(0.0, |&sum| f32::from(sum) * self.weights.scale_of_words())
    }

    /// Passes each feature, by its hash below [`HASHED`], and the two texts that it consists of. One that occurs twice is passed twice, and
    /// counts once.
    pub fn for_each(&self, take: &mut dyn FnMut(u32, [&str; 2])) {
        let mut number = 0_u32;
        // The word before, and whether lessons had it; how a command begins, lessons have told.
        let (mut before, mut was_taught) = (Word::try_from(BORDER).ok(), true);
        let _ = for_each_piece(self.utterance, |piece| {
            let is_in = |pieces: u64| pieces.checked_shr(number).is_some_and(|pieces| pieces & 1 == 1);
            let (is_taught, is_name, is_far) = (is_in(self.taught), is_in(self.names), is_in(self.far));
            let mut take = |texts: [&str; 2]| take(hash(if is_far { FAR } else { self.of }, texts), texts);
            number = number.saturating_add(1);
            for word in piece.split('\'').filter(|word| !word.is_empty()) {
                let word = if is_name { NAME } else { word };
                if !is_taught {
                    take([word, ""]);
                    if let Some((end, _)) = word.char_indices().nth(LETTERS) {
                        take([word.get(..end).unwrap_or(word), "*"]);
                    }
                }
                if let Some(first) = before.as_ref().filter(|_| !(is_taught && was_taught)) {
                    take([first, word]);
                }
                (before, was_taught) = (Word::try_from(word).ok(), is_taught);
            }
            Ok(())
        });
    }
}

/// The bit of a piece; none beyond the last.
fn bit(piece: u8) -> u64 {
    1_u64.checked_shl(piece.into()).unwrap_or(0)
}

/// The hash of two texts with a blank between them, folded.
fn hash(of: &str, texts: [&str; 2]) -> u32 {
    let hash = fnv(of.bytes().map(u32::from).chain(texts.iter().flat_map(|text| text.bytes().chain([b' '])).map(u32::from)));
    (hash ^ hash >> 16) % HASHED as u32
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::string::String;

    fn features(utterance: &str, taught: &[u8]) -> std::vec::Vec<String> {
        let mut features = std::vec::Vec::new();
        Spoken::of(utterance, Weights::BUILT_IN, taught.iter().map(|&piece| (piece, piece == 4)))
            .for_each(&mut |_, texts| features.push(texts.join("~")));
        features
    }

    #[test]
    fn words_their_beginnings_and_pairs_are_features_unless_lessons_had_them() {
        let here = ["nip~", "^~nip", "over~", "nip~over", "to~", "over~to", "the~", "to~the", "the~#", "please~", "plea~*", "room~please"];
        assert_eq!(features("Nip over to the RED room, please", &[4, 5]), here);
        assert_eq!(features("don't", &[]), ["don~", "^~don", "t~", "don~t"]);
    }

    #[test]
    fn what_words_say_is_the_same_in_any_case_of_letters() {
        let kinds = |utterance| [1, 2, 3, 4].map(|kind| Spoken::of(utterance, Weights::BUILT_IN, [].into_iter()).says(kind));
        assert_eq!(kinds("Would you mind"), kinds("would YOU mind"));
        assert_ne!(kinds("would you mind"), [0.0; KINDS]);
        assert_eq!(kinds(""), [0.0; KINDS]);
        assert_eq!(kinds("please please please"), kinds("please please"));
    }
}
