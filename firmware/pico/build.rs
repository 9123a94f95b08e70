//! Gives the linker the Pico's memory; the first 256 bytes of the flash are the chip's own second loader.

use std::path::PathBuf;
use std::{env, fs};

const MEMORY: &str = "\
MEMORY
{
 BOOT2 : ORIGIN = 0x10000000, LENGTH = 0x100
 FLASH : ORIGIN = 0x10000100, LENGTH = 2048K - 0x100
 RAM : ORIGIN = 0x20000000, LENGTH = 264K
}
";

fn main() {
    let out = PathBuf::from(env::var_os("OUT_DIR").expect("cargo sets OUT_DIR"));
    fs::write(out.join("memory.x"), MEMORY).expect("memory.x can be written");
    println!("cargo::rustc-link-search={}", out.display());
    for argument in ["-Tlink.x", "-Tlink-rp.x", "--nmagic"] {
        println!("cargo::rustc-link-arg-bins={argument}");
    }
    println!("cargo::rerun-if-changed=build.rs");
}
