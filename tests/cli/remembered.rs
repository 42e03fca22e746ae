//! What a diagnosis keeps of its command line, so that it is not said again.

use std::fs;
use std::path::Path;

use serde_json::Value;

use crate::arm::{self, Gap};
use crate::files::{json, names};
use crate::program::{Answer, run};

/// The arm with a wrist that no log knows, and its logs with efforts and positions under other names.
fn folder() -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path();
    for name in ["robots", "logs", "elsewhere"] {
        fs::create_dir(path.join(name)).unwrap();
    }
    let wrist = "  <link name=\"hand\"><inertial><origin xyz=\"0.01 0 0\"/><mass value=\"0.001\"/>\n\
        <inertia ixx=\"1e-6\" iyy=\"1e-6\" izz=\"1e-6\" ixy=\"0\" ixz=\"0\" iyz=\"0\"/></inertial></link>\n\
        <joint name=\"wrist\" type=\"revolute\"><parent link=\"fore\"/><child link=\"hand\"/>\n\
        <origin xyz=\"0.3 0 0\"/><axis xyz=\"0 -1 0\"/>\n\
        <limit lower=\"-2\" upper=\"2\" effort=\"5\" velocity=\"6\"/></joint>\n</robot>";
    arm::write(path, "robots/arm.urdf", &arm::URDF.replace("</robot>", wrist));
    for k in 0..3 {
        let log = arm::log(k, Gap::Friction(1.5)).replacen(".effort", ".torque", 2);
        let log = log.replacen(".position", ".angle", 2);
        arm::write(path, &format!("logs/run_{k}.csv"), &log);
    }
    let map = "position = \"{joint}.angle\"\nvelocity = \"{joint}.velocity\"\n\
        effort = \"{joint}.torque\"\n";
    arm::write(path, "logs/map.toml", map);
    folder
}

fn good(folder: &Path, arguments: &[&str]) -> Answer {
    let answer = run(folder, arguments);
    assert_eq!(answer.code, 0, "{arguments:?}: {}{}", answer.out, answer.err);
    answer
}

/// Diagnoses two of the runs of two of the joints.
fn diagnosed() -> tempfile::TempDir {
    let folder = folder();
    let arguments = [
        "diagnose",
        "--robot",
        "robots/arm.urdf",
        "--joints",
        "shoulder,elbow",
        "--map",
        "logs/map.toml",
        "--log",
        "logs/run_0.csv",
        "logs/run_1.csv",
        "--no-recording",
        "--quiet",
    ];
    good(folder.path(), &arguments);
    folder
}

#[test]
fn a_diagnosis_names_its_files_from_its_folder_and_how_they_were_read() {
    let folder = diagnosed();
    let said = json(&folder.path().join("out/diagnose/diagnosis.json"));
    let files = said["provenance"]["files"].as_array().unwrap();
    let paths: Vec<&str> = files.iter().map(|file| file["path"].as_str().unwrap()).collect();
    let expected = ["robots/arm.urdf", "logs/map.toml", "logs/run_0.csv", "logs/run_1.csv"];
    assert_eq!(paths, expected.map(|path| format!("../../{path}")));
    assert_eq!(said["input"]["joints"], serde_json::json!(["shoulder", "elbow"]));
    assert_eq!(said["input"]["until_damage"], false);
    let page = fs::read_to_string(folder.path().join("out/diagnose/report.html")).unwrap();
    assert!(!page.contains("../../"), "a page that is passed on names no folders");
}

#[test]
fn export_measures_another_log_without_an_option_said_again() {
    let folder = diagnosed();
    for (at, export) in [
        ("", ["export", "out/diagnose", "--to", "mjcf", "--log", "logs/run_2.csv", "--json"]),
        (
            "elsewhere",
            ["export", "../out/diagnose", "--to", "mjcf", "--log", "../logs/run_2.csv", "--json"],
        ),
    ] {
        let answer = good(&folder.path().join(at), &export);
        assert_eq!(answer.err, "", "{at}");
        let told: Value = serde_json::from_str(&answer.out).unwrap();
        assert_eq!(told["loss"]["joints"], serde_json::json!(["shoulder", "elbow"]));
        let models = told["loss"]["models"].as_array().unwrap();
        let error = |name: &str| {
            let model = models.iter().find(|model| model["model"] == name).unwrap();
            model["all_nm"].as_f64().unwrap()
        };
        assert!(error("nominal") > 5.0 * error("extended"), "{models:?}");
    }
}

#[test]
fn design_and_replay_need_the_diagnosis_alone_wherever_one_stands() {
    let folder = diagnosed();
    let pair = ["--separate", "FR01@elbow", "--from", "FR02@elbow", "--duration-s", "5"];
    let design = ["design", "--diagnosis", "../out/diagnose", "--json"];
    let answer = run(&folder.path().join("elsewhere"), &[&design[..], &pair].concat());
    assert!(answer.code <= 1 && answer.err.is_empty(), "{}{}", answer.out, answer.err);
    let told: Value = serde_json::from_str(&answer.out).unwrap();
    assert_eq!(told["schema"], "plumbline.design/1");
    let goal = &told["goals"][0];
    assert!(goal["goal"].as_str().unwrap().contains("FR01 viscous friction at elbow"), "{told}");
    assert!(goal["logs_nats"].as_f64().unwrap() > 0.0, "the logs were read: {told}");

    let replay = ["replay", "--diagnosis", "../out/diagnose", "--window-ms", "50", "--json"];
    let answer = good(&folder.path().join("elsewhere"), &replay);
    let told: Value = serde_json::from_str(&answer.out).unwrap();
    let runs: Vec<&str> =
        told["runs"].as_array().unwrap().iter().map(|run| run["name"].as_str().unwrap()).collect();
    assert_eq!(runs, ["run_0", "run_1"]);
    assert!(folder.path().join("elsewhere/out/replay/report.html").is_file());
}

#[test]
fn a_log_that_is_gone_is_told_with_the_option_that_names_it() {
    let folder = diagnosed();
    fs::rename(folder.path().join("logs/run_1.csv"), folder.path().join("moved.csv")).unwrap();
    let replay = ["replay", "--diagnosis", "out/diagnose", "--window-ms", "50"];
    let answer = run(folder.path(), &replay);
    assert_eq!(answer.code, 3, "{}", answer.err);
    let expected =
        "run_1.csv: out/diagnose/diagnosis.json was made from it and it is not there; --log names";
    assert!(answer.err.contains(expected), "{}", answer.err);
    good(folder.path(), &[&replay[..], &["--log", "moved.csv", "--quiet"]].concat());
    let none = run(folder.path(), &["design", "--separate", "FR01@elbow", "--from", "FR02@elbow"]);
    assert_eq!(none.code, 2);
    assert!(none.err.contains("a robot was expected, as --robot FILE or as"), "{}", none.err);
}

#[test]
fn a_robot_that_changed_since_is_told() {
    let folder = diagnosed();
    let urdf = folder.path().join("robots/arm.urdf");
    let text = fs::read_to_string(&urdf).unwrap().replace("mass value=\"2\"", "mass value=\"2.1\"");
    fs::write(urdf, text).unwrap();
    let pair = ["--separate", "FR01@elbow", "--from", "FR02@elbow", "--duration-s", "5"];
    let design = ["design", "--diagnosis", "out/diagnose", "--quiet"];
    let answer = run(folder.path(), &[&design[..], &pair].concat());
    assert!(answer.err.contains("robots/arm.urdf: it has changed since"), "{}", answer.err);
}

/// A folder that is moved together with what it names is read as before.
#[test]
fn a_folder_that_moved_with_its_logs_is_read() {
    let folder = diagnosed();
    let moved = tempfile::tempdir().unwrap();
    for name in names(folder.path()) {
        fs::rename(folder.path().join(&name), moved.path().join(&name)).unwrap();
    }
    let at = moved.path().join("out/diagnose");
    good(&at, &["replay", "--diagnosis", ".", "--window-ms", "50", "--quiet"]);
    assert!(at.join("out/replay/replay.json").is_file());
}
