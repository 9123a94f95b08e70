//! The fault that the processor raises when the stack leaves the RAM: reports it and ends the program.

use crate::board;

/// The exit code of a fault.
const FAULT: u8 = 102;

#[cfg(target_arch = "arm")]
core::arch::global_asm!(
    ".section .text.HardFault, \"ax\", %progbits",
    ".global HardFault",
    ".type HardFault, %function",
    ".thumb_func",
    "HardFault:",
    // The stack is of no use any more: begin at its top again.
    "ldr r0, =_stack_start",
    "mov sp, r0",
    "bl {fault}",
    ".ltorg",
    fault = sym fault,
);

#[cfg(target_arch = "riscv32")]
core::arch::global_asm!(
    ".section .trap.start, \"ax\", @progbits",
    ".balign 4",
    ".global _start_trap",
    "_start_trap:",
    "la sp, _stack_start",
    "call {fault}",
    fault = sym fault,
);

extern "C" fn fault() -> ! {
    board::print("fault\n");
    board::exit(FAULT)
}
