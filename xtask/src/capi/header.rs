//! `capi/include/goodbot.h`, as cbindgen writes it.

use std::path::PathBuf;

use anyhow::{Context, Result, bail};
use cbindgen::{Builder, Config, DocumentationStyle, Language, RenameRule};

use crate::project;

/// The sources whose items the header has, in its order.
const SOURCES: [&str; 10] = [
    "status.rs",
    "version.rs",
    "capacities.rs",
    "robot.rs",
    "home.rs",
    "table/description.rs",
    "table/init.rs",
    "training.rs",
    "beliefs.rs",
    "model.rs",
];

/// Rust's names of types, and C's.
const TYPES: [(&str, &str); 11] = [
    ("Goodbot", "goodbot"),
    ("GoodbotStatus", "goodbot_status"),
    ("GoodbotCapacities", "goodbot_capacities"),
    ("GoodbotCarrier", "goodbot_carrier"),
    ("GoodbotAttribute", "goodbot_attribute"),
    ("GoodbotProposition", "goodbot_proposition"),
    ("GoodbotObject", "goodbot_object"),
    ("GoodbotAction", "goodbot_action"),
    ("GoodbotTable", "goodbot_table"),
    ("GoodbotStep", "goodbot_step"),
    ("GoodbotHolds", "goodbot_holds"),
];

const HEAD: &str = "\
/* goodbot: a robot that learns what your words mean from reward and punishment. docs/robot.md leads through a whole program.

   The order of calls, each function's own rules beside it:

     goodbot_preset, goodbot_init_home          a robot, in your memory; goodbot_init_table for one that is no home
     goodbot_restore, goodbot_learn ...         what it learned before, if it has
     goodbot_home_begin ... goodbot_home_build  where it is
     goodbot_hear                               a command: a session begins
       goodbot_plan ..., goodbot_decide         an action; you do it
       goodbot_done                             it was done; goodbot_home_place where things then are elsewhere than described
       goodbot_feedback                         what the trainer says to it, until the next action is done
     goodbot_finish, goodbot_learn ...          the session is learned from; goodbot_forget if it shall not be
     goodbot_save                               what it has learned, as bytes

   What holds for all of them:

   - Every function returns a status; GOODBOT_STATUS_OK is 0. What fails changes nothing, where nothing else is said.
   - Memory is yours, aligned to 8. It must stay where it is and hold nothing else; nothing has to be given back.
   - Texts are UTF-8 and end with 0. They are copied, but for those that a goodbot_table points to.
   - Nothing is global: robots do not know of each other. One robot is one thread's at a time.
   - goodbot_plan and goodbot_learn do as much as their budget says and no more; the others are short, as docs/footprint.md counts. */";

const TRAILER: &str = "\
/** Bytes of a robot in a home, known when the program is compiled: `static _Alignas(8) unsigned char memory[GOODBOT_SMALL_BYTES];` */
#define GOODBOT_SMALL_BYTES (sizeof(void *) == 4 ? GOODBOT_SMALL_BYTES_32 : GOODBOT_SMALL_BYTES_64)
#define GOODBOT_TINY_BYTES (sizeof(void *) == 4 ? GOODBOT_TINY_BYTES_32 : GOODBOT_TINY_BYTES_64)
/** Bytes of a robot of the caller's own. */
#define GOODBOT_SMALL_TABLE_BYTES (GOODBOT_SMALL_BYTES + GOODBOT_TABLE_BYTES)
#define GOODBOT_TINY_TABLE_BYTES (GOODBOT_TINY_BYTES + GOODBOT_TABLE_BYTES)";

fn path() -> PathBuf {
    project::root().join("capi/include/goodbot.h")
}

/// The header as it should be.
fn generate() -> Result<String> {
    let mut config = Config {
        language: Language::C,
        include_guard: Some("GOODBOT_H".to_owned()),
        autogen_warning: Some("/* Written by `cargo xtask capi`; do not change it by hand. */".to_owned()),
        header: Some(HEAD.to_owned()),
        trailer: Some(TRAILER.to_owned()),
        cpp_compat: true,
        usize_is_size_t: true,
        documentation_style: DocumentationStyle::C99,
        no_includes: true,
        sys_includes: vec!["stdbool.h".to_owned(), "stddef.h".to_owned(), "stdint.h".to_owned()],
        ..Config::default()
    };
    config.enumeration.rename_variants = RenameRule::ScreamingSnakeCase;
    config.enumeration.prefix_with_name = true;
    config.export.rename = TYPES.iter().map(|&(rust, c)| (rust.to_owned(), c.to_owned())).collect();
    let sources = project::root().join("capi/src");
    let builder = SOURCES.iter().fold(Builder::new().with_config(config), |builder, file| builder.with_src(sources.join(file)));
    let mut bytes = Vec::new();
    builder.generate().context("cbindgen could not read capi/src")?.write(&mut bytes);
    // Rust's heading for what the caller promises.
    Ok(String::from_utf8(bytes).context("the header is no text")?.replace("// # Safety\n", "// The caller sees to it:\n"))
}

/// Writes the header.
pub fn write() -> Result<()> {
    std::fs::write(path(), generate()?).with_context(|| format!("{} cannot be written", path().display()))
}

/// The names of all functions that the header declares.
pub fn functions() -> Result<Vec<String>> {
    let header = std::fs::read_to_string(path()).with_context(|| format!("{} cannot be read", path().display()))?;
    Ok(header.lines().filter_map(declared).map(str::to_owned).collect())
}

/// The function that a line begins to declare.
fn declared(line: &str) -> Option<&str> {
    let (before, _) = line.split_once('(')?;
    let name = before.rsplit([' ', '*']).next()?;
    let is_type = line.starts_with("typedef") || line.starts_with([' ', '/', '#']);
    (name.starts_with("goodbot_") && !is_type).then_some(name)
}

/// Compares the header that is checked in.
pub fn check() -> Result<()> {
    let kept = std::fs::read_to_string(path()).with_context(|| format!("{} cannot be read", path().display()))?;
    if kept != generate()? {
        bail!("capi/include/goodbot.h is stale: write it again with `cargo xtask capi`");
    }
    println!("capi/include/goodbot.h is what capi/src says");
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::declared;

    #[test]
    fn functions_are_found_in_the_header() {
        assert_eq!(declared("enum goodbot_status goodbot_save(struct goodbot *robot,"), Some("goodbot_save"));
        assert_eq!(declared("const char *goodbot_status_text(int32_t status);"), Some("goodbot_status_text"));
        assert_eq!(declared("typedef bool (*goodbot_holds)(void *context,"), None);
        assert_eq!(declared(" * `goodbot_full` names it (see there)."), None);
    }
}
