//! Drives that fit an arm: rotors, torque limits, counterbalances and the gains of their loops.

use nalgebra::{DMatrix, DVector};
use rand_chacha::ChaCha8Rng;
use robot::{JointKind, Robot};

use crate::arms::electronics::Electronics;
use crate::arms::make::Make;
use crate::dice::{between, round_to_digits};
use crate::rigid::{mass_matrix, torque};

/// Postures at which an arm is weighed.
const POSTURES: usize = 40;
/// What bodies need over what a drive has: the rest is for friction.
const BODIES_SHARE: f64 = 0.7;
/// Torque limit over what a drive needs.
const RESERVE: f64 = 2.0;
/// Largest `lambda lag` of a loop, `lambda` the largest eigenvalue of `M^-1 Kd`: half of what a rate loop
/// with that lag stands.
const LARGEST_LAG: f64 = 0.5;

/// Rounds in which single loops are weakened.
const SOFTENED: usize = 60;

/// The drive of a joint, everything seen at the joint.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct SampledDrive {
    /// Turns of the motor in a turn of the joint.
    pub gear: f64,
    /// Inertia of rotor and gear (kg m^2 or kg).
    pub rotor: f64,
    /// Largest torque (N m or N).
    pub limit: f64,
    /// Stiffness (N m/rad) and rest (rad) of a counterbalance, 0 for none.
    pub spring: [f64; 2],
    /// Gains of its loop.
    pub kp: f64,
    /// Gains of its loop.
    pub kd: f64,
}

/// What an arm weighs.
struct Weighed {
    /// Largest torque of gravity and springs (N m or N).
    gravity: Vec<f64>,
    /// Mass matrices at the postures.
    inertia: Vec<DMatrix<f64>>,
}

/// Sizes the drives of a robot whose bodies and gravity are known, and puts them into it.
///
/// ```text
/// limit = 2 (max gravity + max M_ii a) / 0.7
/// rotor = rated torque / acceleration of the motor alone,  rated = limit / 2
/// kp    = max(w^2 M_ii, (max gravity + limit / 20) / sag),  kd = 2 zeta sqrt(kp M_ii)
/// ```
pub(crate) fn fit(
    robot: &mut Robot,
    make: &Make,
    electronics: &Electronics,
    random: &mut ChaCha8Rng,
) -> Vec<SampledDrive> {
    let postures = postures(robot, random);
    let weighed = weigh(robot, &postures);
    let accelerations = accelerations(robot, make, random);
    let mut drives = Vec::with_capacity(robot.joint_count());
    for i in 0..robot.joint_count() {
        let slides = slides(robot, i);
        let most = weighed.inertia.iter().map(|m| m[(i, i)]).fold(0.0, f64::max);
        let bodies = weighed.gravity[i] + most * accelerations[i];
        let least = 0.5 * make.least_limit[usize::from(slides)];
        let mut rated = (bodies / BODIES_SHARE).max(least * between(random, [1.0, 1.5]));
        let share = if slides { 0.1 } else { 1.0 };
        let [low, high] = make.rotor_inertia;
        let [low, high] = if slides { [low, f64::INFINITY] } else { [low, high] };
        let agile = share * between(random, make.rotor_acceleration);
        let rotor = round_to_digits((rated / agile).clamp(low, high), 3);
        rated += rotor * accelerations[i] / BODIES_SHARE;
        let gear = between(random, make.gear).round();
        drives.push(SampledDrive {
            gear,
            rotor,
            limit: round_to_digits(RESERVE * rated, 2),
            spring: [0.0, 0.0],
            kp: 0.0,
            kd: 0.0,
        });
    }
    put(robot, &drives);
    tune(robot, &postures, &mut drives, &weighed.gravity, electronics, random);
    drives
}

/// Puts rotors, springs and limits into a robot.
pub(crate) fn put(robot: &mut Robot, drives: &[SampledDrive]) {
    for (i, drive) in drives.iter().enumerate() {
        let Some(link) = robot.link_mut(i) else { continue };
        link.actuator.rotor_inertia = drive.rotor;
        [link.actuator.spring_stiffness, link.actuator.spring_rest] = drive.spring;
        link.joint.limits.effort = Some(drive.limit);
    }
}

/// A spring that carries some of what a joint carries (N m/rad), at rest where that is least.
pub(crate) fn counterbalance(
    robot: &Robot,
    i: usize,
    share: f64,
    random: &mut ChaCha8Rng,
) -> [f64; 2] {
    let postures = postures(robot, random);
    let still = vec![0.0; robot.joint_count()];
    // Least squares of the torque over position: slope and zero of its line.
    let points = postures.iter().map(|q| (q[i], torque(robot, q, &still, &still)[i]));
    let [mut n, mut sx, mut sy, mut sxx, mut sxy] = [0.0; 5];
    for (x, y) in points {
        n += 1.0;
        sx += x;
        sy += y;
        sxx += x * x;
        sxy += x * y;
    }
    let slope = (n * sxy - sx * sy) / (n * sxx - sx * sx);
    if slope >= 0.0 || !slope.is_finite() {
        return [0.0, 0.0];
    }
    let zero = (sx - sy / slope) / n;
    [round_to_digits(-share * slope, 3), (100.0 * zero.clamp(-0.5, 0.5)).round() / 100.0]
}

/// Gains from the inertia that each joint turns, weaker where the loop would not stand them.
fn tune(
    robot: &Robot,
    postures: &[Vec<f64>],
    drives: &mut [SampledDrive],
    gravity: &[f64],
    electronics: &Electronics,
    random: &mut ChaCha8Rng,
) {
    let inertia: Vec<DMatrix<f64>> = postures.iter().map(|q| mass_matrix(robot, q)).collect();
    for (i, drive) in drives.iter_mut().enumerate() {
        let mean = inertia.iter().map(|m| m[(i, i)]).sum::<f64>() / inertia.len() as f64;
        let omega = std::f64::consts::TAU * between(random, [2.0, 5.0]);
        let sag = between(random, [0.015, 0.04]);
        let sag = if slides(robot, i) { 0.2 * sag } else { sag };
        drive.kp = (omega * omega * mean).max((gravity[i] + 0.05 * drive.limit) / sag);
        drive.kd = 2.0 * between(random, [0.7, 1.0]) * (drive.kp * mean).sqrt();
    }
    soften(drives, &inertia, LARGEST_LAG / electronics.lag_s());
    for drive in drives {
        drive.kp = round_to_digits(drive.kp, 3);
        drive.kd = round_to_digits(drive.kd, 3);
    }
}

/// Weakens loops until no eigenvalue of `M^-1 Kd` is above `highest` (1/s): first, some rounds long, that of
/// the joint which the fastest mode moves most, then all of them.
fn soften(drives: &mut [SampledDrive], inertia: &[DMatrix<f64>], highest: f64) {
    let inverse = |m: &DMatrix<f64>| m.clone().try_inverse();
    let inverses: Vec<DMatrix<f64>> = inertia.iter().filter_map(inverse).collect();
    for _ in 0..SOFTENED {
        let (fastest, mode) = fastest(drives, &inverses);
        if fastest <= highest {
            return;
        }
        if let Some(drive) = drives.get_mut(mode.iamax()) {
            weaken(drive, 0.9);
        }
    }
    let (fastest, _) = fastest(drives, &inverses);
    let share = (highest / fastest).min(1.0);
    drives.iter_mut().for_each(|drive| weaken(drive, share));
}

/// Keeps the damping ratio.
fn weaken(drive: &mut SampledDrive, share: f64) {
    drive.kd *= share;
    drive.kp *= share * share;
}

/// Largest eigenvalue of `Kd^1/2 M^-1 Kd^1/2` over all postures (1/s), and its mode.
fn fastest(drives: &[SampledDrive], inverses: &[DMatrix<f64>]) -> (f64, DVector<f64>) {
    let damping = DVector::from_iterator(drives.len(), drives.iter().map(|d| d.kd.sqrt()));
    let damping = DMatrix::from_diagonal(&damping);
    let mut found = (0.0, DVector::zeros(drives.len()));
    for inverse in inverses {
        let eigen = (&damping * inverse * &damping).symmetric_eigen();
        let at = eigen.eigenvalues.imax();
        if eigen.eigenvalues[at] > found.0 {
            found = (eigen.eigenvalues[at], eigen.eigenvectors.column(at).into_owned());
        }
    }
    found
}

/// Accelerations that drives are sized for (rad/s^2 or m/s^2).
pub(crate) fn accelerations(robot: &Robot, make: &Make, random: &mut ChaCha8Rng) -> Vec<f64> {
    let share = between(random, [0.0, 1.0]);
    let of = |i| {
        let [low, high] = make.acceleration[usize::from(slides(robot, i))];
        low + share * (high - low)
    };
    (0..robot.joint_count()).map(of).collect()
}

fn weigh(robot: &Robot, postures: &[Vec<f64>]) -> Weighed {
    let still = vec![0.0; robot.joint_count()];
    let mut gravity = still.clone();
    for q in postures {
        let held = torque(robot, q, &still, &still);
        gravity.iter_mut().zip(held).for_each(|(most, tau)| *most = most.max(tau.abs()));
    }
    Weighed { gravity, inertia: postures.iter().map(|q| mass_matrix(robot, q)).collect() }
}

fn postures(robot: &Robot, random: &mut ChaCha8Rng) -> Vec<Vec<f64>> {
    let ranges = robot.links().iter().map(|l| l.joint.limits.position.unwrap_or((-3.0, 3.0)));
    let ranges: Vec<(f64, f64)> = ranges.collect();
    let mut posture = || ranges.iter().map(|&(a, b)| between(random, [a, b])).collect();
    (0..POSTURES).map(|_| posture()).collect()
}

fn slides(robot: &Robot, i: usize) -> bool {
    robot.links()[i].joint.kind == JointKind::Prismatic
}
