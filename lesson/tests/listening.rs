//! A live session that began by listening, and its record: replayed, it gives the same belief and the same model, to the bit.

use goodbot::feedback::Feedback;
use goodbot::home::{Moves, paper_tasks};
use goodbot::memory::AgentHeap;
use goodbot::session::Phase;
use goodbot::talk::Said;
use goodbot::talk::{Class, ClosedWords, Hypothesis, Verdict};
use goodbot::task::TaskSet;
use goodbot::{Agent, AgentError, Capacities, Options};
use goodbot_formats::environment::EnvironmentFile;
use goodbot_formats::session::{RecordedSession, SessionReader};
use goodbot_lesson::live::Lesson;
use goodbot_lesson::replay::{Event, Replay, Rules};
use goodbot_lesson::{checked, home};
use rand_pcg::Pcg32;
use std::cell::Cell;

const COLORS: [[&str; 3]; 6] = [
    ["red", "blue", "green"],
    ["blue", "green", "red"],
    ["green", "red", "blue"],
    ["red", "green", "blue"],
    ["blue", "red", "green"],
    ["green", "blue", "red"],
];

/// Three rooms in a row, with two things that the robot can push along.
fn home_of(colors: [&str; 3], things: [(&str, &str); 2]) -> EnvironmentFile {
    let room = |at: usize| {
        let left = at * 6;
        format!(r#"{{"class":"room","name":"room{at}","left":{left},"bottom":0,"right":{},"top":6,"color":"{}"}}"#, left + 6, colors[at])
    };
    let door = |at: usize| format!(r#"{{"class":"door","name":"door{at}","left":{0},"bottom":3,"right":{0},"top":3}}"#, at * 6);
    let thing = |at: usize| {
        let (color, shape) = things[at];
        format!(r#"{{"class":"block","name":"block{at}","x":3,"y":{},"color":"{color}","shape":"{shape}"}}"#, 3 - at)
    };
    let robot = r#"{"class":"agent","name":"agent0","x":1,"y":4}"#.to_owned();
    let objects = [room(0), room(1), room(2), door(1), door(2), thing(0), thing(1), robot];
    EnvironmentFile::parse(&format!(r#"{{"version":1,"objects":[{}]}}"#, objects.join(","))).expect("a home")
}

fn rooms() -> EnvironmentFile {
    home_of(COLORS[0], [("yellow", "chair"), ("purple", "chair")])
}

/// A robot that was told what 60 commands mean, each in a home of its own.
fn taught() -> Lesson {
    let lifted = paper_tasks().expect("tasks");
    let mut agent = Agent::new(AgentHeap::new(&Capacities::STANDARD), &lifted, Options::DEFAULT).expect("an agent");
    for lesson in 0..60 {
        let (colors, room) = (COLORS[lesson % 6], 1 + lesson / 6 % 2);
        let shapes = [["chair", "bag"], ["bag", "chair"]][lesson / 2 % 2];
        let of_things = [["yellow", "purple"], ["purple", "yellow"]][lesson / 3 % 2];
        let things = [0, 1].map(|at| (of_things[at], shapes[at]));
        let (place, start) = home::build(&home_of(colors, things), Moves::Push, home::memory()).expect("a home");
        let ((color, shape), thing) = (things[lesson / 5 % 2], lesson / 5 % 2);
        let (command, task) = match lesson % 4 {
            0 => (format!("go to the {} room", colors[room]), format!("agentInRoom(agent0,room{room})")),
            1 => (format!("walk into the {} room", colors[room]), format!("agentInRoom(agent0,room{room})")),
            2 => (format!("take the {color} {shape} to the {} room", colors[room]), format!("blockInRoom(block{thing},room{room})")),
            _ => (format!("bring the {color} {shape} to the {} room", colors[room]), format!("blockInRoom(block{thing},room{room})")),
        };
        agent.hear(&place, &start, &command).expect("a command");
        let told = agent.task_named(&place, &task).expect("a task");
        let _ = agent.answered(TaskSet::of(told), true, 1e-6, 1).expect("an answer");
        if agent.finish_for_later(&place).is_err() {
            let _ = agent.finish(&place).expect("learned");
        }
    }
    agent.begin_learning();
    agent.learn_fully();
    let (place, start) = home::build(&rooms(), Moves::Push, home::memory()).expect("a home");
    Lesson::new(agent, place, start)
}

/// Walks until the robot thinks that its task is done, and praises each step.
fn walk(lesson: &mut Lesson, random: &mut Pcg32) {
    for _ in 0..60 {
        while !lesson.plan(10_000).expect("a plan") {}
        let acted = lesson.act(random).expect("a step").clone();
        let right = acted.is_right(lesson.agent.most_likely().expect("a task")).unwrap_or(false);
        let _ = lesson.judge(if right { Feedback::Reward } else { Feedback::Punish }).expect("a word");
        if acted.plan.onward().is_none() {
            return;
        }
        lesson.go_on().expect("it goes on");
    }
    panic!("it does not arrive");
}

fn beliefs(agent: &Agent<AgentHeap>) -> Vec<u32> {
    (0..agent.tasks().len()).map(|task| agent.belief().probability(task).to_bits()).collect()
}

/// Replays a record with another robot, as from a log.
fn replayed(lesson: &mut Lesson, recorded: &RecordedSession) -> Vec<u32> {
    let log = recorded.to_lines().expect("lines").join("\n");
    let read = SessionReader::new(log.as_bytes()).next().expect("a session").expect("sound");
    assert_eq!(read.header, recorded.header);
    let lifted = paper_tasks().expect("tasks");
    let session = checked::check("log", &read, &lifted, home::memory()).unwrap_or_else(|faults| panic!("{faults:?}\n{log}"));
    let mut replay = Replay::new(Rules::AS_IT_WAS);
    while replay.advance(&mut lesson.agent, &session.walk, u32::MAX).expect("a walk") != Event::Ended {}
    let beliefs = beliefs(&lesson.agent);
    let _ = lesson.agent.finish(&session.walk.home).expect("learned");
    lesson.agent.learn_fully();
    beliefs
}

/// Ends a session, and replays its record with another robot.
fn end(lesson: &mut Lesson, other: &mut Lesson) {
    let recorded = lesson.recorded(true).expect("a session");
    // If people are expected, the end is evidence too; here it is not.
    let believed = beliefs(&lesson.agent);
    assert_eq!(replayed(other, &recorded), believed, "{:?}", recorded.header.command);
    let _ = lesson.finish().expect("learned");
    lesson.agent.learn_fully();
    assert!(lesson.agent.saved().expect("a model") == other.agent.saved().expect("a model"), "{:?}", recorded.header.command);
}

#[test]
fn each_part_of_what_was_said_is_replayed_to_the_bit() {
    let (mut lesson, mut other, mut random) = (taught(), taught(), Pcg32::new(1, 1));
    let listened = lesson.listen("leave the red room and go to the green room, and then to the blue room", rooms(), false).expect("heard");
    assert_eq!((listened.hypothesis, lesson.command()), (Hypothesis::Several, Some("leave the red room")));
    walk(&mut lesson, &mut random);
    end(&mut lesson, &mut other);
    assert_eq!(lesson.rest(), Some("go to the green room, and then to the blue room"));
    for command in ["go to the green room", "to the blue room"] {
        let now = lesson.environment();
        lesson.listen_on(now).expect("heard").expect("a part");
        assert_eq!(lesson.command(), Some(command));
        walk(&mut lesson, &mut random);
        // After a step back, the part is heard as before.
        let before = beliefs(&lesson.agent);
        lesson.go_on().expect("it goes on");
        while !lesson.plan(10_000).expect("a plan") {}
        lesson.act(&mut random).expect("a step");
        let _ = lesson.judge(Feedback::Punish).expect("a word");
        assert!(lesson.take_back().expect("a step back"));
        lesson.walk_on().expect("walked again");
        assert_eq!(beliefs(&lesson.agent), before);
        end(&mut lesson, &mut other);
    }
    assert!(!lesson.is_more() && lesson.listen_on(rooms()).expect("nothing").is_none());
}

#[test]
fn what_is_done_already_is_passed_over_and_the_part_behind_it_is_replayed() {
    let (mut lesson, mut other, mut random) = (taught(), taught(), Pcg32::new(1, 1));
    lesson.listen("first go to the red room and then go to the green room", rooms(), false).expect("heard");
    assert_eq!(lesson.command(), Some("go to the green room"), "it is in the red room");
    walk(&mut lesson, &mut random);
    end(&mut lesson, &mut other);
    assert_eq!(lesson.listen("go to the green room", rooms(), false).expect("heard").verdict, Verdict::Done);
    assert!(!lesson.is_under_way());
}

#[test]
fn all_things_are_brought_one_by_one() {
    let (mut lesson, mut other, mut random) = (taught(), taught(), Pcg32::new(1, 1));
    let listened = lesson.listen("bring all chairs to the blue room", rooms(), false).expect("heard");
    assert_eq!((listened.hypothesis, listened.tasks.iter().count()), (Hypothesis::All, 2));
    let mut things = Vec::new();
    while lesson.is_under_way() {
        walk(&mut lesson, &mut random);
        let task = lesson.agent.most_likely().expect("a task");
        things.push(lesson.name_of(task).expect("a name").to_string());
        end(&mut lesson, &mut other);
        let now = lesson.environment();
        lesson.listen_on(now).expect("heard");
    }
    things.sort();
    assert_eq!(things, ["blockInRoom(block0,room1)", "blockInRoom(block1,room1)"]);
}

#[test]
fn a_correction_is_replayed_to_the_bit() {
    let (mut lesson, mut other, mut random) = (taught(), taught(), Pcg32::new(1, 1));
    lesson.listen("go to the blue room", rooms(), false).expect("heard");
    while !lesson.plan(10_000).expect("a plan") {}
    lesson.act(&mut random).expect("a step");
    assert_eq!(lesson.said("no, the green one").expect("heard"), Said::Correction);
    let _ = lesson.correct("no, the green one").expect("taken in");
    lesson.go_on().expect("it goes on");
    assert_eq!(lesson.name_of(lesson.agent.most_likely().expect("a task")).expect("a name").to_string(), "agentInRoom(agent0,room2)");
    walk(&mut lesson, &mut random);
    end(&mut lesson, &mut other);
}

#[test]
fn tables_of_closed_words_may_be_empty_long_or_have_a_word_in_two_classes() {
    let mut lesson = taught();
    let (agent, home, state) = lesson.parts();
    let none = agent.listen(home, state, "go to the blue room", ClosedWords::new("").expect("a table")).expect("heard");
    assert_eq!((none.verdict, none.hypothesis), (Verdict::Sure, Hypothesis::Command), "no table: a command is one all the same");
    let both = ClosedWords::new("praise: fine\ngreeting: fine").expect("a table");
    assert!(both.of("fine").contains(Class::Praise) && both.of("fine").contains(Class::Greeting));
    let fine = agent.listen(home, state, "fine", both).expect("heard");
    assert_eq!(fine.verdict, Verdict::None, "whichever it is, it is no command");
    let lines: String = (0..10_000).map(|line| format!("polite: word{line}\n")).collect();
    let long = ClosedWords::new(&lines).expect("a table");
    assert!(long.of("word9999").contains(Class::Polite));
    let polite = agent.listen(home, state, "word9999 go to the blue room", long).expect("heard");
    assert_eq!((polite.verdict, polite.hypothesis), (Verdict::Sure, Hypothesis::Command));
    let wrong = format!("{lines}polite word");
    assert_eq!(ClosedWords::new(&wrong).expect_err("no table").to_string(), "line 10001: write a class and a colon before \"polite\"");
}

#[test]
fn words_that_point_back_are_followed_from_session_to_session_and_replayed_to_the_bit() {
    let (mut lesson, mut other, mut random) = (taught(), taught(), Pcg32::new(1, 1));
    lesson.name_conversation("said-1");
    let mut followed = Vec::new();
    for words in ["take the yellow chair to the blue room", "bring it to the green room", "go to the red room", "go back"] {
        let now = lesson.environment();
        let listened = lesson.listen(words, now, false).expect("heard");
        assert!(lesson.is_under_way(), "{words}: {listened:?}");
        let task = lesson.agent.most_likely().expect("a task");
        followed.push(lesson.name_of(task).expect("a name").to_string());
        walk(&mut lesson, &mut random);
        end(&mut lesson, &mut other);
    }
    let meant = ["blockInRoom(block0,room1)", "blockInRoom(block0,room2)", "agentInRoom(agent0,room0)", "agentInRoom(agent0,room2)"];
    assert_eq!(followed, meant);
    let facts = lesson.conversation().recorded(lesson.home(), lesson.agent.lifted()).expect("facts");
    let fact = |name: &str| facts.iter().find(|(known, _)| known == name).map(|(_, object)| object.as_str());
    assert_eq!((fact("id"), fact("last")), (Some("said-1"), Some("agentInRoom(agent0,room2)")));
    assert_eq!((fact("movedLast"), fact("wasThereBefore"), fact("robotWasThereBefore")), (Some("block0"), Some("room1"), Some("room0")));
}

#[test]
fn what_is_done_already_is_spoken_of_too() {
    let (mut lesson, mut random) = (taught(), Pcg32::new(1, 1));
    let listened = lesson.listen("take the yellow chair to the red room", rooms(), false).expect("heard");
    assert_eq!((listened.verdict, lesson.is_under_way()), (Verdict::Done, false));
    lesson.listen("bring it to the blue room", rooms(), false).expect("heard");
    let task = lesson.agent.most_likely().expect("a task");
    assert_eq!(lesson.name_of(task).expect("a name").to_string(), "blockInRoom(block0,room1)");
    // A finished task is remembered although it is not learned from.
    walk(&mut lesson, &mut random);
    lesson.forget();
    let now = lesson.environment();
    let listened = lesson.listen("bring it to the blue room", now, false).expect("heard");
    // It asks while it is young, and does nothing else.
    assert!(matches!(listened.verdict, Verdict::Done | Verdict::Unsure), "{listened:?}");
    assert_eq!(lesson.name_of(listened.task).expect("a name").to_string(), "blockInRoom(block0,room1)");
}

#[test]
fn a_conversation_begins_anew_where_things_are_put_elsewhere_and_can_be_gone_on_with() {
    let mut lesson = taught();
    assert_eq!(
        lesson.converse("said-7").expect_err("none").to_string(),
        "no conversation in this home is called \"said-7\"; none has begun yet: give a command first"
    );
    lesson.name_conversation("said-1");
    lesson.listen("go to the red room", rooms(), false).expect("heard");
    let facts = lesson.conversation().clone();
    assert!(!facts.facts.is_empty());
    lesson.converse_anew();
    assert!(lesson.conversation().facts.is_empty());
    lesson.name_conversation("said-2");
    assert_eq!(
        lesson.converse("said-7").expect_err("none").to_string(),
        "no conversation in this home is called \"said-7\"; known are said-1, said-2"
    );
    lesson.converse("said-1").expect("the first");
    assert_eq!(lesson.conversation(), &facts);
    lesson.converse("said-1").expect("the same");
    assert_eq!(lesson.conversation(), &facts);
    let state = *lesson.state();
    lesson.put(state);
    assert!(lesson.conversation().facts.is_empty() && lesson.conversations().count() == 0);
}

#[test]
fn a_log_with_a_conversation_that_cannot_be_is_refused_with_the_place() {
    let (mut lesson, lifted) = (taught(), paper_tasks().expect("tasks"));
    lesson.listen("go to the blue room", rooms(), false).expect("heard");
    let mut recorded = lesson.recorded(true).expect("a session");
    let mut faults = |facts: &[(&str, &str)]| {
        recorded.header.conversation = Some(facts.iter().map(|&(name, text)| (name.to_owned(), text.to_owned())).collect());
        let faults = checked::check("log", &recorded, &lifted, home::memory()).err().unwrap_or_default();
        faults.iter().map(ToString::to_string).collect::<Vec<_>>().join("\n")
    };
    assert_eq!(faults(&[("id", "said-1"), ("last", "agentInRoom(agent0,room0)"), ("namedLast", "room0")]), "");
    let last = ("last", "agentInRoom(agent0,room0)");
    assert_eq!(
        faults(&[last, ("movedLast", "block9")]),
        "log:1: field \"conversation.movedLast\": there is no object \"block9\"; name one of the environment"
    );
    assert!(
        faults(&[("last", "agentInRoom(agent0,room9)")]).contains("field \"conversation.last\": \"agentInRoom(agent0,room9)\" is no task")
    );
    assert!(faults(&[("last", "go")]).contains("field \"conversation.last\": \"go\" is no task"));
    assert!(faults(&[last, ("saidLast", "room0")]).contains("field \"conversation.saidLast\": is nothing that a conversation remembers"));
    assert!(faults(&[("namedLast", "room0")]).contains("needs the task that was followed last; write \"last\" too"));
}

#[test]
fn who_listens_in_parts_hears_the_same_to_the_bit_and_may_stop() {
    let mut lesson = taught();
    let (agent, home, state) = lesson.parts();
    for words in ["go to the green room and then take the yellow chair to the red room", "don't go to the blue room", "put it back"] {
        let heard = agent.listen(home, state, words, ClosedWords::ENGLISH).expect("heard");
        let whole = beliefs(agent);
        let parts = Cell::new(0);
        let count = || {
            parts.set(parts.get() + 1);
            true
        };
        let in_parts = agent.listen_in_parts(home, state, words, ClosedWords::ENGLISH, false, &count).expect("heard");
        assert_eq!((in_parts, beliefs(agent)), (heard, whole), "{words}");
        assert!(parts.get() >= agent.tasks().len(), "{words}: {parts:?}");
        parts.set(0);
        let stop = || {
            parts.set(parts.get() + 1);
            parts.get() < 5
        };
        let stopped = agent.listen_in_parts(home, state, words, ClosedWords::ENGLISH, false, &stop);
        assert_eq!((stopped, parts.get(), agent.phase()), (Err(AgentError::Stopped), 5, Phase::Idle), "{words}");
    }
}

#[test]
fn words_for_which_there_was_nothing_to_do_are_a_command_when_they_are_said_again() {
    let mut lesson = taught();
    let words = "where is the yellow chair";
    let listened = lesson.tell(words, rooms()).unwrap();
    assert!(listened.verdict == Verdict::None && !lesson.is_under_way());
    let _ = lesson.tell(words, rooms()).unwrap();
    assert!(lesson.is_under_way(), "this time it takes them for a command");
    assert!(lesson.is_under_way() && lesson.teaches());
    lesson.tell("don't go to the blue room", rooms()).unwrap();
    lesson.tell("don't go to the blue room", rooms()).unwrap();
    assert!(!lesson.is_under_way() && lesson.is_prohibition(), "a prohibition is never a command for it");
}

#[test]
fn what_would_change_something_is_no_command_where_nothing_was_before() {
    let lifted = paper_tasks().expect("tasks");
    let agent = Agent::new(AgentHeap::new(&Capacities::STANDARD), &lifted, Options::DEFAULT).expect("an agent");
    let (place, start) = home::build(&rooms(), Moves::Push, home::memory()).expect("a home");
    let untaught = Lesson::new(agent, place, start);
    let mut taught = taught();
    for words in
        ["no, the other one", "No, the blue one!", "forget it", "put it back", "nein, den anderen", "non, l'autre", "不，另一个", "放回去"]
    {
        for lesson in [&untaught, &taught] {
            assert_eq!(lesson.said(words), Ok(Said::Nothing(Class::Back)), "{words}");
        }
    }
    for words in ["bring it back to the blue room", "forget the red room", "no vayas a la habitación roja", "回红色的房间", "nozu bika"]
    {
        assert_eq!(untaught.said(words), Ok(Said::Command), "{words}");
    }
    assert_eq!(taught.said("no, go to the red room"), Ok(Said::Command));
    let now = taught.environment();
    let _ = taught.listen("take the yellow chair to the green room", now, false).expect("heard");
    walk(&mut taught, &mut Pcg32::new(1, 1));
    let _ = taught.finish().expect("learned");
    taught.agent.learn_fully();
    assert_eq!(taught.said("put it back"), Ok(Said::Command), "now there is something to put back");
}
