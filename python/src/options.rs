//! What Python gives and gets: settings, kinds of tasks, actions and tasks by name, lists, numpy arrays (numpy reads the bytes, so that the
//! wheel is built without it), and random numbers that go on elsewhere: a pickled agent or trainer draws what the first one would.

use crate::error;
use crate::error::value;
use goodbot::capacity::Capacity;
use goodbot::language::Settings;
use goodbot::oomdp::{Action, Domain, Schema, action_named};
use goodbot::session::Weights;
use goodbot::task::{GroundedTask, LiftedTask, TaskSet, TaskText};
use goodbot::{Capacities, Options, home};
use goodbot_lesson::kept_kinds;
use pyo3::conversion::FromPyObjectOwned;
use pyo3::exceptions::PyTypeError;
use pyo3::prelude::*;
use pyo3::sync::PyOnceLock;
use pyo3::types::{PyBytes, PyDict, PyModule, PyString};
use rand_core::{Rng, TryRng};
use rand_pcg::Pcg32;
use std::convert::Infallible;

/// The most entries of any table: a greater number is a slip, and would take all memory.
const MOST: usize = 1 << 28;

const PRESETS: [(&str, Capacities); 3] = [("tiny", Capacities::TINY), ("small", Capacities::SMALL), ("standard", Capacities::STANDARD)];

fn preset(name: &str) -> PyResult<Capacities> {
    let found = PRESETS.iter().find(|(known, _)| *known == name);
    found
        .map(|(_, capacities)| *capacities)
        .ok_or_else(|| value(format!("no capacities are called {name:?}; give tiny, small or standard")))
}

/// Capacities from a preset's name, or from a dict of the fields to replace in `standard`.
pub fn capacities_of(given: Option<&Bound<'_, PyAny>>) -> PyResult<Capacities> {
    let Some(given) = given else { return Ok(Capacities::STANDARD) };
    if let Ok(name) = given.extract::<&str>() {
        return preset(name);
    }
    let mut capacities = Capacities::STANDARD;
    for (field, entries) in given.cast::<PyDict>().map_err(|_| value("capacities are a preset's name or a dict"))? {
        let capacity: Capacity = field.extract::<&str>()?.parse().map_err(|error| value(format!("{field}: {error}")))?;
        let entries: usize = entries.extract()?;
        if entries > MOST {
            return Err(value(format!("{}: {entries} is more than {MOST}; check the number", capacity.name())));
        }
        if capacity == Capacity::Tasks && entries > TaskSet::MOST {
            return Err(value(format!("tasks: {entries} is more than {}, the most that one command can choose from", TaskSet::MOST)));
        }
        capacities.set(capacity, entries);
    }
    Ok(capacities)
}

/// Capacities as a dict.
pub fn as_dict<'py>(py: Python<'py>, capacities: &Capacities) -> PyResult<Bound<'py, PyDict>> {
    let dict = PyDict::new(py);
    for capacity in Capacity::ALL {
        dict.set_item(capacity.name(), capacities.get(capacity))?;
    }
    Ok(dict)
}

/// The sizes of all tables of a preset, `tiny`, `small` or `standard`: a dict that `Agent(capacities=...)` takes.
///
/// >>> goodbot.capacities("tiny")["words"]
/// 14
#[pyfunction]
#[pyo3(signature = (preset="standard"))]
pub fn capacities<'py>(py: Python<'py>, preset: &str) -> PyResult<Bound<'py, PyDict>> {
    as_dict(py, &self::preset(preset)?)
}

/// Options from the names of a learner and of its weights.
pub fn options(learner: &str, weights: Option<&str>) -> PyResult<Options> {
    let options = match learner {
        "default" => Options { language: Settings::LAYERED, ..Options::DEFAULT },
        "roles" => Options::DEFAULT,
        "paper" => Options::PAPER,
        "smoothed" => Options::SMOOTHED,
        _ => return Err(value(format!("no learner is called {learner:?}; give default, roles, paper or smoothed"))),
    };
    let weights = match weights {
        None => options.weights,
        Some("paper") => Weights::Paper,
        Some("belief") => Weights::Belief,
        Some("evidence") => Weights::Evidence,
        Some(other) => return Err(value(format!("no weights are called {other:?}; give paper, belief or evidence"))),
    };
    Ok(Options { weights, ..options })
}

/// The action of this name, `noop` included.
pub fn action_of<D: Domain>(domain: &D, name: &str) -> PyResult<Action> {
    action_named(domain, name).ok_or_else(|| {
        let known: Vec<&str> = domain.actions().iter().map(|kind| kind.name).chain(["noop"]).collect();
        value(format!("{name:?} is no action here; there are {}", known.join(", ")))
    })
}

/// A task as logs write it: `agentInRoom(agent0,room1) avoiding agentInRoom(agent0,room2)`.
pub fn task_name<D: Domain>(domain: &D, lifted: &LiftedTask, task: &GroundedTask) -> String {
    TaskText::new(task, lifted, domain.world()).to_string()
}

/// The most items of a list: an object may go on for ever.
const MOST_ITEMS: usize = 1 << 20;

/// The items of a list, a tuple or anything else that has items in order. Room is made as they come: the length that an object says it has may
/// be any number, and room for 10^12 items ends the process.
#[derive(Clone, Debug, Default)]
pub struct Items<T>(pub Vec<T>);

impl<'py, T: FromPyObjectOwned<'py>> FromPyObject<'_, 'py> for Items<T> {
    type Error = PyErr;

    fn extract(given: Borrowed<'_, 'py, PyAny>) -> PyResult<Self> {
        if given.is_instance_of::<PyString>() || given.is_instance_of::<PyDict>() {
            return Err(PyTypeError::new_err(format!("a list is wanted here, and not a {}", given.get_type().name()?)));
        }
        let mut items = Vec::new();
        for item in given.try_iter()? {
            if items.len() == MOST_ITEMS {
                return Err(value(format!("the list has more than {MOST_ITEMS} items; give fewer")));
            }
            items.push(item?.extract::<T>().map_err(Into::into)?);
        }
        Ok(Self(items))
    }
}

/// Kinds of tasks that commands may mean, and their texts if a model file shall keep them.
pub struct Kinds {
    pub lifted: Vec<LiftedTask>,
    pub texts: Option<Vec<String>>,
}

/// The kinds of tasks that commands may mean: those named, or the paper's two. A model file without kinds means the paper's two.
pub fn kinds_of_tasks(py: Python<'_>, kinds: Option<Vec<String>>, schema: &Schema<'_>) -> PyResult<Kinds> {
    let paper = home::paper_tasks().map_err(value)?.to_vec();
    let Some(kinds) = kinds else { return Ok(Kinds { lifted: paper, texts: None }) };
    let parse = |text: &String| {
        LiftedTask::parse(text, schema).map_err(|problem| match problem {
            goodbot::task::TaskTextError::Capacity(full) => error::full(py, full),
            problem => value(format!("{text:?}: {problem}")),
        })
    };
    let lifted = kinds.iter().map(parse).collect::<PyResult<Vec<_>>>()?;
    let texts = (!are_same(&lifted, &paper)).then(|| lifted.iter().map(|kind| kept_kinds::text(kind, schema)).collect());
    Ok(Kinds { lifted, texts })
}

/// Whether two lists have the same kinds, in any order.
pub fn are_same(some: &[LiftedTask], others: &[LiftedTask]) -> bool {
    some.iter().all(|kind| others.contains(kind)) && others.iter().all(|kind| some.contains(kind))
}

fn numpy(py: Python<'_>) -> PyResult<&Bound<'_, PyModule>> {
    static NUMPY: PyOnceLock<Py<PyModule>> = PyOnceLock::new();
    Ok(NUMPY.get_or_try_init(py, || py.import("numpy").map(Bound::unbind))?.bind(py))
}

/// A type of number that numpy has.
pub trait Element: Copy {
    /// numpy's name for it.
    const NAME: &'static str;
    /// Its bytes, in this machine's order.
    fn write(self, bytes: &mut Vec<u8>);
}

macro_rules! element {
    ($($type:ty = $name:literal),*) => {
        $(impl Element for $type {
            const NAME: &'static str = $name;
            fn write(self, bytes: &mut Vec<u8>) {
                bytes.extend_from_slice(&self.to_ne_bytes());
            }
        })*
    };
}
element!(f32 = "float32", i64 = "int64");

impl Element for bool {
    const NAME: &'static str = "bool";
    fn write(self, bytes: &mut Vec<u8>) {
        bytes.push(u8::from(self));
    }
}

/// The numbers, row by row, as a new array of this shape; it cannot be written to.
pub fn array<'py, E: Element>(py: Python<'py>, numbers: impl IntoIterator<Item = E>, shape: &[usize]) -> PyResult<Bound<'py, PyAny>> {
    let mut bytes = Vec::with_capacity(shape.iter().product::<usize>().saturating_mul(size_of::<E>()));
    numbers.into_iter().for_each(|number| number.write(&mut bytes));
    let flat = numpy(py)?.call_method1("frombuffer", (PyBytes::new(py, &bytes), E::NAME))?;
    flat.call_method1("reshape", (shape.to_vec(),))
}

/// The random numbers of a seed, and how many of 32 bits were drawn.
#[derive(Clone, Debug)]
pub struct Random {
    seed: u64,
    drawn: u64,
    numbers: Pcg32,
}

/// A seed, and how many numbers were drawn.
#[derive(Clone, Copy, Debug, FromPyObject, IntoPyObject)]
pub struct Drawn(u64, u64);

impl Random {
    pub fn new(seed: u64) -> Self {
        Self { seed, drawn: 0, numbers: goodbot_course::generator(seed) }
    }

    pub const fn drawn(&self) -> Drawn {
        Drawn(self.seed, self.drawn)
    }

    /// Goes on where others were.
    pub fn after(Drawn(seed, drawn): Drawn) -> Self {
        let mut random = Self { drawn, ..Self::new(seed) };
        random.numbers.advance(drawn);
        random
    }
}

impl TryRng for Random {
    type Error = Infallible;

    fn try_next_u32(&mut self) -> Result<u32, Infallible> {
        self.drawn = self.drawn.wrapping_add(1);
        Ok(self.numbers.next_u32())
    }

    fn try_next_u64(&mut self) -> Result<u64, Infallible> {
        self.drawn = self.drawn.wrapping_add(2);
        Ok(self.numbers.next_u64())
    }

    fn try_fill_bytes(&mut self, bytes: &mut [u8]) -> Result<(), Infallible> {
        self.drawn = self.drawn.wrapping_add(bytes.len().div_ceil(4) as u64);
        self.numbers.fill_bytes(bytes);
        Ok(())
    }
}
