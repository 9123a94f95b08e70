//! The Python package: built as a wheel, installed into an environment of its own, and tried there.

use std::path::{Path, PathBuf};
use std::process::Command;

use anyhow::{Context, Result, bail};

use super::{Run, Step, WORKSPACE};
use crate::programs::{Missing, PYTHON, missing};
use crate::{process, project};

pub const STEP: Step = Step::new(
    "python",
    "the Python package's tests, types and stubs, of a wheel in an environment of its own",
    tried,
    "the tests are in python/tests; `maturin develop` in python/ builds what `pytest` there tries",
);

/// The command line that the package is compared with.
const CLI: &str = "GOODBOT_CLI";
/// The oldest Python that the package is for.
const OLDEST: (u32, u32) = (3, 10);

fn tried(run: &mut Run) -> Result<()> {
    let environment = Environment::made()?;
    environment.install_wheel()?;
    // As the tests have it: by itself it would be built with other features, once more.
    process::run(project::cargo().arg("test").args(WORKSPACE).args(["--no-run", "--test", "recorded"]))?;
    let cli = project::target_dir().join("debug").join(format!("goodbot{}", std::env::consts::EXE_SUFFIX));
    run.count(environment.program("pytest").args(["-p", "no:cacheprovider"]).env(CLI, cli))?;
    let cache = environment.folder.join("mypy");
    process::run(environment.program("mypy").arg("--cache-dir").arg(&cache).args(["--package", "goodbot"]))?;
    process::run(environment.program("mypy").arg("--cache-dir").arg(&cache).args(["tests", "examples", "benches"]))?;
    process::run(environment.program("stubtest").args(["goodbot", "--allowlist", "tests/stubtest.txt"]))
}

/// A virtual environment of this project's own.
struct Environment {
    folder: PathBuf,
}

impl Environment {
    /// The environment with the tests' packages, made where it is not there or they have changed.
    fn made() -> Result<Self> {
        let python = PYTHON.path()?;
        let version = PYTHON.version(&python)?;
        let numbers: Vec<u32> = version.split([' ', '.']).filter_map(|part| part.parse().ok()).collect();
        if !matches!(numbers.as_slice(), [major, minor, ..] if (*major, *minor) >= OLDEST) {
            return Err(Missing(format!("Python {}.{} or newer, and this is {version}; install one", OLDEST.0, OLDEST.1)).into());
        }
        let this = Self { folder: project::target_dir().join("python") };
        let packages = project::root().join("python/tests/requirements.txt");
        let wanted = std::fs::read(&packages).with_context(|| format!("{} cannot be read", packages.display()))?;
        let installed = this.folder.join("installed.txt");
        if std::fs::read(&installed).is_ok_and(|installed| installed == wanted) {
            return Ok(this);
        }
        let cannot = |why: &'static str| move |error: anyhow::Error| missing("python3", why, &error);
        let mut venv = Command::new(&python);
        process::capture(venv.args(["-m", "venv", "--clear"]).arg(&this.folder))
            .map_err(cannot("with the modules venv and ensurepip (Debian's python3-venv)"))?;
        let mut pip = this.python();
        pip.args(["-m", "pip", "install", "--quiet", "--disable-pip-version-check", "--no-compile", "--requirement"]).arg(&packages);
        process::capture(&mut pip).map_err(cannot("with the packages of python/tests/requirements.txt"))?;
        std::fs::write(&installed, wanted)?;
        Ok(this)
    }

    /// A program of the environment, to be run in the package's folder.
    fn program(&self, name: &str) -> Command {
        let programs = self.folder.join(if cfg!(windows) { "Scripts" } else { "bin" });
        let mut command = Command::new(programs.join(format!("{name}{}", std::env::consts::EXE_SUFFIX)));
        command.current_dir(project::root().join("python"));
        project::forget_own_package(&mut command);
        command
    }

    fn python(&self) -> Command {
        self.program("python")
    }

    /// Builds the wheel as the tests of Rust are built, which takes seconds where a release takes minutes, and installs it.
    fn install_wheel(&self) -> Result<()> {
        let wheels = self.folder.join("wheels");
        let _ = std::fs::remove_dir_all(&wheels);
        let mut maturin = self.program("maturin");
        let python = self.python();
        maturin
            .args(["build", "--quiet", "--profile", "dev", "--locked", "--out"])
            .arg(&wheels)
            .arg("--interpreter")
            .arg(python.get_program());
        process::run(maturin.env("CARGO_TARGET_DIR", project::target_dir()))?;
        let wheel = only_file(&wheels)?;
        let mut pip = self.python();
        process::run(
            pip.args(["-m", "pip", "install", "--quiet", "--disable-pip-version-check", "--no-deps", "--force-reinstall"]).arg(wheel),
        )
    }
}

fn only_file(folder: &Path) -> Result<PathBuf> {
    let files: Vec<PathBuf> = std::fs::read_dir(folder)?.map(|entry| Ok(entry?.path())).collect::<Result<_>>()?;
    match <[PathBuf; 1]>::try_from(files) {
        Ok([file]) => Ok(file),
        Err(files) => bail!("{} should have one wheel, and has {}", folder.display(), files.len()),
    }
}
