//! The first line of a session.

use std::collections::BTreeSet;
use std::ops::Not;

use serde::Serialize;

use crate::environment::EnvironmentFile;
use crate::error::{FormatError, twice};
use crate::json::{Node, Object};
use crate::task_text::{GroundAtomText, GroundTaskText, TaskTextError, WayText};
use crate::weights;

/// How the trainer teaches in a session.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Hash, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Kind {
    /// The robot acts, and the trainer judges each step.
    #[default]
    Feedback,
    /// The trainer shows the task.
    Demonstration,
    /// The session gives the task, without steps.
    Labelled,
}

/// A line of type `session`.
#[derive(Debug, Clone, Default, PartialEq, Serialize)]
pub struct SessionHeader {
    /// The session's name.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub id: Option<String>,
    /// The kind of session.
    pub kind: Kind,
    /// The home.
    pub environment: EnvironmentFile,
    /// The command.
    pub command: String,
    /// The intended conjunction, with at least one proposition. For evaluation only, but in a labelled session it is the lesson.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub intended: Option<Vec<GroundAtomText>>,
    /// The way of the intended task: earlier goals in order, each a conjunction.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub before: Option<Vec<Vec<GroundAtomText>>>,
    /// The way of the intended task: lists of alternatives. One of each list is to hold at some time up to the end, in any order.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub through: Option<Vec<Vec<GroundAtomText>>>,
    /// The way of the intended task: propositions that must not hold before the end.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub avoiding: Option<Vec<GroundAtomText>>,
    /// The actions, if they are not the four moves.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub actions: Option<Vec<String>>,
    /// Whether this session repeats the command before, in the same environment.
    #[serde(skip_serializing_if = "Not::not")]
    pub continues: bool,
    /// The tasks' prior probabilities in order, in place of those from the words.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[serde(serialize_with = "write_prior")]
    pub prior: Option<Vec<(GroundTaskText, f64)>>,
    /// The trainer strategies to consider, instead of the robot's own.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub strategies: Option<Vec<StrategyRecord>>,
    /// The utterance from this command on, if the robot listened. The session may be about a prohibition, or about the first of several
    /// commands.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub utterance: Option<String>,
    /// The task of the command before, if this is a later command of an utterance.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub after: Option<GroundTaskText>,
    /// The conversation, if the robot listened, as texts by name: its `id`, its last task, and the objects that words can refer to.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[serde(serialize_with = "write_conversation")]
    pub conversation: Option<Vec<(String, String)>>,
    /// The text of the table of closed words, if it is not the built-in one.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub closed_words: Option<String>,
}

/// A trainer's way of using reward and punishment.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct StrategyRecord {
    /// The strategy's name.
    pub name: String,
    /// The probability that a correct action gets silence.
    pub mu_plus: f64,
    /// The probability that an incorrect action gets silence.
    pub mu_minus: f64,
    /// The probability that the trainer mistakes a correct action for an incorrect one, or the reverse.
    pub epsilon: f64,
    /// Its prior probability.
    pub prior: f64,
    /// For late feedback: the probabilities that it is about the last action, the one before, and the one before that.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub lags: Option<[f64; 3]>,
    /// For feedback to rests that differs from feedback to moves: the probability of silence to a rest at the goal, and to one elsewhere,
    /// the probability that the trainer mistakes one for the other, and the degree to which a move inside the goal counts as a rest there.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub rests: Option<[f64; 4]>,
}

const FIELDS: &[&str] = &[
    "type",
    "version",
    "id",
    "kind",
    "environment",
    "command",
    "intended",
    "before",
    "through",
    "avoiding",
    "actions",
    "continues",
    "prior",
    "strategies",
    "utterance",
    "after",
    "conversation",
    "closed_words",
];
const KINDS: &[&str] = &["feedback", "demonstration", "labelled"];
const MOVES: [&str; 4] = ["north", "south", "east", "west"];

impl SessionHeader {
    /// A session of this kind, without optional fields.
    pub fn new(kind: Kind, environment: EnvironmentFile, command: String) -> Self {
        Self { kind, environment, command, ..Self::default() }
    }

    /// The names of the session's actions: its own, or the four moves. `noop`, which is always possible, is among them only if the session
    /// names it.
    pub fn action_names(&self) -> impl Iterator<Item = &str> {
        let own = self.actions.iter().flatten().map(String::as_str);
        let moves = MOVES.iter().copied();
        own.chain(moves.filter(|_| self.actions.is_none()))
    }

    pub(super) fn read(fields: &Object<'_>) -> Result<Self, FormatError> {
        fields.version()?;
        fields.only(FIELDS)?;
        Self::read_in(EnvironmentFile::read(fields.required("environment")?)?, fields)
    }

    /// Reads all fields of a session except its place.
    pub(crate) fn read_in(environment: EnvironmentFile, fields: &Object<'_>) -> Result<Self, FormatError> {
        let header = SessionHeader {
            id: fields.optional("id").map(|id| id.text()).transpose()?,
            kind: match fields.required("kind")?.word(KINDS)? {
                0 => Kind::Feedback,
                1 => Kind::Demonstration,
                _ => Kind::Labelled,
            },
            environment,
            command: fields.required("command")?.text()?,
            intended: fields.optional("intended").map(propositions).transpose()?,
            before: fields.optional("before").map(lists).transpose()?,
            through: fields.optional("through").map(lists).transpose()?,
            avoiding: fields.optional("avoiding").map(propositions).transpose()?,
            actions: fields.optional("actions").map(|actions| actions.each_once(Node::filled_text)).transpose()?,
            continues: match fields.optional("continues") {
                Some(continues) => continues.truth()?,
                None => false,
            },
            prior: fields.optional("prior").map(prior).transpose()?,
            strategies: fields.optional("strategies").map(strategies).transpose()?,
            utterance: fields.optional("utterance").map(|utterance| utterance.filled_text()).transpose()?,
            after: fields.optional("after").map(task).transpose()?,
            conversation: fields.optional("conversation").map(texts).transpose()?,
            closed_words: fields.optional("closed_words").map(|table| table.text()).transpose()?,
        };
        let refuse = |names: &[&str], problem: &str| match names.iter().find(|name| fields.optional(name).is_some()) {
            Some(name) => Err(fields.error(name, problem)),
            None => Ok(()),
        };
        if header.utterance.is_some() {
            refuse(&["prior", "continues"], "does not belong where the robot listened; remove it, or remove \"utterance\"")?;
        } else {
            refuse(&["after", "conversation"], "belongs where the robot listened; write \"utterance\" too, or remove it")?;
        }
        if header.continues {
            let problem = "does not belong in a session that continues the one before; remove it, or remove \"continues\"";
            refuse(&["prior", "strategies"], problem)?;
        }
        if header.kind == Kind::Labelled {
            fields.required("intended")?;
        }
        if header.intended.is_none() {
            refuse(&["before", "through", "avoiding"], "belongs to an intended task; write \"intended\" too, or remove it")?;
        }
        if let Some(Err(error)) = header.meant() {
            let field = if let TaskTextError::AvoidsGoal { .. } = error { "avoiding" } else { "intended" };
            return Err(fields.error(field, error.to_string()));
        }
        Ok(header)
    }

    /// The intended task with its way, if the record has one; a [`TaskTextError`] if it is no task.
    pub fn meant(&self) -> Option<Result<GroundTaskText, TaskTextError>> {
        let list = |list: &Option<Vec<Vec<GroundAtomText>>>| list.clone().unwrap_or_default();
        let way = WayText { before: list(&self.before), through: list(&self.through), avoiding: self.avoiding.clone().unwrap_or_default() };
        Some(GroundTaskText::with_way(self.intended.clone()?, way))
    }

    /// Sets the intended task, with its way.
    pub fn set_meant(&mut self, task: Option<&GroundTaskText>) {
        fn filled<T>(list: &[T]) -> Option<Vec<T>>
        where
            T: Clone,
        {
            Some(list.to_vec()).filter(|list| !list.is_empty())
        }
        self.intended = task.map(|task| task.atoms().to_vec());
        self.before = task.and_then(|task| filled(&task.way().before));
        self.through = task.and_then(|task| filled(&task.way().through));
        self.avoiding = task.and_then(|task| filled(&task.way().avoiding));
    }

    /// Whether the intended task has a way.
    pub fn has_way(&self) -> bool {
        self.before.is_some() || self.through.is_some() || self.avoiding.is_some()
    }
}

fn write_prior<S: serde::Serializer>(prior: &Option<Vec<(GroundTaskText, f64)>>, serializer: S) -> Result<S::Ok, S::Error> {
    weights::in_order(prior.as_deref().unwrap_or_default(), serializer)
}

fn write_conversation<S: serde::Serializer>(facts: &Option<Vec<(String, String)>>, serializer: S) -> Result<S::Ok, S::Error> {
    weights::in_order(facts.as_deref().unwrap_or_default(), serializer)
}

fn texts(node: Node<'_>) -> Result<Vec<(String, String)>, FormatError> {
    node.object()?.entries().map(|(name, value)| Ok((name.to_owned(), value.filled_text()?))).collect()
}

fn lists(node: Node<'_>) -> Result<Vec<Vec<GroundAtomText>>, FormatError> {
    node.filled_list()?.into_iter().map(propositions).collect()
}

fn task(node: Node<'_>) -> Result<GroundTaskText, FormatError> {
    node.task()
}

fn propositions(node: Node<'_>) -> Result<Vec<GroundAtomText>, FormatError> {
    node.filled_list()?.iter().map(Node::task).collect()
}

fn prior(node: Node<'_>) -> Result<Vec<(GroundTaskText, f64)>, FormatError> {
    let tasks = weights::tasks(node.clone(), 0.0)?;
    above_zero(&node, tasks.iter().map(|(_, p)| *p))?;
    Ok(tasks)
}

fn strategies(node: Node<'_>) -> Result<Vec<StrategyRecord>, FormatError> {
    let mut seen = BTreeSet::new();
    let mut strategies = Vec::new();
    for item in node.filled_list()? {
        let fields = item.object()?;
        fields.only(&["name", "mu_plus", "mu_minus", "epsilon", "prior", "lags", "rests"])?;
        let probability = |name| fields.required(name)?.probability(0.0);
        let name_node = fields.required("name")?;
        let name = name_node.filled_text()?;
        if !seen.insert(name.clone()) {
            return Err(name_node.error(twice(&name)));
        }
        strategies.push(StrategyRecord {
            name,
            mu_plus: probability("mu_plus")?,
            mu_minus: probability("mu_minus")?,
            epsilon: probability("epsilon")?,
            prior: probability("prior")?,
            lags: fields.optional("lags").map(lags).transpose()?,
            rests: fields.optional("rests").map(rests).transpose()?,
        });
    }
    above_zero(&node, strategies.iter().map(|s| s.prior))?;
    Ok(strategies)
}

fn lags(node: Node<'_>) -> Result<[f64; 3], FormatError> {
    let lags = probabilities(&node)?;
    let lags = <[f64; 3]>::try_from(lags).ok().filter(|lags| (lags.iter().sum::<f64>() - 1.0).abs() <= 1e-3);
    lags.ok_or_else(|| node.error("must be three probabilities that sum to 1"))
}

fn rests(node: Node<'_>) -> Result<[f64; 4], FormatError> {
    <[f64; 4]>::try_from(probabilities(&node)?).map_err(|_| node.error("must be four probabilities"))
}

fn probabilities(node: &Node<'_>) -> Result<Vec<f64>, FormatError> {
    node.list()?.iter().map(|number| number.probability(0.0)).collect()
}

fn above_zero(node: &Node<'_>, values: impl Iterator<Item = f64>) -> Result<(), FormatError> {
    match values.fold(0.0, f64::max) > 0.0 {
        true => Ok(()),
        false => Err(node.error("nothing here is above 0; give at least one a probability")),
    }
}
