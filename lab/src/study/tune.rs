//! All settings of the agents that are not goodbot, each with its score, and which is best.

use super::StudyOptions;
use crate::study::agent::Learns;
use crate::study::trial::MOST_STEPS;
use crate::study::tuning::{SEEDS, TRAINED_BY, score};
use goodbot_console::messages::bar;
use goodbot_console::outcome::Failure;
use rayon::prelude::*;
use std::io::Write;

/// How many are told of each agent.
const TOLD: usize = 3;

/// Tries the settings and tells the best.
///
/// # Errors
/// [`Failure::Result`] where a run failed.
pub fn show(out: &mut impl Write, options: &StudyOptions) -> Result<(), Failure> {
    let plan = options.plan();
    let grids: Vec<(&str, Learns, Vec<Learns>)> =
        plan.agents.iter().map(|agent| (agent.name, agent.learns, agent.learns.grid())).filter(|(.., grid)| !grid.is_empty()).collect();
    let bar = bar(grids.iter().map(|(.., grid)| grid.len()).sum(), "trying settings");
    let (last, trainers) = (SEEDS.end - 1, TRAINED_BY.join(", "));
    writeln!(
        out,
        "Score: share of tests right, less steps a lesson / {MOST_STEPS}; seeds {} to {last}, trainers {trainers}.",
        SEEDS.start
    )?;
    for (name, taken, grid) in grids {
        let scored = |learns: Learns| {
            let score = score(&learns).map_err(|error| Failure::Result(format!("{name}, {learns}: {error}")));
            bar.inc(1);
            score.map(|score| (learns, score))
        };
        let mut scores = grid.into_par_iter().map(scored).collect::<Result<Vec<_>, _>>()?;
        // Of equal ones the first of the grid.
        scores.sort_by(|a, b| b.1.total_cmp(&a.1));
        writeln!(out, "\n{name}: the best of {}", scores.len())?;
        for (learns, score) in scores.iter().take(TOLD) {
            writeln!(out, "  {score:>7.4}  {learns}{}", if *learns == taken { "  (taken)" } else { "" })?;
        }
    }
    bar.finish_and_clear();
    Ok(())
}
