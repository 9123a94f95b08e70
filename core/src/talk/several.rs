//! Several commands in one utterance: "go to the red room and take the bag to the blue room".

use super::context::{Context, View};
use super::explained::Explained;
use super::heard::Heard;
use super::readings::{CUE, EITHER, all, negated};
use super::repair::is_after_mark;
use super::words::Words;
use crate::capacity::WORDS_PER_COMMAND;
use crate::memory::AgentMemory;
use crate::oomdp::Domain;
use crate::probability::Scaled;
use crate::session::{Agent, AgentError};
use crate::voice::classes::Class;
use heapless::Vec;

/// The prior of several commands.
pub(super) const SEVERAL: f32 = 0.05;
/// The prior of the other order.
const TURNED: f32 = 0.1;
/// The most clauses of one command; "take the bag from the red room to the blue room" has three.
const CLAUSES_PER_COMMAND: usize = 3;
/// The prior of two commands that share the place in the second: "the bag and the chair to the red room".
const SHARED: f32 = 0.3;
/// The probability of each word of a shared place. The place is said once but counts in both commands, so it is divided out once.
const SAID_ONCE: f32 = 0.2;

/// A split of an utterance: the words of the first command, and the position of those after it.
#[derive(Clone, Copy)]
pub(super) struct Parting<'w> {
    pub first: Words<'w>,
    pub begin: usize,
    pub weight: Scaled,
    /// Whether the second command is to be done first.
    pub is_turned: bool,
}

impl<'w> Parting<'w> {
    /// The same split of two commands with the other order: "before you go to the red room, take the bag to the blue room". Of the `rest`,
    /// which is the whole utterance again, the second command is done.
    pub fn turned(self, words: Words<'w>, is_rest: bool) -> Option<Self> {
        let (front, behind) = (words.before(self.begin), words.from(self.begin));
        let first = if is_rest { front } else { behind };
        // "The bag and the chair to the red room" tells no order.
        let is_shared = self.first.len() > front.len();
        (front.has_name() && behind.has_name() && !is_shared).then(|| Self {
            first,
            weight: self.weight.scaled_by(TURNED),
            is_turned: true,
            ..self
        })
    }

    /// The words that tell the order: those between the two commands, and if it is turned, those before and after the names, too.
    pub fn between(self, words: Words<'w>) -> Words<'w> {
        let between = between_commands(words, self.begin);
        let (first, last) = (words.position(&|word| word.is_name).unwrap_or(0), words.last_name().unwrap_or(usize::MAX));
        if self.is_turned { words.before(first).with(between).with(words.after(last)) } else { between }
    }
}

/// The words between two commands: from the last name before a position to the next name.
fn between_commands(words: Words<'_>, begin: usize) -> Words<'_> {
    let last = words.before(begin).last_name().map_or(0, |last| last.saturating_add(1));
    let next = words.from(begin).position(&|word| word.is_name).map_or(usize::MAX, |next| begin.saturating_add(next));
    words.part(last, next)
}

/// The words of the place that a clause shares with the next one, if it has none of its own: "the bag and the chair to the red room".
fn shared_place<'w>(clause: Words<'w>, next: Words<'w>) -> Option<Words<'w>> {
    let way = next.position(&|word| word.is_toward)?;
    (next.before(way).has_name() && clause.has_name() && !clause.has_way()).then(|| next.from(way))
}

/// The clauses of an utterance, between connectives or commas: "go to the red room, take the bag to the blue room"; or after a name, if the
/// words before and after it can be commands: "go to the red room after that take the bag to the blue room".
fn clauses(words: Words<'_>) -> Vec<(usize, usize), WORDS_PER_COMMAND> {
    let mut clauses = Vec::new();
    let (mut begin, mut phrase, mut is_named) = (0, 0, false);
    let is_connective = |at: usize| words.get(at).is_some_and(|word| word.is(Class::Connective));
    let is_whole =
        |words: Words<'_>, is_comma: bool| words.has_name() && (is_comma || words.any(&|word| word.is_toward || word.is_of_task));
    for at in 0..=words.len() {
        let word = words.get(at);
        let of = word.map_or(phrase, |word| word.phrase);
        let behind = |is_comma: bool| if is_comma { words.from(at).of_phrase(of) } else { words.from(at) };
        let is_comma = of > phrase;
        // "Room" in "the red room" belongs to the name.
        let is_of_name = word.is_some_and(|word| word.is_name && !word.is_toward || is_named && word.is_noun());
        let ends_name = is_named && !is_of_name;
        is_named = is_of_name;
        let is_mark = is_comma || begins_name(words, at);
        let is_end = is_mark || ends_name;
        let may_end = is_end && !is_connective(at) && is_whole(words.part(begin, at), is_mark) && is_whole(behind(is_comma), is_mark);
        phrase = of;
        if at == words.len() || is_connective(at) || may_end {
            if begin < at {
                let _ = clauses.push((begin, at));
            }
            begin = if may_end { at } else { at.saturating_add(1) };
        }
    }
    clauses
}

/// Whether the noun of a name ends before a position, and another name follows: "red room green room".
fn begins_name(words: Words<'_>, at: usize) -> bool {
    let name = words.before(at).last(&|word| word.is_name || word.is_toward);
    let noun = name.filter(|&name| words.get(name).is_some_and(|word| !word.is_toward)).map_or(at, |name| name.saturating_add(1));
    let is_noun = noun < at && words.part(noun, at).iter().all(Heard::is_noun);
    is_noun && words.get(at).is_some_and(|word| word.is_name)
}

impl<M: AgentMemory> Agent<M> {
    /// The most probable split of the words into commands, with its probability.
    #[inline(never)]
    pub(super) fn part<'w, D: Domain>(
        &mut self,
        domain: &D,
        words: Words<'w>,
        context: Context<'_>,
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
                let next = clauses.get(after);
                // All clauses are no split.
                if first == 0 && next.is_none() {
                    continue;
                }
                let (mut clause, context) = (words.part(start, end), if first > 0 { context.after_first() } else { context });
                let mut here = self.clause(domain, clause, context)?;
                let mut is_shared = false;
                // The place may be a clause of its own: "the bag and the red bench | to the blue room".
                let with_place = |&(begin, end): &(usize, usize)| {
                    let behind = clauses.get(after.saturating_add(1)).filter(|clause| clause.0 == end && !words.part(begin, end).has_way());
                    words.part(begin, behind.map_or(end, |clause| clause.1))
                };
                if let Some(shared) = next.and_then(|next| shared_place(clause, with_place(next))) {
                    let with_shared = clause.with(shared);
                    let prior = shared.iter().fold(SHARED, |prior, _| prior / SAID_ONCE);
                    let other = self.clause(domain, with_shared, context)?.scaled_by(prior);
                    if other.exceeds(here) {
                        (here, clause, is_shared) = (other, with_shared, true);
                    }
                }
                let connective = match next {
                    None => Scaled::ONE,
                    // "And" mostly joins the names of two things.
                    Some(_) if is_shared => Scaled::new(SEVERAL),
                    Some(&(next, _)) => match words.get(end).filter(|_| next > end) {
                        Some(word) => Scaled::new(SEVERAL * CUE).divided_by(Scaled::new(1.0 + word.count).square_root()),
                        // A comma is no word.
                        None if is_after_mark(words, end, end) || begins_name(words, end) => Scaled::new(EITHER),
                        None => Scaled::new(SEVERAL * CUE),
                    },
                };
                let rest = ahead.get(after).copied().unwrap_or(Scaled::ZERO);
                let weight = here.times(rest).times(connective);
                if weight.exceeds(best) {
                    best = weight;
                    parting = next.map(|&(begin, _)| Parting { first: clause, begin, weight, is_turned: false });
                }
            }
            ahead.iter_mut().skip(first).take(1).for_each(|slot| *slot = best);
        }
        Ok(parting)
    }

    /// The probability of some words as one command, over all its readings. A later clause may leave out the act word.
    fn clause<D: Domain>(&mut self, domain: &D, clause: Words<'_>, context: Context<'_>) -> Result<Scaled, AgentError> {
        let (mut explained, context) = (Explained::NEW, context.of_kind(None));
        // The state that the previous command leads to is not known yet.
        self.explain_all(domain, clause, View { done: EITHER, ..View::PLAIN }, context, &mut explained)?;
        let mut sum = explained.here;
        for rest in [negated(clause), all(clause)].into_iter().flatten() {
            self.explain_all(domain, rest.words, View { done: EITHER, ..rest.view }, context, &mut explained)?;
            sum = sum.plus(explained.here.scaled_by(rest.prior));
        }
        Ok(sum)
    }
}

#[cfg(test)]
mod tests {
    use super::super::taught::{for_each, left};
    use super::*;

    fn split(words: Words<'_>) -> Parting<'_> {
        let begin = clauses(words).get(1).map_or(0, |&(begin, _)| begin);
        Parting { first: words.before(begin), begin, weight: Scaled::ONE, is_turned: false }
    }

    #[test]
    fn a_name_after_the_noun_of_another_begins_a_command() {
        let rows = [
            ("en", "red room green room", "red room"),
            ("de", "rotes Zimmer grünes Zimmer", "rotes zimmer"),
            ("zh", "红色房间绿色房间", "红 色 房 间"),
            ("en", "purple bag red room", ""),
        ];
        for_each(&rows, &|sentence, words, first| {
            let clauses = clauses(words);
            let read = if clauses.len() > 1 { left(sentence, split(words).first) } else { std::string::String::new() };
            assert_eq!(read, *first, "{sentence}");
        });
    }

    #[test]
    fn the_second_of_two_commands_may_be_first_and_words_around_the_names_tell_it() {
        let rows = [
            (
                "en",
                "go to the red room and then take the purple bag to the blue room",
                ["room and then take the", "take the purple bag to the blue room"],
            ),
            (
                "en",
                "before you go to the red room take the purple bag to the blue room",
                ["room take the", "take the purple bag to the blue room"],
            ),
            (
                "de",
                "geh ins rote Zimmer, aber bring vorher die lila Tasche ins blaue Zimmer",
                ["zimmer aber bring vorher", "aber bring vorher die lila tasche ins blaue zimmer"],
            ),
        ];
        for_each(&rows, &|sentence, words, [between, second]| {
            let parting = split(words);
            assert_eq!(left(sentence, parting.between(words)), *between, "{sentence}");
            let turned = parting.turned(words, false).expect(sentence);
            assert_eq!(left(sentence, turned.first), *second, "{sentence}");
            let rest = parting.turned(words, true).expect(sentence);
            assert_eq!(left(sentence, rest.first), left(sentence, words.before(parting.begin)), "{sentence}");
        });
    }
}
