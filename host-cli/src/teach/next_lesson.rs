//! Proposes the next lesson, with the reason.

use super::lessons::{course_lessons, home_named};
use super::pupil::Pupil;
use goodbot_console::outcome::Failure;
use goodbot_course::next_lesson::{next_lesson, times_heard};
use goodbot_formats::environment::EnvironmentFile;

/// A proposed lesson.
#[derive(Clone, Debug, PartialEq)]
pub struct Proposal {
    /// The command.
    pub command: String,
    /// The home; `None` for the present one.
    pub home: Option<EnvironmentFile>,
    /// The word that it mainly teaches.
    pub word: String,
    /// How many of the wanted commands have that word.
    pub needed: u32,
    /// In how many sessions the robot has heard it.
    pub heard: u32,
}

impl Proposal {
    /// The reason, in words.
    pub fn reason(&self) -> String {
        let Self { word, needed, heard, .. } = self;
        let heard = match heard {
            0 => "it has never heard that word".to_owned(),
            1 => "it has heard that word in 1 session only".to_owned(),
            more => format!("it has heard that word in {more} sessions only"),
        };
        format!("\"{word}\" is in {needed} of the commands that it is to understand, and {heard}")
    }
}

/// The result of the search for a lesson.
#[derive(Clone, Debug, PartialEq)]
pub enum Next {
    /// The proposal.
    Lesson(Proposal),
    /// Every word of the wanted commands was heard often.
    LittleLeft,
    /// There are no wanted commands yet.
    NothingWanted,
}

/// The lesson that teaches most of the wanted words. It is chosen from all lessons in the course's homes and from the wanted commands
/// themselves.
pub fn propose(pupil: &Pupil, wanted: &[String]) -> Result<Next, Failure> {
    if wanted.is_empty() {
        return Ok(Next::NothingWanted);
    }
    // The course's lessons are for homes only.
    let is_home = pupil.lesson.home().as_floor().is_some();
    let mut lessons: Vec<_> = course_lessons().map(|(home, command)| (Some(home), command)).filter(|_| is_home).collect();
    let own: Vec<_> = wanted.iter().filter(|command| lessons.iter().all(|(_, other)| other != *command)).cloned().collect();
    lessons.extend(own.into_iter().map(|command| (None, command)));
    let [commands, wanted]: [Vec<&str>; 2] =
        [lessons.iter().map(|(_, command)| command.as_str()).collect(), wanted.iter().map(String::as_str).collect()];
    let found = next_lesson(&commands, &wanted, |word| times_heard(&pupil.lesson.agent, word))?;
    let Some((next, (home, command))) = found.filter(|next| !next.is_known()).and_then(|next| Some((next, lessons.get(next.lesson)?)))
    else {
        return Ok(Next::LittleLeft);
    };
    let home = home.and_then(home_named);
    Ok(Next::Lesson(Proposal { command: command.clone(), home, word: next.word.to_owned(), needed: next.needed, heard: next.heard }))
}
