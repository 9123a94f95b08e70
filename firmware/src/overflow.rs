//! A stack that overflows: the processor must stop it before it changes a static. Exits with 0 if nothing stopped it, so that it ran into
//! other memory.

#![no_std]
#![no_main]

#[allow(dead_code, reason = "it counts nothing")]
mod board;
mod fault;

use core::hint::black_box;

unsafe extern "C" {
    static _stack_start: u32;
    static _stack_end: u32;
}

/// Takes 64 bytes of the stack and more for each level.
#[inline(never)]
fn descend(level: usize) -> usize {
    let taken = black_box([level; 16]);
    if level == 0 { taken.len() } else { descend(level.wrapping_sub(1)).wrapping_add(black_box(&taken).len()) }
}

#[board::entry]
fn main() -> ! {
    board::print("descending\n");
    // A little more than the stack, and far less than the RAM: with other memory below the stack, the call would return.
    let stack = (&raw const _stack_start as usize).wrapping_sub(&raw const _stack_end as usize);
    black_box(descend(black_box(stack / 64)));
    board::print("nothing stopped it\n");
    board::exit(0)
}
