//! The benchmarks for a WebAssembly host, which measures the time: `peers/wasm.mjs`.

use std::cell::RefCell;

use crate::works;

thread_local! {
    static RUN: RefCell<Option<Box<dyn FnMut()>>> = const { RefCell::new(None) };
}

/// Prepares the benchmark at this position.
#[unsafe(no_mangle)]
pub extern "C" fn prepare(position: u32) {
    let work = works::all().into_iter().nth(position as usize);
    RUN.set(work.map(|work| (work.prepare)()));
}

/// Runs the prepared benchmark this many times.
#[unsafe(no_mangle)]
pub extern "C" fn run(times: u32) {
    RUN.with_borrow_mut(|run| {
        for _ in 0..times {
            if let Some(run) = run {
                run();
            }
        }
    });
}
