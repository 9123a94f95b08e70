//! Derived facts about a room or a block: they follow from the places of things.
//!
//! | fact | holds for |
//! |---|---|
//! | `leftmost`, `rightmost`, `topmost`, `bottommost` | the room with the centre farthest that way, or the block |
//! | `largest`, `smallest` | the room with the most or the fewest cells inside |
//! | `nearest`, `farthest` | the block, or the room without the robot, by steps as if there were no walls |
//! | `nextToRed`, for each colour | a room that a door joins to a red one |
//!
//! On a tie, the fact holds for neither. A single room or block has no facts of comparison.

use super::layout::{Area, Cell};
use super::moves::{Home, HomeState};
use super::{BLOCK, COLOR, DOOR, ROOM};
use crate::memory::HomeMemory;
use crate::oomdp::{ClassId, ObjectId};
use crate::task::attribute_token;

/// The measure by which objects of a class are compared: the object with the smallest value has the fact.
const FACTS: [(&str, Measure); 8] = [
    ("leftmost", Measure::Left),
    ("rightmost", Measure::Right),
    ("bottommost", Measure::Bottom),
    ("topmost", Measure::Top),
    ("smallest", Measure::Small),
    ("largest", Measure::Large),
    ("nearest", Measure::Near),
    ("farthest", Measure::Far),
];

#[derive(Clone, Copy, PartialEq, Eq)]
enum Measure {
    Left,
    Right,
    Bottom,
    Top,
    Small,
    Large,
    Near,
    Far,
}

impl Measure {
    /// The measure of an area, seen from the robot's cell; `None` if it is not compared.
    fn of(self, area: Area, robot: Cell) -> Option<i32> {
        let span = |from: i32, to: i32| to.wrapping_sub(from);
        let (middle_x, middle_y) = (area.left.wrapping_add(area.right), area.bottom.wrapping_add(area.top));
        let inside = span(area.left, area.right).wrapping_sub(1).wrapping_mul(span(area.bottom, area.top).wrapping_sub(1));
        let beyond = |low: i32, at: i32, high: i32| low.wrapping_sub(at).max(at.wrapping_sub(high)).max(0);
        let steps = beyond(area.left, robot.x, area.right).wrapping_add(beyond(area.bottom, robot.y, area.top));
        match self {
            Self::Left => Some(middle_x),
            Self::Right => Some(middle_x.wrapping_neg()),
            Self::Bottom => Some(middle_y),
            Self::Top => Some(middle_y.wrapping_neg()),
            Self::Small => Some(inside),
            Self::Large => Some(inside.wrapping_neg()),
            Self::Near | Self::Far if area.holds_strictly(robot) => None,
            Self::Near => Some(steps),
            Self::Far => Some(steps.wrapping_neg()),
        }
    }
}

impl<M: HomeMemory> Home<M> {
    /// Passes each fact of an object to `tell`.
    pub(super) fn for_each_derived(&self, state: &HomeState, object: ObjectId, tell: &mut dyn FnMut(&str)) {
        let Some(class) = self.objects().get(object).map(|object| object.class).filter(|&class| class == ROOM || class == BLOCK) else {
            return;
        };
        for (fact, measure) in FACTS {
            if class == ROOM || !matches!(measure, Measure::Small | Measure::Large) {
                let of = |object| measure.of(self.extent(state, object), self.agent_cell(state));
                let mut others = self.objects().of_class(class).filter(|&other| other != object).filter_map(of).peekable();
                if others.peek().is_some() && of(object).is_some_and(|least| others.all(|other| least < other)) {
                    tell(fact);
                }
            }
        }
        if class == ROOM {
            self.for_each_neighbour(object, |neighbour| {
                if let Ok(fact) = attribute_token("nextTo", self.objects().value(neighbour, COLOR)) {
                    tell(&fact);
                }
            });
        }
    }

    /// The extent of an object: a room's or door's box, or the cell of a block.
    fn extent(&self, state: &HomeState, object: ObjectId) -> Area {
        match self.block_cell(state, object) {
            Some(cell) => Area::new(cell.x, cell.y, cell.x, cell.y),
            None => self.area(object),
        }
    }

    /// The rooms that a door joins to this one.
    fn for_each_neighbour(&self, room: ObjectId, mut give: impl FnMut(ObjectId)) {
        let objects = |class: ClassId| self.objects().of_class(class);
        let here = self.area(room);
        for other in objects(ROOM).filter(|&other| other != room) {
            let joins = |door: ObjectId| self.area(door).meets(here) && self.area(door).meets(self.area(other));
            if objects(DOOR).any(joins) {
                give(other);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::home::{HomeBuilder, Moves};
    use crate::oomdp::Domain;
    use std::string::{String, ToString};
    use std::vec::Vec;

    /// A wide red room below, a green and a blue one above it, and two chairs.
    fn facts(with_derived: bool, name: &str) -> Vec<String> {
        let mut memory = crate::HeapMemory::new(&crate::Capacities::STANDARD);
        let mut builder = HomeBuilder::new(&mut memory.home);
        builder.room("below", Area::new(0, 0, 8, 4), "red").unwrap();
        builder.room("left", Area::new(0, 4, 4, 8), "green").unwrap();
        builder.room("right", Area::new(4, 4, 8, 8), "blue").unwrap();
        builder.door("door", Area::new(2, 4, 2, 4)).unwrap();
        builder.agent("robot", Cell::new(6, 2)).unwrap();
        builder.block("chair0", Cell::new(1, 2), "blue", "chair").unwrap();
        builder.block("chair1", Cell::new(5, 2), "blue", "chair").unwrap();
        let (home, state) = builder.build(Moves::Push).unwrap();
        let home = home.with_derived(with_derived);
        let mut all = Vec::new();
        home.tell_derived(&state, home.objects().find(name).unwrap(), &mut |fact| all.push(fact.to_string()));
        all
    }

    #[test]
    fn a_home_tells_of_each_room_and_block_what_sets_it_apart() {
        assert_eq!(facts(true, "below"), ["bottommost", "largest", "nextToGreen"]);
        assert_eq!(facts(true, "left"), ["leftmost", "farthest", "nextToRed"]);
        assert_eq!(facts(true, "right"), ["rightmost", "nearest"]);
        assert_eq!(facts(true, "chair0"), ["leftmost", "farthest"]);
        assert_eq!(facts(true, "chair1"), ["rightmost", "nearest"]);
        assert!(facts(true, "robot").is_empty() && facts(true, "door").is_empty());
    }

    #[test]
    fn a_home_that_was_not_asked_tells_no_facts() {
        assert!(facts(false, "below").is_empty());
    }
}
