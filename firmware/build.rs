//! Gives the linker the board's memory.

use std::path::PathBuf;
use std::{env, fs};

/// Feature, flash and RAM: where each begins and its KiB.
const BOARDS: [(&str, &str); 3] = [
    ("MPS2_AN386", "FLASH : ORIGIN = 0x00000000, LENGTH = 256K\n RAM : ORIGIN = 0x20000000, LENGTH = 64K"),
    ("MPS2_AN385", "FLASH : ORIGIN = 0x00000000, LENGTH = 256K\n RAM : ORIGIN = 0x20000000, LENGTH = 64K"),
    ("MICROBIT", "FLASH : ORIGIN = 0x00000000, LENGTH = 256K\n RAM : ORIGIN = 0x20000000, LENGTH = 16K"),
];

fn main() {
    let chosen: Vec<&str> =
        BOARDS.iter().filter(|(name, _)| env::var_os(format!("CARGO_FEATURE_{name}")).is_some()).map(|&(_, memory)| memory).collect();
    let [memory] = chosen[..] else {
        panic!("choose one board by its feature: mps2-an386, mps2-an385 or microbit");
    };
    let out = PathBuf::from(env::var_os("OUT_DIR").expect("cargo sets OUT_DIR"));
    fs::write(out.join("memory.x"), format!("MEMORY\n{{\n {memory}\n}}\n")).expect("memory.x can be written");
    println!("cargo::rustc-link-search={}", out.display());
    println!("cargo::rustc-link-arg-bins=-Tlink.x");
    println!("cargo::rustc-link-arg-bins=--nmagic");
    println!("cargo::rerun-if-changed=build.rs");
}
