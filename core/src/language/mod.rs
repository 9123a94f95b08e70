//! The language model (paper, section 3): how words are explained by machine tokens.
//!
//! - `tokenizer`: a command as words;
//! - `letters`: one letter that is written in many ways;
//! - [`unspaced`]: words of scripts without spaces;
//! - `bitext`: the training data, pairs of an English command and a machine command, each with a weight;
//! - `spelling`: which words are variants of one;
//! - `synonyms`: which words a table says mean the same;
//! - `tables`: the parameters;
//! - `settings`: which model it is, and how it is trained;
//! - [`ibm2`]: IBM Model 2, the paper's;
//! - [`roles`]: the role model, which is the default;
//! - [`layer`]: a discriminative layer above the role model, for hosts;
//! - `training`: training, in steps as large as the caller allows;
//! - [`forgetting`]: what gives way when memory is full;
//! - `model`: all of it together.

pub(crate) mod bitext;
pub mod forgetting;
pub mod ibm2;
pub mod layer;
#[cfg(feature = "marks")]
pub(crate) mod letters;
pub(crate) mod model;
pub mod roles;
pub(crate) mod settings;
pub(crate) mod spelling;
pub(crate) mod synonyms;
pub(crate) mod tables;
pub(crate) mod tokenizer;
pub(crate) mod training;
pub mod unspaced;

pub use bitext::{BitextRef, Pair, Span};
pub use ibm2::LengthPair;
#[cfg(feature = "marks")]
pub use letters::is_spelled_alike;
pub use model::{LanguageModel, LanguageMut, LanguageRef};
pub use roles::Meaning;
pub use settings::{MOST_ROUNDS, MOST_WEIGHT, Model, SettingError, Settings};
pub use spelling::is_slip;
pub use synonyms::{SynonymError, Synonyms};
pub use tables::TablesRef;
#[cfg(feature = "talk")]
pub use tokenizer::first_words;
pub use tokenizer::{Sentence, Word, for_each_piece, for_each_word, word_form};
pub use training::Training;
