//! Gives the linker the board's memory.
//!
//! The stack lies below everything else in the RAM: a stack that runs over leaves the RAM, which the processor answers with a fault. With the
//! stack on top, it would run into the statics and change them unseen.

use std::path::PathBuf;
use std::{env, fs};

/// Where the RAM begins on every board.
const RAM: u32 = 0x2000_0000;
const KIB: u32 = 1024;

/// Feature, bytes of RAM, and how many of them are the stack's.
const BOARDS: [(&str, u32, u32); 3] = [("MPS2_AN386", 64 * KIB, 8 * KIB), ("MPS2_AN385", 64 * KIB, 8 * KIB), ("MICROBIT", 16 * KIB, 5_280)];

fn main() {
    let is_chosen = |board: &&(&str, u32, u32)| env::var_os(format!("CARGO_FEATURE_{}", board.0)).is_some();
    let chosen: Vec<_> = BOARDS.iter().filter(is_chosen).collect();
    let [&(_, ram, stack)] = chosen[..] else {
        panic!("choose one board by its feature: mps2-an386, mps2-an385 or microbit");
    };
    let memory = format!(
        "MEMORY\n{{\n FLASH : ORIGIN = 0x00000000, LENGTH = 256K\n STACK : ORIGIN = {RAM}, LENGTH = {stack}\n \
         RAM : ORIGIN = {}, LENGTH = {}\n}}\n_stack_start = ORIGIN(STACK) + LENGTH(STACK);\n_stack_end = ORIGIN(STACK);\n",
        RAM + stack,
        ram - stack
    );
    let out = PathBuf::from(env::var_os("OUT_DIR").expect("cargo sets OUT_DIR"));
    fs::write(out.join("memory.x"), memory).expect("memory.x can be written");
    println!("cargo::rustc-link-search={}", out.display());
    println!("cargo::rustc-link-arg-bins=-Tlink.x");
    println!("cargo::rustc-link-arg-bins=--nmagic");
    println!("cargo::rerun-if-changed=build.rs");
}
