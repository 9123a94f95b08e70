//! Kinds of task that were never meant, compared with those that were.
//!
//! **Ways.** For the role model, a kind that was never meant counts as one session. It also divides Pr(e|t) by Z_l^(3/4), so that how well
//! the words fit a kind counts little against how often it was meant. That is right in the scenes of the lessons. In another scene, if only
//! commands with ways were heard before, "move to the red room" would avoid some room that nobody named. There, two things are known
//! better:
//!
//! - A way is added to a goal. A kind without a way is as probable as the kinds that add a way to its goals are on average.
//! - How much of a task the words name is the same question for all kinds, and counts in full.
//!
//! Let q be the probability of a kind by the words alone, K the kinds that were meant and add a way to the goals of l, a the role model's
//! posterior, and n(t) the probability that commands name as much of t as these words do. All tasks of a kind l without a way that was
//! never meant are multiplied by
//!
//! ```text
//! n(t) max(1, mean of q(k) over K / q(l)),
//! ```
//!
//! if there are any K, and all others by the mean of f over the tasks that were meant, weighted by a, with f(l) = (sum of a(t) / sum of
//! a(t) / n(t))^(3/4) over the tasks t of l. Other kinds that were never meant are also multiplied by n(t). Kinds that were meant keep
//! their shares of their common probability: the layer has learned to tell those apart.
//!
//! **Things.** A kind may be one that no session could mean, because it needs things that were in no scene. The words for them were not
//! learned either, so they are new. With r the share of sessions with a word that no other session has, the probability of these kinds
//! together is 1 - r after a command with a new word, and r after another. After the layer has weighed the tasks, those of these kinds that
//! have a way divide their common probability as the kinds that were meant do with the same ways.

use crate::weighed::{Group, Weighed};
use goodbot::language::BitextRef;
use goodbot::language::TablesRef;
use goodbot::language::roles::forward::named;
use goodbot::language::roles::kind::Kinds;
use goodbot::probability::square_root;
use goodbot::symbols::Symbol;
use goodbot::task::description::{form, groups};
use goodbot::task::{Role, RoleKind};
use std::collections::BTreeMap;

/// A kind of task in a new scene.
struct Kind<'d> {
    /// One of its tasks.
    example: &'d [Symbol],
    group: Group,
    /// The posterior of its tasks together.
    whole: f32,
    /// The same, each divided by the probability of how much of the task is named.
    without_naming: f32,
    /// The factor of the kind.
    factor: f32,
    /// Whether the kind was never meant, has no way, and some kind that was meant adds a way to its goals.
    is_without_its_way: bool,
}

/// Corrects the role model's posterior for kinds that were never meant. `description` returns the description of the task at a position,
/// and `possible` has the tasks of all sessions.
pub fn weigh_ways<'d>(
    tables: TablesRef<'_>,
    possible: BitextRef<'_>,
    sentence: &[Option<Symbol>],
    description: &dyn Fn(usize) -> &'d [Symbol],
    tasks: &mut [Weighed],
) {
    let is_met = |task: &Weighed| task.group == Group::Met;
    let is_mixed = tasks.iter().any(is_met) && !tasks.iter().all(is_met);
    if !is_mixed || !tables.layout().has_ways() {
        return;
    }
    let was_possible = |position: usize| (0..possible.commands() as u16).any(|task| possible.command(task) == description(position));
    if (0..tasks.len()).all(was_possible) {
        return;
    }
    let mut kinds: BTreeMap<Option<Symbol>, Kind<'d>> = BTreeMap::new();
    for (position, task) in tasks.iter_mut().enumerate() {
        let example = description(position);
        let naming = named(tables.layout(), tables.cells(), sentence, example).max(f32::MIN_POSITIVE);
        // The role model includes naming only for a kind that was meant.
        if task.group != Group::Met {
            task.understood *= naming;
        }
        let kind = kinds.entry(form(example)).or_insert(Kind {
            example,
            group: task.group,
            whole: 0.0,
            without_naming: 0.0,
            factor: 0.0,
            is_without_its_way: false,
        });
        if task.understood > 0.0 {
            kind.whole += task.understood;
            kind.without_naming += task.understood / naming;
        }
    }
    let known: Vec<Symbol> = sentence.iter().copied().flatten().filter(|word| word.index() < tables.words()).collect();
    let shares = Kinds::of(tables.layout(), tables.cells().1, &known, sentence.len().saturating_sub(known.len()));
    let share = |kind: Option<Symbol>| kind.map_or(0.0, |kind| shares.share(tables.layout(), kind));
    let with_ways: Vec<(&'d [Symbol], f32)> = kinds
        .iter()
        .filter(|(_, kind)| kind.group == Group::Met && has_way(kind.example))
        .map(|(&form, kind)| (kind.example, share(form)))
        .collect();
    for (&form, kind) in &mut kinds {
        let root = square_root(if kind.without_naming > 0.0 { kind.whole / kind.without_naming } else { 0.0 });
        kind.factor = if kind.group == Group::Met { root * square_root(root) } else { 1.0 };
        let of_same_goals = || with_ways.iter().filter(|(other, _)| goals(other).eq(goals(kind.example))).map(|(_, share)| share);
        let count = of_same_goals().count();
        if kind.group != Group::Met && !has_way(kind.example) && count > 0 {
            let of_one = of_same_goals().sum::<f32>() / count as f32;
            // The share may be 0 in an f32.
            kind.factor *= (of_one / share(form).max(f32::MIN_POSITIVE)).max(1.0);
            kind.is_without_its_way = true;
        }
    }
    let kind = |position: usize| kinds.get(&form(description(position)));
    let factor = |position: usize| kind(position).map_or(1.0, |kind| kind.factor);
    let (mut before, mut after) = (0.0, 0.0);
    for (position, task) in tasks.iter().enumerate().filter(|(_, task)| is_met(task)) {
        before += task.understood;
        after += task.understood * factor(position);
    }
    let of_met = if before > 0.0 { after / before } else { 0.0 };
    let mut whole = 0.0;
    for (position, task) in tasks.iter_mut().enumerate() {
        task.understood *= if kind(position).is_some_and(|kind| kind.is_without_its_way) { factor(position) } else { of_met };
        whole += task.understood;
    }
    if whole > 0.0 {
        tasks.iter_mut().for_each(|task| task.understood /= whole);
    }
}

/// Divides the probability between kinds that no session could mean and all others, by whether there is a new word. `new_words` is the
/// share of sessions with a word that no other has.
pub fn weigh_impossible(tables: TablesRef<'_>, new_words: f32, sentence: &[Option<Symbol>], tasks: &mut [Weighed]) {
    let is_impossible = |task: &Weighed| task.group == Group::Impossible;
    let (mut of_these, mut of_others) = (0.0, 0.0);
    for task in &*tasks {
        *if is_impossible(task) { &mut of_these } else { &mut of_others } += task.understood;
    }
    if of_others <= 0.0 || of_these <= 0.0 {
        return;
    }
    let has_new_word = sentence.iter().any(|word| word.is_none_or(|word| word.index() >= tables.words()));
    let these = if has_new_word { 1.0 - new_words } else { new_words };
    for task in tasks {
        let (share, whole) = if is_impossible(task) { (these, of_these) } else { (1.0 - these, of_others) };
        // In this order a tiny probability does not become 0 or NaN.
        task.understood = task.understood / whole * share;
    }
}

/// Divides the probability of the ways of kinds that no session could mean as it is divided among the same ways of kinds that were meant.
pub fn share_ways<'d>(description: &dyn Fn(usize) -> &'d [Symbol], tasks: &mut [Weighed]) {
    let mut ways: BTreeMap<Vec<Role>, [f32; 2]> = BTreeMap::new();
    let way = |position: usize| way(description(position)).collect::<Vec<Role>>();
    for (position, task) in tasks.iter().enumerate().filter(|(position, _)| has_way(description(*position))) {
        let [met, impossible] = ways.entry(way(position)).or_default();
        match task.group {
            Group::Met => *met += task.believed,
            Group::Impossible => *impossible += task.believed,
            Group::Unmet => {}
        }
    }
    ways.retain(|_, [met, impossible]| *met > 0.0 && *impossible > 0.0);
    let (all, whole) = ways.values().fold((0.0, 0.0), |(all, whole), [met, impossible]| (all + met, whole + impossible));
    for (position, task) in tasks.iter_mut().enumerate().filter(|(_, task)| task.group == Group::Impossible) {
        if let Some([met, impossible]) = ways.get(&way(position)) {
            task.believed = task.believed / impossible * whole * met / all;
        }
    }
}

/// The roles of a task's goals.
fn goals(description: &[Symbol]) -> impl Iterator<Item = Role> {
    roles(description, |kind| matches!(kind, RoleKind::Goal | RoleKind::Subject))
}

/// The roles of a task's way.
fn way(description: &[Symbol]) -> impl Iterator<Item = Role> {
    roles(description, |kind| matches!(kind, RoleKind::Through | RoleKind::Avoiding | RoleKind::Before))
}

/// The roles whose kind is wanted, each once.
fn roles(description: &[Symbol], is_wanted: impl Fn(RoleKind) -> bool) -> impl Iterator<Item = Role> {
    let mut last = None;
    groups(description).map(|group| group.marker.role).filter(move |&role| is_wanted(role.kind()) && last.replace(role) != Some(role))
}

/// Whether a task has a way.
fn has_way(description: &[Symbol]) -> bool {
    way(description).next().is_some()
}
