//! Simpler wordings of an utterance: its words in another order, or without those that say nothing about the task.

use super::heard::Heard;
use super::syntax::{begins_with_way, is_past, names_thing_and_way, stays_by_name};
use super::words::Words;
use crate::voice::classes::Class;

/// The most words before "it" in "and bring it to".
const MOST_BEFORE_IT: usize = 3;

/// The most new words of a phrase that calls somebody.
const MOST_CALLED: usize = 2;

/// The fewest words of a reason.
const LEAST_REASON: usize = 2;

/// A phrase with such a word is about the command.
pub(super) const OF_SENTENCES: [Class; 14] = [
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

/// A phrase with such a word is no aside.
const OF_REQUESTS: [Class; 8] =
    [Class::Negation, Class::If, Class::No, Class::Meant, Class::Connective, Class::Stop, Class::Wish, Class::You];

/// Such words belong to the command, however polite they are.
const OF_COMMANDS: [Class; 7] = [Class::Negation, Class::Out, Class::But, Class::All, Class::Connective, Class::Or, Class::Pronoun];

/// A simpler wording of some words; `None` if it does not apply to them.
pub(super) type Rewording = for<'w> fn(Words<'w>) -> Option<Words<'w>>;

/// The simpler wordings, in the order in which they are tried. Each is tried on the result of those before it.
pub(super) const REWORDINGS: [Rewording; 7] =
    [without_asides, without_taking_up, without_leaving, without_demand, without_polite_words, without_other_clauses, from_verb_on];

/// The words without the phrases about no task: "hey buddy, go to the red room, the floor is wet there".
fn without_asides(words: Words<'_>) -> Option<Words<'_>> {
    let first = words.iter().find(|word| word.is_name)?.phrase;
    let reason = reason(words).unwrap_or(words.len());
    let is_spoken = |phrase: u8| phrase < first && is_about_speaker(words.of_phrase(phrase));
    let mut at = 0_usize;
    let mut rest = words.only(|word| {
        let phrase = words.of_phrase(word.phrase);
        let is_aside = (at >= reason || is_spoken(word.phrase)) && !words.has(Class::If);
        at = at.saturating_add(1);
        !(is_aside || is_polite_condition(phrase) || is_care(words, word.phrase))
            && (is_about_task(phrase) || word.phrase < first && !is_call(phrase))
    });
    // "Could you, please, go there?"
    let front = words.only(|word| word.phrase < first);
    rest.is_asked &= !(front.has(Class::You) && front.has(Class::Polite));
    rest.if_fewer(words)
}

/// Whether a phrase says something about a task.
fn is_about_task(phrase: Words<'_>) -> bool {
    phrase.any(&|word| word.is_name || word.is_mended || word.acts() || word.is_any(&OF_SENTENCES))
}

/// Whether a phrase about no task may call somebody: "my friend, ...".
fn is_call(phrase: Words<'_>) -> bool {
    phrase.iter().filter(|word| word.is_new).count() <= MOST_CALLED && !phrase.has(Class::Asking)
}

/// Whether a phrase is a condition that is only polite: "if you have time, ...".
fn is_polite_condition(phrase: Words<'_>) -> bool {
    let is_polite = |word: &Heard| !word.is_open() && (word.is(Class::If) || !word.is_any(&OF_SENTENCES));
    phrase.has(Class::If) && phrase.iter().all(is_polite)
}

/// Whether a word belongs to a task, or to a request.
fn is_of_request(word: &Heard) -> bool {
    word.is_name || word.acts() || word.is_any(&OF_REQUESTS)
}

/// Whether a phrase is about the speaker alone: "I have to mop, ...".
fn is_about_speaker(phrase: Words<'_>) -> bool {
    phrase.begins_with(Class::Speaker) && !phrase.any(&is_of_request)
}

/// The position where a reason begins, after the last name: "... while the baby sleeps".
fn reason(words: Words<'_>) -> Option<usize> {
    let end = words.last_name()?;
    let reason = end.saturating_add(words.from(end).at(Class::Speaker)?);
    let behind = words.from(reason);
    (behind.len() >= LEAST_REASON && !behind.any(&is_of_request)).then_some(reason)
}

/// Whether a phrase after the last name asks for care: "..., don't touch it".
fn is_care(words: Words<'_>, phrase: u8) -> bool {
    let is_last = words.last_name().and_then(|last| words.get(last)).is_some_and(|last| phrase > last.phrase);
    let phrase = words.of_phrase(phrase);
    let is_it = |word: &Heard| word.is_article || word.is(Class::It);
    is_last && phrase.has(Class::Negation) && phrase.any(&is_it) && phrase.any(&|word| word.is_new)
}

/// The words without those that first take a thing: "pick up the bag and bring it to the red room" becomes "the bag bring to the red room".
fn without_taking_up(words: Words<'_>) -> Option<Words<'_>> {
    let is_it = |word: &Heard| word.is(Class::It) || word.is(Class::Pronoun) && !word.is_any(&[Class::There, Class::Other]);
    let (and, it) = (words.at(Class::Connective)?, words.position(&is_it)?);
    // "Fetch the bag from the green room and put it ..." names its present place.
    let from = words.at(Class::From).filter(|&from| from < and).unwrap_or(and);
    let (front, behind) = (words.before(from), words.after(it));
    let is_near = and < it && it <= and.saturating_add(MOST_BEFORE_IT);
    if !is_near || !front.has_name() || !behind.has_name() || front.has_way() {
        return None;
    }
    let verb = words.part(and.saturating_add(1), it).only(|word| word.is_of_task);
    Some(front.only(|word| verb.is_empty() || !word.may_act()).with(verb).with(behind))
}

/// The words without the verb that leaves a thing in its place: "leave the bag in the red room" becomes "the bag in the red room".
fn without_leaving(words: Words<'_>) -> Option<Words<'_>> {
    let rest = words.only(|word| !word.leaves).if_fewer(words)?;
    let is_other = |word: &Heard| word.is_any(&[Class::Negation, Class::From, Class::But]);
    (!words.any(&is_other) && (stays_by_name(rest) || names_thing_and_way(rest))).then_some(rest)
}

/// The words without those between a thing and its place that demand it: "the bag has to go to the red room", "the bag must not end up in
/// the red room".
fn without_demand(words: Words<'_>) -> Option<Words<'_>> {
    let front = words.before(words.position(&|word| word.is_name)?);
    let way = words.before(words.last_name()?).last(&|word| word.is_toward)?;
    let thing = words.before(way).last_name()?.saturating_add(1);
    let middle = words.part(thing, way);
    let begins = |word: &Heard| word.may_act() && !word.is_article || word.is_any(&[Class::Speaker, Class::Asking, Class::If]);
    let demands = |word: &Heard| word.is_of_task || word.is_any(&[Class::Wish, Class::Polite]);
    // "The chair used to be", "the chair was once".
    let asks = |word: &Heard| word.is(Class::Asking) && !word.is_any(&[Class::Wish, Class::Polite]);
    let reports = |word: &Heard| word.is_new_word() && !word.is_sign || asks(word);
    let others = [Class::Connective, Class::Out, Class::Speaker, Class::If, Class::Or, Class::No];
    let is_other = |word: &Heard| word.is_any(&others) && !word.is(Class::Negation);
    let is_demand = middle.any(&demands) && !middle.get(0).is_some_and(reports) && !middle.any(&is_other);
    let keep = |word: &Heard| word.is_any(&[Class::Negation, Class::All]);
    (!front.any(&begins) && is_demand && !is_past(words)).then(|| words.before(thing).with(middle.only(keep)).with(words.from(way)))
}

/// The words without polite words in the middle of a command: "geh doch mal bitte ins rote Zimmer".
fn without_polite_words(words: Words<'_>) -> Option<Words<'_>> {
    let verb = words.position(&|word| word.is_of_task).or_else(|| words.position(&|word| word.is_new))?;
    let last = words.last_name()?;
    let end = words.len().checked_sub(1)?;
    let (mut at, mut is_asked) = (0_usize, words.is_asked);
    let mut rest = words.only(|word| {
        let is_inside = verb <= at && at.saturating_add(1) < last;
        let is_polite = word.is(Class::Polite) && !word.comes_first && !word.is_any(&OF_COMMANDS);
        // "把包放到房间去".
        let is_last_verb = at == end && word.is_sign && word.is_of_task;
        let is_left = is_inside && (word.is_article || is_polite) && !word.is_of_lessons() || is_last_verb;
        // Polite words make a request, not a question.
        is_asked &= !(is_left && is_polite);
        at = at.saturating_add(1);
        !is_left
    });
    rest.is_asked = is_asked;
    rest.if_fewer(words)
}

/// The words after "go and" and "do me a favour and", or before "and wait there".
fn without_other_clauses(words: Words<'_>) -> Option<Words<'_>> {
    let is_and = |word: &Heard| word.is(Class::Connective);
    let (first, last) = (words.position(&is_and)?, words.last(&is_and)?);
    let behind = words.from(last);
    if behind.has(Class::Stop) && !behind.any(&|word| word.is_name || word.acts() || word.is(Class::Negation)) {
        return Some(words.before(last));
    }
    let (front, behind) = (words.before(first), words.after(first));
    let is_polite = front.has(Class::Polite);
    let says = |word: &Heard| word.is_name || word.is_toward || word.is_any(&OF_SENTENCES) || word.is(Class::Here);
    let is_idle = |word: &Heard| !says(word) && (is_polite || !word.is_strange());
    (!front.is_empty() && front.iter().all(is_idle) && behind.has_name()).then_some(behind)
}

/// The words from the verb on, followed by those before it, if something is named in front: "take the bag to the red room". Words that
/// negate or soften a command stay with its verb.
fn from_verb_on(words: Words<'_>) -> Option<Words<'_>> {
    let has_way = begins_with_way(words);
    let (mut is_named, mut begin) = (false, 0);
    for (at, word) in words.iter().enumerate() {
        let is_verb = word.may_be_verb();
        if is_verb && is_named {
            // "The bag, put it in the red room".
            let rest = words.only(|word| !word.is(Class::It));
            return Some(rest.turned(begin)).filter(|_| begin > 0);
        }
        if is_verb && !has_way || word.is_any(&[Class::Connective, Class::Out]) {
            return None;
        }
        is_named |= word.is_name;
        if word.is_open() || word.is_toward {
            begin = at.saturating_add(1);
        }
    }
    None
}

#[cfg(test)]
mod tests {
    use super::super::taught::{for_each, left};
    use super::*;
    use std::string::String;

    /// Sentences with the rule for them and the words that it leaves; none if it does not apply.
    const SIMPLER: [(&str, &str, (Rewording, &str)); 18] = [
        ("en", "I have to mop, go to the red room", (without_asides, "go to the red room")),
        ("en", "if you have time, go to the red room", (without_asides, "go to the red room")),
        ("en", "take the purple bag to the red room, don't touch it", (without_asides, "take the purple bag to the red room")),
        ("de", "he Kumpel, geh ins rote Zimmer", (without_asides, "geh ins rote zimmer")),
        ("es", "hola amigo, ve a la sala roja", (without_asides, "ve a la sala roja")),
        ("fr", "prends le sac violet et apporte-le dans la salle rouge", (without_taking_up, "le sac violet apporte dans la salle rouge")),
        ("es", "coge el bolso morado y llévalo a la sala roja", (without_taking_up, "bolso morado llévalo a la sala roja")),
        ("en", "leave the purple bag in the red room", (without_leaving, "the purple bag in the red room")),
        ("en", "the purple bag must not end up in the red room", (without_demand, "the purple bag not in the red room")),
        ("de", "die lila Tasche muss ins rote Zimmer", (without_demand, "die lila tasche ins rote zimmer")),
        ("es", "el bolso morado tiene que ir a la sala roja", (without_demand, "el bolso morado a la sala roja")),
        ("de", "geh doch mal bitte ins rote Zimmer", (without_polite_words, "geh ins rote zimmer")),
        ("fr", "va donc s'il te plaît dans la salle rouge", (without_polite_words, "va dans la salle rouge")),
        ("zh", "把紫色的包拿到红色房间去", (without_polite_words, "把 紫 色 的 包 拿 到 红 色 房 间")),
        ("en", "go to the red room and wait there", (without_other_clauses, "go to the red room")),
        ("en", "the purple bag, put it in the red room", (from_verb_on, "put in the red room the purple bag")),
        ("de", "ins rote Zimmer bring die lila Tasche", (from_verb_on, "bring die lila tasche ins rote zimmer")),
        ("zh", "紫色的包，把它拿到红色房间", (from_verb_on, "把 拿 到 红 色 房 间 紫 色 的 包")),
    ];

    #[test]
    fn a_simpler_wording_keeps_the_words_of_the_task() {
        for_each(&SIMPLER, &|sentence, words, (rule, rest)| {
            let words = rule(words).map_or(String::new(), |words| left(sentence, words));
            assert_eq!(words, *rest, "{sentence}");
        });
    }
}
