use robot::Robot;

use crate::judge::Judge;
use crate::log_reading::LogReading;
use crate::motion_samples::MotionSamples;
use crate::observation::{Observation, ObservationKind, Rival, Spoils};
use crate::thresholds::InspectionThresholds;

/// A velocity column against the derivative of its position.
#[derive(Debug, Clone, Copy)]
struct Slope {
    joint: usize,
    /// Velocity per derivative.
    factor: f64,
    correlation: f64,
}

fn slopes(samples: &MotionSamples, t: &InspectionThresholds) -> Vec<Slope> {
    let of = |joint: usize| {
        let v = samples.column(&samples.velocity, joint);
        let d = samples.column(&samples.motion[1], joint);
        let pairs: Vec<(f64, f64)> = v.into_iter().zip(d).filter(|(v, _)| v.is_finite()).collect();
        let sum = |f: fn(&(f64, f64)) -> f64| pairs.iter().map(f).sum::<f64>();
        let (vv, vd, dd) = (sum(|p| p.0 * p.0), sum(|p| p.0 * p.1), sum(|p| p.1 * p.1));
        let alike = vd.abs() > t.velocity_correlation * (vv * dd).sqrt()
            && dd > 0.0
            && pairs.len() > t.enough_rows;
        alike.then_some(Slope { joint, factor: vd / dd, correlation: vd.abs() / (vv * dd).sqrt() })
    };
    (0..samples.joints).filter_map(of).collect()
}

/// Velocity columns of the other sign, and a factor by which all of them are off: another clock, or another unit of
/// velocity. A wrong clock is corrected for the tests that follow.
pub(crate) fn clock(robot: &Robot, judge: &mut Judge, runs: usize) -> Vec<Observation> {
    let t = judge.thresholds;
    let slopes = slopes(&judge.samples, t);
    let observation = |kind, joints, spoils, or| Observation {
        or,
        ..Observation::of_runs(kind, joints, (0..runs).collect(), spoils)
    };
    let mut all = Vec::new();
    let turned: Vec<usize> = slopes.iter().filter(|s| s.factor < 0.0).map(|s| s.joint).collect();
    if !turned.is_empty() {
        all.push(observation(ObservationKind::VelocitySign, turned, Spoils::Nothing, Vec::new()));
    }
    let mut sizes: Vec<f64> = slopes.iter().map(|s| s.factor.abs()).collect();
    sizes.sort_unstable_by(f64::total_cmp);
    let Some(&factor) = sizes.get(sizes.len() / 2) else {
        all.extend(slow_clock(judge).map(|factor| {
            judge.adopt(&LogReading::Time(factor));
            let joints = (0..robot.joint_count()).collect();
            observation(
                ObservationKind::TimeUnit { factor },
                joints,
                Spoils::Everything,
                Vec::new(),
            )
        }));
        return all;
    };
    let same = sizes.iter().all(|s| (s / factor - 1.0).abs() < t.same_velocity_factor);
    let closely = slopes.iter().all(|s| s.correlation > t.close_velocity_correlation);
    let is_close = factor > t.close_velocity[0] && factor < t.close_velocity[1];
    if is_close && !closely {
        return all;
    }
    if !same || (factor - 1.0).abs() < judge.thresholds.velocity_factor {
        return all;
    }
    let as_is = judge.as_is();
    let reading = LogReading::Time(factor);
    let gain = judge.judge_reading(reading.clone(), &as_is).gain;
    let joints: Vec<usize> = (0..robot.joint_count()).collect();
    let margin = judge.thresholds.margin;
    let velocity = ObservationKind::VelocityUnit { factor };
    let time = ObservationKind::TimeUnit { factor };
    if gain < -margin {
        all.push(observation(velocity, joints, Spoils::Nothing, Vec::new()));
        return all;
    }
    let or = if gain > margin {
        Vec::new()
    } else {
        vec![Rival { kind: velocity, joints: joints.clone() }]
    };
    all.push(observation(time, joints, Spoils::Everything, or));
    judge.adopt(&reading);
    all
}

/// Logged time per second of a log without velocities whose rows are too far apart for any controller: a power
/// of a thousand that gives a rate that loggers have. `None` for a log of a usual rate, or where the efforts contradict it.
fn slow_clock(judge: &mut Judge) -> Option<f64> {
    let step_s = judge.samples.step_s;
    let slowest = judge.thresholds.slowest_hz;
    if step_s * slowest < 1.0 {
        return None;
    }
    let factor =
        (1..=3).map(|k| 1e3_f64.powi(k)).find(|f| f / step_s > judge.thresholds.least_rate_hz)?;
    let as_is = judge.as_is();
    let found = judge.judge_reading(LogReading::Time(factor), &as_is);
    (found.gain > -judge.thresholds.margin).then_some(factor)
}
