//! What users of the core may rely on.

mod rooms;

mod any_order;
#[cfg(feature = "asking")]
mod asking;
mod bad_homes;
mod ends_of_sessions;
#[cfg(feature = "std")]
mod honest_evidence;
mod hypotheses;
mod lending_memory;
#[cfg(all(feature = "std", feature = "snapshot"))]
mod role_model;
mod sessions;
mod settings;
mod training_data;
mod ways;
