use std::path::PathBuf;

use learner::Samples;
use logs::{PrepareSettings, Prepared, Run, centre_commands, duplicate_of, rest_speeds};
use report::{DataSet, FileHash};
use robot::Loaded;

use super::arguments::Arguments;
use crate::error::CliError;
use crate::input::hashes_of;
use crate::input_warnings::input_warnings;
use crate::output::display_path;

/// What a log is for, behind its name in warnings.
const TEST: &str = "test";
const TRAINING: &str = "training";
const REGRESSION: &str = "regression";

/// Samples on which a model is tested at most; of more, so many evenly spread. A variance takes
/// as long as a thousand predictions.
const MOST_TESTED: usize = 5000;

/// The data that models learn from and are tested on, all through one filter.
pub struct LearningData {
    /// What Gaussian processes learn from.
    pub train: Set,
    /// What the rigid bodies come from, where that is something else.
    regression: Option<Set>,
    /// What the errors are measured on.
    pub test: Set,
    /// Cut-off of the filter (Hz).
    pub cutoff_hz: f64,
    /// Speed below which each joint counts as at rest (rad/s or m/s).
    pub rest_speeds: Vec<f64>,
    /// What to know about the logs.
    pub warnings: Vec<String>,
}

/// The samples of some logs.
pub struct Set {
    /// The files.
    logs: Vec<FileHash>,
    /// All samples in them.
    pub samples: Samples,
}

impl LearningData {
    /// Reads the logs, and refuses one that a model would be trained and tested on.
    pub fn read(arguments: &Arguments, loaded: &Loaded) -> Result<Self, CliError> {
        let read = |role: &str, paths: &[PathBuf]| -> Result<Vec<Run>, CliError> {
            let mut runs = arguments.reading.read_runs(paths, &loaded.robot)?;
            runs.iter_mut().for_each(|run| run.name = format!("{} ({role})", run.name));
            Ok(runs)
        };
        let test = read(TEST, &arguments.test)?;
        let train = read(TRAINING, &arguments.train)?;
        let regression = read(REGRESSION, &arguments.regression)?;
        let counts = [test.len(), train.len(), regression.len()];
        let runs: Vec<Run> = [test, train, regression].into_iter().flatten().collect();
        refuse_leak(&runs, counts[0])?;

        // Together, so that one filter and one kind of velocity serve them all.
        let cutoff_hz = arguments.cutoff_hz;
        let mut prepared = logs::prepare(&runs, &PrepareSettings { cutoff_hz })?;
        centre_commands(&loaded.robot, &mut prepared.runs, loaded.control.rate_hz);
        let parts = [TEST, TRAINING, REGRESSION].map(|role| part(&mut prepared, role));
        let mut files = hashes_of(&runs);
        let mut set = |which: usize| Set {
            logs: files.by_ref().take(counts[which]).collect(),
            samples: Samples::new(&parts[which]),
        };
        let (test, train, regression) = (set(0), set(1), set(2));
        let mut warnings = input_warnings(loaded, &runs);
        warnings.extend(prepared.warnings.iter().map(ToString::to_string));
        Ok(Self {
            rest_speeds: rest_speeds(&parts[1]),
            train,
            regression: (counts[2] > 0).then_some(regression),
            test,
            cutoff_hz: prepared.cutoff_hz,
            warnings,
        })
    }

    /// What the rigid bodies come from.
    pub fn regression(&self) -> &Set {
        self.regression.as_ref().unwrap_or(&self.train)
    }

    /// The samples that the models are tested on.
    pub fn test_samples(&self) -> Samples {
        self.test.samples.thin(MOST_TESTED)
    }
}

impl Set {
    /// The files, and how many of their samples are used where that is at most `points`.
    pub fn summary(&self, points: usize) -> DataSet {
        let rows = self.samples.len();
        DataSet { logs: self.logs.clone(), rows, points: rows.min(points) }
    }

    /// The files and how many samples the tests use.
    pub fn summary_of_test(&self) -> DataSet {
        self.summary(MOST_TESTED)
    }
}

/// Takes the runs of one role, whole or in parts, which their names end with.
fn part(prepared: &mut Prepared, role: &str) -> Prepared {
    let is_of = |name: &str| name.rsplit(" (").next().is_some_and(|end| end.starts_with(role));
    let all = std::mem::take(&mut prepared.runs);
    let (runs, others) = all.into_iter().partition(|run| is_of(&run.name));
    prepared.runs = others;
    prepared.with_runs(runs)
}

/// Refuses a recording among the first `tested` runs that comes again among the others.
fn refuse_leak(runs: &[Run], tested: usize) -> Result<(), CliError> {
    for index in tested..runs.len() {
        if let Some(test) = duplicate_of(runs, index).filter(|&earlier| earlier < tested) {
            return Err(CliError::TestedOnTraining {
                test: display_path(&runs[test].source),
                training: display_path(&runs[index].source),
            });
        }
    }
    Ok(())
}
