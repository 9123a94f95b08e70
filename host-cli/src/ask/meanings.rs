//! The tasks that an utterance may mean, including tasks that are done already.
//!
//! A robot with enough lessons [listens](goodbot::talk). A robot with few lessons takes every utterance for a command. To score a task that
//! is done already, it hears the command in a state with one object elsewhere, in which the task is not done.

use super::following::{self, Followed, Step};
use goodbot::home::{Home, HomeState};
use goodbot::language::first_words;
use goodbot::memory::AgentMemory;
use goodbot::memory::HomeMemory;
use goodbot::oomdp::Domain;
use goodbot::probability::{Scaled, total};
use goodbot::talk::{ClosedWords, Listened, Verdict};
use goodbot::task::{GroundedTask, LiftedTask, ground};
use goodbot::{Agent, AgentError, Capacities};
use goodbot_lesson::listening::tells_talk;
use goodbot_lesson::name::{in_words, task_name};

/// A task that a command may mean.
#[derive(Clone, Debug)]
pub struct Meaning {
    /// The task, as in files.
    pub name: String,
    /// The task in words.
    pub words: String,
    /// The probability of the task.
    pub probability: f32,
    /// Whether it is done already.
    pub done: bool,
}

/// The reading of an utterance.
#[derive(Debug)]
pub struct Interpretation {
    /// The kind of utterance; `None` if the robot has too few lessons to tell.
    pub listened: Option<Listened>,
    /// The tasks and the plan, if it is no plain command.
    pub followed: Option<Followed>,
    /// The most likely tasks, each with the state in which it begins.
    pub steps: Vec<Step>,
    /// All possible meanings, the most probable first.
    pub meanings: Vec<Meaning>,
}

/// The kind of the utterance, and its possible meanings. Afterwards the agent has heard the utterance as a command in `start`, if there is
/// anything to do.
///
/// # Errors
/// An [`AgentError`], but not the error that there is nothing to do.
pub fn meanings(
    agent: &mut Agent<impl AgentMemory>,
    home: &Home<impl HomeMemory>,
    start: &HomeState,
    utterance: &str,
    closed: ClosedWords<'_>,
) -> Result<Interpretation, AgentError> {
    if !tells_talk(agent) {
        let meanings = of_command(agent, home, start, first_words(utterance))?;
        let likeliest = agent.most_likely().and_then(|task| agent.tasks().get(task));
        let steps = likeliest.map(|task| (*task, *start)).into_iter().collect();
        return Ok(Interpretation { listened: None, followed: None, steps, meanings });
    }
    let listened = agent.listen(home, start, utterance, closed)?;
    let followed = match following::is_followed(listened.hypothesis) {
        true => Some(following::follow(agent, home, start, utterance, closed, listened)?),
        false => None,
    };
    let steps = match &followed {
        Some(followed) => followed.steps.clone(),
        None => agent.tasks().get(listened.task).map(|task| (*task, *start)).into_iter().collect(),
    };
    let mut meanings: Vec<Meaning> = match &followed {
        Some(Followed { name, .. }) if name.is_empty() => vec![],
        Some(Followed { name, words, probability, verdict, .. }) => {
            vec![Meaning { name: name.clone(), words: words.clone(), probability: *probability, done: *verdict == Verdict::Done }]
        }
        None => of_session(agent, home, listened),
    };
    meanings.sort_by(|a, b| b.probability.total_cmp(&a.probability));
    match agent.hear(home, start, first_words(utterance)) {
        Ok(()) | Err(AgentError::NoTask) => Ok(Interpretation { listened: Some(listened), followed, steps, meanings }),
        Err(error) => Err(error),
    }
}

/// The possible meanings in the agent's session.
fn of_session(agent: &Agent<impl AgentMemory>, home: &Home<impl HomeMemory>, listened: Listened) -> Vec<Meaning> {
    let done = agent.done(home);
    let of = |(position, task): (usize, &GroundedTask)| {
        let kind = agent.lifted().get(usize::from(task.lifted))?;
        let probability = listened.command * agent.belief().probability(position);
        Some(meaning(home, kind, task, probability, done.contains(position)))
    };
    agent.tasks().iter().enumerate().filter_map(of).collect()
}

fn meaning(home: &Home<impl HomeMemory>, kind: &LiftedTask, task: &GroundedTask, probability: f32, done: bool) -> Meaning {
    let name = task_name(home, kind, task).map(|name| name.to_string()).unwrap_or_default();
    Meaning { name, words: in_words(home, kind, task), probability, done }
}

/// The possible meanings of a command, the most probable first. An unknown word makes every meaning less sure: the share of unknown words
/// falls back to the task prior. Afterwards the agent has heard the command in `start`, if there is anything to do.
///
/// # Errors
/// An [`AgentError`], but not the error that there is nothing to do.
fn of_command(
    agent: &mut Agent<impl AgentMemory>,
    home: &Home<impl HomeMemory>,
    start: &HomeState,
    command: &str,
) -> Result<Vec<Meaning>, AgentError> {
    let lifted: Vec<LiftedTask> = agent.lifted().to_vec();
    let done = done(home, start, &lifted);
    let mut explained: Vec<(GroundedTask, Scaled, bool)> = Vec::new();
    for task in done {
        if let Some(elsewhere) = undone(home, start, &lifted, &task) {
            agent.hear(home, &elsewhere, command)?;
            explained.extend(likelihoods(agent).into_iter().filter(|(it, _)| is_same(it, &task)).map(|(_, weight)| (task, weight, true)));
        }
    }
    match agent.hear(home, start, command) {
        Ok(()) => explained.extend(likelihoods(agent).into_iter().map(|(task, weight)| (task, weight, false))),
        Err(AgentError::NoTask) if !explained.is_empty() => {}
        Err(error) => return Err(error),
    }
    let unheard = unheard_share(agent);
    let groups = (0..lifted.len()).filter(|&kind| explained.iter().any(|(task, ..)| usize::from(task.lifted) == kind)).count();
    let prior = |task: &GroundedTask| {
        let alike = explained.iter().filter(|(other, ..)| other.lifted == task.lifted).count();
        1.0 / (groups.max(1) * alike.max(1)) as f32
    };
    let whole = total(explained.iter().map(|(task, weight, _)| weight.scaled_by(prior(task))));
    let mut meanings = Vec::new();
    for (task, weight, done) in &explained {
        let Some(kind) = lifted.get(usize::from(task.lifted)) else { continue };
        let said = if whole.is_zero() { prior(task) } else { weight.scaled_by(prior(task)).over(whole) };
        meanings.push(meaning(home, kind, task, (1.0 - unheard) * said + unheard * prior(task), *done));
    }
    meanings.sort_by(|a, b| b.probability.total_cmp(&a.probability));
    Ok(meanings)
}

/// The share of the command's words that training never had.
fn unheard_share(agent: &Agent<impl AgentMemory>) -> f32 {
    let (sentence, known) = (agent.sentence(), agent.language().tables().words());
    let unheard = sentence.iter().filter(|word| word.is_none_or(|word| word.index() >= known)).count();
    if known == 0 { 0.0 } else { unheard as f32 / sentence.len().max(1) as f32 }
}

/// The likelihood of the words for each task of the agent's session.
fn likelihoods(agent: &Agent<impl AgentMemory>) -> Vec<(GroundedTask, Scaled)> {
    let of = |(position, task): (usize, &GroundedTask)| (*task, agent.belief().weight(position).scaled_by(1.0 / task.prior));
    agent.tasks().iter().enumerate().map(of).collect()
}

fn is_same(a: &GroundedTask, b: &GroundedTask) -> bool {
    a.lifted == b.lifted && a.bindings == b.bindings
}

/// The tasks that hold in a state.
fn done(home: &Home<impl HomeMemory>, state: &HomeState, lifted: &[LiftedTask]) -> Vec<GroundedTask> {
    let mut found = Vec::new();
    // A task with a way is done by going that way, so it never holds in a single state.
    for (position, kind) in lifted.iter().enumerate().filter(|(_, kind)| !kind.has_way()) {
        let task = GroundedTask { lifted: position as u8, prior: 1.0, ..GroundedTask::UNUSED };
        bind(home, state, kind, task, 0, &mut found);
    }
    found
}

/// Binds the variables from `variable` on, and drops bindings that cannot hold.
fn bind(
    home: &Home<impl HomeMemory>,
    state: &HomeState,
    kind: &LiftedTask,
    task: GroundedTask,
    variable: usize,
    found: &mut Vec<GroundedTask>,
) {
    let bound = |variables: &[u8]| variables.iter().all(|&it| usize::from(it) < variable);
    for (part, grounded) in kind.propositions().iter().zip(task.propositions(kind)) {
        let parameters = home.world().schema.parameters(part.proposition).len();
        if part.variables.get(..parameters).is_some_and(bound) && !home.holds(&grounded, state) {
            return;
        }
    }
    let Some(&class) = kind.variables().get(variable) else {
        found.push(task);
        return;
    };
    for object in home.world().objects.of_class(class) {
        if task.bindings.get(..variable).is_some_and(|taken| taken.contains(&object)) {
            continue;
        }
        let mut task = task;
        if let Some(slot) = task.bindings.get_mut(variable) {
            *slot = object;
        }
        bind(home, state, kind, task, variable + 1, found);
    }
}

/// A state in which the task does not hold, because one object is elsewhere.
fn undone(home: &Home<impl HomeMemory>, start: &HomeState, lifted: &[LiftedTask], task: &GroundedTask) -> Option<HomeState> {
    let kind = lifted.get(usize::from(task.lifted))?;
    let bound = task.bindings.iter().take(kind.variables().len());
    let things = bound.filter(|&&object| object == home.agent() || home.blocks().contains(&object));
    let states = things.flat_map(|&thing| home.places().iter().filter_map(move |place| home.placed(start, &[(thing, place.cell())])));
    // From a doorway, tasks with ways have one more room to go through, and may be too many.
    let mut tasks = vec![GroundedTask::UNUSED; Capacities::STANDARD.tasks];
    let mut fits = |state: &HomeState| ground(home, lifted, state, &mut tasks).is_ok();
    states.into_iter().find(|state| task.propositions(kind).any(|part| !home.holds(&part, state)) && fits(state))
}
