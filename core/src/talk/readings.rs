//! Readings of an utterance that differ from one plain command: negated commands, and all things of a kind.

use super::acceptance::FAR;
use super::context::View;
use super::heard::Heard;
use super::repair::{is_interregnum, names};
use super::syntax::{begins_with_way, is_question, stays_by_name};
use super::told::place_of_all;
use super::words::{Words, learned};
use crate::voice::classes::Class;
use heapless::Vec;

/// The priors of a negation, and of all things of a kind.
const NEGATED: f32 = 0.1;
const ALL: f32 = 0.03;
/// The same of all things if no known cue tells it.
pub(super) const GATHERED: f32 = ALL * UNCUED;
/// The probability of a word as a cue for a negation, several commands or all things.
pub(super) const CUE: f32 = 0.15;
/// The same if no known cue tells it.
const UNCUED: f32 = 0.02;
/// The share of tasks that hold already, if a change may be asked for or not.
pub(super) const EITHER: f32 = 0.5;
/// The same if a change is asked for, and the task's goal is to be undone.
const CHANGE: f32 = 0.65;
/// The factor for "all", whose things need no name: e^4.
const UNNAMED: f32 = 54.598_15;
/// The same for a plural, which is more probable than a slip.
const PLURAL: f32 = 1_000.0;
/// The classes of words that negate a command.
const NEGATING: [Class; 3] = [Class::Negation, Class::Out, Class::But];
/// The number of words after "all" that may name the things.
const NAME_OF_ALL: usize = 2;

/// So many words before a name, and after it, are near it.
const BEFORE_NAME: u8 = 3;
const AFTER_NAME: u8 = 2;

/// The most names of a command about all things that no known cue tells, and its readings.
const MOST_NAMES: usize = 3;
pub(super) const GATHERINGS: usize = 1 + 2 * MOST_NAMES;

/// A reading of an utterance: its words without the cues.
#[derive(Clone, Copy)]
pub(super) struct WithoutCues<'w> {
    pub words: Words<'w>,
    /// The words that name exceptions.
    pub except: Words<'w>,
    /// The words that name the present place of the things.
    pub from: Words<'w>,
    /// The prior of this reading.
    pub prior: f32,
    pub view: View,
    /// Whether the reading is certain, given its tasks.
    pub is_clear: bool,
    /// Whether it needs no act word: "leave the red room".
    pub needs_no_act: bool,
    /// The same for a task about a thing. "Leave the chair in the red room" is the opposite of "out of the red room".
    pub things_need_no_act: bool,
    /// Whether it may say that a thing stays: "leave the chair in the red room".
    pub stays: bool,
    /// Whether it negates a negation: "don't leave the red room".
    pub is_double: bool,
}

/// The words without the cues of some classes, and the probability of these cues. Adjacent cues count once: "out of", "all things".
fn without<'w>(words: Words<'w>, cues: &[Class]) -> Option<(Words<'w>, f32)> {
    let takes_out = cues.contains(&Class::Out) && is_out(words);
    let (mut probability, mut is_after_cue) = (1.0, false);
    let rest = words.only(|word| {
        let is_cue = word.is_any(cues);
        let is_from = takes_out && word.is(Class::From);
        if is_cue && !is_after_cue {
            probability *= CUE;
        }
        is_after_cue = is_cue && !word.is(Class::From);
        !(is_cue || is_from)
    });
    // The new verb of "clear the chairs from the red room" is the cue.
    probability *= if takes_out && !words.has(Class::Out) { CUE } else { 1.0 };
    Some((rest.if_fewer(words)?, probability)).filter(|(rest, _)| !rest.is_empty())
}

/// Whether a place is to be left.
fn is_out(words: Words<'_>) -> bool {
    words.has(Class::Out) || is_taken_from(words)
}

/// Whether a new verb takes something away from a place: "clear the chairs from the red room".
fn is_taken_from(words: Words<'_>) -> bool {
    let begins_with_verb = words.iter().find(|word| word.is_open()).is_some_and(|word| word.is_new);
    begins_with_verb && !words.has_way() && words.at(Class::From).is_some_and(|from| words.from(from).has_name())
}

/// The words without the cues for a negation, if there are some.
fn without_negation(words: Words<'_>) -> Option<(Words<'_>, f32)> {
    without(words, if is_all_out(words) { &[Class::Out, Class::All] } else { &NEGATING })
}

/// Whether a known cue tells that words forbid.
pub(super) fn has_negation(words: Words<'_>) -> bool {
    without_negation(words).is_some()
}

/// The words read as a negated command, if there is a cue for one, or a new word that may be one.
pub(super) fn negated(words: Words<'_>) -> Option<WithoutCues<'_>> {
    let not = words.at(Class::Negation);
    // "All chairs out of the blue room into the red room" states a goal.
    if not.is_none() && has_place_of_all(words) {
        return None;
    }
    // "All chairs out of the red room".
    let unnamed = if is_all_out(words) { UNNAMED } else { 1.0 };
    let with_cue = without_negation(words);
    // "The red room is off limits": any word that no lesson had may forbid.
    let (rest, probability) = with_cue.or_else(|| words.any(&Heard::is_new_word).then_some((words, UNCUED)))?;
    let (is_out, is_not) = (is_out(words), not.is_some());
    // "Leave" implies a present place, and needs no other act word.
    let view = View { done: if is_out { CHANGE } else { EITHER }, has_act: is_out };
    // "Leave the chair in the red room" says that it stays; "right away go into the red room" asks for the room. The "to" of "has to come
    // out" is another one.
    let stays = is_out && rest.iter().zip(rest.iter().skip(1)).any(|(way, word)| way.is_toward && !word.may_act());
    let is_there = stays && rest.any(&Heard::acts);
    // In "go to the red room ... no", nothing that could be negated follows.
    let denies = is_out || words.has(Class::You) || not.is_none_or(|not| words.from(not).has_name());
    // "Don't move the bag, it has to stay here" says the same thing twice.
    let is_twice = is_not && stays_by_name(words) && !denies_stay(words);
    let is_other = asks_instead(words) || is_half_negated(words) || is_not_but(words) || words.has(Class::If);
    let needs_no_act = is_out || words.has(Class::But) || begins_with_way(rest) || rest.any(&Heard::may_act);
    Some(WithoutCues {
        words: rest,
        except: Words::NONE,
        from: Words::NONE,
        prior: NEGATED * (probability * unnamed) / learned(words, &|word| word.is_any(&NEGATING)),
        view,
        is_clear: with_cue.is_some() && denies && !is_there && !is_twice && !is_other,
        needs_no_act,
        things_need_no_act: needs_no_act && (is_not || words.has(Class::From)),
        stays,
        is_double: is_not && is_out,
    })
}

/// Whether words with a negation ask for something: "why don't you go", "don't you like it?". "You are not allowed" forbids, and "you don't
/// have to" does not. "Anywhere" is no question word: "n'importe où".
fn asks_instead(words: Words<'_>) -> bool {
    let last = words.last(&|word| word.is(Class::Negation)).unwrap_or(0);
    let asked = if words.begins_with(Class::You) { words.from(last) } else { words };
    let not = words.at(Class::Negation);
    let asks_you = words.is_asked && not.is_some_and(|not| words.after(not).begins_with(Class::You));
    !words.has(Class::But) && (is_question(asked) || asks_you)
}

/// Whether a word negates only with another one: "ne va que dans la salle rouge".
fn is_half_negated(words: Words<'_>) -> bool {
    words.has(Class::Negation) && !words.any(&|word| word.is_new || word.is(Class::Negation) && !word.is(Class::Or))
}

/// Whether two negations ask for the place: "do not go anywhere but to the red room". "Anywhere but not there" negates once.
fn is_not_but(words: Words<'_>) -> bool {
    words.at(Class::But).zip(words.at(Class::Negation)).is_some_and(|(but, not)| not < but)
}

/// Whether a word such as "stay" is negated: "the basket can't stay in the green room".
fn denies_stay(words: Words<'_>) -> bool {
    let not = words.at(Class::Negation).unwrap_or(usize::MAX);
    let is_near = |word: &&Heard| word.is_any(&[Class::Negation, Class::Polite, Class::Here]);
    words.from(not).iter().take_while(is_near).any(|word| word.is(Class::Here))
}

/// Whether all things of a kind are to leave a place.
fn is_all_out(words: Words<'_>) -> bool {
    words.has(Class::Out) && words.has(Class::All) && !words.has(Class::Negation) && !words.has(Class::But) && !has_place_of_all(words)
}

/// Whether several things may be meant that must leave a place: "the chairs".
pub(super) fn is_of_several(words: Words<'_>) -> bool {
    is_all_out(words) || words.any(&|word| word.is_plural)
}

/// The words read as a command about all things of a kind, if there is a cue for that: "all chairs", "the chairs".
pub(super) fn all(words: Words<'_>) -> Option<WithoutCues<'_>> {
    if is_all_out(words) {
        return None;
    }
    let exception = exception(words);
    let (words, except) = exception.unwrap_or((words, Words::NONE));
    let (words, from) = place_of_all(words, first_of_all(words));
    let excepts = |word: &Heard| is_but(word) || word.is_any(&[Class::Negation, Class::Out]) && !word.is(Class::All);
    let has_other_exception = words.any(&excepts) || exception.is_some() && !except.has_name();
    let (rest, prior, is_clear) = if let Some((rest, probability)) = without(words, &[Class::All]) {
        let behind = words.at(Class::All).map_or(Words::NONE, |all| words.after(all));
        (rest, UNNAMED * probability, !behind.iter().take(NAME_OF_ALL).take_while(|word| !word.is_name).any(|word| word.is_new))
    } else {
        let plural = words.position(&|word| word.is_plural)?;
        (words, PLURAL, has_one_article(words.before(plural)))
    };
    Some(WithoutCues {
        words: rest,
        except,
        from,
        prior: ALL * prior,
        view: View { done: EITHER, ..View::PLAIN },
        is_clear: is_clear && !has_other_exception,
        needs_no_act: false,
        things_need_no_act: false,
        stays: false,
        is_double: false,
    })
}

/// What tells that a command is about all things, if no known cue does: "the whole lot", "bar the bag", "empty the red room".
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Gathering {
    /// The words: all things that fit are meant.
    Whole,
    /// A name: all things but this one are meant.
    Except,
    /// A place: all things in it are meant.
    From,
}

impl Gathering {
    /// What stands before the words that tell it, for the [acceptance](super::acceptance).
    pub const fn sign(self) -> &'static str {
        match self {
            Self::Whole => FAR,
            Self::Except => "-",
            Self::From => "@",
        }
    }

    /// The words read so, with the name that tells it.
    pub fn read(self, words: Words<'_>, name: Name) -> WithoutCues<'_> {
        let name = name.of(words);
        let (except, from) = match self {
            Self::Whole => (Words::NONE, Words::NONE),
            Self::Except => (name, Words::NONE),
            Self::From => (Words::NONE, name),
        };
        WithoutCues {
            words: words.without(name),
            except,
            from,
            prior: GATHERED,
            view: View { done: EITHER, ..View::PLAIN },
            is_clear: false,
            needs_no_act: false,
            things_need_no_act: false,
            stays: false,
            is_double: false,
        }
    }
}

/// A name, from one position among words to another.
#[derive(Clone, Copy)]
pub(super) struct Name {
    begin: u8,
    end: u8,
}

impl Name {
    const NONE: Self = Self { begin: 0, end: 0 };

    /// Its words.
    fn of(self, words: Words<'_>) -> Words<'_> {
        words.part(self.begin.into(), self.end.into())
    }

    /// Whether a word is so near that it may tell what is said of it: "all but the", "the ... stays".
    pub fn is_near(self, words: Words<'_>, word: &Heard) -> bool {
        let name = self.of(words);
        let (begin, end) = (name.get(0).map_or(u8::MAX, |first| first.piece), name.iter().last().map_or(0, |last| last.piece));
        word.piece.saturating_add(BEFORE_NAME) >= begin && word.piece <= end.saturating_add(AFTER_NAME)
    }
}

/// The commands about all things that words may be, although no known cue tells it, each with the name that tells it.
pub(super) fn gatherings(words: Words<'_>) -> Vec<(Gathering, Name), GATHERINGS> {
    let (names, mut gatherings) = (names(words), Vec::new());
    if !is_interregnum(words) || names.len() > MOST_NAMES {
        return gatherings;
    }
    let cued = all(words);
    // What known cues tell needs no other words.
    if cued.is_some_and(|all| !(all.except.is_empty() && all.from.is_empty())) {
        return gatherings;
    }
    if cued.is_none() {
        let _ = gatherings.push((Gathering::Whole, Name::NONE));
    }
    for name in names {
        let noun = usize::from(words.get(name.end).is_some_and(Heard::is_noun));
        let name = Name { begin: name.start as u8, end: name.end.saturating_add(noun) as u8 };
        let _ = gatherings.extend_from_slice(&[(Gathering::Except, name), (Gathering::From, name)]);
    }
    gatherings
}

fn is_but(word: &Heard) -> bool {
    word.is(Class::But) && !word.is(Class::All)
}

/// The words without an exception, and those that name it: "everything but the red bag to the blue room".
fn exception(words: Words<'_>) -> Option<(Words<'_>, Words<'_>)> {
    let but = words.position(&is_but)?;
    let behind = words.from(but);
    let end = behind.position(&|word| word.is_toward || word.is_of_task).unwrap_or(usize::MAX);
    Some((words.before(but).with(behind.from(end)), behind.part(1, end)))
}

/// The position of the word for all things.
fn first_of_all(words: Words<'_>) -> usize {
    words.position(&|word| word.is(Class::All) || word.is_plural).unwrap_or(usize::MAX)
}

/// Whether the present place of all things is told.
fn has_place_of_all(words: Words<'_>) -> bool {
    !place_of_all(words, first_of_all(words)).1.is_empty()
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

#[cfg(test)]
mod tests {
    use super::super::taught::{for_each, left};
    use super::*;
    use std::string::String;

    #[test]
    fn a_prohibition_is_read_without_its_cue() {
        let rows = [
            ("en", "never go to the red room", "go to the red room"),
            ("en", "don't take the purple bag to the red room", "take the purple bag to the red room"),
            ("en", "get out of the red room", "get the red room"),
            ("en", "clear the purple chairs from the red room", "clear the purple chairs the red room"),
            ("en", "go to the red room", ""),
            ("de", "geh nicht ins rote Zimmer", "geh ins rote zimmer"),
            ("de", "raus aus dem roten Zimmer", "dem roten zimmer"),
            ("fr", "ne va pas dans la salle rouge", "va dans la salle rouge"),
            ("fr", "sors de la salle rouge", "la salle rouge"),
            ("es", "no entres en la sala roja", "entres en la sala roja"),
            ("es", "sal de la sala roja", "la sala roja"),
            ("zh", "不要去红色房间", "去 红 色 房 间"),
            ("zh", "离开红色房间", "红 色 房 间"),
        ];
        for_each(&rows, &|sentence, words, rest| {
            let words = negated(words).map_or(String::new(), |reading| left(sentence, reading.words));
            assert_eq!(words, *rest, "{sentence}");
        });
    }

    #[test]
    fn a_prohibition_is_clear_only_if_it_asks_for_nothing_else() {
        let rows = [
            ("en", "don't go to the red room", true),
            ("en", "why don't you go to the red room", false),
            ("en", "go to the red room ... no", false),
            ("en", "do not go anywhere but to the red room", false),
            ("en", "don't move the purple bag, it has to stay here", false),
            ("en", "you are not allowed to go to the red room", true),
            ("de", "geh nicht ins rote Zimmer", true),
            ("fr", "ne va que dans la salle rouge", false),
            ("es", "no entres en la sala roja", true),
        ];
        for_each(&rows, &|sentence, words, clear| {
            assert_eq!(negated(words).is_some_and(|reading| reading.is_clear), *clear, "{sentence}");
        });
    }

    #[test]
    fn a_command_for_all_things_is_read_without_all_with_exceptions_and_present_place() {
        let rows = [
            ("en", "take all chairs to the red room", ["take chairs to the red room", "", ""]),
            ("en", "take the chairs to the red room", ["take the chairs to the red room", "", ""]),
            ("en", "take everything but the purple bag to the red room", ["take to the red room", "the purple bag", ""]),
            ("en", "take all chairs from the blue room to the red room", ["take chairs to the red room", "", "the blue room"]),
            ("en", "take the purple chair to the red room", ["", "", ""]),
            ("de", "bring alle Stühle ins rote Zimmer", ["bring stühle ins rote zimmer", "", ""]),
            ("fr", "apporte toutes les chaises dans la salle rouge", ["apporte les chaises dans la salle rouge", "", ""]),
            ("es", "lleva todas las sillas a la sala roja", ["lleva las sillas a la sala roja", "", ""]),
            ("zh", "把所有的椅子拿到红色房间", ["把 椅子 拿 到 红 色 房 间", "", ""]),
        ];
        for_each(&rows, &|sentence, words, parts| {
            let read =
                all(words).map_or([(); 3].map(|()| String::new()), |it| [it.words, it.except, it.from].map(|part| left(sentence, part)));
            assert_eq!(read, *parts, "{sentence}");
        });
    }

    #[test]
    fn a_name_may_tell_what_stays_or_the_present_place_where_no_known_cue_does() {
        let rows = [
            ("en", "shift the lot to the red room bar the purple bag", std::vec!["", "red room", "red room", "purple bag", "purple bag"]),
            ("de", "räum mal das blaue Zimmer aus", std::vec!["", "blaue zimmer", "blaue zimmer"]),
            ("en", "go to the red room", std::vec![]),
        ];
        for_each(&rows, &|sentence, words, names| {
            let read: std::vec::Vec<_> = gatherings(words).iter().map(|&(_, name)| left(sentence, name.of(words))).collect();
            assert_eq!(read, *names, "{sentence}");
        });
        for_each(&[("en", "shift the lot to the red room bar the purple bag", ())], &|sentence, words, ()| {
            let of_bag = |gathering| gatherings(words).iter().copied().rfind(|it| it.0 == gathering);
            let (except, name) = of_bag(Gathering::Except).expect(sentence);
            let rest = except.read(words, name);
            assert_eq!(left(sentence, rest.words), "shift the lot to the red room bar the");
            assert_eq!(left(sentence, rest.except), "purple bag");
        });
    }
}
