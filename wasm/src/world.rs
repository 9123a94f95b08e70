//! The home, the robot's mind and the session under way.

use crate::route::{Lookahead, Scout};
use crate::starter::Starter;
use crate::view::{Extent, Place, Scene, Thing};
use goodbot::feedback::{Strategy, population};
use goodbot::home::{self, Area, BLOCK, COLOR, DOOR, Home, HomeState, Map, Moves, ROOM, SHAPE};
use goodbot::memory::{AgentHeap, HomeHeap, HomeMemory};
use goodbot::oomdp::ObjectId;
use goodbot::snapshot::{Contents, Part, RestoreError};
use goodbot::task::{GroundedTask, LiftedTask};
use goodbot::{Agent, Capacities, Options};
use goodbot_formats::environment::EnvironmentFile;
use goodbot_lesson::home::HomeFlaw;
use goodbot_lesson::live::Lesson;
use goodbot_lesson::replay::{Replay, expect_ends};
use goodbot_lesson::walk::Walk;
use rand_pcg::Pcg32;
use std::fmt;
use wasm_bindgen::prelude::*;

/// Why something was refused, in words for the person at the page.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{0}")]
pub struct Refusal(pub String);

impl Refusal {
    pub(crate) fn from(error: impl fmt::Display) -> Self {
        Self(error.to_string())
    }
}

/// The page starts with a robot in a home of one room.
const FIRST_HOME: &str = r#"{"version":1,"objects":[{"class":"room","name":"room0","left":0,"bottom":0,"right":4,"top":4,"color":"red"},{"class":"agent","name":"agent0","x":2,"y":2}]}"#;

/// One home, one robot, and the session under way.
#[wasm_bindgen(js_name = Goodbot)]
pub struct World {
    pub(crate) lesson: Lesson,
    pub(crate) scout: Scout,
    pub(crate) file: EnvironmentFile,
    pub(crate) moves: Moves,
    pub(crate) start: HomeState,
    /// How many older sessions this robot has forgotten for new ones.
    pub(crate) gave_way: usize,
    pub(crate) ahead: Option<Lookahead>,
    pub(crate) random: Pcg32,
    pub(crate) replaying: Option<Replaying>,
    pub(crate) starter: Starter,
}

/// A recorded session that is handed over in parts, and then replayed.
#[derive(Debug)]
pub(crate) struct Replaying {
    pub(crate) replay: Replay,
    pub(crate) walk: Walk<Home<HomeHeap>>,
    /// The state after the last step.
    pub(crate) end: HomeState,
    pub(crate) environment: EnvironmentFile,
    /// The tasks here, each with its name.
    pub(crate) tasks: Vec<(GroundedTask, String)>,
}

impl fmt::Debug for World {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("World").field("file", &self.file).finish_non_exhaustive()
    }
}

/// A mind that has learned nothing yet, and expects the feedback of real people. `ways` says whether commands may mean tasks with a way.
fn new_mind(capacities: &Capacities, ways: bool) -> Result<Agent<AgentHeap>, Refusal> {
    let mut mind = plain_mind(capacities, ways)?;
    mind.set_strategies(&population::STRATEGIES).map_err(Refusal::from)?;
    expect_ends(&mut mind).map_err(Refusal::from)?;
    Ok(mind)
}

/// A mind that has learned nothing yet, and expects the paper's trainer.
fn plain_mind(capacities: &Capacities, ways: bool) -> Result<Agent<AgentHeap>, Refusal> {
    let paper = home::paper_tasks().map_err(Refusal::from)?;
    let with_routes = if ways { Some(home::with_routes(&paper).map_err(Refusal::from)?) } else { None };
    let lifted = with_routes.as_deref().unwrap_or(&paper);
    Agent::new(AgentHeap::new(capacities), lifted, Options::DEFAULT).map_err(Refusal::from)
}

/// Builds the home of a file. The message of a refusal names the object.
pub(crate) fn build(file: &EnvironmentFile, moves: Moves, room: &Capacities) -> Result<(Home<HomeHeap>, HomeState), Refusal> {
    goodbot_lesson::home::build(file, moves, HomeHeap::new(room)).map_err(|HomeFlaw { object, problem }| {
        let object = object.and_then(|at| file.objects.get(at));
        Refusal(object.map_or_else(|| problem.to_string(), |object| format!("{}: {problem}", object.name())))
    })
}

/// A mind restored from a model file, which is still to be trained.
fn taught(bytes: &[u8], ways: bool) -> Result<Agent<AgentHeap>, Refusal> {
    let contents = Contents::read(bytes).map_err(|error| match error {
        // The model is sound, but the page does not have its learner.
        RestoreError::Inconsistent(Part::Options) => {
            Refusal("this model learned by Model 2, and the page has only the role model; learn it anew with --learner roles".to_owned())
        }
        error => Refusal::from(error),
    })?;
    // The page's own capacities, or more for a model from another machine that needs more.
    let mut mind = new_mind(&contents.room(MIND, MOST_OF_A_FIELD), ways)?;
    mind.restore(bytes).map_err(Refusal::from)?;
    Ok(mind)
}

/// Says why an environment cannot be used, if it cannot.
///
/// # Errors
/// The reason.
pub fn check(json: &str) -> Result<(), Refusal> {
    build(&EnvironmentFile::parse(json).map_err(Refusal::from)?, Moves::Push, &ROOMS).map(|_| ())
}

impl World {
    /// A robot that has learned nothing yet. `seed` decides its draws among actions that are equally good.
    ///
    /// # Errors
    /// None where the built-in home is sound.
    pub fn new(seed: u64) -> Result<Self, Refusal> {
        let file = EnvironmentFile::parse(FIRST_HOME).map_err(Refusal::from)?;
        let moves = Moves::Push;
        let (rooms, start) = build(&file, moves, &ROOMS)?;
        Ok(Self {
            lesson: Lesson::new(new_mind(&MIND, false)?, rooms, start),
            scout: Scout::default(),
            file,
            moves,
            start,
            gave_way: 0,
            ahead: None,
            random: Pcg32::new(seed, 1),
            replaying: None,
            starter: Starter::default(),
        })
    }

    /// Replaces the mind by one that has only its own sessions.
    fn take(&mut self, mut mind: Agent<AgentHeap>) {
        self.starter.join(&mut mind);
        self.forget();
        self.lesson.replace_agent(mind);
    }

    /// The home.
    pub(crate) fn home(&self) -> &Home<HomeHeap> {
        self.lesson.home()
    }

    /// The robot's mind.
    pub fn agent(&self) -> &Agent<AgentHeap> {
        &self.lesson.agent
    }

    /// The environment in its current state.
    pub fn environment_now(&self) -> EnvironmentFile {
        self.lesson.environment()
    }

    /// The home as it is now.
    pub fn scene(&self) -> Scene {
        let home = self.home();
        let map = Map::new(home, self.lesson.state());
        let places = |class| home.objects().of_class(class).map(|id| place(home, id)).collect();
        Scene {
            bounds: extent(map.bounds()),
            rooms: places(ROOM),
            doors: places(DOOR),
            blocks: home.objects().of_class(BLOCK).map(|id| thing(home, self.lesson.state(), id)).collect(),
            agent: thing(home, self.lesson.state(), home.agent()),
            map: map.to_string(),
        }
    }
}

#[wasm_bindgen(js_class = "Goodbot")]
impl World {
    /// Moves the robot to another home. A session under way ends unlearned.
    ///
    /// # Errors
    /// Why the home cannot be used; the old one then stays.
    #[wasm_bindgen(js_name = setEnvironment)]
    pub fn set_environment(&mut self, json: &str) -> Result<(), Refusal> {
        let file = EnvironmentFile::parse(json).map_err(Refusal::from)?;
        let (rooms, start) = build(&file, self.moves, &ROOMS)?;
        self.forget();
        self.lesson.enter(rooms, start);
        (self.file, self.start) = (file, start);
        Ok(())
    }

    /// Sets whether the robot can pull blocks too. Puts everything back; a session under way ends unlearned.
    ///
    /// # Errors
    /// None: a home is one with either kind of moves.
    #[wasm_bindgen(js_name = setPulls)]
    pub fn set_pulls(&mut self, pulls: bool) -> Result<(), Refusal> {
        let moves = if pulls { Moves::PushAndPull } else { Moves::Push };
        let (rooms, start) = build(&self.file, moves, &ROOMS)?;
        self.forget();
        self.lesson.enter(rooms, start);
        (self.moves, self.start) = (moves, start);
        Ok(())
    }

    /// Whether the robot can pull blocks too.
    pub fn pulls(&self) -> bool {
        self.moves == Moves::PushAndPull
    }

    /// The home as it was entered, as JSON.
    pub fn environment(&self) -> String {
        crate::log::json(&self.file)
    }

    /// Puts everything back to where it was when the home was entered. A session under way ends unlearned.
    pub fn reset(&mut self) {
        self.forget();
        self.lesson.put(self.start);
    }

    /// A new robot in the same home. It has learned nothing, has no starter, and expects the trainer strategies that the one before expected.
    ///
    /// # Errors
    /// None where the built-in strategies are sound.
    pub fn restart(&mut self) -> Result<(), Refusal> {
        let expected = self.expected();
        self.lesson.replace_agent(new_mind(&MIND, self.ways())?);
        self.lesson.put(self.start);
        self.gave_way = 0;
        self.starter = Starter::default();
        expected.map_or(Ok(()), |strategies| self.set_strategies(&strategies))
    }

    /// The robot's model, as the bytes of a model file, without its starter.
    ///
    /// # Errors
    /// Where it is still learning.
    pub fn save(&self) -> Result<Vec<u8>, Refusal> {
        let mut bytes = self.lesson.agent.saved().map_err(Refusal::from)?;
        if self.starter.places.count() > 0 {
            let mut mind = taught(&bytes, self.ways())?;
            self.starter.places.clone().leave(&mut mind);
            bytes = mind.saved().map_err(Refusal::from)?;
        }
        Ok(bytes)
    }

    /// Replaces the robot's model by a model file, and begins to train it: call [`learn`](Self::learn) until it is done. A session under
    /// way ends unlearned.
    ///
    /// # Errors
    /// Why the file cannot be used; the old model then stays.
    pub fn restore(&mut self, bytes: &[u8]) -> Result<(), Refusal> {
        self.take(taught(bytes, self.ways())?);
        Ok(())
    }

    /// Adds the lessons of another robot's model file, and begins to train: call [`learn`](Self::learn) until it is done. Returns the number
    /// of lessons that were not known. A session under way ends unlearned.
    ///
    /// # Errors
    /// Why the file cannot be used; the training data are then unchanged.
    pub fn join(&mut self, bytes: &[u8]) -> Result<usize, Refusal> {
        self.forget();
        let Self { starter, lesson, .. } = self;
        starter.places.leave(&mut lesson.agent);
        let joined = lesson.agent.join(bytes);
        starter.join(&mut lesson.agent);
        joined.map_err(Refusal::from)
    }

    /// Whether a micro:bit has room for the home.
    #[wasm_bindgen(js_name = fitsMicrobit)]
    pub fn fits_microbit(&self) -> bool {
        build(&self.file, Moves::Push, &Capacities::TINY).is_ok()
    }

    /// The robot's model, as the bytes of a model file for a micro:bit: there it expects the paper's balanced trainer.
    ///
    /// # Errors
    /// Where a micro:bit has no room for it, or cannot use it.
    #[wasm_bindgen(js_name = forMicrobit)]
    pub fn for_microbit(&self) -> Result<Vec<u8>, Refusal> {
        let mut bytes = self.save()?;
        if !matches!(self.lesson.agent.belief().strategies(), [(Strategy::BALANCED, _)]) {
            let mut mind = taught(&bytes, self.ways())?;
            mind.set_strategies(&[(Strategy::BALANCED, 1.0)]).map_err(Refusal::from)?;
            bytes = mind.saved().map_err(Refusal::from)?;
        }
        plain_mind(&Capacities::TINY, false)?.restore(&bytes).map_err(Refusal::from)?;
        Ok(bytes)
    }

    /// Sets whether commands may mean tasks with a way too: through a room, through one of two, avoiding one. The robot keeps its training
    /// data, and begins to train anew: call [`learn`](Self::learn) until it is done. A session under way ends unlearned.
    ///
    /// # Errors
    /// Where it is still learning.
    #[wasm_bindgen(js_name = setWays)]
    pub fn set_ways(&mut self, ways: bool) -> Result<(), Refusal> {
        if ways == self.ways() {
            self.forget();
            return Ok(());
        }
        self.take(taught(&self.save()?, ways)?);
        Ok(())
    }

    /// Whether commands may mean tasks with a way too.
    pub fn ways(&self) -> bool {
        self.lesson.agent.lifted().iter().any(LiftedTask::has_way)
    }
}

const fn extent(area: Area) -> Extent {
    Extent { left: area.left, bottom: area.bottom, right: area.right, top: area.top }
}

fn place(home: &Home<impl HomeMemory>, id: ObjectId) -> Place {
    let objects = home.objects();
    Place { name: objects.name(id).to_owned(), extent: extent(home.area(id)), color: objects.value(id, COLOR).to_owned() }
}

pub(crate) fn thing(home: &Home<impl HomeMemory>, state: &HomeState, id: ObjectId) -> Thing {
    let objects = home.objects();
    let cell = home.block_cell(state, id).unwrap_or_else(|| home.agent_cell(state));
    let (color, shape) = (objects.value(id, COLOR).to_owned(), objects.value(id, SHAPE).to_owned());
    Thing { name: objects.name(id).to_owned(), x: cell.x, y: cell.y, color, shape }
}

/// The robot's mind: the preset for hosts.
pub const MIND: Capacities = Capacities::STANDARD;

/// The most entries that a model file from elsewhere may demand for a table of the mind.
pub const MOST_OF_A_FIELD: usize = 1 << 22;

/// A home alone.
pub const ROOMS: Capacities = Capacities::STANDARD;

/// The scout: smaller than the mind, because the page can do without looking ahead.
pub const SCOUT: Capacities = Capacities { tasks: 64, ground_propositions: 64, goal_entries: 8_192, states: 1 << 18, ..Capacities::NONE };
