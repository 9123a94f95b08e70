//! The decision on an utterance: the likeliest hypothesis, its tasks, and any objections to them.

use super::context::{Context, View};
use super::conversation::Before;
use super::explained::Explained;
use super::hypothesis::{Hypothesis, Judged};
use super::readings::{all, is_of_several, negated};
use super::reworded::reversed;
use super::several::has_more;
use super::syntax::{begins_with_new_word, has_condition, has_new_name, is_past, is_question, new_names, tells};
use super::words::Words;
use crate::memory::AgentMemory;
use crate::oomdp::Domain;
use crate::probability::Scaled;
use crate::session::{Agent, AgentError};
use crate::task::TaskSet;
use crate::voice::classes::Class;

/// A done task of the same kind makes the verdict unsure if it explains the words at least a fifth as well.
const RIVAL: f32 = 5.0;

/// The verdict on an utterance.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum Verdict {
    /// The most likely task is meant.
    Sure,
    /// It is uncertain which task is meant.
    Unsure,
    /// The most likely task is meant, and is done already.
    Done,
    /// No task that the robot can do here is meant.
    None,
}

impl<M: AgentMemory> Agent<M> {
    /// Decides on words, and on the tasks that they mean. Leaves the explanation of the words in `explained`.
    #[inline(never)]
    pub(super) fn judge<'w, D: Domain + ?Sized>(
        &mut self,
        domain: &D,
        words: Words<'w>,
        explained: &mut Explained,
        context: Context<'_>,
    ) -> Result<Judged<'w>, AgentError> {
        let (mut words, begin) = (words, words.get(0).map(|word| usize::from(word.piece)));
        if let Some((first, last)) = reversed(words) {
            if !context.earlier.is_rest {
                let part = self.judge_part(domain, first, explained, context)?;
                return Ok(Judged { hypothesis: Hypothesis::Several, rest: begin, ..part });
            }
            // The rest is the whole utterance again, with "before": by that time, the command to do first is done.
            words = last;
            self.explain_all(domain, words, View::PLAIN, context, explained)?;
        }
        let parting = self.part(domain, words, context)?;
        let likeliest = self.hypotheses(domain, words, explained, context, parting)?;
        let (Hypothesis::Several, Some(parting)) = (likeliest.hypothesis, parting) else {
            return self.judge_one(domain, likeliest, explained, context);
        };
        let part = self.judge_part(domain, parting.first, explained, context)?;
        // "Go there, but take the bag first" is in another order.
        let is_clear = part.is_clear && !words.from(parting.begin.saturating_sub(1)).has(Class::But);
        Ok(Judged {
            hypothesis: Hypothesis::Several,
            probability: likeliest.probability * part.probability,
            command: likeliest.probability * part.command,
            is_clear,
            rest: words.get(parting.begin).map(|word| usize::from(word.piece)),
            ..part
        })
    }

    /// Decides on the first of several commands.
    fn judge_part<'w, D: Domain + ?Sized>(
        &mut self,
        domain: &D,
        words: Words<'w>,
        explained: &mut Explained,
        context: Context<'_>,
    ) -> Result<Judged<'w>, AgentError> {
        self.explain_all(domain, words, View::PLAIN, context, explained)?;
        let likeliest = self.hypotheses(domain, words, explained, context, None)?;
        self.judge_one(domain, likeliest, explained, context)
    }

    /// The tasks of words that are not several commands, under their likeliest hypothesis.
    #[inline(never)]
    fn judge_one<'w, D: Domain + ?Sized>(
        &mut self,
        domain: &D,
        likeliest: Judged<'w>,
        explained: &mut Explained,
        context: Context<'_>,
    ) -> Result<Judged<'w>, AgentError> {
        let Judged { hypothesis, words, probability, .. } = likeliest;
        if hypothesis == Hypothesis::Talk(Class::Again)
            && let Some(task) = self.again(words, context.earlier.before, explained)
        {
            explained.keep_only(task);
            // No word of the utterance is learned for it.
            let again = Judged::likely(Hypothesis::Again, Words::NONE, probability, probability);
            return Ok(Judged { task, tasks: TaskSet::of(task), is_clear: true, ..again });
        }
        let judged = match hypothesis {
            Hypothesis::Negated => self.judge_negated(domain, likeliest, explained, context)?,
            Hypothesis::All => self.judge_all(domain, likeliest, explained, context)?,
            _ => None,
        };
        Ok(judged.unwrap_or_else(|| self.judge_command(domain, likeliest, explained)))
    }

    /// The state that words forbid, or the one to keep if they negate twice.
    fn judge_negated<'w, D: Domain + ?Sized>(
        &mut self,
        domain: &D,
        likeliest: Judged<'w>,
        explained: &mut Explained,
        context: Context<'_>,
    ) -> Result<Option<Judged<'w>>, AgentError> {
        let Judged { words, probability, .. } = likeliest;
        let Some(rest) = negated(words) else { return Ok(None) };
        self.explain_all(domain, rest.words, rest.view, context, explained)?;
        // "Both chairs out of the red room".
        let all = if is_of_several(words) { self.all_that_fit(domain, explained) } else { (TaskSet::EMPTY, 0.0) };
        let (task, of_task) = explained.best();
        let is_of_thing = self.place_of_thing(domain, task).is_some();
        // "Don't leave the red room" asks for a goal that holds, "don't leave the bag in the red room" does not.
        let holds = rest.is_double && !(is_of_thing && words.any(&|word| word.leaves));
        if !holds {
            self.negate(explained);
            self.plan_for(domain, self.task_count)?;
        }
        // "The red chair must not end up in the blue room", "I don't want you in the red room".
        let is_whole = explained.whole.contains(task) || self.is_only_one(domain, explained, task);
        let has_act = explained.acts || context.earlier.is_rest;
        let is_told = match is_of_thing {
            true => rest.things_need_no_act || !rest.stays && (has_act || is_whole),
            false => rest.needs_no_act || has_act || is_whole && words.has(Class::You),
        };
        let is_possible = !holds || self.done(domain).contains(task);
        let (tasks, of_tasks) = if all.0.contains(task) { all } else { (TaskSet::of(task), of_task) };
        Ok(Some(Judged {
            words: rest.words,
            task,
            tasks,
            probability: probability * of_tasks,
            command: probability,
            is_clear: rest.is_clear && is_told && is_possible && explained.fitting.contains(task) && !tells(words),
            ..likeliest
        }))
    }

    /// The tasks about all things of a kind.
    fn judge_all<'w, D: Domain + ?Sized>(
        &mut self,
        domain: &D,
        likeliest: Judged<'w>,
        explained: &mut Explained,
        context: Context<'_>,
    ) -> Result<Option<Judged<'w>>, AgentError> {
        let Judged { words, probability, .. } = likeliest;
        let Some(rest) = all(words) else { return Ok(None) };
        let mut excepted = TaskSet::EMPTY;
        if !rest.except.is_empty() {
            self.explain_all(domain, rest.except, rest.view, context, explained)?;
            excepted = explained.own;
        }
        let mut there = None;
        if !rest.from.is_empty() {
            self.explain_all(domain, rest.from, rest.view, context, explained)?;
            there = Some(explained.fitting.common(self.done(domain)));
        }
        self.explain_all(domain, rest.words, rest.view, context, explained)?;
        let (tasks, of_place) = self.all_that_fit(domain, explained);
        let is_there = |task: &usize| there.is_none_or(|there| there.iter().any(|other| self.thing(other) == self.thing(*task)));
        let tasks: TaskSet = tasks.without(excepted).iter().filter(is_there).collect();
        Ok(Some(Judged {
            words: explained.naming(rest.words),
            task: tasks.iter().next().unwrap_or(explained.best().0),
            tasks,
            probability: probability * of_place,
            command: probability,
            is_clear: rest.is_clear && !tasks.is_empty() && !tells(words) && !has_condition(words),
            ..likeliest
        }))
    }

    /// The task of a plain command, and any objections to it.
    fn judge_command<'w, D: Domain + ?Sized>(&self, domain: &D, likeliest: Judged<'w>, explained: &Explained) -> Judged<'w> {
        let Judged { words, command, .. } = likeliest;
        let (task, of_command) = explained.best();
        let (is_whole, is_own) = (explained.whole.contains(task), explained.own.contains(task));
        // "This or that" leaves the choice to the robot.
        let is_choice = words.any(&|word| word.is(Class::Or) && !word.is_of_lessons());
        // A word that names nothing known may be the name of something else.
        let is_named = is_own && (is_whole || !has_new_name(words));
        // "Paint the red room" is about no known task. A named thing with a place is enough: "haul that red chair to the red room".
        let is_of_thing = self.is_only_one(domain, explained, task);
        // "Switch on the lamp in the red room" has a new verb and a new name.
        let has_verb = is_of_thing || !begins_with_new_word(words) || explained.acted.contains(task) && new_names(words) == 0;
        let is_told = !is_question(words) && !tells(words) && !has_condition(words) && !is_past(words);
        let is_one = !is_choice && !has_more(words) && !self.has_rival(domain, explained, task);
        Judged {
            words: explained.naming(words),
            task,
            tasks: TaskSet::of(task),
            probability: command * of_command,
            is_clear: is_named && has_verb && is_told && is_one,
            ..likeliest
        }
    }

    /// Negates all tasks. The session is then about states to avoid.
    fn negate(&mut self, explained: &mut Explained) {
        let session = self.memory.lend().session;
        for (task, weight) in session.tasks.iter_mut().take(self.task_count).zip(&mut explained.weights) {
            match self.lifted.get(usize::from(task.lifted)).and_then(|lifted| task.negated(lifted)) {
                Some(negated) => *task = negated,
                None => *weight = Scaled::ZERO,
            }
        }
    }

    /// The position of the last task in the session, if the words ask for it again and for nothing else.
    fn again(&self, words: Words<'_>, before: Before<'_>, explained: &Explained) -> Option<usize> {
        let Before::Known(conversation) = before else { return None };
        let last = conversation.last()?;
        let asks = words.any(&|word| word.is(Class::Again) && !word.is_any(&[Class::Back, Class::Undo]));
        let task = self.tasks().iter().position(|task| (task.lifted, task.bindings) == (last.lifted, last.bindings))?;
        (asks && (!explained.acts || explained.acted.contains(task))).then_some(task)
    }

    /// Whether a done task of the same kind explains the words nearly as well as this one.
    fn has_rival<D: Domain + ?Sized>(&self, domain: &D, explained: &Explained, task: usize) -> bool {
        let done = self.done(domain);
        let likelihood = |task: usize| explained.likelihoods.get(task).copied().unwrap_or(Scaled::ZERO);
        let is_rival = |other: usize| {
            self.task(other).lifted == self.task(task).lifted && likelihood(other).scaled_by(RIVAL).exceeds(likelihood(task))
        };
        !done.contains(task) && done.iter().any(is_rival)
    }
}
