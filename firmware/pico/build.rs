//! Gives the linker the Pico's memory; the first 256 bytes of the flash are the chip's own second loader.

#[path = "../linker.rs"]
mod linker;

const MEMORY: &str = "\
MEMORY
{
 BOOT2 : ORIGIN = 0x10000000, LENGTH = 0x100
 FLASH : ORIGIN = 0x10000100, LENGTH = 2048K - 0x100
 RAM : ORIGIN = 0x20000000, LENGTH = 264K
}
";

fn main() {
    linker::link(MEMORY, &["link.x", "link-rp.x"]);
}
