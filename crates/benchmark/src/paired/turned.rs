use serde::Serialize;

use crate::paired::measures::Measure;
use crate::trials::record::Record;

/// A trial that two results answer differently.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct Turned {
    /// Its index in the campaign.
    pub task: usize,
    /// Its seed.
    pub seed: u64,
    /// The hidden effects, or the corner of the population.
    pub about: String,
    /// Measures in which the second result is better.
    pub better: Vec<Measure>,
    /// Measures in which the first result is better.
    pub worse: Vec<Measure>,
}

impl Turned {
    /// `None` where both results agree.
    pub(super) fn new(first: &Record, second: &Record) -> Option<Self> {
        let measures_that_turn = |better: bool| {
            let is = |measure: &Measure| match (measure.of(first), measure.of(second)) {
                (Some(a), Some(b)) => a != b && (b == measure.is_yes_better()) == better,
                _ => false,
            };
            Measure::ALL.into_iter().filter(is).collect::<Vec<_>>()
        };
        let (better, worse) = (measures_that_turn(true), measures_that_turn(false));
        let some = !better.is_empty() || !worse.is_empty();
        let (task, seed) = (first.task, first.seed);
        some.then(|| Self { task, seed, about: about([first, second]), better, worse })
    }

    /// The trial in a line, such as `task 3, seed 99 (cobot, sweep): better: right; worse: false alarm`.
    pub fn words(&self) -> String {
        let list = |name: &str, measures: &[Measure]| {
            let names: Vec<String> = measures.iter().map(Measure::to_string).collect();
            (!names.is_empty()).then(|| format!("{name}: {}", names.join(", ")))
        };
        let parts = [list("better", &self.better), list("worse", &self.worse)];
        let parts: Vec<String> = parts.into_iter().flatten().collect();
        format!("task {}, seed {} ({}): {}", self.task, self.seed, self.about, parts.join("; "))
    }
}

fn about(records: [&Record; 2]) -> String {
    let hidden = |record: &&Record| record.hidden.map(|hidden| hidden.to_string());
    let corner = |record: &&Record| {
        let corner = &record.judgement()?.corner;
        Some(format!("{}, {}", corner.arm, corner.motion).replace('_', " "))
    };
    let about = records.iter().find_map(hidden).or_else(|| records.iter().find_map(corner));
    about.unwrap_or_else(|| "population".to_owned())
}
