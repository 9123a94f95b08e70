//! The layer: a discriminative model over the tasks that are possible in a session, above the role model. With the feature `layer`.
//!
//! The role model says how probable the words are where a task is meant, and is sure too early. The layer learns where it is wrong. With t a
//! task, e the words, d the parts of a task and p the posterior of the role model,
//!
//! ```text
//! Pr(t|e,s) proportional to exp(a log(p(t|e,s) + 0.03 / T) + sum over the parts d of t of U_d(e)),   T the number of tasks here
//! ```
//!
//! The parts of a task are its kind, and each value of what it speaks of, with the role (`parts`). g(w,v) is how often the role model took the
//! word w for the value v, of all times that it was heard. U of a kind is a constant, and a weight for each word. U of a value is, over the
//! words with g > 0.05, a weight of the word, and g times a weight for each thing that stands around the word (`contexts`); all values of a
//! role share those. So the layer learns "avoid" from one color and knows it with another. Where tasks are told by words of names, U of a
//! value also has a constant and a weight for each word, whatever its g: with few meanings a word and a value often occur only together, and
//! the role model takes the word for one of several. A meaning told n times teaches there as much as the root of n.
//!
//! So it weighs the tasks of kinds that were meant before. The tasks of all other kinds are weighed among themselves: of those kinds nothing
//! was learned, and they keep the probability that the role model gives them together. There are two exceptions (`unmet`). Where tasks have
//! ways, in a new scene, a command that names no way means none. And a kind that no session could mean is decided by new words.
//!
//! In a scene that was taught often (`scenes`), small recurrent networks read the words in their order (`network`). They only share out what
//! the tasks that were meant there have together.
//!
//! It is trained to give each session's tasks the shares that the session has shown (`training`), with
//! - p from a model that has not seen the session: two models are trained, each without half of the sessions, and with 30
//!   batches for the kind of task;
//! - weights pulled towards 0, and a towards 1, by pulls that do not grow with the sessions, so that few sessions leave p as it is.
//!
//! From eight sessions on, there is a layer: with fewer it understood less than the role model alone.
//!
//! It needs the tasks of each session that were not meant, too, in memory of its own ([`LayerMemory`]). Where there is none of it, or it is
//! full, the layer is silent, and all is as without it.

mod tables;

#[cfg(feature = "layer")]
mod contexts;
#[cfg(feature = "layer")]
pub(crate) mod fold;
#[cfg(feature = "layer")]
mod known;
#[cfg(feature = "layer")]
mod network;
#[cfg(feature = "layer")]
mod parts;
#[cfg(feature = "layer")]
mod posterior;
#[cfg(feature = "layer")]
mod scenes;
#[cfg(feature = "layer")]
mod speaking;
#[cfg(feature = "layer")]
pub(crate) mod training;
#[cfg(feature = "layer")]
mod unmet;
#[cfg(feature = "layer")]
mod weights;

#[cfg(feature = "layer")]
pub(in crate::language) use known::Known;
#[cfg(feature = "layer")]
pub use tables::LAYER_WEIGHTS;
pub(in crate::language) use tables::Layer;
pub use tables::LayerMemory;
#[cfg(feature = "layer")]
pub(in crate::language) use tables::LayerRef;
