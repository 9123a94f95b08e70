//! What is written: its format, what clippy and rustdoc say of it, and two rules that no other tool checks.

use std::process::Command;

use anyhow::{Result, bail};

use super::{Run, Step, WORKSPACE};
use crate::{process, project};

/// Every file is as rustfmt writes it.
pub const FORMAT: Step = Step::new(
    "format",
    "files are as rustfmt writes them",
    |_| process::run(project::cargo().args(["fmt", "--all", "--check"])),
    "run `cargo fmt --all`",
)
.fast();

/// What must be in no file: why, where, and as which regular expression.
const FORBIDDEN: [(&str, &str, &str); 2] = [
    ("a place on one machine is named", "*", r#"(^|[[:space:]"'`=:,;|([{])/(work|root|home|Users)($|[^[:alnum:]_-])"#),
    (
        "the server that a package came from is named: write the file again with `npm config set omit-lockfile-registry-resolved true`",
        "*package-lock.json",
        r#""resolved": "http"#,
    ),
];

/// The project's own rules.
pub const STYLE: Step =
    Step::new("style", "no file names a place on one machine, or a package's server", style, "mend the lines that are listed").fast();

fn style(_: &mut Run) -> Result<()> {
    for (what, files, expression) in FORBIDDEN {
        let mut git = Command::new("git");
        git.args(["grep", "--untracked", "-nIE", "-e", expression, "--", files, ":!xtask/src/steps/text.rs"]).current_dir(project::root());
        let (code, lines) = process::capture_within(&mut git, std::time::Duration::from_secs(60))?;
        match code {
            0 => bail!("{what}:\n{lines}"),
            1 => {}
            _ => bail!("`git grep` cannot look at the files: this takes git, and a clone"),
        }
    }
    Ok(())
}

/// Clippy has nothing to say; of the core as a controller has it, and without its optional parts, neither.
pub const CLIPPY: Step = Step::new(
    "clippy",
    "clippy has nothing to say",
    |_| {
        process::run(project::cargo().arg("clippy").args(WORKSPACE).args(["--all-targets", "--", "-D", "warnings"]))?;
        process::run(project::cargo().args(["clippy", "--package", "goodbot", "--features", "defmt", "--", "-D", "warnings"]))?;
        process::run(project::cargo().args(["clippy", "--package", "goodbot", "--no-default-features", "--", "-D", "warnings"]))
    },
    "mend what clippy points at; an `#[expect(…, reason = \"…\")]` is for where it is wrong",
)
.fast();

/// The documentation can be built, with no link that leads nowhere.
pub const DOCS: Step = Step::new(
    "docs",
    "the documentation is built without a warning",
    |_| process::run(project::cargo().arg("doc").args(WORKSPACE).arg("--no-deps").env("RUSTDOCFLAGS", "-D warnings")),
    "mend the doc comments that rustdoc points at",
);
