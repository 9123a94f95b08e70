//! The program as its users run it, and lines for its input.

use std::io::Write;
use std::process::{Command, Stdio};

pub use goodbot_tests::hostile::Run;

/// Runs the program with `input` as its standard input.
pub fn goodbot(arguments: &[&str], input: &[u8]) -> Run {
    let mut child = Command::new(env!("CARGO_BIN_EXE_goodbot"))
        .args(arguments)
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .expect("the program runs");
    let mut stdin = child.stdin.take().expect("an input");
    let input = input.to_vec();
    // A program that refuses early does not read all its input.
    let writer = std::thread::spawn(move || drop(stdin.write_all(&input)));
    let output = child.wait_with_output().expect("the program ends");
    writer.join().expect("the input is written");
    let text = |bytes: Vec<u8>| String::from_utf8(bytes).expect("messages are UTF-8");
    Run { code: output.status.code().unwrap_or(-1), output: text(output.stdout), messages: text(output.stderr) }
}

/// Runs the program with an output that is closed before its first word. Returns the exit code and the messages.
#[allow(dead_code, reason = "each test file uses what it needs")]
pub fn goodbot_unheard(arguments: &[&str], input: &[u8]) -> (i32, String) {
    let mut command = Command::new(env!("CARGO_BIN_EXE_goodbot"));
    let piped = command.args(arguments).stdin(Stdio::piped()).stdout(Stdio::piped()).stderr(Stdio::piped());
    let mut child = piped.spawn().expect("the program runs");
    drop(child.stdout.take());
    let mut stdin = child.stdin.take().expect("an input");
    stdin.write_all(input).expect("the program reads");
    drop(stdin);
    let output = child.wait_with_output().expect("the program ends");
    (output.status.code().unwrap_or(-1), String::from_utf8_lossy(&output.stderr).into_owned())
}

/// Two rooms, one above the other, with a door between them.
pub const ROOMS: &str = r#"{"class":"room","name":"room0","left":0,"bottom":0,"right":8,"top":4,"color":"red"},{"class":"room","name":"room1","left":0,"bottom":4,"right":8,"top":8,"color":"green"},{"class":"door","name":"door0","left":2,"bottom":4,"right":2,"top":4}"#;

/// An agent in the lower room.
pub const AGENT: &str = r#"{"class":"agent","name":"agent0","x":2,"y":3}"#;

/// A session line: in `ROOMS` with `objects`, with the fields `more`.
pub fn session(objects: &str, kind: &str, command: &str, more: &str) -> String {
    format!(
        r#"{{"type":"session","version":1,"id":"s","kind":"{kind}","environment":{{"version":1,"objects":[{ROOMS},{objects}]}},"command":"{command}"{more}}}"#
    )
}

/// A step line.
pub fn step(action: &str, feedback: &str) -> String {
    format!(r#"{{"type":"step","action":"{action}","feedback":"{feedback}"}}"#)
}

/// A step line of a demonstration.
#[allow(dead_code, reason = "each test file uses what it needs")]
pub fn shown(action: &str) -> String {
    format!(r#"{{"type":"step","action":"{action}"}}"#)
}

/// The end of a session that is learned from.
pub const END: &str = r#"{"type":"end","learn":true}"#;

/// A log of these lines.
pub fn log<const N: usize>(lines: [&str; N]) -> Vec<u8> {
    (lines.join("\n") + "\n").into_bytes()
}

/// Three storeys: the robot below, in the middle of the pink room; blue, red and yellow between; green above.
#[allow(dead_code, reason = "few tests need it")]
pub const THREE_STOREYS: &str = r#"{"version":1,"objects":[{"class":"room","name":"room0","left":0,"bottom":8,"right":12,"top":12,"color":"green"},{"class":"room","name":"room1","left":0,"bottom":4,"right":4,"top":8,"color":"blue"},{"class":"room","name":"room2","left":4,"bottom":4,"right":8,"top":8,"color":"red"},{"class":"room","name":"room3","left":8,"bottom":4,"right":12,"top":8,"color":"yellow"},{"class":"room","name":"room4","left":0,"bottom":0,"right":12,"top":4,"color":"pink"},{"class":"door","name":"door0","left":2,"bottom":4,"right":2,"top":4},{"class":"door","name":"door1","left":6,"bottom":4,"right":6,"top":4},{"class":"door","name":"door2","left":10,"bottom":4,"right":10,"top":4},{"class":"door","name":"door3","left":2,"bottom":8,"right":2,"top":8},{"class":"door","name":"door4","left":6,"bottom":8,"right":6,"top":8},{"class":"door","name":"door5","left":10,"bottom":8,"right":10,"top":8},{"class":"agent","name":"agent0","x":6,"y":2}]}"#;
