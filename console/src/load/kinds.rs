//! The kinds of tasks that commands may mean.

use crate::outcome::Failure;
use clap::Args;
use goodbot::capacity::LIFTED_TASKS;
use goodbot::home;
use goodbot::task::{LiftedTask, TaskTextError};

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
    /// The lifted tasks: the paper's two, unless they are left out, and those that were named.
    ///
    /// # Errors
    /// [`Failure::Input`] where they are too many.
    pub fn lifted(&self) -> Result<Vec<LiftedTask>, Failure> {
        let paper = home::paper_tasks().map_err(|error| Failure::Input(error.to_string()))?;
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

    /// One kind of task.
    pub fn parse(text: &str) -> Result<LiftedTask, String> {
        LiftedTask::parse(text, &home::SCHEMA).map_err(|error| error.to_string())
    }
}
