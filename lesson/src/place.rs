//! The place of a lesson, a home or another world, and its record in a log.

use crate::home;
use goodbot::home::Home;
use goodbot::memory::HomeMemory;
use goodbot::oomdp::{Domain, Either, PushGrid};
use goodbot_formats::environment::EnvironmentFile;
use goodbot_formats::session::RecordedSession;
use std::fmt;

/// The place of a lesson.
pub trait Place: Domain<State: fmt::Debug> + fmt::Debug {
    /// The place at the time of a command, as a log records it.
    type Record: Clone + fmt::Debug;

    /// A session as a log has it.
    type Recorded;

    /// The record of the place in a state.
    fn record(&self, state: &Self::State) -> Self::Record;

    /// A session that began in `record`. `session` has everything else; its environment is empty.
    fn recorded(&self, record: &Self::Record, session: RecordedSession) -> Self::Recorded;
}

/// The number of actions of a robot that only moves.
const MOVES: usize = 4;

/// The names of a home's actions, if a log must name them: if the robot does more than move.
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
