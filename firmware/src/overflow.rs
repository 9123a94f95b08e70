//! A stack that runs over: the processor must stop it before it changes a static. Ends with 0 where a static was changed or nothing stopped it.

#![no_std]
#![no_main]

#[allow(dead_code, reason = "it counts nothing")]
mod board;
mod fault;

use core::hint::black_box;

/// As much as the smallest board has of RAM.
const DEPTH: usize = 16 * 1024 / 64;

/// Takes 64 bytes of the stack and more for each level.
#[inline(never)]
fn descend(level: usize) -> usize {
    let taken = black_box([level; 16]);
    if level == 0 { taken.len() } else { descend(level.wrapping_sub(1)).wrapping_add(black_box(&taken).len()) }
}

#[cortex_m_rt::entry]
fn main() -> ! {
    board::print("descending\n");
    black_box(descend(black_box(DEPTH)));
    board::print("nothing stopped it\n");
    board::exit(0)
}
