//! The C interface, and the guide to a robot of one's own.

use super::Step;
use crate::capi::{example, header};
use crate::guide;

/// The header is not stale.
pub const HEADER: Step = Step::new(
    "c-header",
    "the C header is what the C interface says",
    |_| header::check(),
    "`cargo xtask capi` writes the header again; where a program that was compiled before would go wrong, raise GOODBOT_API_VERSION",
);

/// The examples run on this machine.
pub const HOST: Step = Step::new(
    "c-host",
    "the C examples run under AddressSanitizer and UBSan",
    |_| example::on_host(),
    "the examples are in capi/examples; the sanitizer says where",
);

/// The examples run on a board.
pub const BOARD: Step = Step::new(
    "c-board",
    "the C examples run on an emulated Cortex-M4F, and have nothing in them that panics",
    |_| example::on_board(),
    "the examples are in capi/examples, what the board needs in capi/examples/board",
);

/// The guide's programs work as they stand.
pub const GUIDE: Step = Step::new(
    "guide",
    "the programs of docs/robot.md are built in an empty folder and say what it promises",
    |_| guide::follow(),
    "mend docs/robot.md, or what it speaks of",
);
