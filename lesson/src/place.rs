//! Where a lesson takes place, and how a log tells of it: a home, or another world.

use crate::home;
use goodbot::home::Home;
use goodbot::memory::HomeMemory;
use goodbot::oomdp::{Domain, Either, PushGrid};
use goodbot_formats::environment::EnvironmentFile;
use goodbot_formats::session::RecordedSession;
use std::fmt;

/// Where a lesson takes place.
pub trait Place: Domain<State: fmt::Debug> + fmt::Debug {
    /// How a log tells of the place as it is when a command is said.
    type Record: Clone + fmt::Debug;

    /// A session as a log has it.
    type Recorded;

    /// The place in a state.
    fn record(&self, state: &Self::State) -> Self::Record;

    /// A session that began where `record` tells. `session` has all the rest; its environment is empty.
    fn recorded(&self, record: &Self::Record, session: RecordedSession) -> Self::Recorded;
}

/// How many actions a robot has that only moves.
const MOVES: usize = 4;

/// The names of the actions in a home, where a log must name them: those of a robot that does more than move.
pub(crate) fn named_actions<M: HomeMemory>(home: &Home<M>) -> Option<impl Iterator<Item = &str>> {
    let actions = home.actions();
    (actions.len() > MOVES).then(|| actions.iter().map(|kind| kind.name))
}

impl<M: HomeMemory + fmt::Debug> Place for Home<M> {
    type Record = EnvironmentFile;
    type Recorded = RecordedSession;

    fn record(&self, state: &Self::State) -> EnvironmentFile {
        home::environment(self, state)
    }

    fn recorded(&self, record: &EnvironmentFile, mut session: RecordedSession) -> RecordedSession {
        session.header.environment = record.clone();
        session.header.actions = named_actions(self).map(|names| names.map(str::to_owned).collect());
        session
    }
}

impl<H: Place + PushGrid, W: Place> Place for Either<H, W> {
    type Record = Either<H::Record, W::Record>;
    type Recorded = Either<H::Recorded, W::Recorded>;

    fn record(&self, state: &Self::State) -> Self::Record {
        match (self, state) {
            (Self::Floor(home), Either::Floor(state)) => Either::Floor(home.record(state)),
            (Self::Other(world), Either::Other(state)) => Either::Other(world.record(state)),
            _ => unreachable!("a lesson has one place, and its states"),
        }
    }

    fn recorded(&self, record: &Self::Record, session: RecordedSession) -> Self::Recorded {
        match (self, record) {
            (Self::Floor(home), Either::Floor(record)) => Either::Floor(home.recorded(record, session)),
            (Self::Other(world), Either::Other(record)) => Either::Other(world.recorded(record, session)),
            _ => unreachable!("a lesson has one place, and its records"),
        }
    }
}
