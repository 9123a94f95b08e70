//! What is told of an evaluation.

use super::curve::Point;
use super::folds::Answer;
use crate::load::fault::quoted;
use serde_json::json;
use std::collections::BTreeMap;
use std::io::{self, Write};

/// All answers together.
#[derive(Clone, Copy, Debug)]
pub struct Summary {
    /// Sessions read.
    pub sessions: usize,
    /// Commands asked.
    pub asked: usize,
    /// Commands understood.
    pub right: usize,
    /// Sessions at fault.
    pub skipped: usize,
    /// The share that was understood.
    pub accuracy: f64,
    /// Its 95 % interval (Wilson).
    pub interval: (f64, f64),
    /// The mean of -ln of the probability of what was meant.
    pub surprise: f64,
}

impl Summary {
    /// The summary of answers.
    pub fn of(answers: &[Answer], sessions: usize, skipped: usize) -> Self {
        let right = answers.iter().filter(|answer| answer.right).count();
        let surprise: f64 = answers.iter().map(|answer| -f64::from(answer.probabilities.0.max(1e-9)).ln()).sum();
        let count = answers.len().max(1) as f64;
        Self {
            sessions,
            asked: answers.len(),
            right,
            skipped,
            accuracy: right as f64 / count,
            interval: wilson(right, answers.len()),
            surprise: surprise / count,
        }
    }
}

/// Wilson's 95 % interval of a share.
pub fn wilson(right: usize, all: usize) -> (f64, f64) {
    if all == 0 {
        return (0.0, 1.0);
    }
    let (n, z) = (all as f64, 1.959_964);
    let p = right as f64 / n;
    let middle = p + z * z / (2.0 * n);
    let half = z * (p * (1.0 - p) / n + z * z / (4.0 * n * n)).sqrt();
    let whole = 1.0 + z * z / n;
    ((middle - half) / whole, (middle + half) / whole)
}

/// Prints the mistakes, the confusion table and the summary.
pub fn print(answers: &[Answer], summary: &Summary, json: bool) -> io::Result<()> {
    let mut out = io::stdout().lock();
    if json {
        for answer in answers {
            let words: Vec<_> = answer.telling.iter().map(|(word, ratio)| json!({"word": word, "ratio": ratio})).collect();
            let line = json!({
                "type": "answer", "session": answer.id, "command": answer.command, "intended": answer.meant.0, "said": answer.said.0,
                "right": answer.right, "probability_intended": answer.probabilities.0, "probability_said": answer.probabilities.1,
                "telling_words": words,
            });
            writeln!(out, "{line}")?;
        }
        let line = json!({
            "type": "summary", "sessions": summary.sessions, "asked": summary.asked, "right": summary.right, "skipped": summary.skipped,
            "accuracy": summary.accuracy, "interval": [summary.interval.0, summary.interval.1], "surprise": summary.surprise,
        });
        return writeln!(out, "{line}");
    }
    for answer in answers.iter().filter(|answer| !answer.right) {
        writeln!(out, "{}: {}", answer.id, quoted(&answer.command))?;
        writeln!(out, "  meant {} {:.3}, said {} {:.3}", answer.meant.0, answer.probabilities.0, answer.said.0, answer.probabilities.1)?;
        let words: Vec<String> =
            answer.telling.iter().filter(|(_, ratio)| *ratio > 1.0).map(|(word, ratio)| format!("{word} {ratio:.1} times")).collect();
        if !words.is_empty() {
            writeln!(out, "  words for the mistake: {}", words.join(", "))?;
        }
    }
    confusion(&mut out, answers)?;
    let (low, high) = summary.interval;
    writeln!(out, "\nsessions   {} ({} at fault)", summary.sessions, summary.skipped)?;
    writeln!(out, "right      {} of {}", summary.right, summary.asked)?;
    writeln!(out, "accuracy   {:.2} %, 95 % interval {:.1} to {:.1}", 100.0 * summary.accuracy, 100.0 * low, 100.0 * high)?;
    writeln!(out, "surprise   {:.3} nats a command", summary.surprise)
}

/// How often each kind of task was taken for which.
fn confusion(out: &mut impl Write, answers: &[Answer]) -> io::Result<()> {
    let mut counts: BTreeMap<&str, BTreeMap<&str, usize>> = BTreeMap::new();
    for answer in answers {
        *counts.entry(&answer.meant.1).or_default().entry(&answer.said.1).or_default() += 1;
    }
    writeln!(out, "\nmeant, how often, and what was said instead")?;
    for (meant, said) in &counts {
        let all: usize = said.values().sum();
        let right = said.get(meant).copied().unwrap_or(0);
        let others: Vec<String> = said.iter().filter(|(said, _)| *said != meant).map(|(said, count)| format!("{said} {count}")).collect();
        writeln!(out, "  {meant:44} {right:3} of {all:3}  {}", others.join(", "))?;
    }
    Ok(())
}

/// Prints a learning curve.
pub fn print_curve(points: &[Point]) -> io::Result<()> {
    let mut out = io::stdout().lock();
    writeln!(out, "\nsessions  right of all others")?;
    points.iter().try_for_each(|it| writeln!(out, "{:8}  {:.1} % ± {:.1}", it.sessions, 100.0 * it.mean, 100.0 * it.deviation))
}

/// Prints a row for each combination of options.
pub fn ablation(rows: &[(&str, Summary)], json: bool) -> io::Result<()> {
    let mut out = io::stdout().lock();
    for (name, it) in rows {
        let (low, high) = it.interval;
        if json {
            let line = json!({
                "type": "ablation", "settings": name.trim(), "right": it.right, "asked": it.asked, "accuracy": it.accuracy,
                "interval": [low, high], "surprise": it.surprise,
            });
            writeln!(out, "{line}")?;
        } else {
            let shares = format!("{:6.2} %  ({:.1} to {:.1})", 100.0 * it.accuracy, 100.0 * low, 100.0 * high);
            writeln!(out, "{name:28} {:3} of {:3}  {shares}  surprise {:.3}", it.right, it.asked, it.surprise)?;
        }
    }
    Ok(())
}
