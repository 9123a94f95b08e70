//! A trainer for any robot: teaches commands by reward and punishment, and lets the robot obey.

use goodbot::feedback::Feedback;
use goodbot::memory::AgentMemory;
use goodbot::oomdp::{Action, Domain, action_name};
use goodbot::planning::Judgement;
use goodbot::{Agent, AgentError};

/// Teaches a command that means a task, such as `liftAtFloor(lift, floor3)`. The robot is judged until it has rightly rested three times in
/// a row, because the task is done or can no longer be done. Then it learns.
pub fn teach<D: Domain>(
    agent: &mut Agent<impl AgentMemory>,
    domain: &D,
    start: &D::State,
    command: &str,
    meaning: &str,
) -> Result<(), AgentError> {
    agent.hear(domain, start, command)?;
    let intended = agent.task_named(domain, meaning).unwrap_or_else(|| panic!("no task is called {meaning} here"));
    let (mut state, mut rests) = (*start, 0);
    while rests < 3 {
        agent.plan_fully(domain, &state)?;
        let decision = agent.decide(domain, &state)?;
        let plan = agent.planned();
        let right = plan.judge(intended, decision.action) == Judgement::Correct;
        rests = if right && decision.action == Action::NOOP { rests + 1 } else { 0 };
        state = agent.acted(domain, &state, decision.action)?;
        let _ = agent.feedback(if right { Feedback::Reward } else { Feedback::Punish })?;
    }
    let finished = agent.finish(domain)?;
    if finished.gave_way.count() > 0 {
        println!("{}", finished.gave_way);
    }
    agent.learn_fully();
    Ok(())
}

/// Gives a command, which the robot carries out as it understands it. Returns its actions and the final state.
pub fn obey<D: Domain>(
    agent: &mut Agent<impl AgentMemory>,
    domain: &D,
    start: &D::State,
    command: &str,
) -> Result<(Vec<String>, D::State), AgentError> {
    agent.hear(domain, start, command)?;
    let (mut state, mut actions) = (*start, vec![]);
    loop {
        agent.plan_fully(domain, &state)?;
        let decision = agent.decide(domain, &state)?;
        if decision.action == Action::NOOP {
            agent.forget();
            return Ok((actions, state));
        }
        actions.push(action_name(domain, decision.action).to_owned());
        state = agent.acted(domain, &state, decision.action)?;
    }
}
