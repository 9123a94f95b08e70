//! The machine commands of a session's tasks, in the form of the language model: one for each [constraint](constraints) on a task's
//! objects, for IBM Model 2, or one [description](description) of the task, for the role model.
//!
//! Only this module tells the two models apart for the agent.

mod constraints;
mod description;

use super::agent::Agent;
use super::candidates::{Candidate, Candidates};
use super::error::AgentError;
use super::least::{Lessons, Survey};
use super::phase::Position;
use crate::capacity::{Capacities, CapacityError};
use crate::language::{LanguageRef, Model};
use crate::memory::{AgentMemory, AgentTables};
use crate::oomdp::Domain;
use crate::probability::Scaled;
use crate::symbols::Symbol;
use crate::task::description::{Scene, form_token};
use crate::task::grounded::expect_change;
use crate::task::machine_command::head;

/// The callback for each machine command, with its share; a trait object, so that the loop is compiled once.
pub(super) type Each<'e> =
    dyn FnMut(&mut Candidates<'_>, LanguageRef<'_>, &[Option<Symbol>], &[Symbol], f32) -> Result<Scaled, CapacityError> + 'e;

impl<M: AgentMemory> Agent<M> {
    const fn model(&self) -> Model {
        self.options.language.model.in_use()
    }

    /// Lowers the priors of the session's tasks that ask a thing to stay where it is. Model 2 uses no such prior.
    pub(super) fn expect_change<D: Domain>(&mut self, domain: &D, state: &D::State, count: usize) {
        match self.model() {
            Model::Model2 => {}
            Model::Roles => {
                let tasks = self.memory.lend().session.tasks.get_mut(..count).unwrap_or(&mut []);
                expect_change(domain, &self.lifted, state, tasks);
            }
        }
    }

    /// Interns the tokens of the lifted tasks that the session's tasks ground: those of a machine command's propositions and classes, or of
    /// a description.
    #[inline(never)]
    pub(super) fn intern_own_tokens<D: Domain>(&mut self, domain: &D) -> Result<(), CapacityError> {
        let (model, schema) = (self.model(), &domain.world().schema);
        let AgentTables { language, session, workspace } = self.memory.lend();
        let mut language = self.language.called_with(language, workspace);
        let tasks = session.tasks.get(..self.task_count).unwrap_or(&[]);
        for (position, lifted) in self.lifted.iter().enumerate() {
            if tasks.iter().any(|task| usize::from(task.lifted) == position) {
                match model {
                    Model::Model2 => head(schema, lifted, language.tokens_mut()).map(drop)?,
                    Model::Roles => form_token(schema, lifted, language.tokens_mut()).map(drop)?,
                }
            }
        }
        Ok(())
    }

    /// Continues the likelihood of the command for the task at the position: the sum over its machine commands c of Pr(c|s,l,t) Pr(e|l,c).
    /// Adds them to the candidates. Returns whether all of the task's are done.
    pub(super) fn read_candidates<D: Domain>(
        &mut self,
        domain: &D,
        scene: &mut Option<Scene<D::State>>,
        position: &mut Position,
        left: &mut u32,
    ) -> Result<bool, AgentError> {
        match (self.model(), scene) {
            (Model::Model2, _) => self.read_constraints(domain, position, left),
            (Model::Roles, Some(scene)) => self.read_description(domain, scene, position, left),
            (Model::Roles, None) => Ok(true),
        }
    }

    /// Continues to call `each` with the machine commands of the task at the position, and Pr(c|s,l,t). Returns whether all of the task's are
    /// done.
    pub(super) fn for_each_candidate<D: Domain>(
        &mut self,
        domain: &D,
        position: &mut Position,
        left: &mut u32,
        mut each: impl FnMut(&mut Candidate, f32),
    ) -> Result<bool, AgentError> {
        match self.model() {
            Model::Model2 => self.for_each_constraint(domain, position, left, &mut |candidates, _, _, tokens, share| {
                if let Some(entry) = candidates.read().find(tokens).and_then(|found| candidates.entry_mut(found)) {
                    each(entry, share);
                }
                Ok(Scaled::ZERO)
            }),
            Model::Roles => {
                self.with_description(position, left, each);
                Ok(true)
            }
        }
    }

    /// Weighs the kinds of task, once the likelihood of each task is known.
    pub(super) fn weigh_kinds<D: Domain>(&mut self, domain: &D) {
        match self.model() {
            Model::Model2 => {}
            Model::Roles => self.weigh_kinds_of_descriptions(domain),
        }
    }

    /// The largest capacities that the machine commands of the grounded tasks take, together with those of earlier worlds: candidates for
    /// one session, commands for the training data. Interns their tokens, besides the `known` ones.
    pub(super) fn most_machine_commands<D: Domain>(
        &mut self,
        domain: &D,
        lessons: &Lessons,
        known: usize,
        survey: &mut Survey,
    ) -> Result<Capacities, AgentError> {
        match self.model() {
            Model::Model2 => self.most_constraints(domain, lessons, survey),
            Model::Roles => self.most_descriptions(domain, lessons, known, survey),
        }
    }
}
