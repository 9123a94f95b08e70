//! The search that looks at whole rows of states at once.
//!
//! Where the robot goes about in a grid (see [`Domain::grid`]), the states that differ only in where it is make up a row: one bit a cell, line
//! after line. There are as many rows as there are ways for all else to be. All states of a row that are at one distance are looked at
//! together: what its moves reach is the bits shifted by one cell each way, without the cells that are wall, taken, or nearer. Only
//! where the robot acts on what stands beside it does it leave its row, one bit at a time.
//!
//! A row has one plane of bits for each action, the states to which a shortest way begins with it, and two for the frontier: the distance
//! under way and the next. A robot with four actions so has six bits for each cell of the grid.

mod look;

use super::findings::Findings;
use super::states::States;
use crate::oomdp::{Action, ActionSet, Divider, Domain, Grid};
use crate::planning::GoalTable;
use crate::task::TaskSet;

/// How the memory is laid out, and where the search stands.
///
/// First the cells, those of them that are free, and the cells at which each task that asks where the robot is may hold; then four bit
/// sets over the rows; then the rows.
#[derive(Clone, Copy, Debug)]
pub(super) struct Rows {
    grid: Grid,
    /// Words of a plane.
    words: usize,
    actions: usize,
    /// Places of the robot.
    places: usize,
    by_places: Divider,
    /// Actions that are no direction of the grid.
    others: ActionSet,
    /// The tasks that ask where the robot is, and those of them that ask nothing else.
    placed: TaskSet,
    only_placed: TaskSet,
    /// Words of a row, and of a bit set over the rows.
    stride: usize,
    set: usize,
    /// Where the bit sets and the rows begin.
    sets_at: usize,
    rows_at: usize,
    /// The planes of the distance under way and of the next, and their sets.
    here: usize,
    next: usize,
    /// The word of the set of rows that is looked through.
    cursor: usize,
    /// Whether any row has a state at the next distance.
    ahead: bool,
}

/// Cells to a place from which on a grid is sparse.
const SPARSE: usize = 16;
/// The bit sets over the rows: two of the frontier, one of all rows that were ever reached, and one.
const SETS: usize = 4;
const TOUCHED: usize = 2;
/// The rows in which a task may hold that asks for more than where the robot is.
const HOPEFUL: usize = 3;

/// One state, by its row and its bit.
#[derive(Clone, Copy, Debug)]
struct Spot {
    row: usize,
    bit: usize,
}

impl Rows {
    /// How a search for these tasks lies in so many words; `None` where the domain has no grid, or it does not fit, or so few cells of the
    /// grid are places that states are sooner looked at one by one.
    pub(super) fn new<D: Domain + ?Sized>(domain: &D, goals: &GoalTable<'_>, tasks: TaskSet, words: usize) -> Option<Self> {
        let mut grid = domain.grid()?;
        if grid.bits <= grid.width {
            // With a single line, north and south lead nowhere; what is beside it is so one word at most.
            grid.width = 1;
        }
        let asked = goals.asked();
        if !asked.of_several.common(tasks).is_empty() || domain.actions().iter().any(|kind| kind.cost != 1) {
            return None;
        }
        let actions = domain.actions().len().min(Action::MOST);
        let places = domain.values(0).max(1);
        let sparse = grid.bits / SPARSE > places;
        if sparse && domain.state_count() <= States::room(domain, words) as u64 {
            return None;
        }
        let rows = usize::try_from(domain.state_count()).ok()? / places;
        let placed = asked.of_place.common(tasks);
        let plane = grid.bits.div_ceil(64);
        let stride = plane.checked_mul(actions.saturating_add(2))?;
        let set = rows.div_ceil(64);
        let sets_at = plane.checked_mul(2_usize.wrapping_add(placed.0.count_ones() as usize))?;
        let rows_at = set.checked_mul(SETS)?.checked_add(sets_at)?;
        if rows.checked_mul(stride)?.checked_add(rows_at)? > words {
            return None;
        }
        let all = ActionSet(ActionSet::of(Action(actions as u8)).0.wrapping_sub(1));
        let directions = grid.directions.into_iter().fold(ActionSet::EMPTY, ActionSet::with);
        Some(Self {
            grid,
            words: plane,
            actions,
            places,
            by_places: Divider::new(places),
            others: ActionSet(all.0 & !directions.0),
            placed,
            only_placed: placed.without(asked.of_all_else),
            stride,
            set,
            sets_at,
            rows_at,
            here: actions,
            next: actions.wrapping_add(1),
            cursor: 0,
            ahead: false,
        })
    }

    #[inline]
    const fn set_at(&self, set: usize) -> usize {
        self.sets_at.wrapping_add(set.wrapping_mul(self.set))
    }

    /// The bit set of the rows that have a state in one of the frontier's planes.
    #[inline]
    const fn frontier_at(&self, plane: usize) -> usize {
        self.set_at(plane.wrapping_sub(self.actions))
    }

    /// The mask of all cells (0), of those that are free (1), and of those at which a task may hold.
    #[inline]
    const fn cells_at(&self, mask: usize) -> usize {
        mask.wrapping_mul(self.words)
    }

    #[inline]
    const fn row_at(&self, row: usize) -> usize {
        self.rows_at.wrapping_add(row.wrapping_mul(self.stride))
    }

    /// Lays out the memory, which holds nothing but zeroes, and opens what `state` leads to.
    pub(super) fn begin<D: Domain + ?Sized>(
        &mut self,
        domain: &D,
        goals: &GoalTable<'_>,
        state: &D::State,
        marks: &mut [u64],
        found: &Findings<'_>,
    ) {
        for place in 0..domain.values(0) {
            let bit = domain.bit_of(place);
            let mut mark = |mask: usize| {
                if let Some(word) = marks.get_mut(self.cells_at(mask).wrapping_add(bit / 64)) {
                    *word |= 1 << (bit % 64);
                }
            };
            mark(0);
            if domain.is_free(place) {
                mark(1);
            }
            let here = goals.not_ruled_out(domain, &domain.with_value(state, 0, place), 0);
            for task in here.common(self.placed).iter() {
                mark(self.mask_of(task));
            }
        }
        let hopeful = self.set_at(HOPEFUL);
        marks.get_mut(hopeful..hopeful.wrapping_add(self.set)).unwrap_or(&mut []).fill(u64::MAX);
        let number = domain.number(state);
        if let Some(start) = self.spot(domain, number) {
            // Known by any action, it is reached by none again.
            self.reach(marks, start, ActionSet::of(Action(0)));
            if let Some(open) =
                marks.get_mut(self.row_at(start.row).wrapping_add(self.next.wrapping_mul(self.words)).wrapping_add(start.bit / 64))
            {
                *open = 0;
            }
        }
        for action in found.applicable.iter().filter(|&action| action != Action::NOOP) {
            let next = domain.number_after(state, number, action).filter(|&next| next != number);
            if let Some(next) = next.and_then(|next| self.spot(domain, next)) {
                self.reach(marks, next, ActionSet::of(action));
            }
        }
    }

    /// The mask of the cells at which a task may hold that asks where the robot is.
    #[inline]
    fn mask_of(&self, task: usize) -> usize {
        let before = self.placed.common(TaskSet::first(task));
        2_usize.wrapping_add(before.0.count_ones() as usize)
    }

    fn spot<D: Domain + ?Sized>(&self, domain: &D, number: u64) -> Option<Spot> {
        let (row, place) = self.by_places.split(number);
        Some(Spot { row: usize::try_from(row).ok()?, bit: domain.bit_of(place as usize) })
    }

    /// Reaches one state at the next distance, by a way that begins with one of these first actions.
    fn reach(&mut self, marks: &mut [u64], to: Spot, first: ActionSet) {
        let (start, word, bit) = (self.row_at(to.row), to.bit / 64, 1_u64 << (to.bit % 64));
        let Some(planes) = marks.get_mut(start..start.wrapping_add(self.stride)) else { return };
        let (mut known, mut at) = (0, word);
        for _ in 0..self.actions {
            known |= planes.get(at).copied().unwrap_or(0);
            at = at.wrapping_add(self.words);
        }
        let Some(open) = planes.get_mut(self.next.wrapping_mul(self.words).wrapping_add(word)) else { return };
        if known & !*open & bit != 0 {
            return;
        }
        *open |= bit;
        at = word;
        for action in 0..self.actions {
            if let Some(plane) = planes.get_mut(at) {
                *plane |= if first.0 >> action & 1 == 1 { bit } else { 0 };
            }
            at = at.wrapping_add(self.words);
        }
        self.open(marks, to.row);
        self.set_bit(marks, self.set_at(TOUCHED), to.row);
    }

    /// Takes note that a row has a state at the next distance.
    #[inline]
    fn open(&mut self, marks: &mut [u64], row: usize) {
        self.set_bit(marks, self.frontier_at(self.next), row);
        self.ahead = true;
    }

    #[inline]
    fn set_bit(&self, marks: &mut [u64], set_at: usize, row: usize) {
        if let Some(word) = marks.get_mut(set_at.wrapping_add(row / 64)) {
            *word |= 1 << (row % 64);
        }
    }

    /// Goes on to the next distance. Gives whether there is one.
    pub(super) fn next_level(&mut self) -> bool {
        (self.here, self.next, self.cursor) = (self.next, self.here, 0);
        core::mem::take(&mut self.ahead)
    }

    /// Leaves nothing but zeroes.
    pub(super) fn clear(&self, marks: &mut [u64]) {
        for word in 0..self.set {
            let mut touched = marks.get(self.set_at(TOUCHED).wrapping_add(word)).copied().unwrap_or(0);
            while touched != 0 {
                let start = self.row_at(word.wrapping_mul(64).wrapping_add(touched.trailing_zeros() as usize));
                touched &= touched.wrapping_sub(1);
                marks.get_mut(start..start.wrapping_add(self.stride)).unwrap_or(&mut []).fill(0);
            }
        }
        marks.get_mut(..self.rows_at).unwrap_or(&mut []).fill(0);
    }
}
