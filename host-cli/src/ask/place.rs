//! The places of questions, and the robots that answer there: one for all homes, and one for each world from a file.

use super::{AskOptions, Question};
use crate::teach::site::{Setting, Site, SiteState};
use goodbot::Agent;
use goodbot::memory::AgentHeap;
use goodbot_console::outcome::Failure;
use goodbot_console::restored;
use goodbot_formats::world::WorldFile;
use goodbot_lesson::home;
use goodbot_lesson::world::robot::{self, Robot, Tables, WorldFlaw};
use std::sync::Arc;

/// The robots, with the model of the options. Each is made for its first question.
pub struct Robots<'o> {
    options: &'o AskOptions,
    in_homes: Option<Agent<AgentHeap>>,
    in_worlds: Vec<(Arc<WorldFile>, Robot<'static>, Agent<AgentHeap>)>,
}

impl<'o> Robots<'o> {
    /// No robot yet.
    pub const fn new(options: &'o AskOptions) -> Self {
        Self { options, in_homes: None, in_worlds: Vec::new() }
    }

    /// The robot for a question, its place, and the state in which the question is asked.
    ///
    /// # Errors
    /// A [`Failure`] of the model, or of the place.
    pub fn at(&mut self, question: &Question) -> Result<(&mut Agent<AgentHeap>, Site, SiteState), Failure> {
        match &question.setting {
            Setting::Floor(environment) => {
                let (place, start) = home::build(environment, question.moves, home::memory()).map_err(|flaw| {
                    Failure::Input(format!("{}: field \"{}\": {}", question.source, flaw.field(), flaw.message(environment)))
                })?;
                Ok((self.in_homes()?, Site::Floor(place), SiteState::Floor(start)))
            }
            Setting::Other(world) => {
                let flawed = |flaw: WorldFlaw| Failure::Input(format!("{}: {flaw}", question.source));
                let known = self.in_worlds.iter().position(|(known, ..)| Arc::ptr_eq(known, world));
                let at = match known {
                    Some(at) => at,
                    None => {
                        let robot = Tables::of(Arc::clone(world)).map_err(flawed)?.keep();
                        let lifted = robot::tasks(world, &robot).map_err(flawed)?;
                        self.in_worlds.push((Arc::clone(world), robot, restored::agent_elsewhere(&self.options.with, &lifted)?));
                        self.in_worlds.len() - 1
                    }
                };
                let (_, robot, agent) = &mut self.in_worlds[at];
                let start = robot.state_of(question.facts.as_ref().unwrap_or(&world.facts)).map_err(flawed)?;
                Ok((agent, Site::Other(*robot), SiteState::Other(start)))
            }
        }
    }

    fn in_homes(&mut self) -> Result<&mut Agent<AgentHeap>, Failure> {
        let AskOptions { with, kinds, starter, .. } = self.options;
        let agent = match self.in_homes.take() {
            Some(agent) => agent,
            None => {
                let lifted = kinds.of_model(with)?;
                restored::agent_beside(with, &lifted, &starter.of_model(with, &lifted)?)?
            }
        };
        Ok(self.in_homes.insert(agent))
    }
}
