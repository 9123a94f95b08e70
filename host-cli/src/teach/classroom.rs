//! A robot, what is kept of it, and the tour: what one visit is about, whether it is seen on a screen or told in lines.

use super::full_words::FullWords;
use super::kept::{Kept, Past};
use super::lessons::{Tour, is_lesson};
use super::next_lesson::{Next, propose};
use super::pupil::{Heard, Meaning, Pupil};
use super::site::{Recorded, Site, session};
use goodbot_console::outcome::Failure;
use goodbot_formats::environment::EnvironmentFile;
use goodbot_lesson::first_words::words_read;
use goodbot_lesson::live::Lesson;

/// A robot, what is kept of it, and the tour.
pub struct Classroom {
    /// The robot in its home.
    pub pupil: Pupil,
    /// The tour, if it is one.
    pub tour: Option<Tour>,
    /// The words that were said.
    pub words: FullWords,
    /// What it is to understand in the end; where nothing is given, what was said so far.
    pub wanted: Vec<String>,
    /// The commands that were said, each once.
    said: Vec<String>,
    /// What was said last, as a command.
    last: Option<String>,
    kept: Option<Kept>,
    /// What the robot knew before each session of a visit, if nothing is kept.
    before: Vec<Vec<u8>>,
    learning: Option<(Recorded, Vec<u8>)>,
    /// The names of the sessions that were learned from in this visit.
    learned: Vec<Option<String>>,
    sessions: usize,
}

/// What the robot takes the command of a test to mean.
#[derive(Clone, Debug, PartialEq)]
pub struct Tested {
    /// The likeliest task.
    pub heard: Meaning,
    /// Whether that is what was meant.
    pub right: bool,
}

fn add_once(said: &mut Vec<String>, command: &str) {
    if !said.iter().any(|other| other == command) {
        said.push(command.to_owned());
    }
}

impl Classroom {
    /// A robot as its files have it. With a tour, it is in the tour's home.
    pub fn new(mut pupil: Pupil, kept: Option<(Kept, Past)>, tour: Option<Tour>) -> Result<Self, Failure> {
        let mut words = FullWords::new(pupil.word_letters());
        let (mut sessions, mut said) = (0, Vec::new());
        let kept = match kept {
            None => None,
            Some((kept, past)) => {
                if let Some(model) = &past.model {
                    let name = kept.places().model.display();
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

    /// Where the robot is kept.
    pub fn kept(&self) -> Option<&Kept> {
        self.kept.as_ref()
    }

    /// Says a command. In the tour everything is put back before, and what is meant is known.
    pub fn say(&mut self, command: &str) -> Result<Heard, Failure> {
        self.forget()?;
        let stop = self.tour.as_ref().and_then(Tour::stop);
        if stop.is_some() {
            self.pupil.put_back();
        }
        let id = stop.map_or_else(|| Some(format!("said-{}", self.sessions + 1)), |stop| stop.id());
        let heard = self.pupil.hear(command, id, stop.map(|stop| &stop.exercise.intention))?;
        self.last = Some(command.to_owned());
        if heard == Heard::Command {
            let read = words_read(command);
            self.words.hear(read);
            add_once(&mut self.said, read);
        }
        Ok(heard)
    }

    /// Notes what the trainer means by the command under way: a task as logs write it or in words, or else the likeliest. The log tells it;
    /// nothing is learned from it.
    pub fn mean(&mut self, task: Option<&str>) -> Result<Meaning, Failure> {
        if self.tour.as_ref().and_then(Tour::stop).is_some() {
            return Err(Failure::Input("in the tour the intended task is known".to_owned()));
        }
        let named = |meaning: &Meaning| task.is_none_or(|task| meaning.name == task || meaning.words == task);
        let meanings = self.pupil.meanings();
        let Some(first) = meanings.first().map(|meaning| meaning.words.clone()) else {
            return Err(Failure::Input("no session is under way; give a command first".to_owned()));
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

    /// Hears the rest of the utterance, once a part is over and learned from; `None` if there is no rest.
    pub fn hear_rest(&mut self) -> Result<Option<Heard>, Failure> {
        self.pupil.hear_rest(Some(format!("said-{}", self.sessions + 1)))
    }

    /// What was said last, as a command.
    pub fn last(&self) -> Option<&str> {
        self.last.as_deref()
    }

    /// What to teach next.
    pub fn next_lesson(&self) -> Result<Next, Failure> {
        propose(&self.pupil, if self.wanted.is_empty() { &self.said } else { &self.wanted })
    }

    /// The result of a test whose command has just been heard.
    pub fn tested(&self) -> Option<Tested> {
        self.tour.as_ref().and_then(Tour::stop).filter(|stop| stop.test)?;
        let heard = self.pupil.meanings().into_iter().next()?;
        let right = self.pupil.intended()? == heard.position;
        Some(Tested { heard, right })
    }

    /// A test is over: on to the next.
    pub fn pass_test(&mut self, right: bool) -> Result<(), Failure> {
        self.pupil.forget();
        if let Some(tour) = &mut self.tour {
            tour.pass(right);
        }
        self.enter_tour()
    }

    /// Ends the session and begins to learn from it: [`learn`](Self::learn) until that is done. Gives how many older sessions gave way
    /// because memory was full.
    pub fn finish(&mut self) -> Result<usize, Failure> {
        let before = self.pupil.save()?;
        let (record, finished) = self.pupil.finish()?;
        self.learning = Some((record, before));
        Ok(finished.gave_way.count())
    }

    /// Goes on learning. Gives whether it is done; what was learned is then kept, and the tour goes on.
    pub fn learn(&mut self, budget: u32) -> Result<bool, Failure> {
        if !self.pupil.learn(budget) {
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

    /// Ends the session under way without learning from it; it is written to the log all the same. Gives whether there was one.
    pub fn forget(&mut self) -> Result<bool, Failure> {
        let under_way = self.pupil.lesson().is_under_way();
        let testing = self.tour.as_ref().and_then(Tour::stop).is_some_and(|stop| stop.test);
        if let (Some(record), Some(kept), false) = (self.pupil.forget(), &mut self.kept, testing) {
            self.sessions += 1;
            kept.keep(&record, None)?;
        }
        Ok(under_way)
    }

    /// The visit is over: what was being learned is learned to its end, and a session under way is written down.
    pub fn leave(&mut self) -> Result<(), Failure> {
        let learned = loop {
            match self.learn(u32::MAX) {
                Ok(false) => {}
                done => break done,
            }
        };
        let forgotten = self.forget();
        // What could not be written is tried once more: perhaps there is room again.
        let written = self.kept.as_mut().map_or(Ok(0), Kept::write_what_is_left);
        learned.and(forgotten)?;
        written.map(drop)
    }

    /// Whether a session of this visit taught something that can be taken back.
    pub fn has_taught(&self) -> bool {
        !self.learned.is_empty()
    }

    /// Takes back what the last session of this visit taught. Gives `false` where there is none.
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

    /// Begins another conversation, or goes on with one, by its name. A session under way ends unlearned.
    pub fn converse(&mut self, id: Option<&str>) -> Result<(), Failure> {
        self.forget()?;
        self.pupil.converse(id)
    }

    /// Moves the robot to another home. A session under way ends unlearned.
    pub fn enter(&mut self, home: &EnvironmentFile) -> Result<(), Failure> {
        self.forget()?;
        self.pupil.enter(home)
    }

    /// The robot, its home and the session under way.
    pub const fn lesson(&self) -> &Lesson<Site> {
        self.pupil.lesson()
    }
}
