//! The module, sorted for packing: like stands beside like, and LZMA packs it a twelfth denser.
//!
//! What instructions do stands in one stream, and the numbers behind them in others, each kind in its own. The sizes of functions are left
//! out, for they follow from the rest. `page/src/module.js` puts the module together again.

use anyhow::{Context, Result, bail, ensure};

/// The section of a module that has its functions.
const CODE: u8 = 10;
/// What begins a block: `block`, `loop` and `if`.
const BLOCKS: std::ops::RangeInclusive<u8> = 2..=4;
const END: u8 = 0x0b;

/// How many parts [`sorted`] makes.
pub const PARTS: usize = 7;

/// The streams of the code, by position.
#[derive(Clone, Copy)]
enum Stream {
    /// What instructions do, and whatever is not below.
    Operations,
    /// Which local variable.
    Locals,
    /// Constants.
    Constants,
    /// Where in memory, from an address on.
    Offsets,
    /// Which function is called.
    Calls,
}

/// A module in parts: what stands before its code, what stands behind it, and the code's streams.
///
/// # Errors
/// Where the module has instructions that are not known here.
pub fn sorted(module: &[u8]) -> Result<[Vec<u8>; PARTS]> {
    let mut reader = Reader { bytes: module, at: 8, streams: Default::default() };
    let mut sides = [module.get(..8).context("the module ends early")?.to_vec(), Vec::new()];
    let mut code_was = false;
    while reader.at < module.len() {
        let from = reader.at;
        let (section, length) = (reader.byte()?, reader.number()?);
        let end = reader.at + length;
        if section == CODE {
            reader.functions().context("the module's code")?;
            ensure!(reader.at == end, "the module's code does not end where it says");
            code_was = true;
        } else {
            sides[usize::from(code_was)].extend(module.get(from..end).context("the module ends early")?);
            reader.at = end;
        }
    }
    let [before, after] = sides;
    let [operations, locals, constants, offsets, calls] = reader.streams;
    Ok([before, after, operations, locals, constants, offsets, calls])
}

struct Reader<'m> {
    bytes: &'m [u8],
    at: usize,
    streams: [Vec<u8>; 5],
}

impl Reader<'_> {
    fn byte(&mut self) -> Result<u8> {
        let byte = *self.bytes.get(self.at).context("the module ends early")?;
        self.at += 1;
        Ok(byte)
    }

    /// Reads a number in as many bytes as it takes.
    fn number(&mut self) -> Result<usize> {
        let (mut value, mut shift) = (0, 0);
        loop {
            let byte = self.byte()?;
            if shift < usize::BITS {
                value |= usize::from(byte & 127) << shift;
            }
            shift += 7;
            if byte < 128 {
                return Ok(value);
            }
        }
    }

    /// Copies so many bytes into a stream.
    fn copy(&mut self, count: usize, stream: Stream) -> Result<()> {
        let bytes = self.bytes.get(self.at..self.at + count).context("the module ends early")?;
        self.streams[stream as usize].extend(bytes);
        self.at += count;
        Ok(())
    }

    /// Copies a number into a stream, and returns it.
    fn copy_number(&mut self, stream: Stream) -> Result<usize> {
        let from = self.at;
        let value = self.number()?;
        let length = self.at - from;
        self.at = from;
        self.copy(length, stream)?;
        Ok(value)
    }

    fn functions(&mut self) -> Result<()> {
        for _ in 0..self.number()? {
            let size = self.number()?;
            let end = self.at + size;
            for _ in 0..self.copy_number(Stream::Operations)? {
                self.copy_number(Stream::Operations)?;
                self.copy(1, Stream::Operations)?;
            }
            let mut depth = 1;
            while depth > 0 {
                let instruction = self.instruction()?;
                depth += i32::from(BLOCKS.contains(&instruction)) - i32::from(instruction == END);
            }
            ensure!(self.at == end, "a function does not end where it says");
        }
        Ok(())
    }

    /// Sorts an instruction, and returns what it begins with.
    fn instruction(&mut self) -> Result<u8> {
        use Stream::{Calls, Constants, Locals, Offsets, Operations};
        let instruction = self.bytes.get(self.at).copied().unwrap_or_default();
        self.copy(1, Operations)?;
        match instruction {
            0x00 | 0x01 | 0x05 | END | 0x0f | 0x1a | 0x1b | 0x45..=0xc4 | 0xd1 => {}
            // Blocks, branches, global variables, tables, the memory's size, references.
            0x02..=0x04 | 0x0c | 0x0d | 0x23..=0x26 | 0x3f | 0x40 | 0xd0 | 0xd2 => drop(self.copy_number(Operations)?),
            // A branch by a table, which has one more entry than it says.
            0x0e => {
                for _ in 0..=self.copy_number(Operations)? {
                    self.copy_number(Operations)?;
                }
            }
            0x10 => drop(self.copy_number(Calls)?),
            0x11 => {
                self.copy_number(Calls)?;
                self.copy_number(Calls)?;
            }
            0x20..=0x22 => drop(self.copy_number(Locals)?),
            // Memory: how it is aligned, and where.
            0x28..=0x3e => {
                self.copy_number(Operations)?;
                self.copy_number(Offsets)?;
            }
            0x41 | 0x42 => drop(self.copy_number(Constants)?),
            0x43 => self.copy(4, Constants)?,
            0x44 => self.copy(8, Constants)?,
            0xfc => {
                let further = match self.copy_number(Operations)? {
                    0..=7 => 0,
                    9 | 11 | 13 | 15..=17 => 1,
                    8 | 10 | 12 | 14 => 2,
                    other => bail!("the instruction 0xfc {other} is not known here; add it, and in page/src/module.js"),
                };
                for _ in 0..further {
                    self.copy_number(Operations)?;
                }
            }
            other => bail!("the instruction {other:#x} is not known here; add it, and in page/src/module.js"),
        }
        Ok(instruction)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A module with one function, after whose section another stands: `(func (result i32) local.get 0 i32.const 300 i32.load offset=8 call 1)`.
    const MODULE: [u8; 33] = [
        0, b'a', b's', b'm', 1, 0, 0, 0, 3, 2, 1, 0, 10, 16, 1, 14, 1, 1, 0x7f, 0x20, 0, 0x41, 0xac, 2, 0x28, 2, 8, 0x10, 1, END, 11, 1, 0,
    ];

    #[test]
    fn the_kinds_of_numbers_stand_apart() {
        let parts = sorted(&MODULE).unwrap();
        let expected: [&[u8]; PARTS] =
            [&MODULE[..12], &[11, 1, 0], &[1, 1, 0x7f, 0x20, 0x41, 0x28, 2, 0x10, END], &[0], &[0xac, 2], &[8], &[1]];
        assert_eq!(parts, expected);
    }

    #[test]
    fn an_instruction_that_is_not_known_is_an_error() {
        let mut module = MODULE;
        module[19] = 0xfe;
        assert!(format!("{:#}", sorted(&module).unwrap_err()).contains("0xfe is not known"));
    }

    #[test]
    fn a_module_that_ends_early_is_an_error() {
        for length in [4, 10, 13, 25, 29] {
            assert!(sorted(&MODULE[..length]).is_err(), "{length}");
        }
    }
}
