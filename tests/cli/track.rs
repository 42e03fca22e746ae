use std::fs;
use std::path::Path;
use std::process::{Child, Command, Stdio};
use std::thread::sleep;
use std::time::{Duration, Instant};

use logs::{ReadOptions, Run};
use recording::Contents;
use robot::Robot;
use serde_json::Value;

use crate::arm;
use crate::files::{json, names};
use crate::program::{Answer, plumbline, run};

const SCENARIOS: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../../scenarios");
const ROBOT: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../../robots/wam7/robot.toml");

const SCENARIO: &str = r#"plant = "plant.toml"
motion.sinusoids = { seed = 24, terms = 3, lowest_hz = 0.3, highest_hz = 1.0, duration_s = 2.0, fade_s = 0.5 }
feedforward = ["none", "rbd", "gp"]

[control]
gains = "low-quarter"

[learn]
train = ["training"]
points = 40
"#;

/// A tracking scenario of two seconds and its plant, the simulated WAM.
fn folder() -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    let plant = format!(
        "extends = {:?}\n[[run]]\nname = \"training\"\nmotion.sinusoids = {{ seed = 21, terms = 3, \
         lowest_hz = 0.3, highest_hz = 1.0, duration_s = 5.0 }}\n",
        format!("{SCENARIOS}/arms/real_wam.toml")
    );
    arm::write(folder.path(), "plant.toml", &plant);
    arm::write(folder.path(), "tracking.toml", SCENARIO);
    folder
}

fn track(folder: &Path, out: &str, more: &[&str]) -> Answer {
    run(folder, &[&["track", "tracking.toml", "--out", out], more].concat())
}

fn comparison(out: &Path) -> Value {
    json(&out.join("tracking.json"))
}

/// The runs without what a clock measured.
fn timeless(out: &Path) -> Vec<Value> {
    let mut models = comparison(out)["models"].as_array().unwrap().clone();
    models.iter_mut().for_each(|model| model["prediction_us"] = Value::Null);
    models
}

/// A log of the simulated WAM.
fn log(path: &Path) -> Run {
    let robot = Robot::load(Path::new(ROBOT)).unwrap().robot;
    logs::read_run(path, &robot, &ReadOptions::default()).unwrap()
}

fn is_recorded(path: &Path, end_s: f64) {
    let contents = Contents::read(path).unwrap();
    assert!(contents.is_whole && contents.layouts > 0, "{}", path.display());
    let [start, end] = contents.time_s().unwrap();
    assert!(start.abs() < 1e-9 && (end - end_s).abs() < 0.01, "{start} to {end}");
    for entity in ["/joints/j7_palm_yaw", "/verdict", "/world/paths/measured"] {
        assert!(contents.entities.contains_key(entity), "{entity} is missing");
    }
}

#[test]
fn everything_that_a_comparison_needs_is_written_and_told() {
    let folder = folder();
    let answer = track(folder.path(), "out", &[]);
    assert_eq!((answer.code, answer.err.as_str()), (0, ""));
    for expected in ["none", "rbd", "gp", "j4_elbow_pitch", "plumbline view out"] {
        assert!(answer.out.contains(expected), "{expected} is missing in\n{}", answer.out);
    }
    let out = folder.path().join("out");
    let files = ["errors.svg", "logs", "models", "motion.svg", "recordings", "report.html"];
    assert_eq!(names(&out), [&files[..], &["scenario.toml", "tracking.json"]].concat());
    assert_eq!(names(&out.join("models")), ["gp.parquet", "rbd.parquet"]);
    assert_eq!(names(&out.join("logs")), ["gp.parquet", "none.parquet", "rbd.parquet"]);
    assert_eq!(names(&out.join("recordings")), ["gp.rrd", "none.rrd", "rbd.rrd"]);
    for name in names(&out.join("recordings")) {
        is_recorded(&out.join("recordings").join(name), 2.0);
    }
    let entities = Contents::read(&out.join("recordings/rbd.rrd")).unwrap().entities;
    assert!(entities.contains_key("/joints/j7_palm_yaw/further1"), "what gp expects");
    for name in names(&out.join("logs")) {
        assert!((1000..=1001).contains(&log(&out.join("logs").join(name)).time.len()));
    }

    let json = comparison(&out);
    assert_eq!(json["schema"], "plumbline.tracking/1");
    assert_eq!(json["robot"], "wam7");
    assert_eq!(json["gains"]["name"], "low-quarter");
    assert_eq!(json["gains"]["kp"][0], 50.0, "a quarter of 200");
    assert_eq!(json["duration_s"], 2.0);
    assert!(json["sweep"].is_null());
    let models = json["models"].as_array().unwrap();
    assert_eq!(models.iter().map(|m| &m["name"]).collect::<Vec<_>>(), ["none", "rbd", "gp"]);
    for model in models {
        for key in ["rmse_rad", "max_error_rad", "effort_rms_nm", "feedback_rms_nm"] {
            let numbers = model[key].as_array().unwrap();
            assert!(numbers.len() == 7 && numbers.iter().all(|n| n.as_f64().unwrap() > 0.0));
        }
        assert!(model["timing"].is_null(), "time was simulated");
        assert!(model["stopped"].is_null());
    }
    let tip = |model: usize| models[model]["tip_rmse_m"].as_f64().unwrap();
    assert!(tip(1) < 0.7 * tip(0), "rigid bodies know gravity: {} and {}", tip(1), tip(0));
}

#[test]
fn models_that_are_given_follow_as_those_that_are_learned_bit_for_bit() {
    let folder = folder();
    let answer = track(folder.path(), "out", &["--quiet"]);
    assert_eq!((answer.code, answer.out.as_str(), answer.err.as_str()), (0, "", ""));
    let given = ["--learned", "out/models", "--quiet"];
    assert_eq!(track(folder.path(), "again", &given).code, 0);
    let (out, again) = (folder.path().join("out"), folder.path().join("again"));
    assert_eq!(timeless(&out), timeless(&again));
    assert!(!again.join("models").exists(), "nothing was learned");
    let [first, second] = [&out, &again].map(|out| log(&out.join("logs/gp.parquet")));
    assert_eq!(first.sha256, second.sha256, "the same bytes");

    // The scenario that was written stands alone, and one model may be asked for.
    let more = ["--learned", "models", "--feedforward", "gp", "--json", "--quiet"];
    let arguments = [&["track", "scenario.toml", "--out", "one"], &more[..]].concat();
    let answer = run(&out, &arguments);
    assert_eq!((answer.code, answer.err.as_str()), (0, ""));
    assert_eq!(answer.out, fs::read_to_string(out.join("one/tracking.json")).unwrap());
    assert_eq!(timeless(&out.join("one")), timeless(&out)[2..]);
}

/// Refused with exit code 3 and this text, before anything is written.
fn refused(change: impl Fn(&str) -> String, more: &[&str], expected: &str) {
    let folder = folder();
    arm::write(folder.path(), "tracking.toml", &change(SCENARIO));
    let answer = track(folder.path(), "out", more);
    assert_eq!((answer.code, answer.out.as_str()), (3, ""), "{}", answer.err);
    assert_eq!(answer.err.trim_end(), expected.trim_matches('\n'));
    assert!(!folder.path().join("out").exists());
}

#[test]
fn names_that_are_not_there_are_underlined_and_the_known_ones_are_told() {
    refused(
        |s| s.replace("low-quarter", "low-quater"),
        &[],
        r#"
error: unknown set of gains `low-quater`, did you mean `low-quarter`?
 --> tracking.toml:6:9
  |
6 | gains = "low-quater"
  |         ^^^^^^^^^^^^ control.gains
  |
  = help: expected `compliant`, `low-quarter`, `low-tenth` or `stiff`"#,
    );
    refused(
        |s| s.replace("\"training\"", "\"trainig\""),
        &[],
        r#"
error: unknown run of the plant `trainig`, did you mean `training`?
 --> tracking.toml:9:10
  |
9 | train = ["trainig"]
  |          ^^^^^^^^^ learn.train.0
  |
  = help: expected `training`"#,
    );
    refused(
        |s| s.replace("[learn]", "kd_nm_s_per_rad = { j8 = 1.0 }\n[learn]"),
        &[],
        "
error: unknown joint `j8`
 --> tracking.toml:8:21
  |
8 | kd_nm_s_per_rad = { j8 = 1.0 }
  |                     ^^ control.kd_nm_s_per_rad.j8
  |
  = help: expected `j1_base_yaw`, `j2_shoulder_pitch`, `j3_shoulder_yaw`, `j4_elbow_pitch`,
          `j5_wrist_yaw`, `j6_wrist_pitch` or `j7_palm_yaw`",
    );
    refused(
        |s| s.replace("plant.toml", "plan.toml"),
        &[],
        r#"
error: plan.toml: there is no such file
 --> tracking.toml:1:9
  |
1 | plant = "plan.toml"
  |         ^^^^^^^^^^^ plant"#,
    );
}

#[test]
fn values_that_cannot_be_meant_are_underlined_where_they_were_given() {
    let cases = [
        ("prediction.time_ms=", "-1", "-1, a number from 0 to 10000 was expected"),
        ("prediction.time_ms=", "fast", "\"measured\" or a number (ms) was expected"),
        ("prediction.stops_at_s=", "nan", "NaN, a number from 0 to 1000000 was expected"),
        ("learn.points=", "0", "0, at least one was expected"),
        ("feedforward=", "[]", "nothing, at least one was expected, such as \"rbd\""),
        ("control.kp_nm_per_rad.j1_base_yaw=", "-3", "-3, a number from 0 to 1000000 was expected"),
    ];
    for (key, value, message) in cases {
        let path = key.trim_end_matches('=');
        let (blank, line) = (" ".repeat("--set ".len() + key.len()), "^".repeat(value.len()));
        let expected =
            format!("error: {message}\n  |\n1 | --set {key}{value}\n  | {blank}{line} {path}");
        refused(str::to_owned, &["--set", &format!("{key}{value}")], &expected);
    }
}

#[test]
fn an_unknown_feedforward_is_refused_with_all_that_there_are() {
    let folder = folder();
    let answer = track(folder.path(), "out", &["--feedforward", "rbd,gp_rbd"]);
    assert_eq!(answer.code, 2);
    assert!(answer.err.contains("\"gp_rbd\", one of none, gravity, cad, rbd,"), "{}", answer.err);
    let answer = track(folder.path(), "out", &["--set", "feedforward=['gp_rbd']"]);
    assert_eq!(answer.code, 3);
    for part in ["\"gp_rbd\", one of none,", "^^^^^^^^ feedforward.0"] {
        assert!(answer.err.contains(part), "{part} is missing in\n{}", answer.err);
    }
}

#[test]
fn a_model_that_is_missing_and_an_output_that_is_a_file_are_named() {
    let folder = folder();
    let answer = track(folder.path(), "out", &["--learned", "nowhere", "--quiet"]);
    let expected = "error: nowhere/rbd.parquet: there is no such file, the scenario feeds rbd \
                    forward\nhelp: plumbline learn and track write models; without --learned \
                    they are learned\n";
    assert_eq!((answer.code, answer.err.as_str()), (2, expected));
    let answer = track(folder.path(), "plant.toml", &[]);
    let expected = "error: plant.toml: it is a file, a folder to write into was expected\n";
    assert_eq!((answer.code, answer.err.as_str()), (2, expected));
}

#[test]
fn on_the_clock_on_the_wall_missed_deadlines_are_told() {
    let folder = folder();
    let wall = ["--set", "prediction.clock=wall", "--feedforward", "named,rbd"];
    let answer = track(folder.path(), "out", &wall);
    assert_eq!((answer.code, answer.err.as_str()), (0, ""));
    assert!(answer.out.contains("missed deadlines"), "{}", answer.out);
    let out = folder.path().join("out");
    let page = fs::read_to_string(out.join("report.html")).unwrap();
    assert!(page.contains("missed deadlines"));
    for model in comparison(&out)["models"].as_array().unwrap() {
        assert!(model["stopped"].is_null(), "{model}");
        let timing = |key: &str| model["timing"][key].as_f64().unwrap();
        assert!((1000.0..=1001.0).contains(&timing("ticks")));
        assert!((0.0..=timing("ticks")).contains(&timing("missed_deadlines")));
        assert!((0.0..=timing("ticks")).contains(&timing("missed_updates")));
        assert!(timing("worst_late_us") >= 0.0);
        assert!((0.0..=timing("latency_max_us")).contains(&timing("latency_99_us")));
        assert!(timing("latency_max_us") > 0.0, "a prediction takes time");
    }
}

#[test]
fn a_log_that_cannot_be_made_whole_is_left_as_it_grew() {
    let folder = folder();
    let logs = folder.path().join("out/logs");
    fs::create_dir_all(logs.join("none.parquet")).unwrap();
    let answer = track(folder.path(), "out", &["--feedforward", "none"]);
    assert_eq!(answer.code, 2, "{}", answer.err);
    for part in ["error: out/logs/none.parquet: it cannot be written: ", "comparison is whole"] {
        assert!(answer.err.contains(part), "{part} is missing in\n{}", answer.err);
    }
    assert!(answer.out.contains("j4_elbow_pitch"), "{}", answer.out);
    assert_eq!(log(&logs.join("none.csv")).time.len(), 1000);
    is_recorded(&folder.path().join("out/recordings/none.rrd"), 2.0);
    let warning = comparison(&folder.path().join("out"))["warnings"][0].to_string();
    assert!(warning.contains("none.parquet: it cannot be written"), "{warning}");
}

/// The recording needs more room than a file may have here, the log does not.
#[cfg(target_os = "linux")]
#[test]
fn a_recording_that_the_disk_refuses_costs_neither_log_nor_comparison() {
    let folder = folder();
    let program = plumbline().get_program().to_owned();
    let script = "trap '' XFSZ; ulimit -f 2048; exec \"$0\" \"$@\"";
    let mut command = Command::new("sh");
    command.current_dir(folder.path()).arg("-c").arg(script).arg(program);
    command.args(["track", "tracking.toml", "--out", "out", "--feedforward", "none"]);
    command.args(["--set", "motion.sinusoids.duration_s=1"]);
    let answer: Answer = command.output().unwrap().into();
    assert_eq!(answer.code, 2, "{}", answer.err);
    let part = "error: out/recordings/none.rrd: the recording cannot be written, ";
    assert!(answer.err.contains(part), "{}", answer.err);
    assert!(answer.out.contains("j4_elbow_pitch"), "{}", answer.out);
    let out = folder.path().join("out");
    assert_eq!(log(&out.join("logs/none.parquet")).time.len(), 500);
    assert_eq!(names(&out.join("logs")), ["none.parquet"]);
    assert!(out.join("report.html").exists());
}

/// A run of a minute with feedback alone, once its log holds so many lines and its recording
/// shows something move.
fn running(folder: &Path, lines: usize) -> Child {
    let motion = "motion.sinusoids.duration_s=60";
    let mut command = plumbline();
    command.current_dir(folder).args(["track", "tracking.toml", "--out", "out"]);
    command.args(["--feedforward", "none", "--set", motion]);
    let child = command.stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap();
    let out = folder.join("out");
    let newlines = |bytes: Vec<u8>| bytes.iter().filter(|c| **c == b'\n').count();
    let has_rows = || fs::read(out.join("logs/none.csv")).is_ok_and(|b| newlines(b) >= lines);
    let recording = out.join("recordings/none.rrd");
    let moves = || Contents::read(&recording).is_ok_and(|found| found.time_s().is_some());
    let (start, patience) = (Instant::now(), Duration::from_secs(120));
    while !(has_rows() && moves()) && start.elapsed() < patience {
        sleep(Duration::from_millis(2));
    }
    child
}

#[test]
fn a_viewer_that_nobody_started_is_missed_in_words() {
    if std::net::TcpListener::bind("127.0.0.1:9876").is_err() {
        println!("skipped: something listens where a viewer would");
        return;
    }
    let folder = folder();
    let told = "no viewer listened on 127.0.0.1:9876 (--live): start rerun first";
    let answer = track(folder.path(), "out", &["--feedforward", "none", "--live"]);
    let words = |answer: &Answer| answer.out.split_whitespace().collect::<Vec<_>>().join(" ");
    assert!(answer.code == 0 && words(&answer).contains(told), "{}{}", answer.out, answer.err);
    assert_eq!(comparison(&folder.path().join("out"))["warnings"], serde_json::json!([told]));
    let alone = track(folder.path(), "alone", &["--feedforward", "none"]);
    assert!(alone.code == 0 && !words(&alone).contains("viewer"), "{}{}", alone.out, alone.err);
}

/// Whenever it is killed: what had been written is there, and the same as in any other run.
#[test]
fn a_run_that_is_killed_leaves_a_log_and_a_recording_that_read_back() {
    let mut before = Vec::new();
    for lines in [2, 1200, 3000] {
        let folder = folder();
        let mut child = running(folder.path(), lines);
        child.kill().unwrap();
        child.wait().unwrap();
        let out = folder.path().join("out");
        let path = out.join("logs/none.csv");
        let log = log(&path);
        assert!(log.time.len() + 1 >= lines && log.time.len() < 30_000, "{}", log.time.len());
        for (row, time_s) in log.time.iter().enumerate() {
            assert!((time_s - row as f64 / 500.0).abs() < 1e-9, "row {row} at {time_s} s");
        }
        let answer = run(&out, &["log", "info", "logs/none.csv", "--robot", ROBOT]);
        assert_eq!(answer.code, 0, "{}", answer.err);

        let bytes = fs::read(&path).unwrap();
        let whole = bytes.iter().rposition(|c| *c == b'\n').unwrap();
        assert!(bytes.starts_with(&before), "every run writes the same rows");
        before = bytes[..whole].to_vec();

        let contents = Contents::read(&out.join("recordings/none.rrd")).unwrap();
        assert!(contents.layouts > 0 && !contents.is_whole);
        let [start_s, end_s] = contents.time_s().unwrap();
        let last_s = *log.time.last().unwrap();
        assert!(
            start_s.abs() < 1e-9 && end_s < last_s + 2.0,
            "{last_s} s, {start_s} to {end_s} s recorded"
        );
    }
}

#[cfg(unix)]
#[test]
fn a_run_that_ctrl_c_ends_is_whole_up_to_there() {
    let folder = folder();
    let child = running(folder.path(), 2);
    let pid = child.id().to_string();
    assert!(Command::new("kill").args(["-INT", &pid]).status().unwrap().success());
    let answer: Answer = child.wait_with_output().unwrap().into();
    assert_eq!(answer.code, 0, "{}", answer.err);
    assert!(answer.out.contains("Ctrl-C ended the run"), "{}", answer.out);
    let out = folder.path().join("out");
    let model = &comparison(&out)["models"][0];
    assert_eq!(model["stopped"], "Ctrl-C ended the run");
    assert_eq!(names(&out.join("logs")), ["none.parquet"]);
    let log = log(&out.join("logs/none.parquet"));
    assert!((2..30_000).contains(&log.time.len()), "{}", log.time.len());
    is_recorded(&out.join("recordings/none.rrd"), *log.time.last().unwrap());
    assert!(out.join("report.html").exists());
}
