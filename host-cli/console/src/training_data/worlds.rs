//! Commands and sessions in worlds from files, as training data.

use super::evidence::Witness;
use super::{Lesson, Reading, place, told_pairs};
use crate::typed::Believes;
use goodbot::Options;
use goodbot::language::Model;
use goodbot::task::Marker;
use goodbot_formats::session::{Kind, RecordedSession, SessionHeader};
use goodbot_formats::task_text::{GroundAtomText, GroundTaskText};
use goodbot_formats::world::{CommandRecord, Line, SessionInWorld, WorldFile, WorldReader};
use goodbot_lesson::Fault;
use goodbot_lesson::fault::quoted;
use goodbot_lesson::first_words::{self, too_long};
use goodbot_lesson::world::before::{self, Step};
use goodbot_lesson::world::robot::{self, Robot, Tables, WorldFlaw};
use goodbot_lesson::world::{TooMany, meanings, numbers};
use std::collections::hash_map::Entry;
use std::collections::{BTreeMap, HashMap};
use std::io::BufRead;
use std::sync::Arc;

/// A state of a world without a robot: its tasks, and the position of each.
struct Scene {
    readings: Arc<[Reading]>,
    numbers: Arc<BTreeMap<String, String>>,
    positions: HashMap<Vec<GroundAtomText>, usize>,
}

/// A world of a log.
enum LoggedWorld {
    /// A world without a robot, with the scenes of its commands by their [`place`].
    Told(Arc<WorldFile>, HashMap<String, Scene>),
    /// A world with a robot.
    Acted(Arc<WorldFile>, Robot<'static>, Box<Witness>),
}

/// The worlds of a log.
struct Worlds<'b> {
    options: Options,
    believes: Option<&'b Believes>,
    worlds: HashMap<String, LoggedWorld>,
    /// For each named command: the steps of its conversation up to it.
    conversations: HashMap<String, Vec<Arc<Step>>>,
}

/// Reads a log of worlds, and passes each lesson or fault to `take`; `None` is a command whose meaning is no task. `believes` replaces the
/// trainer strategies that the sessions name. At most `left` commands and sessions are
/// read.
///
/// # Errors
/// The errors of `take`.
pub fn read<E>(
    file: &str,
    log: impl BufRead,
    options: Options,
    believes: Option<&Believes>,
    left: &mut usize,
    mut take: impl FnMut(Result<Option<Lesson>, Fault>) -> Result<(), E>,
) -> Result<(), E> {
    let mut known = Worlds { options, believes, worlds: HashMap::new(), conversations: HashMap::new() };
    let mut lines = WorldReader::new(log);
    while let Some(line) = lines.next() {
        if *left == 0 {
            break;
        }
        *left -= usize::from(!matches!(line, Ok(Line::World(_))));
        match line {
            Err(error) => take(Err(Fault::from_format(file, error)))?,
            Ok(Line::World(world)) => {
                if let Err(fault) = known.meet(file, &world) {
                    take(Err(Fault { line: Some(lines.began()), ..fault }))?;
                }
            }
            Ok(Line::Command(command)) => take(known.command(file, &command))?,
            Ok(Line::Session(session)) => match known.session(file, &session) {
                Ok(lesson) => take(Ok(Some(lesson)))?,
                Err(faults) => faults.into_iter().try_for_each(|fault| take(Err(fault)))?,
            },
        }
    }
    Ok(())
}

/// A question in a world without actions: a lesson for a command without its meaning.
///
/// # Errors
/// The fault of the world or of the command.
pub fn question(file: &str, world: &WorldFile, command: &str, options: Options) -> Result<Lesson, Fault> {
    let asked = CommandRecord { line: 1, world: world.name.clone(), command: command.to_owned(), ..CommandRecord::default() };
    let readings = readings(world, &world.facts, &[], options.language.model);
    let readings: Arc<[Reading]> = readings.map_err(|error| Fault::new(file, error).in_field("task_kinds"))?.into();
    let read = first_words::read(command).map_err(|error| Fault::new(file, too_long(error)).in_field("command"))?;
    let long = read.long().map(|long| Fault::new(file, long).in_field("command"));
    Ok(Lesson { long, ..Lesson::told(String::new(), place(world, &world.facts), &read, header(&asked), readings) })
}

impl Worlds<'_> {
    /// Adds a world. The same world again changes nothing; another of the same name replaces it.
    fn meet(&mut self, file: &str, world: &Arc<WorldFile>) -> Result<(), Fault> {
        let (LoggedWorld::Told(same, _) | LoggedWorld::Acted(same, ..)) = match self.worlds.get(&world.name) {
            Some(known) => known,
            None => return self.meet_anew(file, world),
        };
        if same == world { Ok(()) } else { self.meet_anew(file, world) }
    }

    fn meet_anew(&mut self, file: &str, world: &Arc<WorldFile>) -> Result<(), Fault> {
        // If the new world is at fault, its commands and sessions are skipped without further errors.
        self.worlds.remove(&world.name);
        let known = if world.actions.is_empty() {
            LoggedWorld::Told(Arc::clone(world), HashMap::new())
        } else {
            let fault = |flaw: WorldFlaw| Fault::new(file, format!("world {}: {}", quoted(&world.name), flaw.message)).in_field(flaw.field);
            let robot = Tables::of(Arc::clone(world)).map_err(fault)?.keep();
            let lifted = robot::tasks(world, &robot).map_err(fault)?;
            let witness = Witness::new(&lifted, self.options, self.believes.cloned());
            LoggedWorld::Acted(Arc::clone(world), robot, Box::new(witness.map_err(|error| Fault::new(file, error))?))
        };
        self.worlds.insert(world.name.clone(), known);
        Ok(())
    }

    fn session(&mut self, file: &str, recorded: &SessionInWorld) -> Result<Lesson, Vec<Fault>> {
        match self.worlds.get_mut(&recorded.world.name) {
            Some(LoggedWorld::Acted(_, robot, witness)) => witness.lesson_in(file, recorded, *robot),
            None => Err(vec![]),
            Some(LoggedWorld::Told(..)) => {
                let message = "has no actions, so nothing can be done in it; add actions, or write a command with \"intended\"";
                Err(vec![Fault::on_line(file, recorded.session.header_line, message).in_field("world")])
            }
        }
    }

    fn command(&mut self, file: &str, command: &CommandRecord) -> Result<Option<Lesson>, Fault> {
        let at = |field: &str, message: &dyn std::fmt::Display| Fault::on_line(file, command.line, message).in_field(field);
        let before = self.before(command).map_err(|unknown| at("before", &unknown))?;
        self.remember(command, &before);
        let read = first_words::read(&command.command).map_err(|error| at("command", &too_long(error)))?;
        if read.count == 0 {
            return Err(at("command", &goodbot::AgentError::EmptyCommand));
        }
        // A command that also ends a proposition has no task.
        if command.ended.is_empty() { self.told(file, command, &before) } else { Ok(None) }
    }

    /// The steps before a command, in order.
    ///
    /// # Errors
    /// The fault of an unknown name.
    fn before(&self, command: &CommandRecord) -> Result<Vec<Arc<Step>>, String> {
        let mut before: Vec<Arc<Step>> = Vec::new();
        for id in &command.before {
            let unknown = || format!("{} is no command of a line before; name one, or leave it out", quoted(id));
            let steps = self.conversations.get(id).ok_or_else(unknown)?;
            before.extend(steps.iter().filter(|&step| !before.iter().any(|known| Arc::ptr_eq(known, step))).cloned().collect::<Vec<_>>());
        }
        Ok(before)
    }

    /// Remembers a command and the steps before it, by its name.
    fn remember(&mut self, command: &CommandRecord, before: &[Arc<Step>]) {
        let Some(id) = &command.id else { return };
        let world = self.worlds.get(&command.world).map(|(LoggedWorld::Told(world, _) | LoggedWorld::Acted(world, ..))| Arc::clone(world));
        let steps = world.map_or_else(|| before.to_vec(), |world| before::after(before, &world, command));
        self.conversations.insert(id.clone(), steps);
    }

    /// The lesson of a command with its meaning.
    fn told(&mut self, file: &str, command: &CommandRecord, before: &[Arc<Step>]) -> Result<Option<Lesson>, Fault> {
        let at = |field: &str, message: &dyn std::fmt::Display| Fault::on_line(file, command.line, message).in_field(field);
        let id = command.id.clone().unwrap_or_else(|| format!("{file}:{}", command.line));
        let model = self.options.language.model;
        let (world, scenes) = match self.worlds.get_mut(&command.world) {
            None => return Ok(None),
            Some(LoggedWorld::Told(world, scenes)) => (world, scenes),
            Some(LoggedWorld::Acted(world, robot, witness)) => {
                let facts = command.facts.as_ref().unwrap_or(&world.facts).clone();
                let session = RecordedSession {
                    header: SessionHeader { intended: None, ..header(command) },
                    header_line: command.line,
                    steps: vec![],
                    answers: vec![],
                    learn: true,
                    end_line: command.line,
                };
                let recorded = SessionInWorld { world: Arc::clone(world), facts, session };
                let told = witness.told_in(file, &recorded, *robot, &command.intended);
                let told = told.map_err(|faults| faults.into_iter().next().unwrap_or_else(|| Fault::new(file, "cannot be used")))?;
                return Ok(told.map(|lesson| Lesson { id, header: header(command), group: command.group.clone(), ..lesson }));
            }
        };
        let facts = command.facts.as_ref().unwrap_or(&world.facts);
        let place = place(world, facts);
        let after;
        let scene = match scenes.entry(place.clone()) {
            _ if !before.is_empty() => {
                after = Scene::of(world, facts, before, model).map_err(|error| at("world", &error))?;
                &after
            }
            Entry::Occupied(known) => known.into_mut(),
            Entry::Vacant(new) => new.insert(Scene::of(world, facts, &[], model).map_err(|error| at("world", &error))?),
        };
        let mut wanted = command.intended.clone();
        wanted.sort();
        let Some(&intended) = scene.positions.get(&wanted) else { return Ok(None) };
        let readings = Arc::clone(&scene.readings);
        let read = first_words::read(&command.command).map_err(|error| at("command", &too_long(error)))?;
        let mut beliefs = vec![0.0; readings.len()];
        beliefs.iter_mut().skip(intended).take(1).for_each(|belief| *belief = 1.0);
        Ok(Some(Lesson {
            group: command.group.clone(),
            intended: Some(intended),
            pairs: readings.get(intended).map(told_pairs).unwrap_or_default(),
            beliefs,
            numbers: Arc::clone(&scene.numbers),
            learn: true,
            long: read.long().map(|long| at("command", &long)),
            ..Lesson::told(id, place, &read, header(command), readings)
        }))
    }
}

/// The header of a labelled session without a home.
fn header(command: &CommandRecord) -> SessionHeader {
    SessionHeader {
        kind: Kind::Labelled,
        command: command.command.clone(),
        id: command.id.clone(),
        intended: Some(command.intended.clone()),
        ..SessionHeader::default()
    }
}

/// The tasks of a world without a robot in which `facts` hold. Model 2 knows no roles, so it reads the values alone.
///
/// # Errors
/// [`TooMany`].
fn readings(world: &WorldFile, facts: &[GroundAtomText], before: &[Arc<Step>], model: Model) -> Result<Vec<Reading>, TooMany> {
    let is_read = |token: &String| model == Model::Roles || token.parse::<Marker>().is_err();
    let reading = |meaning: goodbot_lesson::world::Meaning| Reading {
        name: meaning.name,
        label: meaning.label,
        prior: meaning.prior,
        commands: vec![meaning.description.into_iter().filter(is_read).collect()],
    };
    Ok(meanings(world, facts, before)?.into_iter().map(reading).collect())
}

impl Scene {
    fn of(world: &WorldFile, facts: &[GroundAtomText], before: &[Arc<Step>], model: Model) -> Result<Self, TooMany> {
        let readings: Arc<[Reading]> = readings(world, facts, before, model)?.into();
        let sorted = |name: &GroundTaskText| {
            let mut atoms = name.atoms().to_vec();
            atoms.sort();
            atoms
        };
        let positions = readings.iter().enumerate().map(|(position, reading)| (sorted(&reading.name), position)).collect();
        Ok(Self { readings, numbers: Arc::new(numbers(world)), positions })
    }
}
