//! How large the page may be, and what it is made of.

use std::io::Write;

use anyhow::{Result, bail};
use flate2::Compression;
use flate2::write::GzEncoder;

use super::assemble::Page;

const MOST_BYTES: usize = 500_000;
const MOST_GZIPPED: usize = 220_000;

/// Says what the page is made of. It is an error if it is too large. `unpacked` is how large the module becomes in the browser.
pub fn check(page: &Page, unpacked: usize) -> Result<()> {
    let Page { html, module, script, style } = page;
    let whole = gzipped(html)?;
    println!("dist/goodbot.html: {} bytes (at most {MOST_BYTES}), gzipped {whole} (at most {MOST_GZIPPED})", html.len());
    println!("  the module ({unpacked} bytes), packed: {} bytes, gzipped {}", module.len(), gzipped(module)?);
    println!("  the scripts with the glue: {} bytes, gzipped {}", script.len(), gzipped(script)?);
    println!("  the style: {} bytes, gzipped {}", style.len(), gzipped(style)?);
    if html.len() > MOST_BYTES || whole > MOST_GZIPPED {
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
        Page { html: " ".repeat(bytes), module: String::new(), script: String::new(), style: String::new() }
    }

    #[test]
    fn a_page_that_is_too_large_is_refused() {
        assert!(check(&page(MOST_BYTES), 0).is_ok());
        assert!(check(&page(MOST_BYTES + 1), 0).is_err());
    }
}
