//! A model as bytes, the same for firmware, browser, command line and C.
//!
//! [`Agent::save`](crate::Agent::save) writes all that the robot has learned. [`Agent::restore`](crate::Agent::restore) reads it back and
//! begins training on it: the restored robot then has the same parameters, to the last bit, as one that was never switched off. The file
//! holds the training data instead of the parameters, so learning continues as if it had never stopped. `docs/files.md` describes every
//! byte.
//!
//! - `checking`: checks a file record by record;
//! - `restoring`, `saving`: read or write a model in parts;
//! - `contents`: a checked model file, to inspect without restoring it;
//! - `record`: the records of a file; `section`: those of one kind, in order;
//! - `joining`: joins the sessions of two robots; `starter`: sentences to begin with;
//! - `migration`: a model for the next version of a robot, with other names;
//! - `parameters`: the parameters alone, for a robot that only obeys;
//! - `error`: why a model could not be saved or restored.

#[cfg(feature = "learning")]
mod agent;
#[cfg(feature = "learning")]
mod checking;
#[cfg(feature = "learning")]
pub(crate) mod contents;
pub(crate) mod error;
#[cfg(feature = "learning")]
mod joining;
#[cfg(feature = "learning")]
mod language;
#[cfg(all(feature = "alloc", feature = "learning"))]
mod migration;
mod parameters;
#[cfg(feature = "layer")]
mod possible;
pub(crate) mod record;
#[cfg(feature = "learning")]
mod restoring;
#[cfg(feature = "learning")]
mod saving;
#[cfg(feature = "learning")]
mod section;
#[cfg(feature = "learning")]
mod starter;

#[cfg(feature = "learning")]
pub use contents::Contents;
pub use error::{Part, RestoreError, SaveError};
#[cfg(all(feature = "alloc", feature = "learning"))]
pub use migration::{Migrated, Migration};
pub use parameters::PARAMETERS_MAGIC;
pub use record::{
    CommandRecord, KINDS_MAGIC, LAYERED_VERSION, PairRecord, RestsRecord, SAVED, SessionRecord, StrategyRecord, TrainerRecord, VERSION,
    most_bytes,
};
#[cfg(feature = "learning")]
pub use restoring::Restoring;
#[cfg(feature = "learning")]
pub use saving::Saving;
#[cfg(feature = "learning")]
pub use section::Section;
#[cfg(feature = "learning")]
pub use starter::{Places, is_beside};

/// Checks that the bytes are a model, or the parameters of one.
pub(crate) fn check(bytes: &[u8]) -> Result<(), RestoreError> {
    if cfg!(not(feature = "learning")) || bytes.starts_with(&PARAMETERS_MAGIC) {
        return parameters::check(bytes);
    }
    #[cfg(feature = "learning")]
    Contents::read(bytes)?;
    Ok(())
}
