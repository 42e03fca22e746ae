use std::path::Path;

use document::Document;
use experiment::{
    FeedforwardKind, Learned, Outputs, Progress, TrackedRun, TrackingScenario, simulated_logs,
    sweep, track_all,
};
use recording::Live;
use report::{ReportError, TrackingComparison};

use super::comparison;
use crate::error::CliError;
use crate::output::create_folder;

/// What is tracked.
pub struct Asked<'a> {
    /// The file of the scenario.
    pub scenario: &'a Path,
    /// Values in the place of the scenario's, as `key=value`.
    pub set: &'a [String],
    /// What is fed forward; what the scenario says where there is none.
    pub feedforward: &'a [FeedforwardKind],
    /// A folder of models that were learned before, in the place of learning them.
    pub learned: Option<&'a Path>,
    /// The folder that models, logs and recordings are written into while the work goes on, if any is.
    pub out: Option<&'a Path>,
    /// Whether a running viewer sees the runs.
    pub live: bool,
    /// The command line that does the same, where this process was not started with it.
    pub command: Option<Vec<String>>,
}

/// A motion tracked with every feedforward, and how they compare.
pub struct Tracked {
    scenario: TrackingScenario,
    runs: Vec<TrackedRun>,
    comparison: TrackingComparison,
}

impl Tracked {
    /// Learns what is asked for, tracks the motion with each model, and compares them.
    ///
    /// # Errors
    ///
    /// [`CliError`] for a scenario, models or an arm that cannot be used, and for files that cannot be written.
    pub fn new(asked: &Asked, progress: &dyn Progress) -> Result<Self, CliError> {
        let scenario = TrackingScenario::from_document(&document(asked)?)?;
        let outputs = asked.out.map(|out| Outputs {
            logs: out.join("logs"),
            recordings: recording::IS_BUILT.then(|| out.join("recordings")),
            live: if asked.live { Live::On } else { Live::Off },
        });
        if let (Some(out), Some(outputs)) = (asked.out, &outputs) {
            let folders = [out, outputs.logs.as_path()].into_iter();
            folders.chain(outputs.recordings.as_deref()).try_for_each(create_folder)?;
        }
        let learned = models(asked, &scenario, progress)?;
        let runs = track_all(&scenario, &learned, outputs.as_ref(), progress)?;
        let swept = sweep(&scenario, &learned, progress)?;
        let mut comparison = comparison(asked.scenario, &scenario, &runs, swept.as_ref())?;
        if let Some(command) = &asked.command {
            comparison.provenance.command.clone_from(command);
        }
        Ok(Self { scenario, runs, comparison })
    }

    /// How the feedforwards compare.
    pub fn comparison(&self) -> &TrackingComparison {
        &self.comparison
    }

    /// What of the logs and recordings could not be written, in sentences that name the file.
    pub fn problems(&self) -> Vec<String> {
        super::problems(&self.runs).cloned().collect()
    }

    /// Writes report, figures, numbers and the scenario.
    ///
    /// # Errors
    ///
    /// [`ReportError`].
    pub fn write(&self, out: &Path) -> Result<(), ReportError> {
        super::write(out, &self.scenario, &self.comparison)
    }
}

fn document(asked: &Asked) -> Result<Document, CliError> {
    let mut document = Document::read(asked.scenario)?;
    asked.set.iter().try_for_each(|assignment| document.set(assignment))?;
    if !asked.feedforward.is_empty() {
        let names: Vec<String> =
            asked.feedforward.iter().map(|kind| format!("{:?}", kind.name())).collect();
        document.set(&format!("feedforward=[{}]", names.join(",")))?;
    }
    Ok(document)
}

/// The models, from a folder or from logs that are simulated for them.
fn models(
    asked: &Asked,
    scenario: &TrackingScenario,
    progress: &dyn Progress,
) -> Result<Learned, CliError> {
    if let Some(folder) = asked.learned {
        return Ok(Learned::load(scenario, folder)?);
    }
    let logs = simulated_logs(scenario, progress)?;
    let learned = Learned::learn(scenario, &logs, None, progress)?;
    if let Some(folder) = asked.out.map(|out| out.join("models")) {
        create_folder(&folder)?;
        learned.save(&folder)?;
    }
    Ok(learned)
}
