//! The language model (paper, section 3): how machine tokens explain words.
//!
//! - `tokenizer`: splits a command into words;
//! - `letters`: one form for letters that can be written in several ways;
//! - [`unspaced`]: words of scripts without spaces;
//! - `bitext`: the training data, pairs of an English command and a machine command, each with a weight;
//! - `spelling`: words that count as variants of another;
//! - `synonyms`: words that a table declares to mean the same;
//! - `tables`: the parameters;
//! - `settings`: the choice of the model, and its training;
//! - [`ibm2`]: IBM Model 2, the paper's;
//! - [`roles`]: the role model, which is the default;
//! - [`layer`]: a discriminative layer above the role model, for hosts;
//! - `training`: training, in steps as large as the caller allows;
//! - [`forgetting`]: the sessions that give way when memory is full;
//! - `model`: all of it together.

pub(crate) mod bitext;
#[doc(hidden)]
pub mod forgetting;
pub(crate) mod hearing;
#[doc(hidden)]
pub mod ibm2;
#[doc(hidden)]
#[cfg(feature = "layer")]
pub mod layer;
#[cfg(not(feature = "layer"))]
#[path = "layer/absent.rs"]
pub mod layer;
#[cfg(all(feature = "alloc", feature = "unicode"))]
pub(crate) mod letters;
pub(crate) mod model;
#[doc(hidden)]
pub mod roles;
pub(crate) mod settings;
pub(crate) mod spelling;
pub(crate) mod synonyms;
pub(crate) mod tables;
pub(crate) mod tokenizer;
pub(crate) mod training;
#[doc(hidden)]
pub mod unspaced;

pub use bitext::{BitextRef, Pair, Span};
pub use ibm2::LengthPair;
#[cfg(all(feature = "alloc", feature = "unicode"))]
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
