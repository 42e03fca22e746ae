use std::fmt;
use std::num::NonZeroUsize;
use std::str::FromStr;

/// One of several parts of a campaign, such as the first of four, `1/4`: every fourth trial.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Part {
    /// Its number, from 1.
    number: usize,
    /// Number of parts.
    of: usize,
}

/// A text that does not name a part.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("{0:?}: a part such as 1/4 was expected, the first number from 1 to the second")]
pub struct BadPart(String);

impl Part {
    /// The whole campaign.
    pub const WHOLE: Self = Self { number: 1, of: 1 };

    /// The part that a task belongs to, out of `of` parts.
    pub fn of_task(task: usize, of: NonZeroUsize) -> Self {
        Self { number: task % of + 1, of: of.get() }
    }

    /// Its number, from 1.
    pub fn number(self) -> usize {
        self.number
    }

    /// Whether a task belongs to the part.
    pub fn holds(self, task: usize) -> bool {
        task % self.of == self.number - 1
    }
}

impl FromStr for Part {
    type Err = BadPart;

    fn from_str(text: &str) -> Result<Self, BadPart> {
        let numbers = text.split_once('/').and_then(|(number, of)| {
            let (number, of) = (number.parse().ok()?, of.parse().ok()?);
            (1..=of).contains(&number).then_some(Self { number, of })
        });
        numbers.ok_or_else(|| BadPart(text.to_owned()))
    }
}

impl fmt::Display for Part {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}/{}", self.number, self.of)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_parts_hold_every_task_once() {
        for of in 1..=5 {
            let parts = (1..=of).map(|k| format!("{k}/{of}").parse::<Part>().unwrap());
            let parts: Vec<Part> = parts.collect();
            assert!((0..23).all(|task| parts.iter().filter(|part| part.holds(task)).count() == 1));
        }
        assert_eq!("1/1".parse(), Ok(Part::WHOLE));
    }

    #[test]
    fn a_task_belongs_to_the_part_that_holds_it() {
        let of = NonZeroUsize::new(4).unwrap();
        for task in 0..9 {
            let part = Part::of_task(task, of);
            assert!(part.holds(task));
            assert_eq!(part.to_string(), format!("{}/4", part.number()));
        }
        assert_eq!(Part::of_task(7, NonZeroUsize::MIN), Part::WHOLE);
    }

    #[test]
    fn a_part_is_one_of_as_many_as_there_are() {
        for text in ["0/4", "5/4", "1/0", "1", "", "1/4/2", "-1/4", "a/b"] {
            assert_eq!(text.parse::<Part>(), Err(BadPart(text.to_owned())));
        }
    }
}
