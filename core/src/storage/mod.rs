//! A model in flash that survives a power cut at any moment.
//!
//! [`TwoSlots`] keeps two models over `embedded-storage`'s NOR-flash traits, and always overwrites the older one, its header last. Whenever
//! the power fails, the robot starts with the last complete model: the old one until the last byte of the new header is written, the new
//! one from then on. [`TwoSlotsAsync`] does the same over asynchronous flash. The parameters of a robot that only obeys are kept alike.
//! `docs/files.md` describes every byte of a slot.

mod error;
mod slot;
mod two_slots;

pub use error::StorageError;
pub use slot::SLOT_HEADER_BYTES;
pub use two_slots::{TwoSlots, TwoSlotsAsync};
