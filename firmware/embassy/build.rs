//! Gives the linker the board's memory.

use std::path::PathBuf;
use std::{env, fs};

/// Feature, KiB of flash and KiB of RAM. The last 8 KiB of the flash are left to what the robot learns.
const BOARDS: [(&str, u32, u32); 2] = [("MPS2_AN386", 512, 64), ("MICROBIT_V2", 512, 128)];

fn main() {
    let chosen = BOARDS.iter().find(|board| env::var_os(format!("CARGO_FEATURE_{}", board.0)).is_some());
    let Some((_, flash, ram)) = chosen else { panic!("choose one board by its feature: mps2-an386 or microbit-v2") };
    let memory =
        format!("MEMORY\n{{\n FLASH : ORIGIN = 0x00000000, LENGTH = {}K\n RAM : ORIGIN = 0x20000000, LENGTH = {ram}K\n}}\n", flash - 8);
    let out = PathBuf::from(env::var_os("OUT_DIR").expect("cargo sets OUT_DIR"));
    fs::write(out.join("memory.x"), memory).expect("memory.x can be written");
    println!("cargo::rustc-link-search={}", out.display());
    println!("cargo::rustc-link-arg-bins=-Tlink.x");
    println!("cargo::rustc-link-arg-bins=--nmagic");
    println!("cargo::rerun-if-changed=build.rs");
}
