//! Readings of an utterance that differ from one plain command: negated commands, and all things of a kind.

use super::acceptance::FAR;
use super::context::View;
use super::heard::Heard;
use super::repair::{is_interregnum, names};
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
    /// Whether known cues tell it, and none speaks for an exception.
    pub is_clear: bool,
    /// Whether it negates a negation: "don't leave the red room".
    pub is_double: bool,
}

/// The words without the cues of some classes, and the probability of these cues. Adjacent cues count once: "out of", "all things".
fn without<'w>(words: Words<'w>, cues: &[Class]) -> Option<(Words<'w>, f32)> {
    let takes_out = cues.contains(&Class::Out) && words.has(Class::Out);
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
    (rest.len() < words.len() && !rest.is_empty()).then_some((rest, probability))
}

/// The words read as a negated command, if there is a cue for one, or a new word that may be one.
pub(super) fn negated(words: Words<'_>) -> Option<WithoutCues<'_>> {
    let is_not = words.has(Class::Negation);
    // "All chairs out of the blue room into the red room" states a goal.
    if !is_not && !of_one_place(words).1.is_empty() {
        return None;
    }
    let with_cue = without(words, &NEGATING);
    // "The red room is off limits": any word that no lesson had may forbid.
    let (rest, probability) = with_cue.or_else(|| words.any(&Heard::is_new_word).then_some((words, UNCUED)))?;
    let is_out = words.has(Class::Out);
    Some(WithoutCues {
        words: rest,
        except: Words::NONE,
        from: Words::NONE,
        prior: NEGATED * probability / learned(words, &|word| word.is_any(&NEGATING)),
        // "Leave" implies a present place, and needs no other act word.
        view: View { done: if is_out { CHANGE } else { EITHER }, has_act: is_out },
        is_clear: with_cue.is_some(),
        is_double: is_not && is_out,
    })
}

/// The words read as a command about all things of a kind, if there is a cue for that: "all chairs", "the chairs".
pub(super) fn all(words: Words<'_>) -> Option<WithoutCues<'_>> {
    let (words, from) = of_one_place(words);
    let (rest, prior, means_all) = if let Some((rest, probability)) = without(words, &[Class::All]) {
        (rest, UNNAMED * probability, true)
    } else {
        let plural = words.position(&|word| word.is_plural)?;
        (words, PLURAL, has_one_article(words.before(plural)))
    };
    // "But", "not" and "out" make exceptions.
    let excepts = words.any(&|word| word.is_any(&NEGATING) && !word.is(Class::All));
    Some(WithoutCues {
        words: rest,
        except: Words::NONE,
        from,
        prior: ALL * prior,
        view: View { done: EITHER, ..View::PLAIN },
        is_clear: means_all && !excepts,
        is_double: false,
    })
}

/// What tells that a command is about all things, or about which of them, beside the known cues: "the whole lot", "bar the bag", "empty the red room".
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
    if cued.is_some_and(|all| !all.from.is_empty()) {
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

/// Splits the words for the present place of all things from the others.
fn of_one_place(words: Words<'_>) -> (Words<'_>, Words<'_>) {
    place_of_all(words, words.position(&|word| word.is(Class::All) || word.is_plural).unwrap_or(usize::MAX))
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
    fn a_command_for_all_things_is_read_without_all() {
        let rows = [
            ("en", "take all chairs to the red room", "take chairs to the red room"),
            ("en", "take the chairs to the red room", "take the chairs to the red room"),
            ("en", "take everything but the purple bag to the red room", "take but the purple bag to the red room"),
            ("en", "take the purple chair to the red room", ""),
            ("de", "bring alle Stühle ins rote Zimmer", "bring stühle ins rote zimmer"),
            ("fr", "apporte toutes les chaises dans la salle rouge", "apporte les chaises dans la salle rouge"),
            ("es", "lleva todas las sillas a la sala roja", "lleva las sillas a la sala roja"),
            ("zh", "把所有的椅子拿到红色房间", "把 椅子 拿 到 红 色 房 间"),
        ];
        for_each(&rows, &|sentence, words, rest| {
            assert_eq!(all(words).map_or(String::new(), |all| left(sentence, all.words)), *rest, "{sentence}");
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
