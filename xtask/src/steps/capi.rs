//! The C interface.

use super::Step;
use crate::capi::{example, header};

/// The header is not stale.
pub const HEADER: Step = Step {
    name: "c-header",
    about: "the C header is what the C interface says",
    fast: true,
    run: |_| header::check(),
    next: "`cargo xtask capi` writes the header again; where a program that was compiled before would go wrong, raise GOODBOT_API_VERSION",
};

/// The examples run on this machine.
pub const HOST: Step = Step {
    name: "c-host",
    about: "the C examples run under AddressSanitizer and UBSan",
    fast: false,
    run: |_| example::on_host(),
    next: "the examples are in capi/examples; the sanitizer says where",
};

/// The examples run on a board.
pub const BOARD: Step = Step {
    name: "c-board",
    about: "the C examples run on an emulated Cortex-M4F, and have nothing in them that panics",
    fast: false,
    run: |_| example::on_board(),
    next: "the examples are in capi/examples, what the board needs in capi/examples/board",
};
