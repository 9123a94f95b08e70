//! Words that refer to earlier sentences: "it", "there", "back", "the other one", "the same with the bag", "again".
//!
//! Such words restrict the tasks to those that fit the conversation. The other words are read as usual, and a thing or place that is
//! referred to needs no name.

use super::conversation::{Before, Fact};
use super::repair::Shape;
use super::words::{Words, learned};
use crate::oomdp::Domain;
use crate::task::grounded::is_thing;
use crate::task::{GroundedTask, LiftedTask};
use crate::voice::classes::Class;

/// The probability that an utterance in a conversation has a reference, and of each word that makes it.
const POINTS_BACK: f32 = 0.4;
const CUE: f32 = 0.6;
/// How much less probable a learned command is without the words for a thing, for a place, or for what to do. "The same" counts twice.
const MISSING: f32 = 10.0;
/// The share of a reading in which the place is a new one: "bring it back to the red room".
const ELSEWHERE: f32 = 0.3;

/// How the words restrict the place.
#[derive(Clone, Copy, PartialEq)]
enum Place {
    /// It must be named.
    Free,
    /// The place named last.
    Named,
    /// The earlier place of the thing, or of the robot.
    Was,
    /// The present place.
    Here,
}

/// How the words restrict the thing.
#[derive(Clone, Copy, PartialEq)]
enum Thing {
    /// It must be named, or the task is about none.
    Free,
    /// The thing of the last task.
    Last,
    /// Another of its kind.
    Other,
    /// Any but the thing of the last task, for the same kind of task.
    Named,
    /// As in the last task: its thing, or the robot itself.
    Same,
    /// The robot itself.
    Robot,
}

/// The restriction on tasks by the words that refer.
#[derive(Clone, Copy)]
pub(super) struct Recalled<'c> {
    before: Before<'c>,
    thing: Thing,
    place: Place,
    /// Whether only a task of the last one's kind fits.
    is_of_last_kind: bool,
}

/// The classes of words that refer to earlier sentences, or to the present place.
const CUES: [Class; 6] = [Class::It, Class::There, Class::Back, Class::Other, Class::Same, Class::Here];

impl Recalled<'_> {
    /// Whether the thing of a task needs no name.
    pub const fn has_thing(&self) -> bool {
        matches!(self.thing, Thing::Last | Thing::Other | Thing::Same)
    }

    /// Whether the place of a task needs no name.
    pub fn has_place(&self) -> bool {
        self.place != Place::Free
    }

    /// Whether the meant goal holds already.
    pub fn is_here(&self) -> bool {
        self.place == Place::Here
    }

    /// Whether only a task of the last one's kind fits.
    pub const fn is_of_last_kind(&self) -> bool {
        self.is_of_last_kind
    }

    /// The factor for words that a command would have and that are missing here. `is_way`: whether a word of direction remains.
    pub fn missing(&self, is_way: bool) -> f32 {
        let is_same = self.thing == Thing::Named;
        let missing = [self.has_thing(), self.has_place() && !(self.is_here() && is_way), is_same, is_same];
        missing.into_iter().filter(|&is_missing| is_missing).fold(1.0, |product, _| product * MISSING)
    }

    /// Whether a task fits the words that refer: it has one proposition, about a subject and its place, and no way.
    pub fn fits<D: Domain>(&self, domain: &D, all: &[LiftedTask], task: &GroundedTask) -> bool {
        let world = domain.world();
        let kind = all.get(usize::from(task.lifted)).filter(|kind| !kind.has_way() && kind.propositions().len() == 1);
        let Some(part) = kind.and_then(|kind| task.propositions(kind).next()) else { return false };
        let (Some(&subject), [_, _]) = (part.arguments.first(), world.schema.parameters(part.proposition)) else { return false };
        let Some(&place) = part.arguments.get(1) else { return false };
        let is_about_thing = is_thing(&world, subject);
        let Before::Known(conversation) = self.before else { return is_about_thing || self.thing == Thing::Free };
        let holds = |fact, object| conversation.holds(domain, fact, object);
        if self.is_of_last_kind && conversation.last().is_none_or(|last| last.lifted != task.lifted) {
            return false;
        }
        let is_the_thing = match self.thing {
            Thing::Free => true,
            Thing::Last => is_about_thing && holds(Fact::MovedLast, subject),
            Thing::Other if is_about_thing => holds(Fact::OtherOfItsKind, subject),
            Thing::Other => !holds(Fact::NamedLast, place),
            Thing::Named => is_about_thing && !holds(Fact::MovedLast, subject),
            Thing::Same => !is_about_thing || holds(Fact::MovedLast, subject),
            Thing::Robot => !is_about_thing,
        };
        let is_the_place = match self.place {
            Place::Free | Place::Here => true,
            Place::Named => holds(Fact::NamedLast, place),
            Place::Was if is_about_thing => holds(Fact::MovedLast, subject) && holds(Fact::WasThereBefore, place),
            Place::Was => holds(Fact::RobotWasThereBefore, place),
        };
        // "The other room" differs from the place of the last task.
        is_the_thing && (is_the_place || self.thing == Thing::Other && !is_about_thing)
    }
}

/// The words without those that refer, and the probability of the reference.
pub(super) fn without(words: Words<'_>) -> Option<(Words<'_>, f32)> {
    // "Stay" refers to the present place, not to an earlier sentence.
    let is_here = words.has(Class::Here);
    let mut probability = if is_here { 1.0 } else { POINTS_BACK };
    // "The other one" needs no other word.
    let is_told = words.any(&|word| word.is_any(&[Class::Other, Class::Same]));
    let rest = words.only(|word| {
        let is_cue = word.is_any(&CUES);
        let is_plain = is_told && word.is_plain();
        probability *= match () {
            () if word.is(Class::Here) => 1.0,
            () if is_cue => CUE,
            () if is_plain => word.without_task,
            () => 1.0,
        };
        !(is_cue || is_plain)
    });
    let is_pointing = rest.len() < words.len() && (is_told || is_here || !rest.is_empty());
    is_pointing.then(|| (rest, probability / learned(words, &|word| word.is_any(&CUES))))
}

/// The possible references of the words, each with its share.
pub(super) fn readings<'c>(words: Words<'_>, before: Before<'c>) -> impl Iterator<Item = (Recalled<'c>, f32)> {
    let thing = if words.has(Class::Other) {
        Thing::Other
    } else if words.has(Class::Same) && !words.has(Class::There) {
        Thing::Named
    } else if words.has(Class::It) {
        Thing::Last
    } else {
        Thing::Free
    };
    let places: &'static [(Place, f32)] = if words.has(Class::Here) {
        &[(Place::Here, 1.0)]
    } else if words.has(Class::There) {
        &[(Place::Named, 1.0)]
    } else if words.has(Class::Back) {
        &[(Place::Was, 1.0 - ELSEWHERE), (Place::Free, ELSEWHERE)]
    } else if matches!(thing, Thing::Other | Thing::Named) {
        &[(Place::Named, 1.0 - ELSEWHERE), (Place::Free, ELSEWHERE)]
    } else {
        &[(Place::Free, 1.0)]
    };
    let is_of_last_kind = matches!(thing, Thing::Other | Thing::Named);
    places.iter().map(move |&(place, share)| (Recalled { before, thing, place, is_of_last_kind }, share))
}

/// The tasks that words about the last task can mean, by the shape of the repair that they make: "no, the yellow one", "put it back". `None`
/// if the shape is that of another repair, or nothing was done.
pub(super) fn of_last(before: Before<'_>, shape: Shape) -> Option<Recalled<'_>> {
    let (thing, place) = match shape {
        Shape::LastPlace => (Thing::Same, Place::Free),
        Shape::LastThing => (Thing::Named, Place::Named),
        Shape::LastNames => (Thing::Free, Place::Free),
        Shape::Back => (Thing::Same, Place::Was),
        Shape::OtherThing => (Thing::Other, Place::Named),
        Shape::RobotToo => (Thing::Robot, Place::Named),
        Shape::NotThere => (Thing::Same, Place::Named),
        Shape::Name | Shape::Clause | Shape::Earlier | Shape::All | Shape::Hither | Shape::Beside => return None,
    };
    let is_done = matches!(before, Before::Known(conversation) if conversation.last().is_some_and(|last| !last.is_negated()));
    is_done.then_some(Recalled { before, thing, place, is_of_last_kind: shape != Shape::RobotToo })
}
