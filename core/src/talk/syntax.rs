//! The syntax of an utterance, as far as its words tell: whether it has a verb, begins with a direction, asks, reports, or has a condition.

use super::classes::{Class, Classes};
use super::heard::{Heard, Words};

/// A sentence with more new words is no paraphrase of a known command.
const MOST_NEW: usize = 2;
/// The number of words after "if" that name a condition.
const NAMES_A_CASE: usize = 4;

/// The number of new words that may name things: those after a known word, "the purple bag".
pub(super) fn new_names(words: Words<'_>) -> usize {
    let (mut is_behind, mut phrase, mut is_way) = (false, 0, false);
    let mut behind = words.iter();
    let may_name = |word: &&Heard| {
        // "Ask you to step into".
        let _ = behind.next();
        let is_verb = is_way && behind.clone().next().is_some_and(|behind| behind.is_toward);
        is_way = word.is_toward;
        let may_name = is_behind && word.is_new && word.phrase == phrase && !is_verb;
        phrase = word.phrase;
        is_behind = word.count > 0.0 || may_name;
        may_name
    };
    words.iter().filter(may_name).count()
}

/// The word after a new word that may be an act word: only words of closed classes precede it, and the last of them is no "I".
pub(super) fn new_verb(words: Words<'_>) -> Option<Option<&Heard>> {
    let first = words.iter().position(|word| word.classes == Classes::NONE)?;
    let is_verb = words.get(first)?.is_new && words.iter().filter(|word| word.is_new).count() <= MOST_NEW;
    // "Grandma sleeps in the red room".
    let front = || words.iter().take_while(|word| !word.is_toward);
    let is_told = words.iter().any(|word| word.is_name && !word.is_toward)
        && front().count() == MOST_NEW
        && front().all(|word| word.is_new && !word.is_sign && word.classes == Classes::NONE);
    let is_verb = is_verb && !is_told;
    // "All bags": the new word names a thing.
    let before = first.checked_sub(1).and_then(|before| words.get(before));
    let is_other = before.is_some_and(|word| word.classes.contains_any(&[Class::All, Class::Speaker]));
    let asks = words.part(0, first).has(Class::Asking);
    let known = words.part(first, words.len()).only(|word| !word.is_new);
    // "Off with you into the red room".
    let way = known
        .only(|word| word.count > 0.0 || !word.classes.contains_any(&[Class::Polite, Class::You]))
        .get(0)
        .filter(|word| word.is_toward);
    (is_verb && !is_other && !asks).then(|| way.or_else(|| known.get(0)))
}

/// Whether no word says what to do, except for words of direction.
pub(super) fn is_verbless(words: Words<'_>) -> bool {
    !words.iter().any(|word| word.may_act() && !word.is_toward)
}

/// Whether a word of direction comes first, apart from words of closed classes.
pub(super) fn begins_with_way(words: Words<'_>) -> bool {
    // "Everything to the red room" is about things.
    let others = [Class::Asking, Class::Speaker, Class::All, Class::It, Class::Other, Class::Same];
    !words.iter().any(|word| word.classes.contains_any(&others))
        && words.iter().find(|word| word.is_toward || word.classes == Classes::NONE).is_some_and(|word| word.is_toward)
}

/// Whether a word of direction stands between names. "The chair next to the red room" is a thing.
pub(super) fn names_thing_and_way(words: Words<'_>) -> bool {
    let mut words = words.iter();
    let mut is_named = false;
    while let Some(word) = words.next().filter(|word| word.classes == Classes::NONE || word.classes.contains(Class::Polite)) {
        if word.is_toward {
            return is_named && words.any(|word| word.is_name);
        }
        is_named |= word.is_name;
    }
    false
}

/// Whether something is named before a word such as "here": "leave the bag here", but not "leave this red room".
pub(super) fn stays_by_name(words: Words<'_>) -> bool {
    words.at(Class::Here).is_some_and(|here| words.part(0, here).iter().any(|word| word.is_name))
}

/// Whether a new word stands between known ones.
pub(super) fn has_new_name(words: Words<'_>) -> bool {
    // Whether there was a known word, and a new one after it.
    let (mut has_known, mut has_new) = (false, false);
    words.iter().any(|word| {
        let is_known = word.count > 0.0;
        has_new |= has_known && word.is_new;
        has_known |= is_known;
        is_known && has_new
    })
}

/// Whether the first word outside all closed classes is new.
pub(super) fn begins_with_new_word(words: Words<'_>) -> bool {
    words.iter().find(|word| word.classes == Classes::NONE && !word.is_toward).is_some_and(|word| word.is_new)
}

/// Whether the words report an action: "I go to the red room", "my sister went", "the dog takes the bag". "I want you to go" and "I want
/// the bag there" are requests, and a new word that begins a command is an exclamation.
pub(super) fn tells(words: Words<'_>) -> bool {
    let (mut is_speaker, mut is_other, mut has_verb) = (false, false, false);
    let mut before: Option<&Heard> = None;
    // "Tomorrow Paul will take": several new words, perhaps after an article, before the verb. Two signs make a word.
    let is_plain = |word: &Heard| word.count > 0.0 && word.is_plain() && word.classes == Classes::NONE && !word.is_toward;
    let has_article = words.get(0).is_some_and(|word| word.is_article || is_plain(word));
    let (mut at, mut subject) = (usize::from(has_article), 0_usize);
    while let Some(word) = words.get(at).filter(|word| word.is_new_word() && word.classes == Classes::NONE) {
        (at, subject) = (at.saturating_add(1), subject.saturating_add(if word.is_sign { 1 } else { 2 }));
    }
    let verb = words.iter().skip(at).find(|word| !word.classes.contains(Class::Polite));
    // "The vacuum cleaner goes to the red room".
    let is_thing = has_article && subject > 0;
    if verb.is_some_and(|verb| {
        let acts = verb.is_of_task && !verb.is_toward && !verb.is_article && !verb.is_mended;
        // "Zounds, go" is an exclamation, "爸爸去" has a subject.
        if is_thing { verb.may_act() || verb.is_toward } else { acts && (subject / 2 > 1 || subject > 1 && verb.is_sign) }
    }) {
        return true;
    }
    let is_told = words.has(Class::You);
    // "The red chair looks good in the blue room".
    let acts = |word: &Heard| word.may_act() && !word.is_name && !word.is_toward && !word.is_article;
    let front = words.iter().take_while(|word| !acts(word)).count();
    let looks = |noun: &Heard, verb: &Heard| noun.count > 0.0 && noun.phrase == verb.phrase && verb.is_new_word() && !verb.is_sign;
    let last = front.checked_sub(1).and_then(|last| words.get(last)).zip(words.get(front));
    let is_named = words.iter().take(front).any(|word| word.is_name);
    if is_named && !is_told && !words.part(0, front).has(Class::Wish) && last.is_some_and(|(noun, verb)| looks(noun, verb)) {
        return true;
    }
    // "You went to the red room".
    if words.get(0).is_some_and(|word| word.classes.contains(Class::You)) && words.get(1).is_some_and(Heard::is_new_word) {
        return true;
    }
    // "I saw you go", "I never said that you should".
    let (mut tells, mut is_seen, mut is_subject) = (false, false, false);
    let mut speaks = false;
    for word in words.iter().take_while(|word| !word.is_name) {
        let is_of = |class| word.classes.contains(class);
        is_seen |= is_subject && word.is_new_word() && !word.is_sign;
        speaks |= is_of(Class::Speaker);
        is_subject = is_of(Class::Speaker) || is_subject && is_of(Class::Negation);
        // "I want to go" reports about the speaker.
        let is_wished = before.is_some_and(|before| before.classes.contains(Class::Wish)) && !word.is_toward;
        is_speaker &= !is_wished;
        tells |= !word.is_toward && (is_speaker && word.may_act() || is_other && !has_verb && word.is_of_task);
        let goes_on = is_of(Class::Polite) || is_of(Class::Asking);
        is_speaker = is_speaker && goes_on || is_of(Class::Speaker);
        // "The dog", "dad is". After a verb it is a thing.
        let is_new = |word: &Heard| word.is_new_word() && word.classes == Classes::NONE;
        is_other = is_other && goes_on
            || before.is_some_and(|before| {
                before.count > 0.0 && before.classes == Classes::NONE && is_new(word) || is_new(before) && is_of(Class::Asking)
            });
        has_verb |= word.is_of_task && !word.is_toward;
        before = Some(word);
    }
    // "I like the red room" has neither an act word nor a direction.
    let asks = words.iter().any(|word| word.may_act() || word.is_toward || word.classes.contains(Class::Wish));
    is_seen || !is_told && (tells || speaks && !asks)
}

/// Whether words in the past precede another command: "when you've put the bag in the red room, go to the green room".
pub(super) fn is_past(words: Words<'_>) -> bool {
    let names = |phrase: u8| words.iter().any(|word| word.is_name && word.phrase != phrase);
    words.iter().any(|word| word.is_perfect && names(word.phrase))
}

/// Whether the words hold only under an unknown condition, or later: "if it rains", "until I say so", "tomorrow". "If you like" is no
/// condition, and "I'd be glad if you went" is a request.
pub(super) fn has_condition(words: Words<'_>) -> bool {
    let is_if = |word: &Heard| word.count == 0.0 && word.classes.contains(Class::If) && !word.classes.contains(Class::Wish);
    let Some(first) = words.iter().position(is_if) else { return false };
    // Two signs make a word.
    let at = first.saturating_add(words.iter().skip(first.saturating_add(1)).take_while(|word| word.is_sign && is_if(word)).count());
    let case = words.part(at.saturating_add(1), at.saturating_add(NAMES_A_CASE));
    let is_polite = case.get(0).is_some_and(|word| word.classes.contains_any(&[Class::Polite, Class::You]));
    let is_glad = first > 0 && words.has(Class::You) && !words.part(0, first).iter().any(|word| word.is_of_task || word.is_name);
    // "If you took the bag there, I'd be glad."
    let phrase = words.get(at).map_or(0, |word| word.phrase);
    let behind = words.only(|word| word.phrase > phrase);
    let is_thanked = behind.has(Class::Polite) && behind.has(Class::Speaker) && !behind.iter().any(|word| word.is_of_task || word.is_name);
    let is_glad = is_glad || first == 0 && is_polite && is_thanked && !behind.has(Class::Negation);
    !is_polite || !is_glad && case.iter().any(|word| word.is_new_word() || word.classes.contains(Class::Speaker))
}

/// Whether the words are a question or a report: they have a question word that no lesson had, or a question mark and no polite word. "To
/// have" asks nothing, and "shall I" is a question.
pub(super) fn is_question(words: Words<'_>) -> bool {
    let asks = |word: &Heard| word.classes.contains(Class::Asking) && !word.classes.contains_any(&[Class::Polite, Class::Wish]);
    let is_polite = |word: &Heard| word.classes.contains(Class::Polite) && !word.classes.contains(Class::Speaker);
    let is_request = words.iter().take_while(|word| word.count == 0.0).any(|word| word.classes.contains(Class::Polite));
    // "The bag was there", and the particle at the end of a request: 吗.
    let mut known = words.iter().take(if is_request { words.len().saturating_sub(1) } else { words.len() });
    let (mut is_way, first) = (false, words.get(0).filter(|word| word.is_sign && words.has(Class::Here)).map(|word| word.piece));
    // "在房间里等着".
    let is_asking = |word: &Heard| word.count == 0.0 && Some(word.piece) != first && asks(word);
    known.any(|word| !core::mem::replace(&mut is_way, word.is_toward) && is_asking(word))
        || words.is_asked
            && (!words.iter().any(is_polite) || words.has(Class::Speaker) && !words.has(Class::You) && !words.has(Class::Wish))
}
