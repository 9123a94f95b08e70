//! Assembles one HTML file from its parts.

use std::path::Path;

use anyhow::{Context, Result, bail};

use crate::pack::packed;

/// The page, and two of its parts.
pub struct Page {
    /// The whole page.
    pub html: String,
    /// The packed parts, as text.
    pub packed: String,
    /// The script that expands it.
    pub script: String,
}

/// The body of the page in `folder`, in lines without indentation.
pub fn body(folder: &Path) -> Result<String> {
    Ok(without_comments(&read(folder, "body.html")?))
}

fn read(folder: &Path, name: &str) -> Result<String> {
    std::fs::read_to_string(folder.join(name)).with_context(|| format!("page/{name} cannot be read"))
}

/// Puts the first script, and the parts packed together, into the `index.html` of `folder`.
pub fn assemble(folder: &Path, parts: &[&[u8]], script: &str) -> Result<Page> {
    let script = escaped(script);
    let packed = packed(&parts.concat())?;
    let mut html = read(folder, "index.html")?;
    let sizes = parts.iter().map(|part| part.len().to_string()).collect::<Vec<_>>().join(" ");
    for (mark, text) in [("/*SIZES*/", &sizes), ("/*SCRIPT*/", &script), ("<!--PACKED-->", &packed)] {
        if html.matches(mark).count() != 1 {
            bail!("page/index.html must have {mark} once");
        }
        html = html.replacen(mark, text, 1);
    }
    Ok(Page { html: without_comments(&html), packed, script })
}

/// A text without indentation, without empty lines and without lines that are only a comment.
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
