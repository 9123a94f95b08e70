//! How a session begins: a command becomes a belief over the tasks that are possible here (paper, Algorithm 1).

use super::agent::Agent;
use super::candidates::Candidates;
use super::error::AgentError;
use crate::capacity::CapacityError;
use crate::language::{LanguageModel, Sentence};
use crate::oomdp::{Domain, digest};
use crate::probability::Scaled;
use crate::symbols::Symbol;
use crate::task::machine_command::{Tokens, intern_heads};
use crate::task::{Expression, GroundedTask, LiftedTask, ground};

impl<'m> Agent<'m> {
    /// Hears a command in the state that the session starts from: the tasks possible here get their prior from the language model,
    /// Pr(t|e,s) proportional to the sum over l of Pr(l|s) Pr(t|s,l) times the sum over c of Pr(c|s,l,t) Pr(e|l,c).
    ///
    /// # Errors
    /// [`AgentError`]; no session is then under way (but for [`AgentError::StillLearning`], which changes nothing), and what was learned is
    /// kept.
    pub fn hear<D: Domain + ?Sized>(&mut self, domain: &D, state: &D::State, command: &str) -> Result<(), AgentError> {
        self.open(domain, state, command)?;
        self.understand(domain)
    }

    /// Hears a command whose task prior is given: `prior(task, lifted)` for each task and the lifted task that it grounds, in any unit.
    ///
    /// # Errors
    /// As [`hear`](Self::hear), and [`AgentError::NotAProbability`].
    pub fn hear_with_prior<D: Domain + ?Sized>(
        &mut self,
        domain: &D,
        state: &D::State,
        command: &str,
        prior: impl Fn(&GroundedTask, &LiftedTask) -> f32,
    ) -> Result<(), AgentError> {
        self.open(domain, state, command)?;
        // The machine commands' likelihoods are still needed when the session is learned from.
        self.understand(domain)?;
        let mut any = false;
        for position in 0..self.task_count {
            let task = self.tasks.get(position).copied().unwrap_or(GroundedTask::UNUSED);
            let value = self.lifted.get(usize::from(task.lifted)).map_or(0.0, |lifted| prior(&task, lifted));
            if !(0.0..=f32::MAX).contains(&value) {
                return self.refuse_prior();
            }
            any |= value > 0.0;
            self.belief.set_prior(position, Scaled::new(value));
        }
        if !any {
            return self.refuse_prior();
        }
        Ok(())
    }

    /// Ends the session that was about to begin: a belief of no tasks is a belief all the same.
    fn refuse_prior(&mut self) -> Result<(), AgentError> {
        self.start = None;
        self.belief.restart(core::iter::empty())?;
        Err(AgentError::NotAProbability)
    }

    /// Hears the same command again in the same initial state: the belief goes on. An ended session, learned from or forgotten, is taken up
    /// again by this.
    ///
    /// # Errors
    /// [`AgentError::NoSession`] where the last session did not start in this state, and [`AgentError::StillLearning`] while what it ended
    /// with is being learned.
    pub fn hear_again<D: Domain + ?Sized>(&mut self, domain: &D, state: &D::State) -> Result<(), AgentError> {
        if self.start != Some(domain.number(state)) || self.domain != digest(domain) || self.tasks().is_empty() {
            return Err(AgentError::NoSession);
        }
        if self.language.is_training() {
            return Err(AgentError::StillLearning);
        }
        self.ended = false;
        self.belief.settle();
        self.forget_plan();
        Ok(())
    }

    #[inline(never)]
    fn open<D: Domain + ?Sized>(&mut self, domain: &D, state: &D::State, command: &str) -> Result<(), AgentError> {
        if self.language.is_training() {
            return Err(AgentError::StillLearning);
        }
        self.start = None;
        self.ended = false;
        self.forget_plan();
        self.followed = None;
        self.task_count = 0;
        self.language.forget_unlearned();
        self.language.hear_into(command, &mut self.sentence)?;
        if self.sentence.is_empty() {
            return Err(AgentError::EmptyCommand);
        }
        let count = ground(domain, &self.lifted, state, self.tasks)?;
        if count == 0 {
            return Err(AgentError::NoTask);
        }
        self.set_tasks(domain, count, state)?;
        self.task_count = count;
        self.domain = digest(domain);
        self.start = Some(domain.number(state));
        Ok(())
    }

    /// Begins the belief with each task's Pr(l|s) Pr(t|s,l) times the sum over c of Pr(c|s,l,t) Pr(e|l,c). Fills the candidates.
    fn understand<D: Domain + ?Sized>(&mut self, domain: &D) -> Result<(), AgentError> {
        let result = self.try_understand(domain);
        if result.is_err() {
            self.start = None;
        }
        result
    }

    #[inline(never)]
    fn try_understand<D: Domain + ?Sized>(&mut self, domain: &D) -> Result<(), AgentError> {
        self.candidates.clear();
        self.belief.restart(self.tasks.iter().take(self.task_count).map(|task| Scaled::new(task.prior)))?;
        // The tasks' own tokens come first, and what can be said of objects after them, as far as there is room.
        intern_heads(&domain.world().schema, &self.lifted, self.tasks.get(..self.task_count).unwrap_or(&[]), self.language.tokens_mut())?;
        let mut any = false;
        for position in 0..self.task_count {
            let explained = self.for_each_candidate(domain, position, |candidates, language, sentence, tokens, _| {
                let found = match candidates.find(tokens) {
                    Some(found) => found,
                    None => candidates.add(tokens, language.likelihood(sentence, tokens))?,
                };
                Ok(candidates.entries().get(found).map_or(Scaled::ZERO, |entry| entry.likelihood))
            })?;
            let prior = explained.scaled_by(self.tasks.get(position).map_or(0.0, |task| task.prior));
            any |= !prior.is_zero();
            self.belief.set_prior(position, prior);
        }
        // A command that nothing explains says nothing.
        if !any {
            for position in 0..self.task_count {
                self.belief.set_prior(position, Scaled::new(self.tasks.get(position).map_or(0.0, |task| task.prior)));
            }
        }
        Ok(())
    }

    /// The sum over the constraints of a task of Pr(c|s,l,t), which is the last argument of `each`, times what `each` gives for the machine
    /// command.
    pub(super) fn for_each_candidate<D: Domain + ?Sized>(
        &mut self,
        domain: &D,
        position: usize,
        mut each: impl FnMut(&mut Candidates<'m>, &LanguageModel<'m>, &Sentence, &[Symbol], f32) -> Result<Scaled, CapacityError>,
    ) -> Result<Scaled, AgentError> {
        let Some(task) = self.tasks.get(position) else { return Ok(Scaled::ZERO) };
        let Some(lifted) = self.lifted.get(usize::from(task.lifted)) else { return Ok(Scaled::ZERO) };
        let order = self.language.settings().order;
        // Left where it was made, and the tokens too: taken out of their results, they would stand on the stack twice.
        let expression = Expression::new(domain, lifted, task, order, self.language.tokens_mut());
        let expression = expression.as_ref().map_err(|error| *error)?;
        let mut tokens = Tokens::new();
        let share = 1.0 / f32::from(expression.constraints());
        let mut sum = Scaled::ZERO;
        for constraint in 0..expression.constraints() {
            expression.write_machine_command(constraint, &mut tokens)?;
            sum = sum.plus(each(&mut self.candidates, &self.language, &self.sentence, &tokens, share)?.scaled_by(share));
        }
        Ok(sum)
    }
}
