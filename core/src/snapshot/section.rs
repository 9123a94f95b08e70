//! The records of a section of a model file, read one after the other.

use core::marker::PhantomData;
use serde::Deserialize;

/// A sequence of records of one kind, read while iterating.
#[derive(Debug)]
pub struct Section<'a, T> {
    count: u32,
    bytes: &'a [u8],
    record: PhantomData<T>,
}

impl<T> Clone for Section<'_, T> {
    fn clone(&self) -> Self {
        *self
    }
}

impl<T> Copy for Section<'_, T> {}

/// The place of a section's records in a file.
#[derive(Clone, Copy, Debug)]
pub(super) struct Place {
    pub count: u32,
    pub from: u32,
}

impl Place {
    /// No record.
    pub const NONE: Self = Self { count: 0, from: 0 };
}

impl<'a, T> Section<'a, T> {
    /// The records at a place of a file.
    pub(super) fn at(file: &'a [u8], place: Place) -> Self {
        Self { count: place.count, bytes: file.get(place.from as usize..).unwrap_or(&[]), record: PhantomData }
    }

    /// The bytes from its first record on.
    #[doc(hidden)]
    pub const fn bytes(&self) -> &'a [u8] {
        self.bytes
    }
}

impl<'a, T: Deserialize<'a>> Section<'a, T> {
    /// The bytes after its last record.
    #[cfg(feature = "alloc")]
    #[doc(hidden)]
    pub fn after(&self) -> &'a [u8] {
        let mut rest = self.bytes;
        for _ in 0..self.count {
            let _: Option<T> = take(&mut rest);
        }
        rest
    }

    /// The number of records.
    pub fn len(&self) -> usize {
        self.count as usize
    }

    /// Whether there are no records.
    pub fn is_empty(&self) -> bool {
        self.count == 0
    }

    /// The records, in order.
    pub fn iter(&self) -> impl Iterator<Item = T> + Clone + use<'a, T> {
        let mut rest = self.bytes;
        (0..self.count).map_while(move |_| take(&mut rest))
    }
}

/// The starts of records at regular distances in a section, so that few records are read to find any one.
pub(super) struct Index<'a, T> {
    marks: [&'a [u8]; MARKS],
    stride: usize,
    record: PhantomData<T>,
}

const MARKS: usize = 32;

impl<'a, T: Deserialize<'a>> Section<'a, T> {
    pub(super) fn index(&self) -> Index<'a, T> {
        let stride = self.len().div_ceil(MARKS).max(1);
        let mut marks: [&[u8]; MARKS] = [&[]; MARKS];
        let mut rest = self.bytes;
        for mark in &mut marks {
            *mark = rest;
            for _ in 0..stride {
                let _: Option<T> = take(&mut rest);
            }
        }
        Index { marks, stride, record: PhantomData }
    }
}

impl<'a, T: Deserialize<'a>> Index<'a, T> {
    /// The record at a position within the section.
    pub(super) fn get(&self, position: usize) -> Option<T> {
        let mut rest = *self.marks.get(position.checked_div(self.stride)?)?;
        for _ in 0..position.checked_rem(self.stride)? {
            let _: T = take(&mut rest)?;
        }
        take(&mut rest)
    }
}

/// Reads one value from the front.
pub(super) fn take<'a, T: Deserialize<'a>>(rest: &mut &'a [u8]) -> Option<T> {
    let (value, after) = postcard::take_from_bytes(rest).ok()?;
    *rest = after;
    Some(value)
}
