//! Trains on some sessions, asks others, and collects the answers.

use super::method::{Trained, Wordless};
use super::novel::Novel;
use goodbot::language::{Settings, Synonyms};
use goodbot_console::{Failure, Lesson, Starter, bar, training};
use rand_core::Rng;
use rayon::prelude::*;

/// The answer to one command.
#[derive(Clone, Debug, Default)]
pub struct Answer {
    /// The session.
    pub id: String,
    /// The command.
    pub command: String,
    /// The intended task, and its label.
    pub expected: (String, String),
    /// The most likely task (the first of equals), and its label.
    pub predicted: (String, String),
    /// The probabilities of the intended and of the predicted task.
    pub probabilities: (f32, f32),
    /// Whether the two are the same.
    pub right: bool,
    /// Whether the steps told the intended task, in place of the record.
    pub is_told_by_steps: bool,
    /// Whether a learner without words was right, and its probability of the intended task.
    pub wordless: (bool, f32),
    /// The probability of the intended task by chance in this scene.
    pub chance: f32,
    /// The training session that this one copies, if any.
    pub copy_of: Option<String>,
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

/// The training sessions and the questions.
pub struct Experiment<'l> {
    /// Sessions to train on.
    pub taught: &'l [Lesson],
    /// Sessions to ask.
    pub asked: &'l [Lesson],
    /// For each model to train: the positions that it is not trained on, and those that it is asked.
    pub rounds: Vec<(Vec<usize>, Vec<usize>)>,
    /// For each asked session, the training session that it copies, if any.
    pub copies: Vec<Option<&'l Lesson>>,
    /// The synonyms that replace unknown words.
    pub synonyms: Synonyms<'l>,
    /// The starter to learn from beside the sessions.
    pub starter: &'l Starter,
    /// Other layouts to ask in, if any.
    pub novel: Option<Novel<'l>>,
}

impl Experiment<'_> {
    /// Trains and asks, with rounds in parallel on all cores.
    ///
    /// # Errors
    /// [`Failure::Input`] if a command does not fit, or a home has no other layout.
    pub fn run(&self, settings: Settings) -> Result<Vec<Answer>, Failure> {
        let progress = bar(self.rounds.len(), "training");
        let answers: Vec<Vec<Answer>> = self
            .rounds
            .par_iter()
            .map_init(
                || training::memory(&[self.taught, self.starter.lessons()].concat(), &settings),
                |memory, (left_out, part)| {
                    let left: std::collections::HashSet<usize> = left_out.iter().copied().collect();
                    let others =
                        || self.taught.iter().enumerate().filter(|(position, _)| !left.contains(position)).map(|(_, lesson)| lesson);
                    let wordless = Wordless::of(others());
                    let lessons = others().chain(self.starter.beside(others().count()));
                    let mut trained = Trained::on(memory, lessons, settings)?;
                    let answers = self.ask_part(&mut trained, &wordless, part);
                    progress.inc(1);
                    answers
                },
            )
            .collect::<Result<_, Failure>>()?;
        progress.finish_and_clear();
        Ok(answers.into_iter().flatten().collect())
    }

    /// Asks the questions of all rounds to one trained model.
    ///
    /// # Errors
    /// The errors of [`run`](Self::run).
    pub fn ask(&self, trained: &mut Trained<'_>) -> Result<Vec<Answer>, Failure> {
        let wordless = Wordless::default();
        let part: Vec<usize> = self.rounds.iter().flat_map(|(_, part)| part.iter().copied()).collect();
        self.ask_part(trained, &wordless, &part)
    }

    fn ask_part(&self, trained: &mut Trained<'_>, wordless: &Wordless, part: &[usize]) -> Result<Vec<Answer>, Failure> {
        let mut answers = Vec::new();
        for &position in part {
            let Some(lesson) = self.asked.get(position) else { continue };
            let mut each = |lesson: &Lesson| -> Result<(), Failure> {
                let lesson_in_known_words = trained.in_known_words(self.synonyms, lesson)?;
                let Some(answer) = ask(trained, &lesson_in_known_words)? else { return Ok(()) };
                let (best, meant) = best_and_meant(&wordless.posterior(lesson), lesson);
                let meant_alone = wordless.posterior(lesson).get(meant).copied().unwrap_or(0.0);
                let copy_of = self.copies.get(position).copied().flatten().map(|copy| copy.id.clone());
                let chance = lesson.readings.get(meant).map_or(0.0, |reading| reading.prior);
                answers.push(Answer { command: lesson.command.clone(), wordless: (best == meant, meant_alone), chance, copy_of, ..answer });
                Ok(())
            };
            match &self.novel {
                None => each(lesson)?,
                Some(novel) => novel.each_layout(lesson, position, &mut each)?,
            }
        }
        Ok(answers)
    }
}

/// The most likely task, the first of equals, and the intended one.
fn best_and_meant(posterior: &[f32], lesson: &Lesson) -> (usize, usize) {
    let best = posterior.iter().enumerate().fold((0, f32::MIN), |best, (task, &p)| if p > best.1 { (task, p) } else { best }).0;
    (best, lesson.intended.unwrap_or(usize::MAX))
}

/// Asks one command; `None` if its intended task is unknown.
///
/// # Errors
/// [`Failure::Input`] if the command does not fit.
pub fn ask(trained: &mut Trained<'_>, lesson: &Lesson) -> Result<Option<Answer>, Failure> {
    if lesson.intended.is_none() {
        return Ok(None);
    }
    let posterior = trained.posterior(lesson)?;
    let (best, meant) = best_and_meant(&posterior, lesson);
    let name = |task: usize| lesson.readings.get(task).map_or_else(Default::default, |it| (it.name.to_string(), it.label.clone()));
    Ok(Some(Answer {
        id: lesson.id.clone(),
        command: lesson.command.clone(),
        expected: name(meant),
        predicted: name(best),
        probabilities: (posterior.get(meant).copied().unwrap_or(0.0), posterior.get(best).copied().unwrap_or(0.0)),
        right: best == meant,
        is_told_by_steps: lesson.is_told_by_steps,
        ..Answer::default()
    }))
}
