//! Places that are told by a thing in them, and things that are told by their place: "take the bag where the basket is", "bring the bag to the room
//! with the chair", "take the chair from the red room to the blue room".
//!
//! The words that tell are read apart. The other words are then a command for the tasks that fit them.

use super::classes::{Class, Classes};
use super::conversation::place_of;
use super::explained::Explained;
use super::heard::{Heard, Words};
use super::place::{ToldTasks, View};
use super::readings::from_place;
use super::reworded::OF_SENTENCES;
use super::wording::Wording;
use crate::memory::AgentMemory;
use crate::oomdp::{Domain, ObjectId};
use crate::session::{Agent, AgentError};

/// A command, and the words that tell its place by a thing, or its thing by a place.
struct Apart<'w> {
    words: Words<'w>,
    by: Words<'w>,
    is_place: bool,
}

fn acts(word: &Heard) -> bool {
    word.is_of_task && !word.is_toward && !word.is_name
}

fn has_name(words: Words<'_>) -> bool {
    words.iter().any(|word| word.is_name)
}

/// Whether some words are one name, and no part of another command.
fn is_name_alone(words: Words<'_>) -> bool {
    let phrase = words.get(0).map(|word| word.phrase);
    let is_other = |word: &Heard| {
        acts(word) || word.classes.contains_any(&OF_SENTENCES) && !word.classes.contains(Class::There) || Some(word.phrase) != phrase
    };
    has_name(words) && !words.iter().any(is_other)
}

/// Tells the words apart, if the first command has such a phrase.
fn apart(words: Words<'_>) -> Option<Apart<'_>> {
    let end = words.iter().skip(1).position(|word| word.classes.contains(Class::Connective) && !word.is_beside);
    let end = end.map_or(words.len(), |end| end.saturating_add(1));
    let (command, behind) = (words.part(0, end), words.part(end, words.len()));
    let (rest, by, is_place) =
        beside(command).map(|(rest, by)| (rest, by, true)).or_else(|| taken_from(command).map(|(rest, by)| (rest, by, false)))?;
    // "Tell me where the bag is" asks for nothing else.
    let asks = command.iter().any(|word| word.is_beside && word.classes.contains(Class::Asking));
    (rest.iter().any(|word| acts(word) || word.is_new && !asks) || !is_place && has_name(rest)).then(|| Apart {
        words: rest.with(behind),
        by,
        is_place,
    })
}

/// The words without those for the place by a thing: "put the bag next to the basket".
fn beside(words: Words<'_>) -> Option<(Words<'_>, Words<'_>)> {
    let mut before: Option<&Heard> = None;
    let mut marks = None;
    for (at, word) in words.iter().enumerate() {
        // "The room of the basket", "the room with the basket", but not "go with the bag".
        let is_behind_noun =
            before.is_some_and(|noun| noun.count > 0.0 && noun.is_plain() && noun.classes == Classes::NONE && !noun.is_article);
        let marks_here = match () {
            () if word.classes.contains(Class::From) || word.classes.contains(Class::Polite) && word.is_beside => is_behind_noun,
            // "Look where the bag is" asks for nothing else.
            () => word.is_beside && before.is_some_and(|before| !before.is_new),
        };
        marks = if marks_here { Some(at) } else { marks };
        before = Some(word);
    }
    let mark = marks?;
    let by = words.part(mark, words.len());
    let has_goal_behind = by.iter().skip_while(|word| !word.is_name || word.is_toward).any(|word| word.is_toward);
    // "Next to the basket".
    let (rest, by) = (words.part(0, mark), by.only(|word| !word.is_beside && !word.is_toward));
    let is_thing = is_name_alone(by) && !has_goal_behind;
    let first = rest.get(0)?.phrase;
    is_thing.then(|| (rest.only(|word| word.phrase == first && !word.classes.contains(Class::There)), by))
}

/// The words without those for the present place of the thing: "take the chair from the red room to the blue room".
fn taken_from(words: Words<'_>) -> Option<(Words<'_>, Words<'_>)> {
    let thing = words.iter().position(|word| word.is_name)?;
    let (rest, from) = from_place(words, thing, true);
    is_name_alone(from).then_some((rest, from))
}

impl<M: AgentMemory> Agent<M> {
    /// Leaves out the words that tell a place or a thing, and returns the tasks that fit them: those with the place where such things are,
    /// or with the things at this place. `None` if there are no such words, or no such thing or place.
    #[inline(never)]
    pub(super) fn tell_apart<D: Domain + ?Sized>(
        &mut self,
        domain: &D,
        words: &mut Words<'_>,
        wording: &Wording<'_>,
        explained: &mut Explained,
    ) -> Result<Option<ToldTasks>, AgentError> {
        let Some(Apart { words: rest, by, is_place }) = apart(*words) else { return Ok(None) };
        self.explain_words(domain, by, wording, View::PLAIN, None, explained)?;
        let is_of_thing = |task: usize| self.place_of_thing(domain, task).is_some();
        let named = if is_place { explained.own } else { explained.fitting };
        // "Beside the red room" names no thing.
        if named.is_empty() || is_place && !named.iter().all(is_of_thing) {
            self.explain_all(domain, *words, wording, View::PLAIN, explained)?;
            return Ok(None);
        }
        let there = named.common(self.done(domain));
        let object = |task: usize| if is_place { self.goal(domain, task) } else { self.thing(task) };
        let fits = |&task: &usize| {
            let is_there = |other: usize| is_of_thing(other) && object(other) == object(task);
            (is_place || is_of_thing(task)) && there.iter().any(is_there)
        };
        *words = rest;
        Ok(Some(ToldTasks { tasks: (0..self.tasks().len()).filter(fits).collect(), is_place }))
    }

    /// The place of a task of one proposition.
    fn goal<D: Domain + ?Sized>(&self, domain: &D, task: usize) -> Option<ObjectId> {
        let task = self.task(task);
        let lifted = self.lifted().get(usize::from(task.lifted))?;
        task.propositions(lifted).next().and_then(|part| place_of(domain, &part))
    }
}
