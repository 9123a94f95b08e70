//! Some of the words of an utterance, in order. A reading of an utterance is such a selection, and needs no copy of the words.

use super::heard::Heard;
use crate::capacity::WORDS_PER_COMMAND;
use crate::voice::classes::Class;

/// Some of the words of an utterance, in order: one bit each.
#[derive(Clone, Copy)]
pub(super) struct Words<'w> {
    all: &'w [Heard],
    kept: u64,
    /// Whether a question mark ends them.
    pub is_asked: bool,
}

const _: () = assert!(WORDS_PER_COMMAND <= u64::BITS as usize);

impl<'w> Words<'w> {
    /// No words.
    pub const NONE: Self = Self { all: &[], kept: 0, is_asked: false };

    pub const fn new(all: &'w [Heard], is_asked: bool) -> Self {
        Self { all, kept: u64::MAX, is_asked }
    }

    pub const fn iter(self) -> Iter<'w> {
        Iter { words: self, passed: 0 }
    }

    pub fn len(self) -> usize {
        self.iter().count()
    }

    pub fn is_empty(self) -> bool {
        self.iter().next().is_none()
    }

    pub fn get(self, at: usize) -> Option<&'w Heard> {
        self.iter().nth(at)
    }

    /// The position of the first such word.
    #[inline(never)]
    pub fn position(self, is_wanted: &dyn Fn(&Heard) -> bool) -> Option<usize> {
        self.iter().position(is_wanted)
    }

    /// The position of the last such word.
    #[inline(never)]
    pub fn last(self, is_wanted: &dyn Fn(&Heard) -> bool) -> Option<usize> {
        self.iter().enumerate().filter_map(|(at, word)| is_wanted(word).then_some(at)).last()
    }

    /// Whether there is such a word.
    pub fn any(self, is_wanted: &dyn Fn(&Heard) -> bool) -> bool {
        self.position(is_wanted).is_some()
    }

    /// Whether a word is of a class.
    pub fn has(self, class: Class) -> bool {
        self.any(&|word| word.is(class))
    }

    /// Whether a word names a value.
    pub fn has_name(self) -> bool {
        self.any(&|word| word.is_name)
    }

    /// The position of the last name.
    pub fn last_name(self) -> Option<usize> {
        self.last(&|word| word.is_name)
    }

    /// Whether a word tells a direction.
    pub fn has_way(self) -> bool {
        self.any(&|word| word.is_toward)
    }

    /// The words for which `is_wanted` holds; it is called once for each, in order.
    pub fn only(self, mut is_wanted: impl FnMut(&Heard) -> bool) -> Self {
        self.keep(&mut is_wanted)
    }

    #[inline(never)]
    fn keep(self, is_wanted: &mut dyn FnMut(&Heard) -> bool) -> Self {
        let mut kept = 0;
        for (at, word) in self.all.iter().enumerate().filter(|&(at, _)| self.kept >> at & 1 == 1) {
            kept |= u64::from(is_wanted(word)) << at;
        }
        Self { kept, ..self }
    }

    /// These words and those of another part of the same utterance.
    pub const fn with(self, other: Self) -> Self {
        Self { kept: self.kept | other.kept, ..self }
    }

    /// These words without those of another part of the same utterance.
    pub const fn without(self, other: Self) -> Self {
        Self { kept: self.kept & !other.kept, ..self }
    }

    /// All words of the utterance.
    pub const fn whole(self) -> Self {
        Self { kept: u64::MAX, ..self }
    }

    /// The words from one position up to another.
    pub fn part(self, begin: usize, end: usize) -> Self {
        let mut at = 0_usize;
        self.only(|_| {
            at = at.saturating_add(1);
            begin < at && at <= end
        })
    }

    /// The words from a position on.
    pub fn from(self, begin: usize) -> Self {
        self.part(begin, usize::MAX)
    }

    /// The words after a position.
    pub fn after(self, position: usize) -> Self {
        self.from(position.saturating_add(1))
    }

    /// The words before a position.
    pub fn before(self, position: usize) -> Self {
        self.part(0, position)
    }

    /// The words before the first such word; all if there is none.
    pub fn until(self, is_wanted: &dyn Fn(&Heard) -> bool) -> Self {
        self.before(self.position(is_wanted).unwrap_or(usize::MAX))
    }

    /// The words of a phrase.
    pub fn of_phrase(self, phrase: u8) -> Self {
        self.only(|word| word.phrase == phrase)
    }
}

/// The divisor of a reading's prior: 1 plus the largest count of its cues in lessons. Words that commands have are weak cues.
pub(super) fn learned(words: Words<'_>, of: &dyn Fn(&Heard) -> bool) -> f32 {
    1.0 + words.iter().filter(|word| of(word)).map(|word| word.count).fold(0.0, f32::max)
}

/// Iterates over words. It is one type for all callers; iterator adapters would be compiled for each.
#[derive(Clone)]
pub(super) struct Iter<'w> {
    words: Words<'w>,
    /// The number of words of the utterance passed, kept or not.
    passed: usize,
}

impl<'w> Iterator for Iter<'w> {
    type Item = &'w Heard;

    #[inline(never)]
    fn next(&mut self) -> Option<&'w Heard> {
        let Words { all, kept, .. } = self.words;
        while let Some(word) = all.get(self.passed) {
            let at = self.passed;
            self.passed = at.saturating_add(1);
            if kept >> at & 1 == 1 {
                return Some(word);
            }
        }
        None
    }
}
