//! Ways to spoil clean logs, and what is to be told of each.

use std::f64::consts::{FRAC_PI_2, PI, TAU};

use checks::arms::potential_energy;
use inspection::{Observation, ObservationKind as K};
use logs::{Channels, Run};
use nalgebra::{Unit, Vector3};
use robot::Robot;

/// A clean robot and its logs.
#[derive(Clone)]
pub struct Clean {
    pub robot: Robot,
    pub runs: Vec<Run>,
}

/// A way to spoil them.
pub struct Spoil {
    pub name: &'static str,
    pub spoil: fn(&mut Clean, [usize; 2]),
    pub told: fn(K) -> bool,
    /// Whether nearly all such logs must be told; otherwise the logs say too little of it, or rivals as much.
    pub sure: Sure,
    /// Whether the joints told must be the one, or the two, that were spoilt.
    pub joints: usize,
}

/// How surely a way to spoil logs is told.
#[derive(Clone, Copy, PartialEq, Eq)]
pub enum Sure {
    Nearly,
    Sometimes,
}

const fn of(
    name: &'static str,
    joints: usize,
    spoil: fn(&mut Clean, [usize; 2]),
    told: fn(K) -> bool,
) -> Spoil {
    Spoil { name, spoil, told, joints, sure: Sure::Nearly }
}

const fn sometimes(spoil: Spoil) -> Spoil {
    Spoil { sure: Sure::Sometimes, ..spoil }
}

/// All ways.
pub const SPOILS: [Spoil; 30] = [
    of("effort sign, a joint", 1, |c, [a, _]| efforts(c, a, |e| -e), |k| k == K::EffortSign),
    of("effort sign, all", 0, |c, _| all_efforts(c, |_, e| -e), |k| k == K::EffortSign),
    of("position sign, a joint", 1, |c, [a, _]| scale(c, a, -1.0, -1.0), |k| k == K::PositionSign),
    of(
        "position sign, velocity kept",
        1,
        |c, [a, _]| scale(c, a, -1.0, 1.0),
        |k| k == K::PositionSign,
    ),
    of(
        "axis turned",
        1,
        |c, [a, _]| {
            scale(c, a, -1.0, -1.0);
            efforts(c, a, |e| -e);
        },
        |k| k == K::AxisSign,
    ),
    of("joints exchanged", 2, exchange, |k| k == K::JointsExchanged),
    of("efforts exchanged", 2, exchange_efforts, |k| k == K::EffortsExchanged),
    of("effort in mN m", 0, |c, _| all_efforts(c, |_, e| 1e3 * e), |k| unit(k, 1e3)),
    of(
        "effort in A",
        0,
        |c, _| all_efforts(c, |j, e| e / (7.0 + j as f64)),
        |k| matches!(k, K::EffortUnit { .. }),
    ),
    of("effort of the motor", 0, |c, _| all_efforts(c, |_, e| e / 100.0), |k| unit(k, 1e-2)),
    of("effort without gravity", 0, |c, _| lift(c), |k| k == K::EffortWithoutGravity),
    of("base hanging", 0, |c, _| pull(c, |g| -g), is_direction),
    of("base on a wall", 0, |c, _| pull(c, |g| Vector3::new(g.z, g.x, g.y)), is_direction),
    of(
        "off by a quarter turn",
        1,
        |c, [a, _]| offset(c, a, FRAC_PI_2),
        |k| is_offset(k, FRAC_PI_2),
    ),
    of("off by half a turn", 1, |c, [a, _]| offset(c, a, PI), |k| is_offset(k, PI)),
    of("time in ms", 0, |c, _| time(c, |t, _| 1e3 * t), |k| is_time(k, 1e3)),
    of("time in ns", 0, |c, _| time(c, |t, _| 1e9 * t), |k| is_time(k, 1e9)),
    of(
        "time a sample number",
        0,
        |c, _| time(c, |_, k| k as f64),
        |k| matches!(k, K::TimeUnit { .. }),
    ),
    of("time stretched by 1.1", 0, |c, _| time(c, |t, _| 1.1 * t), |k| is_time(k, 1.1)),
    of("time stretched by 2", 0, |c, _| time(c, |t, _| 2.0 * t), |k| is_time(k, 2.0)),
    of(
        "time in ms, no velocity",
        0,
        |c, _| {
            time(c, |t, _| 1e3 * t);
            no_velocity(c)
        },
        |k| is_time(k, 1e3),
    ),
    sometimes(of(
        "time stretched by 2, no velocity",
        0,
        |c, _| {
            time(c, |t, _| 2.0 * t);
            no_velocity(c)
        },
        |k| is_time(k, 2.0),
    )),
    of(
        "degrees at a joint",
        1,
        |c, [a, _]| scale(c, a, 180.0 / PI, 180.0 / PI),
        |k| k == K::Degrees,
    ),
    of("stuck encoder", 1, stuck, |k| k == K::StuckEncoder),
    of("held for 2 s", 0, held, |k| k == K::Held),
    of("five spikes", 1, spikes, |k| matches!(k, K::Spikes { count: 5, .. })),
    of("jump by a turn", 1, jump, |k| matches!(k, K::TurnJump { turns: 1 })),
    of("effort clipped", 1, clip, |k| matches!(k, K::AtLimit { .. })),
    of("two runs overlap", 0, overlap, |k| matches!(k, K::Overlap { .. })),
    sometimes(of("another robot", 0, |c, _| other_axes(c), |k| k == K::AnotherRobot)),
];

/// Whether what was done is among what is told: as the first reading, or as one that fits as well.
pub fn is_told(spoil: &Spoil, joints: [usize; 2], told: &[Observation]) -> bool {
    let those = |found: &[usize]| match spoil.joints {
        0 => true,
        1 => found == [joints[0]],
        _ => {
            let mut sorted = joints;
            sorted.sort_unstable();
            found == sorted
        }
    };
    told.iter().any(|o| {
        let first = (spoil.told)(o.kind) && those(&o.joints);
        first || o.or.iter().any(|r| (spoil.told)(r.kind) && those(&r.joints))
    })
}

fn near(x: f64, expected: f64) -> bool {
    (x / expected).ln().abs() < 0.2
}

fn unit(kind: K, expected: f64) -> bool {
    matches!(kind, K::EffortUnit { factor } if near(factor, expected))
}

fn is_time(kind: K, expected: f64) -> bool {
    matches!(kind, K::TimeUnit { factor } if (factor / expected).ln().abs() < 0.05 || (expected > 1.5 && near(factor, expected)))
}

fn is_direction(kind: K) -> bool {
    matches!(kind, K::GravityDirection { .. })
}

fn is_offset(kind: K, expected: f64) -> bool {
    let apart =
        |offset: f64| ((offset - expected) / TAU - ((offset - expected) / TAU).round()).abs();
    matches!(kind, K::PositionOffset { offset } if apart(offset) < 0.01)
}

fn efforts(clean: &mut Clean, joint: usize, to: fn(f64) -> f64) {
    for run in &mut clean.runs {
        run.joints[joint].effort.iter_mut().for_each(|e| *e = to(*e));
    }
}

fn all_efforts(clean: &mut Clean, to: fn(usize, f64) -> f64) {
    for run in &mut clean.runs {
        for (j, joint) in run.joints.iter_mut().enumerate() {
            joint.effort.iter_mut().for_each(|e| *e = to(j, *e));
        }
    }
}

fn scale(clean: &mut Clean, joint: usize, position: f64, velocity: f64) {
    for run in &mut clean.runs {
        let joint = &mut run.joints[joint];
        joint.position.iter_mut().for_each(|q| *q *= position);
        joint.velocity.iter_mut().flatten().for_each(|v| *v *= velocity);
    }
}

fn exchange(clean: &mut Clean, [a, b]: [usize; 2]) {
    for run in &mut clean.runs {
        run.joints.swap(a, b);
    }
}

fn exchange_efforts(clean: &mut Clean, [a, b]: [usize; 2]) {
    for run in &mut clean.runs {
        let effort = std::mem::take(&mut run.joints[a].effort);
        run.joints[a].effort = std::mem::replace(&mut run.joints[b].effort, effort);
    }
}

/// Takes `dV/dq` of the potential energy from the efforts.
fn lift(clean: &mut Clean) {
    const STEP: f64 = 1e-4;
    for run in &mut clean.runs {
        for k in 0..run.time.len() {
            let q: Vec<f64> = run.joints.iter().map(|j| j.position[k]).collect();
            for (j, joint) in run.joints.iter_mut().enumerate() {
                let at = |step: f64| {
                    let mut q = q.clone();
                    q[j] += step;
                    potential_energy(&clean.robot, &q)
                };
                joint.effort[k] -= (at(STEP) - at(-STEP)) / (2.0 * STEP);
            }
        }
    }
}

fn pull(clean: &mut Clean, to: fn(Vector3<f64>) -> Vector3<f64>) {
    let gravity = to(clean.robot.gravity_in_base());
    clean.robot = clean.robot.clone().with_gravity(gravity);
}

fn offset(clean: &mut Clean, joint: usize, by: f64) {
    for run in &mut clean.runs {
        run.joints[joint].position.iter_mut().for_each(|q| *q += by);
    }
}

fn time(clean: &mut Clean, to: fn(f64, usize) -> f64) {
    for run in &mut clean.runs {
        run.time.iter_mut().enumerate().for_each(|(k, t)| *t = to(*t, k));
    }
}

fn no_velocity(clean: &mut Clean) {
    clean.runs.iter_mut().flat_map(|run| &mut run.joints).for_each(|joint| joint.velocity = None);
}

/// A row of the first run about the middle at which a joint is fast.
fn fast_row(run: &Run, joint: usize) -> usize {
    let q = &run.joints[joint].position;
    let speed = |k: usize| (q[k + 4] - q[k - 4]).abs();
    let rows = q.len() / 4..3 * q.len() / 4;
    let fastest = rows.clone().map(speed).fold(0.0, f64::max);
    let middle = q.len() / 2;
    rows.filter(|&k| speed(k) > 0.5 * fastest).min_by_key(|k| k.abs_diff(middle)).unwrap()
}

fn stuck(clean: &mut Clean, [joint, _]: [usize; 2]) {
    let from = fast_row(&clean.runs[0], joint);
    let joint = &mut clean.runs[0].joints[joint];
    let still = joint.position[from];
    joint.position[from..].fill(still);
}

fn held(clean: &mut Clean, [joint, _]: [usize; 2]) {
    let run = &mut clean.runs[0];
    let from = fast_row(run, joint);
    let until = run.time.partition_point(|t| *t < run.time[from] + 2.0);
    for Channels { position, effort, velocity, .. } in &mut run.joints {
        for signal in [position, effort].into_iter().chain(velocity) {
            let still = signal[from];
            signal[from..until].fill(still);
        }
    }
}

fn spikes(clean: &mut Clean, [joint, _]: [usize; 2]) {
    let q = &mut clean.runs[0].joints[joint].position;
    for part in 1..=5 {
        let row = part * q.len() / 7;
        q[row] += if part % 2 == 0 { 0.1 } else { -0.1 };
    }
}

fn jump(clean: &mut Clean, [joint, _]: [usize; 2]) {
    let q = &mut clean.runs[0].joints[joint].position;
    let from = q.len() / 2;
    q[from..].iter_mut().for_each(|q| *q += TAU);
}

/// Clips at what half of the samples exceed.
fn clip(clean: &mut Clean, [joint, _]: [usize; 2]) {
    let all = || clean.runs.iter().flat_map(|run| &run.joints[joint].effort);
    let mean = all().sum::<f64>() / all().count() as f64;
    let mut sizes: Vec<f64> = all().map(|e| (e - mean).abs()).collect();
    sizes.sort_unstable_by(f64::total_cmp);
    let limit = sizes[sizes.len() / 2];
    for run in &mut clean.runs {
        run.joints[joint].effort.iter_mut().for_each(|e| *e = (*e - mean).clamp(-limit, limit));
    }
}

/// Cuts the first run into two that share a third of it.
fn overlap(clean: &mut Clean, _: [usize; 2]) {
    let part = |run: &Run, rows: std::ops::Range<usize>, name: &str| {
        let cut = |x: &[f64]| x[rows.clone()].to_vec();
        let joint = |j: &Channels| Channels {
            name: j.name.clone(),
            position: cut(&j.position),
            effort: cut(&j.effort),
            velocity: j.velocity.as_deref().map(cut),
            ..Channels::default()
        };
        let time = cut(&run.time);
        let joints = run.joints.iter().map(joint).collect();
        Run { name: name.to_owned(), time, joints, extra: Default::default(), ..run.clone() }
    };
    let run = clean.runs.remove(0);
    let n = run.time.len();
    clean.runs.insert(0, part(&run, 0..2 * n / 3, "first"));
    clean.runs.push(part(&run, n / 3..n, "last"));
}

/// The description of an arm with other axes.
fn other_axes(clean: &mut Clean) {
    for j in 0..clean.robot.joint_count() {
        let axis = &mut clean.robot.link_mut(j).unwrap().joint.axis_in_joint;
        *axis = Unit::new_normalize(Vector3::new(axis.y, axis.z, axis.x));
    }
}
