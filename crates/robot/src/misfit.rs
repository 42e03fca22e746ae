use document::{Document, KeyPath};

use crate::error::RobotError;

/// What a key of a `robot.toml` says that cannot be meant.
#[derive(Debug)]
pub(crate) struct Misfit {
    key: KeyPath,
    problem: Problem,
}

#[derive(Debug)]
enum Problem {
    /// What was found and what was expected.
    Sentence(String),
    /// A name that nothing carries.
    Name { what: &'static str, found: String, known: Vec<String> },
}

impl Misfit {
    /// A sentence that says what was found at `key` and what was expected.
    pub fn new(key: KeyPath, sentence: String) -> Self {
        Self { key, problem: Problem::Sentence(sentence) }
    }

    /// A name at `key`, or that of `key` itself, that is none of the `known` ones.
    pub fn name<'a>(
        key: KeyPath,
        what: &'static str,
        found: &str,
        known: impl IntoIterator<Item = &'a str>,
    ) -> Self {
        let known = known.into_iter().map(str::to_owned).collect();
        Self { key, problem: Problem::Name { what, found: found.to_owned(), known } }
    }

    /// The mistake where it stands in the file.
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
