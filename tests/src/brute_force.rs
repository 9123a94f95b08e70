//! Plans by brute force: distances by relaxing every edge until nothing changes, optimal sets by their definition.

use crate::reachable::reachable;
use goodbot::oomdp::{Action, ActionSet, Domain};
use goodbot::planning::OptimalSet;
use goodbot::task::{GroundedTask, LiftedTask};

/// The plans of every state that can be reached from one.
pub struct BruteForce<S> {
    /// The states, in the order of their numbers.
    pub states: Vec<S>,
    edges: Vec<Vec<(Action, u32, usize)>>,
    /// For each task, the distance of each state.
    pub distances: Vec<Vec<Option<u32>>>,
}

impl<S: Copy + PartialEq> BruteForce<S> {
    /// Plans for all `tasks` from all states that can be reached from `start`.
    pub fn new<D: Domain<State = S>>(domain: &D, start: &S, lifted: &[LiftedTask], tasks: &[GroundedTask]) -> Self {
        let actions: Vec<Action> = (0..domain.actions().len()).map(|position| Action::new(position as u8)).collect();
        let found = reachable(domain, start);
        let numbers: Vec<u64> = found.keys().copied().collect();
        let states: Vec<S> = found.into_values().collect();
        let at = |state: &S| numbers.binary_search(&domain.number(state)).expect("a state that can be reached");
        let leads = |state: &S, action: Action| {
            let next = domain.step(state, action)?;
            Some((action, u32::from(domain.actions()[action.index()].cost), at(&next)))
        };
        let edges: Vec<Vec<_>> = states.iter().map(|state| actions.iter().filter_map(|&action| leads(state, action)).collect()).collect();
        let distances = tasks
            .iter()
            .map(|task| {
                let goal = |state: &S| task.is_reached(&lifted[usize::from(task.lifted)], |part| domain.holds(part, state));
                let mut distances: Vec<Option<u32>> = states.iter().map(|state| goal(state).then_some(0)).collect();
                let mut changed = true;
                while changed {
                    changed = false;
                    for (from, edges) in edges.iter().enumerate() {
                        for &(_, cost, to) in edges {
                            let through = distances[to].map(|distance| distance + cost);
                            if through.is_some_and(|through| distances[from].is_none_or(|known| through < known)) {
                                distances[from] = through;
                                changed = true;
                            }
                        }
                    }
                }
                distances
            })
            .collect();
        Self { states, edges, distances }
    }

    /// The optimal set of a task in a state, both by position.
    pub fn optimal(&self, state: usize, task: usize) -> OptimalSet {
        let set = |keep: &dyn Fn(&(Action, u32, usize)) -> bool| {
            self.edges[state].iter().filter(|edge| keep(edge)).fold(ActionSet::EMPTY, |set, edge| set.with(edge.0))
        };
        let distances = &self.distances[task];
        match distances[state] {
            Some(0) => OptimalSet::Goal,
            Some(distance) => OptimalSet::Toward(set(&|&(_, cost, to)| distances[to].is_some_and(|rest| rest + cost == distance))),
            None => OptimalSet::DeadEnd(set(&|_| true).with(Action::NOOP)),
        }
    }
}
