//! Kinds of task that were never meant, beside those that were, where tasks have ways and the scene is new.
//!
//! The role model gives a kind that was never meant what one session would. It also divides each kind's Pr(e|t) by three quarters of what
//! they are together, so that how well the words fit a kind counts little against how often it was meant. That is right where the lessons
//! were given. In another scene, where only ways were heard before, "move to the red room" would avoid some room that nobody named. There
//! two things are known better:
//!
//! - A way comes on top of a goal. A kind without a way is as probable as a kind that adds a way to its goals is on average.
//! - How much of a task the words name is the same question for all kinds, and counts whole.
//!
//! With q the probability of a kind by the words alone, K the kinds that were meant and add a way to the goals of l, a the role model's
//! posterior, and n(t) how probable it is that so much of t is named as the words do, all tasks of l are multiplied by
//!
//! ```text
//! f(l) max(1, mean of q(k) over K / q(l)),   f(l) = (sum of a(t) / sum of a(t) / n(t))^(3/4) over the tasks t of l
//! ```
//!
//! and all others by the mean of f over what was meant. Kinds that were meant keep their shares of what they have together: the layer has
//! learned to tell those apart.

use super::posterior::Weighed;
use crate::language::bitext::BitextRef;
use crate::language::roles::forward::named;
use crate::language::roles::kind::Kinds;
use crate::language::tables::TablesRef;
use crate::probability::square_root;
use crate::symbols::Symbol;
use crate::task::description::{form, groups};
use crate::task::role::{Role, RoleKind};
use alloc::collections::{BTreeMap, BTreeSet};
use alloc::vec::Vec;

/// What is known of a kind of task.
struct Kind<'d> {
    /// A task of it.
    example: &'d [Symbol],
    met: bool,
    /// What its tasks have together.
    whole: f32,
    /// What they would have if the words named of each as much as they do for sure.
    without_naming: f32,
    /// What the kind is weighed by.
    factor: f32,
    /// Whether it was possible in some session.
    was_possible: bool,
    /// Whether it was never meant, but kinds that were tell how probable it is.
    is_known_by_others: bool,
}

/// Weighs anew what the role model makes of kinds that were never meant. `description` gives the description of the task at a position, and
/// `possible` has the tasks of all sessions.
pub(super) fn weigh<'d>(
    tables: TablesRef<'_>,
    possible: BitextRef<'_>,
    sentence: &[Option<Symbol>],
    description: impl Fn(usize) -> &'d [Symbol],
    tasks: &mut [Weighed],
) {
    let is_mixed = tasks.iter().any(|task| task.met) && tasks.iter().any(|task| !task.met);
    if !is_mixed || !tables.layout().has_ways() {
        return;
    }
    let was_possible = |position: usize| (0..possible.commands() as u16).any(|task| possible.command(task) == description(position));
    if (0..tasks.len()).all(was_possible) {
        return;
    }
    let forms: BTreeSet<Option<Symbol>> = (0..possible.commands() as u16).map(|task| form(possible.command(task))).collect();
    let mut kinds: BTreeMap<Option<Symbol>, Kind<'d>> = BTreeMap::new();
    for (position, task) in tasks.iter().enumerate() {
        let example = description(position);
        let kind = kinds.entry(form(example)).or_insert(Kind {
            example,
            met: task.met,
            whole: 0.0,
            without_naming: 0.0,
            factor: 0.0,
            was_possible: forms.contains(&form(example)),
            is_known_by_others: false,
        });
        if task.understood > 0.0 {
            kind.whole += task.understood;
            kind.without_naming += task.understood / named(tables.layout(), tables.cells(), sentence, example).max(f32::MIN_POSITIVE);
        }
    }
    let known: Vec<Symbol> = sentence.iter().copied().flatten().filter(|word| word.index() < tables.words()).collect();
    let shares = Kinds::of(tables.layout(), tables.cells().1, &known, sentence.len().saturating_sub(known.len()));
    let share = |kind: Option<Symbol>| kind.map_or(0.0, |kind| shares.share(tables.layout(), kind));
    let with_ways: Vec<(&'d [Symbol], f32)> =
        kinds.iter().filter(|(_, kind)| kind.met && has_way(kind.example)).map(|(&form, kind)| (kind.example, share(form))).collect();
    for (&form, kind) in &mut kinds {
        let root = square_root(if kind.without_naming > 0.0 { kind.whole / kind.without_naming } else { 0.0 });
        kind.factor = root * square_root(root);
        let is_like = |other: &[Symbol]| {
            let is_of_same_goals = !kind.was_possible || goals(other).eq(goals(kind.example));
            is_of_same_goals && (!has_way(kind.example) || (!kind.was_possible && way(other).eq(way(kind.example))))
        };
        let alike = || with_ways.iter().filter(|(other, _)| is_like(other)).map(|(_, share)| share);
        let count = alike().count();
        if !kind.met && count > 0 {
            let of_one = alike().sum::<f32>() / count as f32;
            // A share may be too small for an f32.
            kind.factor *= (of_one / share(form).max(f32::MIN_POSITIVE)).max(1.0);
            kind.is_known_by_others = true;
        }
    }
    let kind = |position: usize| kinds.get(&form(description(position)));
    let factor = |position: usize| kind(position).map_or(1.0, |kind| kind.factor);
    let (mut before, mut after) = (0.0, 0.0);
    for (position, task) in tasks.iter().enumerate().filter(|(_, task)| task.met) {
        before += task.understood;
        after += task.understood * factor(position);
    }
    let of_met = if before > 0.0 { after / before } else { 0.0 };
    let mut whole = 0.0;
    for (position, task) in tasks.iter_mut().enumerate() {
        task.understood *= if kind(position).is_some_and(|kind| kind.is_known_by_others) { factor(position) } else { of_met };
        whole += task.understood;
    }
    if whole > 0.0 {
        tasks.iter_mut().for_each(|task| task.understood /= whole);
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

/// The roles of some kinds.
fn roles(description: &[Symbol], is_wanted: impl Fn(RoleKind) -> bool) -> impl Iterator<Item = Role> {
    let mut last = None;
    groups(description).map(|group| group.marker.role).filter(move |&role| is_wanted(role.kind()) && last.replace(role) != Some(role))
}

/// Whether a task says how.
fn has_way(description: &[Symbol]) -> bool {
    way(description).next().is_some()
}
