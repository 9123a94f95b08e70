//! Words that refer to earlier sentences: "it", "there", "back", "the other one", "the same with the bag", "again".
//!
//! Such words restrict the tasks to those that fit the conversation. The other words are read as usual, and a thing or place that is
//! referred to needs no name.

use super::classes::Class;
use super::conversation::{Conversation, Fact};
use super::explained::Explained;
use super::heard::{Words, learned};
use super::place::View;
use super::wording::Wording;
use crate::memory::AgentMemory;
use crate::oomdp::Domain;
use crate::probability::Scaled;
use crate::session::{Agent, AgentError};
use crate::task::grounded::is_thing;
use crate::task::{GroundedTask, LiftedTask};

/// The probability that an utterance in a conversation has a reference, and of each word that makes it.
const POINTS_BACK: f32 = 0.4;
const CUE: f32 = 0.6;
/// How much less probable a learned command is without the words for a thing, for a place, or for what to do. "The same" counts twice.
const MISSING: f32 = 10.0;
/// The share of a reading in which the place is a new one: "bring it back to the red room".
const ELSEWHERE: f32 = 0.3;

/// What words can refer to.
#[derive(Clone, Copy)]
pub(super) enum Before<'c> {
    /// No earlier task.
    Nothing,
    /// The conversation of earlier tasks.
    Known(&'c Conversation),
    /// A part of the same utterance that is not done yet.
    Open,
}

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
}

/// The restriction on tasks by the words that refer.
#[derive(Clone, Copy)]
pub(super) struct Recalled<'c> {
    before: Before<'c>,
    thing: Thing,
    place: Place,
}

/// The classes of words that refer to earlier sentences, or to the present place.
const CUES: [Class; 6] = [Class::It, Class::There, Class::Back, Class::Other, Class::Same, Class::Here];

impl Recalled<'_> {
    /// Whether the thing of a task needs no name.
    pub const fn has_thing(&self) -> bool {
        matches!(self.thing, Thing::Last | Thing::Other)
    }

    /// Whether the place of a task needs no name.
    pub fn has_place(&self) -> bool {
        self.place != Place::Free
    }

    /// Whether the meant goal holds already.
    pub fn is_here(&self) -> bool {
        self.place == Place::Here
    }

    /// Whether a task fits the words that refer: it has one proposition, about a subject and its place, and no way.
    pub fn fits<D: Domain + ?Sized>(&self, domain: &D, all: &[LiftedTask], task: &GroundedTask) -> bool {
        let world = domain.world();
        let kind = all.get(usize::from(task.lifted)).filter(|kind| !kind.has_way() && kind.propositions().len() == 1);
        let Some(part) = kind.and_then(|kind| task.propositions(kind).next()) else { return false };
        let (Some(&subject), [_, _]) = (part.arguments.first(), world.schema.parameters(part.proposition)) else { return false };
        let Some(&place) = part.arguments.get(1) else { return false };
        let is_about_thing = is_thing(&world, subject);
        let Before::Known(conversation) = self.before else { return is_about_thing || self.thing == Thing::Free };
        let holds = |fact, object| conversation.holds(domain, fact, object);
        let is_like_last = conversation.last().is_some_and(|last| last.lifted == task.lifted);
        let is_the_thing = match self.thing {
            Thing::Free => true,
            Thing::Last => is_about_thing && holds(Fact::MovedLast, subject),
            Thing::Other if is_about_thing => is_like_last && holds(Fact::OtherOfItsKind, subject),
            Thing::Other => is_like_last && !holds(Fact::NamedLast, place),
            Thing::Named => is_like_last && is_about_thing && !holds(Fact::MovedLast, subject),
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
fn without(words: Words<'_>) -> Option<(Words<'_>, f32)> {
    // "Stay" refers to the present place, not to an earlier sentence.
    let is_here = words.has(Class::Here);
    let mut probability = if is_here { 1.0 } else { POINTS_BACK };
    // "The other one" needs no other word.
    let is_told = words.iter().any(|word| word.classes.contains_any(&[Class::Other, Class::Same]));
    let rest = words.only(|word| {
        let is_cue = word.classes.contains_any(&CUES);
        let is_plain = is_told && word.is_plain();
        if word.classes.contains(Class::Here) {
        } else if is_cue {
            probability *= CUE;
        } else if is_plain {
            probability *= word.beside;
        }
        !(is_cue || is_plain)
    });
    let is_pointing = rest.len() < words.len() && (is_told || is_here || !rest.is_empty());
    is_pointing.then(|| (rest, probability / learned(words, |word| word.classes.contains_any(&CUES))))
}

/// The possible references of the words, each with its share.
fn readings<'c>(words: Words<'_>, before: Before<'c>) -> impl Iterator<Item = (Recalled<'c>, f32)> {
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
    places.iter().map(move |&(place, share)| (Recalled { before, thing, place }, share))
}

impl<M: AgentMemory> Agent<M> {
    /// How well the tasks here explain these words, some of which may refer to earlier sentences. The most probable reading is taken.
    pub(super) fn explain_all<D: Domain + ?Sized>(
        &mut self,
        domain: &D,
        words: Words<'_>,
        wording: &Wording<'_>,
        view: View<'_>,
        explained: &mut Explained,
    ) -> Result<(), AgentError> {
        self.explain_words(domain, words, wording, view, None, explained)?;
        let can_point = words.has(Class::Here) || !matches!(view.before, Before::Nothing);
        let Some((rest, prior)) = without(words).filter(|_| can_point) else { return Ok(()) };
        self.explain_recalled(domain, (words, rest, prior), wording, view, explained)
    }

    /// How well the tasks explain words with a reference: the remaining words, with the prior of the reading.
    #[inline(never)]
    fn explain_recalled<D: Domain + ?Sized>(
        &mut self,
        domain: &D,
        (words, rest, prior): (Words<'_>, Words<'_>, f32),
        wording: &Wording<'_>,
        view: View<'_>,
        explained: &mut Explained,
    ) -> Result<(), AgentError> {
        let mut other = Explained::NEW;
        let is_way = rest.iter().any(|word| word.is_toward);
        for (recalled, share) in readings(words, view.before) {
            let kind = match view.before {
                Before::Known(conversation) if matches!(recalled.thing, Thing::Other | Thing::Named) => {
                    conversation.last().map(|last| last.lifted)
                }
                _ => view.kind,
            };
            let is_here = recalled.is_here();
            let has_act = view.has_act || is_here || matches!(recalled.thing, Thing::Other | Thing::Named);
            let view = View { has_act, kind, done: if is_here { 1.0 } else { view.done }, ..view };
            self.explain_words(domain, rest, wording, view, Some(recalled), &mut other)?;
            // Words that a command would have are missing.
            let is_same = recalled.thing == Thing::Named;
            let missing = [recalled.has_thing(), recalled.has_place() && !(is_here && is_way), is_same, is_same];
            let missing = missing.into_iter().filter(|&is_missing| is_missing).fold(1.0, |product, _| product * MISSING);
            let prior = prior * share * missing;
            // A thing that is not here cannot stay.
            let absent = if is_here { Scaled::ZERO } else { other.absent };
            (other.here, other.absent) = (other.here.scaled_by(prior), absent.scaled_by(prior));
            other.points_back = true;
            if other.here.exceeds(explained.here) {
                core::mem::swap(explained, &mut other);
            }
        }
        Ok(())
    }

    /// The position of the last task in the session, if the words ask for it again and for nothing else.
    pub(super) fn again(&self, words: Words<'_>, before: Before<'_>, explained: &Explained) -> Option<usize> {
        let Before::Known(conversation) = before else { return None };
        let last = conversation.last()?;
        let asks = words.iter().any(|word| word.classes.contains(Class::Again) && !word.classes.contains_any(&[Class::Back, Class::Undo]));
        let task = self.tasks().iter().position(|task| (task.lifted, task.bindings) == (last.lifted, last.bindings))?;
        (asks && (!explained.acts || explained.signed.contains(task))).then_some(task)
    }
}

impl Explained {
    /// The words that name objects. References change with each use, so nothing is learned of them.
    pub(super) fn naming<'w>(&self, words: Words<'w>) -> Words<'w> {
        if self.points_back { without(words).map_or(words, |(rest, _)| rest) } else { words }
    }

    /// Keeps one task alone.
    pub(super) fn keep_only(&mut self, task: usize) {
        for (position, weight) in self.weights.iter_mut().enumerate() {
            *weight = if position == task { Scaled::ONE } else { Scaled::ZERO };
        }
    }
}
