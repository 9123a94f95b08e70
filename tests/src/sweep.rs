//! One sweep backward from all goals, for every task in every state that can be reached: an oracle for the plans of one state.
//!
//! It carries sets of tasks from the goals along the actions, one level of cost at a time, and keeps for each state and action the tasks
//! for which that action is optimal there.

use goodbot::oomdp::{Action, ActionSet, Domain};
use goodbot::task::{GroundedTask, LiftedTask, TaskSet};

const UNREACHED: u32 = u32::MAX;

/// The optimal sets of every state that can be reached from one.
#[derive(Debug)]
pub struct Sweep {
    /// The position of each state among the reached ones, by its number.
    positions: Vec<u32>,
    actions: usize,
    /// For each state that can be reached, the tasks whose goal can be reached from it.
    reachable: Vec<TaskSet>,
    /// For each state and action, the tasks for which the action begins a shortest way.
    toward: Vec<TaskSet>,
}

/// An action that leads to a state, from another.
#[derive(Clone, Copy, Debug)]
struct Edge {
    from: u32,
    action: u8,
    to: u32,
}

impl Sweep {
    /// Sweeps all states that can be reached from `start`. Their numbers must be below a number that fits into memory.
    pub fn new<D: Domain>(domain: &D, start: &D::State, lifted: &[LiftedTask], tasks: &[GroundedTask]) -> Self {
        let actions = domain.actions().len();
        let mut sweep = Self {
            positions: vec![UNREACHED; usize::try_from(domain.state_count()).expect("states that can be counted")],
            actions,
            reachable: vec![],
            toward: vec![],
        };
        let (states, mut edges) = sweep.flood(domain, start);
        // By the state they lead to.
        edges.sort_unstable_by_key(|edge| edge.to);
        let begin_of = |state: usize| edges.partition_point(|edge| (edge.to as usize) < state);
        let begins: Vec<usize> = (0..=states.len()).map(begin_of).collect();

        sweep.reachable = states.iter().map(|state| satisfied(domain, state, lifted, tasks)).collect();
        sweep.toward = vec![TaskSet::EMPTY; states.len() * actions];
        let goals = sweep.reachable.iter().copied().enumerate().filter(|(_, met)| !met.is_empty()).collect();
        let costs: Vec<usize> = domain.actions().iter().map(|kind| usize::from(kind.cost)).collect();
        let highest = costs.iter().copied().max().unwrap_or(1);
        // At each level, the states with their new tasks.
        let mut levels: Vec<Vec<(usize, TaskSet)>> = vec![goals];
        let mut gained = vec![TaskSet::EMPTY; states.len()];
        while levels.iter().rev().take(highest).any(|level| !level.is_empty()) {
            let mut met = vec![];
            for cost in 1..=highest.min(levels.len()) {
                for &(state, tasks) in &levels[levels.len() - cost] {
                    let into = edges[begins[state]..begins[state + 1]].iter().filter(|edge| costs[usize::from(edge.action)] == cost);
                    for edge in into {
                        let before = edge.from as usize;
                        let new = tasks.without(sweep.reachable[before]);
                        if !new.is_empty() {
                            let toward = &mut sweep.toward[before * actions + usize::from(edge.action)];
                            *toward = toward.union(new);
                            if gained[before].is_empty() {
                                met.push(before);
                            }
                            gained[before] = gained[before].union(new);
                        }
                    }
                }
            }
            let level = met.into_iter().map(|state| (state, std::mem::take(&mut gained[state])));
            let level: Vec<(usize, TaskSet)> =
                level.inspect(|&(state, new)| sweep.reachable[state] = sweep.reachable[state].union(new)).collect();
            levels.push(level);
        }
        sweep
    }

    fn flood<D: Domain>(&mut self, domain: &D, start: &D::State) -> (Vec<D::State>, Vec<Edge>) {
        let (mut states, mut edges, mut next) = (vec![*start], vec![], 0);
        self.positions[domain.number(start) as usize] = 0;
        while let Some(state) = states.get(next).copied() {
            for action in (0..self.actions).map(|action| action as u8) {
                let Some(there) = domain.step(&state, Action::new(action)) else { continue };
                let position = &mut self.positions[domain.number(&there) as usize];
                if *position == UNREACHED {
                    *position = states.len() as u32;
                    states.push(there);
                }
                edges.push(Edge { from: next as u32, action, to: *position });
            }
            next += 1;
        }
        (states, edges)
    }

    fn position<D: Domain>(&self, domain: &D, state: &D::State) -> Option<usize> {
        self.positions.get(domain.number(state) as usize).filter(|&&position| position != UNREACHED).map(|&position| position as usize)
    }

    /// How many states can be reached.
    pub fn states(&self) -> usize {
        self.reachable.len()
    }

    /// Whether the state can be reached.
    pub fn knows<D: Domain>(&self, domain: &D, state: &D::State) -> bool {
        self.position(domain, state).is_some()
    }

    /// The tasks whose goal can be reached from a state, those included that hold there.
    pub fn reachable<D: Domain>(&self, domain: &D, state: &D::State) -> TaskSet {
        self.position(domain, state).map_or(TaskSet::EMPTY, |position| self.reachable[position])
    }

    /// The actions that begin a shortest way to a task's goal: none where the task holds or is a dead end.
    pub fn toward<D: Domain>(&self, domain: &D, state: &D::State, task: usize) -> ActionSet {
        let Some(position) = self.position(domain, state) else { return ActionSet::EMPTY };
        let toward = &self.toward[position * self.actions..][..self.actions];
        let begins = toward.iter().enumerate().filter(|(_, tasks)| tasks.contains(task));
        begins.fold(ActionSet::EMPTY, |set, (action, _)| set.with(Action::new(action as u8)))
    }

    /// The cost of a shortest way to a task's goal, by following it.
    pub fn distance<D: Domain>(&self, domain: &D, state: &D::State, task: usize) -> Option<u32> {
        if !self.reachable(domain, state).contains(task) {
            return None;
        }
        let (mut state, mut distance) = (*state, 0);
        while let Some(action) = self.toward(domain, &state, task).iter().next() {
            distance += u32::from(domain.actions()[action.index()].cost);
            state = domain.step(&state, action)?;
        }
        Some(distance)
    }
}

/// The tasks that hold in a state.
pub fn satisfied<D: Domain>(domain: &D, state: &D::State, lifted: &[LiftedTask], tasks: &[GroundedTask]) -> TaskSet {
    let holds = |task: &GroundedTask| task.is_reached(&lifted[usize::from(task.lifted)], |part| domain.holds(part, state));
    tasks.iter().enumerate().filter(|(_, task)| holds(task)).fold(TaskSet::EMPTY, |set, (position, _)| set.with(position))
}
