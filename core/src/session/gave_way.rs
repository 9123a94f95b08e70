//! The sessions that gave way to a new one because memory was full.

use crate::capacity::Capacity;
use crate::language::forgetting::Room;
use core::fmt;

/// The most positions of sessions that gave way that are kept.
const MOST_TOLD: usize = 7;

/// The sessions that gave way to a new one.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct GaveWay {
    count: u16,
    full: Option<Capacity>,
    /// In order of their positions.
    told: [u16; MOST_TOLD],
}

impl GaveWay {
    /// No session gave way.
    pub(super) const NONE: Self = Self { count: 0, full: None, told: [0; MOST_TOLD] };

    /// The number of sessions that gave way.
    pub const fn count(&self) -> usize {
        self.count as usize
    }

    /// Their positions in the training data before the new session came, in order; at most seven are listed.
    pub fn positions(&self) -> &[u16] {
        self.told.get(..self.count().min(MOST_TOLD)).unwrap_or(&[])
    }

    /// The table that was full when the last of them gave way; `None` if none gave way. Raise its capacity to keep more.
    pub const fn full(&self) -> Option<Capacity> {
        self.full
    }

    /// Records a session that gave way.
    pub(super) fn note(&mut self, room: Room) {
        if let Room::Made(session, full) = room {
            self.add(session, full);
        }
    }

    /// Adds a session by its current position, with the table that was full.
    fn add(&mut self, now: u16, full: Capacity) {
        self.full = Some(full);
        let told = self.count().min(MOST_TOLD);
        // The sessions removed before it have shifted its position.
        let before =
            self.positions().iter().fold(now, |position, &gone| if gone <= position { position.saturating_add(1) } else { position });
        let at = self.positions().partition_point(|&gone| gone < before);
        if let Some(later) = self.told.get_mut(at..told.saturating_add(1).min(MOST_TOLD)) {
            let mut moved = before;
            for slot in later {
                core::mem::swap(slot, &mut moved);
            }
        }
        self.count = self.count.saturating_add(1);
    }
}

impl fmt::Display for GaveWay {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.full {
            None => f.write_str("no session gave way"),
            Some(full) => {
                write!(f, "older sessions that gave way: {}, the last because {} is full; raise it to keep them", self.count, full.field())
            }
        }
    }
}
