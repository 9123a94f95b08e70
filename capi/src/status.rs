//! What every function returns.

use goodbot::AgentError;
use goodbot::capacity::CapacityError;
use goodbot::home::{HomeError, Problem};
use goodbot::oomdp::ObjectError;
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
    /// No action was done that could be judged: call `goodbot_done` for each.
    NothingDone = 22,
    /// The command is not heard to its end: call `goodbot_hear_on` until it is.
    StillHearing = 23,
    /// The session is not finished: call `goodbot_finish_on` until it is.
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
    pub(crate) failure: Failure,
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
        Self {
            failure: error.into(),
            #[cfg(feature = "explain")]
            place: None,
        }
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

pub(crate) fn text_of(status: i32) -> &'static core::ffi::CStr {
    const NONE: &core::ffi::CStr = c"no such status";
    const WORLD: &core::ffi::CStr = c"the home or table is described wrongly, or the call is for the other kind of robot";
    /// A fault of a task's text, in a library that explains.
    const fn of_task(text: &'static core::ffi::CStr) -> &'static core::ffi::CStr {
        if cfg!(feature = "explain") { text } else { WORLD }
    }
    const TEXTS: &[&core::ffi::CStr] = &[
        c"done",
        c"not done yet; call again",
        c"a pointer is null that must not be",
        c"the handle is none, or its memory was moved or written over",
        c"the memory is too small; ask for its size",
        c"the memory is not aligned to 8 bytes",
        c"a text is not UTF-8, or longer than this call takes",
        c"a table is full; goodbot_full says which",
        WORLD,
        c"there is no home yet; describe it and build it",
        c"the command has no word; say what to do",
        c"there is nothing to do here",
        c"no session is under way; give a command first",
        c"the plan for this state is not done; plan on until it is",
        c"the last session is still being learned from; learn on until it is done",
        c"the action cannot be done in this state",
        c"a number is none of those allowed",
        c"there is no object or task of this name or number",
        c"the bytes are no model, or were damaged",
        c"the model was learned with another vocabulary",
        c"the buffer is too small",
        c"something else failed",
        c"no action was done that could be judged; say that one was done first",
        c"the command is not heard to its end; hear on until it is",
        c"the session is not finished; finish on until it is",
        c"no question waits for an answer; ask first",
        c"this is no answer to that question; answer yes, no, or with the number of a choice",
        c"the flash refused, or did not keep what was written; the older model is still there",
        c"nothing is stored",
        if cfg!(feature = "talk") { c"the work was stopped in a pause; say it again" } else { NONE },
        if cfg!(feature = "voice") {
            c"the text is no table of closed words; write a class, a colon and its words in each line"
        } else {
            NONE
        },
        c"what was learned has changed meanwhile; begin again",
        c"a model is coming back; restore on until it is done",
        c"the library has no checks and the table has no kinds; print the table by goodbot table --c, or link a library with checks",
        c"another call is using this robot; call again when it has returned",
        c"the model has a newer format than this library; use the program that stored it, or a newer one",
        of_task(c"a task is not written as name(?a, ?b) & other(?c)"),
        of_task(c"a task names an unknown proposition"),
        of_task(c"a task's proposition has too few or too many arguments"),
        of_task(c"a task's variable is of two classes"),
        of_task(if cfg!(feature = "ways") { c"a task's way says nothing new, or avoids the goal" } else { c"the library has no ways" }),
    ];
    usize::try_from(status).ok().and_then(|status| TEXTS.get(status)).copied().unwrap_or(NONE)
}
