use std::path::Path;

use experiment::{
    AheadSpec, ClockSpec, GainSweep, PredictionTimeSpec, TrackedRun, TrackingScenario,
};
use recording::Listener;
use report::{
    ComparedJoint, ControllerGains, ErrorSweep, FirstSeconds, ReportError, SweptFeedforward,
    TrackedModel, TrackingComparison, WallTiming,
};
use robot::PdGain;
use tracking::{End, Signal};

use crate::input::{hash, provenance};
use crate::output::display_path;

/// What the runs of a scenario are reported as.
pub fn comparison(
    scenario_file: &Path,
    scenario: &TrackingScenario,
    runs: &[TrackedRun],
    swept: Option<&GainSweep>,
) -> Result<TrackingComparison, ReportError> {
    let robot = scenario.robot();
    let file = scenario.plant().robot_file();
    let mut provenance = provenance(file, scenario.loaded_robot(), None)?;
    provenance.files.push(hash("scenario", scenario_file)?);
    provenance.files.push(hash("plant", scenario.plant_file())?);
    Ok(TrackingComparison {
        robot: robot.name().to_owned(),
        joints: ComparedJoint::all(robot),
        motion: format!("the motion of {}", display_path(scenario_file)),
        gains: gains(scenario.gains_name(), scenario.gains()),
        clock: clock(scenario),
        duration_s: scenario.motion().duration_s(),
        models: runs.iter().map(tracked_model).collect(),
        sweep: swept.map(sweep),
        warnings: problems(runs).cloned().chain(viewer_warning(runs)).collect(),
        provenance,
    })
}

/// Why logs and recordings of the runs could not be written.
pub fn problems(runs: &[TrackedRun]) -> impl Iterator<Item = &String> {
    runs.iter().filter_map(|run| run.written.as_ref()).flat_map(|written| &written.problems)
}

/// What a viewer that was asked for did not see.
fn viewer_warning(runs: &[TrackedRun]) -> Option<String> {
    let listeners = || runs.iter().filter_map(|run| Some(run.written.as_ref()?.listener));
    if listeners().any(|listener| listener == Listener::Nobody) {
        return Some("no viewer listened on 127.0.0.1:9876 (--live): start rerun first".into());
    }
    let messages_left_out = |listener| match listener {
        Listener::Viewer { left_out } => left_out,
        Listener::NotAsked | Listener::Nobody => 0,
    };
    let left_out: u64 = listeners().map(messages_left_out).sum();
    (left_out > 0).then(|| {
        format!("the viewer was too slow for {left_out} messages, which the recordings hold")
    })
}

fn gains(name: &str, gains: &[PdGain]) -> ControllerGains {
    ControllerGains {
        name: name.to_owned(),
        kp: gains.iter().map(|gain| gain.kp).collect(),
        kd: gains.iter().map(|gain| gain.kd).collect(),
    }
}

/// What the time of a prediction was, in words.
fn clock(scenario: &TrackingScenario) -> String {
    let prediction = scenario.prediction();
    let moment = match prediction.ahead {
        AheadSpec::Now => "for the moment at which it begins",
        AheadSpec::Arrival => "for the middle of the time in which it is used",
    };
    let time = match (prediction.clock, prediction.time_ms) {
        (ClockSpec::Wall, _) => "on the clock on the wall".to_owned(),
        (ClockSpec::Virtual, PredictionTimeSpec::Given(ms)) => {
            format!("within {ms} ms of simulated time")
        }
        (ClockSpec::Virtual, PredictionTimeSpec::Here(_)) => {
            "within the time measured before the run, simulated".to_owned()
        }
    };
    format!("predicted beside the loop, {time}, {moment}")
}

fn tracked_model(run: &TrackedRun) -> TrackedModel {
    let TrackedRun { kind, tracking, metrics, .. } = run;
    let joints = &metrics.joints;
    let tip = metrics.end_effector_of_links.unwrap_or(metrics.end_effector);
    TrackedModel {
        name: kind.name().to_owned(),
        words: kind.words().to_owned(),
        rmse_rad: joints.iter().map(|joint| joint.rmse).collect(),
        rmse_first_10_s_rad: joints.iter().map(|joint| joint.rmse_first_10_s).collect(),
        max_error_rad: joints.iter().map(|joint| joint.max_error).collect(),
        tip_rmse_m: Some(tip.rms_m),
        tip_max_m: Some(tip.max_m),
        link_rmse_rad: joints.iter().map(|joint| Some(joint.link?.rmse)).collect(),
        effort_rms_nm: joints.iter().map(|joint| joint.command_rms).collect(),
        feedback_rms_nm: joints.iter().map(|joint| joint.feedback_rms).collect(),
        largest_jump_nm: joints.iter().map(|joint| joint.jump_max).collect(),
        prediction_us: 1e6 * run.prediction_time_s,
        stopped: match &tracking.end {
            End::Complete => None,
            End::Fault(fault) => Some(fault.to_string()),
            End::Stopped => Some("Ctrl-C ended the run".to_owned()),
        },
        events: tracking.events.iter().map(|e| format!("{:.2} s: {}", e.time_s, e.words)).collect(),
        timing: tracking.timing.wall.as_ref().map(|wall| WallTiming {
            ticks: tracking.rows.len(),
            missed_deadlines: wall.deadlines_missed,
            worst_late_us: 1e6 * wall.latest_s,
            missed_updates: tracking.timing.updates_missed,
            latency_99_us: 1e6 * wall.latency.p99_s,
            latency_max_us: 1e6 * wall.latency.max_s,
        }),
        first_seconds: first_seconds(run),
    }
}

fn first_seconds(run: &TrackedRun) -> FirstSeconds {
    let rows = &run.tracking.rows;
    let columns = |signal: Signal| -> Vec<Vec<f64>> {
        (0..rows.joints()).map(|joint| rows.column(signal, joint).collect()).collect()
    };
    let time: Vec<f64> = rows.time_s().collect();
    let (desired, measured) = (columns(Signal::QRef), columns(Signal::Q));
    let desired: Vec<&[f64]> = desired.iter().map(Vec::as_slice).collect();
    let measured: Vec<&[f64]> = measured.iter().map(Vec::as_slice).collect();
    FirstSeconds::of(&time, &desired, &measured)
}

fn sweep(swept: &GainSweep) -> ErrorSweep {
    let models = swept.models.iter();
    ErrorSweep {
        gains: swept.gains.clone(),
        duration_s: swept.duration_s,
        scales: swept.scales.clone(),
        models: models
            .map(|model| SweptFeedforward {
                name: model.kind.name().to_owned(),
                rmse_rad: model.rmse.clone(),
            })
            .collect(),
    }
}
