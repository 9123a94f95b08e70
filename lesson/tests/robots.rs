//! Robots from world files are sound, and are taught by reward and punishment like any other.

use goodbot::feedback::Feedback;
use goodbot::memory::AgentHeap;
use goodbot::oomdp::{Action, Domain, check};
use goodbot::planning::Judgement;
use goodbot::{Agent, Capacities, Options};
use goodbot_formats::world::WorldFile;
use goodbot_lesson::world::robot::{self, Robot};

/// A world, how many states its robot can come to, what it is taught, and a command that it then obeys.
struct Course {
    world: &'static str,
    states: usize,
    lessons: &'static [(&'static str, &'static str)],
    asked: (&'static str, &'static str),
}

const COURSES: [Course; 4] = [
    Course {
        world: include_str!("../../docs/examples/worlds/lift.json"),
        states: 8,
        lessons: &[
            ("to the roof please", "liftAtFloor(lift0,floor3)"),
            ("to the garage please", "liftAtFloor(lift0,floor0)"),
            ("to the office", "liftAtFloor(lift0,floor2)"),
        ],
        asked: ("to the roof", "liftAtFloor(lift0,floor3)"),
    },
    Course {
        world: include_str!("../../docs/examples/worlds/lamps.json"),
        states: 16,
        lessons: &[
            ("the red one in the kitchen on", "lampOn(lamp0)"),
            ("the blue one in the kitchen on", "lampOn(lamp1)"),
            ("the red one in the bedroom on", "lampOn(lamp2)"),
            ("the green one off", "lampOff(lamp3)"),
        ],
        asked: ("bedroom on", "lampOn(lamp2)"),
    },
    Course {
        world: include_str!("../../docs/examples/worlds/arm.json"),
        states: 15,
        lessons: &[
            ("red cup to the black tray", "cupIn(cup0,tray1)"),
            ("blue cup to the white tray", "cupIn(cup1,tray0)"),
            ("red cup to the yellow tray", "cupIn(cup0,tray2)"),
        ],
        asked: ("blue cup to the yellow tray", "cupIn(cup1,tray2)"),
    },
    Course {
        world: include_str!("../../docs/examples/worlds/vacuum.json"),
        states: 79,
        lessons: &[
            ("go to the kitchen", "vacuumIn(vacuum0,room1)"),
            ("go to the bedroom", "vacuumIn(vacuum0,room2)"),
            ("clean the kitchen", "roomClean(room1)"),
            ("clean the hall", "roomClean(room0)"),
            ("clean the kitchen now", "roomClean(room1)"),
        ],
        asked: ("clean the bedroom", "roomClean(room2)"),
    },
];

/// Gives a command, and judges each step until the robot has rightly rested three times.
fn teach(agent: &mut Agent<AgentHeap>, robot: &Robot<'_>, start: u64, command: &str, meaning: &str) {
    agent.hear(robot, &start, command).expect("a command");
    let meant = agent.task_named(robot, meaning).expect("a task");
    let (mut state, mut rests, mut steps) = (start, 0, 0);
    while rests < 3 {
        agent.plan_fully(robot, &state).expect("a plan");
        let action = agent.decide(robot, &state).expect("a decision").action;
        let right = agent.planned().judge(meant, action) == Judgement::Correct;
        rests = if right && action == Action::NOOP { rests + 1 } else { 0 };
        state = agent.acted(robot, &state, action).expect("an action that can be done");
        let _ = agent.feedback(if right { Feedback::Reward } else { Feedback::Punish }).expect("feedback");
        steps += 1;
        assert!(steps < 200, "{command}: the robot does not learn");
    }
    let _ = agent.finish(robot).expect("an end");
    agent.learn_fully();
}

#[test]
fn the_robots_of_the_example_worlds_are_sound_and_learn_what_words_mean() {
    for course in &COURSES {
        let file = WorldFile::parse(course.world).expect("a world");
        robot::with(&file, |robot, start| {
            let checked = check(robot, start, 1_000_000).expect("a sound robot");
            assert_eq!((checked.states, checked.all, checked.never_held), (course.states, true, None), "{}", file.name);
            let tasks = robot::tasks(&file, robot).expect("tasks");
            let mut agent = Agent::new(AgentHeap::new(&Capacities::STANDARD), &tasks, Options::DEFAULT).expect("an agent");
            for (command, meaning) in course.lessons {
                teach(&mut agent, robot, start, command, meaning);
            }
            let (command, meaning) = course.asked;
            agent.hear(robot, &start, command).expect("a command");
            assert_eq!(agent.most_likely(), agent.task_named(robot, meaning), "{command}");
        })
        .expect("a robot");
    }
}

#[test]
fn a_plan_is_one_of_the_cheapest() {
    let plan =
        |world: &str, task: &str| robot::plan(&WorldFile::parse(world).expect("a world"), &task.parse().expect("a task")).expect("a robot");
    let [lift, _, arm, vacuum] = &COURSES;
    assert_eq!(plan(lift.world, "liftAtFloor(lift0,floor3)"), Some(vec!["up".to_owned(), "up".to_owned()]));
    assert_eq!(plan(arm.world, "cupIn(cup0,tray2)"), Some(vec!["grasp(cup0)".to_owned(), "put(tray2)".to_owned()]));
    // Its charge is enough for one step: it docks first.
    assert_eq!(plan(vacuum.world, "roomClean(room1)"), Some(["dock", "go(room1)", "clean"].map(str::to_owned).to_vec()));
    assert_eq!(plan(lift.world, "liftAtFloor(lift0,floor1)"), None, "what holds is no task");
}

#[test]
fn what_is_too_large_for_a_robot_is_refused_by_its_field_at_once() {
    let lamps = |count: usize, actions: &str| {
        let objects: Vec<String> = (0..count).map(|lamp| format!(r#"{{"name":"l{lamp}","class":"lamp"}}"#)).collect();
        let text = format!(
            r#"{{"type":"world","name":"w","classes":["lamp"],"attributes":{{}},"propositions":{{"on":["lamp"]}},"objects":[{}],"task_kinds":["on(?l)"],"actions":[{actions}]}}"#,
            objects.join(",")
        );
        WorldFile::parse(&text)
            .map_err(|error| error.to_string())
            .and_then(|file| robot::with(&file, |robot, _| robot.state_count()).map_err(|flaw| flaw.to_string()))
    };
    let light = r#"{"name":"light","parameters":{"?l":"lamp"},"effects":["on(?l)"]}"#;
    assert_eq!(lamps(12, light), Ok(4_096));
    assert!(lamps(16, light).is_err_and(|it| it.contains("field \"actions\": give the robot 16 actions")));
    assert!(lamps(64, r#"{"name":"all","effects":["on(l0)"]}"#).is_err_and(|it| it.contains("more states than can be numbered")));
    assert!(lamps(10_000, light).is_err_and(|it| it.contains("field \"objects\": are 10000, and 255 are the most")));
    assert!(lamps(2, "").is_err_and(|it| it.contains("no robot can act in it")));
    for (action, told) in [
        (r#"{"name":"a","effects":[]}"#, "actions[0].effects\": are none"),
        (r#"{"name":"a","effects":["on(l0)"],"cost":0}"#, "actions[0].cost\": 0 is no cost"),
        (r#"{"name":"a","effects":["on(l9)"]}"#, "actions[0].effects[0]\": the world has no object \"l9\""),
        (r#"{"name":"a","effects":["on(?x)"]}"#, "?x has no value"),
    ] {
        assert!(lamps(2, action).is_err_and(|it| it.contains(told)), "{told}");
    }
}
