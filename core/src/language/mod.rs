//! The language model (paper, section 3): how words are explained by machine tokens.
//!
//! - `tokenizer`: a command as words;
//! - `bitext`: the training data, pairs of an English command and a machine command, each with a weight;
//! - `spelling`: which words are variants of one;
//! - `synonyms`: which words a table says mean the same;
//! - `tables`: IBM Model 2's translation and alignment tables;
//! - `likelihood`: Pr(e|m), exactly, without underflow;
//! - [`forgetting`]: what gives way when memory is full;
//! - `em`: weighted expectation maximisation, in steps as large as the caller allows;
//! - `settings`: how it is trained;
//! - [`roles`]: the role model, which is the default;
//! - `model`: all of it together.

pub(crate) mod bitext;
pub(crate) mod em;
pub mod forgetting;
pub(crate) mod lengths;
pub(crate) mod likelihood;
pub(crate) mod model;
pub mod roles;
pub(crate) mod settings;
pub(crate) mod spelling;
pub(crate) mod synonyms;
pub(crate) mod tables;
pub(crate) mod tokenizer;

pub use bitext::{BitextRef, BitextTables, BitextTablesRef, Pair, Span};
pub use em::Training;
pub use model::{LanguageModel, LanguageMut, LanguageRef, LanguageTables, LanguageTablesRef};
pub use roles::Meaning;
pub use settings::{MOST_ROUNDS, MOST_WEIGHT, Model, SettingError, Settings};
pub use spelling::is_slip;
pub use synonyms::{SynonymError, Synonyms};
pub use tables::{LengthPair, ParameterTables, ParameterTablesRef, TablesRef};
pub use tokenizer::{Sentence, Word, for_each_piece, for_each_word, word_form};
