//! Files of strangers, whose names, words and ids have characters that a terminal obeys: no command sends them on, and lines of JSON and
//! pictures stay well-formed.

use crate::program::{END, Run, goodbot, shown, step};
use serde_json::{Value, json};
use std::path::Path;

/// What a name may try: colours, the terminal's own commands, the end of a text, another order of letters, letters without a shape, markup.
const TRIES: [&str; 7] =
    ["\u{1b}[31m", "\u{9b}2J\u{7}", "\0\u{1}\r", "\u{202e}\u{2066}", "\u{200b}\u{feff}\u{e0041}", "\u{fffe}\u{ffff}", "]]>&<\"'"];

/// Names, words and ids with a try in each that may have it, as files.
struct Place {
    folder: tempfile::TempDir,
}

impl Place {
    fn new(hostile: &str) -> Self {
        let folder = tempfile::tempdir().unwrap();
        // Names are mentioned in tasks, which have no control characters and no quotation marks.
        let name =
            |name: &str| format!("{name}{}", hostile.chars().filter(|it| !it.is_control() && !"\"&".contains(*it)).collect::<String>());
        let (room, block) = (name("room"), name("block"));
        let home = json!({"version": 1, "objects": [
            {"class": "room", "name": room, "left": 0, "bottom": 0, "right": 5, "top": 6, "color": format!("re{hostile}d")},
            {"class": "room", "name": "room1", "left": 5, "bottom": 0, "right": 10, "top": 6, "color": "blue"},
            {"class": "door", "name": name("door"), "left": 5, "bottom": 3, "right": 5, "top": 3},
            {"class": "block", "name": block, "x": 3, "y": 2, "color": "yellow", "shape": format!("ba{hostile}g")},
            {"class": "agent", "name": "agent0", "x": 2, "y": 1}
        ]});
        let mut log = String::new();
        for (number, kind) in ["demonstration", "feedback", "demonstration", "feedback"].into_iter().enumerate() {
            let header = json!({
                "type": "session", "version": 1, "id": format!("s{number}{hostile}"), "kind": kind, "environment": home,
                "command": format!("to the bl{hostile}ue {hostile}room"), "intended": ["agentInRoom(agent0,room1)"]
            });
            let steps = if kind == "feedback" {
                vec![step("north", "reward"), step("east", "punish")]
            } else {
                vec![shown("north"), shown("east")]
            };
            log += &[&[header.to_string()], &steps[..], &[END.to_owned(), String::new()]].concat().join("\n");
        }
        let world = json!({
            "type": "world", "name": format!("lift{hostile}"), "classes": ["lift", "floor"], "attributes": {"name": ["floor"]},
            "propositions": {"liftAtFloor": ["lift", "floor"]}, "variables": ["liftAtFloor"],
            "objects": [
                {"name": "lift0", "class": "lift"}, {"name": name("floor"), "class": "floor", "attributes": {"name": format!("ga{hostile}rage")}},
                {"name": "floor1", "class": "floor", "attributes": {"name": "roof"}}
            ],
            "facts": ["liftAtFloor(lift0,floor1)"],
            "actions": [
                {"name": "up", "conditions": [], "effects": ["liftAtFloor(lift0,floor1)"]},
                {"name": name("down"), "conditions": [], "effects": [format!("liftAtFloor(lift0,{})", name("floor"))]}
            ],
            "task_kinds": ["liftAtFloor(?l,?f)"]
        });
        let files = [
            ("home.json", home.to_string()),
            ("log.jsonl", log),
            ("world.json", world.to_string()),
            ("fault.json", world.to_string() + hostile),
        ];
        files.iter().for_each(|(name, text)| std::fs::write(folder.path().join(name), text).unwrap());
        Self { folder }
    }

    fn file(&self, name: &str) -> String {
        self.folder.path().join(name).to_str().unwrap().to_owned()
    }

    /// Runs a command line whose files are in this folder.
    fn run(&self, arguments: &str, hostile: &str, input: &str) -> Run {
        let is_file = |word: &str| Path::new(word).extension().is_some() && !word.contains('(');
        let words = arguments.split(' ').map(|word| if is_file(word) { self.file(word) } else { word.replace('~', hostile) });
        // The system gives no program an argument with a zero byte.
        let words: Vec<String> = words.map(|word| word.replace('\0', "")).collect();
        goodbot(&words.iter().map(String::as_str).collect::<Vec<_>>(), input.as_bytes())
    }
}

/// Characters that no output may have.
fn is_obeyed(letter: char) -> bool {
    letter.is_control() && !matches!(letter, '\n' | '\t')
        || matches!(letter, '\u{200b}'..='\u{200f}' | '\u{202a}'..='\u{202e}' | '\u{2060}'..='\u{206f}' | '\u{feff}' | '\u{e0000}'..='\u{e007f}')
}

/// Whether a picture is XML: its characters, its tags, one in the other, and its references.
fn assert_well_formed(svg: &str) {
    assert!(svg.chars().all(|letter| !matches!(letter, '\u{fffe}' | '\u{ffff}') && !is_obeyed(letter)), "{svg:?}");
    let (mut open, mut rest) = (Vec::new(), svg);
    while let Some((text, after)) = rest.split_once('<') {
        let is_reference = |part: &str| {
            part.split_once(';').is_some_and(|(name, _)| ["amp", "lt", "gt", "quot", "apos"].contains(&name) || name.starts_with('#'))
        };
        assert!(text.split('&').skip(1).all(is_reference) && !text.contains("]]>"), "{text}");
        if let Some(comment) = after.strip_prefix("!--") {
            rest = comment.split_once("-->").expect("the end of a comment").1;
            continue;
        }
        let (tag, after) = after.split_once('>').expect("the end of a tag");
        let name = |tag: &str| tag.split([' ', '\n']).next().unwrap_or_default().to_owned();
        match tag.strip_prefix('/') {
            Some(end) => assert_eq!(open.pop(), Some(name(end)), "{svg}"),
            None if tag.ends_with('/') => {}
            None => open.push(name(tag)),
        }
        assert!(tag.split('&').skip(1).all(is_reference), "{tag}");
        rest = after;
    }
    assert!(open.is_empty(), "{open:?}");
}

/// Every command that reads files of strangers. `~` stands for the hostile text.
const COMMANDS: [&str; 41] = [
    "check home.json",
    "check log.jsonl world.json fault.json",
    "check --json log.jsonl world.json fault.json home.json",
    "learn log.jsonl --out words.goodbot --json",
    "learn log.jsonl --out roles.goodbot --learner roles",
    "ask -w words.goodbot -e home.json to the blue room",
    "ask -w words.goodbot -e home.json --why go~ to the bl~ue room",
    "ask -w words.goodbot -e home.json --json go~ to the ba~g",
    "ask -w words.goodbot --log log.jsonl --why",
    "ask -w words.goodbot --log log.jsonl --json",
    "ask -w words.goodbot --log log.jsonl --session ~",
    "ask -w words.goodbot -e home.json --expected x~(agent0,room1) to the blue room",
    "ask -w words.goodbot -e world.json to the ga~rage",
    "inspect words.goodbot",
    "inspect words.goodbot --json",
    "inspect words.goodbot --sessions",
    "inspect words.goodbot --plot words.svg",
    "diff words.goodbot roles.goodbot",
    "diff words.goodbot roles.goodbot --json",
    "unlearn words.goodbot 1 --out less.goodbot",
    "unlearn words.goodbot s1~ --log log.jsonl --out less.goodbot",
    "merge words.goodbot less.goodbot --out both.goodbot",
    "parameters roles.goodbot --out parameters.h --c",
    "size home.json",
    "size home.json --log log.jsonl --json",
    "size world.json",
    "replay log.jsonl",
    "replay log.jsonl --json",
    "replay log.jsonl --plot plot.svg",
    "evaluate log.jsonl --k-fold 2",
    "evaluate log.jsonl --k-fold 2 --json",
    "evaluate --with words.goodbot --test log.jsonl",
    "fit-trainers log.jsonl",
    "table world.json --c",
    "table world.json --rust",
    "teach home.json --picture screen.svg --command to~ --intended agentInRoom(agent0,room1)",
    "teach home.json --lines",
    "teach world.json --lines",
    "doctor home.json log.jsonl fault.json",
    "convert fault.json home.json",
    "check --task ~ no-such-file~",
];

#[test]
fn no_command_sends_the_terminal_what_it_would_obey() {
    for hostile in TRIES {
        let place = Place::new(hostile);
        let lines =
            format!("command to the bl{hostile}ue room\nstep\ngood\nnonsense{hostile}\nfinish\ncommand to the ro{hostile}of\nstep\n");
        for command in COMMANDS {
            let run = place.run(command, hostile, &lines);
            assert!((0..=2).contains(&run.code), "{command}: {} {}", run.code, run.messages);
            let is_misused = run.messages.contains("For more information");
            assert!(!is_misused || command.contains("--task") || command.contains("--expected"), "{command}: {}", run.messages);
            for text in [&run.output, &run.messages] {
                assert!(!text.contains(is_obeyed), "{command} {hostile:?}: {text:?}");
            }
            if command.contains("--json") || command.contains("--lines") {
                for line in run.output.lines() {
                    let read: Result<Value, _> = serde_json::from_str(line);
                    assert!(read.is_ok(), "{command} {hostile:?}: {line}");
                }
            }
        }
        for picture in ["words.svg", "plot.svg", "screen.svg"] {
            assert_well_formed(&std::fs::read_to_string(place.file(picture)).expect(picture));
        }
    }
}

#[test]
fn lines_of_json_keep_the_words_of_a_stranger() {
    let hostile = "\u{9b}\u{202e}\u{e0041}";
    let run = Place::new(hostile).run("check --json log.jsonl", hostile, "");
    assert_eq!((run.code, run.output.is_ascii()), (0, true), "{}", run.output);
    let place = Place::new(hostile);
    assert_eq!(place.run("learn log.jsonl --out words.goodbot", hostile, "").code, 0);
    let run = place.run("ask -w words.goodbot --log log.jsonl --json", hostile, "");
    let first: Value = serde_json::from_str(run.output.lines().next().expect("a line")).unwrap();
    assert_eq!(first["session"], format!("s0{hostile}"));
}

#[test]
fn memory_follows_what_a_model_contains_and_not_what_it_claims() {
    // Its head says that it was saved from memory with room for 2^32 - 1 strategies.
    let claims = include_bytes!("hostile_texts/strategies-ffffffff.goodbot");
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("claims.goodbot");
    std::fs::write(&file, claims).unwrap();
    let file = file.to_str().unwrap();
    let limited = format!("ulimit -v 300000; exec {} inspect {file}", env!("CARGO_BIN_EXE_goodbot"));
    let run = std::process::Command::new("sh").args(["-c", &limited]).output().unwrap();
    assert!(run.status.success(), "{}", String::from_utf8_lossy(&run.stderr));
}
