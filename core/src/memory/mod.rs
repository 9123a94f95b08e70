//! Memory that the caller owns and lends for the length of each call, shaped by [`Capacities`](crate::Capacities).
//!
//! [`memory!`](crate::memory!) makes a struct of plain arrays, which a controller puts into a static; with the `alloc` feature,
//! [`HeapMemory`](crate::HeapMemory) takes the same capacities at run time. Both have two parts: `home`, for a
//! [`Home`](crate::home::Home), and `agent`, for an [`Agent`](crate::Agent). Either part may be moved in or lent:
//!
//! | memory handed over | who owns the tables |
//! |---|---|
//! | `memory.agent` | the agent |
//! | `&mut memory.agent` | the caller, who can use them again when the agent is gone |
//! | [`AgentTables`] | the caller, table by table: for memory that is allotted at run time |
//!
//! All memory is made from one list of tables (`list.rs`). The tables are typed: in an untyped array of words, every bit pattern would have
//! to be valid for every table, and that is not so for a goal's pieces, a task's progress or a pair's lengths.

mod arrays;
#[cfg(feature = "alloc")]
pub(crate) mod heap;
mod list;

pub use arrays::{AgentArrays, Arrays, HomeArrays};
#[cfg(feature = "alloc")]
pub use heap::{AgentHeap, HomeHeap};

/// Makes the structs of slices, mutable and read-only, and the trait of memory that lends them.
macro_rules! tables {
    ($(#[$memory_meta:meta])* $Memory:ident $whole:ident $Whole:ident $WholeRef:ident; $(
        $(#[$meta:meta])* $group:ident: $Tables:ident $TablesRef:ident
        { $($(#[$doc:meta])* $table:ident: $Element:ty = $empty:expr; $field:ident $(($($call:tt)*))?,)* }
        ($($part:ident: $Part:ident $PartRef:ident,)*)
    )*) => {
        $(
            $(#[$meta])*
            #[doc(hidden)]
            #[derive(Debug, Default)]
            pub struct $Tables<'t> {
                $($(#[$doc])* pub $table: &'t mut [$Element],)*
                $(#[doc = concat!("See [`", stringify!($Part), "`].")] pub $part: $Part<'t>,)*
            }

            $(#[$meta])*
            ///
            /// To be read.
            #[doc(hidden)]
            #[derive(Clone, Copy, Debug, Default)]
            pub struct $TablesRef<'t> {
                $($(#[$doc])* pub $table: &'t [$Element],)*
                $(#[doc = concat!("See [`", stringify!($PartRef), "`].")] pub $part: $PartRef<'t>,)*
            }

            impl $Tables<'_> {
                /// The same tables, lent for a shorter time.
                pub fn lend(&mut self) -> $Tables<'_> {
                    $Tables { $($table: self.$table,)* $($part: self.$part.lend(),)* }
                }

                /// The same tables, read-only.
                #[inline]
                pub const fn read(&self) -> $TablesRef<'_> {
                    $TablesRef { $($table: self.$table,)* $($part: self.$part.read(),)* }
                }
            }
        )*

        $(#[$memory_meta])*
        pub trait $Memory {
            /// Lends the tables to one call.
            #[doc(hidden)]
            fn lend(&mut self) -> $Whole<'_>;
            /// Lends the tables to one call that only reads.
            #[doc(hidden)]
            fn read(&self) -> $WholeRef<'_>;
        }

        impl<M: $Memory + ?Sized> $Memory for &mut M {
            fn lend(&mut self) -> $Whole<'_> {
                (**self).lend()
            }

            fn read(&self) -> $WholeRef<'_> {
                (**self).read()
            }
        }

        impl $Memory for $Whole<'_> {
            fn lend(&mut self) -> $Whole<'_> {
                Self::lend(self)
            }

            fn read(&self) -> $WholeRef<'_> {
                Self::read(self)
            }
        }
    };
}

crate::for_each_home_table! { tables!(
    /// Memory for a [`Home`](crate::home::Home). Every call must lend the same tables, and nothing else may write to them in between.
) }
crate::for_each_agent_table! { tables!(
    /// Memory for an [`Agent`](crate::Agent). Every call must lend the same tables, and nothing else may write to them in between.
) }
