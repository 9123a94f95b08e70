//! The decision on an utterance: the likeliest hypothesis, its tasks, and any objections to them.

use super::acceptance::{ACTS_FROM, BETWEEN, Clues, DONE_FROM, OTHER, Sorts, TURNING, asks, clear_from, odds};
use super::context::{Context, View};
use super::conversation::Before;
use super::explained::Explained;
use super::heard::Heard;
use super::hypothesis::{Hypothesis, Judged, likeliest};
use super::readings::{GATHERED, GATHERINGS, Gathering, Name, WithoutCues, all, gatherings, negated};
use super::recalled::of_last;
use super::repair::{Shape, WEIGHED};
use super::several::Parting;
use super::syntax::has_new_name;
use super::words::Words;
use crate::memory::AgentMemory;
use crate::oomdp::Domain;
use crate::probability::{Scaled, total};
use crate::session::{Agent, AgentError};
use crate::task::TaskSet;
use crate::voice::classes::Class;
use heapless::Vec;

/// The most readings of an utterance that are compared: repairs, gatherings, four for each order of several commands, four of a
/// command and three of a prohibition, and one of all things.
const MEANINGS: usize = WEIGHED + GATHERINGS + 2 * 4 + 4 + 3 + 1;

/// From this probability on, an uncertain reading says more than the likeliest hypothesis that asks for nothing.
const WORTH_ASKING: f32 = 0.4;

/// What speaks against the tasks of a reading, one bit each: clues for the [acceptance](super::acceptance).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) struct Doubts(u16);

impl Doubts {
    /// No doubts.
    pub const NONE: Self = Self(0);
    /// The names of all doubts.
    const NAMES: [&'static str; 9] = [
        "a thing outside the task",
        "a new name",
        "other cues",
        "not possible",
        "not fitting",
        "no tasks",
        "a likelier task",
        "a name of two things",
        "a likelier kind",
    ];
    /// How many there are.
    pub const COUNT: usize = Self::NAMES.len();

    /// These doubts, in order.
    fn of(doubts: &[(Doubt, bool)]) -> Self {
        Self(doubts.iter().fold(0, |all, &(doubt, holds)| all | u16::from(holds) << doubt as u16))
    }

    /// Whether the doubt at a position holds.
    pub const fn has(self, position: usize) -> bool {
        self.0 >> (position & 15) & 1 == 1
    }

    /// The name of the doubt at a position.
    pub fn name(position: usize) -> &'static str {
        Self::NAMES.get(position).copied().unwrap_or("")
    }
}

/// A doubt, by its position in [`Doubts`].
#[derive(Clone, Copy)]
enum Doubt {
    Foreign,
    NewName,
    Cues,
    Impossible,
    Unfitting,
    NoTasks,
    /// Another task is likelier, although it lacks a name.
    Outweighed,
    /// Neighbouring names are not those of one thing.
    TwoThings,
    /// A task of another kind is likelier.
    OtherKind,
}

/// Which of the readings that words have under a hypothesis is meant.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Choice {
    /// The likeliest.
    Likeliest,
    /// Of the first of several commands the plain command, although another reading of it is likelier: "but first take ..."; of words that
    /// may refer, those that do not: "wait in the red room".
    Plain,
    /// The likeliest task about all that is named, although another one is likelier: "don't let the basket go into the red room".
    AllNamed,
    /// The likeliest task of another kind, about another thing, than the likeliest of all: "put yourself in the red room".
    OtherKind,
}

/// A reading of an utterance, as a robot weighs it.
pub struct Reading<'r> {
    /// What it is.
    pub hypothesis: Hypothesis,
    /// Its tasks, by their positions in the session; of several commands, those of the first.
    pub tasks: TaskSet,
    /// Whether it forbids them.
    pub is_negated: bool,
    /// How much more probable it is than that nothing was meant.
    pub odds: f32,
    /// The byte where the rest of the utterance begins, if it has several commands. It is the whole utterance again if the second command
    /// is to be done first.
    pub rest: Option<usize>,
    /// Why.
    pub clues: &'r Clues<'r>,
}

/// A reading before its tasks are known.
#[derive(Clone, Copy)]
struct Candidate<'w> {
    hypothesis: Hypothesis,
    words: Words<'w>,
    share: f32,
    /// Whether the second of several commands is to be done first.
    is_turned: bool,
    choice: Choice,
    /// Of a command about all things that no known cue tells, what tells it, with the name that does.
    gathering: Option<(Gathering, Name)>,
    /// Of a repair, which one, and what it takes back.
    repair: Option<(u8, Shape)>,
    /// Whether the words were explained as a plain command just now, and refer to nothing.
    is_explained: bool,
}

/// A reading while it is compared with others.
struct Meaning<'w, 'c> {
    candidate: &'c Candidate<'w>,
    /// Its tasks, whether they are forbidden, and whether others follow.
    asked: (TaskSet, bool, bool),
    odds: f32,
    /// The robot acts on it if it is more probable than this.
    least: f32,
}

/// The verdict on an utterance.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
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
    /// Decides on words, and on the tasks that they mean: the reading that was most probably meant. `explained` has the words as a command;
    /// then it has the reading's.
    #[inline(never)]
    pub(super) fn judge<'w, D: Domain>(
        &mut self,
        domain: &D,
        words: Words<'w>,
        sorts: &Sorts<'_>,
        explained: &mut Explained,
        context: Context<'_>,
    ) -> Result<Judged<'w>, AgentError> {
        // The rest of a rest is shorter, so that an utterance that is heard part by part comes to an end.
        let is_shorter = |parting: &Parting<'_>| words.get(parting.begin).is_some_and(|word| word.piece > 0);
        let parting = self.part(domain, words, context)?.filter(|parting| !context.earlier.is_rest || is_shorter(parting));
        let (weighed, command, whole) = self.hypotheses(domain, words, explained, context, parting)?;
        let (likeliest, most) = likeliest(&weighed, words, context.is_known());
        let plain = |hypothesis, share| Candidate {
            hypothesis,
            words,
            share,
            is_turned: false,
            choice: Choice::Likeliest,
            gathering: None,
            repair: None,
            is_explained: false,
        };
        // What is asked for again was understood before; and where a new word may mean "not", nothing is weighed.
        if matches!(likeliest, Hypothesis::Talk(Class::Again) | Hypothesis::Reversed) {
            let (judged, _) = self.read(domain, plain(likeliest, most), command, explained, context, parting)?;
            let is_again = judged.hypothesis == Hypothesis::Again;
            // "Bring it back again" says more than "again".
            if is_again || likeliest == Hypothesis::Reversed || !context.is_known() {
                let is_accepted = is_again && most >= clear_from(self.language().bitext().sessions());
                return Ok(Judged { is_accepted, ..judged });
            }
        }
        let repairs = self.repairs(domain, words, explained, context)?;
        let turned = parting.and_then(|parting| parting.turned(words, context.earlier.is_rest));
        let parting_of = |candidate: Candidate<'w>| if candidate.is_turned { turned } else { parting };
        let gatherings = gatherings(words);
        let mut candidates: Vec<Candidate<'w>, MEANINGS> = Vec::new();
        let mut weigh = |candidate: Candidate<'w>| {
            let choices: &[Choice] = match candidate.hypothesis {
                _ if candidate.repair.is_some() || candidate.gathering.is_some() => &[Choice::Likeliest],
                Hypothesis::Several => &[Choice::Likeliest, Choice::Plain, Choice::AllNamed, Choice::OtherKind],
                Hypothesis::Command => &[Choice::Likeliest, Choice::AllNamed, Choice::OtherKind, Choice::Plain],
                Hypothesis::Negated => &[Choice::Likeliest, Choice::AllNamed, Choice::OtherKind],
                _ => &[Choice::Likeliest],
            };
            for &choice in choices {
                let _ = candidates.push(Candidate { choice, ..candidate });
            }
        };
        for (at, repair) in (0..).zip(&repairs) {
            let share = repair.weight.over(whole.plus(repair.weight));
            weigh(Candidate { words: repair.judged.words, repair: Some((at, repair.shape)), ..plain(Hypothesis::Command, share) });
        }
        for &gathering in &gatherings {
            // Its share is known when its words are explained.
            weigh(Candidate { gathering: Some(gathering), ..plain(Hypothesis::All, 1.0) });
        }
        if let Some(turned) = turned {
            weigh(Candidate { is_turned: true, ..plain(Hypothesis::Several, turned.weight.over(whole.plus(turned.weight))) });
        }
        for &(hypothesis, share) in weighed.iter().filter(|&&(hypothesis, share)| asks(hypothesis) && share > 0.0) {
            weigh(plain(hypothesis, share));
        }
        let mut meanings: Vec<Meaning<'w, '_>, MEANINGS> = Vec::new();
        let mut is_explained = false;
        for candidate in &candidates {
            let repair = candidate.repair.and_then(|(at, _)| repairs.get(usize::from(at)));
            let &Candidate { hypothesis, mut share, is_turned, gathering, .. } = candidate;
            let parting = parting_of(*candidate).filter(|_| hypothesis == Hypothesis::Several);
            let is_other = |other| repair.is_some() || gathering.is_some() || other != hypothesis;
            let others = weighed.iter().filter(|&&(other, _)| is_other(other));
            let rival = others.fold((Hypothesis::Nothing, 0.0), |most, &(other, share)| if share > most.1 { (other, share) } else { most });
            let between = match (repair, parting, gathering) {
                (Some(repair), ..) => Some((repair.between, repair.shape.sign())),
                (_, Some(parting), _) => Some((parting.between(words), if is_turned { TURNING } else { BETWEEN })),
                (.., Some((gathering, _))) => Some((words.only(|word| !word.is_name), gathering.sign())),
                _ if candidate.choice == Choice::OtherKind => Some((words.only(|word| !word.is_name), OTHER)),
                _ => None,
            };
            let is_near = |word: &Heard| gathering.is_none_or(|(_, name)| name.is_near(words, word));
            let between = between.map(|(words, sign)| sorts.between(words, &is_near, sign));
            // New words forbid, mean all things, or change what was done only if people were heard to say so with them: a young robot takes its
            // first words for commands.
            let changes = repair.is_some_and(|repair| repair.shape.change().is_some());
            let is_heard = match gathering {
                Some(_) => between.is_some_and(|words| words.asks()),
                None if changes => between.is_some_and(|words| words.repairs()),
                None => hypothesis != Hypothesis::Negated || sorts.forbids() || negated(words).is_some_and(|it| it.is_clear),
            };
            let observe = context.wording.observe;
            if !is_heard && observe.is_none() {
                continue;
            }
            let done = self.done(domain);
            let (mut judged, first) = match repair {
                Some(repair) => (Judged { probability: share * repair.judged.probability, ..repair.judged }, None),
                None => self.read(domain, Candidate { is_explained, ..*candidate }, command, explained, context, parting)?,
            };
            is_explained = match candidate.choice {
                _ if hypothesis != Hypothesis::Command || repair.is_some() => false,
                Choice::Likeliest => !explained.points_back,
                _ => is_explained,
            };
            if gathering.is_some() {
                let weight = explained.here.scaled_by(GATHERED);
                share = weight.over(whole.plus(weight));
                judged.probability *= share;
            }
            if judged.tasks.is_empty() {
                continue;
            }
            let clues = Clues {
                sorts,
                hypothesis,
                first,
                repair: repair.map(|repair| repair.shape),
                gathering: gathering.map(|(gathering, _)| gathering),
                between: between.as_ref(),
                share,
                of_tasks: judged.probability / share,
                rival,
                tasks: judged.tasks.iter().count(),
                is_done: if judged.is_negated { judged.tasks.common(done).is_empty() } else { judged.tasks.without(done).is_empty() },
                is_asked: words.is_asked,
                points_back: explained.points_back || repair.is_some_and(|repair| of_last(context.earlier.before, repair.shape).is_some()),
                told: context.told.map(|told| told.is_place),
                is_of_thing: self.place_of_thing(domain, judged.task).is_some(),
                is_rest: context.earlier.is_rest,
                is_turned: candidate.is_turned,
                lessons: self.language().bitext().sessions(),
                doubts: judged.doubts,
            };
            let odds = odds(&clues);
            let Judged { hypothesis, tasks, is_negated, rest, .. } = judged;
            if let Some(observe) = observe {
                observe(&Reading { hypothesis, tasks, is_negated, odds, rest: sorts.place(rest), clues: &clues });
            }
            if !is_heard {
                continue;
            }
            let meaning = Meaning {
                candidate,
                asked: (tasks, is_negated, rest.is_some()),
                odds,
                least: match () {
                    () if judged.doubts.has(Doubt::Impossible as usize) => f32::INFINITY,
                    // After the first of several commands, the others follow.
                    () if clues.is_done && rest.is_none() => DONE_FROM,
                    () => ACTS_FROM,
                },
            };
            let _ = meanings.push(meaning);
        }
        // Readings with the same tasks support each other, and the others compete.
        let sum = 1.0 + meanings.iter().map(|meaning| meaning.odds).sum::<f32>();
        let mut best: Option<(&Meaning<'w, '_>, f32, bool)> = None;
        for meaning in &meanings {
            let same = meanings.iter().filter(|other| other.asked == meaning.asked).map(|other| other.odds).sum::<f32>();
            let probability = same / sum;
            // Of those with the same tasks, the later takes back nothing, or says how many are meant.
            if best.is_none_or(|(_, most, _)| probability >= most) {
                best = Some((meaning, probability, probability > meaning.least));
            }
        }
        // A reading that is improbable says less than the likeliest hypothesis.
        let best = best.filter(|&(_, probability, _)| probability > WORTH_ASKING || asks(likeliest));
        let (candidate, probability, is_accepted) = best
            .map_or((plain(likeliest, most), 0.0, false), |(meaning, probability, is_accepted)| {
                (*meaning.candidate, probability, is_accepted)
            });
        let (judged, _) = self.read(domain, candidate, command, explained, context, parting_of(candidate))?;
        if let Some(among) = self.among(candidate.choice, explained) {
            explained.prefer(among);
        }
        if judged.is_negated {
            self.negate(explained);
            self.plan_for(domain, self.task_count)?;
        }
        let of_tasks = explained.weights.get(judged.task).map_or(0.0, |weight| weight.over(total(explained.weights.iter().copied())));
        Ok(Judged { probability, is_accepted, command: if of_tasks > 0.0 { (probability / of_tasks).min(1.0) } else { command }, ..judged })
    }

    /// The tasks of words under a hypothesis, and what the first of several commands is. Leaves the explanation in `explained`.
    fn read<'w, D: Domain>(
        &mut self,
        domain: &D,
        candidate: Candidate<'w>,
        command: f32,
        explained: &mut Explained,
        context: Context<'_>,
        parting: Option<Parting<'w>>,
    ) -> Result<(Judged<'w>, Option<Hypothesis>), AgentError> {
        let Candidate { hypothesis, words, share: probability, gathering, .. } = candidate;
        if let Some((gathering, name)) = gathering {
            let likely = Judged::likely(hypothesis, words, probability, command);
            return Ok((self.judge_all(domain, likely, gathering.read(words, name), explained, context)?, None));
        }
        if let Some((_, shape)) = candidate.repair {
            self.explain_repaired(domain, words, shape, explained, context)?;
            return Ok((self.judge_repaired(Judged::likely(hypothesis, words, probability, command), shape, explained), None));
        }
        let (Hypothesis::Several, Some(parting)) = (hypothesis, parting) else {
            let likely = Judged::likely(hypothesis, words, probability, command);
            // A prohibition, and a command about all things, are explained without their cues.
            let has_cues =
                hypothesis == Hypothesis::Negated && negated(words).is_some() || hypothesis == Hypothesis::All && all(words).is_some();
            if !candidate.is_explained && !has_cues {
                self.explain_all(domain, words, View::PLAIN, context, explained)?;
            }
            let refers = !has_cues && explained.points_back;
            if hypothesis == Hypothesis::Command && candidate.choice == Choice::Plain && !refers {
                return Ok((likely, None));
            }
            if refers && matches!(candidate.choice, Choice::OtherKind | Choice::Plain) {
                self.explain_words(domain, words, View::PLAIN, context, None, explained)?;
            }
            return Ok((self.judge_one(domain, likely, candidate.choice, explained, context)?, None));
        };
        self.explain_all(domain, parting.first, View::PLAIN, context, explained)?;
        let (weighed, command, _) = self.hypotheses(domain, parting.first, explained, context, None)?;
        let (mut first, mut share) = likeliest(&weighed, parting.first, context.is_known());
        // Any other hypothesis is read as a command already.
        let is_command = !matches!(first, Hypothesis::Negated | Hypothesis::All);
        match candidate.choice {
            Choice::Plain if is_command => return Ok((Judged::likely(hypothesis, words, probability, command), None)),
            Choice::Plain => (first, share) = (Hypothesis::Command, command),
            _ => {}
        }
        let part = self.judge_one(domain, Judged::likely(first, parting.first, share, command), candidate.choice, explained, context)?;
        if matches!(candidate.choice, Choice::AllNamed | Choice::OtherKind) && part.tasks.is_empty() {
            return Ok((Judged::likely(hypothesis, words, probability, command), None));
        }
        let begin = if parting.is_turned { 0 } else { words.get(parting.begin).map_or(0, |word| usize::from(word.piece)) };
        let is_all = parting.is_turned && context.earlier.is_rest;
        let several = Judged {
            hypothesis: if is_all { part.hypothesis } else { hypothesis },
            probability: probability * part.probability,
            rest: (!is_all).then_some(begin),
            ..part
        };
        Ok((several, Some(part.hypothesis)))
    }

    /// The tasks of words that are not several commands, under their likeliest hypothesis; none if there is nothing to choose.
    #[inline(never)]
    fn judge_one<'w, D: Domain>(
        &mut self,
        domain: &D,
        likeliest: Judged<'w>,
        choice: Choice,
        explained: &mut Explained,
        context: Context<'_>,
    ) -> Result<Judged<'w>, AgentError> {
        let Judged { hypothesis, words, probability, .. } = likeliest;
        if matches!(choice, Choice::AllNamed | Choice::OtherKind) && matches!(hypothesis, Hypothesis::Talk(Class::Again) | Hypothesis::All)
        {
            return Ok(likeliest);
        }
        if hypothesis == Hypothesis::Talk(Class::Again)
            && let Some(task) = self.again(words, context.earlier.before, explained)
        {
            explained.keep_only(task);
            // No word of the utterance is learned for it.
            let again = Judged::likely(Hypothesis::Again, Words::NONE, probability, probability);
            return Ok(Judged { task, tasks: TaskSet::of(task), ..again });
        }
        let judged = match hypothesis {
            Hypothesis::Negated => self.judge_negated(domain, likeliest, choice, explained, context)?,
            Hypothesis::All => match all(words) {
                Some(rest) => Some(self.judge_all(domain, likeliest, rest, explained, context)?),
                None => None,
            },
            _ => None,
        };
        Ok(judged.unwrap_or_else(|| self.judge_command(likeliest, choice, explained)))
    }

    /// The state that words forbid, or the one to keep if they negate twice.
    fn judge_negated<'w, D: Domain>(
        &mut self,
        domain: &D,
        likeliest: Judged<'w>,
        choice: Choice,
        explained: &mut Explained,
        context: Context<'_>,
    ) -> Result<Option<Judged<'w>>, AgentError> {
        let Judged { words, probability, .. } = likeliest;
        let Some(rest) = negated(words) else { return Ok(None) };
        self.explain_all(domain, rest.words, rest.view, context, explained)?;
        // "The chairs out of the red room".
        let is_of_several = choice == Choice::Likeliest && words.any(&|word| word.is_plural || word.is(Class::All));
        let all = if is_of_several { self.all_that_fit(domain, explained) } else { (TaskSet::EMPTY, 0.0) };
        let Some((task, of_task)) = explained.chosen(self.among(choice, explained)) else { return Ok(Some(likeliest)) };
        // "Don't leave the red room" asks for a goal that holds, "don't leave the bag in the red room" does not.
        let is_of_thing = self.place_of_thing(domain, task).is_some();
        let holds = rest.is_double && !(is_of_thing && words.any(&|word| word.leaves));
        // A task of two facts has no opposite.
        let has_opposite =
            self.lifted.get(usize::from(self.task(task).lifted)).is_some_and(|lifted| self.task(task).negated(lifted).is_some());
        let is_possible = if holds { self.done(domain).contains(task) } else { has_opposite };
        let (tasks, of_tasks) = if all.0.contains(task) { all } else { (TaskSet::of(task), of_task) };
        Ok(Some(Judged {
            words: rest.words,
            task,
            tasks,
            probability: probability * of_tasks,
            command: probability,
            is_negated: !holds,
            doubts: Doubts::of(&[
                (Doubt::Cues, !rest.is_clear),
                (Doubt::Impossible, !is_possible),
                (Doubt::Unfitting, !explained.fitting.contains(task)),
                (Doubt::Outweighed, choice == Choice::AllNamed),
                (Doubt::OtherKind, choice == Choice::OtherKind),
                (Doubt::TwoThings, !explained.of_one.contains(task)),
            ]),
            ..likeliest
        }))
    }

    /// The tasks about all things of a kind.
    pub(super) fn judge_all<'w, D: Domain>(
        &mut self,
        domain: &D,
        likeliest: Judged<'w>,
        rest: WithoutCues<'w>,
        explained: &mut Explained,
        context: Context<'_>,
    ) -> Result<Judged<'w>, AgentError> {
        let probability = likeliest.probability;
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
        Ok(Judged {
            words: explained.naming(rest.words),
            task: tasks.iter().next().unwrap_or(explained.best().0),
            tasks,
            probability: probability * of_place,
            command: probability,
            doubts: Doubts::of(&[(Doubt::Cues, !rest.is_clear), (Doubt::NoTasks, tasks.is_empty())]),
            ..likeliest
        })
    }

    /// The task of a plain command, and any objections to it.
    pub(super) fn judge_command<'w>(&self, likeliest: Judged<'w>, choice: Choice, explained: &Explained) -> Judged<'w> {
        let Judged { words, command, .. } = likeliest;
        let Some((task, of_command)) = explained.chosen(self.among(choice, explained)) else { return likeliest };
        let doubts = Doubts::of(&[
            (Doubt::Foreign, !explained.own.contains(task)),
            // A word that names nothing known may be the name of something else.
            (Doubt::NewName, !explained.whole.contains(task) && has_new_name(words)),
            (Doubt::Outweighed, matches!(choice, Choice::AllNamed | Choice::Plain)),
            (Doubt::OtherKind, choice == Choice::OtherKind),
            (Doubt::TwoThings, !explained.of_one.contains(task)),
        ]);
        Judged { words: explained.naming(words), task, tasks: TaskSet::of(task), probability: command * of_command, doubts, ..likeliest }
    }

    /// The tasks among which one is chosen; `None` for all.
    fn among(&self, choice: Choice, explained: &Explained) -> Option<TaskSet> {
        match choice {
            Choice::Likeliest | Choice::Plain => None,
            Choice::AllNamed => Some(explained.fitting),
            Choice::OtherKind => {
                let (best, _) = explained.best();
                // Whether the same thing is to be switched on or off, act words tell.
                let is_other = |&task: &usize| self.task(task).lifted != self.task(best).lifted && self.thing(task) != self.thing(best);
                Some((0..self.task_count).filter(is_other).collect())
            }
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
        // "Back to the red room again" is more than "again".
        let asks = words.has(Class::Again) && !words.any(&|word| word.is_name || word.is_any(&[Class::Back, Class::Undo]));
        let task = self.tasks().iter().position(|task| (task.lifted, task.bindings) == (last.lifted, last.bindings))?;
        (asks && (!explained.acts || explained.acted.contains(task))).then_some(task)
    }
}
