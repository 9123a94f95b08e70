//! What people say beside commands: something that is done already, something that no task here is, the opposite of a command, several
//! things at once, and words that are no command at all.
//!
//! An utterance is one of several hypotheses, each with a prior and a likelihood of all its words: a [command](Hypothesis::Command), whose
//! tasks are those of [`hear`](crate::Agent::hear) and those that are done already; [none](Hypothesis::Nothing) of what the robot can do;
//! and what [closed classes of words](Class) are a sign of. [`Agent::listen`](crate::Agent::listen) begins a session as `hear` does, with
//! the belief that the words give a command, and says what it takes the utterance for.
//!
//! - `classes`: closed classes of words, from a table;
//! - `conversation`: what was done and said before, for words such as "it" and "there";
//! - `correction`: words to a robot on its way;
//! - `listening`: the hypotheses, and the verdict;
//! - `recalled`: words that stand for what was said before;
//! - `readings`: what shall not be, all things of a kind, and one command after another;
//! - `voice`: what words ask for that are no command.

mod classes;
mod conversation;
mod correction;
pub(crate) mod listening;
mod readings;
mod recalled;
mod voice;

pub use classes::{Class, Classes, ClosedWords, ClosedWordsError};
pub use conversation::{Conversation, Fact};
pub use correction::Corrected;
pub use listening::{Hypothesis, Listened, Verdict};
pub use voice::{Said, Stage, for_each_open_word};
