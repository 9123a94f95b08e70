//! Capacities as source code for a controller.

use goodbot::Capacities;
use goodbot::capacity::Capacity;

/// The capacities in Rust.
pub fn rust(capacities: &Capacities) -> String {
    let fields = rust_fields(capacities);
    format!("goodbot::memory! {{\n    struct RobotMemory = goodbot::Capacities {{\n{fields}    }};\n}}\n")
}

/// The capacities in C, with a buffer of `bytes` bytes for a robot in homes, or for one with a table.
pub fn c(capacities: &Capacities, bytes: usize, is_table: bool) -> String {
    let (table, size) = (c_table("capacities", capacities), if is_table { "goodbot_table_size" } else { "goodbot_size" });
    format!(
        "{table}/* Where a pointer has four bytes; {size}(&capacities) says how many are needed. */\n\
         GOODBOT_ALIGNED static unsigned char memory[{bytes}];\n"
    )
}

/// A line for each field of capacities in Rust.
pub fn rust_fields(capacities: &Capacities) -> String {
    Capacity::ALL.iter().map(|&capacity| format!("        {}: {},\n", capacity.name(), capacities.get(capacity))).collect()
}

/// Capacities of this name in C that also compile as C++, which has no designated array entries.
pub fn c_table(name: &str, capacities: &Capacities) -> String {
    let entries: String =
        Capacity::ALL.iter().map(|&capacity| format!("    {}, /* {} */\n", capacities.get(capacity), capacity.name())).collect();
    format!(
        "#if GOODBOT_CAPACITIES != {}\n#error \"print these capacities with the goodbot that this library comes from\"\n#endif\n\
         static const goodbot_capacities {name} = {{ {{\n{entries}}} }};\n",
        Capacity::ALL.len()
    )
}
