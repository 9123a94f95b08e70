//! Why a model could not be stored or loaded.

use crate::snapshot::RestoreError;
use core::fmt;

/// Why a model could not be stored or loaded; `E` is the flash's own error.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum StorageError<E> {
    /// The flash refused to read, write or erase.
    Flash(E),
    /// The slots do not lie on whole erase blocks within the flash, or the flash's unit of reading or writing is larger than 256 bytes.
    Geometry,
    /// The model, or the buffer to load it into, does not fit.
    Size {
        /// Bytes needed.
        needed: usize,
        /// Bytes available.
        given: usize,
    },
    /// The bytes to store are not a model.
    NotAModel(RestoreError),
    /// The flash returned other bytes than were written. The older model is still there.
    NotKept,
}

impl<E: fmt::Debug> fmt::Display for StorageError<E> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Flash(error) => write!(f, "the flash refused: {error:?}"),
            Self::Geometry => f.write_str("the slots must lie on whole erase blocks within the flash"),
            Self::Size { needed, given } => write!(f, "{needed} bytes are needed and there are {given}"),
            Self::NotAModel(error) => error.fmt(f),
            Self::NotKept => f.write_str("the flash did not keep what was written; the older model is still there"),
        }
    }
}

impl<E: fmt::Debug> core::error::Error for StorageError<E> {}
