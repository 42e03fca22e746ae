use std::path::PathBuf;

use robot::Robot;

use super::in_workspace;

/// The folder with the public recordings, where there is one.
fn data() -> PathBuf {
    let named = std::env::var_os("PLUMBLINE_DATA").map(PathBuf::from);
    named.unwrap_or_else(|| in_workspace("../shared/data"))
}

#[test]
fn recorded_urdfs_of_other_arms_load() {
    for (folder, joints, base, mass) in [
        ("kuka_lwr4", 7, "box", 14.4),
        ("kinova_gen3", 7, "world", 5.4772),
        ("staubli_tx40", 6, "base_link", 23.01),
    ] {
        let path = data().join(folder).join("robot.urdf");
        if !path.exists() {
            println!("skipped: {} is not there", path.display());
            continue;
        }
        let loaded = Robot::load(&path).unwrap();
        assert_eq!(loaded.robot.joint_count(), joints, "{folder}");
        assert_eq!(loaded.base_link, base, "{folder}");
        let found: f64 = loaded.robot.links().iter().map(|l| l.inertia.mass).sum();
        assert!((found - mass).abs() < 1e-9, "{folder}: moving mass {found} kg, not {mass}");
        println!("{folder}: {} warnings", loaded.warnings.len());
        loaded.warnings.iter().for_each(|w| println!("  {w}"));
    }
}
