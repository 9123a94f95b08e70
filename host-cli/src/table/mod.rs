//! `goodbot table`: prints the robot of a world file as source code for a controller, from parts that [`c`] and [`rust`] share.

mod c;
mod rust;

use crate::size::{MOST_STATES_OF_WORLD, is_for_controllers, least_of_world};
use clap::{Args, ValueHint};
use goodbot::Capacities;
use goodbot::capacity::WORDS_PER_COMMAND;
use goodbot::oomdp::{ActionKind, Domain, Objects, Schema, World, check};
use goodbot::session::Lessons;
use goodbot::task::LiftedTask;
use goodbot_console::{Failure, InputFile, Learner, Printed, between, input};
use goodbot_lesson::world::robot::{self, DigitAt, FactAt, Robot, Rule, WorldFlaw};
use std::io::Write;

/// Print the robot of a world as source for a controller
///
/// The description is checked in every state that the robot can reach. The capacities are the smallest with which every lesson is kept and
/// every plan is exact.
#[derive(Debug, Args)]
#[command(after_help = "\
In C it is a goodbot_table for the library's feature table, which has at most 8 classes, 8 propositions and 8 kinds of task. In Rust it is a module with \
a robot for Agent and memory for both. A state is a number: a comment gives the meaning of each digit.

Examples:
  goodbot table lift.json --c > lift.h
  goodbot table lift.json --rust --sessions 40 > lift.rs")]
pub struct TableOptions {
    /// The world, as JSON
    #[arg(value_name = "WORLD", value_hint = ValueHint::FilePath)]
    world: InputFile,
    /// Print C
    #[arg(long, required_unless_present = "rust", conflicts_with = "rust")]
    c: bool,
    /// Print Rust
    #[arg(long)]
    rust: bool,
    /// The number of sessions that it must keep, 1 to 65535
    #[arg(long, value_name = "N", default_value_t = 16, value_parser = between(1, usize::from(u16::MAX)))]
    sessions: usize,
    /// The most words of one command, 1 to 64
    #[arg(long, value_name = "N", default_value_t = 8, value_parser = between(1, WORDS_PER_COMMAND))]
    words: usize,
}

/// Runs the command.
///
/// # Errors
/// [`Failure`]: the fault of the file or of the output.
pub fn run(options: &TableOptions) -> Result<(), Failure> {
    let file = input::world(&options.world)?;
    let refused = |flaw: WorldFlaw| file.fault(&flaw.field, &flaw.message);
    let text = robot::with(&file.world, |robot, start| text(options, robot, start)).map_err(refused)?.map_err(refused)?;
    let mut out = Printed::stdout();
    out.write_all(text.as_bytes())?;
    Ok(out.flush()?)
}

fn text(options: &TableOptions, robot: &Robot<'_>, start: u64) -> Result<String, WorldFlaw> {
    // The kinds of task and the numbers of actions and states are checked before the states themselves, which take longer.
    let kinds = robot::tasks(robot.file(), robot)?;
    is_for_controllers(robot)?;
    check(robot, start, MOST_STATES_OF_WORLD).map_err(|error| WorldFlaw { field: "actions".to_owned(), message: error.to_string() })?;
    let capacities = least_of_world(robot, &Lessons::new(options.sessions, options.words), Learner::Roles.options())?;
    let source = Source::of(robot, start, kinds, capacities);
    if options.c { c::text(&source) } else { Ok(rust::text(&source)) }
}

/// The parts of a robot's source.
pub struct Source<'w> {
    /// The world's name in its file.
    pub name: &'w str,
    /// The vocabulary.
    pub schema: Schema<'w>,
    /// The objects.
    pub objects: Objects<'w>,
    /// The actions.
    pub actions: &'w [ActionKind<'w>],
    /// The kinds of task.
    pub tasks: Vec<String>,
    /// The kinds of task, parsed.
    pub kinds: Vec<LiftedTask>,
    /// How many states there are.
    pub states: u64,
    /// The initial state.
    pub start: u64,
    /// The facts, with the digits' values with which they hold.
    pub facts: Vec<FactAt>,
    /// The rules of each action.
    pub rules: Vec<Vec<Rule>>,
    /// The sizes of its tables.
    pub capacities: Capacities,
}

/// A part of a rule.
#[derive(Clone, Copy, Debug)]
pub enum Part {
    /// A rule begins.
    Begin,
    /// A digit must have this value.
    Has(DigitAt),
    /// A digit must have another value.
    HasNot(DigitAt),
    /// A digit takes this value.
    Takes(DigitAt),
}

impl<'w> Source<'w> {
    /// The source of a robot.
    pub fn of(robot: &'w Robot<'w>, start: u64, kinds: Vec<LiftedTask>, capacities: Capacities) -> Self {
        let World { schema, objects } = robot.world();
        Self {
            name: &robot.file().name,
            schema,
            objects,
            actions: robot.actions(),
            tasks: robot.file().task_kinds.iter().map(ToString::to_string).collect(),
            kinds,
            states: robot.state_count(),
            start,
            facts: robot.where_facts_hold(),
            rules: robot.rules(),
            capacities,
        }
    }

    /// The parts of all rules, in order, each with its action.
    pub fn parts(&self) -> Vec<(usize, Part)> {
        let mut parts = Vec::new();
        for (action, rules) in self.rules.iter().enumerate() {
            for Rule { conditions, effects } in rules {
                parts.push((action, Part::Begin));
                parts.extend(conditions.iter().map(|&(at, has)| (action, if has { Part::Has(at) } else { Part::HasNot(at) })));
                parts.extend(effects.iter().map(|&at| (action, Part::Takes(at))));
            }
        }
        parts
    }

    /// A line for each fact that can change: the fact, and the condition under which it holds. The names come from a file, so that `escaped`
    /// writes each as the language's comments need it.
    pub fn legend(&self, escaped: impl Fn(&str) -> String) -> Vec<String> {
        let told = |fact: &FactAt| {
            let count = self.schema.parameters(fact.proposition).len();
            let names: Vec<String> = fact.arguments.iter().take(count).map(|&object| escaped(self.objects.name(object))).collect();
            let DigitAt { digit, value } = fact.at;
            let name = escaped(self.schema.proposition_name(fact.proposition));
            format!("{name}({}): state / {} % {} == {value}", names.join(","), digit.unit, digit.values)
        };
        self.facts.iter().filter(|fact| fact.at.digit.values > 1).map(told).collect()
    }

    /// The class, the name and the values of each object.
    pub fn rows(&self) -> Vec<(usize, &str, Vec<&str>)> {
        let row = |(id, object): (goodbot::oomdp::ObjectId, &goodbot::oomdp::Object)| {
            let values = (0..self.schema.attributes.len()).map(|attribute| self.objects.value(id, attribute)).collect();
            (object.class.index(), self.objects.name(id), values)
        };
        self.objects.iter().map(row).collect()
    }
}

/// A list in source code.
fn list(items: impl Iterator<Item = String>) -> String {
    items.collect::<Vec<_>>().join(", ")
}
