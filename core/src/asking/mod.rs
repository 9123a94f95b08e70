//! Questions: when asking the trainer teaches more than acting does.
//!
//! With c the posterior of the tasks for which the answer is yes, eta the probability of a wrong answer and h the binary entropy, a
//! question has the information I = h(c (1 - eta) + (1 - c) eta) - h(eta) bits. The information of an action is
//! [`Words::information`](crate::feedback::Words::information). A question that costs kappa steps is asked if I / kappa is more than the
//! mean information of the next n actions of the followed plan, for every n from 1 to 12. Looking only one step ahead asks too often: the
//! next step is often uninformative, but a step at the next door is not.
//!
//! - `settings`: the cost of a question, and the probability of a wrong answer;
//! - `question`: possible questions, and their information;
//! - `looking_ahead`: the information of the next steps;
//! - `agent`: how an [`Agent`](crate::Agent) asks, and takes the answer.
//!
//! ```
//! use goodbot::asking::{Answer, Asking};
//! use goodbot::{Agent, Options, home::{self, Area, Cell, HomeBuilder, Moves}, session::Evidence};
//! goodbot::memory! { struct Memory = goodbot::Capacities::SMALL; }
//! let mut memory = Memory::new();
//! let mut builder = HomeBuilder::new(&mut memory.home);
//! builder.room("room0", Area::new(0, 0, 8, 4), "red")?;
//! builder.room("room1", Area::new(0, 4, 4, 8), "green")?;
//! builder.room("room2", Area::new(4, 4, 8, 8), "blue")?;
//! builder.door("door0", Area::new(2, 4, 2, 4))?;
//! builder.door("door1", Area::new(6, 4, 6, 4))?;
//! builder.agent("agent0", Cell::new(4, 2))?;
//! let (home, state) = builder.build(Moves::Push)?;
//! let mut agent = Agent::new(&mut memory.agent, &home::paper_tasks()?, Options::DEFAULT)?;
//! agent.hear(&home, &state, "go to the green room")?;
//! agent.plan_fully(&home, &state)?;
//! // It knows no word: green or blue? A question of yes and no that costs two steps tells more than two steps do.
//! let asking = Asking { kappa: 2.0, choices: 0, ..Asking::DEFAULT };
//! let question = agent.question(&home, &state, &asking)?.expect("worth asking");
//! assert_eq!(agent.answer(Answer::Yes)?, Evidence::Used);
//! let meant: f32 = question.yes.iter().map(|task| agent.belief().probability(task)).sum();
//! assert!(meant > 0.94);
//! // It is sure enough now.
//! assert_eq!(agent.question(&home, &state, &asking)?, None);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod agent;
mod looking_ahead;
mod question;
mod settings;

pub(crate) use agent::Asked;
pub use agent::Considered;
pub use question::{Answer, Question, Subject};
pub use settings::{Asking, CHOICES};
