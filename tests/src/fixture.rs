//! Homes and tasks of the reference numbers.

use goodbot::home::{Area, Cell, Home, HomeBuilder, HomeState, Moves};
use goodbot::memory::HomeMemory;
use goodbot::oomdp::Domain;
use goodbot::task::{GroundedTask, LiftedTask};
use serde_json::Value;

/// A whole number of the reference.
fn number(value: &Value) -> i32 {
    i32::try_from(value.as_i64().expect("a whole number")).expect("a small number")
}

/// A reference file of the folder `fixtures`.
pub fn read(file: &str) -> Value {
    let path = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("fixtures").join(file);
    serde_json::from_str(&std::fs::read_to_string(path).expect("the file can be read")).expect("the file is JSON")
}

/// A home from a reference world.
pub fn home<M: HomeMemory>(world: &Value, memory: M, moves: Moves) -> (Home<M>, HomeState) {
    let mut builder = HomeBuilder::new(memory);
    let text = |value: &Value| value.as_str().expect("a name").to_owned();
    let area =
        |row: &Value, from: usize| Area::new(number(&row[from]), number(&row[from + 1]), number(&row[from + 2]), number(&row[from + 3]));
    for row in world["rooms"].as_array().expect("rooms") {
        builder.room(&text(&row[0]), area(row, 2), &text(&row[1])).expect("a room");
    }
    for row in world["doors"].as_array().expect("doors") {
        builder.door(&text(&row[0]), area(row, 1)).expect("a door");
    }
    for row in world["blocks"].as_array().expect("blocks") {
        let cell = Cell::new(number(&row[3]), number(&row[4]));
        builder.block(&text(&row[0]), cell, &text(&row[1]), &text(&row[2])).expect("a block");
    }
    builder.agent("agent0", Cell::new(number(&world["agent"][0]), number(&world["agent"][1]))).expect("an agent");
    builder.build(moves).expect("a home")
}

/// The name of a task in the reference: `blockInRoom(block0, room1)`.
pub fn task_text<D: Domain>(domain: &D, lifted: &[LiftedTask], task: &GroundedTask) -> String {
    let parts: Vec<String> = task
        .propositions(&lifted[usize::from(task.lifted)])
        .map(|part| {
            let parameters = domain.world().schema.parameters(part.proposition).len();
            let names: Vec<&str> = part.arguments[..parameters].iter().map(|&object| domain.world().objects.name(object)).collect();
            format!("{}({})", domain.world().schema.proposition_name(part.proposition), names.join(", "))
        })
        .collect();
    parts.join(" & ")
}
