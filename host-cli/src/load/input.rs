//! Files, and standard input under the name `-`.

use super::Fault;
use std::fs::File;
use std::io::{BufReader, Read};

/// How standard input is called in messages.
const STANDARD_INPUT: &str = "standard input";

/// The name of a file in messages.
pub fn name(file: &str) -> &str {
    if file == "-" { STANDARD_INPUT } else { file }
}

/// Opens a file.
pub fn open(file: &str) -> Result<BufReader<Box<dyn Read>>, Fault> {
    let opened: Box<dyn Read> =
        if file == "-" { Box::new(std::io::stdin()) } else { Box::new(File::open(file).map_err(unreadable(file))?) };
    Ok(BufReader::with_capacity(1 << 16, opened))
}

/// All of a file.
pub fn bytes(file: &str) -> Result<Vec<u8>, Fault> {
    let mut bytes = Vec::new();
    open(file)?.read_to_end(&mut bytes).map_err(unreadable(file))?;
    Ok(bytes)
}

fn unreadable(file: &str) -> impl FnOnce(std::io::Error) -> Fault {
    move |error| Fault::new(name(file), format!("cannot be read ({error}); check its name and that you may read it"))
}
