//! The limits of the page's size, and the sizes of its parts.

use std::io::Write;

use anyhow::{Result, bail};
use flate2::Compression;
use flate2::write::GzEncoder;

use super::assemble::Page;

const MOST_BYTES: usize = 410_000;
const MOST_GZIPPED: usize = 330_000;
/// The bytes of panic messages, if a ready-made standard library brings them along.
const PANIC_MESSAGES: usize = 20_000;

/// Prints the sizes of the page and its parts. It is an error if the page is too large. `parts` are the packed parts, by name.
pub fn check(page: &Page, parts: &[(&str, usize)], with_panic_messages: bool) -> Result<()> {
    let most_gzipped = MOST_GZIPPED + if with_panic_messages { PANIC_MESSAGES } else { 0 };
    let Page { html, packed, script } = page;
    let whole = gzipped(html)?;
    println!("dist/goodbot.html: {} bytes (at most {MOST_BYTES}), gzipped {whole} (at most {most_gzipped})", html.len());
    let listed = parts.iter().map(|(name, part)| format!("{name} ({part} bytes)")).collect::<Vec<_>>().join(", ");
    println!("  {listed}; packed together: {} bytes, gzipped {}", packed.len(), gzipped(packed)?);
    println!("  the script that expands them: {} bytes, gzipped {}", script.len(), gzipped(script)?);
    if html.len() > MOST_BYTES || whole > most_gzipped {
        bail!("the page is too large");
    }
    Ok(())
}

fn gzipped(text: &str) -> Result<usize> {
    let mut encoder = GzEncoder::new(Vec::new(), Compression::best());
    encoder.write_all(text.as_bytes())?;
    Ok(encoder.finish()?.len())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn page(bytes: usize) -> Page {
        Page { html: " ".repeat(bytes), packed: String::new(), script: String::new() }
    }

    #[test]
    fn a_page_that_is_too_large_is_refused() {
        assert!(check(&page(MOST_BYTES), &[], false).is_ok());
        assert!(check(&page(MOST_BYTES + 1), &[], true).is_err());
    }
}
