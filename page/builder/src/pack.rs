//! Packs bytes by LZMA, for `page/src/expand.js`. Browsers expand deflate themselves, but with zopfli's deflate the page is larger.

use std::io::Write;

use anyhow::Result;
use lzma_rust2::{EncodeMode, LzmaOptions, LzmaWriter, MfType};

/// How many bits of the previous byte predict a literal, as in `page/src/expand.js`.
const LC: u32 = 3;

/// An LZMA stream of the bytes, without a header.
pub fn packed(bytes: &[u8]) -> Result<Vec<u8>> {
    let options = LzmaOptions::new(1 << 20, LC, 0, 0, EncodeMode::Normal, 273, MfType::Bt4, 10_000);
    let mut packer = LzmaWriter::new_no_header(Vec::new(), &options, false)?;
    packer.write_all(bytes)?;
    Ok(packer.finish()?)
}
