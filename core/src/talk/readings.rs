//! Readings of an utterance that differ from one plain command: negated commands, all things of a kind, and several commands.

use super::classes::{Class, Classes};
use super::explained::Explained;
use super::heard::{Heard, Words, learned};
use super::place::{Place, View};
use super::syntax::{begins_with_way, is_question, stays_by_name};
use super::wording::Wording;
use crate::capacity::WORDS_PER_COMMAND;
use crate::memory::AgentMemory;
use crate::oomdp::{Domain, ObjectId};
use crate::probability::{Scaled, total};
use crate::session::{Agent, AgentError};
use crate::task::TaskSet;
use crate::task::grounded::is_thing;
use heapless::Vec;

/// The priors of a negation, of several commands and of all things of a kind.
const NEGATED: f32 = 0.1;
pub(super) const SEVERAL: f32 = 0.05;
const ALL: f32 = 0.03;
/// The probability of a word as a cue for a negation, several commands or all things.
const CUE: f32 = 0.15;
/// The share of tasks that hold already, if a change may be asked for or not.
pub(super) const EITHER: f32 = 0.5;
/// The same if a change is asked for, and the task's goal is to be undone.
const CHANGE: f32 = 0.65;
/// The factor for "all", whose things need no name: e^4.
const UNNAMED: f32 = 54.598_15;
/// The same for a plural, which is more probable than a slip.
const PLURAL: f32 = 1_000.0;
/// The most clauses of one command; "the bag and the chair" has two.
const CLAUSES_PER_COMMAND: usize = 2;
/// The prior of two commands that share the place in the second: "the bag and the chair to the red room".
const SHARED: f32 = 0.3;
/// The probability of each word of a shared place. The place is said once but counts in both commands, so it is divided out once.
const SAID_ONCE: f32 = 0.2;
/// The number of words after "all" that may name the things.
const NAME_OF_ALL: usize = 2;
/// The number of words of "to the".
const ARTICLE: usize = 2;

/// A reading of an utterance: its words without the cues.
pub(super) struct WithoutCues<'w> {
    pub words: Words<'w>,
    /// The words that name exceptions.
    pub except: Words<'w>,
    /// The words that name the present place of the things.
    pub from: Words<'w>,
    /// The prior of this reading.
    pub prior: f32,
    pub view: View<'static>,
    /// Whether the reading is certain, given its tasks.
    pub is_clear: bool,
    /// Whether it needs no act word: "leave the red room".
    pub is_act: bool,
    /// The same for a task about a thing. "Leave the chair in the red room" is the opposite of "out of the red room".
    pub is_act_for_things: bool,
    /// Whether it may say that a thing stays: "leave the chair in the red room".
    pub stays: bool,
    /// Whether it negates a negation: "don't leave the red room".
    pub is_double: bool,
}

/// The words without the cues of some classes, and the probability of these cues. Adjacent cues count once: "out of", "all things".
fn without<'w>(words: Words<'w>, cues: &[Class]) -> Option<(Words<'w>, f32)> {
    let is_out = cues.contains(&Class::Out) && (words.has(Class::Out) || is_taken_from(words));
    let (mut probability, mut before) = (1.0, Before::Other);
    let rest = words.only(|word| {
        let is_cue = word.classes.contains_any(cues);
        let is_from = is_out && word.classes.contains(Class::From);
        // An article in a grammatical case that no lesson had: "aus dem Zimmer".
        let is_article = before == Before::From && word.is_strange();
        if is_cue {
            probability *= if before == Before::Cue { 1.0 } else { CUE };
        }
        before = if is_cue && !word.classes.contains(Class::From) {
            Before::Cue
        } else if is_cue || is_from {
            Before::From
        } else {
            Before::Other
        };
        !(is_cue || is_from || is_article)
    });
    probability *= if is_out && !words.has(Class::Out) { CUE } else { 1.0 };
    Some((rest, probability)).filter(|(rest, _)| rest.len() < words.len() && !rest.is_empty())
}

/// Whether a new verb takes something away from a place: "clear the chairs from the red room".
fn is_taken_from(words: Words<'_>) -> bool {
    let is_verb = words.iter().find(|word| word.classes == Classes::NONE).is_some_and(|word| word.is_new);
    let behind = words.at(Class::From).map_or(Words::NONE, |from| words.part(from, words.len()));
    is_verb && !words.iter().any(|word| word.is_toward) && behind.iter().any(|word| word.is_name)
}

/// The kind of the previous word.
#[derive(Clone, Copy, PartialEq)]
enum Before {
    Cue,
    From,
    Other,
}

/// The words read as a negated command, if there is a cue for one.
pub(super) fn negated(words: Words<'_>) -> Option<WithoutCues<'_>> {
    // "All chairs out of the blue room into the red room" states a goal.
    if !words.has(Class::Negation) && !from_place(words, first_of_all(words), false).1.is_empty() {
        return None;
    }
    let cues = [Class::Negation, Class::Out, Class::But];
    // "All chairs out of the red room".
    let is_of_all = is_all_out(words);
    let (rest, mut probability) = without(words, if is_of_all { &[Class::Out, Class::All] } else { &cues })?;
    probability *= if is_of_all { UNNAMED } else { 1.0 };
    let prior = NEGATED * probability / learned(words, |word| word.classes.contains_any(&cues));
    let (is_out, is_not) = (words.has(Class::Out) || is_taken_from(words), words.has(Class::Negation));
    // "Leave" implies a present place, and needs no other act word.
    let view = if is_out { View { done: CHANGE, has_act: true, ..View::PLAIN } } else { View { done: EITHER, ..View::PLAIN } };
    // "Do not leave" is a double negation, and so is "not anywhere but"; "anywhere but not" is none. "Why don't you go" is no command. "If
    // it's not too much trouble" is none either. "Anywhere" is no question word: "n'importe où".
    let is_told = words.get(0).is_some_and(|word| word.classes.contains(Class::You));
    let not = words.at(Class::Negation);
    let at = not.map_or(usize::MAX, |not| not.saturating_add(1));
    let last = words.iter().enumerate().filter_map(|(at, word)| word.classes.contains(Class::Negation).then_some(at)).last();
    // "You are not allowed" forbids, "you don't have to" does not, and "don't you like it?" asks.
    let asked = if is_told { words.part(last.unwrap_or(0), words.len()) } else { words };
    let asks_you = words.is_asked && words.get(at).is_some_and(|word| word.classes.contains(Class::You));
    let is_question = !words.has(Class::But) && (is_question(asked) || asks_you);
    // "Ne" alone negates nothing: "ne va que dans la salle rouge".
    let negates = |word: &Heard| word.is_new || word.classes.contains(Class::Negation) && !word.classes.contains(Class::Or);
    let is_half = is_not && !words.iter().any(negates);
    let is_not_but = words.at(Class::But).zip(not).is_some_and(|(but, not)| not < but);
    // In "go to the red room ... no", nothing that could be negated follows.
    let is_before_name = |not: usize| words.iter().skip(not).any(|word| word.is_name);
    let turns = !is_not || is_out || words.has(Class::You) || not.is_some_and(is_before_name);
    let is_act = is_out || words.has(Class::But) || begins_with_way(rest) || rest.iter().any(Heard::may_act);
    // "Leave the chair in the red room" says that it stays; "right away go into the red room" asks for the room. The "to" of "has to come
    // out" is another one.
    let stays = is_out && rest.iter().zip(rest.iter().skip(1)).any(|(way, word)| way.is_toward && !word.may_act());
    let is_there = stays && rest.iter().any(|word| word.is_of_task && !word.is_toward);
    // "Don't move the bag, it has to stay here" says the same thing twice.
    let is_clear = !(is_question
        || is_half
        || words.has(Class::If)
        || is_not_but
        || is_there
        || is_not && stays_by_name(words) && !denies_stay(words))
        && turns;
    let is_act_for_things = is_act && (is_not || words.has(Class::From));
    let is_double = is_not && is_out;
    Some(WithoutCues {
        words: rest,
        except: Words::NONE,
        from: Words::NONE,
        prior,
        view,
        is_clear,
        is_act,
        is_act_for_things,
        stays,
        is_double,
    })
}

/// Whether a word such as "stay" is negated: "the basket can't stay in the green room".
fn denies_stay(words: Words<'_>) -> bool {
    let not = words.at(Class::Negation).unwrap_or(words.len());
    let near = |word: &&Heard| word.classes.contains_any(&[Class::Negation, Class::Polite, Class::Here]);
    words.iter().skip(not).take_while(near).any(|word| word.classes.contains(Class::Here))
}

/// Whether all things of a kind are to leave a place.
fn is_all_out(words: Words<'_>) -> bool {
    words.has(Class::Out)
        && words.has(Class::All)
        && !words.has(Class::Negation)
        && !words.has(Class::But)
        && from_place(words, first_of_all(words), false).1.is_empty()
}

/// Whether several things may be meant that must leave a place: "the chairs".
pub(super) fn is_of_several(words: Words<'_>) -> bool {
    is_all_out(words) || words.iter().any(|word| word.is_plural)
}

/// The words read as a command about all things of a kind, if there is a cue for that: "all chairs", "the chairs".
pub(super) fn all(words: Words<'_>) -> Option<WithoutCues<'_>> {
    if is_all_out(words) {
        return None;
    }
    let is_but = |word: &Heard| word.classes.contains(Class::But) && !word.classes.contains(Class::All);
    // "Everything but the red bag to the blue room".
    let but = words.iter().position(is_but);
    let behind = but.map_or(Words::NONE, |but| words.part(but, words.len()));
    let until = behind.iter().position(|word| word.is_toward || word.is_of_task).unwrap_or(behind.len());
    let except = behind.part(1, until);
    let words = but.map_or(words, |but| words.part(0, but).with(behind.part(until, words.len())));
    let is_exception =
        |word: &Heard| is_but(word) || word.classes.contains_any(&[Class::Negation, Class::Out]) && !word.classes.contains(Class::All);
    let (words, from) = from_place(words, first_of_all(words), false);
    let has_exception = words.iter().any(is_exception) || but.is_some() && !except.iter().any(|word| word.is_name);
    let (rest, prior, is_clear) = if let Some((rest, probability)) = without(words, &[Class::All]) {
        let behind = words.iter().skip_while(|word| !word.classes.contains(Class::All));
        (rest, UNNAMED * probability, !behind.skip(1).take(NAME_OF_ALL).take_while(|word| !word.is_name).any(|word| word.is_new))
    } else {
        let plural = words.iter().position(|word| word.is_plural)?;
        (words, PLURAL, has_one_article(words.part(0, plural)))
    };
    let view = View { done: EITHER, ..View::PLAIN };
    let is_clear = is_clear && !has_exception;
    Some(WithoutCues {
        words: rest,
        except,
        from,
        prior: ALL * prior,
        view,
        is_clear,
        is_act: false,
        is_act_for_things: false,
        stays: false,
        is_double: false,
    })
}

/// The position of the word for all things.
fn first_of_all(words: Words<'_>) -> usize {
    words.iter().position(|word| word.classes.contains(Class::All) || word.is_plural).unwrap_or(words.len())
}

/// Splits the words for the present place of things, named at a position, from the others: "everything in the blue room" to another. Both
/// places then share a word that is no name: "room". A place of one thing needs no such word after "from", and begins with another word
/// than its goal.
pub(super) fn from_place(words: Words<'_>, sign: usize, is_one: bool) -> (Words<'_>, Words<'_>) {
    let way = words.iter().enumerate().filter_map(|(at, word)| word.is_toward.then_some(at)).last().unwrap_or(0);
    let leads = |(at, word): (usize, &Heard)| at > sign && (word.is_toward || word.classes.contains(Class::From));
    let Some(begin) = words.iter().enumerate().position(leads).filter(|&begin| begin < way) else { return (words, Words::NONE) };
    let (from, goal) = (words.part(begin, way), words.part(way, words.len()));
    // "All of the chairs" names no place, although "the" occurs in both parts.
    let is_same = |word: &Heard| !word.is_name && goal.iter().skip(ARTICLE).any(|other| other.said.symbol == word.said.symbol);
    let has = |is: &dyn Fn(&Heard) -> bool| from.iter().any(|word| word.classes == Classes::NONE && is(word));
    // "The chair that is in the red room".
    let named = words.part(sign, begin).iter().enumerate().filter_map(|(at, word)| word.is_name.then_some(at)).last().unwrap_or(0);
    let end = sign.saturating_add(named).saturating_add(1);
    let is_relative = |word: &Heard| word.is_new || word.classes.contains(Class::Asking);
    let start = if is_one && words.part(end, begin).iter().any(is_relative) { end } else { begin };
    let symbol = |words: Words<'_>| words.get(0).and_then(|word| word.said.symbol);
    let is_from = is_one && (start < begin || from.get(0).is_some_and(|word| word.classes.contains(Class::From)));
    let of = |words: Words<'_>| words.get(0).map(|word| word.phrase);
    let is_other = !is_one || is_from || symbol(from) != symbol(goal) && of(from) == of(goal);
    if has(&|word| word.is_name) && is_other && (is_from || has(&is_same)) {
        (words.part(0, start).with(goal), from.part(1, from.len()))
    } else {
        (words, Words::NONE)
    }
}

/// Whether a plural after these words means all things: "take the". "Take one of the", "take two" and "take any" mean some.
fn has_one_article(words: Words<'_>) -> bool {
    let mut articles = 0_usize;
    let mut has_verb = false;
    for word in words.iter().filter(|word| !word.is_name) {
        let is_verb = word.is_of_task || word.is_new && !has_verb;
        articles = if is_verb { 0 } else { articles.saturating_add(if word.is_strange() { 2 } else { 1 }) };
        has_verb |= is_verb;
    }
    articles <= 1 && !words.has(Class::Or)
}

/// Whether a new word may negate a command: "never", "out of". A slip for a known word cannot, nor can the one new verb that a command may
/// have.
pub(super) fn may_turn(words: Words<'_>, has_new_verb: bool) -> bool {
    words.iter().filter(|word| word.is_new_word()).count() > usize::from(has_new_verb)
}

/// Whether a connective stands between words that may be two commands: to do only one of them would be wrong. "Be a darling and go" has one
/// command.
pub(super) fn has_more(words: Words<'_>) -> bool {
    let parts = |word: &Heard| word.classes.contains(Class::Connective) && word.count == 0.0;
    let before = words.iter().take_while(|word| !parts(word)).count();
    let is_command = words.iter().take(before).any(|word| word.is_of_task || word.is_name);
    let mut behind = words.iter().skip(before);
    if is_command { behind.any(Heard::may_act) } else { behind.skip(1).skip_while(|word| !parts(word)).any(Heard::may_act) }
}

/// A split of an utterance: the words of the first command, and the position of those after it.
#[derive(Clone, Copy)]
pub(super) struct Parting<'w> {
    pub first: Words<'w>,
    pub begin: usize,
    pub weight: Scaled,
}

/// The words of the place that a clause shares with the next one, if it has none of its own: "the bag and the chair to the red room".
fn shared_place<'w>(clause: Words<'w>, behind: Words<'w>) -> Option<Words<'w>> {
    let way = behind.iter().position(|word| word.is_toward)?;
    let names_thing = behind.iter().take(way).any(|word| word.is_name);
    (names_thing && clause.iter().any(|word| word.is_name) && !clause.iter().any(|word| word.is_toward))
        .then(|| behind.part(way, behind.len()))
}

/// The clauses of an utterance, between connectives or commas: "go to the red room, take the bag to the blue room".
fn clauses(words: Words<'_>) -> Vec<(usize, usize), WORDS_PER_COMMAND> {
    let mut clauses = Vec::new();
    let (mut begin, mut phrase) = (0, 0);
    let is_connective = |at: usize| words.get(at).is_some_and(|word| word.classes.contains(Class::Connective));
    let is_whole = |words: Words<'_>| words.iter().any(|word| word.is_name) && words.iter().any(|word| word.is_toward || word.is_of_task);
    for at in 0..=words.len() {
        let of = words.get(at).map_or(phrase, |word| word.phrase);
        let behind = || words.part(at, words.len()).only(|word| word.phrase == of);
        let is_comma = of > phrase && !is_connective(at) && is_whole(words.part(begin, at)) && is_whole(behind());
        phrase = of;
        if at == words.len() || is_connective(at) || is_comma {
            if begin < at {
                let _ = clauses.push((begin, at));
            }
            begin = if is_comma { at } else { at.saturating_add(1) };
        }
    }
    clauses
}

impl<M: AgentMemory> Agent<M> {
    /// The most probable split of the words into commands, with its probability.
    #[inline(never)]
    pub(super) fn part<'w, D: Domain + ?Sized>(
        &mut self,
        domain: &D,
        words: Words<'w>,
        wording: &Wording<'_>,
        place: Place<'_>,
    ) -> Result<Option<Parting<'w>>, AgentError> {
        let clauses = clauses(words);
        let mut parting = None;
        // The probability of the words from each clause on; 1 after the last.
        let mut ahead: Vec<Scaled, { WORDS_PER_COMMAND + 1 }> = Vec::new();
        let _ = ahead.resize(clauses.len().saturating_add(1), Scaled::ZERO);
        ahead.iter_mut().rev().take(1).for_each(|slot| *slot = Scaled::ONE);
        if clauses.len() < 2 {
            return Ok(None);
        }
        for (first, &(start, _)) in clauses.iter().enumerate().rev() {
            let mut best = Scaled::ZERO;
            parting = None;
            for (last, &(_, end)) in clauses.iter().enumerate().skip(first).take(CLAUSES_PER_COMMAND) {
                let after = last.saturating_add(1);
                let next = clauses.get(after).map(|&(begin, _)| begin);
                if first == 0 && next.is_none() {
                    continue;
                }
                let (mut clause, place) = (words.part(start, end), if first > 0 { place.after_first() } else { place });
                let mut here = self.clause(domain, clause, wording, place)?;
                let mut is_shared = false;
                if let Some(&(begin, end)) = clauses.get(after)
                    && let Some(shared) = shared_place(clause, words.part(begin, end))
                {
                    let with_place = clause.with(shared);
                    let prior = shared.iter().fold(SHARED, |prior, _| prior / SAID_ONCE);
                    let other = self.clause(domain, with_place, wording, place)?.scaled_by(prior);
                    if other.exceeds(here) {
                        (here, clause, is_shared) = (other, with_place, true);
                    }
                }
                let rest = ahead.get(after).copied().unwrap_or(Scaled::ZERO);
                let connective = next.map_or(Scaled::ONE, |next| match words.get(end).filter(|_| next > end && !is_shared) {
                    Some(word) => Scaled::new(SEVERAL * CUE).divided_by(Scaled::new(1.0 + word.count).square_root()),
                    // A comma is no word, and "and" mostly joins the names of two things.
                    None if !is_shared => Scaled::new(EITHER),
                    None => Scaled::new(SEVERAL),
                });
                let weight = here.times(rest).times(connective);
                if weight.exceeds(best) {
                    best = weight;
                    parting = next.map(|begin| Parting { first: clause, begin, weight });
                }
            }
            ahead.iter_mut().skip(first).take(1).for_each(|slot| *slot = best);
        }
        Ok(parting)
    }

    /// The probability of some words as one command, over all its readings. A later clause may leave out the act word.
    fn clause<D: Domain + ?Sized>(
        &mut self,
        domain: &D,
        clause: Words<'_>,
        wording: &Wording<'_>,
        place: Place<'_>,
    ) -> Result<Scaled, AgentError> {
        let mut explained = Explained::NEW;
        // The state that the previous command leads to is not known yet.
        self.explain_all(domain, clause, wording, place.of_any_kind(View { done: EITHER, ..View::PLAIN }), &mut explained)?;
        let mut sum = explained.here;
        for rest in [negated(clause), all(clause)].into_iter().flatten() {
            let view = place.of_any_kind(View { done: EITHER, ..rest.view });
            self.explain_all(domain, rest.words, wording, view, &mut explained)?;
            sum = sum.plus(explained.here.scaled_by(rest.prior));
        }
        Ok(sum)
    }

    /// Negates all tasks. Returns the most likely one, with its probability. The session is then about states to avoid.
    pub(super) fn negate(&mut self, explained: &mut Explained) -> (usize, f32) {
        let session = self.memory.lend().session;
        for (task, weight) in session.tasks.iter_mut().take(self.task_count).zip(&mut explained.weights) {
            match self.lifted.get(usize::from(task.lifted)).and_then(|lifted| task.negated(lifted)) {
                Some(negated) => *task = negated,
                None => *weight = Scaled::ZERO,
            }
        }
        explained.best()
    }

    /// The kind of a task about one thing and its place, and this place.
    pub(super) fn place_of_thing<D: Domain + ?Sized>(&self, domain: &D, task: usize) -> Option<(u8, ObjectId)> {
        let (world, task) = (domain.world(), self.task(task));
        let lifted = self.lifted.get(usize::from(task.lifted)).filter(|lifted| !lifted.has_way() && lifted.propositions().len() == 1)?;
        let part = task.propositions(lifted).next()?;
        let last = world.schema.parameters(part.proposition).len().checked_sub(1).filter(|&last| last > 0)?;
        let is_thing = is_thing(&world, part.arguments.first().copied()?);
        part.arguments.get(last).copied().filter(|_| is_thing).map(|place| (task.lifted, place))
    }

    /// The tasks that bring all fitting things to one place, and the probability of that place.
    pub(super) fn all_that_fit<D: Domain + ?Sized>(&self, domain: &D, explained: &Explained) -> (TaskSet, f32) {
        let place = |task: usize| self.place_of_thing(domain, task);
        let likelihood = |task: usize| explained.likelihoods.get(task).copied().unwrap_or(Scaled::ZERO);
        let (mut likeliest, mut best, mut most) = (None, None, Scaled::ZERO);
        for task in (0..self.task_count).filter(|&task| place(task).is_some() && explained.fitting.contains(task)) {
            if likelihood(task).exceeds(most) {
                (likeliest, best, most) = (Some(task), place(task), likelihood(task));
            }
        }
        if best.is_none() {
            return (TaskSet::EMPTY, 0.0);
        }
        let there = || (0..self.task_count).filter(|&task| place(task) == best);
        let weight = |task: usize| explained.weights.get(task).copied().unwrap_or(Scaled::ZERO);
        let fits = |&task: &usize| explained.fitting.contains(task);
        // The command is about things, unless other words say otherwise: "everything to the red room" has no act word.
        let of_things: TaskSet = (0..self.task_count).filter(|&task| place(task).is_some()).collect();
        let others = TaskSet::first(self.task_count).without(of_things);
        let [of_things, others] = [of_things, others].map(|tasks| total(tasks.iter().map(weight)));
        let is_elsewhere = explained.acts
            && !explained.has_new_verb
            && others.exceeds(of_things)
            && likeliest.is_none_or(|task| !explained.signed.contains(task));
        let probability = if is_elsewhere { 0.0 } else { total(there().map(weight)).over(of_things) };
        (there().filter(fits).collect(), probability)
    }
}
