//! Gives the linker a board's memory, for the build scripts of the programs for one board.

use std::path::PathBuf;
use std::{env, fs};

/// Writes the file that the linker scripts include, and passes the arguments.
pub fn link(memory: &str, scripts: &[&str]) {
    let out = PathBuf::from(env::var_os("OUT_DIR").expect("cargo sets OUT_DIR"));
    fs::write(out.join("memory.x"), memory).expect("memory.x can be written");
    println!("cargo::rustc-link-search={}", out.display());
    for script in scripts {
        println!("cargo::rustc-link-arg-bins=-T{script}");
    }
    println!("cargo::rustc-link-arg-bins=--nmagic");
    println!("cargo::rerun-if-changed=build.rs");
}
