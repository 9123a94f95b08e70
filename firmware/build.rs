//! Gives the linker the board's memory.
//!
//! The stack is below everything else in the RAM: a stack that overflows leaves the RAM, and the processor raises a fault. With the stack
//! on top, it would silently overwrite the statics.

mod linker;

use std::env;

const KIB: u32 = 1024;
const FLASH: u32 = 256 * KIB;

struct Board {
    /// Its feature, as cargo names it.
    feature: &'static str,
    /// Where the flash and the RAM begin.
    flash: u32,
    ram: u32,
    /// Bytes of RAM, and of the stack within it.
    bytes: u32,
    stack: u32,
}

const AN386: Board = Board { feature: "MPS2_AN386", flash: 0, ram: 0x2000_0000, bytes: 64 * KIB, stack: 8 * KIB };
const BOARDS: [Board; 5] = [
    AN386,
    Board { feature: "MPS2_AN385", ..AN386 },
    // Its secure side, where it starts.
    Board { feature: "MPS2_AN505", flash: 0x1000_0000, ram: 0x3800_0000, ..AN386 },
    Board { feature: "MICROBIT", bytes: 16 * KIB, stack: 5_312, ..AN386 },
    // All its memory is RAM, and the stack begins it; the "flash" is the part after 64 KiB.
    Board { feature: "VIRT", flash: 0x8001_0000, ram: 0x8000_0000, ..AN386 },
];

fn main() {
    let is_chosen = |board: &&Board| env::var_os(format!("CARGO_FEATURE_{}", board.feature)).is_some();
    let chosen: Vec<_> = BOARDS.iter().filter(is_chosen).collect();
    let [&Board { flash, ram, bytes, stack, .. }] = chosen[..] else {
        let names: Vec<_> = BOARDS.iter().map(|board| board.feature.to_lowercase().replace('_', "-")).collect();
        panic!("choose one board by its feature: {}", names.join(", "));
    };
    let (bytes, stack) = if env::var_os("CARGO_FEATURE_FULL").is_some() { (4 * 1024 * KIB, 16 * KIB) } else { (bytes, stack) };
    let regions = ["TEXT", "RODATA", "DATA", "BSS", "HEAP", "STACK"].map(|region| {
        let memory = match region {
            "TEXT" | "RODATA" => "FLASH",
            "STACK" => "STACK",
            _ => "RAM",
        };
        format!("REGION_ALIAS(\"REGION_{region}\", {memory});\n")
    });
    let memory = format!(
        "MEMORY\n{{\n FLASH : ORIGIN = {flash}, LENGTH = {FLASH}\n STACK : ORIGIN = {ram}, LENGTH = {stack}\n \
         RAM : ORIGIN = {}, LENGTH = {}\n}}\n_stack_start = ORIGIN(STACK) + LENGTH(STACK);\n_stack_end = ORIGIN(STACK);\n{}",
        ram + stack,
        bytes - stack,
        regions.concat()
    );
    // The linker script for Cortex-M includes the memory by itself.
    let is_riscv = env::var("CARGO_CFG_TARGET_ARCH").is_ok_and(|arch| arch == "riscv32");
    linker::link(&memory, if is_riscv { &["memory.x", "link.x"] } else { &["link.x"] });
}
