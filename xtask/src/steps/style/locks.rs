//! npm's lock files name packages by version and checksum alone, so that they
//! can be installed from any mirror.

use super::{Breach, Source, numbered};

pub fn rule(source: &Source) -> Vec<Breach> {
    if !source.path.ends_with("package-lock.json") {
        return Vec::new();
    }
    numbered(source.text)
        .filter(|(_, line)| line.trim_start().starts_with("\"resolved\": \"http"))
        .map(|(line, _)| Breach {
            line,
            what: "names the server a package came from: write the file again with \
                   `npm config set omit-lockfile-registry-resolved true`"
                .to_owned(),
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_server_in_a_lock_file_is_found() {
        let text = "{\n  \"version\": \"1\",\n  \"resolved\": \"https://example.org/a.tgz\"\n}\n";
        let lines = |path| {
            let breaches = rule(&Source { path, text });
            breaches.iter().map(|b| b.line).collect::<Vec<_>>()
        };
        assert_eq!(lines("page/package-lock.json"), [3]);
        assert!(lines("page/other.json").is_empty());
    }
}
