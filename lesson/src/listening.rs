//! When a robot that is taught expects new words, how it hears a recorded utterance, and a conversation as a log records it.

use crate::walk::Listening;
use goodbot::memory::AgentMemory;
use goodbot::oomdp::{Domain, ObjectId};
use goodbot::talk::{ClosedWords, Conversation, Fact, Listened};
use goodbot::task::{GroundedTask, LiftedTask, TaskText};
use goodbot::{Agent, AgentError};
use goodbot_formats::quoted;
use std::collections::BTreeMap;

/// The share of new words in commands from which on a trainer's words are tried, even if the robot takes them for nothing that it can do.
const MANY_NEW: f32 = 0.1;

/// Whether the next command may well have words that no lesson had, by the words that the lessons have once (the Good-Turing estimate).
/// What the robot takes for nothing is then more probably a command in new words. To try it costs a punishment, and teaches them.
pub fn expects_new_words(agent: &Agent<impl AgentMemory>) -> bool {
    let bitext = agent.language().bitext();
    let mut times: BTreeMap<usize, u32> = BTreeMap::new();
    (0..bitext.sessions() as u16)
        .flat_map(|session| bitext.sentence(session))
        .for_each(|word| *times.entry(word.index()).or_default() += 1);
    let (once, all) = (times.values().filter(|&&times| times == 1).count(), times.values().sum::<u32>());
    (once as f32 + 2.0) / (all as f32 + 2.0) >= MANY_NEW
}

/// Begins a session with a recorded utterance.
///
/// # Errors
/// The errors of [`Agent::listen`] and [`Agent::listen_after`].
pub fn listen<D: Domain>(
    agent: &mut Agent<impl AgentMemory>,
    home: &D,
    start: &D::State,
    listening: &Listening,
    closed: ClosedWords<'_>,
) -> Result<Listened, AgentError> {
    agent.resume(listening.conversation.facts);
    let listened = match listening.after {
        None => agent.listen(home, start, &listening.utterance, closed)?,
        kind => agent.listen_after(home, start, &listening.utterance, closed, kind)?,
    };
    agent.leave_out_done(home, &listened)?;
    Ok(listened)
}

/// A conversation, by its name.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Conversing {
    /// Its name, where it has one.
    pub id: Option<String>,
    /// The last task, and the objects that later words can refer to.
    pub facts: Conversation,
}

/// The names of fields in a record.
const ID: &str = "id";
const LAST: &str = "last";

/// The facts that a record keeps. The other object of the same kind is left out: it follows from the object itself.
fn kept() -> impl Iterator<Item = Fact> {
    Fact::ALL.into_iter().filter(|fact| *fact != Fact::OtherOfItsKind)
}

impl Conversing {
    /// The conversation as a record in a log; `None` if there is nothing to record.
    pub fn recorded<D: Domain>(&self, domain: &D, lifted: &[LiftedTask]) -> Option<Vec<(String, String)>> {
        let mut record = Vec::new();
        record.extend(self.id.clone().map(|id| (ID.to_owned(), id)));
        if let Some(last) = self.facts.last() {
            let kind = lifted.get(usize::from(last.lifted))?;
            record.push((LAST.to_owned(), TaskText::new(last, kind, domain.world()).to_string()));
        }
        let name = |object: ObjectId| domain.world().objects.name(object).to_owned();
        record.extend(kept().filter_map(|fact| Some((fact.name().to_owned(), name(self.facts.object(fact)?)))));
        Some(record).filter(|record| !record.is_empty())
    }

    /// Reads the record of a log. `task` finds a task by its name.
    ///
    /// # Errors
    /// The name of the field at fault, and the fault.
    pub fn read<'r, D: Domain>(
        domain: &D,
        record: &'r [(String, String)],
        task: impl Fn(&str) -> Option<GroundedTask>,
    ) -> Result<Self, (&'r str, String)> {
        let (mut id, mut last, mut objects) = (None, None, Vec::new());
        for (name, text) in record {
            let wrong = |message: String| (name.as_str(), message);
            if name == ID {
                id = Some(text.clone());
            } else if name == LAST {
                last = Some(
                    task(text)
                        .ok_or_else(|| wrong(format!("{} is no task of the kinds that commands may mean; correct it", quoted(text))))?,
                );
            } else if let Some(fact) = kept().find(|fact| fact.name() == name) {
                let found = domain.world().objects.find(text);
                objects
                    .push((fact, found.ok_or_else(|| wrong(format!("there is no object {}; name one of the environment", quoted(text))))?));
            } else {
                let known: Vec<&str> = kept().map(Fact::name).collect();
                return Err(wrong(format!("is nothing that a conversation remembers; known are id, last, {}", known.join(", "))));
            }
        }
        if let (None, Some((fact, _))) = (last, objects.first()) {
            return Err((fact.name(), "needs the task that was followed last; write \"last\" too".to_owned()));
        }
        let object = |fact| objects.iter().find(|(known, _)| *known == fact).map(|&(_, object)| object);
        let facts = if last.is_some() { Conversation::recorded(domain, last, object) } else { Conversation::NEW };
        Ok(Self { id, facts })
    }
}
