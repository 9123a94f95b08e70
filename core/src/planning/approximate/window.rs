//! Plans within a window of regions, for memories that cannot hold the robot and one piece on the whole floor.
//!
//! A piece's way to the goal is first looked for as if the robot were wherever it has to be. Then one search moves the robot and that piece
//! within a window: the regions of the two, those on the piece's way for as long as they fit the memory, and then what lies around. The
//! piece is to come to the goal where that is in the window, else to the last cell of its way there. Where the robot is too far off for one
//! window, it first goes behind the piece on its own. Where the window has no way, the robot goes there too, and then moves the piece by
//! one cell. All other pieces stay where they are. Such a plan is good for the next action, not for the whole way: its distance is that to
//! the subgoal.

use super::trail::Trail;
use crate::oomdp::{CellId, Piece, PushGrid};
use crate::planning::bitboard::{RowSearch, Subgoal, View, region};
use crate::planning::deadlock::moves;
use crate::planning::goals::Goals;
use crate::task::TaskSet;

/// A task to do next from a state.
pub(super) struct Errand<'d, G: PushGrid + ?Sized> {
    pub(super) grid: &'d G,
    pub(super) goals: &'d Goals<'d>,
    pub(super) state: &'d G::State,
    pub(super) task: usize,
}

impl<G: PushGrid + ?Sized> Errand<'_, G> {
    /// The first search for the task, with its subgoal. `marks` holds zeros here and in all that follows.
    #[inline(never)]
    pub(super) fn begin(&self, marks: &mut [u64]) -> Option<(RowSearch, Subgoal)> {
        let asked = self.goals.pieces_of(self.task)?;
        let open = |&piece: &Piece| asked & piece.bit() != 0 && !self.is_goal(piece, self.cell(piece));
        // The robot comes last: its own cell changes as it moves the others.
        let piece = (0..self.grid.pieces()).rev().map(|piece| Piece(piece as u8)).find(open)?;
        let (here, robot) = (self.region(self.cell(piece)), self.region(self.cell(Piece::ROBOT)));
        let mut start = here | robot;
        if here != robot
            && let Some((behind, _)) = self.first_move(marks, piece)
            && let Some(between) = self.regions_between(marks, behind)
        {
            start |= between;
            if self.search(marks.len(), piece, start, None).is_none() {
                return self.approach(marks, behind);
            }
        }
        self.along(marks, piece, start, None)
    }

    /// The regions on the robot's way to a cell.
    fn regions_between(&self, marks: &mut [u64], to: CellId) -> Option<u32> {
        let trail = self.trail(marks, Piece::ROBOT, Some(to))?;
        Some(trail.cells().fold(0, |regions, cell| regions | self.region(cell)))
    }

    /// Another try to move a piece on: the robot goes to the cell behind it, or moves it to the next cell where the robot is there.
    #[inline(never)]
    pub(super) fn one_step(&self, marks: &mut [u64], piece: Piece) -> Option<RowSearch> {
        let (behind, next) = self.first_move(marks, piece)?;
        if self.cell(Piece::ROBOT) != behind {
            return self.approach(marks, behind).map(|(search, _)| search);
        }
        let window = self.region(behind) | self.region(self.cell(piece)) | self.region(next);
        self.search(marks.len(), piece, window, Some(next)).map(|(search, _)| search)
    }

    /// The robot goes to a cell on its own.
    fn approach(&self, marks: &mut [u64], to: CellId) -> Option<(RowSearch, Subgoal)> {
        self.along(marks, Piece::ROBOT, self.region(self.cell(Piece::ROBOT)), Some(to))
    }

    /// The cell from which the robot moves a piece on its way, and the cell to which.
    fn first_move(&self, marks: &mut [u64], piece: Piece) -> Option<(CellId, CellId)> {
        let (here, floor) = (self.cell(piece), self.grid.floor());
        let next = self.trail(marks, piece, None)?.next(here)?;
        let direction = (0..4).find(|&direction| floor.neighbour(here, direction) == next)?;
        Some((floor.neighbour(here, direction ^ 1), next)).filter(|&(behind, _)| behind != CellId::NONE)
    }

    /// The search that moves a piece along its trail, in as large a window as fits: on along the trail, then around.
    #[inline(never)]
    fn along(&self, marks: &mut [u64], piece: Piece, start: u32, to: Option<CellId>) -> Option<(RowSearch, Subgoal)> {
        let mut window = start;
        let words = marks.len();
        self.search(words, piece, window, to)?;
        let trail = self.trail(marks, piece, to)?;
        let (mut last, mut arrives) = (self.cell(piece), true);
        while let Some(next) = trail.next(last) {
            let larger = self.region(next) | window;
            if larger != window && self.search(words, piece, larger, to).is_none() {
                arrives = false;
                break;
            }
            (window, last) = (larger, next);
        }
        drop(trail);
        if last == self.cell(piece) {
            return None;
        }
        loop {
            let before = window;
            for cell in self.grid.floor().cells.iter().filter(|cell| region(cell) & before != 0) {
                for beside in cell.neighbours.into_iter().filter(|&beside| beside != CellId::NONE) {
                    let larger = self.region(beside) | window;
                    if larger != window && self.search(words, piece, larger, to).is_some() {
                        window = larger;
                    }
                }
            }
            if window == before {
                break;
            }
        }
        self.search(words, piece, window, if arrives { to } else { Some(last) })
    }

    /// The search that moves a piece in a window, if it fits so many words.
    #[inline(never)]
    fn search(&self, words: usize, piece: Piece, window: u32, to: Option<CellId>) -> Option<(RowSearch, Subgoal)> {
        let subgoal = Subgoal { task: self.task, piece, to };
        let view = View { moving: Piece::ROBOT.bit() | piece.bit(), window, subgoal: Some(subgoal) };
        RowSearch::layout(self.grid, self.goals, TaskSet::of(self.task), view, None, words).map(|search| (search, subgoal))
    }

    /// The way of one piece alone, around the others: to a cell, or to where the task asks it to be.
    #[inline(never)]
    fn trail<'t>(&self, marks: &'t mut [u64], piece: Piece, to: Option<CellId>) -> Option<Trail<'t>> {
        let others = || (1..self.grid.pieces()).map(|other| Piece(other as u8)).filter(move |&other| other != piece);
        let is_free = move |&cell: &CellId| !others().any(|other| self.cell(other) == cell);
        let beside = |cell: CellId| moves(self.grid, piece, cell).filter(is_free);
        let is_goal = |cell: CellId| to.map_or_else(|| self.is_goal(piece, cell), |to| cell == to);
        Trail::find(marks, self.grid.floor().cells.len(), self.cell(piece), beside, is_goal)
    }

    fn is_goal(&self, piece: Piece, cell: CellId) -> bool {
        self.goals.allowed(self.grid, self.state, piece, cell).contains(self.task)
    }

    fn cell(&self, piece: Piece) -> CellId {
        self.grid.cell(self.state, piece)
    }

    fn region(&self, cell: CellId) -> u32 {
        self.grid.floor().cells.get(cell.index()).map_or(0, region)
    }
}
