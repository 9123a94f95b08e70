//! Where a task would lead the robot, for the ghost on the floor plan.

use goodbot::home::{Home, HomeState};
use goodbot::oomdp::apply;
use goodbot::planning::{GoalTable, OptimalSet, Progress, Search};
use goodbot::task::TaskSet;

use crate::cells::{Lookout, SCOUT, Scout, memory};

/// How many states a look ahead may expand before it is given up.
const MOST_EXPANDED: u32 = 200_000;
/// How many steps it may go.
const MOST_STEPS: usize = 300;

/// A scout who has not looked yet.
pub fn scout() -> Scout {
    Scout::new(memory(&SCOUT), |memory| {
        let session = memory.borrow_mut().split().agent.session;
        Lookout { goals: GoalTable::new(session.goals), search: Search::new(session.plan) }
    })
}

/// The states from `state` to the task's goal, following the first optimal action each time. `None` where there is no way, or where
/// finding it takes too long.
pub fn follow(lookout: &mut Lookout<'_>, home: &Home<'_>, state: &HomeState, task: usize) -> Option<Vec<HomeState>> {
    let mut states = vec![*state];
    let mut left = MOST_EXPANDED;
    while states.len() <= MOST_STEPS {
        let here = *states.last()?;
        lookout.search.begin(home, &lookout.goals, &here, TaskSet::of(task), TaskSet::EMPTY);
        if lookout.search.advance(home, &lookout.goals, left) == Progress::Working {
            return None;
        }
        left = left.saturating_sub(lookout.search.looks());
        match lookout.search.optimal(task) {
            OptimalSet::Goal => return Some(states),
            OptimalSet::Toward(actions) => states.push(apply(home, &here, actions.iter().next()?)?),
            OptimalSet::DeadEnd(_) | OptimalSet::Unknown => return None,
        }
    }
    None
}
