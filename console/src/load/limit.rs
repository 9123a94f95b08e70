//! How much of a long log is read.

use clap::Args;

/// How many sessions are read.
#[derive(Clone, Copy, Debug, Default, Args)]
pub struct Limit {
    /// Read only the first N sessions of a log, or of all the logs that are read together; N is 1 or more
    #[arg(long, value_name = "N", value_parser = sessions, allow_negative_numbers = true)]
    limit: Option<usize>,
}

fn sessions(text: &str) -> Result<usize, String> {
    text.trim().parse().ok().filter(|&count| count > 0).ok_or_else(|| "give a whole number of 1 or more".to_owned())
}

impl Limit {
    /// How many there are at most.
    pub fn count(self) -> usize {
        self.limit.unwrap_or(usize::MAX)
    }
}
