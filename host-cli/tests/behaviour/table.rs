//! `goodbot table`: the robot of a world as source code, compiled here, and taught.

#[rustfmt::skip]
#[path = "table/lift.rs"]
mod lift;

use crate::program::goodbot;
use goodbot::feedback::Feedback;
use goodbot::memory::HomeMemory;
use goodbot::oomdp::{Action, Domain, GroundProposition, ObjectId, PropositionId};
use goodbot::planning::Judgement;
use goodbot::{Agent, Options};
use goodbot_formats::world::WorldFile;
use goodbot_lesson::world::robot;

const LIFT: &str = include_str!("../../../docs/examples/worlds/lift.json");
/// The output of `goodbot table lift.json --rust --sessions 6`, and of the same with `--c`.
const RUST: &str = include_str!("table/lift.rs");
const C: &str = include_str!("../../../capi/examples/lift_world.h");

fn lift_file() -> tempfile::NamedTempFile {
    let file = tempfile::Builder::new().suffix(".json").tempfile().expect("a file");
    std::fs::write(file.path(), LIFT).expect("a file");
    file
}

#[test]
fn the_source_that_is_compiled_here_and_by_a_c_compiler_is_what_the_command_prints() {
    let file = lift_file();
    for (language, source) in [("--rust", RUST), ("--c", C)] {
        let run = goodbot(&["table", file.path().to_str().expect("UTF-8"), language, "--sessions", "6"], b"");
        assert_eq!((run.code, run.output.as_str()), (0, source), "{}", run.messages);
    }
}

#[test]
fn the_compiled_robot_does_what_the_robot_of_the_file_does() {
    let mut memory = lift::RobotMemory::new();
    let compiled = lift::Robot::new(memory.home.lend().objects).expect("room");
    let file = WorldFile::parse(LIFT).expect("a world");
    robot::with(&file, |robot, start| {
        assert_eq!((u64::from(lift::START), compiled.state_count()), (start, robot.state_count()));
        let objects: Vec<ObjectId> = robot.world().objects.iter().map(|(object, _)| object).collect();
        for state in 0..lift::STATES {
            for action in (0..robot.actions().len()).map(|action| Action::new(action as u8)) {
                let next = compiled.step(&state, action).map(u64::from);
                assert_eq!(next, robot.step(&u64::from(state), action), "{state} {action:?}");
            }
            for proposition in (0..file.propositions.len()).map(|position| PropositionId::new(position as u8)) {
                for pair in objects.iter().flat_map(|&first| objects.iter().map(move |&second| [first, second])) {
                    let ground = GroundProposition::new(proposition, &pair);
                    assert_eq!(compiled.holds(&ground, &state), robot.holds(&ground, &u64::from(state)), "{state} {ground:?}");
                }
            }
        }
    })
    .expect("a robot");
}

#[test]
fn the_compiled_robot_is_taught_in_exactly_the_memory_that_was_printed() {
    let mut memory = lift::RobotMemory::new();
    let lift = lift::Robot::new(memory.home.lend().objects).expect("room");
    let tasks = lift::Robot::tasks().expect("tasks");
    let mut agent = Agent::new(&mut memory.agent, &tasks, Options { language: goodbot::language::Settings::DEFAULT, ..Options::DEFAULT })
        .expect("room");
    let lessons = [
        ("to the roof please", "liftAtFloor(lift0,floor3)"),
        ("to the garage please", "liftAtFloor(lift0,floor0)"),
        ("to the office", "liftAtFloor(lift0,floor2)"),
    ];
    for (command, meaning) in lessons.iter().cycle().take(6) {
        agent.hear(&lift, &lift::START, command).expect("a command");
        let meant = agent.task_named(&lift, meaning).expect("a task");
        let (mut state, mut rests) = (lift::START, 0);
        while rests < 3 {
            agent.plan_fully(&lift, &state).expect("an exact plan");
            let action = agent.decide(&lift, &state).expect("a decision").action;
            let right = agent.planned().judge(meant, action) == Judgement::Correct;
            rests = if right && action == Action::NOOP { rests + 1 } else { 0 };
            state = agent.acted(&lift, &state, action).expect("an action");
            let _ = agent.feedback(if right { Feedback::Reward } else { Feedback::Punish }).expect("feedback");
        }
        assert_eq!(agent.finish(&lift).expect("an end").gave_way.count(), 0);
        agent.learn_fully();
    }
    assert_eq!(agent.language().bitext().sessions(), 6);
    agent.hear(&lift, &lift::START, "to the roof").expect("a command");
    assert_eq!(agent.most_likely(), agent.task_named(&lift, "liftAtFloor(lift0,floor3)"));
}

#[test]
fn what_is_no_robot_for_a_controller_is_refused() {
    let refused = |text: &str, told: &str| {
        let file = tempfile::NamedTempFile::new().expect("a file");
        std::fs::write(file.path(), text).expect("a file");
        let run = goodbot(&["table", file.path().to_str().expect("UTF-8"), "--c"], b"");
        assert!(run.code == 2 && run.messages.contains(told) && run.output.is_empty(), "{told}: {}", run.messages);
    };
    refused(&LIFT.replace("\"effects\":[\"doorOpen(lift0)\"]", "\"effects\":[]"), ":16: field \"actions[2].effects\": are none");
    refused(goodbot(&["example", "home"], b"").output.as_str(), "is no world");
    let derived = r#""derived":[{"name":"here","of":"?f","conditions":["liftAtFloor(?l,?f)"]}],"actions":["#;
    refused(
        &LIFT.replace("\"effects\":[\"doorOpen(lift0)\"]", "\"effects\":[\"doorOpen(lift0)\"],\"cost\":17"),
        "16 is the most for a controller",
    );
    refused(&LIFT.replacen("\"actions\":[", derived, 1), "field \"derived\": are for hosts");
    let parents = r#""parents":{"lift":"floor"},"attributes":{"#;
    refused(&LIFT.replacen("\"attributes\":{", parents, 1), "field \"parents\": are for hosts");
    let many: Vec<String> = (0..9).map(|kind| format!("\"p{kind}\":[\"lift\"]")).collect();
    refused(
        &LIFT.replace("\"doorOpen\":[\"lift\"]", &format!("\"doorOpen\":[\"lift\"],{}", many.join(","))),
        "8 are the most of a table in C",
    );
}
