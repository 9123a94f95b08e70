//! The robot and one piece alone on the floor: a backward search from a task's goal, over the cells of the two.
//!
//! No other piece is in the way, so the distance is a lower bound of the real one. Pieces that can never move again are walls.
//!
//! For a hard task, a few other pieces (the lasting ones) are in the way until the robot first pushes them; then they are removed. This bound is
//! greater, and still a lower bound: each plan of the floor is also one here. Each lasting piece doubles the states. Later tasks with the same
//! goal cells share this bound as well.
//!
//! A state is one bit in each of three sets: closed, open at the current distance, and open at the next. If there is memory, an array stores
//! the distances of all states, for A*. Otherwise the search ends at the planned state.

use crate::oomdp::{ActionSet, CellId, Piece, PushGrid, own_actions};
use crate::planning::bits::{entry, entry_words, insert, set_entry};
use crate::planning::goals::Goals;

/// The robot and one piece on the floor, and the progress of the search.
#[derive(Clone, Copy, Debug)]
pub(super) struct Relaxation {
    /// A task whose goal the search begins at; tasks of other pieces can share it.
    task: usize,
    /// The piece that moves besides the robot; the robot itself if the task depends on its cell alone.
    piece: Piece,
    cells: usize,
    /// The number of cells of the piece; 1 if it is the robot.
    rows: usize,
    /// The number of states: pairs of cells, or cells of the robot alone, for each set of lasting pieces that have moved.
    states: usize,
    /// The number of pieces besides the robot that the task depends on.
    blocks: u32,
    /// The pieces that are in the way until they are first pushed, each with its cell.
    lasting: [(Piece, CellId); MOST_LASTING],
    /// Whether other pieces were removed.
    others: bool,
    /// Whether distances are stored.
    tabled: bool,
    /// The state where the search ends if distances are not stored.
    start: usize,
    level: u16,
    /// The word scanned for open states.
    cursor: usize,
    /// Which of the two sets of open states is the next one.
    flipped: bool,
    done: bool,
}

/// The most pieces that are in the way until they are first pushed.
pub(super) const MOST_LASTING: usize = 3;

/// The known distance from one state.
#[derive(Clone, Copy, Debug)]
pub(super) enum Bound {
    /// No goal can be reached.
    Unreachable,
    /// Exactly this distance, by these first actions.
    Exactly(u32, ActionSet),
    /// At least this distance.
    AtLeast(u32),
    /// Unknown.
    Unknown,
}

/// The pieces, other than the robot and this one, that a search leaves out.
pub(super) fn others<G: PushGrid>(grid: &G, piece: Piece) -> impl Iterator<Item = Piece> + Clone + use<G> {
    (1..grid.pieces()).map(|other| Piece(other as u8)).filter(move |&other| other != piece)
}

/// The piece that moves besides the robot in a task's lower bound: the first that the task depends on and that is not at its goal. The
/// robot, if the task depends on no other piece; `None` if no single pieces decide the task.
pub(super) fn piece_of<G: PushGrid>(grid: &G, goals: &Goals<'_>, state: &G::State, task: usize) -> Option<Piece> {
    goals.pieces_of(task).map(|asked| piece_among(asked, grid, goals, state, task))
}

/// The same, where these pieces decide the task.
fn piece_among<G: PushGrid>(asked: u32, grid: &G, goals: &Goals<'_>, state: &G::State, task: usize) -> Piece {
    let is_open = |piece: &Piece| !goals.allowed(grid, state, *piece, grid.cell(state, *piece)).contains(task);
    let mut blocks = others(grid, Piece::ROBOT).filter(|piece| asked & piece.bit() != 0);
    blocks.clone().find(is_open).or_else(|| blocks.next()).unwrap_or(Piece::ROBOT)
}

/// The number of these pieces besides the robot.
const fn blocks_of(pieces: u32) -> u32 {
    (pieces & !1).count_ones()
}

/// Finds the pieces that never move again, and marks their cells. In each line of such a piece, one of the cells beside it is a wall, or
/// holds another such piece: so none of them can be the first that moves.
fn freeze<G: PushGrid>(walls: &mut [u64], grid: &G, state: &G::State) {
    if grid.can_pull() {
        return;
    }
    let cells = || others(grid, Piece::ROBOT).map(|piece| grid.cell(state, piece));
    cells().for_each(|cell| {
        insert(walls, cell.index());
    });
    let floor = grid.floor();
    loop {
        let is_wall = |cell: CellId| cell == CellId::NONE || has(walls, cell.index());
        // Opposite directions differ in the lowest bit: north and south are 0 and 1, east and west 2 and 3.
        let can_move = |cell: CellId, line: usize| [line, line ^ 1].into_iter().all(|side| !is_wall(floor.neighbour(cell, side)));
        let Some(moved) = cells().find(|&cell| has(walls, cell.index()) && [0, 2].into_iter().any(|line| can_move(cell, line))) else {
            return;
        };
        remove(walls, moved.index());
    }
}

/// The parts of the marks.
struct Parts<'m> {
    /// The cells of pieces.
    pieces: &'m mut [u64],
    /// The cells of pieces that never move again.
    walls: &'m mut [u64],
    /// Those, and the cells of the lasting pieces that have not moved yet; empty if no pieces are lasting.
    taken: &'m mut [u64],
    here: &'m mut [u64],
    met: Met<'m>,
}

/// The states met so far.
struct Met<'m> {
    closed: &'m mut [u64],
    next: &'m mut [u64],
    distances: &'m mut [u64],
}

impl Met<'_> {
    /// Opens a state at the next distance, unless it is known.
    #[inline]
    fn open(&mut self, number: usize, distance: u16) {
        // Most states are known, so they cost one look.
        let bit = 1 << (number % 64);
        let Some(closed) = self.closed.get_mut(number / 64).filter(|closed| **closed & bit == 0) else { return };
        *closed |= bit;
        if let Some(next) = self.next.get_mut(number / 64) {
            *next |= bit;
        }
        set_entry(self.distances, number, distance.saturating_add(1));
    }
}

impl Relaxation {
    /// Lays out the marks, which hold zeros, and opens the goals of a task; `None` if they are too small, or if no single pieces decide the
    /// task. Of the pieces in `lasting`, one bit each, the first [`MOST_LASTING`] become lasting ones.
    pub(super) fn begin<G: PushGrid>(
        marks: &mut [u64],
        grid: &G,
        goals: &Goals<'_>,
        state: &G::State,
        task: usize,
        lasting: u32,
    ) -> Option<Self> {
        let asked_pieces = goals.pieces_of(task)?;
        let piece = piece_among(asked_pieces, grid, goals, state, task);
        let cells = grid.floor().cells.len();
        let rows = if piece == Piece::ROBOT { 1 } else { cells };
        let mut places = [(Piece::ROBOT, CellId::NONE); MOST_LASTING];
        let first = others(grid, piece).filter(|other| lasting & other.bit() != 0);
        places.iter_mut().zip(first).for_each(|(place, other)| *place = (other, grid.cell(state, other)));
        let sets = 1_usize << places.iter().filter(|(_, cell)| *cell != CellId::NONE).count();
        let states = cells.checked_mul(rows)?.checked_mul(sets)?;
        let has_others = others(grid, piece).next().is_some();
        let mut it = Self {
            task,
            piece,
            cells,
            rows,
            states,
            blocks: blocks_of(asked_pieces),
            lasting: places,
            others: has_others,
            tabled: has_others,
            start: 0,
            level: 0,
            cursor: 0,
            flipped: false,
            done: false,
        };
        it.start = it.number(0, grid.cell(state, Piece::ROBOT), grid.cell(state, piece));
        if it.words() > marks.len() {
            return None;
        }
        let mut parts = it.parts(marks)?;
        for other in others(grid, Piece::ROBOT) {
            insert(parts.pieces, grid.cell(state, other).index());
        }
        freeze(parts.walls, grid, state);
        let asked = |piece, cell| goals.allowed(grid, state, piece, cell).contains(task);
        if piece != Piece::ROBOT && asked(piece, grid.cell(state, piece)) {
            remove(parts.walls, grid.cell(state, piece).index());
        }
        for moved in 0..sets {
            it.take(parts.taken, parts.walls, moved);
            let taken = if it.is_sharp() { &*parts.taken } else { &*parts.walls };
            for row in (0..rows).map(|row| CellId(row as u16)) {
                // States with the robot on a taken cell count as closed, so that none is opened.
                let first = it.number(moved, CellId(0), row);
                for (at, word) in taken.iter().enumerate() {
                    let mut word = *word;
                    while let Some(bit) = take_bit(&mut word) {
                        insert(parts.met.closed, first.wrapping_add(at.wrapping_mul(64)).wrapping_add(bit));
                    }
                }
                if piece != Piece::ROBOT {
                    insert(parts.met.closed, first.wrapping_add(row.index()));
                    if !asked(piece, row) || has(taken, row.index()) {
                        continue;
                    }
                }
                for robot in grid.floor().ids().filter(|&robot| asked(Piece::ROBOT, robot)) {
                    parts.met.open(it.number(moved, robot, row), 0);
                }
            }
        }
        it.turn();
        Some(it)
    }

    /// Whether another task has the same goal cells, for the robot and for a piece that can take the place of this task's piece.
    pub(super) fn is_shared_by<G: PushGrid>(&self, marks: &[u64], grid: &G, goals: &Goals<'_>, state: &G::State, task: usize) -> bool {
        if !self.tabled || self.blocks > 1 {
            return false;
        }
        let Some(asked) = goals.pieces_of(task).filter(|&asked| blocks_of(asked) == self.blocks) else { return false };
        let piece = piece_among(asked, grid, goals, state, task);
        let is_alike = |own: Piece, other: Piece, cell: CellId| {
            goals.allowed(grid, state, own, cell).contains(self.task) == goals.allowed(grid, state, other, cell).contains(task)
        };
        let is_at_goal = |cell| goals.allowed(grid, state, piece, cell).contains(task);
        // A piece that never moves again and is not at its goal never gets there.
        let is_free = |cell| !self.is_wall(marks, cell) || !is_at_goal(cell);
        (piece == Piece::ROBOT || is_free(grid.cell(state, piece)))
            && grid.floor().ids().all(|cell| is_alike(Piece::ROBOT, Piece::ROBOT, cell) && is_alike(self.piece, piece, cell))
    }

    /// The number of words of the marks that it takes.
    pub(super) fn words(&self) -> usize {
        let distances = if self.tabled { entry_words(self.states) } else { 0 };
        self.set()
            .saturating_mul(3)
            .saturating_add(self.floor().saturating_mul(if self.is_sharp() { 3 } else { 2 }))
            .saturating_add(distances)
    }

    /// The number of states.
    pub(super) const fn states(&self) -> usize {
        self.states
    }

    /// The number of words of a set of cells.
    const fn floor(&self) -> usize {
        self.cells.div_ceil(64)
    }

    /// Whether a piece other than the robot is on this cell in the planned state.
    #[inline]
    pub(super) fn has_piece(&self, marks: &[u64], cell: CellId) -> bool {
        has(marks, cell.index())
    }

    /// Whether a piece that never moves again is on this cell.
    #[inline]
    pub(super) fn is_wall(&self, marks: &[u64], cell: CellId) -> bool {
        marks.get(self.floor()..).is_some_and(|walls| has(walls, cell.index()))
    }

    /// The number of words of a set of states.
    const fn set(&self) -> usize {
        self.states.div_ceil(64)
    }

    /// The number of the state with the robot and the piece on these cells, and with this set of lasting pieces that have moved.
    #[inline]
    pub(super) fn number(&self, moved: usize, robot: CellId, piece: CellId) -> usize {
        let row = if self.piece == Piece::ROBOT { 0 } else { piece.index() };
        moved.wrapping_mul(self.rows).wrapping_add(row).wrapping_mul(self.cells).wrapping_add(robot.index())
    }

    /// How many pieces are lasting.
    pub(super) fn lasting(&self) -> usize {
        self.lasting.iter().filter(|(_, cell)| *cell != CellId::NONE).count()
    }

    /// The lasting pieces, one bit each.
    pub(super) fn lasting_pieces(&self) -> u32 {
        self.lasting.iter().filter(|(_, cell)| *cell != CellId::NONE).fold(0, |all, (piece, _)| all | piece.bit())
    }

    /// Whether any are.
    #[inline]
    const fn is_sharp(&self) -> bool {
        self.states > self.cells.wrapping_mul(self.rows)
    }

    /// Whether a lasting piece that has not moved is on this cell.
    #[inline]
    fn lasts(&self, moved: usize, cell: CellId) -> bool {
        self.lasting.iter().enumerate().any(|(at, &(_, place))| place == cell && moved >> at & 1 == 0)
    }

    /// The cells of the lasting pieces, where `cells` has the cell of each piece.
    #[inline]
    pub(super) fn lasting_cells(&self, cells: &[CellId; 32]) -> [CellId; MOST_LASTING] {
        self.lasting.map(|(piece, place)| if place == CellId::NONE { place } else { cells.get(piece.index()).copied().unwrap_or(place) })
    }

    /// Which lasting pieces have moved from these cells, after a push of what is on `ahead` to `beyond`.
    #[inline]
    pub(super) fn moved(&self, cells: &[CellId; MOST_LASTING], ahead: CellId, beyond: CellId) -> usize {
        if !self.is_sharp() {
            return 0;
        }
        let has_moved = |cell: CellId, place: CellId| usize::from(place != if cell == ahead { beyond } else { cell });
        let ([a, b, c], [(_, at_a), (_, at_b), (_, at_c)]) = (*cells, self.lasting);
        has_moved(a, at_a) | has_moved(b, at_b) << 1 | has_moved(c, at_c) << 2
    }

    fn parts<'m>(&self, marks: &'m mut [u64]) -> Option<Parts<'m>> {
        let (pieces, rest) = marks.split_at_mut_checked(self.floor())?;
        let (walls, rest) = rest.split_at_mut_checked(self.floor())?;
        let (taken, rest) = rest.split_at_mut_checked(if self.is_sharp() { self.floor() } else { 0 })?;
        let (closed, rest) = rest.split_at_mut_checked(self.set())?;
        let (even, rest) = rest.split_at_mut_checked(self.set())?;
        let (odd, rest) = rest.split_at_mut_checked(self.set())?;
        let distances = rest.get_mut(..if self.tabled { entry_words(self.states) } else { 0 })?;
        let (here, next) = if self.flipped { (odd, even) } else { (even, odd) };
        Some(Parts { pieces, walls, taken, here, met: Met { closed, next, distances } })
    }

    /// Makes the states open at the next distance the current ones.
    const fn turn(&mut self) {
        (self.flipped, self.cursor) = (!self.flipped, 0);
    }

    /// Continues, with at most `left` expansions. Returns whether it is complete.
    pub(super) fn search<G: PushGrid>(&mut self, marks: &mut [u64], grid: &G, left: &mut u32) -> bool {
        let (floor, is_sharp, size) = (grid.floor(), self.is_sharp(), self.cells);
        while !self.done && *left > 0 {
            let Some(mut parts) = self.parts(marks) else { return true };
            let Parts { walls, taken, here, met, .. } = &mut parts;
            let distance = self.level.saturating_add(1);
            // Which lasting pieces have moved, the piece's cell, and the number of the first state of both; numbers only grow.
            let (mut moved, mut row, mut first, mut cursor) = (0_usize, 0_usize, 0_usize, self.cursor);
            self.take(taken, walls, moved);
            while let Some(word) = here.get_mut(cursor) {
                while let Some(bit) = take_bit(word) {
                    let number = cursor.wrapping_mul(64).wrapping_add(bit);
                    while number.wrapping_sub(first) >= size {
                        (row, first) = (row.wrapping_add(1), first.wrapping_add(size));
                        if row >= self.rows {
                            (moved, row) = (moved.wrapping_add(1), 0);
                            self.take(taken, walls, moved);
                        }
                    }
                    let piece = if self.piece == Piece::ROBOT { CellId::NONE } else { CellId(row as u16) };
                    let robot = CellId(number.wrapping_sub(first) as u16);
                    let (cells, swaps) = ((moved, robot, piece), grid.swaps());
                    let Some(neighbours) = floor.cells.get(robot.index()).map(|cell| &cell.neighbours) else { continue };
                    // Most actions only move the robot.
                    for &before in neighbours {
                        if before != CellId::NONE {
                            met.open(first.wrapping_add(before.index()), distance);
                        }
                    }
                    let is_beside = piece != CellId::NONE && neighbours.contains(&piece);
                    // The lasting piece that the robot may have pushed from this cell.
                    let came_from = |&(at, &(_, place)): &(usize, &(Piece, CellId))| place == robot && moved >> at & 1 == 1;
                    let pushed = if moved != 0 { self.lasting.iter().enumerate().find(came_from) } else { None };
                    if is_beside || pushed.is_some() {
                        let taken = if is_sharp { &**taken } else { &**walls };
                        self.push(taken, met, neighbours, swaps, cells, pushed.map(|(at, _)| moved & !(1 << at)));
                    }
                    *left = left.saturating_sub(1);
                    if *left == 0 {
                        self.cursor = cursor;
                        return false;
                    }
                }
                cursor = cursor.wrapping_add(1);
            }
            let is_near = !self.tabled && has(parts.met.closed, self.start);
            // Beyond this distance, far goals cannot be distinguished from unreachable ones: then the bound is unknown.
            self.done = is_near || parts.met.next.iter().all(|&word| word == 0) || self.level >= FARTHEST;
            if !self.done {
                self.level = self.level.saturating_add(1);
                self.turn();
            }
        }
        self.done
    }

    /// Marks the occupied cells after these lasting pieces have moved.
    fn take(&self, taken: &mut [u64], walls: &[u64], moved: usize) {
        taken.iter_mut().zip(walls).for_each(|(taken, wall)| *taken = *wall);
        self.lasting.iter().map(|&(_, place)| place).filter(|&place| self.lasts(moved, place)).for_each(|place| {
            insert(taken, place.index());
        });
    }

    /// Opens the states from which an action that moves a piece leads to this one. `earlier` are the lasting pieces that had moved before the
    /// robot pushed one from this cell.
    fn push(
        &self,
        taken: &[u64],
        met: &mut Met<'_>,
        neighbours: &[CellId; 4],
        swaps: bool,
        (moved, robot, piece): (usize, CellId, CellId),
        earlier: Option<usize>,
    ) {
        let distance = self.level.saturating_add(1);
        // Opposite directions differ in the lowest bit: north and south are 0 and 1, east and west 2 and 3.
        let [north, south, east, west] = *neighbours;
        for (before, beyond) in [(north, south), (south, north), (east, west), (west, east)] {
            if before == CellId::NONE || has(taken, before.index()) {
                continue;
            }
            if before == piece {
                if swaps && (self.others || beyond == CellId::NONE) {
                    met.open(self.number(moved, piece, robot), distance);
                }
            } else if beyond == piece && piece != CellId::NONE {
                met.open(self.number(moved, before, robot), distance);
            } else if let Some(earlier) = earlier
                && beyond != CellId::NONE
                && !has(taken, beyond.index())
            {
                met.open(self.number(earlier, before, piece), distance);
            }
        }
    }

    /// Whether the finished search knows every state from which the goal can be reached.
    pub(super) const fn is_whole(&self) -> bool {
        self.level < FARTHEST
    }

    /// The distances of all states, if they are stored.
    pub(super) fn distances<'m>(&self, marks: &'m [u64]) -> &'m [u64] {
        marks.get(self.words().wrapping_sub(entry_words(self.states))..).unwrap_or(&[])
    }

    /// The lower bound of the distance from the state with this number, `None` if no goal can be reached.
    #[inline]
    pub(super) fn distance(distances: &[u64], number: usize) -> Option<u32> {
        entry(distances, number).checked_sub(1).map(u32::from)
    }

    /// The bound of the distance from the planned state, if the task's piece is this one.
    pub(super) fn bound<G: PushGrid>(&self, marks: &mut [u64], grid: &G, state: &G::State, piece: Piece) -> Bound {
        let number = |state: &G::State| self.number(0, grid.cell(state, Piece::ROBOT), grid.cell(state, piece));
        let Some(parts) = self.parts(marks).filter(|_| self.is_whole()) else { return Bound::Unknown };
        if !has(parts.met.closed, number(state)) {
            return Bound::Unreachable;
        }
        if self.tabled {
            return Bound::AtLeast(u32::from(entry(parts.met.distances, number(state)).saturating_sub(1)));
        }
        // The planned state was opened last; states that are closed and not open are nearer.
        let is_nearer = |next: &G::State| has(parts.met.closed, number(next)) && !has(parts.met.next, number(next));
        let first = own_actions(grid).filter(|&action| grid.step(state, action).is_some_and(|next| is_nearer(&next)));
        Bound::Exactly(u32::from(self.level).saturating_add(1), first.fold(ActionSet::EMPTY, ActionSet::with))
    }

    /// Fills the marks with zeros.
    pub(super) fn clear(&self, marks: &mut [u64]) {
        marks.get_mut(..self.words()).unwrap_or(&mut []).fill(0);
    }
}

/// The greatest distance that is searched.
const FARTHEST: u16 = u16::MAX - 2;

/// Takes the first bit of a word.
#[inline]
fn take_bit(word: &mut u64) -> Option<usize> {
    let bit = word.trailing_zeros();
    *word &= word.wrapping_sub(1);
    (bit < 64).then_some(bit as usize)
}

fn remove(bits: &mut [u64], at: usize) {
    if let Some(word) = bits.get_mut(at / 64) {
        *word &= !(1 << (at % 64));
    }
}

#[inline]
fn has(bits: &[u64], at: usize) -> bool {
    bits.get(at / 64).is_some_and(|word| word >> (at % 64) & 1 == 1)
}
