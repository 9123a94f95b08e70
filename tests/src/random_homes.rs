//! Random homes, the same for the same seed.

use goodbot::home::{Area, Cell, Home, HomeBuilder, HomeState, Moves};
use goodbot::memory::HomeMemory;
use rand_pcg::Pcg32;
use rand_pcg::rand_core::Rng;

/// A number from 0 to below `limit`.
pub fn below(random: &mut Pcg32, limit: i32) -> i32 {
    (random.next_u32() % limit.max(1).cast_unsigned()).cast_signed()
}

/// How large a random home is.
#[derive(Clone, Copy, Debug)]
pub struct Size {
    /// Rooms from west to east.
    pub columns: i32,
    /// Rooms from south to north.
    pub rows: i32,
    /// Cells of a room's side, its walls not counted.
    pub side: i32,
    /// Blocks.
    pub blocks: i32,
}

/// A home of `columns` times `rows` square rooms, each joined to its neighbours by a door at a random place, with blocks and the agent at
/// random cells inside the rooms.
pub fn random_home<M: HomeMemory>(random: &mut Pcg32, size: Size, moves: Moves, memory: M) -> (Home<M>, HomeState) {
    const COLOURS: [&str; 8] = ["red", "green", "blue", "yellow", "purple", "orange", "tan", "teal"];
    const SHAPES: [&str; 4] = ["chair", "bag", "backpack", "basket"];
    let Size { columns, rows, side, blocks } = size;
    let (step, mut doors) = (side + 1, 0);
    let mut builder = HomeBuilder::new(memory);
    for (room, (column, row)) in (0..rows).flat_map(|row| (0..columns).map(move |column| (column, row))).enumerate() {
        let (left, bottom) = (column * step, row * step);
        let area = Area::new(left, bottom, left + step, bottom + step);
        builder.room(&format!("room{room}"), area, COLOURS[room % COLOURS.len()]).expect("a room");
        let mut door = |builder: &mut HomeBuilder<M>, x, y| {
            builder.door(&format!("door{doors}"), Area::new(x, y, x, y)).expect("a door");
            doors += 1;
        };
        if column > 0 {
            door(&mut builder, left, bottom + 1 + below(random, side));
        }
        if row > 0 {
            door(&mut builder, left + 1 + below(random, side), bottom);
        }
    }
    let mut taken = Vec::new();
    let mut free = || loop {
        let mut coordinate = |rooms: i32| below(random, rooms) * step + 1 + below(random, side);
        let cell = (coordinate(columns), coordinate(rows));
        if !taken.contains(&cell) {
            taken.push(cell);
            return Cell::new(cell.0, cell.1);
        }
    };
    for block in 0..blocks {
        let (colour, shape) = (COLOURS[block as usize % COLOURS.len()], SHAPES[block as usize % SHAPES.len()]);
        builder.block(&format!("block{block}"), free(), colour, shape).expect("a block");
    }
    builder.agent("agent0", free()).expect("an agent");
    builder.build(moves).expect("a home")
}
