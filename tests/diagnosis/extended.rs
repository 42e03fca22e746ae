//! The robot with its findings: as a file, and judged by the log it came from.

use std::path::Path;

use diagnosis::{Diagnosis, Settings, Silent, Verdict, diagnose};
use rayon::prelude::*;
use robot::Robot;

use crate::world::{World, against_nominal, finding, named, sign};

/// Friction, a reading and bodies that a description can hold.
fn describable() -> World {
    World::nominal()
        .torque(3, |[_, qd, _]| 0.5 * sign(qd) + 0.6 * qd)
        .reading(2, |effort| effort + 0.3)
        .torque(0, |[_, _, qdd]| 0.1 * qdd)
}

/// A palm that is 1 kg heavier, 10 cm before its origin.
fn loaded() -> World {
    World::nominal().body(|mut robot| {
        let inertia = &mut robot.link_mut(6).unwrap().inertia;
        *inertia = inertia.with_body(&robot::Inertia {
            mass: 1.0,
            com_in_link: 0.1 * nalgebra::Vector3::z(),
            about_com: nalgebra::Matrix3::identity() * (0.4 * 0.03 * 0.03),
        });
        robot
    })
}

/// Names of the joints at which something is left without a name.
fn unexplained(diagnosis: &Diagnosis) -> Vec<&str> {
    diagnosis.unexplained.iter().map(|u| u.joint.as_str()).collect()
}

/// Diagnosed again with its findings, a log is consistent but for what the first
/// diagnosis said was left; no cause is found twice.
#[test]
fn the_extended_robot_explains_the_log_it_came_from() {
    let trials = [("drives", describable()), ("payload", loaded())];
    let trials: Vec<_> = trials.iter().flat_map(|t| (4000..4003).map(move |s| (t, s))).collect();
    let failure = |((what, world), seed): &(&(&str, World), u64)| {
        let runs = world.log(*seed);
        let first = against_nominal(&runs);
        let again = diagnose(&first.extended, &runs, &Settings::default(), &Silent).unwrap();
        let (first, again) = (first.diagnosis, again.diagnosis);
        let (before, after) = (named(&first), named(&again));
        let (left, later) = (unexplained(&first), unexplained(&again));
        let text = format!("{what} {seed}: {before:?}, left {left:?}; then {after:?}, {later:?}");
        println!("{text}");
        let fine = !before.is_empty()
            && !after.iter().any(|cause| before.contains(cause))
            && later.iter().all(|joint| left.contains(joint))
            && (!left.is_empty() || again.verdict == Verdict::Consistent);
        (!fine).then_some(text)
    };
    let failures: Vec<String> = trials.par_iter().filter_map(failure).collect();
    assert!(failures.is_empty(), "\n{}", failures.join("\n"));
}

/// A torque that no effect of the catalogue makes stays without a name, twice.
#[test]
fn what_has_no_name_is_left_over_by_the_extended_robot_and_only_that() {
    let world = describable().torque(1, |[q, ..]| 2.0 * (6.0 * q).sin());
    let runs = world.log(4010);
    let first = against_nominal(&runs);
    let again = diagnose(&first.extended, &runs, &Settings::default(), &Silent).unwrap();
    println!("{:?}, then {:?}", named(&first.diagnosis), named(&again.diagnosis));
    for diagnosis in [&first.diagnosis, &again.diagnosis] {
        assert_eq!(unexplained(diagnosis), ["j2_shoulder_pitch"]);
    }
    for f in &first.diagnosis.findings {
        let twice = finding(&again.diagnosis, &f.at.words());
        assert!(twice.is_none(), "{} was already in the robot", f.at.words());
    }
}

#[test]
fn the_extended_robot_written_and_loaded_again_is_the_same() {
    let folder = tempfile::tempdir().unwrap();
    let source = Path::new(env!("CARGO_MANIFEST_DIR")).join("../robots/wam7");
    std::fs::copy(source.join("robot.urdf"), folder.path().join("robot.urdf")).unwrap();
    let loaded_wam = Robot::load(&source.join("robot.toml")).unwrap();
    for world in [describable(), loaded()] {
        let outcome = against_nominal(&world.log(4020));
        assert_ne!(outcome.extended, loaded_wam.robot, "{:?}", named(&outcome.diagnosis));
        let text = loaded_wam.to_toml(&outcome.extended, "robot.urdf").unwrap();
        let path = folder.path().join("extended.toml");
        std::fs::write(&path, text).unwrap();
        assert_eq!(Robot::load(&path).unwrap().robot, outcome.extended);
    }
}
