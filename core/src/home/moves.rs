//! The effects of a home's actions, and the propositions that hold (model: paper, section 4).

use super::layout::{Area, Cell, Place, find};
use super::{AGENT_IN_DOOR, AGENT_IN_ROOM, BLOCK_IN_DOOR, BLOCK_IN_ROOM, SCHEMA};
use crate::capacity::{BLOCKS, Capacities};
use crate::memory::HomeMemory;
#[cfg(feature = "alloc")]
use crate::oomdp::StateKey;
use crate::oomdp::{
    Action, ActionKind, BitRows, CellId, Divider, Domain, Floor, GroundProposition, ObjectCount, ObjectId, Objects, Piece, PushGrid, World,
};

/// The actions that a home offers.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Moves {
    /// North, south, east, west; a block in the way is pushed.
    #[default]
    Push,
    /// Push, and pull: the first neighbour block, in the order north, south, east, west, that could not be pushed swaps places with the
    /// agent.
    PushAndPull,
}

const ACTIONS: [ActionKind<'static>; 5] = [
    ActionKind::new("north", 1),
    ActionKind::new("south", 1),
    ActionKind::new("east", 1),
    ActionKind::new("west", 1),
    ActionKind::new("pull", 1),
];

/// Bits needed to number `cells` cells.
pub(super) const fn cell_bits(cells: usize) -> usize {
    (usize::BITS - cells.saturating_sub(1).leading_zeros()) as usize
}

/// The cells of the agent and of each block.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct HomeState {
    pub(super) agent: CellId,
    pub(super) blocks: [CellId; BLOCKS],
}

impl HomeState {
    /// The numbers of its cells: that of the agent, then those of the blocks. So a shell can write a state down.
    pub fn to_numbers(&self) -> impl Iterator<Item = u16> + '_ {
        core::iter::once(&self.agent).chain(&self.blocks).map(|cell| cell.0)
    }

    /// The state with these [numbers](Self::to_numbers), for the same home. A block without a number is nowhere.
    pub fn of_numbers(numbers: impl IntoIterator<Item = u16>) -> Self {
        let mut numbers = numbers.into_iter();
        let mut state = Self { agent: CellId(numbers.next().unwrap_or(0)), blocks: [CellId::NONE; BLOCKS] };
        state.blocks.iter_mut().zip(numbers).for_each(|(block, number)| *block = CellId(number));
        state
    }
}

/// A home: its rooms and doors, and the effects of its actions.
#[derive(Debug)]
pub struct Home<M> {
    memory: M,
    objects: ObjectCount,
    place_count: usize,
    agent: ObjectId,
    blocks: [ObjectId; BLOCKS],
    block_count: usize,
    moves: Moves,
    by_places: Divider,
    /// Whether there are more states than can be numbered.
    #[cfg(feature = "alloc")]
    is_vast: bool,
    #[cfg(feature = "ways")]
    tells_derived: bool,
}

impl<M> Home<M> {
    pub(super) fn new(
        memory: M,
        objects: ObjectCount,
        place_count: usize,
        agent: ObjectId,
        blocks: [ObjectId; BLOCKS],
        block_count: usize,
        moves: Moves,
    ) -> Self {
        Self {
            memory,
            objects,
            place_count,
            agent,
            blocks,
            block_count,
            moves,
            by_places: Divider::new(place_count as u16),
            #[cfg(feature = "alloc")]
            is_vast: (0..block_count).try_fold(place_count as u64, |states, _| states.checked_mul(place_count as u64)).is_none(),
            #[cfg(feature = "ways")]
            tells_derived: false,
        }
    }

    /// The same home with derived facts about its rooms and blocks, or without them: `leftmost`, `rightmost`, `topmost`, `bottommost`,
    /// `largest`, `smallest`, `nearest`, `farthest`, and `nextToRed` for a room that a door joins to a red room. Each is one more machine
    /// token to learn, so leave them out if colour and shape tell the rooms and blocks apart.
    ///
    /// ```
    /// use goodbot::{HeapMemory, oomdp::Domain, home::{Area, Cell, HomeBuilder, Moves}};
    /// let mut memory = HeapMemory::new(&goodbot::Capacities::SMALL);
    /// let mut builder = HomeBuilder::new(&mut memory.home);
    /// let small = builder.room("room0", Area::new(0, 0, 4, 4), "red")?;
    /// builder.room("room1", Area::new(4, 0, 12, 4), "red")?;
    /// builder.agent("agent0", Cell::new(6, 2))?;
    /// let (home, state) = builder.build(Moves::Push)?;
    /// let mut told = vec![];
    /// home.with_derived(true).tell_derived(&state, small, &mut |fact| told.push(fact.to_string()));
    /// assert_eq!(told, ["leftmost", "smallest"]);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    #[cfg(feature = "ways")]
    #[must_use]
    pub fn with_derived(self, tells_derived: bool) -> Self {
        Self { tells_derived, ..self }
    }

    /// Whether it has derived facts: see [`with_derived`](Self::with_derived).
    #[cfg(feature = "ways")]
    pub fn tells_derived(&self) -> bool {
        self.tells_derived
    }

    /// Returns the memory, for another home.
    pub fn into_memory(self) -> M {
        self.memory
    }

    /// The actions that it offers.
    pub fn moves(&self) -> Moves {
        self.moves
    }

    /// The agent.
    pub fn agent(&self) -> ObjectId {
        self.agent
    }

    /// The blocks, in the order of the state.
    pub fn blocks(&self) -> &[ObjectId] {
        self.blocks.get(..self.block_count).unwrap_or(&[])
    }

    /// The agent or block as a piece on the floor; `None` for any other object.
    pub fn piece(&self, object: ObjectId) -> Option<Piece> {
        if object == self.agent {
            return Some(Piece::ROBOT);
        }
        self.blocks().iter().position(|&block| block == object).map(|position| Piece((position + 1) as u8))
    }
}

impl<M: HomeMemory> Home<M> {
    /// The objects.
    pub fn objects(&self) -> Objects<'_> {
        Objects::new(self.memory.read().objects, self.objects)
    }

    /// The number of used entries in the tables of objects, names and cells.
    pub fn usage(&self) -> Capacities {
        let mut used = Capacities { cells: self.place_count, ..Capacities::NONE };
        self.objects().usage(&mut used);
        used
    }

    /// The box of a room or door; a box without cells for anything else.
    pub fn area(&self, object: ObjectId) -> Area {
        let areas = self.memory.read().areas;
        areas.get(..self.objects().len()).and_then(|areas| areas.get(object.index())).map_or(Area::NOWHERE, |area| area.area())
    }

    /// The cells that are not wall, row by row from the south, each row from the west.
    #[inline]
    pub fn places(&self) -> &[Place] {
        self.memory.read().places.get(..self.place_count).unwrap_or(&[])
    }

    fn place(&self, cell: CellId) -> Option<Cell> {
        self.places().get(cell.index()).map(Place::cell)
    }

    /// The agent's cell.
    pub fn agent_cell(&self, state: &HomeState) -> Cell {
        self.place(state.agent).unwrap_or(Cell::new(i32::MIN, i32::MIN))
    }

    /// The cell of a block; `None` for any other object.
    pub fn block_cell(&self, state: &HomeState, block: ObjectId) -> Option<Cell> {
        self.place(self.cell(state, self.piece(block).filter(|&piece| piece != Piece::ROBOT)?))
    }

    /// Moves the named agent and blocks to these cells, all at once, so two things can swap places. Use it for a robot that senses the
    /// places of things. The others stay. `None` if a cell is a wall, two things would share a cell, or an object is neither the agent nor
    /// a block.
    pub fn placed(&self, state: &HomeState, things: &[(ObjectId, Cell)]) -> Option<HomeState> {
        let placed = things
            .iter()
            .try_fold(*state, |placed, &(object, cell)| Some(self.put(&placed, self.piece(object)?, find(self.places(), cell)?)))?;
        let alone = |piece: usize| {
            let here = self.cell(&placed, Piece(piece as u8));
            (0..piece).all(|earlier| self.cell(&placed, Piece(earlier as u8)) != here)
        };
        (0..self.pieces()).all(alone).then_some(placed)
    }

    #[inline]
    fn block_on(&self, state: &HomeState, cell: CellId) -> Option<usize> {
        state.blocks.iter().take(self.block_count).position(|&block| block == cell)
    }

    #[inline]
    fn go(&self, state: &HomeState, direction: usize) -> HomeState {
        let ahead = self.floor().neighbour(state.agent, direction);
        if ahead == CellId::NONE {
            return *state;
        }
        let mut moved = HomeState { agent: ahead, ..*state };
        if let Some(block) = self.block_on(state, ahead) {
            let beyond = self.floor().neighbour(ahead, direction);
            if beyond == CellId::NONE || self.block_on(state, beyond).is_some() {
                return *state;
            }
            if let Some(cell) = moved.blocks.get_mut(block) {
                *cell = beyond;
            }
        }
        moved
    }

    fn pull(&self, state: &HomeState) -> Option<HomeState> {
        (0..4).find_map(|direction| {
            let beside = self.floor().neighbour(state.agent, direction);
            let block = self.block_on(state, beside).filter(|_| beside != CellId::NONE)?;
            let beyond = self.floor().neighbour(beside, direction);
            if beyond != CellId::NONE && self.block_on(state, beyond).is_none() {
                return None;
            }
            let mut swapped = HomeState { agent: beside, ..*state };
            *swapped.blocks.get_mut(block)? = state.agent;
            Some(swapped)
        })
    }
}

impl<M: HomeMemory> Domain for Home<M> {
    type State = HomeState;
    type Search = BitRows;

    fn world(&self) -> World<'_> {
        World { schema: SCHEMA, objects: self.objects() }
    }

    fn actions(&self) -> &[ActionKind<'_>] {
        match self.moves {
            Moves::Push => ACTIONS.get(..4).unwrap_or(&ACTIONS),
            Moves::PushAndPull => &ACTIONS,
        }
    }

    #[inline]
    fn step(&self, state: &HomeState, action: Action) -> Option<HomeState> {
        match action.0 {
            direction @ 0..4 => Some(self.go(state, usize::from(direction))),
            4 if self.moves == Moves::PushAndPull => self.pull(state),
            _ => None,
        }
    }

    fn holds(&self, proposition: &GroundProposition, state: &HomeState) -> bool {
        let [subject, container, _] = proposition.arguments;
        let Some(piece) = self.piece(subject) else { return false };
        let (of_agent, strictly) = match proposition.proposition {
            AGENT_IN_ROOM => (true, true),
            AGENT_IN_DOOR => (true, false),
            BLOCK_IN_ROOM => (false, true),
            BLOCK_IN_DOOR => (false, false),
            _ => return false,
        };
        let Some(cell) = self.place(self.cell(state, piece)).filter(|_| of_agent == (piece == Piece::ROBOT)) else { return false };
        let area = self.area(container);
        if strictly { area.holds_strictly(cell) } else { area.holds(cell) }
    }

    fn state_count(&self) -> u64 {
        let places = self.place_count as u64;
        (0..self.block_count).fold(places, |count, _| count.saturating_mul(places))
    }

    // The agent's cell counts fastest: neighbouring states lie close together in the search's arrays.
    #[inline]
    fn number(&self, state: &HomeState) -> u64 {
        // There are more states than numbers, so this number identifies none.
        if !self.is_numbered() {
            return 0;
        }
        let places = self.place_count as u64;
        let digit = |number: u64, cell: CellId| number.wrapping_mul(places).wrapping_add(u64::from(cell.0));
        digit(state.blocks.iter().take(self.block_count).rev().fold(0, |number, &block| digit(number, block)), state.agent)
    }

    #[inline]
    fn numbered(&self, number: u64) -> HomeState {
        let (mut rest, agent) = self.by_places.split(number);
        let mut state = HomeState { agent: CellId(agent as u16), blocks: [CellId::NONE; BLOCKS] };
        for block in state.blocks.iter_mut().take(self.block_count) {
            let (more, cell) = self.by_places.split(rest);
            (*block, rest) = (CellId(cell as u16), more);
        }
        state
    }

    #[cfg(feature = "alloc")]
    fn key(&self, state: &HomeState) -> StateKey {
        if self.is_numbered() {
            return StateKey::of(self.number(state));
        }
        let cells = core::iter::once(&state.agent).chain(state.blocks.iter().take(self.block_count));
        StateKey::packed(cells.map(|cell| cell.0), cell_bits(self.place_count))
    }

    #[cfg(feature = "alloc")]
    fn keyed(&self, key: StateKey) -> HomeState {
        if self.is_numbered() {
            return self.numbered(key.number());
        }
        let cell = |position| CellId(key.unpacked(position, cell_bits(self.place_count)));
        let mut state = HomeState { agent: cell(0), blocks: [CellId::NONE; BLOCKS] };
        for (block, place) in state.blocks.iter_mut().take(self.block_count).enumerate() {
            *place = cell(block.saturating_add(1));
        }
        state
    }

    #[cfg(feature = "ways")]
    fn tell_derived(&self, state: &HomeState, object: ObjectId, tell: &mut dyn FnMut(&str)) {
        if self.tells_derived {
            self.for_each_derived(state, object, tell);
        }
    }
}

impl<M: HomeMemory> PushGrid for Home<M> {
    #[cfg(feature = "alloc")]
    #[inline]
    fn is_numbered(&self) -> bool {
        !self.is_vast
    }

    #[inline]
    fn floor(&self) -> Floor<'_> {
        Floor { cells: self.places(), directions: [0, 1, 2, 3].map(Action) }
    }

    #[inline]
    fn pieces(&self) -> usize {
        self.block_count + 1
    }

    #[inline]
    fn cell(&self, state: &HomeState, piece: Piece) -> CellId {
        match usize::from(piece.0).checked_sub(1) {
            None => state.agent,
            Some(block) => state.blocks.get(block).copied().unwrap_or(CellId::NONE),
        }
    }

    #[inline]
    fn put(&self, state: &HomeState, piece: Piece, cell: CellId) -> HomeState {
        let mut changed = *state;
        let slot = match usize::from(piece.0).checked_sub(1) {
            None => Some(&mut changed.agent),
            Some(block) => changed.blocks.get_mut(block),
        };
        if let Some(slot) = slot {
            *slot = cell;
        }
        changed
    }

    fn piece_of(&self, proposition: &GroundProposition) -> Option<Piece> {
        self.piece(proposition.arguments.first().copied()?)
    }

    fn can_pull(&self) -> bool {
        self.moves == Moves::PushAndPull
    }

    #[inline]
    fn pushes_plainly(&self) -> bool {
        true
    }

    #[inline]
    fn swaps(&self) -> bool {
        self.can_pull()
    }
}
