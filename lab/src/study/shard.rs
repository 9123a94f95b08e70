//! A part of a study, so that several machines can share the work.

use std::fmt;
use std::str::FromStr;

/// One of several parts. Part `number` has the seed at position `number`, counted from 1, and every `of`-th seed after it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Shard {
    /// The number of the part, from 1.
    pub number: u32,
    /// The number of parts.
    pub of: u32,
}

impl Shard {
    /// The whole study.
    pub const WHOLE: Self = Self { number: 1, of: 1 };

    /// Whether the part has the seed at a position, counted from 0.
    pub const fn has(self, position: u32) -> bool {
        position % self.of == self.number - 1
    }
}

impl fmt::Display for Shard {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}/{}", self.number, self.of)
    }
}

impl FromStr for Shard {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let example = "write PART/OF, such as 1/4 for the first of four";
        let (number, of) = text.split_once('/').ok_or_else(|| example.to_owned())?;
        let whole = |text: &str| text.trim().parse::<u32>().ok().filter(|&number| number > 0);
        let (Some(number), Some(of)) = (whole(number), whole(of)) else {
            return Err(format!("both must be whole numbers from 1; {example}"));
        };
        if number > of {
            return Err(format!("there is no part {number} of {of}; the last is {of}/{of}"));
        }
        Ok(Self { number, of })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_seed_belongs_to_one_part() {
        let parts: Vec<Shard> = ["1/3", "2/3", "3/3"].map(|text| text.parse().unwrap()).to_vec();
        for position in 0..10 {
            assert_eq!(parts.iter().filter(|part| part.has(position)).count(), 1);
        }
    }

    #[test]
    fn what_is_no_part_is_refused_with_an_example() {
        for text in ["3/2", "0/2", "1/0", "1", "a/b", "-1/2", ""] {
            let error = text.parse::<Shard>().unwrap_err();
            assert!(error.contains("1/4") || error.contains("the last is 2/2"), "{text}: {error}");
        }
    }
}
