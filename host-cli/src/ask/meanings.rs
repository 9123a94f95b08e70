//! The tasks that an utterance may mean, as the robot hears it once, and the actions that lead to their goals: one task, or those of several
//! parts with one plan for all.

use super::why::Word;
use super::{AskOptions, why};
use crate::teach::site::{Setting, Site, SiteState};
use crate::words::task_words;
use goodbot::home::Moves;
use goodbot::memory::{AgentHeap, AgentMemory};
use goodbot::oomdp::{Domain, apply};
use goodbot::planning::OptimalSet;
use goodbot::talk::{ClosedWords, Hypothesis, Listened, Verdict};
use goodbot::task::GroundedTask;
use goodbot::{Agent, AgentError, Capacities, Options};
use goodbot_console::{Failure, input, restored};
use goodbot_lesson::home;
use goodbot_lesson::name::task_name;
use goodbot_lesson::world::robot::{self, Tables, WorldFlaw};
use std::sync::Arc;

/// A task that an utterance may mean.
#[derive(Clone, Debug)]
pub struct Meaning {
    /// The task, as in files.
    pub name: String,
    /// The task in words.
    pub words: String,
    /// The probability that it is meant.
    pub probability: f32,
    /// Whether it is done already.
    pub done: bool,
}

/// The reading of an utterance.
#[derive(Debug)]
pub struct Interpretation {
    /// The verdict and the kind of utterance.
    pub listened: Listened,
    /// The tasks and the plan, if it is no plain command.
    pub followed: Option<Followed>,
    /// The most likely tasks, each with the state in which it begins.
    pub steps: Vec<Step>,
    /// The session's tasks in order. With each, its probability if the utterance is a command.
    pub tasks: Vec<Meaning>,
    /// The position of the likeliest of them that is still to do.
    pub best: Option<usize>,
    /// The words of the utterance, each with its explanation by that task.
    pub words: Vec<Word>,
    /// All meanings, the most probable first.
    pub meanings: Vec<Meaning>,
}

/// The robot listens to an utterance. `read` are the words of it that are read.
/// Afterwards the agent's session is about the utterance, or about its last part if it has several.
///
/// # Errors
/// An [`AgentError`].
pub fn meanings(
    agent: &mut Agent<impl AgentMemory>,
    site: &Site,
    start: &SiteState,
    (utterance, read): (&str, &str),
    closed: ClosedWords<'_>,
) -> Result<Interpretation, AgentError> {
    let listened = agent.listen(site, start, utterance, closed)?;
    let tasks = of_session(agent, site);
    let likelier = |best: Option<usize>, at: usize| {
        let of = |at: usize| tasks.get(at).map_or(0.0, |task: &Meaning| task.probability);
        if best.is_some_and(|best| of(best) >= of(at)) { best } else { Some(at) }
    };
    let best = (0..tasks.len()).filter(|&at| tasks.get(at).is_some_and(|task| !task.done)).fold(None, likelier);
    let words = why::words(agent, site, start, read, best.unwrap_or(listened.task))?;
    let steps = agent.tasks().get(listened.task).map(|task| (*task, *start)).into_iter().collect();
    let followed = match is_followed(listened.hypothesis) {
        true => Some(follow(agent, site, start, utterance, closed, listened)?),
        false => None,
    };
    let mut meanings: Vec<Meaning> = match &followed {
        Some(Followed { name, .. }) if name.is_empty() => vec![],
        Some(Followed { name, words, probability, verdict, .. }) => {
            vec![Meaning { name: name.clone(), words: words.clone(), probability: *probability, done: *verdict == Verdict::Done }]
        }
        None => tasks.iter().map(|task| Meaning { probability: listened.command * task.probability, ..task.clone() }).collect(),
    };
    meanings.sort_by(|a, b| b.probability.total_cmp(&a.probability));
    let steps = followed.as_ref().map_or(steps, |followed| followed.steps.clone());
    Ok(Interpretation { listened, followed, steps, tasks, best, words, meanings })
}

/// The tasks of the agent's session.
fn of_session(agent: &Agent<impl AgentMemory>, site: &Site) -> Vec<Meaning> {
    let done = agent.done(site);
    let of = |(position, task): (usize, &GroundedTask)| {
        let kind = agent.lifted().get(usize::from(task.lifted))?;
        let name = task_name(site, kind, task).map(|name| name.to_string()).unwrap_or_default();
        let probability = agent.belief().probability(position);
        Some(Meaning { name, words: task_words(site, kind, task), probability, done: done.contains(position) })
    };
    agent.tasks().iter().enumerate().filter_map(of).collect()
}

/// The tasks of an utterance, one after another.
#[derive(Clone, Debug)]
pub struct Followed {
    /// The tasks, as in files, joined by `then`.
    pub name: String,
    /// The tasks in words.
    pub words: String,
    /// The probability of all together.
    pub probability: f32,
    /// The verdict on the whole utterance.
    pub verdict: Verdict,
    /// The actions for all tasks, if they are known.
    pub plan: Option<Plan>,
    /// The steps of the plan, in order.
    pub steps: Vec<Step>,
    /// The state at the end.
    pub end: SiteState,
}

/// A task, and the state in which it begins.
pub type Step = (GroundedTask, SiteState);

/// Whether an utterance of this kind is followed differently from a plain command.
pub const fn is_followed(hypothesis: Hypothesis) -> bool {
    matches!(hypothesis, Hypothesis::Negated | Hypothesis::Several | Hypothesis::All | Hypothesis::Again)
}

/// Follows an utterance whose first part the agent has heard. Each part begins in the state in which the part before ends.
///
/// # Errors
/// An [`AgentError`].
pub fn follow(
    agent: &mut Agent<impl AgentMemory>,
    site: &Site,
    start: &SiteState,
    utterance: &str,
    closed: ClosedWords<'_>,
    first: Listened,
) -> Result<Followed, AgentError> {
    let (mut state, mut part, mut rest) = (*start, first, utterance);
    let (mut names, mut words, mut verdicts, mut steps) = (vec![], vec![], vec![], vec![]);
    let (mut probability, mut whole) = (1.0, Some(Plan::default()));
    loop {
        probability *= part.probability;
        verdicts.push(if part.tasks.is_empty() { Verdict::Unsure } else { part.verdict });
        for task in part.tasks.iter() {
            let Some((grounded, kind)) =
                agent.tasks().get(task).and_then(|grounded| Some((*grounded, agent.lifted().get(usize::from(grounded.lifted))?.clone())))
            else {
                continue;
            };
            names.push(task_name(site, &kind, &grounded).map(|name| name.to_string()).unwrap_or_default());
            words.push(task_words(site, &kind, &grounded));
            steps.push((grounded, state));
            let planned = plan(agent, site, state, task)?;
            state = planned.as_ref().map_or(state, |(_, end)| *end);
            whole = whole.zip(planned).map(|(whole, (more, _))| whole.and(more));
        }
        let Some(after) = part.rest.and_then(|at| rest.get(at..)) else { break };
        rest = after;
        part = agent.listen_on(site, &state, rest, closed)?;
    }
    let verdict = if verdicts.iter().all(|verdict| *verdict == Verdict::Done) {
        Verdict::Done
    } else if verdicts.iter().all(|verdict| matches!(verdict, Verdict::Sure | Verdict::Done)) {
        Verdict::Sure
    } else {
        Verdict::Unsure
    };
    Ok(Followed { name: names.join(" then "), words: words.join(", then "), probability, verdict, plan: whole, steps, end: state })
}

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
