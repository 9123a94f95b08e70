//! `goodbot migrate`: a model for the next version of a robot.

use clap::{Args, ValueHint};
use goodbot::oomdp::Domain;
use goodbot::snapshot::Contents;
use goodbot_console::migration::{Migrated, Migration};
use goodbot_console::{Failure, InputFile, Kind, Output, counted, input, read_model, restored, say};
use goodbot_lesson::world::robot::{self, Robot, WorldFlaw};
use std::path::PathBuf;

/// Take a model over to the next version of its robot
#[derive(Clone, Debug, Args)]
#[command(after_help = "\
What has the same name in both versions is kept, wherever it is. A proposition, class or attribute with another name needs --rename. Sessions that meant \
a kind of task which the next version does not have are left out, and told. A controller takes a model by itself if the next version only has more \
propositions or attributes, at the ends of their lists.

Example:
  goodbot migrate robot.goodbot --from old.json --to new.json --rename liftAtFloor=cabinAtFloor --out new.goodbot")]
pub struct MigrateArgs {
    /// The model
    #[arg(value_name = "MODEL", value_hint = ValueHint::FilePath)]
    model: PathBuf,
    /// The world that it was learned in, as JSON
    #[arg(long, value_name = "WORLD", value_hint = ValueHint::FilePath)]
    from: InputFile,
    /// The world of the next version
    #[arg(long, value_name = "WORLD", value_hint = ValueHint::FilePath)]
    to: InputFile,
    /// A name that changed; may be given several times
    #[arg(long, value_name = "OLD=NEW", value_parser = renamed)]
    rename: Vec<(String, String)>,
    /// The model to write; - is standard output
    #[arg(long, short = 'o', value_name = "MODEL", value_hint = ValueHint::FilePath)]
    out: PathBuf,
    /// Replace a file that is no model
    #[arg(long)]
    force: bool,
}

fn renamed(text: &str) -> Result<(String, String), String> {
    let names = text.split_once('=').filter(|(old, new)| !old.is_empty() && !new.is_empty());
    names.map(|(old, new)| (old.to_owned(), new.to_owned())).ok_or_else(|| "is no OLD=NEW, such as liftAtFloor=cabinAtFloor".to_owned())
}

/// Runs the command.
///
/// # Errors
/// [`Failure`] names the file and its fault.
pub fn run(args: &MigrateArgs) -> Result<(), Failure> {
    let inputs = [args.model.as_path(), args.from.as_ref(), args.to.as_ref()];
    let target = Output::new(Kind::Model, &args.out, inputs, args.force)?;
    let bytes = read_model(&args.model)?;
    let Migrated { model, lost, sessions } = in_world(&args.from, |old| in_world(&args.to, |new| migrated(args, old, new, &bytes)))???;
    for name in &lost {
        say!("{}: {name} is not in {}; --rename says its new name", target.name(), input::name(&args.to));
    }
    let contents = Contents::read(&model).map_err(|error| Failure::of(&args.model, error))?;
    let (mut file, vocabulary) = (model.clone(), contents.vocabulary);
    if !sessions.is_empty() {
        let mut agent = restored::agent_of(&args.model, &model)?;
        for &session in sessions.iter().rev() {
            let _ = agent.unlearn(session);
        }
        restored::learn_fully(&mut agent);
        file = agent.saved_for(vocabulary)?;
    }
    target.write(&file)?;
    let kept = contents.sessions.len() - sessions.len();
    let gone = if sessions.is_empty() { String::new() } else { format!("; {} left out", counted(sessions.len(), "session")) };
    say!("{}: {}{gone}", target.name(), counted(kept, "session"));
    Ok(())
}

/// Runs something with the robot of a world file.
fn in_world<R>(world: &InputFile, run: impl FnOnce(&Robot<'_>) -> R) -> Result<R, Failure> {
    let file = input::world(world)?;
    robot::with(&file.world, |robot, _| run(robot)).map_err(|flaw: WorldFlaw| file.fault(&flaw.field, &flaw.message).into())
}

fn migrated(args: &MigrateArgs, old: &Robot<'_>, new: &Robot<'_>, bytes: &[u8]) -> Result<Migrated, Failure> {
    let kinds = |robot: &Robot<'_>, name: &str| {
        robot::tasks(robot.file(), robot).map_err(|flaw| Failure::Input(format!("{name}: {}: {}", flaw.field, flaw.message)))
    };
    let [before, after] = [kinds(old, input::name(&args.from))?, kinds(new, input::name(&args.to))?];
    let renamed: Vec<(&str, &str)> = args.rename.iter().map(|(old, new)| (old.as_str(), new.as_str())).collect();
    let [from, to] = [old, new].map(|robot| robot.world().schema);
    Migration { from, to, kinds: [&before, &after], renamed: &renamed }.of(bytes).map_err(|error| Failure::of(&args.model, error))
}
