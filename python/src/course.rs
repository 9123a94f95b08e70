//! The paper's lessons and tests.

use crate::error::{self, value};
use crate::home::{Home, meant};
use crate::options::{kinds_of_tasks, options};
use crate::trainer::{counts, trainer_of};
use goodbot::home::SCHEMA;
use goodbot::{Agent, Capacities, HeapMemory};
use goodbot_course::{CourseError, CourseTrainer, Exercise, Homes, LESSONS, TESTS, generator};
use pyo3::IntoPyObjectExt;
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyList};

/// The capacities of the command line's runs: enough for the whole course.
const CAPACITIES: Capacities = Capacities::SMALL;

fn homes(layouts: &str, random: &mut impl rand_core::Rng) -> PyResult<Homes> {
    match layouts {
        "fixed" => Ok(Homes::FIXED),
        "random" => Ok(Homes::random(random, &mut HeapMemory::new(&CAPACITIES).home)),
        _ => Err(value(format!("no layouts are called {layouts:?}; give fixed or random"))),
    }
}

/// The paper's seven lessons and five tests, in the homes as drawn, or at random for a seed: dicts of `kind`, `command`, `intended`, `home`.
///
/// >>> [it["command"] for it in goodbot.exercises()][:2]
/// ['go to the green room', 'go to the red room']
#[pyfunction]
#[pyo3(signature = (seed=None))]
pub fn exercises<'py>(py: Python<'py>, seed: Option<u64>) -> PyResult<Bound<'py, PyList>> {
    let homes = match seed {
        None => Homes::FIXED,
        Some(seed) => homes("random", &mut generator(seed))?,
    };
    let list = PyList::empty(py);
    let numbered = LESSONS.iter().map(|exercise| ("lesson", exercise)).chain(TESTS.iter().map(|exercise| ("test", exercise)));
    for (kind, exercise) in numbered {
        let home = Home::of_layout(homes.layout(exercise.home))?;
        let one = PyDict::new(py);
        one.set_item("kind", kind)?;
        one.set_item("command", exercise.command)?;
        one.set_item("intended", meant(&home.rooms, &home.start, exercise)?)?;
        one.set_item("home", home.into_py_any(py)?)?;
        list.append(one)?;
    }
    Ok(list)
}

/// The seed's course, as `goodbot paper` runs it.
fn run(
    seed: u64,
    trainer: &CourseTrainer,
    homes: &str,
    options: goodbot::Options,
    lifted: &[goodbot::task::LiftedTask],
) -> Result<goodbot_course::Results, CourseError> {
    let mut memory = HeapMemory::new(&CAPACITIES);
    // As in the paper: any action that leads on.
    let options = goodbot::Options { telling: false, ..options };
    let mut agent = Agent::new(&mut memory.agent, lifted, options).map_err(CourseError::Agent)?;
    let mut random = generator(seed);
    let homes = if homes == "random" { Homes::random(&mut random, &mut memory.home) } else { Homes::FIXED };
    goodbot_course::run_course(&mut agent, &mut memory.home, &homes, trainer, trainer.strategy, &mut random, &mut ())
}

fn row<'py>(py: Python<'py>, seed: u64, kind: &str, number: usize, exercise: &Exercise) -> PyResult<Bound<'py, PyDict>> {
    let row = PyDict::new(py);
    row.set_item("seed", seed)?;
    row.set_item("kind", kind)?;
    row.set_item("number", number + 1)?;
    row.set_item("command", exercise.command)?;
    Ok(row)
}

/// Trains a new agent through the seven lessons and asks the five tests, as `goodbot paper --seed SEED` does: twelve rows.
///
/// Each row has `seed`, `kind`, `number`, `command` and `right`; lessons also have `steps`, `ending`, `reward`, `punish` and `neutral`,
/// tests the `probability` of the intended task. `layouts` is `fixed` or `random`.
///
/// >>> rows = goodbot.run_course(1)
/// >>> [row["right"] for row in rows if row["kind"] == "test"]
/// [True, True, True, True, True]
#[pyfunction]
#[pyo3(signature = (seed, *, trainer=None, layouts="fixed", learner="roles", weights=None))]
pub fn run_course<'py>(
    py: Python<'py>,
    seed: u64,
    trainer: Option<&Bound<'py, PyAny>>,
    layouts: &str,
    learner: &str,
    weights: Option<&str>,
) -> PyResult<Bound<'py, PyList>> {
    let trainer = trainer.map_or(Ok(CourseTrainer::BALANCED), trainer_of)?;
    if !matches!(layouts, "fixed" | "random") {
        return Err(value(format!("no layouts are called {layouts:?}; give fixed or random")));
    }
    let (options, lifted) = (options(learner, weights)?, kinds_of_tasks(py, None, &SCHEMA)?.lifted);
    let ran = py.detach(|| std::panic::catch_unwind(|| run(seed, &trainer, layouts, options, &lifted)));
    let results = ran
        .map_err(|_| error::InternalError::new_err("goodbot itself failed; report it"))?
        .map_err(|refused| error::course(py, refused))?;
    let rows = PyList::empty(py);
    for (number, (exercise, lesson)) in LESSONS.iter().zip(&results.lessons).enumerate() {
        let row = row(py, seed, "lesson", number, exercise)?;
        row.set_item("right", lesson.understood)?;
        row.set_item("steps", lesson.steps)?;
        row.set_item("ending", lesson.ending.name())?;
        row.update(counts(py, lesson.feedback)?.as_mapping())?;
        rows.append(row)?;
    }
    for (number, (exercise, test)) in TESTS.iter().zip(&results.tests).enumerate() {
        let row = row(py, seed, "test", number, exercise)?;
        row.set_item("right", test.right)?;
        row.set_item("probability", test.probability)?;
        rows.append(row)?;
    }
    Ok(rows)
}
