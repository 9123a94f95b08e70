//! Plans within a window of regions, for memories that cannot hold the robot and one piece on the whole floor.
//!
//! First, a piece's path to the goal is found as if the robot could stand anywhere. Then one search moves the robot and that piece within a
//! window: the regions of the two, the regions along the piece's path as far as they fit the memory, and then those around. The subgoal of
//! the piece is its goal if that is in the window, else the last cell of its path in the window. If the robot is too far away for one
//! window, it first goes behind the piece alone. If the window has no plan, the robot goes there too, and then moves the piece by one cell.
//! All other pieces stay in place. Such a plan is good for the next action, not for the whole task: its distance is that to the subgoal.

use super::trail::Trail;
use crate::oomdp::{CellId, Piece, PushGrid};
use crate::planning::bitboard::{RowSearch, Subgoal, View, region};
use crate::planning::deadlock::moves;
use crate::planning::goals::Goals;
use crate::task::TaskSet;

/// The input for finding a task's windows.
pub(super) struct Scene<'d, G: PushGrid + ?Sized> {
    pub(super) grid: &'d G,
    pub(super) goals: &'d Goals<'d>,
    pub(super) state: &'d G::State,
}

/// The outcome of a call: no search, one that is not ready yet, or this one.
pub(super) type Found = Option<Option<(RowSearch, Subgoal)>>;

/// The preparation of a search for a task from a state.
#[derive(Clone, Copy, Debug)]
pub(super) struct Errand {
    task: usize,
    /// The piece to move; `None` before it is chosen.
    piece: Option<Piece>,
    /// Whether it is another try to move the piece: the robot goes to the cell behind it, or, if it is there, moves it to the next cell.
    pub(super) is_retry: bool,
    step: Step,
}

/// A piece, its window, and its subgoal.
#[derive(Clone, Copy, Debug)]
struct Leg {
    piece: Piece,
    window: u32,
    to: Option<CellId>,
}

/// The next step.
#[derive(Clone, Copy, Debug)]
enum Step {
    /// Choose the piece.
    Begin,
    /// Find its own path, and so the cell from which the robot moves it.
    Ahead(Trail),
    /// Find the robot's path to that cell.
    Between(Trail, CellId),
    /// Find the path of the leg.
    Along(Leg, Trail),
    /// Extend the window along that path; its cells up to this one fit.
    Follow(Leg, Trail, CellId),
    /// Extend the window around its earlier regions, from this cell on.
    Widen(Leg, u32, usize),
}

impl Errand {
    /// The first search for a task.
    pub(super) const fn of(task: usize) -> Self {
        Self { task, piece: None, is_retry: false, step: Step::Begin }
    }

    /// Another try after a search without a plan.
    pub(super) const fn after(failed: Subgoal) -> Self {
        Self { task: failed.task, piece: Some(failed.piece), is_retry: true, step: Step::Begin }
    }

    /// Continues, with about `left` cells at most. `marks` holds zeros at the beginning and at the end; do not change it meanwhile.
    #[inline(never)]
    pub(super) fn advance<G: PushGrid + ?Sized>(&mut self, scene: &Scene<'_, G>, marks: &mut [u64], left: &mut u32) -> Found {
        while *left > 0 {
            let found = self.go_on(scene, marks, left)?;
            if found.is_some() {
                return Some(found);
            }
        }
        Some(None)
    }

    fn go_on<G: PushGrid + ?Sized>(&mut self, scene: &Scene<'_, G>, marks: &mut [u64], left: &mut u32) -> Found {
        let cells = scene.grid.floor().cells;
        let robot = scene.region(scene.cell(Piece::ROBOT));
        match self.step {
            Step::Begin => {
                let asked = scene.goals.pieces_of(self.task)?;
                let open = |&piece: &Piece| asked & piece.bit() != 0 && !scene.is_goal(self.task, piece, scene.cell(piece));
                // The robot comes last: its own cell changes as it moves the others.
                let first = || (0..scene.grid.pieces()).rev().map(|piece| Piece(piece as u8)).find(open);
                let piece = self.piece.or_else(first)?;
                self.piece = Some(piece);
                let here = scene.region(scene.cell(piece));
                if !self.is_retry && here == robot {
                    return self.go_along(scene, marks, Leg { piece, window: here, to: None });
                }
                self.step = Step::Ahead(Trail::begin(marks, cells.len(), scene.cell(piece))?);
                Some(None)
            }
            Step::Ahead(mut trail) => {
                let piece = self.piece?;
                let is_found = scene.find_on(self.task, &mut trail, marks, piece, None, left);
                self.step = Step::Ahead(trail);
                let Some(is_found) = is_found else { return Some(None) };
                let next = Some(scene.cell(piece)).filter(|_| is_found).and_then(|here| trail.next(marks, here));
                trail.clear(marks);
                let behind = next.and_then(|next| scene.behind(piece, next));
                let leg = Leg { piece, window: scene.region(scene.cell(piece)) | robot, to: None };
                if self.is_retry {
                    let (next, behind) = (next?, behind?);
                    if scene.cell(Piece::ROBOT) != behind {
                        return self.go_along(scene, marks, Leg { piece: Piece::ROBOT, window: robot, to: Some(behind) });
                    }
                    let window = scene.region(behind) | scene.region(scene.cell(piece)) | scene.region(next);
                    return Some(Some(scene.search(self.task, marks.len(), Leg { piece, window, to: Some(next) })?));
                }
                let Some(behind) = behind else { return self.go_along(scene, marks, leg) };
                self.step = Step::Between(Trail::begin(marks, cells.len(), scene.cell(Piece::ROBOT))?, behind);
                Some(None)
            }
            Step::Between(mut trail, behind) => {
                let piece = self.piece?;
                let is_found = scene.find_on(self.task, &mut trail, marks, Piece::ROBOT, Some(behind), left);
                self.step = Step::Between(trail, behind);
                let Some(is_found) = is_found else { return Some(None) };
                let mut leg = Leg { piece, window: scene.region(scene.cell(piece)) | robot, to: None };
                if is_found {
                    leg.window = trail.cells(marks).fold(leg.window, |regions, cell| regions | scene.region(cell));
                }
                trail.clear(marks);
                if is_found && scene.search(self.task, marks.len(), leg).is_none() {
                    leg = Leg { piece: Piece::ROBOT, window: robot, to: Some(behind) };
                }
                *left = 0;
                self.go_along(scene, marks, leg)
            }
            Step::Along(leg, mut trail) => {
                let is_found = scene.find_on(self.task, &mut trail, marks, leg.piece, leg.to, left);
                self.step = match is_found {
                    None => Step::Along(leg, trail),
                    Some(true) => Step::Follow(leg, trail, scene.cell(leg.piece)),
                    Some(false) => {
                        trail.clear(marks);
                        return None;
                    }
                };
                Some(None)
            }
            Step::Follow(mut leg, trail, mut last) => {
                let next = trail.next(marks, last);
                let mut fits = true;
                if let Some(next) = next {
                    let larger = Leg { window: scene.region(next) | leg.window, ..leg };
                    if larger.window != leg.window {
                        fits = scene.search(self.task, marks.len(), larger).is_some();
                        *left = left.saturating_sub(cells.len() as u32);
                    }
                    if fits {
                        (leg, last) = (larger, next);
                        self.step = Step::Follow(leg, trail, last);
                        *left = left.saturating_sub(1);
                        return Some(None);
                    }
                }
                trail.clear(marks);
                if last == scene.cell(leg.piece) {
                    return None;
                }
                leg.to = if fits { leg.to } else { Some(last) };
                self.step = Step::Widen(leg, leg.window, 0);
                Some(None)
            }
            Step::Widen(mut leg, before, at) => {
                let Some(cell) = cells.get(at) else {
                    if leg.window != before {
                        self.step = Step::Widen(leg, leg.window, 0);
                        return Some(None);
                    }
                    return Some(Some(scene.search(self.task, marks.len(), leg)?));
                };
                *left = left.saturating_sub(1);
                for beside in cell.neighbours.into_iter().filter(|&beside| region(cell) & before != 0 && beside != CellId::NONE) {
                    let larger = Leg { window: scene.region(beside) | leg.window, ..leg };
                    if larger.window != leg.window {
                        *left = left.saturating_sub(cells.len() as u32);
                        if scene.search(self.task, marks.len(), larger).is_some() {
                            leg = larger;
                        }
                    }
                }
                self.step = Step::Widen(leg, before, at.wrapping_add(1));
                Some(None)
            }
        }
    }

    /// Begins the search that moves a piece along its path, in as large a window as fits: first along the path, then around it.
    fn go_along<G: PushGrid + ?Sized>(&mut self, scene: &Scene<'_, G>, marks: &mut [u64], leg: Leg) -> Found {
        scene.search(self.task, marks.len(), leg)?;
        let trail = Trail::begin(marks, scene.grid.floor().cells.len(), scene.cell(leg.piece))?;
        self.step = Step::Along(leg, trail);
        Some(None)
    }
}

impl<G: PushGrid + ?Sized> Scene<'_, G> {
    /// The cell from which the robot moves a piece to a neighbour cell.
    fn behind(&self, piece: Piece, next: CellId) -> Option<CellId> {
        let (here, floor) = (self.cell(piece), self.grid.floor());
        let direction = (0..4).find(|&direction| floor.neighbour(here, direction) == next)?;
        Some(floor.neighbour(here, direction ^ 1)).filter(|&behind| behind != CellId::NONE)
    }

    /// The search that moves a piece in a window, if it fits into this many words.
    #[inline(never)]
    fn search(&self, task: usize, words: usize, leg: Leg) -> Option<(RowSearch, Subgoal)> {
        let Leg { piece, window, to } = leg;
        let subgoal = Subgoal { task, piece, to };
        let view = View { moving: Piece::ROBOT.bit() | piece.bit(), window, subgoal: Some(subgoal) };
        RowSearch::layout(self.grid, self.goals, TaskSet::of(task), view, None, words).map(|search| (search, subgoal))
    }

    /// Continues to find the path of one piece alone, around the others: to a cell, or to a cell that satisfies the task.
    #[inline(never)]
    fn find_on(&self, task: usize, trail: &mut Trail, marks: &mut [u64], piece: Piece, to: Option<CellId>, left: &mut u32) -> Option<bool> {
        let others = || (1..self.grid.pieces()).map(|other| Piece(other as u8)).filter(move |&other| other != piece);
        let is_free = move |&cell: &CellId| !others().any(|other| self.cell(other) == cell);
        let beside = |cell: CellId| moves(self.grid, piece, cell).filter(is_free);
        let is_goal = |cell: CellId| to.map_or_else(|| self.is_goal(task, piece, cell), |to| cell == to);
        trail.find_on(marks, left, beside, is_goal)
    }

    fn is_goal(&self, task: usize, piece: Piece, cell: CellId) -> bool {
        self.goals.allowed(self.grid, self.state, piece, cell).contains(task)
    }

    fn cell(&self, piece: Piece) -> CellId {
        self.grid.cell(self.state, piece)
    }

    fn region(&self, cell: CellId) -> u32 {
        self.grid.floor().cells.get(cell.index()).map_or(0, region)
    }
}
