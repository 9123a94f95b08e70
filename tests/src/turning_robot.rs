//! A robot that turns and drives, with actions of different costs, on a floor with one crate that it can push but not pull.

use goodbot::oomdp::{
    Action, ActionKind, Class, ClassId, Domain, GroundProposition, ObjectSet, ObjectTables, Objects, OneByOne, Proposition, PropositionId,
    Schema, World,
};

const SCHEMA: Schema<'static> = Schema {
    classes: &[Class::new("robot"), Class::new("zone"), Class::new("crate")],
    attributes: &[],
    propositions: &[
        Proposition::new("robotInZone", &[ClassId::new(0), ClassId::new(1)]),
        Proposition::new("crateInZone", &[ClassId::new(2), ClassId::new(1)]),
    ],
};

const ACTIONS: [ActionKind<'static>; 4] =
    [ActionKind::new("left", 1), ActionKind::new("right", 2), ActionKind::new("drive", 3), ActionKind::new("jump", 5)];

/// Where the robot and the crate are; the heading counts from north by quarter turns to the west.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Pose {
    cell: i32,
    heading: i32,
    crate_cell: i32,
}

/// A square floor; some of its cells are blocked, and each zone is one cell.
pub struct TurningRobot<'m> {
    objects: Objects<'m>,
    side: i32,
    blocked: Vec<i32>,
    zones: Vec<i32>,
    /// State numbers are this many apart, so that a search must hash them.
    pub gap: u64,
}

impl<'m> TurningRobot<'m> {
    /// A floor of `side` times `side` cells, which count row by row.
    pub fn new(side: i32, blocked: Vec<i32>, zones: Vec<i32>, memory: ObjectTables<'m>) -> Self {
        let mut objects = ObjectSet::new(memory);
        objects.add(ClassId::new(0), "robot0", &[]).expect("a robot");
        objects.add(ClassId::new(2), "crate0", &[]).expect("a crate");
        for zone in 0..zones.len() {
            objects.add(ClassId::new(1), &format!("zone{zone}"), &[]).expect("a zone");
        }
        Self { objects: objects.into_objects(), side, blocked, zones, gap: 1 }
    }

    /// The robot heads north.
    pub fn start(&self, cell: i32, crate_cell: i32) -> Pose {
        Pose { cell, heading: 0, crate_cell }
    }

    fn ahead(&self, cell: i32, heading: i32) -> Option<i32> {
        let (x, y) = (cell % self.side, cell / self.side);
        let (x, y) = [(x, y + 1), (x - 1, y), (x, y - 1), (x + 1, y)][heading as usize];
        let inside = (0..self.side).contains(&x) && (0..self.side).contains(&y);
        Some(y * self.side + x).filter(|cell| inside && !self.blocked.contains(cell))
    }

    fn moved(&self, pose: &Pose, action: Action) -> Option<Pose> {
        let ahead = |cell| self.ahead(cell, pose.heading);
        match action.index() {
            0 => Some(Pose { heading: (pose.heading + 1) % 4, ..*pose }),
            1 => Some(Pose { heading: (pose.heading + 3) % 4, ..*pose }),
            2 => {
                let cell = ahead(pose.cell)?;
                let crate_cell = if cell == pose.crate_cell { ahead(cell)? } else { pose.crate_cell };
                Some(Pose { cell, crate_cell, ..*pose })
            }
            _ => ahead(ahead(pose.cell)?).filter(|&cell| cell != pose.crate_cell).map(|cell| Pose { cell, ..*pose }),
        }
    }
}

impl Domain for TurningRobot<'_> {
    type State = Pose;
    type Search = OneByOne;

    fn world(&self) -> World<'_> {
        World { schema: SCHEMA, objects: self.objects }
    }

    fn actions(&self) -> &[ActionKind<'_>] {
        &ACTIONS
    }

    // Driving against a wall can be done and changes nothing; jumping onto a wall cannot be done.
    fn step(&self, pose: &Pose, action: Action) -> Option<Pose> {
        self.moved(pose, action).or((action.index() == 2).then_some(*pose))
    }

    fn holds(&self, proposition: &GroundProposition, pose: &Pose) -> bool {
        let zone = self.zones[proposition.arguments[1].index() - 2];
        zone == if proposition.proposition == PropositionId::new(0) { pose.cell } else { pose.crate_cell }
    }

    fn state_count(&self) -> u64 {
        let cells = u64::from(self.side.cast_unsigned()).pow(2);
        cells * cells * 4 * self.gap
    }

    fn number(&self, pose: &Pose) -> u64 {
        let cells = self.side * self.side;
        u64::from(((pose.crate_cell * cells + pose.cell) * 4 + pose.heading).cast_unsigned()) * self.gap
    }

    fn numbered(&self, number: u64) -> Pose {
        assert_eq!(number % self.gap, 0, "asked for the state of a number that no state has");
        let (number, cells) = ((number / self.gap) as i32, self.side * self.side);
        Pose { heading: number % 4, cell: number / 4 % cells, crate_cell: number / 4 / cells }
    }
}
