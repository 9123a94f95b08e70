//! The place of the commands, and the robot there.

use super::AskOptions;
use crate::teach::site::{Setting, Site, SiteState};
use goodbot::Agent;
use goodbot::home::Moves;
use goodbot::memory::AgentHeap;
use goodbot_console::load::input;
use goodbot_console::outcome::Failure;
use goodbot_console::restored;
use goodbot_lesson::home;
use goodbot_lesson::world::robot::{self, Tables, WorldFlaw};
use std::sync::Arc;

/// The robot with the model of the options, its place, and the state of the place's file.
///
/// # Errors
/// A [`Failure`] of the model, or of the place.
pub fn robot(options: &AskOptions, setting: &Setting) -> Result<(Agent<AgentHeap>, Site, SiteState), Failure> {
    let AskOptions { with, kinds, starter, .. } = options;
    let name = input::name(&options.environment);
    match setting {
        Setting::Floor(environment) => {
            let moves = if options.pull { Moves::PushAndPull } else { Moves::Push };
            let (place, start) = home::build(environment, moves, home::memory())
                .map_err(|flaw| Failure::Input(format!("{name}: field \"{}\": {}", flaw.field(), flaw.message(environment))))?;
            let lifted = kinds.of_model(with)?;
            let agent = restored::agent_beside(with, &lifted, &starter.of_model(with, &lifted)?)?;
            Ok((agent, Site::Floor(place), SiteState::Floor(start)))
        }
        Setting::Other(world) => {
            let flawed = |flaw: WorldFlaw| Failure::Input(format!("{name}: {flaw}"));
            let robot = Tables::of(Arc::clone(world)).map_err(flawed)?.keep();
            let agent = restored::agent_elsewhere(with, &robot::tasks(world, &robot).map_err(flawed)?)?;
            let start = robot.state_of(&world.facts).map_err(flawed)?;
            Ok((agent, Site::Other(robot), SiteState::Other(start)))
        }
    }
}
