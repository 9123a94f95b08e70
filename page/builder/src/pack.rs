//! Packs bytes as text for a script element: deflate, which browsers expand by themselves, as base64.

use anyhow::Result;
use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use zopfli::{Format, Options, compress};

/// The bytes packed, for `page/src/begin.js`.
pub fn packed(bytes: &[u8]) -> Result<String> {
    let mut packed = Vec::new();
    compress(Options::default(), Format::Deflate, bytes, &mut packed)?;
    Ok(STANDARD.encode(packed))
}
