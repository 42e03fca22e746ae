//! Large dependencies have one place each.

use crate::assert_kept;
use crate::workspace::{Package, crates};

/// How the name of a dependency starts, and the crates that may use it.
const PLACES: [(&str, &[&str]); 6] = [
    ("rapier", &["simulator"]),
    ("rerun", &["recording"]),
    ("clap", &["plumbline", "plumbline-bench"]),
    ("pyo3", &["python"]),
    ("numpy", &["python"]),
    ("faer", &["benchmark", "dynamics", "effects", "gaussian_process", "learner", "population"]),
];

fn broken(crates: &[Package]) -> Vec<String> {
    let mut broken = Vec::new();
    for package in crates {
        let outside = |need: &str| {
            let stray = |(start, homes): &&(&str, &[&str])| {
                need.starts_with(start) && !homes.contains(&package.name.as_str())
            };
            let (_, homes) = PLACES.iter().find(stray)?;
            let homes = homes.join(", ");
            Some(format!("{} depends on {need}, which has its place in {homes}", package.name))
        };
        broken.extend(package.dependencies.iter().filter_map(|d| outside(&d.name)));
    }
    broken
}

#[test]
fn large_dependencies_stay_in_their_place() {
    assert_kept(&broken(&crates()));
}

#[test]
fn a_large_dependency_out_of_place_is_reported() {
    let made_up = [
        Package::made_up("simulator", 2, &["rapier3d-f64", "nalgebra"]),
        Package::made_up("learner", 3, &["faer"]),
        Package::made_up("plumbline", 7, &["clap", "rapier3d-f64"]),
        Package::made_up("report", 6, &["clap", "faer", "rerun"]),
    ];
    let expected = [
        "plumbline depends on rapier3d-f64, which has its place in simulator",
        "report depends on clap, which has its place in plumbline, plumbline-bench",
        "report depends on faer, which has its place in benchmark, dynamics, effects, gaussian_process, learner, population",
        "report depends on rerun, which has its place in recording",
    ];
    assert_eq!(broken(&made_up), expected);
}
