//! Prints `capi/include/goodbot.h`, as cbindgen writes it; `cargo xtask capi` saves it.

mod layout;

use std::fmt::Write;
use std::path::Path;

use anyhow::{Context, Result, anyhow};
use cbindgen::{Builder, Config};

/// The sources of the header's items, in the header's order.
const SOURCES: [&str; 20] = [
    "status.rs",
    "version.rs",
    "capacities.rs",
    "memory.rs",
    "robot.rs",
    "tasks.rs",
    "home.rs",
    "table/description.rs",
    "table/init.rs",
    "training.rs",
    "options.rs",
    "beliefs.rs",
    "words.rs",
    "asking.rs",
    "voice.rs",
    "talk.rs",
    "model.rs",
    "starter.rs",
    "parameters.rs",
    "storage.rs",
];

fn capi() -> &'static Path {
    Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/.."))
}

fn main() -> Result<()> {
    print!("{}", header()?);
    Ok(())
}

fn header() -> Result<String> {
    let capi = capi();
    let manifest = std::fs::read_to_string(capi.join("Cargo.toml")).context("capi/Cargo.toml")?;
    let config = Config::from_file(capi.join("cbindgen.toml")).map_err(|error| anyhow!("capi/cbindgen.toml: {error}"))?;
    let builder = SOURCES.iter().fold(Builder::new().with_config(config), |builder, file| builder.with_src(capi.join("src").join(file)));
    let mut bytes = Vec::new();
    builder.generate().context("cbindgen could not read capi/src")?.write(&mut bytes);
    // Rust's heading for the caller's promises.
    let header = String::from_utf8(bytes).context("the header is no text")?.replace("// # Safety\n", "// The caller sees to it:\n");
    let layouts = layout::assertions(&layout::structs(&header)?);
    let header = header.replacen(INCLUDED, &format!("{INCLUDED}\n{}", of_the_library(&manifest)?), 1);
    Ok(header.replacen(END, &format!("{layouts}\n{END}"), 1))
}

/// The last line of the includes, and the end of what is included once.
const INCLUDED: &str = "#include <stdint.h>\n";
const END: &str = "#endif  /* GOODBOT_H */";

/// The library's version and features, as numbers for `#if`.
fn of_the_library(manifest: &str) -> Result<String> {
    let mut text = String::from("// The library's version.\n");
    let version = env!("CARGO_PKG_VERSION").split(['.', '-']);
    for (part, number) in ["MAJOR", "MINOR", "PATCH"].into_iter().zip(version) {
        writeln!(text, "#define GOODBOT_VERSION_{part} {number}")?;
    }
    text += "\n// The features of the library that this header came with: 1 for those that it has. Only their functions are there to be linked.\n";
    let (_, features) = manifest.split_once("\n[features]\n").context("capi/Cargo.toml has features")?;
    let named = features.lines().take_while(|line| !line.starts_with('[')).filter(|line| !line.starts_with('#'));
    let mut names: Vec<_> = named.filter_map(|line| line.split_once(" = ")).map(|(name, _)| name).collect();
    names.sort_unstable();
    // How it is built, not what it can do.
    names.retain(|name| !["default", "alone"].contains(name));
    names.into_iter().try_for_each(|name| writeln!(text, "#define GOODBOT_HAS_{} 1", name.to_uppercase()))?;
    Ok(text + MUST_USE)
}

/// A status that is not looked at is a fault that nobody sees.
const MUST_USE: &str = "
// Warns where the result of a function is not used. Define it as nothing before the header is included, if that is too strict.
#ifndef GOODBOT_MUST_USE
#if (defined(__cplusplus) && __cplusplus >= 201703L) || (defined(__STDC_VERSION__) && __STDC_VERSION__ >= 202311L)
#define GOODBOT_MUST_USE [[nodiscard]]
#elif defined(__GNUC__)
#define GOODBOT_MUST_USE __attribute__((warn_unused_result))
#else
#define GOODBOT_MUST_USE
#endif
#endif
";

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_header_is_what_the_sources_say() {
        let kept = std::fs::read_to_string(capi().join("include/goodbot.h")).unwrap();
        let advice = "write capi/include/goodbot.h again with `cargo xtask capi`; where a program that was compiled before would go wrong, raise GOODBOT_API_VERSION";
        assert!(kept.trim_end() == header().unwrap().trim_end(), "{advice}");
    }

    #[test]
    fn each_name_of_the_version_before_stands_for_one_of_this_version() {
        let header = std::fs::read_to_string(capi().join("include/goodbot.h")).unwrap();
        let (now, old) = header.split_once("/** Names of the version before").unwrap();
        let names = old.lines().filter_map(|line| line.strip_prefix("#define ")?.split_once(' '));
        let is_declared = |name| [format!("#define {name} "), format!("goodbot_status {name}(")].iter().any(|text| now.contains(text));
        let [mut done, mut evidence] = [false; 2];
        for (old, name) in names {
            assert!(is_declared(name) && !is_declared(old), "{old} is {name}");
            done |= old == "goodbot_done";
            evidence |= old == "GOODBOT_EVIDENCE_NOTHING";
        }
        assert!(done && evidence);
    }
}
