//! What is trained on, what is asked, and what was answered.

use super::method::{Method, Trained};
use crate::lessons::{Lesson, bar, training};
use goodbot::AgentError;
use goodbot::language::Settings;
use rand_core::Rng;
use rayon::prelude::*;
use std::num::NonZeroUsize;

/// What was answered to one command.
#[derive(Clone, Debug)]
pub struct Answer {
    /// The session.
    pub id: String,
    /// What was said.
    pub command: String,
    /// What was meant, and its kind.
    pub meant: (String, String),
    /// The most likely task (the first in order of equals), and its kind.
    pub said: (String, String),
    /// The probability of what was meant, and of what was said.
    pub probabilities: (f32, f32),
    /// Whether the two are the same.
    pub right: bool,
    /// The words that speak most for a mistake.
    pub telling: Vec<(String, f32)>,
}

/// The sessions by the part that they are asked in: one each, or K of about the same size, shuffled.
pub fn parts(count: usize, k: Option<NonZeroUsize>, seed: u64) -> Vec<Vec<usize>> {
    let Some(k) = k else { return (0..count).map(|position| vec![position]).collect() };
    let mut parts = vec![Vec::new(); k.get().min(count)];
    let whole = parts.len();
    for (position, session) in shuffled(count, seed).into_iter().enumerate() {
        parts[position % whole].push(session);
    }
    parts
}

/// The numbers up to `count` in an order that the seed draws.
pub fn shuffled(count: usize, seed: u64) -> Vec<usize> {
    let mut random = goodbot_course::generator(seed);
    let mut order: Vec<usize> = (0..count).collect();
    for last in (1..count).rev() {
        order.swap(last, random.next_u32() as usize % (last + 1));
    }
    order
}

/// For each part, trains on all others and asks what is `asked` in place of each of its sessions.
///
/// # Errors
/// An [`AgentError`] where a command has no room.
pub fn ask_all(
    lessons: &[Lesson],
    asked: &[Vec<Lesson>],
    parts: &[Vec<usize>],
    method: Method,
    settings: Settings,
) -> Result<Vec<Answer>, AgentError> {
    let progress = bar(parts.len(), "training");
    let actions: Vec<Lesson> = if method == Method::Action { lessons.iter().map(by_actions).collect() } else { vec![] };
    let taught = if method == Method::Action { &actions[..] } else { lessons };
    let answers: Vec<Vec<Answer>> = parts
        .par_iter()
        .map_init(
            || training::memory(taught),
            |memory, part| {
                let others = taught.iter().enumerate().filter(|(position, _)| !part.contains(position)).map(|(_, lesson)| lesson);
                let mut trained = Trained::on(method, memory, others, settings)?;
                let mut answers = Vec::new();
                for lesson in part.iter().filter_map(|&session| asked.get(session)).flatten() {
                    let by_plans = (method == Method::Action).then(|| by_plans(lesson));
                    answers.extend(ask(&mut trained, by_plans.as_ref().unwrap_or(lesson))?);
                }
                progress.inc(1);
                Ok(answers)
            },
        )
        .collect::<Result<_, AgentError>>()?;
    progress.finish_and_clear();
    Ok(answers.into_iter().flatten().collect())
}

/// Asks for one command. Nothing where it is not known what was meant.
pub fn ask(trained: &mut Trained<'_>, lesson: &Lesson) -> Result<Option<Answer>, AgentError> {
    let Some(meant) = lesson.intended else { return Ok(None) };
    let posterior = trained.posterior(lesson)?;
    let best = posterior.iter().enumerate().fold(0, |best, (task, &p)| if p > posterior[best] { task } else { best });
    let name = |task: usize| lesson.readings.get(task).map_or_else(Default::default, |it| (it.name.to_string(), it.label.clone()));
    Ok(Some(Answer {
        id: lesson.id.clone(),
        command: lesson.command.clone(),
        meant: name(meant),
        said: name(best),
        probabilities: (posterior.get(meant).copied().unwrap_or(0.0), posterior.get(best).copied().unwrap_or(0.0)),
        right: best == meant,
        telling: if best == meant { vec![] } else { trained.telling(lesson, best, meant)? },
    }))
}

/// The lesson with what was shown as its only machine command.
fn by_actions(lesson: &Lesson) -> Lesson {
    let shown: Vec<String> = lesson.shown.iter().take(goodbot::capacity::TOKENS_PER_COMMAND).cloned().collect();
    Lesson { pairs: if shown.is_empty() { vec![] } else { vec![(shown, 1.0)] }, ..lesson.clone() }
}

/// The lesson with each task's plan as its only machine command.
fn by_plans(lesson: &Lesson) -> Lesson {
    let mut lesson = lesson.clone();
    lesson.readings.iter_mut().for_each(|reading| reading.commands = vec![reading.plan.clone()]);
    lesson
}
