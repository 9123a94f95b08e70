//! The report of an evaluation.

use super::curve::Point;
use super::folds::Answer;
use crate::calibration::{self, RANGES, Range, wilson};
use goodbot_console::counted;
use goodbot_lesson::fault::quoted;
use serde_json::{Value, json};
use std::collections::BTreeMap;
use std::io::{self, Write};

/// The accuracy and the log loss of answers.
#[derive(Clone, Copy, Debug, Default)]
pub struct Score {
    /// Commands understood.
    pub right: usize,
    /// Commands asked.
    pub asked: usize,
    /// The mean of -ln of the intended task's probability.
    pub log_loss: f64,
}

impl Score {
    fn of(answers: impl Iterator<Item = (bool, f32)>) -> Self {
        let mut score = Self::default();
        for (right, probability) in answers {
            score.asked += 1;
            score.right += usize::from(right);
            score.log_loss -= f64::from(probability.max(1e-9)).ln();
        }
        score.log_loss /= score.asked.max(1) as f64;
        score
    }

    /// The share of right answers.
    pub fn accuracy(&self) -> f64 {
        self.right as f64 / self.asked.max(1) as f64
    }

    fn to_json(self) -> Value {
        let (low, high) = wilson(self.right, self.asked);
        json!({"right": self.right, "asked": self.asked, "accuracy": self.accuracy(), "interval": [low, high], "log_loss": self.log_loss})
    }

    fn text(&self) -> String {
        let (low, high) = wilson(self.right, self.asked);
        let (accuracy, low, high) = (100.0 * self.accuracy(), 100.0 * low, 100.0 * high);
        format!("{accuracy:6.2} %  ({low:.1} to {high:.1})  {} of {}, log loss {:.3}", self.right, self.asked, self.log_loss)
    }
}

/// Counts of the sessions that were read.
#[derive(Clone, Copy, Debug, Default)]
pub struct SessionCounts {
    /// Whether the model was trained before. Its training data and copies of them are unknown then.
    pub is_given: bool,
    /// Sessions that models are trained on.
    pub taught: usize,
    /// Faulty sessions that were skipped.
    pub skipped: usize,
    /// Sessions that were left out because their task has a way.
    pub with_way: usize,
    /// Sessions that are not asked because they have no intended task.
    pub unknown: usize,
    /// Commands that are read by their first words only.
    pub long: usize,
    /// Of the training sessions whose steps can be compared with an intended task: how many are right by their steps alone, and how many
    /// there are.
    pub evidence: (usize, usize),
}

/// The summary of all answers.
#[derive(Clone, Debug)]
pub struct Summary {
    /// The counts of sessions.
    pub read: SessionCounts,
    /// The model.
    pub score: Score,
    /// A learner without words.
    pub wordless: Score,
    /// The mean probability of the intended task by chance.
    pub chance: f64,
    /// The model, without copies of training sessions.
    pub without_copies: Score,
    /// The model where the steps told what was meant. The other figures are without these commands, unless there are no others.
    pub by_steps: Score,
    /// Answers by certainty.
    pub ranges: [Range; RANGES],
}

impl Summary {
    /// The summary of answers.
    pub fn of(answers: &[Answer], read: SessionCounts) -> Self {
        let model = |answer: &Answer| (answer.right, answer.probabilities.0);
        let by_steps = Score::of(answers.iter().filter(|answer| answer.is_told_by_steps).map(model));
        let answers = counted_ones(answers);
        let model = |answer: &&Answer| model(answer);
        Self {
            read,
            score: Score::of(answers.iter().map(model)),
            wordless: Score::of(answers.iter().map(|answer| answer.wordless)),
            chance: answers.iter().map(|answer| f64::from(answer.chance)).sum::<f64>() / answers.len().max(1) as f64,
            without_copies: Score::of(answers.iter().filter(|answer| answer.copy_of.is_none()).map(model)),
            by_steps,
            ranges: calibration::ranges(answers.iter().map(|answer| (f64::from(answer.probabilities.1), answer.right))),
        }
    }

    /// A value that is known only if the training sessions are known.
    fn known(&self, value: Value) -> Value {
        if self.read.is_given { Value::Null } else { value }
    }

    fn to_json(&self) -> Value {
        let mut line = json!({
            "type": "summary", "sessions": self.read.taught, "skipped": self.read.skipped, "left_out_with_way": self.read.with_way,
            "not_asked_without_intended": self.read.unknown, "long_commands": self.read.long,
        });
        let range = |(number, range): (usize, &Range)| {
            let (low, high) = wilson(range.right, range.count);
            json!({
                "from": number as f64 / RANGES as f64, "to": (number + 1) as f64 / RANGES as f64, "count": range.count,
                "right": range.right, "certainty": range.certainty(), "accuracy": range.accuracy(), "interval": [low, high],
            })
        };
        let more = [
            ("calibration_error", json!(calibration::error(&self.ranges))),
            ("chance", json!(self.chance)),
            ("without_words", self.known(self.wordless.to_json())),
            ("copies", self.known(json!(self.score.asked - self.without_copies.asked))),
            ("without_copies", self.known(self.without_copies.to_json())),
            ("by_the_steps", self.by_steps.to_json()),
            ("steps_alone", json!({"right": self.read.evidence.0, "of": self.read.evidence.1})),
            ("reliability", self.ranges.iter().enumerate().filter(|(_, range)| range.count > 0).map(range).collect()),
        ];
        if let (Some(line), Some(score)) = (line.as_object_mut(), self.score.to_json().as_object()) {
            line.extend(score.clone());
            line.extend(more.map(|(name, value)| (name.to_owned(), value)));
        }
        line
    }
}

/// The answers that count: those whose intended task was recorded; if there are none, those whose steps told it.
fn counted_ones(answers: &[Answer]) -> Vec<&Answer> {
    let are_all_told = answers.iter().all(|answer| answer.is_told_by_steps);
    answers.iter().filter(|answer| are_all_told || !answer.is_told_by_steps).collect()
}

/// Prints the mistakes, the confusion table and the summary.
pub fn print(out: &mut impl Write, answers: &[Answer], summary: &Summary, json: bool) -> io::Result<()> {
    if json {
        for answer in answers {
            writeln!(out, "{}", answer_to_json(answer, summary))?;
        }
        writeln!(out, "{}", summary.to_json())?;
        return out.flush();
    }
    for answer in answers.iter().filter(|answer| !answer.right) {
        writeln!(out, "{}: {}", answer.id.escape_debug(), quoted(&answer.command))?;
        let (expected, predicted) = answer.probabilities;
        writeln!(out, "  expected {} {expected:.3}, predicted {} {predicted:.3}", answer.expected.0, answer.predicted.0)?;
    }
    confusion(out, &counted_ones(answers))?;
    totals(out, summary)?;
    out.flush()
}

fn answer_to_json(answer: &Answer, summary: &Summary) -> Value {
    json!({
        "type": "answer", "session": answer.id, "command": answer.command, "expected": answer.expected.0, "predicted": answer.predicted.0,
        "right": answer.right, "probability_expected": answer.probabilities.0, "probability_predicted": answer.probabilities.1,
        "right_without_words": summary.known(json!(answer.wordless.0)), "copy_of": answer.copy_of, "told_by_steps": answer.is_told_by_steps,
    })
}

fn totals(out: &mut impl Write, summary: &Summary) -> io::Result<()> {
    let SessionCounts { is_given, taught, skipped, with_way, unknown, evidence, .. } = summary.read;
    let others: Vec<String> = [(skipped, "at fault"), (with_way, "left out with a way"), (unknown, "not asked: no intended task")]
        .iter()
        .filter(|(count, _)| *count > 0)
        .map(|(count, what)| format!(", {count} {what}"))
        .collect();
    let taught = if is_given { "nothing here: the model was there".to_owned() } else { counted(taught, "session") };
    writeln!(out, "\ntrained on         {taught}{}", others.concat())?;
    writeln!(out, "accuracy           {}", summary.score.text())?;
    if summary.by_steps.asked > 0 {
        writeln!(out, "by the steps       {}", summary.by_steps.text())?;
    }
    if !is_given {
        writeln!(out, "without words      {}", summary.wordless.text())?;
    }
    writeln!(out, "by chance          {:6.2} %", 100.0 * summary.chance)?;
    let copies = summary.score.asked - summary.without_copies.asked;
    if copies > 0 {
        let rest = &summary.without_copies;
        let rest = if rest.asked == 0 { "nothing is left to ask".to_owned() } else { rest.text() };
        let asked = if copies == 1 { "is a copy of a session" } else { "are copies of sessions" };
        writeln!(out, "without copies     {rest}  ({copies} asked {asked} trained on)")?;
    }
    if evidence.1 > 0 {
        let share = 100.0 * evidence.0 as f64 / evidence.1 as f64;
        writeln!(
            out,
            "steps alone        {share:6.2} %  of the training sessions point at the intended task: {} of {}",
            evidence.0, evidence.1
        )?;
    }
    writeln!(out, "calibration error  {:6.3}", calibration::error(&summary.ranges))?;
    writeln!(out, "\nhow sure           asked  right  sure, mean  right, with interval")?;
    for (number, range) in summary.ranges.iter().enumerate().filter(|(_, range)| range.count > 0) {
        let (low, high) = wilson(range.right, range.count);
        let (from, to, right) = (number * 100 / RANGES, (number + 1) * 100 / RANGES, 100.0 * range.accuracy());
        writeln!(
            out,
            "  {from:>2} to {to:>3} %      {:5}  {:5}  {:8.1} %  {right:5.1} %  ({:.1} to {:.1})",
            range.count,
            range.right,
            100.0 * range.certainty(),
            100.0 * low,
            100.0 * high
        )?;
    }
    Ok(())
}

/// Prints how often each kind of task was taken for each other.
fn confusion(out: &mut impl Write, answers: &[&Answer]) -> io::Result<()> {
    let mut counts: BTreeMap<&str, BTreeMap<&str, usize>> = BTreeMap::new();
    for answer in answers {
        *counts.entry(&answer.expected.1).or_default().entry(&answer.predicted.1).or_default() += 1;
    }
    writeln!(out, "\nexpected task, how often it was predicted, and other predictions")?;
    for (expected, predicted) in &counts {
        let all: usize = predicted.values().sum();
        let right = predicted.get(expected).copied().unwrap_or(0);
        let others: Vec<String> =
            predicted.iter().filter(|(other, _)| *other != expected).map(|(other, count)| format!("{other} {count}")).collect();
        writeln!(out, "  {expected:44} {right:3} of {all:3}  {}", others.join(", "))?;
    }
    Ok(())
}

/// Prints a learning curve.
pub fn print_curve(out: &mut impl Write, points: &[Point]) -> io::Result<()> {
    writeln!(out, "\nsessions  right of all others")?;
    points.iter().try_for_each(|it| writeln!(out, "{:8}  {:.1} % ± {:.1}", it.sessions, 100.0 * it.mean, 100.0 * it.deviation))
}

/// Prints a row for each combination of options, and one for a learner without words.
pub fn ablation(out: &mut impl Write, rows: &[(&str, Summary)], json: bool) -> io::Result<()> {
    let wordless = rows.first().map(|(_, it)| ("without words", it.wordless, None));
    let scores = rows.iter().map(|(name, it)| (*name, it.score, Some(calibration::error(&it.ranges)))).chain(wordless);
    for (name, score, calibration) in scores {
        if json {
            let mut line = json!({"type": "ablation", "settings": name.trim(), "calibration_error": calibration});
            if let (Some(line), Some(score)) = (line.as_object_mut(), score.to_json().as_object()) {
                line.extend(score.clone());
            }
            writeln!(out, "{line}")?;
        } else {
            let calibration = calibration.map_or_else(String::new, |error| format!(", calibration error {error:.3}"));
            writeln!(out, "{name:28} {}{calibration}", score.text())?;
        }
    }
    Ok(())
}
