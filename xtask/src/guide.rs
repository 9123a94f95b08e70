//! Follows `docs/robot.md`: builds its programs in an empty folder, those in C from the packed library alone, and runs them. The same for
//! the C recipe of `docs/cookbook.md`.

use std::path::{Path, PathBuf};

use anyhow::{Context, Result, ensure};
use xshell::{Shell, cmd};

use crate::capi::{headers_beside, library};
use crate::process::{root, shell, target_dir};
use crate::programs::{ARM_GCC, GCC, QEMU};
use crate::release::unpacked_c;
use crate::toolchain::CORTEX_M4F;

const PAGE: &str = "docs/robot.md";
const COOKBOOK: &str = "docs/cookbook.md";

/// A part of the page, followed in a folder.
struct Part<'p> {
    text: &'p str,
    folder: PathBuf,
}

impl<'p> Part<'p> {
    /// The part from one heading to another.
    fn of(page: &'p str, from: &str, to: &str, folder: &Path) -> Result<Self> {
        let found = page.split_once(from).and_then(|(_, rest)| rest.split_once(to));
        let (text, _) = found.with_context(|| format!("{PAGE} has no heading `{}` before `{}`", from.trim(), to.trim()))?;
        Ok(Self { text, folder: folder.to_owned() })
    }

    /// The code blocks in a language, without their indentation.
    fn blocks(&self, language: &str) -> Vec<String> {
        let mut found = Vec::new();
        let mut lines = self.text.lines();
        while let Some(line) = lines.next() {
            let indent = line.len() - line.trim_start().len();
            let code = line.trim_start().strip_prefix("```").map(|name| (name, lines.by_ref().take_while(|line| line.trim() != "```")));
            let Some((name, code)) = code else { continue };
            let text = code.map(|line| line.get(indent..).unwrap_or("")).fold(String::new(), |text, line| text + line + "\n");
            found.extend((name == language).then_some(text));
        }
        found
    }

    /// Writes all blocks of a language into a file, one after the other.
    fn write(&self, sh: &Shell, language: &str, file: &str) -> Result<()> {
        Ok(sh.write_file(self.folder.join(file), self.blocks(language).concat())?)
    }

    /// Runs the first block of commands that contains this word. Returns its output.
    fn run(&self, sh: &Shell, word: &str) -> Result<String> {
        let blocks = self.blocks("sh");
        let commands = blocks.iter().find(|block| block.contains(word)).with_context(|| format!("{PAGE} has no commands with `{word}`"))?;
        let _folder = sh.push_dir(&self.folder);
        Ok(cmd!(sh, "sh -ec {commands}").env("GOODBOT", root()).read()?)
    }

    /// Runs the same and prints its output. It is an error if that lacks the text that the part promises.
    fn try_out(&self, sh: &Shell, word: &str) -> Result<()> {
        let (promised, said) = (self.promised()?, self.run(sh, word)?);
        println!("{said}");
        ensure!(said.contains(promised), "{PAGE} promises `{promised}`");
        Ok(())
    }

    /// The features of the library that its program needs.
    fn features(&self) -> Result<Vec<&'p str>> {
        let named = self.text.split_once("cargo xtask library").and_then(|(_, rest)| rest.split_once("--features "));
        let (named, _) = named.and_then(|(_, rest)| rest.split_once('`')).with_context(|| format!("{PAGE} names no features"))?;
        Ok(named.split(',').collect())
    }

    fn promised(&self) -> Result<&'p str> {
        let said = self.text.split_once("It says `").and_then(|(_, rest)| rest.split_once('`'));
        Ok(said.with_context(|| format!("{PAGE} does not tell what a program says"))?.0)
    }
}

/// Follows the page.
pub fn follow() -> Result<()> {
    let (sh, page, gcc) = (shell()?, shell()?.read_file(PAGE)?, GCC.path()?);
    let folder = sh.create_temp_dir()?;
    let folder = folder.path();

    // On this machine, and below on the emulated board.
    let in_c = Part::of(&page, "\n## In C\n", "\n## In Rust\n", folder)?;
    unpacked_c(&sh, None, &folder.join("goodbot"))?;
    in_c.write(&sh, "c", "trolley.c")?;
    in_c.try_out(&sh, "gcc")?;

    with_own_features(&sh, &in_c, &gcc)?;

    let recipe = Part { text: &sh.read_file(COOKBOOK)?, folder: folder.to_owned() };
    recipe.write(&sh, "c", "recipe.c")?;
    sh.copy_file("capi/tests/cookbook.c", folder)?;
    let built = folder.join("cookbook");
    cmd!(sh, "{gcc} -std=c11 -Wall -Wextra -Werror -I {folder} -I {folder}/goodbot/include {folder}/cookbook.c {folder}/goodbot/lib/libgoodbot.a -o {built}").run()?;
    let said = cmd!(sh, "{built}").read()?;
    ensure!(said == "1 session came back", "{COOKBOOK} keeps no session in flash: {said}");

    unpacked_c(&sh, Some(CORTEX_M4F), &folder.join("board"))?;
    let (arm_gcc, qemu, path) = (ARM_GCC.path()?, QEMU.path()?, std::env::var_os("PATH").unwrap_or_default());
    let found = [&arm_gcc, &qemu].into_iter().filter_map(|program| program.parent()).map(Path::to_owned);
    sh.set_var("PATH", std::env::join_paths(found.chain(std::env::split_paths(&path)))?);
    in_c.try_out(&sh, "arm-none-eabi-gcc")?;

    let mut in_rust = Part::of(&page, "\n## In Rust\n", "\n## What is promised\n", &sh.create_dir(folder.join("rust"))?)?;
    in_rust.run(&sh, "cargo new")?;
    in_rust.folder.push("robot");
    in_rust.write(&sh, "rust", "src/main.rs")?;
    sh.set_var("CARGO_TARGET_DIR", target_dir().join("guide"));
    // It runs once, and briefly: to optimise it would take longer.
    sh.set_var("CARGO_PROFILE_RELEASE_OPT_LEVEL", "0");
    in_rust.try_out(&sh, "cargo run")
}

/// Links the program with a library of only those features that the page names for it.
fn with_own_features(sh: &Shell, in_c: &Part<'_>, gcc: &Path) -> Result<()> {
    let named = in_c.features()?;
    let folder = sh.create_dir(in_c.folder.join("own"))?;
    headers_beside(sh, &named, &folder)?;
    let (trolley, library) = (in_c.folder.join("trolley.c"), library(None, &named)?);
    cmd!(sh, "{gcc} -std=c11 -Wall -Wextra -Werror -I {folder} {trolley} {library} -o {folder}/trolley").run()?;
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn part(text: &str) -> Part<'_> {
        Part { text, folder: PathBuf::new() }
    }

    #[test]
    fn indented_blocks_are_found_whole() {
        let part = part("1. Text\n\n   ```c\n   int a;\n\n     int b;\n   ```\n   It says `a`.\n\n```sh\nls\n```\n");
        assert_eq!(part.blocks("c"), ["int a;\n\n  int b;\n"]);
        assert_eq!(part.blocks("sh"), ["ls\n"]);
        assert!(part.run(&shell().unwrap(), "gcc").is_err());
    }

    #[test]
    fn the_features_of_a_smaller_library_are_read_from_the_page() {
        let page = part("`cargo xtask library --target arm --features checks,table` writes");
        assert_eq!(page.features().unwrap(), ["checks", "table"]);
    }

    #[test]
    fn what_a_program_says_is_read_from_the_page() {
        assert_eq!(part("and then. It says `passed`.").promised().unwrap(), "passed");
        assert!(part("It says nothing.").promised().is_err());
    }
}
