//! A robot's readings of sentences, and which of them are right.

use super::fit::Example;
use super::sets::{Meaning, Sentence, Set};
use goodbot::home::{Home, HomeState, Moves, paper_tasks};
use goodbot::memory::{AgentHeap, HomeHeap};
use goodbot::oomdp::Domain;
use goodbot::talk::{Hypothesis, Listened, Reading, Spoken, Verdict};
use goodbot::task::{GroundedTask, TaskSet};
use goodbot::{Agent, AgentError};
use goodbot_console::load::input::{self, InputFile};
use goodbot_console::outcome::Failure;
use goodbot_console::restored;
use goodbot_lesson::closed_words::CLOSED_WORDS;
use goodbot_lesson::home;
use goodbot_lesson::name::task_name;
use std::cell::RefCell;

/// Words as features: their hashes, and what they are.
pub type Words = Vec<(u32, String)>;

/// A sentence as a robot reads it.
#[derive(Clone, Debug)]
pub struct Said {
    /// Who wrote it.
    pub author: String,
    /// Its language.
    pub language: String,
    /// Its kind.
    pub kind: String,
    /// Its words.
    pub words: Words,
    /// Whether something is to be done.
    pub is_meant: bool,
    /// Its readings.
    pub readings: Vec<Read>,
    /// What follows the first of several commands, heard where the first led to; `None` if no reading has the first rightly.
    pub rest: Option<Box<Said>>,
    /// What the robot did, if it was to act and did not wait.
    pub did: Option<Did>,
}

/// What a robot did.
#[derive(Clone, Copy, Debug)]
pub struct Did {
    /// Whether it is what was meant.
    pub is_right: bool,
    /// Whether it was so already.
    pub is_done: bool,
}

/// A reading.
#[derive(Clone, Debug)]
pub struct Read {
    /// Its clues.
    pub clues: Vec<u16>,
    /// Their values.
    pub values: Vec<f32>,
    /// The words between two commands, or in a repair.
    pub between: Words,
    /// The tasks that it asks for, and whether others follow.
    pub asked: (Vec<String>, bool),
    /// Where the others begin.
    pub rest: Option<usize>,
    /// Its kind for words, from 1.
    pub kind: usize,
    /// The distance from each clue to that for its kind of reading alone.
    pub to_kind: u16,
    /// Whether it is what was meant.
    pub is_right: bool,
    /// Whether it asks for what is so already.
    pub is_done: bool,
}

impl Said {
    /// All its words, and those between names.
    pub fn features(&self) -> impl Iterator<Item = &(u32, String)> {
        self.commands().flat_map(|said| said.words.iter().chain(said.readings.iter().flat_map(|reading| &reading.between)))
    }

    /// The readings of each of its commands: its own, then those of the rest.
    pub fn commands(&self) -> impl Iterator<Item = &Said> {
        std::iter::successors(Some(self), |said| said.rest.as_deref())
    }

    /// Its readings as examples to learn from.
    pub fn examples(&self) -> impl Iterator<Item = Example<'_>> {
        self.readings.iter().map(|&Read { ref clues, ref values, ref between, kind, to_kind, is_right, .. }| Example {
            clues,
            values,
            words: &self.words,
            between,
            kind,
            to_kind,
            holds: is_right,
        })
    }
}

/// A reading before it is compared with the meaning.
struct Weighed {
    between: Words,
    clues: Vec<u16>,
    values: Vec<f32>,
    kind: usize,
    to_kind: u16,
    hypothesis: Hypothesis,
    tasks: TaskSet,
    is_negated: bool,
    rest: Option<usize>,
}

/// Reads the sentences of a set; if asked, the robot acts on them, too.
///
/// # Errors
/// The faults of its files.
pub fn of(set: &Set, acts: bool) -> Result<Vec<Said>, Failure> {
    let flaw = |message: String| Failure::Input(format!("{}: {message}", set.home.display()));
    let environment = input::home(&InputFile::from(set.home.clone().into_os_string()))?;
    let lifted = paper_tasks().map_err(|error| flaw(error.to_string()))?;
    let mut memory = home::memory();
    let (home, start) = home::build(&environment, Moves::Push, &mut memory).map_err(|fault| flaw(fault.message(&environment)))?;
    let mut agent = restored::agent_beside(&set.model, &lifted, &Default::default())?;
    let mut said = Vec::new();
    for sentence in &set.sentences {
        let read = heard(&mut agent, &home, &start, (set, sentence), acts);
        said.push(read.map_err(|error| flaw(format!("{:?}: {error}", sentence.words)))?);
    }
    Ok(said)
}

fn heard(
    agent: &mut Agent<AgentHeap>,
    home: &Home<&mut HomeHeap>,
    start: &HomeState,
    (set, sentence): (&Set, &Sentence),
    acts: bool,
) -> Result<Said, AgentError> {
    agent.resume(goodbot::talk::Conversation::NEW);
    let mut state = *start;
    if let Some(before) = &sentence.before {
        let listened = agent.listen(home, &state, before, CLOSED_WORDS)?;
        if let Some(task) = agent.tasks().get(listened.task).copied() {
            agent.remember(home, &state, &task);
            state = followed(agent, home, &state, &task);
        }
    }
    let (read, listened) = readings(agent, home, &state, (set, sentence), false)?;
    let rest = rest(agent, home, &state, (set, sentence), &read, &listened)?;
    if !acts {
        return Ok(Said { rest, ..read });
    }
    // The rest was heard in between.
    let listened = agent.listen(home, &state, &sentence.words, CLOSED_WORDS)?;
    let did = did(agent, home, state, sentence, listened)?;
    Ok(Said { rest, did, ..read })
}

/// What follows the first of several commands.
fn rest(
    agent: &mut Agent<AgentHeap>,
    home: &Home<&mut HomeHeap>,
    state: &HomeState,
    (set, sentence): (&Set, &Sentence),
    said: &Said,
    listened: &Listened,
) -> Result<Option<Box<Said>>, AgentError> {
    let right = said.readings.iter().find_map(|reading| reading.rest.filter(|_| reading.is_right).map(|at| (at, reading)));
    let Some((at, reading)) = right else { return Ok(None) };
    let is_negated = agent.tasks().get(listened.task).is_some_and(GroundedTask::is_negated);
    let names = agent.tasks().iter().map(|task| name(agent, home, task, is_negated));
    let tasks: TaskSet = names.enumerate().filter(|(_, name)| reading.asked.0.contains(name)).map(|(at, _)| at).collect();
    if tasks.is_empty() || agent.answered(tasks, true, 1e-6, 1).is_err() {
        return Ok(None);
    }
    let so = so(agent, home, state);
    let followed = tasks.iter().filter_map(|task| agent.tasks().get(task).copied());
    let state = followed.collect::<Vec<_>>().iter().fold(*state, |state, task| self::followed(agent, home, &state, task));
    let left = |meaning: &Meaning| {
        let tasks = meaning.tasks.iter().filter(|task| !reading.asked.0.contains(task)).cloned().collect();
        Meaning { tasks, ..meaning.clone() }
    };
    let is_begun = |meaning: &&Meaning| is_meant(&reading.asked.0, Hypothesis::Several, meaning, &so);
    let meanings = sentence.meanings.iter().filter(is_begun).map(left).collect();
    let words = sentence.words.get(at..).unwrap_or_default().to_owned();
    let sentence = Sentence { kind: sentence.kind.clone(), words, before: None, meanings };
    // "A, and B but first C" is the same rest again.
    let is_shorter = at > 0;
    let (said, listened) = readings(agent, home, &state, (set, &sentence), true)?;
    let rest = if is_shorter { rest(agent, home, &state, (set, &sentence), &said, &listened)? } else { None };
    Ok(Some(Box::new(Said { rest, ..said })))
}

/// A robot's readings of a sentence, and what it takes it for.
fn readings(
    agent: &mut Agent<AgentHeap>,
    home: &Home<&mut HomeHeap>,
    state: &HomeState,
    (set, sentence): (&Set, &Sentence),
    is_rest: bool,
) -> Result<(Said, Listened), AgentError> {
    let (weighed, words) = (RefCell::new(Vec::new()), RefCell::new(Vec::new()));
    let observe = |reading: &Reading<'_>| {
        let (mut clues, mut values) = (Vec::new(), Vec::new());
        reading.clues.for_each(&mut |clue, value| {
            clues.push(clue);
            values.push(value);
        });
        if words.borrow().is_empty() {
            *words.borrow_mut() = features(reading.clues.spoken());
        }
        let &Reading { hypothesis, tasks, is_negated, rest, .. } = reading;
        let (kind, to_kind) = (reading.clues.kind_of_words(), reading.clues.to_kind());
        let between = reading.clues.between().map(features).unwrap_or_default();
        weighed.borrow_mut().push(Weighed { between, clues, values, kind, to_kind, hypothesis, tasks, is_negated, rest });
    };
    let listened = agent.listen_and_show(home, state, &sentence.words, CLOSED_WORDS, is_rest, (&|| true, Some(&observe)))?;
    let so = so(agent, home, state);
    let read = |weighed: Weighed| {
        let (asked, is_done) = asked(agent, home, state, weighed.tasks, weighed.is_negated);
        let is_right = sentence.meanings.iter().any(|meaning| is_meant(&asked, weighed.hypothesis, meaning, &so));
        let Weighed { between, clues, values, kind, to_kind, rest, .. } = weighed;
        Read { asked: (asked, rest.is_some()), rest, between, clues, values, kind, to_kind, is_right, is_done }
    };
    let mut readings: Vec<Read> = weighed.into_inner().into_iter().map(read).collect();
    // Where either order is right, people mean the one in which they spoke: the other begins with the rest.
    if readings.iter().any(|reading| reading.is_right && reading.rest.is_some_and(|at| at > 0)) {
        readings.iter_mut().for_each(|reading| reading.is_right &= reading.rest != Some(0));
    }
    let (author, language, kind) = (set.author.clone(), set.language.clone(), sentence.kind.clone());
    let (words, is_meant) = (words.into_inner(), !sentence.meanings.is_empty());
    Ok((Said { author, language, kind, words, is_meant, readings, rest: None, did: None }, listened))
}

/// The words as features.
fn features(spoken: &Spoken<'_>) -> Words {
    let mut words = Words::new();
    spoken.for_each(&mut |hash, texts| {
        if words.iter().all(|(other, _)| *other != hash) {
            words.push((hash, texts.join(" ").trim().to_string()));
        }
    });
    words
}

/// What the robot does of a sentence, one command after the other; `None` if it waits at the first or at a later one.
fn did(
    agent: &mut Agent<AgentHeap>,
    home: &Home<&mut HomeHeap>,
    mut state: HomeState,
    sentence: &Sentence,
    mut listened: Listened,
) -> Result<Option<Did>, AgentError> {
    let so = so(agent, home, &state);
    let (mut all, mut did) = (Vec::new(), Did { is_right: false, is_done: true });
    let mut rest = sentence.words.as_str();
    loop {
        if !matches!(listened.verdict, Verdict::Sure | Verdict::Done) {
            return Ok(None);
        }
        let is_negated = agent.tasks().get(listened.task).is_some_and(GroundedTask::is_negated);
        let (asked, is_done) = asked(agent, home, &state, listened.tasks, is_negated);
        all.extend(asked);
        did.is_done &= is_done;
        let Some(after) = listened.rest.and_then(|at| rest.get(at..)) else { break };
        if let Some(task) = agent.tasks().get(listened.task).copied() {
            state = followed(agent, home, &state, &task);
        }
        rest = after;
        listened = agent.listen_on(home, &state, rest, CLOSED_WORDS)?;
    }
    let in_order = |meaning: &&Meaning| !meaning.is_ordered || meaning.tasks == all || meaning.left(&so).tasks == all;
    did.is_right = sentence.meanings.iter().filter(in_order).any(|meaning| is_meant(&all, Hypothesis::Command, meaning, &so));
    Ok(Some(did))
}

/// The names of tasks that are asked for, without those that are so already unless all are, and whether all are.
fn asked(agent: &Agent<AgentHeap>, home: &Home<&mut HomeHeap>, state: &HomeState, tasks: TaskSet, is_negated: bool) -> (Vec<String>, bool) {
    let holds = |task: &GroundedTask| kind(agent, task).is_some_and(|kind| task.propositions(kind).all(|part| home.holds(&part, state)));
    let tasks: Vec<GroundedTask> = tasks.iter().filter_map(|task| agent.tasks().get(task).copied()).collect();
    // What is so already need not be done.
    let is_so = |task: &&GroundedTask| holds(task) != is_negated;
    let is_done = tasks.iter().all(|task| is_so(&task));
    (tasks.iter().filter(|task| is_done || !is_so(task)).map(|task| name(agent, home, task, is_negated)).collect(), is_done)
}

fn kind<'a>(agent: &'a Agent<AgentHeap>, task: &GroundedTask) -> Option<&'a goodbot::task::LiftedTask> {
    agent.lifted().get(usize::from(task.lifted))
}

/// The name of a task, with a mark if it is forbidden. A session about a prohibition has the marked tasks.
fn name(agent: &Agent<AgentHeap>, home: &Home<&mut HomeHeap>, task: &GroundedTask, is_negated: bool) -> String {
    let name = kind(agent, task).and_then(|kind| task_name(home, kind, task).ok()).map(|name| name.to_string()).unwrap_or_default();
    format!("{}{}", if is_negated { "!" } else { "" }, name.trim_start_matches('!'))
}

/// The names of the tasks that are so already.
fn so(agent: &Agent<AgentHeap>, home: &Home<&mut HomeHeap>, state: &HomeState) -> Vec<String> {
    let holds = |task: &&GroundedTask| kind(agent, task).is_some_and(|kind| task.propositions(kind).all(|part| home.holds(&part, state)));
    agent.tasks().iter().filter(holds).map(|task| name(agent, home, task, false)).collect()
}

/// Whether tasks are a meaning, or what is left to do of it; of several commands, the first of one.
fn is_meant(tasks: &[String], hypothesis: Hypothesis, meaning: &Meaning, so: &[String]) -> bool {
    [meaning, &meaning.left(so)].into_iter().any(|meaning| is_whole(tasks, hypothesis, meaning))
}

fn is_whole(tasks: &[String], hypothesis: Hypothesis, meaning: &Meaning) -> bool {
    if tasks.is_empty() {
        return false;
    }
    if hypothesis == Hypothesis::Several {
        let begins =
            if meaning.is_ordered { meaning.tasks.starts_with(tasks) } else { tasks.iter().all(|task| meaning.tasks.contains(task)) };
        return meaning.tasks.len() > tasks.len() && begins;
    }
    let sorted = |tasks: &[String]| {
        let mut tasks = tasks.to_vec();
        tasks.sort_unstable();
        tasks
    };
    sorted(tasks) == sorted(&meaning.tasks)
}

/// The state in which a task is done, if there is one.
fn followed(agent: &Agent<AgentHeap>, home: &Home<&mut HomeHeap>, state: &HomeState, task: &GroundedTask) -> HomeState {
    let Some(kind) = kind(agent, task) else { return *state };
    let things =
        task.bindings.iter().take(kind.variables().len()).filter(|&&object| object == home.agent() || home.blocks().contains(&object));
    let mut states = things.flat_map(|&thing| home.places().iter().filter_map(move |place| home.placed(state, &[(thing, place.cell())])));
    states.find(|state| task.propositions(kind).all(|part| home.holds(&part, state))).unwrap_or(*state)
}
