//! Recorded sessions as the trainer saw them: actions that were right or wrong for each task, and the end of the session.

use goodbot::feedback::{Feedback, Judged, Moment};
use goodbot::memory::AgentHeap;
use goodbot::oomdp::Action;
use goodbot::planning::OptimalSet;
use goodbot::task::{GroundedTask, LiftedTask};
use goodbot::{Agent, Capacities, Options};
use goodbot_console::{Failure, InputFile, counting, input};
use goodbot_formats::session::{Kind, RecordedSession, SessionReader};
use goodbot_lesson::checked::check;
use goodbot_lesson::replay::{Event, Replay, Rules};
use goodbot_lesson::{Fault, home};

/// One step of a session.
#[derive(Clone, Debug)]
pub struct WalkStep {
    /// Whether each task was done before it; `None` if unknown.
    pub began: Vec<Option<bool>>,
    /// The judgement of the action for each task.
    pub judged: Vec<Judged>,
    /// The trainer's feedback to it.
    pub feedback: Feedback,
    /// The last actions and the last feedback after it.
    pub moment: Moment,
    /// Whether each task was done after it; `None` if unknown.
    pub at_goal: Vec<Option<bool>>,
}

/// A session.
#[derive(Clone, Debug)]
pub struct Walk {
    /// Its id in the log.
    pub id: Option<String>,
    /// The trainer: see [`trainer_of`].
    pub trainer: String,
    /// Whether it continued the one before.
    pub continues: bool,
    /// The tasks' prior.
    pub prior: Vec<f32>,
    /// The position of the intended task.
    pub intended: Option<usize>,
    /// The steps.
    pub steps: Vec<WalkStep>,
}

impl Walk {
    /// Whether the trainer gave any feedback.
    pub fn has_feedback(&self) -> bool {
        self.steps.iter().any(|step| step.feedback != Feedback::Neutral)
    }
}

/// The trainer of a session: its id up to the first dot, as in `w03.1-2`; without a dot, the file's name.
pub fn trainer_of<'a>(id: Option<&'a str>, file: &'a str) -> &'a str {
    id.and_then(|id| id.split_once('.')).map_or(file, |(trainer, _)| trainer)
}

/// Reads the sessions with feedback of these files, and plans for each of their steps.
///
/// # Errors
/// The first fault.
pub fn read(files: &[InputFile], lifted: &[LiftedTask]) -> Result<Vec<Walk>, Failure> {
    let mut agent = Agent::new(AgentHeap::new(&Capacities::STANDARD), lifted, Options::PAPER)?;
    let mut walks = vec![];
    let progress = counting("planning for sessions");
    for file in files {
        let opened = input::log(file)?;
        let name = input::name(file);
        for session in SessionReader::new(opened) {
            progress.inc(1);
            let recorded = session.map_err(|error| Fault::from_format(name, error))?;
            if recorded.header.kind == Kind::Feedback {
                walks.push(walk(&mut agent, name, &recorded, lifted)?);
            }
        }
    }
    progress.finish_and_clear();
    Ok(walks)
}

fn walk(agent: &mut Agent<AgentHeap>, file: &str, recorded: &RecordedSession, lifted: &[LiftedTask]) -> Result<Walk, Vec<Fault>> {
    let header = &recorded.header;
    let session = check(file, recorded, lifted, home::memory())?;
    let mut replay = Replay::new(Rules::PLANS);
    let mut steps: Vec<WalkStep> = vec![];
    let mut moment = Moment::default();
    loop {
        let event = replay.advance(agent, &session.walk, u32::MAX);
        let event = event.map_err(|refused| vec![Fault::on_line(file, refused.line, refused.error)])?;
        let planned = match event {
            Event::Ended => break,
            Event::Planned(planned) => planned,
            _ => continue,
        };
        // Each step begins where the last one ended.
        let here: Vec<Option<bool>> = (0..session.tasks.len()).map(|task| at_goal(agent.planned().optimal(task))).collect();
        if let Some(last) = steps.last_mut() {
            if last.moment.rests == 0 {
                let inside = last.began.iter().zip(&here).map(|(began, here)| (*began, *here) == (Some(true), Some(true)));
                last.judged.iter_mut().zip(inside).filter(|(_, inside)| *inside).for_each(|(judged, _)| *judged = Judged::MovesInside);
            }
            last.at_goal.clone_from(&here);
        }
        steps.extend(planned.map(|step| {
            let rests = step.action == Action::NOOP;
            moment = moment.acted(rests).heard(step.feedback);
            let judged = |task| Judged::of(agent.planned().judge(task, step.action), rests);
            let judged = (0..session.tasks.len()).map(judged).collect();
            WalkStep { began: here, judged, feedback: step.feedback, moment, at_goal: vec![] }
        }));
    }
    agent.forget();
    let trainer = trainer_of(header.id.as_deref(), file).to_owned();
    let prior = |task: &GroundedTask| match &session.walk.prior {
        Some(recorded) => recorded.iter().find(|(known, _)| known == task).map_or(0.0, |&(_, share)| share),
        None => task.prior,
    };
    let prior = session.tasks.iter().map(|(task, _)| prior(task)).collect();
    Ok(Walk { id: header.id.clone(), trainer, continues: header.continues, prior, intended: session.intended, steps })
}

/// Whether a task is done, by its plan; `None` if unknown.
const fn at_goal(plan: OptimalSet) -> Option<bool> {
    match plan {
        OptimalSet::Approximate(_) | OptimalSet::Unknown => None,
        OptimalSet::Goal => Some(true),
        OptimalSet::Toward(_) | OptimalSet::DeadEnd(_) => Some(false),
    }
}
