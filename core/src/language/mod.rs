//! The language model (paper, section 3): how words are explained by machine tokens.
//!
//! - [`tokenizer`]: a command as words;
//! - [`bitext`]: the training data, pairs of an English command and a machine command, each with a weight;
//! - [`tables`]: IBM Model 2's translation and alignment tables;
//! - [`likelihood`]: Pr(e|m), exactly, without underflow;
//! - [`forgetting`]: what gives way when memory is full;
//! - [`em`]: weighted expectation maximisation, in steps as large as the caller allows;
//! - [`settings`]: how it is trained;
//! - [`model`]: all of it together.

pub mod bitext;
pub mod em;
pub mod forgetting;
pub(crate) mod lengths;
pub mod likelihood;
pub mod model;
pub mod settings;
pub mod tables;
pub mod tokenizer;

pub use bitext::{BitextRef, BitextTables, BitextTablesRef, Pair, Span};
pub use em::Training;
pub use model::{LanguageModel, LanguageMut, LanguageRef, LanguageTables, LanguageTablesRef};
pub use settings::{SettingError, Settings};
pub use tables::{LengthPair, ParameterTables, ParameterTablesRef, TablesRef};
pub use tokenizer::Sentence;
