//! Files stay: inputs and foreign files are not replaced, and wanted files are written even if nobody reads the text.

use crate::program;

use program::{AGENT, END, Run, goodbot, goodbot_unheard, session, shown};
use std::fs;
use std::path::{Path, PathBuf};

/// A folder with a log and a model of it.
struct Place {
    folder: tempfile::TempDir,
}

impl Place {
    fn new() -> Self {
        let place = Self { folder: tempfile::tempdir().expect("a folder") };
        fs::write(place.path("log.jsonl"), log()).expect("a log");
        assert_eq!(place.run(&["learn", "log.jsonl", "--out", "model"]).code, 0);
        place
    }

    fn path(&self, name: &str) -> PathBuf {
        self.folder.path().join(name)
    }

    /// The arguments, with the folder before the names of its files.
    fn words(&self, arguments: &[&str]) -> Vec<String> {
        let named = ["log.jsonl", "model", "other", "link", "hard", "picture.svg", "notes.txt", "home.json"];
        let word = |word: &&str| if named.contains(word) { self.path(word).to_str().unwrap().to_owned() } else { (*word).to_owned() };
        arguments.iter().map(word).collect()
    }

    fn run(&self, arguments: &[&str]) -> Run {
        goodbot(&self.words(arguments).iter().map(String::as_str).collect::<Vec<_>>(), b"")
    }

    #[track_caller]
    fn assert_kept(&self, file: &str, arguments: &[&str], message: &str) {
        let before = fs::read(self.path(file)).unwrap();
        let run = self.run(arguments);
        assert_eq!(run.code, 2, "{arguments:?} {}", run.output);
        assert!(run.messages.contains(message), "{arguments:?}: {}", run.messages);
        assert_eq!(fs::read(self.path(file)).unwrap(), before, "{arguments:?}");
    }
}

fn log() -> String {
    let intended = r#","intended":["agentInRoom(agent0,room1)"]"#;
    let lesson = |id: usize| {
        let header = session(AGENT, "demonstration", "up to the green one", intended).replace(r#""id":"s""#, &format!(r#""id":"s{id}""#));
        [header, shown("north"), shown("north"), END.to_owned()].join("\n")
    };
    (0..4).map(lesson).collect::<Vec<_>>().join("\n") + "\n"
}

const READ: &str = "is read here, and would be replaced; write to another file";

#[test]
fn an_input_is_never_replaced() {
    let place = Place::new();
    place.assert_kept("log.jsonl", &["learn", "log.jsonl", "--out", "log.jsonl"], READ);
    place.assert_kept("log.jsonl", &["learn", "log.jsonl", "--out", "log.jsonl", "--force"], READ);
    place.assert_kept("log.jsonl", &["evaluate", "log.jsonl", "--plot", "log.jsonl", "--force"], READ);
    place.assert_kept("log.jsonl", &["evaluate", "log.jsonl", "--curve", "log.jsonl", "--force"], READ);
    place.assert_kept("log.jsonl", &["evaluate", "--with", "model", "--test", "log.jsonl", "--plot", "log.jsonl", "--force"], READ);
    place.assert_kept("model", &["evaluate", "--with", "model", "--test", "log.jsonl", "--plot", "model", "--force"], READ);
    place.assert_kept("model", &["inspect", "model", "--plot", "model", "--force"], READ);
    fs::copy(place.path("model"), place.path("other")).unwrap();
    place.assert_kept("other", &["merge", "model", "other", "--out", "other", "--force"], READ);
}

#[test]
#[cfg(unix)]
fn an_input_is_not_replaced_through_a_link() {
    let place = Place::new();
    std::os::unix::fs::symlink(place.path("log.jsonl"), place.path("link")).unwrap();
    fs::hard_link(place.path("log.jsonl"), place.path("hard")).unwrap();
    for link in ["link", "hard"] {
        place.assert_kept("log.jsonl", &["learn", "log.jsonl", "--out", link, "--force"], READ);
        place.assert_kept("log.jsonl", &["learn", link, "--out", "log.jsonl", "--force"], READ);
    }
}

#[test]
#[cfg(target_os = "linux")]
fn an_input_is_not_replaced_whatever_letters_its_name_has() {
    use std::os::unix::ffi::OsStrExt;
    let place = Place::new();
    let odd = place.folder.path().join(std::ffi::OsStr::from_bytes(b"m\xff"));
    fs::copy(place.path("model"), &odd).unwrap();
    for command in [&["inspect"][..], &["unlearn"], &["merge"]] {
        let mut program = std::process::Command::new(env!("CARGO_BIN_EXE_goodbot"));
        program.args(command).arg(&odd);
        match command {
            ["inspect"] => program.arg("--plot").arg(&odd),
            ["unlearn"] => program.arg("1").arg("--out").arg(&odd),
            _ => program.arg(place.path("model")).arg("--out").arg(&odd),
        };
        let run = program.arg("--force").output().unwrap();
        assert!(String::from_utf8_lossy(&run.stderr).contains(READ), "{command:?}: {}", String::from_utf8_lossy(&run.stderr));
    }
}

#[test]
fn a_foreign_file_is_replaced_only_when_it_is_said() {
    let place = Place::new();
    fs::write(place.path("notes.txt"), "what I must not forget").unwrap();
    place.assert_kept("notes.txt", &["learn", "log.jsonl", "--out", "notes.txt"], "is there already and is no model of goodbot's");
    place.assert_kept("notes.txt", &["inspect", "model", "--plot", "notes.txt"], "is there already and is no picture of goodbot's");
    place.assert_kept("notes.txt", &["evaluate", "log.jsonl", "--plot", "notes.txt"], "--force");
    place.assert_kept("notes.txt", &["paper", "--plot", "notes.txt"], "--force");
    place.assert_kept("model", &["inspect", "model", "--plot", "model"], READ);
    place.assert_kept("notes.txt", &["merge", "model", "model", "--out", "notes.txt"], "--force");
    assert_eq!(place.run(&["learn", "log.jsonl", "--out", "notes.txt", "--force"]).code, 0);
    assert!(fs::read(place.path("notes.txt")).unwrap().starts_with(b"goodbot\0"));
}

#[test]
fn our_own_models_and_pictures_are_replaced() {
    let place = Place::new();
    for _ in 0..2 {
        assert_eq!(place.run(&["learn", "log.jsonl", "--out", "model"]).code, 0);
        assert_eq!(place.run(&["inspect", "model", "--plot", "picture.svg"]).code, 0);
        assert_eq!(place.run(&["evaluate", "log.jsonl", "--plot", "picture.svg"]).code, 0);
    }
    assert!(fs::read_to_string(place.path("picture.svg")).unwrap().starts_with("<svg"));
}

#[test]
fn what_was_asked_for_is_written_although_the_reader_has_left() {
    let place = Place::new();
    let cases: [&[&str]; 4] = [
        &["inspect", "model", "--plot", "picture.svg"],
        &["evaluate", "log.jsonl", "--json", "--plot", "picture.svg"],
        &["paper", "--plot", "picture.svg"],
        &["study", "--courses", "paper", "--agents", "paper", "--runs", "1", "--json", "--plot", "picture.svg"],
    ];
    for arguments in cases {
        let _ = fs::remove_file(place.path("picture.svg"));
        let words = place.words(arguments);
        let (code, messages) = goodbot_unheard(&words.iter().map(String::as_str).collect::<Vec<_>>(), b"");
        assert_eq!(code, 0, "{arguments:?} {messages}");
        assert!(fs::read_to_string(place.path("picture.svg")).is_ok_and(|svg| svg.contains("</svg>")), "{arguments:?}");
    }
    let words = place.words(&["learn", "log.jsonl", "--out", "other"]);
    assert_eq!(goodbot_unheard(&words.iter().map(String::as_str).collect::<Vec<_>>(), b"").0, 0);
    assert_eq!(fs::read(place.path("other")).unwrap(), fs::read(place.path("model")).unwrap());
}

#[test]
fn a_dash_is_standard_output_and_the_text_then_goes_beside_it() {
    let place = Place::new();
    let run = place.run(&["evaluate", "log.jsonl", "--plot", "-"]);
    assert!(run.output.starts_with("<svg") && run.output.trim_end().ends_with("</svg>"), "{}", run.output);
    assert!(run.messages.contains("accuracy"), "{}", run.messages);
    let inspected = place.run(&["inspect", "model", "--plot", "-"]);
    assert!(inspected.output.starts_with("<svg") && inspected.messages.contains("4 sessions"), "{}", inspected.messages);
    let replayed = place.run(&["replay", "log.jsonl", "--plot", "-"]);
    assert!(replayed.output.starts_with("<svg") && replayed.messages.contains("4 learned from"), "{}", replayed.messages);
    let both = place.run(&["evaluate", "log.jsonl", "--plot", "-", "--curve", "-"]);
    assert_eq!((both.code, both.output.as_str()), (2, ""));
    assert!(both.messages.contains("cannot both go to standard output"), "{}", both.messages);
    let learned = std::process::Command::new(env!("CARGO_BIN_EXE_goodbot"))
        .args(["learn", place.path("log.jsonl").to_str().unwrap(), "--out", "-"])
        .output()
        .unwrap();
    assert_eq!(learned.stdout, fs::read(place.path("model")).unwrap());
    assert!(!Path::new("-").exists());
}

/// Runs the program with at most two gigabytes, for a minute at most.
#[cfg(target_os = "linux")]
fn bounded(arguments: &str) -> (Option<i32>, String) {
    let command = format!("ulimit -v 2000000; exec timeout 60 {} {arguments}", env!("CARGO_BIN_EXE_goodbot"));
    let output = std::process::Command::new("sh").args(["-c", &command]).output().unwrap();
    (output.status.code(), String::from_utf8_lossy(&output.stderr).into_owned())
}

#[test]
#[cfg(target_os = "linux")]
fn what_never_ends_is_refused_in_bounded_memory_and_time() {
    let place = Place::new();
    let (log, model) = (place.path("log.jsonl"), place.path("model"));
    let (log, model, other) = (log.display(), model.display(), place.path("other"));
    for arguments in [
        "inspect /dev/zero".to_owned(),
        "check /dev/zero".to_owned(),
        "check /dev/urandom".to_owned(),
        format!("learn /dev/zero --out {}", other.display()),
        format!("learn /dev/urandom --keep-going --out {}", other.display()),
        "evaluate /dev/zero".to_owned(),
        "replay /dev/zero".to_owned(),
        "replay --keep-going /dev/urandom".to_owned(),
        "teach --lines < /dev/zero".to_owned(),
        format!("merge /dev/zero {model} --out {}", other.display()),
        format!("ask --with {model} --environment /dev/zero go"),
        format!("evaluate {log} --novel-environments 100000"),
        format!("evaluate {log} --k-fold 99999999999"),
        format!("evaluate {log} --k-fold 1"),
        format!("evaluate {log} --curve {} --runs 99999999", other.display()),
        "paper --runs 99999999999".to_owned(),
        format!("inspect {model} --most 99999999999"),
    ] {
        let (code, messages) = bounded(&arguments);
        assert_eq!(code, Some(2), "{arguments}: {messages}");
        assert!(messages.len() < 1 << 20, "{arguments} says {} bytes", messages.len());
    }
    assert!(!other.exists());
}

#[test]
#[cfg(target_os = "linux")]
fn a_home_of_too_many_objects_is_refused_in_bounded_memory() {
    let folder = tempfile::tempdir().unwrap();
    let home = folder.path().join("home.json");
    let blocks = (0..400_000)
        .map(|block| format!("{{\"class\":\"block\",\"name\":\"b{block}\",\"x\":1,\"y\":1,\"color\":\"red\",\"shape\":\"bag\"}}"));
    let text = |blocks: Vec<String>| format!("{{\"version\":1,\"objects\":[{}]}}", blocks.join(","));
    for (count, told) in [(400_000, "has more than 65536 entries"), (60_000, "are the most; leave out some")] {
        std::fs::write(&home, text(blocks.clone().take(count).collect())).unwrap();
        for command in ["check", "size", "teach --lines"] {
            let limited = format!("ulimit -v 250000; exec timeout 10 {} {command} {}", env!("CARGO_BIN_EXE_goodbot"), home.display());
            let run = std::process::Command::new("sh").args(["-c", &limited]).output().unwrap();
            let messages = String::from_utf8_lossy(&run.stderr);
            assert!(run.status.code() == Some(2) && messages.contains(told), "{command}: {messages}");
        }
    }
}

#[test]
#[cfg(unix)]
fn a_link_to_a_file_that_is_not_there_yet_is_followed_and_is_no_way_around_an_input() {
    let place = Place::new();
    std::os::unix::fs::symlink("other", place.path("link")).unwrap();
    assert_eq!(place.run(&["learn", "log.jsonl", "--out", "link"]).code, 0);
    assert!(std::fs::symlink_metadata(place.path("link")).unwrap().is_symlink() && place.path("other").is_file());
    fs::remove_file(place.path("other")).unwrap();
    let run = place.run(&["inspect", "model", "--plot", "link"]);
    assert_eq!(run.code, 0, "{}", run.messages);
    assert!(fs::read_to_string(place.path("other")).unwrap().starts_with("<svg"));
}

#[test]
fn two_pictures_do_not_go_into_one_file() {
    let place = Place::new();
    let same = place.folder.path().join(".").join("picture.svg");
    let run = place.run(&["evaluate", "log.jsonl", "--plot", "picture.svg", "--curve", same.to_str().unwrap()]);
    assert!(run.code == 2 && run.messages.contains("two things cannot both be written there"), "{}", run.messages);
    assert!(!same.exists());
}

#[test]
#[cfg(target_os = "linux")]
fn an_output_that_cannot_be_written_is_an_error() {
    let place = Place::new();
    for arguments in ["check", "check --json", "inspect", "replay"] {
        let file = place.path(if arguments == "inspect" { "model" } else { "log.jsonl" });
        let command = format!("exec {} {arguments} {} > /dev/full", env!("CARGO_BIN_EXE_goodbot"), file.display());
        let output = std::process::Command::new("sh").args(["-c", &command]).output().unwrap();
        let messages = String::from_utf8_lossy(&output.stderr);
        assert!(output.status.code() == Some(1) && messages.contains("cannot write to standard output"), "{arguments}: {messages}");
    }
}

#[test]
#[cfg(target_os = "linux")]
fn messages_that_cannot_be_written_change_no_exit_code() {
    for arguments in ["check not-there", "lern", "inspect not-there", "ask", "teach --lines"] {
        let command = format!("echo nonsense | {} {arguments} 2> /dev/full", env!("CARGO_BIN_EXE_goodbot"));
        let output = std::process::Command::new("sh").args(["-c", &command]).output().unwrap();
        assert_eq!(output.status.code(), Some(2), "{arguments}");
    }
}

/// A limit of the sizes of files is a full disk for one program alone.
#[test]
#[cfg(unix)]
fn a_full_disk_is_told_without_the_name_of_an_unfinished_file() {
    let place = Place::new();
    let (log, model) = (place.path("log.jsonl"), place.path("full.goodbot"));
    let command =
        format!("trap '' XFSZ; ulimit -f 0; exec {} learn {} --out {}", env!("CARGO_BIN_EXE_goodbot"), log.display(), model.display());
    let output = std::process::Command::new("sh").args(["-c", &command]).output().unwrap();
    let messages = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.code() == Some(2) && messages.contains("full.goodbot cannot be written"), "{messages}");
    assert!(!messages.contains(".part") && !model.exists(), "{messages}");
}

#[test]
fn a_folder_and_a_place_that_is_not_there_are_known_before_the_work() {
    let place = Place::new();
    let missing = place.path("missing").join("picture.svg");
    let run = goodbot(&["paper", "--runs", "100000", "--plot", missing.to_str().unwrap()], b"");
    assert_eq!(run.code, 2);
    assert!(run.messages.contains("no file can be written there"), "{}", run.messages);
    let folder = place.folder.path().to_str().unwrap();
    let run = place.run(&["learn", "log.jsonl", "--out", folder]);
    assert!(run.code == 2 && run.messages.contains("is a folder"), "{}", run.messages);
}

/// Not every name of a file is text: `teach --model` writes such a log, and every command reads it.
#[test]
#[cfg(target_os = "linux")]
fn a_file_may_have_any_name_that_the_system_allows() {
    use std::os::unix::ffi::OsStrExt;
    let place = Place::new();
    let name = |name: &[u8]| place.folder.path().join(std::ffi::OsStr::from_bytes(name));
    let [log, home, out] = [&b"log\xff\x1b.jsonl"[..], b"home\xff.json", b"model\xff.goodbot"].map(name);
    fs::copy(place.path("log.jsonl"), &log).unwrap();
    fs::write(&home, goodbot(&["example", "home"], b"").output).unwrap();
    let run = |words: &[&str], files: &[&PathBuf]| {
        let run = std::process::Command::new(env!("CARGO_BIN_EXE_goodbot")).args(words).args(files).output().unwrap();
        assert!(run.status.success(), "{words:?}: {}", String::from_utf8_lossy(&run.stderr));
        String::from_utf8(run.stdout).unwrap()
    };
    assert!(run(&["check"], &[&log, &home]).contains("log\u{fffd}\\u001b.jsonl: 4 sessions"));
    run(&["learn", "--out", place.path("other").to_str().unwrap()], &[&log]);
    run(&["replay"], &[&log]);
    run(&["evaluate", "--k-fold", "2"], &[&log]);
    run(&["size"], &[&home]);
    run(&["learn", place.path("log.jsonl").to_str().unwrap(), "--out"], &[&out]);
    let asked = std::process::Command::new(env!("CARGO_BIN_EXE_goodbot"))
        .args(["ask", "go", "up", "--with"])
        .arg(&out)
        .arg("--environment")
        .arg(&home)
        .output()
        .unwrap();
    assert!(asked.status.success(), "{}", String::from_utf8_lossy(&asked.stderr));
}
