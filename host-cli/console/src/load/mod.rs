//! Files that the commands read.
//!
//! - [`input`]: files and standard input, and the kind of a file;
//! - [`kinds`]: the kinds of tasks that commands may mean;
//! - [`words`]: tables of synonyms and of closed words.

pub mod input;
pub mod kinds;
pub mod words;
