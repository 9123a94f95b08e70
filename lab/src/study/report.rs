//! A study as a page of Markdown, with a picture beside it.

use super::plan::{Plan, Run};
use super::summary::{self, Column, Row};
use super::{StudyOptions, likeness};
use crate::calibration::Mean;
use crate::study::agent::language::Language;
use crate::study::agent::{Contestant, Learns};
use crate::study::course::{COMPARED, Course};
use crate::study::trial::{CERTAIN, MOST_STEPS, TEST_STEPS};
use crate::study::tuning::{SEEDS, TRAINED_BY, TUNED};
use goodbot_console::{Failure, Kind, Output, say};
use std::path::Path;

/// The agents in the tables of the other trainers. Without an inference, what trainers say makes no difference.
const TRAINED: [&str; 5] = ["this+roles", "sabl+roles", "tamer+roles", "coach+roles", "shaping+roles"];
/// The columns of these tables.
const SHOWN: [Column; 3] = [Column::Tests, Column::Steps, Column::WronglyCertain];
/// The trainers in the picture.
const DRAWN: [&str; 2] = ["balanced", "mute"];

/// Runs the study, and writes the page and its picture.
///
/// # Errors
/// [`Failure`].
pub fn write(page: &Path, options: &StudyOptions) -> Result<(), Failure> {
    let text = Output::new(Kind::Page, page, &options.fit, options.force)?;
    if text.is_standard() {
        return Err(Failure::Input("the picture goes beside the page; name a file for it".to_owned()));
    }
    let beside = page.with_extension("svg");
    let target = Output::new(Kind::Picture, &beside, &options.fit, options.force)?;
    let checks = if options.fit.is_empty() { None } else { Some(likeness::markdown(options)?) };
    let (plan, runs) = options.runs()?;
    let rows = summary::rows(&plan, &runs);
    let drawn: Vec<Row> = rows.iter().filter(|row| DRAWN.contains(&row.trainer)).cloned().collect();
    target.draw(summary::picture(&plan, &drawn))?;
    let picture = beside.file_name().unwrap_or_default().to_string_lossy().into_owned();
    text.write(markdown(&plan, &runs, &rows, &picture, checks.as_deref()).as_bytes())?;
    say!("page: {}", text.name());
    Ok(())
}

fn markdown(plan: &Plan, runs: &[Run], rows: &[Row], picture: &str, checks: Option<&str>) -> String {
    let (first, last) = (plan.seed, plan.seed_at(plan.runs - 1));
    let program = plan.agents.iter().find_map(Contestant::program);
    let mut program = program.map_or_else(String::new, |command| format!(" --program \"{command}\""));
    let mut fewer = String::new();
    if plan.program_runs < plan.runs {
        program += &format!(" --program-runs {}", plan.program_runs);
        fewer = format!(" Agents with a program have the first {} seeds.", plan.program_runs);
    }
    let mut text = format!(
        "# Comparison with other agents\n\n\
         Do people's words teach goodbot more than they teach other learners? An agent here has two parts: an *inference* finds the task \
         that a command means, and a *language* learns words from it. So `tamer+roles` is TAMER with goodbot's role model. Up to {} kinds of \
         simulated trainers teach each of them, in {} courses. Each number is a mean over {} seeds ({first} to {last}) with half of its 95 % \
         interval; each seed has its own homes and trainers, the same for all agents.{fewer}\n\n\
         `goodbot study --runs {} --seed {first}{program}{} --report study.md` writes this page, and `--csv` prints all figures.\n\n",
        plan.trainers.len(),
        plan.courses.len(),
        plan.runs,
        plan.runs,
        if checks.is_some() { " --fit feedback.jsonl" } else { "" },
    );
    text += &format!(
        "## Limitations\n\
         - No human took part. `population` and `leaving` are fitted to recorded sessions of twelve people, with four commands only, and \
         `this` expects trainers that were fitted to the same sessions. A simulated trainer never tires or changes its mind.\n\
         - TAMER, COACH and policy shaping were made for other purposes. Here they choose among tasks, begin with the language's \
         probabilities, and have goodbot's exact planner.\n\
         - A lesson ends after three rests at the goal, when the goal becomes unreachable, or after {MOST_STEPS} steps. No agent takes \
         the end as evidence.\n\n\
         ## What is compared\nThe courses:\n"
    );
    for course in &plan.courses {
        text += &format!("- `{}`: {}.\n", course.name(), course.is());
    }
    text += "\nThe agents:\n";
    text += &compared(plan);
    text += &format!(
        "All agents learn from the inference's belief at the end of a lesson, act for the likeliest task or a drawn one, and go straight on if \
         they can. goodbot as it is used: `goodbot study --agents goodbot,people,asking,paper`. `goodbot study --tune` chose the settings of \
         {}, by the highest share of tests right minus steps a lesson / {MOST_STEPS}, on seeds {} to {} of the `paper` course, with the \
         trainers {}.\n\n",
        TUNED.map(|name| format!("`{name}`")).join(", "),
        SEEDS.start,
        SEEDS.end - 1,
        TRAINED_BY.join(", "),
    );
    text += "Agents `NAME+program` ask a program of yours, here [a recurrent network](../../benches/peers/gru.py), in lines of JSON. `begin` \
             starts a new model. `hear` has `words`, and the facts of each of the `tasks`; it alone is answered, by one list of log \
             likelihoods. `learn` also has `beliefs`.\n\n";
    text += "The trainers, all of them as balanced where nothing else is said:\n";
    for trainer in &plan.trainers {
        text += &format!("- `{}` {}.\n", trainer.name, trainer.does);
    }
    text += &format!(
        "\n## Tests right, of five\nA test is right if the agent does the intended task and then rests, in at most {TEST_STEPS} steps, \
         without feedback. `mute` and `shuffled` are controls, and so is `contrary`, from whom nobody learns (`--csv`). *Due to feedback* is \
         the difference between `balanced` and `mute`, seed by seed.\n\n\
         ![tests right for each agent, with a balanced trainer and with a mute one]({picture})\n"
    );
    for (at, course) in plan.courses.iter().enumerate() {
        text += &format!("\n### Course {}\n| agent |", course.name());
        // From the contrary trainer nobody learns.
        let shown = COMPARED.into_iter().filter(|name| *name != "contrary" && position(plan, name).is_some());
        let shown: Vec<&str> = shown.collect();
        shown.iter().for_each(|name| text += &format!(" {name} |"));
        text += &format!(" due to feedback |\n|---|{}---:|\n", "---:|".repeat(shown.len()));
        for (agent, contestant) in plan.agents.iter().enumerate().filter(|(_, agent)| language(agent).is_none()) {
            text += &format!("| `{}` |", contestant.name);
            for trainer in &shown {
                text += &format!(" {} |", cell(rows, *course, trainer, contestant.name, Column::Tests));
            }
            text += &format!(" {} |\n", due(plan, runs, at, agent).map_or("-".to_owned(), short));
        }
    }
    text += &languages(plan, rows);
    text += &format!(
        "\n## Other trainers, steps and wrong certainty, in the course {}\n*Wrongly certain* is the share of commands for which the agent ever gave a wrong task more \
         than {:.0} %. A lesson that ends before the goal counts as {MOST_STEPS} steps.\n",
        plan.courses.first().map_or("", |course| course.name()),
        100.0 * CERTAIN,
    );
    let agents: Vec<&str> = TRAINED.into_iter().filter(|name| plan.agents.iter().any(|agent| agent.name == *name)).collect();
    for column in SHOWN {
        // The course's own table has the tests of the compared trainers. Steps and certainty with the last two, which mislead, tell nothing.
        let is_shown = |name: &str| if column == Column::Tests { !COMPARED.contains(&name) } else { COMPARED[..3].contains(&name) };
        let trainers: Vec<&str> = plan.trainers.iter().map(|trainer| trainer.name).filter(|name| is_shown(name)).collect();
        if trainers.is_empty() {
            continue;
        }
        text += &format!("\n| {} |", column.head());
        agents.iter().for_each(|name| text += &format!(" {name} |"));
        text += &format!("\n|---|{}\n", "---:|".repeat(agents.len()));
        for trainer in trainers {
            text += &format!("| `{trainer}` |");
            for agent in &agents {
                text += &format!(" {} |", cell(rows, plan.courses[0], trainer, agent, column));
            }
            text += "\n";
        }
    }
    if let Some(checks) = checks {
        text += &format!(
            "\n## Are simulated trainers like real ones?\nPeople drawn from the fit judge the same recorded actions. Their words after right and \
             wrong actions were fitted; these figures were not (`goodbot study --fit feedback.jsonl --runs {}` prints both):\n\n{checks}",
            plan.runs
        );
    }
    text.truncate(text.trim_end().len());
    text + "\n"
}

/// The name of an agent's language, if it is not goodbot's own.
fn language(agent: &Contestant) -> Option<&'static str> {
    agent.name.split_once('+').map(|(_, language)| language).filter(|language| *language != "roles")
}

/// The first inference with each language, taught by the first of the compared trainers.
fn languages(plan: &Plan, rows: &[Row]) -> String {
    let parts = plan.agents.iter().filter_map(|agent| agent.name.split_once('+'));
    let Some((inference, _)) = parts.clone().next() else { return String::new() };
    let languages: Vec<&str> = parts.filter(|(of, _)| *of == inference).map(|(_, language)| language).collect();
    let Some(trainer) =
        COMPARED.into_iter().find(|name| position(plan, name).is_some()).filter(|_| languages.iter().any(|name| *name != "roles"))
    else {
        return String::new();
    };
    let mut text =
        format!("\n### Languages\nWith the inference `{inference}` and the trainer `{trainer}` (`--csv` has the others).\n\n| course |");
    languages.iter().for_each(|language| text += &format!(" {language} |"));
    text += &format!("\n|---|{}\n", "---:|".repeat(languages.len()));
    for course in &plan.courses {
        text += &format!("| {} |", course.name());
        for language in &languages {
            text += &format!(" {} |", cell(rows, *course, trainer, &format!("{inference}+{language}"), Column::Tests));
        }
        text += "\n";
    }
    text
}

/// What is compared: each agent as it is used, each inference with its settings and source, and the languages in one sentence.
fn compared(plan: &Plan) -> String {
    let mut text = String::new();
    for agent in &plan.agents {
        if let Learns::Whole(settings) = agent.learns {
            text += &format!("- `{}`: {} ({settings}).\n", agent.name, agent.is);
        }
    }
    let inferences = plan.agents.iter().filter_map(|agent| {
        let Learns::Factors(inference, _) = agent.learns else { return None };
        let (name, is) = (agent.name.split_once('+')?.0, agent.is.split_once("; ")?.0);
        let source = inference.source().map_or(String::new(), |(source, simpler)| format!(" {source}. Simpler here: {simpler}."));
        Some(format!("- `{name}`: {is} ({inference}).{source}\n"))
    });
    text += &once(inferences).concat();
    let languages = plan.agents.iter().filter_map(|agent| {
        let Learns::Factors(_, language) = agent.learns else { return None };
        let (name, is) = (agent.name.split_once('+')?.1, agent.is.split_once("; ")?.1);
        Some(match language {
            Language::LogLinear(settings) => format!("`{name}` ({is}: {settings})"),
            Language::Program(settings) => format!("`{name}` ({is}: `{}`)", settings.command),
            Language::Roles | Language::ModelTwo | Language::Nothing => format!("`{name}` ({is})"),
        })
    });
    let languages = once(languages);
    text.push('\n');
    if !languages.is_empty() {
        text += &format!("The languages are {}. ", languages.join(", "));
    }
    text
}

/// Each thing once, in the order of its first place.
fn once<T: PartialEq>(things: impl Iterator<Item = T>) -> Vec<T> {
    things.fold(Vec::new(), |mut found, thing| {
        if !found.contains(&thing) {
            found.push(thing);
        }
        found
    })
}

fn position(plan: &Plan, trainer: &str) -> Option<usize> {
    plan.trainers.iter().position(|known| known.name == trainer)
}

fn cell(rows: &[Row], course: Course, trainer: &str, agent: &str, column: Column) -> String {
    let row = rows.iter().find(|row| row.course == course && row.trainer == trainer && row.agent == agent);
    row.map_or("-".to_owned(), |row| short(row.mean(column)))
}

/// A mean with half of its interval, in a short form.
fn short(Mean { mean, half }: Mean) -> String {
    if mean.abs() < 10.0 { format!("{mean:.2}±{half:.2}") } else { format!("{mean:.1}±{half:.1}") }
}

/// How many more tests are right with the balanced trainer than with the mute one, seed by seed.
fn due(plan: &Plan, runs: &[Run], course: usize, agent: usize) -> Option<Mean> {
    let (taught, alone) = (position(plan, COMPARED[0])?, position(plan, COMPARED[2])?);
    let right = |trainer: usize| {
        let own = runs.iter().filter(move |run| run.course == course && run.trainer == trainer && run.agent == agent);
        own.map(|run| run.outcome.tests_right() as f64)
    };
    // Both lists have the seeds in the same order.
    Some(Mean::of(right(taught).zip(right(alone)).map(|(taught, alone)| taught - alone)))
}
