//! The trainer page in a real browser.

use anyhow::{Context, Result};

use super::{Step, Tally};
use crate::toolchain::{need_program, npm_ci};
use crate::{page, process, project};

pub const STEP: Step = Step {
    name: "page",
    about: "the trainer page works in a browser, from a file",
    fast: false,
    run: in_browser,
    next: "see the test that failed in page/tests; the page is dist/goodbot.html",
};

/// Where the browser tests put what the page exported, for the tests on the host.
const EXPORT: &str = "GOODBOT_PAGE_EXPORT";
/// Where the browser tests find the command line.
const CLI: &str = "GOODBOT_CLI";

fn in_browser(tally: &mut Tally) -> Result<()> {
    page::build()?;
    need_program("chromium", &["chromium"], "to show the page")?;
    need_program("node", &["nodejs", "npm"], "to drive the browser")?;
    let tests = project::root().join("page").join("tests");
    npm_ci(&tests)?;
    let export = project::target_dir().join("page").join("export");
    std::fs::create_dir_all(&export).with_context(|| format!("{} cannot be made", export.display()))?;
    process::run(project::cargo().args(["build", "--quiet", "--package", "goodbot-cli"]))?;
    let cli = project::target_dir().join("debug").join(format!("goodbot{}", std::env::consts::EXE_SUFFIX));
    let mut node = std::process::Command::new("node");
    node.args(["--test", "--test-reporter=spec"]).current_dir(&tests).env(EXPORT, &export).env(CLI, &cli);
    process::run(&mut node)?;
    let mut compare = project::cargo();
    compare.args(["test", "--package", "goodbot-wasm", "--test", "exported_by_the_page"]).env(EXPORT, &export);
    process::run_with_lines(&mut compare, |line| tally.read(line))
}
