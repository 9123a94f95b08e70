//! Places that are told by a thing in them, and things that are told by their place: "take the bag where the basket is", "bring the bag to
//! the room with the chair", "take the chair from the red room to the blue room".
//!
//! The words that tell are read apart. The other words are then a command for the tasks that fit them.

use super::context::{Context, ToldTasks, View};
use super::explained::Explained;
use super::heard::Heard;
use super::wording::Wording;
use super::words::Words;
use crate::memory::AgentMemory;
use crate::oomdp::Domain;
use crate::session::{Agent, AgentError};
use crate::task::TaskSet;
use crate::voice::classes::Class;

/// The number of words of "to the".
const ARTICLE: usize = 2;

/// Words of these classes belong to no name.
const OF_SENTENCES: [Class; 14] = [
    Class::Negation,
    Class::Out,
    Class::But,
    Class::All,
    Class::Connective,
    Class::Or,
    Class::Pronoun,
    Class::Stop,
    Class::No,
    Class::Blame,
    Class::Again,
    Class::If,
    Class::Speaker,
    Class::Meant,
];

/// A command, and the words that tell its place by a thing, or its thing by a place.
struct Apart<'w> {
    words: Words<'w>,
    by: Words<'w>,
    is_place: bool,
}

fn acts(word: &Heard) -> bool {
    word.acts() && !word.is_name
}

/// Whether some words are one name, and no part of another command.
fn is_name_alone(words: Words<'_>) -> bool {
    let phrase = words.get(0).map(|word| word.phrase);
    let is_other = |word: &Heard| acts(word) || word.is_any(&OF_SENTENCES) && !word.is(Class::There) || Some(word.phrase) != phrase;
    words.has_name() && !words.any(&is_other)
}

/// Tells the words apart, if the first command has such a phrase.
fn apart(words: Words<'_>) -> Option<Apart<'_>> {
    let end = words.after(0).position(&|word| word.is(Class::Connective) && !word.is_beside);
    let end = end.map_or(words.len(), |end| end.saturating_add(1));
    let (command, behind) = (words.before(end), words.from(end));
    let by_thing = beside(command).map(|(rest, by)| (rest, by, true));
    let (rest, by, is_place) = by_thing.or_else(|| taken_from(command).map(|(rest, by)| (rest, by, false)))?;
    // "Tell me where the bag is" asks for nothing else.
    let asks = command.any(&|word| word.is_beside && word.is(Class::Asking));
    let is_command = rest.any(&|word| acts(word) || word.is_new && !asks) || !is_place && rest.has_name();
    is_command.then(|| Apart { words: rest.with(behind), by, is_place })
}

/// The words without those for the place by a thing: "put the bag next to the basket".
fn beside(words: Words<'_>) -> Option<(Words<'_>, Words<'_>)> {
    let mut before: Option<&Heard> = None;
    let mut mark = None;
    for (at, word) in words.iter().enumerate() {
        let marks = if word.is(Class::From) || word.is(Class::Polite) && word.is_beside {
            // "The room of the basket", "the room with the basket", but not "go with the bag".
            before.is_some_and(|noun| noun.is_of_lessons() && noun.is_plain() && noun.is_open() && !noun.is_article)
        } else {
            // "Look where the bag is" asks for nothing else.
            word.is_beside && before.is_some_and(|before| !before.is_new)
        };
        mark = if marks { Some(at) } else { mark };
        before = Some(word);
    }
    let (rest, by) = (words.before(mark?), words.from(mark?));
    let name = by.position(&|word| word.is_name && !word.is_toward)?;
    // "Next to the basket".
    let thing = by.only(|word| !word.is_beside && !word.is_toward);
    let phrase = rest.get(0)?.phrase;
    let rest = rest.only(|word| word.phrase == phrase && !word.is(Class::There));
    (is_name_alone(thing) && !by.from(name).has_way()).then_some((rest, thing))
}

/// The words without those for the present place of the thing: "take the chair from the red room to the blue room". Such a place shares its
/// noun with the goal, and begins with another word, or with one such as "from".
fn taken_from(words: Words<'_>) -> Option<(Words<'_>, Words<'_>)> {
    let (begin, from, goal) = present_place(words, words.position(&|word| word.is_name)?)?;
    // "The chair that is in the red room".
    let end = words.before(begin).last_name()?.saturating_add(1);
    let is_relative = words.part(end, begin).any(&|word| word.is_new || word.is(Class::Asking));
    let (way, other) = (from.get(0)?, goal.get(0)?);
    let is_other_way = way.said.symbol != other.said.symbol && way.phrase == other.phrase;
    let is_from = is_relative || way.is(Class::From) || is_other_way && share_noun(from, goal);
    let rest = words.before(if is_relative { end } else { begin }).with(goal);
    let from = from.after(0);
    (is_from && is_name_alone(from)).then_some((rest, from))
}

/// Splits the words for the present place of all things, named at a position, from the others: "everything in the blue room" to another.
/// Both places then share a word that is no name: "room".
pub(super) fn place_of_all(words: Words<'_>, all: usize) -> (Words<'_>, Words<'_>) {
    let place = present_place(words, all).filter(|&(_, from, goal)| share_noun(from, goal));
    place.map_or((words, Words::NONE), |(begin, from, goal)| (words.before(begin).with(goal), from.after(0)))
}

/// The words for the present place of things, named at a position, and those for the goal; and the position where the first begin.
fn present_place(words: Words<'_>, named: usize) -> Option<(usize, Words<'_>, Words<'_>)> {
    let goal = words.last(&|word| word.is_toward)?;
    let leads = words.after(named).position(&|word| word.is_toward || word.is(Class::From))?;
    let begin = leads.saturating_add(named).saturating_add(1);
    let from = words.part(begin, goal);
    from.any(&|word| word.is_name && word.is_open()).then(|| (begin, from, words.from(goal)))
}

/// Whether two places share a noun, such as "room". The article of the goal does not count.
fn share_noun(from: Words<'_>, goal: Words<'_>) -> bool {
    let goal = goal.from(ARTICLE);
    from.any(&|word| word.is_open() && !word.is_name && goal.any(&|other| other.said.symbol == word.said.symbol))
}

impl<M: AgentMemory> Agent<M> {
    /// Leaves out the words that tell a place or a thing, and returns the tasks that fit them: those with the place where such things are,
    /// or with the things at this place. `None` if there are no such words, or no such thing or place.
    #[inline(never)]
    pub(super) fn tell_apart<D: Domain>(
        &mut self,
        domain: &D,
        words: &mut Words<'_>,
        context: Context<'_>,
        explained: &mut Explained,
    ) -> Result<Option<ToldTasks>, AgentError> {
        let Some(Apart { words: rest, by, is_place }) = apart(*words) else { return Ok(None) };
        let Some(tasks) = self.told_by(domain, by, is_place, context.wording, explained)? else {
            self.explain_all(domain, *words, View::PLAIN, context, explained)?;
            return Ok(None);
        };
        *words = rest;
        Ok(Some(ToldTasks { tasks, is_place }))
    }

    /// The tasks whose place, or else thing, is told by the names of a thing that is there, or of the place where it is. `None` if no thing
    /// here, or no place, has such names; no tasks if there is one, but nothing is there.
    pub(super) fn told_by<D: Domain>(
        &mut self,
        domain: &D,
        names: Words<'_>,
        is_place: bool,
        wording: &Wording<'_>,
        explained: &mut Explained,
    ) -> Result<Option<TaskSet>, AgentError> {
        self.explain_words(domain, names, View::PLAIN, Context::of(wording), None, explained)?;
        let is_of_thing = |task: usize| self.place_of_thing(domain, task).is_some();
        let named = if is_place { explained.own } else { explained.fitting };
        // "Beside the red room" names no thing.
        if named.is_empty() || is_place && !named.iter().all(is_of_thing) {
            return Ok(None);
        }
        let there = named.common(self.done(domain));
        let object = |task: usize| if is_place { self.goal(domain, task) } else { self.thing(task) };
        let fits = |&task: &usize| {
            let is_there = |other: usize| is_of_thing(other) && object(other) == object(task);
            (is_place || is_of_thing(task)) && there.iter().any(is_there)
        };
        Ok(Some((0..self.tasks().len()).filter(fits).collect()))
    }
}
