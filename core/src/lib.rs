//! goodbot: you tell a robot in your own words what to do, say "good bot" or "bad bot" while it tries, and it learns what your words mean.
//!
//! The robot's mind is an [`Agent`]: it hears, plans, decides and learns. It lives in a [`Domain`](oomdp::Domain), which is a
//! [`Home`](home::Home) or a robot of your own. It follows *Training an Agent to Ground Commands with Reward and Punishment* (MacGlashan,
//! Littman, Loftin, Peng, Roberts, Taylor).
//!
//! # A robot that learns
//! ```
//! use goodbot::{Agent, Options, feedback::Feedback, home::{self, Area, Cell, HomeBuilder, Moves}, session::Evidence};
//! goodbot::memory! { struct Memory = goodbot::Capacities::SMALL; }
//! let mut memory = Memory::new();
//! let mut builder = HomeBuilder::new(&mut memory.home);
//! builder.room("room0", Area::new(0, 0, 8, 4), "red")?;
//! builder.room("room1", Area::new(0, 4, 8, 8), "green")?;
//! builder.door("door0", Area::new(2, 4, 2, 4))?;
//! builder.agent("agent0", Cell::new(4, 2))?;
//! let (home, mut state) = builder.build(Moves::Push)?;
//! let mut agent = Agent::new(&mut memory.agent, &home::paper_tasks()?, Options::DEFAULT)?;
//!
//! agent.hear(&home, &state, "go to the green room")?;
//! for _ in 0..6 {
//!     agent.plan_fully(&home, &state)?;
//!     let decision = agent.decide(&home, &state)?;
//!     state = agent.acted(&home, &state, decision.action)?;
//!     assert_eq!(agent.feedback(Feedback::Reward)?, Evidence::Used);
//! }
//! assert_eq!(agent.finish(&home)?.gave_way.count(), 0);
//! agent.learn_fully();
//! assert_eq!(home.agent_cell(&state).y, 5);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! # The modules
//! In the order in which data flows through them:
//!
//! | module | what it holds |
//! |---|---|
//! | [`oomdp`] | object-oriented MDPs: classes, attributes, objects, propositional functions; the interface to your own robot |
//! | [`home`] | the paper's environment: rooms, doors, blocks, an agent |
//! | [`task`] | lifted and grounded tasks, binding constraints, machine commands |
//! | [`planning`] | uniform-cost search for all tasks at once; it keeps all first actions of equal cost, and the agent chooses |
//! | [`feedback`] | trainer strategies and the belief over tasks (SABL, I-SABL) |
//! | [`language`] | words: the role model, IBM Model 2, weighted EM, forgetting when memory is full |
//! | [`session`] | Algorithm 1: the [`Agent`] |
//! | [`asking`] | questions: when asking teaches more than acting (feature `asking`) |
//! | `voice` | praise, blame, "stop", "yes" in words (feature `asking`) |
//! | `talk` | what people say besides commands, and what words such as "it" refer to (feature `talk`) |
//! | [`snapshot`] | the learned parameters and training data as bytes |
//! | [`storage`] | those bytes in flash, safe from power cuts |
//!
//! Beside them: [`capacity`] and [`mod@memory`] (the size of every table, and who owns it), [`symbols`] (names), [`probability`] (products
//! that never underflow) and [`random`] (draws).
//!
//! # Features
//! On by default: `learning` (without it a robot uses parameters that another robot learned), `asking` (questions, and praise, blame, "stop"
//! and "yes" in words), `model2` (the paper's language model), `ways` (through, avoiding, then; and derived facts such as leftmost) and
//! `unicode` (letters beyond ASCII). A controller enables only those that it needs. The others:
//!
//! | feature | what it adds |
//! |---|---|
//! | `alloc` | for hosts: `HeapMemory`, `oomdp::check`, `Lessons::of`, `Synonyms::in_known_words`, `Agent::saved`, with `unicode` one form for a letter that can be written in several ways; homes of 24 blocks and 96 objects, 256 tasks, and 255 actions |
//! | `layer` | with `alloc`: a layer above the role model, which a host hands over: the crate `goodbot-layer` has one |
//! | `talk` | what people say besides commands |
//!
//! Every error is a [`core::error::Error`], the same trait as the standard library's: `?` turns it into a `Box<dyn Error>` with any
//! features.
//!
//! # What it promises
//! No allocation, no `unsafe`, no panic on any input. Every capacity is a field of [`Capacities`], and an error names the field to raise.
//! It uses only `+ - * /` on f32, and a logarithm made of them: the same input gives the same bits on x86-64, wasm32, Cortex-M and RISC-V.
//! Long work runs in parts, with a budget that the caller sets.

#![no_std]
// docs.rs sets it: each item then shows the feature that it needs.
#![cfg_attr(docsrs, feature(doc_cfg))]
#![forbid(unsafe_code)]
#![deny(missing_docs)]
#![cfg_attr(not(feature = "learning"), allow(dead_code, unused_imports, reason = "lessons alone need some of it"))]
#![deny(clippy::indexing_slicing, clippy::unwrap_used, clippy::expect_used, clippy::panic, clippy::unreachable)]
#![cfg_attr(test, allow(clippy::unwrap_used, clippy::expect_used, clippy::panic, clippy::indexing_slicing))]

#[cfg(feature = "alloc")]
extern crate alloc;
#[cfg(test)]
extern crate std;

#[macro_use]
pub mod memory;
#[cfg(feature = "asking")]
pub mod asking;
pub mod capacity;
mod checksum;
mod decimal;
pub mod feedback;
pub mod home;
pub mod language;
pub mod oomdp;
pub mod planning;
pub mod probability;
pub mod random;
pub mod session;
pub mod snapshot;
pub mod storage;
pub mod symbols;
#[cfg(feature = "talk")]
pub mod talk;
pub mod task;
#[cfg(feature = "asking")]
pub mod voice;

pub use capacity::list::Capacities;
#[cfg(feature = "alloc")]
pub use memory::heap::HeapMemory;
pub use session::agent::Agent;
pub use session::error::AgentError;
pub use session::options::Options;
