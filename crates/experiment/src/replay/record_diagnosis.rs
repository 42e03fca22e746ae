use std::path::Path;

use diagnosis::{DiagnosisProgress, DiagnosisRun, RunTraces};
use logs::{PrepareSettings, PreparedRun, Run, of_run, prepare, without_repeats};
use recording::{
    Arm, BarSeries, EventLevel, Live, Recorder, RowBlock, Scene, SceneRole, SceneSignal,
    SignalQuantity,
};
use robot::Loaded;

use crate::error::ExperimentError;
use crate::replay::replayed::{Replayed, Simulated};

/// Highest rate of the recording (Hz).
const RATE_HZ: f64 = 100.0;

/// Time between the end of a run and the beginning of the next (s).
const PAUSE_S: f64 = 1.0;

/// Number of rows that are handed over at a time: a second or a little more.
const BLOCK: usize = 110;

/// A diagnosis to be recorded.
#[derive(Debug, Clone, Copy)]
pub struct DiagnosedLogs<'a> {
    /// The robot as described, with its shapes.
    pub loaded: &'a Loaded,
    /// The logs that were diagnosed.
    pub runs: &'a [Run],
    /// The outcome of the diagnosis.
    pub outcome: &'a DiagnosisRun,
    /// The findings in Markdown.
    pub verdict: &'a str,
}

/// Records a diagnosis: the measured arm beside the simulated one, torques and residuals. The runs follow one another
/// on one timeline.
///
/// ```text
/// measured ---> arm, q, qd, tau                                  solid, white
/// nominal  ---> arm, q under the measured tau; tau; tau - tau_nominal     orange
/// extended ---> arm, q under the measured tau; tau; tau - tau_extended    blue
/// ```
///
/// A simulation starts anew from the measured state after 1, 0.5, 0.2 or 0.1 s: the longest time for which the
/// nominal model stays near the measurement. The plots open at the joint of the finding that explains most. At most
/// two minutes of all runs are simulated, the same time from the beginning of each. A run that cannot be simulated
/// becomes an event of the recording.
///
/// Rows are samples of the log, at most 100 a second. Torques are those of the diagnosis, interpolated linearly
/// between the samples of its regression.
///
/// # Errors
///
/// [`ExperimentError::Log`] when the runs were not diagnosed with this outcome, and [`ExperimentError::Recording`].
pub fn record_diagnosis(
    path: &Path,
    diagnosed: &DiagnosedLogs<'_>,
    progress: &dyn DiagnosisProgress,
) -> Result<recording::FinishedRecording, ExperimentError> {
    let DiagnosedLogs { loaded, outcome, runs, .. } = *diagnosed;
    let cutoff_hz = Some(outcome.diagnosis.data.cutoff_hz);
    let records = prepare(&without_repeats(runs), &PrepareSettings { cutoff_hz })?.runs;
    let title = format!("{}: measured and simulated", loaded.robot.name());
    let mut recorder = Recorder::create(path, &scene(&title, loaded), Live::Off)?;
    let replayed = Replayed::of([&loaded.robot, &outcome.extended], &records, progress);
    recorder.document(&format!("{}\n{}", diagnosed.verdict, legend(outcome, &replayed)))?;
    record_findings(&mut recorder, outcome)?;
    let first = outcome.diagnosis.findings.iter().find_map(|f| f.at.joint.as_deref());
    let at = |name: &str| loaded.robot.joint_names().position(|joint| joint == name);
    if let Some(joint) = first.and_then(at) {
        recorder.open(joint);
    }
    progress.stage("writing the recording", records.len());
    let mut start_s = 0.0;
    for (r, (record, traces)) in records.iter().zip(&outcome.traces).enumerate() {
        events(&mut recorder, start_s, record, [&replayed.nominal[r], &replayed.extended[r]])?;
        let ghosts = [&replayed.nominal[r].q[..], &replayed.extended[r].q];
        let end_s = write(&mut recorder, start_s, &Shown { record, traces, ghosts })?;
        start_s = end_s + PAUSE_S;
        progress.step();
    }
    Ok(recorder.finish()?)
}

fn scene<'a>(title: &'a str, loaded: &'a Loaded) -> Scene<'a> {
    use SignalQuantity::{Position, Residual, Torque, Velocity};
    let signal = |quantity, name, role| SceneSignal { quantity, name, role };
    Scene {
        title,
        robot: &loaded.robot,
        looks: &loaded.looks,
        arms: vec![
            Arm { name: "measured", role: SceneRole::Actual },
            Arm { name: "nominal", role: SceneRole::Nominal },
            Arm { name: "extended", role: SceneRole::Predicted },
        ],
        signals: vec![
            signal(Position, "measured", SceneRole::Actual),
            signal(Position, "nominal", SceneRole::Nominal),
            signal(Position, "extended", SceneRole::Predicted),
            signal(Velocity, "measured", SceneRole::Actual),
            signal(Torque, "measured", SceneRole::Actual),
            signal(Torque, "nominal", SceneRole::Nominal),
            signal(Torque, "extended", SceneRole::Predicted),
            signal(Residual, "nominal", SceneRole::Nominal),
            signal(Residual, "extended", SceneRole::Predicted),
        ],
    }
}

/// The legend: the signals, and how they were made.
fn legend(outcome: &DiagnosisRun, replayed: &Replayed) -> String {
    let data = &outcome.diagnosis.data;
    format!(
        "---\n**White** was measured. **Orange** is the nominal model, **blue** the extended one, \
         both moved by the measured torque. They start anew from the measured state every \
         {} s, so a step back is no motion. The first {:.0} s of every run are simulated.\n\n\
         Torques and residuals are low-passed at {} Hz, the diagnosis has {:.1} samples a second \
         of them. The extended model's are held out ({}).\n",
        replayed.window_s,
        replayed.simulated_s,
        data.cutoff_hz,
        data.regression_rate_hz,
        outcome.diagnosis.gain.inverse.held_out,
    )
}

/// Records findings and warnings, and the errors as bars.
fn record_findings(recorder: &mut Recorder, outcome: &DiagnosisRun) -> Result<(), ExperimentError> {
    let diagnosis = &outcome.diagnosis;
    for finding in &diagnosis.findings {
        let words = finding.at.words();
        let share = 100.0 * finding.share_explained;
        recorder.event(
            0.0,
            EventLevel::Info,
            &format!("found {words}, {share:.1} % of the gap"),
        )?;
    }
    for warning in &diagnosis.warnings {
        recorder.event(0.0, EventLevel::Warning, warning)?;
    }
    let gain = &diagnosis.gain.inverse;
    let bar = |name, role, values| BarSeries { name, role, values };
    let bars = [
        bar("nominal", SceneRole::Nominal, &gain.rms_before_nm[..]),
        bar("extended", SceneRole::Predicted, &gain.rms_after_nm),
    ];
    Ok(recorder.bars("RMS error (N·m or N)", &bars)?)
}

/// Records the beginning of a run at `start_s` and the parts that the nominal and the extended model could not simulate.
fn events(
    recorder: &mut Recorder,
    start_s: f64,
    record: &PreparedRun,
    [nominal, extended]: [&Simulated; 2],
) -> Result<(), ExperimentError> {
    let begins = format!("{}, from {:.3} s of its log", of_run(&record.name), record.time[0]);
    recorder.event(start_s, EventLevel::Info, &begins)?;
    for (model, run) in [("nominal", nominal), ("extended", extended)] {
        if let Some(trouble) = &run.trouble {
            recorder.event(start_s, EventLevel::Warning, &format!("{model} model: {trouble}"))?;
        }
    }
    Ok(())
}

/// One run.
struct Shown<'a> {
    record: &'a PreparedRun,
    traces: &'a RunTraces,
    /// Positions simulated by the nominal and by the extended model.
    ghosts: [&'a [f64]; 2],
}

impl Shown<'_> {
    /// The signals of a joint at one sample, in the order of the scene.
    fn signals(&self, sample: usize, j: usize) -> [f64; 9] {
        let (record, traces) = (&self.record.joints[j], &self.traces.joints[j]);
        let ghost = |g: &[f64]| g[sample * self.record.joints.len() + j];
        let [nominal_q, extended_q] = self.ghosts.map(ghost);
        let time_s = self.record.time[sample];
        let at = |values: &[f64]| interpolate(&self.traces.time, values, time_s);
        let [tau, nominal, extended] =
            [&traces.measured, &traces.nominal, &traces.extended].map(|values| at(values));
        [
            record.q[sample],
            nominal_q,
            extended_q,
            record.qd[sample],
            tau,
            nominal,
            extended,
            tau - nominal,
            tau - extended,
        ]
    }
}

/// Writes a run that begins at `start_s` of the recording (s), followed by a row of gaps. Returns its end (s).
fn write(recorder: &mut Recorder, start_s: f64, shown: &Shown<'_>) -> Result<f64, ExperimentError> {
    let record = shown.record;
    let stride = (record.rate_hz / RATE_HZ).ceil().max(1.0) as usize;
    let joints = record.joints.len();
    let (mut time_s, mut columns): (Vec<f64>, [Vec<f64>; 9]) = Default::default();
    for sample in (0..record.time.len()).step_by(stride) {
        time_s.push(start_s + record.time[sample] - record.time[0]);
        for j in 0..joints {
            let numbers = shown.signals(sample, j);
            columns.iter_mut().zip(numbers).for_each(|(column, number)| column.push(number));
        }
    }
    let end_s = time_s.last().copied().unwrap_or(start_s);
    time_s.push(end_s + 0.5 * PAUSE_S);
    columns.iter_mut().for_each(|column| column.extend(vec![f64::NAN; joints]));
    // In blocks, because the path of an arm grows by a piece a block.
    for first in (0..time_s.len()).step_by(BLOCK) {
        let last = time_s.len().min(first + BLOCK);
        let signals = columns.each_ref().map(|column| &column[first * joints..last * joints]);
        let arms = &signals[..3];
        recorder.rows(&RowBlock { time_s: &time_s[first..last], arms, signals: &signals })?;
    }
    Ok(end_s)
}

/// Linear interpolation between two samples; NaN outside of them.
fn interpolate(time: &[f64], values: &[f64], time_s: f64) -> f64 {
    let next = time.partition_point(|t| *t < time_s);
    let at = |i: usize| time.get(i).copied().zip(values.get(i).copied());
    match (next.checked_sub(1).and_then(at), at(next)) {
        (Some((t0, a)), Some((t1, b))) => a + (b - a) * (time_s - t0) / (t1 - t0),
        (None, Some((t, value))) if t <= time_s => value,
        _ => f64::NAN,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_between_samples_lie_on_a_line_and_there_are_none_outside() {
        let (time, values) = ([1.0, 2.0, 4.0], [10.0, 20.0, 0.0]);
        let at = |time_s| interpolate(&time, &values, time_s);
        for (time_s, expected) in [(1.0, 10.0), (1.5, 15.0), (2.0, 20.0), (3.5, 5.0), (4.0, 0.0)] {
            assert!((at(time_s) - expected).abs() < 1e-12, "{time_s} s: {}", at(time_s));
        }
        assert!(at(0.999).is_nan() && at(4.001).is_nan() && at(f64::NAN).is_nan());
        assert!(interpolate(&time, &[], 1.5).is_nan());
    }
}
