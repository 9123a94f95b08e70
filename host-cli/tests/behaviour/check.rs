//! `goodbot check`, and the errors of `goodbot replay` for the same files.

use crate::program;

use program::{AGENT, END, ROOMS, Run, goodbot, goodbot_unheard, log, session, shown, step};

fn check(input: &[u8]) -> Run {
    goodbot(&["check", "-"], input)
}

/// An environment on lines of its own: line 2 has the rooms, each further object a line.
fn environment(objects: &[&str]) -> Vec<u8> {
    format!("{{\"version\":1,\"objects\":[\n{ROOMS},\n{}\n]}}\n", objects.join(",\n")).into_bytes()
}

#[track_caller]
fn assert_refused(input: &[u8], messages: &[&str]) {
    let run = check(input);
    assert_eq!(run.code, 2, "{} {}", run.output, run.messages);
    let lines: Vec<&str> = run.messages.lines().collect();
    assert_eq!(lines.len(), messages.len(), "{}", run.messages);
    for (line, message) in lines.iter().zip(messages) {
        assert_eq!(line.strip_prefix("standard input:"), Some(*message));
    }
}

/// As `assert_refused`, and a replay refuses the log with the same words.
#[track_caller]
fn assert_refused_by_both(input: &[u8], message: &str) {
    assert_refused(input, &[message]);
    let run = goodbot(&["replay", "-"], input);
    assert_eq!(run.code, 2);
    assert_eq!(run.messages.trim_end().strip_prefix("standard input:"), Some(message));
}

fn block(name: &str, x: i32, y: i32) -> String {
    format!(r#"{{"class":"block","name":"{name}","x":{x},"y":{y},"color":"tan","shape":"star"}}"#)
}

#[test]
fn a_sound_environment_and_a_sound_log_have_no_fault() {
    let run = check(&environment(&[AGENT, &block("block0", 2, 2)]));
    assert_eq!((run.code, run.output.as_str()), (0, "standard input: a home, no fault\n"));
    let run = check(&log([&session(AGENT, "feedback", "go", ""), &step("north", "reward"), END]));
    assert_eq!((run.code, run.output.as_str()), (0, "standard input: 1 session of 1 step, no fault\n"));
}

#[test]
fn a_home_without_an_agent_is_refused() {
    assert_refused(&environment(&[&block("block0", 2, 2)]), &[r#"1: field "objects": there is no agent; add one, inside a room"#]);
}

#[test]
fn a_second_agent_is_refused_on_its_line() {
    let second = r#"{"class":"agent","name":"agent1","x":3,"y":3}"#;
    let message = r#"4: field "objects[4]": object "agent1": there is an agent already; a home has one"#;
    assert_refused(&environment(&[AGENT, second]), &[message]);
}

#[test]
fn each_block_inside_a_wall_is_refused_on_its_line() {
    let objects = [&block("block0", 0, 2), AGENT, &block("block1", 5, 4)];
    let in_wall = "it is in a wall or outside every room; move it inside a room or into a doorway";
    let messages =
        [format!(r#"3: field "objects[3]": object "block0": {in_wall}"#), format!(r#"5: field "objects[5]": object "block1": {in_wall}"#)];
    assert_refused(&environment(&objects), &[&messages[0], &messages[1]]);
}

#[test]
fn an_agent_outside_every_room_is_refused() {
    let message =
        r#"3: field "objects[3]": object "agent0": it is in a wall or outside every room; move it inside a room or into a doorway"#;
    assert_refused(&environment(&[r#"{"class":"agent","name":"agent0","x":40,"y":2}"#]), &[message]);
}

#[test]
fn a_room_of_no_area_is_refused() {
    let room = r#"{"class":"room","name":"room2","left":8,"bottom":0,"right":9,"top":4,"color":"teal"}"#;
    let message = r#"4: field "objects[4]": object "room2": the room has no cell inside; its right must be at least left + 2 and its top at least bottom + 2"#;
    assert_refused(&environment(&[AGENT, room]), &[message]);
}

#[test]
fn ten_thousand_objects_are_refused_with_the_limit() {
    let blocks: Vec<String> = (0..10_000).map(|number| block(&format!("block{number}"), 2, 2)).collect();
    let mut objects: Vec<&str> = vec![AGENT];
    objects.extend(blocks.iter().map(String::as_str));
    let run = check(&environment(&objects));
    assert_eq!(run.code, 2);
    assert!(
        run.messages.contains("standard input:1: field \"objects\": are 10004, and 96 are the most; leave out some\n"),
        "{}",
        run.messages
    );
    assert_eq!(run.messages.lines().count(), 1);
}

#[test]
fn a_command_of_ten_thousand_words_is_warned_of_and_ends_no_run() {
    let input = log([&session(AGENT, "feedback", &"go ".repeat(10_000), ""), &step("north", "reward"), END]);
    let run = check(&input);
    assert!(
        run.code == 0 && run.messages.contains(r#"1: field "command": warning: has 10000 words; its first 64 are read"#),
        "{}",
        run.messages
    );
    assert_eq!(goodbot(&["replay", "--json", "-"], &input).code, 0);
}

#[test]
fn an_empty_command_is_refused() {
    let input = log([&session(AGENT, "feedback", " . ", ""), END]);
    assert_refused_by_both(&input, r#"1: field "command": the command has no word; say what to do"#);
}

#[test]
fn invalid_utf8_is_refused_on_its_line() {
    let mut input = log([&session(AGENT, "feedback", "go", "")]);
    input.extend(b"{\"type\":\"step\",\"action\":\"n\xff\"}\n");
    assert_refused(&input, &["2: is not UTF-8; save the file in UTF-8"]);
    let run = goodbot(&["replay", "-"], &input);
    assert_eq!((run.code, run.messages.trim_end()), (2, "standard input:2: is not UTF-8; save the file in UTF-8"));
}

#[test]
fn an_environment_in_invalid_utf8_or_with_nan_is_refused_on_its_line() {
    let mut input = environment(&[AGENT]);
    let cut = input.len() - 10;
    input[cut] = 0xff;
    assert_refused(&input, &["3: is not UTF-8; save the file in UTF-8"]);
    let nan = check(&environment(&[r#"{"class":"agent","name":"agent0","x":NaN,"y":3}"#]));
    assert_eq!(nan.code, 2);
    assert!(nan.messages.starts_with("standard input:3: is not JSON"), "{}", nan.messages);
}

#[test]
fn strategies_that_are_no_probabilities_are_refused() {
    let with = |mu: &str| {
        let more = format!(r#","strategies":[{{"name":"odd","mu_plus":{mu},"mu_minus":0.7,"epsilon":0.1,"prior":1}}]"#);
        log([&session(AGENT, "feedback", "go", &more), END])
    };
    let message = r#"1: field "strategies[0].mu_plus": 1.5 is no probability; write a number from 0 to 1"#;
    assert_refused_by_both(&with("1.5"), message);
    let run = check(&with("NaN"));
    assert_eq!(run.code, 2);
    assert!(run.messages.starts_with("standard input:1: is not JSON"), "{}", run.messages);
    assert!(run.messages.contains("JSON has no NaN"), "{}", run.messages);
}

#[test]
fn a_log_that_is_cut_is_refused() {
    let whole = log([&session(AGENT, "feedback", "go", ""), &step("north", "reward"), END]);
    let without_end = whole.len() - END.len() - 1;
    let message = "1: the session that begins here is not ended when the file ends; add an end line";
    assert_refused_by_both(&whole[..without_end], message);
    let message = "3: the text ends in the middle of a value; complete it, or remove what is left of it";
    assert_refused_by_both(&whole[..whole.len() - 5], message);
}

#[test]
fn an_unknown_action_is_refused() {
    let input = log([&session(AGENT, "feedback", "go", ""), &step("jump", "reward"), END]);
    let message = r#"2: field "action": "jump" is no action of this session; write "north", "south", "east", "west" or noop, or name it in the session's "actions""#;
    assert_refused_by_both(&input, message);
    let input = log([&session(AGENT, "feedback", "go", r#","actions":["north","jump"]"#), &step("jump", "reward"), END]);
    let message = r#"1: field "actions": a home has the actions north, south, east and west, and may have pull; name these four or five"#;
    assert_refused_by_both(&input, message);
}

#[test]
fn a_step_after_the_end_is_refused() {
    let input = log([&session(AGENT, "feedback", "go", ""), END, &step("north", "reward")]);
    let message = "3: a step comes after the end of its session; move it before the end line, or begin a session";
    assert_refused(&input, &[message]);
}

#[test]
fn a_pull_of_nothing_is_refused_on_its_line() {
    let more = r#","actions":["north","south","east","west","pull"]"#;
    let input = log([&session(AGENT, "feedback", "go", more), &step("south", "reward"), &step("pull", "reward"), END]);
    let message = r#"3: field "action": "pull" cannot be done here, where the agent is at 2, 2: no block beside it has a wall or another block on its far side; correct the steps, or leave out the session"#;
    assert_refused_by_both(&input, message);
}

#[test]
fn a_demonstration_through_a_wall_is_warned_of_and_replayed_with_a_remark() {
    let input = log([&session(AGENT, "demonstration", "go", ""), &shown("east"), &shown("north"), END]);
    let message = r#"3: field "action": warning: the demonstration walks into a wall or a held block: the agent stays at 3, 3; remove the step, or correct the steps before it"#;
    let run = check(&input);
    assert_eq!((run.code, run.messages.trim_end().strip_prefix("standard input:")), (0, Some(message)));
    assert_eq!(run.output, "standard input: 1 session of 2 steps, no fault, 1 warning\n");
    let run = goodbot(&["replay", "-"], &input);
    assert_eq!(run.code, 0);
    assert!(run.messages.starts_with("standard input:3: the demonstration walks into a wall"), "{}", run.messages);
}

#[test]
fn tasks_that_cannot_be_meant_here_are_refused() {
    let intended = |atom: &str| log([&session(AGENT, "feedback", "go", &format!(r#","intended":["{atom}"]"#)), END]);
    let field = r#"1: field "intended[0]":"#;
    let missing = r#"there is no object "block0"; name a block of the environment"#;
    assert_refused_by_both(&intended("blockInRoom(block0,room1)"), &format!("{field} {missing}"));
    let wrong = r#""door0" is no room; name a room of the environment"#;
    assert_refused_by_both(&intended("agentInRoom(agent0,door0)"), &format!("{field} {wrong}"));
    let unknown = r#""flies" is no propositional function; known are agentInRoom, blockInRoom, agentInDoor, blockInDoor"#;
    assert_refused_by_both(&intended("flies(agent0)"), &format!("{field} {unknown}"));
    let done = r#"1: field "intended": holds where the session begins already, so there is nothing to do; correct it or the environment"#;
    assert_refused_by_both(&intended("agentInRoom(agent0,room0)"), done);
}

#[test]
fn a_prior_of_a_task_that_holds_already_is_refused() {
    let input = log([&session(AGENT, "feedback", "go", r#","prior":{"agentInRoom(agent0,room0)":1}"#), END]);
    let message = r#"1: field "prior.agentInRoom(agent0,room0)": is no task here: it holds at the beginning already, names an object that is not here, or is of a kind not asked for; remove it, or name its kind with --task"#;
    assert_refused_by_both(&input, message);
}

#[test]
fn every_broken_session_of_a_log_is_told() {
    let empty = session(AGENT, "feedback", "", "");
    let input = log([&empty, END, &session(AGENT, "feedback", "go", ""), &step("jump", "reward"), END, &empty, END]);
    let run = check(&input);
    let lines: Vec<&str> = run.messages.lines().map(|line| line.split(' ').nth(1).unwrap()).collect();
    assert_eq!(lines, ["input:1:", "input:4:", "input:6:"]);
}

#[test]
fn a_file_that_is_not_there_is_told() {
    for command in ["check", "replay"] {
        let run = goodbot(&[command, "no such file"], b"");
        assert_eq!(run.code, 2);
        assert!(run.messages.contains("no such file: cannot be read ("), "{}", run.messages);
    }
}

#[test]
fn a_reader_that_leaves_is_no_fault() {
    let input = log([&session(AGENT, "feedback", "go", ""), &step("north", "reward"), END]);
    for arguments in [["check", "-"].as_slice(), &["replay", "-"], &["replay", "--json", "-"]] {
        assert_eq!(goodbot_unheard(arguments, &input), (0, String::new()));
    }
}

#[test]
fn an_empty_file_is_told() {
    let run = check(b"");
    assert_eq!(run.code, 2);
    assert!(run.messages.contains("there is nothing here"), "{}", run.messages);
}

#[test]
fn what_a_replay_wrote_is_sound_and_a_wrong_belief_is_told() {
    let run = goodbot(&["replay", "--json", "-"], &log([&session(AGENT, "feedback", "go", ""), &step("north", "reward"), END]));
    assert_eq!(check(run.output.as_bytes()).output, "standard input: 2 beliefs, no fault\n");
    let wrong = run.output.replacen("\"step\":1", "\"step\":-1", 1);
    assert_refused(wrong.as_bytes(), &[r#"2: field "step": -1 is no count; write a whole number from 0"#]);
}

#[test]
fn a_prior_over_tasks_of_another_kind_is_sound_where_the_kind_is_named() {
    let block = block("block0", 2, 2);
    let prior = r#","prior":{"agentInRoom(agent0,room0) & blockInRoom(block0,room1)":1}"#;
    let input = log([&session(&format!("{AGENT},{block}"), "feedback", "go", prior), END]);
    assert_eq!(check(&input).code, 2);
    assert_eq!(goodbot(&["check", "--task", "agentInRoom(?a,?r1) & blockInRoom(?o,?r2)", "-"], &input).code, 0);
}

/// The warnings of a check that finds no fault.
#[track_caller]
fn warnings(input: &[u8]) -> Vec<String> {
    let run = check(input);
    assert_eq!(run.code, 0, "{}", run.messages);
    run.messages.lines().map(|line| line.split_once("warning: ").unwrap().1.to_owned()).collect()
}

#[test]
fn what_is_allowed_and_hardly_meant_is_warned_of() {
    let overlapping = r#"{"class":"room","name":"room2","left":6,"bottom":6,"right":12,"top":10,"color":"tan"}"#;
    assert!(warnings(&environment(&[AGENT, overlapping]))[0].starts_with("room2: it overlaps room1"));
    let apart = r#"{"class":"room","name":"room2","left":20,"bottom":0,"right":24,"top":4,"color":"tan"}"#;
    assert_eq!(warnings(&environment(&[AGENT, apart])), ["room2: the agent cannot get there; add a door"]);
    let nowhere = r#"{"class":"door","name":"door1","left":8,"bottom":2,"right":8,"top":2}"#;
    assert_eq!(warnings(&environment(&[AGENT, nowhere])), ["door1: the door leads nowhere; put it into a wall between two rooms"]);
    let colourless = block("block0", 2, 2).replace("tan", "");
    assert_eq!(warnings(&environment(&[AGENT, &colourless])), ["block0: its color is empty, so no word can name it; give it one"]);
    let twice = log([&session(AGENT, "feedback", "go", ""), END, &session(AGENT, "feedback", "walk", ""), END]);
    assert_eq!(warnings(&twice), ["is on line 1 already; give each session an id of its own"]);
    let half = session(AGENT, "feedback", "go", r#","prior":{"agentInRoom(agent0,room1)":0.5}"#);
    assert_eq!(warnings(&log([&half, END])), ["the probabilities sum to 0.500000 and not to 1; they are divided by their sum"]);
}

#[test]
fn findings_can_be_read_by_programs() {
    let apart = r#"{"class":"room","name":"room2","left":20,"bottom":0,"right":24,"top":4,"color":"tan"}"#;
    let run = goodbot(&["check", "--json", "-"], &environment(&[AGENT, apart]));
    let lines: Vec<serde_json::Value> = run.output.lines().map(|line| serde_json::from_str(line).unwrap()).collect();
    assert_eq!((run.code, run.messages.as_str(), lines.len()), (0, "", 2));
    assert_eq!((&lines[0]["type"], &lines[0]["line"], &lines[0]["field"]), (&"warning".into(), &4.into(), &"objects[4]".into()));
    assert_eq!((&lines[1]["type"], &lines[1]["faults"], &lines[1]["warnings"]), (&"file".into(), &0.into(), &1.into()));
    let run = goodbot(&["check", "--json", "-"], b"{}");
    assert_eq!(run.code, 2);
    assert!(run.output.starts_with(r#"{"type":"fault","file":"standard input","line":1,"#), "{}", run.output);
}

#[test]
fn a_session_is_judged_alike_by_all_who_read_it() {
    let kind = r#","intended":["agentInRoom(agent0,room0)","blockInRoom(block0,room1)"]"#;
    let input = log([&session(&format!("{AGENT},{}", block("block0", 2, 2)), "feedback", "go", kind), END]);
    let message =
        "standard input:1: field \"intended\": is no task of the kinds that commands may mean; name its kind with --task, or correct it";
    let model = std::env::temp_dir().join(format!("goodbot-alike-{}", std::process::id()));
    for arguments in [&["check", "-"][..], &["replay", "-"], &["evaluate", "-"], &["learn", "-", "--out", model.to_str().unwrap()]] {
        let run = goodbot(arguments, &input);
        assert_eq!(run.code, 2, "{arguments:?}");
        assert!(run.messages.contains(message), "{arguments:?} {}", run.messages);
    }
}

#[test]
fn a_table_of_closed_words_is_checked_too() {
    let run = check(goodbot(&["example", "closed-words"], b"").output.as_bytes());
    assert_eq!(run.code, 0, "{}", run.messages);
    assert!(run.output.starts_with("standard input: a table of ") && run.output.ends_with(" closed words, no fault\n"), "{}", run.output);
    let messages = [
        "2: \"colour\" is no class of words",
        "3: write \"Halt\" in lower case and without punctuation",
        "4: write a class and a colon before \"wait\"",
    ];
    assert_refused(b"# My words\ncolour: red\nstop: Halt\nwait\n", &messages);
    assert_refused(
        b"yes: yes ok\n\nno: ok no\n",
        &["1: \"ok\" praises or agrees, and another line has it for the opposite; leave it in one of them"],
    );
    assert!(goodbot(&["learn", "-", "--out", "-"], b"no: no\n").messages.contains("this is a table of closed words, not a session log"));
}

#[test]
fn no_more_of_a_log_is_read_than_the_limit_says() {
    let sound = |id: &str| session(AGENT, "feedback", "go", r#","intended":["agentInRoom(agent0,room1)"]"#).replace(r#""id":"s""#, id);
    let north = step("north", "reward");
    let input = log([&sound(r#""id":"a""#), &north, END, &sound(r#""id":"b""#), &north, END, "broken"]);
    let checked = |limit: &str| goodbot(&["check", "-", "--limit", limit], &input);
    assert_eq!(checked("1").output, "standard input: 1 session of 1 step, as far as --limit, no fault\n");
    assert_eq!(checked("2").code, 0);
    assert_eq!(checked("3").code, 2);
    let folder = tempfile::tempdir().unwrap();
    let model = folder.path().join("words.goodbot");
    for command in [&["replay", "-"][..], &["learn", "-", "--out", model.to_str().unwrap()], &["evaluate", "-"]] {
        let run = |limit: &str| goodbot(&[command, &["--limit", limit]].concat(), &input);
        let (two, three) = (run("2"), run("3"));
        assert_eq!((two.code, three.code), (0, 2), "{command:?}: {} {}", two.messages, three.messages);
    }
    let none = checked("0");
    assert!(none.code == 2 && none.messages.contains("give a whole number of 1 or more"), "{}", none.messages);
}

#[test]
fn a_home_drawn_as_text_is_checked_too() {
    let drawing = goodbot(&["example", "map"], b"").output;
    assert_eq!(check(drawing.as_bytes()).output, "standard input: a home, drawn as text, no fault\n");
    let run = check(drawing.replace("C: yellow chair", "").as_bytes());
    assert_eq!(run.code, 2);
    assert!(run.messages.starts_with("standard input:7: block C has no colour and shape"), "{}", run.messages);
}

/// A labelled session whose task has a way.
fn way(more: &str) -> Vec<u8> {
    let header = session(AGENT, "labelled", "around to the green room", &format!(r#","intended":["agentInRoom(agent0,room1)"]{more}"#));
    log([&header, END])
}

#[test]
fn a_way_through_a_room_that_is_not_there_is_refused() {
    let run = check(&way(r#","through":[["agentInRoom(agent0,room7)"]]"#));
    assert_eq!(run.code, 2);
    assert!(run.messages.contains("through[0][0]") && run.messages.contains("room7"), "{}", run.messages);
}

#[test]
fn a_way_that_avoids_its_own_goal_is_refused() {
    let run = check(&way(r#","avoiding":["agentInRoom(agent0,room1)"]"#));
    assert_eq!(run.code, 2);
    let message = "avoids agentInRoom(agent0,room1), which it asks for as well; remove the one or the other";
    assert!(run.messages.contains(message), "{}", run.messages);
}

#[test]
fn nine_clauses_are_refused_in_a_log_and_as_a_kind_of_task() {
    let clauses = [r#"["agentInRoom(agent0,room0)"]"#; 9].join(",");
    let run = check(&way(&format!(r#","through":[{clauses}]"#)));
    assert_eq!(run.code, 2);
    assert!(run.messages.contains("has 10 propositions with its way, and 4 are the most; leave out clauses"), "{}", run.messages);
    let kind = format!("agentInRoom(?a,?goal){}", " through agentInRoom(?a,?via)".repeat(9));
    let run = goodbot(&["check", "--task", &kind, "-"], b"");
    assert_eq!(run.code, 2);
    assert!(run.messages.contains("PROPOSITIONS_PER_TASK"), "{}", run.messages);
}

#[test]
fn what_one_option_mends_is_told_once_with_its_count() {
    let both = r#","intended":["agentInRoom(agent0,room1)","blockInRoom(block0,room1)"]"#;
    let told = session(&format!("{AGENT},{}", block("block0", 2, 2)), "labelled", "go", both);
    let lines: Vec<&str> = std::iter::repeat_n([told.as_str(), END], 150).flatten().collect();
    let input = (lines.join("\n") + "\n").into_bytes();
    let fault = r#"1: field "intended": is no task of the kinds that commands may mean; name its kind with --task, or correct it"#;
    assert_refused(&input, &[&format!("{fault}; and 149 lines like it")]);
    let json = goodbot(&["check", "--json", "-"], &input);
    assert_eq!(json.output.lines().filter(|line| line.contains(r#""type":"fault""#)).count(), 150, "each is a line of JSON");
}
