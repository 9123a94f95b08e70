//! Limits the sessions read from a long log.

use clap::Args;

/// The option for the limit.
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
    /// The most sessions to read.
    pub fn count(self) -> usize {
        self.limit.unwrap_or(usize::MAX)
    }
}
