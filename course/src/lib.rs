//! The paper's experiment as a course: seven lessons, then five tests, with a simulated trainer.
//!
//! | module | contents |
//! |---|---|
//! | [`exercise`] | the commands, each with its meaning and its home |
//! | [`layout`] | the homes: drawn, or [at random](layout::random) for each seed |
//! | [`trainer`] | the simulated trainers |
//! | [`lesson`] | one lesson: command, actions, feedback, and when the trainer ends it |
//! | [`course`] | the whole course, and its observers |
//!
//! The crate needs neither heap nor standard library, and one [`generator`] feeds every choice: the command line, a web page and a
//! controller that start from the same seed see the same course.
//!
//! ```
//! use goodbot::feedback::Strategy;
//! use goodbot::{Agent, Options, home};
//! use goodbot_course::{CourseTrainer, Homes, generator, run_course};
//! goodbot::memory! { struct Memory = goodbot::Capacities::SMALL; }
//! let mut memory = Memory::new();
//! let mut agent = Agent::new(memory.agent, &home::paper_tasks()?, Options::PAPER)?;
//! // The trainer never rewards; the agent assumes that it may.
//! let (trainer, believed) = (CourseTrainer::PUNISH_ONLY, Strategy::PUNISH_ONLY);
//! let results = run_course(&mut agent, &mut memory.home, &Homes::FIXED, &trainer, believed, &mut generator(1), &mut ())?;
//! assert!(results.tests.iter().all(|test| test.right));
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

#![no_std]
#![forbid(unsafe_code)]
#![deny(missing_docs)]
#![deny(clippy::indexing_slicing, clippy::unwrap_used, clippy::expect_used, clippy::panic, clippy::unreachable)]

pub mod course;
pub mod error;
pub mod exercise;
pub mod layout;
pub mod lesson;
pub mod next_lesson;
mod seed;
pub mod trainer;

pub use course::{Observer, Results, Scene, TestReport, run_course};
pub use error::CourseError;
pub use exercise::{Exercise, HomeName, Intention, LESSONS, TESTS};
pub use layout::{Homes, Layout};
pub use lesson::{Ending, FeedbackCounts, Lesson, LessonReport, Step, Turn, run_lesson};
pub use seed::generator;
pub use trainer::{CourseTrainer, SimulatedTrainer, Trainer};
