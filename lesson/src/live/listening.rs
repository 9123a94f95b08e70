//! The utterances of a person, and how they begin sessions.
//!
//! [`Lesson::listen`] begins a session if there is something to do: a command, a prohibition, the first of several commands, or the first
//! of all things of a kind. After that session, [`Lesson::listen_on`] begins the next one, as long as [`Lesson::is_more`] says that there
//! is one. Each part is a session of its own, with feedback of its own. [`Lesson::forget`] stops between parts.
//!
//! Conversations say what "it", "there" and "back" refer to, from one session to the next. A task is remembered when its session is learned
//! from, when the robot has done it although nothing is learned, and when it was done already. A conversation belongs to one home. It begins
//! again when things are moved from outside.

use super::{Lesson, LiveError, Session};
use crate::listening::{Conversing, expects_new_words, listen};
use crate::place::Place;
use crate::replay::expect_ends;
use crate::walk::Listening;
use goodbot::language::first_words;
use goodbot::talk::{Class, ClosedWords, Hypothesis, Listened, Verdict};
use goodbot::task::{GroundedTask, TaskSet};

/// The rest of an utterance.
#[derive(Clone, Debug)]
pub(super) struct Ahead {
    listening: Listening,
    after: Option<GroundedTask>,
    /// How many tasks were left, if the same words are heard again for the next of all things.
    left: Option<usize>,
    /// Whether the robot tries it although it is not sure.
    insists: bool,
}

/// Whether the robot begins a session for this utterance. `insists` says that it was said once before.
fn is_followed(listened: &Listened, is_negated: bool, insists: bool) -> bool {
    let is_sure = listened.verdict == Verdict::Sure;
    match listened.hypothesis {
        _ if listened.verdict == Verdict::Done => false,
        // Doing the opposite of a prohibition is worse than waiting.
        _ if is_negated => is_sure,
        // A name that no lesson had is perhaps to be learned.
        Hypothesis::Command | Hypothesis::Absent | Hypothesis::About => true,
        Hypothesis::Several => is_sure || insists,
        Hypothesis::Again => is_sure,
        Hypothesis::All => is_sure || insists && !listened.tasks.is_empty(),
        _ => false,
    }
}

/// The words before the rest of an utterance, without the connective.
fn part<'u>(utterance: &'u str, rest: Option<usize>, closed: ClosedWords<'_>) -> &'u str {
    // After "before ..., ..." the rest is the whole utterance once more, and so is the command.
    let Some(mut part) = rest.filter(|&rest| rest > 0).and_then(|rest| utterance.get(..rest)) else {
        return first_words(utterance.trim()).trim_end();
    };
    loop {
        part = part.trim_end_matches(|letter: char| !letter.is_alphanumeric());
        let last = part.rsplit(char::is_whitespace).next().unwrap_or_default();
        // Letter by letter, as the table's words were made lower case.
        let word: String = last.chars().flat_map(char::to_lowercase).collect();
        match part.strip_suffix(last) {
            Some(before) if !before.is_empty() && closed.of(&word).contains(Class::Connective) => part = before,
            _ => return part,
        }
    }
}

impl<D: Place> Lesson<D> {
    /// Listens to an utterance, and begins a session if there is something to do. `insists` says that the same was said before: the robot
    /// then tries it although it is not sure. `environment` is the place as it is now, for the record. The session under way and the rest
    /// of its utterance are forgotten.
    ///
    /// # Errors
    /// The errors of [`Agent::listen`](goodbot::Agent::listen).
    pub fn listen(&mut self, utterance: &str, environment: D::Record, insists: bool) -> Result<Listened, LiveError> {
        self.forget();
        let listening = self.listening_to(utterance.trim(), None);
        self.begin_part(Ahead { listening, after: None, left: None, insists }, environment)
    }

    /// Tells the robot something: it [listens](Self::listen). The words count as a command if the robot found nothing to do although it
    /// [expects new words](expects_new_words), or although the same was said before. A prohibition, and what is done already, stays what it
    /// is. The verdict is that of listening in any case.
    ///
    /// # Errors
    /// The errors of [`Agent::listen`](goodbot::Agent::listen) and [`Agent::hear`](goodbot::Agent::hear).
    pub fn tell(&mut self, words: &str, environment: D::Record) -> Result<Listened, LiveError> {
        let is_again = self.declined.take().is_some_and(|declined| declined == words);
        let mut listened = self.listen(words, environment.clone(), is_again)?;
        let may_be_new = matches!(listened.hypothesis, Hypothesis::Nothing | Hypothesis::Several | Hypothesis::All);
        let is_command = is_again || may_be_new && listened.verdict != Verdict::Done && expects_new_words(&self.agent);
        if self.is_under_way() || !is_command || self.is_prohibition() {
            self.declined = (!self.is_under_way()).then(|| words.to_owned());
            return Ok(listened);
        }
        self.hear(first_words(words).trim_end(), environment)?;
        (listened.task, listened.rest) = (self.agent.most_likely().unwrap_or(0), None);
        listened.tasks = TaskSet::of(listened.task);
        Ok(listened)
    }

    /// Begins a recorded session again. The log gives `listening` and the task of the command before.
    ///
    /// # Errors
    /// As [`listen`](Self::listen).
    pub fn listen_as(&mut self, listening: Listening, after: Option<GroundedTask>, environment: D::Record) -> Result<Listened, LiveError> {
        self.forget();
        self.conversations.now = listening.conversation.clone();
        self.begin_part(Ahead { listening, after, left: None, insists: true }, environment)
    }

    /// Whether the session, or the last one, is about a prohibition.
    pub fn is_prohibition(&self) -> bool {
        self.agent.tasks().iter().any(GroundedTask::is_negated)
    }

    /// Whether the utterance has more parts.
    pub const fn is_more(&self) -> bool {
        self.ahead.is_some()
    }

    /// Whether the session under way has something to learn from. A prohibition and "again" have no words for their tasks.
    pub fn teaches(&self) -> bool {
        self.is_under_way() && !self.agent.sentence().is_empty() && !self.is_prohibition()
    }

    /// The part of the utterance that is still to come.
    pub fn rest(&self) -> Option<&str> {
        self.ahead.as_ref().map(|ahead| ahead.listening.utterance.as_str())
    }

    /// Begins a session with the next part of the utterance, where the robot is now; `None` if there is none. The session before must be
    /// over.
    ///
    /// # Errors
    /// The errors of [`Agent::listen_after`](goodbot::Agent::listen_after).
    pub fn listen_on(&mut self, environment: D::Record) -> Result<Option<Listened>, LiveError> {
        let Some(mut ahead) = self.ahead.take() else { return Ok(None) };
        let left = ahead.left;
        ahead.listening.conversation = self.conversation().clone();
        let listened = self.begin_part(ahead, environment)?;
        // A robot that could not bring one thing does not try it for ever.
        if left.is_some_and(|left| listened.tasks.iter().count() >= left) {
            self.forget();
            return Ok(None);
        }
        Ok(Some(listened))
    }

    /// Begins a session with the first part that is not done yet.
    fn begin_part(&mut self, mut ahead: Ahead, environment: D::Record) -> Result<Listened, LiveError> {
        expect_ends(&mut self.agent)?;
        let listened = loop {
            let closed = self.closed;
            let (agent, home, state) = self.parts();
            let listened = listen(agent, home, state, &ahead.listening, closed)?;
            let rest = listened.rest.and_then(|rest| ahead.listening.utterance.get(rest..)).filter(|_| listened.verdict == Verdict::Done);
            if listened.verdict == Verdict::Done {
                let state = *state;
                listened.tasks.iter().for_each(|task| self.remember(task, &state));
            }
            let Some(rest) = rest else { break listened };
            let listening = self.listening_to(rest, self.followed().map(|task| task.lifted));
            (ahead.listening, ahead.after, ahead.left) = (listening, self.followed(), None);
        };
        let is_negated = self.agent.tasks().get(listened.task).is_some_and(GroundedTask::is_negated);
        if !is_followed(&listened, is_negated, ahead.insists) {
            self.agent.forget();
            return Ok(listened);
        }
        let command = part(&ahead.listening.utterance, listened.rest, self.closed).to_owned();
        let strategies = self.agent.belief().strategies().to_vec();
        let after = ahead.after;
        self.begin(command, Session { after, ..Session::new(environment, strategies) });
        self.walk.listening = Some(ahead.listening.clone());
        let rest = listened.rest.and_then(|rest| ahead.listening.utterance.get(rest..));
        self.ahead = match (listened.tasks.iter().count(), rest) {
            (left, _) if left > 1 => Some(Ahead { left: Some(left), ..ahead }),
            (_, Some(rest)) => {
                let listening = self.listening_to(rest, None);
                Some(Ahead { listening, after: None, left: None, insists: ahead.insists })
            }
            _ => None,
        };
        Ok(listened)
    }

    fn listening_to(&self, utterance: &str, after: Option<u8>) -> Listening {
        Listening { utterance: utterance.to_owned(), after, conversation: self.conversation().clone() }
    }

    /// Ends a part: the next part follows its task.
    pub(super) fn end_part(&mut self) {
        let followed = self.followed();
        if let Some(ahead) = self.ahead.as_mut().filter(|ahead| ahead.left.is_none()) {
            (ahead.listening.after, ahead.after) = (followed.map(|task| task.lifted), followed);
        }
    }

    fn followed(&self) -> Option<GroundedTask> {
        self.agent.tasks().get(self.agent.most_likely()?).copied()
    }
}

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

#[cfg(test)]
mod tests {
    use super::part;
    use crate::closed_words::CLOSED_WORDS;

    #[test]
    fn a_part_of_an_utterance_ends_before_its_connective() {
        let utterance = "Go to the red room, and then to the blue one";
        assert_eq!(part(utterance, utterance.find("to the blue"), CLOSED_WORDS), "Go to the red room");
        assert_eq!(part("and then", Some(8), CLOSED_WORDS), "and");
        assert_eq!(part(" go on ", None, CLOSED_WORDS), "go on");
    }
}
