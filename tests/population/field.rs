//! What robots in use have, seen through the files of a trial.

use std::path::Path;

use document::Document;
use logs::{ReadOptions, Run, read_run};
use nalgebra::{Isometry3, Point3, Rotation3, Vector3};
use population::{
    ArmClass, FieldFeature, MotionClass, PopulationSpec, RobotShares, TruthSheet, make,
};
use robot::Robot;
use simulator::effects::EffectSpec;
use simulator::scenario::Scenario;

use crate::made::{files, short};

/// Trials without causes of a class, with some shares.
fn spec(class: ArmClass, robots: RobotShares) -> PopulationSpec {
    PopulationSpec { strangers: 0.0, robots, ..short(class, [0, 0]) }
}

/// The first trial that has a feature, from a seed on.
fn first(spec: &PopulationSpec, from: u64, feature: FieldFeature, folder: &Path) -> TruthSheet {
    let made = (from..from + 12).map(|seed| make(spec, seed, folder).unwrap());
    let sheet = made.into_iter().find(|sheet| sheet.corner.field.contains(&feature));
    sheet.unwrap_or_else(|| panic!("no trial of twelve has {feature}"))
}

fn scenario(folder: &Path) -> Scenario {
    Scenario::from_document(&Document::read(folder.join("truth/scenario.toml")).unwrap()).unwrap()
}

fn robot(folder: &Path, side: &str) -> Robot {
    Robot::load(&folder.join(side).join("robot.toml")).unwrap().robot
}

fn log(folder: &Path, number: usize, robot: &Robot) -> Run {
    let path = folder.join(format!("logs/log_{number}.parquet"));
    read_run(&path, robot, &ReadOptions::default()).unwrap()
}

/// A turned axis is in the nominal URDF and nowhere else: no other draw has moved.
#[test]
fn a_turned_axis_changes_the_nominal_urdf_alone() {
    let made = |robots| {
        let folder = tempfile::tempdir().unwrap();
        let sheet = make(&spec(ArmClass::Hobby, robots), 4, folder.path()).unwrap();
        (files(folder.path()), sheet)
    };
    let (plain, as_ever) = made(RobotShares::default());
    let (turned, sheet) = made(RobotShares { turned_axes: 1.0, ..RobotShares::default() });
    let differ: Vec<&String> = plain.keys().filter(|name| plain[*name] != turned[*name]).collect();
    assert_eq!(differ, ["nominal/robot.urdf", "sheet.json"]);
    assert_eq!(as_ever.causes, sheet.causes);
    assert!(as_ever.corner.field.is_empty());
    assert_eq!(sheet.corner.field, [FieldFeature::AxisTurned]);
    assert_eq!(sheet.strangers[0].name, "model: axis turned");
}

/// At the joint with the largest effort; `torque_rms` is that of the logs without noise.
#[test]
fn strong_friction_is_a_tenth_to_a_third_of_the_effort() {
    let robots = RobotShares { strong_friction: 1.0, ..RobotShares::default() };
    for (class, seed) in [(ArmClass::Cobot, 20), (ArmClass::Industrial, 40), (ArmClass::Wam, 60)] {
        let folder = tempfile::tempdir().unwrap();
        let sheet = first(&spec(class, robots), seed, FieldFeature::StrongFriction, folder.path());
        let arm = scenario(folder.path());
        let most = sheet.torque_rms.iter().copied().fold(0.0, f64::max);
        let large = sheet.torque_rms.iter().position(|rms| *rms >= most).unwrap();
        let level = arm.effects().iter().find_map(|effect| match effect {
            EffectSpec::CoulombFriction(dry) if dry.joint == sheet.joints[large] => {
                Some(dry.level_nm)
            }
            _ => None,
        });
        let share = level.unwrap() / most;
        println!("{class}: Coulomb over RMS effort {share:.3}");
        assert!((0.1..=1.0 / 3.0).contains(&share), "{class}: {share}");
    }
}

/// `g = exp(w x) g_nominal`, and nothing else differs between the two bases.
#[test]
fn an_unknown_mount_is_told_as_the_turn_of_gravity() {
    let robots = RobotShares { unknown_mounts: 1.0, ..RobotShares::default() };
    let folder = tempfile::tempdir().unwrap();
    let sheet = first(&spec(ArmClass::Hobby, robots), 0, FieldFeature::MountUnknown, folder.path());
    let cause = sheet.causes.iter().find(|cause| cause.truth.effect.name() == "gravity_direction");
    let tilt = &cause.unwrap().truth.parameters;
    let turn = Rotation3::new(Vector3::new(tilt["tilt_1"], tilt["tilt_2"], 0.0));
    let [truth, nominal] =
        ["truth", "nominal"].map(|side| robot(folder.path(), side).gravity_in_base());
    assert_eq!(nominal, Vector3::new(0.0, 0.0, -9.81));
    assert!((turn * nominal - truth).norm() < 1e-4, "{truth}");
    assert!((0.08..1.6).contains(&truth.angle(&nominal)));
}

#[test]
fn every_drive_is_late_by_the_same_time() {
    let robots = RobotShares { delayed_drives: 1.0, ..RobotShares::default() };
    let folder = tempfile::tempdir().unwrap();
    let sheet =
        first(&spec(ArmClass::Hobby, robots), 0, FieldFeature::DelayedDrives, folder.path());
    let late: Vec<_> =
        sheet.causes.iter().filter(|c| c.truth.effect.name() == "actuator_delay").collect();
    assert_eq!(late.len(), sheet.joints.len());
    let delay = late[0].truth.parameters["delay"];
    assert!(late.iter().all(|cause| (cause.truth.parameters["delay"] - delay).abs() < 1e-12));
    assert!(delay > 0.0);
}

/// In the logs of a trial, two joints have each other's columns of the same trial without the fault.
#[test]
fn exchanged_columns_are_those_of_the_other_joint() {
    let robots = RobotShares { exchanged_joints: 1.0, ..RobotShares::default() };
    let [plain, spoilt] = [(); 2].map(|()| tempfile::tempdir().unwrap());
    let with = spec(ArmClass::Wam, robots);
    let sheet = first(&with, 70, FieldFeature::ColumnsExchanged, spoilt.path());
    make(&spec(ArmClass::Wam, RobotShares::default()), sheet.seed, plain.path()).unwrap();
    let arm = robot(plain.path(), "truth");
    let [plain, spoilt] = [&plain, &spoilt].map(|folder| log(folder.path(), 1, &arm));
    let is_own = |j: &usize| plain.joints[*j].effort == spoilt.joints[*j].effort;
    let moved: Vec<usize> = (0..arm.joint_count()).filter(|j| !is_own(j)).collect();
    let [one, other] = moved[..] else { panic!("{moved:?}") };
    for (a, b) in [(one, other), (other, one)] {
        assert_eq!(plain.joints[a].effort, spoilt.joints[b].effort);
        assert_eq!(plain.joints[a].position, spoilt.joints[b].position);
        assert_eq!(plain.joints[a].name, spoilt.joints[a].name);
    }
}

/// Potential of a mass on the last link (J).
fn potential(robot: &Robot, mass: f64, com: Vector3<f64>, q: &[f64]) -> f64 {
    let mut base_from: Vec<Isometry3<f64>> = Vec::new();
    for (link, q) in robot.links().iter().zip(q) {
        let parent = link.parent.map_or(Isometry3::identity(), |p| base_from[p]);
        base_from.push(parent * link.joint.parent_from_child(*q));
    }
    let at = base_from[robot.joint_count() - 1] * Point3::from(com);
    -mass * robot.gravity_in_base().dot(&at.coords)
}

/// The same motion with and without: the mean efforts differ by the mean of the payload's weight, `dU / dq`.
#[test]
fn a_payload_that_changes_is_in_the_later_logs() {
    let robots = RobotShares { changed_payloads: 1.0, ..RobotShares::default() };
    let mut spec = spec(ArmClass::Industrial, robots);
    spec.motions = vec![MotionClass::Repeated];
    spec.logs = [2, 2];
    let folder = tempfile::tempdir().unwrap();
    let sheet = first(&spec, 3, FieldFeature::PayloadChanged, folder.path());
    let cause = sheet.causes.iter().find(|cause| cause.truth.effect.name() == "payload").unwrap();
    let of = |key: &str| cause.truth.parameters[key];
    let com = Vector3::new(of("com_x"), of("com_y"), of("com_z"));
    let arm = robot(folder.path(), "truth");
    let [before, after] = [1, 2].map(|number| log(folder.path(), number, &arm));
    let mean = |values: &[f64]| values.iter().sum::<f64>() / values.len() as f64;
    let mut told = Vec::new();
    for j in 0..arm.joint_count() {
        let found = mean(&after.joints[j].effort) - mean(&before.joints[j].effort);
        let rows = (0..after.time.len()).step_by(10);
        let slopes: Vec<f64> = rows
            .map(|i| {
                let at = |step: f64| {
                    let mut q: Vec<f64> = after.joints.iter().map(|c| c.position[i]).collect();
                    q[j] += step;
                    potential(&arm, of("mass"), com, &q)
                };
                (at(1e-5) - at(-1e-5)) / 2e-5
            })
            .collect();
        told.push((found, mean(&slopes)));
    }
    let most = told.iter().map(|(_, weight)| weight.abs()).fold(0.0, f64::max);
    println!("{told:?}");
    assert!(most > 0.0);
    for (found, weight) in &told {
        assert!((found - weight).abs() < 0.05 * most, "{found} for {weight} of {most}");
    }
}
