//! Prints `capi/include/goodbot.h`, as cbindgen writes it; `cargo xtask capi` saves it.

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
    let config = Config::from_file(capi.join("cbindgen.toml")).map_err(|error| anyhow!("capi/cbindgen.toml: {error}"))?;
    let builder = SOURCES.iter().fold(Builder::new().with_config(config), |builder, file| builder.with_src(capi.join("src").join(file)));
    let mut bytes = Vec::new();
    builder.generate().context("cbindgen could not read capi/src")?.write(&mut bytes);
    // Rust's heading for the caller's promises.
    Ok(String::from_utf8(bytes).context("the header is no text")?.replace("// # Safety\n", "// The caller sees to it:\n"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_header_is_what_the_sources_say() {
        let kept = std::fs::read_to_string(capi().join("include/goodbot.h")).unwrap();
        let advice = "write capi/include/goodbot.h again with `cargo xtask capi`; where a program that was compiled before would go wrong, raise GOODBOT_API_VERSION";
        assert!(kept.trim_end() == header().unwrap().trim_end(), "{advice}");
    }
}
