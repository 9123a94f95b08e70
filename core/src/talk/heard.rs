//! The words of an utterance, with their probabilities in a command and beside one.

use super::classes::{Class, Classes, ClosedWords, cut};
use super::slips::{SLIP, is_plural, slip_for};
use crate::capacity::WORDS_PER_COMMAND;
use crate::language::bitext::BitextRef;
use crate::language::roles::talk::{Said, background, common, is_name, is_of_task};
use crate::language::spelling::is_slip;
use crate::language::tokenizer::start_of_piece;
use crate::language::{LanguageRef, for_each_piece};
use crate::memory::AgentMemory;
use crate::session::{Agent, AgentError};
use crate::symbols::Symbol;
use heapless::Vec;

/// The probability of a new word if no task is meant, and beside a command.
pub(super) const NEW: f32 = 0.5;
/// The probability of a polite word beside a command, and of another word of a closed class.
const POLITE: f32 = 0.6;
const OTHER_CLOSED: f32 = 1e-3;
/// The factor of a cue, a word that negates, splits or generalises a command, read as an ordinary word, if no lesson had it.
const TURNS: f32 = 0.01;
/// After a "but" that excepts nothing, "you" follows within this many words.
const SPOKEN_TO: usize = 2;
/// The factor of a word of direction ("to") other than the lessons' own.
const OTHER_WAY: f32 = 0.3;
/// The least bytes of a new verb before a pronoun.
const LEAST_VERB: usize = 3;
/// A negation within this many words after "if" belongs to the condition.
const NEGATES_A_CONDITION: usize = 3;

/// One word, with its classes.
#[derive(Clone, Copy)]
pub(super) struct Heard {
    pub said: Said,
    pub classes: Classes,
    /// Its probability if no task is meant.
    pub beside: f32,
    /// Its number of occurrences in lessons.
    pub count: f32,
    /// A factor on its probability in a command. For a mended word: its spelling as a slip, against that of a new word. For a word that
    /// negates, splits or generalises commands and was in no lesson: [`TURNS`]. 1 for any other word.
    pub factor: f32,
    /// Whether it is heard for the first time, and in no class.
    pub is_new: bool,
    pub is_mended: bool,
    /// Whether it is a word of direction, such as "to".
    pub is_toward: bool,
    /// Whether it is "forget".
    is_forgetting: bool,
    /// Whether it is an article: "el".
    pub is_article: bool,
    /// Whether it leaves a thing in its place, such as "leave".
    pub leaves: bool,
    /// Whether its command is done first, such as "first", and "after" between two commands.
    pub comes_first: bool,
    /// Whether it is "have" before a participle.
    pub is_perfect: bool,
    /// Whether it tells a place by the thing named next, such as "where" and "beside".
    pub is_beside: bool,
    /// Whether it is a single sign of a script without spaces.
    pub is_sign: bool,
    /// The number of its piece in the utterance, from 0.
    pub piece: u8,
    /// The number of its phrase: of marks such as commas before it.
    pub phrase: u8,
    /// Whether some task explains it better than the background does.
    pub is_of_task: bool,
    /// Whether it names a value.
    pub is_name: bool,
    /// Whether it is probably the plural of a name: "chairs".
    pub is_plural: bool,
}

/// The words of an utterance.
pub(super) type Utterance = Vec<Heard, WORDS_PER_COMMAND>;

/// Some of the words of an utterance, in order. One bit each, so that a reading needs no copy of the words.
#[derive(Clone, Copy)]
pub(super) struct Words<'w> {
    all: &'w [Heard],
    kept: u64,
    /// The word that comes first; the words before it come last.
    first: usize,
    /// Whether a question mark ends them.
    pub is_asked: bool,
}

const _: () = assert!(WORDS_PER_COMMAND <= u64::BITS as usize);

impl<'w> Words<'w> {
    /// No words.
    pub const NONE: Self = Self { all: &[], kept: 0, first: 0, is_asked: false };

    pub const fn new(all: &'w [Heard], is_asked: bool) -> Self {
        Self { all, kept: u64::MAX, first: 0, is_asked }
    }

    pub const fn iter(self) -> Iter<'w> {
        Iter { words: self, passed: 0, at: 0 }
    }

    pub fn len(self) -> usize {
        self.iter().count()
    }

    pub fn is_empty(self) -> bool {
        self.iter().next().is_none()
    }

    pub fn get(self, at: usize) -> Option<&'w Heard> {
        self.iter().nth(at)
    }

    /// The first position of a word of a class.
    #[inline(never)]
    pub fn at(self, class: Class) -> Option<usize> {
        self.iter().position(|word| word.classes.contains(class))
    }

    /// Whether a word is of a class.
    pub fn has(self, class: Class) -> bool {
        self.at(class).is_some()
    }

    /// The words for which `is_wanted` holds; it is called once for each, in order.
    pub fn only(self, mut is_wanted: impl FnMut(&Heard) -> bool) -> Self {
        self.keep(&mut is_wanted)
    }

    #[inline(never)]
    fn keep(self, is_wanted: &mut dyn FnMut(&Heard) -> bool) -> Self {
        let (mut words, mut kept) = (self.iter(), 0);
        while let Some(word) = words.next() {
            kept |= u64::from(is_wanted(word)) << words.at;
        }
        Self { kept, ..self }
    }

    /// The same words, with those before a position moved to the end.
    pub fn turned(self, position: usize) -> Self {
        let mut words = self.iter();
        let _ = words.nth(position);
        Self { first: words.at, ..self }
    }

    /// These words and those of another part of the same utterance.
    pub const fn with(self, other: Self) -> Self {
        Self { kept: self.kept | other.kept, ..self }
    }

    /// The words from one position up to another.
    pub fn part(self, begin: usize, end: usize) -> Self {
        let mut at = 0_usize;
        self.only(|_| {
            at = at.saturating_add(1);
            begin < at && at <= end
        })
    }
}

/// Iterates over words. It is one type for all callers; iterator adapters would be compiled for each.
#[derive(Clone)]
pub(super) struct Iter<'w> {
    words: Words<'w>,
    /// The number of words of the utterance passed, kept or not.
    passed: usize,
    /// The position of the last word in the utterance.
    at: usize,
}

impl<'w> Iterator for Iter<'w> {
    type Item = &'w Heard;

    #[inline(never)]
    fn next(&mut self) -> Option<&'w Heard> {
        let Words { all, kept, first, .. } = self.words;
        while self.passed < all.len() {
            let at = first.saturating_add(self.passed);
            self.at = if at < all.len() { at } else { at.saturating_sub(all.len()) };
            self.passed = self.passed.saturating_add(1);
            if kept >> self.at & 1 == 1 {
                return all.get(self.at);
            }
        }
        None
    }
}

impl Heard {
    pub fn new(language: LanguageRef<'_>, symbol: Option<Symbol>, classes: Classes) -> Self {
        let (is_toward, is_forgetting) = (classes.contains(Class::Toward), classes.forgets());
        let is_article = classes.contains(Class::Clitic);
        let leaves = classes.contains(Class::Out) && classes.contains(Class::Act);
        let is_beside = classes.is_beside();
        let is_perfect = classes.contains(Class::Act) && classes.contains(Class::Asking);
        let comes_first = classes.contains(Class::Act) && classes.contains(Class::Polite) && !is_perfect;
        let classes = classes.about_commands();
        let (polite, common) = (classes.contains(Class::Polite), common(language.tables(), symbol));
        let share = |known: Option<f32>, new: f32| known.map_or(new, |share| (1.0 - new) * share);
        let cues = [
            Class::Negation,
            Class::Out,
            Class::But,
            Class::All,
            Class::Connective,
            Class::Stop,
            Class::No,
            Class::Pronoun,
            Class::Again,
            Class::Asking,
        ];
        let chatter = match polite {
            true => common.map_or(POLITE, |common| POLITE.max((1.0 - NEW) * common)),
            false if classes.contains_any(&cues) => OTHER_CLOSED,
            false => share(background(language.tables(), symbol), NEW),
        };
        let is_of_task = is_of_task(language.tables(), symbol);
        let is_new = classes == Classes::NONE && !is_toward && !is_beside && !is_article && is_unknown(language, symbol);
        let count = symbol.map_or(0.0, |symbol| count(language.bitext(), symbol) as f32);
        let turns = [Class::Negation, Class::Out, Class::But, Class::All, Class::Connective];
        let factor = if count == 0.0 && classes.contains_any(&turns) { TURNS } else { 1.0 };
        let beside = factor * share(common, if polite { NEW / 2.0 } else { NEW });
        Self {
            said: Said { symbol, chatter },
            classes,
            beside,
            count,
            factor,
            is_new,
            is_mended: false,
            is_toward,
            is_forgetting,
            is_article,
            leaves,
            comes_first,
            is_perfect,
            is_beside,
            is_sign: false,
            piece: 0,
            phrase: 0,
            is_of_task,
            is_name: is_name(language.tables(), symbol),
            is_plural: false,
        }
    }

    /// Replaces a new word of direction ("hasta") by the lessons' own ("a"); `None` for a word of the lessons, or one without direction.
    pub fn as_usual_way(&self, language: LanguageRef<'_>, closed: ClosedWords<'_>) -> Option<Self> {
        let Self { piece, phrase, is_sign, is_toward, classes, factor, .. } = *self;
        let way = Some(usual_way(language, closed).filter(|_| is_toward && is_unknown(language, self.said.symbol) && factor == 1.0)?);
        Some(Self { piece, phrase, is_sign, is_toward, factor: OTHER_WAY, ..Self::new(language, way, classes) })
    }

    /// The word "it" joined to a verb.
    fn joined(language: LanguageRef<'_>) -> Self {
        Self::new(language, None, Classes::of(Class::It).with(Class::Pronoun))
    }

    /// Marks the first word of an utterance: a connective there splits nothing.
    const fn begin(&mut self) {
        if self.classes.contains(Class::Connective) {
            self.factor = 1.0;
        }
    }

    /// Marks a word that says nothing against the command: "if you don't mind", "don't forget to".
    fn excuse(&mut self) {
        self.is_forgetting = false;
        if self.count == 0.0 {
            (self.factor, self.said.chatter, self.classes, self.is_new) = (1.0, POLITE, Classes::of(Class::Polite), false);
        }
    }

    /// Marks a connective among polite words as polite.
    const fn make_polite(&mut self) {
        if self.classes.contains(Class::Connective) && !self.classes.is_before() {
            (self.factor, self.said.chatter, self.classes) = (1.0, POLITE, Classes::of(Class::Polite));
        }
    }

    /// Whether it is heard for the first time, and in no class, even if it was mended.
    pub fn is_strange(&self) -> bool {
        self.is_new || self.is_mended
    }

    /// Whether it is heard for the first time, and no slip for a known word.
    pub fn is_new_word(&self) -> bool {
        self.is_strange() && !self.is_slip()
    }

    /// Whether it is more probable as a slip for a known word than as a new word.
    pub fn is_slip(&self) -> bool {
        self.is_mended && self.factor > 1.0
    }

    /// Whether it neither belongs to a task nor names a value.
    pub const fn is_plain(&self) -> bool {
        !(self.is_new || self.is_of_task || self.is_name)
    }

    /// Whether it may be an act word.
    pub const fn may_act(&self) -> bool {
        self.is_new || self.is_of_task
    }

    /// The same word as a slip for a known one.
    pub fn mended(self, language: LanguageRef<'_>, symbol: Symbol, slip: f32) -> Self {
        let meant = Self::new(language, Some(symbol), Classes::NONE);
        let said = Said { symbol: Some(symbol), chatter: self.said.chatter / slip + meant.said.chatter };
        Self {
            said,
            beside: self.beside + slip * meant.beside,
            count: meant.count,
            factor: slip,
            is_new: false,
            is_mended: true,
            is_of_task: meant.is_of_task,
            is_name: meant.is_name,
            is_plural: false,
            ..self
        }
    }
}

/// The divisor of a reading's prior: 1 plus the largest count of its cues in lessons. Words that commands have are weak cues.
pub(super) fn learned(words: Words<'_>, of: impl Fn(&Heard) -> bool) -> f32 {
    1.0 + words.iter().filter(|word| of(word)).map(|word| word.count).fold(0.0, f32::max)
}

/// The number of occurrences of a word in all lessons.
pub(super) fn count(bitext: BitextRef<'_>, word: Symbol) -> usize {
    (0..bitext.sessions() as u16).map(|session| bitext.sentence(session).iter().filter(|&&other| other == word).count()).sum()
}

impl<M: AgentMemory> Agent<M> {
    /// The words of an utterance, with their classes.
    #[inline(never)]
    pub(super) fn hear_words(&self, utterance: &str, closed: ClosedWords<'_>, words: &mut Utterance) -> Result<(), AgentError> {
        let (sentence, language) = (&self.sentence, self.language.read(self.memory.read().language, self.memory.read().workspace.len()));
        let mut signs: Vec<Option<char>, WORDS_PER_COMMAND> = Vec::new();
        for_each_piece(utterance, |piece| {
            let mut letters = piece.chars();
            let sign = letters.next().filter(|sign| !sign.is_ascii() && letters.next().is_none());
            let _ = signs.push(sign);
            Ok(())
        })?;
        let (mut of_word, mut position) = ((0, Classes::NONE), 0_usize);
        for_each_piece(utterance, |piece| {
            let (elided, piece, is_whole) =
                elided(language, closed, piece).map_or(("", piece, true), |(elided, word)| (elided, word, false));
            // The first word of a command names no thing: "range" in "range le panier" is no slip for "orange". "Alle Stühle" has no verb.
            let is_first = words.iter().all(|word: &Heard| word.classes != Classes::NONE && !word.classes.contains(Class::All));
            // "Chairs" is a plural, not a slip.
            let is_no_name = |symbol: &Symbol| {
                let known = language.words().text(*symbol);
                !(is_name(language.tables(), Some(*symbol)) && is_slip(known, piece) && !piece.starts_with(known))
            };
            let symbol = if is_whole { sentence.get(position).copied().flatten() } else { language.words().find(piece) };
            let symbol = symbol.filter(|symbol| !is_first || is_no_name(symbol));
            if of_word.0 == 0 {
                of_word = closed.of_signs(signs.get(position..).unwrap_or(&[])).unwrap_or((1, closed.of(piece)));
            }
            of_word.0 = usize::saturating_sub(of_word.0, 1);
            let mut heard = Heard::new(language, symbol, of_word.1);
            // German adjectives have the endings of plurals: "grünen".
            let may_be_plural = heard.is_name && piece.ends_with(['s', 'x']);
            heard.is_plural = may_be_plural && symbol.is_some_and(|symbol| is_plural(piece, language.words().text(symbol)));
            let is_cue = heard.is_new && !of_word.1.contains(Class::Act) && slip_for(language, piece, SLIP).is_none();
            let is_behind_verb = words.last().is_some_and(Heard::may_act);
            let left = signs.len().saturating_sub(position);
            let is_sign = signs.get(position).is_some_and(Option::is_some);
            let has_room = words.len().saturating_add(left) < WORDS_PER_COMMAND;
            let parted = verb_before_clitic(language, closed, piece).filter(|_| heard.is_new && has_room);
            // In "y súbela", a new verb.
            let ends_in_it = |piece| has_room && closed.ends(Class::Clitic, piece).any(|verb| verb.len() >= LEAST_VERB);
            let is_joined_verb =
                heard.is_new && words.last().is_some_and(|word| word.classes.contains(Class::Connective)) && ends_in_it(piece);
            let mut add = |word: Heard| {
                let _ = words.push(Heard { piece: position as u8, phrase: phrase(utterance, position), is_sign, ..word });
            };
            let before = closed.of(elided);
            if before != Classes::NONE && has_room {
                add(Heard::new(language, None, before));
            }
            if of_word.1.contains(Class::Clitic) && is_behind_verb && is_joined(utterance, position) {
                add(Heard::joined(language));
            } else if let Some((verb, has_it)) = parted {
                add(Heard::new(language, Some(verb), Classes::NONE));
                if has_it {
                    add(Heard::joined(language));
                }
            } else if is_joined_verb {
                add(heard);
                add(Heard::joined(language));
            } else {
                add(if is_cue { Heard::new(language, symbol, closed.of_slip(piece)) } else { heard });
            }
            position = position.saturating_add(1);
            Ok(())
        })?;
        // In "then go on", no command comes before "then".
        words.iter_mut().take(1).for_each(Heard::begin);
        // "Is the bag here" is a question, even if lessons have "is" elsewhere.
        let begins = |word: Symbol| {
            let bitext = language.bitext();
            (0..bitext.sessions() as u16).any(|session| bitext.sentence(session).first() == Some(&word))
        };
        let asks = |word: &&mut Heard| word.classes.contains(Class::Asking) && !word.said.symbol.is_some_and(begins);
        words.iter_mut().take(1).filter(asks).for_each(|word| word.count = 0.0);
        excuse(words);
        // In "把篮子提到", the new sign is a verb.
        let mut is_named = false;
        for at in 1..words.len() {
            let is_way = words.get(at).is_some_and(|word| word.is_toward && word.is_sign);
            let Some(word) = words.get_mut(at.saturating_sub(1)) else { break };
            if is_way && is_named && word.is_new {
                (word.is_new, word.is_of_task) = (false, true);
            }
            is_named |= word.is_name || word.classes.contains(Class::All);
        }
        Ok(())
    }
}

/// The most frequent word of direction in the lessons.
fn usual_way(language: LanguageRef<'_>, closed: ClosedWords<'_>) -> Option<Symbol> {
    let learned = language.words().iter().take(language.tables().words());
    let leads = |word: &str| closed.of(word).contains(Class::Toward);
    learned.filter(|(_, word)| leads(word)).map(|(symbol, _)| symbol).max_by_key(|&symbol| count(language.bitext(), symbol))
}

/// Excuses the words that put a command into the past: "after you have", "when you've", and the participle.
fn excuse_past(words: &mut [Heard], phrase: u8) {
    let is_perfect = |at: usize| words.get(at).is_some_and(|word| word.is_perfect && word.phrase == phrase);
    let past = (0..words.len()).find(|&at| is_perfect(at));
    let is_participle = |at: usize| past.is_some_and(|past| at.abs_diff(past) == 1);
    for at in 0..words.len() {
        let is_near = is_participle(at);
        if let Some(word) = words.get_mut(at).filter(|word| word.phrase == phrase)
            && (word.classes.contains_any(&[Class::Connective, Class::If, Class::Asking, Class::You]) || is_near && !word.is_of_task)
        {
            word.excuse();
        }
    }
}

/// Excuses words that negate, except or split nothing in their context, and marks words for the present place.
fn excuse(words: &mut [Heard]) {
    // "After you have been to the red room, go to the green room", "when you have put the bag in the red room, go ...".
    let phrase = words.first().map_or(0, |word| word.phrase);
    let in_phrase = |is: &dyn Fn(&Heard) -> bool| words.iter().any(|word| word.phrase == phrase && is(word));
    let begins = words.first().is_some_and(|word| word.classes.contains(Class::Connective) && word.classes.contains(Class::Polite))
        || in_phrase(&|word| word.is_perfect) && in_phrase(&|word| word.classes.contains(Class::If));
    if begins && in_phrase(&|word| word.is_name) && words.iter().any(|word| word.is_name && word.phrase != phrase) {
        excuse_past(words, phrase);
    }
    // In "be so kind and go", no command comes before "and".
    let polite = [Class::Polite, Class::Greeting, Class::Connective];
    for word in words.iter_mut() {
        if !word.classes.contains_any(&polite) {
            break;
        }
        word.make_polite();
    }
    let mut spoken_to = 0;
    let (mut is_from, mut is_past, mut is_out, mut is_named) = (false, false, false, false);
    for at in (0..words.len()).rev() {
        let Some(word) = words.get_mut(at) else { continue };
        let is_of = |class| word.classes.contains(class);
        spoken_to = if is_of(Class::You) { at } else { spoken_to };
        // "Away" is a cue only before "from", not in "right away". "But" in "sorry, but could you go" excepts nothing.
        let is_away = is_of(Class::Out) && is_of(Class::Polite) && !is_from;
        let is_sorry = is_of(Class::But) && !is_of(Class::All) && at < spoken_to && spoken_to <= at.saturating_add(SPOKEN_TO);
        // "After that" introduces the next command, "after taking" an earlier one.
        let is_after = is_of(Class::Connective) && is_of(Class::Polite) && is_past;
        is_from = is_of(Class::From);
        is_past = is_from || is_of(Class::You) || word.is_perfect || word.is_new;
        is_out |= is_of(Class::Out) && !is_away && !word.leaves;
        is_named |= word.is_name;
        if is_away || is_sorry || is_after {
            word.excuse();
        }
        if is_after && is_named && words.iter().take(at).any(|word| word.is_name) {
            let behind = words.iter_mut().skip(at);
            behind.enumerate().for_each(|(at, word)| (word.phrase, word.comes_first) = (word.phrase.saturating_add(1), at == 0));
            let phrase = words.get(at).map_or(0, |word| word.phrase);
            excuse_past(words, phrase);
        }
    }
    let (mut case, mut reach, mut stays, mut is_where, mut is_forgetting, mut is_not) = (0, 0, false, false, false, false);
    for at in 0..words.len() {
        let behind = at.saturating_add(1);
        let acts = words.iter().skip(behind).any(|word| word.is_of_task);
        let asks_behind = words.get(behind).is_some_and(|word| word.classes.contains(Class::Asking));
        let Some(word) = words.get_mut(at) else { break };
        let is_of = |class| word.classes.contains(class);
        let (forgets, negates) = (word.is_forgetting, is_of(Class::Negation));
        // After a word such as "stay" or "leave", "where it is" means here.
        stays |= word.leaves || is_of(Class::Here);
        is_where |= stays && is_of(Class::Asking);
        // "If you don't mind" negates no command, nor does "si ça ne te dérange pas" with two negations. "If I don't" and "tomorrow don't"
        // may.
        if is_of(Class::If) {
            (case, reach) = (at, behind.saturating_add(NEGATES_A_CONDITION));
        } else if is_of(Class::Speaker) || word.classes == Classes::NONE && !word.is_new {
            reach = 0;
        }
        let is_polite = negates && (case.saturating_add(1) < at || case < at && asks_behind) && at < reach;
        if is_out && is_named {
            // "Stay out of the red room" is about another place than here, "get out of here" is not.
            word.classes = word.classes.without(Class::Here);
        } else if is_where && word.classes.contains_any(&[Class::Asking, Class::Pronoun, Class::You]) {
            word.classes = Classes::of(Class::Here);
        }
        // "Don't forget to go" asks to go.
        let asks = acts && (forgets && is_not || negates && is_forgetting);
        (is_forgetting, is_not) = (forgets, negates);
        let excused = match () {
            () if is_polite => case..behind.saturating_add(1),
            () if asks => at.saturating_sub(1)..behind,
            () => 0..0,
        };
        reach = if is_polite { behind.saturating_add(NEGATES_A_CONDITION) } else { reach };
        words.iter_mut().take(excused.end).skip(excused.start).for_each(Heard::excuse);
    }
}

/// The number of punctuation marks between phrases before a piece of an utterance.
fn phrase(utterance: &str, piece: usize) -> u8 {
    let before = start_of_piece(utterance, piece).and_then(|start| utterance.get(..start)).unwrap_or("");
    let parts = |letter: &char| matches!(letter, ',' | '.' | ';' | ':' | '!' | '?' | '…' | '，' | '。' | '；' | '！' | '？' | '、');
    before.chars().filter(parts).count() as u8
}

/// Whether a hyphen joins a piece of an utterance to the previous one.
fn is_joined(utterance: &str, piece: usize) -> bool {
    start_of_piece(utterance, piece)
        .and_then(|start| utterance.get(..start))
        .is_some_and(|before| before.ends_with(['-', '\u{2010}', '\u{2011}']))
}

/// The word after an elided one, and the elided one before it: "d" and "aller" of "d'aller". The longer part is the word: "you" in "you're".
pub(super) fn elided<'p>(language: LanguageRef<'_>, closed: ClosedWords<'_>, piece: &'p str) -> Option<(&'p str, &'p str)> {
    let (front, Some(back)) = cut(piece, b'\'') else { return None };
    let is_known = closed.of(piece) != Classes::NONE || !is_unknown(language, language.words().find(piece));
    let parts = if front.len() < back.len() { (front, back) } else { (back, front) };
    (!is_known).then_some(parts)
}

/// Whether no lesson had a word.
fn is_unknown(language: LanguageRef<'_>, symbol: Option<Symbol>) -> bool {
    symbol.is_none_or(|symbol| symbol.index() >= language.tables().words())
}

/// The verb in a word that ends in a pronoun, and whether that is "it": "llévalo" is "lleva" and "lo", "llévame" is "lleva". Accents do not
/// count.
fn verb_before_clitic(language: LanguageRef<'_>, closed: ClosedWords<'_>, word: &str) -> Option<(Symbol, bool)> {
    let plain = |letter: char| match letter {
        'á' => 'a',
        'é' => 'e',
        'í' => 'i',
        'ó' => 'o',
        'ú' => 'u',
        other => other,
    };
    let known = |verb: &str| {
        let is_verb = |known: &str| known.chars().map(plain).eq(verb.chars().map(plain));
        let (symbol, _) = language.words().iter().take(language.tables().words()).find(|&(_, known)| is_verb(known))?;
        is_of_task(language.tables(), Some(symbol)).then_some(symbol)
    };
    let before_polite = |front: &str| closed.ends(Class::Polite, front).find_map(known);
    let with_it = closed.ends(Class::Clitic, word).find_map(|front| known(front).or_else(|| before_polite(front)));
    with_it.map(|verb| (verb, true)).or_else(|| Some((before_polite(word)?, false)))
}
