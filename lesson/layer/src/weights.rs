//! The cells of the weights: each feature of a command and a part of a task has a cell, found by a hash. Two features may share one.

use goodbot::probability::{root, square_root};
use goodbot::symbols::Symbol;
use goodbot::task::RoleKind;
use std::ops::Range;

/// Weights of a word together with a kind of task.
const KINDS: Range<usize> = 0..2_048;
/// Weights of the contexts of words that name a value in a role.
const CONTEXTS: Range<usize> = KINDS.end..KINDS.end + 2_048;
/// A constant for each kind of task.
const CONSTANTS: Range<usize> = CONTEXTS.end..CONTEXTS.end + 64;
/// a - 1, with a the exponent of the role model's posterior.
pub const TRUST: usize = CONSTANTS.end;
/// In worlds that are told, and for commands of one or two words: a constant for each value in a role, and a weight of each word together
/// with it.
const WORDS: Range<usize> = TRUST + 1..TRUST + 1 + 16_384;
/// If tasks have ways: weights of contexts for all roles of one kind, and for all roles of a group of kinds.
const KINDS_OF_ROLES: Range<usize> = WORDS.end..WORDS.end + 8_192;
const GROUPS_OF_ROLES: Range<usize> = KINDS_OF_ROLES.end..KINDS_OF_ROLES.end + 2_048;
/// The number of weights.
pub const CELLS: usize = GROUPS_OF_ROLES.end;

/// How strongly each range is pulled towards 0: the stronger, the more sessions it takes to learn a weight.
pub const PULLS: [(Range<usize>, f32); 7] = [
    (KINDS, 10.0),
    (CONTEXTS, 3.0),
    (CONSTANTS, 1.0),
    (TRUST..TRUST + 1, 10.0),
    (WORDS, 10.0),
    (KINDS_OF_ROLES, 3.0),
    (GROUPS_OF_ROLES, 1.0),
];

/// The roles that share a weight.
#[derive(Clone, Copy, Debug)]
pub enum Roles {
    /// Those of one kind, with alternatives or without.
    Kind(RoleKind, bool),
    /// All of the task.
    OfTask,
    /// All others.
    Others,
}

impl Roles {
    const fn code(self) -> u16 {
        match self {
            Self::Kind(kind, has_alternatives) => kind.index() as u16 * 2 + has_alternatives as u16,
            Self::OfTask => 100,
            Self::Others => 102,
        }
    }
}

/// What stands around a word that speaks of a value.
#[derive(Clone, Copy, Debug)]
pub enum Context {
    /// Any context.
    Any,
    /// The word before; `None` at the beginning of the command.
    Before(Option<Symbol>),
    /// The word before [`Before`](Self::Before); `None` at the beginning of the command.
    SecondBefore(Option<Symbol>),
    /// The word after; `None` at the end of the command.
    After(Option<Symbol>),
    /// The number of mentions before it, at most 3.
    Earlier(u16),
    /// The number of mentions after it, at most 3.
    Later(u16),
    /// A word between the mention before and it.
    Since(Symbol),
}

impl Context {
    fn code(self) -> (u16, u16) {
        // No word has the number of the end.
        let end = |word: Option<Symbol>| word.map_or(u16::MAX, number);
        match self {
            Self::Any => (1, 0),
            Self::Before(word) => (2, end(word)),
            Self::SecondBefore(word) => (3, end(word)),
            Self::After(word) => (4, end(word)),
            Self::Earlier(count) => (5, count),
            Self::Later(count) => (6, count),
            Self::Since(word) => (7, number(word)),
        }
    }
}

/// The cell of a word together with a kind of task.
pub fn of_kind_word(form: Symbol, word: Symbol) -> usize {
    cell(KINDS, [number(form), number(word), 0])
}

/// The cell of a value in a role, alone or with any word of the command.
pub fn of_told(role: Symbol, value: Symbol, word: Option<Symbol>) -> usize {
    cell(WORDS, [number(role), number(value), word.map_or(u16::MAX, number)])
}

/// The cell of a context, for all values of a role.
pub fn of_context(role: Symbol, context: Context) -> usize {
    let (kind, about) = context.code();
    cell(CONTEXTS, [number(role), kind, about])
}

/// The cell of a context, for the values of all these roles.
pub fn of_roles(roles: Roles, context: Context) -> usize {
    let range = if matches!(roles, Roles::Kind(..)) { KINDS_OF_ROLES } else { GROUPS_OF_ROLES };
    let (kind, about) = context.code();
    cell(range, [roles.code(), kind, about])
}

/// The cell of a kind of task's constant.
pub fn of_kind(form: Symbol) -> usize {
    cell(CONSTANTS, [number(form), 0, 0])
}

const fn number(symbol: Symbol) -> u16 {
    symbol.index() as u16
}

fn cell(range: Range<usize>, parts: [u16; 3]) -> usize {
    range.start.saturating_add(hashed(range.len(), parts))
}

/// One of `count` numbers, by a hash: the finisher of MurmurHash3, word by word.
pub fn hashed<const PARTS: usize>(count: usize, parts: [u16; PARTS]) -> usize {
    let mut hash = 0x9e37_79b9_u32;
    for part in parts {
        hash = (hash ^ u32::from(part)).wrapping_mul(0x85eb_ca6b);
        hash = (hash ^ (hash >> 13)).wrapping_mul(0xc2b2_ae35);
        hash ^= hash >> 16;
    }
    (hash as usize).checked_rem(count).unwrap_or(0)
}

/// The weights, and the state of their training.
pub struct Weights<'t> {
    pub values: &'t mut [f32],
    /// 1 plus the sum of the squares of all gradients so far.
    pub squares: &'t mut [f32],
    /// The step size.
    pub rate: f32,
}

impl<'t> Weights<'t> {
    /// The two parts of a table of twice [`CELLS`] numbers.
    pub fn of(all: &'t mut [f32], rate: f32) -> Self {
        let (values, squares) = all.split_at_mut_checked(CELLS).unwrap_or((&mut [], &mut []));
        Self { values, squares, rate }
    }

    /// Resets everything to before training.
    pub fn clear(&mut self) {
        self.values.fill(0.0);
        self.squares.fill(1.0);
    }

    /// A weight.
    pub fn value(&self, cell: usize) -> f32 {
        self.values.get(cell).copied().unwrap_or(0.0)
    }

    /// One `AdaGrad` step of a weight against this slope.
    pub fn step(&mut self, cell: usize, slope: f32) {
        if let (Some(value), Some(square)) = (self.values.get_mut(cell), self.squares.get_mut(cell)) {
            *square += slope * slope;
            *value -= self.rate * slope / square_root(*square);
        }
    }

    /// The same for each of these weights. No cell occurs twice. The roots are apart from the tables, where the compiler can compute several
    /// at once.
    pub fn step_each(&mut self, cells: &[u32], mut slopes: Vec<f32>) {
        let rate = self.rate;
        let mut squares: Vec<f32> = cells.iter().map(|&cell| self.squares.get(cell as usize).copied().unwrap_or(1.0)).collect();
        for (square, slope) in squares.iter_mut().zip(&mut slopes) {
            *square += *slope * *slope;
            *slope = rate * *slope / root(*square);
        }
        for (&cell, (square, step)) in cells.iter().zip(squares.iter().zip(&slopes)) {
            if let (Some(value), Some(slot)) = (self.values.get_mut(cell as usize), self.squares.get_mut(cell as usize)) {
                *value -= step;
                *slot = *square;
            }
        }
    }
}
