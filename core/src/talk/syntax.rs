//! The syntax of an utterance, as far as its words tell: whether it has a verb, begins with a direction, asks, reports, or has a condition.

use super::heard::Heard;
use super::words::Words;
use crate::voice::classes::Class;

/// A sentence with more new words is no paraphrase of a known command.
const MOST_NEW: usize = 2;
/// The number of words of a subject and its verb.
const SUBJECT_AND_VERB: usize = 2;
/// The number of words after "if" that name a condition.
const NAMES_A_CASE: usize = 4;

/// The number of new words that may name things: those after a known word, "the purple bag".
pub(super) fn new_names(words: Words<'_>) -> usize {
    let (mut names, mut before, mut is_after_known) = (0_usize, None::<&Heard>, false);
    let mut ahead = words.iter();
    while let Some(word) = ahead.next() {
        // "Ask you to step into".
        let is_verb = before.is_some_and(|before| before.is_toward) && ahead.clone().next().is_some_and(|behind| behind.is_toward);
        let is_name = is_after_known && word.is_new && !is_verb && before.is_some_and(|before| before.phrase == word.phrase);
        names = names.saturating_add(usize::from(is_name));
        is_after_known = word.is_of_lessons() || is_name;
        before = Some(word);
    }
    names
}

/// The word after a new word that may be an act word: only words of closed classes precede it, and the last of them is no "I".
pub(super) fn new_verb(words: Words<'_>) -> Option<Option<&Heard>> {
    let first = words.position(&Heard::is_open)?;
    if !words.get(first)?.is_new || words.iter().filter(|word| word.is_new).count() > MOST_NEW || is_of_new_subject(words) {
        return None;
    }
    let front = words.before(first);
    // "All bags": the new word names a thing.
    let is_other = |word: &Heard| word.is_any(&[Class::All, Class::Speaker]);
    if front.has(Class::Asking) || front.iter().last().is_some_and(is_other) {
        return None;
    }
    let known = words.from(first).only(|word| !word.is_new);
    // "Off with you into the red room".
    let says = known.only(|word| word.is_of_lessons() || !word.is_any(&[Class::Polite, Class::You]));
    Some(says.get(0).filter(|word| word.is_toward).or_else(|| known.get(0)))
}

/// Whether a new subject and a new verb come before the direction: "Grandma sleeps in the red room".
fn is_of_new_subject(words: Words<'_>) -> bool {
    let front = words.until(&|word| word.is_toward);
    let is_new = |word: &Heard| word.is_new && !word.is_sign && word.is_open();
    words.any(&|word| word.is_name && !word.is_toward) && front.len() == SUBJECT_AND_VERB && front.iter().all(is_new)
}

/// Whether no word says what to do, except for words of direction.
pub(super) fn is_verbless(words: Words<'_>) -> bool {
    !words.any(&Heard::may_be_verb)
}

/// Whether a word of direction comes first, apart from words of closed classes.
pub(super) fn begins_with_way(words: Words<'_>) -> bool {
    // "Everything to the red room" is about things.
    let others = [Class::Asking, Class::Speaker, Class::All, Class::It, Class::Other, Class::Same];
    !words.any(&|word| word.is_any(&others))
        && words.iter().find(|word| word.is_toward || word.is_open()).is_some_and(|word| word.is_toward)
}

/// Whether a word of direction stands between names. "The chair next to the red room" is a thing.
pub(super) fn names_thing_and_way(words: Words<'_>) -> bool {
    let Some(way) = words.position(&|word| word.is_toward) else { return false };
    let front = words.part(0, way.saturating_add(1));
    words.before(way).has_name() && words.after(way).has_name() && front.iter().all(|word| word.is_open() || word.is(Class::Polite))
}

/// Whether something is named before a word such as "here": "leave the bag here", but not "leave this red room".
pub(super) fn stays_by_name(words: Words<'_>) -> bool {
    words.at(Class::Here).is_some_and(|here| words.before(here).has_name())
}

/// Whether a new word stands between known ones.
pub(super) fn has_new_name(words: Words<'_>) -> bool {
    let Some(known) = words.position(&Heard::is_of_lessons) else { return false };
    let behind = words.after(known);
    behind.position(&|word| word.is_new).is_some_and(|new| behind.from(new).any(&Heard::is_of_lessons))
}

/// Whether the first word outside all closed classes is new.
pub(super) fn begins_with_new_word(words: Words<'_>) -> bool {
    words.iter().find(|word| word.is_open() && !word.is_toward).is_some_and(|word| word.is_new)
}

/// Whether the words report an action: "I go to the red room", "my sister went", "the dog takes the bag". "I want you to go" and "I want
/// the bag there" are requests, and a new word that begins a command is an exclamation.
pub(super) fn tells(words: Words<'_>) -> bool {
    // "You went to the red room".
    let you_did = words.begins_with(Class::You) && words.get(1).is_some_and(Heard::is_new_word);
    let front = words.until(&|word| word.is_name);
    // "I like the red room" has neither an act word nor a direction.
    let asks = |word: &Heard| word.may_act() || word.is_toward || word.is(Class::Wish);
    let is_opinion = || front.has(Class::Speaker) && !words.any(&asks);
    begins_with_subject(words)
        || you_did
        || speaker_did(front)
        || !words.has(Class::You) && (thing_does(words) || speaker_does(front) || somebody_does(front) || is_opinion())
}

/// Whether new words, perhaps after an article, are the subject of the verb after them: "Tomorrow Paul will take", "the vacuum cleaner
/// goes". "Zounds, go" is an exclamation, "爸爸去" has a subject.
fn begins_with_subject(words: Words<'_>) -> bool {
    let is_known = |word: &Heard| word.is_of_lessons() && word.is_plain() && word.is_open() && !word.is_toward;
    let has_article = words.get(0).is_some_and(|word| word.is_article || is_known(word));
    let words = words.from(usize::from(has_article));
    let subject = words.until(&|word| !(word.is_new_word() && word.is_open()));
    let Some(verb) = words.from(subject.len()).iter().find(|word| !word.is(Class::Polite)) else { return false };
    if has_article && !subject.is_empty() {
        return verb.may_act() || verb.is_toward;
    }
    // Two signs make a word.
    let signs: usize = subject.iter().map(|word| if word.is_sign { 1 } else { 2 }).sum();
    verb.acts() && !verb.is_article && !verb.is_mended && (signs / 2 > 1 || signs > 1 && verb.is_sign)
}

/// Whether a new verb comes right after a name: "the red chair looks good in the blue room".
fn thing_does(words: Words<'_>) -> bool {
    let acts = |word: &Heard| word.may_be_verb() && !word.is_name && !word.is_article;
    let Some(at) = words.position(&acts) else { return false };
    let front = words.before(at);
    let does = |noun: &Heard, verb: &Heard| noun.is_of_lessons() && noun.phrase == verb.phrase && verb.is_new_word() && !verb.is_sign;
    front.has_name() && !front.has(Class::Wish) && front.iter().last().zip(words.get(at)).is_some_and(|(noun, verb)| does(noun, verb))
}

/// Whether a new verb comes right after the speaker: "I saw you go", "I never said that you should".
fn speaker_did(front: Words<'_>) -> bool {
    let mut is_after_speaker = false;
    for word in front.iter() {
        if is_after_speaker && word.is_new_word() && !word.is_sign {
            return true;
        }
        is_after_speaker = word.is(Class::Speaker) || is_after_speaker && word.is(Class::Negation);
    }
    false
}

/// Whether words such as "could" and "is" may come between a subject and its verb.
fn goes_on(word: &Heard) -> bool {
    word.is_any(&[Class::Polite, Class::Asking])
}

/// Whether a verb comes after the speaker: "I will take". "I want to go" reports about the speaker, "I want the bag there" does not.
fn speaker_does(front: Words<'_>) -> bool {
    let (mut is_speaker, mut is_wished) = (false, false);
    for word in front.iter() {
        is_speaker &= !is_wished || word.is_toward;
        if is_speaker && word.may_be_verb() {
            return true;
        }
        is_speaker = is_speaker && goes_on(word) || word.is(Class::Speaker);
        is_wished = word.is(Class::Wish);
    }
    false
}

/// Whether a known verb comes after a new subject: "the dog takes", "dad is taking". After a verb, a new word is a thing.
fn somebody_does(front: Words<'_>) -> bool {
    let is_new = |word: &Heard| word.is_new_word() && word.is_open();
    let (mut is_subject, mut before) = (false, None::<&Heard>);
    for word in front.iter() {
        if word.acts() {
            return is_subject;
        }
        let begins =
            |before: &Heard| before.is_of_lessons() && before.is_open() && is_new(word) || is_new(before) && word.is(Class::Asking);
        is_subject = is_subject && goes_on(word) || before.is_some_and(begins);
        before = Some(word);
    }
    false
}

/// Whether words in the past precede another command: "when you've put the bag in the red room, go to the green room".
pub(super) fn is_past(words: Words<'_>) -> bool {
    let names = |phrase: u8| words.any(&|word| word.is_name && word.phrase != phrase);
    words.any(&|word| word.is_perfect && names(word.phrase))
}

/// Whether the words hold only under an unknown condition, or later: "if it rains", "until I say so", "tomorrow". "If you like" is no
/// condition, and "I'd be glad if you went" is a request.
pub(super) fn has_condition(words: Words<'_>) -> bool {
    let is_if = |word: &Heard| !word.is_of_lessons() && word.is(Class::If) && !word.is(Class::Wish);
    let Some(first) = words.position(&is_if) else { return false };
    // Two signs make a word.
    let signs = words.after(first).iter().take_while(|word| word.is_sign && is_if(word)).count();
    let at = first.saturating_add(signs);
    let case = words.part(at.saturating_add(1), at.saturating_add(NAMES_A_CASE));
    let is_polite = case.get(0).is_some_and(|word| word.is_any(&[Class::Polite, Class::You]));
    let says = |words: Words<'_>| words.any(&|word| word.is_of_task || word.is_name);
    let is_glad = first > 0 && words.has(Class::You) && !says(words.before(first));
    !is_polite || !is_glad && case.any(&|word| word.is_new_word() || word.is(Class::Speaker))
}

/// Whether the words are a question or a report: they have a question word that no lesson had, or a question mark and no polite word.
/// "Shall I" is a question.
pub(super) fn is_question(words: Words<'_>) -> bool {
    let is_polite = |word: &Heard| word.is(Class::Polite) && !word.is(Class::Speaker);
    let is_of_speaker = || words.has(Class::Speaker) && !words.has(Class::You) && !words.has(Class::Wish);
    has_question_word(words) || words.is_asked && (!words.any(&is_polite) || is_of_speaker())
}

/// Whether there is a question word that no lesson had. "To have" asks nothing.
fn has_question_word(words: Words<'_>) -> bool {
    // "The bag was there", and the particle at the end of a request: 吗.
    let is_request = words.iter().take_while(|word| !word.is_of_lessons()).any(|word| word.is(Class::Polite));
    let end = if is_request { words.len().saturating_sub(1) } else { words.len() };
    // "在房间里等着".
    let stays = words.get(0).filter(|word| word.is_sign && words.has(Class::Here)).map(|word| word.piece);
    let asks = |word: &Heard| {
        word.is(Class::Asking) && !word.is_any(&[Class::Polite, Class::Wish]) && !word.is_of_lessons() && Some(word.piece) != stays
    };
    let mut is_after_way = false;
    words.before(end).iter().any(|word| !core::mem::replace(&mut is_after_way, word.is_toward) && asks(word))
}

#[cfg(all(test, feature = "alloc"))]
mod tests {
    use super::super::taught::for_each;
    use super::*;

    type Rule = fn(Words<'_>) -> bool;

    /// Sentences with a rule, and whether it holds for them.
    const SENTENCES: [(&str, &str, (Rule, bool)); 44] = [
        ("en", "is the purple bag in the red room?", (is_question, true)),
        ("en", "where is the purple bag", (is_question, true)),
        ("en", "could you go to the red room?", (is_question, false)),
        ("en", "shall I go to the red room?", (is_question, true)),
        ("de", "ist die lila Tasche im roten Zimmer?", (is_question, true)),
        ("de", "kannst du ins rote Zimmer gehen?", (is_question, false)),
        ("fr", "où est le sac violet", (is_question, true)),
        ("fr", "peux-tu entrer dans la salle rouge?", (is_question, false)),
        ("es", "dónde está el bolso morado", (is_question, true)),
        ("es", "puedes ir a la sala roja?", (is_question, false)),
        ("zh", "紫色的包在哪里", (is_question, true)),
        ("zh", "请把紫色的包拿到红色房间好吗", (is_question, false)),
        ("en", "if it rains, go to the red room", (has_condition, true)),
        ("en", "go to the red room tomorrow", (has_condition, true)),
        ("en", "if you like, go to the red room", (has_condition, false)),
        ("en", "I'd be glad if you went to the red room", (has_condition, false)),
        ("de", "wenn es regnet, geh ins rote Zimmer", (has_condition, true)),
        ("fr", "s'il pleut, va dans la salle rouge", (has_condition, true)),
        ("fr", "si tu veux, va dans la salle rouge", (has_condition, false)),
        ("es", "si llueve, ve a la sala roja", (has_condition, true)),
        ("zh", "如果下雨，去红色房间", (has_condition, true)),
        ("en", "when you've put the purple bag in the red room, go to the green room", (is_past, true)),
        ("en", "go to the green room", (is_past, false)),
        ("de", "wenn du die lila Tasche ins rote Zimmer gebracht hast, geh ins grüne Zimmer", (is_past, true)),
        ("en", "my sister went to the red room", (tells, true)),
        ("en", "I go to the red room", (tells, true)),
        ("en", "you went to the red room", (tells, true)),
        ("en", "the dog takes the purple bag to the red room", (tells, true)),
        ("en", "I want you to go to the red room", (tells, false)),
        ("en", "zounds, go to the red room", (tells, false)),
        ("de", "ich gehe ins rote Zimmer", (tells, true)),
        ("de", "der Hund bringt die lila Tasche ins rote Zimmer", (tells, true)),
        ("de", "ich will, dass du ins rote Zimmer gehst", (tells, false)),
        ("fr", "je vais dans la salle rouge", (tells, true)),
        ("fr", "je veux que tu ailles dans la salle rouge", (tells, false)),
        ("es", "yo voy a la sala roja", (tells, true)),
        ("es", "quiero que vayas a la sala roja", (tells, false)),
        ("zh", "我去红色房间", (tells, true)),
        ("zh", "爸爸去红色房间", (tells, true)),
        ("en", "leave the purple bag here", (stays_by_name, true)),
        ("en", "leave this red room", (stays_by_name, false)),
        ("de", "lass die lila Tasche hier", (stays_by_name, true)),
        ("fr", "laisse le sac violet ici", (stays_by_name, true)),
        ("es", "deja el bolso morado aquí", (stays_by_name, true)),
    ];

    #[test]
    fn questions_conditions_and_reports_are_told_from_commands() {
        for_each(&SENTENCES, &|sentence, words, (rule, holds)| assert_eq!(rule(words), *holds, "{sentence}"));
    }
}
