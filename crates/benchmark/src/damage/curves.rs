use std::fs;
use std::path::{Path, PathBuf};

use population::{LogDamageSpec, LogKind, PopulationSpec, TruthSheet, damage_logs, make_any};
use rayon::prelude::*;
use serde::Serialize;

use crate::damage::answer::DamageAnswer;
use crate::damage::outcome::{DamageOutcome, Telling};
use crate::damage::told::{is_effect, is_told};
use crate::error::BenchmarkError;
use crate::trial_folder::unusable;
use crate::trials::campaign::PopulationCampaign;
use crate::trials::hash::seed_of;

/// The schema that `damage.json` follows.
pub const DAMAGE_SCHEMA: &str = "plumbline.damage/1";

/// Sizes of the damage, as shares.
pub const DAMAGE_SIZES: [f64; 7] = [0.001, 0.003, 0.01, 0.03, 0.1, 0.3, 0.5];

/// Kinds of damage that have a curve: all with a share for a size, of logs with efforts.
pub fn damage_kinds() -> impl Iterator<Item = LogKind> {
    let kinds = LogKind::ALL.iter().copied();
    kinds.filter(|kind| !matches!(kind, LogKind::LowRate) && kind.sizes().is_some())
}

/// What is answered as the logs of some trials are spoilt more and more.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct DamageCurves {
    /// Always [`DAMAGE_SCHEMA`].
    pub schema: &'static str,
    /// The trials.
    pub trials: Vec<DamageTrial>,
    /// One entry for every kind, size and trial that can have it, in this order.
    pub points: Vec<DamagePoint>,
}

/// A trial before it is spoilt.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct DamageTrial {
    /// The seed of every draw.
    pub seed: u64,
    /// Name of its arm.
    pub arm: String,
    /// The verdict, in words.
    pub verdict: &'static str,
    /// What is named.
    pub names: Vec<String>,
}

/// The answer to one trial with one damage.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct DamagePoint {
    /// The kind of damage.
    pub kind: LogKind,
    /// Its size, as [`LogKind`] says.
    pub size: f64,
    /// Number of the trial among the trials.
    pub trial: usize,
    /// What was made of it.
    pub outcome: DamageOutcome,
    /// The verdict, in words.
    pub verdict: &'static str,
    /// What is named.
    pub names: Vec<String>,
    /// What is said of the logs, without what was said before they were spoilt.
    pub said: Vec<String>,
}

impl DamageCurves {
    /// Makes the simulated trials of a population in a folder, and spoils the logs of each with every kind at every size.
    /// `on_point` is called after every answer, from any thread.
    ///
    /// # Errors
    ///
    /// [`BenchmarkError`] when a trial cannot be made, spoilt or read.
    pub fn measure(
        campaign: &PopulationCampaign,
        kinds: &[LogKind],
        folder: &Path,
        on_point: &(dyn Fn() + Sync),
    ) -> Result<Self, BenchmarkError> {
        let spec = &campaign.population;
        let tasks: Vec<usize> = (0..spec.trials).collect();
        let made: Vec<MadeTrial> = tasks
            .par_iter()
            .map(|&task| MadeTrial::new(spec, task, folder))
            .collect::<Result<_, _>>()?;
        let mut points = Vec::new();
        for &kind in kinds {
            for size in DAMAGE_SIZES {
                points.extend((0..made.len()).map(|trial| (kind, size, trial)));
            }
        }
        let measured: Result<Vec<Option<DamagePoint>>, BenchmarkError> = points
            .into_par_iter()
            .map(|(kind, size, trial)| {
                let point = made[trial].damage((kind, size), trial, folder);
                on_point();
                point
            })
            .collect();
        Ok(Self {
            schema: DAMAGE_SCHEMA,
            points: measured?.into_iter().flatten().collect(),
            trials: made.into_iter().map(MadeTrial::summary).collect(),
        })
    }

    /// Number of points with this outcome.
    pub fn count(&self, outcome: DamageOutcome) -> usize {
        self.points.iter().filter(|point| point.outcome == outcome).count()
    }
}

/// A trial with its logs and the answer to them.
struct MadeTrial {
    seed: u64,
    arm: String,
    folder: PathBuf,
    answer: DamageAnswer,
}

impl MadeTrial {
    fn new(spec: &PopulationSpec, task: usize, folder: &Path) -> Result<Self, BenchmarkError> {
        let seed = seed_of(spec.seed, "population", task);
        let folder = folder.join("trials").join(format!("{task:05}"));
        make_any(spec, spec.origin(task), seed, &folder)?;
        let arm = TruthSheet::open(&folder)?.corner.arm;
        let answer = DamageAnswer::of_folder(&folder)?;
        Ok(Self { seed, arm, folder, answer })
    }

    fn damage(
        &self,
        (kind, size): (LogKind, f64),
        trial: usize,
        folder: &Path,
    ) -> Result<Option<DamagePoint>, BenchmarkError> {
        // The same seed at every size: the joint stays, and the rows of a smaller share are among those of a larger one.
        let spec = LogDamageSpec { kind, size, seed: self.seed ^ kind as u64 };
        let spoilt = folder.join("spoilt").join(format!("{kind}-{size}-{trial}"));
        let answer = |damage| Ok((damage, DamageAnswer::of_folder(&spoilt)?));
        let damaged = damage_logs(&self.folder, &spec, &spoilt).map_err(BenchmarkError::from);
        let answered = damaged.and_then(|damage| damage.map(answer).transpose());
        if spoilt.exists() {
            fs::remove_dir_all(&spoilt).map_err(unusable(&spoilt))?;
        }
        let Some((damage, after)) = answered? else { return Ok(None) };
        let is_told = is_told(&self.answer, &after, &damage);
        let telling = if is_told { Telling::Told } else { Telling::Untold };
        let place = format!("{}/", spoilt.display());
        let new = after.said.iter().filter(|text| !self.answer.said.contains(text));
        Ok(Some(DamagePoint {
            kind,
            size,
            trial,
            outcome: DamageOutcome::new(&self.answer, &after, telling, |effect| {
                is_effect(kind, effect)
            }),
            verdict: after.verdict.words(),
            names: after.names.iter().map(|name| name.at.words()).collect(),
            said: new.map(|text| text.replace(&place, "")).collect(),
        }))
    }

    fn summary(self) -> DamageTrial {
        DamageTrial {
            seed: self.seed,
            arm: self.arm,
            verdict: self.answer.verdict.words(),
            names: self.answer.names.iter().map(|name| name.at.words()).collect(),
        }
    }
}
