//! One visit to a robot, on a screen or in lines: the robot, its files and the tour.

use super::kept::{Kept, Past};
use super::lessons::{Next, Tour, is_lesson, propose};
use super::pupil::{Meaning, Pupil, Reaction};
use super::site::{Recorded, session};
use crate::words::FullWords;
use goodbot::planning::Progress;
use goodbot_console::Failure;
use goodbot_formats::environment::EnvironmentFile;
use goodbot_lesson::first_words::words_read;
use goodbot_lesson::live::LiveError;

/// The robot, its files and the tour.
pub struct Classroom {
    /// The robot in its home.
    pub pupil: Pupil,
    /// The tour, if it is one.
    pub tour: Option<Tour>,
    /// The full forms of the words in commands.
    pub words: FullWords,
    /// The commands that the robot is to understand; if empty, the commands so far count.
    pub wanted: Vec<String>,
    /// The commands so far, each once.
    said: Vec<String>,
    /// The last command.
    pub last: Option<String>,
    /// The robot's files.
    pub kept: Option<Kept>,
    /// The model before each session of this visit, if the robot has no files.
    before: Vec<Vec<u8>>,
    learning: Option<(Recorded, Vec<u8>)>,
    /// The ids of the sessions of this visit that were learned from.
    learned: Vec<Option<String>>,
    sessions: usize,
}

/// The result of a test.
#[derive(Clone, Debug, PartialEq)]
pub struct Tested {
    /// The likeliest task.
    pub heard: Meaning,
    /// Whether it is the intended task.
    pub right: bool,
}

fn add_once(said: &mut Vec<String>, command: &str) {
    if !said.iter().any(|other| other == command) {
        said.push(command.to_owned());
    }
}

impl Classroom {
    /// Opens a robot with its files. With a tour, it is in the tour's home.
    pub fn new(mut pupil: Pupil, kept: Option<(Kept, Past)>, tour: Option<Tour>) -> Result<Self, Failure> {
        let mut words = FullWords::new(pupil.word_letters());
        let (mut sessions, mut said) = (0, Vec::new());
        let kept = match kept {
            None => None,
            Some((kept, past)) => {
                if let Some(model) = &past.model {
                    let name = kept.files().model.display();
                    pupil.restore(model).map_err(|refusal| Failure::Input(format!("{name}: {refusal}; name another file with --model")))?;
                }
                words = FullWords::new(pupil.word_letters());
                past.commands.iter().for_each(|command| words.hear(command));
                sessions = past.sessions;
                past.commands.into_iter().for_each(|command| add_once(&mut said, &command));
                Some(kept)
            }
        };
        let (wanted, before, learning, learned) = (Vec::new(), Vec::new(), None, Vec::new());
        let mut classroom = Self { pupil, tour, words, wanted, said, last: None, kept, before, learning, learned, sessions };
        classroom.enter_tour()?;
        Ok(classroom)
    }

    fn enter_tour(&mut self) -> Result<(), Failure> {
        self.tour.as_ref().and_then(Tour::home).map_or(Ok(()), |home| self.pupil.enter(&home))
    }

    /// Gives a command. In the tour, everything is first put back, and the intended task is known.
    pub fn say(&mut self, command: &str) -> Result<Reaction, Failure> {
        self.forget()?;
        let stop = self.tour.as_ref().and_then(Tour::stop);
        if stop.is_some() {
            self.pupil.put_back();
        }
        let id = stop.map_or_else(|| Some(format!("said-{}", self.sessions + 1)), |stop| stop.id());
        let heard = self.pupil.hear(command, id, stop.map(|stop| &stop.exercise.intention))?;
        self.last = Some(command.to_owned());
        if heard == Reaction::Command {
            let read = words_read(command);
            self.words.hear(read);
            add_once(&mut self.said, read);
        }
        Ok(heard)
    }

    /// Records the intended task of the command under way: a task as in logs or in words, or the likeliest one. It goes to the log only;
    /// nothing is learned from it.
    pub fn mean(&mut self, task: Option<&str>) -> Result<Meaning, Failure> {
        if self.tour.as_ref().and_then(Tour::stop).is_some() {
            return Err(Failure::Input("in the tour the intended task is known".to_owned()));
        }
        // "a & b" and "b & a" are one task.
        let parts = |text: &str| text.split('&').map(|part| part.trim().to_owned()).collect::<std::collections::BTreeSet<_>>();
        let named = |meaning: &Meaning| task.is_none_or(|task| parts(&meaning.name) == parts(task) || meaning.words == task);
        let meanings = self.pupil.meanings();
        let Some(first) = meanings.first().map(|meaning| meaning.words.clone()) else {
            return Err(LiveError::NoSession.into());
        };
        let meant = meanings.into_iter().find(named).ok_or_else(|| {
            Failure::Input(format!(
                "{:?} is no task here; name one of the tasks that were told, such as: {first}",
                task.unwrap_or_default()
            ))
        })?;
        self.pupil.mean(meant.position);
        Ok(meant)
    }

    /// Hears the rest of the utterance after a session was learned from; `None` if there is no rest.
    pub fn hear_rest(&mut self) -> Result<Option<Reaction>, Failure> {
        self.pupil.hear_rest(Some(format!("said-{}", self.sessions + 1)))
    }

    /// Whether to ask before these words end the session under way: see [`Lesson::doubts`](goodbot_lesson::live::Lesson::doubts).
    pub fn doubts(&mut self, words: &str) -> Result<bool, Failure> {
        let is_test = self.tour.as_ref().and_then(Tour::stop).is_some_and(|stop| stop.test);
        Ok(!is_test && self.pupil.lesson.doubts(words)?)
    }

    /// The next lesson to teach.
    pub fn next_lesson(&self) -> Result<Next, Failure> {
        propose(&self.pupil, if self.wanted.is_empty() { &self.said } else { &self.wanted })
    }

    /// The result of the test whose command was heard last.
    pub fn tested(&self) -> Option<Tested> {
        self.tour.as_ref().and_then(Tour::stop).filter(|stop| stop.test)?;
        let heard = self.pupil.meanings().into_iter().next()?;
        let right = self.pupil.intended()? == heard.position;
        Some(Tested { heard, right })
    }

    /// Ends a test, and goes to the next.
    pub fn pass_test(&mut self, right: bool) -> Result<(), Failure> {
        self.pupil.forget();
        if let Some(tour) = &mut self.tour {
            tour.pass(right);
        }
        self.enter_tour()
    }

    /// Ends the session and begins to learn from it. Call [`learn`](Self::learn) until it is done. Returns how many older sessions gave way
    /// because memory was full; `None` if nothing was taught, so that there is nothing to learn.
    pub fn finish(&mut self) -> Result<Option<usize>, Failure> {
        let lesson = &self.pupil.lesson;
        if lesson.is_under_way() && !lesson.has_evidence() {
            self.pupil.lesson.pass_over();
            return Ok(None);
        }
        let before = self.pupil.save()?;
        let (record, finished) = self.pupil.finish()?;
        self.learning = Some((record, before));
        Ok(Some(finished.gave_way.count()))
    }

    /// Continues to learn. Returns `true` when learning is done. The model is then saved, and the tour continues.
    pub fn learn(&mut self, budget: u32) -> Result<bool, Failure> {
        if self.pupil.lesson.agent.learn(budget) != Progress::Done {
            return Ok(false);
        }
        let Some((record, before)) = self.learning.take() else { return Ok(true) };
        self.sessions += 1;
        let id = session(&record).header.id.clone();
        self.learned.push(id.clone());
        let kept = match &mut self.kept {
            Some(kept) => {
                let model = self.pupil.save()?;
                kept.keep(&record, Some(model))
            }
            None => {
                self.before.push(before);
                Ok(())
            }
        };
        if let Some(tour) = self.tour.as_mut().filter(|tour| tour.stop().is_some_and(|stop| stop.id() == id)) {
            tour.pass(true);
        }
        self.enter_tour()?;
        kept.map(|()| true)
    }

    /// Ends the session under way without learning from it. The log still gets it. Returns whether there was one.
    pub fn forget(&mut self) -> Result<bool, Failure> {
        let under_way = self.pupil.lesson.is_under_way();
        let testing = self.tour.as_ref().and_then(Tour::stop).is_some_and(|stop| stop.test);
        if let (Some(record), Some(kept), false) = (self.pupil.forget(), &mut self.kept, testing) {
            self.sessions += 1;
            kept.keep(&record, None)?;
        }
        Ok(under_way)
    }

    /// Ends the visit: learning is completed, and a session under way goes to the log.
    pub fn leave(&mut self) -> Result<(), Failure> {
        let learned = loop {
            match self.learn(u32::MAX) {
                Ok(false) => {}
                done => break done,
            }
        };
        let forgotten = self.forget();
        // A failed write is tried again: perhaps the disk has room now.
        let written = self.kept.as_mut().map_or(Ok(0), Kept::write_what_is_left);
        learned.and(forgotten)?;
        written.map(drop)
    }

    /// Whether a session of this visit can be unlearned.
    pub fn has_taught(&self) -> bool {
        !self.learned.is_empty()
    }

    /// Unlearns the last session of this visit. Returns `false` if there is none.
    pub fn unlearn(&mut self) -> Result<bool, Failure> {
        self.forget()?;
        let before = match &mut self.kept {
            Some(kept) => kept.take_back()?,
            None => self.before.pop().map(Some),
        };
        let Some(before) = before else { return Ok(false) };
        match before {
            Some(model) => self.pupil.restore(&model)?,
            None => self.pupil.start_anew()?,
        }
        let was = self.learned.pop().flatten();
        if let Some(tour) = self.tour.as_mut().filter(|_| was.is_some_and(|id| is_lesson(&id))) {
            tour.back();
        }
        self.enter_tour()?;
        Ok(true)
    }

    /// Begins another conversation, or continues one by its name. A session under way ends unlearned.
    pub fn converse(&mut self, id: Option<&str>) -> Result<(), Failure> {
        self.forget()?;
        match id {
            None => self.pupil.lesson.converse_anew(),
            Some(id) => self.pupil.lesson.converse(id)?,
        }
        Ok(())
    }

    /// Moves the robot to another home. A session under way ends unlearned.
    pub fn enter(&mut self, home: &EnvironmentFile) -> Result<(), Failure> {
        self.forget()?;
        self.pupil.enter(home)
    }
}
