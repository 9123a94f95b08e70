//! Results as text: a table for each trainer, or comma-separated values.

use super::plan::Plan;
use super::summary::{Column, Row};
use crate::mean::Mean;
use crate::study::trial::MOST_STEPS;
use std::io::{self, Write};

/// Prints a table for each trainer.
pub fn print(out: &mut impl Write, plan: &Plan, rows: &[Row]) -> io::Result<()> {
    let last = plan.seed_at(plan.runs - 1);
    writeln!(out, "Seeds {} to {last}; means with 95 % intervals.", plan.seed)?;
    let wide = rows.iter().map(|row| row.agent.len()).max().unwrap_or(0);
    for group in rows.chunks(plan.agents.len()) {
        let Some(first) = group.first() else { continue };
        writeln!(out, "\nTrainer {}", first.trainer)?;
        write!(out, "  {:wide$}", "")?;
        for column in Column::ALL {
            write!(out, "  {:>20}", column.head())?;
        }
        writeln!(out, "  {:>12}", "median steps")?;
        for row in group {
            write!(out, "  {:wide$}", row.agent)?;
            for column in Column::ALL {
                write!(out, "  {:>20}", mean(row.mean(column)))?;
            }
            writeln!(out, "  {:>12}", median(row))?;
        }
    }
    Ok(())
}

/// The median of the steps.
pub fn median(row: &Row) -> String {
    if row.median_steps < MOST_STEPS { row.median_steps.to_string() } else { "not reached".to_owned() }
}

/// A mean with half of its interval.
pub fn mean(mean: Option<Mean>) -> String {
    match mean {
        Some(Mean { mean, half }) if mean.abs() < 10.0 => format!("{mean:.2} ± {half:.2}"),
        Some(Mean { mean, half }) => format!("{mean:.1} ± {half:.1}"),
        None => "-".to_owned(),
    }
}

/// A line for each trainer and agent.
pub fn csv(out: &mut impl Write, plan: &Plan, rows: &[Row]) -> io::Result<()> {
    let names = Column::ALL.map(|column| format!("{0},{0}_low,{0}_high", column.name()));
    writeln!(out, "trainer,agent,seed,seeds,{},median_steps", names.join(","))?;
    for row in rows {
        let cells = Column::ALL.map(|column| match row.mean(column) {
            Some(Mean { mean, half }) => format!("{mean:.6},{:.6},{:.6}", mean - half, mean + half),
            None => ",,".to_owned(),
        });
        let (trainer, agent, seeds) = (&row.trainer, row.agent, row.seeds);
        writeln!(out, "\"{trainer}\",{agent},{},{seeds},{},{}", plan.seed, cells.join(","), row.median_steps)?;
    }
    Ok(())
}
