//! What every function returns.

use goodbot::AgentError;
use goodbot::capacity::CapacityError;
use goodbot::home::{HomeError, Problem};
use goodbot::oomdp::ObjectError;
use goodbot::planning::Progress;
use goodbot::session::Phase;
use goodbot::snapshot::{RestoreError, SaveError};
use goodbot::task::TaskTextError;

/// The result of a call.
#[repr(i32)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum GoodbotStatus {
    /// Done.
    Ok = 0,
    /// Not done yet: call again.
    Working = 1,
    /// A pointer is null that must not be.
    Null = 2,
    /// This is no handle, or its memory was moved or overwritten.
    BadHandle = 3,
    /// The memory is too small: ask for its size.
    Memory = 4,
    /// The memory is not aligned to 8 bytes.
    Alignment = 5,
    /// A text is not UTF-8, or longer than its call takes.
    Text = 6,
    /// A table is full: `goodbot_full` says which.
    Full = 7,
    /// The home or table is described wrongly, or the call is for the other kind of robot.
    World = 8,
    /// There is no home yet: describe it and call `goodbot_home_build`.
    NoWorld = 9,
    /// The command has no word.
    EmptyCommand = 10,
    /// There is no task to do here.
    NoTask = 11,
    /// No session is under way: hear a command first.
    NoSession = 12,
    /// The plan for this state is not done: call `goodbot_plan` until it is.
    NotPlanned = 13,
    /// The last session is still being learned from: call `goodbot_learn` until it is.
    StillLearning = 14,
    /// The action cannot be done in this state.
    NotApplicable = 15,
    /// A number is not one of those allowed.
    Number = 16,
    /// There is no object or task of this name or number.
    Unknown = 17,
    /// The bytes are no model, or were damaged.
    BadModel = 18,
    /// The model was learned with another machine vocabulary. A robot of the caller's own keeps its lessons if propositions and attributes are
    /// only added, each at the end of its list.
    OtherDomain = 19,
    /// The buffer is too small.
    Buffer = 20,
    /// Anything else.
    Other = 21,
    /// No action was done that could be judged: call `goodbot_acted` for each.
    NothingDone = 22,
    /// The command is not heard to its end: call `goodbot_hear_on` until it is.
    StillHearing = 23,
    /// The session is not finished: call `goodbot_finish_on` until it is. A call that ends a session says so too, where the session is half
    /// among those that were learned from.
    StillFinishing = 24,
    /// No question waits for an answer.
    NotAsked = 25,
    /// This is no answer to the question that was asked.
    NoAnswer = 26,
    /// The flash refused, or did not keep what was written; the older model is still there.
    Flash = 27,
    /// Nothing is stored.
    NothingStored = 28,
    /// A pause stopped the work: no session is under way.
    Stopped = 29,
    /// The text is no table of words: `docs/talk.md` says how one is written.
    ClosedWords = 30,
    /// What was learned has changed since saving or restoring began: begin again.
    Changed = 31,
    /// A model is coming back: call `goodbot_restore_on` until it is done.
    StillRestoring = 32,
    /// The library has no checks, and the table is none that was checked: print it by `goodbot table --c`, or link a library with the feature
    /// `checks`. A task with a way needs them.
    Unchecked = 33,
    /// Another call is using this robot: this one came from a function of the caller's, an interrupt or another thread. It did nothing.
    Busy = 34,
    /// The model has a format that is newer than this library: a newer program stored it. It is whole, so keep it.
    NewerFormat = 35,
    /// A task's text is not of the form `name(?a, ?b) & other(?c)`: a bracket, a comma or a question mark is missing.
    TaskForm = 36,
    /// A task's text names a propositional function that there is not.
    TaskProposition = 37,
    /// A task's text gives a propositional function more or fewer arguments than it has.
    TaskArguments = 38,
    /// A task's text uses one variable for objects of two classes.
    TaskClass = 39,
    /// A task's way says what its goal says already, or avoids the goal; or the library has no `ways`.
    TaskWay = 40,
}

/// Why a call failed, with the table that was full, if one was.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Failure {
    pub(crate) status: GoodbotStatus,
    pub(crate) full: Option<CapacityError>,
}

/// Why a description was refused, with the part that is wrong. Most calls have none, so theirs is the smaller [`Failure`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Fault {
    pub(crate) status: GoodbotStatus,
    /// The full table, if one was, to be explained; nobody else asks for it.
    #[cfg(feature = "explain")]
    pub(crate) full: Option<CapacityError>,
    #[cfg(feature = "explain")]
    pub(crate) place: Option<Place>,
}

/// A part of the caller's description: `objects[3].name`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Place {
    /// The list or field of the table.
    pub(crate) list: &'static str,
    /// Which item of the list.
    pub(crate) item: Option<usize>,
    /// The item's field.
    pub(crate) field: &'static str,
    /// The value there, if it is a number.
    pub(crate) found: Option<u32>,
    /// The least and the greatest allowed value.
    pub(crate) allowed: Option<(u32, u32)>,
}

impl Place {
    /// A field of the table itself.
    pub(crate) const fn of(list: &'static str) -> Self {
        Self { list, item: None, field: "", found: None, allowed: None }
    }

    /// A field of an item of a list.
    pub(crate) const fn item(list: &'static str, item: usize, field: &'static str) -> Self {
        Self { item: Some(item), field, ..Self::of(list) }
    }

    /// Adds the value there, and the least and the greatest allowed value.
    pub(crate) const fn number(self, found: u32, least: u32, most: u32) -> Self {
        Self { found: Some(found), allowed: Some((least, most)), ..self }
    }
}

/// Adds a place to a fault that has none yet.
pub(crate) trait At<T> {
    fn at(self, place: Place) -> Result<T, Fault>;
}

impl<T, E: Into<Fault>> At<T> for Result<T, E> {
    #[cfg(not(feature = "explain"))]
    fn at(self, _place: Place) -> Result<T, Fault> {
        self.map_err(Into::into)
    }

    #[cfg(feature = "explain")]
    fn at(self, place: Place) -> Result<T, Fault> {
        self.map_err(|error| {
            let fault = error.into();
            Fault { place: fault.place.or(Some(place)), ..fault }
        })
    }
}

impl<E: Into<Failure>> From<E> for Fault {
    fn from(error: E) -> Self {
        let failure = error.into();
        Self {
            status: failure.status,
            #[cfg(feature = "explain")]
            full: failure.full,
            #[cfg(feature = "explain")]
            place: None,
        }
    }
}

impl From<()> for GoodbotStatus {
    fn from((): ()) -> Self {
        Self::Ok
    }
}

impl From<Progress> for GoodbotStatus {
    fn from(progress: Progress) -> Self {
        if progress == Progress::Done { Self::Ok } else { Self::Working }
    }
}

impl From<GoodbotStatus> for Failure {
    fn from(status: GoodbotStatus) -> Self {
        Self { status, full: None }
    }
}

impl From<CapacityError> for Failure {
    fn from(error: CapacityError) -> Self {
        Self { full: Some(error), ..GoodbotStatus::Full.into() }
    }
}

impl From<AgentError> for Failure {
    fn from(error: AgentError) -> Self {
        match error {
            AgentError::EmptyCommand => GoodbotStatus::EmptyCommand,
            AgentError::NoTask => GoodbotStatus::NoTask,
            AgentError::NotNow(Phase::Hearing) => GoodbotStatus::StillHearing,
            AgentError::NotNow(Phase::Finishing) => GoodbotStatus::StillFinishing,
            AgentError::NotNow(Phase::Learning) => GoodbotStatus::StillLearning,
            AgentError::NotNow(Phase::Restoring) => GoodbotStatus::StillRestoring,
            AgentError::NotNow(_) | AgentError::OtherDomain => GoodbotStatus::NoSession,
            AgentError::NotPlanned => GoodbotStatus::NotPlanned,
            AgentError::OtherVocabulary => GoodbotStatus::World,
            AgentError::NothingDone => GoodbotStatus::NothingDone,
            AgentError::NotAsked => GoodbotStatus::NotAsked,
            AgentError::NoAnswer => GoodbotStatus::NoAnswer,
            #[cfg(feature = "talk")]
            AgentError::Stopped => GoodbotStatus::Stopped,
            AgentError::NotApplicable => GoodbotStatus::NotApplicable,
            AgentError::StateNumber
            | AgentError::Strategy(_)
            | AgentError::Prior { .. }
            | AgentError::NoPrior
            | AgentError::Weight { .. }
            | AgentError::Setting(_) => GoodbotStatus::Number,
            AgentError::Capacity(error) => return error.into(),
            _ => GoodbotStatus::Other,
        }
        .into()
    }
}

impl From<HomeError> for Failure {
    fn from(error: HomeError) -> Self {
        match error.problem {
            Problem::Capacity(error) => error.into(),
            _ => GoodbotStatus::World.into(),
        }
    }
}

impl From<ObjectError> for Failure {
    fn from(error: ObjectError) -> Self {
        match error {
            ObjectError::Capacity(error) => error.into(),
            _ => GoodbotStatus::World.into(),
        }
    }
}

impl From<TaskTextError> for Failure {
    fn from(error: TaskTextError) -> Self {
        match error {
            TaskTextError::Capacity(error) => return error.into(),
            TaskTextError::Form => GoodbotStatus::TaskForm,
            TaskTextError::UnknownProposition { .. } => GoodbotStatus::TaskProposition,
            TaskTextError::ArgumentCount { .. } => GoodbotStatus::TaskArguments,
            TaskTextError::ClassConflict { .. } => GoodbotStatus::TaskClass,
            TaskTextError::SaysNothing | TaskTextError::AvoidsGoal | TaskTextError::NoWays => GoodbotStatus::TaskWay,
            _ => GoodbotStatus::World,
        }
        .into()
    }
}

impl From<SaveError> for Failure {
    fn from(error: SaveError) -> Self {
        match error {
            SaveError::Buffer { .. } => GoodbotStatus::Buffer.into(),
            SaveError::StillLearning => GoodbotStatus::StillLearning.into(),
            SaveError::Changed => GoodbotStatus::Changed.into(),
            _ => GoodbotStatus::Other.into(),
        }
    }
}

impl From<RestoreError> for Failure {
    fn from(error: RestoreError) -> Self {
        match error {
            RestoreError::Capacity(error) => error.into(),
            RestoreError::OtherDomain => GoodbotStatus::OtherDomain.into(),
            RestoreError::Version { found: 1.. } => GoodbotStatus::NewerFormat.into(),
            RestoreError::Interrupted => GoodbotStatus::Changed.into(),
            _ => GoodbotStatus::BadModel.into(),
        }
    }
}

/// What is wrong, as a sentence for people; a constant text that is never null.
#[unsafe(no_mangle)]
pub extern "C" fn goodbot_status_text(status: i32) -> *const core::ffi::c_char {
    text_of(status).as_ptr()
}

/// A text that only a library with a feature needs; another one for the rest.
macro_rules! text_with {
    ($name:ident, $feature:literal, $other:literal) => {
        #[cfg(feature = $feature)]
        macro_rules! $name {
            ($text:literal) => {
                $text
            };
        }
        #[cfg(not(feature = $feature))]
        macro_rules! $name {
            ($text:literal) => {
                $other
            };
        }
    };
}
text_with!(of_talk, "talk", "no such status");
text_with!(of_voice, "voice", "no such status");
text_with!(of_task, "explain", "a task is described wrongly");

/// One text, because a list of texts takes eight bytes more for each.
const TEXTS: &str = concat!(
    "done\0",
    "not done yet; call again\0",
    "a pointer is null that must not be\0",
    "the handle is none, or its memory was moved or written over\0",
    "the memory is too small; ask for its size\0",
    "the memory is not aligned to 8 bytes\0",
    "a text is not UTF-8, or longer than this call takes\0",
    "a table is full; goodbot_full says which\0",
    "the home or table is described wrongly, or the call is for the other kind of robot\0",
    "there is no home yet; describe it and build it\0",
    "the command has no word; say what to do\0",
    "there is nothing to do here\0",
    "no session is under way; give a command first\0",
    "the plan for this state is not done; plan on until it is\0",
    "the last session is still being learned from; learn on until it is done\0",
    "the action cannot be done in this state\0",
    "a number is none of those allowed\0",
    "there is no object or task of this name or number\0",
    "the bytes are no model, or were damaged\0",
    "the model was learned with another vocabulary\0",
    "the buffer is too small\0",
    "something else failed\0",
    "no action was done that could be judged; say that one was done first\0",
    "the command is not heard to its end; hear on until it is\0",
    "the session is not finished; finish on until it is\0",
    "no question waits for an answer; ask first\0",
    "this is no answer to that question; answer yes, no, or with the number of a choice\0",
    "the flash refused, or did not keep what was written; the older model is still there\0",
    "nothing is stored\0",
    of_talk!("the work was stopped in a pause; say it again"),
    "\0",
    of_voice!("the text is no table of closed words; write a class, a colon and its words in each line"),
    "\0",
    "what was learned has changed meanwhile; begin again\0",
    "a model is coming back; restore on until it is done\0",
    "the library has no checks and the table has no kinds; print the table by goodbot table --c, or link a library with checks\0",
    "another call is using this robot; call again when it has returned\0",
    "the model has a newer format than this library; use the program that stored it, or a newer one\0",
    of_task!("a task is not written as name(?a, ?b)"),
    "\0",
    of_task!("a task names an unknown proposition"),
    "\0",
    of_task!("a task has a wrong number of arguments"),
    "\0",
    of_task!("a task's variable is of two classes"),
    "\0",
    of_task!("a task's way says nothing, or is not known"),
    "\0",
);

pub(crate) fn text_of(status: i32) -> &'static core::ffi::CStr {
    let mut rest = TEXTS.as_bytes();
    for _ in 0..status as u32 {
        let end = rest.iter().position(|&byte| byte == 0).unwrap_or(rest.len());
        rest = rest.get(end.saturating_add(1)..).unwrap_or(&[]);
        if rest.is_empty() {
            return c"no such status";
        }
    }
    // SAFETY: the last of the texts ends with a 0, too.
    unsafe { core::ffi::CStr::from_ptr(rest.as_ptr().cast()) }
}
