//! The decision on an utterance: the likeliest hypothesis, its tasks, and any objections to them.

use super::classes::Class;
use super::conversation::Before;
use super::explained::Explained;
use super::heard::Words;
use super::hypothesis::Hypothesis;
use super::place::{Place, View};
use super::readings::{all, has_more, is_of_several, negated};
use super::reworded::reversed;
use super::syntax::{begins_with_new_word, has_condition, has_new_name, is_past, is_question, new_names, tells};
use super::wording::Wording;
use crate::memory::AgentMemory;
use crate::oomdp::{Domain, ObjectId};
use crate::probability::Scaled;
use crate::session::{Agent, AgentError};
use crate::task::TaskSet;

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

/// The decision on some words.
pub(super) struct Judged<'w> {
    pub hypothesis: Hypothesis,
    /// The words that name the tasks.
    pub words: Words<'w>,
    pub task: usize,
    pub tasks: TaskSet,
    pub probability: f32,
    pub command: f32,
    /// Whether only the probability could speak against the tasks.
    pub is_clear: bool,
    /// The piece of the utterance where the rest begins.
    pub rest: Option<usize>,
}

impl Judged<'_> {
    /// The last task once more. No word of the utterance is learned for it.
    fn again(task: usize, probability: f32) -> Self {
        let (hypothesis, words, tasks) = (Hypothesis::Again, Words::NONE, TaskSet::of(task));
        Self { hypothesis, words, task, tasks, probability, command: probability, is_clear: true, rest: None }
    }
}

impl<M: AgentMemory> Agent<M> {
    /// Decides on words, and on the tasks that they mean. Leaves the explanation of the words in `explained`.
    #[inline(never)]
    pub(super) fn judge<'w, D: Domain + ?Sized>(
        &mut self,
        domain: &D,
        words: Words<'w>,
        explained: &mut Explained,
        wording: &Wording<'_>,
        place: Place<'_>,
    ) -> Result<Judged<'w>, AgentError> {
        let (mut words, begin) = (words, words.get(0).map(|word| usize::from(word.piece)));
        if let Some((first, last)) = reversed(words) {
            // The rest is then the whole utterance again, with "before": by that time, the command to do first is done.
            words = if place.is_rest { last } else { first };
            self.explain_all(domain, words, wording, place.view(View::PLAIN), explained)?;
            if !place.is_rest {
                let taken = self.hypotheses(domain, words, wording, explained, place, None)?;
                let part = self.judge_one(domain, words, explained, wording, place, taken)?;
                return Ok(Judged { hypothesis: Hypothesis::Several, rest: begin, ..part });
            }
        }
        let parting = self.part(domain, words, wording, place)?;
        let (best, share, command) = self.hypotheses(domain, words, wording, explained, place, parting)?;
        let (Hypothesis::Several, Some(parting)) = (best, parting) else {
            return self.judge_one(domain, words, explained, wording, place, (best, share, command));
        };
        let first = parting.first;
        self.explain_all(domain, first, wording, place.view(View::PLAIN), explained)?;
        let taken = self.hypotheses(domain, first, wording, explained, place, None)?;
        let part = self.judge_one(domain, first, explained, wording, place, taken)?;
        let (probability, command) = (share * part.probability, share * part.command);
        let rest = words.get(parting.begin).map(|word| usize::from(word.piece));
        // "Go there, but take the bag first" is in another order.
        let is_clear = part.is_clear && !words.part(parting.begin.saturating_sub(1), words.len()).has(Class::But);
        Ok(Judged { hypothesis: best, probability, command, rest, is_clear, ..part })
    }

    /// The tasks of words that are not several commands. `taken` is their hypothesis, its probability, and the probability of a plain
    /// command.
    #[inline(never)]
    fn judge_one<'w, D: Domain + ?Sized>(
        &mut self,
        domain: &D,
        words: Words<'w>,
        explained: &mut Explained,
        wording: &Wording<'_>,
        place: Place<'_>,
        (hypothesis, share, command): (Hypothesis, f32, f32),
    ) -> Result<Judged<'w>, AgentError> {
        if let (Hypothesis::Negated, Some(rest)) = (hypothesis, negated(words)) {
            self.explain_all(domain, rest.words, wording, place.view(rest.view), explained)?;
            // "Both chairs out of the red room".
            let all = if is_of_several(words) { self.all_that_fit(domain, explained) } else { (TaskSet::EMPTY, 0.0) };
            let (task, of_tasks) = explained.best();
            let is_of_thing = self.place_of_thing(domain, task).is_some();
            // "Don't leave the red room" asks for a goal that holds, "don't leave the bag in the red room" does not.
            let holds = rest.is_double && !(is_of_thing && words.iter().any(|word| word.leaves));
            if !holds {
                let _ = self.negate(explained);
                self.plan_for(domain, self.task_count)?;
            }
            // "The red chair must not end up in the blue room", "I don't want you in the red room".
            let is_whole = explained.whole.contains(task) || self.is_only_one(domain, explained, task);
            let has_act = match is_of_thing {
                true => rest.is_act_for_things || !rest.stays && (explained.acts || place.is_rest || is_whole),
                false => rest.is_act || explained.acts || place.is_rest || is_whole && words.has(Class::You),
            };
            let is_clear = rest.is_clear && has_act && explained.fitting.contains(task) && !tells(words);
            let is_clear = is_clear && (!holds || self.done(domain).contains(task));
            let (tasks, of_tasks) = if all.0.contains(task) { all } else { (TaskSet::of(task), of_tasks) };
            let (words, probability) = (rest.words, share * of_tasks);
            return Ok(Judged { hypothesis, words, task, tasks, probability, command: share, is_clear, rest: None });
        }
        if let (Hypothesis::All, Some(rest)) = (hypothesis, all(words)) {
            let mut excepted = TaskSet::EMPTY;
            if !rest.except.is_empty() {
                self.explain_all(domain, rest.except, wording, place.view(rest.view), explained)?;
                excepted = explained.own;
            }
            let mut there = None;
            if !rest.from.is_empty() {
                self.explain_all(domain, rest.from, wording, place.view(rest.view), explained)?;
                there = Some(explained.fitting.common(self.done(domain)));
            }
            self.explain_all(domain, rest.words, wording, place.view(rest.view), explained)?;
            let (tasks, of_place) = self.all_that_fit(domain, explained);
            let is_there = |task: &usize| there.is_none_or(|there| there.iter().any(|other| self.thing(other) == self.thing(*task)));
            let tasks: TaskSet = tasks.without(excepted).iter().filter(is_there).collect();
            let is_only_told = tells(words) || has_condition(words);
            let task = tasks.iter().next().unwrap_or(explained.best().0);
            let (words, is_clear, probability) =
                (explained.naming(rest.words), rest.is_clear && !tasks.is_empty() && !is_only_told, share * of_place);
            return Ok(Judged { hypothesis, words, task, tasks, probability, command: share, is_clear, rest: None });
        }
        if hypothesis == Hypothesis::Talk(Class::Again)
            && let Some(task) = self.again(words, place.before, explained)
        {
            explained.keep_only(task);
            return Ok(Judged::again(task, share));
        }
        let (task, of_command) = explained.best();
        let (tasks, probability) = (TaskSet::of(task), command * of_command);
        // "This or that" leaves the choice to the robot.
        let is_choice = words.iter().any(|word| word.classes.contains(Class::Or) && word.count == 0.0);
        // A word that names nothing known may be the name of something else.
        let is_named = explained.own.contains(task) && (explained.whole.contains(task) || !has_new_name(words));
        // "Paint the red room" is about no known task. A named thing with a place is enough: "haul that red chair to the red room".
        let is_of_thing =
            explained.whole.contains(task) && self.place_of_thing(domain, task).is_some() || self.is_only_one(domain, explained, task);
        // "Switch on the lamp in the red room" has a new verb and a new name.
        let has_verb = is_of_thing || !begins_with_new_word(words) || explained.acted.contains(task) && new_names(words) == 0;
        let is_told = is_named && has_verb && !is_choice && !is_question(words) && !tells(words) && !has_condition(words);
        let is_clear = is_told && !is_past(words) && !has_more(words) && !self.has_rival(domain, explained, task);
        let words = explained.naming(words);
        Ok(Judged { hypothesis, words, task, tasks, probability, command, is_clear, rest: None })
    }

    /// The position of the last task in the session, if the words ask for it again and for nothing else.
    fn again(&self, words: Words<'_>, before: Before<'_>, explained: &Explained) -> Option<usize> {
        let Before::Known(conversation) = before else { return None };
        let last = conversation.last()?;
        let asks = words.iter().any(|word| word.classes.contains(Class::Again) && !word.classes.contains_any(&[Class::Back, Class::Undo]));
        let task = self.tasks().iter().position(|task| (task.lifted, task.bindings) == (last.lifted, last.bindings))?;
        (asks && (!explained.acts || explained.signed.contains(task))).then_some(task)
    }

    /// The first object of a task of one proposition.
    pub(super) fn thing(&self, task: usize) -> Option<ObjectId> {
        let task = self.task(task);
        let lifted = self.lifted().get(usize::from(task.lifted))?;
        task.propositions(lifted).next()?.arguments.first().copied()
    }

    /// Whether a task about a thing and its place is the only one that fits both names.
    fn is_only_one<D: Domain + ?Sized>(&self, domain: &D, explained: &Explained, task: usize) -> bool {
        let place = self.place_of_thing(domain, task);
        let alike = || (0..self.task_count).filter(|&other| place.is_some() && self.place_of_thing(domain, other) == place);
        let fits = |task: &usize| explained.fitting.contains(*task);
        fits(&task) && alike().count() > 1 && alike().filter(fits).count() == 1
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
