//! Results as text: a table for each course and trainer, or comma-separated values.

use super::plan::Plan;
use super::summary::{Column, Row};
use crate::mean::Mean;
use goodbot_console::csv::{self, Cell};
use std::io::{self, Write};

/// Prints a table for each course and trainer.
pub fn print(out: &mut impl Write, plan: &Plan, rows: &[Row]) -> io::Result<()> {
    let last = plan.seed_at(plan.runs - 1);
    writeln!(out, "Seeds {} to {last}; means with 95 % intervals.", plan.seed)?;
    let wide = rows.iter().map(|row| row.agent.len()).max().unwrap_or(0);
    for group in rows.chunks(plan.agents.len()) {
        let Some(first) = group.first() else { continue };
        writeln!(out, "\nCourse {}, trainer {}", first.course.name(), first.trainer)?;
        write!(out, "  {:wide$}", "")?;
        for column in Column::ALL {
            write!(out, "  {:>20}", column.head())?;
        }
        writeln!(out)?;
        for row in group {
            write!(out, "  {:wide$}", row.agent)?;
            for column in Column::ALL {
                write!(out, "  {:>20}", mean(row.mean(column)))?;
            }
            writeln!(out)?;
        }
    }
    Ok(())
}

/// A mean with half of its interval.
pub fn mean(Mean { mean, half }: Mean) -> String {
    if mean.abs() < 10.0 { format!("{mean:.2} ± {half:.2}") } else { format!("{mean:.1} ± {half:.1}") }
}

/// A line for each course, trainer and agent.
pub fn csv(out: &mut impl Write, plan: &Plan, rows: &[Row]) -> io::Result<()> {
    let names = Column::ALL.map(|column| format!("{0},{0}_low,{0}_high", column.name()));
    writeln!(out, "course,trainer,agent,seed,seeds,{}", names.join(","))?;
    for row in rows {
        let cells = Column::ALL.map(|column| {
            let Mean { mean, half } = row.mean(column);
            [mean, mean - half, mean + half].map(|number| Cell::Number(format!("{number:.6}")))
        });
        let names = [row.course.name(), row.trainer, row.agent].map(Cell::text);
        csv::line(out, names.into_iter().chain([Cell::number(plan.seed), Cell::number(row.seeds)]).chain(cells.into_iter().flatten()))?;
    }
    Ok(())
}
