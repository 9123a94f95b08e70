//! The place of a robot: a home (`Floor`), or another world from a file (`Other`).

use goodbot::home::Home;
use goodbot::memory::HomeHeap;
use goodbot::oomdp::{Domain, Either};
use goodbot_formats::FormatError;
use goodbot_formats::environment::EnvironmentFile;
use goodbot_formats::session::RecordedSession;
use goodbot_formats::world::{SessionInWorld, WorldFile};
use goodbot_lesson::world::robot::Robot;
use std::sync::Arc;

/// The file of a place.
pub type Setting = Either<EnvironmentFile, Arc<WorldFile>>;

/// The place.
pub type Site = Either<Home<HomeHeap>, Robot<'static>>;

/// The state of the place; in a world from a file, a number.
pub type SiteState = <Site as Domain>::State;

/// A session as a log has it.
pub type Recorded = Either<RecordedSession, SessionInWorld>;

/// The session in a record.
pub const fn session(recorded: &Recorded) -> &RecordedSession {
    match recorded {
        Recorded::Floor(session) => session,
        Recorded::Other(recorded) => &recorded.session,
    }
}

/// The session in a record, to be changed.
pub const fn session_mut(recorded: &mut Recorded) -> &mut RecordedSession {
    match recorded {
        Recorded::Floor(session) => session,
        Recorded::Other(recorded) => &mut recorded.session,
    }
}

/// The lines of a log.
///
/// # Errors
/// An error if the session could not be read again.
pub fn lines(recorded: &Recorded) -> Result<Vec<String>, FormatError> {
    match recorded {
        Recorded::Floor(session) => session.to_lines(),
        Recorded::Other(recorded) => recorded.to_lines(),
    }
}
