//! Writing a model in parts, record by record, without memory of its own.

use super::checking::{
    BYTES_PER_CELL, COMMANDS, HEARD_AGAIN, PAIRS, POSSIBLE, POSSIBLE_COMMANDS, POSSIBLE_COUNTS, RESTS, SESSIONS, STRATEGIES, TOKENS,
    TRAINERS, WORDS,
};
use super::error::SaveError;
use super::record::{CHECK_BYTES, HEADER_BYTES, LAYERED_VERSION, MAGIC, OPTIONS_BYTES, OptionsRecord, Sizes, VERSION};
use crate::capacity::Capacities;
use crate::checksum::Running;
use crate::feedback::BeliefRef;
use crate::language::settings::is_weight;
use crate::language::{BitextRef, LanguageRef, Pair};
use crate::probability::Scaled;
use crate::session::Options;
use crate::symbols::Symbol;

/// A model that is being saved in parts: [`Agent::save_on`](crate::Agent::save_on).
#[derive(Clone, Debug)]
pub struct Saving {
    stage: Stage,
    /// Bytes written so far, including those that did not fit into the buffer.
    length: usize,
    running: Running,
    changes: u32,
}

/// The next part to write.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Stage {
    Head,
    /// A section, and the position of its next record.
    Section(u8, usize),
    /// The checksum of the bytes, from this one on.
    Check(usize),
}

impl Saving {
    /// Nothing is written yet.
    pub fn new() -> Self {
        Self { stage: Stage::Head, length: 0, running: Running::new(), changes: 0 }
    }
}

impl Default for Saving {
    fn default() -> Self {
        Self::new()
    }
}

/// The data to save.
pub(super) struct Model<'a> {
    pub vocabulary: u32,
    pub options: &'a Options,
    pub language: LanguageRef<'a>,
    pub strategies: Option<BeliefRef<'a>>,
}

/// The output buffer; bytes that do not fit are only counted.
pub(super) struct Out<'b> {
    pub buffer: &'b mut [u8],
    pub length: usize,
}

impl Out<'_> {
    pub fn bytes(&mut self, bytes: &[u8]) {
        let end = self.length.saturating_add(bytes.len());
        if let Some(room) = self.buffer.get_mut(self.length..end) {
            // Both have this length. `copy_from_slice` would check it and could panic.
            room.iter_mut().zip(bytes).for_each(|(slot, &byte)| *slot = byte);
        }
        self.length = end;
    }

    /// Writes a number or a count: seven bits per byte, the lowest first.
    pub fn number(&mut self, number: u32) {
        let mut left = number;
        while left > 0x7f {
            self.byte((left & 0x7f) as u8 | 0x80);
            left >>= 7;
        }
        self.byte(left as u8);
    }

    fn byte(&mut self, byte: u8) {
        if let Some(slot) = self.buffer.get_mut(self.length) {
            *slot = byte;
        }
        self.length = self.length.saturating_add(1);
    }

    pub fn count(&mut self, count: usize) {
        self.number(count as u32);
    }

    fn real(&mut self, number: f32) {
        self.bytes(&number.to_le_bytes());
    }

    pub fn text(&mut self, text: &str) {
        self.count(text.len());
        self.bytes(text.as_bytes());
    }

    pub fn symbols(&mut self, symbols: &[Symbol]) {
        self.count(symbols.len());
        if self.buffer.is_empty() {
            // Nearly all of the work of a robot that only asks for the size.
            let bytes = symbols.iter().map(|symbol| 1 + usize::from(symbol.0 > 0x7f) + usize::from(symbol.0 > 0x3fff));
            self.length = bytes.fold(self.length, usize::saturating_add);
            return;
        }
        for symbol in symbols {
            self.number(u32::from(symbol.0));
        }
    }

    /// # Errors
    /// [`SaveError::Unsound`] if the weight could not be restored.
    fn pair(&mut self, pair: &Pair) -> Result<(), SaveError> {
        if !is_weight(pair.weight) {
            return Err(SaveError::Unsound);
        }
        self.number(u32::from(pair.command));
        self.real(pair.weight);
        Ok(())
    }
}

impl Model<'_> {
    /// Bytes of the whole file.
    pub fn bytes(&self) -> Result<usize, SaveError> {
        match self.write(&mut []) {
            Err(SaveError::Buffer { needed, .. }) => Ok(needed),
            other => other,
        }
    }

    /// Writes the whole file to the front of the buffer. Returns its length.
    pub fn write(&self, buffer: &mut [u8]) -> Result<usize, SaveError> {
        let mut saving = Saving::new();
        loop {
            if let Some(length) = self.write_on(&mut saving, buffer, u32::MAX)? {
                return Ok(length);
            }
        }
    }

    /// Continues writing, with about `budget` units of work: at least one record.
    pub fn write_on(&self, saving: &mut Saving, buffer: &mut [u8], budget: u32) -> Result<Option<usize>, SaveError> {
        let changes = self.changes();
        if saving.stage == Stage::Head {
            saving.changes = changes;
        }
        if saving.changes != changes {
            return Err(SaveError::Changed);
        }
        let mut left = budget.max(1);
        while left > 0 {
            let work = if let Stage::Check(from) = saving.stage {
                let to = from.saturating_add((left as usize).saturating_mul(BYTES_PER_CELL)).min(saving.length);
                if to == from {
                    return Self::complete(saving, buffer).map(Some);
                }
                saving.running.update(buffer.get(from..to).unwrap_or(&[]));
                saving.stage = Stage::Check(to);
                to.saturating_sub(from).div_ceil(BYTES_PER_CELL)
            } else {
                let before = saving.length;
                let mut out = Out { buffer: &mut *buffer, length: before };
                saving.stage = self.write_part(saving.stage, &mut out)?;
                saving.length = out.length;
                if saving.stage == Stage::Check(0) {
                    self.write_header(saving, buffer)?;
                }
                saving.length.saturating_sub(before)
            };
            left = left.saturating_sub((work as u32).max(1));
        }
        Ok(None)
    }

    /// A number that changes with the saved data, except for the belief about the trainer.
    fn changes(&self) -> u32 {
        let known = self.strategies.map_or(&[][..], BeliefRef::strategies);
        let numbers = known.iter().flat_map(|(strategy, _)| {
            let numbers = [strategy.mu_plus(), strategy.mu_minus(), strategy.epsilon()];
            numbers.into_iter().chain(strategy.lags()).chain(strategy.rests())
        });
        numbers.fold(self.language.bitext().changes(), |sum, number| sum.rotate_left(5).wrapping_add(number.to_bits()))
    }

    /// Writes the header, now that the length is known.
    fn write_header(&self, saving: &Saving, buffer: &mut [u8]) -> Result<(), SaveError> {
        let needed = saving.length.saturating_add(CHECK_BYTES);
        if needed > buffer.len() {
            return Err(SaveError::Buffer { needed, given: buffer.len() });
        }
        let stated = u32::try_from(needed).map_err(|_| SaveError::Unsound)?;
        let mut out = Out { buffer, length: 0 };
        out.bytes(&MAGIC);
        out.bytes(&self.version().to_le_bytes());
        out.bytes(&stated.to_le_bytes());
        Ok(())
    }

    /// Writes the checksum, now that all other bytes are written.
    fn complete(saving: &mut Saving, buffer: &mut [u8]) -> Result<usize, SaveError> {
        let given = buffer.len();
        let mut out = Out { buffer, length: saving.length };
        out.bytes(&saving.running.value().to_le_bytes());
        let needed = out.length;
        *saving = Saving::new();
        if needed > given { Err(SaveError::Buffer { needed, given }) } else { Ok(needed) }
    }

    /// Writes the head, or one record. Returns the next stage.
    fn write_part(&self, stage: Stage, out: &mut Out<'_>) -> Result<Stage, SaveError> {
        Ok(match stage {
            Stage::Head => {
                self.write_head(out)?;
                Stage::Section(STRATEGIES, 0)
            }
            Stage::Section(STRATEGIES, _) => {
                self.write_strategies(out);
                self.after(STRATEGIES)
            }
            Stage::Section(TRAINERS, _) => {
                self.write_trainers(out);
                self.after(RESTS)
            }
            Stage::Section(section, at) => self.write_record(section, at, out)?,
            Stage::Check(from) => Stage::Check(from),
        })
    }

    /// Writes one record of a section, which begins with their number. Returns the next stage.
    fn write_record(&self, section: u8, at: usize, out: &mut Out<'_>) -> Result<Stage, SaveError> {
        let (language, position) = (self.language, at as u16);
        let data = self.possible().filter(|_| section >= POSSIBLE_COMMANDS).unwrap_or(language.bitext());
        let count = match section {
            WORDS => language.learned_words(),
            TOKENS => language.learned_tokens(),
            COMMANDS | POSSIBLE_COMMANDS => data.commands(),
            PAIRS | POSSIBLE => data.pairs().len(),
            _ => data.sessions(),
        };
        if at == 0 {
            out.count(count);
        }
        if at < count {
            match section {
                WORDS => out.text(language.words().text(Symbol(position))),
                TOKENS => out.text(language.tokens().text(Symbol(position))),
                COMMANDS | POSSIBLE_COMMANDS => out.symbols(data.command(position)),
                SESSIONS => {
                    out.symbols(data.sentence(position));
                    out.count(data.pairs_of(position).len());
                }
                HEARD_AGAIN => out.bytes(&[u8::from(data.heard_again(position))]),
                POSSIBLE_COUNTS => out.count(data.pairs_of(position).len()),
                _ => data.pairs().get(at).map_or(Ok(()), |pair| out.pair(pair))?,
            }
        }
        let next = at.saturating_add(1);
        Ok(if next < count { Stage::Section(section, next) } else { self.after(section) })
    }

    /// The stage after a section.
    fn after(&self, section: u8) -> Stage {
        match section {
            POSSIBLE => Stage::Check(0),
            RESTS if self.possible().is_none() => Stage::Check(0),
            section => Stage::Section(section.saturating_add(1), 0),
        }
    }

    #[inline(never)]
    fn write_head(&self, out: &mut Out<'_>) -> Result<(), SaveError> {
        let options = OptionsRecord::new(self.options);
        if !options.is_sound() {
            return Err(SaveError::Unsound);
        }
        let mut bytes = [0; OPTIONS_BYTES];
        let options = postcard::to_slice(&options, &mut bytes).map_err(|_| SaveError::Unsound)?;
        // The header is written last, when the length is known.
        out.bytes(&[0; HEADER_BYTES]);
        out.number(self.vocabulary);
        let strategies = self.strategies.map_or(0, BeliefRef::most_strategies);
        Sizes::new(&Capacities { strategies, ..self.language.rooms() }).numbers().for_each(|size| out.number(size));
        out.count(options.len());
        out.bytes(options);
        Ok(())
    }

    /// Each word of the trainer changes this belief, so all of it is written at once.
    fn write_strategies(&self, out: &mut Out<'_>) {
        let whole = self.strategies.map_or(Scaled::ZERO, BeliefRef::evident_whole);
        let known = self.strategies.map_or(&[][..], BeliefRef::strategies);
        out.count(known.len());
        for (position, &(strategy, before)) in known.iter().enumerate() {
            let probability = self.strategies.map_or(before, |belief| belief.strategy_among(position, whole));
            [strategy.mu_plus(), strategy.mu_minus(), strategy.epsilon(), probability].into_iter().for_each(|number| out.real(number));
        }
    }

    /// Writes each strategy's lags and its probability before the trainer was met, then its responses to rests.
    fn write_trainers(&self, out: &mut Out<'_>) {
        let known = self.strategies.map_or(&[][..], BeliefRef::strategies);
        out.count(known.len());
        for (position, (strategy, _)) in known.iter().enumerate() {
            strategy.lags().into_iter().for_each(|lag| out.real(lag));
            out.real(self.strategies.map_or(0.0, |belief| belief.expected(position)));
        }
        out.count(known.len());
        for (strategy, _) in known {
            strategy.rests().into_iter().for_each(|number| out.real(number));
        }
    }

    /// The tasks of all sessions, if the model has the layer and memory for it. Without that memory it is saved as a role model.
    fn possible(&self) -> Option<BitextRef<'_>> {
        let possible = self.language.possible();
        #[cfg(feature = "layer")]
        let possible = possible.filter(|_| self.options.language.layer);
        possible
    }

    fn version(&self) -> u16 {
        if self.possible().is_some() { LAYERED_VERSION } else { VERSION }
    }
}
