//! Memory together with what lives in it, so that both can be replaced while the page stays open.

use goodbot::home::Home;
use goodbot::{Agent, Capacities, HeapMemory};
use self_cell::{MutBorrow, self_cell};

self_cell! {
    /// A robot's mind in its own memory.
    pub struct Mind {
        owner: MutBorrow<HeapMemory>,
        #[covariant]
        dependent: Agent,
    }
}

self_cell! {
    /// A home in its own memory.
    pub struct Rooms {
        owner: MutBorrow<HeapMemory>,
        #[covariant]
        dependent: Home,
    }
}

/// The robot's mind: all that a host can give it.
pub const MIND: Capacities = Capacities::STANDARD;

/// The most that any of the mind's tables may hold after a model file from elsewhere.
pub const MOST_OF_A_FIELD: usize = 1 << 22;

/// A home alone.
pub const ROOMS: Capacities = Capacities { objects: 32, names: 96, name_bytes: 1_024, cells: 1_024, ..NOTHING };

/// The scout: smaller than the mind, for looking ahead is a courtesy.
pub const SCOUT: Capacities = Capacities { tasks: 64, ground_propositions: 64, goal_entries: 8_192, states: 1 << 18, ..NOTHING };

const NOTHING: Capacities = Capacities {
    objects: 0,
    names: 0,
    name_bytes: 0,
    cells: 0,
    tasks: 0,
    strategies: 0,
    beliefs: 0,
    candidates: 0,
    candidate_tokens: 0,
    ground_propositions: 0,
    goal_entries: 0,
    states: 0,
    hashed_states: 0,
    words: 0,
    word_bytes: 0,
    tokens: 0,
    token_bytes: 0,
    commands: 0,
    command_tokens: 0,
    sessions: 0,
    sentence_words: 0,
    pairs: 0,
    translations: 0,
    alignments: 0,
    length_pairs: 0,
};

/// Memory of these capacities, ready to be lent.
pub fn memory(capacities: &Capacities) -> MutBorrow<HeapMemory> {
    MutBorrow::new(HeapMemory::new(capacities))
}
