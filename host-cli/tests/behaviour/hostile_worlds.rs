//! Worlds of strangers, whose names try to be code: `goodbot table` writes their robots, and only their robots.

use crate::program::goodbot;
use rand_core::{Rng, SeedableRng};
use rand_pcg::Pcg32;
use serde_json::{Value, json};
use std::path::Path;
use std::process::Command;

/// Parts of names that end a comment, a text or a line in C or Rust, or begin a new one.
const PARTS: [&str; 24] = [
    "*/",
    "/*",
    "//",
    "\"",
    "\\",
    "\n",
    "\r\n",
    "\u{2028}",
    "??/",
    "??'",
    "#define x 1",
    "`",
    "{",
    "};",
    ";",
    "(",
    "\0",
    "\u{1b}[31m",
    "\u{202e}",
    "ü",
    "int f(void)",
    "\\u{41}",
    "%s",
    "'",
];

/// A world like this, with other names. Names that tasks mention have no blank, bracket or quotation mark.
fn world(name: &str, object: &str, action: &str, value: &str) -> Value {
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
fn table(folder: &Path, world: &Value, language: &str) -> Result<String, String> {
    let file = folder.join("world.json");
    std::fs::write(&file, world.to_string()).unwrap();
    let run = goodbot(&["table", file.to_str().unwrap(), language], b"");
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
fn read_by_c(folder: &Path, header: &str) -> String {
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

#[test]
fn no_name_of_a_world_becomes_code() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    let plain = world("plainlift", "floor0", "up", "garage");
    let [in_c, in_rust] = ["--c", "--rust"].map(|language| table(folder, &plain, language).unwrap());
    let (in_c, in_rust) = (read_by_c(folder, &in_c), read_by_rust(&in_rust));
    let mut random = Pcg32::seed_from_u64(59);
    let mut name = |is_in_tasks: bool| {
        let fits = |letter: &char| !is_in_tasks || !(letter.is_whitespace() || letter.is_control() || "(),&?\"".contains(*letter));
        let parts = (0..1 + random.next_u32() % 5).map(|_| PARTS[random.next_u32() as usize % PARTS.len()]).collect::<String>();
        format!("xqz{}", parts.chars().filter(fits).collect::<String>())
    };
    let mut written = 0;
    for _ in 0..40 {
        let hostile = world(&name(false), &name(true), &name(true), &name(false));
        for (language, plain) in [("--c", &in_c), ("--rust", &in_rust)] {
            let Ok(source) = table(folder, &hostile, language) else { continue };
            let read = if language == "--c" { read_by_c(folder, &source) } else { read_by_rust(&source) };
            assert_eq!(read, *plain, "{language} {hostile}\n{source}");
            written += 1;
        }
    }
    assert!(written >= 20, "only {written} were written");
}

#[test]
fn a_name_that_would_end_early_in_c_is_refused_and_not_shortened() {
    let folder = tempfile::tempdir().unwrap();
    let cut = world("lift", "floor0", "up", "ga\0rage");
    let refused = table(folder.path(), &cut, "--c").unwrap_err();
    assert!(refused.contains("U+0000") && refused.contains("--rust"), "{refused}");
    assert!(table(folder.path(), &cut, "--rust").unwrap().contains("ga\\0rage"));
}

#[test]
fn a_world_with_the_name_of_the_library_or_of_no_letters_compiles() {
    let folder = tempfile::tempdir().unwrap();
    for name in ["goodbot", "goodbot_size", "7 lifts", "_Static_assert", "__x", "家", "int", &"long ".repeat(100)] {
        let header = table(folder.path(), &world(name, "floor0", "up", "garage"), "--c").unwrap();
        read_by_c(folder.path(), &header);
    }
}
