//! One robot, one home, and the session under way. All that this command asks of the core is asked here.
//!
//! [`Pupil::hear`], then over and over [`Pupil::plan`] until it is done, [`Pupil::act`], [`Pupil::judge`], [`Pupil::go_on`]; at the
//! end [`Pupil::finish`] and [`Pupil::learn`] until it is done, or [`Pupil::forget`].
//!
//! What the trainer says counts at once, and of several words to one step the last one counts. To take a step back, the session is walked
//! again up to there: the same actions and the same feedback give the same belief.
//!
//! - [`asking`]: what the robot asks; [`half_taught`]: a starter in its mind; [`mind`]: the robot's mind and its home in memory; [`thoughts`]: what the robot thinks.

mod asking;
mod half_taught;
mod mind;
mod thoughts;

pub use goodbot_lesson::live::{Acted, Judged};
pub use thoughts::{Idea, Meaning, WordSupport};

use crate::ask::SURE;
use crate::teach::scene::{Scene, scene};
use crate::teach::site::{Recorded, Setting, Site, SiteState, session, session_mut};
use crate::teach::table::{Table, table};
use goodbot::capacity::Capacity;
use goodbot::feedback::{Feedback, SimulatedTrainer, Strategy};
use goodbot::language::Synonyms;
use goodbot::memory::AgentHeap;
use goodbot::planning::{OptimalSet, Progress};
use goodbot::session::{Evidence, Finished};
use goodbot::snapshot::Contents;
use goodbot::talk::{ClosedWords, Hypothesis, Listened, Said, Verdict};
use goodbot::task::LiftedTask;
use goodbot::{Agent, AgentError, Capacities};
use goodbot_console::believes::Believes;
use goodbot_console::load::kinds::with_kinds;
use goodbot_console::load::synonyms::said_in_known_words;
use goodbot_console::messages::say;
use goodbot_console::outcome::Failure;
use goodbot_console::starter::Starter;
use goodbot_console::training_data::restored::{self, learn_fully, room_for, room_for_tasks};
use goodbot_course::exercise::Intention;
use goodbot_course::generator;
use goodbot_course::next_lesson::times_heard;
use goodbot_formats::environment::EnvironmentFile;
use goodbot_lesson::first_words::{read, words_read};
use goodbot_lesson::listening::tells_talk;
use goodbot_lesson::live::{Lesson, LiveError};
use half_taught::HalfTaught;
use mind::{build, expect, kinds_of_task, new_mind};
use rand_pcg::Pcg32;
use std::borrow::Cow;

fn no_session() -> Failure {
    Failure::Input("no session is under way; give a command first".to_owned())
}

/// The effect of words to the robot.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Heard {
    /// A session has begun.
    Command,
    /// The task that is meant, in words, is done already. No session has begun.
    Done(String),
    /// The words are taken for something that the robot does not do. No session has begun.
    Nothing(Hypothesis),
}

/// One robot, one home or other world, and the session under way.
pub struct Pupil {
    lesson: Lesson<Site>,
    /// Where everything is at first.
    start: SiteState,
    /// The name of the session under way, and the task that its trainer means, where they are known.
    id: Option<String>,
    intended: Option<usize>,
    random: Pcg32,
    /// What it expects of its trainer, where that was told.
    believes: Option<Believes>,
    /// What it knew before its first session.
    half_taught: HalfTaught,
    /// What the robot took the words of the last command for, where it listens.
    listened: Option<Listened>,
    /// How many words of the last command it did not read.
    unread: usize,
    /// Words that the robot hears as words that it knows.
    synonyms: Synonyms<'static>,
}

impl Pupil {
    /// A robot that has learned nothing yet, in a home or another world. `seed` decides its draws among what is equally good, `ways` whether commands may mean
    /// ways too, and `believes` what it expects of its trainer, where that is not what real people do.
    pub fn new(file: &Setting, seed: u64, ways: bool, believes: Option<Believes>) -> Result<Self, Failure> {
        let (rooms, start) = build(file)?;
        let lifted = kinds_of_task(&rooms, ways)?;
        let mind = new_mind(&Capacities::STANDARD, Capacities::STANDARD.pairs, &lifted, believes.as_ref())?;
        let lesson = Lesson::new(mind, rooms, start);
        let half_taught = HalfTaught::default();
        Ok(Self {
            lesson,
            start,
            id: None,
            intended: None,
            random: generator(seed),
            believes,
            half_taught,
            listened: None,
            unread: 0,
            synonyms: Synonyms::NONE,
        })
    }

    /// The same robot, whose commands mean tasks of these kinds: it has learned nothing yet.
    pub fn with_kinds(mut self, lifted: &[LiftedTask]) -> Result<Self, Failure> {
        let mind = new_mind(&Capacities::STANDARD, Capacities::STANDARD.pairs, lifted, self.believes.as_ref())?;
        self.lesson.replace_agent(mind);
        Ok(self)
    }

    /// The same robot, half taught from the start: it begins anew, with the sentences of a starter.
    pub fn with_starter(mut self, starter: Starter) -> Result<Self, Failure> {
        self.half_taught = HalfTaught::new(starter);
        self.start_anew()?;
        Ok(self)
    }

    /// The same robot, with these words that speak about commands.
    pub const fn with_closed_words(mut self, closed: ClosedWords<'static>) -> Self {
        self.lesson.closed = closed;
        self
    }

    /// The same robot, which hears unknown words as known ones of their line in a table.
    pub const fn with_synonyms(mut self, synonyms: Synonyms<'static>) -> Self {
        self.synonyms = synonyms;
        self
    }

    /// What was said, as the robot hears it.
    fn in_known_words<'w>(&self, words: &'w str) -> Result<Cow<'w, str>, Failure> {
        if self.synonyms == Synonyms::NONE {
            return Ok(Cow::Borrowed(words));
        }
        Ok(said_in_known_words(self.synonyms, self.lesson.agent.language(), words)?)
    }

    /// A mind that has learned nothing yet, with these capacities and room for a starter.
    fn new_mind(&self, capacities: &Capacities, tasks: usize) -> Result<Agent<AgentHeap>, Failure> {
        let (capacities, tasks) = (self.half_taught.room(*capacities), tasks + self.half_taught.tasks());
        new_mind(&capacities, tasks, self.lesson.agent.lifted(), self.believes.as_ref())
    }

    /// Gives the robot a mind that has its own sessions alone: a starter's sentences come beside them.
    fn take_mind(&mut self, mut mind: Agent<AgentHeap>) -> Result<(), Failure> {
        self.half_taught.join(&mut mind)?;
        learn_fully(&mut mind);
        self.lesson.replace_agent(mind);
        Ok(())
    }

    /// Replaces what the robot has learned by a model file. A session under way ends unlearned.
    pub fn restore(&mut self, bytes: &[u8]) -> Result<(), Failure> {
        let contents = Contents::read(bytes)?;
        let mut mind = self.new_mind(&room_for(&contents), room_for_tasks(&contents))?;
        if contents.vocabulary == 0 || contents.vocabulary == mind.vocabulary() {
            mind.restore(bytes)?;
        } else {
            say!("this model was learned elsewhere: what it knows of words is taken along, and what it believes of its trainer is not");
            let _ = mind.join(&restored::words(bytes)?)?;
        }
        if self.believes.is_some() {
            expect(&mut mind, self.believes.as_ref())?;
        }
        self.take_mind(mind)
    }

    /// A new robot, which has learned nothing, in the same home. A session under way ends unlearned.
    pub fn start_anew(&mut self) -> Result<(), Failure> {
        let mind = self.new_mind(&Capacities::STANDARD, Capacities::STANDARD.pairs)?;
        self.take_mind(mind)
    }

    /// What the robot has learned, as the bytes of a model file with its kinds of task. It must not be learning. A starter's sentences are not in it.
    pub fn save(&self) -> Result<Vec<u8>, Failure> {
        let model = match self.half_taught.own() {
            Some(own) => own.to_vec(),
            None => self.lesson.agent.saved()?,
        };
        // A world names its kinds of task itself.
        Ok(if self.lesson.home().as_floor().is_some() { with_kinds(model, self.lesson.agent.lifted()) } else { model })
    }

    /// Moves the robot to another home. A session under way ends unlearned.
    pub fn enter(&mut self, file: &EnvironmentFile) -> Result<(), Failure> {
        if self.lesson.home().as_other().is_some() {
            let message = "this robot is in a world from a file, and its commands mean nothing in a home; teach another one there";
            return Err(Failure::Input(message.to_owned()));
        }
        let (rooms, start) = build(&Setting::Floor(file.clone()))?;
        self.start = start;
        self.lesson.enter(rooms, start);
        Ok(())
    }

    /// Puts everything back to where it was when the home was entered. A session under way ends unlearned.
    pub fn put_back(&mut self) {
        self.lesson.put(self.start);
    }

    /// The home as it is now; `None` in another world.
    pub fn scene(&self) -> Option<Scene> {
        match (self.lesson.home(), self.lesson.state()) {
            (Site::Floor(home), SiteState::Floor(state)) => Some(scene(home, state)),
            _ => None,
        }
    }

    /// The world from a file as it is now; `None` in a home.
    pub fn table(&self) -> Option<Table> {
        match (self.lesson.home(), self.lesson.state()) {
            (Site::Other(robot), SiteState::Other(state)) => Some(table(robot, *state)),
            _ => None,
        }
    }

    /// The robot, its home and the session under way.
    pub const fn lesson(&self) -> &Lesson<Site> {
        &self.lesson
    }

    /// The same, to plan, to judge and to go on.
    pub const fn lesson_mut(&mut self) -> &mut Lesson<Site> {
        &mut self.lesson
    }

    /// The position of the task that the trainer means, where that is known.
    pub fn intended(&self) -> Option<usize> {
        self.intended.filter(|_| self.lesson.is_under_way())
    }

    /// Notes what is meant by the command under way, by position.
    pub fn mean(&mut self, position: usize) {
        self.intended = Some(position);
    }

    /// How many sessions the robot has learned from.
    pub fn lessons_learned(&self) -> usize {
        self.lesson.agent.language().bitext().sessions() - self.half_taught.count()
    }

    /// In how many of the sessions that it has learned from the robot heard a word.
    pub fn times_heard(&self, word: &str) -> u32 {
        times_heard(&self.lesson.agent, word)
    }

    /// Hears a command where everything is now. A session under way ends unlearned. `intention` is what the trainer means, where that is
    /// known: it is written down, and never learned from.
    ///
    /// With some lessons, the robot listens: it begins with what there is to do. Said once more, words for which there was nothing to do are a
    /// command all the same, unless they say what shall not be.
    pub fn hear(&mut self, command: &str, id: Option<String>, intention: Option<&Intention>) -> Result<Heard, Failure> {
        self.forget();
        (self.id, self.intended, self.listened) = (id, None, None);
        let command = &self.in_known_words(command)?;
        let environment = self.lesson.environment();
        let read = read(command)?;
        self.unread = read.long().map_or(0, |long| long.unread());
        if let Some(intention) = intention {
            self.lesson.hear(read.words, environment)?;
            self.intended = intention.find(&self.lesson.agent, self.lesson.home());
            return Ok(Heard::Command);
        }
        // A conversation has the name of its first session.
        if let Some(id) = self.id.as_ref().filter(|_| tells_talk(&self.lesson.agent)) {
            self.lesson.name_conversation(id);
        }
        // A robot that listens reads a long utterance in parts.
        let told = if tells_talk(&self.lesson.agent) { command } else { read.words };
        self.listened = match self.lesson.tell(told, environment.clone()) {
            // Said once more, it is a command all the same.
            Err(LiveError::Agent(AgentError::Capacity(full))) if full.capacity == Capacity::WordsPerCommand => {
                self.lesson.hear(read.words, environment)?;
                None
            }
            told => told?,
        };
        if self.listened.is_some_and(|listened| listened.rest.is_some()) {
            self.unread = 0;
        }
        Ok(self.listened.map_or(Heard::Command, |listened| self.heard(&listened)))
    }

    /// Hears the rest of the utterance, where the robot is now; `None` if there is no rest.
    pub fn hear_rest(&mut self, id: Option<String>) -> Result<Option<Heard>, Failure> {
        let environment = self.lesson.environment();
        (self.id, self.intended) = (id, None);
        let listened = self.lesson.listen_on(environment)?;
        (self.listened, self.unread) = (listened, 0);
        Ok(listened.map(|listened| self.heard(&listened)))
    }

    /// The effect of words that the robot has listened to.
    fn heard(&self, listened: &Listened) -> Heard {
        if self.lesson.is_under_way() {
            return Heard::Command;
        }
        match listened.verdict {
            Verdict::Done => Heard::Done(self.words_of(listened.task).unwrap_or_default()),
            _ if self.lesson.is_about_what_shall_not_be() => Heard::Nothing(Hypothesis::Negated),
            _ => Heard::Nothing(listened.hypothesis),
        }
    }

    /// How many words of the last command were not read: it had more than are read.
    pub const fn unread(&self) -> usize {
        self.unread
    }

    /// How sure the robot is of the last command: `sure`, `unsure`, `done` or `none`, as `goodbot ask` says it.
    pub fn certainty(&self) -> &'static str {
        let is_sure = || self.meanings().first().is_some_and(|meaning| meaning.probability >= SURE);
        match self.listened.map(|listened| listened.verdict) {
            Some(Verdict::Done) => "done",
            Some(Verdict::None) => "none",
            Some(Verdict::Sure) => "sure",
            None if is_sure() => "sure",
            Some(Verdict::Unsure) | None => "unsure",
        }
    }

    /// What the robot takes the last command for.
    pub fn taken_for(&self) -> Hypothesis {
        self.listened.map_or(Hypothesis::Command, |listened| listened.hypothesis)
    }

    /// What a person's words ask for, at this point of the conversation.
    pub fn said(&self, words: &str) -> Result<Said, Failure> {
        // In a session, words that are too long are refused: their first ones could end it.
        let words = if self.lesson.is_under_way() { words } else { words_read(words) };
        Ok(self.lesson.said(&self.in_known_words(words)?)?)
    }

    /// Takes in words that turn the robot on its way round.
    pub fn correct(&mut self, words: &str) -> Result<Evidence, Failure> {
        let words = &self.in_known_words(words)?;
        Ok(self.lesson.correct(words)?)
    }

    /// Learns what is said along with a button.
    pub fn learn_word(&mut self, words: &str, feedback: Feedback) -> Result<(), Failure> {
        Ok(self.lesson.learn_voice(words, feedback)?)
    }

    /// Begins another conversation, or goes on with one, by its name.
    pub fn converse(&mut self, id: Option<&str>) -> Result<(), Failure> {
        match id {
            None => self.lesson.converse_anew(),
            Some(id) => self.lesson.converse(id)?,
        }
        Ok(())
    }

    /// Plans to the end.
    pub fn plan_fully(&mut self) -> Result<(), Failure> {
        while !self.lesson.plan(u32::MAX)? {}
        Ok(())
    }

    /// Decides on an action and does it. The plan must be done, and what was done before must be over: [`go_on`](Self::go_on).
    pub fn act(&mut self) -> Result<&Acted, Failure> {
        Ok(self.lesson.act(&mut self.random)?)
    }

    /// What a simulated trainer who means the intended task says to the last step; `None` where nothing is intended or done.
    pub fn simulated_word(&mut self) -> Option<Feedback> {
        let right = self.lesson.acted()?.is_right(self.intended()?) == Some(true);
        Some(SimulatedTrainer { strategy: Strategy::BALANCED }.feedback(right, &mut self.random))
    }

    /// What the plan says for the intended task, as [`Acted::plan`] does.
    pub fn intended_plan(&self) -> Option<OptimalSet> {
        Some(self.lesson.agent.planned().optimal(self.intended()?))
    }

    /// Ends the session and begins to learn from it. Gives its record, and which older sessions gave way because memory was full. A step
    /// to which nothing was said is left out.
    pub fn finish(&mut self) -> Result<(Recorded, Finished), Failure> {
        self.lesson.walk_on()?;
        let record = self.record(true).ok_or_else(no_session)?;
        let finished = self.lesson.finish()?;
        self.half_taught.fade(&mut self.lesson.agent, &finished)?;
        Ok((record, finished))
    }

    /// Goes on learning, with at most about `budget` table cells of work. Gives whether it is done.
    pub fn learn(&mut self, budget: u32) -> bool {
        self.lesson.agent.learn(budget) == Progress::Done
    }

    /// Ends the session, if one is under way, without learning from it. Gives its record where anything was judged.
    pub fn forget(&mut self) -> Option<Recorded> {
        let record = self.record(false).filter(|record| !session(record).steps.is_empty() || !session(record).answers.is_empty());
        self.lesson.forget();
        record
    }

    fn record(&self, learn: bool) -> Option<Recorded> {
        let mut record = self.lesson.recorded(learn)?;
        session_mut(&mut record).header.id = self.id.clone();
        // A log tells what was meant where it is a task of the paper's kind that is to be done.
        let is_to_do =
            |position: &usize| !self.lesson.is_about_what_shall_not_be() && !self.lesson.agent.done(self.lesson.home()).contains(*position);
        let meant = self.intended.filter(is_to_do).and_then(|position| self.lesson.name_of(position));
        session_mut(&mut record).header.set_meant(meant.as_ref());
        Some(record)
    }
}
