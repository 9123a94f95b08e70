//! Posteriors: both precisions, order, and errors.

use goodbot_formats::posterior::PosteriorLine;

const LINE: &str = r#"{"session":"w01-3","step":2,"tasks":{"z(a)":0.4999999999999999,"b(a)":1.2345678901234568e-300},"strategies":{"R+/P-":0.36,"balanced":0.64}}"#;

fn belief(task: f32) -> PosteriorLine<f32> {
    PosteriorLine { session: "s".into(), step: 0, tasks: vec![("f(a)".parse().unwrap(), task)], strategies: vec![("balanced".into(), 1.0)] }
}

#[test]
fn order_and_the_last_bit_are_kept() {
    let read = PosteriorLine::parse(LINE, 1).unwrap();
    assert_eq!(read.tasks[0].1, 0.4999999999999999);
    assert_eq!(read.to_json_line().unwrap(), LINE);
}

#[test]
fn single_precision_is_written_short_and_read_back_exactly() {
    for value in [0.1_f32, 1.0 / 3.0, 5e-5, f32::MIN_POSITIVE, 1.0e-45, 0.0, 1.0000001] {
        let line = belief(value).to_json_line().unwrap();
        let read = PosteriorLine::parse(&line, 1).unwrap();
        assert_eq!((read.tasks[0].1 as f32).to_bits(), value.to_bits(), "{line}");
    }
    assert!(belief(0.1).to_json_line().unwrap().contains("\"f(a)\":0.1}"));
}

#[test]
fn what_is_no_probability_is_not_written() {
    for value in [f32::NAN, f32::INFINITY, -0.1, 1.1] {
        let error = belief(value).to_json_line().unwrap_err();
        assert_eq!(error.field.as_deref(), Some("tasks"));
        assert!(error.problem.contains("is no probability"));
    }
    let mut twice = belief(0.5);
    twice.strategies.push(twice.strategies[0].clone());
    let error = twice.to_json_line().unwrap_err();
    assert!(error.problem.contains("is here twice"));
}

#[test]
fn what_is_wrong_is_named_with_its_field() {
    for (from, to, wanted) in [
        ("\"step\":2", "\"step\":-1", "field \"step\": -1 is no count; write a whole number from 0"),
        ("0.36", "1.5", "field \"strategies.R+/P-\": 1.5 is no probability; write a number from 0 to 1"),
        ("0.36", "null", "field \"strategies.R+/P-\": is null; write a number"),
        ("z(a)", "b( a)", "field \"tasks.b(a)\": \"b(a)\" is here twice; name each once"),
        ("z(a)", "b(a)", "field \"tasks.b(a)\": is given twice; keep one of the two"),
        ("z(a)", "z(?a)", "field \"tasks.z(?a)\": has a variable at its character 3; name objects, like agentInRoom(agent0,room1)"),
        ("\"session\":\"w01-3\",", "", "field \"session\": is missing; add it"),
        ("\"step\"", "\"steps\"", "field \"steps\": is not known here; known are session, step, tasks, strategies"),
        ("\"w01-3\"", "null", "field \"session\": is null; write a text"),
    ] {
        let error = PosteriorLine::parse(&LINE.replacen(from, to, 1), 4).unwrap_err();
        assert_eq!(error.to_string(), format!("line 4: {wanted}"));
    }
}
