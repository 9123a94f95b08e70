//! The C interface: its header, its static library, and the C examples on this machine and on an emulated board.

use crate::firmware::{AN386, FAULT, emulate, nothing_panics, run_alone};
use crate::process::{shell, target_dir};
use crate::programs::{ARM_GCC, CLANG, GCC, GXX};
use crate::toolchain::{self, CONTROLLER, CORTEX_M0, CORTEX_M4F, TARGETS};
use anyhow::{Context, Result};
use clap::Args;
use std::path::{Path, PathBuf};
use xshell::{Shell, cmd};

const HEADER: &str = "capi/include/goodbot.h";
/// The C header, and the C++ header that wraps it.
pub const HEADERS: [&str; 2] = [HEADER, "capi/include/goodbot.hpp"];

/// The features to choose from, as in `capi/Cargo.toml`. `talk` and `bounds` are no defaults, because they take flash even if they are not used.
pub const ALL_FEATURES: [&str; 12] =
    ["asking", "checks", "explain", "forgetting", "home", "learning", "table", "unicode", "voice", "ways", "talk", "bounds"];
/// The default features of a library.
pub const FEATURES: &[&str] = ALL_FEATURES.split_at(10).0;
const FEATURES_AND_TALK: &[&str] = ALL_FEATURES.split_at(11).0;

/// Clang for the Cortex-M4F.
const CLANG_FOR_ARM: [&str; 4] = ["--target=arm-none-eabi", "-mcpu=cortex-m4", "-mfloat-abi=hard", "-mfpu=fpv4-sp-d16"];

const WARNINGS: [&str; 5] = ["-std=c11", "-Wall", "-Wextra", "-Wpedantic", "-Werror"];

/// Writes the header that cbindgen makes. A test of `goodbot-header` compares the two.
pub fn header() -> Result<()> {
    let sh = shell()?;
    let header = cmd!(sh, "cargo run --package goodbot-header").read()? + "\n";
    Ok(sh.write_file(HEADER, header)?)
}

/// Puts both headers into a folder, beside a library with these features: the macros say which it has.
pub fn headers_beside(sh: &Shell, features: &[&str], folder: &Path) -> Result<()> {
    for file in HEADERS {
        sh.copy_file(file, folder)?;
    }
    Ok(sh.write_file(folder.join("goodbot.h"), of_features(&sh.read_file(HEADER)?, features))?)
}

/// The header of a library with these features.
fn of_features(header: &str, features: &[&str]) -> String {
    let has = |line: &str| {
        let name = line.strip_prefix("#define GOODBOT_HAS_")?.strip_suffix(" 1")?;
        let given = features.iter().any(|feature| feature.eq_ignore_ascii_case(name));
        Some(format!("#define GOODBOT_HAS_{name} {}\n", u8::from(given)))
    };
    header.lines().map(|line| has(line).unwrap_or_else(|| format!("{line}\n"))).collect()
}

/// Compiles the header alone, by each standard of C and C++ and with enums of either size: it asserts the layout of every struct.
fn assert_layouts(sh: &Shell, compiler: &Path, target: &[&str]) -> Result<()> {
    for (language, standards) in [("c", ["c99", "c11", "c2x"]), ("c++", ["c++11", "c++17", "c++20"])] {
        for standard in standards {
            for enums in ["-fshort-enums", "-fno-short-enums"] {
                let strict = ["-Wall", "-Wextra", "-Wpedantic", "-Werror", "-ffreestanding", "-fsyntax-only"];
                cmd!(sh, "{compiler} {target...} -x {language} -std={standard} {enums} {strict...} {HEADER}").run()?;
            }
        }
    }
    Ok(())
}

/// The names of all functions that a header declares.
fn functions(header: &str) -> Vec<&str> {
    let before_brackets = header.split('(').filter_map(|text| text.rsplit(|c: char| !c.is_ascii_alphanumeric() && c != '_').next());
    before_brackets.filter(|name| name.starts_with("goodbot_")).collect()
}

/// The library to build.
#[derive(Args)]
pub struct Library {
    /// For this processor, instead of this machine.
    #[arg(long, value_parser = TARGETS)]
    target: Option<String>,
    /// The features to include; the others take no flash
    #[arg(long, value_delimiter = ',', value_name = "LIST", default_values = FEATURES.iter().copied(), value_parser = ALL_FEATURES)]
    features: Vec<String>,
}

/// Builds the static library with these features, for this machine if `target` is `None`. Returns its path.
pub fn library(target: Option<&str>, features: &[&str]) -> Result<PathBuf> {
    let (sh, features) = (shell()?, features.join(","));
    // Apart from the workspace's own builds, because other features would rebuild them.
    let own = target_dir().join("capi");
    let (cargo, built) = match target {
        None => (cmd!(sh, "cargo rustc --profile dist --target-dir {own}"), own.join("dist")),
        Some(target) => {
            let cargo = toolchain::cargo(&sh, target, "rustc")?.args(["--profile", CONTROLLER]);
            (cargo, toolchain::artifacts(target, CONTROLLER))
        }
    };
    let what =
        ["--quiet", "--package", "goodbot-capi", "--crate-type", "staticlib", "--no-default-features", "--features", "alone", "--features"];
    cargo.args(what).arg(features).run()?;
    Ok(built.join("libgoodbot_capi.a"))
}

/// Builds the library and puts it into a folder, with the header.
pub fn deliver(options: &Library) -> Result<()> {
    let (sh, target) = (shell()?, options.target.as_deref());
    let features: Vec<_> = options.features.iter().map(String::as_str).collect();
    let folder = sh.create_dir(format!("dist/c/{}", target.unwrap_or("host")))?;
    sh.copy_file(library(target, &features)?, folder.join("libgoodbot.a"))?;
    headers_beside(&sh, &features, &folder)?;
    eprintln!("written: libgoodbot.a, goodbot.h and goodbot.hpp in {}", folder.display());
    Ok(())
}

/// Builds every example with the host's compilers and both sanitizers, and runs it. What `goodbot table --c` writes is C and C++.
pub fn on_host() -> Result<()> {
    let (sh, gcc, gxx, library) = (shell()?, GCC.path()?, GXX.path()?, library(None, &ALL_FEATURES)?);
    let clang = CLANG.path()?;
    assert_layouts(&sh, &gcc, &[])?;
    assert_layouts(&sh, &clang, &[])?;
    run_with_either_enums(&sh, &clang, &library)?;
    let in_c = ["home", "lift", "obey", "talk", "world"].map(|example| (&gcc, "-std=c11", format!("{example}.c")));
    let in_cpp = ["lift.cpp", "world.c"].map(|example| (&gxx, "-std=c++17", example.to_owned()));
    for (compiler, standard, example) in in_c.into_iter().chain(in_cpp) {
        let binary = library.with_file_name(format!("{example}{standard}"));
        let language = if standard == "-std=c11" { "c" } else { "c++" };
        let checks =
            ["-Wall", "-Wextra", "-Wpedantic", "-Werror", "-g", "-O1", "-fsanitize=address,undefined", "-fno-sanitize-recover=all"];
        let compile = cmd!(sh, "{compiler} {standard} {checks...} -I capi/include -x {language} capi/examples/{example} -x none {library}");
        compile.arg("-o").arg(&binary).run()?;
        cmd!(sh, "{binary}").run()?;
    }
    Ok(())
}

/// Builds an example by clang and runs it, with enums of one byte and of four. The library is the same.
fn run_with_either_enums(sh: &Shell, clang: &Path, library: &Path) -> Result<()> {
    for enums in ["-fshort-enums", "-fno-short-enums"] {
        let binary = library.with_file_name(format!("lift-clang{enums}"));
        cmd!(sh, "{clang} {WARNINGS...} {enums} -I capi/include capi/examples/lift.c {library} -o {binary}").run()?;
        cmd!(sh, "{binary}").run()?;
    }
    Ok(())
}

/// A program in C for the Cortex-M4F.
#[derive(Clone, Copy, Debug)]
pub struct Example {
    name: &'static str,
    features: &'static [&'static str],
    /// Whether all functions are linked, even those that it does not call.
    every_function: bool,
}

pub const HOME: Example = Example { name: "home", features: FEATURES, every_function: false };
pub const LIFT: Example = Example { name: "lift", ..HOME };
/// A robot that is talked to.
pub const TALK: Example = Example { name: "talk", features: FEATURES_AND_TALK, ..HOME };
/// With a library that has no other features.
pub const LIFT_ALONE: Example = Example { features: &["checks", "learning", "table"], ..LIFT };
/// One that only obeys, with a library that cannot do more.
pub const OBEY: Example = Example { name: "obey", features: &["table"], every_function: false };
/// With every function, because the examples do not call all of them.
pub const EVERY_FUNCTION: Example = Example { features: FEATURES_AND_TALK, every_function: true, ..HOME };
/// With every function of the packages for boards.
pub const EVERY_FUNCTION_OF_BOARDS: Example = Example { every_function: true, ..HOME };
/// With every function of a library for both kinds of robot that learn, in memory of any size.
pub const EVERY_FUNCTION_OF_LEARNERS: Example =
    Example { features: &["checks", "forgetting", "home", "learning", "table"], every_function: true, ..LIFT };

impl Example {
    /// Builds it. Returns its path.
    pub fn build(self) -> Result<PathBuf> {
        let Self { name, features, every_function } = self;
        let header = shell()?.read_file(HEADER)?;
        let linked = functions(&header).into_iter().filter(|_| every_function).map(|function| format!("-Wl,--undefined={function}"));
        let binary = format!("{name}-{}{}.elf", features.len(), if every_function { "-all" } else { "" });
        link(&format!("capi/examples/{name}.c"), features, &binary, &linked.collect::<Vec<_>>())
    }
}

/// The search for the longest calls, in this many worlds, built for this processor.
pub fn search_program(processor: &Processor, trials: u32, seed: u32) -> Result<PathBuf> {
    let numbers = [format!("-DTRIALS={trials}"), format!("-DSEED={seed}")];
    link_for(processor, "capi/tests/worst.c", FEATURES_AND_TALK, &format!("worst-{trials}-{seed}.elf"), &numbers)
}

/// A program that makes a table robot, and calls this function, if any.
pub fn program_that_calls(function: Option<&str>) -> Result<PathBuf> {
    let called: Vec<_> = ["goodbot_init_table"].into_iter().chain(function).map(|name| format!("-Wl,--undefined={name}")).collect();
    link("capi/tests/overflow.c", FEATURES_AND_TALK, &format!("with-{}.elf", function.unwrap_or("none")), &called)
}

/// Compiles an example by clang for the Cortex-M4F, with enums of either size, and links it with gcc's C library. Returns the paths.
fn examples_of_clang() -> Result<[PathBuf; 2]> {
    let (sh, clang, gcc) = (shell()?, CLANG.path()?, ARM_GCC.path()?);
    let libc = PathBuf::from(cmd!(sh, "{gcc} -print-file-name=libc.a").read()?);
    let headers = libc.parent().context("gcc names no folder of its C library")?.join("../include");
    let mut found = ["-fshort-enums", "-fno-short-enums"].map(PathBuf::from);
    for binary in &mut found {
        let enums = binary.display().to_string();
        let object = sh.create_dir(target_dir().join("clang"))?.join(format!("lift{enums}.o"));
        let compile =
            cmd!(sh, "{clang} {CLANG_FOR_ARM...} {WARNINGS...} {enums} -O2 -isystem {headers} -I capi/include -c capi/examples/lift.c");
        compile.arg("-o").arg(&object).run()?;
        // The C library's enums are short, but none is in what the example calls.
        let object = object.display().to_string();
        *binary = link(&object, FEATURES, &format!("lift-clang{enums}.elf"), &["-Wl,--no-enum-size-warning".to_owned()])?;
    }
    Ok(found)
}

/// A processor that the emulated Cortex-M4F can be, and gcc's options for it.
#[derive(Debug)]
pub struct Processor {
    target: &'static str,
    options: &'static [&'static str],
}

pub const M4F: Processor = Processor { target: CORTEX_M4F, options: &["-mcpu=cortex-m4", "-mfloat-abi=hard", "-mfpu=fpv4-sp-d16"] };
/// Its instructions are a part of those of the others.
pub const M0: Processor = Processor { target: CORTEX_M0, options: &["-mcpu=cortex-m0", "-mfloat-abi=soft"] };

/// Links a program in C with a library of these features, for the Cortex-M4F.
fn link(program: &str, features: &[&str], name: &str, options: &[String]) -> Result<PathBuf> {
    link_for(&M4F, program, features, name, options)
}

fn link_for(processor: &Processor, program: &str, features: &[&str], name: &str, options: &[String]) -> Result<PathBuf> {
    let (sh, gcc, library) = (shell()?, ARM_GCC.path()?, library(Some(processor.target), features)?);
    let binary = library.with_file_name(name);
    let processor = processor.options.iter().chain(&["-mthumb", "-ffp-contract=off", "-O2"]);
    let sections = ["-ffunction-sections", "-fdata-sections", "-Wl,--gc-sections", "--specs=nano.specs", "--specs=rdimon.specs"];
    let gcc = cmd!(sh, "{gcc} {WARNINGS...} {processor...} {sections...} -nostartfiles -I capi/include -T capi/examples/board/link.ld");
    gcc.arg(program).arg("capi/examples/board/start.c").arg(library).arg("-o").arg(&binary).args(options).run()?;
    Ok(binary)
}

/// Builds the examples for the Cortex-M4F and runs them in the emulator; those of small libraries, which have to be built for them, if `all` are meant.
pub fn on_board(all: bool) -> Result<()> {
    let sh = shell()?;
    assert_layouts(&sh, &ARM_GCC.path()?, &[])?;
    assert_layouts(&sh, &CLANG.path()?, &CLANG_FOR_ARM)?;
    emulate(AN386.name, &link("capi/tests/overflow.c", FEATURES, "overflow.elf", &[])?, FAULT)
        .context("no fault stops a stack that runs over")?;
    for binary in examples_of_clang()? {
        print!("{}", run_alone(&binary)?.0);
    }
    let small = [LIFT_ALONE, OBEY].into_iter().filter(|_| all);
    for example in [HOME, LIFT, TALK, EVERY_FUNCTION].into_iter().chain(small) {
        let binary = example.build()?;
        print!("{}", run_alone(&binary)?.0);
        nothing_panics(&[binary])?;
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn functions_are_found_in_the_header() {
        let header = "enum goodbot_status goodbot_save(struct goodbot *robot,\n    void *(to));\nconst char *goodbot_status_text(int32_t status);\n\
                      typedef bool (*goodbot_holds)(void *context,\n * `goodbot_full` names it (see there).";
        assert_eq!(functions(header), ["goodbot_save", "goodbot_status_text"]);
    }

    #[test]
    fn a_header_says_which_features_its_library_has() {
        let header = shell().unwrap().read_file(HEADER).unwrap();
        let named = header.lines().filter_map(|line| line.strip_prefix("#define GOODBOT_HAS_")?.strip_suffix(" 1"));
        let mut all = ALL_FEATURES.map(str::to_uppercase);
        all.sort_unstable();
        assert!(named.eq(all.iter().map(String::as_str)));
        let of = of_features("int a;\n#define GOODBOT_HAS_TALK 1\n#define GOODBOT_HAS_HOME 1\n", &["home"]);
        assert_eq!(of, "int a;\n#define GOODBOT_HAS_TALK 0\n#define GOODBOT_HAS_HOME 1\n");
    }
}
