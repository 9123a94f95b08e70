//! IBM Model 2, the paper's (section 3): every word translates one token of a machine command, or none.
//!
//! ```text
//! Pr(e | m) = product over the words i of the sum over the tokens j, NULL included, of a(j | i, l, n) t(e_i | m_j)
//! ```
//!
//! - `tables`: t and a;
//! - `lengths`: counts the pairs of lengths in training data;
//! - `likelihood`: Pr(e|m), exactly, without underflow;
//! - `training`: weighted expectation maximisation, in parts;
//! - `data`: memory for the training data.

pub(crate) mod data;
pub(crate) mod lengths;
pub(crate) mod likelihood;
pub(crate) mod tables;
pub(crate) mod training;

pub use tables::LengthPair;
