//! Chooses one of several transcripts: a speech recogniser knows the sound, the scene restricts the possible tasks.

use super::agent::Agent;
use super::error::AgentError;
use crate::memory::AgentMemory;
use crate::oomdp::Domain;
use crate::probability::Scaled;
use crate::symbols::Symbol;

/// The probability of one word among all unheard words: everyday vocabulary has about ten thousand. The language model gives only the
/// probability that any unheard word occurs.
const ONE_UNHEARD: f32 = 1e-4;

/// One entry of a speech recogniser's n-best list.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hypothesis<'h> {
    /// The command.
    pub command: &'h str,
    /// The recogniser's probability, in any unit: a number of 0 or more. For [`Agent::hear_one_of_logs`] its natural logarithm.
    pub weight: f32,
}

impl<M: AgentMemory> Agent<M> {
    /// Hears the most probable of several transcripts of one command, and returns its position. Its probability is its weight times Pr(e|s)
    /// = sum over tasks t of Pr(t|s) Pr(e|t), with each unheard word one of ten thousand. On a tie, the larger weight wins, then the first
    /// transcript. The session is the same as if only this transcript had been heard by [`hear`](Self::hear). A transcript that cannot be
    /// heard is skipped if another can.
    ///
    /// It takes the time of hearing each transcript, and one of them a second time.
    ///
    /// ```
    /// use goodbot::session::Hypothesis;
    /// # use goodbot::home::{self, Area, Cell, HomeBuilder, Moves};
    /// # use goodbot::feedback::Feedback;
    /// # use goodbot::planning::Progress;
    /// # use goodbot::{Agent, Capacities, HeapMemory, Options};
    /// # let memory = HeapMemory::new(&Capacities::STANDARD);
    /// # let mut builder = HomeBuilder::new(memory.home);
    /// # builder.room("room0", Area::new(0, 0, 8, 4), "red")?;
    /// # builder.room("room1", Area::new(0, 4, 8, 8), "green")?;
    /// # builder.door("door0", Area::new(2, 4, 2, 4))?;
    /// # builder.agent("agent0", Cell::new(2, 3))?;
    /// # let (home, state) = builder.build(Moves::Push)?;
    /// let mut agent = Agent::new(memory.agent, &home::paper_tasks()?, Options::DEFAULT)?;
    /// // A robot that has learned "go to the green room".
    /// # for _ in 0..3 {
    /// #     agent.hear(&home, &state, "go to the green room")?;
    /// #     let _ = agent.finish(&home)?;
    /// #     while agent.learn(u32::MAX) == Progress::Working {}
    /// # }
    /// // The recogniser is a little surer of the wrong transcript.
    /// let heard = [Hypothesis { command: "goat tooth a grin broom", weight: 0.5 }, Hypothesis { command: "go to the green room", weight: 0.4 }];
    /// assert_eq!(agent.hear_one_of(&home, &state, &heard)?, 1);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// [`AgentError::Weight`] if a weight is negative or not a number, [`AgentError::EmptyCommand`] if there is no transcript, or all
    /// weights are 0, and as [`hear`](Self::hear) if none can be heard. No session is then under way.
    pub fn hear_one_of<D: Domain>(&mut self, domain: &D, state: &D::State, hypotheses: &[Hypothesis<'_>]) -> Result<usize, AgentError> {
        check(hypotheses, |weight| (0.0..=f32::MAX).contains(&weight))?;
        self.hear_most_probable(domain, state, hypotheses, Scaled::new)
    }

    /// As [`hear_one_of`](Self::hear_one_of), where each weight is the natural logarithm of a probability, as many recognisers give it: any
    /// number, because only differences count, up to 10,000, or negative infinity for 0. They may be far apart, because none is rounded to 0.
    ///
    /// A recogniser's acoustic scores differ too much to be logarithms of probabilities: multiply them first by its acoustic scale, often 0.1.
    ///
    /// # Errors
    /// As [`hear_one_of`](Self::hear_one_of); [`AgentError::Weight`] if a weight is infinity or not a number.
    pub fn hear_one_of_logs<D: Domain>(
        &mut self,
        domain: &D,
        state: &D::State,
        hypotheses: &[Hypothesis<'_>],
    ) -> Result<usize, AgentError> {
        check(hypotheses, |weight| weight < f32::INFINITY)?;
        let most = hypotheses.iter().map(|hypothesis| hypothesis.weight).fold(f32::NEG_INFINITY, f32::max);
        self.hear_most_probable(domain, state, hypotheses, |weight| {
            let apart = weight - most;
            Scaled::exp(if weight.is_finite() { apart.max(f32::MIN) } else { apart })
        })
    }

    fn hear_most_probable<D: Domain>(
        &mut self,
        domain: &D,
        state: &D::State,
        hypotheses: &[Hypothesis<'_>],
        probability: impl Fn(f32) -> Scaled,
    ) -> Result<usize, AgentError> {
        let (mut best, mut error): (Option<(usize, Scaled, Scaled)>, _) = (None, AgentError::EmptyCommand);
        let mut last = None;
        for (position, hypothesis) in hypotheses.iter().enumerate() {
            let sound = probability(hypothesis.weight);
            if sound.is_zero() {
                continue;
            }
            match self.hear_anew(domain, state, hypothesis.command, best.is_some()) {
                Ok(()) => {
                    let weight = self.explained().times(sound);
                    let is_better = |(_, most, loudest)| weight.exceeds(most) || (weight == most && sound.exceeds(loudest));
                    if best.is_none_or(is_better) {
                        best = Some((position, weight, sound));
                    }
                }
                // The next transcript would fail in the same way.
                Err(found @ (AgentError::NotNow(_) | AgentError::NoTask)) => return Err(found),
                Err(found) => error = found,
            }
            last = Some(position);
        }
        let Some((best, ..)) = best else { return Err(error) };
        if last != Some(best)
            && let Some(hypothesis) = hypotheses.get(best)
        {
            self.hear_anew(domain, state, hypothesis.command, true)?;
        }
        Ok(best)
    }

    /// Hears a command; `again` in the same session, so that the belief about the trainer does not drift twice.
    fn hear_anew<D: Domain>(&mut self, domain: &D, state: &D::State, command: &str, again: bool) -> Result<(), AgentError> {
        if again {
            self.belief_mut().restart(core::iter::empty(), 0.0)?;
        }
        self.hear(domain, state, command)
    }

    /// Pr(e|s) of the command that was just heard; 0 if no task explains it.
    fn explained(&self) -> Scaled {
        let belief = self.belief();
        let known = self.language().tables().words();
        let is_unheard = |word: &&Option<Symbol>| word.is_none_or(|word| word.index() >= known);
        let unheard = if known == 0 { 0 } else { self.sentence.iter().filter(is_unheard).count() };
        let says_nothing = self.tasks().iter().enumerate().all(|(position, task)| belief.prior(position) == Scaled::new(task.prior));
        if known > 0 && says_nothing {
            return Scaled::ZERO;
        }
        (0..unheard).fold(belief.whole(), |whole, _| whole.scaled_by(ONE_UNHEARD))
    }
}

/// It is an error if a weight is not allowed.
fn check(hypotheses: &[Hypothesis<'_>], allowed: impl Fn(f32) -> bool) -> Result<(), AgentError> {
    let wrong = hypotheses.iter().enumerate().find(|(_, hypothesis)| !allowed(hypothesis.weight));
    wrong.map_or(Ok(()), |(position, hypothesis)| {
        Err(AgentError::Weight { hypothesis: position.min(usize::from(u8::MAX)) as u8, value: hypothesis.weight })
    })
}
