//! How well the tasks here explain words, some of which may refer to earlier sentences.

use super::absent::with_ghost;
use super::classes::Class;
use super::conversation::Before;
use super::heard::Words;
use super::place::{DONE, View};
use super::recalled::{Recalled, readings, without};
use super::syntax::{begins_with_way, is_verbless, names_thing_and_way, new_names, new_verb};
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

    /// The words that name objects. References change with each use, so nothing is learned of them.
    pub fn naming<'w>(&self, words: Words<'w>) -> Words<'w> {
        if self.points_back { without(words).map_or(words, |(rest, _)| rest) } else { words }
    }

    /// Keeps one task alone.
    pub fn keep_only(&mut self, task: usize) {
        for (position, weight) in self.weights.iter_mut().enumerate() {
            *weight = if position == task { Scaled::ONE } else { Scaled::ZERO };
        }
    }
}

impl<M: AgentMemory> Agent<M> {
    /// How well the tasks here explain these words, some of which may refer to earlier sentences. The most probable reading is taken.
    pub(super) fn explain_all<D: Domain + ?Sized>(
        &mut self,
        domain: &D,
        words: Words<'_>,
        wording: &Wording<'_>,
        view: View<'_>,
        explained: &mut Explained,
    ) -> Result<(), AgentError> {
        self.explain_words(domain, words, wording, view, None, explained)?;
        let can_point = words.has(Class::Here) || !matches!(view.before, Before::Nothing);
        let Some((rest, prior)) = without(words).filter(|_| can_point) else { return Ok(()) };
        self.explain_recalled(domain, (words, rest, prior), wording, view, explained)
    }

    /// How well the tasks explain words with a reference: the remaining words, with the prior of the reading.
    #[inline(never)]
    fn explain_recalled<D: Domain + ?Sized>(
        &mut self,
        domain: &D,
        (words, rest, prior): (Words<'_>, Words<'_>, f32),
        wording: &Wording<'_>,
        view: View<'_>,
        explained: &mut Explained,
    ) -> Result<(), AgentError> {
        let mut other = Explained::NEW;
        let is_way = rest.iter().any(|word| word.is_toward);
        for (recalled, share) in readings(words, view.before) {
            let kind = match view.before {
                Before::Known(conversation) if recalled.is_of_last_kind() => conversation.last().map(|last| last.lifted),
                _ => view.kind,
            };
            let is_here = recalled.is_here();
            let has_act = view.has_act || is_here || recalled.is_of_last_kind();
            let view = View { has_act, kind, done: if is_here { 1.0 } else { view.done }, ..view };
            self.explain_words(domain, rest, wording, view, Some(recalled), &mut other)?;
            let prior = prior * share * recalled.missing(is_way);
            // A thing that is not here cannot stay.
            let absent = if is_here { Scaled::ZERO } else { other.absent };
            (other.here, other.absent) = (other.here.scaled_by(prior), absent.scaled_by(prior));
            other.points_back = true;
            if other.here.exceeds(explained.here) {
                core::mem::swap(explained, &mut other);
            }
        }
        Ok(())
    }

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
                    with_ghost(&description, ghost, tables.layout().tokens(), bitext, &|token| tables.layout().forms().contains(&token))
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

/// The factor on a task's prior if only some tasks of its kind are meant; 0 for the others.
fn share_among(tasks: &[GroundedTask], task: usize, is_meant: impl Fn(usize) -> bool) -> f32 {
    let Some(kind) = tasks.get(task).filter(|_| is_meant(task)).map(|task| task.lifted) else { return 0.0 };
    let of_kind = || tasks.iter().enumerate().filter(|(_, other)| other.lifted == kind);
    let prior = |(_, task): (usize, &GroundedTask)| task.prior;
    let (all, meant): (f32, f32) = (of_kind().map(prior).sum(), of_kind().filter(|&(at, _)| is_meant(at)).map(prior).sum());
    if meant > 0.0 { all / meant } else { 0.0 }
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
