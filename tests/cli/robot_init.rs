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

/// Both commands tell programs what they wrote, in the folders that no option names.
#[test]
fn what_was_guessed_and_simulated_is_told_for_programs() {
    let folder = arm::folder(Gap::None);
    let told = |arguments: &[&str]| -> serde_json::Value {
        let answer = run(folder.path(), arguments);
        assert_eq!(answer.code, 0, "{arguments:?}: {}", answer.err);
        serde_json::from_str(&answer.out).unwrap()
    };
    let begun = told(&["robot", "init", "arm.urdf", "--json"]);
    assert_eq!(begun["robot"], "out/robot/robot.toml");
    let toml = std::fs::read_to_string(folder.path().join("out/robot/robot.toml")).unwrap();
    let joints = begun["joints"].as_array().unwrap();
    assert_eq!(joints.len(), 2);
    for joint in joints {
        assert!(toml.contains(&format!("[joint.{}]", joint["name"].as_str().unwrap())), "{joint}");
        assert!(joint["kp_nm_per_rad"].as_f64().unwrap() > 0.0, "{joint}");
    }
    let made = told(&["simulate", begun["scenario"].as_str().unwrap(), "--json"]);
    assert_eq!(made["schema"], "plumbline.simulation/1");
    let runs = made["runs"].as_array().unwrap();
    assert_eq!(runs.len(), 3);
    for run in runs {
        assert!(folder.path().join(run["log"].as_str().unwrap()).is_file(), "{run}");
        assert!(run["rows"].as_u64().unwrap() > 1000, "{run}");
    }
    // Ideal sensors: of the noise nothing is known, and no number says so.
    let mut diagnose =
        vec!["diagnose", "--robot", "out/robot/robot.toml", "--no-recording", "--log"];
    diagnose.extend(runs.iter().map(|run| run["log"].as_str().unwrap()));
    let answer = run(folder.path(), &diagnose);
    assert!(answer.out.contains("RMS, noise -\n"), "{}{}", answer.out, answer.err);
    assert!(!answer.out.contains("noise 0"), "{}", answer.out);
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

#[test]
fn a_mistake_in_a_robot_toml_is_underlined() {
    let folder = arm::folder(Gap::None);
    for (toml, told) in [
        (
            "urdf = \"arm.urdf\"\n[joint.elbow]\nviscous = 1\n",
            "error: unknown key `viscous`, did you mean `viscous_nm_s_per_rad`?\n \
             --> robot.toml:3:1\n  |\n3 | viscous = 1\n  | ^^^^^^^ joint.elbow.viscous\n  |\n  = help: expected ",
        ),
        (
            "urdf = \"arm.urdf\"\n[joint.elbow]\ncoulomb_nm = 1\nactuator_delay_ms = -2\n",
            "error: actuator_delay_ms is -2, a finite number not below 0 was expected\n \
             --> robot.toml:4:21\n  |\n4 | actuator_delay_ms = -2\n  |                     ^^ joint.elbow.actuator_delay_ms\n",
        ),
        (
            "urdf = \"arm.urdf\"\ndifferentials = [[\"shoulder\", \"elbwo\"]]\n",
            "error: unknown joint `elbwo`, did you mean `elbow`?\n \
             --> robot.toml:2:31\n  |\n2 | differentials = [[\"shoulder\", \"elbwo\"]]\n  \
             |                               ^^^^^^^ differentials.0.1\n  |\n  = help: expected `shoulder` or `elbow`\n",
        ),
        (
            "urdf = \"amr.urdf\"\n",
            "error: amr.urdf: there is no such file, a URDF or a robot.toml was expected\n \
             --> robot.toml:1:8\n  |\n1 | urdf = \"amr.urdf\"\n  |        ^^^^^^^^^^ urdf\n",
        ),
    ] {
        arm::write(folder.path(), "robot.toml", toml);
        let answer = run(folder.path(), &["robot", "check", "robot.toml"]);
        assert_eq!(answer.code, 3, "{answer:?}");
        assert!(answer.err.starts_with(told), "{}\ninstead of\n{told}", answer.err);
    }
}
