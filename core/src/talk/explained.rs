//! How well the tasks here explain words, some of which may refer to earlier sentences.

use super::absent::{Spoken, with_ghost};
use super::context::{Context, DONE, STAYS, View};
use super::conversation::Before;
use super::recalled::{Recalled, readings, without};
use super::syntax::{begins_with_way, is_verbless, names_thing_and_way, neighbouring_names, new_names, new_verb};
use super::wording::take_pause;
use super::words::Words;
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
use crate::voice::classes::Class;
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
    /// The tasks whose place is named, and outside of which no word names anything.
    pub fitting: TaskSet,
    /// The tasks outside of which no word names a thing.
    pub own: TaskSet,
    /// The tasks with all of their parts named.
    pub whole: TaskSet,
    /// The tasks in which neighbouring names, such as "blue chair", are those of one thing.
    pub of_one: TaskSet,
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
        fitting: TaskSet::EMPTY,
        own: TaskSet::EMPTY,
        whole: TaskSet::EMPTY,
        of_one: TaskSet::EMPTY,
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

    /// The likeliest task, with its probability; `among` some tasks `None` if the likeliest of all is one of them, or none is possible.
    pub fn chosen(&self, among: Option<TaskSet>) -> Option<(usize, f32)> {
        let (likeliest, probability) = self.best();
        let Some(among) = among else { return Some((likeliest, probability)) };
        if among.contains(likeliest) {
            return None;
        }
        let of_some = self.weights.iter().copied().enumerate().filter(|&(task, _)| among.contains(task));
        let (task, weight) = of_some.reduce(|one, other| if other.1.exceeds(one.1) { other } else { one })?;
        (!weight.is_zero()).then(|| (task, weight.over(total(self.weights.iter().copied()))))
    }

    /// Makes the task that is chosen among some the likeliest of all, so that the robot follows it.
    pub fn prefer(&mut self, among: TaskSet) {
        let Some((task, _)) = self.chosen(Some(among)) else { return };
        let of = |task: usize| self.weights.get(task).copied().unwrap_or(Scaled::ONE);
        let less = of(task).over(of(self.best().0)) * FOREIGN;
        for (_, weight) in self.weights.iter_mut().enumerate().filter(|&(task, _)| !among.contains(task)) {
            *weight = weight.scaled_by(less);
        }
    }

    /// The task that explains the words best, among some; `None` if none explains them.
    pub fn likeliest(&self, tasks: TaskSet) -> Option<usize> {
        let (mut likeliest, mut most) = (None, Scaled::ZERO);
        for (task, &likelihood) in self.likelihoods.iter().enumerate().filter(|&(task, _)| tasks.contains(task)) {
            if likelihood.exceeds(most) {
                (likeliest, most) = (Some(task), likelihood);
            }
        }
        likeliest
    }

    /// The words that name objects. References change with each use, so nothing is learned of them.
    pub fn naming<'w>(&self, words: Words<'w>) -> Words<'w> {
        if self.points_back { without(words).map_or(words, |(rest, _)| rest) } else { words }
    }

    /// Makes tasks less likely if words name an object outside of them, and other tasks have no such word. "Put the basket in the green
    /// room" is about a basket rather than the green bag.
    fn prefer_own(&mut self) {
        if self.likeliest(self.own).is_some() {
            for (task, (weight, likelihood)) in self.weights.iter_mut().zip(&mut self.likelihoods).enumerate() {
                if !self.own.contains(task) {
                    (*weight, *likelihood) = (weight.scaled_by(FOREIGN), likelihood.scaled_by(FOREIGN));
                }
            }
        }
    }

    /// Sums the likelihoods up: the kinds of task, by their `forms`, have shares as in the lessons. `ghosts` are those of tasks about things
    /// that are not here.
    fn sum_up(&mut self, words: Words<'_>, bitext: BitextRef<'_>, forms: &[Symbol], ghosts: &[Scaled]) {
        let is_first = |at: usize, form: &Symbol| !forms.iter().take(at).any(|before| before == form);
        let kinds = forms.iter().enumerate().filter(|&(at, form)| is_first(at, form)).count() as f32;
        for (_, &kind) in forms.iter().enumerate().filter(|&(at, form)| is_first(at, form)) {
            let of_kind = |weights: &[Scaled]| {
                total(weights.iter().zip(forms).filter(|&(_, form)| *form == kind).map(|(&weight, _)| weight.scaled_by(kinds)))
            };
            let share = share_of_kind(bitext, kind);
            self.here = self.here.plus(of_kind(&self.weights).scaled_by(share));
            self.absent = self.absent.plus(of_kind(ghosts).scaled_by(share));
        }
        let factors = words.iter().fold(Scaled::ONE, |product, word| product.scaled_by(word.factor));
        // The names of two things belong to no single command.
        let here = factors.scaled_by(if self.own.is_empty() { FOREIGN } else { 1.0 });
        (self.here, self.absent) = (self.here.times(here), self.absent.times(factors));
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
    pub(super) fn explain_all<D: Domain>(
        &mut self,
        domain: &D,
        words: Words<'_>,
        view: View,
        context: Context<'_>,
        explained: &mut Explained,
    ) -> Result<(), AgentError> {
        self.explain_words(domain, words, view, context, None, explained)?;
        let can_point = words.has(Class::Here) || !matches!(context.earlier.before, Before::Nothing);
        let Some((rest, prior)) = without(words).filter(|_| can_point) else { return Ok(()) };
        self.explain_recalled(domain, (words, rest, prior), view, context, explained)
    }

    /// How well the tasks explain words with a reference: the remaining words, with the prior of the reading.
    #[inline(never)]
    fn explain_recalled<D: Domain>(
        &mut self,
        domain: &D,
        (words, rest, prior): (Words<'_>, Words<'_>, f32),
        view: View,
        context: Context<'_>,
        explained: &mut Explained,
    ) -> Result<(), AgentError> {
        let mut other = Explained::NEW;
        let is_way = rest.has_way();
        for (recalled, share) in readings(words, context.earlier.before) {
            let kind = match context.earlier.before {
                Before::Known(conversation) if recalled.is_of_last_kind() => conversation.last().map(|last| last.lifted),
                _ => context.earlier.kind,
            };
            let is_here = recalled.is_here();
            let has_act = view.has_act || is_here || recalled.is_of_last_kind();
            let view = View { has_act, done: if is_here { STAYS } else { view.done } };
            self.explain_words(domain, rest, view, context.of_kind(kind), Some(recalled), &mut other)?;
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
    pub(super) fn explain_words<D: Domain>(
        &mut self,
        domain: &D,
        words: Words<'_>,
        view: View,
        context: Context<'_>,
        recalled: Option<Recalled<'_>>,
        explained: &mut Explained,
    ) -> Result<(), AgentError> {
        let wording = context.wording;
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
        let (named, acts, has_new_verb) = name(language.read(), words, &said, view, context, recalled.as_ref());
        let neighbours = neighbouring_names(words);
        *explained = Explained { acts, has_new_verb, done: view.done, ..Explained::NEW };
        let mut forms: Vec<Symbol, { TaskSet::MOST }> = Vec::new();
        let mut ghosts: Vec<Scaled, { TaskSet::MOST }> = Vec::new();
        let spoken = Spoken::of(language.read());
        let is_told = |position: usize| context.told.is_none_or(|told| told.tasks.contains(position));
        let is_meant = |position: usize| {
            let fits = |recalled: Recalled<'_>| tasks.get(position).is_some_and(|task| recalled.fits(domain, &self.lifted, task));
            is_told(position) && recalled.is_none_or(fits)
        };
        for (position, task) in tasks.iter().enumerate() {
            take_pause(wording.pause)?;
            let mut description = Tokens::new();
            if let Some(scene) = &mut scene {
                describe(domain, &self.lifted, task, scene, language.tokens_mut(), &mut description)?;
            }
            let (tables, bitext) = (language.read().tables(), language.read().bitext());
            let layout = tables.layout();
            let explain = |description: &[Symbol], ghost: Option<RoleKind>| {
                let share = wording.coverage.share(layout, &named, description, ghost);
                likelihood(tables, &said, description, wording.new).times(share)
            };
            let insert = |set: &mut TaskSet, is_in: bool| *set = if is_in { set.with(position) } else { *set };
            let is_own = is_told(position) && named.is_own(tables, bitext, &description);
            insert(&mut explained.own, is_own);
            insert(&mut explained.fitting, is_own && named.places(layout, &description));
            insert(&mut explained.acted, named.acts_for(layout, &description));
            insert(&mut explained.whole, named.is_whole(layout, &description));
            insert(&mut explained.of_one, named.is_of_one(&neighbours, &description));
            let share = if recalled.is_some() || context.told.is_some() { share_among(tasks, position, &is_meant) } else { 1.0 };
            let prior = share * task.prior;
            // "Keep the bag here" is not about the robot's place.
            let is_possible = share > 0.0 && (is_own || !recalled.is_some_and(|recalled| recalled.is_here()));
            let whole = if is_possible { explain(&description, None) } else { Scaled::ZERO };
            let is_other = !acts && context.earlier.kind.is_some_and(|kind| kind != task.lifted);
            let _ = explained.likelihoods.push(whole);
            let _ = explained.weights.push(whole.scaled_by(if is_other { OTHER_KIND * prior } else { prior }));
            let _ = forms.push(form(&description).unwrap_or(Symbol(0)));
            // The place or the thing may be one that is not here.
            let (mut absent, mut kinds) = (Scaled::ZERO, 0.0_f32);
            for kind in [RoleKind::Goal, RoleKind::Subject] {
                if let Some(ghost) = with_ghost(&description, kind, language.read(), &spoken) {
                    (absent, kinds) = (absent.plus(explain(&ghost, Some(kind))), kinds + 1.0);
                }
            }
            let _ = ghosts.push(if kinds > 0.0 { absent.scaled_by(prior / kinds) } else { Scaled::ZERO });
        }
        explained.prefer_own();
        let language = language.read();
        explained.sum_up(words, language.bitext(), &forms, &ghosts);
        kind::weigh(language.tables(), &sentence, |task| forms.get(task).copied().unwrap_or(Symbol(0)), &mut explained.weights);
        Ok(())
    }
}

/// The parts that words name, whether a word is the sign of a kind of task, and whether a new word stands in the place of a command's act
/// word.
#[inline(never)]
fn name(
    language: LanguageRef<'_>,
    words: Words<'_>,
    said: &[Said],
    view: View,
    context: Context<'_>,
    recalled: Option<&Recalled<'_>>,
) -> (Named, bool, bool) {
    let wording = context.wording;
    let is_plain = |word| wording.is_plain(language, word);
    let mut senses = Senses::new(language.tables(), language.bitext(), &is_plain, wording.facts);
    let mut named = Named::of(&mut senses, said);
    named.has_new(new_names(words));
    let verb = new_verb(words);
    let kinds = verb.map_or(0, |behind| {
        let toward = |word| wording.is_toward(language, word);
        let is_behind: Option<&dyn Fn(Symbol) -> bool> = if behind.is_some_and(|word| word.is_toward) { Some(&toward) } else { None };
        senses.acts_before(behind.and_then(|word| word.said.symbol), is_behind)
    });
    named.may_act(kinds);
    let acts = named.acts();
    // "I want the bag in the red room" needs no act word. "Come back": nothing after the verb tells its kind of task.
    let wishes = words.has(Class::Wish) && !words.any(&|word| word.is_new && !word.is_article);
    let points_with_verb = recalled.is_some() && matches!(verb, Some(None));
    if view.has_act || context.earlier.is_rest || wishes || points_with_verb {
        named.act();
    }
    // "I want you in the red room", "into the red room with you", "the bag to the red room".
    if is_verbless(words) && (wishes || begins_with_way(words) || names_thing_and_way(words)) {
        named.act_in_any_way();
    }
    let has_thing = recalled.is_some_and(Recalled::has_thing);
    let has_place = recalled.is_some_and(Recalled::has_place) || context.told.is_some_and(|told| told.is_place);
    named.cover(has_place, has_thing);
    (named, acts, kinds != 0)
}

/// The factor on a task's prior if only some tasks of its kind are meant; 0 for the others.
fn share_among(tasks: &[GroundedTask], task: usize, is_meant: &dyn Fn(usize) -> bool) -> f32 {
    let Some(kind) = tasks.get(task).filter(|_| is_meant(task)).map(|task| task.lifted) else { return 0.0 };
    let of_kind = || tasks.iter().enumerate().filter(|(_, other)| other.lifted == kind);
    let prior = |(_, task): (usize, &GroundedTask)| task.prior;
    let (all, meant): (f32, f32) = (of_kind().map(prior).sum(), of_kind().filter(|&(at, _)| is_meant(at)).map(prior).sum());
    if meant > 0.0 { all / meant } else { 0.0 }
}

/// The share of a kind of task in the lessons.
fn share_of_kind(bitext: BitextRef<'_>, token: Symbol) -> f32 {
    let of_kind = |wanted: Option<Symbol>| -> f32 {
        let pairs = bitext.pairs().iter().filter(|pair| wanted.is_none() || form(bitext.command(pair.command)) == wanted);
        pairs.map(|pair| pair.weight).sum()
    };
    (of_kind(Some(token)) + 0.5 / LIFTED_TASKS as f32) / (of_kind(None) + 0.5)
}
