//! Dead ends that are told without a search: a task asks of one variable what it can never become, whatever all else does.
//!
//! A block in a corner goes nowhere, and one along a wall stays there. So a block's places are followed from where it is, as if nothing else
//! were in the way and the robot were wherever it has to be. A task that asks for none of these places is a dead end. Others may be one
//! too: that is for the search to find out.

use crate::oomdp::Domain;
use crate::planning::GoalTable;
use crate::planning::lanes::{insert, take_from};
use crate::task::TaskSet;

/// The tasks that no variable rules out for ever. `scratch` holds nothing but zeroes, and does so afterwards; where it is too small, less
/// is ruled out.
pub(super) fn possible<D: Domain + ?Sized>(
    domain: &D,
    goals: &GoalTable<'_>,
    state: &D::State,
    tasks: TaskSet,
    scratch: &mut [u64],
) -> TaskSet {
    let ways = domain.ways_on();
    if ways == 0 {
        return tasks;
    }
    let mut possible = tasks;
    for variable in (0..domain.variables()).filter(|&variable| domain.stands_still(variable)) {
        let words = domain.values(variable).div_ceil(64);
        let Some((seen, rest)) = scratch.split_at_mut_checked(words) else { return possible };
        let Some(open) = rest.get_mut(..words) else { return possible };
        let value = domain.value(state, variable);
        insert(seen, value);
        insert(open, value);
        let (mut reached, mut cursor) = (TaskSet::EMPTY, 0);
        while let Some(value) = take_from(open, &mut cursor) {
            let there = domain.with_value(state, variable, value);
            reached = reached.union(goals.not_ruled_out(domain, &there, variable));
            if possible.without(reached).is_empty() {
                break;
            }
            for next in (0..ways).filter_map(|way| domain.way_on(variable, value, way)) {
                if insert(seen, next) && insert(open, next) {
                    cursor = cursor.min(next / 64);
                }
            }
        }
        seen.fill(0);
        open.fill(0);
        possible = possible.common(reached);
    }
    possible
}
