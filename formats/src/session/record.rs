//! The lines of a log, and which of them a session can have.

use super::header::{Kind, SessionHeader};
use crate::error::{FormatError, KNOWN_VERSIONS, not_json, quoted};
use crate::json::{Node, Object, Source};
use crate::task_text::GroundTaskText;
use serde::Serialize;

/// The trainer's feedback to a step.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum FeedbackWord {
    /// Praise.
    Reward,
    /// Blame.
    Punish,
    /// Silence.
    Neutral,
}

/// A line of type `step`.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct StepRecord {
    /// The name of the action.
    pub action: String,
    /// The feedback to it; absent in a demonstration.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub feedback: Option<FeedbackWord>,
    /// When the robot acted, in milliseconds since the session began. Nothing is learned from it.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub at_ms: Option<u64>,
    /// When the trainer gave the feedback, in milliseconds since the session began. Nothing is learned from it.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub said_ms: Option<u64>,
}

/// A line of type `answer`: the trainer's answer to a question of the robot, before the next step.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct AnswerRecord {
    /// The tasks of the question, at least one.
    pub tasks: Vec<GroundTaskText>,
    /// Whether the intended task is among them.
    pub yes: bool,
    /// The probability that an answer is wrong.
    pub eta: f64,
    /// How many other answers were possible, each equally probable if the answer is wrong: 1 for yes and no.
    #[serde(skip_serializing_if = "is_one")]
    pub others: u8,
    /// The words of a correction: evidence beside the answer.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub words: Option<String>,
    /// When the trainer gave it, in milliseconds since the session began. Nothing is learned from it.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub said_ms: Option<u64>,
}

fn milliseconds(fields: &Object<'_>, name: &'static str) -> Result<Option<u64>, FormatError> {
    fields.optional(name).map(|node| node.count()).transpose()
}

pub(crate) fn is_one(number: &u8) -> bool {
    *number == 1
}

/// A line of type `end`.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
pub struct EndRecord {
    /// Whether the robot is to learn from the session.
    pub learn: bool,
}

/// A line of any type.
#[derive(Debug, Clone, PartialEq)]
pub enum Record {
    /// A session begins.
    Session(Box<SessionHeader>),
    /// An action.
    Step(StepRecord),
    /// An answer.
    Answer(AnswerRecord),
    /// The session ends.
    End(EndRecord),
}

const TYPES: &[&str] = &["session", "step", "answer", "end"];
const FEEDBACK_WORDS: &[&str] = &["reward", "punish", "neutral"];

/// A record with its type before its fields.
#[derive(Serialize)]
struct Typed<'a, T> {
    #[serde(rename = "type")]
    kind: &'static str,
    #[serde(skip_serializing_if = "Option::is_none")]
    version: Option<u32>,
    #[serde(flatten)]
    record: &'a T,
}

fn typed<T: Serialize>(kind: &'static str, version: Option<u32>, record: &T) -> Result<String, FormatError> {
    serde_json::to_string(&Typed { kind, version, record }).map_err(|error| FormatError::new(1, not_json(error)))
}

/// Writes a record, and checks that it can be read again.
fn write<T: Serialize>(kind: &'static str, version: Option<u32>, record: &T) -> Result<String, FormatError> {
    let line = typed(kind, version, record)?;
    Record::parse(&line, 1)?;
    Ok(line)
}

impl FeedbackWord {
    /// The word as it is written.
    pub fn as_str(self) -> &'static str {
        match self {
            FeedbackWord::Reward => "reward",
            FeedbackWord::Punish => "punish",
            FeedbackWord::Neutral => "neutral",
        }
    }
}

impl SessionHeader {
    /// The header on one line, without a line end. It is an error if the line could not be read again.
    pub fn to_json_line(&self) -> Result<String, FormatError> {
        write("session", KNOWN_VERSIONS.last().copied(), self)
    }

    /// The header on one line, with another place than its environment; the line is not checked. Inside of texts quotes are escaped, so
    /// that the environment is found.
    pub(crate) fn line_elsewhere(&self, place: &str) -> Result<String, FormatError> {
        let environment = format!("\"environment\":{}", self.environment.to_json_line());
        Ok(typed("session", KNOWN_VERSIONS.last().copied(), self)?.replacen(&environment, place, 1))
    }

    /// Refuses an answer in a session without feedback.
    pub(crate) fn check_answer(&self, line: usize) -> Result<(), FormatError> {
        if self.kind == Kind::Feedback {
            Ok(())
        } else {
            Err(FormatError::new(line, "an answer belongs in a session of feedback alone; remove it, or make the session's kind feedback"))
        }
    }

    /// Refuses a step that this session cannot have.
    pub(super) fn check(&self, step: &StepRecord, line: usize) -> Result<(), FormatError> {
        if step.action != "noop" && !self.action_names().any(|name| name == step.action) {
            let (found, known) = (quoted(&step.action), self.action_names().map(quoted).collect::<Vec<_>>().join(", "));
            let problem = format!("{found} is no action of this session; write {known} or noop, or name it in the session's \"actions\"");
            return Err(FormatError::new(line, problem).with_field("action"));
        }
        self.check_feedback(step, line)
    }

    /// Refuses feedback that a session of this kind cannot have.
    pub(crate) fn check_feedback(&self, step: &StepRecord, line: usize) -> Result<(), FormatError> {
        let wrong = |field, problem| Err(FormatError::new(line, problem).with_field(field));
        match (self.kind, step.feedback) {
            (Kind::Labelled, _) => Err(FormatError::new(
                line,
                "a step does not belong in a labelled session; remove it, or make the session's kind demonstration",
            )),
            (Kind::Feedback, None) => wrong("feedback", "is missing in a feedback session; add reward, punish or neutral"),
            (Kind::Demonstration, Some(_)) => {
                wrong("feedback", "does not belong in a demonstration; remove it, or make the session's kind feedback")
            }
            _ => Ok(()),
        }
    }
}

impl StepRecord {
    /// An action and its feedback, without times.
    pub fn new(action: String, feedback: Option<FeedbackWord>) -> Self {
        Self { action, feedback, at_ms: None, said_ms: None }
    }

    /// The step on one line, without a line end. It is an error if the line could not be read again.
    pub fn to_json_line(&self) -> Result<String, FormatError> {
        write("step", None, self)
    }
}

impl AnswerRecord {
    /// The answer on one line, without a line end. It is an error if the line could not be read again.
    pub fn to_json_line(&self) -> Result<String, FormatError> {
        write("answer", None, self)
    }

    fn read(fields: &Object<'_>) -> Result<Self, FormatError> {
        fields.only(&["type", "tasks", "yes", "eta", "others", "words", "said_ms"])?;
        let tasks = fields.required("tasks")?.each_once(Node::task)?;
        let eta = fields.required("eta")?;
        let others = match fields.optional("others") {
            None => 1,
            Some(node) => {
                let others = node.count()?;
                u8::try_from(others)
                    .ok()
                    .filter(|&others| others > 0)
                    .ok_or_else(|| node.error(format!("{others} is no number of other answers; write a whole number from 1 to 255")))?
            }
        };
        let probability = eta.probability(0.0)?;
        if probability >= 0.5 {
            return Err(eta.error("must be less than 0.5: an answer that is more often wrong than right is no answer"));
        }
        let words = fields.optional("words").map(|words| words.filled_text()).transpose()?;
        let (yes, said_ms) = (fields.required("yes")?.truth()?, milliseconds(fields, "said_ms")?);
        Ok(Self { tasks, yes, eta: probability, others, words, said_ms })
    }
}

impl EndRecord {
    /// The end on one line, without a line end.
    pub fn to_json_line(&self) -> Result<String, FormatError> {
        write("end", None, self)
    }
}

impl Record {
    /// Reads a line; `line` is its number in the file, for errors.
    ///
    /// The order of lines is not checked here; a [`SessionReader`](super::SessionReader) checks it.
    ///
    /// ```
    /// use goodbot_formats::session::Record;
    ///
    /// let error = Record::parse(r#"{"type":"step","action":"north","feedback":"good"}"#, 7);
    /// assert_eq!(
    ///     error.unwrap_err().to_string(),
    ///     r#"line 7: field "feedback": "good" is not known; write reward, punish or neutral"#
    /// );
    /// ```
    pub fn parse(text: &str, line: usize) -> Result<Self, FormatError> {
        let source = Source::new(text, line);
        let fields = source.root()?.object()?;
        match fields.required("type")?.word(TYPES)? {
            0 => Ok(Record::Session(Box::new(SessionHeader::read(&fields)?))),
            1 => {
                fields.only(&["type", "action", "feedback", "at_ms", "said_ms"])?;
                let feedback = match fields.optional("feedback") {
                    None => None,
                    Some(word) => Some(match word.word(FEEDBACK_WORDS)? {
                        0 => FeedbackWord::Reward,
                        1 => FeedbackWord::Punish,
                        _ => FeedbackWord::Neutral,
                    }),
                };
                let action = fields.required("action")?.filled_text()?;
                let [at_ms, said_ms] = [milliseconds(&fields, "at_ms")?, milliseconds(&fields, "said_ms")?];
                Ok(Record::Step(StepRecord { action, feedback, at_ms, said_ms }))
            }
            2 => Ok(Record::Answer(AnswerRecord::read(&fields)?)),
            _ => {
                fields.only(&["type", "learn"])?;
                let learn = fields.required("learn")?.truth()?;
                Ok(Record::End(EndRecord { learn }))
            }
        }
    }

    /// The record on one line, without a line end. It is an error if the line could not be read again.
    pub fn to_json_line(&self) -> Result<String, FormatError> {
        match self {
            Record::Session(header) => header.to_json_line(),
            Record::Step(step) => step.to_json_line(),
            Record::Answer(answer) => answer.to_json_line(),
            Record::End(end) => end.to_json_line(),
        }
    }
}
