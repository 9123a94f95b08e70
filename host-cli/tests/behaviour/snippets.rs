//! The commands of the pages for newcomers, in their order in one folder.

use std::ffi::OsStr;
use std::fs;
use std::path::Path;
use std::process::Command;

/// A robot with four sessions, and with the first of them alone; a home, and a robot from a file.
const BEFORE: &str = r#"
lesson() { printf "command go to the $1 room\nstep\ngood\nfinish\n"; }
lesson red | goodbot teach --lines --model rex.goodbot
cp rex.goodbot before.goodbot
{ lesson green; lesson blue; lesson red; } | goodbot teach --lines --model rex.goodbot
goodbot learn lab/acts/lessons.en.jsonl --out en.goodbot
goodbot example home > home.json
cp docs/examples/worlds/lift.json .
"#;
/// The first words of blocks that take minutes, or that install the command.
const ELSEWHERE: [&str; 2] = ["cargo install", "for language in"];

#[test]
fn each_command_of_a_page_works_as_it_is_written() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    let folder = tempfile::tempdir().expect("a folder");
    for file in [
        "docs/examples/home.json",
        "docs/examples/sessions.jsonl",
        "docs/examples/worlds/lift.json",
        "lab/acts/home.json",
        "lab/acts/lessons.en.jsonl",
    ] {
        let to = folder.path().join(file);
        fs::create_dir_all(to.parent().expect("a folder")).expect("a folder");
        fs::copy(root.join(file), to).expect("a file");
    }
    let program = Path::new(env!("CARGO_BIN_EXE_goodbot")).parent().expect("a folder").to_owned();
    let others = std::env::var_os("PATH").unwrap_or_default();
    let path = std::env::join_paths(std::iter::once(program).chain(std::env::split_paths(&others))).expect("a path");
    run(BEFORE, folder.path(), &path);
    for (page, least) in [("start", 4), ("how-it-works", 1), ("teach", 3), ("talk", 1)] {
        let text = fs::read_to_string(root.join("docs").join(page).with_extension("md")).expect("a page");
        let blocks = text.split("```sh\n").skip(1).filter_map(|rest| rest.split("```\n").next());
        let blocks: Vec<_> = blocks.filter(|block| !ELSEWHERE.iter().any(|words| block.starts_with(words))).collect();
        assert!(blocks.len() >= least, "{page}: {} blocks", blocks.len());
        for block in blocks {
            run(block, folder.path(), &path);
        }
    }
}

fn run(block: &str, folder: &Path, path: &OsStr) {
    // No robot of whoever runs this is touched.
    let mut shell = Command::new("sh");
    shell.args(["-ec", block]).current_dir(folder).env("PATH", path).env("XDG_DATA_HOME", folder).env("HOME", folder);
    let run = shell.output().expect("a shell");
    let said = [run.stdout, run.stderr].map(|bytes| String::from_utf8_lossy(&bytes).into_owned());
    assert!(run.status.success(), "{block}\n{said:?}");
}

#[test]
fn the_marks_of_each_code_block_stand_on_lines_of_their_own() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).parent().expect("the project");
    let pages = |folder: &str| fs::read_dir(root.join(folder)).expect("a folder").map(|file| file.expect("a file").path());
    let pages = pages("docs").chain(pages("docs/appendix")).chain(pages("")).filter(|page| page.extension().is_some_and(|it| it == "md"));
    let (mut count, mark) = (0, "```");
    for page in pages {
        let text = fs::read_to_string(&page).expect("a page");
        let marks: Vec<&str> = text.lines().filter(|line| line.contains(mark)).map(str::trim_start).collect();
        // A paragraph that was wrapped over a block has its mark in the middle of a line, and the block runs nowhere.
        let is_alone = |line: &&str| line.strip_prefix(mark).is_some_and(|language| language.chars().all(|it| it.is_ascii_alphanumeric()));
        assert!(marks.iter().all(is_alone) && marks.len().is_multiple_of(2), "{}: {marks:?}", page.display());
        count += marks.len() / 2;
    }
    assert!(count > 60, "{count} blocks");
}
