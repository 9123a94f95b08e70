//! Whole logs: the order of their lines, and the next session after an error.

use goodbot_formats::FormatError;
use goodbot_formats::session::{RecordedSession, SessionReader};
use goodbot_formats::world::{Line, WorldReader};

const HOME: &str = r#"{"version":1,"objects":[{"class":"agent","name":"agent0","x":4,"y":2}]}"#;
const STEP: &str = r#"{"type":"step","action":"north","feedback":"neutral"}"#;
const SHOWN: &str = r#"{"type":"step","action":"noop"}"#;
const END: &str = r#"{"type":"end","learn":true}"#;

fn session(kind: &str, command: &str) -> String {
    format!("{{\"type\":\"session\",\"version\":1,\"kind\":\"{kind}\",\"environment\":{HOME},\"command\":\"{command}\"}}")
}

fn feedback() -> String {
    session("feedback", "go")
}

fn continued(command: &str) -> String {
    session("feedback", command).replace("\"}", "\",\"continues\":true}")
}

fn read(log: impl AsRef<[u8]>) -> Vec<Result<RecordedSession, FormatError>> {
    SessionReader::new(log.as_ref()).collect()
}

/// The log's sessions by their lines, and its errors by their words.
fn outline(log: &[&str]) -> Vec<String> {
    let told = |result: Result<RecordedSession, FormatError>| match result {
        Ok(s) => format!("{}-{}", s.header_line, s.end_line),
        Err(error) => error.to_string().split(';').next().unwrap().to_string(),
    };
    read(log.join("\n")).into_iter().map(told).collect()
}

#[test]
fn sessions_are_read_with_the_numbers_of_their_lines() {
    let show = session("demonstration", "show");
    let log = [&feedback(), STEP, STEP, END, "", &show, SHOWN, END, "  "].join("\r\n");
    let sessions = read(format!("\u{feff}{log}"));
    let first = sessions[0].as_ref().unwrap();
    assert_eq!((first.header_line, first.end_line, first.learn), (1, 4, true));
    assert_eq!(first.steps.iter().map(|s| s.0).collect::<Vec<_>>(), [2, 3]);
    assert_eq!(sessions[1].as_ref().unwrap().header_line, 6);
    assert_eq!(sessions.len(), 2);
    assert!(read("").is_empty());
}

#[test]
fn the_last_line_needs_no_line_end() {
    assert_eq!(outline(&[&feedback(), END]), ["1-2"]);
}

#[test]
fn stray_lines_are_refused() {
    assert_eq!(outline(&[STEP]), ["line 1: a step comes before any session"]);
    assert_eq!(
        outline(&[&feedback(), END, STEP, STEP, END, &feedback(), END]),
        ["1-2", "line 3: a step comes after the end of its session", "6-7"]
    );
    assert_eq!(outline(&[&feedback(), END, END]), ["1-2", "line 3: an end is outside of any session"]);
}

#[test]
fn a_session_without_an_end_is_told_and_the_next_one_is_read() {
    assert_eq!(
        outline(&[&feedback(), STEP, &feedback(), END]),
        ["line 1: the session that begins here is not ended when another begins on line 3", "3-4"]
    );
    assert_eq!(outline(&[&feedback(), STEP]), ["line 1: the session that begins here is not ended when the file ends"]);
}

#[test]
fn a_broken_session_line_after_a_session_without_an_end_is_told_too() {
    let broken = feedback().replace("command", "comand");
    assert_eq!(
        outline(&[&feedback(), STEP, &broken, STEP, END, &feedback(), END]),
        [
            "line 1: the session that begins here is not ended when another begins on line 3",
            "line 3: field \"comand\": is not known here",
            "6-7"
        ]
    );
}

#[test]
fn a_log_that_is_cut_in_a_line_is_told_once() {
    let whole = [&feedback(), END, &feedback(), STEP, END].join("\n");
    let start = whole.len() - END.len();
    for cut in start + 1..whole.len() {
        let sessions = read(&whole[..cut]);
        assert_eq!(sessions.len(), 2);
        let error = sessions[1].as_ref().unwrap_err();
        assert!(error.line == 5 && error.problem.contains("ends in the middle of a value"), "{error}");
    }
    assert_eq!(outline(&[&feedback()[..100]]), ["line 1: the text ends in the middle of a value"]);
}

#[test]
fn feedback_is_there_exactly_where_it_belongs() {
    assert_eq!(
        outline(&[&feedback(), r#"{"type":"step","action":"north"}"#, END]),
        ["line 2: field \"feedback\": is missing in a feedback session"]
    );
    assert_eq!(outline(&[&session("demonstration", "go"), STEP, END]), ["line 2: field \"feedback\": does not belong in a demonstration"]);
    assert_eq!(outline(&[&feedback(), &STEP.replace("neutral", "none"), END]), ["line 2: field \"feedback\": \"none\" is not known"]);
}

#[test]
fn an_action_is_one_of_the_sessions_or_noop() {
    let pull = STEP.replace("north", "pull");
    assert_eq!(
        outline(&[&feedback(), &STEP.replace("north", "noop"), &pull, END]),
        ["line 3: field \"action\": \"pull\" is no action of this session"]
    );
    let own = feedback().replace("\"}", "\",\"actions\":[\"pull\"]}");
    assert_eq!(outline(&[&own, &pull, END]), ["1-3"]);
    assert_eq!(outline(&[&own, STEP, END]), ["line 2: field \"action\": \"north\" is no action of this session"]);
}

#[test]
fn a_session_continues_the_same_command_only() {
    assert_eq!(outline(&[&feedback(), END, &continued("go"), END]), ["1-2", "3-4"]);
    assert_eq!(outline(&[&continued("go"), END]), ["1-2"]);
    assert_eq!(
        outline(&[&feedback(), END, &continued("stop"), END]),
        ["1-2", "line 3: field \"continues\": the session before has another command or environment"]
    );
    assert_eq!(
        outline(&[&feedback(), SHOWN, END, &continued("go"), END, &feedback(), END]),
        [
            "line 2: field \"feedback\": is missing in a feedback session",
            "line 4: field \"continues\": the session before could not be read, so nothing can be continued",
            "6-7"
        ]
    );
}

#[test]
fn each_broken_session_is_one_error_and_all_others_are_read() {
    let other = feedback().replace("\"version\":1,\"kind\"", "\"version\":2,\"kind\"");
    let log = [
        &feedback(),
        "{",
        STEP,
        "nonsense",
        END, // broken at 2
        &other,
        STEP,
        END, // broken at 6
        &feedback(),
        STEP,
        END,
        "\"session\" {",
        STEP,
        END, // broken at 12
        &feedback(),
        END,
    ];
    assert_eq!(
        outline(&log),
        [
            "line 2: the text ends in the middle of a value",
            "line 6: field \"version\": version 2 is unknown",
            "9-11",
            "line 12: is not JSON (trailing characters)",
            "15-16"
        ]
    );
}

#[test]
fn each_broken_session_of_a_log_of_worlds_is_one_error_and_all_others_are_read() {
    let world = r#"{"type":"world","name":"hall","classes":["lamp"],"attributes":{},"propositions":{"on":["lamp"]},"objects":[{"name":"a","class":"lamp"}],"actions":[{"name":"light","effects":["on(a)"]}],"task_kinds":["on(?l)"]}"#;
    let session = r#"{"type":"session","version":1,"kind":"feedback","world":"hall","facts":[],"command":"light please"}"#;
    let step = r#"{"type":"step","action":"light","feedback":"reward"}"#;
    let log = [world, session, "{", step, "nonsense", END, session, step, END, "\"session\" {", step, END, session, END].join("\n");
    let line = |read: Result<Line, FormatError>| match read {
        Ok(Line::Session(session)) => format!("{}-{}", session.session.header_line, session.session.end_line),
        Ok(_) => "world".to_owned(),
        Err(error) => format!("fault in {}", error.line),
    };
    let read: Vec<String> = WorldReader::new(log.as_bytes()).map(line).collect();
    assert_eq!(read, ["world", "fault in 3", "7-9", "fault in 10", "13-14"]);
}

#[test]
fn a_session_is_written_as_it_was_read() {
    let lines = [&feedback(), STEP, STEP, END];
    let session = read(lines.join("\n")).remove(0).unwrap();
    assert_eq!(session.to_lines().unwrap(), lines);
}

#[test]
fn a_session_that_could_not_be_read_again_is_not_written() {
    let mut session = read([&feedback(), STEP, STEP, END].join("\n")).remove(0).unwrap();
    session.steps[1].1.feedback = None;
    let error = session.to_lines().unwrap_err();
    assert!(error.line == 3 && error.problem.contains("is missing in a feedback session"), "{error}");
    session.steps[0].1.action = "jump".into();
    assert_eq!(session.to_lines().unwrap_err().line, 2);
}
