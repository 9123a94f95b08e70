//! A study as a page of Markdown, with pictures beside it.

use super::plan::Plan;
use super::summary::{self, Column, Row};
use super::{StudyOptions, likeness, picture, table};
use crate::study::agent::Learns;
use crate::study::trial::{CERTAIN, MOST_STEPS, TEST_STEPS};
use crate::study::tuning::{SEEDS, TRAINED_BY};
use goodbot_console::messages::say;
use goodbot_console::outcome::Failure;
use goodbot_console::output::Output;
use std::path::Path;

/// The columns that are drawn.
const DRAWN: [Column; 3] = [Column::Tests, Column::Steps, Column::Words];

/// Runs the study, or reads its parts, and writes the page and its pictures.
///
/// # Errors
/// [`Failure`].
pub fn write(page: &Path, options: &StudyOptions) -> Result<(), Failure> {
    let text = Output::page(page, options.inputs(), options.force)?;
    if text.is_standard() {
        return Err(Failure::Input("the pictures go beside the page; name a file for it".to_owned()));
    }
    let beside = |column: Column| page.with_extension(format!("{}.svg", column.name()));
    let pictures = DRAWN.map(|column| Output::picture(&beside(column), options.inputs(), options.force));
    let checks = if options.fit.is_empty() { None } else { Some(likeness::markdown(options)?) };
    let (plan, runs) = options.runs()?;
    let rows = summary::rows(&plan, &runs);
    for (column, target) in DRAWN.into_iter().zip(pictures) {
        let drawing = picture::of(&plan, &rows, column).map_err(|error| Failure::Result(format!("cannot draw the picture: {error}")))?;
        target?.write(drawing.as_bytes())?;
    }
    let links: Vec<String> = DRAWN.iter().map(|&column| link(column, &beside(column))).collect();
    text.write(markdown(&plan, &rows, &links, checks.as_deref()).as_bytes())?;
    say!("page: {}", text.name());
    Ok(())
}

fn link(column: Column, file: &Path) -> String {
    let name = file.file_name().unwrap_or_default().to_string_lossy();
    format!("![{}, for each agent and trainer]({name})\n", column.head())
}

fn markdown(plan: &Plan, rows: &[Row], links: &[String], checks: Option<&str>) -> String {
    let (first, last) = (plan.seed, plan.seed_at(plan.runs - 1));
    let mut text = format!(
        "# Comparison with other agents\n\n\
         Compares goodbot with other agents that learn from a person's words, in the paper's course of seven lessons and five tests, with \
         {} kinds of trainers. Every number covers {} seeds ({first} to {last}). Each seed has its own homes; all agents meet the same \
         homes and trainers. Intervals are 95 %.\n\n\
         `goodbot study --runs {} --seed {first}{} --report study.md` writes this page. With `--shard PART/OF --json` several machines \
         share the work, and `--merge` joins their parts.\n\n",
        plan.trainers.len(),
        plan.runs,
        plan.runs,
        if checks.is_some() { " --fit feedback.jsonl" } else { "" },
    );
    text += &format!(
        "## Limitations\n\
         - No human took part: the trainers are simulated. The trainer `population` is fitted to recorded sessions of twelve people, with \
         four commands only. A simulated trainer never tires and never changes its mind.\n\
         - The course is small, and goodbot's language model was made for such commands. The other algorithms were made for other purposes \
         and understand no commands. Both of their forms here are adaptations to this course.\n\
         - A lesson ends when the agent has rested three times at the goal, when the goal becomes unreachable, or after {MOST_STEPS} \
         steps. Real trainers leave sooner, as the trainer `leaving` does.\n\
         - No agent is told which trainer it has. But `people` and `asking` expect trainers that were fitted to the same recorded sessions \
         as `population`; there they know more than the other agents.\n\n\
         ## The columns\n\
         - *Tests right*: of five commands in a new home, without feedback. A test is right if the agent does the intended task and then \
         rests, in at most {TEST_STEPS} steps.\n\
         - *Words said*: how often the trainer said good bot or bad bot, or answered a question, in all seven lessons together. One answer \
         in twenty is wrong, for every trainer.\n\
         - *Steps a lesson*: steps until the lesson ended at the goal, or {MOST_STEPS} if it ended elsewhere. The median is over all \
         lessons of all seeds.\n\
         - *Wrongly certain*: the share of the twelve commands for which the agent ever gave a wrong task more than {:.0} %. An agent with \
         \"-\" has no such probability.\n\
         - *Gave up*: the share of lessons that ended before the goal.\n\n",
        100.0 * CERTAIN,
    );
    text += "## The agents\nIn the tabular form an agent learns the good actions of each command, home and state. In the shared form it learns a weight \
             for each pair of a word (or two neighbours, or none) and a fact of a task (its kind, the colour of the room, the colour and shape of \
             the block). The weights score the tasks of a command, and goodbot's exact planner acts for the best one. In this form each \
             word of the trainer judges every task: it supports the tasks that agree with the action and counts against the others. Most \
             of the original algorithms have no such help; it makes them comparable.\n\n| agent | description | settings |\n|---|---|---|\n";
    for agent in &plan.agents {
        text += &format!("| `{}` | {} | {} |\n", agent.name, agent.is, agent.learns);
    }
    text += &format!(
        "\nOne rule chose the settings of the other algorithms, on seeds {} to {} with the trainers {}: the highest share of tests right \
         minus steps a lesson / {MOST_STEPS} (`goodbot study --tune`).\n\n",
        SEEDS.start,
        SEEDS.end - 1,
        TRAINED_BY.join(", "),
    );
    let mut told: Vec<&str> = Vec::new();
    for agent in &plan.agents {
        let (source, simpler) = agent.learns.source();
        if !told.contains(&source) {
            told.push(source);
            let simpler = if simpler.is_empty() { String::new() } else { format!(" Simpler here: {simpler}") };
            text += &format!("- {}: {source}.{simpler}\n", family(&agent.learns));
        }
    }
    text += "\n## The trainers\n| trainer | what it does |\n|---|---|\n";
    for trainer in &plan.trainers {
        text += &format!("| `{}` | {} |\n", trainer.name, trainer.does);
    }
    text += "\nThe worst tenth of a population are the people whose words tell least whether an action was right (mutual information). All \
             agents meet the same people.\n";
    if let Some(checks) = checks {
        text += &format!(
            "\n### Are simulated trainers like real ones?\nPeople drawn from the fit judge the same recorded actions. `goodbot study --fit \
             feedback.jsonl --runs {}`; the recorded sessions are not in this repository.\n\n{checks}",
            plan.runs
        );
    }
    text += "\n## Results\n";
    for link in links {
        text += &format!("{link}\n");
    }
    for group in rows.chunks(plan.agents.len()) {
        let Some(first) = group.first() else { continue };
        text += &format!("### Trainer {}\n", first.trainer);
        text += "| agent |";
        Column::ALL.iter().for_each(|column| text += &format!(" {} |", column.head()));
        text += " median steps |\n|---|---:|---:|---:|---:|---:|---:|---:|\n";
        for row in group {
            text += &format!("| `{}` |", row.agent);
            Column::ALL.iter().for_each(|&column| text += &format!(" {} |", table::mean(row.mean(column))));
            text += &format!(" {} |\n", table::median(row));
        }
        text += "\n";
    }
    text.truncate(text.trim_end().len());
    text + "\n"
}

/// The name of an algorithm.
const fn family(learns: &Learns) -> &'static str {
    match learns {
        Learns::Goodbot(_) => "goodbot",
        Learns::Tamer(_) => "TAMER",
        Learns::Coach(_) => "COACH",
        Learns::Advise(_) => "Advise",
        Learns::Cobot(_) => "Cobot",
    }
}
