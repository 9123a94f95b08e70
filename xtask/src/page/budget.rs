//! How large the page may be, and what it is made of.

use std::io::Write;

use anyhow::{Result, bail};
use flate2::Compression;
use flate2::write::GzEncoder;

use super::Parts;

const MOST_BYTES: usize = 400_000;
const MOST_GZIPPED: usize = 150_000;

/// Says what the page is made of. It is an error if it is too large.
pub fn check(html: &str, parts: &Parts) -> Result<()> {
    let whole = gzipped(html.as_bytes())?;
    println!("dist/goodbot.html: {} bytes (at most {MOST_BYTES}), gzipped {whole} (at most {MOST_GZIPPED})", html.len());
    println!("  the core as WebAssembly: {} bytes, gzipped {}", parts.wasm.len(), gzipped(&parts.wasm)?);
    println!("  its glue:                {} bytes", parts.glue.len());
    if html.len() > MOST_BYTES || whole > MOST_GZIPPED {
        bail!("the page is too large");
    }
    Ok(())
}

fn gzipped(bytes: &[u8]) -> Result<usize> {
    let mut encoder = GzEncoder::new(Vec::new(), Compression::best());
    encoder.write_all(bytes)?;
    Ok(encoder.finish()?.len())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn parts() -> Parts {
        Parts { wasm: Vec::new(), glue: String::new() }
    }

    #[test]
    fn a_page_that_is_too_large_is_refused() {
        assert!(check(&" ".repeat(MOST_BYTES), &parts()).is_ok());
        assert!(check(&" ".repeat(MOST_BYTES + 1), &parts()).is_err());
    }
}
