//! The world that the page shows, as examples.

use goodbot_formats::session::{RecordedSession, SessionReader};
use goodbot_wasm::view::About;
use goodbot_wasm::world::check;
use goodbot_wasm::{World, course};

/// A new robot in the home of the course with this name.
fn world(home: &str) -> World {
    let mut world = World::new(7).unwrap();
    let course = course::fixed();
    let (_, file) = course.homes.iter().find(|(name, _)| name == home).unwrap();
    world.set_environment(&file.to_json_line()).unwrap();
    world
}

/// Trains by hand: a trainer who says every time whether the action is right for the task with this name.
fn train(world: &mut World, command: &str, intended: &str) -> String {
    world.hear(command).unwrap();
    let intended = world.belief().tasks.iter().position(|task| task.name == intended).unwrap();
    for _ in 0..12 {
        while !world.plan(1_000).unwrap() {}
        let decided = world.act().unwrap();
        let there = decided.plans[intended] == "goal";
        let right = there == (decided.action == "noop") && decided.task == intended;
        world.judge(if right { "reward" } else { "punish" }).unwrap();
    }
    let log = world.finish().unwrap();
    while !world.learn(1_000) {}
    log
}

/// The model that `goodbot learn` makes of the log that `goodbot example log` prints: the default learner, with its layer.
const OF_A_HOST: &[u8] = include_bytes!("../../tests/tests/behaviour/format_3.model");

#[test]
fn a_robot_takes_back_what_a_host_taught_and_keeps_it_as_a_role_model() {
    let mut world = world("A");
    world.restore(OF_A_HOST).unwrap();
    while !world.learn(1_000) {}
    let saved = world.save().unwrap();
    assert_eq!(saved[8..10], [2, 0]);
    assert!(!world.for_microbit().unwrap().is_empty());
    world.restore(&saved).unwrap();
    while !world.learn(1_000) {}
    assert_eq!(world.save().unwrap(), saved);
    let damaged = [&OF_A_HOST[..OF_A_HOST.len() - 9], &[0; 9]].concat();
    assert!(world.restore(&damaged).unwrap_err().to_string().contains("damaged"));
}

#[test]
fn a_robot_that_does_not_know_the_words_does_not_say_that_all_is_done() {
    let mut world = world("A");
    world.hear("go to the green room").unwrap();
    while !world.plan(1_000).unwrap() {}
    world.act().unwrap();
    world.judge("neutral").unwrap();
    world.finish().unwrap();
    while !world.learn(1_000) {}
    world.reset();
    for command in ["go to the green room", "go to the red room", "fetch me some coffee"] {
        assert_ne!(world.listen(command, false).unwrap().verdict, "done", "{command}");
    }
}

#[test]
fn what_is_done_already_is_told_and_nothing_else_is() {
    let mut world = world("A");
    let lessons = [("go to the green room", 1), ("go to the red room", 2)];
    for (command, task) in lessons.into_iter().cycle().take(12) {
        world.reset();
        train(&mut world, command, &format!("agentInRoom(agent0,room{task})"));
    }
    let heard = |world: &mut World, command| {
        let heard = world.listen(command, false).unwrap();
        (heard.verdict, heard.begun, heard.task)
    };
    let red = "agentInRoom(agent0,room2)".to_owned();
    assert_eq!(heard(&mut world, "go to the red room"), ("done", false, red.clone()), "the last session ended there");
    assert!(world.belief().tasks.is_empty(), "nothing is under way");
    assert!(heard(&mut world, "go to the green room").1);
    world.reset();
    assert_eq!(heard(&mut world, "go to the red room"), ("sure", true, red));
}

#[test]
fn a_robot_that_was_trained_understands_the_command_it_was_trained_on() {
    let mut world = world("A");
    train(&mut world, "go to the green room", "agentInRoom(agent0,room1)");
    train(&mut world, "go to the red room", "agentInRoom(agent0,room2)");
    world.reset();
    world.hear("go to the red room").unwrap();
    let tasks = world.belief().tasks;
    let best = tasks.iter().max_by(|a, b| a.probability.total_cmp(&b.probability)).unwrap();
    assert_eq!(best.name, "agentInRoom(agent0,room2)");
    let support = world.support().unwrap();
    let red = support.words.iter().position(|word| word == "red").unwrap();
    let task = tasks.iter().position(|task| task.name == best.name).unwrap();
    assert!(support.tasks[red][task] > 0.5, "{support:?}");
}

#[test]
fn who_is_asked_learns_nothing_and_stays_where_it_is() {
    let mut robots = [world("A"), world("A")];
    for robot in &mut robots {
        train(robot, "go to the green room", "agentInRoom(agent0,room1)");
    }
    let [asked, other] = &mut robots;
    let (scene, home) = (asked.scene(), world("D").environment());
    let belief = asked.asked(&home, "bring me coffee in the green room").unwrap();
    assert!(belief.tasks.iter().any(|task| task.name.starts_with("blockInRoom")), "it was asked in the other home");
    assert!(asked.asked("{}", "go to the green room").is_err());
    assert!(asked.asked(&home, "").is_err());
    assert_eq!(asked.scene(), scene);
    assert!(!asked.is_listening());
    assert_eq!(asked.save().unwrap(), other.save().unwrap());
    for robot in &mut robots {
        train(robot, "go to the red room", "agentInRoom(agent0,room2)");
    }
    let [asked, other] = robots;
    assert_eq!(asked.save().unwrap(), other.save().unwrap());
}

#[test]
fn feedback_goes_to_the_last_action_and_says_what_it_changed() {
    let mut world = world("A");
    world.hear("go to the red room").unwrap();
    assert!(world.judge("reward").is_err(), "nothing was done yet");
    while !world.plan(10).unwrap() {}
    let decided = world.act().unwrap();
    assert!(world.act().is_err(), "the action was not judged yet");
    let evidence = world.judge("punish").unwrap();
    assert_eq!(evidence.action, decided.action);
    for (task, judgement) in evidence.judgements.iter().enumerate() {
        let fell = evidence.after[task] < evidence.before[task];
        assert!(*judgement == "wrong" || fell || evidence.judgements.iter().all(|other| other == judgement));
    }
}

#[test]
fn a_robot_that_nobody_judges_believes_the_same_all_its_way() {
    let mut world = world("Test");
    world.hear("an unknown command").unwrap();
    let believed = world.belief();
    let mut steps = Vec::new();
    while steps.last().is_none_or(|action| action != "noop") {
        assert!(steps.len() < 40, "it does not walk to and fro: {steps:?}");
        while !world.plan(1_000).unwrap() {}
        steps.push(world.act().unwrap().action);
        world.unjudged();
        assert_eq!(world.belief(), believed);
    }
    assert!(steps.len() > 1, "it gets somewhere");
}

#[test]
fn what_a_word_says_of_nothing_at_all_is_told_too() {
    let mut world = world("A");
    train(&mut world, "go to the green room", "agentInRoom(agent0,room1)");
    let heat = world.heat();
    assert_eq!(heat.idle.len(), heat.words.len());
    assert!((heat.idle.iter().sum::<f32>() - 1.0).abs() < 1e-4, "{:?}", heat.idle);
}

#[test]
fn a_log_of_a_session_is_read_by_its_reader_and_teaches_the_same() {
    let mut first = world("D");
    first.set_learns_style(true).unwrap();
    let log = train(&mut first, "take the blue chair to the yellow room", "blockInRoom(block0,room2)");
    let sessions: Vec<_> = SessionReader::new(log.as_bytes()).collect::<Result<_, _>>().unwrap();
    let mut second = World::new(1).unwrap();
    second.replay(&sessions[0]).unwrap();
    assert_eq!(second.heat(), first.heat());
    assert_eq!(sessions[0].to_lines().unwrap().join("\n"), log.trim_end());
}

#[test]
fn a_saved_model_believes_the_same_to_the_last_bit() {
    let mut first = world("A");
    for command in ["go to the green room", "please walk over to that green one now", "green", "to the green room, if you like, my friend"]
    {
        train(&mut first, command, "agentInRoom(agent0,room1)");
        first.reset();
    }
    let mut second = world("A");
    second.restore(&first.save().unwrap()).unwrap();
    while !second.learn(100) {}
    first.reset();
    for world in [&mut first, &mut second] {
        world.hear("go to the red room").unwrap();
    }
    let bits = |world: &World| world.belief().tasks.iter().map(|task| task.probability.to_bits()).collect::<Vec<_>>();
    assert_eq!(bits(&second), bits(&first));
}

#[test]
fn a_damaged_model_is_refused_and_the_old_one_stays() {
    let mut world = world("A");
    train(&mut world, "go to the green room", "agentInRoom(agent0,room1)");
    let old = world.save().unwrap();
    let mut damaged = old.clone();
    let middle = damaged.len() / 2;
    damaged[middle] ^= 1;
    assert!(world.restore(&damaged).is_err());
    assert_eq!(world.save().unwrap(), old);
}

#[test]
fn the_lessons_of_another_robot_are_added_once_and_a_damaged_model_adds_none() {
    let (mut world, mut other) = (world("A"), world("A"));
    train(&mut world, "go to the green room", "agentInRoom(agent0,room1)");
    train(&mut other, "walk to the red room", "agentInRoom(agent0,room2)");
    let mut theirs = other.save().unwrap();
    for (added, sessions) in [(1, 2), (0, 2)] {
        assert_eq!(world.join(&theirs).unwrap(), added);
        while !world.learn(1_000) {}
        assert_eq!(world.sessions(), sessions);
    }
    let known = world.save().unwrap();
    let middle = theirs.len() / 2;
    theirs[middle] ^= 1;
    assert!(world.join(&theirs).is_err());
    assert_eq!(world.save().unwrap(), known);
}

#[test]
fn a_home_that_is_none_is_refused_by_the_name_of_what_is_wrong() {
    let json = r#"{"version":1,"objects":[{"class":"room","name":"hall","left":0,"bottom":0,"right":4,"top":4,"color":"red"},{"class":"agent","name":"robbie","x":0,"y":2}]}"#;
    let refusal = check(json).unwrap_err();
    assert!(refusal.0.starts_with("robbie: it is in a wall"), "{refusal}");
}

#[test]
fn the_ghost_stands_where_the_task_is_done() {
    let mut world = world("D");
    world.hear("take the blue chair to the yellow room").unwrap();
    let task = world.belief().tasks.iter().position(|task| task.name == "blockInRoom(block0,room2)").unwrap();
    world.look_ahead(task);
    let mut parts = 1;
    let route = loop {
        match world.look(40) {
            (false, _) => parts += 1,
            (true, route) => break route.unwrap(),
        }
    };
    assert!(parts > 3, "it looks in parts, so that a page never stands still");
    let chair = route.end.iter().find(|thing| thing.name == "block0").unwrap();
    assert!(chair.x > 4 && chair.y > 4, "{chair:?} is in the room to the north-east");
    assert_eq!(route.cells[0], [4, 1]);
}

#[test]
fn the_course_can_be_taken_in_homes_at_random() {
    let course = course::random(5);
    assert_eq!((course.lessons.len(), course.tests.len(), course.homes.len()), (7, 5, 7));
    for lesson in course.lessons.iter().chain(&course.tests) {
        let (_, file) = course.homes.iter().find(|(name, _)| *name == lesson.home).unwrap();
        let mut world = World::new(1).unwrap();
        world.set_environment(&file.to_json_line()).unwrap();
        world.hear(&lesson.command).unwrap();
        assert!(world.belief().tasks.iter().any(|task| task.name == lesson.intended), "{lesson:?}");
    }
}

#[test]
fn a_robot_that_pulls_says_so_in_its_log() {
    let mut world = world("D");
    world.set_pulls(true).unwrap();
    world.hear("take the chair").unwrap();
    while !world.plan(1_000).unwrap() {}
    world.act_as("north").unwrap();
    world.judge("reward").unwrap();
    let log = world.log(true).unwrap();
    let sessions: Vec<_> = SessionReader::new(log.as_bytes()).collect::<Result<_, _>>().unwrap();
    assert!(sessions[0].header.action_names().any(|name| name == "pull"));
    let mut other = World::new(1).unwrap();
    other.replay(&sessions[0]).unwrap();
    assert!(other.pulls());
    assert_eq!(other.sessions(), 1);
}

/// The session of a log, with another end.
fn recorded(log: &str, learn: bool) -> RecordedSession {
    RecordedSession { learn, ..SessionReader::new(log.as_bytes()).next().unwrap().unwrap() }
}

#[test]
fn a_recorded_session_goes_on_from_the_one_before() {
    let mut world = world("A");
    world.set_learns_style(false).unwrap();
    world.hear("go to the red room").unwrap();
    while !world.plan(1_000).unwrap() {}
    world.act().unwrap();
    world.judge("punish").unwrap();
    let log = world.log(false).unwrap();
    let mut again = recorded(&log, true);
    again.header.continues = true;
    let [mut once, mut twice, mut aside] = [1, 2, 3].map(|seed| World::new(seed).unwrap());
    once.replay(&recorded(&log, true)).unwrap();
    twice.replay(&recorded(&log, false)).unwrap();
    twice.replay(&again).unwrap();
    aside.replay(&recorded(&log, false)).unwrap();
    assert_eq!([once.sessions(), twice.sessions(), aside.sessions()], [1, 1, 0]);
    // The second session is evidence on top of the first.
    assert_ne!(once.heat(), twice.heat());
    assert!(World::new(1).unwrap().replay(&again).is_err());
}

#[test]
fn a_recorded_prior_takes_the_place_of_what_the_words_say() {
    let mut world = world("A");
    let home = world.environment();
    let mut begin = |task: &str| {
        world.begin_recorded(&home, "go there", false, false).unwrap();
        world.recorded_prior(task, &[0.5]).map(|()| {
            assert!(!world.replay_on(1, true).unwrap(), "the command alone was heard");
            [0, 1].map(|task| world.agent().belief().probability(task))
        })
    };
    assert_eq!(begin("agentInRoom(agent0,room1)").unwrap(), [1.0, 0.0]);
    assert!(begin("agentInRoom(agent0,room9)").unwrap_err().0.contains("room9"));
}

#[test]
fn a_recorded_prior_leaves_what_is_believed_of_the_trainer_to_the_last_bit() {
    let mut world = world("A");
    world.set_learns_style(true).unwrap();
    train(&mut world, "go to the red room", "agentInRoom(agent0,room2)");
    let believed = |world: &World| {
        let style = world.belief().trainer;
        [style.good, style.bad, style.mistakes, style.late].map(f32::to_bits)
    };
    world.reset();
    let before = believed(&world);
    world.hear("go to the red room").unwrap();
    let mut session = recorded(&world.log(true).unwrap(), true);
    session.header.prior = Some(vec![("agentInRoom(agent0,room1)".parse().unwrap(), 1.0)]);
    world.replay(&session).unwrap();
    assert_eq!(believed(&world), before);
}

#[test]
fn what_is_dropped_leaves_the_robot_as_it_was_and_its_trainer_too() {
    let mut world = world("D");
    train(&mut world, "take the blue chair to the yellow room", "blockInRoom(block0,room2)");
    world.hear("go to the yellow room").unwrap();
    world.forget();
    let before = world.save().unwrap();
    world.hear("go to the yellow room").unwrap();
    for _ in 0..3 {
        while !world.plan(1_000).unwrap() {}
        world.act().unwrap();
        world.judge("punish").unwrap();
    }
    world.forget();
    assert_eq!(world.save().unwrap(), before);
}

/// Hears unknown words where much could be meant, until the robot asks.
fn questioned(world: &mut World) -> goodbot_wasm::view::Question {
    world.hear("abrakadabra").unwrap();
    while !world.plan(1_000).unwrap() {}
    loop {
        if let Some(question) = world.question(1_000).unwrap() {
            return question.expect("it has something to ask");
        }
    }
}

#[test]
fn an_answer_stands_in_the_log_and_the_log_believes_the_same() {
    let mut first = world("Test");
    let question = questioned(&mut first);
    let choice = question.about == About::WhichObject || question.about == About::WhichTask;
    first.answer(if choice { "1" } else { "yes" }).unwrap();
    let believed = first.belief().tasks;
    let log = first.log(false).unwrap();
    let answer = log.lines().find(|line| line.contains("\"answer\"")).unwrap();
    let sessions: Vec<_> = SessionReader::new(log.as_bytes()).collect::<Result<_, _>>().unwrap();
    assert_eq!(sessions[0].answers.len(), 1);
    let mut second = world("Test");
    second.hear("abrakadabra").unwrap();
    let recorded = &sessions[0].answers[0].answer;
    let names: Vec<String> = recorded.tasks.iter().map(ToString::to_string).collect();
    second.answer_as(&names.join("\n"), recorded.yes, recorded.eta as f32, recorded.others, "").unwrap();
    assert_eq!(second.belief().tasks, believed, "{answer}");
    assert!(second.log(false).unwrap().contains(answer));
    assert!(second.answer_as("agentInRoom(agent0,room9)", true, 0.05, 1, "").unwrap_err().0.contains("room9"));
}

#[test]
fn while_a_question_waits_for_its_answer_no_other_is_asked() {
    let mut world = world("Test");
    let first = questioned(&mut world);
    assert_eq!(world.question(u32::MAX).unwrap(), Some(None));
    assert_eq!(world.open_question(), Some(first));
}

#[test]
fn an_answer_to_no_question_or_of_no_kind_is_refused() {
    let mut world = world("Test");
    assert!(world.answer("yes").is_err());
    questioned(&mut world);
    assert!(world.answer("perhaps").unwrap_err().0.contains("perhaps"));
    assert!(world.answer("0").is_err());
    assert!(world.answer("99").is_err());
    assert!(world.open_question().is_some(), "the question still waits");
}

#[test]
fn the_next_lesson_is_the_one_with_the_word_that_was_heard_least() {
    let mut world = world("A");
    train(&mut world, "go to the green room", "agentInRoom(agent0,room1)");
    let next =
        world.next_lesson("go to the green room\ngo to the red room", "go to the green room\ntake it to the red room").unwrap().unwrap();
    assert_eq!((next.lesson, next.word.as_str(), next.needed, next.heard), (1, "red", 1, 0));
    let known = world.next_lesson("go to the green room", "Green!").unwrap().unwrap();
    assert_eq!((known.word.as_str(), known.heard), ("green", 1));
    assert_eq!(world.next_lesson("go to the green room", "coffee").unwrap(), None);
}

/// A new robot in the home of the tests, with the starter of a language.
fn half_taught(language: &str) -> World {
    let mut world = world("Test");
    world.set_starter(language);
    while !world.learn(10_000) {}
    world
}

/// The bits of what a robot believes on a command.
fn believed(world: &mut World, command: &str) -> Vec<u32> {
    let home = world.environment();
    world.asked(&home, command).unwrap().tasks.iter().map(|task| task.probability.to_bits()).collect()
}

#[test]
fn a_robot_with_a_starter_is_sure_of_everyday_sentences_before_its_first_lesson() {
    for (language, go, take) in [
        ("en", "go to the green room", "take the chair to the yellow room"),
        ("de", "geh in den grünen Raum", "bring den Stuhl in den gelben Raum"),
        ("fr", "va dans la pièce verte", "porte la chaise dans la pièce jaune"),
        ("es", "ve a la habitación verde", "lleva la silla a la habitación amarilla"),
        ("zh", "去绿色的房间", "把椅子搬到黄色的房间"),
    ] {
        let [mut knowing, mut new] = [half_taught(language), half_taught("")];
        let scene = knowing.scene();
        let room = |color| &scene.rooms.iter().find(|room| room.color == color).unwrap().name;
        let chair = &scene.blocks.iter().find(|block| block.shape == "chair").unwrap().name;
        for (command, wanted) in
            [(go, format!("agentInRoom(agent0,{})", room("green"))), (take, format!("blockInRoom({chair},{})", room("yellow")))]
        {
            let home = knowing.environment();
            let sure = |world: &mut World| {
                let belief = world.asked(&home, command).unwrap();
                belief.tasks.iter().find(|task| task.name == wanted).unwrap().probability
            };
            assert!(sure(&mut knowing) > 0.5 && sure(&mut new) < 0.3, "{command}: {} {}", sure(&mut knowing), sure(&mut new));
        }
        assert_eq!((knowing.sessions(), knowing.save().unwrap()), (0, new.save().unwrap()), "the sentences are not saved");
    }
}

#[test]
fn a_robot_with_a_starter_comes_back_from_its_model_and_from_its_log_to_the_last_bit() {
    let mut first = half_taught("en");
    let begun = first.agent().language().bitext().sessions();
    let mut log = String::new();
    for (command, meant) in [("go to the red room", "agentInRoom(agent0,room1)"), ("off to red with you", "agentInRoom(agent0,room1)")] {
        log += &train(&mut first, command, meant);
        first.reset();
    }
    assert_eq!(first.sessions(), 2);
    assert!(first.agent().language().bitext().sessions() < begun, "the sentences fade");
    let [mut restored, mut replayed] = ["en", "en"].map(half_taught);
    restored.restore(&first.save().unwrap()).unwrap();
    while !restored.learn(10_000) {}
    for session in SessionReader::new(log.as_bytes()) {
        replayed.replay(&session.unwrap()).unwrap();
    }
    let known = believed(&mut first, "go to the blue room");
    for other in [&mut restored, &mut replayed] {
        assert_eq!(other.save().unwrap(), first.save().unwrap());
        assert_eq!(believed(other, "go to the blue room"), known);
    }
    restored.set_ways(true).unwrap();
    restored.set_ways(false).unwrap();
    restored.set_starter("");
    restored.set_starter("en");
    while !restored.learn(10_000) {}
    assert_eq!(believed(&mut restored, "go to the blue room"), known);
    restored.restart().unwrap();
    assert_eq!((restored.sessions(), restored.starter().as_str()), (0, ""));
}

#[test]
fn a_robot_with_a_starter_takes_over_lessons_and_a_trainer() {
    let [mut first, mut other] = ["de", ""].map(half_taught);
    train(&mut other, "geh zum roten", "agentInRoom(agent0,room1)");
    let theirs = other.save().unwrap();
    for added in [1, 0] {
        assert_eq!(first.join(&theirs).unwrap(), added);
        while !first.learn(10_000) {}
        assert_eq!(first.sessions(), 1);
    }
    assert!(first.join(&theirs[1..]).is_err());
    while !first.learn(10_000) {}
    let mut same = half_taught("de");
    same.restore(&theirs).unwrap();
    while !same.learn(10_000) {}
    assert_eq!(believed(&mut first, "geh ins blaue Zimmer"), believed(&mut same, "geh ins blaue Zimmer"));
    first.set_learns_style(false).unwrap();
    let mut restored = half_taught("");
    restored.restore(&first.save().unwrap()).unwrap();
    assert!(!restored.learns_style());
}
