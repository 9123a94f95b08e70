//! `capi/include/goodbot.h`, as cbindgen writes it: printed, as `cargo xtask capi` takes it.

use std::path::Path;

use anyhow::{Context, Result, anyhow};
use cbindgen::{Builder, Config};

/// The sources whose items the header has, in its order.
const SOURCES: [&str; 15] = [
    "status.rs",
    "version.rs",
    "capacities.rs",
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
    "model.rs",
    "storage.rs",
];

fn main() -> Result<()> {
    let capi = Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/.."));
    let config = Config::from_file(capi.join("cbindgen.toml")).map_err(|error| anyhow!("capi/cbindgen.toml: {error}"))?;
    let builder = SOURCES.iter().fold(Builder::new().with_config(config), |builder, file| builder.with_src(capi.join("src").join(file)));
    let mut bytes = Vec::new();
    builder.generate().context("cbindgen could not read capi/src")?.write(&mut bytes);
    // Rust's heading for what the caller promises.
    print!("{}", String::from_utf8(bytes).context("the header is no text")?.replace("// # Safety\n", "// The caller sees to it:\n"));
    Ok(())
}
