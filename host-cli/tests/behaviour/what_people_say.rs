//! The example sentences of `docs/talk.md`, said to a robot with the lessons that the page names.

use std::fs;

use serde_json::Value;

use crate::program::goodbot;

const ROOT: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/..");

/// The tables' rows with a sentence in their second cell: the sentence, and what the third cell tells of the robot.
fn examples(page: &str) -> Vec<(&str, Option<&str>)> {
    let rows = page.lines().filter_map(|line| line.strip_prefix("| ")?.strip_suffix(" |"));
    let cells = rows.map(|row| row.split(" | ").collect::<Vec<_>>());
    cells
        .filter_map(|cells| Some((cells.get(1)?.strip_prefix('`')?.strip_suffix('`')?, cells.get(2).copied())))
        .filter(|(sentence, _)| sentence.contains(' ') || sentence.starts_with("hello"))
        .collect()
}

#[test]
fn the_robot_takes_each_sentence_as_the_page_tells() {
    let page = fs::read_to_string(format!("{ROOT}/docs/talk.md")).expect("the page");
    let examples = examples(&page);
    let waiting = examples.iter().filter(|(_, told)| told.is_none()).count();
    assert!(waiting >= 5 && examples.len() - waiting >= 15, "{examples:?}");

    let folder = tempfile::tempdir().expect("a folder");
    let model = folder.path().join("en.goodbot").to_str().expect("a name").to_owned();
    let lessons = format!("{ROOT}/lab/acts/lessons.en.jsonl");
    assert_eq!(goodbot(&["learn", &lessons, "--out", &model], b"").code, 0);
    let heard = fs::read_to_string(lessons).expect("the lessons");
    let sentences: String = examples.iter().map(|(sentence, _)| format!("{sentence}\n")).collect();
    let home = format!("{ROOT}/lab/acts/home.json");
    let run = goodbot(&["ask", "--json", "--with", &model, "--environment", &home, "-"], sentences.as_bytes());
    let answers: Vec<Value> = run.output.lines().map(|line| serde_json::from_str(line).expect("JSON")).collect();
    assert_eq!(answers.len(), examples.len(), "{}", run.messages);
    for ((sentence, told), answer) in examples.into_iter().zip(answers) {
        assert!(!heard.contains(&format!(r#""command":"{sentence}""#)), "a lesson had: {sentence}");
        let (verdict, what) = match told {
            None => ("unsure", None),
            Some("nothing: a greeting") => ("none", Some("greeting")),
            Some("nothing: that thing is not here") => ("none", Some("a thing that is not here")),
            Some(told) => told.strip_prefix("already done: ").map_or(("sure", Some(told)), |task| ("done", Some(task))),
        };
        assert_eq!(answer["verdict"], verdict, "{sentence}: {answer}");
        let is = if verdict == "none" { &answer["taken_for"] } else { &answer["meanings"][0]["words"] };
        assert!(what.is_none_or(|what| is == what), "{sentence}: {is}");
    }
}

#[test]
fn an_utterance_that_turns_its_parts_round_is_turned_round_once() {
    let folder = tempfile::tempdir().expect("a folder");
    let model = folder.path().join("zh.goodbot").to_str().expect("a name").to_owned();
    assert_eq!(goodbot(&["learn", &format!("{ROOT}/lab/acts/lessons.zh.jsonl"), "--out", &model], b"").code, 0);
    let home = format!("{ROOT}/lab/acts/home.json");
    let sentences = "篮子没到蓝色房间你就别去绿色房间，送到了再去。\n绿色房间先别急着去，篮子放到黄色房间之后再去。\n";
    let run = goodbot(&["ask", "--json", "--with", &model, "--environment", &home, "-"], sentences.as_bytes());
    assert_eq!((run.code, run.output.lines().count()), (0, 2), "{}", run.messages);
}
