//! The session under way as a log has it. The reader of goodbot's formats is strict and large; this writes what it reads, and a test
//! has it read.

use goodbot::feedback::Strategy;
use goodbot_formats::environment::EnvironmentFile;
use serde::Serialize;

/// What has happened in the session under way.
#[derive(Clone, Debug, PartialEq)]
pub struct Recording {
    /// What was said.
    pub command: String,
    /// Where everything was when it was said.
    pub environment: EnvironmentFile,
    /// The actions of the robot, where they are not the four moves.
    pub actions: Option<&'static [&'static str]>,
    /// The trainer strategies to consider, where they are not the ones that every robot starts with.
    pub strategies: Option<Vec<StrategyLine>>,
    /// What was done.
    pub steps: Vec<Line>,
}

/// A trainer strategy of a log.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct StrategyLine {
    name: String,
    mu_plus: f32,
    mu_minus: f32,
    epsilon: f32,
    prior: f32,
    #[serde(skip_serializing_if = "Option::is_none")]
    lags: Option<[f32; 3]>,
    #[serde(skip_serializing_if = "Option::is_none")]
    rests: Option<[f32; 4]>,
}

/// A step of a log.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Step {
    r#type: &'static str,
    action: String,
    feedback: &'static str,
}

/// An answer of a log: its tasks, whether what is meant is among them, how often an answer is wrong, and how many others there were.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct AnswerLine {
    r#type: &'static str,
    tasks: Vec<String>,
    yes: bool,
    eta: f32,
    others: u8,
}

/// A line between those with which a session begins and ends.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[serde(untagged)]
pub enum Line {
    /// A step.
    Step(Step),
    /// An answer.
    Answer(AnswerLine),
}

impl AnswerLine {
    /// An answer.
    pub fn new(tasks: Vec<String>, yes: bool, eta: f32, others: u8) -> Self {
        Self { r#type: "answer", tasks, yes, eta, others }
    }
}

#[derive(Serialize)]
struct Header<'a> {
    r#type: &'static str,
    version: u32,
    kind: &'static str,
    environment: &'a EnvironmentFile,
    command: &'a str,
    #[serde(skip_serializing_if = "Option::is_none")]
    actions: Option<&'static [&'static str]>,
    #[serde(skip_serializing_if = "Option::is_none")]
    strategies: &'a Option<Vec<StrategyLine>>,
}

#[derive(Serialize)]
struct End {
    r#type: &'static str,
    learn: bool,
}

impl Step {
    /// An action and what was said to it.
    pub fn new(action: String, feedback: &'static str) -> Self {
        Self { r#type: "step", action, feedback }
    }
}

impl Recording {
    /// The session as lines, each with its end.
    pub fn lines(&self, learn: bool) -> Result<String, serde_json::Error> {
        let &Self { ref command, ref environment, actions, ref strategies, ref steps } = self;
        let header = Header { r#type: "session", version: 1, kind: "feedback", environment, command, actions, strategies };
        let mut lines = serde_json::to_string(&header)?;
        for step in steps {
            lines.push('\n');
            lines.push_str(&serde_json::to_string(step)?);
        }
        lines.push('\n');
        lines.push_str(&serde_json::to_string(&End { r#type: "end", learn })?);
        lines.push('\n');
        Ok(lines)
    }
}

/// The actions of a robot that pulls too, as logs name them.
pub const PULLING: &[&str] = &["north", "south", "east", "west", "pull"];

/// The strategies as logs have them; `None` for the paper's one, which every robot starts with.
pub fn strategies(strategies: &[(Strategy, f32)]) -> Option<Vec<StrategyLine>> {
    let line = |(number, (strategy, prior)): (usize, &(Strategy, f32))| StrategyLine {
        name: format!("strategy {}", number + 1),
        mu_plus: strategy.mu_plus(),
        mu_minus: strategy.mu_minus(),
        epsilon: strategy.epsilon(),
        prior: *prior,
        lags: Some(strategy.lags()).filter(|lags| *lags != Strategy::NO_LAG),
        rests: (!strategy.rests_as_it_moves()).then(|| strategy.rests()),
    };
    let is_paper = matches!(strategies, [(strategy, _)] if *strategy == Strategy::BALANCED);
    (!is_paper).then(|| strategies.iter().enumerate().map(line).collect())
}
