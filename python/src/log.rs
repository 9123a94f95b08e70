//! Recorded sessions: read, written, and replayed.

use crate::agent::{Agent, feedback_of};
use crate::error::{self, format, value};
use crate::home::{Home, Rooms};
use crate::mind::{Mind, PART, warn};
use crate::options::{Items, array};
use crate::world::World;
use goodbot::Capacities;
use goodbot::home::{HomeState, Moves};
use goodbot::oomdp::Domain;
use goodbot_console::load::input::Content;
use goodbot_formats::FormatError;
use goodbot_formats::environment::EnvironmentFile;
use goodbot_formats::session::{FeedbackWord, Kind, RecordedSession, SessionHeader, SessionReader, StepRecord};
use goodbot_formats::task_text::{GroundAtomText, GroundTaskText};
use goodbot_formats::world::{Line, SessionInWorld, WorldReader};
use goodbot_lesson::checked::{CheckedSession, check_steps, moves};
use goodbot_lesson::place::word;
use goodbot_lesson::replay::{Event, Replay, Rules};
use goodbot_lesson::world as in_world;
use goodbot_lesson::world::robot::Tables;
use goodbot_lesson::{Fault, home};
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyString};
use std::sync::Arc;

/// A recorded session: a command in a home or a world, and the actions and feedback that followed.
///
/// `steps` are pairs of an action and its feedback, which is None in a `demonstration`. A session that could not be read again is
/// refused with `FormatError`.
///
/// >>> home = goodbot.Home.random(1, "A")
/// >>> session = goodbot.Session("go there", home, [("north", "reward"), ("noop", "neutral")])
/// >>> agent = goodbot.Agent()
/// >>> len(session.teach(agent)), agent.sessions
/// (2, 1)
#[pyclass(frozen, eq, module = "goodbot")]
#[derive(Clone, Debug)]
pub struct Session {
    recorded: RecordedSession,
    /// The world, and the propositions that held when the command was said; `None` in a home.
    place: Option<(Arc<Tables>, Vec<GroundAtomText>)>,
}

/// Sessions are equal if a log says the same of them, on whichever lines.
impl PartialEq for Session {
    fn eq(&self, other: &Self) -> bool {
        matches!((self.written(), other.written()), (Ok(one), Ok(two)) if one == two)
    }
}

/// For pickle: the function that makes a session again, and its lines.
type Reduced<'py> = (Bound<'py, PyAny>, (Vec<String>,));

/// The kinds of sessions, by name.
const KINDS: [(&str, Kind); 3] = [("feedback", Kind::Feedback), ("demonstration", Kind::Demonstration), ("labelled", Kind::Labelled)];

fn kind_of(name: &str) -> PyResult<Kind> {
    let kind = KINDS.into_iter().find(|(known, _)| *known == name);
    kind.map(|(_, kind)| kind).ok_or_else(|| value(format!("{name:?} is no kind of session; give feedback, demonstration or labelled")))
}

fn step_of(action: String, feedback: Option<&str>) -> PyResult<(usize, StepRecord)> {
    let feedback = feedback.map(|name| feedback_of(Some(name))).transpose()?;
    Ok((0, StepRecord::new(action, feedback.map(word))))
}

/// The header of a session of feedback that begins in this state of a home.
pub fn header(rooms: &Rooms, state: &HomeState, command: &str) -> SessionHeader {
    let names = || rooms.actions().iter().map(|kind| kind.name.to_owned()).collect();
    let actions = (rooms.moves() == Moves::PushAndPull).then(names);
    SessionHeader { actions, ..SessionHeader::new(Kind::Feedback, home::environment(rooms, state), command.to_owned()) }
}

/// The header of a session of feedback in a world.
pub fn header_in_world(command: &str) -> SessionHeader {
    SessionHeader::new(Kind::Feedback, EnvironmentFile::new(vec![]), command.to_owned())
}

/// The sessions of a log, as bytes of JSON Lines.
#[pyfunction]
#[pyo3(signature = (text, *, file=None))]
pub fn parse_log(py: Python<'_>, text: &[u8], file: Option<String>) -> PyResult<Vec<Session>> {
    if Content::of(text) == Content::Worlds {
        return parse_log_of_worlds(py, text, file);
    }
    let mut sessions = Vec::new();
    for session in SessionReader::new(text) {
        sessions.push(Session::in_home(session.map_err(|error| format_in(py, error, file.as_deref()))?));
        if sessions.len().is_multiple_of(256) {
            py.check_signals()?;
        }
    }
    Ok(sessions)
}

/// An error of a log, with the file's name if there is one.
fn format_in(py: Python<'_>, error: FormatError, file: Option<&str>) -> PyErr {
    format(py, &file.into_iter().fold(error, FormatError::with_file))
}

/// The sessions of a log of worlds.
fn parse_log_of_worlds(py: Python<'_>, text: &[u8], file: Option<String>) -> PyResult<Vec<Session>> {
    let mut sessions: Vec<Session> = Vec::new();
    for line in WorldReader::new(text) {
        let line = line.map_err(|error| format_in(py, error, file.as_deref()))?;
        let SessionInWorld { world, facts, session } = match line {
            Line::World(_) => continue,
            Line::Session(session) => *session,
            Line::Command(command) => {
                let told = "a command of a log of worlds has no steps, so it is no session; evaluate and learn take such a log";
                return Err(value(format!("{}line {}: {told}", file.map_or_else(String::new, |file| format!("{file}: ")), command.line)));
            }
        };
        // Sessions in one world share its tables.
        let known =
            sessions.iter().rev().filter_map(|session| session.place.as_ref()).find(|(tables, _)| Arc::ptr_eq(tables.file(), &world));
        let tables = known.map_or_else(|| Tables::of(world).map(Arc::new).map_err(value), |(tables, _)| Ok(tables.clone()))?;
        sessions.push(Session { recorded: session, place: Some((tables, facts)) });
        if sessions.len().is_multiple_of(256) {
            py.check_signals()?;
        }
    }
    Ok(sessions)
}

impl Session {
    pub const fn in_home(recorded: RecordedSession) -> Self {
        Self { recorded, place: None }
    }

    pub const fn in_world(recorded: RecordedSession, tables: Arc<Tables>, facts: Vec<GroundAtomText>) -> Self {
        Self { recorded, place: Some((tables, facts)) }
    }

    /// The record of a session in a world.
    fn record_in_world(&self) -> Option<SessionInWorld> {
        let (tables, facts) = self.place.as_ref()?;
        Some(SessionInWorld { world: tables.file().clone(), facts: facts.clone(), session: self.recorded.clone() })
    }

    /// The lines of a log; in a world, its own line is the first.
    fn written(&self) -> Result<Vec<String>, FormatError> {
        match self.record_in_world() {
            None => self.recorded.to_lines(),
            Some(session) => Ok([vec![session.world.to_json_line()?], session.to_lines()?].concat()),
        }
    }

    fn home(&self, py: Python<'_>) -> PyResult<Home> {
        if self.place.is_some() {
            return Err(value("this session is in a world, not in a home; see its world and state"));
        }
        let moves = moves(self.recorded.header.action_names());
        let moves =
            moves.ok_or_else(|| value("a home has the actions north, south, east and west, and may have pull; this session has others"))?;
        Home::of(py, &self.recorded.header.environment, moves, &Capacities::STANDARD, "")
    }

    fn replay(&self, py: Python<'_>, mind: &mut Mind, learn: bool) -> PyResult<Replayed> {
        let faults = |faults: Vec<Fault>| value(told(&faults));
        match (self.record_in_world(), &self.place) {
            (Some(session), Some((tables, _))) => tables.lend(|robot| {
                let checked = in_world::check_steps("", &session, *robot, mind.core.lifted()).map_err(faults)?;
                Self::replay_checked(py, mind, &checked, learn)
            }),
            _ => {
                let checked = check_steps("", &self.recorded, mind.core.lifted(), home::memory()).map_err(faults)?;
                Self::replay_checked(py, mind, &checked, learn)
            }
        }
    }

    fn replay_checked<D>(py: Python<'_>, mind: &mut Mind, session: &CheckedSession<D>, learn: bool) -> PyResult<Replayed>
    where
        D: Domain<State: Send + Sync> + Sync,
    {
        session.long.map_or(Ok(()), |long| warn(py, long))?;
        let mut replay = Replay::new(Rules::AS_IT_WAS);
        let mut replayed = Replayed { evidence: vec![], beliefs: vec![] };
        loop {
            let event = py.detach(|| replay.advance(&mut mind.core, &session.walk, PART));
            match event.map_err(|refused| error::agent(py, refused.error))? {
                Event::Ended => break,
                Event::Working => py.check_signals()?,
                Event::Heard => {
                    mind.heard(py, session);
                    replayed.beliefs.push(mind.beliefs());
                }
                Event::Took(_, came) => {
                    replayed.evidence.push(came.name());
                    replayed.beliefs.push(mind.beliefs());
                }
                Event::Answered(_) | Event::Planned(_) | Event::Closed(_) => {}
            }
        }
        // Answers after the last step, and the end of a session, are evidence too.
        if let Some(last) = replayed.beliefs.last_mut() {
            *last = mind.beliefs();
        }
        if learn {
            mind.finish_in(py, &session.walk.home)?;
            mind.learn(py)?;
        } else {
            mind.core.forget();
        }
        Ok(replayed)
    }
}

/// The result of a replayed session.
struct Replayed {
    /// The effect of each step.
    evidence: Vec<&'static str>,
    /// How probable each task was: before the first step, and after each.
    beliefs: Vec<Vec<f32>>,
}

/// The faults of a session, one on each line.
fn told(faults: &[Fault]) -> String {
    let one = |fault: &Fault| fault.field.as_ref().map_or_else(|| fault.message.clone(), |field| format!("{field}: {}", fault.message));
    faults.iter().map(one).collect::<Vec<_>>().join("\n")
}

#[pymethods]
impl Session {
    #[new]
    #[pyo3(signature = (command, home, steps, *, state=None, kind="feedback", learn=true, id=None, intended=None, continues=false))]
    #[expect(clippy::too_many_arguments, reason = "Python's arguments have names")]
    fn new(
        py: Python<'_>,
        command: String,
        home: &Bound<'_, PyAny>,
        steps: Items<(String, Option<String>)>,
        state: Option<&Bound<'_, PyAny>>,
        kind: &str,
        learn: bool,
        id: Option<String>,
        intended: Option<&str>,
        continues: bool,
    ) -> PyResult<Self> {
        let (header, place) = if let Ok(world) = home.cast::<World>() {
            let world = world.get();
            let at = state.map_or(Ok(world.0.start()), |state| world.check(state))?;
            (header_in_world(&command), Some((world.0.clone(), world.0.lend(|robot| robot.facts(at)))))
        } else {
            let home = home.cast::<Home>()?.get();
            let at = state.map_or(Ok(home.start), |state| home.check(state))?;
            (header(&home.rooms, &at, &command), None)
        };
        let mut header = SessionHeader { id, kind: kind_of(kind)?, continues, ..header };
        header.set_meant(intended.map(|text| text.parse::<GroundTaskText>().map_err(value)).transpose()?.as_ref());
        if place.is_some() && (continues || header.before.is_some() || header.through.is_some() || header.avoiding.is_some()) {
            return Err(value("commands that continue, and paths, belong to homes alone; leave them out in a world"));
        }
        let steps = steps.0.into_iter().map(|(action, feedback)| step_of(action, feedback.as_deref())).collect::<PyResult<_>>()?;
        let session = Self { recorded: RecordedSession { header, header_line: 1, steps, answers: vec![], learn, end_line: 1 }, place };
        session.lines(py)?;
        Ok(session)
    }

    /// The session's name, or None.
    #[getter]
    fn id(&self) -> Option<&str> {
        self.recorded.header.id.as_deref()
    }

    /// The command.
    #[getter]
    fn command(&self) -> &str {
        &self.recorded.header.command
    }

    /// `feedback`, `demonstration` or `labelled`.
    #[getter]
    fn kind(&self) -> &'static str {
        KINDS.into_iter().find(|(_, known)| *known == self.recorded.header.kind).map_or("", |(name, _)| name)
    }

    /// Whether it is to be learned from.
    #[getter]
    const fn learn(&self) -> bool {
        self.recorded.learn
    }

    /// Whether it is the previous command once more.
    #[getter]
    const fn continues(&self) -> bool {
        self.recorded.header.continues
    }

    /// The task that was meant, or None. For evaluation only; in a `labelled` session it is the lesson.
    #[getter]
    fn intended(&self) -> Option<String> {
        Some(self.recorded.header.meant()?.ok()?.to_string())
    }

    /// The actions and their feedback, in order.
    #[getter]
    fn steps(&self) -> Vec<(&str, Option<&'static str>)> {
        self.recorded.steps.iter().map(|(_, step)| (step.action.as_str(), step.feedback.map(FeedbackWord::as_str))).collect()
    }

    /// The world, or None in a home.
    #[getter]
    fn world(&self) -> Option<World> {
        self.place.as_ref().map(|(tables, _)| World(tables.clone()))
    }

    /// The first state, in its home or world.
    #[getter]
    fn state(&self, py: Python<'_>) -> PyResult<Py<PyAny>> {
        match &self.place {
            None => {
                let home = self.home(py)?;
                Ok(home.state(home.start).into_pyobject(py)?.into_any().unbind())
            }
            Some((tables, facts)) => {
                let state = tables.lend(|robot| robot.state_of(facts)).map_err(value)?;
                Ok(state.into_pyobject(py)?.into_any().unbind())
            }
        }
    }

    /// The home, with everything where it was at the beginning.
    ///
    /// Raises `ValueError` if the session is in a world.
    #[getter(home)]
    fn get_home(&self, py: Python<'_>) -> PyResult<Home> {
        self.home(py)
    }

    /// The tasks' recorded prior, or None.
    #[getter]
    fn prior<'py>(&self, py: Python<'py>) -> PyResult<Option<Bound<'py, PyDict>>> {
        let Some(prior) = &self.recorded.header.prior else { return Ok(None) };
        let dict = PyDict::new(py);
        for (task, value) in prior {
            dict.set_item(task.to_string(), value)?;
        }
        Ok(Some(dict))
    }

    /// The recorded trainer strategies, each mu+, mu-, epsilon and prior, or None.
    #[getter]
    fn strategies(&self) -> Option<Vec<(f64, f64, f64, f64)>> {
        let records = self.recorded.header.strategies.as_ref()?;
        Some(records.iter().map(|it| (it.mu_plus, it.mu_minus, it.epsilon, it.prior)).collect())
    }

    /// The session as lines of a log, without line ends. In a world, the world's own line is the first.
    fn lines(&self, py: Python<'_>) -> PyResult<Vec<String>> {
        self.written().map_err(|error| format(py, &error))
    }

    /// Replays the session with an agent: it hears, plans, and takes in each step. Returns the effect of each step, as
    /// `Agent.feedback` does. `learn` overrides the session's own `learn`.
    #[pyo3(signature = (agent, *, learn=None))]
    fn teach(&self, py: Python<'_>, agent: &Bound<'_, Agent>, learn: Option<bool>) -> PyResult<Vec<&'static str>> {
        agent.get().with(|mind| Ok(self.replay(py, mind, learn.unwrap_or(self.recorded.learn))?.evidence))
    }

    /// Replays the session as `teach` does. Returns the names of its tasks, and how probable each was: float32, shape (steps + 1, tasks),
    /// each row of sum 1. The first row is of the words alone; the last one includes evidence after the last step, such as an answer.
    #[pyo3(signature = (agent, *, learn=None))]
    fn posteriors<'py>(
        &self,
        py: Python<'py>,
        agent: &Bound<'_, Agent>,
        learn: Option<bool>,
    ) -> PyResult<(Vec<Py<PyString>>, Bound<'py, PyAny>)> {
        agent.get().with(|mind| {
            let beliefs = self.replay(py, mind, learn.unwrap_or(self.recorded.learn))?.beliefs;
            let shape = [beliefs.len(), beliefs.first().map_or(0, Vec::len)];
            let names = mind.names(py).take(shape[1]).collect();
            Ok((names, array(py, beliefs.into_iter().flatten(), &shape)?))
        })
    }

    fn __reduce__<'py>(slf: &Bound<'py, Self>) -> PyResult<Reduced<'py>> {
        Ok((slf.get_type().getattr("_restored")?, (slf.get().lines(slf.py())?,)))
    }

    #[staticmethod]
    fn _restored(py: Python<'_>, lines: Vec<String>) -> PyResult<Self> {
        let mut sessions = parse_log(py, lines.join("\n").as_bytes(), None)?;
        sessions.pop().filter(|_| sessions.is_empty()).ok_or_else(|| value("these lines are not one session"))
    }

    fn __repr__(&self) -> String {
        format!("<goodbot.Session: {:?}, {} steps>", self.recorded.header.command, self.recorded.steps.len())
    }
}
