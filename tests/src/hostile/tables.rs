//! Worlds of strangers, whose names try to be code in the C and Rust that `goodbot table` writes of them.

use super::{Bytes, Program};
use serde_json::{Value, json};
use std::path::Path;
use std::process::Command;
use std::sync::OnceLock;

/// A world like this, with other names. Names that tasks mention have no blank, bracket or quotation mark.
pub fn world(name: &str, object: &str, action: &str, value: &str) -> Value {
    json!({
        "type": "world", "name": name, "classes": ["lift", "floor"], "attributes": {"name": ["floor"]},
        "propositions": {"liftAtFloor": ["lift", "floor"]}, "variables": ["liftAtFloor"],
        "objects": [
            {"name": "lift0", "class": "lift"}, {"name": object, "class": "floor", "attributes": {"name": value}},
            {"name": "floor1", "class": "floor", "attributes": {"name": "roof"}}
        ],
        "facts": [format!("liftAtFloor(lift0,{object})")],
        "actions": [
            {"name": action, "conditions": [], "effects": ["liftAtFloor(lift0,floor1)"]},
            {"name": "down", "conditions": ["liftAtFloor(lift0,floor1)"], "effects": [format!("liftAtFloor(lift0,{object})")]}
        ],
        "task_kinds": ["liftAtFloor(?l,?f)"]
    })
}

/// The source of a world, or the reason why it was refused.
///
/// # Errors
/// The program's messages.
pub fn table(folder: &Path, world: &Value, language: &str, program: &Program<'_>) -> Result<String, String> {
    let file = folder.join("world.json");
    std::fs::write(&file, world.to_string()).unwrap();
    let run = program(&["table", file.to_str().unwrap(), language], b"");
    match run.code {
        0 => Ok(run.output),
        2 => Err(run.messages),
        code => panic!("{code}: {}", run.messages),
    }
}

/// A program with the content of its texts left out, and its numbers, some of which are lengths of names. A text ends at a quotation mark that no
/// `\` is before.
fn without_texts(program: &str) -> String {
    let (mut rest, mut letters) = (String::new(), program.chars());
    while let Some(letter) = letters.next() {
        rest.push(letter);
        if letter == '"' {
            while let Some(inner) = letters.next().filter(|inner| *inner != '"') {
                if inner == '\\' {
                    letters.next();
                }
            }
            rest.push('"');
        }
    }
    rest.replace(|letter: char| letter.is_ascii_digit(), "")
}

/// What a C compiler reads after the comments are gone, with the beginning of its identifiers as `world`.
pub fn read_by_c(folder: &Path, header: &str) -> String {
    let file = folder.join("world.c");
    std::fs::write(&file, header).unwrap();
    let include = concat!(env!("CARGO_MANIFEST_DIR"), "/../capi/include");
    let compile = |options: &[&str]| {
        let output = Command::new("cc").args(["-std=c11", "-I", include]).args(options).arg(&file).output();
        let output = output.expect("a C compiler, as Rust's linker needs");
        assert!(output.status.success(), "{}\n{header}", String::from_utf8_lossy(&output.stderr));
        String::from_utf8(output.stdout).expect("C in UTF-8")
    };
    compile(&["-Wall", "-Wextra", "-Werror", "-Wno-unused", "-fsyntax-only"]);
    let program = compile(&["-E", "-P"]);
    let table = program.find("_classes[]").expect("the first table");
    let begin = program[..table].rfind('*').map(|at| program[at..table].trim_start_matches("*const ").to_owned()).expect("its name");
    without_texts(&program.replace(&begin, "world"))
}

/// What a Rust compiler reads: all but comments and texts.
fn read_by_rust(module: &str) -> String {
    // Lines of comments end where Rust's lines end.
    assert!(!module.replace("\r\n", "\n").contains('\r'), "{module}");
    let program: Vec<&str> = module.split('\n').filter(|line| !line.starts_with("//")).collect();
    without_texts(&program.join("\n"))
}

/// What compilers read of a world with harmless names.
#[derive(Debug)]
pub struct Harmless {
    in_c: String,
    in_rust: String,
}

impl Harmless {
    /// Tables made by this program.
    pub fn new(folder: &Path, program: &Program<'_>) -> Self {
        let plain = world("plainlift", "floor0", "up", "garage");
        let source = |language| table(folder, &plain, language, program).expect("a harmless world");
        Self { in_c: read_by_c(folder, &source("--c")), in_rust: read_by_rust(&source("--rust")) }
    }

    /// Asserts that compilers read nothing more in the tables of this world, which differs from the harmless one in its names alone. Returns
    /// the number of tables that were not refused.
    pub fn assert_same(&self, folder: &Path, hostile: &Value, program: &Program<'_>) -> usize {
        let mut written = 0;
        for (language, plain) in [("--c", &self.in_c), ("--rust", &self.in_rust)] {
            let Ok(source) = table(folder, hostile, language, program) else { continue };
            let read = if language == "--c" { read_by_c(folder, &source) } else { read_by_rust(&source) };
            assert_eq!(read, *plain, "{language} {hostile}\n{source}");
            written += 1;
        }
        written
    }
}

/// A world whose names are these texts, as far as a name may be one: those of objects and actions stand in tasks, which have blanks, brackets and
/// quotation marks of their own.
pub fn named([name, object, action, value]: [&str; 4]) -> Value {
    let fits = |letter: &char| !(letter.is_whitespace() || letter.is_control() || "(),&?\"".contains(*letter));
    let [object, action] = [object, action].map(|name| format!("xqz{}", name.chars().filter(fits).collect::<String>()));
    world(&format!("xqz{name}"), &object, &action, &format!("xqz{value}"))
}

static HARMLESS: OnceLock<Harmless> = OnceLock::new();

/// The input is four names of a world, one after another, each with its length before it.
pub fn tables(input: &[u8], program: &Program<'_>) {
    let mut input = Bytes::new(input);
    let mut name = || {
        let most = input.below(48);
        input.text(most)
    };
    let hostile = named([&name(), &name(), &name(), &name()]);
    let folder = tempfile::tempdir().expect("a folder");
    let harmless = HARMLESS.get_or_init(|| Harmless::new(folder.path(), program));
    harmless.assert_same(folder.path(), &hostile, program);
}
