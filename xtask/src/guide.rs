//! `docs/robot.md`, done as it says: its programs are built in an empty folder and run.

use std::path::{Path, PathBuf};
use std::process::Command;

use anyhow::{Context, Result, bail};

use crate::capi::library;
use crate::programs::{ARM_GCC, GCC, QEMU};
use crate::toolchain::Target;
use crate::{process, project};

const PAGE: &str = "docs/robot.md";

/// A block of code.
#[derive(Debug, PartialEq, Eq)]
struct Block {
    language: String,
    text: String,
}

/// The page's part from one heading to another.
fn part<'p>(page: &'p str, from: &str, to: &str) -> Result<&'p str> {
    let (_, rest) = page.split_once(from).with_context(|| format!("{PAGE} has no heading `{from}`"))?;
    rest.split_once(to).map(|(part, _)| part).with_context(|| format!("{PAGE} has no heading `{to}`"))
}

/// The blocks of code, without what they are indented by.
fn blocks(part: &str) -> Vec<Block> {
    let mut found = Vec::new();
    let mut lines = part.lines();
    while let Some(line) = lines.next() {
        let Some(language) = line.trim_start().strip_prefix("```") else { continue };
        let indent = line.len() - line.trim_start().len();
        let code = lines.by_ref().take_while(|line| line.trim() != "```");
        let text = code.map(|line| line.get(indent..).unwrap_or("")).fold(String::new(), |text, line| text + line + "\n");
        found.push(Block { language: language.to_owned(), text });
    }
    found
}

/// All blocks of a language, one after the other.
fn program(blocks: &[Block], language: &str) -> String {
    blocks.iter().filter(|block| block.language == language).map(|block| block.text.as_str()).collect()
}

/// The first block of commands that has this in it.
fn commands<'b>(blocks: &'b [Block], word: &str) -> Result<&'b str> {
    let block = blocks.iter().find(|block| block.language == "sh" && block.text.contains(word));
    block.map(|block| block.text.as_str()).with_context(|| format!("{PAGE} has no commands with `{word}`"))
}

/// What a part says that its program prints.
fn promised(part: &str) -> Result<&str> {
    let (_, rest) = part.split_once("It says `").with_context(|| format!("{PAGE} does not tell what a program says"))?;
    rest.split_once('`').map(|(said, _)| said).context("a text has no end")
}

fn shell(commands: &str, folder: &Path) -> Command {
    let mut shell = Command::new("sh");
    shell.args(["-ec", commands]).current_dir(folder).env("GOODBOT", project::root());
    project::forget_own_package(&mut shell);
    shell
}

fn expect(promised: &str, said: &str) -> Result<()> {
    print!("{said}");
    if !said.contains(promised) {
        bail!("{PAGE} promises `{promised}`");
    }
    Ok(())
}

/// An empty folder outside the repository, gone when this is dropped.
struct Folder(PathBuf);

impl Folder {
    fn new() -> Result<Self> {
        let path = std::env::temp_dir().join(format!("goodbot-guide-{}", std::process::id()));
        std::fs::create_dir(&path).with_context(|| format!("{} cannot be made", path.display()))?;
        Ok(Self(path))
    }
}

impl Drop for Folder {
    fn drop(&mut self) {
        let _ = std::fs::remove_dir_all(&self.0);
    }
}

/// Does what the page says.
pub fn follow() -> Result<()> {
    GCC.path()?;
    let page = std::fs::read_to_string(project::root().join(PAGE)).with_context(|| format!("{PAGE} cannot be read"))?;
    let folder = Folder::new()?;
    in_c(part(&page, "\n## In C\n", "\n### A robot of your own\n")?, &folder.0)?;
    own_robot(part(&page, "\n### A robot of your own\n", "\n## In Rust\n")?, &folder.0)?;
    in_rust(part(&page, "\n## In Rust\n", "\n## What is promised\n")?, &folder.0)
}

fn in_c(part: &str, folder: &Path) -> Result<()> {
    let blocks = blocks(part);
    std::fs::copy(library::build(None, &library::FEATURES)?, folder.join("libgoodbot.a"))?;
    std::fs::copy(project::root().join("capi/include/goodbot.h"), folder.join("goodbot.h"))?;
    std::fs::write(folder.join("robot.c"), program(&blocks, "c"))?;
    expect(promised(part)?, &process::capture(&mut shell(commands(&blocks, "gcc")?, folder))?)?;
    // The commands that follow make a folder of this name.
    Ok(std::fs::remove_file(folder.join("robot"))?)
}

/// On this machine, and on the emulated board.
fn own_robot(part: &str, folder: &Path) -> Result<()> {
    let blocks = blocks(part);
    std::fs::write(folder.join("trolley.c"), program(&blocks, "c"))?;
    expect(promised(part)?, &process::capture(&mut shell(commands(&blocks, "gcc")?, folder))?)?;
    let board = folder.join("board");
    std::fs::create_dir(&board)?;
    std::fs::copy(library::build(Some(Target::Thumbv7emHf), &library::FEATURES)?, board.join("libgoodbot.a"))?;
    for file in ["include/goodbot.h", "examples/board/start.c", "examples/board/link.ld"] {
        let from = project::root().join("capi").join(file);
        std::fs::copy(&from, board.join(from.file_name().unwrap_or_default()))?;
    }
    let mut on_board = shell(commands(&blocks, "arm-none-eabi-gcc")?, folder);
    let found = [ARM_GCC.path()?, QEMU.path()?];
    let before = std::env::var_os("PATH").unwrap_or_default();
    let path = found.iter().filter_map(|program| program.parent()).map(Path::to_owned).chain(std::env::split_paths(&before));
    expect(promised(part)?, &process::capture(on_board.env("PATH", std::env::join_paths(path)?))?)
}

fn in_rust(part: &str, folder: &Path) -> Result<()> {
    let blocks = blocks(part);
    process::run(&mut shell(commands(&blocks, "cargo new")?, folder))?;
    let folder = folder.join("robot");
    std::fs::write(folder.join("src/main.rs"), program(&blocks, "rust"))?;
    let mut run = shell(commands(&blocks, "cargo run")?, &folder);
    expect(promised(part)?, &process::capture(run.env("CARGO_TARGET_DIR", project::target_dir().join("guide")))?)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn indented_blocks_are_found_whole() {
        let found = blocks("1. Text\n\n   ```c\n   int a;\n\n     int b;\n   ```\n   It says `a`.\n\n```sh\nls\n```\n");
        let block = |language: &str, text: &str| Block { language: language.to_owned(), text: text.to_owned() };
        assert_eq!(found, [block("c", "int a;\n\n  int b;\n"), block("sh", "ls\n")]);
        assert_eq!(commands(&found, "ls").unwrap(), "ls\n");
        assert!(commands(&found, "gcc").is_err());
    }

    #[test]
    fn what_a_program_says_is_read_from_the_page() {
        assert_eq!(promised("and then. It says `passed`.").unwrap(), "passed");
        assert!(promised("It says nothing.").is_err());
    }
}
