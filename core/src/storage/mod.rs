//! A model in flash that survives a power cut at any moment.
//!
//! [`TwoSlots`] keeps two models over `embedded-storage`'s NOR-flash traits, and always overwrites the older one, its header last. Whenever
//! the power fails, the robot starts with the last complete model: the old one until the last byte of the new header is written, the new
//! one from then on. [`TwoSlotsAsync`] does the same over asynchronous flash. The parameters of a robot that only obeys are kept alike.
//!
//! # The format
//!
//! The two slots are adjacent, of the same length, and on whole erase blocks. Numbers are little-endian. Storing erases the older slot,
//! writes the model, then the 16 bytes. A slot counts if both CRCs are right.
//!
//! ```text
//! 0 to 3     73 6c 6f 74: "slot"
//! 4 to 7     a u32, the count of stored models, which may wrap around; the higher one is newer
//! 8 to 11    the model's length, a u32
//! 12 to 15   CRC-32 of the bytes before
//! from 16    the model file; 16 is rounded up to the flash's write and read size
//! ```

mod error;
mod slot;
mod two_slots;

pub use error::StorageError;
pub use slot::SLOT_HEADER_BYTES;
pub use two_slots::{Storing, TwoSlots, TwoSlotsAsync};
