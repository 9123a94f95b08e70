//! The place of a session: a home, a world from a file, or a robot of one's own, with its current state.

use crate::error::value;
use crate::home::Home;
use crate::options::action_of;
use crate::robot::Robot;
use crate::world::World;
use goodbot::home::HomeState;
use goodbot::oomdp::{Action, action_name};
use goodbot_lesson::world::robot::Tables;
use pyo3::prelude::*;
use std::sync::Arc;

/// A domain and a state of it.
pub enum Place {
    Home(Py<Home>, HomeState),
    Robot(Arc<Robot>, u64),
    World(Arc<Tables>, u64),
}

/// Runs an expression in a place, whichever it is, with the domain and the state by reference.
macro_rules! in_place {
    ($place:expr, |$domain:ident, $state:ident| $run:expr) => {
        match $place {
            $crate::place::Place::Home(home, $state) => {
                let $domain = &home.get().rooms;
                $run
            }
            $crate::place::Place::Robot(robot, $state) => robot.lend(|$domain| $run),
            $crate::place::Place::World(tables, $state) => tables.lend(|$domain| $run),
        }
    };
}
pub(crate) use in_place;

/// As [`in_place`], also with the function from another state to the same place in that state.
macro_rules! in_place_and_on {
    ($py:expr, $place:expr, |$domain:ident, $state:ident, $on:ident| $run:expr) => {
        match $place {
            $crate::place::Place::Home(home, $state) => {
                let ($domain, $on) = (&home.get().rooms, |state| $crate::place::Place::Home(home.clone_ref($py), state));
                $run
            }
            $crate::place::Place::Robot(robot, $state) => {
                let $on = |state| $crate::place::Place::Robot(robot.clone(), state);
                robot.lend(|$domain| $run)
            }
            $crate::place::Place::World(tables, $state) => {
                let $on = |state| $crate::place::Place::World(tables.clone(), state);
                tables.lend(|$domain| $run)
            }
        }
    };
}
pub(crate) use in_place_and_on;

impl Place {
    /// The place that Python names. `last` keeps the last robot, so that it need not be read again.
    pub fn of(domain: &Bound<'_, PyAny>, state: &Bound<'_, PyAny>, last: &mut Option<Arc<Robot>>) -> PyResult<Self> {
        if let Ok(home) = domain.cast::<Home>() {
            return Ok(Self::Home(home.clone().unbind(), home.get().check(state)?));
        }
        if let Ok(world) = domain.cast::<World>() {
            let world = world.get();
            return Ok(Self::World(world.0.clone(), world.check(state)?));
        }
        let robot = match last.as_ref().filter(|robot| robot.is_of(domain)) {
            Some(robot) => robot.clone(),
            None => last.insert(Arc::new(Robot::of(domain)?)).clone(),
        };
        let number = robot.enter(state)?;
        Ok(Self::Robot(robot, number))
    }

    /// The state, as a Python object.
    pub fn state(&self, py: Python<'_>) -> PyResult<Py<PyAny>> {
        match self {
            Self::Home(home, state) => Ok(home.get().state(*state).into_pyobject(py)?.into_any().unbind()),
            Self::Robot(robot, number) => robot.state(py, *number).ok_or_else(|| value("this state was never seen")),
            Self::World(_, number) => Ok(number.into_pyobject(py)?.into_any().unbind()),
        }
    }

    /// The exception of the robot's class, if one was raised.
    pub fn failure(&self) -> Option<PyErr> {
        match self {
            Self::Home(..) | Self::World(..) => None,
            Self::Robot(robot, _) => robot.failure(),
        }
    }

    /// The action of this name.
    pub fn action(&self, name: &str) -> PyResult<Action> {
        in_place!(self, |domain, _state| action_of(domain, name))
    }

    /// The name of an action.
    pub fn action_text(&self, action: Action) -> String {
        in_place!(self, |domain, _state| action_name(domain, action).to_owned())
    }
}
