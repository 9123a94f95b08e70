//! One robot, one home, and the session under way: all calls of this command to the core.
//!
//! Call [`Pupil::hear`]. Then repeat [`Pupil::plan`] until it is done, [`Pupil::act`], [`Pupil::judge`] and [`Pupil::go_on`]. At the end
//! call [`Pupil::finish`], and [`Pupil::learn`] until it is done; or call [`Pupil::forget`].
//!
//! Feedback counts at once; the last feedback to a step replaces earlier ones. To take a step back, the session is replayed up to there:
//! the same actions and the same feedback give the same belief.
//!
//! - [`mind`]: the robot's agent, with a starter, and its home in memory; [`thoughts`]: its beliefs, words and questions.

mod mind;
mod thoughts;

pub use goodbot_lesson::live::Acted;
pub use mind::{build, kinds_of_task};
pub use thoughts::{Idea, Meaning, WordSupport};

use super::site::{Shown, scene, table};
use crate::teach::site::{Recorded, Setting, Site, SiteState, session, session_mut};
use goodbot::feedback::{Feedback, Strategy};
use goodbot::language::Synonyms;
use goodbot::memory::AgentHeap;
use goodbot::planning::OptimalSet;
use goodbot::session::{Evidence, Finished};
use goodbot::snapshot::Contents;
use goodbot::talk::{Hypothesis, Listened, Said, Verdict};
use goodbot::task::LiftedTask;
use goodbot::{Agent, Capacities};
use goodbot_console::load::kinds::with_kinds;
use goodbot_console::load::words::said_in_known_words;
use goodbot_console::restored::{learn_fully, restore_or_join, room_for, room_for_tasks};
use goodbot_console::{Believes, Failure, Starter, say};
use goodbot_course::exercise::Intention;
use goodbot_course::{SimulatedTrainer, generator};
use goodbot_formats::environment::EnvironmentFile;
use goodbot_lesson::first_words::{read, words_read};
use goodbot_lesson::live::{Lesson, LiveError};
use mind::{StarterSessions, expect, new_mind};
use rand_pcg::Pcg32;
use std::borrow::Cow;

/// The effect of words to the robot.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Reaction {
    /// A session has begun.
    Command,
    /// The intended task, in words, is done already. No session has begun.
    Done(String),
    /// The words ask for something that the robot does not do. No session has begun.
    Nothing(Hypothesis),
}

/// One robot, one home or other world, and the session under way.
pub struct Pupil {
    /// The robot, its home and the session under way.
    pub lesson: Lesson<Site>,
    /// The initial state.
    start: SiteState,
    /// The id of the session under way, and the position of its intended task, if they are known.
    id: Option<String>,
    intended: Option<usize>,
    random: Pcg32,
    /// The trainer that it expects, if one was given.
    believes: Option<Believes>,
    /// The starter.
    starter_sessions: StarterSessions,
    /// The result of listening to the last command; `None` if its intended task was given with it.
    listened: Option<Listened>,
    /// How many words of the last command were not read, because it was too long.
    pub unread: usize,
    /// The synonyms that replace unknown words.
    pub synonyms: Synonyms<'static>,
}

impl Pupil {
    /// A robot in a place, without training of its own, whose commands may mean these kinds of task. `seed` determines its choices among
    /// equal actions. `believes` is its expected trainer, by default real people.
    pub fn new(
        (rooms, start): (Site, SiteState),
        lifted: &[LiftedTask],
        seed: u64,
        believes: Option<Believes>,
        starter: Starter,
    ) -> Result<Self, Failure> {
        let mind = new_mind(&Capacities::STANDARD, Capacities::STANDARD.pairs, lifted, believes.as_ref())?;
        let mut pupil = Self {
            lesson: Lesson::new(mind, rooms, start),
            start,
            id: None,
            intended: None,
            random: generator(seed),
            believes,
            starter_sessions: StarterSessions::new(starter),
            listened: None,
            unread: 0,
            synonyms: Synonyms::NONE,
        };
        pupil.start_anew()?;
        Ok(pupil)
    }

    /// The words, with unknown words replaced by known synonyms.
    fn in_known_words<'w>(&self, words: &'w str) -> Result<Cow<'w, str>, Failure> {
        if self.synonyms == Synonyms::NONE {
            return Ok(Cow::Borrowed(words));
        }
        Ok(said_in_known_words(self.synonyms, self.lesson.agent.language(), words)?)
    }

    /// An agent without training, with these capacities and room for the starter.
    fn new_mind(&self, capacities: &Capacities, tasks: usize) -> Result<Agent<AgentHeap>, Failure> {
        let (capacities, tasks) = (self.starter_sessions.room(*capacities), tasks + self.starter_sessions.tasks());
        new_mind(&capacities, tasks, self.lesson.agent.lifted(), self.believes.as_ref())
    }

    /// Replaces the agent by one that has only its own sessions, and adds the starter's sentences.
    fn take_mind(&mut self, mut mind: Agent<AgentHeap>) -> Result<(), Failure> {
        self.starter_sessions.join(&mut mind)?;
        learn_fully(&mut mind);
        self.lesson.replace_agent(mind);
        Ok(())
    }

    /// Replaces the robot's training by a model file. A session under way ends unlearned.
    pub fn restore(&mut self, bytes: &[u8]) -> Result<(), Failure> {
        let contents = Contents::read(bytes)?;
        let mut mind = self.new_mind(&room_for(&contents), room_for_tasks(&contents))?;
        if !restore_or_join(&mut mind, &contents, bytes)? {
            say!("this model was learned elsewhere: its words are taken along, its belief about the trainer is not");
        }
        if self.believes.is_some() {
            expect(&mut mind, self.believes.as_ref())?;
        }
        self.take_mind(mind)
    }

    /// Replaces the robot by one without training, in the same home. A session under way ends unlearned.
    pub fn start_anew(&mut self) -> Result<(), Failure> {
        let mind = self.new_mind(&Capacities::STANDARD, Capacities::STANDARD.pairs)?;
        self.take_mind(mind)
    }

    /// The robot's training as the bytes of a model file, with its kinds of task and without the starter's sentences. It must not be
    /// learning.
    pub fn save(&self) -> Result<Vec<u8>, Failure> {
        let model = match self.starter_sessions.own() {
            Some(own) => own.to_vec(),
            None => self.lesson.agent.saved()?,
        };
        // A world names its own kinds of task.
        Ok(if self.is_in_world() { model } else { with_kinds(model, self.lesson.agent.lifted()) })
    }

    /// Moves the robot to another home. A session under way ends unlearned.
    pub fn enter(&mut self, file: &EnvironmentFile) -> Result<(), Failure> {
        if self.is_in_world() {
            let message = "this robot is in a world from a file, and its commands mean nothing in a home; teach another one there";
            return Err(Failure::Input(message.to_owned()));
        }
        let (rooms, start) = build(&Setting::Floor(file.clone()))?;
        self.start = start;
        self.lesson.enter(rooms, start);
        Ok(())
    }

    /// Puts everything back to its place at the start. A session under way ends unlearned.
    pub fn put_back(&mut self) {
        self.lesson.put(self.start);
    }

    /// The place as it is now. A place always has a state of its own kind, so this is never `None`.
    pub fn shown(&self) -> Option<Shown> {
        match (self.lesson.home(), self.lesson.state()) {
            (Site::Floor(home), SiteState::Floor(state)) => Some(Shown::Floor(scene(home, state))),
            (Site::Other(robot), SiteState::Other(state)) => Some(Shown::Other(table(robot, *state))),
            _ => None,
        }
    }

    /// Whether it is in a world from a file.
    pub fn is_in_world(&self) -> bool {
        self.lesson.home().as_other().is_some()
    }

    /// The position of the intended task, if it is known.
    pub fn intended(&self) -> Option<usize> {
        self.intended.filter(|_| self.lesson.is_under_way())
    }

    /// Records the intended task of the command under way, by position.
    pub fn mean(&mut self, position: usize) {
        self.intended = Some(position);
    }

    /// How many sessions the robot has learned from.
    pub fn lessons_learned(&self) -> usize {
        self.lesson.agent.language().bitext().sessions() - self.starter_sessions.count()
    }

    /// Hears a command in the present state. A session under way ends unlearned. `intention` is the intended task, if it is known: it goes
    /// to the log, and is never learned from.
    ///
    /// The robot listens, and begins with the first part that is still to do. If the same words are said twice and there was nothing to do,
    /// they count as a command too, unless they forbid something.
    pub fn hear(&mut self, command: &str, id: Option<String>, intention: Option<&Intention>) -> Result<Reaction, Failure> {
        self.forget();
        (self.id, self.intended, self.listened) = (id, None, None);
        let command = &self.in_known_words(command)?;
        let environment = self.lesson.environment();
        let read = read(command)?;
        self.unread = read.long().map_or(0, |long| long.unread());
        if let Some(intention) = intention {
            self.lesson.hear(read.words, environment)?;
            self.intended = intention.find(&self.lesson.agent, self.lesson.home());
            return Ok(Reaction::Command);
        }
        // A conversation has the name of its first session.
        if let Some(id) = &self.id {
            self.lesson.name_conversation(id);
        }
        self.listened = Some(self.lesson.tell(command, environment)?);
        if self.listened.is_some_and(|listened| listened.rest.is_some()) {
            self.unread = 0;
        }
        Ok(self.listened.map_or(Reaction::Command, |listened| self.heard(&listened)))
    }

    /// Hears the rest of the utterance in the present state; `None` if there is no rest.
    pub fn hear_rest(&mut self, id: Option<String>) -> Result<Option<Reaction>, Failure> {
        let environment = self.lesson.environment();
        (self.id, self.intended) = (id, None);
        let listened = self.lesson.listen_on(environment)?;
        (self.listened, self.unread) = (listened, 0);
        Ok(listened.map(|listened| self.heard(&listened)))
    }

    /// The effect of an utterance that the robot has listened to.
    fn heard(&self, listened: &Listened) -> Reaction {
        if self.lesson.is_under_way() {
            return Reaction::Command;
        }
        match listened.verdict {
            Verdict::Done => Reaction::Done(self.words_of(listened.task).unwrap_or_default()),
            _ if self.lesson.is_prohibition() => Reaction::Nothing(Hypothesis::Negated),
            _ => Reaction::Nothing(listened.hypothesis),
        }
    }

    /// The verdict on the last command: `sure`, `unsure`, `done` or `none`, as in `goodbot ask`.
    pub fn certainty(&self) -> &'static str {
        match self.listened.map(|listened| listened.verdict) {
            Some(Verdict::Done) => "done",
            Some(Verdict::None) => "none",
            Some(Verdict::Sure) => "sure",
            Some(Verdict::Unsure) | None => "unsure",
        }
    }

    /// The kind of the last utterance.
    pub fn taken_for(&self) -> Hypothesis {
        self.listened.map_or(Hypothesis::Command, |listened| listened.hypothesis)
    }

    /// Reads a person's words at this point of the conversation.
    pub fn said(&self, words: &str) -> Result<Said, Failure> {
        // In a session, words that are too long are refused: their first words alone could end the session.
        let words = if self.lesson.is_under_way() { words } else { words_read(words) };
        Ok(self.lesson.said(&self.in_known_words(words)?)?)
    }

    /// Takes a correction of the robot on its way.
    pub fn correct(&mut self, words: &str) -> Result<Evidence, Failure> {
        let words = &self.in_known_words(words)?;
        Ok(self.lesson.correct(words)?)
    }

    /// Plans to the end.
    pub fn plan_fully(&mut self) -> Result<(), Failure> {
        while !self.lesson.plan(u32::MAX)? {}
        Ok(())
    }

    /// Chooses an action and does it. The plan must be done, and the last step must be over: see [`go_on`](Self::go_on).
    pub fn act(&mut self) -> Result<&Acted, Failure> {
        Ok(self.lesson.act(&mut self.random)?)
    }

    /// The feedback of a simulated trainer to the last step; `None` without an intended task or a step.
    pub fn simulated_word(&mut self) -> Option<Feedback> {
        let right = self.lesson.acted()?.is_right(self.intended()?) == Some(true);
        Some(SimulatedTrainer { strategy: Strategy::BALANCED }.feedback(right, &mut self.random))
    }

    /// How far the plan for the intended task is known, as in [`Acted::plan`].
    pub fn intended_plan(&self) -> Option<OptimalSet> {
        Some(self.lesson.agent.planned().optimal(self.intended()?))
    }

    /// Ends the session and begins to learn from it. Returns its record, and the older sessions that gave way because memory was full. A
    /// last step without feedback is left out.
    pub fn finish(&mut self) -> Result<(Recorded, Finished), Failure> {
        self.lesson.walk_on()?;
        let record = self.record(true).ok_or(LiveError::NoSession)?;
        let finished = self.lesson.finish()?;
        self.starter_sessions.fade(&mut self.lesson.agent, &finished)?;
        Ok((record, finished))
    }

    /// Ends the session, if one is under way, without learning from it. Returns its record if it has any step or answer.
    pub fn forget(&mut self) -> Option<Recorded> {
        let record = self.record(false).filter(|record| !session(record).steps.is_empty() || !session(record).answers.is_empty());
        self.lesson.forget();
        record
    }

    fn record(&self, learn: bool) -> Option<Recorded> {
        let mut record = self.lesson.recorded(learn)?;
        session_mut(&mut record).header.id = self.id.clone();
        // A log records only an intended task that is a plain task and still to do.
        let is_to_do = |position: &usize| !self.lesson.is_prohibition() && !self.lesson.agent.done(self.lesson.home()).contains(*position);
        let meant = self.intended.filter(is_to_do).and_then(|position| self.lesson.name_of(position));
        session_mut(&mut record).header.set_meant(meant.as_ref());
        Some(record)
    }
}
