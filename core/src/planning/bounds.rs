//! Exact plans where the joint states of all pieces do not fit the memory, by bounds on the distance.
//!
//! 1. *The lower bound.* The pieces that a task does not depend on are removed. Each plan of the floor is also a plan without them, so the
//!    distance without them is never longer. One backward search finds it for all cells of the robot and one piece (see `relaxation`).
//!    Tasks with the same goal cells share it. A task that is impossible without the other pieces is impossible with them.
//! 2. *The upper bound.* A* with that lower bound as heuristic looks for a plan as short (see `a_star`). It brings back those removed
//!    pieces that are in the way. A plan that enters no cell of a removed piece is also a plan of the floor, so the two bounds agree, and
//!    the optimal set is exact.
//!
//! The work grows with the square of the cells, and with the number of pieces in the way, not with the number of pieces. Tasks that A*
//! leaves open within its memory and work stay open.

mod a_star;
mod relaxation;

use self::a_star::{AStar, Outcome, Scene};
use self::relaxation::{Bound, Relaxation, others, piece_of};
use super::goals::Goals;
use super::plan::Results;
use crate::oomdp::{Piece, PushGrid, own_actions};
use crate::task::TaskSet;

/// The most expansions of A* for one task.
const MOST_EXPANSIONS: u32 = 1 << 16;
/// The same for an unlikely task, if there are more tasks than one word has bits: 200 of them together get fewer expansions than their
/// lower bounds take in ten rooms.
const FEW_EXPANSIONS: u32 = 1 << 8;

/// The tasks still to bound, and the current work.
#[derive(Clone, Copy, Debug)]
pub(super) struct Bounds {
    /// The tasks without a lower bound yet.
    waiting: TaskSet,
    /// The tasks that share the current lower bound.
    group: TaskSet,
    /// The tasks that get the full work.
    likely: TaskSet,
    relaxation: Option<Relaxation>,
    /// The last search of the group, which may have left a sharper bound.
    search: Option<AStar>,
}

/// A state of A* has so many bits for its first actions.
const MOST_ACTIONS: usize = 16;

/// Whether bounds are sound on this floor: every action costs 1, pieces move only by a plain push or a swap, and A* can tell the actions
/// apart.
fn is_sound<G: PushGrid>(grid: &G) -> bool {
    let directions = grid.floor().directions;
    grid.pushes_plainly()
        && own_actions(grid).count() <= MOST_ACTIONS
        && grid.actions().iter().all(|kind| kind.cost == 1)
        && (grid.swaps() || own_actions(grid).all(|action| directions.contains(&action)))
}

impl Bounds {
    /// Begins for these tasks, of which the likely ones get the full work if there are many; `None` on a floor where bounds are not sound.
    pub(super) fn new<G: PushGrid>(grid: &G, tasks: TaskSet, likely: TaskSet) -> Option<Self> {
        is_sound(grid).then_some(Self { waiting: tasks, group: TaskSet::EMPTY, likely, relaxation: None, search: None })
    }

    /// Continues, with at most `left` expansions. Returns whether there is more to do. To open a lower bound's goals is one step, and so is to
    /// clear what a search met. `marks` holds zeros at the beginning, and again at the end.
    pub(super) fn advance<G: PushGrid>(
        &mut self,
        marks: &mut [u64],
        results: &mut Results<'_>,
        grid: &G,
        goals: &Goals<'_>,
        state: &G::State,
        left: &mut u32,
    ) -> bool {
        while *left > 0 {
            let Some(relaxation) = &mut self.relaxation else {
                if !self.next_group(marks, grid, goals, state) {
                    return false;
                }
                *left = left.saturating_sub(grid.floor().cells.len() as u32);
                continue;
            };
            if !relaxation.search(marks, grid, left) {
                continue;
            }
            let scene = Scene { grid, goals, relaxation, start: state, rest: self.group.common(self.likely) };
            if let Some(search) = self.search.as_mut().filter(|search| search.is_open())
                && search.advance(marks, results, &scene, left) == Outcome::Working
            {
                continue;
            }
            // The likely tasks come first: the others then have their sharper bound.
            let Some(task) = scene.rest.iter().chain(self.group.iter()).next() else {
                if let Some(search) = self.search.take() {
                    search.clear(marks);
                }
                relaxation.clear(marks);
                self.relaxation = None;
                continue;
            };
            self.group = self.group.without(TaskSet::of(task));
            let Some(piece) = piece_of(grid, goals, state, task) else { continue };
            match relaxation.bound(marks, grid, state, piece) {
                Bound::Unreachable => results.found.rule_out(TaskSet::of(task)),
                Bound::Exactly(distance, first) => {
                    results.found.level = distance;
                    results.meet(task, first);
                    results.end_level();
                }
                Bound::AtLeast(distance) => {
                    let most = if self.likely.contains(task) { MOST_EXPANSIONS } else { FEW_EXPANSIONS };
                    let earlier = self.search.take();
                    let bound = earlier.and_then(|search| search.bound_for(marks, piece, grid.cell(state, piece)));
                    if let Some(search) = earlier.filter(|_| bound.is_none()) {
                        search.clear(marks);
                    }
                    self.search = Some(AStar::new(&scene, marks.len(), (task, piece), (distance, most), bound));
                }
                Bound::Unknown => {}
            }
        }
        true
    }

    /// Takes the next tasks that share a lower bound. Returns whether there are any.
    fn next_group<G: PushGrid>(&mut self, marks: &mut [u64], grid: &G, goals: &Goals<'_>, state: &G::State) -> bool {
        let Some(first) = self.waiting.iter().next() else { return false };
        self.relaxation = Relaxation::begin(marks, grid, goals, state, first, 0);
        let is_shared = |&task: &usize| task == first || self.relaxation.is_some_and(|it| it.is_shared_by(marks, grid, goals, state, task));
        // A look at one goal cell rules out most other tasks.
        let piece = piece_of(grid, goals, state, first).unwrap_or(Piece::ROBOT);
        let goal = grid.floor().ids().find(|&cell| goals.allowed(grid, state, piece, cell).contains(first));
        let near = goal.map_or(TaskSet::EMPTY, |cell| {
            let allowed = |other| goals.allowed(grid, state, other, cell);
            others(grid, Piece::ROBOT).map(allowed).fold(self.waiting, TaskSet::common)
        });
        self.group = near.with(first).iter().filter(is_shared).collect();
        self.waiting = self.waiting.without(self.group);
        true
    }

    /// Fills the marks with zeros.
    pub(super) fn clear(&self, marks: &mut [u64]) {
        if let Some(relaxation) = &self.relaxation {
            relaxation.clear(marks);
        }
        if let Some(search) = &self.search {
            search.clear(marks);
        }
    }
}
