//! Robots from world files are sound, and plan; tests of the command line teach them.

use goodbot::oomdp::{Action, Domain, check};
use goodbot_formats::world::WorldFile;
use goodbot_lesson::world::robot;

const LIFT: &str = include_str!("../../docs/examples/worlds/lift.json");
const LAMPS: &str = include_str!("../../docs/examples/worlds/lamps.json");
const ARM: &str = include_str!("../../docs/examples/worlds/arm.json");
const VACUUM: &str = include_str!("../../docs/examples/worlds/vacuum.json");

#[test]
fn the_robots_of_the_example_worlds_are_sound() {
    for (world, states) in [(LIFT, 8), (LAMPS, 16), (ARM, 15), (VACUUM, 79)] {
        let file = WorldFile::parse(world).expect("a world");
        robot::with(&file, |robot, start| {
            let checked = check(robot, start, 1_000_000).expect("a sound robot");
            assert_eq!((checked.states, checked.all, checked.never_held), (states, true, None), "{}", file.name);
        })
        .expect("a robot");
    }
}

#[test]
fn a_plan_is_one_of_the_cheapest() {
    let plan =
        |world: &str, task: &str| robot::plan(&WorldFile::parse(world).expect("a world"), &task.parse().expect("a task")).expect("a robot");
    assert_eq!(plan(LIFT, "liftAtFloor(lift0,floor3)"), Some(vec!["up".to_owned(), "up".to_owned()]));
    assert_eq!(plan(ARM, "cupIn(cup0,tray2)"), Some(vec!["grasp(cup0)".to_owned(), "put(tray2)".to_owned()]));
    // Its charge is enough for one step: it docks first.
    assert_eq!(plan(VACUUM, "roomClean(room1)"), Some(["dock", "go(room1)", "clean"].map(str::to_owned).to_vec()));
    assert_eq!(plan(LIFT, "liftAtFloor(lift0,floor1)"), None, "what holds is no task");
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
    assert_eq!(lamps(16, light), Ok(65_536));
    // Each ordered pair of 16 lamps, and each lamp.
    let many = format!(r#"{{"name":"swap","parameters":{{"?a":"lamp","?b":"lamp"}},"effects":["on(?a)","!on(?b)"]}},{light}"#);
    assert!(lamps(16, &many).is_err_and(|it| {
        it.ends_with("field \"actions\": give the robot 256 actions with their objects, and 255 are the most; give them fewer parameters")
    }));
    let all: Vec<String> = (0..64).map(|lamp| format!("\"on(l{lamp})\"")).collect();
    let all = format!(r#"{{"name":"all","effects":[{}]}}"#, all.join(","));
    assert!(lamps(64, &all).is_err_and(|it| it.contains("\"propositions.on\": gives more states than can be numbered")));
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

#[test]
fn a_robot_may_have_255_actions() {
    let rooms: Vec<String> = (0..255).map(|room| format!(r#"{{"name":"room{room}","class":"room"}}"#)).collect();
    let text = format!(
        r#"{{"type":"world","name":"w","classes":["room"],"attributes":{{}},"propositions":{{"in":["room"]}},"variables":["in"],"objects":[{}],
        "facts":["in(room0)"],"task_kinds":["in(?r)"],"actions":[{{"name":"go","parameters":{{"?r":"room"}},"effects":["in(?r)"]}}]}}"#,
        rooms.join(",")
    );
    let file = WorldFile::parse(&text).expect("a world");
    let counts = robot::with(&file, |robot, start| (robot.actions().len(), check(robot, start, 1_000).map(|checked| checked.states)));
    assert_eq!(counts, Ok((255, Ok(255))));
    for room in [1, 15, 16, 63, 64, 128, 254] {
        let task = format!("in(room{room})").parse().expect("a task");
        assert_eq!(robot::plan(&file, &task), Ok(Some(vec![format!("go(room{room})")])));
    }
}

#[test]
fn actions_of_one_name_are_cases_of_one_action_and_the_first_possible_one_takes_effect() {
    let press = r#"{"name":"press","parameters":{"?l":"lamp"},"conditions":["!on(?l)"],"effects":["on(?l)"],"cost":2},
        {"name":"wait","effects":["!on(l0)"]},
        {"name":"press","parameters":{"?it":"lamp"},"effects":["!on(?it)"],"cost":2},
        {"name":"press","effects":["on(l1)"],"cost":2}"#;
    robot::with(&lamps(2, "", press), |robot, dark| {
        let kinds: Vec<(&str, u8)> = robot.actions().iter().map(|kind| (kind.name, kind.cost)).collect();
        assert_eq!(kinds, [("press(l0)", 2), ("press(l1)", 2), ("wait", 1), ("press", 2)]);
        let press = |state: u64| robot.step(&state, Action::new(1)).expect("a state");
        assert_eq!(robot.facts(press(dark)).iter().map(ToString::to_string).collect::<Vec<_>>(), ["on(l1)"]);
        assert_eq!(press(press(dark)), dark);
    })
    .expect("a robot");
}

#[test]
fn cases_of_an_action_cost_the_same() {
    let text = r#"{"type":"world","name":"w","classes":["lamp"],"attributes":{},"propositions":{"on":["lamp"]},"objects":[{"name":"l0","class":"lamp"}],
        "task_kinds":["on(?l)"],"actions":[{"name":"press","conditions":["!on(l0)"],"effects":["on(l0)"]},{"name":"press","effects":["!on(l0)"],"cost":3}]}"#;
    let refused = WorldFile::parse(text).expect_err("two costs").to_string();
    let told = "field \"actions[1]\": costs 3, and an earlier case of \"press\" costs 1; give all cases of an action the same cost";
    assert!(refused.ends_with(told), "{refused}");
}

#[test]
fn of_more_than_fifteen_actions_those_that_are_never_possible_are_left_out_if_a_controller_can_hold_the_rest() {
    let light = r#"{"name":"light","parameters":{"?l":"lamp"},"conditions":["!on(?l)"],"effects":["on(?l)"]}"#;
    let lit: Vec<String> = (0..20).map(|lamp| format!("\"on(l{lamp})\"")).collect();
    let counts =
        |dark: usize| robot::with(&lamps(20, &lit[dark..].join(","), light), |robot, _| (robot.actions().len(), robot.state_count()));
    assert_eq!(counts(15), Ok((15, 1 << 15)));
    assert_eq!(counts(16), Ok((20, 1 << 20)));
}

/// A house of this many lamps that are on or off; half of them are on. An action for each lamp to light it, and one to
/// darken it.
fn house(count: usize, more: &str) -> WorldFile {
    let objects: Vec<String> = (0..count).map(|lamp| format!(r#"{{"name":"l{lamp}","class":"lamp"}}"#)).collect();
    let facts: Vec<String> = (0..count).map(|lamp| format!(r#""{}(l{lamp})""#, if lamp % 2 == 0 { "on" } else { "off" })).collect();
    let text = format!(
        r#"{{"type":"world","name":"house","classes":["lamp"],"attributes":{{}},"propositions":{{"on":["lamp"],"off":["lamp"]}},
        "objects":[{}],"facts":[{}],"task_kinds":["on(?l)","off(?l)"],"actions":[
        {{"name":"light","parameters":{{"?l":"lamp"}},"conditions":["off(?l)"],"effects":["on(?l)","!off(?l)"]}},
        {{"name":"dim","parameters":{{"?l":"lamp"}},"conditions":["!off(?l)"],"effects":["off(?l)","!on(?l)"]}}{more}]}}"#,
        objects.join(","),
        facts.join(",")
    );
    WorldFile::parse(&text).expect("a world")
}

#[test]
fn propositions_that_are_opposites_share_a_digit_where_there_would_be_too_many_states() {
    // Each lamp is on or off, which the file says by two propositions.
    let of = |file: &WorldFile| robot::with(file, |robot, _| (robot.actions().len(), robot.state_count()));
    assert_eq!(of(&house(16, "")), Ok((32, 1 << 32)));
    assert_eq!(of(&house(40, "")), Ok((80, 1 << 40)));
    assert_eq!(of(&house(63, "")), Ok((126, 1 << 63)));
    // Where an action may light a lamp that is not off, both have digits of their own.
    let broken = r#",{"name":"spark","effects":["on(l1)"]}"#;
    assert_eq!(of(&house(40, broken)), Ok((81, 1 << 41)));
    let many = house(40, "");
    robot::with(&many, |robot, start| {
        let on = |state: u64| robot.facts(state).iter().filter(|fact| fact.function() == "on").count();
        assert_eq!((on(start), robot.facts(start).len()), (20, 40));
        assert_eq!(robot.step(&start, Action::new(0)), None, "l0 is on");
        let lit = robot.step(&start, Action::new(1)).expect("a state");
        assert_eq!((on(lit), robot.facts(lit).len()), (21, 40));
        assert_eq!(robot.step(&lit, Action::new(41)), Some(start));
        assert_eq!(robot.state_of(&robot.facts(lit)), Ok(lit));
        let mut facts = robot.facts(start);
        facts.push("on(l1)".parse().expect("a fact"));
        assert!(robot.state_of(&facts).is_err_and(|told| told.message.contains("the opposite of a fact before it")));
        facts.retain(|fact| fact.arguments() != ["l1"]);
        assert!(robot.state_of(&facts).is_err_and(|told| told.message.starts_with("say neither on(l1) nor off(l1)")));
    })
    .expect("a robot");
    assert_eq!(robot::plan(&many, &"on(l39)".parse().expect("a task")), Ok(Some(vec!["light(l39)".to_owned()])));
    assert_eq!(robot::plan(&many, &"off(l38)".parse().expect("a task")), Ok(Some(vec!["dim(l38)".to_owned()])));
}

/// A world of `count` lamps; those of `on` are on at first.
fn lamps(count: usize, on: &str, actions: &str) -> WorldFile {
    let objects: Vec<String> = (0..count).map(|lamp| format!(r#"{{"name":"l{lamp}","class":"lamp"}}"#)).collect();
    let text = format!(
        r#"{{"type":"world","name":"w","classes":["lamp"],"attributes":{{}},"propositions":{{"on":["lamp"]}},"objects":[{}],"facts":[{on}],"task_kinds":["on(?l)"],"actions":[{actions}]}}"#,
        objects.join(",")
    );
    WorldFile::parse(&text).expect("a world")
}

#[test]
fn of_many_things_only_what_can_change_makes_states() {
    let actions = r#"{"name":"light","conditions":["!on(l0)","on(l7)"],"effects":["on(l0)","!on(l7)"]},
        {"name":"back","conditions":["on(l0)","!on(l9)"],"effects":["!on(l0)","on(l7)","!on(l8)"]},
        {"name":"dark","conditions":["on(l9)"],"effects":["on(l10)"]}"#;
    let file = lamps(64, r#""on(l7)","on(l20)""#, actions);
    robot::with(&file, |robot, start| {
        // All lamps together have too many states. l0 and l7 change; l20 stays on, l8 and l9 stay off, and so nothing is done where l9 is on.
        assert_eq!(robot.state_count(), 4);
        assert_eq!(check(robot, start, 100).map(|checked| checked.states), Ok(2));
        assert_eq!(robot.actions().iter().map(|kind| kind.name).collect::<Vec<_>>(), ["light", "back"]);
        let on = |state: u64| robot.facts(state).iter().map(ToString::to_string).collect::<Vec<_>>();
        assert_eq!(on(start), ["on(l7)", "on(l20)"]);
        let lit = robot.step(&start, Action::new(0)).expect("a state");
        assert_eq!(on(lit), ["on(l0)", "on(l20)"]);
        assert_eq!(robot.step(&lit, Action::new(1)), Some(start));
        assert_eq!(robot.state_of(&robot.facts(lit)), Ok(lit));
        let told = robot.state_of(&["on(l5)", "on(l20)"].map(|fact| fact.parse().expect("a fact"))).expect_err("a flaw");
        assert!(told.message.contains("holds here and not in the world, and no action changes it"), "{told}");
    })
    .expect("a robot");
    assert_eq!(robot::plan(&file, &"on(l0)".parse().expect("a task")), Ok(Some(vec!["light".to_owned()])));
    assert_eq!(robot::plan(&file, &"on(l10)".parse().expect("a task")), Ok(None));
}

#[test]
fn where_all_states_can_be_numbered_a_session_may_begin_with_what_no_action_brings_about() {
    let file = lamps(4, "", r#"{"name":"light","effects":["on(l0)"]}"#);
    let begun = robot::with(&file, |robot, _| {
        let state = robot.state_of(&["on(l3)".parse().expect("a fact")])?;
        Ok::<_, robot::WorldFlaw>((robot.state_count(), state, robot.facts(state).len()))
    });
    assert_eq!(begun.expect("a robot"), Ok((16, 8, 1)));
}

#[test]
fn values_that_a_variable_never_takes_make_no_states() {
    // Ten robots could be in a hundred rooms each. Two of them walk, each between two rooms.
    let objects = |class: &'static str, count: usize| (0..count).map(move |it| format!(r#"{{"name":"{class}{it}","class":"{class}"}}"#));
    let objects: Vec<String> = objects("bot", 12).chain(objects("room", 100)).collect();
    let facts: Vec<String> = (0..12).map(|bot| format!("\"at(bot{bot},room{})\"", 7 * bot)).collect();
    let go = |name: &str, bot: &str, to: &str| format!(r#"{{"name":"{name}","effects":["at({bot},{to})"]}}"#);
    let text = format!(
        r#"{{"type":"world","name":"w","classes":["bot","room"],"attributes":{{}},"propositions":{{"at":["bot","room"]}},"variables":["at"],
        "objects":[{}],"facts":[{}],"task_kinds":["at(?b,?r)"],"actions":[{},{},{}]}}"#,
        objects.join(","),
        facts.join(","),
        go("a", "bot1", "room3"),
        go("b", "bot1", "room7"),
        go("c", "bot2", "room99")
    );
    let file = WorldFile::parse(&text.replace("\"at(?b,?r)\"", "\"at(?b,?r) & at(?c,?r)\"")).expect("a world");
    let tables = robot::Tables::of(std::sync::Arc::new(file)).expect("a robot");
    tables.lend(|robot| {
        assert_eq!(robot.state_count(), 4);
        let next = robot.step(&tables.start(), Action::new(2)).expect("a state");
        let facts = robot.facts(next).iter().map(ToString::to_string).collect::<Vec<_>>();
        assert!(facts.contains(&"at(bot2,room99)".to_owned()) && facts.contains(&"at(bot11,room77)".to_owned()), "{facts:?}");
        assert_eq!(facts.len(), 12);
        assert_eq!(robot.state_of(&robot.facts(next)), Ok(next));
    });
}

#[test]
fn derived_facts_follow_from_what_holds_also_where_few_states_are_possible() {
    let vacuum = |more: &str, derived: &str| {
        let text = VACUUM.replace("\"actions\":[", &format!("\"derived\":[{derived}],\"actions\":[{more}"));
        WorldFile::parse(&text).map_err(|error| error.to_string())
    };
    let told = |file: &WorldFile, task: &str| {
        let Some(plan) = robot::plan(file, &task.parse().expect("a task")).expect("a robot") else { panic!("a plan") };
        robot::with(file, |robot, start| {
            let act = |state: u64, action: &String| {
                let action = goodbot::oomdp::action_named(robot, action).expect("an action");
                robot.step(&state, action).expect("a possible action")
            };
            let state = plan.iter().fold(start, act);
            let mut told = Vec::new();
            for (object, _) in robot.world().objects.iter() {
                robot.tell_derived(&state, object, &mut |fact| told.push(format!("{} {fact}", robot.world().objects.name(object))));
            }
            told.join(", ")
        })
        .expect("a robot")
    };
    let derived = r#"{"name":"here","of":"?r","conditions":["vacuumIn(?v,?r)"]},
        {"name":"near","of":"?r","conditions":["vacuumIn(?v,?other)","door(?other,?r)"]},
        {"name":"clean","of":"?r","conditions":["roomClean(?r)"]},
        {"name":"clean","of":"?r","conditions":["dockIn(?r)","!vacuumIn(vacuum0,?r)"]}"#;
    // With 70 rooms beyond all doors there are too many states to number, so those that are impossible get no number.
    let rooms: Vec<String> = (0..70).map(|room| format!(r#"{{"name":"cellar{room}","class":"room"}}"#)).collect();
    let few = vacuum("", derived).expect("a world");
    let many = WorldFile::parse(
        &few.to_json_line()
            .expect("JSON")
            .replace(r#"{"name":"empty","class":"charge"}"#, &format!(r#"{{"name":"empty","class":"charge"}},{}"#, rooms.join(","))),
    );
    for file in [few, many.expect("a world")] {
        assert_eq!(told(&file, "docked(vacuum0)"), "room0 here, room1 near, room2 near");
        assert_eq!(told(&file, "roomClean(room1)"), "room0 near, room0 clean, room1 here, room1 clean");
    }
    let refused = |derived: &str| vacuum("", derived).map(|file| robot::with(&file, |_, _| ()).map_err(|flaw| flaw.to_string()));
    assert!(refused(r#"{"name":"here","of":"?x","conditions":["vacuumIn(?v,?r)"]}"#).is_err_and(|it| it.contains("?x is in no condition")));
    assert!(refused(r#"{"name":"here","of":"r","conditions":["vacuumIn(?v,?r)"]}"#).is_err_and(|it| it.contains("\"r\" is no variable")));
    assert!(refused(r#"{"name":"here","of":"?r","conditions":[]}"#).is_err_and(|it| it.contains("conditions")));
    let long = format!(r#"{{"name":"{}","of":"?r","conditions":["vacuumIn(?v,?r)"]}}"#, "h".repeat(47));
    assert!(refused(&long).is_ok_and(|it| it.is_err_and(|it| it.contains("field \"derived[0]\": has a name of more than 46 bytes"))));
    let four = r#""a":["room"],"b":["room"],"c":["room"],"name":["room"]"#;
    let text = VACUUM.replace(r#""name":["room"]"#, four).replace("\"actions\":[", &format!("\"derived\":[{derived}],\"actions\":["));
    let four = WorldFile::parse(&text).expect("a world");
    assert!(robot::with(&four, |_, _| ()).is_err_and(|it| it.to_string().contains("have no room beside 4 attributes")));
    let told = VACUUM.split("\"actions\"").next().unwrap_or_default().to_owned() + r#""derived":[],"task_kinds":["roomClean(?r)"]}"#;
    assert!(WorldFile::parse(&told).is_err_and(|it| it.to_string().contains("belong to a world with actions")));
}

#[test]
fn a_dear_action_is_taken_only_where_the_others_cost_more() {
    let plan = |cost: u16| {
        let text = LIFT.replacen(
            "\"actions\":[",
            &format!(r#""actions":[{{"name":"leap","parameters":{{"?f":"floor"}},"effects":["liftAtFloor(lift0,?f)"],"cost":{cost}}},"#),
            1,
        );
        let text = text.replacen(r#"{"name":"up","#, r#"{"name":"up","cost":100,"#, 1);
        let file = WorldFile::parse(&text).map_err(|error| error.to_string())?;
        robot::plan(&file, &"liftAtFloor(lift0,floor3)".parse().expect("a task")).map_err(|flaw| flaw.to_string())
    };
    assert_eq!(plan(199), Ok(Some(vec!["leap(floor3)".to_owned()])));
    assert_eq!(plan(201), Ok(Some(vec!["up".to_owned(), "up".to_owned()])));
    for cost in [0, 256] {
        assert!(plan(cost).is_err_and(|it| it.contains("write a whole number from 1 to 255")));
    }
}

/// A robot that carries balls and boxes, and rolls balls alone.
const THINGS: &str = r#"{"type":"world","name":"toys","classes":["object","robot","thing","ball","box","room"],
    "parents":{"thing":"object","room":"object","ball":"thing","box":"thing"},"attributes":{"color":["object"]},
    "propositions":{"holding":["robot","thing"],"rolled":["ball"],"lies":["thing"]},
    "objects":[{"name":"robot0","class":"robot"},{"name":"ball0","class":"ball","attributes":{"color":"red"}},
        {"name":"box0","class":"box","attributes":{"color":"red"}},{"name":"ball1","class":"ball","attributes":{"color":"blue"}},
        {"name":"room0","class":"room","attributes":{"color":"blue"}}],
    "facts":["lies(ball0)","lies(ball1)","lies(box0)"],
    "actions":[{"name":"take","parameters":{"?x":"thing"},"conditions":["lies(?x)"],"effects":["holding(robot0,?x)","!lies(?x)"]},
        {"name":"roll","parameters":{"?x":"thing"},"conditions":["holding(robot0,?x)","!rolled(?x)"],"effects":["rolled(?x)"]}],
    "task_kinds":["holding(?r,?x)","rolled(?b) & holding(?r,?b)","rolled(?b)"]}"#;

#[test]
fn an_object_is_of_the_classes_above_its_own_and_tasks_of_a_lower_class_are_about_that_alone() {
    use goodbot::task::{GroundedTask, ground};
    let file = WorldFile::parse(THINGS).expect("a world");
    assert_eq!(WorldFile::parse(&file.to_json_line().expect("JSON")), Ok(file.clone()));
    robot::with(&file, |robot, start| {
        assert!(check(robot, start, 1_000).is_ok_and(|checked| checked.all));
        let actions: Vec<&str> = robot.actions().iter().map(|kind| kind.name).collect();
        assert_eq!(actions, ["take(ball0)", "take(box0)", "take(ball1)", "roll(ball0)", "roll(ball1)"]);
        let lifted = robot::tasks(&file, robot).expect("kinds");
        let mut tasks = [GroundedTask::UNUSED; 64];
        let count = ground(robot, &lifted, &start, &mut tasks).expect("room");
        let name = |task: &GroundedTask| goodbot_lesson::name::task_name(robot, &lifted[usize::from(task.lifted)], task);
        let names: Vec<String> = tasks[..count].iter().filter_map(|task| name(task).ok()).map(|name| name.to_string()).collect();
        assert_eq!(
            names,
            [
                "holding(robot0,ball0)",
                "holding(robot0,box0)",
                "holding(robot0,ball1)",
                "rolled(ball0) & holding(robot0,ball0)",
                "rolled(ball1) & holding(robot0,ball1)",
                "rolled(ball0)",
                "rolled(ball1)"
            ]
        );
        assert_eq!(goodbot_lesson::world::count_tasks(&file), Ok(count));
        let mut told = Vec::new();
        for (object, _) in robot.world().objects.iter() {
            robot.tell_derived(&start, object, &mut |fact| told.push(fact.to_owned()));
        }
        assert_eq!(told, ["ball", "box", "ball"], "nothing else is of one class with another");
    })
    .expect("a robot");
    assert_eq!(
        robot::plan(&file, &"rolled(ball1)".parse().expect("a task")),
        Ok(Some(["take(ball1)", "roll(ball1)"].map(str::to_owned).to_vec()))
    );
}

#[test]
fn classes_above_others_that_contradict_are_refused() {
    for (from, to, told) in [
        (r#""box":"thing""#, r#""box":"thing","object":"ball""#, "\"ball\" is the class itself, or below it"),
        (r#""box":"thing""#, r#""box":"toy""#, "the world has no class \"toy\""),
        ("\"lies(box0)\"", "\"rolled(box0)\"", "\"box0\" is where an object of the class \"ball\" belongs"),
        ("\"lies(box0)\"", "\"lies(room0)\"", "\"room0\" is where an object of the class \"thing\" belongs"),
        (r#""conditions":["lies(?x)"]"#, r#""conditions":["lies(?x)","rolled(?y)","holding(?y,?x)"]"#, "\"?y\" is where an object of"),
        (r#""effects":["holding(robot0,?x)""#, r#""effects":["rolled(?x)","holding(robot0,?x)""#, "\"?x\" is where an object of"),
    ] {
        let refused = WorldFile::parse(&THINGS.replacen(from, to, 1)).map_err(|error| error.to_string());
        assert!(refused.as_ref().is_err_and(|it| it.contains(told)), "{told}: {refused:?}");
    }
}
