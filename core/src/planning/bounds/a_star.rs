//! A* with the lower bound as heuristic. It finds the first actions of all shortest plans.
//!
//! Besides the robot and the task's piece, only pieces that are in the way move: at first those that the task depends on. The others are
//! removed, so each plan of the floor is also one here. If a shortest plan never enters the cell of a removed piece, it is a plan of the
//! floor as well, and its distance and first action are exact. If it does, one such set of pieces comes back, and the search is repeated
//! with this distance as threshold (counterexample-guided refinement). So a piece that is not in the way multiplies no states.
//!
//! It proceeds breadth first, from one distance g to the next, and leaves out states whose g and lower bound h together exceed a threshold
//! (breadth-first iterative-deepening A*: Zhou and Hansen, 2004). So a goal is met first at its true distance, even if the threshold is
//! greater. The first threshold is the start's own bound. Then it grows to the least sum that was left out, or further if the last growth
//! added few states. If nothing was left out, no goal can be reached.
//!
//! A state takes two words. One has the robot's cell, that of the task's piece, the arrangement of the others and the distance g; the other
//! describes the plans that lead to the state. An arrangement is a chain of the pieces that have moved, in order, each with its new cell.
//! It needs no number of the joint state, so homes may have more states than can be numbered.

use super::relaxation::{MOST_LASTING, Relaxation, others, piece_of};
use crate::oomdp::{Action, ActionSet, CellId, Piece, PushGrid, own_actions};
use crate::planning::bits::{entry, set_entry};
use crate::planning::goals::Goals;
use crate::planning::plan::Results;
use crate::task::TaskSet;

/// The outcome of a call.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Outcome {
    Working,
    /// All goals at the least distance are found.
    Met,
    /// No goal can be reached.
    Unreachable,
    /// The memory or the work is not sufficient.
    GivenUp,
}

/// The most arrangements of other pieces, and the most states; 16 bits identify them.
const MOST_ARRANGEMENTS: usize = 1 << 14;
const MOST_STATES: usize = u16::MAX as usize - 1;
/// An expansion meets this many states, in four directions with pushes and pulls. More of them would only take room from later states.
const SUCCESSORS: usize = 8;
/// A search counts as long after one expansion per this many states of the lower bound.
const STATES_AN_EXPANSION: usize = 16;
/// A sharper lower bound is made only if it leaves the states this many times the memory of the first one.
const LEAST_ROOM: usize = 4;
/// To clear this many words costs about as much as to find one place.
const WORDS_A_PLACE: usize = 16;
/// After this many occupied places in a row, a table counts as full.
const PROBES: usize = 32;

/// The search for one task, and its progress.
#[derive(Clone, Copy, Debug)]
pub(super) struct AStar {
    task: usize,
    piece: Piece,
    /// A lower bound that knows pieces in the way, once the search is long, and the start of the memory of the bound in use in the marks.
    sharper: Option<Relaxation>,
    bound_at: usize,
    /// The start of its memory in the marks: the arrangements, the states in the order in which they were met, and an index of them.
    at: usize,
    arrangements: usize,
    /// The numbers of states that fit, that were met, and that were expanded.
    room: usize,
    met: usize,
    expanded: usize,
    /// The states met in the last round with a smaller threshold.
    last: u32,
    threshold: u32,
    /// The least sum above the threshold.
    beyond: u32,
    /// The remaining expansions, and their number when the search counts as long.
    left: u32,
    long: u32,
    /// The distance of the nearest goals; the greatest number before they are found.
    distance: u32,
    /// The plans that lead to them.
    reached: Reached,
    /// The pieces on the floor besides the task's own, one bit each.
    present: u32,
    /// The arrangement that was added last, or 0.
    arranged: u16,
}

/// A state being expanded, with the cells of the pieces present.
struct Here {
    key: u64,
    reached: Reached,
    cells: Cells,
}

/// The cells of some pieces; never of the robot and the task's own.
#[derive(Clone, Copy)]
struct Cells {
    of: [CellId; 32],
    /// A bit for each cell, by the last digits of its number; of earlier cells too.
    taken: u64,
}

impl Cells {
    const NONE: Self = Self { of: [CellId::NONE; 32], taken: 0 };

    /// Puts a piece on a cell; `None` if there is no such piece.
    #[inline]
    fn put(&mut self, piece: Piece, cell: CellId) -> Option<()> {
        *self.of.get_mut(piece.index())? = cell;
        self.taken |= 1_u64.wrapping_shl(u32::from(cell.0));
        Some(())
    }

    /// The pieces on a cell, one bit each.
    #[inline]
    fn at(&self, cell: CellId) -> u32 {
        if self.taken >> (cell.0 % 64) & 1 == 0 {
            return 0;
        }
        // A look at sixteen pieces at once.
        let at = |half: &[CellId; 16]| {
            half.iter().enumerate().fold(0, |at, (piece, &there)| at | if there == cell { 1_u16.wrapping_shl(piece as u32) } else { 0 })
        };
        self.of.as_chunks().0.iter().rev().fold(0, |all, half| all << 16 | u32::from(at(half)))
    }
}

/// The result of an action.
struct Ahead {
    action: Action,
    robot: CellId,
    piece: CellId,
    /// Another piece, and its new cell.
    moved: Option<(Piece, CellId)>,
    /// Its entry in the table of lower bounds.
    bound: u16,
    /// The removed pieces whose cells are entered.
    hit: u32,
}

/// The plans that lead to a state.
#[derive(Clone, Copy, Debug)]
struct Reached {
    /// Their first actions.
    first: ActionSet,
    /// The first actions of plans that are also plans of the floor with all pieces.
    sure: ActionSet,
    /// The pieces that one of the other plans passes through, one bit each.
    blockers: u32,
}

impl Reached {
    const NOT: Self = Self::of(0);

    const fn of(word: u64) -> Self {
        Self {
            first: ActionSet::of_first_16(word as u16),
            sure: ActionSet::of_first_16((word >> 16) as u16),
            blockers: (word >> 32) as u32,
        }
    }

    const fn word(self) -> u64 {
        self.first.first_16() as u64 | (self.sure.first_16() as u64) << 16 | (self.blockers as u64) << 32
    }

    /// The same plans, continued by an action to this distance.
    #[inline]
    fn by(self, action: Action, distance: u32) -> Self {
        let first = ActionSet::of(action);
        if distance == 1 { Self { first, sure: first, blockers: 0 } } else { self }
    }

    /// The same plans, continued into the cells of these removed pieces.
    fn through(self, hit: u32) -> Self {
        if hit == 0 { self } else { Self { sure: ActionSet::EMPTY, blockers: self.blockers | hit, ..self } }
    }

    /// These plans and others to the same state. The smaller set of pieces in the way is kept.
    fn or(self, other: Self) -> Self {
        let (first, sure) = (self.first.union(other.first), self.sure.union(other.sure));
        let is_other = other.blockers != 0 && (self.blockers == 0 || other.blockers.count_ones() < self.blockers.count_ones());
        let blockers = if is_other { other.blockers } else { self.blockers };
        Self { first, sure, blockers: if first == sure { 0 } else { blockers } }
    }
}

/// The input of a search.
pub(super) struct Scene<'d, G: PushGrid> {
    pub(super) grid: &'d G,
    pub(super) goals: &'d Goals<'d>,
    pub(super) relaxation: &'d Relaxation,
    /// The planned state.
    pub(super) start: &'d G::State,
    /// The likely tasks to come that share the lower bound.
    pub(super) rest: TaskSet,
}

/// The parts of the memory.
struct Parts<'m> {
    relaxed: &'m [u64],
    /// The lower bounds of the states, while the search goes on.
    bounds: &'m [u64],
    arrangements: &'m mut [u64],
    states: &'m mut [[u64; 2]],
    /// For each place the number of a state, or 0.
    index: &'m mut [u64],
}

/// The key of a state, without its distance.
const fn key(arrangement: u16, robot: CellId, piece: CellId) -> u64 {
    (arrangement as u64) << 48 | (robot.0 as u64) << 32 | (piece.0 as u64) << 16
}

/// The bits of an arrangement that hold its piece, the piece's cell, and the arrangement of the pieces before.
const CHAIN: u64 = 0xffff_ffff_ffff;

/// The entry of a state at the goal in the table of lower bounds.
const AT_GOAL: u16 = 1;

/// The bits of a key that hold the distance.
const DISTANCE: u64 = 0xffff;

/// The possible places of a key in a table of this size.
#[inline]
fn places(key: u64, size: usize) -> impl Iterator<Item = usize> {
    let spread = (key ^ key >> 32).wrapping_mul(0x9e37_79b9_7f4a_7c15);
    let first = ((spread >> 32).wrapping_mul(size as u64) >> 32) as usize;
    // After the last place comes the first.
    (first..first.wrapping_add(size.min(PROBES))).map(move |place| if place < size { place } else { place.wrapping_sub(size) })
}

/// The place of the state with this number, counted from the first one met.
#[inline]
fn slot(number: usize, room: usize) -> Option<usize> {
    // Most searches need no division.
    if number < room { Some(number) } else { number.checked_rem(room) }
}

/// The pieces in a bit set.
fn pieces(mut bits: u32) -> impl Iterator<Item = Piece> {
    core::iter::from_fn(move || {
        let piece = Piece(bits.trailing_zeros() as u8);
        bits &= bits.wrapping_sub(1);
        (piece.0 < 32).then_some(piece)
    })
}

impl AStar {
    /// The search for a task with at least this distance, in at most `most` expansions; closed if there is no memory for one. It takes over
    /// the sharper lower bound of an earlier task.
    pub(super) fn new<G: PushGrid>(
        scene: &Scene<'_, G>,
        words: usize,
        (task, piece): (usize, Piece),
        (distance, most): (u32, u32),
        sharper: Option<Relaxation>,
    ) -> Self {
        // If pieces can be pulled, another piece behind one may be needed.
        let swaps = scene.grid.swaps();
        let asked = if swaps { u32::MAX } else { scene.goals.pieces_of(task).unwrap_or(0) };
        let asked = asked | sharper.map_or(0, |bound| bound.lasting_pieces());
        let present = asked & others(scene.grid, piece).fold(0, |all, other| all | other.bit());
        let shared = scene.relaxation.words();
        let mut it = Self {
            task,
            piece,
            sharper,
            bound_at: sharper.map_or(0, |_| shared),
            at: 0,
            arrangements: 0,
            room: 0,
            met: 0,
            expanded: 0,
            last: 0,
            threshold: distance,
            beyond: u32::MAX,
            left: most,
            long: if swaps { 0 } else { most.saturating_sub((scene.relaxation.states() / STATES_AN_EXPANSION) as u32) },
            distance: u32::MAX,
            reached: Reached::NOT,
            present,
            arranged: 0,
        };
        it.lay_out(shared.saturating_add(sharper.map_or(0, |bound| bound.words())), words);
        it
    }

    /// Lays out its memory from a word on, up to another.
    fn lay_out(&mut self, at: usize, to: usize) {
        let words = to.saturating_sub(at);
        self.at = at;
        self.arrangements = (words / 8).min(MOST_ARRANGEMENTS);
        // Two words a state, and half a word for its two places in the index.
        let most = (self.left as usize).saturating_mul(SUCCESSORS).min(MOST_STATES);
        self.room = (words.saturating_sub(self.arrangements).saturating_mul(2) / 5).min(most);
    }

    /// How many pieces in the way its lower bound knows.
    fn known(&self) -> usize {
        self.sharper.map_or(0, |bound| bound.lasting())
    }

    /// The remaining expansions below which its lower bound is to know more of the pieces in the way.
    fn sharpens_below(&self) -> u32 {
        if self.known() < MOST_LASTING.min(self.present.count_ones() as usize) { self.long } else { 0 }
    }

    /// Begins anew with a lower bound that knows more of the pieces in the way, if there is memory for it. Each of them doubles its words.
    fn sharpen<G: PushGrid>(&mut self, marks: &mut [u64], scene: &Scene<'_, G>) {
        let (from, to) = (scene.relaxation.words(), marks.len());
        let times = to.checked_div(from).unwrap_or(0).saturating_sub(LEAST_ROOM.saturating_add(1));
        let fits = times.checked_ilog2().unwrap_or(0) as usize;
        if fits <= self.known() {
            self.long = 0;
            return;
        }
        self.clear(marks);
        (self.met, self.arranged, self.last) = (0, 0, 0);
        // Without the pieces of the tasks to come, they can use the bound as well.
        let of_tasks = scene.rest.iter().filter_map(|task| piece_of(scene.grid, scene.goals, scene.start, task));
        let of_tasks = of_tasks.fold(0, |all, piece| all | piece.bit());
        let candidates = pieces(self.present & !of_tasks).chain(pieces(self.present & of_tasks));
        let first = candidates.take(fits.min(MOST_LASTING)).fold(0, |first, piece| first | piece.bit());
        let rest = marks.get_mut(from..).unwrap_or(&mut []);
        self.sharper = Relaxation::begin(rest, scene.grid, scene.goals, scene.start, self.task, first);
        let words = self.sharper.map(|bound| bound.words());
        if words.is_none() {
            self.long = 0;
        }
        self.bound_at = words.map_or(0, |_| from);
        self.lay_out(from.saturating_add(words.unwrap_or(0)), to);
    }

    fn parts<'m>(&self, marks: &'m mut [u64]) -> Option<Parts<'m>> {
        let (relaxed, rest) = marks.split_at_mut_checked(self.at)?;
        let relaxed = relaxed.get(self.bound_at..)?;
        let (arrangements, rest) = rest.split_at_mut_checked(self.arrangements)?;
        let (states, rest) = rest.split_at_mut_checked(self.room.saturating_mul(2))?;
        let index = rest.get_mut(..self.room / 2)?;
        Some(Parts { relaxed, bounds: &[], arrangements, states: states.as_chunks_mut().0, index })
    }

    /// Fills its memory with zeros.
    pub(super) fn clear(&self, marks: &mut [u64]) {
        self.clear_own(marks);
        if let Some(bound) = &self.sharper {
            bound.clear(marks.get_mut(self.bound_at..).unwrap_or(&mut []));
        }
    }

    /// Fills its memory with zeros, but for a lower bound of its own.
    fn clear_own(&self, marks: &mut [u64]) {
        if let Some(mut parts) = self.parts(marks) {
            self.clear_states(&mut parts);
        }
    }

    /// Whether the search is not at its end.
    pub(super) const fn is_open(&self) -> bool {
        self.room > 0
    }

    /// Its sharper lower bound, if that also serves a task of this piece, on this cell, with the same goal cells.
    pub(super) fn bound_for(&self, marks: &[u64], piece: Piece, cell: CellId) -> Option<Relaxation> {
        let rest = marks.get(self.bound_at..)?;
        self.sharper.filter(|bound| bound.is_whole() && bound.lasting_pieces() & piece.bit() == 0 && !bound.is_wall(rest, cell))
    }

    /// Fills the memory of the states with zeros.
    fn clear_states(&self, Parts { arrangements, states, index, .. }: &mut Parts<'_>) {
        let met = states.get_mut(..self.met.min(self.room)).unwrap_or(&mut []);
        if met.len() > index.len() / WORDS_A_PLACE {
            index.fill(0);
        } else {
            met.iter().enumerate().for_each(|(at, state)| self.forget(index, at, state[0]));
        }
        met.fill([0; 2]);
        let mut arranged = self.arranged;
        while let Some(entry) = usize::from(arranged).checked_sub(1).and_then(|at| arrangements.get_mut(at)) {
            (arranged, *entry) = ((*entry >> 48) as u16, 0);
        }
    }

    /// Removes a state with this key from the index. If it is met again later, it may be stored twice, which costs work but changes no
    /// plan.
    fn forget(&self, index: &mut [u64], at: usize, key: u64) {
        let number = at.wrapping_add(1) as u16;
        let place = places(key & !DISTANCE, self.places()).find(|&place| entry(index, place) == number);
        place.into_iter().for_each(|place| set_entry(index, place, 0));
    }

    /// The number of places in the index.
    const fn places(&self) -> usize {
        (self.room / 2).saturating_mul(4)
    }

    /// Continues, with at most `left` expansions. At the end it is closed, and leaves zeros in its memory but for a lower bound of its own.
    pub(super) fn advance<G: PushGrid>(
        &mut self,
        marks: &mut [u64],
        results: &mut Results<'_>,
        scene: &Scene<'_, G>,
        left: &mut u32,
    ) -> Outcome {
        while *left > 0 {
            if self.left < self.sharpens_below() {
                self.sharpen(marks, scene);
            }
            let rest = marks.get_mut(self.bound_at..).unwrap_or(&mut []);
            if self.sharper.as_mut().is_some_and(|bound| !bound.search(rest, scene.grid, left)) {
                continue;
            }
            let bound = self.sharper;
            let outcome = self.go_on(marks, &Scene { relaxation: bound.as_ref().unwrap_or(scene.relaxation), ..*scene }, left);
            match outcome {
                Outcome::Working if self.left > 0 => continue,
                Outcome::Met => {
                    results.found.level = self.distance;
                    results.meet(self.task, self.reached.first);
                    results.end_level();
                }
                Outcome::Unreachable => results.found.rule_out(TaskSet::of(self.task)),
                Outcome::Working | Outcome::GivenUp => {}
            }
            self.clear_own(marks);
            (self.met, self.arranged, self.room) = (0, 0, 0);
            return if outcome == Outcome::Working { Outcome::GivenUp } else { outcome };
        }
        Outcome::Working
    }

    /// Continues the search with one lower bound.
    fn go_on<G: PushGrid>(&mut self, marks: &mut [u64], scene: &Scene<'_, G>, left: &mut u32) -> Outcome {
        let Some(mut parts) = self.parts(marks) else { return Outcome::GivenUp };
        parts.bounds = scene.relaxation.distances(parts.relaxed);
        let (mut outcome, mut cells, mut least) = (Outcome::Working, self.cells_at_start(scene), self.sharpens_below().max(1));
        while outcome == Outcome::Working && *left > 0 && self.left >= least {
            if let Some(state) = self.take(&parts) {
                *left = left.saturating_sub(1);
                self.left = self.left.saturating_sub(1);
                outcome = self.expand(&mut parts, scene, &cells, state).map_or(Outcome::GivenUp, |()| Outcome::Working);
            } else {
                outcome = self.next_round(&mut parts, scene);
                (cells, least) = (self.cells_at_start(scene), self.sharpens_below().max(1));
            }
        }
        outcome
    }

    /// The planned state's cells of the pieces present, and of those removed.
    fn cells_at_start<G: PushGrid>(&self, scene: &Scene<'_, G>) -> [Cells; 2] {
        let (mut present, mut removed) = (Cells::NONE, Cells::NONE);
        for piece in others(scene.grid, self.piece) {
            let cells = if self.present & piece.bit() == 0 { &mut removed } else { &mut present };
            cells.put(piece, scene.grid.cell(scene.start, piece));
        }
        [present, removed]
    }

    /// Takes the next state, unless the nearest goals are found.
    #[inline]
    fn take(&mut self, parts: &Parts<'_>) -> Option<[u64; 2]> {
        let at = slot(self.expanded, self.room).filter(|_| self.expanded < self.met)?;
        let state = *parts.states.get(at)?;
        if (state[0] & DISTANCE) as u32 >= self.distance {
            return None;
        }
        self.expanded = self.expanded.wrapping_add(1);
        Some(state)
    }

    /// Begins at the start: for the first time, with pieces that were in the way, or with the next threshold.
    fn next_round<G: PushGrid>(&mut self, parts: &mut Parts<'_>, scene: &Scene<'_, G>) -> Outcome {
        // A bound that ends before all states are told says nothing.
        if !scene.relaxation.is_whole() {
            return Outcome::GivenUp;
        }
        let (robot, piece) = (scene.grid.cell(scene.start, Piece::ROBOT), self.cell_of_piece(scene.grid, scene.start));
        let Some(lower) = Relaxation::distance(parts.bounds, scene.relaxation.number(0, robot, piece)) else {
            return Outcome::Unreachable;
        };
        self.threshold = self.threshold.max(lower);
        if self.met > 0 {
            self.clear_states(parts);
            self.arranged = 0;
            if self.distance != u32::MAX {
                if self.reached.first == self.reached.sure {
                    return Outcome::Met;
                }
                self.present |= self.reached.blockers;
                self.threshold = self.distance;
            } else if self.beyond == u32::MAX {
                return Outcome::Unreachable;
            } else {
                let met = self.met as u32;
                let has_grown = met.saturating_mul(4) >= self.last.saturating_mul(7);
                let further = if has_grown { 0 } else { self.threshold.saturating_sub(lower) / 2 };
                (self.last, self.threshold) = (met, self.beyond.max(self.threshold.saturating_add(further)));
            }
        }
        (self.met, self.expanded, self.beyond, self.distance, self.reached) = (1, 0, u32::MAX, u32::MAX, Reached::NOT);
        let (key, places) = (key(0, robot, piece), self.places());
        let (Some(first), Some(place)) = (parts.states.first_mut(), self::places(key, places).next()) else { return Outcome::GivenUp };
        *first = [key, 0];
        set_entry(parts.index, place, 1);
        Outcome::Working
    }

    /// The cell of the task's piece; none if it is the robot.
    fn cell_of_piece<G: PushGrid>(&self, grid: &G, state: &G::State) -> CellId {
        if self.piece == Piece::ROBOT { CellId::NONE } else { grid.cell(state, self.piece) }
    }

    /// Opens the successors of a state; `None` if there is no room for one.
    #[inline(never)]
    fn expand<G: PushGrid>(
        &mut self,
        parts: &mut Parts<'_>,
        scene: &Scene<'_, G>,
        [present, removed]: &[Cells; 2],
        [key, word]: [u64; 2],
    ) -> Option<()> {
        let Scene { grid, relaxation, .. } = *scene;
        let (arrangement, robot, piece) = ((key >> 48) as u16, CellId((key >> 32) as u16), CellId((key >> 16) as u16));
        let mut from = Here { key, reached: Reached::of(word), cells: *present };
        let mut link = arrangement;
        while let Some(&moved) = usize::from(link).checked_sub(1).and_then(|at| parts.arrangements.get(at)) {
            from.cells.put(Piece((moved >> 16 & 0x1f) as u8), CellId(moved as u16))?;
            link = (moved >> 32) as u16;
        }
        let lasting = relaxation.lasting_cells(&from.cells.of);
        let row = relaxation.number(relaxation.moved(&lasting, CellId::NONE, CellId::NONE), CellId(0), piece);
        let distance = ((key & DISTANCE) as u32).wrapping_add(1);
        let floor = grid.floor();
        let neighbours = &floor.cells.get(robot.index())?.neighbours;
        for direction in 0..4 {
            let (Some(&ahead), Some(&action)) = (neighbours.get(direction), floor.directions.get(direction)) else { break };
            if ahead == CellId::NONE {
                continue;
            }
            // Most actions are ruled out without a look at the other pieces.
            let number = if ahead == piece || lasting.contains(&ahead) {
                let beyond = floor.neighbour(ahead, direction);
                if ahead == piece && beyond == CellId::NONE {
                    continue;
                }
                relaxation.number(relaxation.moved(&lasting, ahead, beyond), ahead, if ahead == piece { beyond } else { piece })
            } else {
                row.wrapping_add(ahead.index())
            };
            let bound = entry(parts.bounds, number);
            if !self.is_within(distance, bound) {
                continue;
            }
            let hit = if relaxation.has_piece(parts.relaxed, ahead) { removed.at(ahead) } else { 0 };
            let other = from.cells.at(ahead);
            if ahead != piece && other == 0 && bound != AT_GOAL {
                let reached = from.reached.by(action, distance).through(hit);
                self.meet(parts, self::key(arrangement, ahead, piece), u64::from(distance), reached)?;
                continue;
            }
            let mut to = Ahead { action, robot: ahead, piece, moved: None, bound, hit };
            if ahead == piece || other != 0 {
                let beyond = floor.neighbour(ahead, direction);
                if beyond == CellId::NONE || beyond == piece || from.cells.at(beyond) != 0 || relaxation.is_wall(parts.relaxed, beyond) {
                    continue;
                }
                to.hit |= if relaxation.has_piece(parts.relaxed, beyond) { removed.at(beyond) } else { 0 };
                to.piece = if ahead == piece { beyond } else { piece };
                to.moved = pieces(other).next().map(|other| (other, beyond));
            }
            self.open(parts, scene, &from, &to)?;
        }
        if grid.swaps() { self.swap(parts, scene, &from) } else { Some(()) }
    }

    /// Opens the states that the other actions lead to: swaps of the robot with a piece. `None` if there is no room for one.
    #[inline(never)]
    fn swap<G: PushGrid>(&mut self, parts: &mut Parts<'_>, scene: &Scene<'_, G>, from: &Here) -> Option<()> {
        let (grid, distance) = (scene.grid, ((from.key & DISTANCE) as u32).saturating_add(1));
        let (robot, piece) = (CellId((from.key >> 32) as u16), CellId((from.key >> 16) as u16));
        let (state, directions) = (self.state(scene, &from.cells.of, robot, piece), grid.floor().directions);
        for action in own_actions(grid).filter(|action| !directions.contains(action)) {
            let Some(next) = grid.step(&state, action).filter(|next| *next != state) else { continue };
            let (robot, piece) = (grid.cell(&next, Piece::ROBOT), self.cell_of_piece(grid, &next));
            let bound = entry(parts.bounds, scene.relaxation.number(0, robot, piece));
            if self.is_within(distance, bound) {
                let moved = pieces(self.present).map(|other| (other, grid.cell(&next, other)));
                let moved = moved.into_iter().find(|(other, cell)| from.cells.of.get(other.index()) != Some(cell));
                self.open(parts, scene, from, &Ahead { action, robot, piece, moved, bound, hit: 0 })?;
            }
        }
        Some(())
    }

    /// The state with the pieces on these cells, and the removed ones in their own places.
    fn state<G: PushGrid>(&self, scene: &Scene<'_, G>, cells: &[CellId; 32], robot: CellId, piece: CellId) -> G::State {
        let put = |state: G::State, piece: Piece, cell: Option<CellId>| cell.map_or(state, |cell| scene.grid.put(&state, piece, cell));
        let state = pieces(self.present).fold(*scene.start, |state, other| put(state, other, cells.get(other.index()).copied()));
        let state = put(state, self.piece, Some(piece).filter(|_| self.piece != Piece::ROBOT));
        put(state, Piece::ROBOT, Some(robot))
    }

    /// Opens the state that an action leads to, or records its goal; `None` if there is no room for it.
    #[inline(never)]
    fn open<G: PushGrid>(&mut self, parts: &mut Parts<'_>, scene: &Scene<'_, G>, from: &Here, to: &Ahead) -> Option<()> {
        let distance = (from.key & DISTANCE).wrapping_add(1);
        let reached = from.reached.by(to.action, distance as u32).through(to.hit);
        let mut cells = from.cells;
        if let Some((other, cell)) = to.moved {
            cells.put(other, cell)?;
        }
        let is_goal = || {
            let state = self.state(scene, &cells.of, to.robot, to.piece);
            !scene.goals.satisfied(scene.grid, &state, TaskSet::of(self.task)).is_empty()
        };
        if to.bound == AT_GOAL && is_goal() {
            (self.distance, self.reached) = (distance as u32, self.reached.or(reached));
            return Some(());
        }
        let arrangement = if to.moved.is_some() { self.arrange(parts.arrangements, scene, &cells)? } else { (from.key >> 48) as u16 };
        self.meet(parts, key(arrangement, to.robot, to.piece), distance, reached)
    }

    /// Opens a state at a distance, unless it is known; `None` if there is no room for it.
    #[inline]
    fn meet(&mut self, Parts { states, index, .. }: &mut Parts<'_>, key: u64, distance: u64, reached: Reached) -> Option<()> {
        for place in places(key, self.places()) {
            let number = usize::from(entry(index, place));
            let Some(at) = number.checked_sub(1) else {
                // If there is no room left, it replaces the state that was expanded first.
                let at = slot(self.met, self.room).filter(|_| self.met.wrapping_sub(self.expanded) < self.room)?;
                let state = states.get_mut(at)?;
                if self.met >= self.room {
                    self.forget(index, at, state[0]);
                }
                *state = [key | distance, reached.word()];
                self.met = self.met.wrapping_add(1);
                set_entry(index, place, at.wrapping_add(1) as u16);
                return Some(());
            };
            let [known, word] = states.get_mut(at)?;
            if *known & !DISTANCE == key {
                // Longer plans to a state are not needed.
                if *known & DISTANCE == distance {
                    *word = Reached::of(*word).or(reached).word();
                }
                return Some(());
            }
        }
        None
    }

    /// The arrangement of pieces on these cells, added if it is new; `None` if there is no room for it.
    fn arrange<G: PushGrid>(&mut self, arrangements: &mut [u64], scene: &Scene<'_, G>, cells: &Cells) -> Option<u16> {
        let mut arrangement = 0_u16;
        for other in pieces(self.present) {
            let cell = *cells.of.get(other.index())?;
            if cell != scene.grid.cell(scene.start, other) {
                let moved = u64::from(arrangement) << 32 | u64::from(other.0) << 16 | u64::from(cell.0);
                let is_it = |&at: &usize| arrangements.get(at).is_some_and(|&entry| entry == 0 || entry & CHAIN == moved);
                let at = places(moved, arrangements.len()).find(is_it)?;
                arrangement = at.wrapping_add(1) as u16;
                let entry = arrangements.get_mut(at)?;
                if *entry == 0 {
                    // The first bits have the arrangement added before, so that all can be cleared.
                    *entry = moved | u64::from(self.arranged) << 48;
                    self.arranged = arrangement;
                }
            }
        }
        Some(arrangement)
    }

    /// Whether a state at this distance with this lower bound can be on a plan within the threshold. If not, records the sum.
    #[inline]
    fn is_within(&mut self, distance: u32, bound: u16) -> bool {
        let Some(bound) = bound.checked_sub(1) else { return false };
        let sum = distance.wrapping_add(u32::from(bound));
        if sum > self.threshold {
            self.beyond = self.beyond.min(sum);
        }
        sum <= self.threshold
    }
}
