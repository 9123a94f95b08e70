//! Conversations: what "it", "there" and "back" refer to, from one session to the next.
//!
//! A task is remembered when its session is learned from, when the robot has done it although nothing is learned, and when it was done
//! already. A conversation belongs to one home. It begins again when things are moved from outside.

use super::{Lesson, LiveError};
use crate::conversing::Conversing;
use crate::place::Place;

/// The conversation under way, and the named ones that can be continued.
#[derive(Clone, Debug, Default)]
pub(super) struct Conversations {
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
    pub(super) fn end_conversations(&mut self) {
        self.conversations = Conversations::default();
    }

    /// Remembers a task that was followed or mentioned in a session that began in the state `start`.
    pub(super) fn remember(&mut self, task: usize, start: &D::State) {
        let Some(task) = self.agent.tasks().get(task).copied() else { return };
        let facts = self.conversations.now.facts;
        self.conversations.now.facts = facts.after(self.home(), self.agent.lifted(), start, &task);
    }

    /// Remembers the task of the session under way.
    pub(super) fn remember_session(&mut self) {
        let start = self.session().map(|(walk, _)| walk.start);
        if let Some((task, start)) = self.agent.most_likely().zip(start) {
            self.remember(task, &start);
        }
    }

    /// Remembers the task of the session under way if the robot has done it.
    pub(super) fn remember_if_done(&mut self) {
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
