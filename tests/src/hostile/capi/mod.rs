//! The C interface, called in any order as a program in C calls it, through the real functions.
//!
//! Memory may be too small or misaligned, pointers null where the contract lets them be refused, texts any bytes, descriptions wrong in
//! any field, graphs of steps anything. Every block is exactly as large as the call is told, so that a sanitizer sees the first byte beyond
//! it.
//!
//! - [`blocks`]: the memory;
//! - [`texts`]: C strings;
//! - [`machine`]: a hostile robot's steps;
//! - [`description`]: a robot of the caller's own, described wrongly or rightly;
//! - [`calls`]: calls in parts, with questions, explanations and settings;
//! - [`program`]: the program that makes the calls.

mod blocks;
mod calls;
mod description;
mod machine;
mod program;
mod texts;

use super::Bytes;
use program::Program;

/// The most calls for one input.
const MOST_CALLS: usize = 120;

/// Makes the calls that the bytes choose.
pub fn capi(input: &[u8]) {
    let mut choices = Bytes::new(input);
    let mut program = Program::new();
    for _ in 0..MOST_CALLS {
        if choices.is_empty() {
            break;
        }
        program.call(&mut choices);
        program.assert_sound();
    }
}
