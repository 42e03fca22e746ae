//! Two walls: what computes motion and what computes torque never see each other, so that
//! neither can be tuned to the other. Not through a third crate and not in tests either.

use crate::assert_kept;
use crate::workspace::{Package, packages, reach};

/// Crates of the one side and what they must not reach.
const WALLS: [(&[&str], &[&str]); 2] = [
    (&["simulator", "population"], &["dynamics", "effects", "learner", "diagnosis"]),
    (&["dynamics", "effects", "learner", "next_motion", "tracking", "diagnosis"], &["simulator"]),
];

fn broken(crates: &[Package]) -> Vec<String> {
    let mut broken = Vec::new();
    for (side, other) in WALLS {
        for name in side {
            let reached = reach(crates, name);
            let across = other.iter().filter(|o| reached.contains(**o));
            broken.extend(across.map(|o| format!("{name} reaches {o} through the wall")));
        }
    }
    broken
}

#[test]
fn simulator_and_models_never_see_each_other() {
    assert_kept(&broken(&packages()));
}

#[test]
fn a_simulator_that_sees_a_model_is_reported() {
    let made_up = [
        Package::made_up("dynamics", 1, &[]),
        Package::made_up("between", 2, &["dynamics"]),
        Package::made_up("simulator", 3, &["between"]),
    ];
    assert_eq!(broken(&made_up), ["simulator reaches dynamics through the wall"]);
}

#[test]
fn a_model_that_sees_the_simulator_is_reported_even_in_its_tests() {
    for model in ["dynamics", "effects", "learner", "next_motion", "tracking", "diagnosis"] {
        let mut package = Package::made_up(model, 4, &["simulator"]);
        package.dependencies[0].kind = Some("dev".to_owned());
        let made_up = [Package::made_up("simulator", 2, &[]), package];
        assert_eq!(broken(&made_up), [format!("{model} reaches simulator through the wall")]);
    }
}

#[test]
fn a_model_whose_tests_see_the_simulator_through_those_of_all_is_reported() {
    let mut diagnosis = Package::made_up("diagnosis", 4, &["checks"]);
    diagnosis.dependencies[0].kind = Some("dev".to_owned());
    let made_up = [
        Package::made_up("simulator", 3, &[]),
        Package::made_up("checks", 9, &["simulator"]),
        diagnosis,
    ];
    assert_eq!(broken(&made_up), ["diagnosis reaches simulator through the wall"]);
}

#[test]
fn experiment_may_see_both_sides() {
    let made_up = [
        Package::made_up("dynamics", 1, &[]),
        Package::made_up("simulator", 2, &[]),
        Package::made_up("experiment", 5, &["dynamics", "simulator"]),
    ];
    assert_kept(&broken(&made_up));
}
