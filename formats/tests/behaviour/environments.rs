//! Environments: the reader, and the words of its errors.

use goodbot_formats::FormatError;
use goodbot_formats::environment::{EnvironmentFile, ObjectRecord};

const HOME: &str = r#"{"version":1,"objects":[{"class":"room","name":"room0","left":0,"bottom":0,"right":8,"top":4,"color":"red"},{"class":"door","name":"door0","left":2,"bottom":4,"right":2,"top":4},{"class":"agent","name":"agent0","x":4,"y":2},{"class":"block","name":"block0","x":2,"y":2,"color":"yellow","shape":"chair"}]}"#;

fn refused(text: &str) -> FormatError {
    match EnvironmentFile::parse(text) {
        Ok(home) => panic!("was read as {home:?}"),
        Err(error) => error,
    }
}

/// The error of an environment with this object on line 2.
fn refused_object(object: &str) -> String {
    let error = refused(&format!("{{\"version\":1,\"objects\":[\n{object}]}}"));
    assert_eq!(error.line, 2, "{error}");
    error.to_string()
}

#[test]
fn the_line_is_written_as_it_was_read() {
    let home = EnvironmentFile::parse(HOME).unwrap();
    assert_eq!(home.to_json_line(), HOME);
}

/// The home on many lines.
fn pretty() -> String {
    serde_json::to_string_pretty(&EnvironmentFile::parse(HOME).unwrap()).unwrap()
}

#[test]
fn the_order_of_fields_is_free_and_the_extremes_are_read() {
    let text = r#"{"objects":[{"y":-2147483648,"x":2147483647,"name":"agent0","class":"agent"}],"version":1}"#;
    let home = EnvironmentFile::parse(text).unwrap();
    let agent = ObjectRecord::Agent { name: "agent0".into(), x: i32::MAX, y: i32::MIN };
    assert_eq!(home, EnvironmentFile::new(vec![agent]));
}

#[test]
fn a_byte_order_mark_and_crlf_line_ends_are_accepted() {
    let windows = format!("\u{feff}{}", pretty().replace('\n', "\r\n"));
    assert_eq!(EnvironmentFile::parse(&windows).unwrap().to_json_line(), HOME);
}

#[test]
fn an_unknown_field_is_named_with_its_line_and_column_in_a_pretty_file() {
    let typo = pretty().replace("\"color\": \"yellow\"", "\"colour\": \"yellow\"");
    let line = 1 + typo.lines().position(|l| l.contains("colour")).unwrap();
    let error = refused(&typo).with_file("home.json");
    assert_eq!((error.line, error.column), (line, Some(7)));
    assert_eq!(
        error.to_string(),
        format!("home.json:{line}: field \"objects[3].colour\": is not known here; known are class, name, x, y, color, shape")
    );
}

#[test]
fn a_field_of_another_class_is_unknown_even_before_the_class() {
    assert_eq!(
        refused_object(r#"{"color":"red","class":"door","name":"d","left":0,"bottom":0,"right":0,"top":0}"#),
        "line 2: field \"objects[0].color\": is not known here; known are class, name, left, bottom, right, top"
    );
}

#[test]
fn duplicate_fields_are_refused_the_class_and_escaped_names_too() {
    for (twice, field) in [
        (r#"{"class":"agent","class":"agent","name":"a","x":1,"y":1}"#, "class"),
        (r#"{"class":"agent","name":"a","x":1,"y":1,"x":1}"#, "x"),
        (r#"{"class":"agent","name":"a","x":1,"y":1,"\u0078":1}"#, "x"),
    ] {
        let wanted = format!("line 2: field \"objects[0].{field}\": is given twice; keep one of the two");
        assert_eq!(refused_object(twice), wanted);
    }
    let error = refused(r#"{"version":1,"objects":[],"objects":[]}"#);
    assert_eq!((error.problem.as_str(), error.field.as_deref()), ("is given twice; keep one of the two", Some("objects")));
}

#[test]
fn every_field_is_missed_by_its_name() {
    let home: serde_json::Value = serde_json::from_str(HOME).unwrap();
    for (index, object) in home["objects"].as_array().unwrap().iter().enumerate() {
        for name in object.as_object().unwrap().keys() {
            let mut less = home.clone();
            less["objects"][index].as_object_mut().unwrap().remove(name);
            let error = refused(&less.to_string());
            assert_eq!(error.problem, "is missing; add it");
            assert_eq!(error.field, Some(format!("objects[{index}].{name}")));
        }
    }
    for name in ["version", "objects"] {
        let mut less = home.clone();
        less.as_object_mut().unwrap().remove(name);
        assert_eq!(refused(&less.to_string()).field.as_deref(), Some(name));
    }
}

#[test]
fn another_version_is_told_of_before_its_unknown_fields() {
    let wanted = "line 1: field \"version\": version 2 is unknown; write 1, or use a newer goodbot";
    assert_eq!(refused(r#"{"things":[],"version":2}"#).to_string(), wanted);
    for version in ["1.0", "\"1\"", "null", "-1", "99999999999999999999", "[1]"] {
        let error = refused(&format!("{{\"version\":{version},\"objects\":[]}}"));
        let found = version.to_string();
        assert_eq!(error.problem, format!("version {found} is unknown; write 1, or use a newer goodbot"));
    }
}

#[test]
fn what_is_no_cell_is_refused() {
    for number in ["1.5", "2147483648", "1e3", "-99999999999999999999999999", "1e999999"] {
        let text = refused_object(&format!("{{\"class\":\"agent\",\"name\":\"a\",\"x\":{number},\"y\":2}}"));
        let wanted = format!("line 2: field \"objects[0].x\": {number} is no cell; ");
        assert!(text.starts_with(&wanted), "{text}");
    }
    let long = "9".repeat(1000);
    let text = refused_object(&format!("{{\"class\":\"agent\",\"name\":\"a\",\"x\":{long},\"y\":2}}"));
    assert!(text.len() < 200, "{text}");
}

#[test]
fn values_of_another_kind_are_told_apart() {
    for (value, found) in [("null", "null"), ("7", "a number"), ("true", "true or false"), ("[]", "a list"), ("{}", "an object")] {
        assert_eq!(
            refused_object(&format!("{{\"class\":\"agent\",\"name\":{value},\"x\":1,\"y\":2}}")),
            format!("line 2: field \"objects[0].name\": is {found}; write a text")
        );
    }
    assert_eq!(refused_object("7"), "line 2: field \"objects[0]\": is a number; write an object");
    assert_eq!(refused("[]").to_string(), "line 1: is a list; write an object");
}

#[test]
fn an_unknown_class_is_told_with_the_known_ones() {
    assert_eq!(
        refused_object(r#"{"class":"lamp","name":"a"}"#),
        "line 2: field \"objects[0].class\": \"lamp\" is not known; write room, door, agent or block"
    );
}

#[test]
fn names_are_unique_and_fit_into_tasks() {
    let agent = r#"{"class":"agent","name":"a","x":1,"y":2}"#;
    assert_eq!(refused_object(&format!("{agent},{agent}")), "line 2: field \"objects[1].name\": \"a\" is here twice; name each once");
    for name in ["", "a b", "a,b", "a(b", "?a", "a&b", "a\\u0007"] {
        let text = refused_object(&agent.replace("\"a\"", &format!("\"{name}\"")));
        assert!(text.contains("cannot be in a task"), "{text}");
    }
}

#[test]
fn what_is_no_json_is_told_with_its_line_and_column() {
    let error = refused("{\"version\":1,\n \"é\":NaN}");
    assert_eq!((error.line, error.column), (2, Some(6)));
    assert!(error.to_string().starts_with("line 2: is not JSON (expected value); correct it"));
    assert!(refused(&HOME[..HOME.len() - 1]).problem.contains("ends in the middle of a value"));
    assert!(refused(" \n").problem.contains("there is nothing here"));
    let error = refused(&format!("{HOME}\n{{}}"));
    assert_eq!(error.line, 2);
    assert!(error.to_string().contains("trailing characters"), "{error}");
}
