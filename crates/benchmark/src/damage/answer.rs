use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::Path;

use diagnosis::{EffectAt, Finding, Settings, Silent, Verdict};
use experiment::ExperimentError;
use robot::Robot;

use crate::disk_failure::is_of_the_disk;
use crate::error::BenchmarkError;
use crate::trial_folder::read_runs;

/// The answer of a diagnosis to the logs of a folder, as far as damage may change it.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct DamageAnswer {
    /// The verdict; that of logs that are refused is inadequate data.
    pub verdict: Verdict,
    /// What is named, with its rivals and the interval of every size that is determined.
    pub names: Vec<NamedSizes>,
    /// All that is said of the logs: warnings, or why they are refused.
    pub said: Vec<String>,
}

/// A name of an answer.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct NamedSizes {
    pub at: EffectAt,
    /// What explains the logs as well.
    pub rivals: Vec<EffectAt>,
    /// 95 % intervals of the determined sizes, by parameter.
    pub sizes: Vec<(&'static str, [f64; 2])>,
}

impl DamageAnswer {
    /// Diagnoses the logs of a folder, `nominal/` and `logs/`, as a trial of a population is diagnosed.
    ///
    /// # Errors
    ///
    /// [`BenchmarkError`] when the folder cannot be read. Logs that are refused are an answer.
    pub fn of_folder(folder: &Path) -> Result<Self, BenchmarkError> {
        let loaded = Robot::load(&folder.join("nominal").join("robot.toml"))?;
        let settings = Settings { control_rate_hz: loaded.control.rate_hz, ..Settings::default() };
        let given = match read_runs(&folder.join("logs"), &loaded.robot) {
            Ok(given) => given,
            Err(error) if is_of_the_disk(&error) => return Err(error),
            Err(BenchmarkError::Experiment(error)) => {
                let ExperimentError::Log(refusal) = &*error else { return Err((*error).into()) };
                return Ok(Self::refusal(refusal.to_string()));
            }
            Err(error) => return Err(error),
        };
        let work = || diagnosis::diagnose(&loaded.robot, &given, &settings, &Silent);
        Ok(match catch_unwind(AssertUnwindSafe(work)) {
            Ok(Ok(run)) => Self {
                verdict: run.diagnosis.verdict,
                names: run.diagnosis.findings.iter().map(NamedSizes::new).collect(),
                // The reason of a joint without an answer says what spoils its logs.
                said: run
                    .diagnosis
                    .warnings
                    .into_iter()
                    .chain(run.diagnosis.joints.into_iter().map(|joint| joint.because))
                    .collect(),
            },
            Ok(Err(error)) => Self::refusal(error.to_string()),
            Err(_) => Self::refusal("the program gave up".to_owned()),
        })
    }

    fn refusal(why: String) -> Self {
        Self { verdict: Verdict::DataInadequate, names: Vec::new(), said: vec![why] }
    }

    /// Whether it leaves nothing open: the program then ends with code 0.
    pub fn is_closed(&self) -> bool {
        matches!(self.verdict, Verdict::Consistent | Verdict::Explained)
    }
}

impl NamedSizes {
    fn new(finding: &Finding) -> Self {
        let determined = finding.parameters.iter().filter(|size| size.determined);
        Self {
            at: finding.at.clone(),
            rivals: finding.not_separable_from.clone(),
            sizes: determined.map(|size| (size.name, size.ci95)).collect(),
        }
    }

    /// Whether another name is the same, or a rival of this one.
    pub fn covers(&self, other: &Self) -> bool {
        self.at == other.at || self.rivals.contains(&other.at)
    }

    /// Whether the intervals of every size that both tell meet.
    pub fn agrees(&self, other: &Self) -> bool {
        self.sizes.iter().all(|(name, [low, high])| {
            let same = other.sizes.iter().filter(|(other, _)| other == name);
            same.into_iter().all(|(_, [least, most])| low <= most && least <= high)
        })
    }
}
