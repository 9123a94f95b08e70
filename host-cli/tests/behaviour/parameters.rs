//! `goodbot parameters`, as it is used: lessons of a lift become the parameters of a board that does not learn.

use crate::program::goodbot;
use goodbot::snapshot::PARAMETERS_MAGIC;

const LIFT: &str = include_str!("../../../docs/examples/worlds/lift.json");
/// What the command writes for the lessons here, and capi/examples/obey.c obeys by.
const C: &str = include_str!("../../../capi/examples/lift_parameters.h");

/// A model of six lessons.
fn model(folder: &std::path::Path) -> String {
    let lesson = |(words, floor): (&str, u8)| {
        format!(r#"{{"type":"command","world":"lift","command":"{words}","intended":["liftAtFloor(lift0,floor{floor})"]}}"#) + "\n"
    };
    let said = [
        ("up to the roof", 3),
        ("to the roof please", 3),
        ("to the garage", 0),
        ("garage please", 0),
        ("the office", 2),
        ("to the office", 2),
    ];
    let world: String = LIFT.lines().collect::<String>() + "\n";
    let (log, model) = (folder.join("log.jsonl"), folder.join("lift.model"));
    std::fs::write(&log, world + &said.map(lesson).concat()).expect("a file");
    let [log, model] = [&log, &model].map(|path| path.to_str().expect("UTF-8"));
    let learned = goodbot(&["learn", log, "--learner", "roles", "--out", model], b"");
    assert_eq!(learned.code, 0, "{}", learned.messages);
    model.to_owned()
}

#[test]
fn a_model_becomes_parameters_as_bytes_and_as_an_array_in_c() {
    let folder = tempfile::tempdir().expect("a folder");
    let model = model(folder.path());
    let path = |name: &str| folder.path().join(name).to_str().expect("UTF-8").to_owned();
    let (bytes, source) = (path("lift.parameters"), path("lift.h"));
    for _ in 0..2 {
        let written = goodbot(&["parameters", &model, "--out", &bytes], b"");
        assert_eq!(written.code, 0, "{}", written.messages);
        assert_eq!(goodbot(&["parameters", &model, "--out", &source, "--c"], b"").code, 0);
    }
    let (bytes, source) = (std::fs::read(bytes).expect("bytes"), std::fs::read_to_string(source).expect("text"));
    assert!(bytes.starts_with(&PARAMETERS_MAGIC));
    let told = source.split_once('{').and_then(|(_, rest)| rest.split_once('}')).expect("an array").0;
    let told: Vec<u8> = told.split(',').map(str::trim).filter(|text| !text.is_empty()).map(|text| text.parse().expect("a byte")).collect();
    assert!(told == bytes);
    if source != C {
        let written = concat!(env!("CARGO_TARGET_TMPDIR"), "/lift_parameters.h");
        std::fs::write(written, source).expect("a file");
        panic!("the lessons come to other parameters: copy {written} to capi/examples");
    }
}

#[test]
fn what_is_no_model_of_roles_is_refused_and_no_file_of_somebody_else_is_replaced() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = |name: &str| folder.path().join(name).to_str().expect("UTF-8").to_owned();
    let (model, out) = (model(folder.path()), path("out"));
    std::fs::write(&out, "mine").expect("a file");
    let refused = goodbot(&["parameters", &model, "--out", &out], b"");
    assert!(refused.code == 2 && refused.messages.contains("is no file of parameters"), "{}", refused.messages);
    let (paper, log) = (path("paper.model"), concat!(env!("CARGO_MANIFEST_DIR"), "/../docs/examples/sessions.jsonl"));
    assert_eq!(goodbot(&["learn", log, "--learner", "paper", "--out", &paper], b"").code, 0);
    let refused = goodbot(&["parameters", &paper, "--out", &path("other")], b"");
    assert!(refused.code == 2 && refused.messages.contains("this is Model 2"), "{}", refused.messages);
}
