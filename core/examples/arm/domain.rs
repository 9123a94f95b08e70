//! An arm above a shelf: it moves from slot to slot, grabs a thing, carries it and releases it. Grabbing and releasing cost twice a move.

use goodbot::oomdp::{
    Action, ActionKind, Attribute, Carrier, Class, ClassId, Domain, GroundProposition, ObjectError, ObjectSet, ObjectTables, Objects,
    OneByOne, Proposition, Schema, World,
};
use goodbot::task::{LiftedTask, TaskTextError};

const ARM: ClassId = ClassId::new(0);
const SLOT: ClassId = ClassId::new(1);
const THING: ClassId = ClassId::new(2);

const SCHEMA: Schema<'static> = Schema {
    classes: &[Class::new("arm"), Class::new("slot"), Class::new("thing")],
    attributes: &[Attribute::new("color", &[Carrier::new(SLOT, "slotIs")]), Attribute::new("shape", &[Carrier::new(THING, "shape")])],
    propositions: &[Proposition::new("armAtSlot", &[ARM, SLOT]), Proposition::new("thingInSlot", &[THING, SLOT])],
};

const ACTIONS: [ActionKind<'static>; 4] =
    [ActionKind::new("left", 1), ActionKind::new("right", 1), ActionKind::new("grab", 2), ActionKind::new("release", 2)];

const SLOTS: u8 = 4;
/// A thing in the hand is in this slot.
const HAND: u8 = SLOTS;
/// Objects: the arm, the slots, the things.
const FIRST_SLOT: usize = 1;
const FIRST_THING: usize = FIRST_SLOT + SLOTS as usize;

/// The slot of the arm and of each thing.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Shelf {
    pub arm: u8,
    pub things: [u8; 2],
}

/// The arm.
pub struct Arm<'m> {
    objects: Objects<'m>,
}

impl<'m> Arm<'m> {
    pub fn new(memory: ObjectTables<'m>) -> Result<Self, ObjectError> {
        let mut objects = ObjectSet::new(memory);
        objects.add(ARM, "arm", &[])?;
        for (name, color) in [("slot0", "red"), ("slot1", "green"), ("slot2", "blue"), ("slot3", "yellow")] {
            objects.add(SLOT, name, &[color])?;
        }
        for (name, shape) in [("thing0", "cup"), ("thing1", "ball")] {
            objects.add(THING, name, &["", shape])?;
        }
        Ok(Self { objects: objects.into_objects() })
    }

    pub fn tasks() -> Result<[LiftedTask; 2], TaskTextError> {
        Ok([LiftedTask::parse("armAtSlot(?a, ?s)", &SCHEMA)?, LiftedTask::parse("thingInSlot(?t, ?s)", &SCHEMA)?])
    }
}

impl Domain for Arm<'_> {
    type State = Shelf;
    type Search = OneByOne;

    fn world(&self) -> World<'_> {
        World { schema: SCHEMA, objects: self.objects }
    }

    fn actions(&self) -> &[ActionKind<'_>] {
        &ACTIONS
    }

    fn step(&self, shelf: &Shelf, action: Action) -> Option<Shelf> {
        let mut next = *shelf;
        let thing_in = |slot: u8| shelf.things.iter().position(|&thing| thing == slot);
        match action.index() {
            0 => next.arm = shelf.arm.checked_sub(1)?,
            1 => next.arm = Some(shelf.arm + 1).filter(|&slot| slot < SLOTS)?,
            2 if thing_in(HAND).is_none() => *next.things.get_mut(thing_in(shelf.arm)?)? = HAND,
            3 if thing_in(shelf.arm).is_none() => *next.things.get_mut(thing_in(HAND)?)? = shelf.arm,
            _ => return None,
        }
        Some(next)
    }

    fn holds(&self, proposition: &GroundProposition, shelf: &Shelf) -> bool {
        let [subject, slot, _] = proposition.arguments;
        let place = match proposition.proposition.index() {
            0 => Some(shelf.arm),
            _ => shelf.things.get(subject.index() - FIRST_THING).copied(),
        };
        place.map(usize::from) == Some(slot.index() - FIRST_SLOT)
    }

    fn state_count(&self) -> u64 {
        u64::from(SLOTS) * u64::from(SLOTS + 1).pow(2)
    }

    fn number(&self, shelf: &Shelf) -> u64 {
        let [first, second] = shelf.things.map(u64::from);
        u64::from(shelf.arm) + u64::from(SLOTS) * (first + u64::from(SLOTS + 1) * second)
    }

    fn numbered(&self, number: u64) -> Shelf {
        // A controller divides numbers of 32 bits in fewer instructions.
        let (number, slots) = (number as u32, u32::from(SLOTS));
        let (arm, things) = (number % slots, number / slots);
        Shelf { arm: arm as u8, things: [(things % (slots + 1)) as u8, (things / (slots + 1)) as u8] }
    }
}
