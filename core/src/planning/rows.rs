//! The exact search that expands rows of states at once, for robots on a floor of cells (see [`PushGrid`]).
//!
//! The states that differ only in the robot's cell make up a row: one bit per cell, line by line of the floor. Each arrangement of the
//! other pieces has a row. All states of a row at one distance are expanded together: the robot's moves reach the bits shifted by one cell
//! in each direction, without the cells that are wall, occupied, or nearer. Only moves of a piece leave the row, one bit at a time.
//!
//! A row has one plane of bits for each action, with the states that have a shortest path beginning with it, and two planes for the
//! frontier: the current distance and the next. A robot with four actions takes six bits per cell of the floor.
//!
//! If the robot's cell determines the progress of the tasks' way, each layer of the way has its own rows. A cell that brings progress takes
//! the state to the row of another layer, and no move leaves a cell to avoid.
//!
//! The approximate plans use the same search with fewer pieces that move (see [`View`]).

mod expand;

use super::bits::take_from;
use super::goals::Goals;
use super::one_by_one::StateSearch;
use crate::oomdp::{Action, ActionSet, CellId, Divider, Floor, FloorCell, Piece, PushGrid, own_actions};
use crate::task::{Part, TaskSet, Way, WayState};

/// The part of the state space to search. Pieces that are not in `moving` stay in place, as walls. Without the feature `approximate` it is always
/// the whole.
#[derive(Clone, Copy, Debug)]
pub(super) struct View {
    /// The pieces that can change their cells, one bit each; the robot's is set.
    pub(super) moving: u32,
}

impl View {
    /// All pieces.
    pub(super) const WHOLE: Self = Self { moving: u32::MAX };

    #[inline]
    fn moves(&self, piece: Piece) -> bool {
        self.moves_all() || self.moving & piece.bit() != 0
    }

    #[inline]
    const fn moves_all(&self) -> bool {
        !cfg!(feature = "approximate") || self.moving == Self::WHOLE.moving
    }

    /// The moving pieces except the robot, one bit each.
    fn pieces<G: PushGrid>(&self, grid: &G) -> u32 {
        (1..grid.pieces()).map(|piece| Piece(piece as u8).bit()).fold(0, |pieces, piece| pieces | piece) & self.moving
    }
}

/// The smallest box around the cells of a floor, as a layout of bits.
#[derive(Clone, Copy, Debug)]
struct Bits {
    left: i16,
    bottom: i16,
    /// The distance in bits from a cell to its northern neighbour: one more than the width of the box, so that no move leads from the end
    /// of a line to the beginning of another.
    width: usize,
    len: usize,
    /// The number of cells.
    cells: usize,
}

impl Bits {
    fn new(floor: &Floor<'_>) -> Option<Self> {
        let mut cells = floor.cells.iter();
        let first = cells.next()?;
        let start = (first.x, first.x, first.y, 1_usize);
        let (left, right, top, count) =
            cells.fold(start, |(left, right, _, count), cell| (left.min(cell.x), right.max(cell.x), cell.y, count.saturating_add(1)));
        let span = |from: i16, to: i16| usize::from(to.wrapping_sub(from).cast_unsigned()).saturating_add(1);
        let width = span(left, right).saturating_add(1);
        let len = width.saturating_mul(span(first.y, top)).saturating_sub(1);
        // With a single line, north and south lead nowhere; so their shifts may be short.
        Some(Self { left, bottom: first.y, width: if len <= width { 1 } else { width }, len, cells: count })
    }

    #[inline]
    fn of(&self, cell: &FloorCell) -> usize {
        let (right, up) = (cell.x.wrapping_sub(self.left), cell.y.wrapping_sub(self.bottom));
        usize::from(up.cast_unsigned()).wrapping_mul(self.width).wrapping_add(usize::from(right.cast_unsigned()))
    }

    /// The bits one step from these in a direction, in a row of one word.
    #[inline]
    fn ahead(&self, bits: u64, direction: usize) -> u64 {
        let width = self.width as u32;
        match direction {
            0 => bits.wrapping_shl(width),
            1 => bits.wrapping_shr(width),
            2 => bits << 1,
            _ => bits >> 1,
        }
    }

    /// Passes the bits beside those of one word to `give`, word by word. A word may occur several times, and words beyond the row too.
    #[inline]
    fn beside(&self, word: usize, bits: u64, mut give: impl FnMut(usize, u64)) {
        let (far, near) = (self.width / 64, (self.width % 64) as u32);
        let over = 63_u32.wrapping_sub(near);
        let mut give = |word: usize, bits: u64| {
            if bits != 0 {
                give(word, bits);
            }
        };
        let (up, up_over, down, down_over) = (bits << near, bits >> 1 >> over, bits >> near, bits << 1 << over);
        // A word before the first wraps around, and is then beyond the row too.
        let (after, before) = (word.wrapping_add(1), word.wrapping_sub(1));
        if far == 0 {
            give(word, bits << 1 | bits >> 1 | up | down);
            give(after, bits >> 63 | up_over);
            give(before, bits << 63 | down_over);
        } else {
            give(word, bits << 1 | bits >> 1);
            give(after, bits >> 63);
            give(before, bits << 63);
            give(word.wrapping_add(far), up);
            give(after.wrapping_add(far), up_over);
            give(word.wrapping_sub(far), down);
            give(before.wrapping_sub(far), down_over);
        }
    }

    /// The shift of a direction, in bits.
    #[inline]
    fn shift(&self, direction: usize) -> isize {
        let width = isize::try_from(self.width).unwrap_or(0);
        match direction {
            0 => width,
            1 => width.wrapping_neg(),
            2 => 1,
            _ => -1,
        }
    }
}

/// The planes of a way that the robot's cell decides.
#[derive(Clone, Copy, Debug)]
struct WayPlanes {
    /// The plane of the cells that need not be avoided. After it come the planes of the cells that meet each clause `through`, and each
    /// earlier goal.
    first: usize,
    clauses: u8,
    stages: u8,
    /// The number of layers; in the last one the way is finished.
    layers: usize,
}

impl WayPlanes {
    /// The planes of a way, from `first` on; `None` if the robot's cell does not decide it.
    fn new<G: PushGrid>(grid: &G, way: &Way<'_>, first: usize) -> Option<Self> {
        let is_decided = way.parts().all(|(_, part)| grid.piece_of(&part) == Some(Piece::ROBOT));
        let clauses = way.pending(WayState::START).count() as u8;
        is_decided.then(|| Self { first, clauses, stages: way.stages(), layers: usize::from(way.layers()) })
    }

    /// The number of planes.
    const fn count(&self) -> usize {
        1_usize.wrapping_add(self.clauses as usize).wrapping_add(self.stages as usize)
    }

    /// The plane of the cells where a part of the way holds.
    fn plane(&self, part: Part) -> usize {
        self.first.wrapping_add(match part {
            Part::Goal | Part::Avoiding => 0,
            Part::Through(clause) => 1_usize.wrapping_add(usize::from(clause)),
            Part::Before(stage) => 1_usize.wrapping_add(usize::from(self.clauses)).wrapping_add(usize::from(stage)),
        })
    }

    /// Whether a clause is met in a layer.
    const fn has_passed(layer: usize, clause: u8) -> bool {
        layer.wrapping_shr(clause as u32) & 1 == 1
    }

    /// The number of earlier goals reached in a layer.
    const fn stage(&self, layer: usize) -> u8 {
        layer.wrapping_shr(self.clauses as u32) as u8
    }
}

/// The layout of the marks, and the progress of the search.
///
/// First, planes over the floor: its cells, the free ones, for each task that depends on the robot's cell the cells where it may hold, and the
/// planes of the way; then four bit sets over the rows; then the rows, those of the first layer first.
#[derive(Clone, Copy, Debug)]
pub(super) struct RowSearch {
    view: View,
    /// The moving pieces except the robot, one bit each.
    pieces: u32,
    /// The way of the tasks, if they have one.
    way: Option<WayPlanes>,
    /// The number of rows of a layer.
    rows: usize,
    bits: Bits,
    /// The number of words of a plane.
    words: usize,
    actions: usize,
    by_cells: Divider,
    directions: [Action; 4],
    /// The actions that are no direction.
    others: ActionSet,
    /// The tasks that depend on the robot's cell, and those that depend on nothing else.
    of_robot: TaskSet,
    only_robot: TaskSet,
    /// The numbers of words of a row, and of a bit set over the rows.
    stride: usize,
    set: usize,
    /// The starts of the bit sets and of the rows.
    sets_at: usize,
    rows_at: usize,
    /// The planes of the current distance and of the next.
    here: usize,
    next: usize,
    /// The word being scanned in the frontier's bit set.
    cursor: usize,
    /// Whether any row has a state at the next distance.
    ahead: bool,
    /// The number of cells laid out in the planes; `None` once the layout is complete.
    laid: Option<u16>,
}

/// From this ratio of box cells to cells on, expanding states one by one is faster.
const SPARSE: usize = 16;
/// The bit sets over the rows: two of the frontier, the rows ever reached, and the candidate rows.
const SETS: usize = 4;
const TOUCHED: usize = 2;
/// The rows that may satisfy a task that depends on the cell of another piece than the robot.
const CANDIDATES: usize = 3;
/// The planes over the floor before those of the tasks: its cells, and the free ones.
const CELLS: usize = 0;
const FREE: usize = 1;

/// The place of one state: its row and its bit.
#[derive(Clone, Copy, Debug)]
struct Spot {
    row: usize,
    bit: usize,
}

impl RowSearch {
    /// The layout of a search for these tasks in this many words; `None` if it does not fit, if an action does not cost 1, if a task
    /// depends on more than single pieces' cells, or if expanding states one by one is faster. `way` is shared by all these tasks.
    #[inline(never)]
    pub(super) fn layout<G: PushGrid>(
        grid: &G,
        goals: &Goals<'_>,
        tasks: TaskSet,
        view: View,
        way: Option<&Way<'_>>,
        words: usize,
    ) -> Option<Self> {
        let floor = grid.floor();
        if !goals.table.of_several.common(tasks).is_empty() || grid.actions().iter().any(|kind| kind.cost != 1) {
            return None;
        }
        let bits = Bits::new(&floor)?;
        if bits.len / SPARSE > bits.cells && StateSearch::fits(grid, words) {
            return None;
        }
        let pieces = view.pieces(grid);
        let rows = bits.cells.checked_pow(pieces.count_ones())?;
        let (of_robot, of_others) = (goals.table.of_robot.common(tasks), goals.table.of_others);
        let actions = own_actions(grid).count();
        let plane = bits.len.div_ceil(64);
        let stride = plane.checked_mul(actions.saturating_add(2))?;
        let planes = 2_usize.wrapping_add(of_robot.len());
        let way = match way {
            None => None,
            Some(way) => Some(WayPlanes::new(grid, way, planes)?),
        };
        let (layers, way_planes) = way.map_or((1, 0), |way| (way.layers, way.count()));
        let all_rows = rows.checked_mul(layers)?;
        let set = all_rows.div_ceil(64);
        let sets_at = plane.checked_mul(planes.wrapping_add(way_planes))?;
        let rows_at = set.checked_mul(SETS)?.checked_add(sets_at)?;
        if all_rows.checked_mul(stride)?.checked_add(rows_at)? > words {
            return None;
        }
        let is_direction = |action: &Action| floor.directions.contains(action);
        Some(Self {
            view,
            pieces,
            way,
            rows,
            bits,
            words: plane,
            actions,
            by_cells: Divider::new(u16::try_from(bits.cells).ok()?),
            directions: floor.directions,
            others: own_actions(grid).filter(|action| !is_direction(action)).fold(ActionSet::EMPTY, ActionSet::with),
            of_robot,
            only_robot: of_robot.without(of_others),
            stride,
            set,
            sets_at,
            rows_at,
            here: actions,
            next: actions.wrapping_add(1),
            cursor: 0,
            ahead: false,
            laid: Some(0),
        })
    }

    /// The number of words for a search of the whole floor for these tasks, `None` if rows cannot search for them.
    pub(super) fn words_needed<G: PushGrid>(grid: &G, goals: &Goals<'_>, tasks: TaskSet) -> Option<usize> {
        let search = Self::layout(grid, goals, tasks, View::WHOLE, None, usize::MAX)?;
        search.rows.checked_mul(search.stride)?.checked_add(search.rows_at)
    }

    #[inline]
    const fn set_at(&self, set: usize) -> usize {
        self.sets_at.wrapping_add(set.wrapping_mul(self.set))
    }

    /// The bit set of the rows with a state in one of the frontier's planes.
    #[inline]
    const fn frontier_at(&self, plane: usize) -> usize {
        self.set_at(plane.wrapping_sub(self.actions))
    }

    #[inline]
    const fn floor_plane_at(&self, plane: usize) -> usize {
        plane.wrapping_mul(self.words)
    }

    /// The plane of the cells where a task that depends on the robot's cell may hold.
    #[inline]
    fn plane_of(&self, task: usize) -> usize {
        let before = self.of_robot.common(TaskSet::first(task));
        2_usize.wrapping_add(before.len())
    }

    /// The way of the tasks. Without the feature `ways` it is always `None`, and takes no code.
    #[inline]
    fn way(&self) -> Option<WayPlanes> {
        self.way.filter(|_| cfg!(feature = "ways"))
    }

    /// The layer of a row.
    #[inline]
    fn layer(&self, row: usize) -> usize {
        if self.way().is_some() { row.checked_div(self.rows).unwrap_or(0) } else { 0 }
    }

    /// The position of a row within its layer.
    #[inline]
    fn row_in_layer(&self, row: usize) -> usize {
        row.wrapping_sub(self.layer(row).wrapping_mul(self.rows))
    }

    /// The same place in another layer; `to` is in the first.
    #[inline]
    fn in_layer(&self, to: Spot, layer: usize) -> Spot {
        Spot { row: to.row.wrapping_add(layer.wrapping_mul(self.rows)), ..to }
    }

    /// A word of a plane over the floor.
    #[inline]
    fn floor_word(&self, marks: &[u64], plane: usize, word: usize) -> u64 {
        marks.get(self.floor_plane_at(plane).wrapping_add(word)).copied().unwrap_or(0)
    }

    /// The bits of one word of a layer that bring progress on the way.
    fn leaving(&self, marks: &[u64], way: &WayPlanes, layer: usize, word: usize) -> u64 {
        let clauses = (0..way.clauses).filter(|&clause| !WayPlanes::has_passed(layer, clause)).map(Part::Through);
        let stage = Some(way.stage(layer)).filter(|&stage| stage < way.stages).map(Part::Before);
        clauses.chain(stage).fold(0, |all, part| all | self.floor_word(marks, way.plane(part), word))
    }

    /// The place of a state after its robot has entered its cell: perhaps in another layer.
    fn come_to(&self, marks: &[u64], to: Spot) -> Spot {
        let Some(way) = self.way() else { return to };
        let layer = self.layer(to.row);
        let holds = |part| self.floor_word(marks, way.plane(part), to.bit / 64) >> (to.bit % 64) & 1 == 1;
        let mut stage = way.stage(layer);
        while stage < way.stages && holds(Part::Before(stage)) {
            stage = stage.wrapping_add(1);
        }
        let passed = (0..way.clauses).filter(|&clause| WayPlanes::has_passed(layer, clause) || holds(Part::Through(clause)));
        let after = passed
            .fold(usize::from(stage).wrapping_shl(u32::from(way.clauses)), |after, clause| after | 1_usize.wrapping_shl(u32::from(clause)));
        Spot { row: to.row.wrapping_add(after.wrapping_sub(layer).wrapping_mul(self.rows)), ..to }
    }

    #[inline]
    const fn row_at(&self, row: usize) -> usize {
        self.rows_at.wrapping_add(row.wrapping_mul(self.stride))
    }

    /// Whether the layout is complete, so that the search can begin.
    #[inline]
    pub(super) const fn is_laid_out(&self) -> bool {
        self.laid.is_none()
    }

    /// Continues to lay out the marks, which held zeros, with at most `most` cells. `way` is the way of the layout, with its progress.
    /// Returns the number of cells. Call [`open_first`](Self::open_first) afterwards.
    #[inline(never)]
    pub(super) fn lay_out<G: PushGrid>(
        &mut self,
        grid: &G,
        goals: &Goals<'_>,
        state: &G::State,
        way: Option<(&Way<'_>, WayState)>,
        marks: &mut [u64],
        most: usize,
    ) -> usize {
        let floor = grid.floor();
        let frozen = |cell: CellId| {
            let mut pieces = (1..grid.pieces()).map(|piece| Piece(piece as u8));
            !self.view.moves_all() && pieces.any(|piece| !self.view.moves(piece) && grid.cell(state, piece) == cell)
        };
        let from = usize::from(self.laid.unwrap_or(0));
        let to = from.saturating_add(most).min(floor.cells.len());
        for (id, cell) in floor.ids().zip(floor.cells).take(to).skip(from) {
            let bit = self.bits.of(cell);
            let mut mark = |plane: usize| set_bit(marks, self.floor_plane_at(plane), bit);
            mark(CELLS);
            if !frozen(id) {
                mark(FREE);
            }
            let here = goals.allowed(grid, state, Piece::ROBOT, id);
            here.common(self.of_robot).iter().for_each(|task| mark(self.plane_of(task)));
            if let (Some((way, _)), Some(planes)) = (way, self.way()) {
                let there = grid.put(state, Piece::ROBOT, id);
                let holds = |part| grid.holds(&part, &there);
                if !way.is_violated(|part| holds(*part)) {
                    mark(planes.first);
                }
                way.parts()
                    .filter(|&(part, it)| matches!(part, Part::Through(_)) && holds(it))
                    .for_each(|(part, _)| mark(planes.plane(part)));
                let all_hold = |stage: &Part| way.parts().all(|(part, it)| part != *stage || holds(it));
                (0..planes.stages).map(Part::Before).filter(all_hold).for_each(|stage| mark(planes.plane(stage)));
            }
        }
        self.laid = Some(to as u16).filter(|_| to < floor.cells.len());
        to.saturating_sub(from)
    }

    /// Opens the successors of `state`, once the layout is complete.
    #[inline(never)]
    pub(super) fn open_first<G: PushGrid>(
        &mut self,
        grid: &G,
        state: &G::State,
        way: Option<(&Way<'_>, WayState)>,
        marks: &mut [u64],
        applicable: ActionSet,
    ) {
        let candidates = self.set_at(CANDIDATES);
        marks.get_mut(candidates..candidates.wrapping_add(self.set)).unwrap_or(&mut []).fill(u64::MAX);
        let layer = way.map_or(0, |(way, now)| usize::from(way.layer(now)));
        if let Some(start) = self.spot(grid, state, state) {
            let start = self.in_layer(start, layer);
            // The start is marked as reached, so that it is not reached again.
            self.reach(marks, start, ActionSet::of(Action(0)));
            let plane = self.row_at(start.row).wrapping_add(self.next.wrapping_mul(self.words));
            if let Some(open) = marks.get_mut(plane.wrapping_add(start.bit / 64)) {
                *open = 0;
            }
            let onward = self.way().is_none_or(|way| self.floor_word(marks, way.first, start.bit / 64) >> (start.bit % 64) & 1 == 1);
            if !onward {
                return;
            }
        }
        for action in applicable.iter().filter(|&action| action != Action::NOOP) {
            let next = grid.step(state, action).filter(|next| next != state);
            if let Some(next) = next.and_then(|next| self.spot(grid, state, &next)) {
                let next = self.come_to(marks, self.in_layer(next, layer));
                self.reach(marks, next, ActionSet::of(action));
            }
        }
    }

    /// The cell at a bit: its number is that of the cells before it.
    #[inline]
    fn cell_of_bit(&self, marks: &[u64], bit: usize) -> CellId {
        let cells = marks.get(..self.words).unwrap_or(&[]);
        let before: u32 = cells.iter().take(bit / 64).map(|word| word.count_ones()).sum();
        let within = cells.get(bit / 64).map_or(0, |word| (word & ((1 << (bit % 64)) - 1)).count_ones());
        CellId(before.wrapping_add(within) as u16)
    }

    /// The place of a state; `None` if a frozen piece has moved.
    #[inline]
    fn spot<G: PushGrid>(&self, grid: &G, now: &G::State, state: &G::State) -> Option<Spot> {
        let floor = grid.floor();
        let (mut row, mut weight) = (0_usize, 1_usize);
        for piece in self.pieces() {
            row = row.wrapping_add(grid.cell(state, piece).index().wrapping_mul(weight));
            weight = weight.wrapping_mul(self.bits.cells);
        }
        if !self.view.moves_all() {
            let mut frozen = (1..grid.pieces()).map(|piece| Piece(piece as u8)).filter(|&piece| !self.view.moves(piece));
            if frozen.any(|piece| grid.cell(state, piece) != grid.cell(now, piece)) {
                return None;
            }
        }
        let robot = floor.cells.get(grid.cell(state, Piece::ROBOT).index())?;
        Some(Spot { row, bit: self.bits.of(robot) })
    }

    /// A state of a row, with the robot on any cell, and the bits of the other moving pieces in the row's first word.
    #[inline]
    fn state_of_row<G: PushGrid>(&self, grid: &G, now: &G::State, row: usize) -> (G::State, u64) {
        let (mut state, mut rest, mut occupied, cells) = (*now, self.row_in_layer(row) as u64, 0, grid.floor().cells);
        let last = self.pieces.checked_ilog2().unwrap_or(0);
        for piece in self.pieces() {
            // The remainder is the last digit.
            let (more, cell) = if u32::from(piece.0) == last { (0, rest) } else { self.by_cells.split(rest) };
            let cell = CellId(cell as u16);
            let bit = cells.get(cell.index()).map_or(64, |cell| self.bits.of(cell));
            occupied |= if bit < 64 { 1 << bit } else { 0 };
            state = grid.put(&state, piece, cell);
            rest = more;
        }
        (state, occupied)
    }

    /// Reaches one state at the next distance, by a path that begins with one of these first actions.
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
                *plane |= if first.has(action) { bit } else { 0 };
            }
            at = at.wrapping_add(self.words);
        }
        self.open(marks, to.row);
        set_bit(marks, self.set_at(TOUCHED), to.row);
    }

    /// The moving pieces except the robot.
    #[inline]
    fn pieces(&self) -> impl Iterator<Item = Piece> + use<> {
        let mut rest = self.pieces;
        core::iter::from_fn(move || {
            let next = rest.trailing_zeros();
            rest &= rest.wrapping_sub(1);
            (next < 32).then_some(Piece(next as u8))
        })
    }

    /// Marks a row as having a state at the next distance.
    #[inline]
    fn open(&mut self, marks: &mut [u64], row: usize) {
        set_bit(marks, self.frontier_at(self.next), row);
        self.ahead = true;
    }

    /// Moves to the next distance. Returns whether there is one.
    pub(super) fn next_level(&mut self) -> bool {
        (self.here, self.next, self.cursor) = (self.next, self.here, 0);
        core::mem::take(&mut self.ahead)
    }

    /// Continues to fill the marks with zeros, with about `left` words at most. Returns whether it is done.
    pub(super) fn clear_on(&self, marks: &mut [u64], left: &mut usize) -> bool {
        let (touched_at, mut cursor) = (self.set_at(TOUCHED), 0);
        while *left > 0 {
            let touched = marks.get_mut(touched_at..touched_at.wrapping_add(self.set)).unwrap_or(&mut []);
            let Some(row) = take_from(touched, &mut cursor) else {
                marks.get_mut(..self.rows_at).unwrap_or(&mut []).fill(0);
                return true;
            };
            let start = self.row_at(row);
            marks.get_mut(start..start.wrapping_add(self.stride)).unwrap_or(&mut []).fill(0);
            *left = left.saturating_sub(self.stride);
        }
        false
    }
}

#[inline]
fn set_bit(marks: &mut [u64], set_at: usize, bit: usize) {
    if let Some(word) = marks.get_mut(set_at.wrapping_add(bit / 64)) {
        *word |= 1 << (bit % 64);
    }
}
