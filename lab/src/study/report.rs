//! The tables of docs/appendix/study.md, as Markdown.

use super::plan::{Plan, Run};
use super::summary::{Column, Row};
use crate::calibration::Mean;
use crate::study::agent::Contestant;
use crate::study::course::{COMPARED, Course};

/// The agents in the tables of the other trainers. Without an inference, what trainers say makes no difference.
const TRAINED: [&str; 5] = ["this+roles", "sabl+roles", "tamer+roles", "coach+roles", "shaping+roles"];
/// The columns of these tables.
const SHOWN: [Column; 3] = [Column::Tests, Column::Steps, Column::WronglyCertain];

/// The tables of a study: tests right in each course, languages, and other trainers.
pub fn tables(plan: &Plan, runs: &[Run], rows: &[Row]) -> String {
    let mut text = String::new();
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
