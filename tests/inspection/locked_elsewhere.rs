//! Joints without a column that stood elsewhere than the description locks them.

use std::collections::BTreeMap;

use checks::arms::data;
use inspection::{Observation, ObservationKind, inspect};
use logs::{ReadOptions, Run, read_run};
use robot::{LoadOptions, Robot, TorqueSource};

use crate::arms_with_friction::{ARMS, runs};

/// An arm whose `locked` joints stand at these positions (rad), with measured efforts.
fn locked(name: &str, locked: &[(&str, f64)]) -> Robot {
    let path = format!("{}/../robots/{name}/robot.toml", env!("CARGO_MANIFEST_DIR"));
    let locked = locked.iter().map(|(name, q)| ((*name).to_owned(), *q)).collect();
    let options = LoadOptions { locked, ..LoadOptions::default() };
    let mut robot = Robot::load_with(path.as_ref(), &options).unwrap().robot;
    for j in 0..robot.joint_count() {
        robot.link_mut(j).unwrap().actuator.torque_source = TorqueSource::Measured;
    }
    robot
}

/// Numbers of an arm in [`ARMS`] for the joints that are left.
fn logs(arm: usize, robot: &Robot, friction: f64, seed: u64) -> Vec<Run> {
    let (name, coulomb, viscous) = ARMS[arm];
    let whole = locked(name, &[]);
    let of = |all: &[f64]| -> Vec<f64> {
        robot.joint_names().map(|name| all[whole.joint_index(name).unwrap()]).collect()
    };
    runs(robot, [&of(coulomb), &of(viscous)], friction, seed)
}

/// Where locked joints are told to stand; `None` where something else is told, or nothing.
fn told(seen: &[Observation]) -> Option<BTreeMap<String, f64>> {
    let [Observation { kind: ObservationKind::LockedElsewhere, locks, .. }] = seen else {
        return None;
    };
    Some(locks.iter().map(|lock| (lock.joint.clone(), lock.position)).collect())
}

const CASES: [(usize, &[(&str, f64)]); 6] = [
    (1, &[("panda_joint3", 1.2)]),
    (1, &[("panda_joint2", -0.7)]),
    (1, &[("panda_joint4", -2.1)]),
    (1, &[("panda_joint3", -0.9), ("panda_joint5", 1.4)]),
    (0, &[("elbow_joint", -1.4)]),
    (0, &[("elbow_joint", 1.1), ("wrist_2_joint", -1.6)]),
];

/// The position of the joint that carries most is found to .05 rad. One whose position changes little may stay unsaid.
#[test]
fn joints_that_stand_elsewhere_are_told_with_their_positions() {
    let mut missed = Vec::new();
    for (case, (arm, at)) in CASES.into_iter().enumerate() {
        let name = ARMS[arm].0;
        let zeros: Vec<(&str, f64)> = at.iter().map(|(joint, _)| (*joint, 0.0)).collect();
        let (truth, described) = (locked(name, at), locked(name, &zeros));
        for (friction, seed) in [0.0, 0.3, 1.0, 2.0].into_iter().zip(0..) {
            let logged = logs(arm, &truth, friction, 900 + 10 * case as u64 + seed);
            let of = format!("{at:?}, friction x {friction}");
            let seen = inspect(&described, &logged);
            match told(&seen) {
                Some(found) if (found[at[0].0] - at[0].1).abs() < 0.05 => {}
                _ => missed.push(format!("{of}: {seen:?}")),
            }
            assert_eq!(inspect(&truth, &logged), [], "{of}, as described");
            // Every sentence ends with the option that says so.
            if let Some(one) = seen.first() {
                let sentence = one.sentence(&described, &logged);
                assert!(sentence.contains(&format!("--locked {}=", at[0].0)), "{sentence}");
            }
        }
    }
    assert!(missed.is_empty(), "{missed:#?}");
}

/// Of a user's arm: a Panda with five of seven columns, two joints at 1.2 and .8 rad.
#[test]
fn a_panda_of_five_columns_is_told_where_its_third_joint_stood() {
    let Some(folder) = data("field_bugs/locked_not_at_zero") else { return };
    let path = format!("{}/../robots/panda/robot.toml", env!("CARGO_MANIFEST_DIR"));
    let joints = [1, 2, 4, 5, 6].map(|k| format!("panda_joint{k}"));
    let options = LoadOptions { joints: Some(joints.into()), ..LoadOptions::default() };
    let robot = Robot::load_with(path.as_ref(), &options).unwrap().robot;
    let mut files: Vec<_> =
        std::fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()).collect();
    files.retain(|file| file.to_string_lossy().contains("run"));
    files.sort();
    let read = |file: &std::path::PathBuf| read_run(file, &robot, &ReadOptions::default()).unwrap();
    let found = told(&inspect(&robot, &files.iter().map(read).collect::<Vec<_>>())).unwrap();
    assert!((found["panda_joint3"] - 1.2).abs() < 0.01, "{found:?}");
}
