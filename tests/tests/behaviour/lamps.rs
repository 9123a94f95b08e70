//! A robot that walks through the rooms of a house, one beside the other, and switches the lamp of the room it is in.

use goodbot::oomdp::{
    Action, ActionKind, Attribute, Carrier, Class, ClassId, Domain, GroundProposition, ObjectError, ObjectSet, ObjectTables, Objects,
    OneByOne, Proposition, PropositionId, Schema, World,
};
use goodbot::task::{LiftedTask, TaskTextError};

const LAMP: ClassId = ClassId::new(0);

const SCHEMA: Schema<'static> = Schema {
    classes: &[Class::new("lamp")],
    attributes: &[Attribute::new("room", &[Carrier::new(LAMP, "lampOf")])],
    propositions: &[Proposition::new("lampIsOn", &[LAMP]), Proposition::new("lampIsOff", &[LAMP])],
};

const ACTIONS: [ActionKind<'static>; 3] = [ActionKind::new("west", 1), ActionKind::new("east", 1), ActionKind::new("switch", 1)];

const ROOMS: [&str; 4] = ["kitchen", "hall", "study", "attic"];

/// The room of the robot, and the lamps that are on, one bit each.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct House {
    pub room: u8,
    pub on: u8,
}

/// The robot.
pub struct Lamps<'m> {
    objects: Objects<'m>,
}

impl<'m> Lamps<'m> {
    pub fn new(memory: ObjectTables<'m>) -> Result<Self, ObjectError> {
        let mut objects = ObjectSet::new(memory);
        for (room, name) in ROOMS.iter().zip(["lamp0", "lamp1", "lamp2", "lamp3"]) {
            objects.add(LAMP, name, &[room])?;
        }
        Ok(Self { objects: objects.into_objects() })
    }

    pub fn tasks() -> Result<[LiftedTask; 2], TaskTextError> {
        Ok([LiftedTask::parse("lampIsOn(?l)", &SCHEMA)?, LiftedTask::parse("lampIsOff(?l)", &SCHEMA)?])
    }
}

impl Domain for Lamps<'_> {
    type State = House;
    type Search = OneByOne;

    fn world(&self) -> World<'_> {
        World { schema: SCHEMA, objects: self.objects }
    }

    fn actions(&self) -> &[ActionKind<'_>] {
        &ACTIONS
    }

    fn step(&self, house: &House, action: Action) -> Option<House> {
        match action.index() {
            0 => Some(House { room: house.room.saturating_sub(1), ..*house }),
            1 => Some(House { room: (house.room + 1).min(ROOMS.len() as u8 - 1), ..*house }),
            2 => Some(House { on: house.on ^ 1 << house.room, ..*house }),
            _ => None,
        }
    }

    fn holds(&self, proposition: &GroundProposition, house: &House) -> bool {
        let [lamp, ..] = proposition.arguments;
        (house.on >> lamp.index() & 1 == 1) == (proposition.proposition == PropositionId::new(0))
    }

    fn state_count(&self) -> u64 {
        (ROOMS.len() as u64) << ROOMS.len()
    }

    fn number(&self, house: &House) -> u64 {
        u64::from(house.room) << ROOMS.len() | u64::from(house.on)
    }

    fn numbered(&self, number: u64) -> House {
        House { room: (number >> ROOMS.len()) as u8, on: (number & ((1 << ROOMS.len()) - 1)) as u8 }
    }
}
