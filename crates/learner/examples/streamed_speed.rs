//! Prints, as one line of JSON, what learning the seven torques of the WAM through inducing points takes from a file of
//! samples that is read block by block, and how well it predicts a motion that it has not seen:
//!
//! ```text
//! cargo run --release -p learner --example streamed_speed -- 1000000 300
//! ```
//!
//! with the numbers of samples and of inducing points; times are those of the processor. `1000000 300 memory` holds all samples
//! in memory instead.

#![allow(clippy::unwrap_used, reason = "a measurement that cannot be made has failed")]

use std::f64::consts::TAU;
use std::ops::ControlFlow;
use std::path::Path;
use std::sync::Mutex;

use dynamics::Dynamics;
use gaussian_process::KernelSearch;
use learner::{
    ModelKind, SampleFile, SampleSlices, SampleSource, Samples, TorqueScore, TrainSettings,
    Training, TrainingProgress,
};
use logs::{Prepared, PreparedJoint, PreparedRun};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use robot::Robot;

const JOINTS: usize = 7;
/// Samples of a run, 10 s of it.
const RUN: usize = 1000;
/// Seconds between two samples.
const STEP_S: f64 = 0.01;
/// Friction, and noise of a hundredth of it (N m).
const FRICTION: [f64; JOINTS] = [2.0, 2.0, 1.0, 1.0, 0.2, 0.2, 0.1];

/// Joints that follow four sines each, with their torque: signals `[q, qd, qdd, tau]`, row-major.
fn run(dynamics: &Dynamics, seed: u64, count: usize) -> [Vec<f64>; 4] {
    let mut random = ChaCha8Rng::seed_from_u64(seed);
    let mut draw = |low: f64, high: f64| random.random_range(low..high);
    let mut sine = |k: f64| [draw(0.2, 0.6) / k, draw(0.3, 1.5) * k.sqrt(), draw(0.0, TAU)];
    let sines = [(); JOINTS].map(|()| [1.0, 2.0, 3.0, 4.0].map(&mut sine));
    let mut signals = [(); 4].map(|()| Vec::with_capacity(JOINTS * count));
    for i in 0..count {
        let t = i as f64 * STEP_S;
        let sum = |f: &dyn Fn([f64; 3]) -> f64| sines.map(|of| of.into_iter().map(f).sum::<f64>());
        let q = sum(&|[a, w, p]| a * (w * t + p).sin());
        let qd = sum(&|[a, w, p]| a * w * (w * t + p).cos());
        let qdd = sum(&|[a, w, p]| -a * w * w * (w * t + p).sin());
        let mut tau = dynamics.inverse_dynamics(&q, &qd, &qdd).unwrap();
        for (j, level) in FRICTION.into_iter().enumerate() {
            tau[j] += level * (5.0 * qd[j]).tanh() + 0.01 * level * draw(-1.7, 1.7);
        }
        let rows: [&[f64]; 4] = [&q, &qd, &qdd, tau.as_slice()];
        signals.iter_mut().zip(rows).for_each(|(signal, row)| signal.extend_from_slice(row));
    }
    signals
}

fn write(path: &Path, dynamics: &Dynamics, samples: usize) -> SampleFile {
    SampleFile::write(path, JOINTS, |writer| {
        for first in (0..samples).step_by(RUN) {
            let count = RUN.min(samples - first);
            let [q, qd, qdd, tau] = run(dynamics, first as u64, count);
            writer.add(SampleSlices { q: &q, qd: &qd, qdd: &qdd, tau: &tau })?;
        }
        Ok(())
    })
    .unwrap()
}

/// Runs in memory, whose seeds start with `seed`.
fn in_memory(dynamics: &Dynamics, seed: u64, samples: usize) -> Samples {
    let runs = (0..samples).step_by(RUN).map(|first| {
        let count = RUN.min(samples - first);
        let signals = run(dynamics, seed + first as u64, count);
        let of = |s: usize, j: usize| signals[s].iter().skip(j).step_by(JOINTS).copied().collect();
        let joint = |j| PreparedJoint::exact([of(0, j), of(1, j), of(2, j)], of(3, j));
        PreparedRun {
            name: format!("run {first}"),
            rate_hz: 1.0 / STEP_S,
            time: (0..count).map(|i| i as f64 * STEP_S).collect(),
            session_start_s: 0.0,
            joints: (0..JOINTS).map(joint).collect(),
        }
    });
    Samples::new(&Prepared::exact(runs.collect(), f64::INFINITY))
}

/// Processor time of all threads of this process so far (s), where the system tells.
fn processor_seconds() -> f64 {
    // Fields 14 and 15 of proc(5), user and system, in hundredths of a second; the second field ends the parentheses.
    let stat = std::fs::read_to_string("/proc/self/stat").unwrap_or_default();
    let fields = stat.rsplit(')').next().unwrap_or_default().split_whitespace();
    0.01 * fields.skip(11).take(2).filter_map(|ticks| ticks.parse::<f64>().ok()).sum::<f64>()
}

/// Remembers when the last stage of a training began (s of processor).
#[derive(Default)]
struct Stages {
    last_began_at: Mutex<f64>,
}

impl TrainingProgress for Stages {
    fn stage(&self, _: &str) {
        *self.last_began_at.lock().unwrap() = processor_seconds();
    }

    fn evaluation(&self, _: usize, _: f64) -> ControlFlow<()> {
        ControlFlow::Continue(())
    }
}

/// Largest memory held so far (MB), where the system tells.
fn peak_megabytes() -> Option<f64> {
    let status = std::fs::read_to_string("/proc/self/status").ok()?;
    let line = status.lines().find(|line| line.starts_with("VmHWM"))?;
    Some(line.split_whitespace().nth(1)?.parse::<f64>().ok()? * 1024.0 / 1e6)
}

fn main() {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let [samples, points, ..] = arguments.as_slice() else {
        return eprintln!("expected the numbers of samples and of inducing points");
    };
    let (samples, inducing_points) = (samples.parse().unwrap(), points.parse().unwrap());
    let urdf = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../robots/wam7/robot.urdf");
    let robot = Robot::load(&urdf).unwrap().robot;
    let dynamics = Dynamics::new(&robot);
    let path = std::env::temp_dir().join(format!("samples_{}.parquet", std::process::id()));
    let begin = processor_seconds();
    let source: Box<dyn SampleSource> = match arguments.get(2) {
        Some(_) => Box::new(in_memory(&dynamics, 0, samples)),
        None => Box::new(write(&path, &dynamics, samples)),
    };
    let made_s = processor_seconds() - begin;
    let megabytes = std::fs::metadata(&path).map_or(0.0, |file| file.len() as f64 / 1e6);
    let search = KernelSearch { starts: 1, start_points: 200, iterations: 20 };
    let settings =
        TrainSettings { points: 300, inducing_points, search, ..TrainSettings::default() };
    let stages = Stages::default();
    let mut training =
        Training::new(&robot, &*source, vec![0.01; JOINTS], &settings, &stages).unwrap();
    let fitted = training.fit(ModelKind::GpInducing).unwrap();
    let peak_mb = peak_megabytes().unwrap_or(f64::NAN);
    let pass_s = processor_seconds() - *stages.last_began_at.lock().unwrap();
    let score = TorqueScore::of(&fitted.model, &in_memory(&dynamics, 1 << 40, 5 * RUN));
    let nmse: Vec<String> = score.nmse.iter().map(|nmse| format!("{nmse:.2e}")).collect();
    println!(
        r#"{{"samples": {samples}, "points": {inducing_points}, "file_mb": {megabytes:.0}, "made_s": {made_s:.1}, "pass_s": {pass_s:.2}, "peak_mb": {peak_mb:.0}, "nmse": [{}]}}"#,
        nmse.join(", ")
    );
    // A file that could not be removed is no part of the measurement.
    drop(std::fs::remove_file(&path));
}
