//! A model as bytes, the same for firmware, browser, command line and C.
//!
//! [`Agent::save`](crate::Agent::save) writes all that the robot has learned, [`Agent::restore`](crate::Agent::restore) takes it back and
//! begins training on it: the restored robot then has the same parameters, to the last bit, as one that was never switched off. The
//! parameters themselves are not in the file; the training data are, so that learning goes on as if it had never stopped.
//! `docs/format.md` says what each byte means.
//!
//! - `checking`: the check of a file, record by record;
//! - `restoring`, `saving`: a model comes back, or is written, in parts;
//! - `contents`: a model file that was checked, to look into without restoring it;
//! - `record`: the records that it is made of;
//! - `parameters`: what was learned as parameters alone, for a robot that only obeys;
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
mod parameters;
#[cfg(feature = "layer")]
mod possible;
pub(crate) mod record;
#[cfg(feature = "learning")]
mod restoring;
#[cfg(feature = "learning")]
mod saving;

#[cfg(feature = "learning")]
pub use contents::{Contents, Section};
pub use error::{Part, RestoreError, SaveError};
pub use parameters::PARAMETERS_MAGIC;
pub use record::{
    CHECK_BYTES, CommandRecord, HEADER_BYTES, KINDS_MAGIC, LAYERED_VERSION, LEAST_BYTES, MAGIC, OLDEST_VERSION, PairRecord, RestsRecord,
    SAVED, SessionRecord, StrategyRecord, TrainerRecord, VERSION, most_bytes,
};
#[cfg(feature = "learning")]
pub use restoring::Restoring;
#[cfg(feature = "learning")]
pub use saving::Saving;
