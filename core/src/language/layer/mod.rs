//! The layer: a discriminative model above the role model, over the tasks that are possible in a session. With the feature `layer`.
//!
//! The role model computes the probability of the words given a task, and is certain too early. The layer learns where it is wrong. With t
//! a task, e the words, d the parts of a task and p the posterior of the role model,
//!
//! ```text
//! Pr(t|e,s) proportional to exp(a log(p(t|e,s) + 0.03 / T) + sum over the parts d of t of U_d(e)),   T the number of tasks
//! ```
//!
//! The parts of a task (`parts`) are its kind, and each value of its things together with their role. g(w,v) is how often the role model
//! took the word w for the value v, as a share of the times it was heard; a word with g > 0.3 for some value is a mention. U of a kind is a
//! constant plus a weight for each word. U of a value is, over the words with g > 0.05, g times a weight for each feature of the word's
//! context (`contexts`): the two words before it, the word after it, the words since the mention before, and the numbers of mentions before
//! and after. All values of a role share these weights. So the layer learns "avoid" from one color and applies it to another. If the words
//! in names are values, U of a value also has a constant and a weight for each word, whatever its g: with few meanings a word and a value
//! often occur only together, and the role model takes the word for one of several. So it has in commands of at most two words, which may
//! name a whole task, such as "hop". Where the words in names are values, the layer is too sure where it is wrong, because there are few
//! meanings: a fifth of each probability is the role model's (a linear pool).
//!
//! If tasks have ways, all mentions are alike as words of a context, and a mention's context has a second weight for all roles of its kind
//! (any place to go through), and a third for all roles of the task, or all others. So what was learned of "through" holds in a home with
//! other names, and for a kind of task that was never meant.
//!
//! The formula applies to the tasks of kinds that were meant before. The tasks of all other kinds are weighed by it among themselves:
//! nothing was learned about those kinds, so together they keep the probability that the role model gives them. There are two exceptions
//! (`unmet`). If tasks have ways, a command in a new scene that names no way means none. And new words decide about a kind that no session
//! could mean.
//!
//! In a scene that was taught often (`scenes`), a small recurrent network reads the words in their order (`network`). It only shares out what
//! the tasks that were meant there have together.
//!
//! The target of training is each session's posterior of its tasks (`training`), with
//! - p from a model that has not seen the session: two models are trained, each without half of the sessions, and with 30 batches for the
//!   kind of task;
//! - weights pulled towards 0, and a towards 1, by pulls that do not grow with the number of sessions, so that few sessions leave p
//!   unchanged.
//!
//! The layer is used from eight sessions on: with fewer it understood less than the role model alone.
//!
//! It also needs the tasks that a session did not mean, in memory of its own ([`LayerMemory`]). If there is no such memory, or it is full,
//! the layer has no effect.

mod tables;

mod contexts;
pub(crate) mod fold;
mod known;
mod learned;
mod network;
mod parts;
mod posterior;
mod scenes;
mod speaking;
pub(crate) mod training;
mod unmet;
mod weighed;
mod weights;

pub(in crate::language) use known::CommandIndex;
pub(in crate::language) use tables::{FOLDS, Layer, LayerRef, LeftOut};
pub use tables::{LAYER_WEIGHTS, LayerMemory};
