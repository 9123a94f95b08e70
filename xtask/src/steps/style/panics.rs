//! The core has no call that is there to panic, and no heap. Its tests may.
//!
//! Clippy knows more about this and is asked by the core itself; this finds
//! also what an `allow` hides from clippy.

use super::{Breach, Source, numbered};

const WHERE: &str = "core/src/";

const FORBIDDEN: [&str; 9] =
    [".unwrap(", ".expect(", ".unwrap_err(", ".expect_err(", "panic!", "unreachable!", "todo!", "unimplemented!", "alloc::"];

pub fn rule(source: &Source) -> Vec<Breach> {
    let Some(below) = source.path.strip_prefix(WHERE) else {
        return Vec::new();
    };
    if !below.ends_with(".rs") || is_test_file(below) {
        return Vec::new();
    }
    let mut breaches = Vec::new();
    for (line, text) in code_lines(source.text) {
        for word in FORBIDDEN.iter().filter(|word| has(text, word)) {
            breaches.push(Breach { line, what: format!("`{word}` has no place in the core") });
        }
    }
    breaches
}

fn is_test_file(path: &str) -> bool {
    let path = path.trim_end_matches(".rs");
    path.split('/').any(|part| part == "tests" || part.ends_with("_tests"))
}

/// Whether the word is there, and not as the end of a longer one.
fn has(text: &str, word: &str) -> bool {
    text.match_indices(word).any(|(at, _)| {
        let before = text[..at].chars().next_back();
        word.starts_with('.') || !before.is_some_and(|c| c.is_alphanumeric() || c == '_')
    })
}

/// The lines without comments and without the items that are for tests only.
/// An item ends, as rustfmt writes it, at the bracket that stands as far in as
/// the item began.
fn code_lines(text: &str) -> Vec<(usize, &str)> {
    let mut kept = Vec::new();
    let mut lines = numbered(text);
    while let Some((number, line)) = lines.next() {
        let code = line.split("//").next().unwrap_or_default();
        if code.trim_start().starts_with("#[cfg(test)]") {
            skip_item(&mut lines);
        } else {
            kept.push((number, code));
        }
    }
    kept
}

fn skip_item<'a>(lines: &mut impl Iterator<Item = (usize, &'a str)>) {
    let is_head = |line: &str| line.starts_with("#[") || line.starts_with("//");
    let Some((_, first)) = lines.find(|(_, line)| !is_head(line.trim_start())) else {
        return;
    };
    if first.ends_with(';') || first.ends_with('}') || first.ends_with(',') {
        return;
    }
    let indent = first.len() - first.trim_start().len();
    let is_end = |line: &str| {
        let rest = line.trim_start();
        line.len() - rest.len() == indent && rest.starts_with(['}', ')', ']']) && !rest.ends_with('{')
    };
    let _ = lines.find(|(_, line)| is_end(line));
}

#[cfg(test)]
mod tests {
    use super::*;

    fn lines(path: &str, text: &str) -> Vec<usize> {
        let breaches = rule(&Source { path, text });
        breaches.iter().map(|breach| breach.line).collect()
    }

    #[test]
    fn what_panics_is_found_in_the_core_only() {
        let text = "fn f() {\n    a.unwrap();\n    panic!(\"no\");\n    a.unwrap_or(0);\n}\n";
        assert_eq!(lines("core/src/a.rs", text), [2, 3]);
        assert!(lines("formats/src/a.rs", text).is_empty());
        assert!(lines("core/src/a/tests.rs", text).is_empty());
    }

    #[test]
    fn comments_attributes_and_longer_words_are_left_alone() {
        let text = "/// `a.unwrap()`\n#[expect(dead_code)]\nuse my_alloc::b; // panic!\n";
        assert!(lines("core/src/a.rs", text).is_empty());
        assert_eq!(lines("core/src/a.rs", "use alloc::vec::Vec;\n"), [1]);
    }

    #[test]
    fn tests_may_panic_but_not_what_follows_them() {
        let text = "\
#[cfg(test)]
mod tests;
#[cfg(test)]
#[allow(dead_code)]
fn help(
    a: u8,
) {
    a.unwrap();
}
fn f() {
    a.expect(\"b\");
}
#[cfg(test)]
mod more {
    fn g() {
        a.unwrap();
    }
}
fn h() {
    todo!()
}
";
        assert_eq!(lines("core/src/a.rs", text), [11, 20]);
    }
}
