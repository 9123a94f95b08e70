//! Homes built from environments, and the flaws of an environment.

use crate::fault::{Fault, quoted};
use goodbot::Capacities;
use goodbot::capacity::{Capacity, CapacityError};
use goodbot::home::{Area, BLOCK, COLOR, Cell, DOOR, Home, HomeBuilder, HomeState, Moves, Problem as HomeProblem, ROOM, SHAPE};
use goodbot::memory::{HomeHeap, HomeMemory};
use goodbot::oomdp::{Domain, ObjectId};
use goodbot_formats::environment::{EnvironmentFile, ObjectRecord};
use goodbot_formats::map;

/// A flaw of a home.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct HomeFlaw {
    /// The position of the object in the environment, if the flaw is in one of them.
    pub object: Option<usize>,
    /// The flaw.
    pub problem: HomeProblem,
}

impl HomeFlaw {
    /// The flaw and its remedy, with the object's name.
    pub fn message(&self, environment: &EnvironmentFile) -> String {
        match self.object.and_then(|object| environment.objects.get(object)) {
            Some(object) => format!("object {}: {}", quoted(object.name()), self.in_words()),
            None => match self.problem {
                HomeProblem::Capacity(CapacityError { capacity: Capacity::Objects, limit, given }) => {
                    format!("are {given}, and {limit} are the most; leave out some")
                }
                _ => self.in_words(),
            },
        }
    }

    fn in_words(&self) -> String {
        match self.problem {
            HomeProblem::Capacity(error) => full(&error).unwrap_or_else(|| error.to_string()),
            problem => problem.to_string(),
        }
    }

    /// The field at fault, within the environment.
    pub fn field(&self) -> String {
        self.object.map_or_else(|| "objects".to_owned(), |object| format!("objects[{object}]"))
    }
}

/// The limit that a home exceeds, and the remedy, without the library's names; `None` for a limit that no home has.
pub fn full(error: &CapacityError) -> Option<String> {
    let &CapacityError { capacity, limit, given } = error;
    let (what, remedy) = match capacity {
        Capacity::Objects => ("objects in a home", "leave out some"),
        Capacity::Names | Capacity::NameBytesTogether => ("names, colours and shapes in a home", "use fewer or shorter ones"),
        Capacity::Cells => ("free cells in a home", "make rooms smaller"),
        Capacity::Blocks => ("blocks in a home", "leave out some"),
        Capacity::NameBytes => ("bytes in a word or name", "shorten it"),
        _ => return None,
    };
    Some(format!("too many {what}: {given} or more, and {limit} are the most; {remedy}"))
}

/// Reads a home from a text: JSON, or a drawing.
///
/// # Errors
/// The fault, and its place.
pub fn parse(name: &str, text: &str) -> Result<EnvironmentFile, Fault> {
    if map::is_map(text) {
        return map::parse(text).map_err(|wrong| Fault::on_line(name, wrong.line, wrong.message));
    }
    EnvironmentFile::parse(text).map_err(|error| Fault::from_format(name, error))
}

/// Memory for one home of the largest size.
pub fn memory() -> HomeHeap {
    HomeHeap::new(&Capacities::STANDARD)
}

/// Builds the home of an environment, with its initial state.
pub fn build<M: HomeMemory>(environment: &EnvironmentFile, moves: Moves, memory: M) -> Result<(Home<M>, HomeState), HomeFlaw> {
    let mut builder = HomeBuilder::new(memory);
    for (position, object) in environment.objects.iter().enumerate() {
        add(&mut builder, object).map_err(|problem| HomeFlaw { object: Some(position), problem })?;
    }
    let (home, start) = builder.build(moves).map_err(|error| HomeFlaw { object: error.object.map(usize::from), problem: error.problem })?;
    Ok((home.with_derived(environment.derived), start))
}

/// All flaws of a home.
pub fn flaws(environment: &EnvironmentFile) -> Vec<HomeFlaw> {
    let most = Capacities::STANDARD.objects;
    if environment.objects.len() > most {
        return vec![HomeFlaw {
            object: None,
            problem: HomeProblem::Capacity(CapacityError::new(Capacity::Objects, most, environment.objects.len())),
        }];
    }
    let mut flaws = Vec::new();
    let has = |wanted: fn(&ObjectRecord) -> bool| environment.objects.iter().any(wanted);
    if !has(|object| matches!(object, ObjectRecord::Agent { .. })) {
        flaws.push(HomeFlaw { object: None, problem: HomeProblem::NoAgent });
    }
    if !has(|object| matches!(object, ObjectRecord::Room { .. })) {
        flaws.push(HomeFlaw { object: None, problem: HomeProblem::NoRoom });
    }
    flaws.extend(flawed_alone(environment));
    if flaws.is_empty() {
        flaws.extend(misplaced(environment));
    }
    flaws
}

/// The objects that cannot be added, whatever other objects there are.
fn flawed_alone(environment: &EnvironmentFile) -> Vec<HomeFlaw> {
    let mut memory = memory();
    let mut builder = HomeBuilder::new(&mut memory);
    let mut flaws = Vec::new();
    for (position, object) in environment.objects.iter().enumerate() {
        if let Err(problem) = add(&mut builder, object) {
            flaws.push(HomeFlaw { object: Some(position), problem });
            // After one that does not fit, no other fits.
            if matches!(problem, HomeProblem::Capacity(_)) {
                break;
            }
        }
    }
    flaws
}

/// The objects at impossible positions. Each pass leaves out those found before.
fn misplaced(environment: &EnvironmentFile) -> Vec<HomeFlaw> {
    let (mut flaws, mut left): (Vec<HomeFlaw>, Vec<usize>) = (Vec::new(), (0..environment.objects.len()).collect());
    loop {
        let rest = EnvironmentFile::new(left.iter().filter_map(|&position| environment.objects.get(position).cloned()).collect());
        let mut memory = memory();
        let Err(flaw) = build(&rest, Moves::Push, &mut memory).map(drop) else { return flaws };
        // Without an agent no home can be built, so the search ends.
        if flaw.problem == HomeProblem::NoAgent {
            return flaws;
        }
        let object = flaw.object.and_then(|object| left.get(object).copied());
        flaws.push(HomeFlaw { object, ..flaw });
        let Some(object) = object else { return flaws };
        left.retain(|&position| position != object);
    }
}

/// The environment of a home in a state, as a file has it.
pub fn environment(home: &Home<impl HomeMemory>, state: &HomeState) -> EnvironmentFile {
    let objects = home.world().objects;
    let record = |id: ObjectId| {
        let (name, color, area) = (objects.name(id).to_owned(), objects.value(id, COLOR).to_owned(), home.area(id));
        match objects.get(id).map(|object| object.class) {
            Some(ROOM) => ObjectRecord::Room { name, left: area.left, bottom: area.bottom, right: area.right, top: area.top, color },
            Some(DOOR) => ObjectRecord::Door { name, left: area.left, bottom: area.bottom, right: area.right, top: area.top },
            Some(BLOCK) => {
                let cell = home.block_cell(state, id).unwrap_or_else(|| home.agent_cell(state));
                ObjectRecord::Block { name, x: cell.x, y: cell.y, color, shape: objects.value(id, SHAPE).to_owned() }
            }
            _ => {
                let cell = home.agent_cell(state);
                ObjectRecord::Agent { name, x: cell.x, y: cell.y }
            }
        }
    };
    let objects = objects.iter().map(|(id, _)| record(id)).collect();
    EnvironmentFile { derived: home.tells_derived(), ..EnvironmentFile::new(objects) }
}

fn add(builder: &mut HomeBuilder<impl HomeMemory>, object: &ObjectRecord) -> Result<(), HomeProblem> {
    let added = match object {
        ObjectRecord::Room { name, left, bottom, right, top, color } => builder.room(name, Area::new(*left, *bottom, *right, *top), color),
        ObjectRecord::Door { name, left, bottom, right, top } => builder.door(name, Area::new(*left, *bottom, *right, *top)),
        ObjectRecord::Agent { name, x, y } => builder.agent(name, Cell::new(*x, *y)),
        ObjectRecord::Block { name, x, y, color, shape } => builder.block(name, Cell::new(*x, *y), color, shape),
    };
    added.map(drop).map_err(|error| error.problem)
}
