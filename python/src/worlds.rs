//! Many homes at once, for reinforcement learning: one call steps them all, without the interpreter.
//!
//! A world is a home with a command. It ends when the command's task holds, or after a number of steps. The next step then begins another
//! world, drawn from those given.

use crate::error::value;
use crate::home::{Home, State};
use crate::options::{Items, task_name};
use goodbot::home::{self, Area, COLOR, Cell, DOOR, HomeState, Map, ROOM, SHAPE};
use goodbot::oomdp::{Action, Domain, GroundProposition, apply};
use goodbot::random::below;
use pyo3::prelude::*;
use pyo3::types::PyBytes;
use rand_pcg::Pcg32;
use std::sync::{Mutex, MutexGuard, PoisonError};

/// Numbers of one cell: its kind, its colour, the thing there, and that thing's colour.
const CHANNELS: usize = 4;
const COLORS: [&str; 10] = ["red", "green", "blue", "yellow", "purple", "orange", "tan", "teal", "magenta", "star"];
const SHAPES: [&str; 4] = ["chair", "bag", "backpack", "basket"];
const WALL: u8 = 1;
const FLOOR: u8 = 2;
const DOORWAY: u8 = 3;
const AGENT: u8 = 1;

/// A command, the task that it means, and the task's propositions.
#[derive(Debug)]
struct Mission {
    command: String,
    task: String,
    parts: Vec<GroundProposition>,
}

/// A home that worlds are made of.
#[derive(Debug)]
struct Site {
    home: Py<Home>,
    missions: Vec<Mission>,
    /// The image without agent and blocks.
    bare: Vec<u8>,
    bounds: Area,
    /// The number of each block in an image.
    blocks: Vec<[u8; 2]>,
}

/// One world.
#[derive(Clone, Copy, Debug)]
struct World {
    site: usize,
    mission: usize,
    state: HomeState,
    steps: u32,
    ended: bool,
}

#[derive(Debug)]
struct Inner {
    sites: Vec<Site>,
    worlds: Vec<World>,
    random: Pcg32,
    size: usize,
    most_steps: u32,
}

/// Many worlds that are stepped together. `places` are homes, each with its commands and the names of the tasks that they mean.
///
/// Images have a row for each row of cells, north first, and for each cell its kind (0 outside, 1 wall, 2 floor, 3 door), its colour,
/// the thing there (0 nothing, 1 the agent, from 2 on blocks by their shape), and that thing's colour; uint8, shape (size, size, 4).
///
/// >>> home = goodbot.Home.from_map("#####\n#r@r#\n##+##\n#ggg#\n#####")
/// >>> worlds = goodbot.Worlds(2, [(home, [("go to the green room", "agentInRoom(agent0,room0)")])])
/// >>> worlds.size, worlds.commands()
/// (5, ['go to the green room', 'go to the green room'])
/// >>> for _ in range(2):
/// ...     image, rewards, terminated, truncated = worlds.step(bytes([1, 4]))
/// >>> list(terminated)
/// [1, 0]
#[pyclass(frozen, module = "goodbot")]
#[derive(Debug)]
pub struct Worlds(Mutex<Inner>);

fn index(names: &[&str], name: &str, first: u8) -> u8 {
    let position = names.iter().position(|&known| known == name).unwrap_or(names.len());
    first + position as u8
}

fn color(name: &str) -> u8 {
    if name.is_empty() { 0 } else { index(&COLORS, name, 1) }
}

impl Site {
    fn new(py: Python<'_>, home: Py<Home>, commands: Items<(String, String)>, size: usize) -> PyResult<Self> {
        let Home { rooms, start, .. } = home.get();
        let bounds = Map::new(rooms, start).bounds();
        let objects = rooms.objects();
        let mut bare = vec![0; size * size * CHANNELS];
        let mut put = |cell: Cell, numbers: [u8; 2]| {
            if let Some(at) = place(&bounds, size, cell) {
                bare[at..at + 2].copy_from_slice(&numbers);
            }
        };
        for id in objects.of_class(ROOM) {
            let area = rooms.area(id);
            for (x, y) in (area.left..=area.right).flat_map(|x| (area.bottom..=area.top).map(move |y| (x, y))) {
                put(Cell::new(x, y), [WALL, 0]);
            }
        }
        for free in rooms.places() {
            let inside = |class| objects.of_class(class).find(|&id| rooms.area(id).holds(free.cell()));
            let room = objects.of_class(ROOM).find(|&id| rooms.area(id).holds_strictly(free.cell()));
            match room {
                Some(room) => put(free.cell(), [FLOOR, color(objects.value(room, COLOR))]),
                None if inside(DOOR).is_some() => put(free.cell(), [DOORWAY, 0]),
                None => put(free.cell(), [FLOOR, 0]),
            }
        }
        let look = |&block| [index(&SHAPES, objects.value(block, SHAPE), AGENT + 1), color(objects.value(block, COLOR))];
        let blocks = rooms.blocks().iter().map(look).collect();
        let missions = missions(py, home.get(), commands.0)?;
        Ok(Self { missions, bare, bounds, blocks, home })
    }

    /// Draws the home in a state.
    fn draw(&self, state: &HomeState, image: &mut [u8], size: usize) {
        image.copy_from_slice(&self.bare);
        let rooms = &self.home.get().rooms;
        let mut put = |cell: Cell, numbers: [u8; 2]| {
            if let Some(at) = place(&self.bounds, size, cell) {
                image[at + 2..at + CHANNELS].copy_from_slice(&numbers);
            }
        };
        for (&block, &look) in rooms.blocks().iter().zip(&self.blocks) {
            if let Some(cell) = rooms.block_cell(state, block) {
                put(cell, look);
            }
        }
        put(rooms.agent_cell(state), [AGENT, 0]);
    }
}

/// Where a cell begins in an image.
fn place(bounds: &Area, size: usize, cell: Cell) -> Option<usize> {
    let column = usize::try_from(cell.x - bounds.left).ok().filter(|&column| column < size)?;
    let row = usize::try_from(bounds.top - cell.y).ok().filter(|&row| row < size)?;
    Some((row * size + column) * CHANNELS)
}

fn missions(py: Python<'_>, home: &Home, commands: Vec<(String, String)>) -> PyResult<Vec<Mission>> {
    let Home { rooms, start, .. } = home;
    // The paper's kinds, and the agent and a block at once.
    let mut lifted = home::paper_tasks().map_err(value)?.to_vec();
    lifted.extend(
        crate::options::kinds_of_tasks(py, Some(vec!["agentInRoom(?a,?r1) & blockInRoom(?o,?r2)".to_owned()]), &home::SCHEMA)?.lifted,
    );
    let tasks = crate::home::tasks(rooms, &lifted, start).map_err(|error| crate::error::full(py, error))?;
    let find = |(command, name): (String, String)| {
        let found = tasks.iter().find_map(|task| {
            let lifted = lifted.get(usize::from(task.lifted))?;
            (task_name(rooms, lifted, task) == name).then(|| task.propositions(lifted).collect())
        });
        let parts = found.ok_or_else(|| value(format!("{name} is no task here, or holds already")))?;
        Ok(Mission { command, task: name, parts })
    };
    let missions = commands.into_iter().map(find).collect::<PyResult<Vec<_>>>()?;
    if missions.is_empty() { Err(value("a home without commands is no place for a world; give it one")) } else { Ok(missions) }
}

impl Inner {
    /// A new world, at random.
    fn begun(&mut self) -> World {
        let site = below(self.sites.len(), &mut self.random);
        let mission = below(self.sites[site].missions.len(), &mut self.random);
        World { site, mission, state: self.sites[site].home.get().start, steps: 0, ended: false }
    }

    fn begin_all(&mut self) {
        for at in 0..self.worlds.len() {
            self.worlds[at] = self.begun();
        }
    }

    /// Steps one world. Returns the reward, and whether it was terminated and truncated.
    fn step(&mut self, at: usize, action: u8) -> (f32, bool, bool) {
        let world = self.worlds[at];
        if world.ended {
            self.worlds[at] = self.begun();
            return (0.0, false, false);
        }
        let site = &self.sites[world.site];
        let rooms = &site.home.get().rooms;
        let action = if usize::from(action) < rooms.actions().len() { Action::new(action) } else { Action::NOOP };
        let state = apply(rooms, &world.state, action).unwrap_or(world.state);
        let steps = world.steps + 1;
        let terminated = site.missions[world.mission].parts.iter().all(|part| rooms.holds(part, &state));
        // A mission that is done in the last step is both, as Gymnasium has it for a single home.
        let truncated = steps >= self.most_steps;
        self.worlds[at] = World { state, steps, ended: terminated || truncated, ..world };
        (f32::from(u8::from(terminated)), terminated, truncated)
    }

    fn draw(&self, images: &mut [u8]) {
        let bytes = self.size * self.size * CHANNELS;
        for (world, image) in self.worlds.iter().zip(images.chunks_exact_mut(bytes)) {
            self.sites[world.site].draw(&world.state, image, self.size);
        }
    }
}

impl Worlds {
    fn inner(&self) -> MutexGuard<'_, Inner> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Takes the lock without holding the interpreter: a thread that holds the lock may wait for the interpreter.
    fn detached<T: Send>(&self, py: Python<'_>, run: impl FnOnce(&mut Inner) -> T + Send) -> T {
        py.detach(|| run(&mut self.inner()))
    }

    fn of<T>(&self, world: usize, tell: impl FnOnce(&Inner, &World) -> T) -> PyResult<T> {
        let inner = self.inner();
        let found = inner.worlds.get(world).ok_or_else(|| value(format!("there is no world {world}; there are {}", inner.worlds.len())))?;
        Ok(tell(&inner, found))
    }
}

/// Images, rewards, terminated and truncated, as bytes.
type Stepped<'py> = (Bound<'py, PyBytes>, Bound<'py, PyBytes>, Bound<'py, PyBytes>, Bound<'py, PyBytes>);

type Places = Items<(Py<Home>, Items<(String, String)>)>;

#[pymethods]
impl Worlds {
    #[new]
    #[pyo3(signature = (count, places, *, max_steps=300, seed=0, size=None))]
    fn new(py: Python<'_>, count: usize, places: Places, max_steps: u32, seed: u64, size: Option<usize>) -> PyResult<Self> {
        const MOST: usize = 1 << 20;
        if count == 0 || count > MOST || places.0.is_empty() || max_steps == 0 {
            return Err(value(format!("give 1 to {MOST} worlds, at least one place and at least one step")));
        }
        let least = places.0.iter().map(|(home, _)| {
            let Area { left, bottom, right, top } = Map::new(&home.get().rooms, &home.get().start).bounds();
            usize::try_from((right - left).max(top - bottom) + 1).unwrap_or(0)
        });
        let least = least.max().unwrap_or(0);
        let size = size.unwrap_or(least);
        if size < least || size > 1 << 10 {
            return Err(value(format!("size is {size}, and the largest home has {least} cells on a side; give it room")));
        }
        let sites = places.0.into_iter().map(|(home, commands)| Site::new(py, home, commands, size)).collect::<PyResult<Vec<_>>>()?;
        let mut inner = Inner { sites, worlds: Vec::new(), random: goodbot_course::generator(seed), size, most_steps: max_steps };
        inner.worlds = (0..count).map(|_| inner.begun()).collect();
        Ok(Self(Mutex::new(inner)))
    }

    /// Begins all worlds anew, with the seed or going on with the draws, and returns their images: uint8 (count, size, size, 4), as bytes.
    #[pyo3(signature = (seed=None))]
    fn reset<'py>(&self, py: Python<'py>, seed: Option<u64>) -> PyResult<Bound<'py, PyBytes>> {
        self.detached(py, |inner| {
            if let Some(seed) = seed {
                inner.random = goodbot_course::generator(seed);
            }
            inner.begin_all();
        });
        self.image(py)
    }

    /// Does an action in each world: one byte each, the position of the action; a greater position is `noop`. A world that has ended
    /// begins anew instead. Returns images, rewards (float32), terminated and truncated (bool), as bytes.
    fn step<'py>(&self, py: Python<'py>, actions: &[u8]) -> PyResult<Stepped<'py>> {
        let count = self.inner().worlds.len();
        if actions.len() != count {
            return Err(value(format!("{} actions are given for {count} worlds", actions.len())));
        }
        let (rewards, terminated, truncated) = self.detached(py, |inner| {
            let (mut rewards, mut terminated, mut truncated) =
                (Vec::with_capacity(count * 4), Vec::with_capacity(count), Vec::with_capacity(count));
            for (at, &action) in actions.iter().enumerate() {
                let (reward, ended, cut) = inner.step(at, action);
                rewards.extend_from_slice(&reward.to_ne_bytes());
                terminated.push(u8::from(ended));
                truncated.push(u8::from(cut));
            }
            (rewards, terminated, truncated)
        });
        Ok((self.image(py)?, PyBytes::new(py, &rewards), PyBytes::new(py, &terminated), PyBytes::new(py, &truncated)))
    }

    /// The images of all worlds as they are.
    fn image<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyBytes>> {
        let inner = self.inner();
        PyBytes::new_with(py, inner.worlds.len() * inner.size * inner.size * CHANNELS, |images| {
            inner.draw(images);
            Ok(())
        })
    }

    /// The commands of all worlds.
    fn commands(&self) -> Vec<String> {
        let inner = self.inner();
        inner.worlds.iter().map(|world| inner.sites[world.site].missions[world.mission].command.clone()).collect()
    }

    /// The command of one world.
    fn command(&self, world: usize) -> PyResult<String> {
        self.of(world, |inner, world| inner.sites[world.site].missions[world.mission].command.clone())
    }

    /// The name of the task that the command of one world means.
    fn intended(&self, world: usize) -> PyResult<String> {
        self.of(world, |inner, world| inner.sites[world.site].missions[world.mission].task.clone())
    }

    /// The home of one world.
    fn home(&self, py: Python<'_>, world: usize) -> PyResult<Py<Home>> {
        self.of(world, |inner, world| inner.sites[world.site].home.clone_ref(py))
    }

    /// The state of one world.
    fn state(&self, world: usize) -> PyResult<State> {
        self.of(world, |inner, world| inner.sites[world.site].home.get().state(world.state))
    }

    fn __repr__(&self) -> String {
        let inner = self.inner();
        format!("<goodbot.Worlds: {} worlds of {} homes, images of {} cells a side>", inner.worlds.len(), inner.sites.len(), inner.size)
    }

    /// How many worlds there are.
    fn __len__(&self) -> usize {
        self.inner().worlds.len()
    }

    /// How many cells an image has on a side.
    #[getter]
    fn size(&self) -> usize {
        self.inner().size
    }
}
