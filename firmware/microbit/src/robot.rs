//! The robot: its work, and people's requests. The work goes in small parts, so that buttons and lights never wait for long.

use crate::buttons::Press;
use crate::lights::{DARK, Picture};
use crate::memory::{Agent, Builder, CAPACITIES, Home, Rooms};
use crate::request::{self, HELP, Request};
use crate::serial::{print, print_digits, print_number, say};
use crate::{flash, house, picture, stack};
use goodbot::capacity::Capacity;
use goodbot::feedback::Feedback;
use goodbot::home::{HomeState, Moves, Problem, SCHEMA, paper_tasks};
use goodbot::oomdp::{Action, action_name, action_named};
use goodbot::planning::Progress;
use goodbot::session::{Evidence, Phase};
use goodbot::{AgentError, Options};
use rand_pcg::Pcg32;

/// Milliseconds from one action to the next.
const PACE: u32 = 1_500;
/// How long a sign is shown.
const SIGN: u32 = 500;
/// The budget of one part of the work: at most about ten milliseconds.
const PLAN: u32 = 50;
const LEARN: u32 = 100;
/// Bytes of the model on one line.
const MODEL_LINE: usize = 32;

/// Where the robot is.
enum Place {
    Here {
        home: Home,
        state: HomeState,
        start: HomeState,
    },
    Described(Builder),
    Nowhere(Rooms),
    /// Between two of the others.
    Moving,
}

/// The robot's current work.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Doing {
    Nothing,
    Hearing,
    Planning,
    /// It has a plan, and acts when it is time.
    Waiting,
    Finishing,
    /// Learning, from a lesson or from the stored model.
    Learning {
        store: bool,
    },
    Storing,
    /// Printing the model.
    Printing,
}

/// A picture or a text on the lights, in place of the home.
#[derive(Clone, Copy)]
enum Sign {
    Picture(&'static Picture, u32),
    Text(&'static str, u32),
}

pub struct Robot<'a> {
    agent: &'a mut Agent,
    place: Place,
    doing: Doing,
    /// Whether a request waits for the work to be done.
    asked: bool,
    pace: u32,
    act_at: u32,
    next: usize,
    sign: Option<Sign>,
    random: Pcg32,
}

impl<'a> Robot<'a> {
    /// The robot in its own home, with nothing learned.
    #[inline(never)]
    pub fn new(agent: &'a mut Agent, rooms: Rooms) -> Self {
        let mut robot = Self {
            agent,
            place: Place::Nowhere(rooms),
            doing: Doing::Nothing,
            asked: false,
            pace: PACE,
            act_at: 0,
            next: 0,
            sign: None,
            random: Pcg32::new(1, 1),
        };
        if let Err(problem) = robot.forget_all().and_then(|()| robot.go_home()) {
            say(&["error: ", problem]);
        }
        robot
    }

    /// Restores the stored model. The robot must work on until it is trained.
    pub fn remember(&mut self) {
        match flash::restore(self.agent) {
            Ok(0) => say(&["nothing is stored"]),
            Ok(bytes) => {
                print("stored: ");
                print_number(bytes as i32);
                say(&[" bytes"]);
                self.doing = Doing::Learning { store: false };
            }
            Err(problem) => say(&["error: ", problem, "; say `forget` to begin anew"]),
        }
    }

    /// Whether it can take a request now; until then lines wait.
    pub fn listens(&self) -> bool {
        !self.asked && matches!(self.doing, Doing::Nothing | Doing::Waiting)
    }

    /// The picture for the lights.
    pub fn shows(&self, now: u32) -> Picture {
        if let Doing::Finishing | Doing::Learning { .. } = self.doing {
            return picture::work(now);
        }
        match (self.sign, &self.place) {
            (Some(Sign::Picture(picture, until)), _) if until.wrapping_sub(now) <= SIGN => *picture,
            (Some(Sign::Text(text, since)), place) => match picture::text(text, now.wrapping_sub(since)) {
                Some(picture) => picture,
                None => home_of(place, now),
            },
            (_, place) => home_of(place, now),
        }
    }

    /// Takes a press of the buttons.
    pub fn pressed(&mut self, press: Press, now: u32) {
        let request = match press {
            Press::A => Request::Bad,
            Press::B => Request::Good,
            Press::Both => Request::Finish,
            Press::Long => {
                // After lessons over the serial line, the robot acts by itself again.
                self.pace = if self.pace == 0 { PACE } else { self.pace };
                Request::Next
            }
        };
        // A word about the last action may come while the robot plans.
        if self.listens() || (self.doing == Doing::Planning && matches!(press, Press::A | Press::B)) {
            self.report(request, now);
        } else {
            say(&["error: the robot is at work; press again when it is done"]);
        }
    }

    /// Does a request, and answers `ok` when it is done, or the error.
    pub fn asked(&mut self, request: Result<Request<'_>, &'static str>, now: u32) {
        match request {
            Ok(request) => {
                self.asked = true;
                self.report(request, now);
                // If work has begun, the answer comes at its end.
                if self.doing == Doing::Nothing || self.doing == Doing::Waiting {
                    self.answer();
                }
            }
            Err(problem) => say(&["error: ", problem]),
        }
    }

    fn answer(&mut self) {
        if core::mem::take(&mut self.asked) {
            say(&["ok"]);
        }
    }

    fn report(&mut self, request: Request<'_>, now: u32) {
        if let Err(problem) = self.does(request, now) {
            self.asked = false;
            say(&["error: ", problem]);
        }
    }

    #[inline(never)]
    fn does(&mut self, request: Request<'_>, now: u32) -> Result<(), &'static str> {
        match request {
            Request::Help => HELP.iter().for_each(|line| say(&[line])),
            Request::Say(words) => self.hear(words, now)?,
            Request::Act(name) => return self.act(name, now),
            Request::Good => return self.judge(Feedback::Reward, now),
            Request::Bad => return self.judge(Feedback::Punish, now),
            Request::Finish => {
                let Place::Here { home, .. } = &self.place else { return Err(NO_HOME) };
                self.agent.begin_finishing(home).map_err(text)?;
                self.doing = Doing::Finishing;
            }
            Request::Next => {
                let command;
                (command, self.next) = house::command(self.next);
                say(&["next: ", command]);
                self.start_again()?;
                self.hear(command, now)?;
                self.sign = Some(Sign::Text(command, now));
                self.act_at = now.wrapping_add(picture::duration(command));
            }
            Request::Believe => self.tell(false)?,
            Request::Pace(pace) => (self.pace, self.act_at) = (pace, now.wrapping_add(pace)),
            Request::Again => self.start_again()?,
            Request::Home => self.go_home()?,
            Request::Begin => self.begin()?,
            Request::Room(..) | Request::Door(..) | Request::Block(..) | Request::Agent(..) => self.describe(request)?,
            Request::Build => self.build()?,
            Request::Forget => {
                flash::erase()?;
                self.forget_all()?;
            }
            Request::Memory => {
                for (name, bytes) in [("statics ", stack::statics()), ("deepest stack ", stack::deepest()), ("stack ", stack::whole())] {
                    print(name);
                    print_number(bytes as i32);
                    say(&[""]);
                }
                self.tell_usage();
            }
            Request::Model if self.doing == Doing::Waiting => return Err("a lesson is under way; say `finish` or `again` first"),
            Request::Model => self.doing = Doing::Printing,
        }
        Ok(())
    }

    /// Prints how full each table was at most, and how large it is.
    #[inline(never)]
    fn tell_usage(&self) {
        let used = self.agent.most_used();
        for &capacity in Capacity::ALL.iter().filter(|&&capacity| used.get(capacity) > 0) {
            print(capacity.name());
            print(" ");
            print_number(used.get(capacity) as i32);
            print(" of ");
            print_number(CAPACITIES.get(capacity) as i32);
            say(&[""]);
        }
    }

    /// Does one part of the work.
    #[inline(never)]
    pub fn work(&mut self, now: u32) {
        if let Err(problem) = self.work_on(now) {
            self.doing = Doing::Nothing;
            self.asked = false;
            say(&["error: ", problem]);
        }
    }

    fn work_on(&mut self, now: u32) -> Result<(), &'static str> {
        let Place::Here { home, state, .. } = &self.place else { return self.learn() };
        match self.doing {
            Doing::Nothing | Doing::Storing | Doing::Printing => {}
            Doing::Hearing => {
                if self.agent.hear_on(home, 1).map_err(text)? == Progress::Done {
                    self.doing = Doing::Planning;
                }
            }
            Doing::Planning => {
                if self.agent.plan(home, state, PLAN).map_err(text)? == Progress::Done {
                    self.doing = Doing::Waiting;
                    self.tell(true)?;
                    self.answer();
                }
            }
            Doing::Waiting => {
                if self.pace > 0 && now.wrapping_sub(self.act_at) < u32::MAX / 2 {
                    self.act(None, now)?;
                }
            }
            Doing::Finishing => {
                if let Some(finished) = self.agent.finish_on(home, 1).map_err(text)? {
                    if finished.gave_way.count() > 0 {
                        print_number(finished.gave_way.count() as i32);
                        say(&[" older lessons gave way to this one"]);
                    }
                    self.doing = Doing::Learning { store: true };
                }
            }
            Doing::Learning { .. } => return self.learn(),
        }
        Ok(())
    }

    #[inline(never)]
    fn learn(&mut self) -> Result<(), &'static str> {
        let Doing::Learning { store } = self.doing else { return Ok(()) };
        if self.agent.learn(LEARN) == Progress::Working {
            return Ok(());
        }
        self.doing = if store { Doing::Storing } else { Doing::Nothing };
        print("lessons ");
        print_number(self.agent.language().bitext().sessions() as i32);
        say(&[""]);
        Ok(())
    }

    /// Stores or prints the model if that is due. Apart from other work: it takes as much of the stack.
    #[inline(never)]
    pub fn store(&mut self) {
        let stored = match self.doing {
            Doing::Storing => flash::store(self.agent).map(|bytes| {
                print("stored ");
                print_number(bytes as i32);
                say(&[" bytes"]);
            }),
            Doing::Printing => flash::written(self.agent).map(|model| model.chunks(MODEL_LINE).for_each(print_digits)),
            _ => return,
        };
        self.doing = Doing::Nothing;
        match stored {
            Ok(()) => self.answer(),
            Err(problem) => {
                self.asked = false;
                say(&["error: ", problem]);
            }
        }
    }

    #[inline(never)]
    fn hear(&mut self, words: &str, now: u32) -> Result<(), &'static str> {
        let Place::Here { home, state, .. } = &self.place else { return Err(NO_HOME) };
        self.agent.begin_hearing(home, state, words).map_err(text)?;
        (self.doing, self.sign, self.act_at) = (Doing::Hearing, None, now.wrapping_add(self.pace));
        Ok(())
    }

    #[inline(never)]
    fn act(&mut self, name: Option<&str>, now: u32) -> Result<(), &'static str> {
        let Place::Here { home, state, .. } = &mut self.place else { return Err(NO_HOME) };
        let action = match name {
            None => self.agent.decide_with(home, state, &mut self.random).map_err(text)?.action,
            Some(name) => action_named(home, name).ok_or("there is no such action; say north, east, south, west or noop")?,
        };
        *state = self.agent.acted(home, state, action).map_err(text)?;
        self.doing = Doing::Planning;
        self.act_at = now.wrapping_add(self.pace);
        print("did ");
        print(if action == Action::NOOP { "nothing" } else { action_name(home, action) });
        for &thing in [home.agent()].iter().chain(home.blocks()) {
            let cell = if thing == home.agent() { Some(home.agent_cell(state)) } else { home.block_cell(state, thing) };
            let Some(cell) = cell else { continue };
            print("; ");
            print(home.objects().name(thing));
            print(" ");
            print_number(cell.x);
            print(" ");
            print_number(cell.y);
        }
        say(&[""]);
        Ok(())
    }

    fn judge(&mut self, feedback: Feedback, now: u32) -> Result<(), &'static str> {
        let evidence = self.agent.feedback(feedback).map_err(text)?;
        let (word, sign) = if feedback == Feedback::Reward { ("good", &picture::GOOD) } else { ("bad", &picture::BAD) };
        self.sign = Some(Sign::Picture(sign, now.wrapping_add(SIGN)));
        say(&[word, if evidence == Evidence::Used { "" } else { ": that says nothing about the last action" }]);
        Ok(())
    }

    /// Prints the most likely task of the command, or all its tasks.
    #[inline(never)]
    fn tell(&self, most_likely: bool) -> Result<(), &'static str> {
        let Place::Here { home, .. } = &self.place else { return Err(NO_HOME) };
        for (position, task) in self.agent.tasks().iter().enumerate() {
            if most_likely && self.agent.most_likely() != Some(position) {
                continue;
            }
            let Some(lifted) = self.agent.lifted().get(usize::from(task.lifted)) else { continue };
            print("believes ");
            print_number((100.0 * self.agent.belief().probability(position)) as i32);
            print(" % ");
            for (number, part) in task.propositions(lifted).enumerate() {
                print(if number == 0 { "" } else { " & " });
                print(SCHEMA.proposition_name(part.proposition));
                for (number, (object, _)) in part.arguments.iter().zip(SCHEMA.parameters(part.proposition)).enumerate() {
                    print(if number == 0 { "(" } else { "," });
                    print(home.objects().name(*object));
                }
                print(")");
            }
            say(&[""]);
        }
        Ok(())
    }

    /// Everything back to its place; a lesson under way is forgotten.
    fn start_again(&mut self) -> Result<(), &'static str> {
        let Place::Here { state, start, .. } = &mut self.place else { return Err(NO_HOME) };
        *state = *start;
        self.agent.forget();
        self.doing = Doing::Nothing;
        Ok(())
    }

    /// Takes back the memory of the home, which is then gone.
    fn leave(&mut self) -> Result<Rooms, &'static str> {
        self.agent.forget();
        self.doing = Doing::Nothing;
        match core::mem::replace(&mut self.place, Place::Moving) {
            Place::Here { home, .. } => Ok(home.into_memory()),
            Place::Described(builder) => Ok(builder.into_memory()),
            Place::Nowhere(rooms) => Ok(rooms),
            Place::Moving => Err("the robot is nowhere; press reset"),
        }
    }

    fn go_home(&mut self) -> Result<(), &'static str> {
        self.begin()?;
        for line in house::description() {
            self.describe(request::read(line)?)?;
        }
        self.build()
    }

    /// Begins another home.
    fn begin(&mut self) -> Result<(), &'static str> {
        self.place = Place::Described(Builder::new(self.leave()?));
        Ok(())
    }

    /// Adds a part to the home that is being described.
    fn describe(&mut self, part: Request<'_>) -> Result<(), &'static str> {
        let Place::Described(home) = &mut self.place else { return Err("say `begin` first, which begins another home") };
        match part {
            Request::Room(name, area, color) => home.room(name, area, color).map(drop),
            Request::Door(name, area) => home.door(name, area).map(drop),
            Request::Block(name, cell, color, shape) => home.block(name, cell, color, shape).map(drop),
            Request::Agent(name, cell) => home.agent(name, cell).map(drop),
            _ => return Err("this is no part of a home"),
        }
        .map_err(|error| problem(error.problem))
    }

    fn build(&mut self) -> Result<(), &'static str> {
        let Place::Described(_) = &self.place else { return Err("say `begin` first, which begins another home") };
        let Place::Described(builder) = core::mem::replace(&mut self.place, Place::Moving) else { return Err(NO_HOME) };
        match builder.try_build(Moves::Push) {
            Ok((home, start)) => {
                self.place = Place::Here { home, state: start, start };
                Ok(())
            }
            Err((error, rooms)) => {
                self.place = Place::Nowhere(rooms);
                Err(problem(error.problem))
            }
        }
    }

    fn forget_all(&mut self) -> Result<(), &'static str> {
        let tasks = paper_tasks().map_err(|_| "the tasks cannot be read")?;
        self.agent.set_tasks(&tasks, Options { done: Options::SELDOM_DONE, ..Options::DEFAULT }).map_err(text)?;
        (self.doing, self.next) = (Doing::Nothing, 0);
        Ok(())
    }
}

fn home_of(place: &Place, now: u32) -> Picture {
    match place {
        Place::Here { home, state, .. } => picture::home(home, state, now),
        _ => DARK,
    }
}

const NO_HOME: &str = "the robot is in no home; say `home`, or describe one and say `build`";

/// The text for an error.
fn text(error: AgentError) -> &'static str {
    match error {
        AgentError::EmptyCommand => "the command has no word; say what to do",
        AgentError::NoTask => "there is nothing to do here: every task is done already",
        AgentError::NotNow(Phase::Idle | Phase::Ended) | AgentError::NotPlanned => "no lesson is under way; give a command first",
        AgentError::NothingDone => "no action was done that could be judged; let it act first",
        AgentError::Capacity(full) => full.capacity.name(),
        _ => "the robot is still at work",
    }
}

/// The text for a fault of a home.
fn problem(problem: Problem) -> &'static str {
    match problem {
        Problem::NoAgent => "the home has no agent",
        Problem::SecondAgent => "the home has an agent already",
        Problem::NoRoom => "the home has no room",
        Problem::RoomOfNoArea => "a room is at least two cells wide and high from border to border",
        Problem::DoorOfNoArea => "a door's right is not left of its left, nor its top below its bottom",
        Problem::InWall => "the agent or a block is in a wall, or outside every room",
        Problem::OnAnother => "two things are on one cell",
        Problem::TooFar => "a coordinate is too far away",
        Problem::TooManyStates => "there are too many cells and blocks",
        Problem::DuplicateName => "another object has this name",
        Problem::EmptyName => "a name is empty",
        Problem::Capacity(full) => full.capacity.name(),
        _ => "this is no home",
    }
}
