//! Records a minute of smooth motion of the Barrett WAM and prints what it cost.
//!
//! ```text
//! cargo run --release -p recording --example arm -- /tmp/arm.rrd
//! ```

use std::error::Error;
use std::path::PathBuf;

use recording::{
    Arm, BarSeries, EventLevel, Live, Recorder, RowBlock, Scene, SceneRole, SceneSignal,
    SignalQuantity,
};
use robot::{Loaded, Robot};

const RATE_HZ: f64 = 500.0;
const DURATION_S: f64 = 60.0;
/// Rows of a block: 0.2 s.
const BLOCK: usize = 100;

fn main() -> Result<(), Box<dyn Error>> {
    let mut arguments = std::env::args().skip(1);
    let path = arguments.next().map_or_else(|| std::env::temp_dir().join("arm.rrd"), PathBuf::from);
    let live = if arguments.next().is_some() { Live::On } else { Live::Off };
    let file = concat!(env!("CARGO_MANIFEST_DIR"), "/../../robots/wam7/robot.toml");
    let loaded = Robot::load(file.as_ref())?;
    let before_s = cpu_s();
    let mut recorder = Recorder::create(&path, &scene(&loaded), live)?;
    let joints = loaded.robot.joint_count();
    let rows = (DURATION_S * RATE_HZ) as usize;
    let mut squares = vec![0.0; joints];
    for start in (0..rows).step_by(BLOCK) {
        let time_s: Vec<f64> =
            (start..(start + BLOCK).min(rows)).map(|i| i as f64 / RATE_HZ).collect();
        let signal = |of: fn(f64, usize) -> f64| -> Vec<f64> {
            time_s.iter().flat_map(|&t| (0..joints).map(move |j| of(t, j))).collect()
        };
        let (q_ref, q) = (signal(reference), signal(|t, j| reference(t, j) - error(t, j)));
        let (qd_ref, qd) = (signal(rate), signal(|t, j| rate(t, j) + 0.01 * noise(t, j)));
        let (tau, feedforward) = (signal(torque), signal(|t, j| 0.9 * torque(t, j)));
        let error = signal(error);
        error.iter().enumerate().for_each(|(i, e)| squares[i % joints] += e * e);
        recorder.rows(&RowBlock {
            time_s: &time_s,
            arms: &[&q, &q_ref],
            signals: &[&q_ref, &q, &qd_ref, &qd, &tau, &feedforward, &error],
        })?;
    }
    let rmse: Vec<f64> = squares.iter().map(|s| 1e3 * (s / rows as f64).sqrt()).collect();
    recorder.event(0.0, EventLevel::Info, "start")?;
    recorder.event(24.0, EventLevel::Warning, "prediction stalled for 40 ms, feedback alone")?;
    recorder.event(DURATION_S, EventLevel::Info, "end")?;
    recorder.document(&verdict(&loaded.robot, &rmse))?;
    let stiff: Vec<f64> = rmse.iter().map(|r| 0.4 * r).collect();
    let bar = |place, name, values| BarSeries { name, role: SceneRole::Model(place), values };
    recorder.bars("RMSE (mrad)", &[bar(0, "low gains", &rmse), bar(1, "stiff", &stiff)])?;
    let written = recorder.finish()?;
    println!(
        "{}: {} rows, {:.2} MB, {:.2} s of CPU, viewer: {:?}",
        written.path.display(),
        written.rows,
        written.bytes as f64 / 1e6,
        cpu_s() - before_s,
        written.listener
    );
    Ok(())
}

fn scene(loaded: &Loaded) -> Scene<'_> {
    let signal = |quantity, name, role| SceneSignal { quantity, name, role };
    Scene {
        title: "wam7: an invented motion",
        robot: &loaded.robot,
        looks: &loaded.looks,
        arms: vec![
            Arm { name: "measured", role: SceneRole::Actual },
            Arm { name: "desired", role: SceneRole::Desired },
        ],
        signals: vec![
            signal(SignalQuantity::Position, "desired", SceneRole::Desired),
            signal(SignalQuantity::Position, "measured", SceneRole::Actual),
            signal(SignalQuantity::Velocity, "desired", SceneRole::Desired),
            signal(SignalQuantity::Velocity, "measured", SceneRole::Actual),
            signal(SignalQuantity::Torque, "applied", SceneRole::Actual),
            signal(SignalQuantity::Torque, "feedforward", SceneRole::Predicted),
            signal(SignalQuantity::Error, "tracking error", SceneRole::Error),
        ],
    }
}

fn verdict(robot: &Robot, rmse_mrad: &[f64]) -> String {
    let rows = robot.joint_names().zip(rmse_mrad).map(|(j, r)| format!("| {j} | {r:.2} |\n"));
    format!(
        "# Verdict\n\n**An invented motion**, to look at.\n\n| joint | RMSE (mrad) |\n|---|---:|\n{}",
        rows.collect::<String>()
    )
}

/// Two sinusoids a joint.
fn reference(t: f64, joint: usize) -> f64 {
    let k = joint as f64;
    0.5 * ((0.6 + 0.11 * k) * t).sin() + 0.25 * ((1.3 - 0.07 * k) * t + k).sin() + 0.2 * k.cos()
}

/// The time derivative of `reference`.
fn rate(t: f64, joint: usize) -> f64 {
    let k = joint as f64;
    let (slow, fast) = (0.6 + 0.11 * k, 1.3 - 0.07 * k);
    0.5 * slow * (slow * t).cos() + 0.25 * fast * (fast * t + k).cos()
}

fn error(t: f64, joint: usize) -> f64 {
    0.03 / (1.0 + joint as f64) * (5.0 * rate(t, joint)).tanh() + 2e-4 * noise(t, joint)
}

fn torque(t: f64, joint: usize) -> f64 {
    let size = 30.0 / (1.0 + joint as f64);
    size * reference(t, joint) + 3.0 * (9.0 * rate(t, joint)).tanh() + 0.2 * noise(t, joint)
}

/// Numbers between -1 and 1 that look random.
fn noise(t: f64, joint: usize) -> f64 {
    (12.9898 * t + 78.233 * joint as f64).sin() * 43758.5453 % 1.0
}

/// CPU seconds of this process so far, all threads; 0 where the system does not say.
fn cpu_s() -> f64 {
    let Ok(stat) = std::fs::read_to_string("/proc/self/stat") else { return 0.0 };
    let fields = stat.rsplit(')').next().unwrap_or_default().split_whitespace();
    fields.skip(11).take(2).filter_map(|f| f.parse::<f64>().ok()).sum::<f64>() / 100.0
}
