//! The hypotheses about an utterance, and their probabilities.

use super::classes::{Class, Classes};
use super::explained::{Explained, FOREIGN};
use super::heard::{Heard, Words, learned};
use super::place::Place;
use super::readings::{Parting, SEVERAL, all, may_turn, negated};
use super::syntax::{is_past, new_names};
use super::wording::Wording;
use crate::memory::AgentMemory;
use crate::oomdp::Domain;
use crate::probability::{Scaled, total};
use crate::session::{Agent, AgentError};
use core::fmt;
use heapless::Vec;

/// The prior of each hypothesis; the [readings](super::readings) have their own, and a plain command has the rest.
const NOTHING: f32 = 0.15;
const ABSENT: f32 = 0.05;
const ABOUT: f32 = 0.05;
const TALK: f32 = 0.02;
/// The prior of a command's opposite if a new word may negate it: as probable as the command.
const REVERSED: f32 = 1.0 - NOTHING - ABSENT - ABOUT - SEVERAL;
/// A table with fewer negations does not have all of a language.
const FEW: usize = 5;
/// The weight of "again" after an earlier task, unnormalised.
const AGAIN: f32 = 1.0;

/// A hypothesis about an utterance.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[non_exhaustive]
pub enum Hypothesis {
    /// A command for one task.
    Command,
    /// Nothing that the robot can do.
    Nothing,
    /// A command about a thing that is not here.
    Absent,
    /// Words about a thing, without an act word.
    About,
    /// A negated command: a state to avoid.
    Negated,
    /// Perhaps the opposite of a command: a word is new, and the table is too small to exclude a negation.
    Reversed,
    /// Several commands.
    Several,
    /// A command for all things of a class.
    All,
    /// The last task once more.
    Again,
    /// Words of a closed class: praise, stop, a greeting ...
    Talk(Class),
}

impl fmt::Display for Hypothesis {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Command => "a command",
            Self::Nothing => "nothing that I can do",
            Self::Absent => "a thing that is not here",
            Self::About => "a thing, but not what to do with it",
            Self::Negated => "a prohibition",
            Self::Reversed => "perhaps the opposite of a command",
            Self::Several => "several commands",
            Self::All => "all things of a kind",
            Self::Again => "the same again",
            Self::Talk(class) => class.name(),
        })
    }
}

impl<M: AgentMemory> Agent<M> {
    /// The likeliest hypothesis, its probability, and the probability of a plain command.
    #[inline(never)]
    pub(super) fn hypotheses<D: Domain + ?Sized>(
        &mut self,
        domain: &D,
        words: Words<'_>,
        wording: &Wording<'_>,
        explained: &Explained,
        place: Place<'_>,
        parting: Option<Parting<'_>>,
    ) -> Result<(Hypothesis, f32, f32), AgentError> {
        let mut hypotheses: Vec<(Hypothesis, Scaled), 16> = Vec::new();
        let mut add = |hypothesis: Hypothesis, weight: Scaled| match hypotheses.iter_mut().find(|(known, _)| *known == hypothesis) {
            Some((_, sum)) => *sum = sum.plus(weight),
            None => drop(hypotheses.push((hypothesis, weight))),
        };
        // As probable as the command, and listed before it: waiting does no harm.
        if wording.closed.count(Class::Negation) < FEW && may_turn(words, explained.has_new_verb) {
            add(Hypothesis::Reversed, explained.here.scaled_by(REVERSED));
        }
        // The names of two things belong to two commands.
        let is_of_two = parting.is_some() && (is_past(words) || explained.own.is_empty() && new_names(words) == 0);
        // If all things of a place are taken to another, the name of the place names no thing.
        let of_all = all(words);
        let is_of_all = of_all.as_ref().is_some_and(|rest| !rest.from.is_empty());
        let of_one = if is_of_two || is_of_all { FOREIGN } else { 1.0 };
        add(Hypothesis::Command, explained.here.scaled_by(of_one * (1.0 - NOTHING - ABSENT - ABOUT - SEVERAL)));
        let no_task = |of: &dyn Fn(usize, &Heard) -> f32| {
            let words = words.iter().enumerate();
            words.fold(Scaled::new(wording.end), |product, (position, word)| product.scaled_by((1.0 - wording.end) * of(position, word)))
        };
        add(Hypothesis::Nothing, no_task(&|_, word| word.beside).scaled_by(NOTHING * if place.told.is_some() { FOREIGN } else { 1.0 }));
        add(Hypothesis::Absent, explained.absent.scaled_by(ABSENT * of_one));
        if !explained.signed.contains(explained.best().0) && !place.is_rest {
            let without = wording.coverage.most_without_task(self.language().tables().layout());
            add(Hypothesis::About, explained.here.scaled_by(ABOUT / without));
        }
        for class in Class::ALL.into_iter().filter(|class| class.is_talk()) {
            // After an earlier task, "back" is a place.
            let speaks = |word: &Heard| word.classes.contains(class) && !(place.is_known() && word.classes.contains(Class::Back));
            if !words.iter().any(speaks) {
                continue;
            }
            let size = wording.closed.count(class) as f32;
            let weight = no_task(&|position, word| match word.classes.contains(class) {
                true => 0.5 / size * if position == 0 { 3.0 } else { 1.0 } + 0.5 * word.beside,
                false => 0.8 * word.beside,
            });
            let prior = if place.is_known() && class == Class::Again { AGAIN } else { TALK };
            add(Hypothesis::Talk(class), weight.scaled_by(prior / learned(words, |word| word.classes.contains(class))));
        }
        for (hypothesis, rest) in [(Hypothesis::Negated, negated(words)), (Hypothesis::All, of_all)] {
            let Some(rest) = rest else { continue };
            let (mut explained, mut from) = (Explained::NEW, Scaled::ONE);
            if !rest.from.is_empty() {
                self.explain_all(domain, rest.from, wording, place.view(rest.view), &mut explained)?;
                from = explained.here;
            }
            self.explain_all(domain, rest.words, wording, place.view(rest.view), &mut explained)?;
            add(hypothesis, explained.here.times(from).scaled_by(rest.prior));
            add(Hypothesis::Absent, explained.absent.times(from).scaled_by(rest.prior * ABSENT));
        }
        if let Some(parting) = parting {
            add(Hypothesis::Several, parting.weight);
        }
        let whole = total(hypotheses.iter().map(|(_, weight)| *weight));
        let mut best = (Hypothesis::Command, Scaled::ZERO);
        for &(hypothesis, weight) in &hypotheses {
            if weight.exceeds(best.1) {
                best = (hypothesis, weight);
            }
        }
        // If all words are in closed classes, the utterance is talk, and the likeliest class says more than "nothing". No task depends on
        // it.
        if best.0 == Hypothesis::Nothing && words.iter().all(|word| word.classes != Classes::NONE) {
            let is_talk = |it| matches!(it, Hypothesis::Talk(class) if class != Class::Again || !place.is_known());
            let mut most = Scaled::ZERO;
            for &(hypothesis, weight) in hypotheses.iter().filter(|(it, _)| is_talk(*it)) {
                if weight.exceeds(most) {
                    (best.0, most) = (hypothesis, weight);
                }
            }
        }
        let command = hypotheses.iter().find(|(it, _)| *it == Hypothesis::Command).map_or(0.0, |(_, weight)| weight.over(whole));
        Ok((best.0, best.1.over(whole), command))
    }
}
