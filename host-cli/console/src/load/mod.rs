//! Files that the commands read.
//!
//! - [`input`]: files and standard input;
//! - [`closed_words`]: tables of closed words;
//! - [`content`]: the kind of a file;
//! - [`kinds`]: the kinds of tasks that commands may mean;
//! - [`limit`]: the number of sessions to read;
//! - [`synonyms`]: tables of words that mean the same.

pub mod closed_words;
pub mod content;
pub mod input;
pub mod kinds;
pub mod limit;
pub mod synonyms;
