//! Capacities as source for a controller.

use goodbot::Capacities;
use goodbot::capacity::Capacity;

/// As Rust.
pub fn rust(capacities: &Capacities) -> String {
    let fields: String =
        Capacity::ALL.iter().map(|&capacity| format!("        {}: {},\n", capacity.name(), capacities.get(capacity))).collect();
    format!("goodbot::memory! {{\n    struct RobotMemory = goodbot::Capacities {{\n{fields}    }};\n}}\n")
}

/// As C, with `bytes` bytes for a robot in homes.
pub fn c(capacities: &Capacities, bytes: usize) -> String {
    let entries: String =
        Capacity::ALL.iter().map(|&capacity| format!("    [{}] = {},\n", c_name(capacity), capacities.get(capacity))).collect();
    format!(
        "static const goodbot_capacities capacities = {{ {{\n{entries}}} }};\n\
         /* For a robot in homes where a pointer has four bytes; goodbot_size(&capacities) says how many are needed. */\n\
         static _Alignas(8) unsigned char memory[{bytes}];\n"
    )
}

/// The constant of C for a capacity.
fn c_name(capacity: Capacity) -> String {
    format!("GOODBOT_CAPACITY_{}", capacity.name().to_uppercase())
}
