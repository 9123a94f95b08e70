//! What the home's actions do, and which propositions hold (model: paper, section 4).

use super::layout::{Area, Cell, Place, Spot, StoredArea, WALL, spot_of};
use super::{AGENT_IN_DOOR, AGENT_IN_ROOM, BLOCK_IN_DOOR, BLOCK_IN_ROOM, ROOM, SCHEMA};
use crate::capacity::BLOCKS;
use crate::oomdp::{Action, ActionKind, Divider, Domain, Grid, GroundProposition, ObjectId, ObjectSet, Schema};

/// The actions that a home offers.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Moves {
    /// North, south, east, west; a block in the way is pushed.
    #[default]
    Push,
    /// Those and pull: the first neighbour block, in the order north, south, east, west, that could not be pushed swaps places with the
    /// agent.
    PushAndPull,
}

const ACTIONS: [ActionKind<'static>; 5] = [
    ActionKind { name: "north", cost: 1 },
    ActionKind { name: "south", cost: 1 },
    ActionKind { name: "east", cost: 1 },
    ActionKind { name: "west", cost: 1 },
    ActionKind { name: "pull", cost: 1 },
];

/// Where the agent and each block are.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct HomeState {
    pub(super) agent: Spot,
    pub(super) blocks: [Spot; BLOCKS],
}

/// A home: its rooms and doors, and what its actions do.
#[derive(Debug)]
pub struct Home<'m> {
    objects: ObjectSet<'m>,
    areas: &'m [StoredArea],
    places: &'m [Place],
    agent: ObjectId,
    blocks: [ObjectId; BLOCKS],
    block_count: usize,
    moves: Moves,
    grid: Grid,
    /// The smallest x and y of the places.
    corner: (i16, i16),
    by_spots: Divider,
}

impl<'m> Home<'m> {
    #[expect(clippy::too_many_arguments, reason = "called once, by the builder, with what it checked")]
    pub(super) fn new(
        objects: ObjectSet<'m>,
        areas: &'m [StoredArea],
        places: &'m [Place],
        count: usize,
        agent: ObjectId,
        blocks: [ObjectId; BLOCKS],
        block_count: usize,
        moves: Moves,
    ) -> Self {
        let places = places.get(..count).unwrap_or(&[]);
        let (grid, corner) = grid_of(places);
        Self { objects, areas, places, agent, blocks, block_count, moves, grid, corner, by_spots: Divider::new(places.len()) }
    }

    /// Which actions it offers.
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

    /// The box of a room or door; a box of no cell for anything else.
    pub fn area(&self, object: ObjectId) -> Area {
        self.areas.get(..self.objects.len()).and_then(|areas| areas.get(object.index())).map_or(Area::NOWHERE, |area| area.area())
    }

    /// The cells that are not wall, row by row from the south, each row from the west.
    pub fn places(&self) -> &[Place] {
        self.places
    }

    fn cell(&self, spot: Spot) -> Cell {
        self.places.get(usize::from(spot)).map_or(Cell::new(i32::MIN, i32::MIN), Place::cell)
    }

    /// Where the agent is.
    pub fn agent_cell(&self, state: &HomeState) -> Cell {
        self.cell(state.agent)
    }

    /// Where a block is; `None` for an object that is no block.
    pub fn block_cell(&self, state: &HomeState, block: ObjectId) -> Option<Cell> {
        let position = self.blocks().iter().position(|&id| id == block)?;
        state.blocks.get(position).map(|&spot| self.cell(spot))
    }

    /// The state in which the agent, or a block, stands on a cell: a robot that senses where things are says so by this. `None` where
    /// the cell is wall or taken, or the object is neither.
    pub fn placed(&self, state: &HomeState, object: ObjectId, cell: Cell) -> Option<HomeState> {
        let spot = spot_of(self.places, cell)?;
        let mut placed = *state;
        if object == self.agent {
            placed.agent = spot;
        } else {
            *placed.blocks.get_mut(self.blocks().iter().position(|&id| id == object)?)? = spot;
        }
        let taken = placed.blocks.iter().enumerate().any(|(position, &other)| {
            other != WALL && (other == placed.agent || placed.blocks.iter().take(position).any(|&earlier| earlier == other))
        });
        (!taken).then_some(placed)
    }

    #[inline]
    fn neighbour(&self, spot: Spot, direction: usize) -> Spot {
        self.places.get(usize::from(spot)).and_then(|place| place.neighbours.get(direction)).copied().unwrap_or(WALL)
    }

    #[inline]
    fn block_on(&self, state: &HomeState, spot: Spot) -> Option<usize> {
        state.blocks.iter().take(self.block_count).position(|&block| block == spot)
    }

    #[inline]
    fn go(&self, state: &HomeState, direction: usize) -> HomeState {
        let ahead = self.neighbour(state.agent, direction);
        if ahead == WALL {
            return *state;
        }
        let mut moved = HomeState { agent: ahead, ..*state };
        if let Some(block) = self.block_on(state, ahead) {
            let beyond = self.neighbour(ahead, direction);
            if beyond == WALL || self.block_on(state, beyond).is_some() {
                return *state;
            }
            if let Some(spot) = moved.blocks.get_mut(block) {
                *spot = beyond;
            }
        }
        moved
    }

    fn pull(&self, state: &HomeState) -> Option<HomeState> {
        for direction in 0..4 {
            let beside = self.neighbour(state.agent, direction);
            if beside == WALL {
                continue;
            }
            let Some(block) = self.block_on(state, beside) else { continue };
            let beyond = self.neighbour(beside, direction);
            if beyond == WALL || self.block_on(state, beyond).is_some() {
                let mut swapped = HomeState { agent: beside, ..*state };
                *swapped.blocks.get_mut(block)? = state.agent;
                return Some(swapped);
            }
        }
        None
    }

    /// The cells of a room inside its walls, or of a door.
    fn region_box(&self, region: usize) -> Area {
        let object = ObjectId(region as u8);
        let area = self.area(object);
        if self.objects.get(object).is_some_and(|object| object.class == ROOM) { area.inside() } else { area }
    }

    #[inline]
    fn spot_of_variable(&self, state: &HomeState, variable: usize) -> Spot {
        match variable.checked_sub(1) {
            None => state.agent,
            Some(block) => state.blocks.get(block).copied().unwrap_or(WALL),
        }
    }
}

/// The grid that holds all places, and the smallest x and y.
fn grid_of(places: &[Place]) -> (Grid, (i16, i16)) {
    let left = places.iter().map(|place| place.x).min().unwrap_or(0);
    let right = places.iter().map(|place| place.x).max().unwrap_or(0);
    let (bottom, top) = (places.first().map_or(0, |place| place.y), places.last().map_or(0, |place| place.y));
    let cells = |from: i16, to: i16| usize::from(to.wrapping_sub(from).cast_unsigned()).saturating_add(1);
    let width = cells(left, right).saturating_add(1);
    let grid = Grid { width, bits: width.saturating_mul(cells(bottom, top)).saturating_sub(1), directions: [0, 1, 2, 3].map(Action) };
    (grid, (left, bottom))
}

impl Domain for Home<'_> {
    type State = HomeState;

    fn schema(&self) -> Schema<'_> {
        SCHEMA
    }

    fn objects(&self) -> &ObjectSet<'_> {
        &self.objects
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
        let Some(variable) = self.reads(proposition) else { return false };
        let expected = match proposition.proposition {
            AGENT_IN_ROOM | AGENT_IN_DOOR => variable == 0 && subject == self.agent,
            BLOCK_IN_ROOM | BLOCK_IN_DOOR => variable != 0,
            _ => false,
        };
        let Some(place) = self.places.get(usize::from(self.spot_of_variable(state, variable))).filter(|_| expected) else {
            return false;
        };
        let marks = match proposition.proposition {
            AGENT_IN_ROOM | BLOCK_IN_ROOM => place.rooms,
            _ => place.doors,
        };
        marks.checked_shr(u32::from(container.0)).unwrap_or(0) & 1 == 1
    }

    fn state_count(&self) -> u64 {
        let spots = self.places.len() as u64;
        (0..self.block_count).fold(spots, |count, _| count.saturating_mul(spots))
    }

    // The agent's place counts fastest: neighbouring states lie close together in the search's arrays.
    #[inline]
    fn number(&self, state: &HomeState) -> u64 {
        let spots = self.places.len() as u64;
        let blocks = state.blocks.iter().take(self.block_count).rev();
        blocks
            .fold(0_u64, |number, &block| number.wrapping_mul(spots).wrapping_add(u64::from(block)))
            .wrapping_mul(spots)
            .wrapping_add(u64::from(state.agent))
    }

    #[inline]
    fn numbered(&self, number: u64) -> HomeState {
        let (row, agent) = self.by_spots.split(number);
        HomeState { agent: agent as Spot, ..self.row(row) }
    }

    #[inline]
    fn number_after(&self, state: &HomeState, number: u64, action: Action) -> Option<u64> {
        let direction = usize::from(action.0);
        if direction >= 4 {
            return self.step(state, action).map(|next| self.number(&next));
        }
        let ahead = self.neighbour(state.agent, direction);
        if ahead == WALL {
            return Some(number);
        }
        let moved = number.wrapping_sub(u64::from(state.agent)).wrapping_add(u64::from(ahead));
        let Some(block) = self.block_on(state, ahead) else { return Some(moved) };
        let beyond = self.neighbour(ahead, direction);
        if beyond == WALL || self.block_on(state, beyond).is_some() {
            return Some(number);
        }
        let spots = self.places.len() as u64;
        let worth = (0..block).fold(spots, |worth, _| worth.wrapping_mul(spots));
        Some(moved.wrapping_add(u64::from(beyond).wrapping_sub(u64::from(ahead)).wrapping_mul(worth)))
    }

    fn variables(&self) -> usize {
        self.block_count.saturating_add(1)
    }

    fn values(&self, _variable: usize) -> usize {
        self.places.len()
    }

    #[inline]
    fn value(&self, state: &HomeState, variable: usize) -> usize {
        usize::from(self.spot_of_variable(state, variable))
    }

    fn with_value(&self, state: &HomeState, variable: usize, value: usize) -> HomeState {
        let mut changed = *state;
        let spot = value as Spot;
        match variable.checked_sub(1) {
            None => changed.agent = spot,
            Some(block) => {
                if let Some(slot) = changed.blocks.get_mut(block) {
                    *slot = spot;
                }
            }
        }
        changed
    }

    fn reads(&self, proposition: &GroundProposition) -> Option<usize> {
        let [subject, ..] = proposition.arguments;
        if subject == self.agent {
            return Some(0);
        }
        self.blocks().iter().position(|&block| block == subject).map(|position| position.saturating_add(1))
    }

    fn grid(&self) -> Option<Grid> {
        Some(self.grid)
    }

    #[inline]
    fn row(&self, row: u64) -> HomeState {
        let (mut state, mut rest) = (HomeState { agent: 0, blocks: [WALL; BLOCKS] }, row);
        if let Some((last, blocks)) = state.blocks.get_mut(..self.block_count).and_then(<[Spot]>::split_last_mut) {
            for block in blocks {
                let (more, spot) = self.by_spots.split(rest);
                (*block, rest) = (spot as Spot, more);
            }
            *last = rest as Spot;
        }
        state
    }

    #[inline]
    fn bit_of(&self, place: usize) -> usize {
        let (left, bottom) = self.corner;
        self.places.get(place).map_or(0, |place| {
            let (right, up) = (place.x.wrapping_sub(left), place.y.wrapping_sub(bottom));
            usize::from(up.cast_unsigned()).wrapping_mul(self.grid.width).wrapping_add(usize::from(right.cast_unsigned()))
        })
    }

    #[inline]
    fn taken(&self, state: &HomeState, variable: usize) -> Option<usize> {
        state.blocks.get(variable.checked_sub(1)?).map(|&spot| usize::from(spot))
    }

    fn stands_still(&self, variable: usize) -> bool {
        variable != 0
    }

    fn ways_on(&self) -> usize {
        4
    }

    // A block is pushed from the cell behind it; pulled, it goes to any cell beside it.
    #[inline]
    fn way_on(&self, variable: usize, value: usize, way: usize) -> Option<usize> {
        let (ahead, behind) = (self.neighbour(value as Spot, way), self.neighbour(value as Spot, way ^ 1));
        (ahead != WALL && (variable == 0 || behind != WALL || self.moves == Moves::PushAndPull)).then_some(usize::from(ahead))
    }

    fn regions(&self) -> usize {
        self.objects.len()
    }

    fn region_size(&self, region: usize) -> usize {
        self.region_box(region).cells()
    }

    // A place in no room is in a door.
    fn region_of(&self, place: usize) -> Option<(usize, usize)> {
        let place = self.places.get(place)?;
        let region = (if place.rooms == 0 { place.doors } else { place.rooms }).trailing_zeros() as usize;
        Some((region, self.region_box(region).position(place.cell())?))
    }

    fn place_in(&self, region: usize, position: usize) -> Option<usize> {
        spot_of(self.places, self.region_box(region).cell_at(position)?).map(usize::from)
    }

    fn ways_in(&self) -> usize {
        match self.moves {
            Moves::Push => 8,
            Moves::PushAndPull => 12,
        }
    }

    // 0 to 3: the agent came from there and touched nothing; 4 to 7: it pushed the block that is now ahead; 8 to 11: it swapped places
    // with the block that is now there.
    #[inline]
    fn way_in(&self, state: &HomeState, way: usize) -> Option<HomeState> {
        let direction = way % 4;
        let from = self.neighbour(state.agent, direction);
        if from == WALL {
            return None;
        }
        let block = if way < 8 {
            if self.block_on(state, from).is_some() {
                return None;
            }
            if way < 4 {
                return Some(HomeState { agent: from, ..*state });
            }
            // North and south, east and west stand side by side.
            self.neighbour(state.agent, direction ^ 1)
        } else {
            from
        };
        let mut before = HomeState { agent: from, ..*state };
        *before.blocks.get_mut(self.block_on(state, block)?)? = state.agent;
        Some(before)
    }
}
