//! The trainer page in a real browser.

use std::path::PathBuf;

use anyhow::{Context, Result};

use super::{Run, Step, WORKSPACE};
use crate::programs::{CHROMIUM, FIREFOX, Missing, NODE, npm};
use crate::{page, process, project};

pub const STEP: Step = Step::new(
    "page",
    "the trainer page works in a browser, from a file",
    in_browser,
    "see the test that failed in page/tests; the page is dist/goodbot.html",
);

/// Where the browser tests put what the page exported, for the tests on the host; `later` until it is there.
pub const EXPORT: &str = "GOODBOT_PAGE_EXPORT";
/// Where the browser tests find the command line and the browsers.
const CLI: &str = "GOODBOT_CLI";
const BROWSER: &str = "GOODBOT_CHROMIUM";
const SECOND: &str = "GOODBOT_FIREFOX";

// A page waits as long as it works, for frames and for a robot that takes its time.
const FILES_PER_CORE: usize = 2;

fn in_browser(run: &mut Run) -> Result<()> {
    let exported = export(run);
    if exported.as_ref().is_err_and(|error| !error.is::<Missing>()) {
        return exported.map(drop);
    }
    // Without a browser, these tests say that they are ignored.
    let mut compare = project::cargo();
    compare.arg("test").args(WORKSPACE).args(["--test", "exported_by_the_page"]);
    if let Ok(folder) = &exported {
        compare.env(EXPORT, folder);
    }
    run.count(&mut compare)?;
    exported.map(drop)
}

/// Tries the page, and returns the folder of what it exported.
fn export(run: &mut Run) -> Result<PathBuf> {
    page::build()?;
    let tests = npm::packages()?.join("tests");
    let browser = CHROMIUM.path().or_else(|missing| process::find_program("chromium").ok_or(missing))?;
    let folder = project::target_dir().join("page-export");
    // Nothing of an earlier run may pass for this one's.
    let _ = std::fs::remove_dir_all(&folder);
    std::fs::create_dir_all(&folder).with_context(|| format!("{} cannot be made", folder.display()))?;
    // As the tests have it: by itself it would be built with other features, once more.
    process::run(project::cargo().arg("test").args(WORKSPACE).args(["--no-run", "--test", "recorded", "--test", "exported_by_the_page"]))?;
    let cli = project::target_dir().join("debug").join(format!("goodbot{}", std::env::consts::EXE_SUFFIX));
    let files = FILES_PER_CORE * std::thread::available_parallelism()?.get();
    let mut node = NODE.command()?;
    node.args(["--test", "--test-reporter=spec", &format!("--test-concurrency={files}")]);
    match FIREFOX.path() {
        Ok(second) => drop(node.env(SECOND, second)),
        // Its tests say that they are ignored.
        Err(error) => eprintln!("the page is not tried in a second browser: {error:#}"),
    }
    run.count(node.current_dir(&tests).env(EXPORT, &folder).env(CLI, &cli).env(BROWSER, &browser))?;
    Ok(folder)
}
