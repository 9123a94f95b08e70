//! The paper's course for the page: the homes as environments, and the meaning of each command.

use crate::world::ROOMS;
use goodbot::memory::HomeHeap;
use goodbot_course::layout::Layout;
use goodbot_course::{Exercise, HomeName, Homes, Intention, LESSONS, TESTS, generator};
use goodbot_formats::environment::{EnvironmentFile, ObjectRecord};
use serde::Serialize;
use tsify::Tsify;

/// The homes that a page offers, and the course in them.
#[derive(Clone, Debug, PartialEq, Serialize, Tsify)]
pub struct Course {
    /// The seven lessons.
    pub lessons: Vec<Posed>,
    /// The five tests.
    pub tests: Vec<Posed>,
    /// All that can be taught in these homes, the simplest home first.
    pub teachable: Vec<Posed>,
    /// The homes alone, by name: `A` to `F`, and `Test`.
    #[tsify(type = "[string, { version: number, objects: any[] }][]")]
    pub homes: Vec<(String, EnvironmentFile)>,
}

/// A command of the course.
#[derive(Clone, Debug, PartialEq, Serialize, Tsify)]
pub struct Posed {
    /// What the trainer says.
    pub command: String,
    /// The home's name.
    pub home: String,
    /// What the trainer means, as logs write it.
    pub intended: String,
}

/// The course in the homes as drawn.
pub fn fixed() -> Course {
    course(&Homes::FIXED)
}

/// The course in homes at random.
pub fn random(seed: u64) -> Course {
    course(&Homes::random(&mut generator(seed), &mut HomeHeap::new(&ROOMS)))
}

fn course(homes: &Homes) -> Course {
    let meant = |home: HomeName, intention: &Intention| Posed {
        command: intention.to_string(),
        home: format!("{home:?}"),
        intended: intended(intention, homes.layout(home)),
    };
    let posed = |exercise: &Exercise| meant(exercise.home, &exercise.intention);
    let teachable = homes.teachable().map(|(home, intention)| meant(home, &intention)).collect();
    let mut named: Vec<(String, EnvironmentFile)> = Vec::new();
    for exercise in LESSONS.iter().chain(&TESTS) {
        let name = format!("{:?}", exercise.home);
        if !named.iter().any(|(other, _)| *other == name) {
            named.push((name, environment(homes.layout(exercise.home))));
        }
    }
    Course { lessons: LESSONS.iter().map(posed).collect(), tests: TESTS.iter().map(posed).collect(), teachable, homes: named }
}

/// The task meant, as logs write it.
fn intended(intention: &Intention, layout: &Layout) -> String {
    let room = layout.rooms.iter().flatten().position(|(_, color)| *color == intention.room).unwrap_or(0);
    match intention.block {
        None => format!("agentInRoom(agent0,room{room})"),
        Some(looks) => {
            let block = layout.blocks.iter().flatten().position(|block| (block.color, block.shape) == looks).unwrap_or(0);
            format!("blockInRoom(block{block},room{room})")
        }
    }
}

/// A layout as an environment.
pub fn environment(layout: &Layout) -> EnvironmentFile {
    let mut objects = Vec::new();
    for (at, (area, color)) in layout.rooms.iter().flatten().enumerate() {
        let (name, color) = (format!("room{at}"), (*color).to_owned());
        objects.push(ObjectRecord::Room { name, left: area.left, bottom: area.bottom, right: area.right, top: area.top, color });
    }
    for (at, cell) in layout.doors.iter().flatten().enumerate() {
        objects.push(ObjectRecord::Door { name: format!("door{at}"), left: cell.x, bottom: cell.y, right: cell.x, top: cell.y });
    }
    for (at, block) in layout.blocks.iter().flatten().enumerate() {
        let (color, shape) = (block.color.to_owned(), block.shape.to_owned());
        objects.push(ObjectRecord::Block { name: format!("block{at}"), x: block.cell.x, y: block.cell.y, color, shape });
    }
    objects.push(ObjectRecord::Agent { name: "agent0".to_owned(), x: layout.agent.x, y: layout.agent.y });
    EnvironmentFile::new(objects)
}
