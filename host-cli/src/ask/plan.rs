//! The actions that lead to a goal.

use goodbot::memory::{AgentHeap, AgentMemory};
use goodbot::oomdp::{Domain, apply};
use goodbot::planning::OptimalSet;
use goodbot::task::GroundedTask;
use goodbot::{Agent, AgentError, Capacities, Options};

/// The longest plan that is printed.
const LONGEST: usize = 1_000;

/// The names of actions, one after another.
#[derive(Clone, Debug)]
pub struct Plan {
    /// The actions.
    pub actions: Vec<String>,
    /// Whether it is known that no plan is shorter.
    pub is_exact: bool,
}

impl Default for Plan {
    fn default() -> Self {
        Self { actions: vec![], is_exact: true }
    }
}

impl Plan {
    /// This plan and then another.
    #[must_use]
    pub fn and(self, mut other: Self) -> Self {
        let mut actions = self.actions;
        actions.append(&mut other.actions);
        Self { actions, is_exact: self.is_exact && other.is_exact }
    }
}

/// The plan for a task of the agent's session from a state on, and the state at its end; `None` if no plan is known.
///
/// # Errors
/// An [`AgentError`].
pub fn plan<D: Domain>(
    agent: &mut Agent<impl AgentMemory>,
    home: &D,
    start: D::State,
    task: usize,
) -> Result<Option<(Plan, D::State)>, AgentError> {
    match alone(agent, home, &start, task)? {
        Some((mut alone, task)) => plan_on(&mut alone, home, start, task),
        None => plan_on(agent, home, start, task),
    }
}

/// A robot with this task alone, and the task's position there: it does not plan for other tasks at each step. `None` if no command asks
/// for the task, such as a prohibition.
fn alone<D: Domain>(
    agent: &Agent<impl AgentMemory>,
    home: &D,
    start: &D::State,
    task: usize,
) -> Result<Option<(Agent<AgentHeap>, usize)>, AgentError> {
    let Some(wanted) = agent.tasks().get(task).copied() else { return Ok(None) };
    let is_wanted = |it: &GroundedTask| (it.lifted, it.bindings, it.way) == (wanted.lifted, wanted.bindings, wanted.way);
    let mut alone = Agent::new(AgentHeap::new(&Capacities::STANDARD), agent.lifted(), Options::DEFAULT)?;
    match alone.hear_with_prior(home, start, "do", |it, _| f32::from(u8::from(is_wanted(it)))) {
        Err(AgentError::NoPrior | AgentError::NoTask) => return Ok(None),
        heard => heard?,
    }
    let position = alone.tasks().iter().position(is_wanted);
    Ok(position.map(|position| (alone, position)))
}

fn plan_on<D: Domain>(
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

#[cfg(test)]
mod tests {
    use super::*;
    use goodbot::home::{Moves, paper_tasks};
    use goodbot_lesson::home;

    #[test]
    fn a_task_that_is_planned_for_alone_has_the_plan_that_it_has_beside_others() {
        let drawing = "###########\n#rrrr#bbbb#\n#rrBr+bbbb#\n#r@rr#bbGb#\n###+####+##\n#gggg+yyyy#\n#gggg#yyyy#\n###########\nB: yellow bag\nG: tan chair\n";
        let environment = home::parse("home", drawing).unwrap();
        let (home, start) = home::build(&environment, Moves::Push, home::memory()).unwrap();
        let mut agent = Agent::new(AgentHeap::new(&Capacities::STANDARD), &paper_tasks().unwrap(), Options::DEFAULT).unwrap();
        agent.hear(&home, &start, "go").unwrap();
        let mut longest = 0;
        for task in 0..agent.tasks().len() {
            let beside = plan_on(&mut agent, &home, start, task).unwrap().unwrap();
            let alone = plan(&mut agent, &home, start, task).unwrap().unwrap();
            assert_eq!((&alone.0.actions, alone.0.is_exact, alone.1), (&beside.0.actions, beside.0.is_exact, beside.1), "{task}");
            longest = longest.max(alone.0.actions.len());
        }
        assert!(longest > 8, "{longest}");
    }
}
