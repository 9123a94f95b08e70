//! Capacities as source for a controller.

use goodbot::Capacities;
use goodbot::capacity::Capacity;

/// As Rust.
pub fn rust(capacities: &Capacities) -> String {
    let fields = rust_fields(capacities);
    format!("goodbot::memory! {{\n    struct RobotMemory = goodbot::Capacities {{\n{fields}    }};\n}}\n")
}

/// As C, with `bytes` bytes for a robot in homes, or for one of a table.
pub fn c(capacities: &Capacities, bytes: usize, is_table: bool) -> String {
    let (entries, size) = (c_entries(capacities), if is_table { "goodbot_table_size" } else { "goodbot_size" });
    format!(
        "static const goodbot_capacities capacities = {{ {{\n{entries}}} }};\n\
         /* Where a pointer has four bytes; {size}(&capacities) says how many are needed. */\n\
         static _Alignas(8) unsigned char memory[{bytes}];\n"
    )
}

/// A line for each field of capacities in Rust.
pub fn rust_fields(capacities: &Capacities) -> String {
    Capacity::ALL.iter().map(|&capacity| format!("        {}: {},\n", capacity.name(), capacities.get(capacity))).collect()
}

/// A line for each entry of capacities in C.
pub fn c_entries(capacities: &Capacities) -> String {
    Capacity::ALL.iter().map(|&capacity| format!("    [{}] = {},\n", c_name(capacity), capacities.get(capacity))).collect()
}

/// The constant of C for a capacity.
fn c_name(capacity: Capacity) -> String {
    format!("GOODBOT_CAPACITY_{}", capacity.name().to_uppercase())
}
