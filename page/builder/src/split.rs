//! Splits the module's code by operation: what stands behind each operation gets a part of its own, and so have the operations themselves. Numbers of one
//! kind resemble each other, so that the parts pack a seventh smaller than the code does. `page/src/joined.js` puts them together again.

use anyhow::{Context, Result, bail, ensure};

/// The part of the operations. No operation has the number of one of these three.
const OPERATIONS: usize = 255;
/// The part of what stands before a function's operations: its length and its local variables.
const HEADS: usize = 254;
/// The part of the alignments of memory.
const ALIGNMENTS: usize = 253;

/// A module whose code is split.
pub struct Split {
    /// What stands before the code.
    pub before: Vec<u8>,
    /// The code.
    pub parts: [Vec<u8>; 256],
    /// What stands behind the code.
    pub behind: Vec<u8>,
}

/// Splits a module.
pub fn split(module: &[u8]) -> Result<Split> {
    let mut at = 8;
    loop {
        let kind = *module.get(at).context("the module has no code")?;
        let (length, begin) = number(module, at + 1)?;
        let end = begin + length;
        if kind == 10 {
            let code = module.get(begin..end).context("the module's code ends too soon")?;
            return Ok(Split { before: module[..begin].to_vec(), parts: parts(code)?, behind: module[end..].to_vec() });
        }
        at = end;
    }
}

/// A number, seven bits a byte, the lowest first, and the place behind it.
fn number(code: &[u8], at: usize) -> Result<(usize, usize)> {
    let (mut value, mut end) = (0, at);
    loop {
        let byte = *code.get(end).context("a number ends too soon")?;
        // Only a constant has more than 32 bits, and its value does not matter.
        value |= usize::from(byte & 127).checked_shl((end - at) as u32 * 7).unwrap_or(0);
        end += 1;
        if byte < 128 {
            return Ok((value, end));
        }
    }
}

/// The code that is still to be split, and its parts so far.
struct Splitter<'a> {
    code: &'a [u8],
    at: usize,
    parts: [Vec<u8>; 256],
}

impl Splitter<'_> {
    fn bytes(&mut self, count: usize, part: usize) -> Result<()> {
        let bytes = self.code.get(self.at..self.at + count).context("the code ends too soon")?;
        self.parts[part].extend_from_slice(bytes);
        self.at += count;
        Ok(())
    }

    fn number(&mut self, part: usize) -> Result<usize> {
        let (value, end) = number(self.code, self.at)?;
        self.bytes(end - self.at, part)?;
        Ok(value)
    }
}

fn parts(code: &[u8]) -> Result<[Vec<u8>; 256]> {
    let mut splitter = Splitter { code, at: 0, parts: std::array::from_fn(|_| Vec::new()) };
    for _ in 0..splitter.number(HEADS)? {
        let length = splitter.number(HEADS)?;
        let end = splitter.at + length;
        for _ in 0..splitter.number(HEADS)? {
            splitter.number(HEADS)?;
            splitter.bytes(1, HEADS)?;
        }
        while splitter.at < end {
            let operation = usize::from(*code.get(splitter.at).context("the code ends too soon")?);
            splitter.bytes(1, OPERATIONS)?;
            if (0x28..0x3f).contains(&operation) {
                splitter.number(ALIGNMENTS)?;
            }
            for _ in 0..numbers(operation, &mut splitter)? {
                splitter.number(operation)?;
            }
            if [0x43, 0x44].contains(&operation) {
                splitter.bytes((operation - 0x42) * 4, operation)?;
            }
        }
        ensure!(splitter.at == end, "a function does not end with an operation");
    }
    ensure!(splitter.at == code.len(), "there is more than functions in the code");
    Ok(splitter.parts)
}

/// How many numbers of its own part still follow an operation.
fn numbers(operation: usize, splitter: &mut Splitter<'_>) -> Result<usize> {
    Ok(match operation {
        0x00 | 0x01 | 0x05 | 0x0b | 0x0f | 0x1a | 0x1b | 0x43..=0xc4 | 0xd1 => 0,
        0x02..=0x04 | 0x0c | 0x0d | 0x10 | 0x20..=0x26 | 0x28..=0x42 | 0xd0 | 0xd2 => 1,
        0x11 => 2,
        // A table of jumps has one more, for all others; a choice has the types of its values.
        0x0e => splitter.number(operation)? + 1,
        0x1c => splitter.number(operation)?,
        // Saturating conversions; copies and sizes of memories and tables.
        0xfc => match splitter.number(operation)? {
            0..=7 => 0,
            9 | 11 | 13 | 15..=17 => 1,
            8 | 10 | 12 | 14 => 2,
            other => bail!("page/src/joined.js does not know the operation 0xfc {other}"),
        },
        other => bail!("page/src/joined.js does not know the operation {other:#x}"),
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A module with one function of these operations, and one more byte.
    fn module(operations: &[u8]) -> Vec<u8> {
        let body = [&[1, 2, 0x7f][..], operations].concat();
        let code = [&[1, body.len() as u8][..], &body].concat();
        [&b"\0asm\x01\0\0\0"[..], &[1, 1, 0], &[10, code.len() as u8], &code, &[0]].concat()
    }

    #[test]
    fn each_operation_has_a_part_for_what_follows_it() {
        let split = split(&module(&[0x20, 0, 0x41, 0x80, 1, 0x28, 2, 8, 0x20, 1, 0x0e, 1, 5, 6, 0x0b])).unwrap();
        assert_eq!(split.before, b"\0asm\x01\0\0\0\x01\x01\0\x0a\x14");
        assert_eq!(split.behind, [0]);
        assert_eq!(split.parts[OPERATIONS], [0x20, 0x41, 0x28, 0x20, 0x0e, 0x0b]);
        assert_eq!(split.parts[HEADS], [1, 18, 1, 2, 0x7f]);
        assert_eq!(split.parts[ALIGNMENTS], [2]);
        for (operation, part) in [(0x20, &[0, 1][..]), (0x41, &[0x80, 1]), (0x28, &[8]), (0x0e, &[1, 5, 6]), (0x0b, &[])] {
            assert_eq!(split.parts[operation], part);
        }
    }

    #[test]
    fn an_operation_that_the_page_cannot_join_is_refused() {
        for operations in [&[0xfd, 0, 0x0b][..], &[0xfc, 40, 0x0b], &[0x41]] {
            assert!(split(&module(operations)).is_err());
        }
    }
}
