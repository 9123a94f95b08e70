//! How well the tasks here explain words.

use super::absent::with_ghost;
use super::classes::{Class, Classes};
use super::heard::{Heard, Words};
use super::place::{DONE, View};
use super::recalled::Recalled;

use super::wording::{Wording, is_plain, rest};
use crate::capacity::{LIFTED_TASKS, WORDS_PER_COMMAND};
use crate::language::LanguageRef;
use crate::language::bitext::BitextRef;
use crate::language::roles::kind;
use crate::language::roles::talk::{Named, Said, Senses, likelihood};
use crate::memory::{AgentMemory, AgentTables};
use crate::oomdp::Domain;
use crate::probability::{Scaled, total};
use crate::session::{Agent, AgentError};
use crate::symbols::Symbol;
use crate::task::description::{describe, form};
use crate::task::machine_command::Tokens;
use crate::task::role::RoleKind;
use crate::task::{GroundedTask, TaskSet};
use heapless::Vec;

/// The factor of tasks of another kind than the previous command's, if no word tells the kind.
const OTHER_KIND: f32 = 0.05;
/// The factor of tasks if words name an object outside of them, and other tasks have no such word.
pub(super) const FOREIGN: f32 = 0.02;
/// A sentence with more new words is no paraphrase of a known command.
const MOST_NEW: usize = 2;

/// How well the tasks here explain some words.
pub(super) struct Explained {
    /// Pr(words) if one of the tasks is meant.
    pub here: Scaled,
    /// Pr(words) if a thing is meant that is not here.
    pub absent: Scaled,
    /// Pr(words | t) of each task, with its coverage.
    pub likelihoods: Vec<Scaled, { TaskSet::MOST }>,
    /// Each task's share of the belief, unnormalised.
    pub weights: Vec<Scaled, { TaskSet::MOST }>,
    /// The tasks whose kind has a word as its sign.
    pub signed: TaskSet,
    /// The tasks whose place is named, and outside of which no word names anything.
    pub fitting: TaskSet,
    /// The tasks outside of which no word names a thing.
    pub own: TaskSet,
    /// The tasks with all of their parts named.
    pub whole: TaskSet,
    /// The tasks with a word for their kind.
    pub acted: TaskSet,
    /// Whether a word is a sign of a kind of task.
    pub acts: bool,
    /// Whether a new word stands in the place of a command's act word.
    pub has_new_verb: bool,
    /// Whether other words refer to earlier sentences.
    pub points_back: bool,
    /// The share of the tasks that hold already.
    pub done: f32,
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
        acted: TaskSet::EMPTY,
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

impl<M: AgentMemory> Agent<M> {
    /// How well the tasks explain these words; with `recalled`, only the tasks that other words refer to.
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
        // "I want the bag in the red room" needs no act word. "Come back": nothing after the verb tells its kind of task.
        let points_with_verb = recalled.is_some() && matches!(new_verb(words), Some(None));
        let wishes = words.has(Class::Wish) && !words.iter().any(|word| word.is_new && !word.is_article);
        if view.has_act || wishes || points_with_verb {
            named.act();
        }
        // "I want you in the red room", "into the red room with you", "the bag to the red room".
        if is_verbless(words) && (wishes || begins_with_way(words) || names_thing_and_way(words)) {
            named.act_in_any_way();
        }
        if let Some(recalled) = &recalled {
            named.cover(recalled.has_place(), recalled.has_thing());
        }
        let is_told_place = view.told.is_some_and(|told| told.is_place);
        if is_told_place {
            named.cover(true, recalled.is_some_and(|recalled| recalled.has_thing()));
        }
        *explained = Explained { acts, has_new_verb, done: view.done, ..Explained::NEW };
        let mut forms: Vec<Symbol, { TaskSet::MOST }> = Vec::new();
        let mut ghosts: Vec<Scaled, { TaskSet::MOST }> = Vec::new();
        let is_told = |position: usize| view.told.is_none_or(|told| told.tasks.contains(position));
        let is_meant = |position: usize| {
            let fits = |recalled: Recalled<'_>| tasks.get(position).is_some_and(|task| recalled.fits(domain, &self.lifted, task));
            is_told(position) && recalled.is_none_or(fits)
        };
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
            if is_told(position) && named.is_own(tables, bitext, &description) {
                explained.own = explained.own.with(position);
                if named.places(tables.layout(), &description) {
                    explained.fitting = explained.fitting.with(position);
                }
            }
            if named.acts_for(tables.layout(), &description) {
                explained.acted = explained.acted.with(position);
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
            let share = if recalled.is_some() || view.told.is_some() { share_among(tasks, position, is_meant) } else { 1.0 };
            // "The bag where it is" is not about the robot's place.
            let is_other_thing = recalled.is_some_and(|recalled| recalled.is_here()) && !explained.own.contains(position);
            let whole = if share > 0.0 && !is_other_thing { whole } else { Scaled::ZERO };
            let prior = share * task.prior;
            let _ = explained.likelihoods.push(whole);
            let _ = explained.weights.push(whole.scaled_by(if is_other { OTHER_KIND * prior } else { prior }));
            if named.acts_for(tables.layout(), &description) {
                explained.signed = explained.signed.with(position);
            }
            let _ = ghosts.push(if kinds > 0.0 { absent.scaled_by(prior / kinds) } else { Scaled::ZERO });
        }
        // "Put the basket in the green room" is about a basket rather than the green bag.
        let is_likely = |task: usize| explained.likelihoods.get(task).is_some_and(|likelihood| !likelihood.is_zero());
        if explained.own.iter().any(is_likely) {
            for (task, (weight, likelihood)) in explained.weights.iter_mut().zip(&mut explained.likelihoods).enumerate() {
                if !explained.own.contains(task) {
                    (*weight, *likelihood) = (weight.scaled_by(FOREIGN), likelihood.scaled_by(FOREIGN));
                }
            }
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
        // The names of two things belong to no single command.
        let here = factors.scaled_by(if explained.own.is_empty() { FOREIGN } else { 1.0 });
        (explained.here, explained.absent) = (explained.here.times(here), explained.absent.times(factors));
        kind::weigh(language.tables(), &sentence, |task| forms.get(task).copied().unwrap_or(Symbol(0)), &mut explained.weights);
        Ok(())
    }
}

/// The parts that words name, and whether a new word stands in the place of a command's act word.
#[inline(never)]
fn name(language: LanguageRef<'_>, wording: &Wording<'_>, words: Words<'_>, said: &[Said]) -> (Named, bool) {
    let is_plain = |word| is_plain(language, wording.closed, word);
    let mut senses = Senses::new(language.tables(), language.bitext(), &is_plain, wording.facts);
    let mut named = Named::of(&mut senses, said);
    named.has_new(new_names(words));
    let Some(behind) = new_verb(words) else { return (named, false) };
    let toward = |word| wording.closed.of(language.words().text(word)).contains(Class::Toward);
    let is_behind: Option<&dyn Fn(Symbol) -> bool> = if behind.is_some_and(|word| word.is_toward) { Some(&toward) } else { None };
    let kinds = senses.acts_before(behind.and_then(|word| word.said.symbol), is_behind);
    named.may_act(kinds);
    (named, kinds != 0)
}

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

/// The factor on a task's prior if only some tasks of its kind are meant; 0 for the others.
fn share_among(tasks: &[GroundedTask], task: usize, is_meant: impl Fn(usize) -> bool) -> f32 {
    let Some(kind) = tasks.get(task).filter(|_| is_meant(task)).map(|task| task.lifted) else { return 0.0 };
    let of_kind = || tasks.iter().enumerate().filter(|(_, other)| other.lifted == kind);
    let prior = |(_, task): (usize, &GroundedTask)| task.prior;
    let (all, meant): (f32, f32) = (of_kind().map(prior).sum(), of_kind().filter(|&(at, _)| is_meant(at)).map(prior).sum());
    if meant > 0.0 { all / meant } else { 0.0 }
}

/// The word after a new word that may be an act word: only words of closed classes precede it, and the last of them is no "I".
fn new_verb(words: Words<'_>) -> Option<Option<&Heard>> {
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

/// The number of different kinds of task.
fn count_kinds(forms: &[Symbol]) -> usize {
    forms.iter().enumerate().filter(|&(position, form)| !forms.iter().take(position).any(|before| before == form)).count()
}

/// The share of a kind of task in the lessons.
fn share_of_kind(bitext: BitextRef<'_>, token: Symbol) -> f32 {
    let of_kind = |wanted: Option<Symbol>| -> f32 {
        let pairs = bitext.pairs().iter().filter(|pair| wanted.is_none() || form(bitext.command(pair.command)) == wanted);
        pairs.map(|pair| pair.weight).sum()
    };
    (of_kind(Some(token)) + 0.5 / LIFTED_TASKS as f32) / (of_kind(None) + 0.5)
}
