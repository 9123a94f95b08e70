//! Follows an utterance of several parts: a task for each part, and one plan for all.

use super::plan::{Plan, plan};
use crate::teach::plain_names::task_words;
use crate::teach::site::{Site, SiteState};
use goodbot::memory::AgentMemory;
use goodbot::talk::{ClosedWords, Hypothesis, Listened, Verdict};
use goodbot::task::GroundedTask;
use goodbot::{Agent, AgentError};
use goodbot_lesson::name::task_name;

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
