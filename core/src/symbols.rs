//! Interned names: each distinct text is kept once and identified by a small number.
//!
//! Words, machine tokens, object names and attribute values ("yellow", "chair") are data that arrive at run time, so they cannot be enums.
//! A [`Symbols`] table keeps their bytes, concatenated, in memory that the caller lends it.

use crate::capacity::{Capacity, CapacityError, NAME_BYTES};
use core::ops::Range;

/// Identifies things by their positions in a list, which their type tells from those in others.
macro_rules! positions {
    ($($(#[$meta:meta])* $Id:ident($Number:ty);)*) => {$(
        $(#[$meta])*
        #[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
        pub struct $Id(pub(crate) $Number);

        impl $Id {
            /// The one at this position.
            pub const fn new(position: $Number) -> Self {
                Self(position)
            }

            /// Its position.
            pub const fn index(self) -> usize {
                self.0 as usize
            }
        }
    )*};
}
pub(crate) use positions;

positions! {
    /// A text known to a [`Symbols`] table, by its position there.
    Symbol(u16);
}

/// Texts, each kept once, in order of their first occurrence.
///
/// ```
/// use goodbot::{capacity::Capacity, symbols::Symbols};
/// let (mut bytes, mut ends, mut count) = ([0; 16], [0; 4], 0);
/// let mut symbols = Symbols::new(&mut bytes, &mut ends, &mut count, Capacity::Words, Capacity::WordBytes);
/// let red = symbols.intern("red").unwrap();
/// assert_eq!(symbols.intern("red"), Ok(red));
/// assert_eq!(symbols.read().text(red), "red");
/// assert_eq!(symbols.read().find("green"), None);
/// ```
#[derive(Debug)]
pub struct Symbols<'t> {
    bytes: &'t mut [u8],
    ends: &'t mut [u16],
    len: &'t mut usize,
    count_capacity: Capacity,
    byte_capacity: Capacity,
}

/// The same texts, read-only.
#[derive(Clone, Copy, Debug)]
pub struct SymbolsRef<'t> {
    bytes: &'t [u8],
    ends: &'t [u16],
    len: usize,
}

impl<'t> SymbolsRef<'t> {
    /// The first `len` texts of `bytes` and `ends`, as [`Symbols`] laid them out.
    pub(crate) const fn new(bytes: &'t [u8], ends: &'t [u16], len: usize) -> Self {
        Self { bytes, ends, len }
    }

    /// The number of texts.
    pub const fn len(self) -> usize {
        self.len
    }

    /// Whether there are no texts.
    pub const fn is_empty(self) -> bool {
        self.len == 0
    }

    /// Bytes of all texts together.
    pub(crate) fn byte_len(self) -> usize {
        self.start(self.len)
    }

    /// The most texts, and the most bytes of them, that the table has room for.
    pub(crate) fn room(self) -> (usize, usize) {
        (self.ends.len().min(usize::from(u16::MAX) - 1), self.bytes.len().min(usize::from(u16::MAX)))
    }

    fn start(self, position: usize) -> usize {
        match position.checked_sub(1) {
            Some(previous) => self.ends.get(previous).copied().unwrap_or(0) as usize,
            None => 0,
        }
    }

    fn raw(self, position: usize) -> &'t [u8] {
        if position >= self.len {
            return &[];
        }
        self.bytes.get(self.start(position)..self.start(position + 1)).unwrap_or(&[])
    }

    /// The bytes of all texts, concatenated, and the end of each text.
    pub(crate) fn parts(self) -> (&'t [u8], &'t [u16]) {
        (self.bytes.get(..self.byte_len()).unwrap_or(&[]), self.ends.get(..self.len).unwrap_or(&[]))
    }

    /// The text of `symbol`; empty for a symbol that this table does not have.
    pub fn text(self, symbol: Symbol) -> &'t str {
        core::str::from_utf8(self.raw(symbol.index())).unwrap_or("")
    }

    /// All texts, in order.
    pub fn iter(self) -> impl Iterator<Item = (Symbol, &'t str)> {
        (0..self.len).map(move |position| {
            let symbol = Symbol(position as u16);
            (symbol, self.text(symbol))
        })
    }

    /// The symbol of `text`, if the table has it.
    pub fn find(self, text: &str) -> Option<Symbol> {
        self.find_in(0..self.len, text.len(), |bytes| bytes == text.as_bytes())
    }

    /// The text of this many bytes with this last one that is the wanted one. Those from a few before `near` on are looked at first: texts
    /// that were added together are often wanted together. The last byte tells many texts apart that begin alike.
    #[cfg(feature = "ways")]
    pub(crate) fn find_near(self, near: Symbol, length: usize, last: Option<&u8>, is_wanted: impl Fn(&[u8]) -> bool) -> Option<Symbol> {
        const BEFORE: usize = 8;
        let first = near.index().saturating_sub(BEFORE).min(self.len);
        let is_wanted = |bytes: &[u8]| bytes.last() == last && is_wanted(bytes);
        [first..self.len, 0..first].into_iter().find_map(|range| self.find_in(range, length, is_wanted))
    }

    /// The first text of this many bytes that is the wanted one, among those at these positions.
    fn find_in(self, among: Range<usize>, length: usize, is_wanted: impl Fn(&[u8]) -> bool) -> Option<Symbol> {
        let (mut start, first) = (self.start(among.start), among.start);
        let position = self.ends.get(among)?.iter().position(|&end| {
            let from = core::mem::replace(&mut start, end as usize);
            start.wrapping_sub(from) == length && self.bytes.get(from..start).is_some_and(&is_wanted)
        });
        position.map(|position| Symbol(first.saturating_add(position) as u16))
    }
}

impl<'t> Symbols<'t> {
    /// The first `len` texts of `bytes` (all texts concatenated, at most 65,535 bytes) and `ends` (one entry per text). The two capacities
    /// are named in errors.
    pub const fn new(
        bytes: &'t mut [u8],
        ends: &'t mut [u16],
        len: &'t mut usize,
        count_capacity: Capacity,
        byte_capacity: Capacity,
    ) -> Self {
        Self { bytes, ends, len, count_capacity, byte_capacity }
    }

    /// The texts, read-only.
    pub const fn read(&self) -> SymbolsRef<'_> {
        SymbolsRef { bytes: self.bytes, ends: self.ends, len: *self.len }
    }

    /// The number of texts.
    pub const fn len(&self) -> usize {
        *self.len
    }

    /// Whether there are no texts.
    pub const fn is_empty(&self) -> bool {
        *self.len == 0
    }

    /// The symbol of `text`, added if the table does not have it yet.
    ///
    /// # Errors
    /// A [`CapacityError`] if the text is longer than [`NAME_BYTES`] or the table is full; the table is then unchanged.
    pub fn intern(&mut self, text: &str) -> Result<Symbol, CapacityError> {
        self.read().find(text).map_or_else(|| self.add([text.as_bytes()]), Ok)
    }

    /// Adds a text in parts, which the table does not have.
    ///
    /// # Errors
    /// As [`intern`](Self::intern).
    pub(crate) fn add<const PARTS: usize>(&mut self, parts: [&[u8]; PARTS]) -> Result<Symbol, CapacityError> {
        let length = parts.iter().fold(0_usize, |sum, part| sum.saturating_add(part.len()));
        Capacity::NameBytes.fits(length, NAME_BYTES)?;
        let start = self.read().byte_len();
        let end = start + length;
        let (most_symbols, most) = self.read().room();
        let full = CapacityError::new(self.byte_capacity, most, end);
        let end_entry = u16::try_from(end).map_err(|_| full)?;
        if *self.len >= most_symbols {
            return Err(CapacityError::full(self.count_capacity, most_symbols));
        }
        let Some(room) = self.bytes.get_mut(start..end) else { return Err(full) };
        room.iter_mut().zip(parts.into_iter().flatten()).for_each(|(slot, &byte)| *slot = byte);
        if let Some(entry) = self.ends.get_mut(*self.len) {
            *entry = end_entry;
        }
        let symbol = Symbol(*self.len as u16);
        *self.len += 1;
        Ok(symbol)
    }

    /// Forgets one text. The later texts move up: each of their symbols decreases by one.
    pub fn remove(&mut self, symbol: Symbol) {
        let position = symbol.index();
        if position >= *self.len {
            return;
        }
        let (start, end) = (self.read().start(position), self.read().start(position + 1));
        let (all, length) = (self.read().byte_len(), end.saturating_sub(start));
        if let Some(bytes) = self.bytes.get_mut(start..all) {
            close_gap(bytes, length);
        }
        let last = self.len.saturating_sub(1);
        if let Some(ends) = self.ends.get_mut(position..*self.len) {
            close_gap(ends, 1);
        }
        for end in self.ends.iter_mut().take(last).skip(position) {
            *end = end.saturating_sub(length as u16);
        }
        *self.len = last;
    }

    /// Forgets all texts from position `len` on.
    pub fn truncate(&mut self, len: usize) {
        *self.len = (*self.len).min(len);
    }
}

/// As many of the items as a list has room for. `collect` could panic, for all that the compiler knows.
pub(crate) fn listed<T, const MOST: usize>(items: impl Iterator<Item = T>) -> heapless::Vec<T, MOST> {
    let mut list = heapless::Vec::new();
    for item in items.take(MOST) {
        let _ = list.push(item);
    }
    list
}

/// Moves the entries after the first `gap` to the front. The standard rotation can panic, and would bring panic messages into a
/// controller's flash.
pub(crate) fn close_gap<T: Copy>(entries: &mut [T], gap: usize) {
    let mut to = 0_usize;
    while let Some(&entry) = entries.get(to + gap) {
        if let Some(slot) = entries.get_mut(to) {
            *slot = entry;
        }
        to += 1;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_full_table_says_what_to_raise_and_keeps_what_it_has() {
        let (mut bytes, mut ends, mut count) = ([0; 8], [0; 2], 0);
        let mut symbols = Symbols::new(&mut bytes, &mut ends, &mut count, Capacity::Words, Capacity::WordBytes);
        symbols.intern("red").unwrap();
        assert_eq!(symbols.intern("yellow"), Err(CapacityError::new(Capacity::WordBytes, 8, 9)));
        symbols.intern("blue").unwrap();
        assert_eq!(symbols.intern("a"), Err(CapacityError::new(Capacity::Words, 2, 3)));
        assert_eq!(symbols.read().find("blue"), Some(Symbol(1)));
    }

    #[test]
    fn a_removed_text_leaves_the_others_in_order() {
        for removed in 0..4 {
            let (mut bytes, mut ends, mut count) = ([0; 16], [0; 4], 0);
            let mut symbols = Symbols::new(&mut bytes, &mut ends, &mut count, Capacity::Words, Capacity::WordBytes);
            let mut texts = std::vec!["red", "", "blue", "green"];
            for text in &texts {
                symbols.intern(text).unwrap();
            }
            symbols.remove(Symbol(removed));
            symbols.remove(Symbol(9));
            texts.remove(usize::from(removed));
            assert!(symbols.read().iter().map(|(_, text)| text).eq(texts));
            assert_eq!(symbols.intern("pink"), Ok(Symbol(3)));
        }
    }

    #[test]
    fn truncating_makes_room_again() {
        let (mut bytes, mut ends, mut count) = ([0; 8], [0; 2], 0);
        let mut symbols = Symbols::new(&mut bytes, &mut ends, &mut count, Capacity::Words, Capacity::WordBytes);
        symbols.intern("red").unwrap();
        symbols.intern("blue").unwrap();
        symbols.truncate(1);
        assert_eq!(symbols.read().find("blue"), None);
        assert_eq!(symbols.intern("green"), Ok(Symbol(1)));
        assert_eq!(symbols.read().byte_len(), 8);
    }
}
