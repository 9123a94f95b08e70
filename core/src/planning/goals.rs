//! The tasks that a state satisfies.
//!
//! A task is a conjunction of ground propositions. On a floor with pieces, most propositions depend on the cell of one piece. So the table
//! has, for each cell of each piece, the tasks that it does not rule out, one bit each. The tasks that a state satisfies are the
//! intersection over its pieces: one look-up per piece, for any number of tasks. In other domains the propositions are tested one by one.

use crate::capacity::{Capacity, CapacityError};
use crate::memory::GoalMemory;
use crate::oomdp::{CellId, Domain, GroundProposition, ObjectId, Piece, PropositionId, PushGrid, SearchKind};
use crate::task::{GroundedTask, LiftedTask, TaskSet, WayState};

/// Whether a proposition is negated. Without the feature `talk` none is, and this takes no memory.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct Sign(#[cfg(feature = "talk")] bool);

impl Sign {
    const PLAIN: Self = Self::of(WayState::START);

    const fn of(_way: WayState) -> Self {
        Self(
            #[cfg(feature = "talk")]
            _way.is_negated(),
        )
    }

    const fn is_negated(self) -> bool {
        #[cfg(feature = "talk")]
        return self.0;
        #[cfg(not(feature = "talk"))]
        false
    }
}

/// A ground proposition, or its negation, and the tasks that contain it.
#[derive(Clone, Copy, Debug)]
#[doc(hidden)]
pub struct GoalPart {
    proposition: GroundProposition,
    sign: Sign,
    tasks: TaskSet,
    piece: Option<Piece>,
}

impl GoalPart {
    /// The value of unused memory.
    pub const UNUSED: Self = Self {
        proposition: GroundProposition { proposition: PropositionId(0), arguments: [ObjectId(0); crate::capacity::ARGUMENTS] },
        sign: Sign::PLAIN,
        tasks: TaskSet::EMPTY,
        piece: None,
    };
}

/// The goals of one session's tasks, besides the tables.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct GoalTable {
    /// The number of distinct ground propositions: at most a few per task.
    parts: u16,
    /// Cells of each piece in the table; 0 without a table, or before it is filled. A floor has no more cells than fit a `u16`.
    tabled_cells: u16,
    /// The number of filled entries.
    filled: u32,
    pub(super) all: TaskSet,
    /// The tasks that depend on the robot's cell, on another piece's cell, and on something that no single cell decides.
    pub(super) of_robot: TaskSet,
    pub(super) of_others: TaskSet,
    pub(super) of_several: TaskSet,
}

impl GoalTable {
    pub(super) const EMPTY: Self = Self {
        parts: 0,
        all: TaskSet::EMPTY,
        filled: 0,
        tabled_cells: 0,
        of_robot: TaskSet::EMPTY,
        of_others: TaskSet::EMPTY,
        of_several: TaskSet::EMPTY,
    };

    /// Lists the propositions of these tasks. [`tabulate`](Self::tabulate) fills the table of cells later.
    pub(super) fn list<D: Domain>(
        memory: &mut GoalMemory<'_>,
        domain: &D,
        lifted: &[LiftedTask],
        tasks: &[GroundedTask],
    ) -> Result<Self, CapacityError> {
        let grid = D::Search::grid(domain);
        let mut table = Self { all: TaskSet::first(tasks.len()), ..Self::EMPTY };
        for (position, task) in tasks.iter().enumerate() {
            let Some(lifted) = lifted.get(usize::from(task.lifted)) else { continue };
            for proposition in task.propositions(lifted) {
                let piece = grid.and_then(|grid| grid.piece_of(&proposition));
                let asked = match piece {
                    Some(Piece::ROBOT) => &mut table.of_robot,
                    Some(_) => &mut table.of_others,
                    None => &mut table.of_several,
                };
                *asked = asked.with(position);
                let known = memory
                    .goal_parts
                    .iter_mut()
                    .take(table.parts())
                    .find(|part| part.proposition == proposition && part.sign == Sign::of(task.way));
                if let Some(part) = known {
                    part.tasks = part.tasks.with(position);
                    continue;
                }
                let limit = memory.goal_parts.len();
                let slot = memory.goal_parts.get_mut(table.parts()).ok_or(CapacityError::full(Capacity::GroundPropositions, limit))?;
                *slot = GoalPart { proposition, sign: Sign::of(task.way), tasks: TaskSet::of(position), piece };
                table.parts = table.parts.saturating_add(1);
            }
        }
        Ok(table)
    }

    /// Whether the table of cells is still to be filled. A domain without a floor, or with more cells than entries, has none.
    pub(super) fn is_to_tabulate<G: PushGrid>(&self, entries: usize, grid: &G) -> bool {
        let cells = grid.floor().cells.len();
        let is_countable = u16::try_from(cells).is_ok() && u32::try_from(entries).is_ok();
        self.tabled_cells == 0 && is_countable && cells.checked_mul(grid.pieces()).is_some_and(|all| all > 0 && all <= entries)
    }

    /// Fills at most `most` more cells of the table. Returns their number. `state` is any state of the domain.
    pub(super) fn tabulate<G: PushGrid>(&mut self, memory: &mut GoalMemory<'_>, grid: &G, state: &G::State, most: usize) -> usize {
        let cells = grid.floor().cells.len();
        let all = cells.saturating_mul(grid.pieces());
        let before = self.filled as usize;
        for at in (before..all).take(most) {
            let piece = Piece(at.checked_div(cells).unwrap_or(0) as u8);
            let cell = CellId(at.checked_rem(cells).unwrap_or(0) as u16);
            let there = Goals { table: self, parts: memory.goal_parts, entries: &[] }.allowed_by(grid, state, piece, cell);
            if let Some(entry) = memory.goal_entries.get_mut(at) {
                *entry = there;
            }
            self.filled = at.saturating_add(1) as u32;
        }
        if self.filled as usize >= all {
            self.tabled_cells = cells as u16;
        }
        (self.filled as usize).saturating_sub(before)
    }

    /// The number of distinct ground propositions in the tasks.
    pub(super) fn parts(&self) -> usize {
        usize::from(self.parts)
    }
}

/// The goals with their tables.
#[derive(Clone, Copy, Debug)]
pub(super) struct Goals<'t> {
    pub(super) table: &'t GoalTable,
    pub(super) parts: &'t [GoalPart],
    pub(super) entries: &'t [TaskSet],
}

impl Goals<'_> {
    fn parts(&self) -> impl Iterator<Item = &GoalPart> {
        self.parts.iter().take(self.table.parts())
    }

    /// The pieces whose cells decide a task, one bit each; `None` if no single piece decides one of its propositions.
    #[cfg(any(feature = "approximate", feature = "bounds"))]
    pub(super) fn pieces_of(&self, task: usize) -> Option<u32> {
        let mut parts = self.parts().filter(|part| part.tasks.contains(task));
        parts.try_fold(0, |pieces, part| Some(pieces | part.piece?.bit()))
    }

    /// The tasks that are decided by the cells of exactly these pieces; with `None`, those that no single pieces decide.
    #[cfg(feature = "approximate")]
    pub(super) fn decided_by(&self, pieces: Option<u32>) -> TaskSet {
        let with = |is_it: &dyn Fn(Option<Piece>) -> bool| {
            self.parts().filter(|part| is_it(part.piece)).fold(TaskSet::EMPTY, |tasks, part| tasks.union(part.tasks))
        };
        let Some(pieces) = pieces else { return with(&|piece| piece.is_none()) };
        let has = |piece: Piece| pieces & piece.bit() != 0;
        let of_all = (0..32).map(Piece).filter(|&piece| has(piece)).map(|own| with(&|piece| piece == Some(own)));
        of_all.fold(self.table.all, TaskSet::common).without(with(&|piece| !piece.is_some_and(has)))
    }

    /// The tasks that a piece on this cell does not rule out.
    #[inline]
    pub(super) fn allowed<G: PushGrid>(&self, grid: &G, state: &G::State, piece: Piece, cell: CellId) -> TaskSet {
        if self.table.tabled_cells == 0 {
            return self.allowed_by(grid, state, piece, cell);
        }
        let at = usize::from(piece.0).wrapping_mul(usize::from(self.table.tabled_cells)).wrapping_add(cell.index());
        self.entries.get(at).copied().unwrap_or(TaskSet::EMPTY)
    }

    #[inline(never)]
    fn allowed_by<G: PushGrid>(&self, grid: &G, state: &G::State, piece: Piece, cell: CellId) -> TaskSet {
        let there = grid.put(state, piece, cell);
        let ruled_out =
            self.parts().filter(|part| part.piece == Some(piece) && grid.holds(&part.proposition, &there) == part.sign.is_negated());
        ruled_out.fold(self.table.all, |left, part| left.without(part.tasks))
    }

    /// The tasks among `asked` that hold in `state`.
    #[inline]
    pub(super) fn satisfied<D: Domain>(&self, domain: &D, state: &D::State, asked: TaskSet) -> TaskSet {
        let mut satisfied = asked.common(self.table.all);
        let grid = D::Search::grid(domain).filter(|_| self.table.tabled_cells > 0);
        if let Some(grid) = grid {
            for piece in (0..grid.pieces()).map(|piece| Piece(piece as u8)) {
                satisfied = satisfied.common(self.allowed(grid, state, piece, grid.cell(state, piece)));
            }
            if satisfied.common(self.table.of_several).is_empty() {
                return satisfied;
            }
        }
        for part in self.parts().filter(|part| grid.is_none() || part.piece.is_none()) {
            if !satisfied.common(part.tasks).is_empty() && domain.holds(&part.proposition, state) == part.sign.is_negated() {
                satisfied = satisfied.without(part.tasks);
            }
        }
        satisfied
    }
}
