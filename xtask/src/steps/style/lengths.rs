//! No Rust file is too long to be about one thing.

use super::{Breach, Source};

const MOST_LINES: usize = 420;

pub fn rule(source: &Source) -> Vec<Breach> {
    let lines = source.text.lines().count();
    if !source.path.ends_with(".rs") || lines <= MOST_LINES {
        return Vec::new();
    }
    vec![Breach { line: lines, what: format!("{lines} lines, and {MOST_LINES} are the most: split it by what it is about") }]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_a_rust_file_can_be_too_long() {
        let text = "\n".repeat(MOST_LINES + 1);
        let breaches = |path, text| rule(&Source { path, text }).len();
        assert_eq!(breaches("core/src/lib.rs", &text), 1);
        assert_eq!(breaches("core/src/lib.rs", &text[1..]), 0);
        assert_eq!(breaches("notes.md", &text), 0);
    }
}
