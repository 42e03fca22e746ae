use nalgebra::DMatrix;
use robot::Robot;
use simulator::effects::EffectSpec;
use simulator::{ActingLaws, EffortSource, LawRow, Plant, PositionSide, TrueRun};

use crate::error::PopulationError;
use crate::hidden::{HiddenThings, Which};
use crate::moving::{Moving, body_torque};
use crate::oracle::column::Torque;
use crate::oracle::motion::{SeenRun, means, slopes};
use crate::oracle::stand_ins::{dry, moves};
use crate::rigid::torque;

/// What a log's effort is and where its position is measured.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Sensing {
    pub effort: EffortSource,
    pub side: PositionSide,
}

impl Sensing {
    /// Whether the effort contains the friction and rotors of the drives.
    pub fn sees_drives(self) -> bool {
        self.effort != EffortSource::Link
    }
}

/// Runs of an arm with all that is hidden in it.
#[derive(Debug, Clone, Copy)]
pub(crate) struct HiddenArm<'a> {
    pub robot: &'a Robot,
    pub sensing: Sensing,
    /// Everyday friction.
    pub base: &'a [EffectSpec],
    pub hidden: &'a HiddenThings,
}

/// What a log would say along a motion, and what a model of the arm says along the motion that is read:
///
/// ```text
/// effort = gain (drive + link) + offset [+ command - what reaches the motor, where the command is logged]
/// drive  = sum of levels sign(qd) + viscous qd + bristles - other torques at the motor + rotor qdd   (none in a joint torque)
/// link   = bodies(q, qd, qdd) + spring - other torques at the link - J^T forces
/// beyond = effort - model(q read, qd read, qdd read)
/// ```
///
/// Friction is that of joints that move: one that stands or creeps is held by anything up to its level.
///
/// A wrong gain is counted on what a model says of the arm, not on friction and what else is hidden: without a friction
/// no gain makes one, so that the two must not pass for one another.
struct Beyond {
    effort: DMatrix<f64>,
    q: DMatrix<f64>,
    qd: DMatrix<f64>,
}

/// Motions of motors and links in a run, as matrices: a row a sample, a column a joint.
struct Motions {
    q: DMatrix<f64>,
    qd: DMatrix<f64>,
    qdd: DMatrix<f64>,
    motor_qdd: DMatrix<f64>,
}

impl Motions {
    fn of(run: &TrueRun, joints: usize) -> Self {
        let matrix = |of: &dyn Fn(&simulator::ArmState, usize) -> f64| {
            DMatrix::from_fn(run.rows.len(), joints, |i, j| of(&run.rows[i].state, j))
        };
        let step_s = step_s(run);
        let qd = matrix(&|s, j| s.qd[j]);
        let motor_qd = matrix(&|s, j| s.motor_qd[j]);
        let (qdd, motor_qdd) = (slopes(&qd, step_s), slopes(&motor_qd, step_s));
        Self { q: matrix(&|s, j| s.q[j]), qd, qdd, motor_qdd }
    }
}

fn step_s(run: &TrueRun) -> f64 {
    let length =
        run.rows.last().map_or(0.0, |r| r.time_s) - run.rows.first().map_or(0.0, |r| r.time_s);
    if run.rows.len() > 1 { length / (run.rows.len() - 1) as f64 } else { 1.0 }
}

impl Beyond {
    /// With these gains of the joints.
    fn along(laws: &mut ActingLaws, gains: &[f64], run: &TrueRun, sensing: Sensing) -> Self {
        let robot = laws.plant().robot.clone();
        let joints = robot.joint_count();
        let motions = Motions::of(run, joints);
        let zeros = || DMatrix::zeros(run.rows.len(), joints);
        let mut beyond = Self { effort: zeros(), q: zeros(), qd: zeros() };
        laws.along(run, sensing.side, &mut |i, row| {
            let tau = torques(&robot, &motions, run, i, row, sensing);
            for (j, link) in robot.links().iter().enumerate() {
                let lost =
                    if sensing.effort == EffortSource::Commanded { row.lost[j] } else { 0.0 };
                beyond.effort[(i, j)] = gains[j] * tau[j] + link.actuator.torque_offset + lost;
                beyond.q[(i, j)] = row.reading.q[j];
                beyond.qd[(i, j)] = row.reading.qd[j];
            }
        });
        beyond
    }
}

/// Torques (N m or N) that a motion asks of the place where the effort is measured, at one row.
fn torques(
    robot: &Robot,
    motions: &Motions,
    run: &TrueRun,
    i: usize,
    row: &LawRow,
    sensing: Sensing,
) -> Vec<f64> {
    let of = |m: &DMatrix<f64>| m.row(i).iter().copied().collect::<Vec<f64>>();
    let moving = Moving::new(robot, &of(&motions.q), &of(&motions.qd), &of(&motions.qdd));
    let mut tau = vec![0.0; robot.joint_count()];
    for (l, link) in robot.links().iter().enumerate() {
        moving.add_body(l, &link.inertia.parameters(), &mut tau);
    }
    for (link, force, point) in row.efforts.forces() {
        moving.add_force(link, -force, point, &mut tau);
    }
    let (state, efforts) = (&run.rows[i].state, &row.efforts);
    for (j, link) in robot.links().iter().enumerate() {
        let drive = &link.actuator;
        tau[j] +=
            drive.spring_stiffness * (motions.q[(i, j)] - drive.spring_rest) - efforts.link[j];
        if sensing.sees_drives() {
            let qd = state.motor_qd[j];
            let level = if qd > 0.0 { efforts.dry_forward[j] } else { efforts.dry_backward[j] };
            let held = if moves(qd) { efforts.bristles[j] } else { 0.0 };
            tau[j] += level * dry(qd) - held + efforts.viscous[j] * qd - efforts.motor[j];
            tau[j] += drive.rotor_inertia * motions.motor_qdd[(i, j)];
        }
    }
    tau
}

/// What a model of the arm says along a motion: a row a sample, a column a joint.
fn model(
    robot: &Robot,
    q: &DMatrix<f64>,
    qd: &DMatrix<f64>,
    step_s: f64,
    sensing: Sensing,
) -> DMatrix<f64> {
    let qdd = slopes(qd, step_s);
    let mut all = DMatrix::zeros(q.nrows(), q.ncols());
    for i in 0..all.nrows() {
        let of = |m: &DMatrix<f64>| m.row(i).iter().copied().collect::<Vec<f64>>();
        let tau = torque(robot, &of(q), &of(qd), &of(&qdd));
        for (j, link) in robot.links().iter().enumerate() {
            let drive = &link.actuator;
            all[(i, j)] = tau[j];
            if let Some(balance) = drive.counterbalance {
                all[(i, j)] += balance.amplitude * (q[(i, j)] + balance.phase).sin();
            }
            if !sensing.sees_drives() {
                all[(i, j)] -= drive.rotor_inertia * qdd[(i, j)];
            }
        }
    }
    all
}

/// The torque that one hidden thing adds to the efforts of runs, along their motion:
///
/// ```text
/// torque of k = beyond of all along the motion  -  beyond of all but k along the same motion
/// ```
///
/// [`Beyond`] has no simulation in it, so friction, inertia and control of the rest are the same on both sides.
/// Behind a transmission that `k` bends, what the encoder reads is kept and the other side is where it would be
/// without `k`. Skewed clocks are those of the log: `effort(t) - effort(t + skew)`.
pub(crate) fn added_torque(
    arm: HiddenArm<'_>,
    runs: &[TrueRun],
    seen: &[SeenRun],
    which: Which,
) -> Result<Torque, PopulationError> {
    let HiddenArm { robot, sensing, base, hidden } = arm;
    if let Which::Cause(k) = which
        && let EffectSpec::TimeSkew(skew) = &hidden.causes[k]
    {
        let joint = skew.joint.as_deref().and_then(|name| robot.joint_index(name));
        let late = |(run, seen): (&TrueRun, &SeenRun)| {
            means(&shift_in_time(run, 1e-3 * skew.skew_ms, joint), seen.thinned)
        };
        return Ok(runs.iter().zip(seen).map(late).collect());
    }
    let laws = |hidden: &HiddenThings| {
        ActingLaws::new(robot, &[base, &hidden.causes[..]].concat(), &hidden.strangers)
    };
    let rest = hidden.without(which);
    let mut torque = Vec::with_capacity(runs.len());
    for (run, seen) in runs.iter().zip(seen) {
        let (mut all, mut others) = (laws(hidden)?, laws(&rest)?);
        let [gains, others_gains] = [&all, &others].map(|laws| gains_of(laws.plant()));
        let with = Beyond::along(&mut all, &gains, run, sensing);
        let stiffer = with_stiff_transmissions(run, &all, &others, sensing);
        let without = Beyond::along(&mut others, &gains, stiffer.as_ref().unwrap_or(run), sensing);
        let mut added = with.effort.clone() - &without.effort;
        let model = |q: &DMatrix<f64>, qd: &DMatrix<f64>| model(robot, q, qd, step_s(run), sensing);
        if gains != others_gains {
            let motions = Motions::of(run, robot.joint_count());
            let known = model(&motions.q, &motions.qd);
            for (j, (all, others)) in gains.iter().zip(&others_gains).enumerate() {
                added.column_mut(j).axpy(all - others, &known.column(j), 1.0);
            }
        }
        if with.q != without.q || with.qd != without.qd {
            added -= model(&with.q, &with.qd) - model(&without.q, &without.qd);
        }
        torque.push(means(&added, seen.thinned));
    }
    Ok(torque)
}

/// Reported effort per unit of torque of each joint.
fn gains_of(plant: &Plant) -> Vec<f64> {
    plant.robot.links().iter().map(|link| link.actuator.torque_gain).collect()
}

/// The run as it would be behind the transmissions of fewer effects, where they differ: what the encoder does not
/// read is the deflection that is left from what it reads.
///
/// ```text
/// q - theta = -(load / stiffness + gap / 2 sign(load)),   0 of a rigid one
/// ```
fn with_stiff_transmissions(
    run: &TrueRun,
    all: &ActingLaws,
    others: &ActingLaws,
    sensing: Sensing,
) -> Option<TrueRun> {
    let pairs = all.plant().transmissions.iter().zip(&others.plant().transmissions);
    let changed: Vec<usize> =
        pairs.enumerate().filter(|(_, (a, b))| a != b).map(|(j, _)| j).collect();
    if changed.is_empty() {
        return None;
    }
    let robot = &all.plant().robot;
    let motions = Motions::of(run, robot.joint_count());
    let mut load = vec![0.0; robot.joint_count()];
    let mut run = run.clone();
    for j in changed {
        let left = others.plant().transmissions[j];
        for (i, row) in run.rows.iter_mut().enumerate() {
            let state = &mut row.state;
            let deflection = if left.is_rigid() {
                0.0
            } else {
                let of = |m: &DMatrix<f64>| m.row(i).iter().copied().collect::<Vec<f64>>();
                body_torque(robot, &of(&motions.q), &of(&motions.qd), &of(&motions.qdd), &mut load);
                left.deflection_under(load[j])
            };
            match sensing.side {
                PositionSide::Motor => {
                    state.q[j] = state.motor_q[j] + deflection;
                    if left.is_rigid() {
                        state.qd[j] = state.motor_qd[j];
                    }
                }
                PositionSide::Link => {
                    state.motor_q[j] = state.q[j] - deflection;
                    if left.is_rigid() {
                        state.motor_qd[j] = state.qd[j];
                    }
                }
            }
        }
    }
    Some(run)
}

/// `effort(t) - effort(t + skew)` of one joint or all of them (N m or N), held beyond the ends.
fn shift_in_time(run: &TrueRun, skew_s: f64, joint: Option<usize>) -> DMatrix<f64> {
    let (rows, step_s) = (run.rows.len(), step_s(run));
    let last = rows.saturating_sub(1) as f64;
    DMatrix::from_fn(rows, run.log.joints.len(), |i, j| {
        if joint.is_some_and(|only| only != j) {
            return 0.0;
        }
        let effort = &run.log.joints[j].effort;
        let at = (i as f64 + skew_s / step_s).clamp(0.0, last);
        let (low, part) = (at.floor() as usize, at.fract());
        let high = (low + 1).min(rows - 1);
        effort[i] - (effort[low] + part * (effort[high] - effort[low]))
    })
}
