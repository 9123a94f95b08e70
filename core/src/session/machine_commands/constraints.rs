//! A task as the paper's machine commands: one for each constraint that its objects satisfy (paper, section 3).

use super::Each;
use crate::capacity::{Capacities, TOKENS_PER_COMMAND};
use crate::memory::{AgentMemory, AgentTables};
use crate::oomdp::Domain;
use crate::probability::Scaled;
use crate::session::agent::Agent;
use crate::session::candidates::{CandidateCount, Candidates};
use crate::session::error::AgentError;
use crate::session::least::{Lessons, Survey};
use crate::session::phase::Position;
use crate::task::Expression;
use crate::task::machine_command::Tokens;

impl<M: AgentMemory> Agent<M> {
    /// Continues the likelihood of the command for a task. Adds its machine commands to the candidates.
    pub(super) fn read_constraints<D: Domain>(&mut self, domain: &D, position: &mut Position, left: &mut u32) -> Result<bool, AgentError> {
        let task = position.task;
        self.for_each_constraint(domain, position, left, &mut |candidates, language, sentence, tokens, _| {
            let found = match candidates.read().find(tokens) {
                Some(found) => found,
                None => candidates.add(task, tokens, language.likelihood(sentence, tokens))?,
            };
            Ok(candidates.read().entries().get(found).map_or(Scaled::ZERO, |entry| entry.likelihood))
        })
    }

    #[inline(never)]
    pub(super) fn for_each_constraint<D: Domain>(
        &mut self,
        domain: &D,
        position: &mut Position,
        left: &mut u32,
        each: &mut Each<'_>,
    ) -> Result<bool, AgentError> {
        let AgentTables { language, session, workspace } = self.memory.lend();
        let mut language = self.language.with(language, workspace);
        let Some(task) = session.tasks.get(position.task) else { return Ok(true) };
        let Some(lifted) = self.lifted.get(usize::from(task.lifted)) else { return Ok(true) };
        let order = language.read().settings().order;
        // Borrow both `Result`s: moving the values out would copy them on the stack.
        let expression = Expression::new(domain, lifted, task, order, language.tokens_mut());
        let expression = expression.as_ref().map_err(|error| *error)?;
        let mut candidates = Candidates::new(session.candidates, &mut self.candidates);
        let mut tokens = Tokens::new();
        let share = 1.0 / f32::from(expression.constraints());
        while position.constraint < expression.constraints() && *left > 0 {
            expression.write_machine_command(position.constraint, &mut tokens)?;
            let value = each(&mut candidates, language.read(), &self.sentence, &tokens, share)?;
            position.sum = position.sum.plus(value.scaled_by(share));
            position.constraint = position.constraint.saturating_add(1);
            let cells = tokens.len().saturating_add(1).saturating_mul(self.sentence.len().max(1));
            *left = left.saturating_sub(cells as u32);
        }
        Ok(position.constraint >= expression.constraints())
    }

    /// A task's machine commands do not depend on the state. Other worlds have other machine commands.
    pub(super) fn most_constraints<D: Domain>(&mut self, domain: &D, lessons: &Lessons, survey: &Survey) -> Result<Capacities, AgentError> {
        let (sessions, words, before) = (lessons.sessions, lessons.heard_words(), survey.least);
        self.candidates = CandidateCount::NONE;
        for task in 0..self.task_count {
            let mut position = Position::of_task(task);
            while !self.for_each_constraint(domain, &mut position, &mut { u32::MAX }, &mut |candidates, _, _, tokens, _| {
                if candidates.read().find(tokens).is_none() {
                    candidates.add(task, tokens, Scaled::ZERO)?;
                }
                Ok(Scaled::ZERO)
            })? {}
        }
        // Each command length has alignment tables of its own; the longest lengths take the most cells.
        let different = sessions.min(words);
        let english = (0..different).fold(0_usize, |sum, shorter| sum.saturating_add(words.saturating_sub(shorter)));
        let candidates = self.candidates();
        let has_length = |length: usize| candidates.entries().iter().any(|entry| candidates.tokens(entry).len() == length);
        let (mut alignments, mut length_pairs) = (before.alignments, before.length_pairs);
        for length in (0..=TOKENS_PER_COMMAND).filter(|&length| has_length(length)) {
            alignments = alignments.saturating_add(length.saturating_add(1).saturating_mul(english));
            length_pairs = length_pairs.saturating_add(different);
        }
        let (count, tokens) = (candidates.entries().len(), candidates.all_tokens().len());
        let (commands, command_tokens) = if sessions == 0 { (0, 0) } else { (count, tokens) };
        Ok(Capacities {
            candidates: count,
            candidate_tokens: tokens,
            commands: commands.saturating_add(before.commands),
            command_tokens: command_tokens.saturating_add(before.command_tokens),
            alignments,
            length_pairs,
            ..Capacities::NONE
        })
    }
}
