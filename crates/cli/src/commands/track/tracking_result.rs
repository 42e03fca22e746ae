use std::path::Path;

use document::Document;
use experiment::{
    FeedforwardKind, Learned, Outputs, Progress, TrackedRun, TrackingScenario, simulated_logs,
    sweep, track_all,
};
use recording::Live;
use report::{ReportError, TrackingComparison};

use super::comparison::{comparison, problems};
use crate::error::CliError;
use crate::output::create_folder;

/// What is to be tracked, and how.
pub struct TrackingRequest<'a> {
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
pub struct TrackingResult {
    scenario: TrackingScenario,
    runs: Vec<TrackedRun>,
    comparison: TrackingComparison,
}

impl TrackingResult {
    /// Learns what is asked for, tracks the motion with each model, and compares them.
    ///
    /// # Errors
    ///
    /// [`CliError`] for a scenario, models or an arm that cannot be used, and for files that cannot be written.
    pub fn new(request: &TrackingRequest, progress: &dyn Progress) -> Result<Self, CliError> {
        let scenario = TrackingScenario::from_document(&document(request)?)?;
        let outputs = request.out.map(|out| Outputs {
            logs: out.join("logs"),
            recordings: recording::IS_BUILT.then(|| out.join("recordings")),
            live: if request.live { Live::On } else { Live::Off },
        });
        if let (Some(out), Some(outputs)) = (request.out, &outputs) {
            let folders = [out, outputs.logs.as_path()].into_iter();
            folders.chain(outputs.recordings.as_deref()).try_for_each(create_folder)?;
        }
        let learned = models(request, &scenario, progress)?;
        let runs = track_all(&scenario, &learned, outputs.as_ref(), progress)?;
        let swept = sweep(&scenario, &learned, progress)?;
        let mut comparison = comparison(request.scenario, &scenario, &runs, swept.as_ref())?;
        if let Some(command) = &request.command {
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
        problems(&self.runs).cloned().collect()
    }

    /// Writes report, figures, numbers and the scenario.
    ///
    /// # Errors
    ///
    /// [`ReportError`].
    pub fn write(&self, out: &Path) -> Result<(), ReportError> {
        write_comparison(out, &self.scenario, &self.comparison)
    }
}

fn document(request: &TrackingRequest) -> Result<Document, CliError> {
    let mut document = Document::read(request.scenario)?;
    request.set.iter().try_for_each(|assignment| document.set(assignment))?;
    if !request.feedforward.is_empty() {
        let names: Vec<String> =
            request.feedforward.iter().map(|kind| format!("{:?}", kind.name())).collect();
        document.set(&format!("feedforward=[{}]", names.join(",")))?;
    }
    Ok(document)
}

/// The models, from a folder or from logs that are simulated for them.
fn models(
    request: &TrackingRequest,
    scenario: &TrackingScenario,
    progress: &dyn Progress,
) -> Result<Learned, CliError> {
    if let Some(folder) = request.learned {
        return Ok(Learned::load(scenario, folder)?);
    }
    let logs = simulated_logs(scenario, progress)?;
    let learned = Learned::learn(scenario, &logs, None, progress)?;
    if let Some(folder) = request.out.map(|out| out.join("models")) {
        create_folder(&folder)?;
        learned.save(&folder)?;
    }
    Ok(learned)
}

/// Writes an output folder, all but the logs, recordings and models.
pub fn write_comparison(
    out: &Path,
    scenario: &TrackingScenario,
    comparison: &TrackingComparison,
) -> Result<(), ReportError> {
    let mut files = vec![
        ("scenario.toml", scenario.self_contained_text().to_owned()),
        ("tracking.json", comparison.json()?),
        ("report.html", comparison.page()?),
        ("errors.svg", comparison.error_figure()?),
        ("motion.svg", comparison.motion_figure(&elbow_and_wrist(scenario))?),
    ];
    if let Some(figure) = comparison.sweep_figure()? {
        files.push(("gains.svg", figure));
    }
    let files: Vec<(&str, &[u8])> =
        files.iter().map(|(name, text)| (*name, text.as_bytes())).collect();
    report::write_folder(out, &files)
}

/// The joints of figure 4 of Nguyen-Tuong & Peters 2010, 4 to 6, as far as there are so many.
fn elbow_and_wrist(scenario: &TrackingScenario) -> Vec<usize> {
    let joints = scenario.robot().joint_count();
    if joints >= 6 { vec![3, 4, 5] } else { (0..joints.min(3)).collect() }
}
