use document::{Document, KeyPath};

use crate::error::RobotError;

/// A value of a `robot.toml` that cannot be used, with its key.
#[derive(Debug)]
pub(crate) struct Misfit {
    key: KeyPath,
    problem: Problem,
}

#[derive(Debug)]
enum Problem {
    /// What was found and what was expected.
    Sentence(String),
    /// An unknown name.
    Name { what: &'static str, found: String, known: Vec<String> },
}

impl Misfit {
    /// A sentence that says what was found at `key` and what was expected.
    pub fn new(key: KeyPath, sentence: String) -> Self {
        Self { key, problem: Problem::Sentence(sentence) }
    }

    /// An unknown name, at `key` or as the last segment of `key`, with the `known` names.
    pub fn name<'a>(
        key: KeyPath,
        what: &'static str,
        found: &str,
        known: impl IntoIterator<Item = &'a str>,
    ) -> Self {
        let known = known.into_iter().map(str::to_owned).collect();
        Self { key, problem: Problem::Name { what, found: found.to_owned(), known } }
    }

    /// Turns it into an error that shows its place in the file.
    pub fn locate_in(self, document: &Document) -> RobotError {
        let mistake = match self.problem {
            Problem::Sentence(sentence) => document.mistake(&self.key, sentence, None),
            Problem::Name { what, found, known } => {
                let known: Vec<&str> = known.iter().map(String::as_str).collect();
                document.unknown_name(&self.key, what, &found, &known)
            }
        };
        RobotError::InToml { problem: Box::new(mistake) }
    }
}
