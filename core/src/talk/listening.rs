//! The hypotheses of what an utterance is, and the verdict.

use super::classes::{Class, Classes, ClosedWords};
use super::readings::{Parting, all, has_more, may_turn, negated};
use super::recalled::{Before, Recalled};
use crate::capacity::{CapacityError, LIFTED_TASKS, WORDS_PER_COMMAND};
use crate::language::bitext::BitextRef;
use crate::language::roles::kind;
use crate::language::roles::talk::{Coverage, Named, Said, Senses, background, common, is_name, is_of_task, likelihood};
use crate::language::spelling::{is_slip, is_slip_of_any_length};
use crate::language::tokenizer::{first_words, start_of_piece};
use crate::language::{LanguageRef, Model, for_each_piece};
use crate::memory::{AgentMemory, AgentTables};
use crate::oomdp::Domain;
use crate::planning::Progress;
use crate::probability::{Scaled, total};
use crate::session::phase::Progressed;
use crate::session::{Agent, AgentError};
use crate::symbols::Symbol;
use crate::task::description::{describe, form, groups};
use crate::task::grounded::share_with_done;
use crate::task::machine_command::Tokens;
use crate::task::role::RoleKind;
use crate::task::{GroundedTask, TaskSet};
use core::fmt;
use heapless::Vec;

/// How probable each hypothesis is before any word; a plain command has the rest.
const NOTHING: f32 = 0.15;
const ABSENT: f32 = 0.05;
const ABOUT: f32 = 0.05;
pub(super) const NEGATED: f32 = 0.1;
pub(super) const SEVERAL: f32 = 0.05;
pub(super) const ALL: f32 = 0.03;
const TALK: f32 = 0.02;
/// How probable the opposite of a command is where a new word may turn it round: as probable as the command.
const REVERSED: f32 = 1.0 - NOTHING - ABSENT - ABOUT - SEVERAL;
/// The weight of "again" where something was done before, in no unit.
const AGAIN: f32 = 1.0;
/// The share of each kind of task that is for tasks that are done already.
const DONE: f32 = 0.03;
/// How often a thing that is there already is meant, where all are to be brought.
const NOT_MEANT: f32 = 1e-4;
/// How probable a word that was never heard is where no task is meant, and beside a command.
const NEW: f32 = 0.5;
/// How probable a polite word is beside a command, and another word of a closed class.
const POLITE: f32 = 0.6;
const OTHER_CLOSED: f32 = 1e-3;
/// How probable a word is as a cue of a negation, of several commands or of all things.
pub(super) const CUE: f32 = 0.15;
/// How much less probable a word is that turns commands round, or parts them, where it does not, as long as no command had it.
const TURNS: f32 = 0.01;
/// How often a word is mistyped, alone and beside another that is.
const SLIP: f32 = 0.02;
const ANOTHER_SLIP: f32 = 0.15;
/// How probable each letter of a word is that was never heard, and the word before its letters.
const LETTER: f32 = 1.0 / 12.0;
const NEW_SPELLING: f32 = 0.2;
/// The factor of tasks of another kind than that of the command before, where no word tells the kind.
const OTHER_KIND: f32 = 0.05;
/// How much more probable a task must be after few lessons, times their number.
const SURE_OF_FEW: f32 = 2.4;
/// A sentence with more new words is not a command in another's words.
const MOST_NEW: usize = 2;
/// So many letters a plural has more.
const LONGEST_ENDING: usize = 2;
/// Not sure if a done task of the same kind explains the words a fifth as well.
const RIVAL: f32 = 5.0;

/// What an utterance is taken for.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[non_exhaustive]
pub enum Hypothesis {
    /// A command for one task.
    Command,
    /// None of what the robot can do.
    Nothing,
    /// A command about a thing that is not here.
    Absent,
    /// Words about a thing, with no word of a task.
    About,
    /// A command the other way round: what shall not be.
    Negated,
    /// Perhaps the opposite of a command: a word was never heard, and no table says that it does not turn the command round.
    Reversed,
    /// Several commands.
    Several,
    /// A command for all things of a class.
    All,
    /// The task of before once more.
    Again,
    /// Words of a closed class: praise, stop, a greeting ...
    Talk(Class),
}

impl fmt::Display for Hypothesis {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Command => "a command",
            Self::Nothing => "nothing that I can do",
            Self::Absent => "a thing that is not here",
            Self::About => "a thing, but not what to do with it",
            Self::Negated => "what shall not be",
            Self::Reversed => "perhaps the opposite of a command",
            Self::Several => "several commands",
            Self::All => "all things of a kind",
            Self::Again => "the same again",
            Self::Talk(class) => class.name(),
        })
    }
}

/// What comes of an utterance.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum Verdict {
    /// The most likely task is meant.
    Sure,
    /// It is not sure which task is meant.
    Unsure,
    /// The most likely task is meant, and is done already.
    Done,
    /// None of what the robot can do here is meant.
    None,
}

/// What [`Agent::listen`] makes of an utterance.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct Listened {
    /// What comes of it.
    pub verdict: Verdict,
    /// What the utterance is most likely taken for.
    pub hypothesis: Hypothesis,
    /// The most likely task of the session, by its position. Where the utterance says what shall not be, the session's tasks are
    /// [negated](crate::task::GroundedTask::is_negated).
    pub task: usize,
    /// All tasks that are meant. They are several where the utterance is about all things of a kind: one for each thing that is not yet where
    /// it is to be, or, where all are, one for each.
    pub tasks: TaskSet,
    /// How probable it is that these tasks are meant, from 0 to 1.
    pub probability: f32,
    /// How probable it is that one of the session's tasks is meant, from 0 to 1.
    pub command: f32,
    /// How probable tasks must be to be sure of them; several commands together.
    pub sure: f32,
    /// Where the rest of the utterance begins, in bytes, if it has several commands. The session is about the first. The rest is for
    /// [`Agent::listen_on`], in the state that the first leads to.
    pub rest: Option<usize>,
    /// Where the words begin, in bytes, that were not read: those beyond [`WORDS_PER_COMMAND`]. The answer is then never sure, unless the rest
    /// has them.
    pub unread: Option<usize>,
}

/// What the caller does between two parts of the work; `false` stops it.
pub(super) type Pause<'p> = &'p dyn Fn() -> bool;

/// Table cells of work, at most about, between two pauses of a robot that takes everything for a command.
const PART: u32 = 1_000;

pub(super) fn rest(pause: Pause<'_>) -> Result<(), AgentError> {
    if pause() { Ok(()) } else { Err(AgentError::Stopped) }
}

/// How commands are worded, as far as was learned.
pub(super) struct Wording<'c> {
    closed: ClosedWords<'c>,
    pause: Pause<'c>,
    coverage: Coverage,
    /// How probable a new word is in a command.
    new: f32,
    /// One by one more than the words of a command, on average: how probable its end is after each word.
    end: f32,
    /// How probable the most likely task must be.
    sure: f32,
    /// The sort of derived facts in descriptions.
    facts: u8,
}

impl<'c> Wording<'c> {
    pub(super) fn of(language: LanguageRef<'_>, closed: ClosedWords<'c>, facts: u8, pause: Pause<'c>) -> Self {
        let (bitext, words) = (language.bitext(), language.tables().words());
        let is_plain = |word| is_plain(language, closed, word);
        let coverage = Coverage::of(&mut Senses::new(language.tables(), bitext, &is_plain, facts));
        let sessions = bitext.sessions();
        let sentences = || (0..sessions as u16).map(|session| bitext.sentence(session));
        let all = sentences().map(<[Symbol]>::len).sum::<usize>() as f32;
        let count = |word: usize| count(bitext, Symbol(word as u16));
        let once = (0..words).filter(|&word| count(word) == 1).count() as f32;
        let sessions = sessions.max(1) as f32;
        Self {
            closed,
            pause,
            coverage,
            // Good and Turing's estimate; at first every word is new.
            new: (once + 2.0) / (all + 2.0),
            end: 1.0 / (1.0 + all / sessions),
            // 0.7 after 24 lessons, 0.62 after 120.
            sure: (0.6 + SURE_OF_FEW / sessions).min(0.95),
            facts,
        }
    }
}

/// Whether a word speaks of no task, whatever lessons say.
fn is_plain(language: LanguageRef<'_>, closed: ClosedWords<'_>, word: Symbol) -> bool {
    closed.of(language.words().text(word)).contains_any(&[Class::Polite, Class::Connective, Class::All])
}

/// How often a word was said in all lessons.
fn count(bitext: BitextRef<'_>, word: Symbol) -> usize {
    (0..bitext.sessions() as u16).map(|session| bitext.sentence(session).iter().filter(|&&other| other == word).count()).sum()
}

/// One word, with its classes.
#[derive(Clone, Copy)]
pub(super) struct Heard {
    said: Said,
    pub classes: Classes,
    /// How probable it is where no task is meant.
    beside: f32,
    /// How often it was said in commands.
    pub count: f32,
    /// How much less probable it is in a command than its reading says: its spelling as a slip for the word that it is taken for, against that
    /// of a word never heard; or a word that turns commands round or parts them, which no command had yet. 1 for any other word.
    factor: f32,
    is_new: bool,
    is_mended: bool,
    /// Whether it tells where a way leads, as "to" does.
    is_toward: bool,
    /// The piece of the utterance that it is of, from 0.
    piece: u8,
    /// Whether it is of some task sooner than of the background.
    is_of_task: bool,
    /// Whether it names a value.
    is_name: bool,
}

/// The words of an utterance.
pub(super) type Utterance = Vec<Heard, WORDS_PER_COMMAND>;

/// Some of the words of an utterance, in their order: one bit each, so that a reading takes no room for words.
#[derive(Clone, Copy)]
pub(super) struct Words<'w> {
    all: &'w [Heard],
    kept: u64,
}

const _: () = assert!(WORDS_PER_COMMAND <= u64::BITS as usize);

impl<'w> Words<'w> {
    /// No word.
    pub const NONE: Self = Self { all: &[], kept: 0 };

    pub const fn new(all: &'w [Heard]) -> Self {
        Self { all, kept: u64::MAX }
    }

    pub fn iter(self) -> impl Iterator<Item = &'w Heard> + Clone {
        self.all.iter().enumerate().filter(move |(at, _)| self.kept >> at & 1 == 1).map(|(_, word)| word)
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

    /// Those that are wanted; each is asked for once, in order.
    pub fn only(self, mut is_wanted: impl FnMut(&Heard) -> bool) -> Self {
        let bits = self.all.iter().enumerate().filter(|(at, word)| self.kept >> at & 1 == 1 && is_wanted(word));
        Self { kept: bits.fold(0, |bits, (at, _)| bits | 1 << at), ..self }
    }

    /// Those from a position up to another.
    pub fn part(self, begin: usize, end: usize) -> Self {
        let mut at = 0_usize;
        self.only(|_| {
            at = at.saturating_add(1);
            begin < at && at <= end
        })
    }
}

/// The known word that a word never heard is most probably a slip for, and how probable its spelling is then, against that of a new word.
fn slip_for(language: LanguageRef<'_>, piece: &str, rate: f32) -> Option<(Symbol, f32)> {
    let letters = piece.chars().count();
    let spelling = (0..letters).fold(NEW_SPELLING, |product, _| product * LETTER);
    let mut best: Option<(Symbol, f32)> = None;
    for position in 0..language.tables().words() {
        let (symbol, known) = (Symbol(position as u16), language.words().text(Symbol(position as u16)));
        let length = known.chars().count();
        if length < 2 || !(is_slip_of_any_length(piece, known) || is_plural(piece, known)) {
            continue;
        }
        // So many slips of a word there are: an exchange, a letter left out, put in or taken for another.
        let slips = 54.0 * length as f32 + 25.0;
        let probability = rate / slips / spelling;
        if best.is_none_or(|(_, most)| probability > most) {
            best = Some((symbol, probability));
        }
    }
    best
}

/// Whether a word is the plural of another, as in German: Stühle, Stuhl.
fn is_plural(piece: &str, known: &str) -> bool {
    let plain = |letter: char| match letter {
        'ä' => 'a',
        'ö' => 'o',
        'ü' => 'u',
        other => other,
    };
    let mut rest = piece.chars().map(plain);
    known.chars().map(plain).all(|letter| rest.next() == Some(letter)) && rest.count() <= LONGEST_ENDING
}

impl Heard {
    pub(super) fn new(language: LanguageRef<'_>, symbol: Option<Symbol>, classes: Classes) -> Self {
        let is_toward = classes.contains(Class::Toward);
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
        let is_new = classes == Classes::NONE && !is_toward && symbol.is_none_or(|symbol| symbol.index() >= language.tables().words());
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
            piece: 0,
            is_of_task,
            is_name: is_name(language.tables(), symbol),
        }
    }

    /// "It" in a verb that it is joined to.
    fn joined(language: LanguageRef<'_>) -> Self {
        Self::new(language, None, Classes::of(Class::It).with(Class::Pronoun))
    }

    /// Nothing stands before it.
    const fn begin(&mut self) {
        if self.classes.contains(Class::Connective) {
            self.factor = 1.0;
        }
    }

    /// It stands among polite words alone.
    const fn make_polite(&mut self) {
        if self.classes.contains(Class::Connective) {
            (self.factor, self.said.chatter, self.classes) = (1.0, POLITE, Classes::of(Class::Polite));
        }
    }

    /// Whether it was heard for the first time, and is in no class, whatever it was mended to.
    pub fn is_strange(&self) -> bool {
        self.is_new || self.is_mended
    }

    /// Whether it is more probable as a slip for a known word than as a new word.
    pub fn is_slip(&self) -> bool {
        self.is_mended && self.factor > 1.0
    }

    /// Whether it says nothing of a task, nor names a value.
    pub const fn is_plain(&self) -> bool {
        !(self.is_new || self.is_of_task || self.is_name)
    }

    /// How probable it is where no task is meant.
    pub const fn beside(&self) -> f32 {
        self.beside
    }

    /// Whether it may be the word of a task.
    pub const fn may_act(&self) -> bool {
        self.is_new || self.is_of_task
    }

    /// Whether it was heard for the first time, and is in no class.
    pub const fn is_new(&self) -> bool {
        self.is_new
    }

    /// The same word as a slip for a known one.
    fn mended(self, language: LanguageRef<'_>, symbol: Symbol, slip: f32) -> Self {
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
            ..self
        }
    }
}

/// Mends slips of the pen; gives whether there are any. Who types in haste does so for a sentence.
fn mend(language: LanguageRef<'_>, utterance: &str, words: &Utterance, mended: &mut Utterance) -> Result<bool, CapacityError> {
    let mut slips = 0_usize;
    mended.clone_from(words);
    for rate in [SLIP, ANOTHER_SLIP] {
        let mut position = 0_usize;
        // Nor is the first word a slip for the name of a thing here.
        let first = words.iter().position(|word| word.classes == Classes::NONE);
        for_each_piece(utterance, |piece| {
            let at = words.iter().position(|word| usize::from(word.piece) == position && word.is_new());
            let word = at.and_then(|at| words.get(at));
            if let (Some(word), Some(slot)) = (word, at.and_then(|at| mended.get_mut(at)))
                && let Some((symbol, slip)) = slip_for(language, piece, rate)
                && (rate == SLIP || slips > 1)
                && !(at == first && is_name(language.tables(), Some(symbol)))
            {
                slips = slips.saturating_add(usize::from(rate == SLIP));
                *slot = word.mended(language, symbol, slip);
            }
            position = position.saturating_add(1);
            Ok(())
        })?;
    }
    Ok(slips > 0)
}

/// A word that was learned speaks for what was learned.
pub(super) fn learned(words: Words<'_>, of: impl Fn(&Heard) -> bool) -> f32 {
    1.0 + words.iter().filter(|word| of(word)).map(|word| word.count).fold(0.0, f32::max)
}

/// How some words are read.
#[derive(Clone, Copy)]
pub(super) struct View<'c> {
    /// The share of the tasks that hold already.
    pub done: f32,
    /// Whether another word is the sign of a task.
    pub has_act: bool,
    /// The kind of task that the command before was of: a command without a word of its own for that is most probably of the same.
    pub kind: Option<u8>,
    /// What words can point back at.
    pub before: Before<'c>,
}

impl View<'_> {
    /// As a command.
    pub const PLAIN: Self = Self { done: DONE, has_act: false, kind: None, before: Before::Nothing };
}

/// How well the tasks here explain some words.
pub(super) struct Explained {
    /// Pr(words) where one of the tasks is meant.
    pub here: Scaled,
    /// Pr(words) where a thing is meant that is not here.
    pub absent: Scaled,
    /// Pr(words | t) of each task, with its coverage.
    pub likelihoods: Vec<Scaled, { TaskSet::MOST }>,
    /// Each task's share of the belief, in no unit.
    pub weights: Vec<Scaled, { TaskSet::MOST }>,
    /// The tasks of whose kind a word is a sign.
    pub signed: TaskSet,
    /// The tasks of which a word names the place, and no word anything that they are not about.
    pub fitting: TaskSet,
    /// The tasks that no word names another thing than.
    own: TaskSet,
    /// The tasks of which all is named.
    whole: TaskSet,
    /// Whether a word is a sign of a kind of task.
    pub acts: bool,
    /// Whether a new word stands where commands have the word of their task.
    pub has_new_verb: bool,
    /// Whether other words point back.
    pub points_back: bool,
    /// The share of the tasks that hold already.
    done: f32,
}

impl Explained {
    pub const NEW: Self = Self {
        here: Scaled::ZERO,
        absent: Scaled::ZERO,
        likelihoods: Vec::new(),
        weights: Vec::new(),
        signed: TaskSet::EMPTY,
        fitting: TaskSet::EMPTY,
        own: TaskSet::EMPTY,
        whole: TaskSet::EMPTY,
        acts: false,
        has_new_verb: false,
        points_back: false,
        done: DONE,
    };

    /// The most likely task, with its probability.
    pub fn best(&self) -> (usize, f32) {
        let whole = total(self.weights.iter().copied());
        let mut best = (0, Scaled::ZERO);
        for (task, &weight) in self.weights.iter().enumerate() {
            if weight.exceeds(best.1) {
                best = (task, weight);
            }
        }
        (best.0, best.1.over(whole))
    }
}

/// What some words are taken for.
struct Judged<'w> {
    hypothesis: Hypothesis,
    /// The words that name the tasks.
    words: Words<'w>,
    task: usize,
    tasks: TaskSet,
    probability: f32,
    command: f32,
    /// Whether nothing but the probability stands against the tasks.
    is_clear: bool,
    /// Where the rest begins, in pieces of the utterance.
    rest: Option<usize>,
}

impl Judged<'_> {
    /// The task of before once more. No word of the utterance is a word for it.
    const fn again(task: usize, probability: f32) -> Self {
        let (hypothesis, words, tasks) = (Hypothesis::Again, Words::NONE, TaskSet::of(task));
        Self { hypothesis, words, task, tasks, probability, command: probability, is_clear: true, rest: None }
    }
}

/// Where words stand in an utterance.
#[derive(Clone, Copy)]
pub(super) struct Place<'c> {
    /// Whether a command is before them. The task's own word may then be left out.
    pub is_rest: bool,
    /// The kind of task that it was of.
    kind: Option<u8>,
    /// What words can point back at.
    before: Before<'c>,
}

impl<'c> Place<'c> {
    const WHOLE: Self = Self { is_rest: false, kind: None, before: Before::Nothing };

    /// Whether something was done before.
    const fn is_known(self) -> bool {
        matches!(self.before, Before::Known(_))
    }

    /// Behind another part of the same utterance.
    pub const fn behind(self) -> Self {
        Self { is_rest: true, before: Before::Open, ..self }
    }

    /// How what is read so is read here, whatever kind of task the command before was of.
    pub const fn of_any_kind(self, view: View<'_>) -> View<'c> {
        Self { kind: None, ..self }.view(view)
    }

    /// How what is read so is read here.
    pub const fn view(self, view: View<'_>) -> View<'c> {
        View { done: view.done, has_act: view.has_act || self.is_rest, kind: self.kind, before: self.before }
    }
}

impl<M: AgentMemory> Agent<M> {
    /// Hears an utterance that may be no command, in the state that the session starts from, and says what it takes it for. `words` are the
    /// closed classes of the language that is spoken. The session's tasks are those that are possible here and, with a small share, those
    /// that are done already. An untrained robot takes everything for a command, and so does one of Model 2.
    ///
    /// # Errors
    /// As [`hear`](Self::hear).
    pub fn listen<D: Domain + ?Sized>(
        &mut self,
        domain: &D,
        state: &D::State,
        utterance: &str,
        words: ClosedWords<'_>,
    ) -> Result<Listened, AgentError> {
        self.listen_in_parts(domain, state, utterance, words, false, &|| true)
    }

    /// As [`listen`](Self::listen), or, where `is_rest`, as [`listen_on`](Self::listen_on), with a pause before each part of the work: before each
    /// task that is compared with the words. `pause` is where a controller does its other work, feeds its watchdog, or looks at the clock. The
    /// result is the same to the bit. Where `pause` gives `false`, the robot stops listening.
    ///
    /// # Errors
    /// As [`hear`](Self::hear), and [`AgentError::Stopped`]: no session is then under way.
    pub fn listen_in_parts<D: Domain + ?Sized>(
        &mut self,
        domain: &D,
        state: &D::State,
        utterance: &str,
        words: ClosedWords<'_>,
        is_rest: bool,
        pause: &dyn Fn() -> bool,
    ) -> Result<Listened, AgentError> {
        let mut conversation = self.conversation.here(domain);
        if !is_rest {
            return self.listen_to(domain, state, utterance, words, Place { before: conversation.before(), ..Place::WHOLE }, pause);
        }
        // Words of this part may point at the part before.
        let (part, start) = (self.most_likely().map(|task| self.task(task)), self.started_from(domain));
        let kind = part.map(|part| part.lifted);
        if let Some((part, start)) = part.zip(start) {
            conversation = conversation.after(domain, &self.lifted, &start, &part);
        }
        self.listen_to(domain, state, utterance, words, Place { is_rest, kind, before: conversation.before() }, pause)
    }

    /// Hears the rest of an utterance of several commands, from [`Listened::rest`] on, in the state that the part before leads to. A command
    /// may leave out a word that the part before has: "and then to the red room".
    ///
    /// # Errors
    /// As [`hear`](Self::hear).
    pub fn listen_on<D: Domain + ?Sized>(
        &mut self,
        domain: &D,
        state: &D::State,
        rest: &str,
        words: ClosedWords<'_>,
    ) -> Result<Listened, AgentError> {
        self.listen_in_parts(domain, state, rest, words, true, &|| true)
    }

    /// As [`listen_on`](Self::listen_on), for who knows from a record which lifted task the part before was about, by its position. Words that
    /// point back mean what was [remembered](Self::remember).
    ///
    /// # Errors
    /// As [`hear`](Self::hear).
    pub fn listen_after<D: Domain + ?Sized>(
        &mut self,
        domain: &D,
        state: &D::State,
        rest: &str,
        words: ClosedWords<'_>,
        kind: Option<u8>,
    ) -> Result<Listened, AgentError> {
        let conversation = self.conversation.here(domain);
        let place = Place { is_rest: true, kind, before: conversation.before() };
        self.listen_to(domain, state, rest, words, place, &|| true)
    }

    fn listen_to<D: Domain + ?Sized>(
        &mut self,
        domain: &D,
        state: &D::State,
        utterance: &str,
        words: ClosedWords<'_>,
        place: Place<'_>,
        pause: Pause<'_>,
    ) -> Result<Listened, AgentError> {
        let read = first_words(utterance);
        let unread = Some(read.len()).filter(|&end| end < utterance.len());
        self.open(domain, state, read, DONE)?;
        if self.options.language.model.in_use() != Model::Roles || self.language().tables().words() == 0 {
            self.begin_to_understand(domain)?;
            while self.hear_on(domain, PART)? == Progress::Working {
                rest(pause).inspect_err(|_| self.leave())?;
            }
            let task = self.most_likely().unwrap_or(0);
            let (hypothesis, probability) = (Hypothesis::Command, self.belief().probability(task));
            let tasks = TaskSet::of(task);
            let (verdict, command, sure) = (Verdict::Unsure, 1.0, 1.0);
            return Ok(Listened { verdict, hypothesis, task, tasks, probability, command, sure, rest: None, unread });
        }
        let result = self.listen_here(domain, read, words, place, unread, pause);
        if result.is_err() {
            (self.start, self.progressed) = (None, Progressed::Idle);
        }
        result
    }

    fn listen_here<D: Domain + ?Sized>(
        &mut self,
        domain: &D,
        utterance: &str,
        closed: ClosedWords<'_>,
        place: Place<'_>,
        unread: Option<usize>,
        pause: Pause<'_>,
    ) -> Result<Listened, AgentError> {
        self.begin_to_understand(domain)?;
        let (mut words, mut mended): (Utterance, Utterance) = (Vec::new(), Vec::new());
        self.hear_words(utterance, closed, &mut words)?;
        let language = self.language();
        let wording = Wording::of(language, closed, (domain.world().schema.attributes.len() << 1) as u8, pause);
        let has_slips = mend(language, utterance, &words, &mut mended)?;
        let (mut words, mut explained) = (Words::new(&words), Explained::NEW);
        self.explain_all(domain, words, &wording, place.view(View::PLAIN), &mut explained)?;
        if has_slips {
            let here = explained.here;
            self.explain_all(domain, Words::new(&mended), &wording, place.view(View::PLAIN), &mut explained)?;
            if explained.here.exceeds(here) {
                words = Words::new(&mended);
            } else {
                // Once more, not kept: two explanations would take a controller's stack.
                self.explain_all(domain, words, &wording, place.view(View::PLAIN), &mut explained)?;
            }
        }
        let judged = self.judge(domain, words, &mut explained, &wording, place)?;
        let done = self.done(domain);
        let is_done = !judged.tasks.is_empty() && judged.tasks.without(done).is_empty();
        let verdict = if judged.probability >= wording.sure && judged.is_clear && (unread.is_none() || judged.rest.is_some()) {
            if is_done { Verdict::Done } else { Verdict::Sure }
        } else {
            match judged.hypothesis {
                Hypothesis::Nothing | Hypothesis::Absent | Hypothesis::Talk(_) => Verdict::None,
                _ => Verdict::Unsure,
            }
        };
        self.believe(domain, judged.words, &explained)?;
        let Judged { hypothesis, task, probability, command, .. } = judged;
        let tasks = if is_done { judged.tasks } else { judged.tasks.without(done) };
        let rest = judged.rest.and_then(|rest| start_of_piece(utterance, rest));
        Ok(Listened { verdict, hypothesis, task, tasks, probability, command, sure: wording.sure, rest, unread })
    }

    /// The words of an utterance, with their classes.
    #[inline(never)]
    fn hear_words(&self, utterance: &str, closed: ClosedWords<'_>, words: &mut Utterance) -> Result<(), AgentError> {
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
            // A command begins with the name of no thing: "range le panier" has no slip for "orange".
            let is_first = words.iter().all(|word: &Heard| word.classes != Classes::NONE);
            let is_no_name =
                |symbol: &Symbol| !(is_name(language.tables(), Some(*symbol)) && is_slip(language.words().text(*symbol), piece));
            let symbol = sentence.get(position).copied().flatten().filter(|symbol| !is_first || is_no_name(symbol));
            if of_word.0 == 0 {
                of_word = closed.of_signs(signs.get(position..).unwrap_or(&[])).unwrap_or((1, closed.of(piece)));
            }
            of_word.0 = usize::saturating_sub(of_word.0, 1);
            let heard = Heard::new(language, symbol, of_word.1);
            let is_cue = heard.is_new() && !of_word.1.contains(Class::Act) && slip_for(language, piece, SLIP).is_none();
            let is_behind_verb = words.last().is_some_and(|word: &Heard| word.is_of_task);
            let left = signs.len().saturating_sub(position);
            let has_room = words.len().saturating_add(left) < WORDS_PER_COMMAND;
            let parted = verb_before_clitic(language, closed, piece).filter(|_| heard.is_new() && has_room);
            let mut add = |word: Heard| {
                let _ = words.push(Heard { piece: position as u8, ..word });
            };
            if of_word.1.contains(Class::Clitic) && is_behind_verb && is_joined(utterance, position) {
                add(Heard::joined(language));
            } else if let Some(verb) = parted {
                add(Heard::new(language, Some(verb), Classes::NONE));
                add(Heard::joined(language));
            } else {
                add(if is_cue { Heard::new(language, symbol, closed.of_slip(piece)) } else { heard });
            }
            position = position.saturating_add(1);
            Ok(())
        })?;
        // "Then go on" has nothing before it.
        words.iter_mut().take(1).for_each(Heard::begin);
        // "Be so kind and go" has no command before it.
        let polite = [Class::Polite, Class::Greeting, Class::Connective];
        let begin = words.iter().take_while(|word| word.classes.contains_any(&polite)).count();
        words.iter_mut().take(begin).for_each(Heard::make_polite);
        Ok(())
    }

    /// Whether a task that is done explains the words nearly as well as the one that is to be done.
    fn has_rival<D: Domain + ?Sized>(&self, domain: &D, explained: &Explained, task: usize) -> bool {
        let done = self.done(domain);
        let likelihood = |task: usize| explained.likelihoods.get(task).copied().unwrap_or(Scaled::ZERO);
        let is_rival = |other: usize| {
            self.task(other).lifted == self.task(task).lifted && likelihood(other).scaled_by(RIVAL).exceeds(likelihood(task))
        };
        !done.contains(task) && done.iter().any(is_rival)
    }

    /// What words are taken for, and the tasks that they then mean. What explains them is left in `explained`.
    #[inline(never)]
    fn judge<'w, D: Domain + ?Sized>(
        &mut self,
        domain: &D,
        words: Words<'w>,
        explained: &mut Explained,
        wording: &Wording<'_>,
        place: Place<'_>,
    ) -> Result<Judged<'w>, AgentError> {
        let parting = self.part(domain, words, wording, place)?;
        let (best, share, command) = self.hypotheses(domain, words, wording, explained, place, parting)?;
        let (Hypothesis::Several, Some(parting)) = (best, parting) else {
            return self.judge_one(domain, words, explained, wording, place, (best, share, command));
        };
        let first = words.part(0, parting.end);
        self.explain_all(domain, first, wording, place.view(View::PLAIN), explained)?;
        let taken = self.hypotheses(domain, first, wording, explained, place, None)?;
        let part = self.judge_one(domain, first, explained, wording, place, taken)?;
        let (probability, command) = (share * part.probability, share * part.command);
        let rest = words.get(parting.begin).map(|word| usize::from(word.piece));
        Ok(Judged { hypothesis: best, probability, command, rest, ..part })
    }

    /// The tasks that words mean that are no several commands. `taken` is what they are taken for, how probable that is, and how probable a
    /// plain command is.
    #[inline(never)]
    fn judge_one<'w, D: Domain + ?Sized>(
        &mut self,
        domain: &D,
        words: Words<'w>,
        explained: &mut Explained,
        wording: &Wording<'_>,
        place: Place<'_>,
        (hypothesis, share, command): (Hypothesis, f32, f32),
    ) -> Result<Judged<'w>, AgentError> {
        if let (Hypothesis::Negated, Some(rest)) = (hypothesis, negated(words)) {
            self.explain_all(domain, rest.words, wording, place.view(rest.view), explained)?;
            let (task, of_tasks) = self.negate(explained);
            self.plan_for(domain, self.task_count)?;
            let is_of_thing = self.place_of_thing(domain, task).is_some();
            let has_act = explained.acts || place.is_rest || if is_of_thing { rest.is_act_for_things } else { rest.is_act };
            let is_clear = rest.is_clear && has_act && explained.fitting.contains(task);
            let (words, tasks, probability) = (rest.words, TaskSet::of(task), share * of_tasks);
            return Ok(Judged { hypothesis, words, task, tasks, probability, command: share, is_clear, rest: None });
        }
        if let (Hypothesis::All, Some(rest)) = (hypothesis, all(words)) {
            self.explain_all(domain, rest.words, wording, place.view(rest.view), explained)?;
            let (tasks, of_place) = self.all_that_fit(domain, explained);
            let task = tasks.iter().next().unwrap_or(explained.best().0);
            let (words, is_clear, probability) = (explained.naming(rest.words), rest.is_clear && !tasks.is_empty(), share * of_place);
            return Ok(Judged { hypothesis, words, task, tasks, probability, command: share, is_clear, rest: None });
        }
        if hypothesis == Hypothesis::Talk(Class::Again)
            && let Some(task) = self.again(words, place.before, explained)
        {
            explained.keep_only(task);
            return Ok(Judged::again(task, share));
        }
        let (task, of_command) = explained.best();
        let (tasks, probability) = (TaskSet::of(task), command * of_command);
        // "This or that" leaves the choice to the robot.
        let is_choice = words.iter().any(|word| word.classes.contains(Class::Or) && word.count == 0.0);
        // A word that names nothing known may be the name of something else.
        let is_named = explained.own.contains(task) && (explained.whole.contains(task) || !has_new_name(words));
        let is_told = is_named && !is_choice && !is_question(words);
        let is_clear = is_told && !has_more(words) && !self.has_rival(domain, explained, task);
        let words = explained.naming(words);
        Ok(Judged { hypothesis, words, task, tasks, probability, command, is_clear, rest: None })
    }

    /// The tasks of the session that hold where it starts: a robot that is told to do one rests.
    pub fn done<D: Domain + ?Sized>(&self, domain: &D) -> TaskSet {
        let Some(state) = self.started_from(domain) else { return TaskSet::EMPTY };
        let holds = |task: usize| {
            let task = self.task(task);
            let lifted = self.lifted().get(usize::from(task.lifted));
            lifted.is_some_and(|lifted| !lifted.has_way() && task.is_reached(lifted, |part| domain.holds(part, &state)))
        };
        (0..self.tasks().len()).filter(|&task| holds(task)).fold(TaskSet::EMPTY, TaskSet::with)
    }

    /// Where all things of a kind are meant, those that are there already are not meant any more.
    ///
    /// # Errors
    /// [`AgentError::NotNow`].
    pub fn leave_out_done<D: Domain + ?Sized>(&mut self, domain: &D, listened: &Listened) -> Result<(), AgentError> {
        let done = self.done(domain);
        let may_be_of_all = matches!(listened.hypothesis, Hypothesis::All | Hypothesis::Several) && listened.verdict != Verdict::Done;
        if may_be_of_all && !done.is_empty() && !self.tasks().iter().any(GroundedTask::is_negated) {
            let _ = self.answered(done, false, NOT_MEANT, 1)?;
        }
        Ok(())
    }

    /// Gives the tasks that hold already a share of `done`.
    pub(super) fn share<D: Domain + ?Sized>(&mut self, domain: &D, done: f32) {
        if let Some(state) = self.started_from(domain) {
            let tasks = self.memory.lend().session.tasks.get_mut(..self.task_count).unwrap_or(&mut []);
            share_with_done(&self.lifted, tasks, done, |part| domain.holds(part, &state));
        }
    }

    /// Begins the session with what the words say of each task.
    fn believe<D: Domain + ?Sized>(&mut self, domain: &D, words: Words<'_>, all: &Explained) -> Result<(), AgentError> {
        self.share(domain, all.done);
        // What is learned of the session are the words that were meant.
        self.sentence.clear();
        for word in words.iter() {
            let _ = self.sentence.push(word.said.symbol);
        }
        let mut scene = self.scene(domain);
        for task in 0..self.tasks().len() {
            let likelihood = all.likelihoods.get(task).copied().unwrap_or(Scaled::ZERO);
            self.add_description(domain, &mut scene, task, likelihood)?;
            let weight = all.weights.get(task).copied().unwrap_or(Scaled::ZERO);
            self.belief_mut().set_prior(task, weight);
        }
        if all.weights.iter().all(|weight| weight.is_zero()) {
            for task in 0..self.tasks().len() {
                let prior = Scaled::new(self.task(task).prior);
                self.belief_mut().set_prior(task, prior);
            }
        }
        self.progressed = Progressed::Ready;
        Ok(())
    }

    /// How well the tasks explain these words, or those of them that other words point at.
    pub(super) fn explain_words<D: Domain + ?Sized>(
        &mut self,
        domain: &D,
        words: Words<'_>,
        wording: &Wording<'_>,
        view: View<'_>,
        recalled: Option<Recalled<'_>>,
        explained: &mut Explained,
    ) -> Result<(), AgentError> {
        self.share(domain, view.done);
        let mut said: Vec<Said, WORDS_PER_COMMAND> = Vec::new();
        let mut sentence: Vec<Option<Symbol>, WORDS_PER_COMMAND> = Vec::new();
        for word in words.iter() {
            let _ = said.push(word.said);
            let _ = sentence.push(word.said.symbol);
        }
        let mut scene = self.scene(domain);
        let AgentTables { language, session, workspace } = self.memory.lend();
        let mut language = self.language.with(language, workspace);
        let tasks = session.tasks.get(..self.task_count).unwrap_or(&[]);
        let (mut named, has_new_verb) = name(language.read(), wording, words, &said);
        let acts = named.acts();
        // "I want the bag in the red room" needs no word of a task.
        let wishes = words.iter().any(|word| word.classes.contains(Class::Wish)) && !words.iter().any(Heard::is_new);
        if view.has_act || wishes {
            named.act();
        }
        if let Some(recalled) = &recalled {
            named.cover(recalled.has_place(), recalled.has_thing());
        }
        *explained = Explained { acts, has_new_verb, done: view.done, ..Explained::NEW };
        let mut forms: Vec<Symbol, { TaskSet::MOST }> = Vec::new();
        let mut ghosts: Vec<Scaled, { TaskSet::MOST }> = Vec::new();
        let is_meant = |task: &GroundedTask| recalled.is_none_or(|recalled| recalled.fits(domain, &self.lifted, task));
        for (position, task) in tasks.iter().enumerate() {
            rest(wording.pause)?;
            let mut description = Tokens::new();
            if let Some(scene) = &mut scene {
                describe(domain, &self.lifted, task, scene, language.tokens_mut(), &mut description)?;
            }
            let (tables, bitext) = (language.read().tables(), language.read().bitext());
            let explain = |description: &[Symbol], ghost: Option<RoleKind>| {
                let share = wording.coverage.share(tables.layout(), &named, description, ghost);
                likelihood(tables, &said, description, wording.new).times(share)
            };
            let whole = explain(&description, None);
            if named.is_own(tables, bitext, &description) {
                explained.own = explained.own.with(position);
                if named.places(tables.layout(), &description) {
                    explained.fitting = explained.fitting.with(position);
                }
            }
            if named.is_whole(tables.layout(), &description) {
                explained.whole = explained.whole.with(position);
            }
            let mut absent = Scaled::ZERO;
            let mut kinds = 0.0_f32;
            for ghost in [RoleKind::Goal, RoleKind::Subject] {
                if let Some(other) =
                    with_ghost(&description, ghost, tables.layout().tokens(), bitext, |token| tables.layout().forms().contains(&token))
                {
                    absent = absent.plus(explain(&other, Some(ghost)));
                    kinds += 1.0;
                }
            }
            let _ = forms.push(form(&description).unwrap_or(Symbol(0)));
            let is_other = !acts && view.kind.is_some_and(|kind| kind != task.lifted);
            let share = if recalled.is_some() { share_among(tasks, task, is_meant) } else { 1.0 };
            let whole = if share > 0.0 { whole } else { Scaled::ZERO };
            let prior = share * task.prior;
            let _ = explained.likelihoods.push(whole);
            let _ = explained.weights.push(whole.scaled_by(if is_other { OTHER_KIND * prior } else { prior }));
            if named.acts_for(tables.layout(), &description) {
                explained.signed = explained.signed.with(position);
            }
            let _ = ghosts.push(if kinds > 0.0 { absent.scaled_by(prior / kinds) } else { Scaled::ZERO });
        }
        let language = language.read();
        let groups = count_kinds(&forms) as f32;
        for (first, &token) in forms.iter().enumerate() {
            if forms.iter().take(first).any(|before| *before == token) {
                continue;
            }
            let of_kind = |weights: &[Scaled]| {
                total(weights.iter().zip(&forms).filter(|&(_, form)| *form == token).map(|(&weight, _)| weight.scaled_by(groups)))
            };
            let share = share_of_kind(language.bitext(), token);
            explained.here = explained.here.plus(of_kind(&explained.weights).scaled_by(share));
            explained.absent = explained.absent.plus(of_kind(&ghosts).scaled_by(share));
        }
        let factors = words.iter().fold(Scaled::ONE, |product, word| product.scaled_by(word.factor));
        (explained.here, explained.absent) = (explained.here.times(factors), explained.absent.times(factors));
        kind::weigh(language.tables(), &sentence, |task| forms.get(task).copied().unwrap_or(Symbol(0)), &mut explained.weights);
        Ok(())
    }

    /// The likeliest hypothesis, how probable it is, and how probable a plain command is.
    #[inline(never)]
    fn hypotheses<D: Domain + ?Sized>(
        &mut self,
        domain: &D,
        words: Words<'_>,
        wording: &Wording<'_>,
        explained: &Explained,
        place: Place<'_>,
        parting: Option<Parting>,
    ) -> Result<(Hypothesis, f32, f32), AgentError> {
        let mut hypotheses: Vec<(Hypothesis, Scaled), 16> = Vec::new();
        let mut add = |hypothesis: Hypothesis, weight: Scaled| match hypotheses.iter_mut().find(|(known, _)| *known == hypothesis) {
            Some((_, sum)) => *sum = sum.plus(weight),
            None => drop(hypotheses.push((hypothesis, weight))),
        };
        // As probable as the command, and before it: who waits does no harm.
        if wording.closed.count(Class::Negation) == 0 && may_turn(words, explained.has_new_verb) {
            add(Hypothesis::Reversed, explained.here.scaled_by(REVERSED));
        }
        add(Hypothesis::Command, explained.here.scaled_by(1.0 - NOTHING - ABSENT - ABOUT - SEVERAL));
        let no_task = |of: &dyn Fn(usize, &Heard) -> f32| {
            let words = words.iter().enumerate();
            words.fold(Scaled::new(wording.end), |product, (position, word)| product.scaled_by((1.0 - wording.end) * of(position, word)))
        };
        add(Hypothesis::Nothing, no_task(&|_, word| word.beside).scaled_by(NOTHING));
        add(Hypothesis::Absent, explained.absent.scaled_by(ABSENT));
        if !explained.signed.contains(explained.best().0) && !place.is_rest {
            let without = wording.coverage.least_without_task(self.language().tables().layout());
            add(Hypothesis::About, explained.here.scaled_by(ABOUT / without));
        }
        for class in Class::ALL.into_iter().filter(|class| class.is_talk()) {
            // "Back" is a place where something was done before.
            let speaks = |word: &Heard| word.classes.contains(class) && !(place.is_known() && word.classes.contains(Class::Back));
            if !words.iter().any(speaks) {
                continue;
            }
            let size = wording.closed.count(class) as f32;
            let weight = no_task(&|position, word| match word.classes.contains(class) {
                true => 0.5 / size * if position == 0 { 3.0 } else { 1.0 } + 0.5 * word.beside,
                false => 0.8 * word.beside,
            });
            let prior = if place.is_known() && class == Class::Again { AGAIN } else { TALK };
            add(Hypothesis::Talk(class), weight.scaled_by(prior / learned(words, |word| word.classes.contains(class))));
        }
        for (hypothesis, rest) in [(Hypothesis::Negated, negated(words)), (Hypothesis::All, all(words))] {
            let Some(rest) = rest else { continue };
            let mut explained = Explained::NEW;
            self.explain_all(domain, rest.words, wording, place.view(rest.view), &mut explained)?;
            add(hypothesis, explained.here.scaled_by(rest.prior));
            add(Hypothesis::Absent, explained.absent.scaled_by(rest.prior * ABSENT));
        }
        if let Some(parting) = parting {
            add(Hypothesis::Several, parting.weight);
        }
        let whole = total(hypotheses.iter().map(|(_, weight)| *weight));
        let mut best = (Hypothesis::Command, Scaled::ZERO);
        for &(hypothesis, weight) in &hypotheses {
            if weight.exceeds(best.1) {
                best = (hypothesis, weight);
            }
        }
        let command = hypotheses.iter().find(|(it, _)| *it == Hypothesis::Command).map_or(0.0, |(_, weight)| weight.over(whole));
        Ok((best.0, best.1.over(whole), command))
    }
}

/// What words name, and whether a new word stands where commands have the word of their task.
#[inline(never)]
fn name(language: LanguageRef<'_>, wording: &Wording<'_>, words: Words<'_>, said: &[Said]) -> (Named, bool) {
    let is_plain = |word| is_plain(language, wording.closed, word);
    let mut senses = Senses::new(language.tables(), language.bitext(), &is_plain, wording.facts);
    let mut named = Named::of(&mut senses, said);
    let Some(behind) = new_verb(words) else { return (named, false) };
    let toward = |word| wording.closed.of(language.words().text(word)).contains(Class::Toward);
    let is_behind: Option<&dyn Fn(Symbol) -> bool> = if behind.is_some_and(|word| word.is_toward) { Some(&toward) } else { None };
    let kinds = senses.acts_before(behind.and_then(|word| word.said.symbol), is_behind);
    named.may_act(kinds);
    (named, kinds != 0)
}

/// By how much the prior of a task grows where only some tasks of its kind are meant; 0 for the others.
fn share_among(tasks: &[GroundedTask], task: &GroundedTask, is_meant: impl Fn(&GroundedTask) -> bool) -> f32 {
    if !is_meant(task) {
        return 0.0;
    }
    let of_kind = || tasks.iter().filter(|other| other.lifted == task.lifted);
    let (all, meant): (f32, f32) = (of_kind().map(|it| it.prior).sum(), of_kind().filter(|it| is_meant(it)).map(|it| it.prior).sum());
    if meant > 0.0 { all / meant } else { 0.0 }
}

/// The word behind a new word that may be a word for what to do: nothing but closed words stand before it, and the last is no "I".
fn new_verb(words: Words<'_>) -> Option<Option<&Heard>> {
    let first = words.iter().position(|word| word.classes == Classes::NONE)?;
    let is_verb = words.get(first)?.is_new() && words.iter().filter(|word| word.is_new()).count() <= MOST_NEW;
    let is_of_speaker = first.checked_sub(1).and_then(|before| words.get(before)).is_some_and(|word| word.classes.contains(Class::Speaker));
    let asks = words.iter().take(first).any(|word| word.classes.contains(Class::Asking));
    let behind = words.iter().skip(first).find(|word| !word.is_new());
    (is_verb && !is_of_speaker && !asks).then_some(behind)
}

/// Whether a piece of an utterance is joined to the one before by a hyphen.
fn is_joined(utterance: &str, piece: usize) -> bool {
    start_of_piece(utterance, piece)
        .and_then(|start| utterance.get(..start))
        .is_some_and(|before| before.ends_with(['-', '\u{2010}', '\u{2011}']))
}

/// The verb that a word is with "it" behind it: "llévalo" is "lleva" and "lo". The accent is none of the verb.
fn verb_before_clitic(language: LanguageRef<'_>, closed: ClosedWords<'_>, word: &str) -> Option<Symbol> {
    let plain = |letter: char| match letter {
        'á' => 'a',
        'é' => 'e',
        'í' => 'i',
        'ó' => 'o',
        'ú' => 'u',
        other => other,
    };
    closed.ends(Class::Clitic, word).find_map(|verb| {
        let is_verb = |known: &str| known.chars().map(plain).eq(verb.chars().map(plain));
        let (symbol, _) = language.words().iter().take(language.tables().words()).find(|&(_, known)| is_verb(known))?;
        is_of_task(language.tables(), Some(symbol)).then_some(symbol)
    })
}

/// Whether a new word stands between known ones.
fn has_new_name(words: Words<'_>) -> bool {
    // Whether a known word was before, and a new one behind it.
    let (mut has_known, mut has_new) = (false, false);
    words.iter().any(|word| {
        let is_known = word.count > 0.0;
        has_new |= has_known && word.is_new();
        has_known |= is_known;
        is_known && has_new
    })
}

/// Whether the words ask or tell something, with a word for it that no command had.
pub(super) fn is_question(words: Words<'_>) -> bool {
    let asks = |word: &Heard| word.classes.contains(Class::Asking) && !word.classes.contains(Class::Polite);
    let is_request = words.iter().take_while(|word| word.count == 0.0).any(|word| word.classes.contains(Class::Polite));
    // "The bag was there", and a particle at the end: 吗.
    let mut words = words.iter().take(if is_request { words.len().saturating_sub(1) } else { words.len() });
    words.any(|word| word.count == 0.0 && asks(word))
}

/// How many different kinds of task.
fn count_kinds(forms: &[Symbol]) -> usize {
    forms.iter().enumerate().filter(|&(position, form)| !forms.iter().take(position).any(|before| before == form)).count()
}

/// The share of the lessons that a kind of task has.
fn share_of_kind(bitext: BitextRef<'_>, token: Symbol) -> f32 {
    let of_kind = |wanted: Option<Symbol>| -> f32 {
        let pairs = bitext.pairs().iter().filter(|pair| wanted.is_none() || form(bitext.command(pair.command)) == wanted);
        pairs.map(|pair| pair.weight).sum()
    };
    (of_kind(Some(token)) + 0.5 / LIFTED_TASKS as f32) / (of_kind(None) + 0.5)
}

/// The description of a task about a thing that is not here: in the place of what has this role, all values of its sorts that it does not have
/// and one that nobody has named. `None` where nothing has this role.
fn with_ghost(
    description: &[Symbol],
    kind: RoleKind,
    tokens: usize,
    bitext: BitextRef<'_>,
    is_form: impl Fn(Symbol) -> bool,
) -> Option<Tokens> {
    let mut ghost = Tokens::new();
    let (mut found, unnamed) = (false, Symbol(tokens as u16));
    ghost.push(*description.first()?).ok()?;
    for group in groups(description) {
        let marker = *description.get(group.first.checked_sub(1)?)?;
        if group.marker.role.kind() != kind {
            ghost.push(marker).ok()?;
            ghost.extend_from_slice(group.values).ok()?;
            continue;
        }
        if group.marker.sort & 1 == 1 {
            continue;
        }
        found = true;
        ghost.push(marker).ok()?;
        // The values of this sort that lessons spoke of; for a place, those that no place here has.
        let is_here = |value: Symbol| {
            kind == RoleKind::Goal
                && groups(description).any(|other| {
                    other.marker.sort == group.marker.sort
                        && matches!(other.marker.role.kind(), RoleKind::Goal | RoleKind::Start | RoleKind::OtherPlace)
                        && other.values.contains(&value)
                })
        };
        let first = ghost.len();
        for command in 0..bitext.commands() as u16 {
            for other in groups(bitext.command(command)).filter(|other| other.marker.sort == group.marker.sort) {
                for &value in other.values.iter().filter(|&&value| !is_form(value) && !is_here(value)) {
                    if !ghost.get(first..).is_some_and(|values| values.contains(&value)) {
                        ghost.push(value).ok()?;
                    }
                }
            }
        }
        ghost.push(unnamed).ok()?;
    }
    found.then_some(ghost)
}
