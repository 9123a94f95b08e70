//! A visit on the screen: the effects of keys, and of time. This module knows neither a terminal nor a clock.

mod talking;
pub mod time;

use super::keys::Prompt;
use super::lessons::Next;
use crate::teach::classroom::{Classroom, Tested};
use crate::teach::keys::{Focus, Intent};
use crate::teach::lessons::{Stop, Tour, random_home};
use crate::teach::pupil::{Acted, Reaction, WordSupport};
use crate::words::percent;
use goodbot::asking::{Answer, Asking};
use goodbot::capacity::WORDS_PER_COMMAND;
use goodbot::feedback::Feedback;
use goodbot::planning::Judgement;
use goodbot::session::Evidence;
use goodbot_console::{Failure, counted};
use std::time::Duration;
use time::Pace;

/// The work between two checks of the keyboard.
const PLAN_BUDGET: u32 = 20_000;
const LEARN_BUDGET: u32 = 60_000;
/// How long feedback can still be corrected, if the robot waits for it.
const SECOND_THOUGHTS: Duration = Duration::from_millis(450);
/// How long the result of a test is shown.
const RESULT_STANDS: Duration = Duration::from_millis(1_500);

/// The phases of a visit.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Phase {
    /// The visit waits for a command.
    Idle,
    /// The robot makes its plan.
    Planning,
    /// The robot waits for feedback, until this time; `None` waits without a limit.
    Waiting(Option<Duration>),
    /// The robot learns.
    Learning,
}

/// A page that covers the screen.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Page {
    /// The explanation of the screen, and the keys.
    Explanation,
    /// The words for each machine token.
    Words,
}

/// A visit.
pub struct Visit {
    /// The robot, its files and the tour.
    pub classroom: Classroom,
    /// The command that is being written.
    pub prompt: Prompt,
    /// How fast the robot goes.
    pub pace: Pace,
    /// The page that covers the screen, and its first line.
    pub page: Option<(Page, u16)>,
    /// The message to the trainer.
    pub message: String,
    /// The support of each word in the last command.
    pub support: Vec<WordSupport>,
    /// Whether the robot is paused.
    pub paused: bool,
    /// Whether a simulated trainer judges.
    pub auto: bool,
    /// Whether the visit is over.
    pub left: bool,
    phase: Phase,
    typing: bool,
    tested: Option<Tested>,
    stepping: bool,
    rests: u8,
    word_at: Option<Duration>,
    homes: u64,
    /// How many older sessions gave way to the present one.
    gave_way: usize,
}

impl Visit {
    /// Begins a visit.
    pub fn new(classroom: Classroom, pace: Pace, seed: u64) -> Self {
        let mut visit = Self {
            classroom,
            prompt: Prompt::default(),
            pace,
            page: None,
            message: String::new(),
            support: Vec::new(),
            paused: false,
            auto: false,
            left: false,
            phase: Phase::Idle,
            typing: true,
            tested: None,
            stepping: false,
            rests: 0,
            gave_way: 0,
            word_at: None,
            homes: seed,
        };
        let learned = visit.classroom.pupil.lessons_learned();
        visit.idle(if learned == 0 {
            String::new()
        } else {
            format!("Here it is again. It has learned from {}.", counted(learned, "session"))
        });
        visit
    }

    /// The present phase.
    pub const fn phase(&self) -> Phase {
        self.phase
    }

    /// The part of the screen that gets the keys.
    pub fn focus(&self) -> Focus {
        match self.page {
            Some(_) => Focus::Page,
            None if self.typing && self.phase != Phase::Learning => Focus::Command,
            None => Focus::Keys,
        }
    }

    /// The tour's current lesson or test.
    pub fn stop(&self) -> Option<Stop> {
        self.classroom.tour.as_ref().and_then(Tour::stop)
    }

    /// The result of the test under way.
    pub const fn tested(&self) -> Option<&Tested> {
        self.tested.as_ref()
    }

    /// The robot's last step.
    pub fn acted(&self) -> Option<&Acted> {
        self.classroom.pupil.lesson.acted()
    }

    /// The judged steps of the session.
    pub fn done(&self) -> impl ExactSizeIterator<Item = (Feedback, &[Judgement])> {
        self.classroom.pupil.lesson.done()
    }

    /// The time of the next event; zero if there is work to do.
    pub fn next(&self) -> Option<Duration> {
        match self.phase {
            Phase::Planning | Phase::Learning => Some(Duration::ZERO),
            Phase::Waiting(until) if !self.holds() => [until, self.word_at].into_iter().flatten().min(),
            Phase::Idle | Phase::Waiting(_) => None,
        }
    }

    fn idle(&mut self, message: String) {
        (self.phase, self.typing, self.paused, self.auto) = (Phase::Idle, true, false, false);
        (self.tested, self.stepping, self.rests, self.word_at) = (None, false, 0, None);
        self.message = message;
        self.prompt.set(self.stop().map_or("", |stop| stop.exercise.command));
        if self.classroom.tour.is_some() && self.stop().is_none() {
            let score = self.classroom.tour.as_ref().map_or_else(String::new, Tour::score);
            self.message =
                format!("{} The tour is over: {score}. Say what you like now; esc, then q leaves.", self.message).trim().to_owned();
        }
    }

    /// Writes a pasted text.
    pub fn paste(&mut self, text: &str) {
        if self.focus() == Focus::Command {
            text.chars().map(|letter| if letter.is_control() { ' ' } else { letter }).for_each(|letter| self.prompt.write(letter));
        }
    }

    /// Handles an intent, at a time since the visit began.
    pub fn take(&mut self, intent: Intent, now: Duration) {
        if let Err(refusal) = self.obey(intent, now) {
            self.message = sentence(&refusal.to_string());
        }
    }

    fn obey(&mut self, intent: Intent, now: Duration) -> Result<(), Failure> {
        let in_session = self.classroom.pupil.lesson.is_under_way();
        match intent {
            Intent::Leave => self.left = true,
            Intent::Explain => self.page = Some((Page::Explanation, 0)),
            Intent::Words => self.page = Some((Page::Words, 0)),
            Intent::Scroll(lines) => {
                self.page = self.page.map(|(page, first)| (page, first.saturating_add_signed(lines)));
            }
            Intent::ToKeys => {
                if self.page.take().is_none() {
                    self.typing = false;
                }
                self.wait_anew(now);
            }
            Intent::ToCommand if self.tested.is_some() => self.pass_test()?,
            Intent::ToCommand => {
                self.typing = true;
                if in_session {
                    self.prompt.set("");
                    self.message = "It waits. Say good or bad, yes or no, stop, undo, what you meant, or something else to do.".to_owned();
                }
            }
            Intent::Write(letter) => self.prompt.write(letter),
            Intent::Edit(edit) if self.focus() == Focus::Command => self.prompt.edit(edit),
            Intent::Say => self.say(now)?,
            Intent::Pace => {
                self.pace = self.pace.next();
                self.message = format!("Speed: {}.", self.pace.name());
                self.wait_anew(now);
            }
            Intent::Undo => self.undo()?,
            Intent::NextLesson | Intent::AnotherHome | Intent::PutBack if in_session || self.phase == Phase::Learning => {
                self.message = "First end this session: f finishes and learns, d finishes without learning.".to_owned();
            }
            Intent::NextLesson if self.stop().is_some() => self.message = "In the tour the lessons are given.".to_owned(),
            Intent::NextLesson => self.propose()?,
            Intent::AnotherHome if self.stop().is_some() => self.message = "In the tour the homes are given.".to_owned(),
            Intent::AnotherHome if self.classroom.pupil.is_in_world() => {
                self.message = "This robot is in a world from a file. Leave, and start it with another file.".to_owned();
            }
            Intent::AnotherHome => {
                self.homes = self.homes.wrapping_add(1);
                let home = random_home(self.homes).ok_or_else(|| Failure::Input("no home could be drawn".to_owned()))?;
                self.classroom.enter(&home)?;
                self.message = "Another home.".to_owned();
            }
            Intent::PutBack => {
                self.classroom.pupil.put_back();
                self.message = "Everything is back where it was.".to_owned();
            }
            Intent::Good => self.judge(Feedback::Reward, now)?,
            Intent::Bad => self.judge(Feedback::Punish, now)?,
            Intent::Silence => self.silence(now)?,
            _ if !in_session => self.message = "Nothing is under way; press enter and say what to do.".to_owned(),
            Intent::Pause => {
                self.paused = !self.paused;
                self.message = if self.paused { "Paused: o takes one step, p goes on." } else { "" }.to_owned();
                if let (false, Phase::Waiting(_)) = (self.paused, self.phase) {
                    self.phase = Phase::Waiting(Some(now));
                }
            }
            Intent::Yes => self.answer(Answer::Yes)?,
            Intent::Choose(number) => self.answer(Answer::This(number.saturating_sub(1)))?,
            Intent::No => self.answer(Answer::No)?,
            Intent::Meant => {
                let meant = self.classroom.mean(None)?;
                self.message = format!("Noted in the log, and never learned from: you mean \"{}\".", meant.words);
            }
            Intent::Step if self.tested.is_some() => self.pass_test()?,
            Intent::Step => {
                self.paused = self.pace != Pace::Step;
                self.go_on()?;
                self.stepping = true;
            }
            Intent::Finish if self.tested.is_some() => self.message = "A test is not learned from; enter goes on.".to_owned(),
            Intent::Finish => self.finish()?,
            Intent::Drop => {
                self.classroom.forget()?;
                self.idle("Finished without learning: it knows what it knew before.".to_owned());
            }
            Intent::Auto if self.tested.is_some() || self.classroom.pupil.intended().is_none() => {
                self.message =
                    "A simulated trainer judges only where it knows the intended task: in lessons of the tour, and after m.".to_owned();
            }
            Intent::Auto => {
                self.auto = !self.auto;
                self.paused = false;
                self.message = if self.auto { "A simulated trainer judges; a stops it." } else { "You judge again." }.to_owned();
                if let (true, Phase::Waiting(_)) = (self.auto, self.phase) {
                    self.word_at = Some(now);
                    self.phase = Phase::Waiting(Some(now + SECOND_THOUGHTS));
                }
            }
            Intent::Suspend | Intent::Redraw | Intent::Edit(_) => {}
        }
        Ok(())
    }

    /// Writes the proposed lesson, goes to its home, and gives the reason.
    fn propose(&mut self) -> Result<(), Failure> {
        self.message = match self.classroom.next_lesson()? {
            Next::NothingWanted => "Teach it something first. Then this proposes the lesson that teaches it most.".to_owned(),
            Next::LittleLeft => "It has heard every word of these commands often. There is little left to teach.".to_owned(),
            Next::Lesson(proposal) => {
                if let Some(home) = &proposal.home {
                    self.classroom.enter(home)?;
                }
                self.typing = true;
                self.prompt.set(&proposal.command);
                sentence(&format!("to teach next, as {}", proposal.reason()))
            }
        };
        Ok(())
    }

    /// Says a command.
    fn command(&mut self, command: &str) -> Result<(), Failure> {
        let heard = self.classroom.say(command)?;
        if heard != Reaction::Command {
            // The session before is over.
            self.phase = Phase::Idle;
            self.message = talking::declined(&heard);
            return Ok(());
        }
        self.prompt.said();
        self.begin()?;
        if self.classroom.pupil.unread > 0 {
            self.message = format!("It reads the first {WORDS_PER_COMMAND} words of that. Say it in parts.");
        }
        self.tested = self.classroom.tested();
        if let Some(Tested { heard, right }) = &self.tested {
            let verdict = if *right { "Right!" } else { "That is not what was meant." };
            self.message = format!("It takes this for \"{}\", {}. {verdict}", heard.words, percent(heard.probability));
        }
        Ok(())
    }

    /// Begins a session.
    fn begin(&mut self) -> Result<(), Failure> {
        self.support = self.classroom.pupil.word_support()?;
        (self.phase, self.message, self.rests) = (Phase::Planning, String::new(), 0);
        (self.typing, self.paused, self.stepping, self.word_at) = (false, false, false, None);
        Ok(())
    }

    /// Whether the robot is paused, or the trainer is writing or reading a page that hides what the robot does and asks.
    const fn holds(&self) -> bool {
        self.paused || self.typing || self.page.is_some()
    }

    /// Gives the trainer the whole time again to judge the last step. A robot that was held before its step takes it.
    fn wait_anew(&mut self, now: Duration) {
        if matches!(self.phase, Phase::Waiting(_)) {
            self.phase = Phase::Waiting(self.acted().map_or(Some(Duration::ZERO), |acted| self.wait(acted)).map(|wait| now + wait));
        }
    }

    /// Gives feedback to the last step, if it can be judged.
    fn judge(&mut self, feedback: Feedback, now: Duration) -> Result<(), Failure> {
        if self.tested.is_some() {
            self.message = "This is a test: it hears no good and no bad. Enter goes on.".to_owned();
            return Ok(());
        }
        let Some(acted) = self.acted() else {
            self.message = if self.phase == Phase::Planning {
                "It is making its plan; judge its next step."
            } else {
                "There is no step to judge yet."
            }
            .to_owned();
            return Ok(());
        };
        let waits = self.wait(acted).is_none();
        match self.classroom.pupil.lesson.judge(feedback)? {
            Evidence::Impossible => self.message = "Your word is impossible under every task, so it was not counted.".to_owned(),
            Evidence::Uninformative => self.message = "Its plan here is not exact, so your word tells it nothing.".to_owned(),
            Evidence::Used => self.message.clear(),
        }
        if let (true, Phase::Waiting(_)) = (waits, self.phase) {
            self.phase = Phase::Waiting(Some(now + SECOND_THOUGHTS));
        }
        Ok(())
    }

    /// Answers the robot's question.
    fn answer(&mut self, answer: Answer) -> Result<(), Failure> {
        if self.classroom.pupil.open_question().is_none() {
            self.message = "It has asked nothing. It asks where an answer would tell it more than its next steps.".to_owned();
            return Ok(());
        }
        let _ = self.classroom.pupil.lesson.answer(answer)?;
        self.message = "It takes your answer into account.".to_owned();
        Ok(())
    }

    /// Asks a question if it teaches more than the next steps do. The robot does not wait for the answer.
    fn ask(&mut self) -> Result<(), Failure> {
        if self.auto || self.tested.is_some() {
            return Ok(());
        }
        if let Some(asks) = self.classroom.pupil.ask(&Asking::DEFAULT)? {
            let choices: Vec<String> = asks.choices.iter().zip(1..).map(|(choice, number)| format!("{number} {choice}")).collect();
            self.message = if choices.is_empty() {
                format!("It asks: {} y yes, n no.", asks.text)
            } else {
                format!("It asks: {} {}, n none of these.", asks.text, choices.join(", "))
            };
        }
        Ok(())
    }

    fn silence(&mut self, now: Duration) -> Result<(), Failure> {
        self.judge(Feedback::Neutral, now)?;
        if let (Phase::Waiting(_), None) = (self.phase, &self.tested) {
            self.phase = Phase::Waiting(Some(now));
        }
        Ok(())
    }

    /// How long the robot waits after a step. At its goal it waits for feedback without a limit.
    fn wait(&self, acted: &Acted) -> Option<Duration> {
        let longest = Duration::from_millis(2_600);
        match () {
            () if self.tested.is_some() && acted.plan.onward().is_none() => Some(RESULT_STANDS),
            () if self.tested.is_some() || self.auto => Some(self.pace.wait(acted.confidence).unwrap_or(longest)),
            () if acted.plan.onward().is_none() => None,
            () => self.pace.wait(acted.confidence),
        }
    }

    fn undo(&mut self) -> Result<(), Failure> {
        if self.phase == Phase::Learning || self.tested.is_some() {
            self.message = "Wait until this is over.".to_owned();
        } else if self.classroom.pupil.lesson.is_under_way() {
            (self.paused, self.auto, self.word_at) = (true, false, None);
            let taken = self.classroom.pupil.lesson.take_back()?;
            self.message =
                if taken { "One step back. o takes the next step, p goes on." } else { "There is no step to take back." }.to_owned();
            if taken {
                (self.phase, self.stepping) = (Phase::Planning, false);
            }
        } else if self.classroom.unlearn()? {
            self.support.clear();
            let learned = counted(self.classroom.pupil.lessons_learned(), "session");
            self.idle(format!("The last session is forgotten. It knows what it learned from {learned}."));
        } else {
            self.message = "Nothing was learned since you came; there is nothing to take back.".to_owned();
        }
        Ok(())
    }

    fn go_on(&mut self) -> Result<(), Failure> {
        let rested = self.acted().map(|acted| acted.action == "noop");
        self.classroom.pupil.lesson.go_on()?;
        match rested {
            Some(true) => self.rests = self.rests.saturating_add(1),
            Some(false) => self.rests = 0,
            None => {}
        }
        self.phase = Phase::Planning;
        Ok(())
    }

    fn finish(&mut self) -> Result<(), Failure> {
        let Some(gave_way) = self.classroom.finish()? else {
            const NOTHING: &str = "Nothing to learn from: no step was taken.";
            if !self.go_on_with_the_rest(NOTHING)? {
                self.idle(NOTHING.to_owned());
            }
            return Ok(());
        };
        self.gave_way = gave_way;
        (self.phase, self.message) = (Phase::Learning, "It learns …".to_owned());
        Ok(())
    }

    fn pass_test(&mut self) -> Result<(), Failure> {
        let Some(Tested { heard, right }) = self.tested.take() else { return Ok(()) };
        self.classroom.pass_test(right)?;
        let verdict = if right { "Right: it understood" } else { "Wrong: it took it for" };
        self.idle(format!("{verdict} \"{}\".", heard.words));
        Ok(())
    }
}

fn sentence(text: &str) -> String {
    let mut letters = text.chars();
    letters.next().map_or_else(String::new, |first| format!("{}{}.", first.to_uppercase(), letters.as_str()))
}
