//! The next lesson: the one that helps most towards a set of wanted commands.
//!
//! One new word at a time: after a lesson with many new words it is open which word has which meaning. A rule that rates a lesson by the
//! sum over its words of need / (1 + heard)^2, and so prefers many new words at once, teaches no faster than random lessons.
//!
//! [`Homes::teachable`](crate::Homes::teachable) lists the teachable tasks in the course's homes, the simplest home first.

use core::cmp::Reverse;
use goodbot::Agent;
use goodbot::capacity::CapacityError;
use goodbot::language::{for_each_word, word_form};
use goodbot::memory::AgentMemory;
use goodbot::symbols::Symbol;

/// The number of lessons after which a word counts as known.
const OFTEN: u32 = 6;

/// A lesson to teach next.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct NextLesson<'c> {
    /// Its position among the given lessons.
    pub lesson: usize,
    /// Its least heard wanted word: the reason to teach it.
    pub word: &'c str,
    /// The number of wanted commands with that word.
    pub needed: u32,
    /// The number of lessons with that word.
    pub heard: u32,
}

impl NextLesson<'_> {
    /// Whether even this word was heard often enough, so that little is left to teach.
    pub const fn is_known(&self) -> bool {
        self.heard >= OFTEN
    }
}

/// The order of lessons: how often its word was heard, the number of its words heard no more often, how often its word is wanted, the
/// number of those words that are wanted, and its number of different words.
type Order = (u32, usize, Reverse<u32>, Reverse<usize>, Reverse<usize>);

/// Chooses the lesson to teach next among `lessons`, for a robot that must understand the commands in `wanted` in the end. `heard` returns
/// the number of lessons with a word. The criteria, in this order: the lesson whose least heard wanted word was heard least; the fewest
/// words heard no more often; the word wanted most often; the most wanted words among them; the most different words, because a colour that
/// names both the chair and the room does not tell them apart. On a tie it is the first, so put lessons in the simplest home first. `None`
/// if no lesson has a wanted word.
///
/// # Errors
/// A [`CapacityError`] if a command has too many words, or one that is too long.
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

/// A lesson with its least heard wanted word; of several, the one that is wanted most often.
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

/// The number of wanted commands with this word.
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

/// The number of learned sessions with a word. If the agent keeps only the first letters of words, words with the same first letters count
/// too.
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

/// Whether a command has a word: all of its pieces, if the language splits words.
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
