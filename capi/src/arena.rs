//! The caller's memory, dealt out table by table.

use core::ptr::NonNull;
use goodbot::Capacities;
use goodbot::memory::{AgentMemory, AgentTables, AgentTablesRef, HomeTables};

/// The rest of the caller's memory.
#[derive(Debug)]
pub struct Arena {
    at: *mut u8,
    left: usize,
}

impl Arena {
    /// All of the caller's memory.
    ///
    /// # Safety
    /// `left` bytes from `at` on are the caller's and used by nothing else. They stay in place as long as any part of them is used.
    pub unsafe fn new(at: *mut u8, left: usize) -> Self {
        Self { at, left }
    }

    /// Room for `count` values, each set to `empty`. None of them is ever dropped.
    pub fn table<T: Clone>(&mut self, count: usize, empty: T) -> Option<&'static mut [T]> {
        let first = self.place::<T>(count)?;
        // SAFETY: `place` made sure of the room and the alignment. An empty value owns nothing, so its bytes may be copied. Each value is given
        // to this table alone; the memory stays, as `new` was promised.
        unsafe {
            fill(first.as_ptr().cast(), (&raw const empty).cast(), size_of::<T>(), count);
            Some(core::slice::from_raw_parts_mut(first.as_ptr(), count))
        }
    }

    /// Aligned room for `count` values, not written yet.
    pub fn place<T>(&mut self, count: usize) -> Option<NonNull<T>> {
        self.room(size_of::<T>(), align_of::<T>(), count).map(NonNull::cast)
    }

    /// The same for all types, so that it is linked once.
    #[inline(never)]
    fn room(&mut self, size: usize, align: usize, count: usize) -> Option<NonNull<u8>> {
        // `align_offset` could panic if the compiler does not know that it is a power of two.
        let skip = self.at.addr().wrapping_neg() & align.wrapping_sub(1);
        let bytes = size.checked_mul(count)?.checked_add(skip)?;
        if bytes > self.left {
            return None;
        }
        let first = self.at.wrapping_add(skip);
        self.at = self.at.wrapping_add(bytes);
        self.left = self.left.wrapping_sub(bytes);
        NonNull::new(first)
    }
}

/// Writes `count` copies of the value of `size` bytes, one after the other. The same for all types, so that it is linked once.
///
/// # Safety
/// There is room for them at `to`.
#[inline(never)]
unsafe fn fill(to: *mut u8, value: *const u8, size: usize, count: usize) {
    for position in 0..count {
        // SAFETY: the caller's promise.
        unsafe { core::ptr::copy_nonoverlapping(value, to.add(position.wrapping_mul(size)), size) };
    }
}

/// The agent's tables in the caller's memory.
#[derive(Debug)]
pub struct Dealt(pub AgentTables<'static>);

impl AgentMemory for Dealt {
    fn lend(&mut self) -> AgentTables<'_> {
        // SAFETY: the copy lives only as long as these tables are lent. They are copied together, because table by table it takes 400 bytes of
        // flash.
        unsafe { core::ptr::read(&raw const self.0) }
    }

    fn read(&self) -> AgentTablesRef<'_> {
        self.0.read()
    }
}

/// The end of an aligned table of `count` values that begins at `at` at the earliest.
pub const fn after<T>(at: usize, count: usize) -> usize {
    after_values(at, size_of::<T>(), align_of::<T>(), count)
}

/// The same for all types, so that it is linked once.
#[inline(never)]
pub const fn after_values(at: usize, size: usize, align: usize, count: usize) -> usize {
    match at.checked_next_multiple_of(align) {
        Some(first) => first.saturating_add(size.saturating_mul(count)),
        None => usize::MAX,
    }
}

macro_rules! tables {
    ($deal:ident $after:ident $Memory:ident $whole:ident $Whole:ident $WholeRef:ident; $(
        $(#[$meta:meta])* $group:ident: $Tables:ident $TablesRef:ident
        { $($(#[$doc:meta])* $table:ident: $Element:ty = $empty:expr; $field:ident $(($($call:tt)*))?,)* }
        ($($part:ident: $Part:ident $PartRef:ident,)*)
    )*) => {
        /// Deals out the tables; `None` if there is too little room.
        pub fn $deal(arena: &mut Arena, capacities: &Capacities) -> Option<$Whole<'static>> {
            $(let $group = goodbot::memory::$Tables {
                $($table: arena.table(capacities.$field $(($($call)*))?, $empty)?,)*
                $($part,)*
            };)*
            Some($whole)
        }

        /// The end of tables that begin at `at`.
        pub const fn $after(at: usize, capacities: &Capacities) -> usize {
            $($(let at = after::<$Element>(at, capacities.$field $(($($call)*))?);)*)*
            at
        }
    };
}
goodbot::for_each_home_table! { tables!(deal_home after_home) }
goodbot::for_each_agent_table! { tables!(deal_agent after_agent) }
