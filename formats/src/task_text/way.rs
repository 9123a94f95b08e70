//! The way of a task: earlier goals, what it goes through, and what it avoids.

use super::TaskTextError;
use std::fmt;

/// The way of a task. Each list may be empty.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct WayText<A> {
    /// Earlier goals in order, each a conjunction: the parts before `then`.
    pub before: Vec<Vec<A>>,
    /// Lists of alternatives: one of each list is to hold at some time up to the end, in any order.
    pub through: Vec<Vec<A>>,
    /// Propositions that must not hold before the end.
    pub avoiding: Vec<A>,
}

impl<A> Default for WayText<A> {
    fn default() -> Self {
        WayText { before: Vec::new(), through: Vec::new(), avoiding: Vec::new() }
    }
}

impl<A> WayText<A> {
    /// Whether there is no way.
    pub fn is_empty(&self) -> bool {
        self.before.is_empty() && self.through.is_empty() && self.avoiding.is_empty()
    }
}

impl<A: Ord + Clone + fmt::Display> WayText<A> {
    /// Refuses a task without a goal, an empty clause, and a way that avoids the goal.
    pub(super) fn check(&self, goal: &[A]) -> Result<(), TaskTextError> {
        if goal.is_empty() || self.before.iter().chain(&self.through).any(Vec::is_empty) {
            return Err(TaskTextError::Empty);
        }
        let asked = |atom: &&A| goal.contains(atom) || self.through.iter().any(|clause| clause.as_slice() == std::slice::from_ref(*atom));
        match self.avoiding.iter().find(asked) {
            Some(atom) => Err(TaskTextError::AvoidsGoal { atom: atom.to_string() }),
            None => Ok(()),
        }
    }

    /// Whether another way is the same. The order counts for earlier goals only.
    pub(super) fn is_same(&self, other: &Self) -> bool {
        let each = |lists: &[Vec<A>]| lists.iter().map(|list| sorted(list)).collect::<Vec<_>>();
        each(&self.before) == each(&other.before)
            && sorted(&each(&self.through)) == sorted(&each(&other.through))
            && sorted(&self.avoiding) == sorted(&other.avoiding)
    }

    /// Writes a task: its goals, then its way.
    pub(super) fn fmt_around(&self, f: &mut fmt::Formatter<'_>, goal: &[A]) -> fmt::Result {
        for before in &self.before {
            list(f, before, " & ")?;
            f.write_str(" then ")?;
        }
        list(f, goal, " & ")?;
        for clause in &self.through {
            f.write_str(" through ")?;
            list(f, clause, " or ")?;
        }
        if !self.avoiding.is_empty() {
            f.write_str(" avoiding ")?;
            list(f, &self.avoiding, " or ")?;
        }
        Ok(())
    }
}

fn list<A: fmt::Display>(f: &mut fmt::Formatter<'_>, atoms: &[A], between: &str) -> fmt::Result {
    for (index, atom) in atoms.iter().enumerate() {
        if index > 0 {
            f.write_str(between)?;
        }
        atom.fmt(f)?;
    }
    Ok(())
}

/// The items of a list in order, each once, so that lists can be compared.
pub(super) fn sorted<A: Ord + Clone>(list: &[A]) -> Vec<A> {
    let mut list = list.to_vec();
    list.sort();
    list.dedup();
    list
}
