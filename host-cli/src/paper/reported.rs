//! The results that the paper reports.

use super::options::PaperOptions;
use goodbot_course::{CourseTrainer, LESSONS};

/// The translations that the paper reports, and one that separates go from take: the machine token of Model 2, the value of the role model,
/// the word.
pub const REPORTED: [(&str, &str, &str); 4] = [
    ("agentInRoom", "agentInRoom", "go"),
    ("shapeBag", "shapeBag", "bag"),
    ("roomIsRed", "colorRed", "red"),
    ("blockInRoom", "blockInRoom", "take"),
];

/// The paper's results for its agent, which one trainer taught (section 5).
#[derive(Clone, Copy, Debug)]
pub struct Reported {
    /// How many of the five tests were right.
    pub tests: usize,
    /// Which lessons needed no correction.
    pub lessons: Option<[bool; LESSONS.len()]>,
    /// The translations of [`REPORTED`].
    pub translations: Option<[f64; REPORTED.len()]>,
}

/// The results with the first trainer.
pub const PAPER_BALANCED: Reported =
    Reported { tests: 5, lessons: Some([false, true, false, false, true, true, true]), translations: Some([0.51, 0.32, 0.33, 0.33]) };
/// The results with the second trainer, who was only allowed to punish.
pub const PAPER_PUNISH_ONLY: Reported = Reported { tests: 4, lessons: None, translations: None };

impl PaperOptions {
    /// The paper's results for this trainer, if the agent expects the same strategy, as in the paper.
    pub fn reported_by_paper(&self) -> Option<Reported> {
        let as_in_paper = self.believed().trainer.strategy == self.trainer.trainer.strategy;
        let known = [(CourseTrainer::BALANCED, PAPER_BALANCED), (CourseTrainer::PUNISH_ONLY, PAPER_PUNISH_ONLY)];
        known.into_iter().find(|(trainer, _)| as_in_paper && *trainer == self.trainer.trainer).map(|(_, reported)| reported)
    }
}
