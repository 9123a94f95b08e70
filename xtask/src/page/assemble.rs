//! One HTML file out of its parts.

use std::path::Path;
use std::process::Command;

use anyhow::{Context, Result, bail};
use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use zopfli::{Format, Options};

use super::Parts;
use crate::{process, project, toolchain};

/// The page's scripts, in the order in which they stand in the file.
const SCRIPTS: [&str; 13] = [
    "state.js",
    "storage.js",
    "words.js",
    "plan.js",
    "robot.js",
    "session.js",
    "thoughts.js",
    "tour.js",
    "build.js",
    "textmap.js",
    "settings.js",
    "speech.js",
    "main.js",
];

/// Puts style, scripts, glue and module into `index.html`.
pub fn assemble(folder: &Path, parts: &Parts) -> Result<String> {
    let read = |name: &str| std::fs::read_to_string(folder.join(name)).with_context(|| format!("page/{name} cannot be read"));
    let mut script = format!("(function () {{\n\"use strict\";\n{}", parts.glue);
    for name in SCRIPTS {
        script.push('\n');
        script.push_str(&read(&format!("src/{name}"))?);
    }
    script.push_str("})();\n");
    let script = minified(&folder.join("tests"), &script)?;
    let mut html = read("index.html")?;
    for (mark, text) in [
        ("/*STYLE*/", without_comments(&read("style.css")?)),
        ("/*SCRIPT*/", escaped(&script)),
        ("<!--MODULE-->", STANDARD.encode(deflated(&parts.wasm)?)),
    ] {
        if html.matches(mark).count() != 1 {
            bail!("page/index.html must have {mark} once");
        }
        html = html.replacen(mark, &text, 1);
    }
    Ok(without_comments(&html))
}

/// A script made small by terser, which npm installs beside the page's tests.
fn minified(tests: &Path, script: &str) -> Result<String> {
    toolchain::need_program("node", &["nodejs", "npm"], "to make the page's scripts small")?;
    toolchain::npm_ci(tests)?;
    let folder = project::target_dir().join("page");
    let (whole, small) = (folder.join("page.js"), folder.join("page.min.js"));
    std::fs::write(&whole, script).with_context(|| format!("{} cannot be written", whole.display()))?;
    let mut terser = Command::new("node");
    terser.arg(tests.join("node_modules/terser/bin/terser")).arg(&whole);
    process::run(terser.args(["--compress", "passes=2", "--mangle", "--output"]).arg(&small))?;
    std::fs::read_to_string(&small).with_context(|| format!("{} was not written", small.display()))
}

/// A text's lines without those that hold nothing but a comment, and without indentation.
fn without_comments(script: &str) -> String {
    let mut in_comment = false;
    let mut kept = String::with_capacity(script.len());
    for line in script.lines().map(str::trim) {
        let opens = line.starts_with("/*");
        if !opens && !in_comment && !line.is_empty() && !line.starts_with("//") {
            kept.push_str(line);
            kept.push('\n');
        }
        in_comment = (in_comment || opens) && !line.ends_with("*/");
    }
    kept
}

/// A script that the HTML parser does not end too soon.
fn escaped(script: &str) -> String {
    script.replace("</script", "<\\/script").replace("<!--", "<\\!--")
}

fn deflated(bytes: &[u8]) -> Result<Vec<u8>> {
    let mut deflated = Vec::new();
    zopfli::compress(Options::default(), Format::Deflate, bytes, &mut deflated)?;
    Ok(deflated)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_script_cannot_end_its_element() {
        assert_eq!(escaped("a = '</script>'"), "a = '<\\/script>'");
    }

    #[test]
    fn lines_of_comment_are_left_out_and_others_kept() {
        assert_eq!(without_comments("// a\n  let b = 1; // c\n\n/**\n * d\n */\n/* e */\n}\n"), "let b = 1; // c\n}\n");
    }
}
