//! `goodbot microbit`: writes a file for a micro:bit, with a model that was learned elsewhere.

use clap::{Args, ValueHint};
use embedded_storage::nor_flash::{ErrorType, NorFlash, NorFlashError, NorFlashErrorKind, ReadNorFlash};
use goodbot::feedback::Strategy;
use goodbot::home::{Moves, paper_tasks};
use goodbot::language::Model;
use goodbot::memory::{AgentHeap, HomeHeap};
use goodbot::snapshot::Contents;
use goodbot::storage::TwoSlots;
use goodbot::{Agent, Capacities, Options};
use goodbot_console::load::kinds::{kept, texts};
use goodbot_console::outcome::InWords;
use goodbot_console::restored::room_for;
use goodbot_console::whole_file::MOST_BYTES;
use goodbot_console::{Failure, InputFile, Kind, Output, counted, input, read_model, say};
use goodbot_formats::microbit::{MicrobitFile, SLOT_BYTES};
use goodbot_lesson::home;
use goodbot_lesson::kept_kinds::model_alone;
use std::fs::File;
use std::io::{ErrorKind, Read};
use std::path::{Path, PathBuf};

/// The capacities of the board's robot.
const CAPACITIES: Capacities = Capacities::TINY;

/// How to get the program.
const HOW_TO_GET_IT: &str = "cargo xtask microbit, in the folder of goodbot's source, makes the program as dist/goodbot.hex";

/// The options of `goodbot microbit`.
#[derive(Debug, Args)]
#[command(after_help = "\
The file has the program of goodbot.hex, the model, and the home if one is named. The micro:bit goes on learning from there. It \
has room for about 14 words and 7 lessons and for a home of 41 cells; an error names the part that has no room.

Example:
  cargo xtask microbit
  goodbot microbit --hex dist/goodbot.hex --model words.goodbot --home home.json --command \"go to the red room\" --out mine.hex")]
pub struct MicrobitOptions {
    /// The program, which `cargo xtask microbit` makes
    #[arg(long, value_name = "FILE.hex", value_hint = ValueHint::FilePath)]
    hex: PathBuf,
    /// A model that goodbot learn or goodbot teach wrote
    #[arg(long, short = 'm', value_name = "MODEL", value_hint = ValueHint::FilePath)]
    model: PathBuf,
    /// A home in place of the robot's own, as JSON or drawn as text; - is standard input
    #[arg(long, value_name = "HOME", value_hint = ValueHint::FilePath)]
    home: Option<InputFile>,
    /// A command for the list of the long press; may be given several times
    #[arg(long, short = 'c', value_name = "WORDS")]
    command: Vec<String>,
    /// The file to write; - is standard output
    #[arg(long, short = 'o', value_name = "FILE.hex", value_hint = ValueHint::FilePath)]
    out: PathBuf,
    /// Replace a file that goodbot did not write
    #[arg(long)]
    force: bool,
}

/// Runs the command.
///
/// # Errors
/// [`Failure`] names the file and its fault.
pub fn run(options: &MicrobitOptions) -> Result<(), Failure> {
    let inputs = [&options.hex, &options.model].map(PathBuf::as_path).into_iter().chain(options.home.as_ref().map(AsRef::as_ref));
    let target = Output::new(Kind::Microbit, &options.out, inputs, options.force)?;
    let mut file =
        MicrobitFile::parse(&read_text(&options.hex)?).map_err(|error| Failure::of(&options.hex, format!("{error}; {HOW_TO_GET_IT}")))?;
    let (slots, sessions) = slots(&options.model)?;
    file.put_slots(&slots).map_err(|error| Failure::of(&options.model, error))?;
    if let Some(command) = options.command.iter().find(|command| command.trim().is_empty() || command.contains(char::is_control)) {
        return Err(Failure::Input(format!("{command:?} is no command; say what to do, on one line")));
    }
    if options.home.is_some() || !options.command.is_empty() {
        let objects = options.home.as_ref().map(described).transpose()?;
        file.put_home(objects.as_ref(), &options.command).map_err(|error| Failure::Input(error.to_string()))?;
    }
    target.write(file.to_text().as_bytes())?;
    say!("{}: {}; drag it onto a micro:bit", target.name(), counted(sessions, "lesson"));
    Ok(())
}

fn read_text(path: &Path) -> Result<String, Failure> {
    let mut text = String::new();
    let read = File::open(path).and_then(|file| file.take(MOST_BYTES).read_to_string(&mut text));
    match read.map_err(|error| (error.kind(), error)) {
        Ok(_) => Ok(text),
        Err((ErrorKind::NotFound, _)) => Err(Failure::of(path, format!("is not there; {HOW_TO_GET_IT}"))),
        Err((ErrorKind::InvalidData, _)) => Err(Failure::of(path, format!("is no micro:bit program; {HOW_TO_GET_IT}"))),
        Err((_, error)) => Err(Failure::of(path, format!("cannot be read ({error}); check its name and that you may read it"))),
    }
}

/// A home that fits the board.
fn described(file: &InputFile) -> Result<goodbot_formats::environment::EnvironmentFile, Failure> {
    let environment = input::home(file)?;
    let mut memory = HomeHeap::new(&CAPACITIES);
    match home::build(&environment, Moves::Push, &mut memory) {
        Ok(_) => Ok(environment),
        Err(flaw) => Err(Failure::Input(format!("{} on a micro:bit: {}", input::name(file), flaw.message(&environment)))),
    }
}

/// The board's slots with a model that its robot can restore, and the number of its sessions.
fn slots(path: &Path) -> Result<(Vec<u8>, usize), Failure> {
    let file = read_model(path)?;
    if let Some(kinds) = kept(path, &file)? {
        let tasks = paper_tasks()?;
        let [theirs, own] = [texts(&kinds), texts(&tasks)].map(|texts| texts.join("; "));
        let message = format!(
            "was learned for the kinds of task {theirs}, and a micro:bit has {own} alone; learn a model without --task and --routes"
        );
        return Err(Failure::of(path, message));
    }
    let mut model = model_alone(&file).to_vec();
    let contents = Contents::read(&model).map_err(|error| Failure::of(path, error))?;
    if contents.options.language.model != Model::Roles {
        return Err(Failure::of(path, "was learned as in the paper, and the micro:bit has the role model alone"));
    }
    let tasks = paper_tasks()?;
    let mut agent = Agent::new(AgentHeap::new(&CAPACITIES), &tasks, Options::DEFAULT)?;
    let is_layered = contents.options.language.layer;
    if contents.strategies.len() > 1 || is_layered {
        let room = room_for(&contents);
        let mut learned = Agent::new(AgentHeap::new(&room), &tasks, Options::DEFAULT)?;
        learned.restore(&model).map_err(|error| Failure::of(path, error))?;
        if contents.strategies.len() > 1 {
            // The board's robot expects the paper's trainer.
            learned.set_strategies(&[(Strategy::BALANCED, 1.0)]).map_err(|error| Failure::of(path, error))?;
        }
        // Neither this memory nor the board has the layer, so only the role model is saved.
        model = learned.saved().map_err(|error| Failure::of(path, error))?;
    }
    agent.restore(&model).map_err(|error| Failure::of(path, format!("on a micro:bit: {}", error.in_words())))?;
    let small = |error| Failure::of(path, format!("on a micro:bit: {error}; teach it fewer lessons and words"));
    let mut flash = Flash(vec![0xff; 2 * SLOT_BYTES as usize]);
    TwoSlots::new(&mut flash, 0, SLOT_BYTES).and_then(|mut slots| slots.store(&model)).map_err(small)?;
    Ok((flash.0, agent.language().bitext().sessions()))
}

/// The board's slots, as its program reads them.
struct Flash(Vec<u8>);

/// An access outside the slots.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct Outside;

impl NorFlashError for Outside {
    fn kind(&self) -> NorFlashErrorKind {
        NorFlashErrorKind::OutOfBounds
    }
}

impl ErrorType for Flash {
    type Error = Outside;
}

impl ReadNorFlash for Flash {
    const READ_SIZE: usize = 1;

    fn read(&mut self, offset: u32, bytes: &mut [u8]) -> Result<(), Outside> {
        let from = self.0.get(offset as usize..).and_then(|rest| rest.get(..bytes.len())).ok_or(Outside)?;
        bytes.copy_from_slice(from);
        Ok(())
    }

    fn capacity(&self) -> usize {
        self.0.len()
    }
}

impl NorFlash for Flash {
    const WRITE_SIZE: usize = 4;
    const ERASE_SIZE: usize = 4_096;

    fn erase(&mut self, from: u32, to: u32) -> Result<(), Outside> {
        self.0.get_mut(from as usize..to as usize).ok_or(Outside)?.fill(0xff);
        Ok(())
    }

    fn write(&mut self, offset: u32, bytes: &[u8]) -> Result<(), Outside> {
        let to = self.0.get_mut(offset as usize..).and_then(|rest| rest.get_mut(..bytes.len())).ok_or(Outside)?;
        to.copy_from_slice(bytes);
        Ok(())
    }
}
