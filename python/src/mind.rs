//! The robot's mind: long work goes in parts, between which other threads may run and ctrl-C is heard.

use crate::error::{self, SessionError, value};
use crate::home as home_of;
use crate::options::{Kinds, Random, task_name};
use crate::place::{Place, in_place, in_place_and_on};
use crate::robot::Robot;
use crate::world::World;
use goodbot::feedback::Strategy;
use goodbot::memory::AgentHeap;
use goodbot::oomdp::{Action, Domain};
use goodbot::planning::Progress;
use goodbot::task::TaskSet;
use goodbot::{Agent as Core, AgentError, Capacities, Options};
use goodbot_console::typed;
use goodbot_lesson::checked::CheckedSession;
use goodbot_lesson::first_words::{Long, read};
use goodbot_lesson::kept_kinds;
use goodbot_lesson::live::Voice;
use pyo3::exceptions::PyUserWarning;
use pyo3::prelude::*;
use pyo3::types::PyString;
use std::collections::HashMap;
use std::ffi::CString;
use std::sync::Arc;

/// About how much work is done before other threads may run: some milliseconds.
pub const PART: u32 = 1 << 16;

/// Work that can go in parts.
#[derive(Clone, Copy)]
pub enum Part {
    Hear,
    Plan,
    Finish,
}

/// The core's agent, and what else Python needs.
pub struct Mind {
    pub core: Core<AgentHeap>,
    /// The texts of its kinds of tasks, if its file keeps them.
    pub kinds: Option<Vec<String>>,
    pub random: Random,
    /// How many possible tasks it keeps, of all sessions together.
    pub room: usize,
    /// The kinds of tasks and the domain that it was made with; a copy is made with the same.
    pub made_with: (Option<Vec<String>>, Option<Py<PyAny>>),
    /// Whether sessions wait for training.
    pub waiting: bool,
    pub robot: Option<Arc<Robot>>,
    pub names: Vec<Py<PyString>>,
    pub command: String,
    pub voice: Voice,
    pub broken: bool,
}

/// The words of a command that are read. If there are more, Python is warned.
pub fn words_read<'c>(py: Python<'_>, command: &'c str) -> PyResult<&'c str> {
    let read = read(command).map_err(|refused| error::full(py, refused))?;
    read.long().map_or(Ok(()), |long| warn(py, long))?;
    Ok(read.words)
}

/// Warns Python that a command is not read to its end.
pub fn warn(py: Python<'_>, long: Long) -> PyResult<()> {
    let text = CString::new(format!("the command {long}")).unwrap_or_default();
    PyErr::warn(py, &py.get_type::<PyUserWarning>(), &text, 2)
}

impl Mind {
    /// `tasks` is the number of possible tasks that it keeps, of all sessions together.
    pub fn new(capacities: &Capacities, tasks: usize, kinds: Kinds, options: Options, seed: u64) -> Result<Self, AgentError> {
        let core = Core::new(typed::memory(capacities, &options.language, tasks), &kinds.lifted, options)?;
        Ok(Self {
            core,
            kinds: kinds.texts,
            random: Random::new(seed),
            room: tasks,
            made_with: (None, None),
            waiting: false,
            robot: None,
            names: Vec::new(),
            command: String::new(),
            voice: Voice::default(),
            broken: false,
        })
    }

    /// The bytes of a model file, with its kinds of tasks.
    pub fn saved(&self) -> PyResult<Vec<u8>> {
        let model = self.core.saved().map_err(error::save)?;
        Ok(match &self.kinds {
            Some(kinds) => kept_kinds::with(&model, kinds),
            None => model,
        })
    }

    pub fn place(&mut self, domain: &Bound<'_, PyAny>, state: &Bound<'_, PyAny>) -> PyResult<Place> {
        Place::of(domain, state, &mut self.robot)
    }

    /// The place for a call that needs no state, such as the end of a session.
    pub fn place_of(&mut self, domain: &Bound<'_, PyAny>) -> PyResult<Place> {
        if let Ok(home) = domain.cast::<home_of::Home>() {
            return Ok(Place::Home(home.clone().unbind(), home.get().start));
        }
        if let Ok(world) = domain.cast::<World>() {
            return Ok(Place::World(world.get().0.clone(), world.get().0.start()));
        }
        match self.robot.as_ref().filter(|robot| robot.is_of(domain)) {
            Some(robot) => Ok(Place::Robot(robot.clone(), 0)),
            None => Err(SessionError::new_err(AgentError::OtherDomain.to_string())),
        }
    }

    /// Raises an exception of the robot's class, or an error of the core. After the former, the session is left: its plans are worthless.
    pub fn settled<T>(&mut self, py: Python<'_>, place: &Place, result: Result<T, AgentError>) -> PyResult<T> {
        if let Some(failure) = place.failure() {
            self.core.leave();
            self.names.clear();
            self.robot = None;
            return Err(failure);
        }
        result.map_err(|refused| error::agent(py, refused))
    }

    fn part(&mut self, part: Part, place: &Place, budget: u32) -> Result<Option<usize>, AgentError> {
        let done = |progress: Progress| if progress == Progress::Done { Some(0) } else { None };
        in_place!(place, |domain, state| match part {
            Part::Hear => self.core.hear_on(domain, budget).map(done),
            Part::Plan => self.core.plan(domain, state, budget).map(done),
            Part::Finish => Ok(self.core.finish_on(domain, budget)?.map(|finished| finished.gave_way.count())),
        })
    }

    /// Goes on with a part of `budget`, or to the end. Once it is done, returns how many sessions gave way (0 unless finishing).
    pub fn go_on(&mut self, py: Python<'_>, part: Part, place: &Place, budget: Option<u32>) -> PyResult<Option<usize>> {
        loop {
            let result = py.detach(|| self.part(part, place, budget.unwrap_or(PART)));
            let came = self.settled(py, place, result)?;
            if came.is_some() || budget.is_some() {
                return Ok(came);
            }
            py.check_signals()?;
        }
    }

    /// Learns to the end.
    pub fn learn(&mut self, py: Python<'_>) -> PyResult<()> {
        while py.detach(|| self.core.learn(PART)) == Progress::Working {
            py.check_signals()?;
        }
        Ok(())
    }

    /// Finishes to the end. Returns how many older sessions gave way.
    pub fn finish(&mut self, py: Python<'_>, place: &Place) -> PyResult<usize> {
        let begun = in_place!(place, |domain, _state| self.core.begin_finishing(domain));
        self.settled(py, place, begun)?;
        let gave_way = self.go_on(py, Part::Finish, place, None)?.unwrap_or(0);
        self.waiting = false;
        Ok(gave_way)
    }

    pub fn hear(&mut self, py: Python<'_>, place: &Place, command: &str) -> PyResult<()> {
        let command = words_read(py, command)?;
        let begun = in_place!(place, |domain, state| self.core.begin_hearing(domain, state, command));
        self.settled(py, place, begun)?;
        command.clone_into(&mut self.command);
        if let Err(stopped) = self.go_on(py, Part::Hear, place, None) {
            self.core.leave();
            return Err(stopped);
        }
        self.name_tasks(py, place);
        Ok(())
    }

    /// Finishes to the end in the home or world of a recorded session.
    pub fn finish_in(&mut self, py: Python<'_>, domain: &(impl Domain + Sync)) -> PyResult<()> {
        self.core.begin_finishing(domain).map_err(|refused| error::agent(py, refused))?;
        while py.detach(|| self.core.finish_on(domain, PART)).map_err(|refused| error::agent(py, refused))?.is_none() {
            py.check_signals()?;
        }
        Ok(())
    }

    /// Records that a recorded session was heard.
    pub fn heard<D: Domain>(&mut self, py: Python<'_>, session: &CheckedSession<D>) {
        session.walk.command.clone_into(&mut self.command);
        self.names = session.tasks.iter().map(|(_, name)| PyString::new(py, &name.to_string()).unbind()).collect();
    }

    pub fn hear_with_prior(&mut self, py: Python<'_>, place: &Place, command: &str, prior: &HashMap<String, f32>) -> PyResult<()> {
        let command = words_read(py, command)?;
        let heard = in_place!(place, |domain, state| {
            self.core
                .hear_with_prior(domain, state, command, |task, lifted| prior.get(&task_name(domain, lifted, task)).copied().unwrap_or(0.0))
        });
        self.settled(py, place, heard)?;
        command.clone_into(&mut self.command);
        self.name_tasks(py, place);
        let strange = prior.keys().find(|name| self.position(py, name).is_none());
        if let Some(name) = strange {
            self.core.leave();
            let known = self.known_tasks(py);
            return Err(value(format!("the prior names {name}, which is no task here; there are {known}")));
        }
        Ok(())
    }

    pub fn name_tasks(&mut self, py: Python<'_>, place: &Place) {
        let lifted = self.core.lifted();
        let names = in_place!(place, |domain, _state| {
            let named = self.core.tasks().iter().filter_map(|task| Some((lifted.get(usize::from(task.lifted))?, task)));
            named.map(|(lifted, task)| PyString::new(py, &task_name(domain, lifted, task)).unbind()).collect()
        });
        self.names = names;
    }

    /// The position of a task by its name.
    pub fn position(&self, py: Python<'_>, name: &str) -> Option<usize> {
        self.names.iter().position(|known| known.bind(py).to_str().is_ok_and(|known| known == name))
    }

    /// The position of a task that Python gives by name or position.
    pub fn task(&self, task: &Bound<'_, PyAny>) -> PyResult<usize> {
        if let Ok(position) = task.extract::<usize>() {
            let count = self.core.tasks().len();
            return if position < count { Ok(position) } else { Err(value(format!("there is no task {position}; there are {count}"))) };
        }
        let name: &str = task.extract()?;
        self.position(task.py(), name)
            .ok_or_else(|| value(format!("{name} is no task of this session; there are {}", self.known_tasks(task.py()))))
    }

    /// The tasks that Python gives as one, by name or position, or as several.
    pub fn tasks(&self, tasks: &Bound<'_, PyAny>) -> PyResult<TaskSet> {
        if tasks.is_instance_of::<PyString>() || tasks.extract::<usize>().is_ok() {
            return Ok(TaskSet::of(self.task(tasks)?));
        }
        tasks.try_iter()?.map(|task| self.task(&task?)).collect()
    }

    /// The names of the tasks, or of the first of many.
    fn known_tasks(&self, py: Python<'_>) -> String {
        const MOST: usize = 12;
        let names: Vec<String> = self.names(py).take(MOST).map(|name| name.to_string()).collect();
        let more = self.count().saturating_sub(MOST);
        if more == 0 { names.join(", ") } else { format!("{}, and {more} more", names.join(", ")) }
    }

    /// The name of a task.
    pub fn task_text(&self, py: Python<'_>, task: usize) -> String {
        self.names.get(task).and_then(|name| name.bind(py).to_str().ok().map(str::to_owned)).unwrap_or_default()
    }

    pub fn acted(&mut self, py: Python<'_>, place: &Place, action: Action) -> PyResult<Place> {
        let next = in_place_and_on!(py, place, |domain, state, on| self.core.acted(domain, state, action).map(on));
        self.settled(py, place, next)
    }

    pub fn set_strategies(&mut self, py: Python<'_>, strategies: &[(Strategy, f32)]) -> PyResult<()> {
        self.core.set_strategies(strategies).map_err(|refused| error::agent(py, refused))
    }

    /// How many tasks the session has.
    pub fn count(&self) -> usize {
        self.core.tasks().len()
    }

    /// How probable each task is.
    pub fn beliefs(&self) -> Vec<f32> {
        let belief = self.core.belief();
        (0..self.count()).map(|task| belief.probability(task)).collect()
    }

    /// The names of the last session's tasks.
    pub fn names(&self, py: Python<'_>) -> impl Iterator<Item = Py<PyString>> {
        self.names.iter().map(move |name| name.clone_ref(py))
    }
}
