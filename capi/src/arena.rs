//! The caller's memory, dealt out table by table.

use goodbot::Capacities;
use goodbot::memory::Memory;

/// What is left of the caller's memory.
#[derive(Debug)]
pub struct Arena {
    at: *mut u8,
    left: usize,
}

impl Arena {
    /// All of it.
    ///
    /// # Safety
    /// `left` bytes from `at` on are the caller's, are used by nothing else, and stay where they are as long as anything that is dealt
    /// out is used.
    pub unsafe fn new(at: *mut u8, left: usize) -> Self {
        Self { at, left }
    }

    /// Room for `count` values, each set to `empty`.
    pub fn table<T: Copy + 'static>(&mut self, count: usize, empty: T) -> Option<&'static mut [T]> {
        let first = self.place::<T>(count)?;
        for position in 0..count {
            // SAFETY: `place` made sure of the room and the alignment.
            unsafe { first.add(position).write(empty) };
        }
        // SAFETY: as above, every value has just been written, and no other table is given the same bytes.
        Some(unsafe { core::slice::from_raw_parts_mut(first, count) })
    }

    /// Aligned room for `count` values, not written yet.
    pub fn place<T>(&mut self, count: usize) -> Option<*mut T> {
        let skip = self.at.align_offset(align_of::<T>());
        let bytes = size_of::<T>().checked_mul(count)?.checked_add(skip)?;
        if bytes > self.left {
            return None;
        }
        let first = self.at.wrapping_add(skip).cast::<T>();
        self.at = self.at.wrapping_add(bytes);
        self.left = self.left.wrapping_sub(bytes);
        Some(first)
    }
}

/// Where the next table begins after one of `count` values that begins at `at` or a little later.
pub const fn after<T>(at: usize, count: usize) -> usize {
    match at.checked_next_multiple_of(align_of::<T>()) {
        Some(first) => first.saturating_add(size_of::<T>().saturating_mul(count)),
        None => usize::MAX,
    }
}

macro_rules! tables {
    ($($table:ident: $Element:ty = $empty:expr; $field:ident $(($($call:tt)*))?,)*) => {
        /// All tables of one robot, in the caller's memory.
        struct Tables {
            $($table: &'static mut [$Element],)*
        }

        impl Tables {
            fn deal(arena: &mut Arena, capacities: &Capacities) -> Option<Self> {
                Some(Self { $($table: arena.table(capacities.$field $(($($call)*))?, $empty)?,)* })
            }
        }

        /// Where the tables end that begin at `at`.
        pub const fn after_tables(at: usize, capacities: &Capacities) -> usize {
            $(let at = after::<$Element>(at, capacities.$field $(($($call)*))?);)*
            at
        }
    };
}
goodbot::for_each_table! { tables!() }

/// Deals out all tables.
pub fn memory(arena: &mut Arena, capacities: &Capacities) -> Option<Memory<'static>> {
    let mut tables = Tables::deal(arena, capacities)?;
    let memory = goodbot::split_tables!(&mut tables);
    // SAFETY: only the references' own lifetimes are widened: what they refer to lies in the arena and not in `tables`, which is not used
    // again.
    Some(unsafe { core::mem::transmute::<Memory<'_>, Memory<'static>>(memory) })
}
