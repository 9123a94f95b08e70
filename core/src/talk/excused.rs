//! Words that negate, except or split nothing in their context, and are read as polite ones: "if you don't mind", "right away", "don't
//! forget to". Also words for the present place: "leave it where it is".

use super::heard::Heard;
use crate::capacity::WORDS_PER_COMMAND;
use crate::voice::classes::{Class, Classes};

/// After a "but" that excepts nothing, "you" follows within this many words.
const SPOKEN_TO: usize = 2;
/// A negation within this many words after "if" belongs to the condition.
const NEGATES_A_CONDITION: usize = 3;

/// Excuses such words, one thing of the language after another.
pub(super) fn excuse(words: &mut [Heard]) {
    // "And" in the past, and among polite words in front, divides no commands.
    excuse_past_in_front(words);
    make_front_polite(words);
    // Each of these words is told by the words after it. So all are found before one is changed.
    let is_out = is_out_of_named_place(words);
    let idle = positions(words, &|at| is_mere_away(words, at) || is_apology(words, at));
    let after = positions(words, &|at| is_after(words, at));
    excuse_at(words, idle | after);
    (0..words.len()).rev().filter(|at| after >> at & 1 == 1).for_each(|at| divide(words, at));
    let conditions = polite_conditions(words);
    let reminders = reminders(words);
    if is_out {
        words.iter_mut().for_each(|word| word.classes = word.classes.without(Class::Here));
    } else {
        mark_present_place(words);
    }
    excuse_at(words, conditions | reminders);
}

/// A set of positions has a bit for each.
const _: () = assert!(WORDS_PER_COMMAND <= u64::BITS as usize);

/// The positions for which `holds`, one bit each.
fn positions(words: &[Heard], holds: &dyn Fn(usize) -> bool) -> u64 {
    (0..words.len()).fold(0, |all, at| all | u64::from(holds(at)) << at)
}

fn excuse_at(words: &mut [Heard], positions: u64) {
    words.iter_mut().enumerate().filter(|(at, _)| positions >> at & 1 == 1).for_each(|(_, word)| word.excuse());
}

/// Excuses the past in front of a command: "after you have been to the red room, go to the green room", "when you have put the bag in the
/// red room, go ...".
fn excuse_past_in_front(words: &mut [Heard]) {
    let Some(&Heard { phrase, classes, .. }) = words.first() else { return };
    let in_phrase = |is: &dyn Fn(&Heard) -> bool| words.iter().any(|word| word.phrase == phrase && is(word));
    let is_after = classes.contains(Class::Connective) && classes.contains(Class::Polite);
    let is_past = is_after || in_phrase(&|word| word.is_perfect) && in_phrase(&|word| word.is(Class::If));
    if is_past && in_phrase(&|word| word.is_name) && words.iter().any(|word| word.is_name && word.phrase != phrase) {
        excuse_past(words, phrase);
    }
}

/// Excuses the words that put a phrase into the past: "after you have", "when you've", and the participle.
fn excuse_past(words: &mut [Heard], phrase: u8) {
    let have = words.iter().position(|word| word.phrase == phrase && word.is_perfect);
    for (at, word) in words.iter_mut().enumerate().filter(|(_, word)| word.phrase == phrase) {
        let is_participle = have.is_some_and(|have| at.abs_diff(have) == 1) && !word.is_of_task;
        if is_participle || word.is_any(&[Class::Connective, Class::If, Class::Asking, Class::You]) {
            word.excuse();
        }
    }
}

/// Makes connectives among polite words in front polite. In "be so kind and go", no command comes before "and".
fn make_front_polite(words: &mut [Heard]) {
    let front = words.iter_mut().take_while(|word| word.is_any(&[Class::Polite, Class::Greeting, Class::Connective]));
    front.filter(|word| word.is(Class::Connective) && !word.classes.is_before()).for_each(Heard::make_polite);
}

/// Whether another place than a named one is meant: "stay out of the red room" is not about this place, "get out of here" is.
fn is_out_of_named_place(words: &[Heard]) -> bool {
    let is_out = |(at, word): (usize, &Heard)| word.is(Class::Out) && !word.leaves && !is_mere_away(words, at);
    words.iter().any(|word| word.is_name) && words.iter().enumerate().any(is_out)
}

fn is_at(words: &[Heard], at: usize, class: Class) -> bool {
    words.get(at).is_some_and(|word| word.is(class))
}

/// Whether a word such as "away" takes nothing out. It does so only before "from", not in "right away".
fn is_mere_away(words: &[Heard], at: usize) -> bool {
    is_at(words, at, Class::Out) && is_at(words, at, Class::Polite) && !is_at(words, at.saturating_add(1), Class::From)
}

/// Whether a word such as "but" excepts nothing: "sorry, but could you go".
fn is_apology(words: &[Heard], at: usize) -> bool {
    let is_but = |word: &Heard| word.is(Class::But) && !word.is_any(&[Class::All, Class::You]);
    words.get(at).is_some_and(is_but) && words.iter().skip(at.saturating_add(1)).take(SPOKEN_TO).any(|word| word.is(Class::You))
}

/// Whether a word such as "after" introduces an earlier command, "after taking", rather than the next one, "after that".
fn is_after(words: &[Heard], at: usize) -> bool {
    let is_past = |word: &Heard| word.is_any(&[Class::From, Class::You]) || word.is_perfect || word.is_new;
    is_at(words, at, Class::Connective) && is_at(words, at, Class::Polite) && words.get(at.saturating_add(1)).is_some_and(is_past)
}

/// Divides the words at such an "after" if there is a name on both sides: "go to the red room after taking the bag to the blue room". The
/// command after it is done first.
fn divide(words: &mut [Heard], after: usize) {
    let Some((front, behind)) = words.split_at_mut_checked(after) else { return };
    if [&*front, &*behind].iter().all(|part| part.iter().any(|word| word.is_name)) {
        for (at, word) in behind.iter_mut().enumerate() {
            (word.phrase, word.comes_first) = (word.phrase.saturating_add(1), at == 0);
        }
        let phrase = behind.first().map_or(0, |word| word.phrase);
        excuse_past(words, phrase);
    }
}

/// The positions of conditions that are only polite, up to the word after their negation. "If you don't mind" negates no command, nor does
/// "si ça ne te dérange pas" with two negations. "If I don't" and "tomorrow don't" may.
fn polite_conditions(words: &mut [Heard]) -> u64 {
    let (mut polite, mut condition, mut reach) = (0, 0, 0);
    for at in 0..words.len() {
        let behind = at.saturating_add(1);
        let Some(word) = words.get(at) else { break };
        if word.is(Class::If) {
            (condition, reach) = (at, behind.saturating_add(NEGATES_A_CONDITION));
        } else if word.is(Class::Speaker) || word.is_open() && !word.is_new {
            reach = 0;
        }
        let is_negated = condition.saturating_add(1) < at || condition < at && is_at(words, behind, Class::Asking);
        if word.is(Class::Negation) && is_negated && at < reach {
            reach = behind.saturating_add(NEGATES_A_CONDITION);
            polite |= positions(words, &|at| (condition..=behind).contains(&at));
            // The rules after this one read "mind" as polite, but "if", and a "stay" in such a condition, as themselves.
            words.iter_mut().skip(behind).take(1).for_each(Heard::excuse);
        }
    }
    polite
}

/// The positions of words such as "don't forget", which ask for the action after them.
fn reminders(words: &[Heard]) -> u64 {
    positions(words, &|at| is_reminder(words, at) || at.checked_sub(1).is_some_and(|before| is_reminder(words, before)))
}

/// Whether the words "don't forget", in any order, begin at a position, with an act word after them.
fn is_reminder(words: &[Heard], at: usize) -> bool {
    let Some([one, other]) = words.get(at..).and_then(|words| words.first_chunk::<2>()) else { return false };
    let is_pair = one.is(Class::Negation) && other.forgets || one.forgets && other.is(Class::Negation);
    is_pair && words.iter().skip(at.saturating_add(2)).any(|word| word.is_of_task)
}

/// Marks words for the present place. After a word such as "stay" or "leave", "where it is" means here.
fn mark_present_place(words: &mut [Heard]) {
    let (mut stays, mut is_where) = (false, false);
    for word in words {
        stays |= word.leaves || word.is(Class::Here);
        is_where |= stays && word.is(Class::Asking);
        if is_where && word.is_any(&[Class::Asking, Class::Pronoun, Class::You]) {
            word.classes = Classes::of(Class::Here);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::taught::for_each;
    use super::*;

    #[test]
    fn a_word_keeps_its_class_only_where_it_has_its_meaning() {
        let rows = [
            ("en", "if you don't mind, go to the red room", (Class::Negation, false)),
            ("en", "don't forget to go to the red room", (Class::Negation, false)),
            ("en", "don't go to the red room", (Class::Negation, true)),
            ("en", "sorry, but could you go to the red room", (Class::But, false)),
            ("en", "take all but the purple bag to the red room", (Class::But, true)),
            ("en", "go right away to the red room", (Class::Out, false)),
            ("en", "go away from the red room", (Class::Out, true)),
            ("en", "be so kind and go to the red room", (Class::Connective, false)),
            ("en", "go to the red room and take the purple bag to the blue room", (Class::Connective, true)),
            ("en", "leave the purple bag where it is", (Class::Here, true)),
            ("en", "stay out of the red room", (Class::Here, false)),
            ("de", "wenn es dir nichts ausmacht, geh ins rote Zimmer", (Class::Negation, false)),
            ("de", "vergiss nicht, ins rote Zimmer zu gehen, geh", (Class::Negation, false)),
            ("de", "lass die lila Tasche, wo sie ist", (Class::Here, true)),
            ("fr", "si ça ne te dérange pas, va dans la salle rouge", (Class::Negation, false)),
            ("fr", "n'oublie pas, apporte le sac violet dans la salle rouge", (Class::Negation, false)),
            ("es", "no olvides, lleva el bolso morado a la sala roja", (Class::Negation, false)),
            ("zh", "别忘了把紫色的包拿到红色房间", (Class::Negation, false)),
        ];
        for_each(&rows, &|sentence, words, (class, has)| assert_eq!(words.has(*class), *has, "{sentence}: {}", class.name()));
    }
}
