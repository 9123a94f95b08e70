//! Runs as JSON lines: the plan first, then a line for each run. The lines of parts can be joined.

use super::plan::Plan;
use super::runs::Run;
use super::shard::Shard;
use crate::study::agent::AGENTS;
use crate::study::agent::language::{PROGRAM, program};
use crate::study::course::Course;
use crate::study::trainer::TRAINERS;
use crate::study::trainer::population::Population;
use crate::study::trial::{Ending, LessonOutcome, Outcome, TestOutcome};
use goodbot_console::load::input::{self, InputFile};
use goodbot_console::outcome::Failure;
use goodbot_lesson::Fault;
use serde_json::{Value, json};
use std::io::BufRead;

/// The version of the lines.
const VERSION: u64 = 3;

/// The first line: the plan, with all settings. Parts of one study differ only in their part.
pub fn plan_to_json(plan: &Plan) -> Value {
    let agents: Vec<Value> = plan.agents.iter().map(|agent| json!({"name": agent.name, "settings": agent.learns.to_string()})).collect();
    let trainers: Vec<&str> = plan.trainers.iter().map(|trainer| trainer.name).collect();
    let courses: Vec<&str> = plan.courses.iter().map(|course| course.name()).collect();
    json!({
        "type": "study",
        "version": VERSION,
        "program": env!("CARGO_PKG_VERSION"),
        "courses": courses,
        "agents": agents,
        "trainers": trainers,
        "population": plan.population.digest(),
        "seed": plan.seed,
        "runs": plan.runs,
        "program_runs": plan.program_runs,
        "part": plan.shard.to_string(),
    })
}

/// The line of a run.
pub fn run_to_json(plan: &Plan, run: &Run) -> Value {
    let Outcome { lessons, tests } = &run.outcome;
    let of = |number: fn(&LessonOutcome) -> u16| lessons.iter().map(number).collect::<Vec<_>>();
    let certain = lessons.iter().map(|lesson| lesson.wrongly_certain).chain(tests.iter().map(|test| test.wrongly_certain));
    json!({
        "type": "run",
        "seed": run.seed,
        "course": plan.courses[run.course].name(),
        "trainer": plan.trainers[run.trainer].name,
        "agent": plan.agents[run.agent].name,
        "endings": lessons.iter().map(|lesson| lesson.ending.name()).collect::<Vec<_>>(),
        "steps": of(|lesson| lesson.steps),
        "words": of(|lesson| lesson.words),
        "answers": of(|lesson| lesson.answers),
        "tests": tests.iter().map(|test| test.right).collect::<Vec<_>>(),
        "wrongly_certain": certain.collect::<Vec<_>>(),
    })
}

/// The plan in a file's first line.
fn plan_from_json(line: &Value) -> Result<Plan, String> {
    let text = |name: &str| line[name].as_str().ok_or_else(|| format!("has no {name:?}"));
    if line["type"] != "study" {
        return Err("is no study; name a file that goodbot study --json has written".to_owned());
    }
    if line["version"] != VERSION || line["program"] != env!("CARGO_PKG_VERSION") {
        return Err(format!("was written by another version of goodbot; run it again with {}", env!("CARGO_PKG_VERSION")));
    }
    let list = |name: &str| line[name].as_array().ok_or_else(|| format!("has no list {name:?}"));
    let mut agents = Vec::new();
    for agent in list("agents")? {
        let known = AGENTS.iter().find(|known| agent["name"] == known.name);
        let known = known.ok_or_else(|| format!("names an agent {} that is not known", agent["name"]))?;
        let command = agent["settings"].as_str().and_then(|settings| settings.split_once(PROGRAM));
        // Joined runs need no answer.
        let known = known.with_program(program::Settings::new(command.map_or("", |(_, command)| command), 0));
        if agent["settings"] != known.learns.to_string() {
            return Err(format!("has other settings of {}: {}; run it again with this version", known.name, agent["settings"]));
        }
        agents.push(known);
    }
    let mut trainers = Vec::new();
    for trainer in list("trainers")? {
        let known = TRAINERS.iter().find(|known| *trainer == known.name);
        trainers.push(*known.ok_or_else(|| format!("names a trainer {trainer} that is not known"))?);
    }
    let mut courses = Vec::new();
    for course in list("courses")? {
        let known = Course::ALL.into_iter().find(|known| *course == known.name());
        courses.push(known.ok_or_else(|| format!("names a course {course} that is not known"))?);
    }
    let population = Population::fitted();
    if line["population"] != population.digest() {
        return Err("has trainers from another fit to real people; they cannot be drawn again here".to_owned());
    }
    let seed = line["seed"].as_u64().ok_or("has no seed")?;
    let number = |name: &str| {
        let number = line[name].as_u64().and_then(|number| u32::try_from(number).ok()).filter(|&number| number > 0);
        number.ok_or_else(|| format!("has no number of {name}"))
    };
    let (runs, program_runs) = (number("runs")?, number("program_runs")?);
    Ok(Plan { courses, agents, trainers, population, seed, runs, program_runs, shard: text("part")?.parse()? })
}

fn run_from_json(plan: &Plan, line: &Value) -> Result<Run, String> {
    if line["type"] != "run" {
        return Err("is no run".to_owned());
    }
    let position = |found: Option<usize>, what: &str| found.ok_or_else(|| format!("names {what} that its study does not have"));
    let course = position(plan.courses.iter().position(|known| line["course"] == known.name()), "a course")?;
    let trainer = position(plan.trainers.iter().position(|known| line["trainer"] == known.name), "a trainer")?;
    let agent = position(plan.agents.iter().position(|known| line["agent"] == known.name), "an agent")?;
    let count = |name: &str, at: usize| {
        let number = line[name][at].as_u64().and_then(|number| u16::try_from(number).ok());
        number.ok_or_else(|| format!("has no whole number in {name}[{at}]"))
    };
    let certain = |at: usize| line["wrongly_certain"][at].as_bool().ok_or_else(|| format!("has no answer in wrongly_certain[{at}]"));
    let length = |name: &str| line[name].as_array().map(Vec::len).ok_or_else(|| format!("has no list {name:?}"));
    let lesson = |at: usize| {
        let ending = Ending::ALL.into_iter().find(|ending| line["endings"][at] == ending.name());
        Ok(LessonOutcome {
            ending: ending.ok_or_else(|| format!("has no ending in endings[{at}]"))?,
            steps: count("steps", at)?,
            words: count("words", at)?,
            answers: count("answers", at)?,
            wrongly_certain: certain(at)?,
        })
    };
    let lessons = (0..length("endings")?).map(lesson).collect::<Result<Vec<_>, String>>()?;
    let test = |at: usize| {
        let right = line["tests"][at].as_bool().ok_or_else(|| format!("has no answer in tests[{at}]"))?;
        Ok(TestOutcome { right, wrongly_certain: certain(lessons.len() + at)? })
    };
    let tests = (0..length("tests")?).map(test).collect::<Result<Vec<_>, String>>()?;
    Ok(Run { seed: line["seed"].as_u64().ok_or("has no seed")?, course, trainer, agent, outcome: Outcome { lessons, tests } })
}

/// Reads the parts of a study, in any order, and joins them to the whole.
///
/// # Errors
/// [`Failure::Input`] names the file and line, or the part that is missing or given twice.
pub fn read(files: &[InputFile]) -> Result<(Plan, Vec<Run>), Failure> {
    let mut whole: Option<(String, Plan)> = None;
    let mut runs = Vec::new();
    let mut parts = Vec::new();
    for file in files {
        let mut plan: Option<Plan> = None;
        for (line, number) in input::open(file)?.lines().zip(1..) {
            let wrong = |message: String| Fault::on_line(input::name(file), number, message);
            let line = line.map_err(|error| wrong(format!("cannot be read ({error}); check that it is text")))?;
            let line: Value = serde_json::from_str(&line).map_err(|error| wrong(format!("is no JSON ({error})")))?;
            match &plan {
                None => plan = Some(plan_from_json(&line).map_err(wrong)?),
                // The summaries after the runs are computed again.
                Some(_) if line["type"] == "summary" => break,
                Some(plan) => runs.push(run_from_json(plan, &line).map_err(wrong)?),
            }
        }
        let plan = plan.ok_or_else(|| Fault::new(input::name(file), "is empty; name a file that goodbot study --json has written"))?;
        parts.push((input::name(file).to_owned(), plan.shard));
        match &whole {
            None => whole = Some((input::name(file).to_owned(), Plan { shard: Shard::WHOLE, ..plan })),
            Some((first, whole)) if plan_to_json(&Plan { shard: Shard::WHOLE, ..plan }) != plan_to_json(whole) => {
                return Err(Failure::Input(format!("{} is of another study than {first}; join parts of one", input::name(file))));
            }
            Some(_) => {}
        }
    }
    let (_, plan) = whole.ok_or_else(|| Failure::Input("there is nothing to join; name files".to_owned()))?;
    check_parts(&parts).map_err(Failure::Input)?;
    let place = |run: &Run| (run.seed.wrapping_sub(plan.seed), run.course, run.trainer, run.agent);
    runs.sort_by_key(place);
    let (whole, taught) = (&plan, plan.taught());
    let of_seed = |position: u32| {
        let agents =
            move |(course, trainer)| whole.agents_at(position).map(move |(agent, _)| (u64::from(position), course, trainer, agent));
        taught.iter().copied().flat_map(agents)
    };
    // One after another, because a file can claim any number of seeds.
    let is_whole = (0..plan.runs).flat_map(of_seed).eq(runs.iter().map(place));
    if !is_whole {
        let message = format!("{} runs where {} belong to the study; a file is cut off or was changed", runs.len(), plan.all_runs());
        return Err(Failure::Input(message));
    }
    Ok((plan, runs))
}

/// Checks that each part is given once.
fn check_parts(parts: &[(String, Shard)]) -> Result<(), String> {
    let Some((first, Shard { of, .. })) = parts.first() else { return Ok(()) };
    for (position, (file, part)) in parts.iter().enumerate() {
        if part.of != *of {
            return Err(format!("{file} is part {part}, and {first} is one of {of}; join parts of one division"));
        }
        if let Some((other, _)) = parts[..position].iter().find(|(_, other)| other == part) {
            return Err(format!("{file} and {other} are both part {part}; name each part once"));
        }
    }
    match (1..=*of).find(|&number| parts.iter().all(|(_, part)| part.number != number)) {
        Some(number) => Err(format!("part {number}/{of} is missing; run it with --shard {number}/{of}, and name its file too")),
        None => Ok(()),
    }
}
