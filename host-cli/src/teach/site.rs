//! Where a robot is taught: a home, or another world from a file.

use goodbot::home::{Home, HomeState};
use goodbot::memory::HomeHeap;
use goodbot::oomdp::{Action, ActionKind, BitRows, CellId, Domain, Floor, GroundProposition, ObjectId, Piece, PushGrid, StateKey, World};
use goodbot_formats::FormatError;
use goodbot_formats::environment::EnvironmentFile;
use goodbot_formats::session::RecordedSession;
use goodbot_formats::task_text::GroundAtomText;
use goodbot_formats::world::{SessionInWorld, WorldFile};
use goodbot_lesson::place::Place;
use goodbot_lesson::world::robot::Robot;
use std::sync::Arc;

/// The file of a place.
#[derive(Clone, Debug, PartialEq)]
pub enum Setting {
    /// A home.
    Home(EnvironmentFile),
    /// Another world, with a robot.
    World(Arc<WorldFile>),
}

/// A home, or another world.
#[derive(Debug)]
pub enum Site {
    /// A home.
    Home(Home<HomeHeap>),
    /// Another world.
    World(Robot<'static>),
}

/// Where everything is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum SiteState {
    /// In a home.
    Home(HomeState),
    /// In another world: the number of its state.
    World(u64),
}

/// A place as a log tells of it.
#[derive(Clone, Debug, PartialEq)]
pub enum Record {
    /// A home.
    Home(EnvironmentFile),
    /// What holds in another world.
    World(Vec<GroundAtomText>),
}

/// A session as a log has it.
#[derive(Clone, Debug, PartialEq)]
pub enum Recorded {
    /// In a home.
    Home(RecordedSession),
    /// In another world.
    World(SessionInWorld),
}

impl Recorded {
    /// What was said and done.
    pub const fn session(&self) -> &RecordedSession {
        match self {
            Self::Home(session) => session,
            Self::World(recorded) => &recorded.session,
        }
    }

    /// What was said and done, to be changed.
    pub const fn session_mut(&mut self) -> &mut RecordedSession {
        match self {
            Self::Home(session) => session,
            Self::World(recorded) => &mut recorded.session,
        }
    }

    /// The lines of a log.
    ///
    /// # Errors
    /// What could not be read again.
    pub fn to_lines(&self) -> Result<Vec<String>, FormatError> {
        match self {
            Self::Home(session) => session.to_lines(),
            Self::World(recorded) => recorded.to_lines(),
        }
    }
}

impl Site {
    /// The home, if it is one.
    pub const fn home(&self) -> Option<&Home<HomeHeap>> {
        match self {
            Self::Home(home) => Some(home),
            Self::World(_) => None,
        }
    }

    /// The other world, if it is one.
    pub const fn robot(&self) -> Option<&Robot<'static>> {
        match self {
            Self::Home(_) => None,
            Self::World(robot) => Some(robot),
        }
    }
}

impl Domain for Site {
    type State = SiteState;
    // Only a home is a floor with pieces: in another world states are expanded one by one.
    type Search = BitRows;

    fn world(&self) -> World<'_> {
        match self {
            Self::Home(home) => home.world(),
            Self::World(robot) => robot.world(),
        }
    }

    fn actions(&self) -> &[ActionKind<'_>] {
        match self {
            Self::Home(home) => home.actions(),
            Self::World(robot) => robot.actions(),
        }
    }

    fn step(&self, state: &SiteState, action: Action) -> Option<SiteState> {
        match (self, state) {
            (Self::Home(home), SiteState::Home(state)) => home.step(state, action).map(SiteState::Home),
            (Self::World(robot), SiteState::World(state)) => robot.step(state, action).map(SiteState::World),
            _ => None,
        }
    }

    fn holds(&self, proposition: &GroundProposition, state: &SiteState) -> bool {
        match (self, state) {
            (Self::Home(home), SiteState::Home(state)) => home.holds(proposition, state),
            (Self::World(robot), SiteState::World(state)) => robot.holds(proposition, state),
            _ => false,
        }
    }

    fn state_count(&self) -> u64 {
        match self {
            Self::Home(home) => home.state_count(),
            Self::World(robot) => robot.state_count(),
        }
    }

    fn number(&self, state: &SiteState) -> u64 {
        match (self, state) {
            (Self::Home(home), SiteState::Home(state)) => home.number(state),
            (Self::World(robot), SiteState::World(state)) => robot.number(state),
            // A state of another place has no number here.
            _ => u64::MAX,
        }
    }

    fn numbered(&self, number: u64) -> SiteState {
        match self {
            Self::Home(home) => SiteState::Home(home.numbered(number)),
            Self::World(robot) => SiteState::World(robot.numbered(number)),
        }
    }

    fn key(&self, state: &SiteState) -> StateKey {
        match (self, state) {
            (Self::Home(home), SiteState::Home(state)) => home.key(state),
            _ => StateKey::of(self.number(state)),
        }
    }

    fn keyed(&self, key: StateKey) -> SiteState {
        match self {
            Self::Home(home) => SiteState::Home(home.keyed(key)),
            Self::World(robot) => SiteState::World(robot.keyed(key)),
        }
    }

    fn tell_derived(&self, state: &SiteState, object: ObjectId, tell: &mut dyn FnMut(&str)) {
        match (self, state) {
            (Self::Home(home), SiteState::Home(state)) => home.tell_derived(state, object, tell),
            (Self::World(robot), SiteState::World(state)) => robot.tell_derived(state, object, tell),
            _ => {}
        }
    }
}

impl PushGrid for Site {
    fn is_floor(&self) -> bool {
        self.home().is_some_and(Home::is_floor)
    }

    fn is_numbered(&self) -> bool {
        self.home().is_none_or(Home::is_numbered)
    }

    fn floor(&self) -> Floor<'_> {
        self.home().map_or(Floor { cells: &[], directions: [0, 1, 2, 3].map(Action::new) }, Home::floor)
    }

    fn pieces(&self) -> usize {
        self.home().map_or(0, Home::pieces)
    }

    fn cell(&self, state: &SiteState, piece: Piece) -> CellId {
        match (self, state) {
            (Self::Home(home), SiteState::Home(state)) => home.cell(state, piece),
            _ => CellId::NONE,
        }
    }

    fn put(&self, state: &SiteState, piece: Piece, cell: CellId) -> SiteState {
        match (self, state) {
            (Self::Home(home), SiteState::Home(state)) => SiteState::Home(home.put(state, piece, cell)),
            _ => *state,
        }
    }

    fn piece_of(&self, proposition: &GroundProposition) -> Option<Piece> {
        self.home().and_then(|home| home.piece_of(proposition))
    }

    fn can_pull(&self) -> bool {
        self.home().is_some_and(Home::can_pull)
    }

    fn pushes_plainly(&self) -> bool {
        self.home().is_some_and(Home::pushes_plainly)
    }

    fn swaps(&self) -> bool {
        self.home().is_some_and(Home::swaps)
    }
}

impl Place for Site {
    type Record = Record;
    type Recorded = Recorded;

    fn record(&self, state: &SiteState) -> Record {
        match (self, state) {
            (Self::Home(home), SiteState::Home(state)) => Record::Home(home.record(state)),
            (Self::World(robot), SiteState::World(state)) => Record::World(robot.record(state)),
            _ => Record::World(vec![]),
        }
    }

    fn recorded(&self, record: &Record, session: RecordedSession) -> Recorded {
        match (self, record) {
            (Self::World(robot), Record::World(facts)) => Recorded::World(robot.recorded(facts, session)),
            (Self::Home(home), Record::Home(environment)) => Recorded::Home(home.recorded(environment, session)),
            _ => Recorded::Home(session),
        }
    }
}
