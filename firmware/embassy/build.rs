//! Gives the linker the micro:bit's memory: the stack below everything else in the RAM, and the last pages of the flash kept for the
//! learned model.

#[path = "../linker.rs"]
mod linker;

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
    linker::link(MEMORY, &["link.x"]);
}
