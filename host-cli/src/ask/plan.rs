//! The actions that lead to a goal.

use goodbot::memory::AgentMemory;
use goodbot::oomdp::{Domain, apply};
use goodbot::planning::OptimalSet;
use goodbot::{Agent, AgentError};

/// The longest plan that is printed.
const LONGEST: usize = 1_000;

/// The names of actions, one after another.
#[derive(Clone, Debug)]
pub struct Plan {
    /// The actions.
    pub actions: Vec<String>,
    /// Whether there is no shorter way.
    pub is_exact: bool,
}

impl Default for Plan {
    fn default() -> Self {
        Self { actions: vec![], is_exact: true }
    }
}

impl Plan {
    /// This one and then another.
    #[must_use]
    pub fn and(self, mut other: Self) -> Self {
        let mut actions = self.actions;
        actions.append(&mut other.actions);
        Self { actions, is_exact: self.is_exact && other.is_exact }
    }
}

/// The plan for a task of the agent's session from a state on, and the state at its end; nothing where it is not known or there is none.
///
/// # Errors
/// An [`AgentError`].
pub fn plan<D: Domain>(
    agent: &mut Agent<impl AgentMemory>,
    home: &D,
    start: D::State,
    task: usize,
) -> Result<Option<(Plan, D::State)>, AgentError> {
    let (mut state, mut plan) = (start, Plan::default());
    while plan.actions.len() < LONGEST {
        agent.plan_fully(home, &state)?;
        let here = agent.planned().optimal(task);
        if here == OptimalSet::Goal {
            return Ok(Some((plan, state)));
        }
        let Some(actions) = here.onward() else { return Ok(None) };
        plan.is_exact &= here.exact().is_some();
        let Some((action, next)) = actions.iter().next().and_then(|action| Some((action, apply(home, &state, action)?))) else { break };
        plan.actions.push(home.actions().get(action.index()).map_or_else(String::new, |action| action.name.to_owned()));
        state = next;
    }
    Ok(None)
}
