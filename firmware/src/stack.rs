//! The deepest stack, by the paint that it has overwritten.

#[cfg(target_arch = "riscv32")]
use crate::board::STACK_PAINT_VALUE;
#[cfg(target_arch = "arm")]
use cortex_m_rt::STACK_PAINT_VALUE;

unsafe extern "C" {
    static _stack_start: u32;
    static _stack_end: u32;
    static __sdata: u32;
    static __ebss: u32;
}

/// Bytes from the top of the stack to the lowest word that was ever written. The start-up code has painted all of it.
pub fn deepest() -> u32 {
    let (top, bottom) = (&raw const _stack_start as usize, &raw const _stack_end as usize);
    let mut at = bottom;
    while at < top {
        // SAFETY: the linker's symbols enclose this board's stack, which is readable memory, and `at` is aligned like them.
        let word = unsafe { (at as *const u32).read_volatile() };
        if word != STACK_PAINT_VALUE {
            break;
        }
        at = at.wrapping_add(4);
    }
    top.wrapping_sub(at) as u32
}

/// Bytes of static memory.
pub fn statics() -> u32 {
    (&raw const __ebss as usize).wrapping_sub(&raw const __sdata as usize) as u32
}

/// Bytes of the whole stack.
#[allow(dead_code, reason = "only the micro:bit tells it")]
pub fn whole() -> u32 {
    (&raw const _stack_start as usize).wrapping_sub(&raw const _stack_end as usize) as u32
}
