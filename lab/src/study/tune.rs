//! Tries all settings of the other inferences and of the log-linear language, and prints the best with their scores.

use crate::study::agent::AGENTS;
use crate::study::trial::MOST_STEPS;
use crate::study::tuning::{SEEDS, TRAINED_BY, TUNED, scores};
use goodbot_console::outcome::Failure;
use std::io::Write;

/// How many settings are printed for each agent.
const TOLD: usize = 3;

/// Tries the settings and prints the best.
///
/// # Errors
/// [`Failure::Result`] if a run failed.
pub fn show(out: &mut impl Write) -> Result<(), Failure> {
    let (last, trainers) = (SEEDS.end - 1, TRAINED_BY.join(", "));
    writeln!(
        out,
        "Score: share of tests right, less steps a lesson / {MOST_STEPS}; seeds {} to {last}, trainers {trainers}.",
        SEEDS.start
    )?;
    for agent in AGENTS.iter().filter(|agent| TUNED.contains(&agent.name)) {
        let grid = agent.learns.grid();
        let scores = scores(&grid).map_err(|error| Failure::Result(format!("{}: {error}", agent.name)))?;
        let mut scored: Vec<_> = grid.into_iter().zip(scores).collect();
        // The first of equals in the grid comes first.
        scored.sort_by(|a, b| b.1.total_cmp(&a.1));
        writeln!(out, "\n{}: the best of {}", agent.name, scored.len())?;
        for (learns, score) in scored.iter().take(TOLD) {
            writeln!(out, "  {score:>7.4}  {learns}{}", if *learns == agent.learns { "  (taken)" } else { "" })?;
        }
    }
    Ok(())
}
