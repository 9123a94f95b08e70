//! The kinds of tasks that commands may mean.

use clap::Args;
use goodbot::home;
use goodbot::task::{LiftedTask, TaskTextError};

/// The kinds of tasks that commands may mean.
#[derive(Clone, Debug, Args)]
pub struct TaskKinds {
    /// A kind of task that commands may mean, such as "agentInRoom(?a,?r1) & blockInRoom(?o,?r2)"; may be given several times. The
    /// paper's two, if none is given.
    #[arg(long = "task", alias = "lifted", value_name = "TASK", value_parser = Self::parse)]
    kinds: Vec<LiftedTask>,
}

impl TaskKinds {
    /// The lifted tasks.
    pub fn lifted(&self) -> Result<Vec<LiftedTask>, TaskTextError> {
        if self.kinds.is_empty() { Ok(home::paper_tasks()?.to_vec()) } else { Ok(self.kinds.clone()) }
    }

    /// The paper's two, and others beside them.
    pub fn and(others: &[LiftedTask]) -> Result<Vec<LiftedTask>, TaskTextError> {
        Ok(home::paper_tasks()?.into_iter().chain(others.iter().cloned()).collect())
    }

    /// One kind of task.
    pub fn parse(text: &str) -> Result<LiftedTask, String> {
        LiftedTask::parse(text, &home::SCHEMA).map_err(|error| error.to_string())
    }
}
