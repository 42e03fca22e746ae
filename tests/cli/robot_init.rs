use std::path::Path;

use crate::arm::{self, Gap};
use crate::program::{Answer, run};

/// The arm with friction, described anew.
fn described(folder: &Path) -> Answer {
    run(folder, &["robot", "init", "arm.urdf", "--out", "robots/mine"])
}

#[test]
fn a_described_arm_can_be_simulated_without_a_key_written_by_hand() {
    let folder = arm::folder(Gap::None);
    let answer = described(folder.path());
    assert_eq!((answer.code, answer.err.as_str()), (0, ""), "{answer:?}");
    let toml = std::fs::read_to_string(folder.path().join("robots/mine/robot.toml")).unwrap();
    for expected in [
        "urdf = \"../../arm.urdf\"",
        "rotor_inertia_kg_m2 = ",
        "kp_nm_per_rad = ",
        "a guess from effort limit and inertia",
        "sensing = \"unknown\"",
        "[joint.elbow]",
    ] {
        assert!(toml.contains(expected), "{expected} is missing in\n{toml}");
    }
    let logs = run(folder.path(), &["simulate", "robots/mine/scenario.toml", "--out", "out"]);
    assert_eq!(logs.code, 0, "{logs:?}");
    let log = ["log", "info", "out/run_1.parquet", "--robot", "robots/mine/robot.toml", "--json"];
    let info = run(folder.path(), &log);
    assert!(info.out.contains("\"moves\": true"), "{}", info.out);
    assert!(!info.out.contains("\"moves\": false"), "{}", info.out);
}

#[test]
fn a_description_that_is_there_stays() {
    let folder = arm::folder(Gap::None);
    assert_eq!(described(folder.path()).code, 0);
    let file = folder.path().join("robots/mine/robot.toml");
    std::fs::write(&file, "mine").unwrap();
    let again = described(folder.path());
    assert_eq!(again.code, 2);
    assert!(again.err.contains("it is there already"), "{}", again.err);
    assert_eq!(std::fs::read_to_string(&file).unwrap(), "mine");
    let force = ["robot", "init", "arm.urdf", "--out", "robots/mine", "--force"];
    assert_eq!(run(folder.path(), &force).code, 0);
    assert_ne!(std::fs::read_to_string(&file).unwrap(), "mine");
}

#[test]
fn a_part_of_a_robot_is_described() {
    let folder = arm::folder(Gap::None);
    let arguments = ["robot", "init", "arm.urdf", "--joints", "shoulder", "--out", "part"];
    let answer = run(folder.path(), &arguments);
    assert_eq!(answer.code, 0, "{answer:?}");
    let toml = std::fs::read_to_string(folder.path().join("part/robot.toml")).unwrap();
    assert!(toml.contains("joints = [\"shoulder\"]"), "{toml}");
    assert!(!toml.contains("[joint.elbow]"), "{toml}");
}
