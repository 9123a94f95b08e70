//! Worlds from files, and logs of commands in them.

use crate::program::{Run, goodbot};
use serde_json::Value;
use std::fs;
use std::path::{Path, PathBuf};

/// Two rooms with a lamp and a fan each.
const WORLD: &str = r#"{"type":"world","name":"flat","classes":["lamp","fan","place"],"attributes":{"room":["lamp","fan"],"kind":["lamp","fan"]},"propositions":{"lampOn":["lamp"],"lampOff":["lamp"],"fanOn":["fan"],"fanOff":["fan"],"listenerIn":["place"]},"objects":[{"name":"kitchen","class":"place"},{"name":"bath","class":"place"},{"name":"a","class":"lamp","attributes":{"room":"kitchen","kind":"lamp"}},{"name":"b","class":"lamp","attributes":{"room":"bath","kind":"lamp"}},{"name":"c","class":"fan","attributes":{"room":"kitchen","kind":"fan"}},{"name":"d","class":"fan","attributes":{"room":"bath","kind":"fan"}}],"facts":["lampOff(a)"],"task_kinds":["lampOn(?x)","lampOff(?x)","fanOn(?x)","fanOff(?x)"]}"#;

fn command(group: &str, words: &str, meant: &str) -> String {
    format!(r#"{{"type":"command","world":"flat","id":"{words}","group":"{group}","command":"{words}","intended":["{meant}"]}}"#)
}

/// Commands in German for each thing, on and off: their meanings are to be learned.
fn log() -> String {
    let mut lines = vec![WORLD.to_owned()];
    for (thing, class, said) in
        [("a", "lamp", "küche licht"), ("b", "lamp", "bad licht"), ("c", "fan", "küche lüfter"), ("d", "fan", "bad lüfter")]
    {
        for (state, word) in [("On", "an"), ("Off", "aus")] {
            // A proposition that holds already is no task.
            if (thing, state) != ("a", "Off") {
                for (number, before) in ["", "bitte "].iter().enumerate() {
                    lines.push(command(&number.to_string(), &format!("{before}{said} {word}"), &format!("{class}{state}({thing})")));
                }
            }
        }
    }
    lines.join("\n")
}

fn file(folder: &Path, name: &str, content: &str) -> PathBuf {
    let path = folder.join(name);
    fs::write(&path, content).expect("a file");
    path
}

fn last_line(run: &Run) -> Value {
    assert_eq!(run.code, 0, "{}", run.messages);
    serde_json::from_str(run.output.lines().last().expect("a line")).expect("JSON")
}

#[test]
fn what_was_said_in_a_world_from_a_file_is_learned_and_understood() {
    let folder = tempfile::tempdir().expect("a folder");
    let (log, world) = (file(folder.path(), "log.jsonl", &log()), file(folder.path(), "world.json", WORLD));
    let model = folder.path().join("words.goodbot");
    let [log, world, model] = [&log, &world, &model].map(|path| path.to_str().expect("UTF-8"));
    let learned = goodbot(&["learn", log, "--out", model], b"");
    assert_eq!(learned.code, 0, "{}", learned.messages);
    for (words, meant) in [("küche licht an", "lampOn(a)"), ("lüfter bad aus", "fanOff(d)"), ("licht bad aus bitte", "lampOff(b)")] {
        let answer = last_line(&goodbot(&["ask", "--with", model, "--environment", world, "--json", words], b""));
        assert_eq!((answer["task"].as_str(), answer["of"].as_u64()), (Some(meant), Some(7)), "{answer}");
    }
    let asked = last_line(&goodbot(&["evaluate", "--with", model, "--test", log, "--json"], b""));
    assert_eq!((asked["asked"].as_u64(), asked["right"].as_u64()), (Some(14), Some(14)));
    // A world with more names than the model has ever met.
    let lamp = |room: u32| format!(r#"{{"name":"x{room}","class":"lamp","attributes":{{"room":"room{room}","kind":"lamp"}}}},"#);
    let lamps: String = (0..300).map(lamp).collect();
    let large = file(folder.path(), "large.json", &WORLD.replacen(r#"{"name":"a""#, &(lamps + r#"{"name":"a""#), 1));
    let large = large.to_str().expect("UTF-8");
    let answer = last_line(&goodbot(&["ask", "--with", model, "--environment", large, "--json", "küche licht an"], b""));
    assert_eq!((answer["task"].as_str(), answer["of"].as_u64()), (Some("lampOn(a)"), Some(607)), "{answer}");
}

#[test]
fn the_group_that_a_log_names_is_left_out_together() {
    let summary = |more: &[&str]| last_line(&goodbot(&[&["evaluate", "-", "--json"], more].concat(), log().as_bytes()));
    let by_group = summary(&[]);
    assert_eq!(by_group["asked"].as_u64(), Some(14));
    assert!(by_group["right"].as_u64() > Some(9), "each group says everything in the other's words: {by_group}");
    assert_eq!(summary(&["--group", "logged"]), by_group);
    let too_many = goodbot(&["evaluate", "-", "--k-fold", "3"], log().as_bytes());
    assert!(too_many.code == 2 && too_many.messages.contains("group by group there are 2"), "{}", too_many.messages);
}

/// Conversations in which each thing is switched on, and then "it" off, or on and off twice with "again". `before` says whether commands
/// name the commands before them.
fn conversations(before: bool) -> String {
    let world = WORLD.replace(r#""facts":["lampOff(a)"]"#, r#""facts":[]"#);
    let mut lines = vec![world];
    for (round, please) in ["", " bitte", " mal"].into_iter().enumerate() {
        for (thing, class, said) in
            [("a", "lamp", "küche licht"), ("b", "lamp", "bad licht"), ("c", "fan", "küche lüfter"), ("d", "fan", "bad lüfter")]
        {
            let group = format!("{thing}{round}");
            let steps = [(format!("{said} an{please}"), "On"), (format!("wieder zurück{please}"), "Off"), (format!("doch{please}"), "On")];
            for (number, (words, state)) in steps.iter().enumerate() {
                let line = command(&group, words, &format!("{class}{state}({thing})"));
                let named = format!("\"id\":\"{group}{number}\"");
                let line = line.replacen(&format!("\"id\":\"{words}\""), &named, 1);
                let told = if before && number > 0 { format!(",\"before\":[\"{group}{}\"]}}", number - 1) } else { "}".to_owned() };
                lines.push(format!("{}{told}", line.trim_end_matches('}')));
            }
        }
    }
    lines.join("\n")
}

#[test]
fn words_that_speak_of_what_was_done_before_are_understood_where_a_log_names_the_commands_before() {
    let right = |before: bool| {
        let run = goodbot(&["evaluate", "-", "--json"], conversations(before).as_bytes());
        let answers = run.output.lines().map(|line| serde_json::from_str::<Value>(line).expect("JSON"));
        let pointing = answers.filter(|it| it["type"] == "answer" && !it["command"].as_str().is_some_and(|words| words.contains(" an")));
        pointing.map(|it| it["right"].as_bool().expect("a bool")).fold((0, 0), |(right, all), it| (right + u32::from(it), all + 1))
    };
    let ((with, of), (without, _)) = (right(true), right(false));
    assert_eq!((with, of), (24, 24));
    assert!(without < 10, "{without} are right by chance");
}

#[test]
fn a_command_that_names_none_before_it_is_refused_by_line_and_a_long_conversation_is_read() {
    let log = conversations(true).replacen("\"before\":[\"a00\"]", "\"before\":[\"x\"]", 1);
    let refused = goodbot(&["check", "-"], log.as_bytes());
    assert!(refused.messages.contains("3: field \"before\": \"x\" is no command of a line before"), "{}", refused.messages);
    let mut log = vec![WORLD.to_owned()];
    for number in 0..1_000 {
        let before = if number > 0 { format!(",\"before\":[\"{}\"]", number - 1) } else { String::new() };
        let meant = ["lampOn(a)", "fanOn(c)"][number % 2];
        log.push(format!(r#"{{"type":"command","world":"flat","id":"{number}","command":"again","intended":["{meant}"]{before}}}"#));
    }
    let read = goodbot(&["check", "-"], log.join("\n").as_bytes());
    assert_eq!(read.code, 0, "{}", read.messages);
}

#[test]
fn a_task_of_two_objects_is_one_whichever_comes_first() {
    let folder = tempfile::tempdir().expect("a folder");
    let world = WORLD.replace(r#""task_kinds":["lampOn(?x)","lampOff(?x)","#, r#""task_kinds":["lampOn(?x) & lampOn(?y)","#);
    let pair = r#"{"type":"command","world":"flat","id":"1","group":"1","command":"beide","intended":["lampOn(b)","lampOn(a)"]}"#;
    let (log, world) = (file(folder.path(), "log.jsonl", &format!("{world}\n{pair}")), file(folder.path(), "world.json", &world));
    let model = folder.path().join("words.goodbot");
    let [log, world, model] = [&log, &world, &model].map(|path| path.to_str().expect("UTF-8"));
    let learned = goodbot(&["learn", log, "--out", model], b"");
    assert_eq!(learned.code, 0, "{}", learned.messages);
    let answer = last_line(&goodbot(&["ask", "--with", model, "--environment", world, "--json", "beide"], b""));
    assert_eq!((answer["task"].as_str(), answer["of"].as_u64()), (Some("lampOn(a) & lampOn(b)"), Some(5)), "{answer}");
}

/// Three rooms with a lamp and a fan each.
const HOUSE: &str = r#"{"type":"world","name":"flat","classes":["lamp","fan","place"],"attributes":{"room":["lamp","fan"],"kind":["lamp","fan"]},"propositions":{"lampOn":["lamp"],"lampOff":["lamp"],"fanOn":["fan"],"fanOff":["fan"]},"objects":[{"name":"kitchen","class":"place"},{"name":"bath","class":"place"},{"name":"hall","class":"place"},{"name":"lamp_kitchen","class":"lamp","attributes":{"room":"kitchen","kind":"lamp"}},{"name":"lamp_bath","class":"lamp","attributes":{"room":"bath","kind":"lamp"}},{"name":"lamp_hall","class":"lamp","attributes":{"room":"hall","kind":"lamp"}},{"name":"fan_kitchen","class":"fan","attributes":{"room":"kitchen","kind":"fan"}},{"name":"fan_bath","class":"fan","attributes":{"room":"bath","kind":"fan"}},{"name":"fan_hall","class":"fan","attributes":{"room":"hall","kind":"fan"}}],"facts":[],"task_kinds":["lampOn(?x)","lampOff(?x)","fanOn(?x)","fanOff(?x)"]}"#;

/// Sentences in French: the group, the meaning, the words. Some meanings are told often and some once. Of twelve draws from many ways to say the
/// same, this is one in which the weights of all words decide.
const SAID: &str = "\
lampOnkitchen lampOn(lamp_kitchen) allume la lumiere dans le cuisine
lampOnkitchen lampOn(lamp_kitchen) mets la lampe du cuisine
lampOnkitchen lampOn(lamp_kitchen) mets le lampe du cuisine
lampOnkitchen lampOn(lamp_kitchen) demarre le lumiere de la cuisine
lampOnkitchen lampOn(lamp_kitchen) demarre la lumiere du cuisine
lampOnkitchen lampOn(lamp_kitchen) mets la lumiere du cuisine
lampOnkitchen lampOn(lamp_kitchen) demarre la lumiere du cuisine
lampOnkitchen lampOn(lamp_kitchen) allume le lampe du cuisine
lampOnbath lampOn(lamp_bath) demarre la lumiere de la bain
lampOnhall lampOn(lamp_hall) allume le lampe de la couloir
lampOffbath lampOff(lamp_bath) eteins la lumiere du bain
lampOffbath lampOff(lamp_bath) arrete la lampe du bain
lampOffbath lampOff(lamp_bath) coupe le lumiere dans le bain
lampOffbath lampOff(lamp_bath) coupe le lampe de la bain
lampOffbath lampOff(lamp_bath) arrete la lumiere de la bain
lampOffbath lampOff(lamp_bath) arrete le lampe de la bain
lampOffbath lampOff(lamp_bath) arrete la lumiere du bain
lampOffbath lampOff(lamp_bath) eteins la lumiere dans le bain
lampOffhall lampOff(lamp_hall) eteins la lampe dans le couloir
lampOffhall lampOff(lamp_hall) eteins le lampe du couloir
fanOnhall fanOn(fan_hall) mets le ventilateur de la couloir
fanOnhall fanOn(fan_hall) allume le ventilateur de la couloir
fanOffkitchen fanOff(fan_kitchen) coupe le air de la cuisine
fanOffbath fanOff(fan_bath) eteins le air de la bain
fanOffhall fanOff(fan_hall) arrete la ventilateur dans le couloir";

#[test]
fn a_meaning_that_was_never_told_is_put_together_from_the_words_for_its_parts() {
    let mut log = vec![HOUSE.to_owned()];
    for (number, line) in SAID.lines().enumerate() {
        let [group, meant, words] = line.splitn(3, ' ').collect::<Vec<_>>()[..] else { panic!("{line}") };
        log.push(command(group, words, meant).replacen(words, &number.to_string(), 1));
    }
    let left_out = last_line(&goodbot(&["evaluate", "-", "--json"], log.join("\n").as_bytes()));
    assert_eq!(left_out["asked"].as_u64(), Some(25));
    assert!(left_out["right"].as_u64() > Some(20), "as many as where each word counts for the values that it names alone: {left_out}");
}

#[test]
fn what_is_wrong_with_a_world_is_told_by_line_and_field() {
    for (from, to, told) in [
        ("\"classes\":[\"lamp\"", "\"classes\":[\"lump\"", "field \"attributes.room[0]\": the world has no class \"lamp\""),
        ("\"lampOn(?x)\"", "\"lampOn(?x,?y)\"", "field \"task_kinds[0]\": \"lampOn\" was given 2 arguments, and it has 1"),
        ("\"lampOff(a)\"", "\"lampOff(c)\"", "field \"facts[0]\": \"c\" is where an object of the class \"lamp\" belongs"),
        ("\"name\":\"b\"", "\"name\":\"a\"", "field \"objects[3].name\": \"a\" is here twice"),
        ("\"room\":\"bath\",\"kind\":\"lamp\"", "\"size\":\"big\"", "the world has no attribute \"size\""),
        ("\"type\":\"world\",", "\"type\":\"world\",\"rooms\":[],", "field \"rooms\": is not known here"),
    ] {
        let checked = goodbot(&["check", "-"], WORLD.replacen(from, to, 1).as_bytes());
        assert!(checked.code == 2 && checked.messages.contains("standard input:1: "), "{}", checked.messages);
        assert!(checked.messages.contains(told), "{told}: {}", checked.messages);
    }
    let lost = goodbot(&["check", "-"], command("1", "an", "lampOn(a)").as_bytes());
    assert!(lost.messages.contains("field \"world\": no world \"flat\""), "{}", lost.messages);
    let sound = goodbot(&["check", "-"], log().as_bytes());
    assert!(sound.code == 0 && sound.output.contains("a log of worlds with 14 commands"), "{}", sound.output);
}

#[test]
fn a_model_of_homes_is_not_asked_in_other_worlds_and_logs_of_both_are_not_mixed() {
    let folder = tempfile::tempdir().expect("a folder");
    let model = folder.path().join("home.goodbot");
    let home = goodbot(&["example", "log"], b"").output;
    let [homes, worlds] = [("homes.jsonl", home), ("worlds.jsonl", log())].map(|(name, text)| file(folder.path(), name, &text));
    let [model, homes, worlds] = [&model, &homes, &worlds].map(|path| path.to_str().expect("UTF-8"));
    assert_eq!(goodbot(&["learn", homes, "--out", model], b"").code, 0);
    let world = file(folder.path(), "world.json", WORLD);
    let asked = goodbot(&["ask", "--with", model, "--environment", world.to_str().expect("UTF-8"), "licht an"], b"");
    assert!(asked.code == 2 && asked.messages.contains("was learned in homes"), "{}", asked.messages);
    let both = goodbot(&["learn", homes, worlds, "--out", model], b"");
    assert!(both.code == 2 && both.messages.contains("learn from each by itself"), "{}", both.messages);
}

#[test]
fn a_robot_from_a_file_is_checked_and_its_commands_are_planned_for() {
    let folder = tempfile::tempdir().expect("a folder");
    let lift = goodbot(&["example", "world"], b"").output;
    assert_eq!(lift, include_str!("../../../docs/examples/worlds/lift.json"));
    let checked = goodbot(&["check", "-"], lift.as_bytes());
    assert_eq!(checked.output, "standard input: a world of 5 objects and 3 tasks, with a robot of 4 actions and 8 states, no fault\n");
    for (from, to, told) in [
        ("\"liftAtFloor(lift0,floor1)\",", "", "field \"facts\": say no value of the variable liftAtFloor of lift0"),
        ("\"effects\":[\"doorOpen(lift0)\"]", "\"effects\":[]", "16: field \"actions[2].effects\": are none"),
        (
            "\"effects\":[\"doorOpen(lift0)\"]",
            "\"effects\":[\"lit(lift0)\"]",
            "16: field \"actions[2].effects[0]\": the world has no proposition \"lit\"",
        ),
    ] {
        let wrong = goodbot(&["check", "-"], lift.replacen(from, to, 1).as_bytes());
        assert!(wrong.code == 2 && wrong.messages.contains(told), "{told}: {}", wrong.messages);
    }
    // A log names its worlds on one line each.
    let line: String = lift.lines().collect();
    let command = |words: &str, floor: u8| {
        format!(r#"{{"type":"command","world":"lift","command":"{words}","intended":["liftAtFloor(lift0,floor{floor})"]}}"#)
    };
    let said =
        [("to the roof", 3), ("up to the roof", 3), ("to the garage", 0), ("garage please", 0), ("the office", 2), ("to the office", 2)];
    let log = [vec![line], said.map(|(words, floor)| command(words, floor)).to_vec()].concat().join("\n");
    let (world, log, model) =
        (file(folder.path(), "lift.json", &lift), file(folder.path(), "log.jsonl", &log), folder.path().join("lift.goodbot"));
    let [world, log, model] = [&world, &log, &model].map(|path| path.to_str().expect("UTF-8"));
    assert_eq!(goodbot(&["learn", log, "--out", model], b"").code, 0);
    let answer = last_line(&goodbot(&["ask", "--with", model, "--environment", world, "--json", "up to the roof please"], b""));
    assert_eq!(
        (answer["task"].as_str(), &answer["plan"]),
        (Some("liftAtFloor(lift0,floor3)"), &serde_json::json!(["up", "up"])),
        "{answer}"
    );
    let door = file(folder.path(), "door.json", &lift.replace("\"liftAtFloor(?l,?f)\"", "\"doorOpen(?l)\""));
    let asked = goodbot(&["ask", "--with", model, "--environment", door.to_str().expect("UTF-8"), "open"], b"");
    assert!(
        asked.output.contains("door open: lift0") && asked.output.contains("never heard: \"open\""),
        "{}{}",
        asked.output,
        asked.messages
    );
}

#[test]
fn a_world_on_one_line_is_checked_as_one_on_many() {
    let lift = goodbot(&["example", "world"], b"").output;
    let line: String = lift.lines().collect();
    let sound = goodbot(&["check", "-"], lift.as_bytes()).output;
    for text in [line.clone(), format!("{line}\n"), format!("\n\n{line}\r\n \n")] {
        assert_eq!(goodbot(&["check", "-"], text.as_bytes()).output, sound);
    }
    let wrong = line.replacen("\"liftAtFloor(lift0,floor1)\",", "", 1);
    let told = "field \"facts\": say no value of the variable liftAtFloor of lift0";
    let checked = goodbot(&["check", "-"], format!("\n{wrong}").as_bytes());
    assert!(checked.messages.contains(&format!("standard input:2: {told}")), "{}", checked.messages);
    // In a log of worlds the fault is on the world's line too.
    let checked = goodbot(&["check", "-"], format!("{line}\n{}\n", wrong.replacen("\"lift\"", "\"lift2\"", 1)).as_bytes());
    assert!(
        checked.messages.contains(&format!("standard input:2: {}", told.replace(": say", ": world \"lift2\": say"))),
        "{}",
        checked.messages
    );
}

#[test]
fn hostile_worlds_are_refused_by_line_at_once() {
    let folder = tempfile::tempdir().expect("a folder");
    let lamps =
        |count: usize| (0..count).map(|lamp| format!("\n{{\"name\":\"l{lamp}\",\"class\":\"lamp\"}}")).collect::<Vec<_>>().join(",");
    let world = |attributes: &str, propositions: &str, objects: &str, actions: &str, kinds: &str| {
        format!(
            "{{\"type\":\"world\",\n\"name\":\"w\",\n\"classes\":[\"lamp\"],\n\"attributes\":{{{attributes}}},\n\"propositions\":{{\"on\":[\"lamp\"]{propositions}}},\n\
             \"objects\":[{objects}],\n\"actions\":[{actions}],\n\"task_kinds\":[{kinds}]}}"
        )
    };
    let (light, on) = (r#"{"name":"light","parameters":{"?l":"lamp"},"effects":["on(?l)"]}"#, "\"on(?l)\"");
    let single = |count: usize| {
        (0..count).map(|lamp| format!("{{\"name\":\"light{lamp}\",\"effects\":[\"on(l{lamp})\"]}}")).collect::<Vec<_>>().join(",")
    };
    let all: Vec<String> = (0..64).map(|lamp| format!("\"on(l{lamp})\"")).collect();
    let attributes: Vec<String> = (0..300).map(|number| format!("\"a{number}\":[\"lamp\"]")).collect();
    let kinds: Vec<String> = (0..20).map(|number| format!("\"p{number}(?l)\"")).collect();
    let more: String = (0..20).map(|number| format!(",\"p{number}\":[\"lamp\"]")).collect();
    let any = r#"{"name":"x","conditions":["r(?a,?b,?c)","r(?d,?e,?f)"],"effects":["on(?a)"]}"#;
    let parameters = r#""?a":"lamp","?b":"lamp","?c":"lamp","?d":"lamp","?e":"none""#;
    let wide = format!("{{\"name\":\"x\",\"parameters\":{{{parameters}}},\"effects\":[\"of(s0)\"]}}");
    let relation = ",\"r\":[\"lamp\",\"lamp\",\"lamp\"]";
    for (text, told) in [
        (world("", "", &lamps(10_000), light, on), "6: field \"objects\": are 10000, and 255 are the most"),
        (world(&attributes.join(","), "", &lamps(2), light, on), "4: field \"attributes\": are 300, and 4 are the most"),
        (world("", "", &lamps(2), r#"{"name":"x","effects":[]}"#, on), "9: field \"actions[0].effects\": are none"),
        (world("", "", &lamps(2), r#"{"name":"x","effects":["on(l0)"],"cost":0}"#, on), "9: field \"actions[0].cost\": 0 is no cost"),
        (
            world("", "", &lamps(2), r#"{"name":"x","effects":["on(zz)"]}"#, on),
            "9: field \"actions[0].effects[0]\": the world has no object",
        ),
        (world("", relation, &lamps(60), any, on), "67: field \"actions[0]\": can be done with more objects than can be tried"),
        (world("", &more, &lamps(2), light, &kinds.join(",")), "10: field \"task_kinds\": are 20, and 8 are the most"),
        (
            world("", "", &format!("{{\"name\":\"{}\",\"class\":\"lamp\"}}", "x".repeat(5_000)), light, on),
            "6: field \"objects[0]\": too many bytes in a word",
        ),
        (
            world("", ",\"near\":[\"lamp\",\"lamp\"]", &lamps(20), &single(15), "\"near(?a,?b)\""),
            "28: field \"task_kinds\": give 380 tasks, and 256 are the most for a robot that acts; leave out kinds or objects",
        ),
        // The last class has no object, which shows only after all others are chosen.
        (
            world("", ",\"of\":[\"sole\"]", &format!("{},{{\"name\":\"s0\",\"class\":\"sole\"}}", lamps(200)), &wide, on)
                .replace("\"classes\":[\"lamp\"]", "\"classes\":[\"lamp\",\"none\",\"sole\"]"),
            "207: field \"actions[0]\": can be done with more objects than can be tried",
        ),
        (
            world("", "", &lamps(64), &format!("{{\"name\":\"x\",\"effects\":[{}]}}", all.join(",")), on),
            "5: field \"propositions.on\": gives more states than can be numbered",
        ),
    ] {
        let path = file(folder.path(), "world.json", &text);
        let path = path.to_str().expect("UTF-8");
        for command in [&["check", path][..], &["teach", path, "--lines"], &["table", path, "--c"]] {
            let began = std::time::Instant::now();
            let run = goodbot(command, b"");
            assert!(run.code == 2 && run.messages.contains(&format!("world.json:{told}")), "{told}: {command:?} {}", run.messages);
            assert!(began.elapsed() < std::time::Duration::from_secs(5), "{told}: {command:?}");
        }
    }
}

#[test]
fn a_controller_that_cannot_tell_all_tasks_apart_is_told_of_in_the_words_of_the_world() {
    let lamps: Vec<String> = (0..13).map(|lamp| format!("{{\"name\":\"l{lamp}\",\"class\":\"lamp\"}}")).collect();
    let text = format!(
        r#"{{"type":"world","name":"w","classes":["lamp"],"attributes":{{}},"propositions":{{"on":["lamp"],"near":["lamp","lamp"]}},
        "objects":[{}],"actions":[{{"name":"light","effects":["on(l0)"]}}],
        "task_kinds":["near(?a,?b)"]}}"#,
        lamps.join(",")
    );
    let folder = tempfile::tempdir().expect("a folder");
    let path = file(folder.path(), "world.json", &text);
    let path = path.to_str().expect("UTF-8");
    for command in [&["table", path, "--c"][..], &["size", path]] {
        let run = goodbot(command, b"");
        let told = "world.json:3: field \"task_kinds\": give too many tasks in one world: 156 or more, and 64 are the most; \
                    leave out objects or kinds of task";
        assert!(run.code == 2 && run.messages.contains(told), "{command:?} {}", run.messages);
    }
}

#[test]
fn an_action_that_does_nothing_or_contradicts_itself_is_warned_of() {
    let world = |actions: &[&str]| {
        format!(
            "{{\"type\":\"world\",\"name\":\"w\",\"classes\":[\"lamp\"],\"attributes\":{{}},\"propositions\":{{\"on\":[\"lamp\"]}},\n\
             \"objects\":[{{\"name\":\"a\",\"class\":\"lamp\"}},{{\"name\":\"b\",\"class\":\"lamp\"}}],\n\
             \"actions\":[{{\"name\":\"light\",\"parameters\":{{\"?l\":\"lamp\"}},\"effects\":[\"on(?l)\"]}},\n{}],\"task_kinds\":[\"on(?l)\"]}}",
            actions.join(",\n")
        )
    };
    for (action, told) in [
        (
            r#"{"name":"x","conditions":["on(a)","!on(a)"],"effects":["on(b)"]}"#,
            "\": warning: on(a) is to hold and not to hold, so that x can never be done; leave one of the two out",
        ),
        (
            r#"{"name":"x","parameters":{"?l":"lamp"},"effects":["on(?l)","!on(?l)"]}"#,
            "\": warning: on(?l) both holds and does not hold after x; the last one counts, so leave one of the two out",
        ),
        (
            r#"{"name":"x","conditions":["on(a)"],"effects":["on(a)"]}"#,
            "\": warning: x changes nothing in any state; correct its effects, or leave it out",
        ),
    ] {
        let checked = goodbot(&["check", "-"], world(&[action]).as_bytes());
        assert!(checked.code == 0 && checked.messages.contains("standard input:4: field \"actions[1]"), "{told}: {}", checked.messages);
        assert!(checked.messages.contains(told), "{told}: {}", checked.messages);
    }
    let two = world(&[r#"{"name":"x","effects":["at(b,a)","at(b,b)"]},{"name":"y","effects":["at(a,a)","at(b,a)"]}"#]).replace(
        "\"on\":[\"lamp\"]}",
        "\"on\":[\"lamp\"],\"at\":[\"lamp\",\"lamp\"]},\"variables\":[\"at\"],\"facts\":[\"at(a,b)\",\"at(b,a)\"]",
    );
    let checked = goodbot(&["check", "-"], two.as_bytes());
    let told =
        "field \"actions[1]\": warning: at(b,a) and at(b,b) give one variable two values; the last one counts, so leave one of the two out";
    assert!(checked.messages.contains(told) && !checked.messages.contains("actions[2]"), "{}", checked.messages);
    let once = r#"{"name":"x","conditions":["on(a)","on(b)"],"effects":["!on(a)","!on(b)"]}"#;
    let sound = goodbot(&["check", "-"], world(&[once]).as_bytes());
    assert!(sound.output.contains("no fault\n"), "{}{}", sound.output, sound.messages);
    let never =
        r#"{"name":"x","conditions":["at(a)"],"effects":["on(a)"]},{"name":"y","conditions":["lit(a)","lit(b)"],"effects":["lit(b)"]}"#;
    let more = world(&[never]).replace("\"on\":[\"lamp\"]", "\"on\":[\"lamp\"],\"at\":[\"lamp\"],\"lit\":[\"lamp\"]");
    let checked = goodbot(&["check", "-"], more.as_bytes());
    for (position, name) in [(1, "x"), (2, "y")] {
        let told = format!(
            "field \"actions[{position}]\": warning: {name} is possible in no state that the robot reaches from these facts; correct its conditions, or leave it out"
        );
        assert!(checked.messages.contains(&told), "{}", checked.messages);
    }
}

#[test]
fn an_action_of_several_cases_is_warned_of_once() {
    let world = |cases: &str| {
        format!(
            r#"{{"type":"world","name":"w","classes":["lamp"],"attributes":{{}},"propositions":{{"on":["lamp"]}},"objects":[{{"name":"a","class":"lamp"}}],
            "actions":[{{"name":"press","conditions":["!on(a)"],"effects":["on(a)"]}},{cases}],"task_kinds":["on(?l)"]}}"#
        )
    };
    let warnings = |cases: &str| goodbot(&["check", "-"], world(cases).as_bytes()).messages;
    assert_eq!(warnings(r#"{"name":"press","effects":["!on(a)"]}"#), "");
    let never = warnings(r#"{"name":"press","conditions":["on(a)","!on(a)"],"effects":["!on(a)"]}"#);
    assert!(
        never.contains("\"actions[1]\": warning: on(a) is to hold and not to hold, so that this case of press can never be done"),
        "{never}"
    );
    let keeps = r#"{"name":"keep","conditions":["on(a)"],"effects":["on(a)"]}"#;
    let keeps = warnings(&format!("{keeps},{keeps}"));
    assert!(keeps.contains("\"actions[1]\": warning: keep changes nothing in any state") && keeps.lines().count() == 1, "{keeps}");
}

#[test]
fn a_problem_of_the_planning_field_is_a_world_that_is_checked_and_taught() {
    let pddl =
        |name: &str| Path::new(env!("CARGO_MANIFEST_DIR")).join("../lesson/tests/pddl").join(name).to_str().expect("UTF-8").to_owned();
    let folder = tempfile::tempdir().expect("a folder");
    let converted = goodbot(&["convert", &pddl("blocks.pddl"), &pddl("blocks-3.pddl")], b"");
    assert_eq!(converted.code, 0, "{}", converted.messages);
    let world = file(folder.path(), "blocks.json", &converted.output);
    let world = world.to_str().expect("UTF-8");
    let checked = goodbot(&["check", world], b"");
    assert!(
        checked.output.contains("a world of 4 objects and 11 tasks, with a robot of 8 actions and 22 states, no fault"),
        "{}{}",
        checked.output,
        checked.messages
    );
    let told = goodbot(&["teach", world, "--lines"], b"command put b on c\nintended on(b,c)\nstep\nauto\nstep\nauto\nfinish\n");
    assert!(told.code == 0 && told.output.contains("\"learned\":true"), "{}{}", told.output, told.messages);
    let refused = goodbot(&["convert", &pddl("blocks-3.pddl"), &pddl("blocks.pddl")], b"");
    assert!(refused.code == 2 && refused.messages.contains("blocks-3.pddl:2: is no definition of a domain"), "{}", refused.messages);
    let other = goodbot(&["convert", &pddl("blocks.pddl"), &pddl("ferry-3.pddl")], b"");
    assert!(other.code == 2 && other.messages.contains("ferry-3.pddl:1: ferry-3 is of the domain ferry"), "{}", other.messages);
}

#[test]
fn a_goal_whose_objects_can_be_exchanged_is_one_task_that_is_taught() {
    let pddl = |name: &str| format!("{}/../lesson/tests/pddl/{name}", env!("CARGO_MANIFEST_DIR"));
    let folder = tempfile::tempdir().expect("a folder");
    let converted = goodbot(&["convert", &pddl("carry.pddl"), &pddl("carry-3.pddl")], b"");
    assert!(converted.code == 0 && converted.messages.is_empty(), "{}", converted.messages);
    let world = file(folder.path(), "carry.json", &converted.output);
    let world = world.to_str().expect("UTF-8");
    let checked = goodbot(&["check", world], b"");
    assert!(checked.output.contains("6 objects and 86 tasks"), "{}{}", checked.output, checked.messages);
    let lines = b"command put all of them in b\nintended at(x,b) & at(y,b) & at(z,b)\nstep\nauto\nfinish\n";
    let told = goodbot(&["teach", world, "--lines"], lines);
    assert!(told.code == 0 && told.output.contains("\"learned\":true"), "{}{}", told.output, told.messages);
}
