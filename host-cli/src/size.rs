//! `goodbot size`: the memory that a robot needs for homes and lessons, as source code for a controller.

use clap::{Args, ValueHint};
use goodbot::capacity::{Capacity, WORDS_PER_COMMAND};
use goodbot::feedback::Strategy;
use goodbot::home::{Home, HomeState, Moves};
use goodbot::language::Model;
use goodbot::memory::{AgentHeap, HomeHeap};
use goodbot::oomdp::{Action, Domain, MOST_COST_ON_CONTROLLERS, PushGrid};
use goodbot::session::Lessons;
use goodbot::snapshot::most_bytes;
use goodbot::task::TaskSet;
use goodbot::{Agent, Capacities, Options};
use goodbot_capi::memory::bytes_32;
use goodbot_console::load::input::{Place, WorldInFile};
use goodbot_console::training_data::LogOptions;
use goodbot_console::{Failure, InputFile, Learner, Lesson, Printed, TaskKinds, between, counted, input, outcome, training, training_data};
use goodbot_formats::environment::EnvironmentFile;
use goodbot_lesson::first_words::heard;
use goodbot_lesson::home;
use goodbot_lesson::world::robot::{self, Robot, WorldFlaw};
use serde_json::json;
use std::collections::BTreeSet;
use std::io::Write;

/// The options of `goodbot size`.
#[derive(Debug, Args)]
#[command(after_help = "\
With these capacities nothing is refused and no lesson gives way, in any of the homes, from any state. The homes of a log count too.

That is the worst case. With a log, words and machine commands are counted as the log has them, which takes much less, and a robot is trained on \
it in that memory: it tells how many sessions it kept. Without a log, every word of every command counts as a new word of 12 letters.

Examples:
  goodbot size home.json --log log.jsonl
  goodbot size home.json --sessions 20 --words 6
  goodbot size lift.json --log lift.jsonl
  goodbot size --log log.jsonl --sessions 100 --json")]
pub struct SizeOptions {
    /// The robot's homes, as JSON or drawn as text, or the world of another robot; - is standard input
    #[arg(value_name = "PLACE", value_hint = ValueHint::FilePath, required_unless_present = "log")]
    places: Vec<InputFile>,
    /// Sessions that it is to keep, with their homes; may be given several times
    #[arg(long, short = 'l', value_name = "LOG", value_hint = ValueHint::FilePath)]
    log: Vec<InputFile>,
    /// The number of sessions that it must keep, 1 to 65535 [default: those of the log, or 16]
    #[arg(long, value_name = "N", value_parser = between(1, usize::from(u16::MAX)))]
    sessions: Option<usize>,
    /// The most words of one command, 1 to 64 [default: those of the log, or 8]
    #[arg(long, value_name = "N", value_parser = between(1, WORDS_PER_COMMAND))]
    words: Option<usize>,
    #[command(flatten)]
    kinds: TaskKinds,
    /// The learner. A controller has no layer: the default needs as much there as roles
    #[arg(long, value_enum, value_name = "NAME", default_value_t = Learner::Roles)]
    learner: Learner,
    /// Print a line of JSON
    #[arg(long)]
    json: bool,
}

/// Runs the command.
///
/// # Errors
/// [`Failure`].
pub fn run(options: &SizeOptions) -> Result<(), Failure> {
    let needs = Needs::find(options)?;
    let mut out = Printed::stdout();
    if options.json {
        writeln!(out, "{}", to_json(&needs))?;
    } else {
        print(&mut out, &needs)?;
    }
    Ok(out.flush()?)
}

fn to_json(needs: &Needs) -> serde_json::Value {
    let capacities: serde_json::Map<_, _> =
        Capacity::ALL.iter().map(|&capacity| (capacity.name().to_owned(), json!(needs.capacities.get(capacity)))).collect();
    let lessons = &needs.lessons;
    json!({
        "type": "size", "homes": needs.homes, "world": needs.world, "sessions": lessons.sessions, "words": lessons.words,
        "different_words": lessons.different_words, "word_bytes": lessons.word_bytes, "capacities": capacities,
        "exact_states": needs.exact_states, "ram": { "controller": needs.ram(), "stack": STACK },
        "flash": { "model": needs.model_bytes(), "slot": needs.slot_bytes() }, "kept": needs.kept,
    })
}

fn print(out: &mut impl Write, needs: &Needs) -> Result<(), Failure> {
    let lessons = &needs.lessons;
    let [homes, sessions] = [(needs.homes, "home"), (lessons.sessions, "session")].map(|(n, it)| counted(n, it));
    let place = needs.world.as_ref().map_or(homes, |world| format!("the world {}", world));
    writeln!(
        out,
        "A robot in {place} that keeps {sessions} of at most {}, {} different:",
        counted(lessons.words, "word"),
        lessons.different_words
    )?;
    writeln!(out)?;
    writeln!(
        out,
        "  RAM    {:>7} bytes on a 32-bit controller, and a stack of {} bytes, as docs/footprint.md says of the course",
        needs.ram(),
        STACK
    )?;
    writeln!(
        out,
        "  flash  {:>7} bytes at most for the model; two slots of {} outlive power cuts",
        needs.model_bytes(),
        needs.slot_bytes()
    )?;
    writeln!(out, "                 for the program: see docs/footprint.md")?;
    if let Some(kept) = needs.kept {
        writeln!(out, "  tried  {kept:>7} of {} sessions of the log were kept in that memory", needs.taught)?;
    }
    if needs.exact_states != Some(needs.capacities.states) {
        let exact = needs.exact_states.map_or("more than can be counted".to_owned(), |states| states.to_string());
        writeln!(
            out,
            "\nThe states are limited to {}; exact plans need {exact}. Plans for far goals are approximate.",
            needs.capacities.states
        )?;
    }
    writeln!(out, "\nIn Rust:\n\n{}", rust(&needs.capacities))?;
    writeln!(out, "In C:\n\n{}", c(&needs.capacities, needs.ram(), needs.world.is_some()))?;
    Ok(())
}

/// The capacities in Rust.
pub fn rust(capacities: &Capacities) -> String {
    let fields = rust_fields(capacities);
    format!("goodbot::memory! {{\n    struct RobotMemory = goodbot::Capacities {{\n{fields}    }};\n}}\n")
}

/// The capacities in C, with a buffer of `bytes` bytes for a robot in homes, or for one with a table.
pub fn c(capacities: &Capacities, bytes: usize, is_table: bool) -> String {
    let (table, size) = (c_table("capacities", capacities), if is_table { "goodbot_table_size" } else { "goodbot_size" });
    format!(
        "{table}/* Where a pointer has four bytes; {size}(&capacities) says how many are needed. */\n\
         GOODBOT_ALIGNED static unsigned char memory[{bytes}];\n"
    )
}

/// A line for each field of capacities in Rust.
pub fn rust_fields(capacities: &Capacities) -> String {
    Capacity::ALL.iter().map(|&capacity| format!("        {}: {},\n", capacity.name(), capacities.get(capacity))).collect()
}

/// Capacities of this name in C that also compile as C++, which has no designated array entries.
pub fn c_table(name: &str, capacities: &Capacities) -> String {
    let entries: String =
        Capacity::ALL.iter().map(|&capacity| format!("    {}, /* {} */\n", capacities.get(capacity), capacity.name())).collect();
    format!(
        "#if GOODBOT_CAPACITIES != {}\n#error \"print these capacities with the goodbot that this library comes from\"\n#endif\n\
         static const goodbot_capacities {name} = {{ {{\n{entries}}} }};\n",
        Capacity::ALL.len()
    )
}

/// The most states for a home: on a controller, exact plans in larger homes cost more memory than they are worth.
const MOST_STATES: usize = Capacities::SMALL.states;
/// The most states for a world: with more, no plan on a controller is exact.
pub const MOST_STATES_OF_WORLD: usize = 1_000_000;
/// The limits of a controller: a set of tasks is a single machine word there.
const OF_CONTROLLERS: Capacities = Capacities { tasks: TaskSet::MOST_OF_ONE_WORD, ..Capacities::STANDARD };
/// The most objects and blocks of a home on a controller.
const MOST_OBJECTS: usize = 32;
const MOST_BLOCKS: usize = 8;
/// The strategies that a robot in C expects: without room for them it does not find out who presses one button only.
const TRAINERS: [(Strategy, f32); 3] = Strategy::ONE_BUTTON_OR_BOTH;
/// The deepest stack of the course in `docs/footprint.md`; `cargo xtask footprint` writes both.
pub const STACK: usize = match usize::from_str_radix(include_str!("size/stack.txt").trim_ascii(), 10) {
    Ok(bytes) => bytes,
    Err(_) => 0,
};
const _: () = assert!(STACK > 0, "stack.txt has no number");
/// Flash is usually erased in units of a power of two from this one on.
const LEAST_SLOT: usize = 1_024;
/// The header of a slot, and the bytes that are written at once.
const SLOT_HEADER: usize = 256;
/// The default numbers of sessions and of words in a command.
const SESSIONS: usize = 16;
const WORDS: usize = 8;

/// The memory that a robot needs.
#[derive(Debug)]
pub struct Needs {
    /// How many different homes it has.
    pub homes: usize,
    /// The name of its world, if it lives in no home.
    pub world: Option<String>,
    /// The lessons to keep.
    pub lessons: Lessons,
    /// The sizes of its tables.
    pub capacities: Capacities,
    /// The number of states with which every plan is exact; `None` if they cannot be counted.
    pub exact_states: Option<usize>,
    /// How many sessions of the log are to be learned from.
    pub taught: usize,
    /// How many of them a robot kept that was trained in this memory; `None` without a trial.
    pub kept: Option<usize>,
}

impl Needs {
    /// Reads homes or a world, and logs.
    ///
    /// # Errors
    /// The faults of the files.
    pub fn find(options: &SizeOptions) -> Result<Self, Failure> {
        let lifted = options.kinds.lifted()?;
        let learner = options.learner.options();
        let log = if options.log.is_empty() {
            vec![]
        } else {
            training_data::read(&options.log, &lifted, learner, &LogOptions::default())?.lessons
        };
        let log: Vec<Lesson> = log.into_iter().filter(|lesson| lesson.learn).collect();
        if log.is_empty() && !options.log.is_empty() {
            return Err(Failure::Input("no session is to be learned from; set \"learn\" to true at the end of one".to_owned()));
        }
        let lessons = to_keep(options, &log, learner.language.model)?;
        let (homes, world) = places(&options.places)?;
        let of_worlds = log.iter().any(|lesson| lesson.world.is_some());
        let (homes, world, least) = match world {
            Some(_) if !homes.is_empty() || (!of_worlds && !log.is_empty()) => {
                return Err(Failure::Input("homes do not mix with a world; ask for each by itself".to_owned()));
            }
            None if of_worlds => {
                return Err(Failure::Input("a log of worlds has no home to make room for; name the robot's world too".to_owned()));
            }
            Some(file) => {
                let least = robot::with(&file.world, |robot, _| {
                    is_for_controllers(robot)?;
                    least_of_world(robot, &lessons, learner)
                });
                let least = least.flatten().map_err(|flaw| file.fault(&flaw.field, &flaw.message))?;
                (0, Some(file.world.name.clone()), least)
            }
            None => {
                let homes = build(homes, &log)?;
                let mut agent = Agent::new(AgentHeap::new(&OF_CONTROLLERS), &lifted, learner)?;
                agent.set_strategies(&TRAINERS)?;
                let least = agent.least_capacities_of_all(homes.iter().map(|(home, _)| home), &lessons)?;
                (homes.len(), None, least)
            }
        };
        let exact_states = Some(least.states).filter(|&states| states > 0);
        let most = if world.is_some() { usize::MAX } else { MOST_STATES };
        let states = exact_states.map_or(MOST_STATES, |states| states.min(most));
        let mut needs =
            Self { homes, world, lessons, capacities: Capacities { states, ..least }, exact_states, taught: log.len(), kept: None };
        if !log.is_empty() && lessons.sessions >= log.len() {
            needs.count_commands(&log, &learner)?;
            needs.kept = Some(train(&needs.capacities, &log, &learner)?.0);
        }
        Ok(needs)
    }

    /// Replaces the worst case by the machine commands that the log needs, in proportion to the sessions to keep.
    fn count_commands(&mut self, log: &[Lesson], learner: &Options) -> Result<(), Failure> {
        let (_, used) = train(&self.capacities, log, learner)?;
        let all = |used: usize| used.saturating_mul(self.lessons.sessions).div_ceil(log.len());
        let capacities = &mut self.capacities;
        capacities.commands = capacities.commands.min(all(used.commands));
        capacities.command_tokens = capacities.command_tokens.min(all(used.command_tokens));
        capacities.pairs = capacities.pairs.min(all(used.pairs));
        Ok(())
    }

    /// Bytes of RAM on a controller with pointers of four bytes, without the stack.
    pub fn ram(&self) -> usize {
        bytes_32(&self.capacities, self.world.is_some())
    }

    /// The most bytes of a model.
    pub fn model_bytes(&self) -> usize {
        most_bytes(&self.capacities)
    }

    /// Bytes of each of the two slots for the model.
    pub fn slot_bytes(&self) -> usize {
        self.model_bytes().saturating_add(SLOT_HEADER).next_multiple_of(LEAST_SLOT)
    }
}

/// Refuses a world with too many actions or states for a controller.
///
/// # Errors
/// The number of them, and what to do.
pub fn is_for_controllers(robot: &Robot<'_>) -> Result<(), WorldFlaw> {
    let (actions, most) = (robot.actions().len(), Action::MOST_ON_CONTROLLERS);
    if actions > most {
        let message = format!(
            "give the robot {actions} actions with their objects, and {most} are the most for a controller; give them fewer parameters"
        );
        return Err(WorldFlaw { field: "actions".to_owned(), message });
    }
    let file = robot.file();
    let for_hosts = [("derived", file.derived.is_empty()), ("parents", file.parents.is_empty())];
    if let Some((field, _)) = for_hosts.into_iter().find(|(_, is_empty)| !is_empty) {
        return Err(WorldFlaw { field: field.to_owned(), message: "are for hosts, not for a controller; leave them out".to_owned() });
    }
    let most = MOST_COST_ON_CONTROLLERS;
    if let Some(dear) = robot.actions().iter().find(|kind| kind.cost > most) {
        let message = format!("have {}, which costs {}, and {most} is the most for a controller; divide the costs", dear.name, dear.cost);
        return Err(WorldFlaw { field: "actions".to_owned(), message });
    }
    let count = robot.state_count();
    if count <= MOST_STATES_OF_WORLD as u64 {
        return Ok(());
    }
    let message = format!(
        "give {count} states together, and {MOST_STATES_OF_WORLD} are the most for a controller; leave out objects or what changes"
    );
    Err(WorldFlaw { field: "propositions".to_owned(), message })
}

/// The least capacities of the robot of a world.
///
/// # Errors
/// The fault of the world.
pub fn least_of_world(robot: &Robot<'_>, lessons: &Lessons, learner: Options) -> Result<Capacities, WorldFlaw> {
    let lifted = robot::tasks(robot.file(), robot)?;
    let least = Agent::new(AgentHeap::new(&OF_CONTROLLERS), &lifted, learner).and_then(|mut agent| {
        agent.set_strategies(&TRAINERS)?;
        agent.least_capacities(robot, lessons)
    });
    least.map_err(|error| {
        let (field, message) = outcome::in_a_world(&error);
        WorldFlaw { field: field.to_owned(), message }
    })
}

/// Trains a robot on the log in this memory. Returns how many sessions it kept, and the sizes of their machine commands.
fn train(capacities: &Capacities, log: &[Lesson], learner: &Options) -> Result<(usize, Capacities), Failure> {
    let mut memory = goodbot_console::typed::memory(capacities, &learner.language, training::tasks(log));
    let model = training::train(&mut memory, log.iter(), learner.language)?;
    let data = model.read().bitext();
    let command_tokens = (0..data.commands() as u16).map(|command| data.command(command).len()).sum();
    Ok((data.sessions(), Capacities { commands: data.commands(), command_tokens, pairs: data.pairs().len(), ..Capacities::NONE }))
}

/// Homes, with the names of their files or sessions.
type Named<'l> = Vec<(&'l str, EnvironmentFile)>;

/// The homes of the files, and the world, if one of the files is a world.
fn places(files: &[InputFile]) -> Result<(Named<'_>, Option<Box<WorldInFile>>), Failure> {
    let (mut homes, mut world) = (Vec::new(), None);
    for file in files {
        match input::place(file)? {
            Place::Home(home) => homes.push((input::name(file), home)),
            Place::World(_) if world.is_some() => {
                return Err(Failure::Input(format!("{}: is a second world; ask for each by itself", input::name(file))));
            }
            Place::World(it) => world = Some(it),
        }
    }
    Ok((homes, world))
}

/// Builds the different homes of files and sessions.
fn build<'l>(mut environments: Named<'l>, log: &'l [Lesson]) -> Result<Vec<(Home<HomeHeap>, HomeState)>, Failure> {
    for lesson in log {
        if environments.iter().all(|(_, known)| *known != lesson.header.environment) {
            environments.push((&lesson.id, lesson.header.environment.clone()));
        }
    }
    let build = |(source, environment): &(&str, EnvironmentFile)| {
        home::build(environment, Moves::Push, home::memory())
            .map_err(|flaw| Failure::Input(format!("{source}: field \"{}\": {}", flaw.field(), flaw.message(environment))))
    };
    let fits = |(home, _): &(Home<HomeHeap>, HomeState)| {
        home.is_numbered() && home.blocks().len() <= MOST_BLOCKS && home.objects().len() <= MOST_OBJECTS
    };
    let built = environments.iter().map(build).collect::<Result<Vec<_>, _>>()?;
    match environments.iter().zip(&built).find(|(_, home)| !fits(home)) {
        Some(((source, _), _)) => Err(Failure::Input(format!(
            "{source}: is too large for a controller: {MOST_OBJECTS} objects, {MOST_BLOCKS} of them blocks, and 2^64 states are the most; leave out some"
        ))),
        None => Ok(built),
    }
}

/// The lessons to keep: those of the log, unless the options ask for more.
fn to_keep(options: &SizeOptions, log: &[Lesson], model: Model) -> Result<Lessons, Failure> {
    if log.is_empty() {
        return Ok(Lessons::new(options.sessions.unwrap_or(SESSIONS), options.words.unwrap_or(WORDS)));
    }
    let (mut different, mut most) = (BTreeSet::new(), 0);
    for lesson in log {
        let words = heard(model, &lesson.command).map_err(|error| Failure::Input(format!("{}: {error}", lesson.id)))?;
        most = most.max(words.len());
        different.extend(words);
    }
    Ok(Lessons {
        sessions: options.sessions.unwrap_or(log.len()),
        words: options.words.unwrap_or(most),
        different_words: different.len(),
        word_bytes: different.iter().map(String::len).sum(),
    })
}
