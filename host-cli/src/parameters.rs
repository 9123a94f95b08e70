//! `goodbot parameters`: writes the part of a model that a robot needs if it does not learn.

use clap::{Args, ValueHint};
use goodbot::language::{LanguageModel, Settings};
use goodbot::memory::AgentHeap;
use goodbot::planning::Progress;
use goodbot::snapshot::{Contents, SaveError};
use goodbot::{Capacities, capacity::Capacity};
use goodbot_console::output::PARAMETERS_IN_C;
use goodbot_console::{Failure, Kind, Output, counted, read_model, say};
use std::fmt::Write;
use std::path::PathBuf;

/// Write the parameters of a model alone, for a robot that only obeys
#[derive(Clone, Debug, Args)]
#[command(after_help = EXAMPLES)]
pub struct ParametersArgs {
    /// The model
    #[arg(value_name = "MODEL", value_hint = ValueHint::FilePath)]
    pub model: PathBuf,
    /// The file to write; - is standard output
    #[arg(long, short = 'o', value_name = "FILE", value_hint = ValueHint::FilePath)]
    pub out: PathBuf,
    /// Write an array in C
    #[arg(long)]
    pub c: bool,
    /// Replace a file that has no parameters
    #[arg(long)]
    pub force: bool,
}

const EXAMPLES: &str = "\
A board restores them by goodbot_restore_parameters or Agent::restore_parameters. It then understands as a board that restores the model, to the bit, and takes \
less flash, because it does not learn. The layer of hosts is left out.

Examples:
  goodbot parameters kitchen.model -o kitchen.parameters
  goodbot parameters kitchen.model -o kitchen.h --c";

/// Runs the command.
///
/// # Errors
/// [`Failure`] names the file and its fault.
pub fn run(options: &ParametersArgs) -> Result<(), Failure> {
    let target = Output::new(Kind::Parameters, &options.out, [&options.model], options.force)?;
    let bytes = read_model(&options.model)?;
    let contents = Contents::read(&bytes).map_err(|error| Failure::of(&options.model, error))?;
    let needs = contents.needs();
    let memory = AgentHeap::new(&Capacities { states: 0, hashed_states: 0, ..needs });
    let mut model = LanguageModel::new(memory, Settings::DEFAULT).map_err(|error| Failure::of(&options.model, error))?;
    model.restore(&bytes).map_err(|error| Failure::of(&options.model, error))?;
    while model.lend().train(u32::MAX) == Progress::Working {}
    let mut file = Vec::new();
    let length = match model.read().save_parameters(contents.vocabulary, &mut file) {
        Err(SaveError::Buffer { needed, .. }) => {
            file.resize(needed, 0);
            model.read().save_parameters(contents.vocabulary, &mut file)
        }
        other => other,
    };
    let length = length.map_err(|error| Failure::of(&options.model, error))?;
    target.write(&if options.c { in_c(&file).into_bytes() } else { file })?;
    let rooms = [Capacity::Words, Capacity::Tokens, Capacity::Translations, Capacity::Alignments];
    let rooms = rooms.map(|room| format!("{} {}", room.name(), needs.get(room))).join(", ");
    say!("{}: {}; they need {rooms}", target.name(), counted(length, "byte"));
    Ok(())
}

/// The bytes as an array.
fn in_c(bytes: &[u8]) -> String {
    let mut text = format!("{PARAMETERS_IN_C} = {{");
    for (at, byte) in bytes.iter().enumerate() {
        let _ = write!(text, "{}{byte},", if at % 32 == 0 { "\n    " } else { "" });
    }
    text + "\n};\n"
}
