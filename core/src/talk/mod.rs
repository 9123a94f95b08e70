//! Utterances beyond plain commands: tasks that are done already or impossible here, negated commands, several things at once, and words
//! that are no command.
//!
//! An utterance is one of several hypotheses, each with a prior and a likelihood of all its words: a [command](Hypothesis::Command), for
//! the tasks of [`hear`](crate::Agent::hear) and those that are done already; [nothing](Hypothesis::Nothing) that the robot can do; or one
//! with cues from the [closed classes of words](crate::voice::Class). [`Agent::listen`](crate::Agent::listen) begins a session as `hear` does, with the
//! belief under the likeliest hypothesis, and returns a verdict on the utterance.
//!
//! The modules, in the order in which an utterance passes through them:
//! - `pieces`: the words of the utterance; `heard`: one word; `words`: some of them;
//! - `slips`: known words that new ones may be slips for; `mended`: the words without slips;
//! - `syntax`: whether they have a verb, begin with a direction, name one thing, or are in the past;
//! - `conversation`: earlier tasks and places; `recalled`: words that refer to them, such as "it" and "there";
//! - `wording`: how commands are worded in the lessons; `context`: whether words come after another command;
//! - `told`: places told by a thing, and things told by their place;
//! - `explained`: how well the tasks here explain the words; `absent`: tasks about things that are not here;
//! - `readings`: negated commands, and all things of a kind or a place; `several`: several commands; `repair`: what people take back in a sentence;
//! - `hypothesis`: the hypotheses and their probabilities; `verdict`: the decision among them; `acceptance`: the probability of each, as
//!   trained; `objects`: the things and places of tasks;
//! - `listening`: the calls, and the session that they begin;
//! - `correction`: words to a robot on its way.
//!
//! [`voice`](crate::voice) has the classes of words, and the effect of words that are no command.

mod absent;
pub(crate) mod acceptance;
mod context;
mod conversation;
mod correction;
mod explained;
mod heard;
mod hypothesis;
pub(crate) mod listening;
mod mended;
mod objects;
mod pieces;
mod readings;
mod recalled;
mod repair;
mod several;
mod slips;
mod syntax;
#[cfg(all(test, feature = "alloc"))]
mod taught;
mod told;
mod verdict;
mod wording;
mod words;

pub use crate::voice::{Class, Classes, ClosedWords, ClosedWordsError, Said, Stage, for_each_open_word};
pub use acceptance::{ACTS_FROM, CLUES, Clues, HASHED, KINDS, KINDS_OF_WORDS, SENSES, Spoken, Trained, Weights, WeightsError, clue_name};
pub use conversation::{Conversation, Fact};
pub use correction::Corrected;
pub use hypothesis::Hypothesis;
pub use listening::Listened;
pub use verdict::{Reading, Verdict};
