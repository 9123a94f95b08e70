//! The single lines of a log.

use goodbot_formats::FormatError;
use goodbot_formats::session::{FeedbackWord, Kind, Record, SessionHeader, StepRecord};

const NOT_WITH_CONTINUES: &str = "does not belong in a session that continues the one before; remove it, or remove \"continues\"";
const HEADER: &str = r#"{"type":"session","version":1,"id":"w01-3","kind":"feedback","environment":{"version":1,"objects":[{"class":"agent","name":"agent0","x":4,"y":2}]},"command":"go to the red room","intended":["agentInRoom(agent0,room0)"],"actions":["north","pull"],"prior":{"agentInRoom(agent0,room0)":0.25,"agentInRoom(agent0,room1) & blockInRoom(block0,room2)":0.3333333333333333},"strategies":[{"name":"balanced","mu_plus":0.75,"mu_minus":0.75,"epsilon":0.1,"prior":0.32}]}"#;

fn header() -> SessionHeader {
    match Record::parse(HEADER, 1) {
        Ok(Record::Session(header)) => *header,
        other => panic!("{other:?}"),
    }
}

/// The error of the header after this replacement.
fn refused(from: &str, to: &str) -> FormatError {
    assert!(HEADER.contains(from), "{from}");
    match Record::parse(&HEADER.replacen(from, to, 1), 3) {
        Ok(read) => panic!("{to} was read as {read:?}"),
        Err(error) => error,
    }
}

#[test]
fn every_field_of_a_header_is_read_and_written_in_order() {
    let header = header();
    assert_eq!(header.id.as_deref(), Some("w01-3"));
    assert_eq!(header.kind, Kind::Feedback);
    assert_eq!(header.prior.as_ref().unwrap()[1].0.atoms().len(), 2);
    assert_eq!(header.strategies.as_ref().unwrap()[0].mu_minus, 0.75);
    assert_eq!(header.action_names().collect::<Vec<_>>(), ["north", "pull"]);
    assert_eq!(header.to_json_line().unwrap(), HEADER);
}

#[test]
fn a_header_may_have_the_least() {
    let text = r#"{"type":"session","version":1,"kind":"demonstration","environment":{"version":1,"objects":[]},"command":""}"#;
    let record = Record::parse(text, 1).unwrap();
    assert_eq!(record.to_json_line().unwrap(), text);
    let Record::Session(header) = record else { panic!() };
    assert!(!header.continues && header.prior.is_none());
    assert_eq!(header.action_names().count(), 4);
}

#[test]
fn steps_and_ends_are_written_as_they_were_read() {
    for text in [
        r#"{"type":"step","action":"north","feedback":"reward"}"#,
        r#"{"type":"step","action":"say \"é\""}"#,
        r#"{"type":"step","action":"north","feedback":"punish","at_ms":1204,"said_ms":1890}"#,
        r#"{"type":"answer","tasks":["agentInRoom(agent0,room0)"],"yes":true,"eta":0.05,"said_ms":900}"#,
        r#"{"type":"end","learn":false}"#,
    ] {
        assert_eq!(Record::parse(text, 1).unwrap().to_json_line().unwrap(), text);
    }
    assert_eq!(FeedbackWord::Punish.as_str(), "punish");
}

#[test]
fn a_time_is_a_whole_number_of_milliseconds() {
    for time in ["-1", "0.5", "\"soon\""] {
        let line = format!(r#"{{"type":"step","action":"north","feedback":"reward","at_ms":{time}}}"#);
        assert_eq!(Record::parse(&line, 1).unwrap_err().field.as_deref(), Some("at_ms"), "{time}");
    }
}

#[test]
fn a_fault_is_told_with_line_and_field_and_what_to_do() {
    for (from, to, wanted) in [
        ("\"version\":1,\"id\"", "\"version\":2,\"id\"", "\"version\": version 2 is unknown; write 1, or use a newer goodbot"),
        (
            "\"version\":1,\"objects\"",
            "\"version\":0,\"objects\"",
            "\"environment.version\": version 0 is unknown; write 1, or use a newer goodbot",
        ),
        ("\"x\":4", "\"z\":4", "\"environment.objects[0].z\": is not known here; known are class, name, x, y"),
        ("\"feedback\"", "\"praise\"", "\"kind\": \"praise\" is not known; write feedback, demonstration or labelled"),
        ("\"session\"", "\"sesion\"", "\"type\": \"sesion\" is not known; write session, step, answer or end"),
        ("\"command\"", "\"id\"", "\"id\": is given twice; keep one of the two"),
        ("\"w01-3\"", "null", "\"id\": is null; write a text"),
        ("[\"agentInRoom(agent0,room0)\"]", "[]", "\"intended\": is empty; fill it, or leave out what is optional"),
        (
            "(agent0,room0)\"]",
            "(agent0\"]",
            "\"intended[0]\": is no task, \",\" or \")\" belongs at its character 19; write it like agentInRoom(agent0,room1) & blockInRoom(block0,room2)",
        ),
        ("\"pull\"", "\"north\"", "\"actions[1]\": \"north\" is here twice; name each once"),
        ("\"pull\"", "\"\"", "\"actions[1]\": is empty; fill it, or leave out what is optional"),
        ("\"balanced\"", "\"\"", "\"strategies[0].name\": is empty; fill it, or leave out what is optional"),
        (
            "\"epsilon\"",
            "\"eps\"",
            "\"strategies[0].eps\": is not known here; known are name, mu_plus, mu_minus, epsilon, prior, lags, rests",
        ),
        ("\"prior\":0.32", "\"prior\":0", "\"strategies\": nothing here is above 0; give at least one a probability"),
        (
            "\"prior\":{",
            "\"continues\":true,\"prior\":{",
            "\"prior\": does not belong in a session that continues the one before; remove it, or remove \"continues\"",
        ),
        ("\"prior\":{", "\"continues\":1,\"prior\":{", "\"continues\": is a number; write true or false"),
    ] {
        assert_eq!(refused(from, to).to_string(), format!("line 3: field {wanted}"));
    }
}

#[test]
fn a_session_that_continues_has_no_strategies() {
    let text = HEADER.replace("\"prior\":{", "\"x\":{");
    let start = text.find(",\"x\":{").unwrap();
    let end = text.find(",\"strategies\"").unwrap();
    let text = format!("{},\"continues\":true{}", &text[..start], &text[end..]);
    let error = Record::parse(&text, 1).unwrap_err();
    assert_eq!((error.field.as_deref(), error.problem.as_str()), (Some("strategies"), NOT_WITH_CONTINUES));
}

#[test]
fn what_is_outside_of_0_to_1_or_not_finite_is_no_probability() {
    for field in ["mu_plus\":0.75", "mu_minus\":0.75", "epsilon\":0.1", "prior\":0.32", "agentInRoom(agent0,room0)\":0.25"] {
        let name = field.split('"').next().unwrap();
        for number in ["-0.1", "1.0000001", "1e999", "2"] {
            let error = refused(field, &format!("{name}\":{number}"));
            let found = number.to_string();
            assert_eq!(error.problem, format!("{found} is no probability; write a number from 0 to 1"));
            assert!(error.field.unwrap().ends_with(name));
        }
        for no_number in ["NaN", "Infinity", "-Infinity"] {
            let error = refused(field, &format!("{name}\":{no_number}"));
            assert!(error.problem.contains("is not JSON"));
        }
        let error = refused(field, &format!("{name}\":null"));
        assert!(error.problem.contains("; write "));
    }
}

#[test]
fn what_could_not_be_read_again_is_not_written() {
    let mut nan = header();
    nan.strategies.as_mut().unwrap()[0].epsilon = f64::NAN;
    let error = nan.to_json_line().unwrap_err();
    assert_eq!(error.field.as_deref(), Some("strategies[0].epsilon"));
    let mut both = header();
    both.continues = true;
    assert_eq!(both.to_json_line().unwrap_err().problem, NOT_WITH_CONTINUES);
    let mut version = header();
    version.environment.version = 7;
    assert!(version.to_json_line().is_err());
    let step = StepRecord::new(String::new(), None);
    assert!(step.to_json_line().unwrap_err().problem.starts_with("is empty"));
}

#[test]
fn a_labelled_session_tells_its_meaning_and_may_tell_a_way() {
    let line = r#"{"type":"session","version":1,"kind":"labelled","environment":{"version":1,"objects":[]},"command":"go around","intended":["agentInRoom(agent0,room0)"],"through":[["agentInRoom(agent0,room1)","agentInRoom(agent0,room2)"]],"avoiding":["agentInRoom(agent0,room3)"]}"#;
    let Record::Session(header) = Record::parse(line, 1).unwrap() else { panic!() };
    assert_eq!(header.kind, Kind::Labelled);
    assert!(header.has_way());
    assert_eq!(header.through.as_ref().unwrap()[0].len(), 2);
    assert_eq!(header.to_json_line().unwrap(), line);
    let told = |line: &str| Record::parse(line, 1).unwrap_err().to_string();
    let without = line.replace(r#","intended":["agentInRoom(agent0,room0)"]"#, "");
    assert_eq!(told(&without), r#"line 1: field "intended": is missing; add it"#);
    let shown = line.replace("labelled", "demonstration");
    let Record::Session(shown) = Record::parse(&shown, 1).unwrap() else { panic!() };
    let text =
        "agentInRoom(agent0,room0) through agentInRoom(agent0,room1) or agentInRoom(agent0,room2) avoiding agentInRoom(agent0,room3)";
    assert_eq!(shown.meant().unwrap().unwrap().to_string(), text);
    let nowhere = without.replace("labelled", "demonstration");
    assert_eq!(told(&nowhere), r#"line 1: field "through": belongs to an intended task; write "intended" too, or remove it"#);
    let torn = line.replace("room3", "room0");
    assert!(told(&torn).starts_with(r#"line 1: field "avoiding": avoids agentInRoom(agent0,room0), which it asks for as well"#));
}

#[test]
fn a_conversation_is_texts_by_name_of_a_session_that_listened() {
    let text = r#"{"type":"session","version":1,"kind":"feedback","environment":{"version":1,"objects":[]},"command":"go","utterance":"go","conversation":{"id":"said-1","last":"agentInRoom(agent0,room0)"}}"#;
    assert_eq!(Record::parse(text, 1).unwrap().to_json_line().unwrap(), text);
    let alone = Record::parse(&text.replace(r#""utterance":"go","#, ""), 1).unwrap_err();
    assert_eq!(alone.field.as_deref(), Some("conversation"));
    assert_eq!(alone.problem.to_string(), "belongs where the robot listened; write \"utterance\" too, or remove it");
    let number = Record::parse(&text.replace(r#""said-1""#, "1"), 1).unwrap_err();
    assert_eq!(number.field.as_deref(), Some("conversation.id"));
    assert!(Record::parse(&text.replace("said-1", ""), 1).is_err());
}
