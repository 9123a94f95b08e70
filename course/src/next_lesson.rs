//! The next lesson: the one that teaches most of the commands that the robot is to understand in the end.
//!
//! One new word at a time: a lesson with many words that were never heard leaves open which of them names what. Lessons that are worth the sum
//! over their words of need / (1 + heard)^2, which look for many new words at once, teach no faster than lessons at random.
//!
//! [`Homes::teachable`](crate::Homes::teachable) lists what can be taught in the course's homes, the simplest home first.

use core::cmp::Reverse;
use goodbot::Agent;
use goodbot::capacity::CapacityError;
use goodbot::language::{for_each_word, word_form};
use goodbot::memory::AgentMemory;
use goodbot::symbols::Symbol;

/// Lessons after which a word counts as known.
const OFTEN: u32 = 6;

/// A lesson that is worth teaching next.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct NextLesson<'c> {
    /// Its position among those that could be taught.
    pub lesson: usize,
    /// Its wanted word that was heard least: the reason to teach it.
    pub word: &'c str,
    /// How many of the wanted commands have that word.
    pub needed: u32,
    /// In how many lessons it was heard.
    pub heard: u32,
}

impl NextLesson<'_> {
    /// Whether even this word was heard so often that there is little left to teach.
    pub const fn is_known(&self) -> bool {
        self.heard >= OFTEN
    }
}

/// Which lesson comes first: how often its word was heard, how many words were heard so little, how often its word is wanted, how many of those
/// are wanted, and how many different words it has.
type Order = (u32, usize, Reverse<u32>, Reverse<usize>, Reverse<usize>);

/// The lesson to teach next of `lessons`, commands that could be taught, for a robot that is to understand the commands in `wanted` in the
/// end. `heard` tells in how many lessons a word was heard. It is the lesson with the wanted word that was heard least; of those the one with
/// the fewest words that were heard so little; of those the one whose word is wanted most often, then the one with most wanted words, and
/// then the one with most different words: where blue names the chair and the room, it is not told apart. Of equal ones it is the first: put the
/// lesson in the simplest home first. `None` where no lesson has a word that is wanted.
///
/// # Errors
/// A [`CapacityError`] where a command has too many words, or one that is too long.
///
/// ```
/// use goodbot_course::next_lesson::next_lesson;
/// let wanted = ["take the bag to the red room", "go to the red room"];
/// let lessons = ["take the red bag to the blue room", "go to the blue room", "go to the red room"];
/// // One new word at a time.
/// let next = next_lesson(&lessons, &wanted, |word| u32::from(["go", "to", "the", "room"].contains(&word)))?.expect("red is wanted");
/// assert_eq!((next.lesson, next.word, next.needed, next.heard), (2, "red", 2, 0));
/// assert!(next_lesson(&lessons, &wanted, |_| 99)?.expect("something").is_known());
/// # Ok::<(), goodbot::capacity::CapacityError>(())
/// ```
pub fn next_lesson<'c>(lessons: &[&'c str], wanted: &[&str], heard: impl Fn(&str) -> u32) -> Result<Option<NextLesson<'c>>, CapacityError> {
    let mut best: Option<(Order, NextLesson<'c>)> = None;
    for (lesson, command) in lessons.iter().enumerate() {
        let Some(next) = least_heard(lesson, command, wanted, &heard)? else { continue };
        let new = || words(command).filter(|word| heard(word) <= next.heard);
        let mut needed = 0_usize;
        for word in new() {
            needed = needed.saturating_add(usize::from(need(word, wanted)? > 0));
        }
        let order = (next.heard, new().count(), Reverse(next.needed), Reverse(needed), Reverse(words(command).count()));
        if best.as_ref().is_none_or(|(least, _)| order < *least) {
            best = Some((order, next));
        }
    }
    Ok(best.map(|(_, next)| next))
}

/// A lesson by its wanted word that was heard least; of several, the one that is wanted most often.
fn least_heard<'c>(
    lesson: usize,
    command: &'c str,
    wanted: &[&str],
    heard: impl Fn(&str) -> u32,
) -> Result<Option<NextLesson<'c>>, CapacityError> {
    let mut best: Option<NextLesson<'c>> = None;
    for word in words(command) {
        let next = NextLesson { lesson, word, needed: need(word, wanted)?, heard: heard(word) };
        let better = |best: &NextLesson<'_>| (next.heard, Reverse(next.needed)) < (best.heard, Reverse(best.needed));
        if next.needed > 0 && best.as_ref().is_none_or(better) {
            best = Some(next);
        }
    }
    Ok(best)
}

/// The words of a command, each once.
fn words(command: &str) -> impl Iterator<Item = &str> {
    let before = |at: usize| command.split_whitespace().take(at);
    command.split_whitespace().enumerate().filter(move |&(at, word)| !before(at).any(|other| other == word)).map(|(_, word)| word)
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
    options.model.for_each_word(word, take).is_ok() && any && all
}
