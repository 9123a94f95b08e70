//! Recorded sessions as what a trainer saw: actions that were right or wrong for each task, and where the trainer ended the session.

use crate::load::session::{Session, load};
use crate::load::{Fault, home, input};
use goodbot::feedback::Feedback;
use goodbot::home::HomeState;
use goodbot::memory::{AgentHeap, HomeMemory};
use goodbot::oomdp::apply;
use goodbot::planning::{Judgement, OptimalSet};
use goodbot::task::LiftedTask;
use goodbot::{Agent, AgentError, Capacities, Options};
use goodbot_formats::session::{Kind, RecordedSession, SessionReader};

/// One step of a session.
#[derive(Clone, Debug)]
pub struct WalkStep {
    /// What the action was for each task.
    pub judged: Vec<Judgement>,
    /// What the trainer said to it.
    pub feedback: Feedback,
    /// Whether each task was done after it; nothing where that is not known.
    pub at_goal: Vec<Option<bool>>,
}

/// A session.
#[derive(Clone, Debug)]
pub struct Walk {
    /// Who trained: see [`trainer_of`].
    pub trainer: String,
    /// Whether it continued the one before.
    pub continues: bool,
    /// The tasks' prior.
    pub prior: Vec<f32>,
    /// The task that was meant, by position.
    pub intended: Option<usize>,
    /// The steps.
    pub steps: Vec<WalkStep>,
}

impl Walk {
    /// Whether the trainer said anything.
    pub fn has_feedback(&self) -> bool {
        self.steps.iter().any(|step| step.feedback != Feedback::Neutral)
    }
}

/// Who trained in a session: its id up to the first dot, as in `w03.1-2`; whoever the file is of where there is none.
pub fn trainer_of<'a>(id: Option<&'a str>, file: &'a str) -> &'a str {
    id.and_then(|id| id.split_once('.')).map_or(file, |(trainer, _)| trainer)
}

/// Reads the sessions with feedback of these files, and plans for each of their steps.
///
/// # Errors
/// What is wrong with the first that is at fault.
pub fn read(files: &[String], lifted: &[LiftedTask]) -> Result<Vec<Walk>, Vec<Fault>> {
    let refused = |error: AgentError| vec![Fault::new("", error)];
    let mut agent = Agent::new(AgentHeap::new(&Capacities::STANDARD), lifted, Options::PAPER).map_err(refused)?;
    let mut walks = vec![];
    for file in files {
        let opened = input::log(file).map_err(|fault| vec![fault])?;
        let name = input::name(file);
        for session in SessionReader::new(opened) {
            let recorded = session.map_err(|error| vec![Fault::from_format(name, error)])?;
            if recorded.header.kind == Kind::Feedback {
                walks.push(walk(&mut agent, name, &recorded, lifted)?);
            }
        }
    }
    Ok(walks)
}

fn walk(agent: &mut Agent<AgentHeap>, file: &str, recorded: &RecordedSession, lifted: &[LiftedTask]) -> Result<Walk, Vec<Fault>> {
    let header = &recorded.header;
    let mut memory = home::memory();
    let session = load(file, recorded, lifted, &mut memory)?;
    let at = |line: usize| move |error: AgentError| vec![Fault::on_line(file, line, error)];
    agent.hear(&session.home, &session.start, &header.command).map_err(at(recorded.header_line))?;
    let prior = session.prior.clone().unwrap_or_else(|| session.tasks.iter().map(|(task, _)| task.prior).collect());
    let intended = header.meant().and_then(Result::ok).and_then(|meant| session.tasks.iter().position(|(_, name)| name.is_same(&meant)));
    let mut steps = vec![];
    for step in &session.steps {
        agent.plan_fully(&session.home, &step.before).map_err(at(step.line))?;
        let judged = (0..session.tasks.len()).map(|task| agent.planned().judge(task, step.action)).collect();
        let after = apply(&session.home, &step.before, step.action).unwrap_or(step.before);
        let at_goal = goals(agent, &session, &after).map_err(at(step.line))?;
        steps.push(WalkStep { judged, feedback: step.feedback, at_goal });
    }
    agent.forget();
    let trainer = trainer_of(header.id.as_deref(), file).to_owned();
    Ok(Walk { trainer, continues: header.continues, prior, intended, steps })
}

fn goals(agent: &mut Agent<AgentHeap>, session: &Session<impl HomeMemory>, state: &HomeState) -> Result<Vec<Option<bool>>, AgentError> {
    agent.plan_fully(&session.home, state)?;
    let goal = |task| match agent.planned().optimal(task) {
        OptimalSet::Approximate(_) | OptimalSet::Unknown => None,
        OptimalSet::Goal => Some(true),
        OptimalSet::Toward(_) | OptimalSet::DeadEnd(_) => Some(false),
    };
    Ok((0..session.tasks.len()).map(goal).collect())
}
