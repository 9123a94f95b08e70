//! A world with a robot of any kind, from a file or a dict.

use crate::error::{file as unread, format as misformed, in_file, misformed as misformed_at, value};
use crate::home::names_of_tasks;
use crate::options::{Items, action_of};
use goodbot::oomdp::{Domain, apply};
use goodbot_formats::task_text::{GroundAtomText, GroundTaskText};
use goodbot_formats::world::WorldFile;
use goodbot_lesson::world::pddl;
use goodbot_lesson::world::robot::{self, Tables};
use pyo3::exceptions::PyUserWarning;
use pyo3::prelude::*;
use pyo3::types::PyDict;
use std::hash::{Hash, Hasher};
use std::path::PathBuf;
use std::sync::Arc;

/// A world with a robot of any kind: classes, attributes, propositions, objects and actions, as a dict or from a file (`goodbot example world`
/// prints one). A state is a number.
///
/// >>> world = goodbot.World({"type": "world", "name": "hall", "classes": ["lamp"], "attributes": {}, "propositions": {"on": ["lamp"]},
/// ...     "objects": [{"name": "a", "class": "lamp"}, {"name": "b", "class": "lamp"}], "task_kinds": ["on(?l)"],
/// ...     "actions": [{"name": "light", "parameters": {"?l": "lamp"}, "effects": ["on(?l)"]}]})
/// >>> world.tasks(), world.actions
/// (['on(a)', 'on(b)'], ('light(a)', 'light(b)'))
/// >>> agent, trainer = goodbot.Agent(domain=world), goodbot.Trainer(seed=1)
/// >>> trainer.teach(agent, world, world.start, "the left one", "on(a)").ending
/// 'goal'
/// >>> agent.hear(world, world.start, "left")
/// >>> agent.most_likely, world.plan("on(a)")
/// ('on(a)', ['light(a)'])
///
/// Worlds of the same description are equal.
#[pyclass(frozen, eq, hash, module = "goodbot")]
#[derive(Debug)]
pub struct World(pub Arc<Tables>);

impl PartialEq for World {
    fn eq(&self, other: &Self) -> bool {
        self.0.file() == other.0.file()
    }
}

impl Hash for World {
    fn hash<H: Hasher>(&self, hasher: &mut H) {
        self.0.file().name.hash(hasher);
    }
}

/// For pickle: the function that makes a world again, and its JSON.
type Reduced<'py> = (Bound<'py, PyAny>, (String,));

impl World {
    fn parsed(py: Python<'_>, text: &str) -> PyResult<Self> {
        let file = WorldFile::parse(text).map_err(|error| misformed(py, &error))?;
        Tables::of(Arc::new(file)).map(|tables| Self(Arc::new(tables))).map_err(value)
    }

    /// A state that Python names.
    pub fn check(&self, state: &Bound<'_, PyAny>) -> PyResult<u64> {
        let number: u64 = state.extract().map_err(|_| value("a state of a world is a number, such as world.start"))?;
        let count = self.0.lend(|robot| robot.state_count());
        if number < count { Ok(number) } else { Err(value(format!("there is no state {number}; they count from 0 to {}", count - 1))) }
    }

    fn checked(&self, state: Option<&Bound<'_, PyAny>>) -> PyResult<u64> {
        state.map_or(Ok(self.0.start()), |state| self.check(state))
    }
}

fn parsed<T: std::str::FromStr<Err: std::fmt::Display>>(text: &str) -> PyResult<T> {
    text.parse().map_err(|error| value(format!("{text:?}: {error}")))
}

#[pymethods]
impl World {
    #[new]
    fn new(description: &Bound<'_, PyDict>) -> PyResult<Self> {
        let py = description.py();
        let text: String = py.import("json")?.getattr("dumps")?.call1((description,))?.extract()?;
        Self::parsed(py, &text)
    }

    /// A world from a text: JSON on one line or on many.
    #[staticmethod]
    fn from_json(py: Python<'_>, text: &str) -> PyResult<Self> {
        Self::parsed(py, text)
    }

    /// A world from a file.
    ///
    /// Raises `FormatError`, `ValueError` and `OSError`.
    #[staticmethod]
    fn load(py: Python<'_>, path: PathBuf) -> PyResult<Self> {
        let text = std::fs::read_to_string(&path).map_err(|error| unread(&path, &error))?;
        Self::parsed(py, &text).map_err(|error| in_file(py, &path, error))
    }

    /// The world of a planning problem, from the files of its PDDL domain and problem; `goodbot convert` writes the same.
    ///
    /// Warns of what you may not expect, such as a goal that no plan reaches. Raises `FormatError`, `ValueError` and `OSError`.
    #[staticmethod]
    fn from_pddl(py: Python<'_>, domain: PathBuf, problem: PathBuf) -> PyResult<Self> {
        let read = |path: &PathBuf| std::fs::read_to_string(path).map_err(|error| unread(path, &error));
        let texts = (read(&domain)?, read(&problem)?);
        let pddl::Converted { world, warnings } = py.detach(|| pddl::convert(&texts.0, &texts.1)).map_err(|error| {
            let path = if error.text == pddl::Text::Domain { &domain } else { &problem };
            misformed_at(py, format!("{}:{}: {}", path.display(), error.line, error.message), error.line, None)
        })?;
        for warning in warnings {
            PyErr::warn(py, &py.get_type::<PyUserWarning>(), &std::ffi::CString::new(warning)?, 1)?;
        }
        Tables::of(Arc::new(world)).map(|tables| Self(Arc::new(tables))).map_err(|flaw| in_file(py, &problem, value(flaw)))
    }

    /// Its name.
    #[getter]
    fn name(&self) -> &str {
        &self.0.file().name
    }

    /// The first state.
    #[getter]
    fn start(&self) -> u64 {
        self.0.start()
    }

    /// The most states that there can be: the number of each is below this.
    #[getter]
    fn state_count(&self) -> u64 {
        self.0.lend(|robot| robot.state_count())
    }

    /// The names of the robot's actions, without `noop`.
    #[getter]
    fn actions<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, pyo3::types::PyTuple>> {
        let names: Vec<String> = self.0.lend(|robot| robot.actions().iter().map(|kind| kind.name.to_owned()).collect());
        pyo3::types::PyTuple::new(py, names)
    }

    /// The propositions that an action can change, such as `lampOn(lamp0)`.
    #[getter]
    fn propositions<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, pyo3::types::PyTuple>> {
        pyo3::types::PyTuple::new(py, self.0.lend(|robot| robot.changing()).iter().map(ToString::to_string))
    }

    /// The objects by their names: `class`, and the values of their attributes.
    #[getter]
    fn objects<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let all = PyDict::new(py);
        for object in &self.0.file().objects {
            let one = PyDict::new(py);
            one.set_item("class", &object.class)?;
            for (attribute, value) in &object.attributes {
                one.set_item(attribute, value)?;
            }
            all.set_item(&object.name, one)?;
        }
        Ok(all)
    }

    /// The facts that hold in a state, by default at the start.
    #[pyo3(signature = (state=None))]
    fn facts(&self, state: Option<&Bound<'_, PyAny>>) -> PyResult<Vec<String>> {
        let state = self.checked(state)?;
        Ok(self.0.lend(|robot| robot.facts(state)).iter().map(ToString::to_string).collect())
    }

    /// The derived facts of each object that has some in a state, by default at the start: the `derived` entries whose conditions hold.
    #[pyo3(signature = (state=None))]
    fn derived<'py>(&self, py: Python<'py>, state: Option<&Bound<'_, PyAny>>) -> PyResult<Bound<'py, PyDict>> {
        let (state, all) = (self.checked(state)?, PyDict::new(py));
        self.0.lend(|robot| {
            robot.world().objects.iter().try_for_each(|(object, _)| {
                let mut facts: Vec<String> = Vec::new();
                robot.tell_derived(&state, object, &mut |fact| facts.push(fact.to_owned()));
                if facts.is_empty() { Ok(()) } else { all.set_item(robot.world().objects.name(object), facts) }
            })
        })?;
        Ok(all)
    }

    /// The state in which these facts hold, and no others. For a robot that senses facts.
    ///
    /// Raises `ValueError` if there is no such state.
    fn state(&self, facts: Items<String>) -> PyResult<u64> {
        let facts = facts.0.iter().map(|fact| parsed(fact)).collect::<PyResult<Vec<GroundAtomText>>>()?;
        if let Some(strange) = facts.iter().find(|fact| self.0.lend(|robot| goodbot_lesson::checked::known_atom(robot, fact)).is_err()) {
            return Err(value(format!("{strange} is no proposition of this world's objects")));
        }
        self.0.lend(|robot| robot.state_of(&facts)).map_err(value)
    }

    /// The state that an action leads to, or None where it cannot be done.
    fn step(&self, state: &Bound<'_, PyAny>, action: &str) -> PyResult<Option<u64>> {
        let state = self.check(state)?;
        self.0.lend(|robot| Ok(apply(robot, &state, action_of(robot, action)?)))
    }

    /// Whether a proposition such as `lampOn(lamp0)` holds in a state.
    fn holds(&self, proposition: &str, state: &Bound<'_, PyAny>) -> PyResult<bool> {
        let (atom, state) = (parsed::<GroundAtomText>(proposition)?, self.check(state)?);
        self.0.lend(|robot| Ok(robot.holds(&goodbot_lesson::checked::known_atom(robot, &atom).map_err(value)?, &state)))
    }

    /// The tasks that a command may mean in a state, by default at the start.
    #[pyo3(signature = (state=None))]
    fn tasks(&self, py: Python<'_>, state: Option<&Bound<'_, PyAny>>) -> PyResult<Vec<String>> {
        let state = self.checked(state)?;
        self.0.lend(|robot| {
            let lifted = robot::tasks(self.0.file(), robot).map_err(value)?;
            names_of_tasks(py, robot, &lifted, &state)
        })
    }

    /// The actions of one of the cheapest plans for a task from the start; None where there is none.
    fn plan(&self, task: &str) -> PyResult<Option<Vec<String>>> {
        robot::plan(self.0.file(), &parsed::<GroundTaskText>(task)?).map_err(value)
    }

    /// The world as JSON, on one line.
    fn to_json(&self, py: Python<'_>) -> PyResult<String> {
        self.0.file().to_json_line().map_err(|error| misformed(py, &error))
    }

    fn __reduce__<'py>(slf: &Bound<'py, Self>) -> PyResult<Reduced<'py>> {
        Ok((slf.get_type().getattr("from_json")?, (slf.get().to_json(slf.py())?,)))
    }

    fn __repr__(&self) -> String {
        let file = self.0.file();
        let actions = self.0.lend(|robot| robot.actions().len());
        format!("<goodbot.World: {}, {} objects, {actions} actions>", file.name, file.objects.len())
    }
}
