//! Memory for the C interface.

use std::alloc::{Layout, alloc, dealloc};

/// A block of memory of an exact size, filled with dirt, aligned to 8 or on purpose not.
#[derive(Debug)]
pub struct Block {
    start: *mut u8,
    layout: Layout,
    offset: usize,
}

impl Block {
    /// A block of `bytes` bytes that begins `offset` bytes after a multiple of 8. Each byte is `dirt`.
    pub fn new(bytes: usize, offset: usize, dirt: u8) -> Self {
        let layout = Layout::from_size_align(bytes.saturating_add(offset).max(1), 8).expect("a size that a block can have");
        // SAFETY: the layout is not empty.
        let start = unsafe { alloc(layout) };
        assert!(!start.is_null(), "out of memory");
        // SAFETY: just allocated, of this size.
        unsafe { start.write_bytes(dirt, layout.size()) };
        Self { start, layout, offset }
    }

    /// Where it begins.
    pub fn start(&self) -> *mut u8 {
        self.start.wrapping_add(self.offset)
    }

    /// How many bytes.
    pub fn bytes(&self) -> usize {
        self.layout.size() - self.offset
    }

    /// What it holds.
    pub fn contents(&self) -> &[u8] {
        // SAFETY: all of it was written when it was made.
        unsafe { std::slice::from_raw_parts(self.start(), self.bytes()) }
    }
}

impl Drop for Block {
    fn drop(&mut self) {
        // SAFETY: allocated with this layout.
        unsafe { dealloc(self.start, self.layout) };
    }
}
