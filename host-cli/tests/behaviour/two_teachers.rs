//! Two programs that would write one model: the second one is refused, and no lesson is lost.

use crate::program;

use program::{AGENT, END, goodbot, session, shown};
use std::fs;
use std::io::{BufRead, BufReader, Write};
use std::path::Path;
use std::process::{Child, ChildStdout, Command, Stdio};

const LESSON: [&str; 4] = ["command go to the red room", "step", "good", "finish"];

/// A teacher at the program, who has not left.
struct Teacher {
    child: Child,
    answers: BufReader<ChildStdout>,
}

impl Teacher {
    fn at(model: &Path) -> Self {
        let mut command = Command::new(env!("CARGO_BIN_EXE_goodbot"));
        command.args(["teach", "--lines", "--model"]).arg(model);
        let mut child = command.stdin(Stdio::piped()).stdout(Stdio::piped()).spawn().expect("the program runs");
        let answers = BufReader::new(child.stdout.take().expect("answers"));
        let mut teacher = Self { child, answers };
        teacher.hear("\"ready\"");
        teacher
    }

    /// Reads answers up to one with these letters.
    fn hear(&mut self, letters: &str) {
        let mut line = String::new();
        while !line.contains(letters) {
            line.clear();
            assert!(self.answers.read_line(&mut line).expect("an answer") > 0, "no {letters}");
        }
    }

    fn teach(&mut self) {
        for request in LESSON {
            writeln!(self.child.stdin.as_mut().expect("an input"), "{request}").expect("the program reads");
        }
        self.hear("\"learned\":true");
    }

    fn leave(mut self) {
        drop(self.child.stdin.take());
        assert!(self.child.wait().expect("the program ends").success());
    }
}

fn sessions(model: &Path) -> usize {
    let run = goodbot(&["inspect", model.to_str().unwrap(), "--sessions"], b"");
    assert_eq!(run.code, 0, "{}", run.messages);
    run.output.matches("go to the red room").count()
}

fn log() -> String {
    let header = session(AGENT, "demonstration", "up to the green one", r#","intended":["agentInRoom(agent0,room1)"]"#);
    [header, shown("north"), shown("north"), END.to_owned()].join("\n") + "\n"
}

#[test]
fn a_second_teacher_of_a_model_is_refused_by_name_whatever_the_log_is_called() {
    let folder = tempfile::tempdir().unwrap();
    let model = folder.path().join("m.goodbot");
    let mut first = Teacher::at(&model);
    let named = model.to_str().unwrap();
    let log = folder.path().join("b.jsonl");
    for more in [&[][..], &["--log", log.to_str().unwrap()]] {
        for _ in 0..2 {
            let run = goodbot(&[&["teach", "--lines", "--model", named][..], more].concat(), LESSON.join("\n").as_bytes());
            assert!(run.code == 2 && run.output.is_empty(), "{}", run.output);
            assert!(run.messages.contains("is being taught or learned in another window"), "{}", run.messages);
        }
        first.teach();
    }
    first.leave();
    assert_eq!(sessions(&model), 2);
    let mut names: Vec<_> = fs::read_dir(folder.path()).unwrap().map(|entry| entry.unwrap().file_name()).collect();
    names.sort();
    let left = if cfg!(unix) { names } else { names.into_iter().filter(|name| !name.to_string_lossy().ends_with(".lock")).collect() };
    assert_eq!(left, ["m.goodbot", "m.jsonl"]);
}

#[test]
fn a_model_that_is_being_taught_is_not_replaced_by_a_command() {
    let folder = tempfile::tempdir().unwrap();
    let path = |name: &str| folder.path().join(name);
    let model = path("m.goodbot");
    fs::write(path("log.jsonl"), log()).unwrap();
    let [named, log, other] = ["m.goodbot", "log.jsonl", "other.goodbot"].map(|name| path(name).to_str().unwrap().to_owned());
    assert_eq!(goodbot(&["learn", &log, "--out", &other], b"").code, 0);
    let mut teacher = Teacher::at(&model);
    teacher.teach();
    for command in [
        &["learn", &log, "--out", &named][..],
        &["learn", &log, "--out", &named, "--force"],
        &["merge", &other, &other, "--out", &named],
        &["unlearn", &other, "1", "--out", &named],
    ] {
        let run = goodbot(command, b"");
        assert!(run.code == 2 && run.messages.contains("m.goodbot: cannot be written to: another program"), "{}", run.messages);
    }
    // Reading disturbs nobody.
    assert_eq!(sessions(&model), 1);
    teacher.teach();
    teacher.leave();
    assert_eq!(sessions(&model), 2);
    assert_eq!(goodbot(&["learn", &log, "--out", &named], b"").code, 0);
}

/// A killed program leaves nothing that keeps the next one out.
#[test]
fn a_program_that_was_killed_keeps_nobody_out() {
    let folder = tempfile::tempdir().unwrap();
    let model = folder.path().join("m.goodbot");
    for lessons in 1..=3 {
        let mut teacher = Teacher::at(&model);
        teacher.teach();
        teacher.child.kill().unwrap();
        teacher.child.wait().unwrap();
        assert_eq!(sessions(&model), lessons);
    }
}
