//! Gives the linker the micro:bit's memory: the stack below everything else in the RAM, and the last pages of the flash kept for the
//! learned model.

use std::path::PathBuf;
use std::{env, fs};

const MEMORY: &str = "\
MEMORY
{
 FLASH : ORIGIN = 0x00000000, LENGTH = 248K
 LEARNED : ORIGIN = 0x0003E000, LENGTH = 8K
 STACK : ORIGIN = 0x20000000, LENGTH = 4480
 RAM : ORIGIN = 0x20001180, LENGTH = 11904
}
_stack_start = ORIGIN(STACK) + LENGTH(STACK);
_stack_end = ORIGIN(STACK);
";

fn main() {
    let out = PathBuf::from(env::var_os("OUT_DIR").expect("cargo sets OUT_DIR"));
    fs::write(out.join("memory.x"), MEMORY).expect("memory.x can be written");
    println!("cargo::rustc-link-search={}", out.display());
    println!("cargo::rustc-link-arg-bins=-Tlink.x");
    println!("cargo::rustc-link-arg-bins=--nmagic");
    println!("cargo::rerun-if-changed=build.rs");
}
