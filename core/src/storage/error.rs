//! Why a model could not be stored or loaded.

use crate::snapshot::RestoreError;

/// Why a model could not be stored or loaded; `E` is the flash's own error.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum StorageError<E> {
    /// The flash refused to read, write or erase.
    #[error("the flash refused: {0:?}")]
    Flash(E),
    /// The slots do not lie on whole erase blocks within the flash, or the flash's unit of reading or writing is larger than 256 bytes.
    #[error("the slots must lie on whole erase blocks within the flash")]
    Geometry,
    /// The model, or the buffer to load it into, does not fit.
    #[error("{needed} bytes are needed and there are {given}")]
    Size {
        /// Bytes needed.
        needed: usize,
        /// Bytes available.
        given: usize,
    },
    /// The bytes to store are not a model.
    #[error(transparent)]
    NotAModel(RestoreError),
    /// The flash returned other bytes than were written. The older model is still there.
    #[error("the flash did not keep what was written; the older model is still there")]
    NotKept,
}
