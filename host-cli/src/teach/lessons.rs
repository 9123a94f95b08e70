//! The tour: the paper's seven lessons and five tests in order; homes to teach in; and the proposal of the next lesson.

use super::pupil::Pupil;
use super::site::scene;
use goodbot_console::Failure;
use goodbot_course::next_lesson::{next_lesson, times_heard};
use goodbot_course::{Exercise, HomeName, Homes, LESSONS, Layout, TESTS, generator};
use goodbot_formats::environment::EnvironmentFile;
use goodbot_lesson::home as homes;
use rand_core::Rng;

/// A hint for each lesson.
const HINTS: [&str; LESSONS.len()] = [
    "It knows no word yet, so it just tries something. Say good when it goes the right way, bad when it does not.",
    "Another room of the same house. Does it already know what \"go to the\" means?",
    "New colours. It needs your word again, but not for long.",
    "By now \"go to the\" should be clear.",
    "Something new: there is a chair, and it can be pushed.",
    "A bag this time. The robot pushes; it cannot pull.",
    "The last lesson. It may well need no correction at all.",
];
const TEST_HINT: &str = "A test: it has never heard this command, and hears no good and no bad now. Does it understand?";

/// The beginning of a lesson's id in logs: `lesson-3`.
const LESSON_ID: &str = "lesson-";

/// A lesson or a test.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Stop {
    /// The number of the lesson or test, from 1.
    pub number: usize,
    /// How many lessons or tests there are.
    pub of: usize,
    /// Whether it is a test.
    pub test: bool,
    /// The command and its meaning.
    pub exercise: &'static Exercise,
}

impl Stop {
    /// The hint for the trainer.
    pub fn hint(&self) -> &'static str {
        if self.test { TEST_HINT } else { HINTS.get(self.number - 1).copied().unwrap_or("") }
    }

    /// `Lesson 3 of 7`.
    pub fn title(&self) -> String {
        format!("{} {} of {}", if self.test { "Test" } else { "Lesson" }, self.number, self.of)
    }

    /// A lesson's id in logs.
    pub fn id(&self) -> Option<String> {
        (!self.test).then(|| format!("{LESSON_ID}{}", self.number))
    }
}

/// Whether a session with this id was a lesson of the tour.
pub fn is_lesson(id: &str) -> bool {
    id.starts_with(LESSON_ID)
}

/// A tour under way.
#[derive(Clone, Debug)]
pub struct Tour {
    homes: Homes,
    at: usize,
    right: Vec<bool>,
}

impl Tour {
    /// The tour in the drawn homes, or in random homes. It continues after the lessons with these ids.
    pub fn new<'a>(seed: Option<u64>, learned: impl Iterator<Item = &'a str>) -> Self {
        let homes = seed.map_or(Homes::FIXED, random_homes);
        let number = |id: &str| id.strip_prefix(LESSON_ID)?.parse::<usize>().ok();
        let at = learned.filter_map(number).max().unwrap_or(0).min(LESSONS.len());
        Self { homes, at, right: Vec::new() }
    }

    /// The current lesson or test; `None` at the end.
    pub fn stop(&self) -> Option<Stop> {
        let stop = |number, of, test| move |exercise| Stop { number, of, test, exercise };
        match self.at.checked_sub(LESSONS.len()) {
            None => LESSONS.get(self.at).map(stop(self.at + 1, LESSONS.len(), false)),
            Some(test) => TESTS.get(test).map(stop(test + 1, TESTS.len(), true)),
        }
    }

    /// The current home; at the end, the home of the tests.
    pub fn home(&self) -> Option<EnvironmentFile> {
        environment(self.homes.layout(self.stop().map_or(HomeName::Test, |stop| stop.exercise.home)))
    }

    /// Goes to the next lesson or test. `right` says whether a test was understood.
    pub fn pass(&mut self, right: bool) {
        if self.stop().is_some_and(|stop| stop.test) {
            self.right.push(right);
        }
        self.at += 1;
    }

    /// Goes back to the last lesson.
    pub fn back(&mut self) {
        self.right.clear();
        self.at = self.at.min(LESSONS.len()).saturating_sub(1);
    }

    /// How many tests were understood.
    pub fn score(&self) -> String {
        format!("{} of {} tests understood", self.right.iter().filter(|&&right| right).count(), TESTS.len())
    }
}

fn random_homes(seed: u64) -> Homes {
    Homes::random(&mut generator(seed), &mut homes::memory())
}

fn environment(layout: &Layout) -> Option<EnvironmentFile> {
    let (home, state) = layout.build(homes::memory()).ok()?;
    Some(scene(&home, &state).environment)
}

/// Everything that can be taught in the tour's drawn homes, the simplest home first: the home and the command.
pub fn course_lessons() -> impl Iterator<Item = (HomeName, String)> {
    Homes::FIXED.teachable().map(|(home, meant)| (home, meant.to_string()))
}

/// A drawn home of the tour.
pub fn home_named(name: HomeName) -> Option<EnvironmentFile> {
    environment(Homes::FIXED.layout(name))
}

/// The default home: four rooms, a chair and a bag.
pub fn first_home() -> Option<EnvironmentFile> {
    environment(&Homes::FIXED.test)
}

/// A random home with something to push.
pub fn random_home(seed: u64) -> Option<EnvironmentFile> {
    let homes = random_homes(seed);
    let [_, _, _, with_blocks @ ..] = &homes.lessons;
    let choice = generator(seed).next_u32() as usize % (with_blocks.len() + 1);
    environment(with_blocks.get(choice).unwrap_or(&homes.test))
}

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
    let mut lessons: Vec<_> = course_lessons().map(|(home, command)| (Some(home), command)).filter(|_| !pupil.is_in_world()).collect();
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_tour_goes_on_where_it_was_left() {
        let at = |ids: &[&str]| Tour::new(None, ids.iter().copied()).stop().unwrap().title();
        assert_eq!(at(&[]), "Lesson 1 of 7");
        assert_eq!(at(&["lesson-1", "said", "lesson-2"]), "Lesson 3 of 7");
        assert_eq!(at(&["lesson-7"]), "Test 1 of 5");
        assert_eq!(at(&["lesson-99999"]), "Test 1 of 5");
    }

    #[test]
    fn homes_at_random_are_the_same_for_the_same_seed() {
        assert_eq!(random_home(4), random_home(4));
        assert_ne!(random_home(4), random_home(5));
    }
}
