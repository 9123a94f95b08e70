//! Files that the commands read.
//!
//! - [`input`]: files and standard input;
//! - [`closed_words`]: tables of words that speak about commands;
//! - [`content`]: what a file is;
//! - [`kinds`]: the kinds of tasks that commands may mean;
//! - [`limit`]: how many sessions of a log;
//! - [`synonyms`]: tables of words that mean the same.

pub mod closed_words;
pub mod content;
pub mod input;
pub mod kinds;
pub mod limit;
pub mod synonyms;
