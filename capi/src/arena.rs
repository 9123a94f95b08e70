//! The caller's memory, dealt out table by table.

use core::ptr::NonNull;
use goodbot::Capacities;
use goodbot::home::{HomeTables, HomeTablesRef};
use goodbot::memory::{AgentMemory, AgentTables, AgentTablesRef, HomeMemory};

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
    pub fn table<T: Copy>(&mut self, count: usize, empty: T) -> Option<Table<T>> {
        let first = self.place::<T>(count)?;
        for position in 0..count {
            // SAFETY: `place` made sure of the room and the alignment.
            unsafe { first.add(position).write(empty) };
        }
        Some(Table { first, count })
    }

    /// Aligned room for `count` values, not written yet.
    pub fn place<T>(&mut self, count: usize) -> Option<NonNull<T>> {
        let skip = self.at.align_offset(align_of::<T>());
        let bytes = size_of::<T>().checked_mul(count)?.checked_add(skip)?;
        if bytes > self.left {
            return None;
        }
        let first = self.at.wrapping_add(skip).cast::<T>();
        self.at = self.at.wrapping_add(bytes);
        self.left = self.left.wrapping_sub(bytes);
        NonNull::new(first)
    }
}

/// A table in the caller's memory: `count` values from `first` on, which nothing else refers to.
#[derive(Debug)]
pub struct Table<T> {
    first: NonNull<T>,
    count: usize,
}

impl<T> Table<T> {
    /// The values, for as long as the caller's memory stays.
    ///
    /// # Safety
    /// The memory stays as long as the values are used.
    pub unsafe fn stay<'r>(self) -> &'r mut [T] {
        // SAFETY: the arena gave these values to this table alone, which ends here; the rest is the caller's promise.
        unsafe { core::slice::from_raw_parts_mut(self.first.as_ptr(), self.count) }
    }
}

impl<T> AsRef<[T]> for Table<T> {
    fn as_ref(&self) -> &[T] {
        // SAFETY: the arena gave these values to this table alone, and each was written.
        unsafe { core::slice::from_raw_parts(self.first.as_ptr(), self.count) }
    }
}

impl<T> AsMut<[T]> for Table<T> {
    fn as_mut(&mut self) -> &mut [T] {
        // SAFETY: as above, and the table is borrowed alone.
        unsafe { core::slice::from_raw_parts_mut(self.first.as_ptr(), self.count) }
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
    ($(#[$meta:meta])* $Tables:ident $after:ident $($table:ident: $Element:ty = $empty:expr; $field:ident $(($($call:tt)*))?,)*) => {
        $(#[$meta])*
        #[derive(Debug)]
        pub struct $Tables {
            $($table: Table<$Element>,)*
        }

        impl $Tables {
            /// Deals them out.
            pub fn deal(arena: &mut Arena, capacities: &Capacities) -> Option<Self> {
                Some(Self { $($table: arena.table(capacities.$field $(($($call)*))?, $empty)?,)* })
            }
        }

        /// Where the tables end that begin at `at`.
        pub const fn $after(at: usize, capacities: &Capacities) -> usize {
            $(let at = after::<$Element>(at, capacities.$field $(($($call)*))?);)*
            at
        }
    };
}
goodbot::for_each_home_table! { tables!(
    /// All tables of one home.
    HomeArena after_home
) }
goodbot::for_each_agent_table! { tables!(
    /// All tables of one agent.
    AgentArena after_agent
) }

impl HomeMemory for HomeArena {
    fn lend(&mut self) -> HomeTables<'_> {
        goodbot::home_tables!(mut self)
    }

    fn read(&self) -> HomeTablesRef<'_> {
        goodbot::home_tables!(ref self)
    }
}

impl AgentMemory for AgentArena {
    fn lend(&mut self) -> AgentTables<'_> {
        goodbot::agent_tables!(mut self)
    }

    fn read(&self) -> AgentTablesRef<'_> {
        goodbot::agent_tables!(ref self)
    }
}
