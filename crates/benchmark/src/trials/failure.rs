use std::collections::BTreeMap;

use serde::Serialize;

use crate::trials::campaign_folder::Manifest;

/// Trials that failed for the same reason.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct Failure {
    /// The hidden effects, or `population`.
    pub hidden: String,
    /// The reason, in words.
    pub error: String,
    /// Their seeds.
    pub seeds: Vec<u64>,
}

impl Failure {
    /// One entry for each kind and reason.
    pub(crate) fn all(made: &Manifest) -> Vec<Self> {
        let mut failures: BTreeMap<(String, String), Vec<u64>> = BTreeMap::new();
        for record in made.records.values() {
            if let Err(error) = &record.score {
                let hidden = record.hidden.map(|hidden| hidden.to_string());
                let hidden = hidden.unwrap_or_else(|| "population".to_owned());
                failures.entry((hidden, error.clone())).or_default().push(record.seed);
            }
        }
        let failure = |((hidden, error), seeds)| Self { hidden, error, seeds };
        failures.into_iter().map(failure).collect()
    }

    /// Number, kind and reason, after a blank line.
    pub(crate) fn words(&self) -> String {
        let Self { hidden, error, seeds } = self;
        let first = seeds.first().map_or(String::new(), |seed| format!(", seed {seed} first"));
        format!("\n{} failed of {hidden}{first}: {error}\n", seeds.len())
    }
}
