//! Readings in which people repair a command while they say it: "take the bag, no, the basket to the red room".
//!
//! A repair has three parts (Shriberg 1994, *Preliminaries to a theory of speech disfluencies*): the reparandum, which is taken back ("the
//! bag"), the interregnum ("no"), and the repair ("the basket"). No list has all words between the two, such as "I tell a lie", so each name
//! that follows another one may repair it, and the [acceptance](super::acceptance) decides by the words between them.
//!
//! The reparandum may also be the last task, after it is done: "no, the yellow one". The words then name what is to be changed in it, and all
//! the others are the interregnum. Where they name nothing, as in "undo that", they still tell whether the last task is to be taken back,
//! forbidden, or repeated with another thing.

use super::acceptance::BETWEEN;
use super::context::{Context, ToldTasks, View};
use super::explained::Explained;
use super::heard::Heard;
use super::hypothesis::Judged;
use super::recalled::of_last;
use super::verdict::Choice;
use super::words::Words;
use crate::memory::AgentMemory;
use crate::oomdp::Domain;
use crate::probability::{Scaled, total};
use crate::session::{Agent, AgentError};
use crate::task::TaskSet;
use core::ops::Range;
use heapless::Vec;

/// The prior of a repair.
const REPAIR: f32 = 0.02;
/// The factor on the prior of words about the last task. They lack what to do, and a thing or a place, each of which a command would have.
const OF_LAST: f32 = 100.0;
/// The most names of an utterance that are looked at, and the most repairs that are weighed: those by a name, and those without.
const NAMES: usize = 6;
const BY_NAME: usize = 4;
/// With more names than this, none is read as telling the place by a thing; and how many may tell it.
const BESIDE: usize = 3;
const TELLING: usize = 2;
pub(super) const WEIGHED: usize = BY_NAME + Shape::WITHOUT_NAME.len() + 1 + TELLING;

/// What a repair takes back.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Shape {
    /// The name before it: "take the bag, no, the basket to the red room".
    Name,
    /// All from an earlier name on: "take the bag to the blue, no, the basket to the red room".
    Clause,
    /// An earlier name, but not those between: "take the bag to the red room, no, the basket".
    Earlier,
    /// All before it: "take the bag to the red room, no, go to the blue room".
    All,
    /// The place of the last task: "no, to the yellow one".
    LastPlace,
    /// Its thing: "no, the basket".
    LastThing,
    /// All that it named: "I said the basket to the red room".
    LastNames,
    /// The last task: all shall be as it was.
    Back,
    /// Its thing: another of its kind shall be there.
    OtherThing,
    /// Its thing: the robot shall be there.
    RobotToo,
    /// The last task, which is forbidden.
    NotThere,
    /// Nothing: the place that has no name is where the robot is, as in "get me the basket".
    Hither,
    /// Nothing: the place is where a thing is, as in "park the chair with the bag".
    Beside,
}

impl Shape {
    /// The shapes that take something of the utterance back.
    const OF_UTTERANCE: [Self; 4] = [Self::Name, Self::Clause, Self::Earlier, Self::All];
    /// Those that name what is to be changed in the last task.
    const OF_LAST: [Self; 3] = [Self::LastPlace, Self::LastThing, Self::LastNames];
    /// Those that change it, and need no name.
    const WITHOUT_NAME: [Self; 4] = [Self::Back, Self::OtherThing, Self::RobotToo, Self::NotThere];
    /// How many take nothing of the utterance back.
    pub const CHANGES: usize = Self::OF_LAST.len() + Self::WITHOUT_NAME.len() + 2;

    /// Which of them it is, from 0.
    pub const fn change(self) -> Option<usize> {
        (self as usize).checked_sub(Self::OF_UTTERANCE.len())
    }

    /// What stands before the words that tell it, for the [acceptance](super::acceptance).
    pub const fn sign(self) -> &'static str {
        match self {
            Self::Back => "/",
            Self::OtherThing => "=",
            Self::RobotToo => ">",
            Self::NotThere => "!",
            Self::Hither => ".",
            Self::Beside => ",",
            _ => BETWEEN,
        }
    }
}

/// A repair: the words that stand, and those of the interregnum.
#[derive(Clone, Copy)]
struct Repair<'w> {
    words: Words<'w>,
    between: Words<'w>,
    shape: Shape,
}

/// A repair with its task.
#[derive(Clone, Copy)]
pub(super) struct Repaired<'w> {
    pub judged: Judged<'w>,
    pub between: Words<'w>,
    pub shape: Shape,
    /// The probability of all words with it.
    pub weight: Scaled,
}

fn is_of_name(word: &Heard) -> bool {
    word.is_name && !word.is_toward
}

/// The names of some words: runs of words that name something.
pub(super) fn names(words: Words<'_>) -> Vec<Range<usize>, NAMES> {
    let mut names: Vec<Range<usize>, NAMES> = Vec::new();
    for (at, _) in words.iter().enumerate().filter(|(_, word)| is_of_name(word)) {
        match names.last_mut() {
            Some(last) if last.end == at => last.end = at.saturating_add(1),
            _ => drop(names.push(at..at.saturating_add(1))),
        }
    }
    names
}

/// The repair of the name `first` by the name `by`.
fn repair<'w>(words: Words<'w>, names: &[Range<usize>], first: usize, by: usize, shape: Shape) -> Option<Repair<'w>> {
    let (first, by, before) = (names.get(first)?, names.get(by)?, names.get(by.checked_sub(1)?)?);
    let is_next = first == before;
    let stands = match shape {
        Shape::Name | Shape::Clause if is_next == (shape == Shape::Name) => words.before(first.start).with(words.from(by.start)),
        Shape::Earlier if !is_next => words.before(first.start).with(words.part(first.end, before.end)).with(words.from(by.start)),
        Shape::All if is_next => words.from(before.end),
        _ => return None,
    };
    let between = words.part(before.end, by.start);
    (is_interregnum(between) || is_after_mark(words, before.end, by.start)).then_some(Repair { words: stands, between, shape })
}

/// The words that stand if the last name, or else the first, tells the place by a thing: those from another name on, if there is one.
fn beside<'w>(words: Words<'w>, names: &[Range<usize>]) -> Vec<Words<'w>, TELLING> {
    let mut stand = Vec::new();
    match names {
        [_] => drop(stand.push(words.only(|_| false))),
        [first, .., last] if names.len() <= BESIDE => {
            let _ = stand.push(words.part(first.start, last.start).with(words.from(last.end)));
            let _ = stand.push(words.from(first.end));
        }
        _ => {}
    }
    stand
}

/// Whether some of the words belong to no command: "no", "I mean". "To the" are no interregnum.
pub(super) fn is_interregnum(words: Words<'_>) -> bool {
    words.any(&|word| word.is_mended || !(word.is_of_lessons() || word.is_toward || word.is_article))
}

/// Whether a mark stands between the words at two positions.
pub(super) fn is_after_mark(words: Words<'_>, begin: usize, end: usize) -> bool {
    let phrase = |at: usize| words.get(at).map(|word| word.phrase);
    begin.checked_sub(1).and_then(phrase) != phrase(end)
}

impl<M: AgentMemory> Agent<M> {
    /// The repairs of some words that are most probable, each for another task.
    #[inline(never)]
    pub(super) fn repairs<'w, D: Domain>(
        &mut self,
        domain: &D,
        words: Words<'w>,
        explained: &mut Explained,
        context: Context<'_>,
    ) -> Result<Vec<Repaired<'w>, WEIGHED>, AgentError> {
        let (names, mut best) = (names(words), Vec::<Repaired<'w>, WEIGHED>::new());
        for by in 0..names.len() {
            for first in 0..by {
                for shape in Shape::OF_UTTERANCE {
                    let Some(repair) = repair(words, &names, first, by, shape) else { continue };
                    keep(&mut best, self.repaired(domain, words, repair, explained, context)?);
                }
            }
            // Of several names, what is meant begins with the first or is the last: "not the red one, the green one".
            let is_outer = by == 0 || by == names.len().saturating_sub(1);
            for shape in Shape::OF_LAST.into_iter().filter(|_| is_outer) {
                let (Some(name), Some(_)) = (names.get(by), of_last(context.earlier.before, shape)) else { continue };
                let repair = Repair { words: words.from(name.start), between: words.only(|word| !word.is_name), shape };
                keep(&mut best, self.repaired(domain, words, repair, explained, context)?);
            }
        }
        let named = names.first().map_or(Words::NONE, |name| words.from(name.start));
        for shape in Shape::WITHOUT_NAME.into_iter().chain([Shape::Hither]) {
            let is_possible = match shape {
                Shape::Hither => !named.is_empty(),
                _ => !context.earlier.is_rest && of_last(context.earlier.before, shape).is_some(),
            };
            if is_possible {
                let repair = Repair { words: named, between: words.only(|word| !word.is_name), shape };
                let _ = best.push(self.repaired(domain, words, repair, explained, context)?);
            }
        }
        for &stands in beside(words, &names).iter().filter(|_| context.told.is_none()) {
            let repair = Repair { words: stands, between: words.only(|word| !word.is_name), shape: Shape::Beside };
            let repaired = self.repaired(domain, words, repair, explained, context)?;
            if !repaired.judged.tasks.is_empty() {
                let _ = best.push(repaired);
            }
        }
        Ok(best)
    }

    /// The task of a repair.
    fn repaired<'w, D: Domain>(
        &mut self,
        domain: &D,
        words: Words<'w>,
        repair: Repair<'w>,
        explained: &mut Explained,
        context: Context<'_>,
    ) -> Result<Repaired<'w>, AgentError> {
        let Repair { words: stands, between, shape } = repair;
        self.explain_repaired(domain, stands, shape, explained, context)?;
        let taken_back = words.without(stands);
        let prior = if shape.change().is_some() { REPAIR * OF_LAST } else { REPAIR };
        let weight = taken_back.iter().fold(explained.here.scaled_by(prior), |weight, word| weight.scaled_by(word.without_task));
        let judged = self.judge_repaired(Judged::likely(super::Hypothesis::Command, stands, 1.0, 1.0), shape, explained);
        Ok(Repaired { judged: Judged { words: stands, ..judged }, between, shape, weight })
    }

    /// The task of the words that stand, which are explained.
    pub(super) fn judge_repaired<'w>(&self, likeliest: Judged<'w>, shape: Shape, explained: &Explained) -> Judged<'w> {
        if total(explained.weights.iter().copied()).is_zero() {
            return Judged { tasks: TaskSet::EMPTY, ..likeliest };
        }
        let judged = self.judge_command(likeliest, Choice::Likeliest, explained);
        match shape.change() {
            // What changes the last task is no command, so it is not learned as one.
            Some(_) if shape == Shape::NotThere => {
                Judged { words: Words::NONE, is_negated: true, hypothesis: super::Hypothesis::Negated, ..judged }
            }
            Some(_) => Judged { words: Words::NONE, ..judged },
            None => judged,
        }
    }

    /// How well the tasks explain the words of a repair that stand. Those about the last task need no act word.
    pub(super) fn explain_repaired<D: Domain>(
        &mut self,
        domain: &D,
        stands: Words<'_>,
        shape: Shape,
        explained: &mut Explained,
        context: Context<'_>,
    ) -> Result<(), AgentError> {
        let view = View { has_act: true, ..View::PLAIN };
        if shape == Shape::Hither {
            let here = |task: usize| self.goal(domain, task).filter(|_| self.place_of_thing(domain, task).is_none());
            let place = self.done(domain).iter().find_map(here);
            let ends_here = |&task: &usize| place.is_some() && self.place_of_thing(domain, task).map(|(_, place)| place) == place;
            let told = ToldTasks { tasks: (0..self.tasks().len()).filter(ends_here).collect(), is_place: true };
            return self.explain_words(domain, stands, view, Context { told: Some(&told), ..context }, None, explained);
        }
        if shape == Shape::Beside {
            // All other names stand.
            let by = stands.whole().only(is_of_name).without(stands);
            let there = self.told_by(domain, by, true, context.wording, explained)?.unwrap_or(TaskSet::EMPTY);
            let is_of_thing = |task: &usize| self.place_of_thing(domain, *task).is_some();
            // If no other name stands, the robot itself goes there.
            let tasks = there.iter().filter(|task| is_of_thing(task) != stands.is_empty()).collect();
            let told = ToldTasks { tasks, is_place: true };
            return self.explain_words(domain, stands, view, Context { told: Some(&told), ..context }, None, explained);
        }
        let Some(recalled) = of_last(context.earlier.before, shape) else {
            return self.explain_all(domain, stands, View::PLAIN, context, explained);
        };
        self.explain_words(domain, stands, view, context, Some(recalled), explained)?;
        explained.points_back = true;
        Ok(())
    }
}

/// Keeps the most probable repairs by a name, one for each task.
fn keep<'w>(best: &mut Vec<Repaired<'w>, WEIGHED>, repaired: Repaired<'w>) {
    if repaired.weight.is_zero() {
        return;
    }
    let same = best.iter().position(|other| other.judged.task == repaired.judged.task);
    let least = (0..best.len()).reduce(|one, other| {
        let weight = |at: usize| best.get(at).map_or(Scaled::ZERO, |it| it.weight);
        if weight(one).exceeds(weight(other)) { other } else { one }
    });
    match same.or(least.filter(|_| best.len() >= BY_NAME)).and_then(|at| best.get_mut(at)) {
        Some(other) if repaired.weight.exceeds(other.weight) => *other = repaired,
        Some(_) => {}
        None => drop(best.push(repaired)),
    }
}

#[cfg(test)]
mod tests {
    use super::super::taught::{for_each, left};
    use super::*;
    use std::string::String;

    #[test]
    fn a_later_name_may_replace_an_earlier_one_and_what_is_between() {
        let rows = [
            ("en", "go to the red room, no, the green one", ((Shape::Name, 0, 1), ["go to the green one", "room no the"])),
            (
                "en",
                "take the purple bag, no, the yellow chair to the red room",
                ((Shape::Name, 0, 1), ["take the yellow chair to the red room", "no the"]),
            ),
            (
                "en",
                "take the purple bag to the blue, sorry, the yellow chair to the red room",
                ((Shape::Clause, 0, 2), ["take the yellow chair to the red room", "sorry the"]),
            ),
            (
                "en",
                "take the purple bag to the red room I mean the yellow chair",
                ((Shape::Earlier, 0, 2), ["take the to the red yellow chair", "room i mean the"]),
            ),
            (
                "en",
                "take the purple bag to the red room forget it go to the blue room",
                ((Shape::All, 1, 2), ["room forget it go to the blue room", "room forget it go to the"]),
            ),
            ("de", "geh ins rote Zimmer, nein, ins grüne", ((Shape::Name, 0, 1), ["geh ins grüne", "zimmer nein ins"])),
            (
                "en",
                "put the purple bag in the blue er in the green room",
                ((Shape::Name, 1, 2), ["put the purple bag in the green room", "er in the"]),
            ),
            ("en", "go to the red room", ((Shape::Name, 0, 1), ["", ""])),
        ];
        for_each(&rows, &|sentence, words, ((shape, first, by), parts)| {
            let repair = repair(words, &names(words), *first, *by, *shape);
            let read = repair.map_or([(); 2].map(|()| String::new()), |it| [it.words, it.between].map(|part| left(sentence, part)));
            assert_eq!(read, *parts, "{sentence}");
        });
    }

    #[test]
    fn the_last_name_or_the_first_may_tell_the_place_by_a_thing() {
        let rows = [
            ("en", "park the yellow chair with the purple bag", std::vec!["yellow chair with the", "with the purple bag"]),
            ("en", "wait with the purple bag", std::vec![""]),
            ("en", "please wait", std::vec![]),
        ];
        for_each(&rows, &|sentence, words, parts| {
            let read: std::vec::Vec<_> = beside(words, &names(words)).iter().map(|&stands| left(sentence, stands)).collect();
            assert_eq!(read, *parts, "{sentence}");
        });
    }
}
