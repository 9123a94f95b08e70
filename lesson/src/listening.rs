//! What a person says to the robot, and how a session begins with it.
//!
//! [`Lesson::listen`] begins a session where there is something to do: a command, what shall not be, the first of several commands, or the
//! first of all things of a kind. When that session is over, [`Lesson::listen_on`] begins the next one, as long as [`Lesson::is_more`] says
//! that there is one. Each part is a session of its own, with feedback of its own. To stop between parts, [`Lesson::forget`].

use crate::live::{Lesson, LiveError, Session};
use crate::place::Place;
use crate::replay::expect_ends;
use crate::walk::Listening;
use goodbot::language::Model;
use goodbot::memory::AgentMemory;
use goodbot::oomdp::Domain;
use goodbot::talk::{Class, ClosedWords, ClosedWordsError, Hypothesis, Listened, Verdict};
use goodbot::task::GroundedTask;
use goodbot::{Agent, AgentError};
use std::sync::{Mutex, PoisonError};

/// The words that speak about commands.
pub const CLOSED_WORDS: ClosedWords<'static> = ClosedWords::ALL;

/// The tables that lessons and logs use beside that one: each stays as long as the program runs, and is kept once.
static TABLES: Mutex<Vec<&str>> = Mutex::new(Vec::new());

/// A table that a program uses as long as it runs.
///
/// # Errors
/// A [`ClosedWordsError`] where the text is no table.
pub fn kept_table(text: &str) -> Result<ClosedWords<'static>, ClosedWordsError<'_>> {
    ClosedWords::new(text)?;
    let mut tables = TABLES.lock().unwrap_or_else(PoisonError::into_inner);
    let known = tables.iter().find(|known| **known == text).copied();
    let kept = known.unwrap_or_else(|| {
        let kept: &'static str = Box::leak(text.into());
        tables.push(kept);
        kept
    });
    Ok(ClosedWords::new(kept).unwrap_or(ClosedWords::NONE))
}

/// With fewer lessons everything is a command: nothing is known yet of how people word what the robot can do.
pub const FEW_LESSONS: usize = 20;

/// Whether a robot can tell what is no command.
pub fn tells_talk(agent: &Agent<impl AgentMemory>) -> bool {
    agent.language().bitext().sessions() >= FEW_LESSONS && agent.options().language.model == Model::Roles
}

/// Begins a session as the record has it.
///
/// # Errors
/// What [`Agent::listen`] refuses.
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

/// The rest of an utterance.
#[derive(Clone, Debug)]
pub(crate) struct Ahead {
    listening: Listening,
    after: Option<GroundedTask>,
    /// Where it is the same words once more, for the next of all things: how many were left.
    left: Option<usize>,
    /// Whether it is tried although it is not sure.
    insists: bool,
}

/// Whether what was listened to is begun. `insists` says that it was said once before.
fn is_followed(listened: &Listened, is_negated: bool, insists: bool) -> bool {
    let is_sure = listened.verdict == Verdict::Sure;
    match listened.hypothesis {
        _ if listened.verdict == Verdict::Done => false,
        // The opposite of what is meant is worse than to wait.
        _ if is_negated => is_sure,
        // A thing that nobody has named is perhaps to be learned.
        Hypothesis::Command | Hypothesis::Absent | Hypothesis::About => true,
        Hypothesis::Several => is_sure || insists,
        Hypothesis::Again => is_sure,
        Hypothesis::All => is_sure || insists && !listened.tasks.is_empty(),
        _ => false,
    }
}

/// The words before the rest of an utterance, without the connective.
fn part<'u>(utterance: &'u str, rest: Option<usize>, closed: ClosedWords<'_>) -> &'u str {
    // What is done last may be said first: "before ..., ...".
    let Some(mut part) = rest.filter(|&rest| rest > 0).and_then(|rest| utterance.get(..rest)) else { return utterance.trim() };
    loop {
        part = part.trim_end_matches(|letter: char| !letter.is_alphanumeric());
        let last = part.rsplit(char::is_whitespace).next().unwrap_or_default();
        // Letter by letter, as the words of the table became lower case.
        let word: String = last.chars().flat_map(char::to_lowercase).collect();
        match part.strip_suffix(last) {
            Some(before) if !before.is_empty() && closed.of(&word).contains(Class::Connective) => part = before,
            _ => return part,
        }
    }
}

impl<D: Place> Lesson<D> {
    /// Listens to what a person says, and begins a session where there is something to do. `insists` tries what is not sure: the same was said
    /// before. `environment` is the place as it is now, for the record. A session under way is forgotten, and what was still to come with it.
    ///
    /// # Errors
    /// What [`Agent::listen`] refuses.
    pub fn listen(&mut self, utterance: &str, environment: D::Record, insists: bool) -> Result<Listened, LiveError> {
        self.forget();
        let listening = self.listening_to(utterance.trim(), None);
        self.begin_part(Ahead { listening, after: None, left: None, insists }, environment)
    }

    /// Tells the robot something. With some lessons it [listens](Self::listen); before that everything is a command, and nothing is returned. Said once
    /// more, words for which there was nothing to do are a command all the same, unless they say what shall not be.
    ///
    /// # Errors
    /// What [`Agent::listen`] and [`Agent::hear`] refuse.
    pub fn tell(&mut self, words: &str, environment: D::Record) -> Result<Option<Listened>, LiveError> {
        let is_again = self.declined.take().is_some_and(|declined| declined == words);
        if tells_talk(&self.agent) {
            let listened = self.listen(words, environment.clone(), is_again)?;
            if self.is_under_way() || !is_again || self.is_about_what_shall_not_be() {
                self.declined = (!self.is_under_way()).then(|| words.to_owned());
                return Ok(Some(listened));
            }
        }
        self.hear(words, environment)?;
        Ok(None)
    }

    /// Begins a session of a log anew: `listening` and the task of the command before are what the log tells.
    ///
    /// # Errors
    /// As [`listen`](Self::listen).
    pub fn listen_as(&mut self, listening: Listening, after: Option<GroundedTask>, environment: D::Record) -> Result<Listened, LiveError> {
        self.forget();
        self.conversations.now = listening.conversation.clone();
        self.begin_part(Ahead { listening, after, left: None, insists: true }, environment)
    }

    /// Whether the session, or the last one, is about what shall not be.
    pub fn is_about_what_shall_not_be(&self) -> bool {
        self.agent.tasks().iter().any(GroundedTask::is_negated)
    }

    /// Whether an utterance has a rest.
    pub const fn is_more(&self) -> bool {
        self.ahead.is_some()
    }

    /// Whether there is something to learn from the session under way. What shall not be, and "again", have no words for their tasks.
    pub fn teaches(&self) -> bool {
        self.is_under_way() && !self.agent.sentence().is_empty() && !self.is_about_what_shall_not_be()
    }

    /// The rest of the utterance.
    pub fn rest(&self) -> Option<&str> {
        self.ahead.as_ref().map(|ahead| ahead.listening.utterance.as_str())
    }

    /// Begins a session with what is still to come, where the robot is now; `None` where nothing is. The session before must be over.
    ///
    /// # Errors
    /// What [`Agent::listen_after`] refuses.
    pub fn listen_on(&mut self, environment: D::Record) -> Result<Option<Listened>, LiveError> {
        let Some(mut ahead) = self.ahead.take() else { return Ok(None) };
        let left = ahead.left;
        ahead.listening.conversation = self.conversation().clone();
        let listened = self.begin_part(ahead, environment)?;
        // Who could not bring one thing does not try it for ever.
        if left.is_some_and(|left| listened.tasks.iter().count() >= left) {
            self.forget();
            return Ok(None);
        }
        Ok(Some(listened))
    }

    /// Begins with the first part that is not done already.
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

    /// A part is over: the next one comes after it.
    pub(crate) fn end_part(&mut self) {
        let followed = self.followed();
        if let Some(ahead) = self.ahead.as_mut().filter(|ahead| ahead.left.is_none()) {
            (ahead.listening.after, ahead.after) = (followed.map(|task| task.lifted), followed);
        }
    }

    fn followed(&self) -> Option<GroundedTask> {
        self.agent.tasks().get(self.agent.most_likely()?).copied()
    }
}

#[cfg(test)]
mod tests {
    use super::{CLOSED_WORDS, part};

    #[test]
    fn a_part_of_an_utterance_ends_before_its_connective() {
        let utterance = "Go to the red room, and then to the blue one";
        assert_eq!(part(utterance, utterance.find("to the blue"), CLOSED_WORDS), "Go to the red room");
        assert_eq!(part("and then", Some(8), CLOSED_WORDS), "and");
        assert_eq!(part(" go on ", None, CLOSED_WORDS), "go on");
    }
}
