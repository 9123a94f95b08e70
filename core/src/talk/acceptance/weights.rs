//! The trained weights, as bytes that `goodbot acts --weights` writes and that every shell reads in place.
//!
//! A word has weights for four kinds of reading, but many words weigh nearly alike: "please" and "kindly", "forget it" and "never mind". So
//! the file has 256 *senses*, each with four weights, and a word has the number of its sense: one byte instead of four.
//!
//! | bytes | |
//! |---|---|
//! | 4 | `acts` |
//! | 2 | the version of this layout |
//! | 2 | the number of clues: weights of other clues mean something else |
//! | 12 | the weight of every reading, the value of a weight of 1 of a clue, and that of a sense: three f32 |
//! | [`CLUES`] | the weight of each clue |
//! | 4 * 256 | the weights of each sense |
//! | 2 * [`GROUPS`] | where the words of each group of blocks begin |
//! | [`BLOCKS`] | how many words each block of 256 hashes has |
//! | n | the place of their hashes in their blocks, as the distance from the one before, which is small and compresses better |
//! | n | their senses |
//! | 4 | the CRC-32 of all before |
//!
//! All numbers are little-endian.

use super::clues::{CLUES, KINDS_OF_WORDS as KINDS};
use crate::checksum::{CHECK_BYTES, Running};
use core::fmt;

/// How many senses words have.
pub const SENSES: usize = 256;
/// Hashes are found by blocks of 256, so that one takes one byte.
pub(super) const BLOCKS: usize = 2048;
/// Where a block begins is counted from the beginning of its group, because counts take half the bytes of such places.
const GROUP: usize = 16;
const GROUPS: usize = BLOCKS / GROUP;

const MAGIC: &[u8; 4] = b"acts";
/// The version of the layout.
const VERSION: u16 = 1;

const VERSION_AT: usize = MAGIC.len();
const CLUES_OF_FILE: usize = VERSION_AT + 2;
const BIAS: usize = CLUES_OF_FILE + 2;
const SCALE: usize = BIAS + 4;
const SCALE_OF_WORDS: usize = SCALE + 4;
const OF_CLUES: usize = SCALE_OF_WORDS + 4;
const OF_SENSES: usize = OF_CLUES + CLUES;
const STARTS: usize = OF_SENSES + KINDS * SENSES;
const COUNTS: usize = STARTS + 2 * GROUPS;
const HASHES: usize = COUNTS + BLOCKS;

/// The trained weights of the acceptance: 37 KB. Those of the library are in [`ClosedWords`](crate::talk::ClosedWords), and
/// [`ClosedWords::weighed`](crate::talk::ClosedWords::weighed) replaces them.
///
/// ```
/// use goodbot::talk::{Weights, WeightsError};
/// assert_eq!(Weights::new(b"acts"), Err(WeightsError::Length { bytes: 4 }));
/// let weights = Weights::new(Weights::BUILT_IN.bytes())?;
/// assert_eq!(weights, Weights::BUILT_IN);
/// # Ok::<(), WeightsError>(())
/// ```
#[derive(Clone, Copy, PartialEq, Eq)]
pub struct Weights<'w>(&'w [u8]);

/// Why bytes are no weights for this version of the library.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum WeightsError {
    /// They do not begin as such a file.
    Foreign,
    /// They are of another version of the library, which has other features. The weights must be trained anew.
    OtherVersion {
        /// Their version, and how many clues they weigh.
        found: [u16; 2],
    },
    /// There are too few of them, or too many.
    Length {
        /// How many there are.
        bytes: usize,
    },
    /// They were damaged.
    Checksum,
}

impl fmt::Display for WeightsError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Foreign => f.write_str("these are no weights that \"goodbot acts --weights\" wrote"),
            Self::OtherVersion { found: [version, clues] } => write!(
                f,
                "these weights are of version {version} and weigh {clues} clues, but this program reads version {VERSION} with {CLUES}: train them again"
            ),
            Self::Length { bytes } => write!(f, "{bytes} bytes are too few or too many for these weights"),
            Self::Checksum => f.write_str("the weights were damaged: their checksum is wrong"),
        }
    }
}

impl core::error::Error for WeightsError {}

impl fmt::Debug for Weights<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "Weights({} words)", self.words())
    }
}

/// The weights of the library.
impl Default for Weights<'_> {
    fn default() -> Self {
        Weights::BUILT_IN
    }
}

impl<'w> Weights<'w> {
    /// The weights of the library.
    pub const BUILT_IN: Weights<'static> = Weights(include_bytes!("weights.acts"));

    /// Reads weights that `goodbot acts --weights` wrote.
    ///
    /// # Errors
    /// A [`WeightsError`] if they are none, or of another version, or damaged.
    pub fn new(bytes: &'w [u8]) -> Result<Self, WeightsError> {
        let weights = Self(bytes);
        if !bytes.starts_with(MAGIC) {
            return Err(WeightsError::Foreign);
        }
        let missing = WeightsError::Length { bytes: bytes.len() };
        let (Some(version), Some(clues)) = (weights.half(VERSION_AT), weights.half(CLUES_OF_FILE)) else { return Err(missing) };
        if (version, usize::from(clues)) != (VERSION, CLUES) {
            return Err(WeightsError::OtherVersion { found: [version, clues] });
        }
        let counts = bytes.get(COUNTS..HASHES).ok_or(missing)?;
        let words: usize = counts.iter().map(|&count| usize::from(count)).sum();
        if bytes.len() != HASHES + 2 * words + CHECK_BYTES {
            return Err(missing);
        }
        let (content, checksum) = bytes.split_at_checked(HASHES + 2 * words).ok_or(missing)?;
        if checksum != checksum_of(content) {
            return Err(WeightsError::Checksum);
        }
        if [BIAS, SCALE, SCALE_OF_WORDS].iter().any(|&at| !weights.float(at).is_finite()) {
            return Err(WeightsError::Foreign);
        }
        // Words are found by these places, so a file with other ones would have words that nobody finds.
        let mut start = 0;
        for (group, counts) in counts.chunks(GROUP).enumerate() {
            if weights.start(group) != start {
                return Err(WeightsError::Checksum);
            }
            start += counts.iter().map(|&count| usize::from(count)).sum::<usize>();
        }
        Ok(weights)
    }

    /// The bytes of the file.
    #[must_use]
    pub const fn bytes(self) -> &'w [u8] {
        self.0
    }

    /// How many words and pairs of words have weights.
    #[must_use]
    pub const fn words(self) -> usize {
        self.0.len().saturating_sub(HASHES + CHECK_BYTES) / 2
    }

    /// The weight of every reading: a part of its log odds.
    pub(super) fn bias(self) -> f32 {
        self.float(BIAS)
    }

    /// The weight of a clue.
    pub(super) fn of_clue(self, clue: u16) -> f32 {
        f32::from(self.signed(OF_CLUES.saturating_add(clue.into()))) * self.float(SCALE)
    }

    /// The value of a weight of 1 of a word.
    pub(super) fn scale_of_words(self) -> f32 {
        self.float(SCALE_OF_WORDS)
    }

    /// The weights of a word for each kind of reading, in units of [`scale_of_words`](Self::scale_of_words); 0 if it has none.
    pub(super) fn of_word(self, hash: u32) -> [i16; KINDS] {
        let (block, place) = (hash as usize / 256, hash as u8);
        let count = |&count: &u8| usize::from(count);
        let group = block / GROUP;
        let before = self.0.get(COUNTS.saturating_add(group * GROUP)..COUNTS.saturating_add(block)).unwrap_or(&[]);
        let begin = HASHES.saturating_add(self.start(group)).saturating_add(before.iter().map(count).sum());
        let end = begin.saturating_add(self.0.get(COUNTS.saturating_add(block)).map_or(0, count));
        let mut at = 0_u8;
        let found = self.0.get(begin..end).and_then(|steps| {
            steps.iter().position(|&step| {
                at = at.saturating_add(step);
                at >= place
            })
        });
        let sense = found.filter(|_| at == place).and_then(|word| self.0.get(begin.saturating_add(word).saturating_add(self.words())));
        sense.map_or([0; KINDS], |&sense| {
            core::array::from_fn(|kind| self.signed(OF_SENSES.saturating_add(usize::from(sense) * KINDS).saturating_add(kind)).into())
        })
    }

    /// The number of words before a group of blocks.
    fn start(self, group: usize) -> usize {
        self.half(STARTS.saturating_add(group.saturating_mul(2))).map_or(0, usize::from)
    }

    fn signed(self, at: usize) -> i8 {
        self.0.get(at).map_or(0, |&byte| byte as i8)
    }

    fn half(self, at: usize) -> Option<u16> {
        self.0.get(at..).and_then(<[u8]>::first_chunk).map(|bytes| u16::from_le_bytes(*bytes))
    }

    fn float(self, at: usize) -> f32 {
        self.0.get(at..).and_then(<[u8]>::first_chunk).map_or(0.0, |bytes| f32::from_le_bytes(*bytes))
    }
}

/// The checksum at the end of a file with this content.
fn checksum_of(content: &[u8]) -> [u8; CHECK_BYTES] {
    let mut running = Running::new();
    running.update(content);
    running.value().to_le_bytes()
}

/// Trained weights before they are a file.
#[derive(Clone, Copy, Debug)]
pub struct Trained<'w> {
    /// The weight of every reading, the value of a weight of 1 of a clue, and that of a sense.
    pub scales: [f32; 3],
    /// The weight of each clue, [`CLUES`] of them.
    pub clues: &'w [i8],
    /// The weights of each sense, for each kind of reading.
    pub senses: &'w [[i8; KINDS]; SENSES],
    /// The words that have weights: their hashes, in ascending order, with their senses; at most 255 in a block of 256, and 65,535 in all.
    /// [`Weights::new`] refuses a file with more.
    pub words: &'w [(u32, u8)],
}

impl Trained<'_> {
    /// Passes the bytes of the file, a few at a time.
    pub fn write(&self, mut take: impl FnMut(&[u8])) {
        let mut running = Running::new();
        let mut put = |bytes: &[u8]| {
            running.update(bytes);
            take(bytes);
        };
        put(MAGIC);
        [VERSION, CLUES as u16].into_iter().for_each(|number| put(&number.to_le_bytes()));
        self.scales.into_iter().for_each(|scale| put(&scale.to_le_bytes()));
        self.clues.iter().chain(self.senses.as_flattened()).for_each(|&weight| put(&[weight as u8]));
        let in_blocks = |end: usize| self.words.partition_point(|&(hash, _)| (hash as usize) < end.saturating_mul(256));
        (0..GROUPS).for_each(|group| put(&(in_blocks(group * GROUP) as u16).to_le_bytes()));
        (0..BLOCKS).for_each(|block| put(&[in_blocks(block + 1).saturating_sub(in_blocks(block)) as u8]));
        let mut before = 0;
        for &(hash, _) in self.words {
            put(&[hash.wrapping_sub(if hash / 256 == before / 256 { before } else { 0 }) as u8]);
            before = hash;
        }
        self.words.iter().for_each(|&(_, sense)| put(&[sense]));
        take(&running.value().to_le_bytes());
    }
}

#[cfg(test)]
mod tests {
    use super::super::words::HASHED;
    use super::*;

    #[test]
    fn each_word_of_the_file_is_found_and_no_other() {
        let weights = Weights::new(Weights::BUILT_IN.bytes()).unwrap();
        let found = (0..HASHED as u32).filter(|&hash| weights.of_word(hash) != [0; KINDS]).count();
        let is_there = |&sense: &&u8| (0..KINDS).any(|kind| weights.signed(OF_SENSES + usize::from(*sense) * KINDS + kind) != 0);
        let senses = &weights.bytes()[HASHES + weights.words()..HASHES + 2 * weights.words()];
        assert!(found > 1_000 && found == senses.iter().filter(is_there).count(), "{found} of {}", weights.words());
    }

    #[test]
    fn a_word_has_the_weights_of_its_sense() {
        let mut senses = [[0; KINDS]; SENSES];
        (senses[3], senses[255]) = ([1, -2, 3, -4], [127, -127, 0, 5]);
        let words = [(7, 3), (8, 255), (256, 3), (HASHED as u32 - 1, 255)];
        let mut file = std::vec::Vec::new();
        let trained = Trained { scales: [0.5, 0.25, 2.0], clues: &[-3; CLUES], senses: &senses, words: &words };
        trained.write(|bytes| file.extend_from_slice(bytes));
        let weights = Weights::new(&file).unwrap();
        assert_eq!(
            (weights.bias(), weights.of_clue(0), weights.of_clue(CLUES as u16 - 1), weights.scale_of_words()),
            (0.5, -0.75, -0.75, 2.0)
        );
        for (hash, sense) in words {
            assert_eq!(weights.of_word(hash), senses[usize::from(sense)].map(i16::from), "{hash}");
        }
        assert_eq!([6, 9, 255, 257].map(|hash| weights.of_word(hash)), [[0; KINDS]; 4]);
    }

    #[test]
    fn damaged_foreign_and_older_weights_are_refused_with_a_reason() {
        let good = Weights::BUILT_IN.bytes();
        let refused = |change: &dyn Fn(&mut std::vec::Vec<u8>)| {
            let mut bytes = good.to_vec();
            change(&mut bytes);
            Weights::new(&bytes).unwrap_err()
        };
        assert_eq!(refused(&|bytes| bytes[0] = b'A'), WeightsError::Foreign);
        assert_eq!(refused(&|bytes| bytes.clear()), WeightsError::Foreign);
        assert_eq!(refused(&|bytes| bytes[VERSION_AT] = 9), WeightsError::OtherVersion { found: [9, CLUES as u16] });
        assert_eq!(refused(&|bytes| bytes.truncate(100)), WeightsError::Length { bytes: 100 });
        assert_eq!(refused(&|bytes| bytes.push(0)), WeightsError::Length { bytes: good.len() + 1 });
        assert_eq!(refused(&|bytes| bytes[OF_CLUES + 9] ^= 1), WeightsError::Checksum);
        let sealed = |bytes: &mut std::vec::Vec<u8>| {
            let end = bytes.len() - CHECK_BYTES;
            let checksum = checksum_of(&bytes[..end]);
            bytes[end..].copy_from_slice(&checksum);
        };
        let changed = |at: usize, value: &[u8]| {
            refused(&|bytes| {
                bytes[at..at + value.len()].copy_from_slice(value);
                sealed(bytes);
            })
        };
        assert_eq!(changed(SCALE, &f32::NAN.to_le_bytes()), WeightsError::Foreign);
        assert_eq!(changed(STARTS + 2, &[0xff, 0xff]), WeightsError::Checksum);
        assert!(std::format!("{}", refused(&|bytes| bytes[VERSION_AT] = 9)).contains("train them again"));
    }
}
