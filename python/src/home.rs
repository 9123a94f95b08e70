//! Homes and their states.

use crate::error::{format, full, misformed, value};
use crate::options::{Items, action_of, as_dict, capacities_of, task_name};
use goodbot::Capacities;
use goodbot::capacity::{Capacity, CapacityError};
use goodbot::home::{self, Area, COLOR, Cell, DOOR, HomeState, Map, Moves, Problem, ROOM, SCHEMA, SHAPE};
use goodbot::memory::HomeHeap;
use goodbot::oomdp::{Domain, GroundProposition, ObjectId, PushGrid, apply};
use goodbot::task::{GroundedTask, LiftedTask, ground};
use goodbot_course::{Exercise, HomeName, Layout, generator};
use goodbot_formats::environment::{EnvironmentFile, object_line};
use goodbot_formats::map;
use goodbot_lesson::home::{HomeFlaw, environment};
use pyo3::exceptions::PyTypeError;
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyTuple};
use std::hash::{DefaultHasher, Hash, Hasher};

/// The core's home, on the heap.
pub type Rooms = home::Home<HomeHeap>;

/// Where the agent and the blocks of a home are. Equal states are equal objects, and can be keys of dicts.
///
/// `Home.start` is one, and `Home.step`, `Home.placed` and `Agent.acted` return others. `Home.cells` says where things are.
#[pyclass(frozen, eq, hash, module = "goodbot")]
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct State {
    /// Marks the home that it belongs to.
    mark: u64,
    pub at: HomeState,
}

/// For pickle: the function that makes a state again, and its arguments.
type ReducedState<'py> = (Bound<'py, PyAny>, (u64, Vec<u16>));

#[pymethods]
impl State {
    fn __repr__(&self) -> String {
        let mut cells = self.at.to_numbers();
        let agent = cells.next().unwrap_or(0);
        let blocks = cells.take_while(|&cell| cell != u16::MAX).map(|cell| cell.to_string()).collect::<Vec<_>>().join(", ");
        format!("<goodbot.State: agent in cell {agent}, blocks in [{blocks}]; Home.cells(state) names them>")
    }

    fn __reduce__<'py>(slf: &Bound<'py, Self>) -> PyResult<ReducedState<'py>> {
        let Self { mark, at } = slf.get();
        Ok((slf.get_type().getattr("_restored")?, (*mark, at.to_numbers().collect())))
    }

    #[staticmethod]
    fn _restored(mark: u64, cells: Vec<u16>) -> Self {
        Self { mark, at: HomeState::of_numbers(cells) }
    }
}

/// A home of rooms, doors and blocks, with one agent: an object-oriented MDP (the paper, section 4). It does not change; states do.
///
/// >>> home = goodbot.Home.from_map('''
/// ... #######
/// ... #r@#gg#
/// ... #rr+gg#
/// ... #######
/// ... ''')
/// >>> print(home.map(home.step(home.start, "south")), end="")
/// #######
/// #rr#gg#
/// #r@+gg#
/// #######
///
/// Homes with the same cells, objects and start are equal.
#[pyclass(frozen, eq, hash, module = "goodbot")]
#[derive(Debug)]
pub struct Home {
    pub rooms: Rooms,
    pub start: HomeState,
    mark: u64,
}

impl PartialEq for Home {
    fn eq(&self, other: &Self) -> bool {
        self.mark == other.mark
    }
}

impl Hash for Home {
    fn hash<H: Hasher>(&self, hasher: &mut H) {
        self.mark.hash(hasher);
    }
}

const fn moves(pull: bool) -> Moves {
    if pull { Moves::PushAndPull } else { Moves::Push }
}

/// The tasks of these kinds in a state.
pub fn tasks<D: Domain>(domain: &D, lifted: &[LiftedTask], state: &D::State) -> Result<Vec<GroundedTask>, CapacityError> {
    let mut tasks = vec![GroundedTask::UNUSED; Capacities::STANDARD.tasks];
    let count = ground(domain, lifted, state, &mut tasks)?;
    tasks.truncate(count);
    Ok(tasks)
}

/// The names of the tasks of these kinds in a state.
pub fn names_of_tasks<D: Domain>(py: Python<'_>, domain: &D, lifted: &[LiftedTask], state: &D::State) -> PyResult<Vec<String>> {
    let tasks = tasks(domain, lifted, state).map_err(|error| full(py, error))?;
    let name = |task: &GroundedTask| Some(task_name(domain, lifted.get(usize::from(task.lifted))?, task));
    Ok(tasks.iter().filter_map(name).collect())
}

/// The name of the task that an exercise means.
pub fn meant(rooms: &Rooms, state: &HomeState, exercise: &Exercise) -> PyResult<String> {
    let lifted = home::paper_tasks().map_err(value)?;
    let tasks = tasks(rooms, &lifted, state).map_err(value)?;
    let named = tasks.iter().filter_map(|task| Some((lifted.get(usize::from(task.lifted))?, task)));
    let mut meant = named.filter(|(lifted, task)| exercise.intention.is(rooms, lifted, task));
    meant.next().map(|(lifted, task)| task_name(rooms, lifted, task)).ok_or_else(|| value("nobody can mean this here"))
}

/// A home of the course by its letter.
fn home_name(name: &str) -> PyResult<HomeName> {
    let known = HomeName::ALL.into_iter().find(|known| format!("{known:?}") == name);
    known.ok_or_else(|| value(format!("no home of the course is called {name:?}; give A to F, or Test")))
}

impl Home {
    /// A home, with its initial state.
    pub fn new(rooms: Rooms, start: HomeState) -> Self {
        let mut hasher = DefaultHasher::new();
        environment(&rooms, &start).to_json_line().hash(&mut hasher);
        rooms.moves().hash(&mut hasher);
        Self { rooms, start, mark: hasher.finish() }
    }

    /// The home of an environment.
    pub fn of(py: Python<'_>, environment: &EnvironmentFile, moves: Moves, capacities: &Capacities, text: &str) -> PyResult<Self> {
        let built = goodbot_lesson::home::build(environment, moves, HomeHeap::new(capacities));
        let (rooms, start) = built.map_err(|error| flaw(py, environment, &error, text))?;
        Ok(Self::new(rooms, start))
    }

    /// A layout of the course.
    pub fn of_layout(layout: &Layout) -> PyResult<Self> {
        let (rooms, start) = layout.build(HomeHeap::new(&Capacities::STANDARD)).map_err(value)?;
        Ok(Self::new(rooms, start))
    }

    /// The state, if it is one of this home.
    pub fn check(&self, state: &Bound<'_, PyAny>) -> PyResult<HomeState> {
        let state =
            state.cast::<State>().map_err(|_| PyTypeError::new_err("the state of a home is a goodbot.State, such as home.start"))?;
        if state.get().mark == self.mark { Ok(state.get().at) } else { Err(value("this state is one of another home")) }
    }

    fn check_numbered(&self) -> PyResult<()> {
        let refused =
            || value("this home has more states than 64 bits number, so its states have no numbers; a state itself is a key of a dict");
        if self.rooms.is_numbered() { Ok(()) } else { Err(refused()) }
    }

    /// A state of this home.
    pub const fn state(&self, at: HomeState) -> State {
        State { mark: self.mark, at }
    }

    fn object(&self, name: &str) -> PyResult<ObjectId> {
        self.rooms.objects().find(name).ok_or_else(|| value(format!("there is no object {name:?} in this home")))
    }
}

/// The exception for a flaw of a home, naming the object and its line.
fn flaw(py: Python<'_>, environment: &EnvironmentFile, error: &HomeFlaw, text: &str) -> PyErr {
    if let Problem::Capacity(error) = error.problem {
        return full(py, error);
    }
    let (position, message) = (error.object, error.message(environment));
    let line = position.and_then(|position| object_line(text, position)).unwrap_or(1);
    misformed(py, message, line, position.map(|position| format!("objects[{position}]")).as_deref())
}

/// For pickle: the function that makes a home again, and its arguments.
type Reduced<'py> = (Bound<'py, PyAny>, (String, bool, Bound<'py, PyDict>));

#[pymethods]
impl Home {
    /// A home from its JSON, as `docs/files.md` describes it. `pull=True` adds the action `pull`.
    ///
    /// Raises `FormatError` with the line and field at fault, and `CapacityError` where the home is larger than the capacities: the
    /// fields `objects`, `names`, `name_bytes` and `cells` of a dict, or a preset's name.
    #[staticmethod]
    #[pyo3(signature = (text, *, pull=false, capacities=None))]
    fn from_json(py: Python<'_>, text: &str, pull: bool, capacities: Option<&Bound<'_, PyAny>>) -> PyResult<Self> {
        let environment = EnvironmentFile::parse(text).map_err(|error| format(py, &error))?;
        Self::of(py, &environment, moves(pull), &capacities_of(capacities)?, text)
    }

    /// A home from a drawing: `#` wall, `+` door, `@` the agent, a small letter for a cell of a room, a capital for a block.
    ///
    /// Letters that are not the first of red, green, blue, yellow, purple, orange or tan need a line such as `C: blue chair` below.
    /// Raises `FormatError` with the line, and `CapacityError`.
    ///
    /// >>> goodbot.Home.from_map("####\n#r@#\n####").objects["room0"]["color"]
    /// 'red'
    #[staticmethod]
    #[pyo3(signature = (text, *, pull=false, capacities=None))]
    fn from_map(py: Python<'_>, text: &str, pull: bool, capacities: Option<&Bound<'_, PyAny>>) -> PyResult<Self> {
        let environment = map::parse(text).map_err(|error| misformed(py, &error, error.line, None))?;
        Self::of(py, &environment, moves(pull), &capacities_of(capacities)?, text)
    }

    /// A home at random: the same seed, the same home. `name` is one of the paper's homes, `A` to `F` or `Test`, whose blocks it has.
    /// Every command that the course gives there can be obeyed, and is not obeyed yet.
    ///
    /// >>> len(goodbot.Home.random(1).objects)
    /// 11
    #[staticmethod]
    #[pyo3(signature = (seed, name="Test"))]
    fn random(py: Python<'_>, seed: u64, name: &str) -> PyResult<Self> {
        let name = home_name(name)?;
        let layout = py.detach(|| Layout::random(name, &mut generator(seed), &mut HomeHeap::new(&Capacities::STANDARD)));
        Self::of_layout(&layout)
    }

    /// The state at the beginning.
    #[getter(start)]
    fn get_start(&self) -> State {
        self.state(self.start)
    }

    /// Whether the agent can pull blocks too.
    #[getter]
    fn pull(&self) -> bool {
        self.rooms.moves() == Moves::PushAndPull
    }

    /// The names of the actions, in order; `noop` is one everywhere and is not listed.
    ///
    /// >>> goodbot.Home.random(1).actions
    /// ('north', 'south', 'east', 'west')
    #[getter]
    fn actions<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyTuple>> {
        PyTuple::new(py, self.rooms.actions().iter().map(|kind| kind.name))
    }

    /// The most states that there can be: the number of each is below this.
    #[getter]
    fn state_count(&self) -> u64 {
        self.rooms.state_count()
    }

    /// The box of all rooms, walls included: left, bottom, right, top. Cells count x to the east and y to the north.
    #[getter]
    fn bounds(&self) -> (i32, i32, i32, i32) {
        let Area { left, bottom, right, top } = Map::new(&self.rooms, &self.start).bounds();
        (left, bottom, right, top)
    }

    /// The objects by their names: `class`, and `color`, `shape` and `box` (left, bottom, right, top) where they have them.
    #[getter]
    fn objects<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let all = PyDict::new(py);
        let objects = self.rooms.objects();
        for (id, object) in objects.iter() {
            let one = PyDict::new(py);
            one.set_item("class", SCHEMA.class_name(object.class))?;
            for (attribute, name) in [(COLOR, "color"), (SHAPE, "shape")] {
                let text = objects.value(id, attribute);
                if !text.is_empty() {
                    one.set_item(name, text)?;
                }
            }
            if matches!(object.class, ROOM | DOOR) {
                let Area { left, bottom, right, top } = self.rooms.area(id);
                one.set_item("box", (left, bottom, right, top))?;
            }
            all.set_item(objects.name(id), one)?;
        }
        Ok(all)
    }

    /// The state that an action leads to, or None where it cannot be done. Bumping into a wall can be done and changes nothing.
    ///
    /// >>> home = goodbot.Home.from_map("####\n#r@#\n####")
    /// >>> home.step(home.start, "north") == home.start
    /// True
    fn step(&self, py: Python<'_>, state: &Bound<'_, PyAny>, action: &str) -> PyResult<Py<PyAny>> {
        let next = apply(&self.rooms, &self.check(state)?, action_of(&self.rooms, action)?);
        Ok(next.map(|next| self.state(next)).into_pyobject(py)?.unbind())
    }

    /// Whether a proposition holds of these objects in a state: `agentInRoom`, `blockInRoom`, `agentInDoor` or `blockInDoor`.
    ///
    /// >>> home = goodbot.Home.from_map("####\n#r@#\n####")
    /// >>> home.holds("agentInRoom", ["agent0", "room0"], home.start)
    /// True
    fn holds(&self, proposition: &str, objects: Items<String>, state: &Bound<'_, PyAny>) -> PyResult<bool> {
        let at = self.check(state)?;
        let Some(known) = SCHEMA.proposition(proposition) else {
            let names: Vec<&str> = SCHEMA.propositions.iter().map(|known| known.name).collect();
            return Err(value(format!("{proposition:?} is no propositional function; known are {}", names.join(", "))));
        };
        if SCHEMA.parameters(known).len() != objects.0.len() {
            return Err(value(format!(
                "{proposition} takes {} objects, and {} are given",
                SCHEMA.parameters(known).len(),
                objects.0.len()
            )));
        }
        let ids = objects.0.iter().map(|name| self.object(name)).collect::<PyResult<Vec<_>>>()?;
        Ok(self.rooms.holds(&GroundProposition::new(known, &ids), &at))
    }

    /// The number of a state, from 0 and below `state_count`. In a home with more states than 64 bits number, states have none.
    fn number(&self, state: &Bound<'_, PyAny>) -> PyResult<u64> {
        let state = self.check(state)?;
        self.check_numbered()?;
        Ok(self.rooms.number(&state))
    }

    /// The state of a number that `number` returned.
    fn numbered(&self, number: u64) -> PyResult<State> {
        self.check_numbered()?;
        if number >= self.rooms.state_count() {
            return Err(value(format!("there is no state {number}; they count from 0 to {}", self.rooms.state_count() - 1)));
        }
        Ok(self.state(self.rooms.numbered(number)))
    }

    /// Where the agent and the blocks are, by their names: x and y.
    ///
    /// >>> home = goodbot.Home.from_map("####\n#r@#\n####")
    /// >>> home.cells(home.start)
    /// {'agent0': (2, 1)}
    fn cells<'py>(&self, py: Python<'py>, state: &Bound<'_, PyAny>) -> PyResult<Bound<'py, PyDict>> {
        let at = self.check(state)?;
        let cells = PyDict::new(py);
        let Cell { x, y } = self.rooms.agent_cell(&at);
        cells.set_item(self.rooms.objects().name(self.rooms.agent()), (x, y))?;
        for &block in self.rooms.blocks() {
            if let Some(Cell { x, y }) = self.rooms.block_cell(&at, block) {
                cells.set_item(self.rooms.objects().name(block), (x, y))?;
            }
        }
        Ok(cells)
    }

    /// The state in which the named things are on these cells, all at once; the others stay. For a robot that senses where things are.
    ///
    /// Raises `ValueError` where a cell is wall, or two things would be on one.
    fn placed(&self, state: &Bound<'_, PyAny>, cells: &Bound<'_, PyDict>) -> PyResult<State> {
        let at = self.check(state)?;
        let mut things = Vec::new();
        for (name, cell) in cells {
            let (x, y) = cell.extract()?;
            things.push((self.object(name.extract()?)?, Cell::new(x, y)));
        }
        let placed = self.rooms.placed(&at, &things);
        placed.map(|at| self.state(at)).ok_or_else(|| {
            value("this cannot be: a cell is wall, two things would be on one cell, or an object is neither the agent nor a block")
        })
    }

    /// The home drawn as text, in a state or at the start; north is up.
    #[pyo3(signature = (state=None))]
    fn map(&self, state: Option<&Bound<'_, PyAny>>) -> PyResult<String> {
        let at = state.map_or(Ok(self.start), |state| self.check(state))?;
        Ok(Map::new(&self.rooms, &at).to_string())
    }

    /// The home as JSON, with all things at their places in a state, or at the start.
    #[pyo3(signature = (state=None))]
    fn to_json(&self, state: Option<&Bound<'_, PyAny>>) -> PyResult<String> {
        let at = state.map_or(Ok(self.start), |state| self.check(state))?;
        Ok(environment(&self.rooms, &at).to_json_line())
    }

    /// The names of the tasks that do not hold in a state yet, of the paper's two kinds or of those given.
    ///
    /// >>> goodbot.Home.from_map("#####\n#r@r#\n##+##\n#ggg#\n#####").tasks()
    /// ['agentInRoom(agent0,room0)']
    #[pyo3(signature = (state=None, kinds=None))]
    fn tasks(&self, py: Python<'_>, state: Option<&Bound<'_, PyAny>>, kinds: Option<Items<String>>) -> PyResult<Vec<String>> {
        let at = state.map_or(Ok(self.start), |state| self.check(state))?;
        let lifted = crate::options::kinds_of_tasks(py, kinds.map(|kinds| kinds.0), &SCHEMA)?.lifted;
        names_of_tasks(py, &self.rooms, &lifted, &at)
    }

    fn __repr__(&self) -> String {
        let used = self.rooms.usage();
        let names = |class| {
            let objects = self.rooms.objects();
            objects
                .iter()
                .filter(|(_, object)| object.class == class)
                .map(|(id, _)| objects.value(id, COLOR).to_owned())
                .collect::<Vec<_>>()
        };
        let (cells, blocks) = (used.get(Capacity::Cells), self.rooms.blocks().len());
        format!("<goodbot.Home: {} rooms and {blocks} blocks on {cells} cells>", names(ROOM).join(", "))
    }

    fn __reduce__<'py>(slf: &Bound<'py, Self>) -> PyResult<Reduced<'py>> {
        let Self { rooms, start, .. } = slf.get();
        let restore = slf.get_type().getattr("_restored")?;
        Ok((restore, (environment(rooms, start).to_json_line(), slf.get().pull(), as_dict(slf.py(), &rooms.usage())?)))
    }

    #[staticmethod]
    fn _restored(py: Python<'_>, text: &str, pull: bool, capacities: &Bound<'_, PyAny>) -> PyResult<Self> {
        Self::from_json(py, text, pull, Some(capacities))
    }
}
