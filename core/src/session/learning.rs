//! The end of a session: each machine command takes its share of the posterior, and the language model learns from it.

use super::agent::Agent;
use super::candidates::Candidate;
use super::error::AgentError;
use super::options::Weights;
use crate::oomdp::Domain;
use crate::planning::Progress;
use crate::probability::{Scaled, total};

impl Agent<'_> {
    /// Ends the session without learning from it. What it made known of words and machine tokens is forgotten with the next command, so
    /// that the same session can still be taken up again with [`hear_again`](Self::hear_again).
    pub fn forget(&mut self) {
        self.ended = true;
        self.forget_plan();
    }

    /// Ends the session and learns from it: each machine command with its share of the posterior joins the training data, and training on
    /// all of them begins. Call [`learn`](Self::learn) until it is done. Where memory is full, other sessions give way, as
    /// [`forgetting`](crate::language::forgetting) says.
    ///
    /// # Errors
    /// [`AgentError::NoSession`], [`AgentError::StillLearning`], or [`AgentError::Capacity`] where the session could not be kept even
    /// alone: it is then forgotten and everything learned before is kept. Where none of its words found room, in a vocabulary that was
    /// restored full, others give way so that the next command is heard whole.
    pub fn finish<D: Domain + ?Sized>(&mut self, domain: &D) -> Result<(), AgentError> {
        self.check_session(domain)?;
        if self.language.is_training() {
            return Err(AgentError::StillLearning);
        }
        self.weigh(domain)?;
        self.keep()
    }

    /// Lets the session's machine commands join the training data, by their weights.
    #[inline(never)]
    fn keep(&mut self) -> Result<(), AgentError> {
        self.ended = true;
        self.forget_plan();
        let whole = total(self.candidates.entries().iter().map(|entry| entry.weight));
        let share = |weight: Scaled| Some(weight.over(whole)).filter(|&share| share > self.options.least_weight);
        let kept: f32 = self.candidates.entries().iter().filter_map(|entry| share(entry.weight)).sum();
        let candidates = &self.candidates;
        let weighted = |entry: &Candidate| share(entry.weight).map(|share| (candidates.tokens(entry), share / kept));
        let pairs = || candidates.entries().iter().filter_map(weighted);
        let added = self.language.add_session_making_room(&self.sentence, candidates.all_tokens(), pairs);
        if let Err(error) = added {
            self.start = None;
            self.language.forget_unlearned();
            if self.sentence.iter().all(Option::is_none) {
                self.language.tidy_vocabulary(&mut self.sentence, &mut [])?;
                self.begin_training();
            }
            return Err(error.into());
        }
        self.language.tidy_vocabulary(&mut self.sentence, self.candidates.all_tokens_mut())?;
        self.candidates.renamed();
        self.begin_training();
        Ok(())
    }

    fn begin_training(&mut self) {
        self.workspace_to_training();
        self.language.begin_training();
    }

    /// The weight of each machine command of the session as it stands, for [`finish`](Self::finish) and for those who look on: the entries
    /// of [`candidates`](Self::candidates) then have their weights, in no unit: their share of the sum is what is learned. Where no machine
    /// command explains the words, the tasks' posterior alone counts, evenly over each task's constraints.
    ///
    /// # Errors
    /// [`AgentError::Capacity`].
    pub fn weigh<D: Domain + ?Sized>(&mut self, domain: &D) -> Result<(), AgentError> {
        self.weigh_by(domain, self.options.weights)?;
        if self.options.weights == Weights::Paper && self.candidates.entries().iter().all(|entry| entry.weight.is_zero()) {
            self.weigh_by(domain, Weights::Belief)?;
        }
        Ok(())
    }

    fn weigh_by<D: Domain + ?Sized>(&mut self, domain: &D, weights: Weights) -> Result<(), AgentError> {
        for position in 0..self.candidates.entries().len() {
            if let Some(entry) = self.candidates.entry_mut(position) {
                entry.weight = Scaled::ZERO;
            }
        }
        for position in 0..self.task_count {
            let prior = self.tasks.get(position).map_or(0.0, |task| task.prior);
            let evidence = match weights {
                Weights::Paper => self.belief.evidence(position).scaled_by(prior),
                Weights::Belief => self.belief.weight(position),
            };
            let mut part = None;
            self.for_each_candidate(domain, position, |candidates, _, _, tokens, share| {
                // Equal for all constraints of the task.
                let evidence = *part.get_or_insert_with(|| evidence.scaled_by(share));
                if let Some(entry) = candidates.find(tokens).and_then(|found| candidates.entry_mut(found)) {
                    let explained = if weights == Weights::Paper { entry.likelihood } else { Scaled::ONE };
                    entry.weight = entry.weight.plus(evidence.times(explained));
                }
                Ok(Scaled::ZERO)
            })?;
        }
        Ok(())
    }

    /// Goes on learning, with at most about `budget` table cells of work.
    pub fn learn(&mut self, budget: u32) -> Progress {
        self.language.train(budget)
    }

    /// Learns to the end.
    pub fn learn_fully(&mut self) {
        while self.learn(u32::MAX) == Progress::Working {}
    }
}
