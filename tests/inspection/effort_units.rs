//! Efforts in another unit, of arms with friction: of every joint what is read must be the torque.

use inspection::{CorrectedLogs, ObservationKind, correct};
use logs::Run;

use crate::arms_with_friction::{ARMS, arm, runs};

/// Logged effort per N m of a joint.
type PerNm = fn(usize) -> f64;

/// Currents (A) per torque (N m) of drives of two sizes and of seven, and units in use.
const UNITS: [(&str, PerNm); 5] = [
    ("drives of two sizes", |j| 1.0 / if j < 3 { 12.6 } else { 9.3 }),
    ("drives of seven sizes", |j| 1.0 / [15.0, 12.6, 9.3, 11.0, 6.1, 5.4, 4.5][j]),
    ("one constant", |_| 1.0 / 7.2),
    ("the motor's torque", |_| 0.01),
    ("mN m", |_| 1e3),
];

/// Slope of a regression of efforts as they were read on those in N m.
fn slope(read: &[Run], whole: &[Run], j: usize) -> f64 {
    let efforts = |runs: &[Run]| -> Vec<f64> {
        runs.iter().flat_map(|run| run.joints[j].effort.clone()).collect()
    };
    let (read, whole) = (efforts(read), efforts(whole));
    let dot = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
    dot(&read, &whole) / dot(&whole, &whole)
}

/// Joints that are read off by more than a share of the torque, in words.
fn wrong(of: &str, read: &CorrectedLogs, whole: &[Run], off: f64) -> Vec<String> {
    let Some(runs) = &read.runs else { return vec![format!("{of}: {:?}", read.left)] };
    let is_unknown = |j: &usize| {
        let unknown = |o: &&inspection::Observation| o.kind == ObservationKind::UnknownUnit;
        read.left.iter().filter(unknown).any(|o| o.joints.contains(j))
    };
    let known = (0..whole[0].joints.len()).filter(|j| !is_unknown(j));
    let slopes = known.map(|j| (j, slope(runs, whole, j)));
    let wrong = slopes.filter(|(_, slope)| (slope - 1.0).abs() > off);
    wrong.map(|(j, slope)| format!("{of}: joint {j} is read as {slope:.3} of the torque")).collect()
}

#[test]
fn efforts_in_another_unit_are_read_in_it_joint_by_joint() {
    let mut all = Vec::new();
    for (name, coulomb, viscous) in ARMS {
        let robot = arm(name);
        for (friction, seed) in
            [0.0, 0.3, 1.0, 2.0].into_iter().flat_map(|f| (0..5).map(move |s| (f, s)))
        {
            let whole = runs(&robot, [coulomb, viscous], friction, 400 + seed);
            for (unit, per_nm) in UNITS {
                let mut logged = whole.clone();
                for (j, joint) in logged.iter_mut().flat_map(|r| r.joints.iter_mut().enumerate()) {
                    joint.effort.iter_mut().for_each(|effort| *effort *= per_nm(j));
                }
                let of = format!("{name}, {unit}, friction x {friction}, seed {seed}");
                all.extend(wrong(&of, &correct(&robot, &logged), &whole, 0.02));
            }
        }
    }
    assert!(all.is_empty(), "{}", all.join("\n"));
}
