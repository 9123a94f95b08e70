//! The behaviour that users of the core may rely on.

mod rooms;

#[cfg(feature = "alloc")]
mod any_order;
#[cfg(all(feature = "alloc", feature = "asking"))]
mod asking;
mod bad_homes;
mod ends_of_sessions;
#[cfg(feature = "alloc")]
mod honest_evidence;
#[cfg(feature = "alloc")]
mod hypotheses;
mod lending_memory;
#[cfg(feature = "alloc")]
mod on_a_host;
#[cfg(feature = "alloc")]
mod role_model;
mod sessions;
mod settings;
#[cfg(feature = "alloc")]
mod training_data;
mod ways;
