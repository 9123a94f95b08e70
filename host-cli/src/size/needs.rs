//! From homes and lessons to capacities, and what they take.

use super::SizeOptions;
use goodbot::home::{Home, HomeState, Moves};
use goodbot::language::Model;
use goodbot::memory::{AgentHeap, HomeHeap};
use goodbot::session::Lessons;
use goodbot::snapshot::most_bytes;
use goodbot::{Agent, AgentError, Capacities};
use goodbot_capi::capacities::bytes_32;
use goodbot_console::lessons::{self, Lesson, Told, training};
use goodbot_console::load::input;
use goodbot_console::outcome::Failure;
use goodbot_console::refusal;
use goodbot_formats::environment::EnvironmentFile;
use goodbot_lesson::home;
use std::collections::BTreeSet;

/// States that a home is given at most: exact plans in larger ones cost more memory than they are worth on a controller.
const MOST_STATES: usize = Capacities::SMALL.states;
/// The deepest stack of the course, in `docs/footprint.md`, rounded up.
pub const STACK: usize = 5_632;
/// What flash is erased by is most often a power of two from here on.
const LEAST_SLOT: usize = 1_024;
/// The header of a slot, and what is written at once.
const SLOT_HEADER: usize = 256;
/// Sessions and words where nothing tells how many.
const SESSIONS: usize = 16;
const WORDS: usize = 8;

/// What a robot needs.
#[derive(Debug)]
pub struct Needs {
    /// How many different homes there are.
    pub homes: usize,
    /// What it keeps.
    pub lessons: Lessons,
    /// How large its tables are.
    pub capacities: Capacities,
    /// The states with which every plan is exact; nothing where they cannot be counted.
    pub exact_states: Option<usize>,
    /// How many sessions of the log there are to learn from.
    pub taught: usize,
    /// How many of them a robot kept that was trained in this memory.
    pub kept: Option<usize>,
}

impl Needs {
    /// Reads homes and logs.
    ///
    /// # Errors
    /// What is wrong with them.
    pub fn find(options: &SizeOptions) -> Result<Self, Failure> {
        let lifted = options.kinds.lifted()?;
        let learner = options.learner.options();
        let log =
            if options.log.is_empty() { vec![] } else { lessons::read(&options.log, &lifted, learner, false, &Told::default())?.lessons };
        let log: Vec<Lesson> = log.into_iter().filter(|lesson| lesson.learn).collect();
        if log.is_empty() && !options.log.is_empty() {
            return Err(Failure::Input("no session is to be learned from; set \"learn\" to true at the end of one".to_owned()));
        }
        if log.iter().any(|lesson| lesson.world.is_some()) {
            return Err(Failure::Input("a log of worlds has no home to make room for; name a session log".to_owned()));
        }
        let homes = homes(&options.homes, &log)?;
        let lessons = to_keep(options, &log, learner.language.model)?;
        let fault = |error: AgentError| Failure::Input(refusal::in_words(&error));
        let mut agent = Agent::new(AgentHeap::new(&Capacities::STANDARD), &lifted, learner).map_err(fault)?;
        let least = agent.least_capacities_of_all(homes.iter().map(|(home, _)| home), &lessons).map_err(fault)?;
        let exact_states = Some(least.states).filter(|&states| states > 0);
        let states = exact_states.map_or(MOST_STATES, |states| states.min(MOST_STATES));
        let capacities = Capacities { states, ..least };
        let kept = if log.is_empty() || options.sessions.is_some_and(|sessions| sessions < log.len()) {
            None
        } else {
            let mut memory = goodbot_console::learner::memory(&capacities, &learner.language, training::tasks(&log));
            let model = training::train(&mut memory, log.iter(), learner.language).map_err(fault)?;
            Some(model.bitext().sessions())
        };
        Ok(Self { homes: homes.len(), lessons, capacities, exact_states, taught: log.len(), kept })
    }

    /// Bytes of RAM on a controller with pointers of four bytes, the stack not counted.
    pub fn ram(&self) -> usize {
        bytes_32(&self.capacities, false)
    }

    /// Bytes that a model takes at most.
    pub fn model_bytes(&self) -> usize {
        most_bytes(&self.capacities)
    }

    /// Bytes of each of two slots that keep it.
    pub fn slot_bytes(&self) -> usize {
        self.model_bytes().saturating_add(SLOT_HEADER).next_multiple_of(LEAST_SLOT)
    }
}

/// The different homes of files and sessions, built.
fn homes(files: &[String], log: &[Lesson]) -> Result<Vec<(Home<HomeHeap>, HomeState)>, Failure> {
    let mut environments: Vec<(&str, EnvironmentFile)> = Vec::new();
    for file in files {
        let environment = input::home(file).map_err(|fault| Failure::Input(fault.to_string()))?;
        environments.push((input::name(file), environment));
    }
    for lesson in log {
        if environments.iter().all(|(_, known)| *known != lesson.header.environment) {
            environments.push((&lesson.id, lesson.header.environment.clone()));
        }
    }
    let build = |(source, environment): &(&str, EnvironmentFile)| {
        home::build(environment, Moves::Push, home::memory())
            .map_err(|flaw| Failure::Input(format!("{source}: field \"{}\": {}", flaw.field(), flaw.message(environment))))
    };
    environments.iter().map(build).collect()
}

/// What it is to keep: what the log has, unless more is asked for.
fn to_keep(options: &SizeOptions, log: &[Lesson], model: Model) -> Result<Lessons, Failure> {
    if log.is_empty() {
        return Ok(Lessons::new(options.sessions.unwrap_or(SESSIONS), options.words.unwrap_or(WORDS)));
    }
    let (mut different, mut most) = (BTreeSet::new(), 0);
    for lesson in log {
        let mut count = 0;
        let take = |word: &str| {
            different.insert(word.to_owned());
            count += 1;
            Ok(())
        };
        model.for_each_word(&lesson.command, take).map_err(|error| Failure::Input(format!("{}: {error}", lesson.id)))?;
        most = most.max(count);
    }
    Ok(Lessons {
        sessions: options.sessions.unwrap_or(log.len()),
        words: options.words.unwrap_or(most),
        different_words: different.len(),
        word_bytes: different.iter().map(String::len).sum(),
    })
}
