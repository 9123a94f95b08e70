//! Tasks, objects and ideas as a person calls them.

use goodbot::home::{BLOCK_IN_ROOM, COLOR, Home, ROOM, SHAPE};
use goodbot::memory::HomeMemory;
use goodbot::oomdp::{Domain, GroundProposition, ObjectId};
use goodbot::task::{GroundedTask, LiftedTask};
use goodbot_lesson::name::{place_in_words, way_in_words};

/// A task as a person says it: `take the yellow bag to the blue room`, `go to the green room, but not through the yellow room`.
pub fn task_words(home: &Home<impl HomeMemory>, lifted: &LiftedTask, task: &GroundedTask) -> String {
    let goal = |part: GroundProposition| {
        let [subject, room, _] = part.arguments;
        let room = object_words(home, room);
        if part.proposition == BLOCK_IN_ROOM {
            format!("take the {} to the {room}", object_words(home, subject))
        } else {
            format!("go to the {room}")
        }
    };
    way_in_words(lifted, task, goal, |it| place_in_words(home, it, |object| format!("the {}", object_words(home, object))))
}

/// An object by its looks; where another looks alike, by its name too.
pub fn object_words(home: &Home<impl HomeMemory>, id: ObjectId) -> String {
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
        "agentInRoom" => return "go to a room".to_owned(),
        "blockInRoom" => return "take to a room".to_owned(),
        _ => {}
    }
    let mut words = String::new();
    for letter in token.chars() {
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
