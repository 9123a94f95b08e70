//! Conversations: what "it", "there" and "back" refer to, from one session to the next.
//!
//! A task is remembered when its session is learned from, when the robot has done it although nothing is learned, and when it was done
//! already. A conversation belongs to one home. It begins anew when things are moved from outside.

use crate::live::{Lesson, LiveError};
use crate::place::Place;
use goodbot::oomdp::{Domain, ObjectId};
use goodbot::talk::{Conversation, Fact};
use goodbot::task::{GroundedTask, LiftedTask, TaskText};
use goodbot_formats::quoted;

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
    pub fn recorded<D: Domain + ?Sized>(&self, domain: &D, lifted: &[LiftedTask]) -> Option<Vec<(String, String)>> {
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
    pub fn read<'r, D: Domain + ?Sized>(
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

/// The conversation under way, and the named ones that can be continued.
#[derive(Clone, Debug, Default)]
pub(crate) struct Conversations {
    pub now: Conversing,
    others: Vec<Conversing>,
}

impl Conversations {
    /// Puts the conversation under way aside, if it has a name.
    fn put_aside(&mut self) {
        let now = std::mem::take(&mut self.now);
        self.others.extend(Some(now).filter(|now| now.id.is_some()));
    }
}

impl<D: Place> Lesson<D> {
    /// The conversation under way.
    pub const fn conversation(&self) -> &Conversing {
        &self.conversations.now
    }

    /// The names of all conversations in this home.
    pub fn conversations(&self) -> impl Iterator<Item = &str> {
        let Conversations { now, others } = &self.conversations;
        others.iter().chain([now]).filter_map(|known| known.id.as_deref())
    }

    /// Names the conversation under way, if it has no name yet.
    pub fn name_conversation(&mut self, id: &str) {
        self.conversations.now.id.get_or_insert_with(|| id.to_owned());
    }

    /// Begins a new conversation. The robot stays where it is, and forgets what was said. The session under way is forgotten.
    pub fn converse_anew(&mut self) {
        self.forget();
        self.declined = None;
        self.conversations.put_aside();
    }

    /// Continues another conversation in this home, by its name. The session under way is forgotten.
    ///
    /// # Errors
    /// [`LiveError::NoConversation`] if none has this name. Nothing has changed then.
    pub fn converse(&mut self, id: &str) -> Result<(), LiveError> {
        let is_named = |known: &Conversing| known.id.as_deref() == Some(id);
        let position = self.conversations.others.iter().position(is_named);
        if position.is_none() && !is_named(&self.conversations.now) {
            let known = self.conversations().map(str::to_owned).collect();
            return Err(LiveError::NoConversation { id: id.to_owned(), known });
        }
        self.forget();
        self.declined = None;
        if let Some(position) = position {
            let other = self.conversations.others.remove(position);
            self.conversations.put_aside();
            self.conversations.now = other;
        }
        Ok(())
    }

    /// Ends all conversations: things were moved from outside, or this is another home.
    pub(crate) fn end_conversations(&mut self) {
        self.conversations = Conversations::default();
    }

    /// Remembers a task that was followed or mentioned in a session that began in the state `start`.
    pub(crate) fn remember(&mut self, task: usize, start: &D::State) {
        let Some(task) = self.agent.tasks().get(task).copied() else { return };
        let facts = self.conversations.now.facts;
        self.conversations.now.facts = facts.after(self.home(), self.agent.lifted(), start, &task);
    }

    /// Remembers the task of the session under way.
    pub(crate) fn remember_session(&mut self) {
        let start = self.session().map(|(walk, _)| walk.start);
        if let Some((task, start)) = self.agent.most_likely().zip(start) {
            self.remember(task, &start);
        }
    }

    /// Remembers the task of the session under way if the robot has done it.
    pub(crate) fn remember_if_done(&mut self) {
        let task = self.agent.most_likely().and_then(|task| self.agent.tasks().get(task));
        let is_done = task.is_some_and(|task| {
            let kind = self.agent.lifted().get(usize::from(task.lifted));
            kind.is_some_and(|kind| task.is_reached(kind, |part| self.home().holds(part, self.state())))
        });
        if is_done {
            self.remember_session();
        }
    }
}
