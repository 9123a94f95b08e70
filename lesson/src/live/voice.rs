//! Words and questions during a session, words between sessions, and words said along with the feedback buttons: as [`goodbot::Agent::said`] reads them.

use super::{Lesson, LiveError};
use crate::place::Place;
use crate::walk::SessionAnswer;
use goodbot::AgentError;
use goodbot::asking::{Asking, Considered, Question};
use goodbot::feedback::Feedback;
use goodbot::language::for_each_piece;
use goodbot::planning::OptimalSet;
use goodbot::session::Evidence;
use goodbot::talk::{Class, Classes, ClosedWords, Said, Stage, for_each_open_word};
use goodbot::task::TaskSet;

impl<D: Place> Lesson<D> {
    /// Reads a person's words at this point of the conversation, and changes nothing. Words that refer to something before are no command
    /// if there is nothing before: they are [`Said::Nothing`] of [`Class::Back`].
    ///
    /// # Errors
    /// An [`AgentError`] if there are too many words, or one is too long.
    pub fn said(&self, words: &str) -> Result<Said, LiveError> {
        let stage = match self.acted() {
            _ if !self.is_under_way() => Stage::Between,
            None => Stage::OnTheWay,
            Some(acted) if acted.action == "noop" && acted.plan == OptimalSet::Goal => Stage::AtGoal,
            Some(_) => Stage::Stepped,
        };
        let said = self.agent.said(words, self.closed, stage, |word| self.voice.count(word))?;
        // Without an earlier command, there is nothing to point at.
        let is_new = self.conversation().facts.is_empty();
        let may_point = stage == Stage::Between && matches!(said, Said::Command | Said::Nothing(Class::No));
        if may_point && is_new && self.changes_what_was_before(words, said)? {
            return Ok(Said::Nothing(Class::Back));
        }
        Ok(said)
    }

    /// Whether words would change something said before: "no, the other one", "put it back", "forget it". A command has more words of its
    /// own.
    fn changes_what_was_before(&self, words: &str, said: Said) -> Result<bool, AgentError> {
        let (mut is_no, mut points, mut acts, mut open) = (false, false, false, 0_usize);
        for_each_piece(words, |piece| {
            let classes = self.closed.of(piece);
            is_no |= open == 0 && classes.contains(Class::No);
            acts |= classes.contains(Class::Act);
            points |= classes.forgets() || classes.contains_any(&[Class::Back, Class::Other]);
            // A Chinese sign counts as half a word.
            open = open.saturating_add(if classes == Classes::NONE { piece.chars().take(2).count() } else { 0 });
            Ok(())
        })?;
        let is_short = open <= if is_no { 4 } else { 2 };
        // "No" alone is feedback, and "no, go to the red room" is a command.
        let is_turned = || Ok::<_, AgentError>(is_no && !acts && said == Said::Command && !self.agent.is_told_to_act(words, self.closed)?);
        Ok(is_short && (points || is_turned()?))
    }

    /// Whether to ask before these words, taken for a command, end the session under way: it has something to learn from, and the words,
    /// such as "hmm", may be no command at all, because none of them is a known word for what to do. The same words once more, before another
    /// step, are no longer doubted.
    ///
    /// # Errors
    /// An [`AgentError`] if there are too many words, or one is too long.
    ///
    /// ```
    /// # use goodbot::home::{Moves, paper_tasks};
    /// # use goodbot::{Agent, Capacities, Options, memory::AgentHeap};
    /// # use goodbot_lesson::{home, live::Lesson};
    /// # let rooms = home::parse("home", "#########\n#rrr#ggg#\n#r@r+ggg#\n#rrr#ggg#\n#########\n").unwrap();
    /// # let (place, start) = home::build(&rooms, Moves::Push, home::memory()).unwrap();
    /// # let agent = Agent::new(AgentHeap::new(&Capacities::SMALL), &paper_tasks().unwrap(), Options::DEFAULT)?;
    /// # let mut lesson = Lesson::new(agent, place, start);
    /// # let mut random = rand_pcg::Pcg32::new(1, 1);
    /// lesson.hear("go to the green room", rooms)?;
    /// assert!(!lesson.doubts("go to the red room")?, "there is nothing to lose yet");
    /// while !lesson.plan(10_000)? {}
    /// lesson.act(&mut random)?;
    /// lesson.go_on()?;
    /// assert!(lesson.doubts("hmm")?);
    /// assert!(!lesson.doubts("hmm")?, "so it was meant");
    /// # Ok::<(), goodbot_lesson::live::LiveError>(())
    /// ```
    pub fn doubts(&mut self, words: &str) -> Result<bool, LiveError> {
        let is_again = self.doubted.take().is_some_and(|doubted| doubted == words);
        let is_lesson = self.is_under_way() && self.has_evidence();
        let doubts = is_lesson && !is_again && !self.agent.is_told_to_act(words, self.closed)?;
        self.doubted = doubts.then(|| words.to_owned());
        Ok(doubts)
    }

    /// Counts the words said along with a button.
    ///
    /// # Errors
    /// The errors of [`Voice::learn`].
    pub fn learn_voice(&mut self, words: &str, feedback: Feedback) -> Result<(), LiveError> {
        Ok(self.voice.learn(words, feedback, self.closed)?)
    }

    /// Takes a correction of the robot on its way, as [`goodbot::Agent::correct`] does, and keeps its words for the record.
    ///
    /// # Errors
    /// [`LiveError::NoSession`], or the agent's error.
    pub fn correct(&mut self, words: &str) -> Result<Evidence, LiveError> {
        if !self.is_under_way() {
            return Err(LiveError::NoSession);
        }
        let followed = self.acted().map_or_else(|| self.agent.most_likely(), |acted| Some(acted.task));
        let closed = self.closed;
        let (agent, home, _) = self.parts();
        let corrected = agent.correct(home, words, closed, followed)?;
        let words = Some(words.trim().to_owned());
        self.note_answer(SessionAnswer { tasks: TaskSet::of(corrected.task), yes: false, words, ..SessionAnswer::of(corrected.eta) });
        Ok(Evidence::Used)
    }

    /// Takes a recorded correction again: "no" to these tasks, the probability that this is wrong, and the words.
    ///
    /// # Errors
    /// The errors of [`correct`](Self::correct).
    pub fn correct_as(&mut self, tasks: TaskSet, eta: f32, words: &str) -> Result<(), LiveError> {
        let closed = self.closed;
        let (agent, home, _) = self.parts();
        let _ = agent.answered(tasks, false, eta, 1)?;
        let _ = agent.corrected(home, words, closed, tasks)?;
        self.note_answer(SessionAnswer { tasks, yes: false, words: Some(words.to_owned()), ..SessionAnswer::of(eta) });
        Ok(())
    }
}

impl<D: Place> Lesson<D> {
    /// The question to ask here, if it teaches the robot more than its next steps do. The plan must be done.
    ///
    /// # Errors
    /// [`LiveError::NoSession`], or the errors of [`Agent::question`](goodbot::Agent::question).
    pub fn ask(&mut self, asking: &Asking) -> Result<Option<Question>, LiveError> {
        loop {
            match self.consider(asking, u32::MAX)? {
                Considered::Working => {}
                Considered::Act => return Ok(None),
                Considered::Ask(question) => return Ok(Some(question)),
            }
        }
    }

    /// As [`ask`](Self::ask), but in parts: see [`Agent::consider`](goodbot::Agent::consider).
    ///
    /// # Errors
    /// As [`ask`](Self::ask).
    pub fn consider(&mut self, asking: &Asking, budget: u32) -> Result<Considered, LiveError> {
        let listened = self.session().ok_or(LiveError::NoSession)?.0.listening.is_some();
        let (agent, home, state) = (&mut self.agent, &self.walk.home, &self.state);
        Ok(self.restraint.consider(agent, home, state, asking, listened, budget)?)
    }
}

/// The words said along with the feedback buttons: how often each came with "good" and with "bad".
#[derive(Clone, Debug, Default)]
pub struct Voice {
    said: Vec<(String, [u32; 2])>,
}

impl Voice {
    /// Counts the words said along with a button. Silence teaches nothing, nor do words of closed classes.
    ///
    /// # Errors
    /// A [`goodbot::capacity::CapacityError`] if there are too many words, or one is too long.
    pub fn learn(&mut self, words: &str, feedback: Feedback, closed: ClosedWords<'_>) -> Result<(), AgentError> {
        let side = match feedback {
            Feedback::Reward => 0,
            Feedback::Punish => 1,
            Feedback::Neutral => return Ok(()),
        };
        for_each_open_word(words, closed, |word| {
            let known = self.said.iter().position(|(known, _)| known == word).unwrap_or_else(|| {
                self.said.push((word.to_owned(), [0; 2]));
                self.said.len() - 1
            });
            let counts = &mut self.said[known].1;
            counts[side] = counts[side].saturating_add(1);
        })
    }

    /// How often a word came with "good" and with "bad"; `None` if it never did.
    pub fn count(&self, word: &str) -> Option<[u32; 2]> {
        self.said.iter().find(|(known, _)| known == word).map(|(_, counts)| *counts)
    }
}
