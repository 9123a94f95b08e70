//! Gives the linker the micro:bit's memory: the stack below everything else in the RAM, as on the other boards, and the last pages of the
//! flash kept for a chosen home and for the learned model.

#[path = "../linker.rs"]
mod linker;

const MEMORY: &str = "\
MEMORY
{
 FLASH : ORIGIN = 0x00000000, LENGTH = 247K
 CHOSEN : ORIGIN = 0x0003DC00, LENGTH = 1K
 LEARNED : ORIGIN = 0x0003E000, LENGTH = 8K
 STACK : ORIGIN = 0x20000000, LENGTH = 3696
 RAM : ORIGIN = 0x20000E70, LENGTH = 12688
}
_stack_start = ORIGIN(STACK) + LENGTH(STACK);
_stack_end = ORIGIN(STACK);
_learned_start = ORIGIN(LEARNED);
_learned_end = ORIGIN(LEARNED) + LENGTH(LEARNED);
";

fn main() {
    linker::link(MEMORY, &["link.x"]);
}
