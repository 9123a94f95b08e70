//! A robot that is taught line by line, for tests that read its answers.

use serde_json::Value;
use std::io::{BufRead, BufReader, Lines, Write};
use std::process::{Child, ChildStdin, ChildStdout, Command, Stdio};

/// A robot that is taught line by line.
pub struct Robot {
    child: Child,
    input: Option<ChildStdin>,
    output: Lines<BufReader<ChildStdout>>,
}

impl Robot {
    /// A robot that is taught with these options.
    pub fn new(arguments: &[&str]) -> Self {
        let mut child = Command::new(env!("CARGO_BIN_EXE_goodbot"))
            .args(["teach", "--lines"])
            .args(arguments)
            .stdin(Stdio::piped())
            .stdout(Stdio::piped())
            .spawn()
            .expect("the program");
        let mut output = BufReader::new(child.stdout.take().expect("a pipe")).lines();
        output.next().expect("a greeting").expect("text");
        Self { input: child.stdin.take(), output, child }
    }

    /// Sends a request, and returns the lines of the answer.
    pub fn tell(&mut self, request: &str) -> Vec<Value> {
        writeln!(self.input.as_mut().expect("a pipe"), "{request}").expect("a robot that listens");
        let read = |line: std::io::Result<String>| serde_json::from_str(&line.expect("text")).expect("JSON");
        self.output.by_ref().map(read).take_while(|line: &Value| line["type"] != "done").collect()
    }

    /// Sends a request, and returns the first line of the answer.
    pub fn one(&mut self, request: &str) -> Value {
        self.tell(request).into_iter().next().expect("an answer")
    }

    /// Walks until the robot thinks that its task is done, with feedback to each step. Returns the task that it followed.
    pub fn walk(&mut self, words: impl Fn(&Value) -> String) -> String {
        for _ in 0..60 {
            let step = self.one("step");
            let word = words(&step);
            self.tell(&word);
            if step["plan"] == "goal" {
                return step["task"].as_str().expect("a task").to_owned();
            }
        }
        panic!("the robot does not arrive");
    }
}

impl Drop for Robot {
    fn drop(&mut self) {
        self.input = None;
        let _ = self.child.wait();
    }
}

/// The right answer to a task, as a trainer would word it.
pub fn is_right(step: &Value, meant: &str) -> bool {
    step["tasks"]
        .as_array()
        .unwrap_or_else(|| panic!("no tasks for {meant}: {step}"))
        .iter()
        .any(|task| task["task"] == meant && task["right"] == true)
}
