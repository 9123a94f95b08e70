//! The file for a BBC micro:bit, as Intel HEX: the program, and in the last pages of the flash the robot's home and models.
//!
//! | from | to | contents |
//! |---|---|---|
//! | 0 | [`HOME`] | the program, which `cargo xtask microbit` makes |
//! | [`HOME`] | [`SLOTS`] | a home and commands, a request per line, as on the serial line; erased (0xff): the built-in home |
//! | [`SLOTS`] | [`END`] | two slots with models, as `goodbot::storage` writes them |
//!
//! ```
//! use goodbot_formats::microbit::{MicrobitFile, SLOTS};
//! let mut file = MicrobitFile::of_program([(0, &b"goodbot on the micro:bit; say help"[..])])?;
//! file.put_slots(&[1, 2, 3])?;
//! let read = MicrobitFile::parse(&file.to_text())?;
//! assert_eq!(read.bytes(SLOTS, 4), [1, 2, 3, 0xff]);
//! assert!(MicrobitFile::parse("S0030000FC").is_err());
//! # Ok::<(), goodbot_formats::microbit::MicrobitError>(())
//! ```

use std::collections::BTreeMap;

use ihex::{Reader, Record};

use crate::environment::{EnvironmentFile, ObjectRecord};

/// The address of the home.
pub const HOME: u32 = 0x3_DC00;
/// The address of the models.
pub const SLOTS: u32 = 0x3_E000;
/// The end of the flash.
pub const END: u32 = 0x4_0000;
/// Bytes of one slot.
pub const SLOT_BYTES: u32 = (END - SLOTS) / 2;
/// The longest line that the board reads, in bytes.
pub const MOST_LINE: usize = 64;

/// A text that the program has, and no other program has.
const MARK: &[u8] = b"goodbot on the micro:bit";
/// Bytes of data on one line of the file.
const LINE: usize = 16;
/// The value of erased flash.
const ERASED: u8 = 0xff;

/// Errors of the file and of its parts.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum MicrobitError {
    /// Not Intel HEX.
    #[error("line {line}: this is no Intel HEX ({problem}); name the file goodbot.hex")]
    NotHex {
        /// The line, from 1.
        line: usize,
        /// The fault.
        problem: String,
    },
    /// Intel HEX, but not goodbot's program for the micro:bit.
    #[error("this is not goodbot's program for the micro:bit; `cargo xtask microbit` makes it")]
    NotGoodbot,
    /// The program is too long, or lies outside the flash.
    #[error("the program has bytes at {address:#x}, which is not its part of the flash")]
    Program {
        /// The address that is out of bounds.
        address: u32,
    },
    /// A part with too many bytes.
    #[error("{what} has {bytes} bytes, and the micro:bit has room for {most}")]
    TooLong {
        /// The part.
        what: &'static str,
        /// Its bytes.
        bytes: usize,
        /// The most bytes for it.
        most: usize,
    },
    /// A name, colour or shape that is not one word, as the board's lines need.
    #[error("{0:?} is not one word; use a word without spaces")]
    Name(String),
}

/// The contents of a micro:bit's flash.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct MicrobitFile(BTreeMap<u32, u8>);

impl MicrobitFile {
    /// A file of the program alone: addresses in the flash, with the bytes there.
    ///
    /// # Errors
    /// [`MicrobitError::Program`] and [`MicrobitError::NotGoodbot`].
    pub fn of_program<'p>(parts: impl IntoIterator<Item = (u32, &'p [u8])>) -> Result<Self, MicrobitError> {
        let bytes = parts.into_iter().flat_map(|(address, bytes)| (address..).zip(bytes.iter().copied()));
        let file = Self(bytes.collect());
        if let Some((&address, _)) = file.0.range(HOME..).next() {
            return Err(MicrobitError::Program { address });
        }
        file.checked()
    }

    /// Reads a file: the program, and whatever else it contains.
    ///
    /// # Errors
    /// [`MicrobitError::NotHex`], [`MicrobitError::Program`] and [`MicrobitError::NotGoodbot`].
    pub fn parse(text: &str) -> Result<Self, MicrobitError> {
        let (mut bytes, mut upper, mut ended) = (BTreeMap::new(), 0_u32, false);
        for (number, record) in Reader::new(text).enumerate() {
            let problem = |problem: String| MicrobitError::NotHex { line: number + 1, problem };
            match record.map_err(|error| problem(error.to_string()))? {
                Record::Data { offset, value } => bytes.extend((upper + u32::from(offset)..).zip(value)),
                Record::ExtendedLinearAddress(address) => upper = u32::from(address) << 16,
                Record::ExtendedSegmentAddress(address) => upper = u32::from(address) << 4,
                Record::EndOfFile => ended = true,
                Record::StartLinearAddress(_) | Record::StartSegmentAddress { .. } => {}
            }
        }
        if !ended {
            return Err(MicrobitError::NotHex { line: text.lines().count(), problem: "it does not end as such a file ends".to_owned() });
        }
        if let Some((&address, _)) = bytes.range(END..).next() {
            return Err(MicrobitError::Program { address });
        }
        Self(bytes).checked()
    }

    fn checked(self) -> Result<Self, MicrobitError> {
        let all: Vec<u8> = self.0.values().copied().collect();
        if all.windows(MARK.len()).any(|window| window == MARK) { Ok(self) } else { Err(MicrobitError::NotGoodbot) }
    }

    /// `count` bytes from an address on. Bytes that the file does not have are erased.
    pub fn bytes(&self, from: u32, count: usize) -> Vec<u8> {
        (from..).take(count).map(|at| self.0.get(&at).copied().unwrap_or(ERASED)).collect()
    }

    /// How many bytes of flash the file takes.
    pub fn len(&self) -> usize {
        self.0.len()
    }

    /// Whether the file has no bytes.
    pub fn is_empty(&self) -> bool {
        self.0.is_empty()
    }

    /// Replaces the bytes of the slots.
    ///
    /// # Errors
    /// [`MicrobitError::TooLong`].
    pub fn put_slots(&mut self, slots: &[u8]) -> Result<(), MicrobitError> {
        self.put("the learned model", SLOTS, END, slots)
    }

    /// Replaces the robot's own home and its list of commands, each only if one is given.
    ///
    /// # Errors
    /// [`MicrobitError::Name`] and [`MicrobitError::TooLong`].
    pub fn put_home(&mut self, home: Option<&EnvironmentFile>, commands: &[String]) -> Result<(), MicrobitError> {
        let mut text = String::new();
        for line in home
            .into_iter()
            .flat_map(|home| &home.objects)
            .map(request)
            .chain(commands.iter().map(|command| Ok(format!("say {}", command.trim()))))
        {
            let line = line?;
            if line.len() > MOST_LINE {
                return Err(MicrobitError::TooLong {
                    what: "the longest line of the home or of a command",
                    bytes: line.len(),
                    most: MOST_LINE,
                });
            }
            text += &line;
            text.push('\n');
        }
        self.put("the home", HOME, SLOTS, text.as_bytes())
    }

    fn put(&mut self, what: &'static str, from: u32, to: u32, bytes: &[u8]) -> Result<(), MicrobitError> {
        let most = (to - from) as usize;
        if bytes.len() > most {
            return Err(MicrobitError::TooLong { what, bytes: bytes.len(), most });
        }
        self.0.retain(|at, _| !(from..to).contains(at));
        self.0.extend((from..).zip(bytes.iter().copied()));
        Ok(())
    }

    /// The file as a text, to be dragged onto the board.
    pub fn to_text(&self) -> String {
        let (mut text, mut upper) = (String::new(), None);
        let mut line: (u32, Vec<u8>) = (0, Vec::new());
        let mut add = |record: &Record| text += &(record.to_record_string().unwrap_or_default() + "\n");
        let mut end = |line: &mut (u32, Vec<u8>)| {
            let (at, value) = std::mem::take(line);
            if value.is_empty() {
                return;
            }
            // A data record has only the lower half of its address.
            if upper != Some(at >> 16) {
                upper = Some(at >> 16);
                add(&Record::ExtendedLinearAddress((at >> 16) as u16));
            }
            add(&Record::Data { offset: at as u16, value });
        };
        for (&at, &byte) in &self.0 {
            if at != line.0 + line.1.len() as u32 || line.1.len() == LINE || at.is_multiple_of(1 << 16) {
                end(&mut line);
                line.0 = at;
            }
            line.1.push(byte);
        }
        end(&mut line);
        text += &(Record::EndOfFile.to_record_string().unwrap_or_default() + "\n");
        text
    }
}

/// An object as a request to the board.
fn request(object: &ObjectRecord) -> Result<String, MicrobitError> {
    let words = match object {
        ObjectRecord::Room { name, color, .. } => vec![name, color],
        ObjectRecord::Door { name, .. } | ObjectRecord::Agent { name, .. } => vec![name],
        ObjectRecord::Block { name, color, shape, .. } => vec![name, color, shape],
    };
    if let Some(&word) = words.iter().find(|word| word.is_empty() || word.contains(char::is_whitespace)) {
        return Err(MicrobitError::Name(word.clone()));
    }
    Ok(match object {
        ObjectRecord::Room { name, left, bottom, right, top, color } => format!("room {name} {left} {bottom} {right} {top} {color}"),
        ObjectRecord::Door { name, left, bottom, right, top } => format!("door {name} {left} {bottom} {right} {top}"),
        ObjectRecord::Agent { name, x, y } => format!("agent {name} {x} {y}"),
        ObjectRecord::Block { name, x, y, color, shape } => format!("block {name} {x} {y} {color} {shape}"),
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn program() -> MicrobitFile {
        let filled = [MARK, &[7; 70_000]].concat();
        MicrobitFile::of_program([(0, &filled[..])]).unwrap()
    }

    fn home(text: &str) -> EnvironmentFile {
        EnvironmentFile::parse(&format!("{{\"version\":1,\"objects\":[{text}]}}")).unwrap()
    }

    #[test]
    fn a_file_is_read_as_it_was_written_across_a_border_of_64_kilobytes() {
        let mut file = program();
        file.put_slots(&[9; 100]).unwrap();
        assert_eq!(MicrobitFile::parse(&file.to_text()).unwrap(), file);
        assert!(file.to_text().lines().all(|line| line.len() <= 11 + 2 * LINE));
    }

    #[test]
    fn a_home_is_a_request_a_line_and_takes_the_place_of_another() {
        let mut file = program();
        file.put_slots(&[9; 8]).unwrap();
        let long = home(
            r#"{"class":"room","name":"room0","left":0,"bottom":0,"right":8,"top":4,"color":"red"},{"class":"agent","name":"a","x":1,"y":2}"#,
        );
        file.put_home(Some(&long), &["go there".to_owned()]).unwrap();
        file.put_home(Some(&home(r#"{"class":"block","name":"b","x":-1,"y":2,"color":"red","shape":"chair"}"#)), &[]).unwrap();
        assert_eq!(file.bytes(HOME, 24), b"block b -1 2 red chair\n\xff");
        assert_eq!(file.bytes(SLOTS, 8), [9; 8]);
    }

    #[test]
    fn what_does_not_fit_is_refused_and_changes_nothing() {
        let mut file = program();
        let before = file.clone();
        assert_eq!(
            file.put_slots(&[0; 8_193]).unwrap_err().to_string(),
            "the learned model has 8193 bytes, and the micro:bit has room for 8192"
        );
        let commands: Vec<String> = (0..40).map(|number| format!("go to the room that has the number {number}")).collect();
        assert!(file.put_home(None, &commands).unwrap_err().to_string().contains("room for 1024"));
        assert!(file.put_home(None, &["so ".repeat(30)]).unwrap_err().to_string().contains("room for 64"));
        assert_eq!(file, before);
    }

    #[test]
    fn what_is_no_such_file_is_refused() {
        let whole = program().to_text();
        let other = MicrobitFile::of_program([(0, &b"another program"[..])]);
        assert_eq!(other, Err(MicrobitError::NotGoodbot));
        assert_eq!(MicrobitFile::of_program([(HOME, MARK)]), Err(MicrobitError::Program { address: HOME }));
        for (text, problem) in [("", "does not end"), ("{}", "no Intel HEX"), (&whole[..whole.len() / 2], "no Intel HEX")] {
            let error = MicrobitFile::parse(text).unwrap_err().to_string();
            assert!(error.contains(problem), "{error}");
        }
    }
}
