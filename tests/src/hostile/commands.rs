//! Command lines on files of strangers: whose names, words and ids have characters that a terminal obeys, or which are damaged anywhere.

use super::Bytes;
use serde_json::{Value, json};
use std::path::Path;

/// The result of a run of the command line.
#[derive(Debug)]
pub struct Run {
    /// The exit code. A program that panicked or was killed has a code other than 0, 1 and 2.
    pub code: i32,
    /// Standard output.
    pub output: String,
    /// Standard error.
    pub messages: String,
}

/// Runs the command line with these arguments and this input: as a program of its own, or within this one.
pub type Program<'a> = dyn Fn(&[&str], &[u8]) -> Run + 'a;

/// What a name may try: colours, the terminal's own commands, the end of a text, another order of letters, letters without a shape, markup.
pub const TRIES: [&str; 7] =
    ["\u{1b}[31m", "\u{9b}2J\u{7}", "\0\u{1}\r", "\u{202e}\u{2066}", "\u{200b}\u{feff}\u{e0041}", "\u{fffe}\u{ffff}", "]]>&<\"'"];

/// Names, words and ids with a try in each that may have it, as files.
#[derive(Debug)]
pub struct Place {
    folder: tempfile::TempDir,
}

impl Place {
    /// A folder of such files.
    pub fn new(hostile: &str) -> Self {
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
                [r#"{"type":"step","action":"north","feedback":"reward"}"#, r#"{"type":"step","action":"east","feedback":"punish"}"#]
            } else {
                [r#"{"type":"step","action":"north"}"#, r#"{"type":"step","action":"east"}"#]
            };
            log += &format!("{header}\n{}\n{{\"type\":\"end\",\"learn\":true}}\n", steps.join("\n"));
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

    /// The path of a file of this name.
    pub fn file(&self, name: &str) -> String {
        self.folder.path().join(name).to_str().unwrap().to_owned()
    }

    /// Runs a command line whose files are in this folder.
    pub fn run(&self, arguments: &str, hostile: &str, input: &str, program: &Program<'_>) -> Run {
        let is_file = |word: &str| Path::new(word).extension().is_some() && !word.contains('(');
        let words = arguments.split(' ').map(|word| if is_file(word) { self.file(word) } else { word.replace('~', hostile) });
        // The system gives no program an argument with a zero byte.
        let words: Vec<String> = words.map(|word| word.replace('\0', "")).collect();
        program(&words.iter().map(String::as_str).collect::<Vec<_>>(), input.as_bytes())
    }

    /// Replaces a part of a file by what is left of the input.
    fn damage(&self, file: &str, input: &mut Bytes<'_>) {
        let kept = std::fs::read(self.file(file)).unwrap_or_default();
        let mut at = || (usize::from(input.byte()) << 8 | usize::from(input.byte())) % (kept.len() + 1);
        let (from, to) = (at(), at());
        let damaged = [&kept[..from], input.rest(), &kept[to..]].concat();
        std::fs::write(self.file(file), damaged).unwrap();
    }
}

/// Characters that no output may have.
pub fn is_obeyed(letter: char) -> bool {
    letter.is_control() && !matches!(letter, '\n' | '\t')
        || matches!(letter, '\u{200b}'..='\u{200f}' | '\u{202a}'..='\u{202e}' | '\u{2060}'..='\u{206f}' | '\u{feff}' | '\u{e0000}'..='\u{e007f}')
}

/// Whether a picture is XML: its characters, its tags, one in the other, and its references.
pub fn assert_well_formed(svg: &str) {
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
pub const COMMANDS: [&str; 35] = [
    "check home.json",
    "check log.jsonl world.json fault.json",
    "check --json log.jsonl world.json fault.json home.json",
    "learn log.jsonl --out words.goodbot --json",
    "learn log.jsonl --out roles.goodbot --learner roles",
    "ask -w words.goodbot -e home.json to the blue room",
    "ask -w words.goodbot -e home.json --why go~ to the bl~ue room",
    "ask -w words.goodbot -e home.json --json go~ to the ba~g",
    "ask -w words.goodbot -e world.json to the ga~rage",
    "inspect words.goodbot",
    "inspect words.goodbot --json",
    "inspect words.goodbot --sessions",
    "inspect words.goodbot --plot words.svg",
    "diff words.goodbot roles.goodbot",
    "diff words.goodbot roles.goodbot --json",
    "unlearn words.goodbot 1 --out less.goodbot",
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
    "teach home.json --lines",
    "teach world.json --lines",
    "convert fault.json home.json",
    "check --task ~ no-such-file~",
    "migrate words.goodbot --from world.json --to world.json --rename ~=~ --out moved.goodbot",
];

/// The commands that write the models which others read.
const MODELS: [&str; 3] = [COMMANDS[3], COMMANDS[4], "unlearn words.goodbot 1 --out less.goodbot"];

/// Runs one of the commands and checks what it sends: nothing that a terminal obeys, well-formed lines of JSON, and well-formed pictures.
pub fn assert_harmless(place: &Place, command: &str, hostile: &str, program: &Program<'_>) -> Run {
    let lines = format!("command to the bl{hostile}ue room\nstep\ngood\nnonsense{hostile}\nfinish\ncommand to the ro{hostile}of\nstep\n");
    let run = place.run(command, hostile, &lines, program);
    assert!((0..=2).contains(&run.code), "{command}: {} {}", run.code, run.messages);
    for text in [&run.output, &run.messages] {
        assert!(!text.contains(is_obeyed), "{command} {hostile:?}: {text:?}");
    }
    if command.contains("--json") || command.contains("--lines") {
        for line in run.output.lines() {
            let read: Result<Value, _> = serde_json::from_str(line);
            assert!(read.is_ok(), "{command} {hostile:?}: {line}");
        }
    }
    for picture in PICTURES {
        if let Ok(svg) = std::fs::read_to_string(place.file(picture)) {
            assert_well_formed(&svg);
        }
    }
    run
}

/// The pictures that the commands draw.
pub const PICTURES: [&str; 2] = ["words.svg", "plot.svg"];

/// The input chooses a command, and either is a part of every name, word and id, or replaces or damages one of the files.
pub fn commands(input: &[u8], program: &Program<'_>) {
    let mut input = Bytes::new(input);
    let command = input.one_of(&COMMANDS);
    let file = input.one_of(&["", "home.json", "log.jsonl", "world.json", "words.goodbot"]);
    let hostile = if file.is_empty() { input.text(24) } else { String::new() };
    let place = Place::new(&hostile);
    if command.contains("goodbot") && !command.starts_with("learn") {
        for first in MODELS {
            assert_harmless(&place, first, &hostile, program);
        }
    }
    if !file.is_empty() {
        place.damage(file, &mut input);
    }
    assert_harmless(&place, command, &hostile, program);
}
