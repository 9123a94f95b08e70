//! What people say beside commands: something that is done already, something that no task here is, the opposite of a command, several
//! things at once, and words that are no command at all.
//!
//! An utterance is one of several hypotheses, each with a prior and a likelihood of all its words: a [command](Hypothesis::Command), whose
//! tasks are those of [`hear`](crate::Agent::hear) and those that are done already; [none](Hypothesis::Nothing) of what the robot can do;
//! and what [closed classes of words](Class) are a sign of. [`Agent::listen`](crate::Agent::listen) begins a session as `hear` does, with
//! the belief that the words give a command, and says what it takes the utterance for.
//!
//! In the order in which an utterance goes through them:
//! - `classes`: closed classes of words, from a table;
//! - `heard`: the words of the utterance; `slips`: the known words that new ones may be;
//! - `conversation`: what was done and said before; `recalled`: words that stand for it, such as "it" and "there";
//! - `wording`: how commands are worded, as far as lessons tell; `place`: whether words stand alone or behind a command;
//! - `explained`: how well the tasks here explain the words; `absent`: tasks about things that are not here;
//! - `readings`: what shall not be, all things of a kind, and one command after another;
//! - `hypothesis`: what the utterance may be; `verdict`: what it is taken for;
//! - `listening`: the calls, and the session that they begin;
//! - `voice`: what words ask for that are no command; `correction`: words to a robot on its way.

mod absent;
mod classes;
mod conversation;
mod correction;
mod explained;
mod heard;
mod hypothesis;
pub(crate) mod listening;
mod place;
mod readings;
mod recalled;
mod renamed;
mod reworded;
mod slips;
mod verdict;
mod voice;
mod wording;

pub use classes::{Class, Classes, ClosedWords, ClosedWordsError};
pub use conversation::{Conversation, Fact};
pub use correction::Corrected;
pub use hypothesis::Hypothesis;
pub use listening::Listened;
pub use verdict::Verdict;
pub use voice::{Said, Stage, for_each_open_word};
