//! The report of a replay, for people.

use super::history::Outcome;
use goodbot_console::messages::counted;
use goodbot_formats::posterior::PosteriorLine;
use goodbot_formats::session::Kind;
use goodbot_formats::task_text::GroundTaskText;
use goodbot_lab::fit_trainers::believing::Rightness;
use goodbot_lesson::fault::quoted;
use std::fmt;

/// The most likely task of a belief.
struct MostLikely<'a> {
    task: &'a GroundTaskText,
    probability: f32,
    /// How many tasks have this probability, this one included.
    tied: usize,
}

fn most_likely(belief: &PosteriorLine<f32>) -> Option<MostLikely<'_>> {
    let best = belief.tasks.iter().map(|&(_, probability)| probability).fold(0.0, f32::max);
    let mut tied = belief.tasks.iter().filter(|&&(_, probability)| probability >= best);
    let (task, probability) = tied.next()?;
    Some(MostLikely { task, probability: *probability, tied: 1 + tied.count() })
}

/// Whether the intended task alone is the most likely one.
fn is_right(belief: Option<&PosteriorLine<f32>>, intended: &GroundTaskText) -> bool {
    belief.and_then(most_likely).is_some_and(|likely| likely.tied == 1 && likely.task.is_same(intended))
}

impl fmt::Display for MostLikely<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} {:.3}", self.task, self.probability)?;
        if self.tied > 1 { write!(f, " (one of {} equally likely)", self.tied) } else { Ok(()) }
    }
}

impl fmt::Display for Outcome {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let again = if self.continues { ", once more" } else { "" };
        writeln!(f, "{}: {}{again}", self.id.escape_debug(), quoted(&self.command))?;
        if let Some(likely) = self.beliefs.first().and_then(most_likely) {
            writeln!(f, "  before    {likely}")?;
        }
        if let Some(likely) = self.beliefs.last().and_then(most_likely) {
            writeln!(f, "  after     {likely}")?;
        }
        if let Some(intended) = &self.intended {
            let right = if is_right(self.beliefs.last(), intended) { "  (right)" } else { "" };
            writeln!(f, "  expected  {intended}{right}")?;
        }
        let steps = self.steps;
        let [reward, punish, neutral] = self.feedback;
        write!(f, "  {}", counted(steps, "step"))?;
        match self.kind {
            Kind::Feedback => write!(f, ": {reward} rewarded, {punish} punished, {neutral} in silence")?,
            Kind::Demonstration | Kind::Labelled => f.write_str(" shown")?,
        }
        writeln!(f, "; {}", if self.learned { "learned from" } else { "not learned from" })
    }
}

/// The totals of all sessions.
#[derive(Debug, Default)]
pub struct Totals {
    /// Sessions replayed.
    pub sessions: usize,
    /// Sessions at fault.
    pub skipped: usize,
    steps: usize,
    feedback: [usize; 3],
    learned: usize,
    trained: usize,
    intended: usize,
    right_before: usize,
    right_after: usize,
    rightness: Rightness,
}

impl Totals {
    /// Adds a session.
    pub fn add(&mut self, outcome: &Outcome) {
        self.sessions += 1;
        self.steps += outcome.steps;
        self.learned += usize::from(outcome.learned);
        self.trained += usize::from(outcome.trained);
        self.feedback.iter_mut().zip(outcome.feedback).for_each(|(sum, count)| *sum += count);
        if let Some(intended) = &outcome.intended {
            self.intended += 1;
            self.right_before += usize::from(is_right(outcome.beliefs.first(), intended));
            self.right_after += usize::from(is_right(outcome.beliefs.last(), intended));
            let [reward, punish, _] = outcome.feedback;
            if let Some(last) = outcome.beliefs.last().filter(|_| reward + punish > 0) {
                let probabilities: Vec<f64> = last.tasks.iter().map(|&(_, probability)| f64::from(probability)).collect();
                if let Some(intended) = last.tasks.iter().position(|(task, _)| task.is_same(intended)) {
                    self.rightness.add(&probabilities, intended, false);
                }
            }
        }
    }
}

impl Totals {
    /// How right the beliefs at the end of sessions with feedback were.
    pub const fn rightness(&self) -> &Rightness {
        &self.rightness
    }

    /// Whether some sessions waited for a later training.
    pub const fn learned_later(&self) -> bool {
        self.trained < self.learned
    }
}

impl fmt::Display for Totals {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let [reward, punish, neutral] = self.feedback;
        writeln!(f, "\nsessions             {}, {} learned from", self.sessions, self.learned)?;
        if self.skipped > 0 {
            writeln!(f, "skipped              {} with faults", self.skipped)?;
        }
        if self.learned_later() {
            let times = counted(self.trained, "time");
            writeln!(f, "words retrained      {times}, from the hundredth session on after a fiftieth more")?;
        }
        writeln!(f, "steps                {}", self.steps)?;
        if reward + punish + neutral > 0 {
            let [reward, punish, neutral] =
                [(reward, "reward"), (punish, "punishment"), (neutral, "silence")].map(|(n, it)| counted(n, it));
            writeln!(f, "feedback             {reward}, {punish}, {neutral}")?;
        }
        if self.intended > 0 {
            writeln!(f, "right on hearing     {} of {} whose intended task is known", self.right_before, self.intended)?;
            writeln!(f, "right at the end     {} of {}", self.right_after, self.intended)?;
        }
        let it = &self.rightness;
        if it.sessions() > 0 {
            let (top, loss, low) = (it.on_top(), it.log_loss(), 100.0 * it.given_up());
            writeln!(f, "in {} with feedback, at the end:", counted(it.sessions(), "session"))?;
            writeln!(f, "  intended task alone on top {top:.3}, mean log loss {loss:.3}, intended below 5 % in {low:.1} %")?;
        }
        Ok(())
    }
}
