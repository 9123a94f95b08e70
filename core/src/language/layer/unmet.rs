//! Kinds of task that were never meant, compared with those that were.
//!
//! **Ways.** For the role model, a kind that was never meant counts as one session. That is right in the scenes of the lessons. In another
//! scene, if only commands with ways were heard before, "move to the red room" would avoid some room that nobody named. There, a kind
//! without a way is as probable as the kinds that add a way to its goals are on average. With q the probability of a kind by the words
//! alone, and K the kinds that were meant and add a way to the goals of l, all tasks of a kind l without a way that was never meant are
//! multiplied by
//!
//! ```text
//! max(1, mean of q(k) over K / q(l)),   if there are any K
//! ```
//!
//! **Things.** A kind may be one that no session could mean, because it needs things that were in no scene. The words for them were not
//! learned either, so they are new. With r the share of sessions with a word that no other session has, the probability of these kinds
//! together is 1 - r after a command with a new word, and r after another. After the layer has weighed the tasks, those of these kinds that
//! have a way divide their common probability as the kinds that were meant do with the same ways.

use super::weighed::{Group, Weighed};
use crate::language::bitext::BitextRef;
use crate::language::roles::kind::Kinds;
use crate::language::tables::TablesRef;
use crate::symbols::Symbol;
use crate::task::description::{form, groups};
use crate::task::role::{Role, RoleKind};
use alloc::collections::BTreeMap;
use alloc::vec::Vec;

/// Corrects the role model's posterior for kinds without a way that were never meant. `description` returns the description of the task at
/// a position, and `possible` has the tasks of all sessions.
pub(super) fn weigh_ways<'d>(
    tables: TablesRef<'_>,
    possible: BitextRef<'_>,
    sentence: &[Option<Symbol>],
    description: &dyn Fn(usize) -> &'d [Symbol],
    tasks: &mut [Weighed],
) {
    let was_possible = |position: usize| (0..possible.commands() as u16).any(|task| possible.command(task) == description(position));
    if !tables.layout().has_ways() || (0..tasks.len()).all(was_possible) {
        return;
    }
    // A task of each kind, and whether the kind was meant.
    let kinds: BTreeMap<Option<Symbol>, (&'d [Symbol], bool)> = tasks
        .iter()
        .enumerate()
        .map(|(position, task)| (form(description(position)), (description(position), task.group == Group::Met)))
        .collect();
    let known: Vec<Symbol> = sentence.iter().copied().flatten().filter(|word| word.index() < tables.words()).collect();
    let shares = Kinds::of(tables.layout(), tables.cells().1, &known, sentence.len().saturating_sub(known.len()));
    let share = |task: &[Symbol]| form(task).map_or(0.0, |kind| shares.share(tables.layout(), kind));
    let factor = |&(task, is_met): &(&'d [Symbol], bool)| {
        let adds_way = |&&(other, is_met): &&(&'d [Symbol], bool)| is_met && has_way(other) && goals(other).eq(goals(task));
        let with_way: Vec<f32> = kinds.values().filter(adds_way).map(|(other, _)| share(other)).collect();
        if is_met || has_way(task) || with_way.is_empty() {
            return 1.0;
        }
        // The share may be 0 in an f32.
        (with_way.iter().sum::<f32>() / with_way.len() as f32 / share(task).max(f32::MIN_POSITIVE)).max(1.0)
    };
    let factors: BTreeMap<Option<Symbol>, f32> = kinds.iter().map(|(&form, kind)| (form, factor(kind))).collect();
    let mut whole = 0.0;
    for (position, task) in tasks.iter_mut().enumerate() {
        task.understood *= factors.get(&form(description(position))).copied().unwrap_or(1.0);
        whole += task.understood;
    }
    if whole > 0.0 {
        tasks.iter_mut().for_each(|task| task.understood /= whole);
    }
}

/// Divides the probability between kinds that no session could mean and all others, by whether there is a new word. `new_words` is the
/// share of sessions with a word that no other has.
pub(super) fn weigh_impossible(tables: TablesRef<'_>, new_words: f32, sentence: &[Option<Symbol>], tasks: &mut [Weighed]) {
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
pub(super) fn share_ways<'d>(description: &dyn Fn(usize) -> &'d [Symbol], tasks: &mut [Weighed]) {
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
    roles(description, |kind| kind.index() >= RoleKind::WITHOUT_WAYS)
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
