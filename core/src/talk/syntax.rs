//! The syntax of an utterance, as far as its words tell: whether it has a verb, begins with a direction, or is in the past.

use super::heard::Heard;
use super::words::Words;
use crate::symbols::Symbol;
use crate::voice::classes::Class;
use heapless::Vec;

/// A sentence with more new words is no paraphrase of a known command.
const MOST_NEW: usize = 2;
/// The number of words of a subject and its verb.
const SUBJECT_AND_VERB: usize = 2;
/// The most pairs of neighbouring names that are looked at.
const NEIGHBOURS: usize = 6;
/// So many signs may stand between the names of one thing: "绿色的包".
const SIGNS_OF_NAME: u8 = 2;

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

/// The names that were said beside each other: "blue chair". In a script without spaces, signs may stand between them.
pub(super) fn neighbouring_names(words: Words<'_>) -> Vec<[Symbol; 2], NEIGHBOURS> {
    let (mut neighbours, mut last) = (Vec::new(), None::<&Heard>);
    // A way or an act word ends a name, and so does all that a reading leaves out.
    for word in words.iter().filter(|word| word.is_name || !word.is_sign || word.is_toward || word.acts()) {
        if !word.is_name || word.is_toward {
            last = None;
            continue;
        }
        let gap = |last: &Heard| word.piece.checked_sub(last.piece);
        let most = if word.is_sign { SIGNS_OF_NAME + 1 } else { 1 };
        let is_beside = |last: &&Heard| last.phrase == word.phrase && gap(last).is_some_and(|gap| gap <= most);
        let pair = last.filter(is_beside).and_then(|last| last.said.symbol.zip(word.said.symbol));
        if let Some((first, second)) = pair {
            let _ = neighbours.push([first, second]);
        }
        last = Some(word);
    }
    neighbours
}

/// Whether a new subject and a new verb come before the direction: "Grandma sleeps in the red room".
fn is_of_new_subject(words: Words<'_>) -> bool {
    let front = words.until(&|word| word.is_toward);
    let is_new = |word: &Heard| word.is_new && !word.is_sign && word.is_open();
    words.any(&|word| word.is_name && !word.is_toward) && front.len() == SUBJECT_AND_VERB && front.iter().all(is_new)
}

/// Whether no word says what to do, except for words of direction.
pub(super) fn is_verbless(words: Words<'_>) -> bool {
    !words.any(&|word| word.may_act() && !word.is_toward)
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

/// The words without the verb that leaves a thing in its place: "leave the bag in the red room" becomes "the bag in the red room".
pub(super) fn without_leaving(words: Words<'_>) -> Option<Words<'_>> {
    let rest = words.only(|word| !word.leaves);
    // "Leave the bag here", but not "leave this red room".
    let stays = rest.position(&|word| word.is(Class::Here)).is_some_and(|here| rest.before(here).has_name());
    let is_other = words.any(&|word| word.is_any(&[Class::Negation, Class::From, Class::But]));
    (rest.len() < words.len() && !is_other && (stays || names_thing_and_way(rest))).then_some(rest)
}

/// Whether a new word stands between known ones.
pub(super) fn has_new_name(words: Words<'_>) -> bool {
    let Some(known) = words.position(&Heard::is_of_lessons) else { return false };
    let behind = words.after(known);
    behind.position(&|word| word.is_new).is_some_and(|new| behind.from(new).any(&Heard::is_of_lessons))
}

/// Whether words in the past precede another command: "when you've put the bag in the red room, go to the green room".
pub(super) fn is_past(words: Words<'_>) -> bool {
    let names = |phrase: u8| words.any(&|word| word.is_name && word.phrase != phrase);
    words.any(&|word| word.is_perfect && names(word.phrase))
}

#[cfg(test)]
mod tests {
    use super::super::taught::for_each;
    use super::*;

    #[test]
    fn what_is_past_is_told_from_commands() {
        let rows = [
            ("en", "when you've put the purple bag in the red room, go to the green room", true),
            ("en", "go to the green room", false),
            ("de", "wenn du die lila Tasche ins rote Zimmer gebracht hast, geh ins grüne Zimmer", true),
        ];
        for_each(&rows, &|sentence, words, holds| assert_eq!(is_past(words), *holds, "{sentence}"));
    }

    #[test]
    fn neighbouring_names_were_said_beside_each_other() {
        let rows = [
            ("en", "take the purple bag to the blue room", 1),
            ("en", "purple bag blue room", 2),
            ("en", "the bag, purple room", 0),
            ("en", "take the chair and the purple bag", 1),
            ("zh", "紫色的包", 1),
        ];
        for_each(&rows, &|sentence, words, pairs| assert_eq!(neighbouring_names(words).len(), *pairs, "{sentence}"));
    }

    #[test]
    fn names_that_words_between_them_were_left_out_of_are_no_neighbours() {
        for_each(&[("en", "take the chair out of the blue room", ())], &|sentence, words, ()| {
            let names = words.only(|word| word.is_name && !word.is_toward);
            assert_eq!(names.len(), 2, "{sentence}");
            assert!(neighbouring_names(names).is_empty(), "{sentence}");
        });
    }
}
