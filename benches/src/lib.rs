//! The benchmarks and how they are measured: one list for time, plots and comparisons.

#![deny(missing_docs)]

pub mod dijkstra;
#[cfg(target_arch = "wasm32")]
pub mod exports;
pub mod homes;
pub mod language;
pub mod three_storeys;
pub mod timing;
pub mod works;
