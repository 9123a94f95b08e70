//! Commands in a world from a file: their meanings, and the plan if a robot acts there.

use super::{AskOptions, SURE, end, lines, tell_refused, unread_words};
use goodbot::Capacities;
use goodbot::language::{LanguageModel, Synonyms};
use goodbot::memory::AgentHeap;
use goodbot_console::load::content::Content;
use goodbot_console::load::input;
use goodbot_console::load::synonyms::in_known_words;
use goodbot_console::messages::counted;
use goodbot_console::outcome::Failure;
use goodbot_console::printed::Printed;
use goodbot_console::restored;
use goodbot_console::training_data::{Lesson, training, worlds};
use goodbot_console::whole_file::options_of_model;
use goodbot_formats::task_text::GroundTaskText;
use goodbot_formats::world::WorldFile;
use goodbot_lesson::first_words::read;
use goodbot_lesson::world::robot;
use serde_json::json;
use std::io::{BufRead, Write};

/// The most meanings that are printed.
const TOLD: usize = 10;

/// The commands, and the world if it has actions.
#[derive(Debug, Default)]
pub struct Questions {
    /// Each question, or a refused command with the reason.
    lessons: Vec<Result<Lesson, (String, String)>>,
    world: Option<WorldFile>,
    /// Whether a robot acts in all worlds.
    act: bool,
}

/// The commands, if the options name a world or a log of worlds; otherwise `None`.
///
/// # Errors
/// The fault of the file or of the options.
pub fn questions(options: &AskOptions) -> Result<Option<Questions>, Failure> {
    // Standard input is read once, for a home.
    let Some(file) = options.log.as_ref().or(options.environment.as_ref()).filter(|file| *file != "-") else { return Ok(None) };
    let name = input::name(file);
    let mut opened = input::open(file)?;
    // A file that cannot be read is refused later, when it is read.
    if opened.fill_buf().map(Content::of).ok() != Some(Content::Worlds) {
        return Ok(None);
    }
    if options.why || options.expected.is_some() || options.pull || options.starter.is_given() {
        return Err(Failure::Input(
            "--why, --expected, --pull and --starter are for homes; leave them out in a world from a file".to_owned(),
        ));
    }
    let agent = options_of_model(&options.with)?;
    if options.log.is_some() {
        let mut lessons = Vec::new();
        let mut left = usize::MAX;
        worlds::read(name, opened, agent, None, false, &mut left, |lesson| {
            lessons.extend(lesson?);
            Ok::<(), Failure>(())
        })?;
        lessons.retain(|lesson| options.session.as_ref().is_none_or(|id| lesson.header.id.as_ref() == Some(id)));
        if lessons.is_empty() {
            return Err(Failure::Input(format!("{name}: has no such command; check its id")));
        }
        let act = lessons.iter().all(|lesson| lesson.acts);
        return Ok(Some(Questions { act, lessons: lessons.into_iter().map(Ok).collect(), world: None }));
    }
    let world = input::WorldInFile::parse(name, input::rest(name, opened)?)?.world;
    let commands = match options.command.as_slice() {
        [only] if only == "-" => lines()?,
        words => vec![words.join(" ")],
    };
    let question = |command: &String| match worlds::question(name, &world, command, agent) {
        // The other commands are still asked.
        Err(refused) if commands.len() > 1 && refused.field.as_deref() == Some("command") => Ok(Err((command.clone(), refused.message))),
        question => Ok(Ok(question?)),
    };
    let lessons = commands.iter().map(question).collect::<Result<_, Failure>>()?;
    Ok(Some(Questions { lessons, act: !world.actions.is_empty(), world: Some(world).filter(|world| !world.actions.is_empty()) }))
}

/// Answers the questions.
///
/// # Errors
/// [`Failure`].
pub fn ask(options: &AskOptions, questions: &Questions) -> Result<(), Failure> {
    let mut memory = AgentHeap::new(&Capacities::NONE);
    let mut model = restored::language(&options.with, &mut memory, questions.lessons.iter().flatten(), questions.act)?;
    let synonyms = options.synonyms.read()?;
    let mut out = Printed::stdout();
    let mut refused = 0_usize;
    for (number, lesson) in questions.lessons.iter().enumerate() {
        let lesson = match lesson {
            Ok(lesson) => lesson,
            Err((command, message)) => {
                refused += 1;
                tell_refused(&mut out, options, command, message)?;
                continue;
            }
        };
        let (meanings, plan) = answer(&mut model, synonyms, lesson, questions.world.as_ref())?;
        let Some((best, share)) = meanings.first() else { continue };
        let verdict = if *share >= options.threshold.unwrap_or(SURE) { "sure" } else { "unsure" };
        let meant = lesson.intended.and_then(|task| lesson.readings.get(task)).map(|reading| reading.name.to_string());
        let told = meanings.iter().take(TOLD);
        let said = &lesson.header.command;
        let unread = read(said).ok().and_then(|read| read.long()).map(|long| long.unread());
        if options.json {
            let tasks: serde_json::Map<_, _> = told.map(|(name, share)| (name.clone(), json!(share))).collect();
            let mut line = json!({
                "type": "answer", "session": lesson.header.id, "command": said, "task": best, "tasks": tasks,
                "of": meanings.len(), "verdict": verdict, "expected": meant, "plan": plan,
            });
            if let Some(unread) = unread {
                line["unread"] = unread.into();
            }
            writeln!(out, "{line}")?;
            continue;
        }
        if number > 0 {
            writeln!(out)?;
        }
        writeln!(out, "\"{}\"", said.escape_debug())?;
        for (name, share) in told {
            writeln!(out, "  {share:6.3}  {name}")?;
        }
        if unread.is_some() {
            writeln!(out, "{}", unread_words())?;
        }
        writeln!(out, "{verdict}: {best}, of {}", counted(meanings.len(), "task"))?;
        match plan {
            Some(plan) => writeln!(out, "plan: {}", plan.join(" "))?,
            None if questions.world.is_some() => writeln!(out, "no plan leads there")?,
            None => {}
        }
        if let Some(meant) = meant {
            writeln!(out, "intended: {meant}")?;
        }
    }
    out.flush()?;
    end(refused, questions.lessons.len())
}

/// The tasks that a command may mean, the most probable first, with their probabilities; and the plan for the first one, if a robot acts
/// there.
type Answer = (Vec<(String, f32)>, Option<Vec<String>>);

fn answer(
    model: &mut LanguageModel<&mut AgentHeap>,
    synonyms: Synonyms<'_>,
    lesson: &Lesson,
    world: Option<&WorldFile>,
) -> Result<Answer, Failure> {
    let heard = in_known_words(synonyms, model.read(), &lesson.command)?;
    let asked = Lesson { command: heard, ..lesson.clone() };
    let posterior = training::posterior(model, &asked)?;
    let mut meanings: Vec<(String, f32)> =
        lesson.readings.iter().zip(&posterior).map(|(reading, &share)| (reading.name.to_string(), share)).collect();
    meanings.sort_by(|a, b| b.1.total_cmp(&a.1));
    let best = meanings.first().and_then(|(best, _)| best.parse::<GroundTaskText>().ok());
    let plan = match (world, best) {
        (Some(world), Some(task)) => robot::plan(world, &task).map_err(|flaw| Failure::Input(format!("{}: {flaw}", world.name)))?,
        _ => None,
    };
    Ok((meanings, plan))
}
