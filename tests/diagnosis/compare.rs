//! What changed between two sets of logs, of an arm whose description is wrong in both.

use checks::synthetic::{Noise, wam};
use diagnosis::{Comparison, DiagnosisError, Settings, Silent, compare};
use nalgebra::{Matrix3, Vector3};
use rayon::prelude::*;
use robot::{Inertia, Robot};

use crate::trials::{changed, loaded};
use crate::world::{World, finding, named, sign};

const SEEDS: std::ops::Range<u64> = 40..46;

const FEW_SEEDS: std::ops::Range<u64> = 40..43;

/// Friction that is named, and a torque for which there is no name.
fn worn() -> World {
    World::nominal()
        .torque(1, |[_, qd, _]| 1.5 * sign(qd))
        .torque(3, |[q, qd, _]| 0.4 * (3.0 * q).sin() * (2.0 * qd).tanh() + 0.3 * qd * qd.abs())
}

fn compared(before: &World, after: &World, seed: u64) -> Comparison {
    let (before, after) = (before.log(seed), after.log(1000 + seed));
    compare(&wam(), [&before, &after], &Settings::default(), &Silent).unwrap()
}

#[test]
fn between_logs_of_the_same_arm_nothing_has_changed() {
    let all: Vec<Vec<String>> = SEEDS
        .into_par_iter()
        .map(|seed| named(&compared(&worn(), &worn(), seed).after.diagnosis))
        .collect();
    println!("{all:?}");
    let wrong = all.iter().filter(|names| !names.is_empty()).count();
    assert!(wrong <= 1, "{all:?}");
}

#[test]
fn what_was_put_on_and_what_wore_is_what_changed() {
    let after = worn().body(loaded).torque(1, |[_, qd, _]| 1.0 * sign(qd));
    SEEDS.into_par_iter().for_each(|seed| {
        let answer = compared(&worn(), &after, seed);
        let names = named(&answer.after.diagnosis);
        println!("{names:?}");
        let friction =
            finding(&answer.after.diagnosis, "FR02 Coulomb friction at j2_shoulder_pitch");
        let level = &friction.unwrap_or_else(|| panic!("{names:?}")).parameters[0];
        assert!((level.nominal - 1.5).abs() < 0.1 && (level.value - 2.5).abs() < 0.1, "{level:?}");
        let load = finding(&answer.after.diagnosis, "IN01 payload at palm");
        let mass = &load.unwrap_or_else(|| panic!("{names:?}")).parameters[0];
        assert!((mass.value - mass.nominal - 1.0).abs() < 0.05, "{mass:?}");
        assert!(names.len() <= 3, "{names:?}");
    });
}

#[test]
fn a_run_is_not_compared_with_itself() {
    let log = World::nominal().log(1);
    let answer = compare(&wam(), [&log, &log[..1]], &Settings::default(), &Silent);
    let expected = DiagnosisError::InBoth { run: log[0].name.clone() };
    assert_eq!(answer.map(|_| ()), Err(expected));
}

/// Dry friction that grows by a quarter, on an arm of which a coarse velocity puts a fifth of the samples near rest: there
/// friction may have any value up to its level, but not while the joint slides.
#[test]
fn a_growth_of_friction_by_a_quarter_is_named() {
    let before = World::nominal().torque(1, |[_, qd, _]| 2.0 * sign(qd));
    let after = World::nominal().torque(1, |[_, qd, _]| 2.5 * sign(qd));
    let noise = Noise { velocity: 0.03, ..Noise::of_a_wam() };
    let wrong: Vec<String> = SEEDS
        .into_par_iter()
        .filter_map(|seed| {
            let log = |world: &World, seed| world.paced(&[0.4; 3], 20.0, &noise, seed);
            let logs = [log(&before, seed), log(&after, 1000 + seed)];
            let logs = logs.each_ref().map(Vec::as_slice);
            let answer = compare(&wam(), logs, &Settings::default(), &Silent).unwrap();
            let diagnosis = &answer.after.diagnosis;
            let found = finding(diagnosis, "FR02 Coulomb friction at j2_shoulder_pitch");
            let is_right = found.is_some_and(|found| {
                let level = &found.parameters[0];
                (level.nominal - 2.0).abs() < 0.1 && (level.value - 2.5).abs() < 0.1
            });
            (!is_right || named(diagnosis).len() > 1).then(|| format!("{:?}", named(diagnosis)))
        })
        .collect();
    assert!(wrong.is_empty(), "{wrong:?}");
}

/// Torques without a name at five joints, which a torque constant, friction or a body takes part of, and another part in
/// another motion.
fn poorly_described() -> World {
    World::nominal()
        .torque(0, |[q, qd, _]| 0.8 * (2.0 * q).cos() * qd + 0.5 * (3.0 * qd).tanh())
        .torque(1, |[q, qd, qdd]| 1.2 * (2.0 * q).sin() + 0.6 * qd * qd.abs() + 0.1 * qdd * q)
        .torque(2, |[q, qd, _]| 0.5 * (2.0 * q).sin() * (2.0 * qd).tanh())
        .torque(3, |[q, qd, _]| 0.6 * (3.0 * q).sin() + 0.3 * qd * qd.abs())
        .torque(5, |[q, qd, _]| 0.1 * (2.0 * q).cos() + 0.05 * (4.0 * qd).tanh())
}

fn light(robot: Robot) -> Robot {
    changed(robot, "palm", |i| {
        i.with_body(&Inertia {
            mass: 0.3,
            com_in_link: 0.1 * Vector3::z(),
            about_com: Matrix3::identity() * 1e-4,
        })
    })
}

/// Slow motions before and fast ones after.
fn at_two_paces(before: &World, after: &World, seed: u64) -> Comparison {
    let noise = Noise::of_a_wam();
    let before = before.paced(&[0.3, 0.4, 0.5], 20.0, &noise, seed);
    let after = after.paced(&[0.5, 0.7, 0.9], 20.0, &noise, 1000 + seed);
    compare(&wam(), [&before, &after], &Settings::default(), &Silent).unwrap()
}

#[test]
fn what_both_logs_have_without_a_name_is_no_change() {
    let changed: Vec<Vec<String>> = FEW_SEEDS
        .into_par_iter()
        .map(|seed| {
            let answer = at_two_paces(&poorly_described(), &poorly_described(), seed);
            named(&answer.after.diagnosis)
        })
        .collect();
    assert!(changed.iter().all(Vec::is_empty), "{changed:?}");
}

/// The torques without a name are half of what the load adds at the shoulder and other ones at another pace: its mass is
/// known to a half.
#[test]
fn a_light_load_is_named_though_the_arm_is_poorly_described() {
    let after = poorly_described().body(light);
    let wrong: Vec<String> = FEW_SEEDS
        .into_par_iter()
        .filter_map(|seed| {
            let answer = at_two_paces(&poorly_described(), &after, seed);
            let diagnosis = &answer.after.diagnosis;
            let mass = finding(diagnosis, "IN01 payload at palm").map(|found| &found.parameters[0]);
            let load = mass.map(|mass| mass.value - mass.nominal);
            let is_right = load.is_some_and(|load| (0.15..0.45).contains(&load));
            (!is_right || named(diagnosis).len() > 1)
                .then(|| format!("{:?} {load:?}", named(diagnosis)))
        })
        .collect();
    assert!(wrong.is_empty(), "{wrong:?}");
}
