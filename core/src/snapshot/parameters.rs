//! The learned parameters alone, for a robot that only obeys: it neither trains nor keeps sessions.
//!
//! Such a file has the role model's words, machine tokens and parameters, to the bit. The documentation of `snapshot` describes every byte.

#[cfg(feature = "learning")]
use super::error::SaveError;
use super::error::{Part, RestoreError};
use super::record::chunk;
#[cfg(feature = "learning")]
use super::saving::Out;
use crate::capacity::{Capacity, CapacityError, NAME_BYTES};
use crate::checksum::{CHECK_BYTES, Running};
#[cfg(feature = "learning")]
use crate::language::Model;
use crate::language::roles::Layout;
use crate::language::{LanguageRef, Settings};
use crate::memory::AgentMemory;
use crate::session::Agent;
use crate::symbols::Symbol;
use crate::task::role::{Marker, RoleKind};

/// The first bytes of every file of parameters. The last letter is the number of the format.
pub const PARAMETERS_MAGIC: [u8; 8] = *b"gbparam1";

const CELL_BYTES: usize = size_of::<f32>();

impl<M: AgentMemory> Agent<M> {
    /// Saves the role model's parameters to the front of the buffer, for a robot that only obeys: see
    /// [`restore_parameters`](Self::restore_parameters). Returns the length. The training data, the options and the trainer strategies are
    /// not saved.
    ///
    /// # Errors
    /// [`SaveError`]; the buffer may then hold anything. [`SaveError::Buffer`] states the length.
    #[cfg(feature = "learning")]
    pub fn save_parameters(&self, buffer: &mut [u8]) -> Result<usize, SaveError> {
        if self.is_between_models() {
            return Err(SaveError::StillLearning);
        }
        self.language().save_parameters(self.vocabulary(), buffer)
    }

    /// Replaces all that was learned here by the parameters of a file that [`save_parameters`](Self::save_parameters) wrote, in any robot
    /// with the same vocabulary. With the same trainer strategies, both robots then understand commands alike, to the bit. Nothing is
    /// trained. The file has no sessions: a lesson learned here replaces its parameters instead of adding to them. A session under way ends
    /// unlearned.
    ///
    /// ```
    /// use goodbot::{Agent, Options, home};
    /// goodbot::memory! { struct Memory = goodbot::Capacities::TINY; }
    /// let (mut memory, mut other) = (Memory::new(), Memory::new());
    /// let taught = Agent::new(&mut memory.agent, &home::paper_tasks()?, Options::DEFAULT)?;
    /// let mut file = [0; 1_024];
    /// let length = taught.save_parameters(&mut file)?;
    /// let mut obeying = Agent::new(&mut other.agent, &home::paper_tasks()?, Options::DEFAULT)?;
    /// obeying.restore_parameters(&file[..length])?;
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// [`RestoreError`]; the agent is then unchanged.
    pub fn restore_parameters(&mut self, bytes: &[u8]) -> Result<(), RestoreError> {
        let found = Parameters::read(bytes)?;
        if found.vocabulary != 0 && found.vocabulary != self.vocabulary() {
            return Err(RestoreError::OtherDomain);
        }
        found.check_room(self.language())?;
        self.end_session();
        self.workspace_to_training();
        let settings = Settings { word_letters: found.word_letters, ..Settings::DEFAULT };
        self.options.language = settings;
        self.language_mut().take_over(settings, (each(found.words), each(found.tokens)), found.layout, found.cells());
        Ok(())
    }

    /// The digest of the lifted tasks' vocabulary; 0 for an agent without tasks.
    pub fn vocabulary(&self) -> u32 {
        self.lifted().first().map_or(0, |task| task.vocabulary())
    }
}

#[cfg(feature = "learning")]
impl LanguageRef<'_> {
    /// Saves the parameters as [`Agent::save_parameters`] does, for robots with a vocabulary of this digest.
    ///
    /// # Errors
    /// [`SaveError`]; the buffer may then hold anything. [`SaveError::Buffer`] states the length.
    pub fn save_parameters(self, vocabulary: u32, buffer: &mut [u8]) -> Result<usize, SaveError> {
        if self.is_training() {
            return Err(SaveError::StillLearning);
        }
        if self.model() != Model::Roles {
            return Err(SaveError::NoRoles);
        }
        let given = buffer.len();
        let mut out = Out { buffer, length: 0 };
        write(&mut out, vocabulary, self);
        let (all, needed) = (out.length, out.length.saturating_add(CHECK_BYTES));
        if needed > given {
            return Err(SaveError::Buffer { needed, given });
        }
        let mut check = Running::new();
        check.update(out.buffer.get(..all).unwrap_or(&[]));
        out.bytes(&check.value().to_le_bytes());
        Ok(needed)
    }
}

/// Writes everything except the check.
#[cfg(feature = "learning")]
fn write(out: &mut Out<'_>, vocabulary: u32, language: LanguageRef<'_>) {
    let (tables, layout) = (language.tables(), language.tables().layout());
    let (forms, roles) = (layout.forms(), layout.roles());
    let (translations, alignments) = tables.cells();
    let translations = translations.get(..layout.translations()).unwrap_or(&[]);
    out.bytes(&PARAMETERS_MAGIC);
    out.bytes(&vocabulary.to_le_bytes());
    out.bytes(&layout.sessions().to_le_bytes());
    out.bytes(&[language.settings().word_letters, forms.len() as u8, roles.len() as u8]);
    for count in [layout.words(), layout.tokens()] {
        out.bytes(&(count as u16).to_le_bytes());
    }
    let roles = roles.iter().map(|&role| Marker { role, sort: 0 }.symbol());
    forms.iter().copied().chain(roles).for_each(|symbol| out.bytes(&symbol.0.to_le_bytes()));
    for (texts, count) in [(language.words(), layout.words()), (language.tokens(), layout.tokens())] {
        for text in texts.iter().take(count).map(|(_, text)| text) {
            out.bytes(&[text.len() as u8]);
            out.bytes(text.as_bytes());
        }
    }
    let cells = translations.iter().chain(alignments.iter().take(layout.trellis_start())).take(cells(layout));
    cells.for_each(|cell| out.bytes(&cell.to_le_bytes()));
}

/// Checks that the bytes are a file of parameters.
pub(super) fn check(bytes: &[u8]) -> Result<(), RestoreError> {
    Parameters::read(bytes).map(drop)
}

/// The number of cells after the texts. A model that has learned nothing has none.
fn cells(layout: &Layout) -> usize {
    if layout.words() == 0 { 0 } else { layout.translations().saturating_add(layout.trellis_start()) }
}

/// A checked file of parameters.
struct Parameters<'a> {
    vocabulary: u32,
    word_letters: u8,
    layout: Layout,
    /// Texts, each preceded by its length.
    words: &'a [u8],
    tokens: &'a [u8],
    cells: &'a [u8],
}

impl<'a> Parameters<'a> {
    fn read(bytes: &'a [u8]) -> Result<Self, RestoreError> {
        let (all, stated) = bytes.split_last_chunk::<CHECK_BYTES>().ok_or(RestoreError::NoParameters)?;
        let rest = all.strip_prefix(&PARAMETERS_MAGIC).ok_or(RestoreError::NoParameters)?;
        let mut check = Running::new();
        check.update(all);
        if check.value() != u32::from_le_bytes(*stated) {
            return Err(RestoreError::Damaged);
        }
        let found = Self::of(rest).ok_or(RestoreError::Inconsistent(Part::Parameters))?;
        // With ways there are more kinds of role.
        if found.layout.roles().iter().any(|role| role.kind().index() >= RoleKind::COUNT) {
            return Err(RestoreError::Ways);
        }
        let is_sound = found.cells.len() == cells(&found.layout).saturating_mul(CELL_BYTES) && found.cells().all(f32::is_finite);
        if is_sound { Ok(found) } else { Err(RestoreError::Inconsistent(Part::Parameters)) }
    }

    fn of(mut rest: &'a [u8]) -> Option<Self> {
        let vocabulary = u32::from_le_bytes(chunk(&mut rest)?);
        let sessions = f32::from_le_bytes(chunk(&mut rest)?);
        let [word_letters, forms, roles] = chunk(&mut rest)?;
        let [words, tokens] = [short(&mut rest)?, short(&mut rest)?];
        let counts = [usize::from(forms), usize::from(roles)];
        let (symbols, mut rest) = rest.split_at_checked(counts.iter().sum::<usize>().saturating_mul(size_of::<Symbol>()))?;
        let symbols = symbols.as_chunks().0.iter().map(|symbol| Symbol(u16::from_le_bytes(*symbol)));
        let [of_forms, _] = counts;
        let roles = symbols.clone().skip(of_forms).filter_map(Marker::of).map(|marker| marker.role);
        let forms = symbols.take(of_forms).filter(|form| form.0 < tokens);
        let layout = Layout::of_others(words.into(), tokens.into(), sessions, forms, roles);
        // None is missing: none was unknown, repeated or too many.
        let is_whole = [layout.forms().len(), layout.roles().len()] == counts && sessions.is_finite();
        let [words, tokens] = [texts(&mut rest, words)?, texts(&mut rest, tokens)?];
        is_whole.then_some(Self { vocabulary, word_letters, layout, words, tokens, cells: rest })
    }

    fn cells(&self) -> impl Iterator<Item = f32> {
        let (cells, _) = self.cells.as_chunks::<CELL_BYTES>();
        cells.iter().map(|cell| f32::from_le_bytes(*cell))
    }

    /// Checks that the tables have room. A command that is read in parts keeps its state after the parameters.
    fn check_room(&self, language: LanguageRef<'_>) -> Result<(), CapacityError> {
        let layout = &self.layout;
        let ((words, word_bytes), (tokens, token_bytes)) = (language.words().room(), language.tokens().room());
        let (translations, alignments) = language.tables().cells();
        let needs = [
            (Capacity::Words, words, layout.words()),
            (Capacity::WordBytes, word_bytes, self.words.len().saturating_sub(layout.words())),
            (Capacity::Tokens, tokens, layout.tokens()),
            (Capacity::TokenBytes, token_bytes, self.tokens.len().saturating_sub(layout.tokens())),
            (Capacity::Translations, translations.len(), layout.translations()),
            (Capacity::Alignments, alignments.len(), layout.trellis_start().saturating_add(layout.memories())),
        ];
        let full = needs.into_iter().find(|&(_, room, need)| need > room);
        full.map_or(Ok(()), |(capacity, room, need)| Err(CapacityError::new(capacity, room, need)))
    }
}

fn short(rest: &mut &[u8]) -> Option<u16> {
    chunk(rest).map(u16::from_le_bytes)
}

fn text<'a>(rest: &mut &'a [u8]) -> Option<&'a str> {
    let [length] = chunk(rest)?;
    let (found, after) = rest.split_at_checked(usize::from(length))?;
    *rest = after;
    core::str::from_utf8(found).ok()
}

/// Reads `count` texts, each short enough to be kept.
fn texts<'a>(rest: &mut &'a [u8], count: u16) -> Option<&'a [u8]> {
    let all = *rest;
    for _ in 0..count {
        text(rest).filter(|text| text.len() <= NAME_BYTES)?;
    }
    all.get(..all.len().saturating_sub(rest.len()))
}

fn each(mut texts: &[u8]) -> impl Iterator<Item = &str> {
    core::iter::from_fn(move || text(&mut texts))
}
