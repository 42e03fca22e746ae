//! Effects as closed forms of the raw columns of a log, added to its efforts: never with the
//! code of `effects` or `dynamics`.

use catalogue::EffectKind;
use checks::arms::base_from_links;
use logs::{Channels, Run};
use nalgebra::{Point3, Vector3};
use robot::Robot;

/// Half of the time over which a velocity is taken (s).
const HALF_S: f64 = 0.02;

/// Speed below which dry friction is in proportion to it (rad/s): the clock and the encoder
/// tell the direction no better.
const CREEP: f64 = 0.01;

/// What a log says of a joint at one time: position from the middle of its way (rad), velocity
/// (rad/s), effort (N m).
#[derive(Debug, Clone, Copy)]
pub struct At {
    q: f64,
    qd: f64,
    effort: f64,
}

/// What an effect adds to the efforts.
#[derive(Clone, Copy)]
pub enum Law {
    /// To that of one joint, per unit of its size.
    Joint(fn(At) -> f64),
    /// To those of all joints what a point mass on the last link takes, per kilogram.
    PointMass,
    /// The efforts of all joints come later, in seconds.
    Late,
}

/// The parameters of a finding that are the size of an effect.
#[derive(Clone, Copy)]
pub enum Size {
    /// One.
    Of(&'static str),
    /// By how much one exceeds another.
    Between(&'static str, &'static str),
}

/// An effect that can be put into a log.
#[derive(Clone, Copy)]
pub struct Graft {
    /// The effect.
    pub kind: EffectKind,
    /// Where its size is read from.
    pub size: Size,
    /// What it adds.
    pub law: Law,
}

/// Every effect that adds a closed form to the effort.
pub const GRAFTS: [Graft; 9] = [
    graft(EffectKind::CoulombFriction, "level", Law::Joint(|at| dry(at.qd))),
    graft(EffectKind::ViscousFriction, "viscous", Law::Joint(|at| at.qd)),
    Graft {
        size: Size::Between("forward", "backward"),
        ..graft(EffectKind::AsymmetricFriction, "", Law::Joint(|at| dry(at.qd).max(0.0)))
    },
    graft(EffectKind::TorqueOffset, "offset", Law::Joint(|_| 1.0)),
    graft(EffectKind::TorqueConstant, "gain", Law::Joint(|at| at.effort)),
    graft(EffectKind::CableSpring, "stiffness", Law::Joint(|at| at.q)),
    graft(
        EffectKind::LoadDependentFriction,
        "coefficient",
        Law::Joint(|at| at.effort.abs() * dry(at.qd)),
    ),
    graft(EffectKind::Payload, "mass", Law::PointMass),
    graft(EffectKind::TimeSkew, "skew", Law::Late),
];

const fn graft(kind: EffectKind, size: &'static str, law: Law) -> Graft {
    Graft { kind, size: Size::Of(size), law }
}

/// Direction of a motion, in proportion to its velocity where it creeps.
fn dry(qd: f64) -> f64 {
    (qd / CREEP).clamp(-1.0, 1.0)
}

/// Root of the mean square.
pub fn rms(values: &[Vec<f64>]) -> f64 {
    let (n, sum) = values.iter().flatten().fold((0.0, 0.0), |(n, s), v| (n + 1.0, s + v * v));
    f64::sqrt(sum / n)
}

/// Samples in half the time over which a velocity is taken.
fn half(time: &[f64]) -> usize {
    let period = (time[time.len() - 1] - time[0]) / (time.len() - 1) as f64;
    ((HALF_S / period).round() as usize).max(1)
}

/// Velocity as the slope of a chord, `(q(t + h) - q(t - h)) / 2 h`.
fn velocity(time: &[f64], q: &[f64]) -> Vec<f64> {
    let (half, last) = (half(time), q.len() - 1);
    let slope = |i: usize| {
        let (a, b) = (i.saturating_sub(half), (i + half).min(last));
        (q[b] - q[a]) / (time[b] - time[a])
    };
    (0..q.len()).map(slope).collect()
}

/// What a law of one joint adds to its effort per unit of the size, run by run.
pub fn unit(runs: &[Run], joint: usize, law: fn(At) -> f64) -> Vec<Vec<f64>> {
    let positions = || runs.iter().flat_map(|run| &run.joints[joint].position);
    let [low, high] = [
        positions().fold(f64::MAX, |a, b| a.min(*b)),
        positions().fold(f64::MIN, |a, b| a.max(*b)),
    ];
    let of_run = |run: &Run| {
        let Channels { position, effort, .. } = &run.joints[joint];
        let at = |((q, qd), effort): ((&f64, f64), &f64)| At {
            q: q - 0.5 * (low + high),
            qd,
            effort: *effort,
        };
        position.iter().zip(velocity(&run.time, position)).zip(effort).map(at).map(law).collect()
    };
    runs.iter().map(of_run).collect()
}

/// Adds `size` units to the effort of a joint.
pub fn add(runs: &mut [Run], joint: usize, unit: &[Vec<f64>], size: f64) {
    for (run, unit) in runs.iter_mut().zip(unit) {
        run.joints[joint].effort.iter_mut().zip(unit).for_each(|(e, u)| *e += size * u);
    }
}

/// Where a point mass is on the last link (m): beside the axis of its joint.
const POINT: [f64; 3] = [0.0, 0.05, 0.1];

/// Torques that move and carry a mass (kg) at the point `p` of the last link:
///
/// ```text
/// tau_j = mass (dp/dq_j)' (d2p/dt2 - g)
/// ```
///
/// with the derivatives as differences, of the positions averaged over the same time.
pub fn add_point_mass(runs: &mut [Run], robot: &Robot, mass: f64) {
    let tip = |q: &[f64]| -> Point3<f64> {
        let last = base_from_links(robot, q).pop();
        last.map_or_else(Point3::origin, |pose| pose * Point3::from(POINT))
    };
    for run in runs {
        let (half, n) = (half(&run.time), run.time.len());
        let step = (run.time[n - 1] - run.time[0]) / (n - 1) as f64 * half as f64;
        let smooth: Vec<Vec<f64>> =
            run.joints.iter().map(|j| averaged(&j.position, half)).collect();
        let at = |i: usize| -> Vec<f64> { smooth.iter().map(|q| q[i]).collect() };
        let path: Vec<Point3<f64>> = (0..n).map(|i| tip(&at(i))).collect();
        for i in 0..n {
            let middle = i.clamp(half, n - 1 - half);
            let (before, after) = (path[middle - half], path[middle + half]);
            let acceleration = ((after - path[middle]) - (path[middle] - before)) / (step * step);
            let force = mass * (acceleration - robot.gravity_in_base());
            for (j, joint) in run.joints.iter_mut().enumerate() {
                joint.effort[i] += slope(&tip, &at(i), j).dot(&force);
            }
        }
    }
}

/// `dp/dq_j` as a difference.
fn slope(tip: &dyn Fn(&[f64]) -> Point3<f64>, q: &[f64], j: usize) -> Vector3<f64> {
    const STEP: f64 = 1e-5;
    let moved = |by: f64| {
        let mut q = q.to_vec();
        q[j] += by;
        tip(&q)
    };
    (moved(STEP) - moved(-STEP)) / (2.0 * STEP)
}

/// Means over `half` samples either side, fewer at the ends.
fn averaged(values: &[f64], half: usize) -> Vec<f64> {
    let mean = |i: usize| {
        let half = half.min(i).min(values.len() - 1 - i);
        let part = &values[i - half..=i + half];
        part.iter().sum::<f64>() / part.len() as f64
    };
    (0..values.len()).map(mean).collect()
}

/// Has the efforts of all joints later by as many samples as come nearest to `late_s`; the first
/// effort stands until then. The time that this makes (s).
pub fn shift(runs: &mut [Run], late_s: f64) -> f64 {
    let mut shifted = 0.0;
    for run in runs {
        let period = (run.time[run.time.len() - 1] - run.time[0]) / (run.time.len() - 1) as f64;
        let samples = (late_s / period).round() as usize;
        for joint in &mut run.joints {
            let first = joint.effort[0];
            joint.effort.rotate_right(samples);
            joint.effort[..samples].fill(first);
        }
        shifted = samples as f64 * period;
    }
    shifted
}
