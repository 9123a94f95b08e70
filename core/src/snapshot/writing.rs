//! Writing a model, record by record, without memory of its own.

use super::error::SaveError;
#[cfg(feature = "layer")]
use super::record::LAYERED_VERSION;
use super::record::{
    CHECK_BYTES, HEADER_BYTES, LEAST_BYTES, MAGIC, OPTIONS_BYTES, OptionsRecord, PairRecord, Sizes, StrategyRecord, TrainerRecord, VERSION,
};
use crate::checksum::CHECK;
use crate::feedback::BeliefRef;
#[cfg(feature = "layer")]
use crate::language::BitextRef;
use crate::language::LanguageRef;
use crate::language::settings::is_weight;
use crate::session::Options;
use crate::symbols::Symbol;
use postcard::ser_flavors::Size;
use serde::ser::{Serialize, SerializeStruct, Serializer};

/// The contents of a model file, ready to be written.
pub(super) struct Writing<'a> {
    pub vocabulary: u32,
    pub options: Options,
    pub language: LanguageRef<'a>,
    pub strategies: Option<BeliefRef<'a>>,
    pub sizes: Sizes,
}

/// A sequence whose records are made as they are written.
struct Sequence<F>(F);

impl<T: Serialize, I: Iterator<Item = T>, F: Fn() -> I> Serialize for Sequence<F> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_seq((self.0)())
    }
}

/// A session, with the positions of its words.
struct Session<'a> {
    words: &'a [Symbol],
    pairs: u32,
}

impl Serialize for Session<'_> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let mut record = serializer.serialize_struct("SessionRecord", 2)?;
        record.serialize_field("words", &positions(self.words))?;
        record.serialize_field("pairs", &self.pairs)?;
        record.end()
    }
}

fn positions(symbols: &[Symbol]) -> impl Serialize {
    Sequence(move || symbols.iter().map(|symbol| symbol.0))
}

impl Serialize for Writing<'_> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let (language, bitext) = (self.language, self.language.bitext());
        let mut bytes = [0; OPTIONS_BYTES];
        let options = postcard::to_slice(&OptionsRecord::new(&self.options), &mut bytes).map_err(serde::ser::Error::custom)?;
        let mut payload = serializer.serialize_struct("Payload", 12)?;
        payload.serialize_field("vocabulary", &self.vocabulary)?;
        payload.serialize_field("sizes", &self.sizes)?;
        payload.serialize_field("options", &ByteString(options))?;
        let has_evidence = self.strategies.is_some_and(BeliefRef::has_evidence);
        let strategies = || {
            let known = self.strategies.map_or(&[][..], BeliefRef::strategies);
            known.iter().enumerate().map(|(position, &(strategy, before))| {
                let probability = self.strategies.map_or(before, |belief| belief.carried(position, has_evidence));
                StrategyRecord::new(strategy, probability)
            })
        };
        payload.serialize_field("strategies", &Sequence(strategies))?;
        payload.serialize_field("words", &Sequence(|| language.learned_words()))?;
        payload.serialize_field("tokens", &Sequence(|| language.learned_tokens()))?;
        payload
            .serialize_field("commands", &Sequence(|| (0..bitext.commands()).map(|command| positions(bitext.command(command as u16)))))?;
        let sessions = || {
            (0..bitext.sessions()).map(|session| {
                let pairs = bitext.pairs_of(session as u16).len() as u32;
                Session { words: bitext.sentence(session as u16), pairs }
            })
        };
        payload.serialize_field("sessions", &Sequence(sessions))?;
        let pairs = || bitext.pairs().iter().map(|pair| PairRecord { command: pair.command, weight: pair.weight });
        payload.serialize_field("pairs", &Sequence(pairs))?;
        payload.serialize_field("heard_again", &Sequence(|| (0..bitext.sessions()).map(|session| bitext.heard_again(session as u16))))?;
        let trainers = || {
            let belief = self.strategies;
            let known = belief.map_or(&[][..], BeliefRef::strategies);
            let expected = move |position| belief.map_or(0.0, |belief| belief.expected(position));
            known.iter().enumerate().map(move |(at, (strategy, _))| TrainerRecord { lags: strategy.lags(), expected: expected(at) })
        };
        payload.serialize_field("trainers", &Sequence(trainers))?;
        let rests = || self.strategies.map_or(&[][..], BeliefRef::strategies).iter().map(|(strategy, _)| strategy.rests());
        payload.serialize_field("rests", &Sequence(rests))?;
        #[cfg(feature = "layer")]
        if let Some(possible) = self.possible() {
            let commands = || (0..possible.commands()).map(|command| positions(possible.command(command as u16)));
            payload.serialize_field("possible_commands", &Sequence(commands))?;
            let counts = || (0..possible.sessions()).map(|session| possible.pairs_of(session as u16).len() as u32);
            payload.serialize_field("possible_counts", &Sequence(counts))?;
            let pairs = || possible.pairs().iter().map(|pair| PairRecord { command: pair.command, weight: pair.weight });
            payload.serialize_field("possible", &Sequence(pairs))?;
        }
        payload.end()
    }
}

struct ByteString<'a>(&'a [u8]);

impl Serialize for ByteString<'_> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.serialize_bytes(self.0)
    }
}

impl Writing<'_> {
    /// Bytes of the whole file.
    pub fn bytes(&self) -> Result<usize, SaveError> {
        self.check()?;
        let payload = postcard::serialize_with_flavor(self, Size::default()).map_err(|_| SaveError::Unsound)?;
        Ok(payload.saturating_add(LEAST_BYTES))
    }

    /// The tasks of all sessions, where the model has the layer and memory for it. Without that memory it is a role model.
    #[cfg(feature = "layer")]
    fn possible(&self) -> Option<BitextRef<'_>> {
        self.language.possible().filter(|_| self.options.language.layer)
    }

    #[cfg(feature = "layer")]
    fn version(&self) -> u16 {
        if self.possible().is_some() { LAYERED_VERSION } else { VERSION }
    }

    #[cfg(not(feature = "layer"))]
    #[expect(clippy::unused_self, reason = "as with the feature")]
    const fn version(&self) -> u16 {
        VERSION
    }

    /// Whether everything can be restored again.
    fn check(&self) -> Result<(), SaveError> {
        let sound =
            OptionsRecord::new(&self.options).is_sound() && self.language.bitext().pairs().iter().all(|pair| is_weight(pair.weight));
        if sound { Ok(()) } else { Err(SaveError::Unsound) }
    }

    /// Writes the whole file to the front of the buffer. Gives its length.
    pub fn write(&self, buffer: &mut [u8]) -> Result<usize, SaveError> {
        let needed = self.bytes()?;
        let too_small = SaveError::Buffer { needed, given: buffer.len() };
        let file = buffer.get_mut(..needed).ok_or(too_small)?;
        let stated = u32::try_from(needed).map_err(|_| SaveError::Unsound)?;
        let (checked, check) = file.split_last_chunk_mut::<CHECK_BYTES>().ok_or(too_small)?;
        let (header, payload) = checked.split_first_chunk_mut::<HEADER_BYTES>().ok_or(too_small)?;
        postcard::to_slice(self, payload).map_err(|_| too_small)?;
        let fields = MAGIC.into_iter().chain(self.version().to_le_bytes()).chain(stated.to_le_bytes());
        for (slot, byte) in header.iter_mut().zip(fields) {
            *slot = byte;
        }
        *check = CHECK.checksum(checked).to_le_bytes();
        Ok(needed)
    }
}
