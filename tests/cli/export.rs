use crate::arm::{self, Gap};
use crate::program::run;

#[test]
fn a_robot_is_written_in_every_format_with_what_each_leaves_out() {
    let folder = arm::folder(Gap::None);
    let toml = "urdf = \"arm.urdf\"\n[joint.elbow]\ncoulomb_nm = 0.8\nrotor_inertia_kg_m2 = 0.01\n";
    std::fs::create_dir(folder.path().join("out")).unwrap();
    std::fs::copy(folder.path().join("arm.urdf"), folder.path().join("out/arm.urdf")).unwrap();
    std::fs::write(folder.path().join("out/extended.toml"), toml).unwrap();
    let answer = run(folder.path(), &["export", "out"]);
    assert_eq!((answer.code, answer.err.as_str()), (0, ""), "{answer:?}");
    for expected in [
        "extended.urdf: 1 exact, 0 approximated, 1 dropped",
        "extended.xml: 2 exact",
        "extended.sdf: ",
        "extended.usda: 2 exact, 0 approximated, 0 dropped",
    ] {
        assert!(answer.out.contains(expected), "{expected} is missing in\n{}", answer.out);
    }
    let check = run(folder.path(), &["robot", "check", "out/extended.urdf", "--json"]);
    assert!(check.out.contains("\"coulomb_forward\": 0.8"), "{}", check.out);
    let json = run(folder.path(), &["export", "out", "--to", "mjcf", "--out", "models", "--json"]);
    assert!(json.out.contains("\"schema\": \"plumbline.export/1\""), "{}", json.out);
    assert!(json.out.contains("\"fate\": \"exact\""), "{}", json.out);
    assert!(folder.path().join("models/extended.xml").exists());
    assert!(!folder.path().join("models/extended.urdf").exists());
}

#[test]
fn what_cannot_be_exported_is_told() {
    let folder = arm::folder(Gap::None);
    std::fs::create_dir(folder.path().join("empty")).unwrap();
    let answer = run(folder.path(), &["export", "empty"]);
    assert_eq!(answer.code, 3);
    assert!(answer.err.contains("empty: an extended.toml was expected"), "{}", answer.err);
    std::fs::rename(folder.path().join("arm.urdf"), folder.path().join("extended.urdf")).unwrap();
    let answer = run(folder.path(), &["export", "extended.urdf", "--to", "urdf"]);
    assert_eq!(answer.code, 2);
    assert!(answer.err.contains("extended.urdf: it is read and would be"), "{}", answer.err);
}

/// The torque errors on the whole robot that `export` tells, by the name of the model (N·m).
fn errors(folder: &std::path::Path, arguments: &[&str]) -> std::collections::BTreeMap<String, f64> {
    let answer = run(folder, arguments);
    assert_eq!(answer.code, 0, "{}", answer.err);
    let told: serde_json::Value = serde_json::from_str(&answer.out).unwrap();
    let models = told["loss"]["models"].as_array().unwrap().iter();
    models
        .map(|m| (m["model"].as_str().unwrap().to_owned(), m["all_nm"].as_f64().unwrap()))
        .collect()
}

#[test]
fn what_was_found_is_in_the_torque_of_what_a_file_holds() {
    let folder = arm::folder(Gap::Friction(0.8));
    let diagnose =
        ["diagnose", "--robot", "arm.urdf", "--log", "run_0.csv", "run_1.csv", "--out", "out"];
    assert_eq!(run(folder.path(), &diagnose).code, 0);
    let export = ["export", "out", "--to", "urdf,mjcf", "--log", "run_2.csv"];
    let text = run(folder.path(), &export).out;
    assert!(text.contains("nominal is arm.urdf\n"), "{text}");
    assert!(text.contains("joint     nominal  extended    urdf    mjcf"), "{text}");
    let errors = errors(folder.path(), &[&export[..], &["--json"]].concat());
    assert!(errors["nominal"] > 10.0 * errors["extended"], "{errors:?}");
    for name in ["urdf", "mjcf"] {
        assert!((errors[name] - errors["extended"]).abs() < 1e-9, "{errors:?}");
    }
}

/// `diagnosis.json` says what stands in `extended.toml` without a name.
#[test]
fn an_export_tells_what_has_no_name() {
    let folder = arm::folder(Gap::None);
    let out = folder.path().join("out");
    std::fs::create_dir(&out).unwrap();
    std::fs::copy(folder.path().join("arm.urdf"), out.join("arm.urdf")).unwrap();
    let toml = "urdf = \"arm.urdf\"\n[joint.elbow]\ncoulomb_nm = 0.8\nrotor_inertia_kg_m2 = 0.01\n";
    std::fs::write(out.join("extended.toml"), toml).unwrap();
    let diagnosis = r#"{"provenance": {"files": []}, "also_fitted": {"parameters": [
        {"code": "IN03", "effect": "rotor_inertia", "joint": "elbow", "name": "inertia", "value": 0.01}]},
        "negligible": [{"code": "FR01", "effect": "viscous_friction", "joint": "elbow", "most_at": "elbow"}]}"#;
    std::fs::write(out.join("diagnosis.json"), diagnosis).unwrap();
    let answer = run(folder.path(), &["export", "out", "--to", "mjcf"]);
    let expected = "Fitted without a name, and in the files above: IN03 rotor inertia at elbow.";
    assert!(answer.out.contains(expected), "{}", answer.out);
    let expected = "Seen and negligible, and in the files above: FR01 viscous friction at elbow.";
    assert!(answer.out.contains(expected), "{}", answer.out);
    std::fs::remove_file(out.join("diagnosis.json")).unwrap();
    let answer = run(folder.path(), &["export", "out", "--to", "mjcf"]);
    assert!(!answer.out.contains("without a name"), "{}", answer.out);
}

/// No format has a place for torque that ripples with the position.
#[test]
fn what_a_file_drops_is_not_in_its_torque() {
    let folder = arm::folder(Gap::Ripple(0.5));
    let toml = "urdf = \"arm.urdf\"\n[joint.elbow]\ntorque_ripple = { amplitude_nm = 0.5, periods_per_turn = 9.0, phase_rad = 0.0 }\n";
    std::fs::write(folder.path().join("extended.toml"), toml).unwrap();
    let export = ["export", "extended.toml", "--to", "mjcf,isaac", "--log", "run_2.csv"];
    let told = run(folder.path(), &export).err;
    assert!(
        told.contains("nominal is what arm.urdf says alone; --nominal names another"),
        "{told}"
    );
    let errors =
        errors(folder.path(), &[&export[..], &["--json", "--nominal", "arm.urdf"]].concat());
    assert!(errors["nominal"] > 3.0 * errors["extended"], "{errors:?}");
    for name in ["mjcf", "isaac"] {
        assert!((errors[name] - errors["nominal"]).abs() < 1e-9, "{errors:?}");
    }
}

#[test]
fn a_nominal_robot_of_other_joints_is_told() {
    let folder = arm::folder(Gap::None);
    let other = arm::URDF.replace("\"elbow\"", "\"knee\"");
    std::fs::write(folder.path().join("other.urdf"), other).unwrap();
    let export = ["export", "arm.urdf", "--to", "mjcf", "--log", "run_2.csv"];
    let answer = run(folder.path(), &[&export[..], &["--nominal", "other.urdf"]].concat());
    assert_eq!(answer.code, 3);
    assert!(
        answer.err.contains("other.urdf: its joints are not those of arm.urdf"),
        "{}",
        answer.err
    );
    let lonely = run(folder.path(), &["export", "arm.urdf", "--nominal", "arm.urdf"]);
    assert_eq!(lonely.code, 2, "a nominal robot without logs: {}", lonely.err);
}

const SERVOS: &str = "urdf = \"arm.urdf\"\neffort_source = { position_loop = { kp_nm_per_rad = [90.0, 40.0], kd_nm_s_per_rad = [6.0, 2.0], goal_hold_hz = 50.0 } }\n[joint.shoulder]\ngoal_delay_ms = 30.0\n[joint.elbow]\ngoal_delay_ms = 30.0\ncoulomb_nm = 0.8\nbacklash_rad = 0.01\n";

#[test]
fn servos_are_written_for_simulators_with_what_each_leaves_out() {
    let folder = arm::folder(Gap::None);
    arm::write(folder.path(), "servo.toml", SERVOS);
    let answer = run(folder.path(), &["export", "servo.toml", "--to", "actuator", "--out", "card"]);
    assert_eq!((answer.code, answer.err.as_str()), (0, ""), "{answer:?}");
    for expected in [
        "card/extended_actuator.xml: ",
        "card/extended_actuator.py: ",
        "card/extended_actuator.json: ",
        "position loop 90 N·m/rad, 6 N·m·s/rad",
        "6 of 5 ms are 30 ms, 0 ms off",
        "gearboxes of BAM are rigid and without play",
    ] {
        assert!(answer.out.contains(expected), "{expected} is missing in\n{}", answer.out);
    }
    assert_eq!(std::fs::read_dir(folder.path().join("card")).unwrap().count(), 3);
    let all = run(folder.path(), &["export", "servo.toml", "--out", "all"]);
    assert_eq!(all.code, 0, "{}", all.err);
    assert_eq!(std::fs::read_dir(folder.path().join("all")).unwrap().count(), 7);
    let text = std::fs::read_to_string(folder.path().join("all/extended.xml")).unwrap();
    assert!(text.contains("kp=\"90\" kv=\"6\" forcerange=\"-80 80\" delay=\"0.03\""), "{text}");
}

/// Loops without damping are no law of BAM: there is a reason and no file.
#[test]
fn an_arm_without_servos_or_laws_is_told() {
    let folder = arm::folder(Gap::None);
    let export = ["export", "arm.urdf", "--to", "mjcf,actuator", "--out", "card"];
    let answer = run(folder.path(), &export);
    assert_eq!(answer.code, 3, "{}", answer.err);
    assert!(answer.err.contains("no joint of arm has a position loop"), "{}", answer.err);
    assert!(!folder.path().join("card").exists(), "nothing is written before all is there");
    arm::write(folder.path(), "servo.toml", &SERVOS.replace("[6.0, 2.0]", "[0.0, 0.0]"));
    let answer = run(folder.path(), &["export", "servo.toml", "--to", "actuator", "--out", "card"]);
    assert!(answer.out.contains("actuator_bam, no file: "), "{}", answer.out);
    assert_eq!(std::fs::read_dir(folder.path().join("card")).unwrap().count(), 2);
}
