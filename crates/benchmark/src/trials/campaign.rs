use std::path::{Path, PathBuf};

use document::{Document, KeyPath};
use population::{Origin, PopulationSpec, Remade, Store};
use schemars::JsonSchema;
use serde::de::IgnoredAny;
use serde::{Deserialize, Serialize};

use crate::error::BenchmarkError;
use crate::panel::judgement::Judgement;
use crate::panel::population_trial;
use crate::trials::hash::{hexadecimal, seed_of};
use crate::trials::hidden::Hidden;
use crate::trials::scenario_campaign::ScenarioCampaign;

/// Version of what a shard holds. Another version gives every campaign another identity, so that shards of a judge that
/// scored otherwise are named and made again.
const JUDGE: &str = "judge/2\n";

/// The key of a population.
const POPULATION: &str = "population";

/// A campaign of blind trials: many random arms, or one arm with hidden effects. Trials of both are judged alike.
#[derive(Debug, Clone)]
pub enum Campaign {
    /// Trials of the arm of a scenario.
    Scenario(ScenarioCampaign),
    /// Trials with random arms, sensors, motions and causes.
    Population(Box<PopulationCampaign>),
}

/// A campaign of trials of a population.
///
/// ```text
/// seed of a task = first 63 bits of SHA-256("seed/population/task")
/// ```
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(title = "Plumbline campaign of trials of a population")]
pub struct PopulationCampaign {
    /// What is drawn.
    pub population: PopulationSpec,
}

/// The key that tells a population from a scenario.
#[derive(Deserialize)]
struct Form {
    population: Option<IgnoredAny>,
}

impl Campaign {
    /// Reads a campaign from a document: a population where the document has its key.
    ///
    /// # Errors
    ///
    /// [`ExperimentError::Document`](experiment::ExperimentError::Document) at the value at fault, and the errors of
    /// a scenario.
    pub fn from_document(document: &Document) -> Result<Self, BenchmarkError> {
        if document.parse::<Form>()?.population.is_none() {
            return Ok(Self::Scenario(ScenarioCampaign::from_document(document)?));
        }
        let file: PopulationCampaign = document.parse()?;
        let key = KeyPath::root().key(POPULATION);
        let population = PopulationSpec::from_document(document, &key, file.population)?;
        Ok(Self::Population(Box::new(PopulationCampaign { population })))
    }

    /// The campaign as one text; `scenario` is the name of the scenario file beside it, if it has one.
    pub(super) fn self_contained_text(&self, scenario: &str) -> String {
        match self {
            Self::Scenario(campaign) => campaign.self_contained_text(scenario),
            // What has come from TOML can be written as TOML.
            Self::Population(campaign) => toml::to_string(campaign).unwrap_or_default(),
        }
    }

    /// The scenario that every trial starts from, settings included.
    pub(super) fn scenario(&self) -> Option<&str> {
        match self {
            Self::Scenario(campaign) => Some(campaign.scenario()),
            Self::Population(_) => None,
        }
    }

    /// The hidden effects, kind by kind; empty for a population.
    pub fn kinds(&self) -> &[Hidden] {
        match self {
            Self::Scenario(campaign) => campaign.kinds(),
            Self::Population(_) => &[],
        }
    }

    /// Number of trials.
    pub fn trials(&self) -> usize {
        match self {
            Self::Scenario(campaign) => campaign.trials(),
            Self::Population(campaign) => campaign.population.tasks(),
        }
    }

    /// Identity of the campaign: SHA-256 of everything that its scores depend on, except for this program and the
    /// recorded logs of a population.
    pub fn hash(&self) -> String {
        let identity = match self {
            Self::Scenario(campaign) => campaign.identity(),
            Self::Population(campaign) => campaign.population.identity(),
        };
        hexadecimal(&(JUDGE.to_owned() + &identity))
    }

    /// The kind (if there are kinds) and the seed of a task, from 0 to [`trials`](Self::trials) - 1.
    pub fn task(&self, task: usize) -> (Option<Hidden>, u64) {
        match self {
            Self::Scenario(campaign) => {
                let (hidden, seed) = campaign.task(task);
                (Some(hidden), seed)
            }
            Self::Population(campaign) => {
                (None, seed_of(campaign.population.seed, POPULATION, task))
            }
        }
    }

    /// Path of the logs of a task among the kept logs: `KIND/SEED`.
    pub(super) fn logs(&self, task: usize) -> PathBuf {
        let (hidden, seed) = self.task(task);
        let kind = hidden.map_or_else(|| POPULATION.to_owned(), |hidden| hidden.to_string());
        PathBuf::from(kind).join(seed.to_string())
    }

    /// Whether a folder holds all logs of a task, so that they can be used again. `scenario` is the file of the
    /// scenario that the task starts from. Logs of a population are used again from a store only.
    pub(super) fn is_logged(&self, task: usize, scenario: &Path, folder: &Path) -> bool {
        match self {
            Self::Scenario(campaign) => campaign.trial(task, scenario).is_logged(folder),
            Self::Population(_) => false,
        }
    }

    /// Whether a store has the logs of a task.
    pub(super) fn is_stored(&self, task: usize, store: Option<&Store>) -> bool {
        match (self, store) {
            (Self::Population(campaign), Some(store)) => {
                let (spec, (_, seed)) = (&campaign.population, self.task(task));
                spec.origin(task) == Origin::Simulated && store.holds(spec, seed)
            }
            _ => false,
        }
    }

    /// Makes the trial of a task, with its logs in `folder` or from the store of a population. An entry of the store
    /// that cannot be used is made again.
    pub(super) fn make(
        &self,
        task: usize,
        scenario: &Path,
        folder: &Path,
        store: Option<&Store>,
    ) -> Result<(Box<Judgement>, Option<Remade>), BenchmarkError> {
        match self {
            Self::Scenario(campaign) => {
                Ok((Box::new(campaign.trial(task, scenario).run(folder)?), None))
            }
            Self::Population(campaign) => {
                let (spec, (_, seed)) = (&campaign.population, self.task(task));
                let judged = population_trial::run(spec, (task, seed), folder, store)?;
                Ok((Box::new(judged.judgement), judged.remade))
            }
        }
    }
}
