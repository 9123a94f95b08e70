//! A robot made of tables alone: the state that each action leads to from each state, and the states in which each proposition holds.
//! Robots that callers of the C library define are of this kind.

use goodbot::oomdp::{
    Action, ActionKind, Attribute, Carrier, Class, ClassId, Domain, GroundProposition, ObjectError, ObjectId, ObjectSet, ObjectTables,
    Objects, OneByOne, Proposition, PropositionId, Schema, World,
};
use goodbot::task::{LiftedTask, TaskTextError};

/// The tables of a lift. States are positions in `next`.
pub struct TableRobot<'m> {
    objects: Objects<'m>,
    /// For each state and action, the state it leads to, or `CANNOT`.
    next: &'static [[u8; 2]],
    /// The propositions that hold, each with its state.
    holds: &'static [(u8, PropositionId, ObjectId)],
}

const CANNOT: u8 = u8::MAX;
const FLOOR: ClassId = ClassId::new(1);

const SCHEMA: Schema<'static> = Schema {
    classes: &[Class::new("lift"), Class::new("floor")],
    attributes: &[Attribute::new("use", &[Carrier::new(FLOOR, "floorIs")])],
    propositions: &[Proposition::new("liftAtFloor", &[ClassId::new(0), FLOOR])],
};

const ACTIONS: [ActionKind<'static>; 2] = [ActionKind::new("up", 1), ActionKind::new("down", 1)];

/// Up and down from each of four floors.
const NEXT: [[u8; 2]; 4] = [[1, CANNOT], [2, 0], [3, 1], [CANNOT, 2]];

const AT: PropositionId = PropositionId::new(0);
const HOLDS: [(u8, PropositionId, ObjectId); 4] =
    [(0, AT, ObjectId::new(1)), (1, AT, ObjectId::new(2)), (2, AT, ObjectId::new(3)), (3, AT, ObjectId::new(4))];

impl<'m> TableRobot<'m> {
    /// A lift in a house of four floors.
    pub fn lift(memory: ObjectTables<'m>) -> Result<Self, ObjectError> {
        let mut objects = ObjectSet::new(memory);
        objects.add(ClassId::new(0), "lift", &[])?;
        for (name, what) in [("floor0", "garage"), ("floor1", "shop"), ("floor2", "office"), ("floor3", "roof")] {
            objects.add(FLOOR, name, &[what])?;
        }
        Ok(Self { objects: objects.into_objects(), next: &NEXT, holds: &HOLDS })
    }

    pub fn tasks() -> Result<[LiftedTask; 1], TaskTextError> {
        Ok([LiftedTask::parse("liftAtFloor(?l, ?f)", &SCHEMA)?])
    }
}

impl Domain for TableRobot<'_> {
    type State = u8;
    type Search = OneByOne;

    fn world(&self) -> World<'_> {
        World { schema: SCHEMA, objects: self.objects }
    }

    fn actions(&self) -> &[ActionKind<'_>] {
        &ACTIONS
    }

    fn step(&self, state: &u8, action: Action) -> Option<u8> {
        let next = *self.next.get(usize::from(*state))?.get(action.index())?;
        (next != CANNOT).then_some(next)
    }

    fn holds(&self, proposition: &GroundProposition, state: &u8) -> bool {
        let [_, floor, _] = proposition.arguments;
        self.holds.contains(&(*state, proposition.proposition, floor))
    }

    fn state_count(&self) -> u64 {
        self.next.len() as u64
    }

    fn number(&self, state: &u8) -> u64 {
        u64::from(*state)
    }

    fn numbered(&self, number: u64) -> u8 {
        number as u8
    }
}
