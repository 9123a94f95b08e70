//! A model in flash that outlives a power cut at any moment.
//!
//! [`TwoSlots`] keeps two models over `embedded-storage`'s NOR-flash traits, and always writes over the older one, its header last. Whenever
//! the power goes, the robot comes up with the last complete model: the old one until the last byte of the new header is written, the new
//! one from then on. With the feature `storage-async`, `TwoSlotsAsync` does the same over flash that is waited for. `docs/format.md` says what each byte of a slot means.

mod error;
mod slot;
mod two_slots;

pub use error::StorageError;
pub use slot::SLOT_HEADER_BYTES;
pub use two_slots::TwoSlots;
#[cfg(feature = "storage-async")]
pub use two_slots::TwoSlotsAsync;
