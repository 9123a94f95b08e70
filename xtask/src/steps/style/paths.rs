//! No file names a place on somebody's machine.

use super::{Breach, Source, numbered};

/// Folders, right below the top one, in which people have their working copies.
const FOLDERS: [&str; 4] = ["work", "root", "home", "Users"];

pub fn rule(source: &Source) -> Vec<Breach> {
    let mut breaches = Vec::new();
    for (line, text) in numbered(source.text) {
        for folder in FOLDERS {
            if names(text, folder) {
                breaches.push(Breach { line, what: format!("names a place on one machine (in /{folder})") });
            }
        }
    }
    breaches
}

/// Whether the line has the folder's absolute path, or one of a file in it.
fn names(line: &str, folder: &str) -> bool {
    let path = format!("/{folder}");
    line.match_indices(&path).any(|(at, _)| {
        let before = line[..at].chars().next_back();
        let after = line[at + path.len()..].chars().next();
        before.is_none_or(begins_path) && after.is_none_or(ends_name)
    })
}

fn begins_path(before: char) -> bool {
    before.is_whitespace() || "\"'`=:,;|([{".contains(before)
}

fn ends_name(after: char) -> bool {
    !(after.is_alphanumeric() || after == '_' || after == '-')
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn absolute_paths_are_found() {
        for folder in FOLDERS {
            for line in [
                format!("cd /{folder}/project"),
                format!("path = \"/{folder}\""),
                format!("/{folder}/a"),
                format!("PATH=/bin:/{folder}/bin"),
            ] {
                assert!(names(&line, folder), "{line}");
            }
        }
    }

    #[test]
    fn other_uses_of_the_names_are_left_alone() {
        for line in
            ["core/src/home/mod.rs", "./root/a", "<root></root>", "https://example.org/work/a", "a /workspace of one's own", "and/or/work"]
        {
            for folder in FOLDERS {
                assert!(!names(line, folder), "{line}");
            }
        }
    }
}
