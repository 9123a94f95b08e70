//! Errors of a text: the place, the fault and the remedy, for every format.

use std::fmt;

use crate::quoted::{excerpt, quoted};
use crate::task_text::TaskTextError;

/// The versions of the file formats that this crate reads. It writes the last of them.
pub const KNOWN_VERSIONS: &[u32] = &[1];

/// A text that is not in the format: the place and the fault.
///
/// Displayed as `FILE:LINE: field "x": the fault; the remedy`:
///
/// ```
/// use goodbot_formats::environment::EnvironmentFile;
///
/// let error = EnvironmentFile::parse(r#"{"version":1,"things":[]}"#).unwrap_err();
/// assert_eq!(
///     error.with_file("home.json").to_string(),
///     r#"home.json:1: field "things": is not known here; known are version, objects, derived"#
/// );
/// ```
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct FormatError {
    /// The file's name, if the caller has given one.
    pub file: Option<String>,
    /// The line, counted from 1.
    pub line: usize,
    /// The column in characters, counted from 1, if the fault is at one place.
    pub column: Option<usize>,
    /// The field at fault, with its path from the outside: `environment.objects[2].color`.
    pub field: Option<String>,
    /// The fault.
    pub problem: Problem,
}

/// The faults of a text.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum Problem {
    /// Not JSON; the message of the JSON reader.
    #[error("is not JSON ({0}); correct it (JSON has no NaN, no comments and no comma at the end of a list)")]
    Syntax(String),
    /// The text, or the line of a log, ends in the middle of a value.
    #[error("the text ends in the middle of a value; complete it, or remove what is left of it")]
    CutShort,
    /// There is no text at all.
    #[error("there is nothing here; give a file with a JSON text")]
    NoText,
    /// Not UTF-8.
    #[error("is not UTF-8; save the file in UTF-8")]
    NotUtf8,
    /// A line of more than `limit` bytes.
    #[error("the line has more than {limit} bytes; put each record on a line of its own")]
    LineTooLong {
        /// The most bytes that a line may have.
        limit: usize,
    },
    /// The file could not be read; the system's message.
    #[error("could not be read ({0}); check the file and its disk")]
    Read(String),
    /// A field that the format does not know.
    #[error("is not known here; known are {}", .known.join(", "))]
    UnknownField {
        /// The fields that it knows.
        known: &'static [&'static str],
    },
    /// A field that is given twice.
    #[error("is given twice; keep one of the two")]
    DuplicateField,
    /// A missing field.
    #[error("is missing; add it")]
    MissingField,
    /// A value of the wrong kind.
    #[error("is {found}; write {expected}")]
    WrongKind {
        /// The kind that belongs there.
        expected: &'static str,
        /// The kind that was found.
        found: &'static str,
    },
    /// A word that the field does not allow.
    #[error("{} is not known; write {}", quoted(.found), alternatives(.known))]
    UnknownWord {
        /// The word.
        found: String,
        /// The words that it allows.
        known: &'static [&'static str],
    },
    /// An action that is neither `noop` nor one of the session's actions.
    #[error("{} is no action of this session; write {} or noop, or name it in the session's \"actions\"", quoted(.found), .known.iter().map(|k| quoted(k)).collect::<Vec<_>>().join(", "))]
    UnknownAction {
        /// The action.
        found: String,
        /// The session's actions.
        known: Vec<String>,
    },
    /// A version other than [`KNOWN_VERSIONS`].
    #[error("version {found} is unknown; write {}, or use a newer goodbot", KNOWN_VERSIONS.iter().map(u32::to_string).collect::<Vec<_>>().join(", "))]
    UnknownVersion {
        /// The version as written.
        found: String,
    },
    /// A number that is no coordinate: no whole number of 32 bits.
    #[error("{found} is no cell; write a whole number from {} to {}", i32::MIN, i32::MAX)]
    NotACoordinate {
        /// The number as written.
        found: String,
    },
    /// A number that is no count: no whole number from 0.
    #[error("{found} is no count; write a whole number from 0")]
    NotACount {
        /// The number as written.
        found: String,
    },
    /// A number outside the range from 0 to 1.
    #[error("{found} is no probability; write a number from 0 to 1")]
    NotAProbability {
        /// The number as written.
        found: String,
    },
    /// An empty list or name.
    #[error("is empty; fill it, or leave out what is optional")]
    Empty,
    /// A list or an object of more than `limit` entries.
    #[error("has more than {limit} entries; write no more than that")]
    TooMany {
        /// The most entries.
        limit: usize,
    },
    /// Probabilities that are all 0.
    #[error("nothing here is above 0; give at least one a probability")]
    AllZero,
    /// A repeated name, where each must be unique.
    #[error("{} is here twice; name each once", quoted(.name))]
    DuplicateName {
        /// The name.
        name: String,
    },
    /// A text that is no task, or a name that no task can hold.
    #[error(transparent)]
    Task(TaskTextError),
    /// A step before the first session.
    #[error("a step comes before any session; put a session line before it")]
    StepBeforeSession,
    /// A step after the end of its session.
    #[error("a step comes after the end of its session; move it before the end line, or begin a session")]
    StepAfterEnd,
    /// An end without a session.
    #[error("an end is outside of any session; remove it")]
    EndOutsideSession,
    /// A session without an end.
    #[error("the session that begins here is not ended when {}", match .next_session {
        Some(line) => format!("another begins on line {line}; add an end line before that"),
        None => "the file ends; add an end line".to_owned(),
    })]
    NoEnd {
        /// The line of the next session; `None` if the file ends.
        next_session: Option<usize>,
    },
    /// A step without feedback in a feedback session.
    #[error("is missing in a feedback session; add reward, punish or neutral")]
    FeedbackMissing,
    /// A step with feedback in a demonstration.
    #[error("does not belong in a demonstration; remove it, or make the session's kind feedback")]
    FeedbackInDemonstration,
    /// No session begins in the first `lines` lines.
    #[error("no session begins in {lines} lines; check that this is a session log")]
    NoSession {
        /// How many lines were read.
        lines: usize,
    },
    /// A step in a labelled session.
    #[error("a step does not belong in a labelled session; remove it, or make the session's kind demonstration")]
    StepInLabelled,
    /// An answer in a session that has no feedback.
    #[error("an answer belongs in a session of feedback alone; remove it, or make the session's kind feedback")]
    AnswerWithoutFeedback,
    /// An answer before the first session or after the end of one.
    #[error("an answer is outside any session; put it between its session line and its end")]
    AnswerOutsideSession,
    /// Answers that are wrong in half of all cases or more.
    #[error("must be less than 0.5: an answer that is more often wrong than right is no answer")]
    AnswersMostlyWrong,
    /// A number of other answers outside 1 to 255.
    #[error("{others} is no number of other answers; write a whole number from 1 to 255")]
    OtherAnswers {
        /// The number.
        others: u64,
    },
    /// Lags that are not three probabilities that sum to 1.
    #[error("must be three probabilities that sum to 1")]
    Lags,
    /// Numbers for rests that are not four probabilities.
    #[error("must be four probabilities")]
    Rests,
    /// A way without an intended task.
    #[error("belongs to an intended task; write \"intended\" too, or remove it")]
    OnlyWithIntended,
    /// A field that a session with `continues` cannot have.
    #[error("does not belong in a session that continues the one before; remove it, or remove \"continues\"")]
    NotWithContinues,
    /// A field that a session with `utterance` cannot have.
    #[error("does not belong where the robot listened; remove it, or remove \"utterance\"")]
    NotWithUtterance,
    /// A field that only a session with `utterance` can have.
    #[error("belongs where the robot listened; write \"utterance\" too, or remove it")]
    OnlyWithUtterance,
    /// A session with `continues` and another command or environment than the one before.
    #[error("the session before has another command or environment; remove \"continues\"")]
    ContinuesAnother,
    /// A session with `continues` after a session that could not be read.
    #[error("the session before could not be read, so nothing can be continued; mend that one first")]
    ContinuesUnread,
    /// A name that the world does not have.
    #[error("the world has no {what} {}; add it, or correct the name", quoted(.name))]
    NotInWorld {
        /// The kind of thing that it would be.
        what: &'static str,
        /// The name.
        name: String,
    },
    /// An attribute that the object's class does not have.
    #[error("objects of the class {} do not carry this attribute; add the class to the attribute's list", quoted(.class))]
    NotCarried {
        /// The class.
        class: String,
    },
    /// A proposition with more or fewer arguments than it has in its world.
    #[error("{} was given {given} arguments, and it has {wanted} in this world; write that many", quoted(.name))]
    ArgumentCount {
        /// The proposition.
        name: Box<str>,
        /// How many arguments it was given.
        given: usize,
        /// How many arguments it has.
        wanted: usize,
    },
    /// An object or a variable of the wrong class.
    #[error("{} is where an object of the class {} belongs; write one of those", quoted(.name), quoted(.class))]
    WrongClass {
        /// The name of the object or variable.
        name: Box<str>,
        /// The class that belongs there.
        class: Box<str>,
    },
    /// A proposition with `!` in a list of propositions that hold.
    #[error("is a negated proposition; leave it out: propositions that are not listed do not hold")]
    Negated,
    /// A kind of task with a way, in a world.
    #[error("has a way (then, through, avoiding), which worlds from files do not know; write the goal alone")]
    KindWithWay,
    /// A variable of a world without any object for its value.
    #[error("is a variable without values: there is no object of the class {}; add one", quoted(.class))]
    NoValues {
        /// The class of its values.
        class: String,
    },
    /// A parameter that does not begin with `?`.
    #[error("{} is no variable; begin it with ?, like \"?room\"", quoted(.name))]
    NoVariable {
        /// The parameter.
        name: String,
    },
    /// A variable in an effect that is no parameter and in no condition.
    #[error("?{} has no value: it is no parameter and in no condition; add it to one of them", excerpt(.name, 40))]
    UnknownVariable {
        /// The variable.
        name: String,
    },
    /// An effect that takes the value of one of the world's variables away.
    #[error("{} is a variable and always has a value; write an effect that gives it another value", quoted(.name))]
    NegatedVariable {
        /// The variable.
        name: String,
    },
    /// An action without an effect.
    #[error("are none: an action that changes nothing is of no use; write what holds after it")]
    NoEffect,
    /// A cost outside 1 to 16.
    #[error("{cost} is no cost of an action; write a whole number from 1 to 16")]
    Cost {
        /// The cost.
        cost: u64,
    },
    /// A case of an action that does not cost what its first case does.
    #[error("costs {cost}, and an earlier case of {} costs {first}; give all cases of an action the same cost", quoted(.name))]
    OtherCost {
        /// The name of the action.
        name: String,
        /// The cost of this case.
        cost: u8,
        /// That of the first case.
        first: u8,
    },
    /// A command in a world without a line before it.
    #[error("no world {} could be read on a line before this one; put the world's line first", quoted(.name))]
    NoSuchWorld {
        /// The world's name.
        name: String,
    },
}

impl FormatError {
    pub(crate) fn new(line: usize, problem: Problem) -> Self {
        FormatError { file: None, line, column: None, field: None, problem }
    }

    pub(crate) fn with_field(mut self, field: impl Into<String>) -> Self {
        self.field = Some(field.into());
        self
    }

    /// The same error, with the name of its file.
    pub fn with_file(mut self, file: impl Into<String>) -> Self {
        self.file = Some(file.into());
        self
    }
}

impl fmt::Display for FormatError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match &self.file {
            Some(file) => write!(f, "{file}:{}: ", self.line)?,
            None => write!(f, "line {}: ", self.line)?,
        }
        if let Some(field) = &self.field {
            // Field names come from the text: control characters in them must not reach a terminal.
            write!(f, "field {}: ", quoted(field))?;
        }
        self.problem.fmt(f)
    }
}

impl std::error::Error for FormatError {}

fn alternatives(words: &[&str]) -> String {
    match words {
        [] => String::new(),
        [only] => only.to_string(),
        [first @ .., last] => format!("{} or {last}", first.join(", ")),
    }
}
