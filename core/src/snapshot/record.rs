//! The records of a model file, and their limits.
//!
//! A file is a header of [`HEADER_BYTES`], a payload in postcard's encoding, and a CRC-32 of everything before it. All numbers of the header
//! and the CRC are little-endian.

use crate::Capacities;
use crate::capacity::{Capacity, TOKENS_PER_COMMAND, WORDS_PER_COMMAND};
pub use crate::checksum::CHECK_BYTES;
use crate::feedback::{Ending, Hazard, LAGS, RESTS, Strategy};
use crate::language::{Model, Settings};
use crate::session::{Options, Weights};
#[cfg(feature = "learning")]
use crate::symbols::{Symbol, listed};
use crate::task::TokenOrder;
#[cfg(feature = "learning")]
use crate::task::role::is_marker;
use serde::{Deserialize, Serialize};

/// The first bytes of every model file.
pub const MAGIC: [u8; 8] = *b"goodbot\0";
/// The first bytes of a host's record after a model. It names the kinds of task that the model was learned for. A robot is created with its
/// kinds of task, so it skips the record; anything else after a model is refused.
pub const KINDS_MAGIC: [u8; 8] = *b"gbkinds\0";
/// The format of a model without the [layer](crate::language::layer).
pub const VERSION: u16 = 2;
/// The format of a model with the [layer](crate::language::layer): after the records of [`VERSION`] it has the tasks that each session
/// could have meant. Programs without the layer ignore these.
pub const LAYERED_VERSION: u16 = 3;
/// The oldest format that this version reads.
pub const OLDEST_VERSION: u16 = 1;
/// Bytes of the header: the magic, the version (u16) and the length of the whole file (u32).
pub const HEADER_BYTES: usize = 14;
/// The shortest file that has a header and a check.
pub const LEAST_BYTES: usize = HEADER_BYTES + CHECK_BYTES;

/// The tables of training data and parameters. A file states their sizes in this order.
pub const SAVED: [Capacity; 13] = [
    Capacity::Strategies,
    Capacity::Words,
    Capacity::WordBytes,
    Capacity::Tokens,
    Capacity::TokenBytes,
    Capacity::Commands,
    Capacity::CommandTokens,
    Capacity::Sessions,
    Capacity::SentenceWords,
    Capacity::Pairs,
    Capacity::Translations,
    Capacity::Alignments,
    Capacity::LengthPairs,
];

/// The table sizes of the memory that the model was saved from, in the order of [`SAVED`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub(crate) struct Sizes([u32; SAVED.len()]);

impl Sizes {
    pub(crate) fn new(rooms: &Capacities) -> Self {
        Self(SAVED.map(|capacity| u32::try_from(rooms.get(capacity)).unwrap_or(u32::MAX)))
    }

    pub(crate) fn numbers(self) -> impl Iterator<Item = u32> {
        self.0.into_iter()
    }

    /// The capacities; 0 for tables whose size a file does not state.
    pub(crate) fn capacities(self) -> Capacities {
        let mut capacities = Capacities::NONE;
        for (capacity, size) in SAVED.into_iter().zip(self.0) {
            capacities.set(capacity, size as usize);
        }
        capacities
    }
}

/// Room for the options record.
pub(crate) const OPTIONS_BYTES: usize = 80;

/// The [`Options`], field by field. New fields are appended; 0 means the behaviour before the field existed.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub(crate) struct OptionsRecord {
    pub smoothing: f32,
    pub alignment_prior: f32,
    pub rounds: u32,
    pub length: bool,
    pub belief_weights: bool,
    pub least_weight: f32,
    pub word_letters: u8,
    pub by_proposition: bool,
    pub by_roles: bool,
    pub evidence_weights: bool,
    pub drift: f32,
    pub ends_at_goal: f32,
    pub ends_elsewhere: f32,
    pub telling: bool,
    /// At the goal: the probability of an end after a rest and after a later one, and its factors after praise and after blame. All 0 if
    /// the end is equally probable at every moment.
    pub at_goal: [f32; 4],
    /// The same elsewhere.
    pub elsewhere: [f32; 4],
}

impl OptionsRecord {
    pub(crate) fn new(options: &Options) -> Self {
        let Settings { model, smoothing, alignment_prior, rounds, length, word_letters, order, .. } = options.language;
        let (by_roles, evidence_weights) = (model == Model::Roles, options.weights == Weights::Evidence);
        let by_proposition = order == TokenOrder::Propositions;
        let belief_weights = options.weights == Weights::Belief;
        let Options { least_weight, drift, ending: Ending { at_goal, elsewhere }, telling, .. } = *options;
        Self {
            smoothing,
            alignment_prior,
            rounds,
            length,
            word_letters,
            by_proposition,
            belief_weights,
            least_weight,
            by_roles,
            evidence_weights,
            drift,
            ends_at_goal: at_goal.moved,
            ends_elsewhere: elsewhere.moved,
            telling,
            at_goal: numbers(at_goal),
            elsewhere: numbers(elsewhere),
        }
    }

    /// The options of a model without the layer.
    pub(crate) fn options(&self) -> Options {
        let Self { smoothing, alignment_prior, rounds, length, word_letters, least_weight, drift, telling, .. } = *self;
        let model = if self.by_roles { Model::Roles } else { Model::Model2 };
        let order = if self.by_proposition { TokenOrder::Propositions } else { TokenOrder::Attributes };
        let weights = match (self.evidence_weights, self.belief_weights) {
            (true, _) => Weights::Evidence,
            (false, true) => Weights::Belief,
            (false, false) => Weights::Paper,
        };
        let language = Settings {
            model,
            smoothing,
            alignment_prior,
            rounds,
            length,
            word_letters,
            order,
            #[cfg(feature = "layer")]
            layer: false,
        };
        let ending = Ending { at_goal: hazard(self.ends_at_goal, self.at_goal), elsewhere: hazard(self.ends_elsewhere, self.elsewhere) };
        // Not in the file: a restored robot keeps its own.
        Options { language, weights, least_weight, drift, ending, telling, done: 0.0 }
    }

    /// Whether every number is in its range.
    pub(crate) fn is_sound(&self) -> bool {
        self.options().check().is_ok()
    }
}

/// The numbers of a hazard except the first.
fn numbers(Hazard { rested, resting, praised, scolded, .. }: Hazard) -> [f32; 4] {
    [rested, resting, praised, scolded]
}

/// The hazard with these numbers.
fn hazard(moved: f32, other: [f32; 4]) -> Hazard {
    let [rested, resting, praised, scolded] = other;
    if other == [0.0; 4] { Hazard::of(moved) } else { Hazard { moved, rested, resting, praised, scolded } }
}

/// A trainer strategy and its probability.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[doc(hidden)]
pub struct StrategyRecord {
    /// The probability of silence after a correct action.
    pub mu_plus: f32,
    /// The probability of silence after an incorrect action.
    pub mu_minus: f32,
    /// The probability that the trainer takes a correct action for an incorrect one, or the reverse.
    pub epsilon: f32,
    /// The probability of the strategy.
    pub probability: f32,
}

impl StrategyRecord {
    /// The strategy and its probability; `None` if a number is no probability.
    pub fn strategy(&self) -> Option<(Strategy, f32)> {
        let strategy = Strategy::new(self.mu_plus, self.mu_minus, self.epsilon).ok()?;
        (0.0..=1.0).contains(&self.probability).then_some((strategy, self.probability))
    }
}

/// A strategy's lags, and its probability before the trainer was met.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[doc(hidden)]
pub struct TrainerRecord {
    /// The probability that a word is about the last action, and about each of the two before it.
    pub lags: [f32; LAGS],
    /// The probability of the strategy before the trainer was met.
    pub expected: f32,
}

impl TrainerRecord {
    /// Whether the numbers are probabilities.
    pub(crate) fn is_sound(&self) -> bool {
        Strategy::UNUSED.with_lags(self.lags).is_ok() && (0.0..=1.0).contains(&self.expected)
    }
}

/// How a strategy judges rests: see [`Strategy::with_rests`].
#[doc(hidden)]
pub type RestsRecord = [f32; RESTS];

/// A machine command: the positions of its tokens.
#[doc(hidden)]
pub type CommandRecord = heapless::Vec<u16, TOKENS_PER_COMMAND>;

/// Takes bytes from the front.
pub(super) fn chunk<const N: usize>(rest: &mut &[u8]) -> Option<[u8; N]> {
    let (found, after) = rest.split_first_chunk::<N>()?;
    *rest = after;
    Some(*found)
}

/// The tokens of a machine command.
#[cfg(feature = "learning")]
pub(super) fn symbols(record: &CommandRecord) -> heapless::Vec<Symbol, TOKENS_PER_COMMAND> {
    listed(record.iter().map(|&token| Symbol(token)))
}

/// A role's marker, which is the same in all models.
#[cfg(feature = "learning")]
pub(super) fn marker(token: u16) -> Option<Symbol> {
    Some(Symbol(token)).filter(|&symbol| is_marker(symbol))
}

/// A session: the positions of its English words, and the number of its pairs.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[doc(hidden)]
pub struct SessionRecord {
    /// The words.
    pub words: heapless::Vec<u16, WORDS_PER_COMMAND>,
    /// The number of pairs.
    pub pairs: u32,
}

/// A machine command that a session's English command may mean, and its weight.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[doc(hidden)]
pub struct PairRecord {
    /// The position of the machine command.
    pub command: u16,
    /// Its weight.
    pub weight: f32,
}

/// The most bytes of a model saved from memory of these capacities: the size of a buffer or a storage slot. [`usize::MAX`] if the number is
/// larger.
pub const fn most_bytes(capacities: &Capacities) -> usize {
    // A length or number takes 5 bytes at most, a position 3, an f32 4.
    let fixed = LEAST_BYTES + 5 + 5 * SAVED.len() + (5 + OPTIONS_BYTES) + 9 * 5;
    let mut sum = fixed;
    let mut rest: &[(usize, usize)] = &[
        (capacities.strategies, 48),
        (capacities.words, 1),
        (capacities.word_bytes, 1),
        (capacities.tokens, 1),
        (capacities.token_bytes, 1),
        (capacities.commands, 1),
        (capacities.command_tokens, 3),
        (capacities.sessions, 7),
        (capacities.sentence_words, 3),
        (capacities.pairs, 7),
    ];
    while let [(entries, bytes), after @ ..] = rest {
        sum = sum.saturating_add(entries.saturating_mul(*bytes));
        rest = after;
    }
    sum
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_bytes_of_capacities_beyond_all_memory_do_not_run_over() {
        let endless = Capacities { pairs: usize::MAX / 2, command_tokens: usize::MAX, ..Capacities::SMALL };
        assert_eq!(most_bytes(&endless), usize::MAX);
        assert!(most_bytes(&Capacities::STANDARD) < 1 << 20);
    }
}
