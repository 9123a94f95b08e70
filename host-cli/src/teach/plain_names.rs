//! Tasks, objects and ideas as a person calls them.

use super::site::Site;
use goodbot::home::{BLOCK_IN_ROOM, COLOR, Home, ROOM, SHAPE};
use goodbot::memory::HomeMemory;
use goodbot::oomdp::{Domain, GroundProposition, ObjectId, World};
use goodbot::task::{GroundedTask, LiftedTask};
use goodbot_lesson::name::{place_in_words, way_in_words};

/// A task as a person says it: `take the yellow bag to the blue room`, `go to the green room, but not through the yellow room`. In a world from a
/// file it is told by the names there: `lamp on: red kitchen lamp`.
pub fn task_words(site: &Site, lifted: &LiftedTask, task: &GroundedTask) -> String {
    match site {
        Site::Home(home) => task_in_home(home, lifted, task),
        Site::World(robot) => {
            let told = |part: GroundProposition| {
                let schema = robot.world().schema;
                let count = schema.parameters(part.proposition).len();
                let objects: Vec<String> = part.arguments.iter().take(count).map(|&object| looks(robot, object)).collect();
                let not = if task.is_negated() { "not " } else { "" };
                format!("{not}{}: {}", in_plain_words(schema.proposition_name(part.proposition)), objects.join(", "))
            };
            way_in_words(lifted, task, told, told)
        }
    }
}

/// An object as a person calls it.
pub fn object_words(site: &Site, id: ObjectId) -> String {
    match site {
        Site::Home(home) => object_in_home(home, id),
        Site::World(robot) => looks(robot, id),
    }
}

/// An object of any world by its values and its class, `red kitchen lamp`; where another is alike, by its name too, and by its name alone where
/// it has no values.
pub fn looks<D: Domain>(domain: &D, id: ObjectId) -> String {
    let World { schema, objects } = domain.world();
    let values = |id: ObjectId| (0..schema.attributes.len()).map(move |at| objects.value(id, at)).filter(|value| !value.is_empty());
    let class = |id: ObjectId| objects.get(id).map(|object| object.class);
    let Some(of) = class(id).filter(|_| values(id).next().is_some()) else { return objects.name(id).to_owned() };
    let alike = objects.of_class(of).filter(|&other| values(other).eq(values(id))).count();
    let told = values(id).chain([schema.class_name(of)]).collect::<Vec<_>>().join(" ");
    if alike > 1 { format!("{told} ({})", objects.name(id)) } else { told }
}

fn task_in_home(home: &Home<impl HomeMemory>, lifted: &LiftedTask, task: &GroundedTask) -> String {
    let goal = |part: GroundProposition| {
        let [subject, room, _] = part.arguments;
        let room = object_in_home(home, room);
        if part.proposition == BLOCK_IN_ROOM {
            format!("take the {} to the {room}", object_in_home(home, subject))
        } else {
            format!("go to the {room}")
        }
    };
    way_in_words(lifted, task, goal, |it| place_in_words(home, it, |object| format!("the {}", object_in_home(home, object))))
}

/// An object by its looks; where another looks alike, by its name too.
fn object_in_home(home: &Home<impl HomeMemory>, id: ObjectId) -> String {
    let objects = home.world().objects;
    let looks = |id: ObjectId| (objects.get(id).map(|object| object.class), objects.value(id, COLOR), objects.value(id, SHAPE));
    let (class, color, shape) = looks(id);
    let kind = if class == Some(ROOM) { "room" } else { shape };
    let alike = objects.iter().filter(|&(other, _)| looks(other) == looks(id)).count();
    if alike > 1 { format!("{color} {kind} ({})", objects.name(id)) } else { format!("{color} {kind}") }
}

/// A machine token in plain words: `roomIsGreen` is `room is green`, and a kind of task is what a person would ask for.
pub fn token_words(token: &str) -> String {
    match token {
        "agentInRoom" => "go to a room".to_owned(),
        "blockInRoom" => "take to a room".to_owned(),
        _ => in_plain_words(token),
    }
}

/// A name of a file in words: `lampOn` is `lamp on`.
pub fn in_plain_words(name: &str) -> String {
    let mut words = String::new();
    for letter in name.chars() {
        if letter.is_uppercase() && !words.is_empty() {
            words.push(' ');
        }
        words.extend(letter.to_lowercase());
    }
    words
}

/// What the robot did: `went north`.
pub fn action_words(action: &str) -> String {
    match action {
        "noop" => "stayed where it is".to_owned(),
        "north" | "south" | "east" | "west" => format!("went {action}"),
        other => format!("did \"{other}\""),
    }
}

/// A probability as a person reads it: never 0 % or 100 % where it is neither.
pub fn percent(probability: f32) -> String {
    match probability * 100.0 {
        none if none <= 0.0 => "0 %".to_owned(),
        little if little < 1.0 => "<1 %".to_owned(),
        all if all >= 100.0 => "100 %".to_owned(),
        nearly if nearly > 99.0 => ">99 %".to_owned(),
        other => format!("{other:.0} %"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_probability_is_certain_only_where_it_is() {
        let shown = [0.0, 0.004, 0.5, 0.994, 0.999, 1.0].map(percent);
        assert_eq!(shown, ["0 %", "<1 %", "50 %", ">99 %", ">99 %", "100 %"]);
    }

    #[test]
    fn tokens_are_read_as_words() {
        assert_eq!(token_words("roomIsGreen"), "room is green");
        assert_eq!(token_words("block"), "block");
        assert_eq!(token_words("blockInRoom"), "take to a room");
    }
}
