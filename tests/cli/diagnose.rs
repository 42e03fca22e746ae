use std::fs;
use std::path::Path;

use learner::{Model, Samples, TorqueModel, TorqueScore};
use logs::{PrepareSettings, ReadOptions};
use robot::Robot;
use serde_json::Value;

use crate::arm::{self, Gap};
use crate::files::{json, names};
use crate::program::{Answer, plumbline, run};

const FILES: [&str; 6] =
    ["diagnosis.json", "extended.toml", "extended.urdf", "figure.svg", "report.html", "robot.urdf"];

fn diagnose(folder: &Path, more: &[&str]) -> Answer {
    let base = ["diagnose", "--log", "run_0.csv", "run_1.csv", "--log", "run_2.csv"];
    run(folder, &[&base, more].concat())
}

/// The output folder, with its recording.
fn all_files() -> Vec<&'static str> {
    [&FILES[..4], &["recording.rrd"], &FILES[4..]].concat()
}

#[test]
fn friction_is_named_written_down_and_gone_from_the_extended_robot() {
    let folder = arm::folder(Gap::Friction(1.5));
    let answer = diagnose(folder.path(), &["--robot", "arm.urdf", "--out", "out"]);
    assert_eq!(answer.code, 0, "{}{}", answer.out, answer.err);
    assert!(answer.out.starts_with("Explained: "), "{}", answer.out);
    assert!(answer.out.contains("FR02 Coulomb friction"), "{}", answer.out);
    assert!(answer.out.contains("figure         out/figure.svg"), "{}", answer.out);
    assert!(answer.out.trim_end().ends_with("extended model out/extended.toml (for --robot)"));
    assert!(!answer.out.contains('\u{1b}') && answer.err.is_empty(), "{answer:?}");
    assert!(answer.out.contains("\nrecording      out/recording.rrd (plumbline view out)\n"));
    assert_eq!(names(&folder.path().join("out")), all_files());

    let value = json(&folder.path().join("out/diagnosis.json"));
    let finding = &value["findings"][0];
    assert_eq!(
        (&finding["effect"], &finding["joint"]),
        (&"coulomb_friction".into(), &"elbow".into())
    );
    let level = finding["parameters"]["level"]["value"].as_f64().unwrap();
    assert!((level - 1.5).abs() < 0.1, "{level}");

    assert_eq!(finding["code"], "FR02");
    let extended = fs::read_to_string(folder.path().join("out/extended.toml")).unwrap();
    assert!(extended.contains("\n# FR02 Coulomb friction at elbow: "), "{extended}");

    let again = diagnose(
        folder.path(),
        &["--robot", "out/extended.toml", "--out", "again", "--json", "--quiet"],
    );
    assert_eq!(again.code, 0, "{}", again.err);
    let value: Value = serde_json::from_str(&again.out).unwrap();
    assert_eq!(value["verdict"], "consistent");
    assert_eq!(value["findings"].as_array().unwrap().len(), 0);
}

#[test]
fn a_gap_without_a_name_and_a_log_without_motion_exit_with_one() {
    let folder = arm::folder(Gap::Ripple(1.5));
    let answer = diagnose(folder.path(), &["--robot", "arm.urdf", "--out", "out"]);
    assert_eq!(answer.code, 1, "{}{}", answer.out, answer.err);
    let verdict = json(&folder.path().join("out/diagnosis.json"))["joints"][1]["verdict"].clone();
    assert!(["unexplained", "partly_explained"].contains(&verdict.as_str().unwrap()), "{verdict}");

    arm::write(folder.path(), "still.csv", &arm::still());
    let arguments = ["diagnose", "--robot", "arm.urdf", "--log", "still.csv", "--out", "still"];
    let answer = run(folder.path(), &arguments);
    assert_eq!(answer.code, 1, "{}{}", answer.out, answer.err);
    let value = json(&folder.path().join("still/diagnosis.json"));
    assert_eq!(value["verdict"], "data_inadequate");
}

/// RMS errors of a model on run 5, of which no log was given (N m).
fn rms_on_another_run(folder: &Path, model: &dyn TorqueModel, robot: &Robot) -> Vec<f64> {
    arm::write(folder, "run_5.csv", &arm::log(5, Gap::Ripple(1.5)));
    let run = logs::read_run(&folder.join("run_5.csv"), robot, &ReadOptions::default()).unwrap();
    let prepared = logs::prepare(&[run], &PrepareSettings::default()).unwrap();
    TorqueScore::of(model, &Samples::new(&prepared)).rmse
}

/// The ripple has no name; the process learns it, and leaves the other joint alone.
#[test]
fn a_residual_model_predicts_what_has_no_name_where_it_is_and_nowhere_else() {
    let folder = arm::folder(Gap::Ripple(1.5));
    let arguments = ["--robot", "arm.urdf", "--out", "out", "--no-recording"];
    let answer = diagnose(folder.path(), &[&arguments[..], &["--residual", "gp"]].concat());
    assert_eq!(answer.code, 1, "{}{}", answer.out, answer.err);
    assert!(answer.out.contains("Of what is left a Gaussian process predicts "), "{}", answer.out);
    assert!(answer.out.contains("bends most with position of elbow ("), "{}", answer.out);
    let out = folder.path().join("out");
    let path = out.join("models/named-gp.parquet");
    assert!(
        answer
            .out
            .ends_with("\nresidual model out/models/named-gp.parquet (for track --learned)\n")
    );

    let residual = &json(&out.join("diagnosis.json"))["residual_model"];
    assert_eq!(residual["file"], "models/named-gp.parquet");
    let [shoulder, elbow] = [&residual["joints"][0], &residual["joints"][1]];
    assert_eq!((&shoulder["is_used"], &elbow["is_used"]), (&false.into(), &true.into()));
    assert!(elbow["share"].as_f64().unwrap() > 0.8, "{elbow}");
    assert!(fs::read_to_string(out.join("report.html")).unwrap().contains("The residual model"));

    let robot = Robot::load(&folder.path().join("arm.urdf")).unwrap().robot;
    let model = Model::load(&path, &robot).unwrap();
    let mut extended = model.clone();
    extended.process = None;
    let before = rms_on_another_run(folder.path(), &extended, &robot);
    let after = rms_on_another_run(folder.path(), &model, &robot);
    assert!(after[1] < 0.3 * before[1], "{before:?} {after:?}");
    assert!((after[0] - before[0]).abs() < 1e-12, "{before:?} {after:?}");

    // The model of an earlier diagnosis is not left beside another extended robot.
    diagnose(folder.path(), &arguments);
    assert!(!path.exists());
    assert!(json(&out.join("diagnosis.json")).get("residual_model").is_none());
}

#[test]
fn a_residual_model_of_another_kind_is_a_mistake_of_usage() {
    let folder = arm::folder(Gap::None);
    let answer =
        diagnose(folder.path(), &["--robot", "arm.urdf", "--out", "o", "--residual", "nn"]);
    assert_eq!(answer.code, 2);
    assert!(answer.err.contains("[possible values: gp]"), "{}", answer.err);
}

#[test]
fn what_the_robot_says_of_play_and_delay_is_part_of_the_model_and_stays() {
    let folder = arm::folder(Gap::Friction(1.5));
    let toml = "urdf = \"arm.urdf\"\n[joint.elbow]\nbacklash_rad = 0.0001\nactuator_delay_ms = 0.1";
    arm::write(folder.path(), "play.toml", toml);
    let answer = diagnose(folder.path(), &["--robot", "play.toml", "--out", "out"]);
    assert_eq!(answer.code, 0, "{}{}", answer.out, answer.err);
    let value = json(&folder.path().join("out/diagnosis.json"));
    assert_eq!(value["warnings"], serde_json::json!([]));
    let extended = fs::read_to_string(folder.path().join("out/extended.toml")).unwrap();
    assert!(extended.contains("backlash_rad = 0.0001\nactuator_delay_ms = 0.1\n"), "{extended}");
}

#[test]
fn the_json_has_the_keys_of_the_schema_and_is_the_same_everywhere() {
    let folder = arm::folder(Gap::Friction(1.5));
    let answer = diagnose(folder.path(), &["--robot", "arm.urdf", "--out", "out", "--json"]);
    let value: Value = serde_json::from_str(&answer.out).unwrap();
    assert_eq!(value["schema"], "plumbline.diagnosis/1");
    for key in
        ["verdict", "joints", "findings", "unexplained", "ruled_out", "gain", "data", "provenance"]
    {
        assert!(!value[key].is_null(), "{key} is missing");
    }
    for key in ["nmse_before", "nmse_after", "rms_before_nm", "rms_after_nm"] {
        assert_eq!(value["gain"]["inverse"][key].as_array().unwrap().len(), 2, "{key}");
    }
    let files = value["provenance"]["files"].as_array().unwrap();
    assert_eq!(files.len(), 4, "the robot and three logs");
    assert!(files.iter().all(|f| f["sha256"].as_str().unwrap().len() == 64));
    assert!(answer.err.contains("out/report.html"), "{}", answer.err);
    assert_eq!(fs::read_to_string(folder.path().join("out/diagnosis.json")).unwrap(), answer.out);
}

#[test]
fn the_same_command_writes_the_same_bytes() {
    let folder = arm::folder(Gap::Friction(1.5));
    let read = || FILES.map(|name| fs::read(folder.path().join("out").join(name)).unwrap());
    let arguments = ["--robot", "arm.urdf", "--out", "out", "--quiet"];
    let first = diagnose(folder.path(), &arguments);
    assert_eq!((first.out.as_str(), first.err.as_str()), ("", ""));
    let before = read();
    diagnose(folder.path(), &arguments);
    for (name, (a, b)) in FILES.iter().zip(before.iter().zip(&read())) {
        assert!(a == b, "{name} differs");
    }
}

/// A truth and a scenario beside the logs, which tell of another effect, change no byte.
#[test]
fn what_lies_beside_the_logs_is_not_looked_at() {
    let folder = arm::folder(Gap::Friction(1.5));
    let read = || FILES.map(|name| fs::read(folder.path().join("out").join(name)).unwrap());
    let arguments = ["--robot", "arm.urdf", "--out", "out", "--quiet", "--no-recording"];
    diagnose(folder.path(), &arguments);
    let alone = read();
    let truth = r#"{ "seed": 1, "effects": [{ "code": "IN01", "effect": "payload", "link": "fore",
        "parameters": { "mass": 2.0, "com_x": 0.1, "com_y": 0.0, "com_z": 0.0 } }] }"#;
    let scenario = "robot = \"arm.urdf\"\n[[effect]]\n\
        payload = { link = \"fore\", mass_kg = 2.0, com_m = [0.1, 0.0, 0.0] }\n";
    arm::write(folder.path(), "truth.json", truth);
    arm::write(folder.path(), "scenario.toml", scenario);
    fs::remove_dir_all(folder.path().join("out")).unwrap();
    diagnose(folder.path(), &arguments);
    for (name, (a, b)) in FILES.iter().zip(alone.iter().zip(&read())) {
        assert!(a == b, "{name} differs");
    }
    let value = json(&folder.path().join("out/diagnosis.json"));
    assert_eq!(value["findings"][0]["effect"], "coulomb_friction");
}

#[test]
fn the_report_opens_offline_and_holds_the_same_json() {
    let folder = arm::folder(Gap::Friction(1.5));
    let answer = diagnose(folder.path(), &["--robot", "arm.urdf", "--out", "out", "--json"]);
    let page = fs::read_to_string(folder.path().join("out/report.html")).unwrap();
    assert!(!page.contains("http://") && !page.contains("https://"));
    let policy = "content=\"default-src 'none'; style-src 'unsafe-inline'; img-src data:; script-src 'sha256-";
    assert!(page.contains(policy));
    assert_eq!(page.matches("<script").count(), 2, "the data, and what zooms, sorts and copies");
    let (_, data) = page.split_once("<script type=\"application/json\" id=\"diagnosis\">").unwrap();
    let embedded: Value = serde_json::from_str(data.split_once("</script>").unwrap().0).unwrap();
    // A page is passed on: its files have no folders, and how they were read is said in diagnosis.json alone.
    let mut printed: Value = serde_json::from_str(&answer.out).unwrap();
    assert!(printed.as_object_mut().unwrap().remove("input").is_some());
    for file in printed["provenance"]["files"].as_array_mut().unwrap() {
        let name = file["path"].as_str().unwrap().strip_prefix("../").unwrap().to_owned();
        file["path"] = name.into();
    }
    assert_eq!(embedded, printed);
    // The drift of the tip, and two joints, each with three views, one enlarged stretch and three runs, and
    // below these what is left, each drawn in a frame; and a spectrum a joint.
    assert_eq!(page.matches("<svg").count(), 2 * (1 + 2 * (3 + 2 * (1 + 3))) + 2);
    assert!(page.len() < 1_500_000, "{} bytes", page.len());
}

#[test]
fn the_figure_stands_alone_and_shows_the_joint_with_its_cause() {
    let folder = arm::folder(Gap::Friction(1.5));
    diagnose(folder.path(), &["--robot", "arm.urdf", "--out", "out", "--quiet"]);
    let svg = fs::read_to_string(folder.path().join("out/figure.svg")).unwrap();
    assert!(svg.starts_with("<svg xmlns=") && svg.trim_end().ends_with("</svg>"));
    for expected in
        ["elbow: torque over time", "FR02 Coulomb friction", "arm: explained by 1 named"]
    {
        assert!(svg.contains(expected), "{expected} is missing");
    }
    assert_eq!(svg.matches("http").count(), 1, "only the name space");
    assert!(svg.len() < 150_000, "{} bytes", svg.len());
}

#[test]
fn a_mesh_that_is_nowhere_is_no_error() {
    let folder = arm::folder(Gap::None);
    let mesh = r#"<link name="upper"><visual><geometry><mesh filename="package://no/such.stl"/></geometry></visual>"#;
    arm::write(folder.path(), "mesh.urdf", &arm::URDF.replace("<link name=\"upper\">", mesh));
    let answer = diagnose(folder.path(), &["--robot", "mesh.urdf", "--out", "out"]);
    assert_eq!(answer.code, 0, "{}{}", answer.out, answer.err);
    assert!(answer.out.starts_with("Consistent: "), "{}", answer.out);
}

/// The recording of the diagnosis before is not left beside the report of another.
#[test]
fn a_diagnosis_without_its_recording_is_whole_but_for_that() {
    let folder = arm::folder(Gap::Friction(1.5));
    let arguments = ["diagnose", "--robot", "arm.urdf", "--log", "run_0.csv", "--out", "out"];
    let out = folder.path().join("out");
    fs::create_dir(&out).unwrap();
    let left_out = |path: &Path| fs::write(path.join("recording.rrd"), "an earlier one").unwrap();
    left_out(&out);
    let answer = run(folder.path(), &[&arguments[..], &["--no-recording"]].concat());
    assert_eq!((answer.code, answer.err.as_str()), (0, ""), "{}", answer.out);
    assert!(!answer.out.contains("recording"), "{}", answer.out);
    assert_eq!(names(&out), FILES);

    left_out(&out);
    let mut off = plumbline();
    let off = off.env("RERUN", "off").current_dir(folder.path()).args(arguments).output();
    let off = Answer::from(off.unwrap());
    assert_eq!(off.code, 0, "{}", off.err);
    assert!(off.err.starts_with("warning: out/recording.rrd: nothing would be"), "{}", off.err);
    assert_eq!(names(&out), FILES);

    // A folder in its place cannot be written.
    fs::create_dir(out.join("recording.rrd")).unwrap();
    let answer = run(folder.path(), &arguments);
    assert_eq!(answer.code, 2, "{}", answer.err);
    assert!(answer.err.starts_with("error: out/recording.rrd: "), "{}", answer.err);
}

#[test]
fn an_effect_that_the_robot_is_known_not_to_have_is_not_named() {
    let folder = arm::folder(Gap::Friction(1.5));
    let told =
        ["--robot", "arm.urdf", "--out", "out", "--without", "FR02", "--without", "stribeck"];
    let answer = diagnose(folder.path(), &told);
    assert_eq!(answer.code, 2);
    assert!(answer.err.contains("did you mean FR04 stribeck_friction?"), "{}", answer.err);
    assert!(!folder.path().join("out").exists());

    let told = ["--robot", "arm.urdf", "--out", "out", "--without", "FR02"];
    let answer = diagnose(folder.path(), &told);
    assert!(answer.code <= 1, "{}", answer.err);
    assert!(!answer.out.contains("FR02"), "{}", answer.out);
    let value = json(&folder.path().join("out/diagnosis.json"));
    let ruled_out = value["ruled_out"].as_array().unwrap();
    assert!(!ruled_out.is_empty() && ruled_out.iter().all(|entry| entry["code"] != "FR02"));
}
