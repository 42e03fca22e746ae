//! A crate depends only on lower floors. What only its tests need is free of that.

use crate::assert_kept;
use crate::workspace::{Package, crates};

fn broken(crates: &[Package]) -> Vec<String> {
    crates.iter().flat_map(|package| broken_by(package, crates)).collect()
}

fn broken_by(package: &Package, crates: &[Package]) -> Vec<String> {
    let name = &package.name;
    let Some(floor) = package.floor() else {
        return vec![format!("{name} has no level in [package.metadata.floor]")];
    };
    let below = |need: &str| {
        let other = crates.iter().find(|p| p.name == need)?;
        let level = other.floor().filter(|&level| level >= floor)?;
        Some(format!("{name} on floor {floor} depends on {need} on floor {level}"))
    };
    package.needs().filter_map(below).collect()
}

#[test]
fn crates_depend_only_on_lower_floors() {
    assert_kept(&broken(&crates()));
}

#[test]
fn a_crate_on_the_same_or_a_higher_floor_is_reported() {
    let made_up = [
        Package::made_up("ground", 0, &["serde"]),
        Package::made_up("beside", 0, &["ground"]),
        Package::made_up("middle", 1, &["ground", "roof"]),
        Package::made_up("roof", 2, &["middle", "beside"]),
    ];
    let expected = [
        "beside on floor 0 depends on ground on floor 0",
        "middle on floor 1 depends on roof on floor 2",
    ];
    assert_eq!(broken(&made_up), expected);
}

#[test]
fn a_crate_without_a_floor_is_reported() {
    let json =
        r#"{"name": "loose", "dependencies": [], "manifest_path": "crates/loose/Cargo.toml"}"#;
    let loose: Package = serde_json::from_str(json).unwrap();
    assert_eq!(broken(&[loose]), ["loose has no level in [package.metadata.floor]"]);
}

#[test]
fn what_only_tests_need_may_stand_higher() {
    let mut low = Package::made_up("low", 0, &["high"]);
    let high = || Package::made_up("high", 1, &[]);
    low.dependencies[0].kind = Some("dev".to_owned());
    assert_kept(&broken(&[low, high()]));
    let mut low = Package::made_up("low", 0, &["high"]);
    low.dependencies[0].kind = Some("build".to_owned());
    assert_eq!(broken(&[low, high()]).len(), 1);
}
