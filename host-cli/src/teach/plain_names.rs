//! Tasks, objects and machine tokens in everyday words.

use super::site::Site;
use goodbot::oomdp::ObjectId;
use goodbot::task::{GroundedTask, LiftedTask};
pub use goodbot_lesson::name::{in_plain_words, looks};
use goodbot_lesson::name::{in_words, in_words_of_file, object_in_words};

/// A task in everyday words: `take the yellow bag to the blue room`; in a world from a file, `lamp on: red kitchen lamp`.
pub fn task_words(site: &Site, lifted: &LiftedTask, task: &GroundedTask) -> String {
    match site {
        Site::Floor(home) => in_words(home, lifted, task),
        Site::Other(robot) => in_words_of_file(robot, lifted, task),
    }
}

/// An object in everyday words.
pub fn object_words(site: &Site, id: ObjectId) -> String {
    match site {
        Site::Floor(home) => object_in_words(home, id),
        Site::Other(robot) => looks(robot, id),
    }
}

/// A machine token in plain words: `roomIsGreen` is `room is green`. A kind of task is worded as a request.
pub fn token_words(token: &str) -> String {
    match token {
        "agentInRoom" => "go to a room".to_owned(),
        "blockInRoom" => "take to a room".to_owned(),
        _ => in_plain_words(token),
    }
}

/// An action in the past tense: `went north`.
pub fn action_words(action: &str) -> String {
    match action {
        "noop" => "stayed where it is".to_owned(),
        "north" | "south" | "east" | "west" => format!("went {action}"),
        other => format!("did \"{other}\""),
    }
}

/// A probability in percent. It is 0 % or 100 % only if it is exactly that.
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
    use goodbot::home::{Moves, paper_tasks};
    use goodbot::task::ground;
    use goodbot_lesson::home as homes;

    #[test]
    fn a_probability_is_certain_only_where_it_is() {
        let shown = [0.0, 0.004, 0.5, 0.994, 0.999, 1.0].map(percent);
        assert_eq!(shown, ["0 %", "<1 %", "50 %", ">99 %", ">99 %", "100 %"]);
    }

    #[test]
    fn what_shall_not_be_is_told_as_that() {
        let rooms = homes::parse("home", "#########\n#rrr#ggg#\n#r@r+ggg#\n#rrr#ggg#\n#########\n").unwrap();
        let (home, start) = homes::build(&rooms, Moves::Push, homes::memory()).unwrap();
        let (kinds, mut tasks) = (paper_tasks().unwrap(), [GroundedTask::UNUSED; 4]);
        ground(&home, &kinds, &start, &mut tasks).unwrap();
        let (site, go) = (Site::Floor(home), tasks[0]);
        let told = [go, go.negated(&kinds[0]).unwrap()].map(|task| task_words(&site, &kinds[0], &task));
        assert_eq!(told, ["go to the green room", "stay out of the green room"]);
    }

    #[test]
    fn tokens_are_read_as_words() {
        assert_eq!(token_words("roomIsGreen"), "room is green");
        assert_eq!(token_words("block"), "block");
        assert_eq!(token_words("blockInRoom"), "take to a room");
    }
}
