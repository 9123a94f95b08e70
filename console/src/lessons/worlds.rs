//! Commands in worlds from files, as training data: what they mean is told.

use super::{Lesson, Reading, told_pairs};
use goodbot::language::{Model, for_each_word};
use goodbot::task::Marker;
use goodbot_formats::environment::EnvironmentFile;
use goodbot_formats::session::{Kind, SessionHeader};
use goodbot_formats::task_text::{GroundAtomText, GroundTaskText};
use goodbot_formats::world::{CommandRecord, Line, WorldFile, WorldReader};
use goodbot_lesson::Fault;
use goodbot_lesson::world::{TooMany, meanings};
use std::collections::HashMap;
use std::io::BufRead;
use std::sync::Arc;

/// A state of a world: the tasks there, and where each stands among them.
struct Scene {
    readings: Arc<[Reading]>,
    positions: HashMap<Vec<GroundAtomText>, usize>,
}

/// The worlds of a log, and the states that its commands were given in.
#[derive(Default)]
struct Worlds {
    worlds: HashMap<String, Arc<WorldFile>>,
    scenes: HashMap<String, Scene>,
}

/// Reads a log of worlds, and hands over each lesson, or what is wrong with it: `None` for a command whose meaning is none of the tasks.
///
/// # Errors
/// What `take` says.
pub fn read<E>(
    file: &str,
    log: impl BufRead,
    model: Model,
    mut take: impl FnMut(Result<Option<Lesson>, Fault>) -> Result<(), E>,
) -> Result<(), E> {
    let mut known = Worlds::default();
    for line in WorldReader::new(log) {
        match line {
            Err(error) => take(Err(Fault::from_format(file, error)))?,
            Ok(Line::World(world)) => {
                known.worlds.insert(world.name.clone(), world);
            }
            Ok(Line::Command(command)) => take(known.lesson(file, &command, model))?,
        }
    }
    Ok(())
}

/// A command that is asked in a world: a lesson of which nobody told what was meant.
///
/// # Errors
/// [`TooMany`].
pub fn question(world: &WorldFile, command: &str, model: Model) -> Result<Lesson, TooMany> {
    let asked = CommandRecord { line: 1, world: world.name.clone(), command: command.to_owned(), ..CommandRecord::default() };
    let readings: Arc<[Reading]> = readings(world, &world.facts, model)?.into();
    Ok(Lesson {
        id: String::new(),
        command: command.to_owned(),
        header: header(&asked),
        world: Some(place(world, None)),
        group: None,
        intended: None,
        pairs: vec![],
        beliefs: readings.iter().map(|reading| reading.prior).collect(),
        readings,
        shown: vec![],
        walk: String::new(),
        learn: false,
        remarks: vec![],
    })
}

impl Worlds {
    fn lesson(&mut self, file: &str, command: &CommandRecord, model: Model) -> Result<Option<Lesson>, Fault> {
        let at = |field: &str, message: &dyn std::fmt::Display| Fault::on_line(file, command.line, message).in_field(field);
        let mut words = 0_usize;
        let counted = for_each_word(&command.command, |_| {
            words += 1;
            Ok(())
        });
        counted.map_err(|error| at("command", &error))?;
        if words == 0 {
            return Err(at("command", &goodbot::AgentError::EmptyCommand));
        }
        let Some(world) = self.worlds.get(&command.world) else { return Ok(None) };
        let place = place(world, command.facts.as_deref());
        let scene = match self.scenes.entry(place.clone()) {
            std::collections::hash_map::Entry::Occupied(known) => known.into_mut(),
            std::collections::hash_map::Entry::Vacant(new) => {
                let facts = command.facts.as_deref().unwrap_or(&world.facts);
                new.insert(Scene::of(world, facts, model).map_err(|error| at("world", &error))?)
            }
        };
        let mut wanted = command.intended.clone();
        wanted.sort();
        // What is to end besides is no task.
        let Some(&intended) = scene.positions.get(&wanted).filter(|_| command.ended.is_empty()) else { return Ok(None) };
        let readings = Arc::clone(&scene.readings);
        let mut beliefs = vec![0.0; readings.len()];
        beliefs.iter_mut().skip(intended).take(1).for_each(|belief| *belief = 1.0);
        Ok(Some(Lesson {
            id: command.id.clone().unwrap_or_else(|| format!("{file}:{}", command.line)),
            command: command.command.clone(),
            header: header(command),
            world: Some(place),
            group: command.group.clone(),
            intended: Some(intended),
            pairs: readings.get(intended).map(told_pairs).unwrap_or_default(),
            readings,
            beliefs,
            shown: vec![],
            walk: String::new(),
            learn: true,
            remarks: vec![],
        }))
    }
}

/// A state of a world, as a text.
fn place(world: &WorldFile, facts: Option<&[GroundAtomText]>) -> String {
    let mut facts: Vec<String> = facts.unwrap_or(&world.facts).iter().map(ToString::to_string).collect();
    facts.sort();
    format!("{} {}", world.name, facts.join(" "))
}

/// As a labelled session has it, in no home.
fn header(command: &CommandRecord) -> SessionHeader {
    SessionHeader {
        id: command.id.clone(),
        kind: Kind::Labelled,
        environment: EnvironmentFile::new(vec![]),
        command: command.command.clone(),
        intended: Some(command.intended.clone()),
        before: None,
        through: None,
        avoiding: None,
        actions: None,
        continues: false,
        prior: None,
        strategies: None,
        utterance: None,
        after: None,
        conversation: None,
    }
}

/// The tasks of a world in which `facts` hold. Model 2 knows no roles: it reads the values alone.
///
/// # Errors
/// [`TooMany`].
pub fn readings(world: &WorldFile, facts: &[GroundAtomText], model: Model) -> Result<Vec<Reading>, TooMany> {
    let is_read = |token: &String| model == Model::Roles || token.parse::<Marker>().is_err();
    let reading = |meaning: goodbot_lesson::world::Meaning| Reading {
        name: meaning.name,
        label: meaning.label,
        prior: meaning.prior,
        commands: vec![meaning.description.into_iter().filter(is_read).collect()],
        plan: vec![],
    };
    Ok(meanings(world, facts)?.into_iter().map(reading).collect())
}

impl Scene {
    fn of(world: &WorldFile, facts: &[GroundAtomText], model: Model) -> Result<Self, TooMany> {
        let readings: Arc<[Reading]> = readings(world, facts, model)?.into();
        let sorted = |name: &GroundTaskText| {
            let mut atoms = name.atoms().to_vec();
            atoms.sort();
            atoms
        };
        let positions = readings.iter().enumerate().map(|(position, reading)| (sorted(&reading.name), position)).collect();
        Ok(Self { readings, positions })
    }
}
