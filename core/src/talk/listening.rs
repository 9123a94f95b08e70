//! The hypotheses of what an utterance is, and the verdict.

use super::classes::{Class, Classes, ClosedWords};
use crate::capacity::{CapacityError, LIFTED_TASKS, WORDS_PER_COMMAND};
use crate::language::bitext::BitextRef;
use crate::language::roles::kind;
use crate::language::roles::talk::{Coverage, Named, Said, Senses, background, common, likelihood};
use crate::language::spelling::is_slip_of_any_length;
use crate::language::{LanguageRef, Model, for_each_piece};
use crate::memory::{AgentMemory, AgentTables};
use crate::oomdp::Domain;
use crate::planning::Progress;
use crate::probability::{Scaled, total};
use crate::session::phase::Progressed;
use crate::session::{Agent, AgentError};
use crate::symbols::Symbol;
use crate::task::TaskSet;
use crate::task::description::{describe, form, groups};
use crate::task::machine_command::Tokens;
use crate::task::role::RoleKind;
use core::fmt;
use heapless::Vec;

/// How probable each hypothesis is before any word; a plain command has the rest.
const NOTHING: f32 = 0.15;
const ABSENT: f32 = 0.05;
const ABOUT: f32 = 0.05;
const NEGATED: f32 = 0.05;
const SEVERAL: f32 = 0.05;
const ALL: f32 = 0.03;
const TALK: f32 = 0.02;
/// The share of each kind of task that is for tasks that are done already.
const DONE: f32 = 0.03;
/// How probable a word that was never heard is where no task is meant, and beside a command.
const NEW: f32 = 0.5;
/// How probable a polite word is beside a command, and another word of a closed class.
const POLITE: f32 = 0.6;
const OTHER_CLOSED: f32 = 1e-3;
/// How probable a word is as a cue of a negation, of several commands or of all things.
const CUE: f32 = 0.15;
/// "All" things need no name: e^4.
const UNNAMED: f32 = 54.598_15;
/// How often a word is mistyped, alone and beside another that is.
const SLIP: f32 = 0.02;
const ANOTHER_SLIP: f32 = 0.15;
/// How probable each letter of a word is that was never heard, and the word before its letters.
const LETTER: f32 = 1.0 / 12.0;
const NEW_SPELLING: f32 = 0.2;
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
    /// Several commands.
    Several,
    /// A command for all things of a class.
    All,
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
            Self::Several => "several commands",
            Self::All => "all things of a kind",
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
    /// The most likely task of the session, by its position.
    pub task: usize,
    /// How probable it is that the utterance is a command for that task, from 0 to 1.
    pub probability: f32,
    /// How probable it is that the utterance is a command for one of the tasks, from 0 to 1.
    pub command: f32,
}

/// How commands are worded, as far as was learned.
struct Wording<'c> {
    closed: ClosedWords<'c>,
    coverage: Coverage,
    /// How probable a new word is in a command.
    new: f32,
    /// One by one more than the words of a command, on average: how probable its end is after each word.
    end: f32,
    /// How probable the most likely task must be.
    sure: f32,
}

impl<'c> Wording<'c> {
    fn of(language: LanguageRef<'_>, closed: ClosedWords<'c>) -> Self {
        let (bitext, words) = (language.bitext(), language.tables().words());
        let is_plain = |word| is_plain(language, closed, word);
        let coverage = Coverage::of(&mut Senses::new(language.tables(), bitext, &is_plain));
        let sessions = bitext.sessions();
        let sentences = || (0..sessions as u16).map(|session| bitext.sentence(session));
        let all = sentences().map(<[Symbol]>::len).sum::<usize>() as f32;
        let count = |word: usize| count(bitext, Symbol(word as u16));
        let once = (0..words).filter(|&word| count(word) == 1).count() as f32;
        let sessions = sessions.max(1) as f32;
        Self {
            closed,
            coverage,
            // Good and Turing's estimate; at first every word is new.
            new: (once + 2.0) / (all + 2.0),
            end: 1.0 / (1.0 + all / sessions),
            // 0.8 after 24 lessons, 0.65 after 120.
            sure: (0.6125 + 4.5 / sessions).min(0.95),
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
struct Heard {
    said: Said,
    classes: Classes,
    /// How probable it is where no task is meant.
    beside: f32,
    /// How often it was said in commands.
    count: f32,
    /// How probable its spelling is as a slip for the word that it is taken for, against that of a word never heard; 1 for a word as it was said.
    slip: f32,
}

type Words = Vec<Heard, WORDS_PER_COMMAND>;

/// The known word that a word never heard is most probably a slip for, and how probable its spelling is then, against that of a new word.
fn slip_for(language: LanguageRef<'_>, piece: &str, rate: f32) -> Option<(Symbol, f32)> {
    let letters = piece.chars().count();
    let spelling = (0..letters).fold(NEW_SPELLING, |product, _| product * LETTER);
    let mut best: Option<(Symbol, f32)> = None;
    for position in 0..language.tables().words() {
        let (symbol, known) = (Symbol(position as u16), language.words().text(Symbol(position as u16)));
        let length = known.chars().count();
        if length < 2 || !is_slip_of_any_length(piece, known) {
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

impl Heard {
    fn new(language: LanguageRef<'_>, symbol: Option<Symbol>, classes: Classes) -> Self {
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
        let count = symbol.map_or(0.0, |symbol| count(language.bitext(), symbol) as f32);
        let beside = share(common, if polite { NEW / 2.0 } else { NEW });
        Self { said: Said { symbol, chatter }, classes, beside, count, slip: 1.0 }
    }

    /// The same word as a slip for a known one.
    fn mended(self, language: LanguageRef<'_>, symbol: Symbol, slip: f32) -> Self {
        let meant = Self::new(language, Some(symbol), Classes::NONE);
        let said = Said { symbol: Some(symbol), chatter: self.said.chatter / slip + meant.said.chatter };
        Self { said, beside: self.beside + slip * meant.beside, count: meant.count, slip, ..self }
    }
}

/// The words with slips of the pen mended, where there are any. Who types in haste does so for a sentence.
fn mend(language: LanguageRef<'_>, utterance: &str, words: &Words) -> Result<Option<Words>, CapacityError> {
    let (known, mut slips, mut mended) = (language.tables().words(), 0_usize, words.clone());
    let is_new = |word: &Heard| word.classes == Classes::NONE && word.said.symbol.is_none_or(|symbol| symbol.index() >= known);
    for rate in [SLIP, ANOTHER_SLIP] {
        let mut position = 0_usize;
        for_each_piece(utterance, |piece| {
            let word = words.get(position).filter(|word| is_new(word));
            if let (Some(word), Some(slot)) = (word, mended.get_mut(position))
                && let Some((symbol, slip)) = slip_for(language, piece, rate)
                && (rate == SLIP || slips > 1)
            {
                slips = slips.saturating_add(usize::from(rate == SLIP));
                *slot = word.mended(language, symbol, slip);
            }
            position = position.saturating_add(1);
            Ok(())
        })?;
    }
    Ok(Some(mended).filter(|_| slips > 0))
}

/// How well the tasks here explain some words.
struct Explained {
    /// Pr(words) where one of the tasks is meant.
    here: Scaled,
    /// Pr(words) where a thing is meant that is not here.
    absent: Scaled,
    /// Pr(words | t) of each task, with its coverage.
    likelihoods: Vec<Scaled, { TaskSet::MOST }>,
    /// Each task's share of the belief, in no unit.
    weights: Vec<Scaled, { TaskSet::MOST }>,
    /// Whether a word is a sign of a kind of task.
    acts: bool,
}

impl Explained {
    /// The most likely task, with its probability.
    fn best(&self) -> (usize, f32) {
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
        if self.options.language.model.in_use() != Model::Roles || self.language().tables().words() == 0 {
            self.open(domain, state, utterance, DONE)?;
            self.begin_to_understand(domain)?;
            while self.hear_on(domain, u32::MAX)? == Progress::Working {}
            let task = self.most_likely().unwrap_or(0);
            let probability = self.belief().probability(task);
            return Ok(Listened { verdict: Verdict::Unsure, hypothesis: Hypothesis::Command, task, probability, command: 1.0 });
        }
        self.open(domain, state, utterance, DONE)?;
        let result = self.listen_here(domain, utterance, words);
        if result.is_err() {
            (self.start, self.progressed) = (None, Progressed::Idle);
        }
        result
    }

    fn listen_here<D: Domain + ?Sized>(&mut self, domain: &D, utterance: &str, closed: ClosedWords<'_>) -> Result<Listened, AgentError> {
        self.begin_to_understand(domain)?;
        let mut words: Words = Vec::new();
        let (sentence, language) = (&self.sentence, self.language.read(self.memory.read().language, self.memory.read().workspace.len()));
        for_each_piece(utterance, |piece| {
            let symbol = sentence.get(words.len()).copied().flatten();
            let _ = words.push(Heard::new(language, symbol, closed.of(piece)));
            Ok(())
        })?;
        let wording = Wording::of(language, closed);
        let mended = mend(language, utterance, &words)?;
        let mut all = self.explain_all(domain, &words, &wording)?;
        if let Some(mended) = mended {
            let other = self.explain_all(domain, &mended, &wording)?;
            if other.here.exceeds(all.here) {
                (all, words) = (other, mended);
                // What is learned of the session are the words that were meant.
                self.sentence.iter_mut().zip(&words).for_each(|(slot, word)| *slot = word.said.symbol);
            }
        }
        let hypotheses = self.hypotheses(domain, &words, &wording, &all)?;
        let whole = total(hypotheses.iter().map(|(_, weight)| *weight));
        let share = |wanted: Hypothesis| hypotheses.iter().find(|(it, _)| *it == wanted).map_or(0.0, |(_, weight)| weight.over(whole));
        let (task, of_command) = all.best();
        let command = share(Hypothesis::Command);
        let probability = command * of_command;
        let done = self.done(domain);
        let kind = |task: usize| self.task(task).lifted;
        let fits = all.likelihoods.get(task).copied().unwrap_or(Scaled::ZERO);
        let is_rival = |other: usize| {
            let likelihood = all.likelihoods.get(other).copied().unwrap_or(Scaled::ZERO);
            done.contains(other) && kind(other) == kind(task) && likelihood.scaled_by(RIVAL).exceeds(fits)
        };
        let has_rival = !done.contains(task) && (0..all.weights.len()).any(is_rival);
        let mut hypothesis = (Hypothesis::Command, Scaled::ZERO);
        for &(it, weight) in &hypotheses {
            if weight.exceeds(hypothesis.1) {
                hypothesis = (it, weight);
            }
        }
        let verdict = if probability >= wording.sure && !has_rival {
            if done.contains(task) { Verdict::Done } else { Verdict::Sure }
        } else {
            match hypothesis.0 {
                Hypothesis::Nothing | Hypothesis::Absent | Hypothesis::Talk(_) => Verdict::None,
                _ => Verdict::Unsure,
            }
        };
        self.believe(domain, &all)?;
        Ok(Listened { verdict, hypothesis: hypothesis.0, task, probability, command })
    }

    /// The tasks of the session that hold where it starts: a robot that is told to do one rests.
    pub fn done<D: Domain + ?Sized>(&self, domain: &D) -> TaskSet {
        let Some(state) = self.started_from(domain) else { return TaskSet::EMPTY };
        let holds = |task: usize| {
            let task = self.task(task);
            let lifted = self.lifted().get(usize::from(task.lifted));
            lifted.is_some_and(|lifted| !lifted.has_way() && task.propositions(lifted).all(|part| domain.holds(&part, &state)))
        };
        (0..self.tasks().len()).filter(|&task| holds(task)).fold(TaskSet::EMPTY, TaskSet::with)
    }

    /// Begins the session with what the words say of each task.
    fn believe<D: Domain + ?Sized>(&mut self, domain: &D, all: &Explained) -> Result<(), AgentError> {
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

    /// How well the tasks explain these words.
    fn explain_all<D: Domain + ?Sized>(&mut self, domain: &D, words: &[Heard], wording: &Wording<'_>) -> Result<Explained, AgentError> {
        let mut said: Vec<Said, WORDS_PER_COMMAND> = Vec::new();
        let mut sentence: Vec<Option<Symbol>, WORDS_PER_COMMAND> = Vec::new();
        for word in words {
            let _ = said.push(word.said);
            let _ = sentence.push(word.said.symbol);
        }
        let mut scene = self.scene(domain);
        let AgentTables { language, session, workspace } = self.memory.lend();
        let mut language = self.language.with(language, workspace);
        let tasks = session.tasks.get(..self.task_count).unwrap_or(&[]);
        let named = {
            let language = language.read();
            let is_plain = |word| is_plain(language, wording.closed, word);
            Named::of(&mut Senses::new(language.tables(), language.bitext(), &is_plain), &said)
        };
        let mut explained =
            Explained { here: Scaled::ZERO, absent: Scaled::ZERO, likelihoods: Vec::new(), weights: Vec::new(), acts: named.acts() };
        let mut forms: Vec<Symbol, { TaskSet::MOST }> = Vec::new();
        let mut ghosts: Vec<Scaled, { TaskSet::MOST }> = Vec::new();
        for task in tasks {
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
            let _ = explained.likelihoods.push(whole);
            let _ = explained.weights.push(whole.scaled_by(task.prior));
            let _ = ghosts.push(if kinds > 0.0 { absent.scaled_by(task.prior / kinds) } else { Scaled::ZERO });
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
        let slips = words.iter().fold(Scaled::ONE, |product, word| product.scaled_by(word.slip));
        (explained.here, explained.absent) = (explained.here.times(slips), explained.absent.times(slips));
        kind::weigh(language.tables(), &sentence, |task| forms.get(task).copied().unwrap_or(Symbol(0)), &mut explained.weights);
        Ok(explained)
    }

    /// The weight of each hypothesis.
    fn hypotheses<D: Domain + ?Sized>(
        &mut self,
        domain: &D,
        words: &[Heard],
        wording: &Wording<'_>,
        all: &Explained,
    ) -> Result<Vec<(Hypothesis, Scaled), 16>, AgentError> {
        let mut hypotheses = Vec::new();
        let mut add = |hypothesis: Hypothesis, weight: Scaled| {
            let _ = hypotheses.push((hypothesis, weight));
        };
        add(Hypothesis::Command, all.here.scaled_by(1.0 - NOTHING - ABSENT - NEGATED - SEVERAL));
        let no_task = |of: &dyn Fn(usize, &Heard) -> f32| {
            let words = words.iter().enumerate();
            words.fold(Scaled::new(wording.end), |product, (position, word)| product.scaled_by((1.0 - wording.end) * of(position, word)))
        };
        add(Hypothesis::Nothing, no_task(&|_, word| word.beside).scaled_by(NOTHING));
        add(Hypothesis::Absent, all.absent.scaled_by(ABSENT));
        if !all.acts {
            let without = wording.coverage.least_without_task(self.language().tables().layout());
            add(Hypothesis::About, all.here.scaled_by(ABOUT / without));
        }
        // A word that was learned speaks for what was learned.
        let learned = |of: &dyn Fn(&Heard) -> bool| 1.0 + words.iter().filter(|word| of(word)).map(|word| word.count).fold(0.0, f32::max);
        for class in Class::ALL.into_iter().filter(|class| class.is_talk()) {
            if !words.iter().any(|word| word.classes.contains(class)) {
                continue;
            }
            let size = wording.closed.count(class) as f32;
            let weight = no_task(&|position, word| match word.classes.contains(class) {
                true => 0.5 / size * if position == 0 { 3.0 } else { 1.0 } + 0.5 * word.beside,
                false => 0.8 * word.beside,
            });
            add(Hypothesis::Talk(class), weight.scaled_by(TALK / learned(&|word| word.classes.contains(class))));
        }
        let negations = [Class::Negation, Class::Out, Class::But];
        for (hypothesis, prior, cues) in
            [(Hypothesis::Negated, NEGATED, &negations[..]), (Hypothesis::All, ALL * UNNAMED, &[Class::All][..])]
        {
            let mut rest: Words = Vec::new();
            for word in words.iter().filter(|word| !word.classes.contains_any(cues)) {
                let _ = rest.push(*word);
            }
            let count = words.len().saturating_sub(rest.len());
            if count == 0 || rest.is_empty() {
                continue;
            }
            let explained = self.explain_all(domain, &rest, wording)?.here;
            let explained = (0..count).fold(explained, |product, _| product.scaled_by(CUE));
            let learned = if hypothesis == Hypothesis::Negated { learned(&|word| word.classes.contains_any(cues)) } else { 1.0 };
            add(hypothesis, explained.scaled_by(prior / learned));
        }
        let mut several = Scaled::ZERO;
        for (position, word) in words.iter().enumerate().take(words.len().saturating_sub(1)).skip(1) {
            if !word.classes.contains(Class::Connective) {
                continue;
            }
            let (before, after) = words.split_at_checked(position).unwrap_or((&[], &[]));
            let skipped =
                after.iter().take(after.len().saturating_sub(1)).take_while(|word| word.classes.contains(Class::Connective)).count();
            let after = after.get(skipped..).unwrap_or(&[]);
            let first = self.explain_all(domain, before, wording)?.here;
            let second = self.explain_all(domain, after, wording)?.here;
            let weight = first.times(second).scaled_by(SEVERAL * CUE).divided_by(Scaled::new(1.0 + word.count).square_root());
            if weight.exceeds(several) {
                several = weight;
            }
        }
        add(Hypothesis::Several, several);
        Ok(hypotheses)
    }
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
