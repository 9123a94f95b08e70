//! The feedback of real trainers, from session logs: each action with whether it was right for the intended task.

use crate::recorded::{self, WalkStep};
use crate::study::trainer::population::{Observed, Record};
use goodbot::feedback::Judged;
use goodbot::home::paper_tasks;
use goodbot_console::load::input::InputFile;
use goodbot_console::outcome::Failure;

/// The trainers of some logs, each with a name.
pub type People = Vec<(String, Record)>;

/// The person of a session: its id up to the first `.`, or else up to the last `-`.
fn person(id: &str) -> &str {
    id.split_once('.').or_else(|| id.rsplit_once('-')).map_or(id, |(person, _)| person)
}

/// Reads logs. Only sessions with feedback and a known intended task count.
///
/// # Errors
/// [`Failure::Input`] names the file and its fault.
pub fn read(files: &[InputFile]) -> Result<People, Failure> {
    let mut people = People::new();
    for walk in recorded::read(files, &paper_tasks()?)? {
        let Some(intended) = walk.intended else { continue };
        let who = walk.id.as_deref().map_or(walk.trainer.as_str(), person);
        let position = people.iter().position(|(known, _)| known == who).unwrap_or_else(|| {
            people.push((who.to_owned(), Record::default()));
            people.len() - 1
        });
        let record = &mut people[position].1;
        // A session that was continued had not ended.
        if let Some(last) = record.ended.last_mut().filter(|_| walk.continues) {
            *last = false;
        }
        let observed = |step: &WalkStep| Observed {
            correct: matches!(step.judged[intended], Judged::Nearer | Judged::RestsAtGoal),
            at_goal: step.began[intended] == Some(true),
            said: step.feedback,
        };
        record.lessons.push(walk.steps.iter().map(observed).collect());
        record.ended.push(true);
    }
    match people.is_empty() {
        true => Err(Failure::Input("no session with feedback has an intended task; name other logs".to_owned())),
        false => Ok(people),
    }
}
