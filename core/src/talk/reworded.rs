//! Simpler wordings of an utterance: its words in another order, or without those that are taken back.

use super::classes::{Class, Classes};
use super::heard::{Heard, Words};
use super::syntax::{begins_with_way, is_past, is_verbless, names_thing_and_way, stays_by_name};

/// The most words before "it" in "and bring it to".
const MOST_BEFORE_IT: usize = 3;

/// The most words from "but" to "before" in "but before that". Two signs make a word.
const MOST_BEFORE_FIRST: usize = 5;

/// The most new words of a phrase that calls somebody.
const MOST_CALLED: usize = 2;

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

/// The words from the verb on, followed by those before it, if something is named in front: "take the bag to the red room". Words that
/// negate or soften a command stay with its verb.
pub(super) fn fronted(words: Words<'_>) -> Option<Words<'_>> {
    let has_way = begins_with_way(words);
    let (mut is_named, mut behind) = (false, 0);
    for (position, word) in words.iter().enumerate() {
        let is_verb = word.may_act() && !word.is_toward;
        // "The red room, eh, nice" has no verb.
        let is_alone = || words.iter().filter(|other| other.phrase == word.phrase).count() == 1;
        if is_verb && is_named && word.is_new && is_alone() {
            return None;
        }
        if is_verb && is_named {
            // "The bag, put it in the red room".
            let rest = words.only(|word| !word.classes.contains(Class::It));
            return Some(rest.turned(behind)).filter(|_| behind > 0);
        }
        if is_verb && !has_way || word.classes.contains_any(&[Class::Connective, Class::Out]) {
            return None;
        }
        is_named |= word.is_name;
        if word.classes == Classes::NONE || word.is_toward {
            behind = position.saturating_add(1);
        }
    }
    None
}

/// The words without those that a correction takes back. "Go to the red room, no, the green one" becomes "go to the room the green one",
/// and "go to the green room, not the red one" becomes "go to the green room". A whole command after "no" replaces all: "no, go to the
/// green room".
pub(super) fn corrected(words: Words<'_>) -> Option<Words<'_>> {
    // "Not the blue chair, the red one to the green room".
    let is_denied = |word: &Heard| word.phrase == 0;
    let denied = words.only(is_denied);
    let other = words.only(|word| !is_denied(word));
    let begins = words.get(0).is_some_and(|word| word.classes.contains(Class::Negation));
    let names = |words: Words<'_>| words.iter().any(|word| word.is_name);
    if begins && names(denied) && names(other) && is_verbless(denied) && !denied.iter().any(|word| word.is_toward) {
        return Some(other);
    }
    // The words for a direction before the names, and where these names begin and end.
    let (mut way, mut is_place, mut begin, mut end) = (None, false, 0, 0);
    let (mut phrase_before, mut is_at_comma) = (0, false);
    let corrects = |(position, word): (usize, &Heard)| {
        (is_at_comma, phrase_before) = (word.phrase > phrase_before, word.phrase);
        let is_no = end > 0 && word.classes.contains_any(&[Class::No, Class::Meant, Class::Blame]);
        if is_no || is_place && word.classes.contains(Class::Negation) {
            return Some((position, is_no));
        }
        way = if word.is_toward { Some(position) } else { way };
        if word.is_name {
            begin = if end < position { position } else { begin };
            end = position.saturating_add(1);
            is_place = way.is_some();
        }
        None
    };
    let (correction, is_no) = words.iter().enumerate().find_map(corrects)?;
    // "Sorry" and "I meant" belong to the correction.
    let of_command = |word: &Heard| word.count > 0.0 || !word.classes.contains_any(&[Class::Meant, Class::Speaker]);
    let behind = words.part(correction.saturating_add(1), words.len()).only(of_command);
    let is_verb = |word: &Heard| word.may_act() && !word.is_toward && !word.is_name;
    let has_verb = behind.iter().any(is_verb);
    // "With no chairs", "do not touch the bag".
    let phrase = words.get(correction).map_or(0, |word| word.phrase);
    if behind.iter().next().is_none_or(|word| word.is_name && !word.is_toward && word.phrase == phrase)
        || !behind.iter().any(|word| word.is_name)
        || !is_no && has_verb
    {
        return None;
    }
    // "To the red room, no, to the green one".
    let way = way.filter(|_| behind.iter().any(|word| word.is_toward));
    let before = words.part(0, if is_no { way.unwrap_or(begin) } else { correction });
    let noun = words.part(end, correction).only(|word| way.is_none() && word.classes == Classes::NONE && !word.is_new);
    Some(match (is_no, has_verb) {
        (false, _) => before,
        // "La bolsa no entre" corrects nothing.
        (true, true) => return Some(behind).filter(|_| is_at_comma && before.iter().any(is_verb)),
        (true, false) => before.with(noun).with(behind),
    })
}

/// The words without the phrases about no task: "hey buddy, go to the red room, the floor is wet there".
pub(super) fn told(words: Words<'_>) -> Option<Words<'_>> {
    let acts = |word: &Heard| word.is_of_task && !word.is_toward;
    let says = |word: &Heard| word.is_name || word.is_mended || acts(word) || word.classes.contains_any(&OF_SENTENCES);
    let first = words.iter().find(|word| word.is_name)?.phrase;
    let of = |phrase: u8| words.iter().filter(move |word| word.phrase == phrase);
    // "If you have time, ..." is no condition.
    let is_of_case =
        |word: &Heard| word.classes != Classes::NONE && (word.classes.contains(Class::If) || !word.classes.contains_any(&OF_SENTENCES));
    let is_polite = |phrase: u8| of(phrase).any(|word| word.classes.contains(Class::If)) && of(phrase).all(is_of_case);
    // "... , can you do that?", but not "..., did you take it?".
    let is_other =
        |word: &Heard| word.is_name || acts(word) || !word.classes.contains(Class::Pronoun) && word.classes.contains_any(&OF_SENTENCES);
    let is_tag = |phrase: u8| phrase > first && of(phrase).any(|word| word.classes.contains(Class::You)) && !of(phrase).any(is_other);
    // "I have to mop, ..." and "... while the baby sleeps" give a reason, and "my friend, ..." calls somebody.
    let (end, last) = words.iter().enumerate().filter_map(|(at, word)| word.is_name.then_some((at, word.phrase))).last()?;
    let denies = |word: &Heard| word.is_name || acts(word) || word.classes.contains_any(&OF_REQUESTS);
    let speaks = |word: &Heard| word.classes.contains(Class::Speaker);
    let is_spoken = |phrase: u8| phrase < first && of(phrase).next().is_some_and(speaks) && !of(phrase).any(denies);
    let reason = words.iter().enumerate().skip(end).find_map(|(at, word)| speaks(word).then_some(at)).unwrap_or(words.len());
    let reason = if words.iter().skip(reason).count() < 2 || words.iter().skip(reason).any(denies) { words.len() } else { reason };
    // "..., don't touch it".
    let is_it = |word: &Heard| word.is_article || word.classes.contains(Class::It);
    let has = |phrase: u8, is: &dyn Fn(&Heard) -> bool| of(phrase).any(is);
    let is_care = |phrase: u8| {
        phrase > last
            && has(phrase, &|word| word.classes.contains(Class::Negation))
            && has(phrase, &is_it)
            && has(phrase, &|word| word.is_new)
    };
    let mut at = 0_usize;
    let mut rest = words.only(|word| {
        at = at.saturating_add(1);
        let is_aside = (at > reason || is_spoken(word.phrase)) && !words.has(Class::If);
        if is_polite(word.phrase) || is_tag(word.phrase) || is_aside || is_care(word.phrase) {
            return false;
        }
        let is_front = word.phrase < first;
        let new = of(word.phrase).filter(|word| word.is_new).count();
        of(word.phrase).any(says) || is_front && (new > MOST_CALLED || of(word.phrase).any(|word| word.classes.contains(Class::Asking)))
    });
    // "Could you, please, go there?"
    let front = words.only(|word| word.phrase < first);
    let asks_politely = front.has(Class::You) && front.has(Class::Polite);
    rest.is_asked &= !(asks_politely || words.iter().last().is_some_and(|word| is_tag(word.phrase)));
    (rest.len() < words.len()).then_some(rest)
}

/// The words without the verb that leaves a thing in its place: "leave the bag in the red room" becomes "the bag in the red room".
pub(super) fn left(words: Words<'_>) -> Option<Words<'_>> {
    let is_other = |word: &Heard| word.classes.contains_any(&[Class::Negation, Class::From, Class::But]);
    let rest = words.only(|word| !word.leaves);
    (rest.len() < words.len() && !words.iter().any(is_other) && (stays_by_name(rest) || names_thing_and_way(rest))).then_some(rest)
}

/// The words without polite words in the middle of a command: "geh doch mal bitte ins rote Zimmer".
pub(super) fn curt(words: Words<'_>) -> Option<Words<'_>> {
    let verb = words.iter().position(|word| word.is_of_task).or_else(|| words.iter().position(|word| word.is_new))?;
    let named = |(position, word): (usize, &Heard)| word.is_name.then_some(position);
    let behind = words.iter().enumerate().filter_map(named).last()?;
    let (mut at, mut is_asked, end) = (0_usize, words.is_asked, words.len());
    let mut rest = words.only(|word| {
        at = at.saturating_add(1);
        let is_inside = verb < at && at < behind;
        let is_polite = word.classes.contains(Class::Polite) && !word.comes_first && !word.classes.contains_any(&OF_COMMANDS);
        // "把包放到房间去".
        let is_left = is_inside && (word.is_article || is_polite) && word.count == 0.0 || at == end && word.is_sign && word.is_of_task;
        // Polite words make a request, not a question.
        is_asked &= !(is_left && is_polite);
        !is_left
    });
    rest.is_asked = is_asked;
    (rest.len() < words.len()).then_some(rest)
}

/// The words without those that first take a thing: "pick up the bag and bring it to the red room" becomes "the bag bring to the red room".
pub(super) fn taken_up(words: Words<'_>) -> Option<Words<'_>> {
    let is_it = |word: &Heard| {
        word.classes.contains(Class::It)
            || word.classes.contains(Class::Pronoun) && !word.classes.contains_any(&[Class::There, Class::Other])
    };
    let (and, it) = (words.at(Class::Connective)?, words.iter().position(is_it)?);
    // "Fetch the bag from the green room and put it ..." names its present place.
    let from = words.at(Class::From).filter(|&from| from < and).unwrap_or(and);
    let (front, behind) = (words.part(0, from), words.part(it.saturating_add(1), words.len()));
    let is_near = and < it && it <= and.saturating_add(MOST_BEFORE_IT);
    let names = |words: Words<'_>| words.iter().any(|word| word.is_name);
    if !is_near || !names(front) || !names(behind) || front.iter().any(|word| word.is_toward) {
        return None;
    }
    let verb = words.part(and.saturating_add(1), it).only(|word| word.is_of_task);
    Some(front.only(|word| verb.is_empty() || !word.may_act()).with(verb).with(behind))
}

/// The words after "go and" and "do me a favour and", or before "and wait there".
pub(super) fn went(words: Words<'_>) -> Option<Words<'_>> {
    let and = words.at(Class::Connective)?;
    let last = words.iter().enumerate().filter_map(|(at, word)| word.classes.contains(Class::Connective).then_some(at)).last()?;
    let behind = words.part(last, words.len());
    let acts = |word: &Heard| word.is_name || word.is_of_task && !word.is_toward || word.classes.contains(Class::Negation);
    if behind.has(Class::Stop) && !behind.iter().any(acts) {
        return Some(words.part(0, last));
    }
    let (front, behind) = (words.part(0, and), words.part(and.saturating_add(1), words.len()));
    let is_polite = front.has(Class::Polite);
    let is_beside = |word: &Heard| {
        let says = word.is_name || word.is_toward || word.classes.contains_any(&OF_SENTENCES) || word.classes.contains(Class::Here);
        !says && (is_polite || !word.is_strange())
    };
    (and > 0 && front.iter().all(is_beside) && behind.iter().any(|word| word.is_name)).then_some(behind)
}

/// The words without those between a thing and its place that demand it: "the bag has to go to the red room", "the bag must not end up in
/// the red room".
pub(super) fn subject(words: Words<'_>) -> Option<Words<'_>> {
    let first = words.iter().position(|word| word.is_name)?;
    let last = words.iter().enumerate().filter_map(|(at, word)| word.is_name.then_some(at)).last()?;
    let way = words.part(0, last).iter().enumerate().filter_map(|(at, word)| word.is_toward.then_some(at)).last()?;
    let end = words.part(0, way).iter().enumerate().filter_map(|(at, word)| word.is_name.then_some(at)).last()?.saturating_add(1);
    let middle = words.part(end, way);
    let front = words.part(0, first);
    let is_front = !front
        .iter()
        .any(|word| word.may_act() && !word.is_article || word.classes.contains_any(&[Class::Speaker, Class::Asking, Class::If]));
    let others = [Class::Connective, Class::Out, Class::Speaker, Class::If, Class::Or, Class::No];
    let must = middle.iter().any(|word| word.is_of_task || word.classes.contains_any(&[Class::Wish, Class::Polite]));
    // "The chair used to be", "the chair was once".
    let asks = |word: &Heard| word.classes.contains(Class::Asking) && !word.classes.contains_any(&[Class::Wish, Class::Polite]);
    let reports = middle.get(0).is_some_and(|word| word.is_new_word() && !word.is_sign || asks(word));
    let is_other = |word: &Heard| word.classes.contains_any(&others) && !word.classes.contains(Class::Negation);
    let keep = |word: &Heard| word.classes.contains_any(&[Class::Negation, Class::All]);
    (is_front && must && !reports && !is_past(words) && !middle.iter().any(is_other))
        .then(|| words.part(0, end).with(middle.only(keep)).with(words.part(way, words.len())))
}

/// The words without "both" if two things are named: "both the bag and the chair", "the bag and the chair both".
pub(super) fn both(words: Words<'_>) -> Option<Words<'_>> {
    let and = words.at(Class::Connective)?;
    let all = words.at(Class::All)?;
    let name = |words: Words<'_>| words.iter().position(|word| word.is_name);
    let (before, behind) = (name(words.part(0, and))?, name(words.part(and, words.len()))?);
    let is_sign = words.get(all).is_some_and(|word| word.is_sign);
    let is_between = if all < and { !is_sign && all < before } else { all > and.saturating_add(behind) };
    (is_between && !words.iter().any(|word| word.is_plural)).then(|| words.only(|word| !word.classes.contains(Class::All)))
}

/// The command done first and the one done last, if the last comes first: "before you go to the red room, take the bag to the blue room".
pub(super) fn reversed<'w>(words: Words<'w>) -> Option<(Words<'w>, Words<'w>)> {
    let names = |words: Words<'_>| words.iter().any(|word| word.is_name);
    let of_both = |part: Words<'w>| part.only(|word| !(word.comes_first || word.classes.is_before() || word.classes.contains(Class::But)));
    let phrase = words.get(0)?.phrase;
    let (first, last) = (words.only(|word| word.phrase != phrase), words.only(|word| word.phrase == phrase));
    let is_before = |at: usize| last.get(at).is_some_and(|word| word.classes.is_before());
    if (is_before(0) || is_before(last.len().saturating_sub(1))) && names(first) && names(last) {
        return Some((of_both(first), of_both(last)));
    }
    // "Go to the red room, but first take the bag to the blue room", "but before that", "after you have taken".
    let but = words.at(Class::But);
    let is_near = |at: usize| but.is_some_and(|but| but < at && at < but.saturating_add(MOST_BEFORE_FIRST));
    let marks = |(at, word): (usize, &Heard)| (word.comes_first || word.classes.is_before() && is_near(at)).then_some((at, word.phrase));
    let (mark, phrase) = words.iter().enumerate().filter_map(marks).last()?;
    let begin = but.filter(|&but| but < mark).or_else(|| words.iter().position(|word| word.phrase == phrase))?;
    // "But before that".
    let start = if is_near(mark) && words.get(mark).is_some_and(|word| word.classes.is_before()) { mark } else { begin };
    let (first, last) = (words.part(start, words.len()), words.part(0, begin));
    (names(first) && names(last)).then(|| (of_both(first), of_both(last)))
}
