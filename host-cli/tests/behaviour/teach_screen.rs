//! `goodbot teach` in a real terminal: the tests press keys and read the screen.

use crate::window;

use portable_pty::CommandBuilder;
use tempfile::TempDir;
use window::Window;

fn teach(folder: &TempDir, arguments: &[&str], environment: &[(&str, &str)]) -> CommandBuilder {
    let mut command = CommandBuilder::new(env!("CARGO_BIN_EXE_goodbot"));
    command.arg("teach");
    command.args(arguments);
    command.env_remove("NO_COLOR");
    command.env("TERM", "xterm-256color");
    command.env("XDG_DATA_HOME", folder.path());
    command.env("HOME", folder.path());
    command.cwd(folder.path());
    for (name, value) in environment {
        command.env(name, value);
    }
    command
}

fn open(folder: &TempDir, arguments: &[&str]) -> Window {
    Window::open(teach(folder, arguments, &[]), 80, 24)
}

fn log(folder: &TempDir, robot: &str) -> String {
    std::fs::read_to_string(folder.path().join(format!("goodbot/{robot}.jsonl"))).unwrap_or_default()
}

#[test]
fn a_command_is_typed_judged_learned_and_there_again() {
    let folder = TempDir::new().unwrap();
    let mut window = open(&folder, &["--speed", "step"]);
    window.see("Tell it what to do");
    window.press("go to the red room\r");
    window.see("What it thinks you mean");
    window.see("is right");
    window.press("g");
    window.see("You said: good.");
    window.press("f");
    window.see("Learned.");
    window.see("learned from 1 session");
    window.press("\u{1b}");
    window.see("undo");
    window.press("q");
    assert!(window.end().success());
    window.wait("a terminal as found", Window::is_as_found);
    window.see("It has learned from 1 session");
    assert!(log(&folder, "robot").contains(r#""command":"go to the red room""#));
    assert!(folder.path().join("goodbot/robot.goodbot").exists());

    let mut again = open(&folder, &[]);
    again.see("Here it is again. It has learned from 1 session.");
    again.press("\u{3}");
    assert!(again.end().success());
}

#[test]
fn control_c_in_a_session_gives_the_terminal_back_and_loses_nothing() {
    let folder = TempDir::new().unwrap();
    let mut window = open(&folder, &["--speed", "step"]);
    window.see("Tell it what to do");
    assert!(window.is_taken_over());
    window.press("go to the red room\r");
    window.see("is right");
    window.press("b");
    window.see("You said: bad.");
    window.press("\u{3}");
    assert!(window.end().success());
    window.wait("a terminal as found", Window::is_as_found);
    let log = log(&folder, "robot");
    assert!(log.contains(r#""feedback":"punish""#) && log.contains(r#""learn":false"#), "{log}");
}

#[test]
fn signals_end_it_as_control_c_does() {
    for signal in ["TERM", "INT", "HUP"] {
        let folder = TempDir::new().unwrap();
        let mut window = open(&folder, &[]);
        window.see("Tell it what to do");
        window.signal(signal);
        assert!(window.end().success(), "{signal}");
        window.wait("a terminal as found", Window::is_as_found);
    }
}

#[test]
fn it_ends_when_its_window_is_closed_and_the_session_is_written_down() {
    // A program that does not control its terminal gets no signal when the terminal closes.
    for signalled in [true, false] {
        let folder = TempDir::new().unwrap();
        let mut command = teach(&folder, &["--speed", "step"], &[]);
        command.set_controlling_tty(signalled);
        let mut window = Window::open(command, 90, 30);
        window.see("Tell it what to do");
        window.press("go to the red room\r");
        window.see("is right");
        window.press("g");
        window.see("You said: good.");
        window.close();
        let log = log(&folder, "robot");
        assert!(log.contains(r#""feedback":"reward""#), "{log}");
    }
}

#[cfg(target_os = "linux")]
#[test]
fn control_z_stops_it_with_the_terminal_as_found_and_it_goes_on_where_it_was() {
    let stopped = |window: &Window| {
        let state = std::fs::read_to_string(format!("/proc/{}/stat", window.number())).unwrap_or_default();
        state.rsplit(')').next().is_some_and(|rest| rest.trim_start().starts_with('T'))
    };
    let folder = TempDir::new().unwrap();
    let mut window = open(&folder, &["--tour"]);
    for stop in ["key", "signal"] {
        window.see("Lesson 1 of 7");
        if stop == "key" {
            window.press("\u{1a}")
        } else {
            window.signal("TSTP")
        }
        window.wait("a stop", stopped);
        window.wait("a terminal as found", Window::is_as_found);
        window.signal("CONT");
        window.wait("the screen again", Window::is_taken_over);
        window.see("Lesson 1 of 7");
    }
    window.press("\u{3}");
    assert!(window.end().success());
}

#[test]
fn the_window_may_change_its_size() {
    let folder = TempDir::new().unwrap();
    let mut window = open(&folder, &["--tour"]);
    window.see("Lesson 1 of 7");
    window.see("Home");
    window.resize(40, 15);
    window.see("Tell it: go to the green room");
    window.resize(20, 5);
    window.see("Please make");
    window.resize(120, 40);
    window.see("speed: normal");
    window.see("ctrl-c leave");
    window.press("\u{3}");
    assert!(window.end().success());
}

#[test]
fn without_colours_none_is_written() {
    let folder = TempDir::new().unwrap();
    let colored = |bytes: &[u8]| String::from_utf8_lossy(bytes).contains("[38;5;") || String::from_utf8_lossy(bytes).contains("[48;5;");
    for (environment, expected) in [(&[][..], true), (&[("NO_COLOR", "1")][..], false)] {
        let mut window = Window::open(teach(&folder, &["--robot", "plain"], environment), 80, 24);
        window.see("@ robot");
        window.press("\u{3}");
        window.end();
        assert_eq!(colored(&window.bytes()), expected, "{environment:?}");
    }
}

/// The whole tour by hand: "a" lets a simulated trainer judge each lesson; the tests run by themselves.
#[test]
fn the_whole_tour_is_taught_by_keys() {
    let folder = TempDir::new().unwrap();
    let mut window = open(&folder, &["--tour", "--speed", "once"]);
    for lesson in 1..=7 {
        window.see(&format!("Lesson {lesson} of 7"));
        window.see("Tell it:");
        window.press("\r");
        window.see("Command:");
        window.press("a");
        window.wait("the next lesson", |window| !window.text().contains(&format!("Lesson {lesson} of 7")));
    }
    for test in 1..=5 {
        window.see(&format!("Test {test} of 5"));
        window.see("Tell it:");
        window.press("\r");
        window.see("It takes this for");
        window.press("\r");
    }
    window.see("The tour is over");
    window.see("of 5 tests");
    window.press("\u{3}");
    assert!(window.end().success());
    assert_eq!(log(&folder, "tour").matches(r#""learn":true"#).count(), 7);
    // An interrupted tour continues where it was.
    let mut again = open(&folder, &["--tour"]);
    again.see("Test 1 of 5");
    again.press("\u{3}");
    again.end();
}

#[test]
fn commands_that_read_sessions_count_them_on_a_terminal() {
    let folder = TempDir::new().unwrap();
    for (arguments, told) in [
        (&["learn", "-", "--out", "words.goodbot"][..], "reading sessions: 0"),
        (&["replay", "-"], "sessions replayed: 0"),
        (&["fit-trainers", "-"], "planning for sessions: 0"),
    ] {
        let mut command = CommandBuilder::new(env!("CARGO_BIN_EXE_goodbot"));
        command.args(arguments);
        command.env("TERM", "xterm-256color");
        command.cwd(folder.path());
        Window::open(command, 80, 24).see(told);
    }
}
