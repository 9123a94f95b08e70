//! The hypotheses about an utterance, and their probabilities.

use super::context::Context;
use super::explained::{Explained, FOREIGN};
use super::heard::Heard;
use super::readings::{all, may_turn, negated};
use super::several::{Parting, SEVERAL};
use super::syntax::{is_past, new_names};
use super::verdict::Doubts;
use super::words::{Words, learned};
use crate::memory::AgentMemory;
use crate::oomdp::Domain;
use crate::probability::{Scaled, total};
use crate::session::{Agent, AgentError};
use crate::task::TaskSet;
use crate::voice::classes::Class;
use core::fmt;
use heapless::Vec;

/// The prior of each hypothesis. A plain command has the rest, and the [readings](super::readings) have their own.
const NOTHING: f32 = 0.15;
const ABSENT: f32 = 0.05;
const ABOUT: f32 = 0.05;
const TALK: f32 = 0.02;
const COMMAND: f32 = 1.0 - NOTHING - ABSENT - ABOUT - SEVERAL;
/// The prior of a command's opposite if a new word may negate it: as probable as the command.
const REVERSED: f32 = COMMAND;
/// A table with fewer negations does not have all of a language.
const FEW: usize = 5;
/// The weight of "again" after an earlier task, unnormalised.
const AGAIN: f32 = 1.0;

/// A hypothesis about an utterance.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
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

/// The decision on some words: the likeliest hypothesis, and then its tasks.
#[derive(Clone, Copy)]
pub(super) struct Judged<'w> {
    pub hypothesis: Hypothesis,
    /// The words that name the tasks; all words before the tasks are known.
    pub words: Words<'w>,
    pub task: usize,
    pub tasks: TaskSet,
    /// The probability of the tasks; of the hypothesis before they are known.
    pub probability: f32,
    /// The probability that one of the session's tasks is meant; of a plain command before they are known.
    pub command: f32,
    /// Whether they are forbidden.
    pub is_negated: bool,
    /// Whether the robot acts on it.
    pub is_accepted: bool,
    /// What speaks against the tasks.
    pub doubts: Doubts,
    /// The piece of the utterance where the rest begins.
    pub rest: Option<usize>,
}

impl<'w> Judged<'w> {
    /// A hypothesis about words without its tasks. `command` is the probability of a plain command.
    pub const fn likely(hypothesis: Hypothesis, words: Words<'w>, probability: f32, command: f32) -> Self {
        Self {
            hypothesis,
            words,
            task: 0,
            tasks: TaskSet::EMPTY,
            probability,
            command,
            is_negated: false,
            is_accepted: false,
            doubts: Doubts::NONE,
            rest: None,
        }
    }
}

/// The hypotheses that some words have, with their weights.
struct Weighed(Vec<(Hypothesis, Scaled), 16>);

impl Weighed {
    fn add(&mut self, hypothesis: Hypothesis, weight: Scaled) {
        match self.0.iter_mut().find(|(known, _)| *known == hypothesis) {
            Some((_, sum)) => *sum = sum.plus(weight),
            None => drop(self.0.push((hypothesis, weight))),
        }
    }

    /// Each hypothesis with its probability, the probability of a plain command, and that of all together.
    fn shares(self) -> (Shares, f32, Scaled) {
        let whole = total(self.0.iter().map(|(_, weight)| *weight));
        let mut shares = Shares::new();
        // Not collected: that could panic, for all that the compiler knows.
        self.0.iter().for_each(|&(hypothesis, weight)| {
            shares.push((hypothesis, weight.over(whole))).ok();
        });
        let command = shares.iter().find(|(it, _)| *it == Hypothesis::Command).map_or(0.0, |&(_, share)| share);
        (shares, command, whole)
    }
}

/// The hypotheses about some words, each with its probability.
pub(super) type Shares = Vec<(Hypothesis, f32), 16>;

/// The likeliest hypothesis about words; after an earlier task if `is_known`.
pub(super) fn likeliest(shares: &Shares, words: Words<'_>, is_known: bool) -> (Hypothesis, f32) {
    let best = |is_one: &dyn Fn(Hypothesis) -> bool| {
        let of_one = shares.iter().filter(|(hypothesis, _)| is_one(*hypothesis));
        of_one.fold(None, |best: Option<(Hypothesis, f32)>, &it| if it.1 > best.map_or(0.0, |(_, most)| most) { Some(it) } else { best })
    };
    let (hypothesis, most) = best(&|_| true).unwrap_or((Hypothesis::Command, 0.0));
    // If all words are in closed classes, the utterance is talk, and the likeliest class says more than "nothing". No task depends on it.
    let is_talk = |it| matches!(it, Hypothesis::Talk(class) if class != Class::Again || !is_known);
    let all_closed = hypothesis == Hypothesis::Nothing && words.iter().all(|word| !word.is_open());
    (if all_closed { best(&is_talk).map_or(hypothesis, |(talk, _)| talk) } else { hypothesis }, most)
}

/// The probability of words without a task; `of` is that of each word, at its position.
fn without_task(words: Words<'_>, end: f32, of: &dyn Fn(usize, &Heard) -> f32) -> Scaled {
    let words = words.iter().enumerate();
    words.fold(Scaled::new(end), |product, (at, word)| product.scaled_by((1.0 - end) * of(at, word)))
}

/// Adds the classes of words that are no command.
fn add_talk(weighed: &mut Weighed, words: Words<'_>, context: Context<'_>) {
    let (wording, is_known) = (context.wording, context.is_known());
    for class in Class::ALL.into_iter().filter(|class| class.is_talk()) {
        // After an earlier task, "back" is a place.
        if !words.any(&|word| word.is(class) && !(is_known && word.is(Class::Back))) {
            continue;
        }
        let size = wording.closed.count(class) as f32;
        let weight = without_task(words, wording.end, &|at, word| match word.is(class) {
            true => 0.5 / size * if at == 0 { 3.0 } else { 1.0 } + 0.5 * word.without_task,
            false => 0.8 * word.without_task,
        });
        let prior = if is_known && class == Class::Again { AGAIN } else { TALK };
        weighed.add(Hypothesis::Talk(class), weight.scaled_by(prior / learned(words, &|word| word.is(class))));
    }
}

impl<M: AgentMemory> Agent<M> {
    /// The hypotheses about words with their probabilities, and the probability of a plain command.
    #[inline(never)]
    pub(super) fn hypotheses<D: Domain>(
        &mut self,
        domain: &D,
        words: Words<'_>,
        explained: &Explained,
        context: Context<'_>,
        parting: Option<Parting<'_>>,
    ) -> Result<(Shares, f32, Scaled), AgentError> {
        let (wording, mut weighed) = (context.wording, Weighed(Vec::new()));
        // As probable as the command, and listed before it: waiting does no harm.
        if wording.closed.count(Class::Negation) < FEW && may_turn(words, explained.has_new_verb) {
            weighed.add(Hypothesis::Reversed, explained.here.scaled_by(REVERSED));
        }
        // The names of two things belong to two commands.
        let is_of_two = parting.is_some() && (is_past(words) || explained.own.is_empty() && new_names(words) == 0);
        // If all things of a place are taken to another, the name of the place names no thing.
        let of_all = all(words);
        let of_one = if is_of_two || of_all.as_ref().is_some_and(|rest| !rest.from.is_empty()) { FOREIGN } else { 1.0 };
        weighed.add(Hypothesis::Command, explained.here.scaled_by(of_one * COMMAND));
        let nothing = NOTHING * if context.told.is_some() { FOREIGN } else { 1.0 };
        weighed.add(Hypothesis::Nothing, without_task(words, wording.end, &|_, word| word.without_task).scaled_by(nothing));
        weighed.add(Hypothesis::Absent, explained.absent.scaled_by(ABSENT * of_one));
        if !explained.acted.contains(explained.best().0) && !context.earlier.is_rest {
            let without = wording.coverage.most_without_task(self.language().tables().layout());
            weighed.add(Hypothesis::About, explained.here.scaled_by(ABOUT / without));
        }
        add_talk(&mut weighed, words, context);
        for (hypothesis, rest) in [(Hypothesis::Negated, negated(words)), (Hypothesis::All, of_all)] {
            let Some(rest) = rest else { continue };
            let (mut explained, mut from) = (Explained::NEW, Scaled::ONE);
            if !rest.from.is_empty() {
                self.explain_all(domain, rest.from, rest.view, context, &mut explained)?;
                from = explained.here;
            }
            self.explain_all(domain, rest.words, rest.view, context, &mut explained)?;
            weighed.add(hypothesis, explained.here.times(from).scaled_by(rest.prior));
            weighed.add(Hypothesis::Absent, explained.absent.times(from).scaled_by(rest.prior * ABSENT));
        }
        if let Some(parting) = parting {
            weighed.add(Hypothesis::Several, parting.weight);
        }
        Ok(weighed.shares())
    }
}
