//! Robots that learn from reward and punishment, beside each other: the same lessons, the same trainers, the same words.
//!
//! | module | what it holds |
//! |---|---|
//! | [`trainer`] | who gives the lessons: what each says after a right and a wrong action, how late, and when it leaves |
//! | [`place`] | a command in a home: its tasks, what they are about, and what is right in each state |
//! | [`agent`] | who learns: goodbot, TAMER, COACH, Advise and a learner like Cobot |
//! | [`trial`] | one agent with one trainer: seven lessons, then five tests |
//! | [`tuning`] | how the settings of the others were chosen |
//!
//! ```
//! use goodbot_study::agent::AGENTS;
//! use goodbot_study::trainer::{TRAINERS, population::Population};
//! use goodbot_study::trial::{homes, run};
//! let (agent, trainer, seed) = (&AGENTS[0], &TRAINERS[0], 1);
//! let outcome = run(&agent.learns, trainer.habits(&Population::fitted(), seed), &homes(seed), seed)?;
//! assert_eq!(outcome.tests_right(), 5);
//! # Ok::<(), goodbot_course::CourseError>(())
//! ```

#![forbid(unsafe_code)]
#![deny(missing_docs)]

pub mod agent;
pub mod place;
pub mod trainer;
pub mod trial;
pub mod tuning;
