//! A robot of another kind in the same rooms: it turns left, turns right and drives forward, and its heading is part of its state.
//!
//! A robot brings only this: its state, its actions with their costs and effects, and a number for each state. The objects and the
//! propositional functions are the home's, so a command learned by one robot is understood by the other.

use goodbot::home::{Home, HomeState};
use goodbot::memory::HomeMemory;
use goodbot::oomdp::{Action, ActionKind, Domain, GroundProposition, OneByOne, World};

/// The cost of driving forward; a turn costs half as much.
const ACTIONS: [ActionKind<'static>; 3] = [ActionKind::new("left", 1), ActionKind::new("right", 1), ActionKind::new("forward", 2)];

/// The home's actions for each heading: north, east, south, west.
const AHEAD: [Action; 4] = [Action::new(0), Action::new(2), Action::new(1), Action::new(3)];

/// The positions of everything, and the heading of the robot.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TurningState {
    /// The positions of everything.
    pub home: HomeState,
    /// 0 north, 1 east, 2 south, 3 west.
    pub heading: u8,
}

/// The robot and its rooms.
pub struct TurningRobot<M> {
    /// The rooms.
    pub home: Home<M>,
}

impl<M: HomeMemory> Domain for TurningRobot<M> {
    type State = TurningState;
    type Search = OneByOne;

    fn world(&self) -> World<'_> {
        self.home.world()
    }

    fn actions(&self) -> &[ActionKind<'_>] {
        &ACTIONS
    }

    fn step(&self, state: &TurningState, action: Action) -> Option<TurningState> {
        match action.index() {
            0 => Some(TurningState { heading: (state.heading + 3) % 4, ..*state }),
            1 => Some(TurningState { heading: (state.heading + 1) % 4, ..*state }),
            2 => {
                let ahead = AHEAD.get(usize::from(state.heading))?;
                Some(TurningState { home: self.home.step(&state.home, *ahead)?, ..*state })
            }
            _ => None,
        }
    }

    fn holds(&self, proposition: &GroundProposition, state: &TurningState) -> bool {
        self.home.holds(proposition, &state.home)
    }

    fn state_count(&self) -> u64 {
        self.home.state_count().saturating_mul(4)
    }

    fn number(&self, state: &TurningState) -> u64 {
        self.home.number(&state.home) * 4 + u64::from(state.heading)
    }

    fn numbered(&self, number: u64) -> TurningState {
        TurningState { home: self.home.numbered(number / 4), heading: (number % 4) as u8 }
    }
}
