//! The packages of the C library, used as their users do: by CMake, pkg-config, PlatformIO's script and Arduino's sketch.

use std::path::{Path, PathBuf};

use anyhow::{Result, ensure};
use xshell::cmd;

use super::texts::Texts;
use crate::process::shell;
use crate::programs::{GCC, GXX, python_with};

const TESTS: &str = "capi/tests/packages";
/// A lesson to the lift, and a question.
const LESSON: &str = "up to the roof\n+\n+\n!\nup to the roof\n?\n+\n";
/// Two lessons by one button; the lift is where the second one wants it.
const TWO_LESSONS: &str = "up to the roof\nup to the roof\n";

fn tools() -> Result<PathBuf> {
    python_with(&format!("--requirement={TESTS}/requirements.txt"), "python-packages")
}

/// The library for this machine, in the folder where its package was unpacked.
pub fn try_out(package: &Path) -> Result<()> {
    let (sh, gcc, gxx, programs) = (shell()?, GCC.path()?, GXX.path()?, tools()?);
    let (above, texts) = (sh.create_temp_dir()?, Texts::new(&sh)?);
    let examples = package.join("examples");
    let (project, built) = (sh.create_dir(above.path().join("project"))?, above.path().join("built"));
    texts.copy(&sh, &Path::new(TESTS).join("CMakeLists.txt"), &project.join("CMakeLists.txt"))?;
    let compilers = [format!("-DCMAKE_C_COMPILER={}", gcc.display()), format!("-DCMAKE_CXX_COMPILER={}", gxx.display())];
    cmd!(sh, "{programs}/cmake -S {project} -B {built} -DCMAKE_PREFIX_PATH={package} -DEXAMPLES={examples} {compilers...}").run()?;
    cmd!(sh, "{programs}/cmake --build {built}").run()?;
    for program in ["in_c", "in_cpp", "in_both"] {
        let program = built.join(program);
        cmd!(sh, "{program}").run()?;
    }

    let found = cmd!(sh, "{programs}/pkgconf --cflags --libs goodbot").env("PKG_CONFIG_PATH", package.join("lib/pkgconfig")).read()?;
    let (found, program) = (found.split_whitespace(), built.join("by_pkg_config"));
    cmd!(sh, "{gcc} -std=c11 -Wall -Werror {examples}/lift.c -o {program}").args(found).run()?;
    Ok(cmd!(sh, "{program}").run()?)
}

/// Builds an example of the package for boards with a stub of Arduino, and runs it. Returns what it says.
fn run_sketch(name: &str, typed: &str, boards: &Path, library: &Path) -> Result<String> {
    let (sh, gxx) = (shell()?, GXX.path()?);
    let folder = sh.create_temp_dir()?;
    let sketch = folder.path().join("sketch");
    let warnings = ["-std=c++17", "-Wall", "-Wextra", "-Wpedantic", "-Werror", "-fsanitize=address,undefined"];
    let compile = cmd!(sh, "{gxx} {warnings...} -I {TESTS} -I {boards}/src -include Arduino.h -x c++ {boards}/examples/{name}/{name}.ino");
    compile.args(["-x", "none"]).arg(library).arg("-o").arg(&sketch).run()?;
    let said = cmd!(sh, "{sketch}").stdin(typed).read()?;
    println!("{said}");
    Ok(said)
}

/// The package for boards, unpacked; its sketches run here, with the library for this machine.
pub fn try_out_boards(boards: &Path, package: &Path) -> Result<()> {
    let (sh, programs) = (shell()?, tools()?);
    cmd!(sh, "{programs}/python {TESTS}/platformio.py {boards}").run()?;
    let library = package.join("lib/libgoodbot.a");
    let said = run_sketch("Lift", LESSON, boards, &library)?;
    ensure!(
        said.contains("learned") && said.lines().filter(|line| line.ends_with('%')).count() == 3,
        "the lift did not learn by its serial line"
    );
    let said = run_sketch("OneButton", TWO_LESSONS, boards, &library)?;
    let (_, second) = said.split_once("learned").unwrap_or_default();
    ensure!(second.contains("learned") && !second.contains("down"), "the lift did not learn by its one button");
    Ok(())
}
