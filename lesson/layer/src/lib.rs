//! The layer: a discriminative model above the role model, over the tasks that are possible in a session.
//!
//! ```
//! use goodbot::{Agent, Capacities, Options, home, language::Settings, memory::AgentHeap};
//! let memory = goodbot_layer::above(AgentHeap::new(&Capacities::STANDARD), 4_000);
//! let options = Options { language: Settings::LAYERED, ..Options::DEFAULT };
//! let agent = Agent::new(memory, &home::paper_tasks()?, options)?;
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
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
//! It also needs the tasks that a session did not mean, in memory of its own (see [`above`]). If that is full, the layer has no effect.

#![forbid(unsafe_code)]
#![deny(missing_docs)]
#![deny(clippy::indexing_slicing, clippy::unwrap_used, clippy::expect_used, clippy::panic, clippy::unreachable)]
#![cfg_attr(test, allow(clippy::unwrap_used, clippy::expect_used, clippy::panic, clippy::indexing_slicing))]

mod contexts;
mod familiar;
mod fold;
mod learned;
mod network;
mod parts;
mod posterior;
mod scenes;
mod speaking;
mod training;
mod unmet;
mod weighed;
mod weights;

use goodbot::language::BitextRef;
use goodbot::language::layer::{Layer, LeftOut, Step, View};
use goodbot::memory::AgentHeap;
use goodbot::probability::Scaled;
use goodbot::symbols::Symbol;
use learned::Learned;
use network::Network;
use speaking::Found;
use training::Part;
use weights::CELLS;

/// Memory for an agent with a layer. `tasks` counts the possible tasks of all sessions together, also those that were not meant.
#[must_use]
pub fn above(memory: AgentHeap, tasks: usize) -> AgentHeap {
    memory.with_layer(Box::new(Layered::new(tasks)), tasks)
}

/// The least number of sessions for a layer: with fewer it understands less than the role model alone.
const LEAST_SESSIONS: usize = 8;

/// The layer, and the state of its training.
#[derive(Clone, Debug)]
struct Layered {
    /// One entry per task of a session: the posterior that the session showed.
    shares: Vec<f32>,
    /// One entry per task of a session: the posterior of a role model that has not seen the session.
    understood: Vec<f32>,
    /// As [`Weights::of`] takes them.
    weights: Vec<f32>,
    learned: Learned,
    /// The tasks that were meant in scenes that were taught often, sorted.
    taught: Vec<u32>,
    network: Network,
    left_out: LeftOut,
    next: Part,
    /// One entry per word, while a role model reads sessions that it has not seen: whether the word was heard in its own.
    heard: Vec<bool>,
    found: Found,
}

impl Layered {
    fn new(tasks: usize) -> Self {
        Self {
            shares: vec![0.0; tasks],
            understood: vec![0.0; tasks],
            weights: vec![0.0; 2 * CELLS],
            learned: Learned::NOTHING,
            taught: Vec::new(),
            network: Network::NONE,
            left_out: LeftOut::NONE,
            next: Part::Done,
            heard: Vec::new(),
            found: Found::default(),
        }
    }
}

impl Layer for Layered {
    fn begin(&mut self, possible: BitextRef<'_>) {
        self.forget();
        let teaches = |&session: &u16| tasks_of(possible, session) > 0;
        if (0..possible.sessions() as u16).filter(teaches).count() >= LEAST_SESSIONS {
            (self.left_out, self.next) = (LeftOut::FIRST, Part::Hear);
        }
    }

    fn forget(&mut self) {
        (self.learned.done, self.left_out, self.next) = (false, LeftOut::NONE, Part::Done);
    }

    fn left_out(&self) -> LeftOut {
        self.left_out
    }

    fn advance(&mut self, view: View<'_>) -> Step {
        self.train(view)
    }

    fn weigh<'d>(
        &self,
        view: View<'_>,
        sentence: &[Option<Symbol>],
        same: &dyn Fn(usize) -> usize,
        description: &dyn Fn(usize) -> &'d [Symbol],
        weights: &mut [Scaled],
    ) {
        self.weigh_tasks(view, sentence, same, description, weights);
    }

    fn boxed(&self) -> Box<dyn Layer> {
        Box::new(self.clone())
    }
}

/// The number of tasks of a session that the layer learns from; 0 if it learns nothing.
fn tasks_of(possible: BitextRef<'_>, session: u16) -> usize {
    let count = possible.pairs_of(session).len();
    if count < 2 { 0 } else { count }
}
