//! The kinds of tasks that commands may mean.

use crate::outcome::Failure;
use crate::whole_file::read_model;
use clap::Args;
use goodbot::capacity::LIFTED_TASKS;
use goodbot::home;
use goodbot::task::{LiftedTask, TaskTextError};
use goodbot_lesson::kept_kinds::{self, are_same};
use std::path::Path;

/// The kinds of tasks that commands may mean.
#[derive(Clone, Debug, Args)]
pub struct TaskKinds {
    /// A kind of task that commands may mean beside the paper's two, such as "agentInRoom(?a,?r1) & blockInRoom(?o,?r2)" or
    /// "agentInRoom(?a,?r) through agentInRoom(?a,?via)"; may be given several times
    #[arg(long = "task", short = 't', alias = "lifted", value_name = "TASK", value_parser = Self::parse)]
    kinds: Vec<LiftedTask>,
    /// Consider ways too: each kind of task also through a room, through one of two rooms, and avoiding a room
    #[arg(long)]
    routes: bool,
    /// Leave out the paper's two kinds of tasks
    #[arg(long, requires = "kinds")]
    only_these_tasks: bool,
}

impl TaskKinds {
    /// The lifted tasks: the paper's two, unless they are left out, and those of the options.
    ///
    /// # Errors
    /// [`Failure::Input`] if they are too many.
    pub fn lifted(&self) -> Result<Vec<LiftedTask>, Failure> {
        let paper = home::paper_tasks()?;
        let mut lifted = if self.only_these_tasks { vec![] } else { paper.to_vec() };
        for kind in &self.kinds {
            if !lifted.contains(kind) {
                lifted.push(kind.clone());
            }
        }
        if self.routes {
            let most = LIFTED_TASKS / 4;
            lifted = home::with_routes(&lifted).map_err(|error| Failure::Input(match error {
                TaskTextError::Capacity(_) => format!("with --routes {most} kinds of tasks are the most, because each counts four times; name fewer with --task, or leave out the paper's with --only-these-tasks"),
                error => error.to_string(),
            }))?.to_vec();
        }
        if lifted.len() > LIFTED_TASKS {
            return Err(Failure::Input(format!("{} kinds of tasks are {LIFTED_TASKS} at most; name fewer with --task", lifted.len())));
        }
        Ok(lifted)
    }

    /// The lifted tasks of a model: those that its file keeps. If it keeps none, they are those of the options.
    ///
    /// # Errors
    /// The errors of [`lifted`](Self::lifted), and an error if the file is no model, or keeps other kinds than the options name.
    pub fn of_model(&self, file: &Path) -> Result<Vec<LiftedTask>, Failure> {
        let asked = if self.is_given() { Some(self.lifted()?) } else { None };
        match kept(file, &read_model(file)?)? {
            Some(kept) => agreed(file, kept, asked, "the options"),
            None => self.lifted(),
        }
    }

    const fn is_given(&self) -> bool {
        self.routes || self.only_these_tasks || !self.kinds.is_empty()
    }

    /// One kind of task.
    pub fn parse(text: &str) -> Result<LiftedTask, String> {
        LiftedTask::parse(text, &home::SCHEMA).map_err(|error| match error {
            TaskTextError::UnknownProposition { .. } => {
                let known: Vec<&str> = home::SCHEMA.propositions.iter().map(|known| known.name).collect();
                format!("a name in it is no propositional function; known are {}", known.join(", "))
            }
            error => error.to_string(),
        })
    }
}

/// The kinds of task that a model of homes keeps; `None` if it keeps none: they are then the paper's two, or unknown.
///
/// # Errors
/// [`Failure::Input`] if they are damaged.
pub fn kept(file: &Path, model: &[u8]) -> Result<Option<Vec<LiftedTask>>, Failure> {
    let texts = kept_kinds::of(model).map_err(|error| Failure::of(file, error))?;
    // Kinds of another vocabulary are handled when the model is restored: the model is refused, or its words are kept.
    Ok(texts.and_then(|texts| texts.iter().map(|text| TaskKinds::parse(text).ok()).collect()))
}

/// The kinds of task that a model keeps, if no others are asked for.
///
/// # Errors
/// [`Failure::Input`] names both kinds if they differ. `who` asks for them.
pub fn agreed(file: &Path, kept: Vec<LiftedTask>, asked: Option<Vec<LiftedTask>>, who: &str) -> Result<Vec<LiftedTask>, Failure> {
    let Some(asked) = asked else { return Ok(kept) };
    let [ours, theirs] = [texts(&kept), texts(&asked)];
    if are_same(&ours, &theirs) {
        return Ok(kept);
    }
    Err(Failure::Input(format!(
        "{}: was learned for the kinds of task {}, and {who} would have {}; leave out {who}, or name another model",
        file.display(),
        ours.join("; "),
        theirs.join("; ")
    )))
}

/// The texts of kinds of task of homes.
pub fn texts(lifted: &[LiftedTask]) -> Vec<String> {
    lifted.iter().map(|kind| kept_kinds::text(kind, &home::SCHEMA)).collect()
}

/// A model file for homes, with its kinds of task. The paper's kinds are left out: a file without kinds is for every robot.
pub fn with_kinds(model: Vec<u8>, lifted: &[LiftedTask]) -> Vec<u8> {
    let is_papers = home::paper_tasks().is_ok_and(|paper| are_same(&texts(&paper), &texts(lifted)));
    if is_papers { model } else { kept_kinds::with(&model, &texts(lifted)) }
}
