//! The tasks that an utterance may mean, as the robot hears it once.

use super::following::{self, Followed, Step};
use super::why::{self, Word};
use crate::teach::plain_names::task_words;
use crate::teach::site::{Site, SiteState};
use goodbot::memory::AgentMemory;
use goodbot::talk::{ClosedWords, Listened, Verdict};
use goodbot::task::GroundedTask;
use goodbot::{Agent, AgentError};
use goodbot_lesson::name::task_name;

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
    let followed = match following::is_followed(listened.hypothesis) {
        true => Some(following::follow(agent, site, start, utterance, closed, listened)?),
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
