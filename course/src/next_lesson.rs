//! Which lesson next: the one that teaches most of what the robot is to understand in the end.
//!
//! A word is needed as often as the wanted commands have it, and a lesson is worth the sum over its words of need(w) / (1 + heard(w))^2: what
//! was heard often is known. Proposals by how unsure the robot is would pick crowded, ambiguous lessons instead.
//!
//! [`Homes::teachable`](crate::Homes::teachable) lists what can be taught in the course's homes, the simplest home first.

use goodbot::Agent;
use goodbot::capacity::CapacityError;
use goodbot::language::{Model, for_each_piece, for_each_word, word_form};
use goodbot::memory::AgentMemory;
use goodbot::symbols::Symbol;

/// A word that was heard in so many lessons is known.
const OFTEN: u32 = 6;

/// A lesson that is worth teaching next.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct NextLesson<'c> {
    /// Its position among those that could be taught.
    pub lesson: usize,
    /// Its worth: more is better, 0 is nothing.
    pub worth: f32,
    /// The word that makes most of its worth: the reason to teach it.
    pub word: &'c str,
    /// How many of the wanted commands have that word.
    pub needed: u32,
    /// In how many lessons it was heard.
    pub heard: u32,
}

impl NextLesson<'_> {
    /// Whether even the word that makes most of its worth was heard so often that there is little left to teach.
    pub const fn is_known(&self) -> bool {
        self.heard >= OFTEN
    }
}

/// The lesson to teach next: of `lessons`, commands that could be taught, the one that teaches most of the commands in `wanted`. `heard`
/// tells in how many lessons a word was heard. Of equal ones it is the first: put the lesson in the simplest home first. `None` where no
/// lesson has a word that is needed.
///
/// # Errors
/// A [`CapacityError`] where a command has too many words, or one that is too long.
///
/// ```
/// use goodbot_course::next_lesson::next_lesson;
/// let wanted = ["take the bag to the red room", "go to the red room"];
/// let lessons = ["go to the blue room", "go to the red room"];
/// let next = next_lesson(&lessons, &wanted, |word| if word == "red" { 0 } else { 1 })?.expect("red is needed");
/// assert_eq!((next.lesson, next.word, next.needed, next.heard), (1, "red", 2, 0));
/// // Where all is known well, nothing is worth much.
/// assert!(next_lesson(&lessons, &wanted, |_| 99)?.expect("but something").worth < 0.01);
/// # Ok::<(), goodbot::capacity::CapacityError>(())
/// ```
pub fn next_lesson<'c>(lessons: &[&'c str], wanted: &[&str], heard: impl Fn(&str) -> u32) -> Result<Option<NextLesson<'c>>, CapacityError> {
    let mut best: Option<NextLesson<'c>> = None;
    for (lesson, command) in lessons.iter().enumerate() {
        let mut next = NextLesson { lesson, worth: 0.0, word: "", needed: 0, heard: 0 };
        let mut most = 0.0;
        for word in command.split_whitespace() {
            let (needed, heard) = (need(word, wanted)?, heard(word));
            let part = needed as f32 / square(heard.saturating_add(1));
            next.worth += part;
            if part > most {
                most = part;
                next = NextLesson { word, needed, heard, ..next };
            }
        }
        if next.worth > best.map_or(0.0, |best| best.worth) {
            best = Some(next);
        }
    }
    Ok(best)
}

/// How many of the wanted commands have this word.
fn need(word: &str, wanted: &[&str]) -> Result<u32, CapacityError> {
    let mut count = 0_u32;
    for command in wanted {
        let mut found = false;
        for_each_word(command, |said| {
            for_each_word(word, |form| {
                found |= said == form;
                Ok(())
            })
        })?;
        count = count.saturating_add(u32::from(found));
    }
    Ok(count)
}

/// In how many of the sessions that it has learned from the agent heard a word, or, where it keeps the first letters of words, one that
/// begins so.
///
/// ```
/// use goodbot::{Agent, Options, home};
/// use goodbot_course::next_lesson::times_heard;
/// goodbot::memory! { struct Memory = goodbot::Capacities::SMALL; }
/// let mut memory = Memory::new();
/// let agent = Agent::new(memory.agent, &home::paper_tasks()?, Options::PAPER)?;
/// assert_eq!(times_heard(&agent, "red"), 0);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn times_heard(agent: &Agent<impl AgentMemory>, word: &str) -> u32 {
    let data = agent.language().bitext();
    let sessions = u16::try_from(data.sessions()).unwrap_or(u16::MAX);
    (0..sessions).map(|session| u32::from(has(agent, data.sentence(session), word))).sum()
}

/// Whether a command has a word: all its pieces, where the language cuts words.
fn has(agent: &Agent<impl AgentMemory>, sentence: &[Symbol], word: &str) -> bool {
    let options = agent.options().language;
    let (mut any, mut all) = (false, true);
    let take = |piece: &str| {
        let known = agent.language().words().find(word_form(piece, options.letters_kept()));
        any = true;
        all &= known.is_some_and(|piece| sentence.contains(&piece));
        Ok(())
    };
    let cut = if options.model == Model::Roles { for_each_piece(word, take) } else { for_each_word(word, take) };
    cut.is_ok() && any && all
}

fn square(count: u32) -> f32 {
    count as f32 * count as f32
}
