use std::fmt::Write as _;
use std::fs;
use std::path::Path;

use catalogue::EffectKind;
use serde_json::Value;

use crate::arm;
use crate::program::{Answer, run};

const ROBOT: &str = "urdf = \"arm.urdf\"\nsensing = \"motor\"\ntorque_source = \"commanded\"\n\
    joint.shoulder = { rotor_inertia_kg_m2 = 0.1, kp_nm_per_rad = 400.0, kd_nm_s_per_rad = 20.0 }\n\
    joint.elbow = { rotor_inertia_kg_m2 = 0.1, kp_nm_per_rad = 200.0, kd_nm_s_per_rad = 10.0 }\n";

const SENSORS: &str = "robot = \"arm.toml\"\nseed = 3\n\n[sensors]\neffort = \"commanded\"\n\
    effort_noise_nm = { shoulder = 1.5, elbow = 1.5 }\n";

const VISCOUS: &str = "viscous_friction = { joint = \"elbow\", viscous_nm_s_per_rad = 1.0 }";
const COULOMB: &str = "coulomb_friction = { joint = \"elbow\", level_nm = 0.3 }";

/// One speed up and down, 0.3 rad/s, at which 1 N·m·s/rad and 0.3 N·m are the same friction: the
/// first terms of the Fourier series of a square wave of velocity, smoothed (Lanczos). One and a half periods: a longer log
/// tells the two apart by where the arm turns.
fn one_speed() -> String {
    let term = |k: u32| {
        let share = f64::from(k) * std::f64::consts::PI / 11.0;
        if k % 2 == 1 {
            1.2 / std::f64::consts::PI / f64::from(k) * share.sin() / share
        } else {
            0.0
        }
    };
    let list = |scale: f64| format!("{:?}", (1..=9).map(|k| scale * term(k)).collect::<Vec<f64>>());
    let mut text = "[[run]]\nname = \"slow\"\n[run.motion.fourier]\nduration_s = 12.0\n\
        fade_s = 0.4\n[run.motion.fourier.coefficients.inline]\nbase_hz = 0.125\n"
        .to_owned();
    let joint = "[run.motion.fourier.coefficients.inline.joint";
    for (name, [a, b]) in [("shoulder", [0.8, 0.0]), ("elbow", [0.0, 1.0])] {
        writeln!(text, "{joint}.{name}]\noffset_rad = 0.0").unwrap();
        writeln!(text, "a_rad_per_s = {}\nb_rad_per_s = {}", list(a), list(b)).unwrap();
    }
    text
}

/// A folder with the arm, what is hidden in it, and its log on a motion at one speed.
fn folder(effect: &str) -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path();
    arm::write(path, "arm.urdf", arm::URDF);
    arm::write(path, "arm.toml", ROBOT);
    arm::write(path, "hidden.toml", &format!("{SENSORS}\n[[effect]]\n{effect}\n"));
    arm::write(path, "slow.toml", &format!("extends = \"hidden.toml\"\n\n{}", one_speed()));
    good(path, &["simulate", "slow.toml", "--out", "first", "--quiet"]);
    folder
}

fn good(folder: &Path, arguments: &[&str]) -> Answer {
    let answer = run(folder, arguments);
    assert_eq!(answer.code, 0, "{arguments:?}: {}{}", answer.out, answer.err);
    answer
}

/// The causes that a diagnosis of some logs names, each with those it cannot be told from.
fn diagnosed(folder: &Path, logs: &[&str], out: &str) -> Vec<(String, Vec<String>)> {
    let base = ["diagnose", "--robot", "arm.toml", "--out", out, "--no-recording", "--quiet"];
    good(folder, &[&base[..], &["--log"], logs].concat());
    let text = fs::read_to_string(folder.join(out).join("diagnosis.json")).unwrap();
    let value: Value = serde_json::from_str(&text).unwrap();
    let name = |at: &Value| at["effect"].as_str().unwrap().to_owned();
    let rivals = |at: &Value| {
        at["not_separable_from"].as_array().unwrap().iter().map(name).collect::<Vec<_>>()
    };
    value["findings"].as_array().unwrap().iter().map(|at| (name(at), rivals(at))).collect()
}

const DESIGN: [&str; 7] =
    ["design", "--robot", "arm.toml", "--diagnosis", "diagnosis", "--out", "next"];

/// The log says "one or the other"; the motion that it asks for, on the same arm, says which.
#[test]
fn what_a_log_could_not_tell_apart_is_told_apart_by_the_motion_it_asked_for() {
    for (effect, own, other) in [
        (VISCOUS, "viscous_friction", "coulomb_friction"),
        (COULOMB, "coulomb_friction", "viscous_friction"),
    ] {
        let folder = folder(effect);
        let path = folder.path();
        let first = diagnosed(path, &["first/slow.parquet"], "diagnosis");
        let [(named, rivals)] = first.as_slice() else { panic!("{first:?}") };
        let open = [std::slice::from_ref(named), rivals].concat();
        assert!([own, other].iter().all(|e| open.iter().any(|o| o == e)), "{first:?}");

        let answer = good(path, &DESIGN);
        assert!(answer.out.contains("this motion tells them apart: its 20 s are worth"));
        arm::write(path, "next.toml", "extends = [\"hidden.toml\", \"next/motion.toml\"]\n");
        good(path, &["simulate", "next.toml", "--out", "second", "--quiet"]);
        for logs in
            [&["second/motion.parquet"][..], &["first/slow.parquet", "second/motion.parquet"]]
        {
            let second = diagnosed(path, logs, "again");
            let [(named, rivals)] = second.as_slice() else { panic!("{second:?}") };
            assert_eq!(named, own, "{logs:?}");
            // What is still open no motion of this length would have told.
            let kinds = rivals.iter().map(|name| name.parse::<EffectKind>().unwrap());
            let still: Vec<String> = kinds.map(|kind| kind.label()).collect();
            let says = |label: &String, words: &str| {
                answer.out.contains(&format!("or {label} at elbow\n  {words}"))
            };
            let closed = |label: &String| {
                !says(label, "no motion of 20 s")
                    && !says(label, "this motion tells them apart, run ")
            };
            assert_eq!(still.into_iter().find(closed), None, "{logs:?}: {}", answer.out);
            assert!(!rivals.iter().any(|rival| rival == other), "{logs:?}: {rivals:?}");
        }
    }
}

#[test]
fn the_motion_is_written_for_programs_for_the_simulator_and_for_a_controller() {
    let folder = folder(VISCOUS);
    let path = folder.path();
    diagnosed(path, &["first/slow.parquet"], "diagnosis");
    let answer = good(path, &[&DESIGN[..], &["--duration-s", "12"]].concat());
    assert!(answer.out.starts_with("FR01 viscous friction at elbow or FR02 Coulomb friction at"));
    assert!(answer.out.lines().all(|line| line.chars().count() <= 100), "{}", answer.out);

    // The log format, at the rate of the logs, from rest to rest.
    let csv = fs::read_to_string(path.join("next/motion.csv")).unwrap();
    let columns = csv.lines().next().unwrap();
    let of = |signal: &str| format!("shoulder.{signal},elbow.{signal}");
    let signals = ["position", "velocity", "acceleration", "effort"].map(of).join(",");
    assert_eq!(columns, format!("time,{signals}"));
    assert_eq!(csv.lines().count(), 1 + 12 * 500 + 1);
    let info = good(path, &["log", "info", "next/motion.parquet", "--robot", "arm.toml"]);
    assert!(info.out.contains("500"), "{}", info.out);

    // A scenario of its own, and a recorded motion of another.
    good(path, &["simulate", "next/motion.toml", "--out", "simulated", "--quiet"]);
    let recorded = "robot = \"arm.toml\"\n[[run]]\nname = \"again\"\n\
        motion.recorded.file = \"next/motion.csv\"\n";
    arm::write(path, "recorded.toml", recorded);
    good(path, &["simulate", "recorded.toml", "--out", "recorded", "--quiet"]);

    // The same command, the same bytes.
    let read = |name| fs::read(path.join("next").join(name)).unwrap();
    let before = ["motion.csv", "motion.parquet", "motion.toml"].map(read);
    good(path, &[&DESIGN[..], &["--duration-s", "12", "--quiet"]].concat());
    assert!(before == ["motion.csv", "motion.parquet", "motion.toml"].map(read));
}

/// Before any log: of the arm only the joint in question moves.
#[test]
fn a_pair_that_is_asked_for_needs_no_diagnosis() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path();
    arm::write(path, "arm.urdf", arm::URDF);
    let pair = ["--separate", "FR01@elbow", "--from", "coulomb-friction@elbow"];
    let base = ["design", "--robot", "arm.urdf", "--out", "next", "--duration-s", "10"];
    let answer = good(path, &[&base[..], &pair].concat());
    assert!(answer.out.contains("over a noise of 1 % of the effort limits"), "{}", answer.out);
    let rests = |joint: &str| {
        let line = answer.out.lines().find(|line| line.trim_start().starts_with(joint));
        line.unwrap().contains(" rests ")
    };
    assert!(rests("shoulder") && !rests("elbow"), "{}", answer.out);
}

#[test]
fn where_no_motion_helps_nothing_is_written_and_it_is_said_what_would() {
    let folder = folder(VISCOUS);
    let path = folder.path();
    diagnosed(path, &["first/slow.parquet"], "diagnosis");
    let pair = ["--separate", "payload@fore", "--from", "IN02@fore"];
    let answer = run(path, &[&DESIGN[..], &pair].concat());
    assert_eq!(answer.code, 1, "{}{}", answer.out, answer.err);
    let expected = "no motion tells them apart: what one adds the other can add";
    assert!(answer.out.contains(expected), "{}", answer.out);
    assert!(answer.out.contains("the same motion before and after the load is put on"));
    assert!(!path.join("next").exists());
}

#[test]
fn what_cannot_be_designed_is_refused_in_a_sentence() {
    let folder = folder(VISCOUS);
    let path = folder.path();
    diagnosed(path, &["first/slow.parquet"], "diagnosis");
    let refused = |more: &[&str], code: i32, said: &str| {
        let answer = run(path, &[&DESIGN[..], more].concat());
        assert_eq!(answer.code, code, "{more:?}: {}{}", answer.out, answer.err);
        assert!(answer.err.contains(said), "{more:?}: {}", answer.err);
    };
    let pair = |one, other| ["--separate", one, "--from", other];
    refused(&pair("FR01@wrist", "FR02@elbow"), 2, "at wrist: one of shoulder, elbow was expected");
    refused(
        &pair("FR08@elbow", "FR02@elbow"),
        2,
        "that a motion of two minutes shows was expected",
    );
    refused(&pair("FR99@elbow", "FR02@elbow"), 2, "effect FR99: it is not in the catalogue");
    refused(&["--separate", "FR01@elbow"], 2, "--from");
    refused(&["--duration-s", "1000"], 2, "duration: found 1000, 1 to 120 s was expected");
    refused(&["--log", "arm.urdf"], 3, "arm.urdf");

    // A log that is another by now, a diagnosis of nothing, and none.
    let file = path.join("diagnosis/diagnosis.json");
    let text = fs::read_to_string(&file).unwrap();
    arm::write(path, "first/slow.csv", &arm::log(0, arm::Gap::None));
    refused(&["--log", "first/slow.csv"], 3, "it is not a log that was diagnosed");
    let mut value: Value = serde_json::from_str(&text).unwrap();
    value["findings"] = Value::Array(Vec::new());
    fs::write(&file, value.to_string()).unwrap();
    let answer = run(path, &DESIGN);
    assert_eq!(answer.code, 0, "an arm that is settled is no mistake: {}", answer.err);
    assert!(answer.out.contains("there is nothing to tell apart"), "{}", answer.out);
    fs::write(&file, "{}").unwrap();
    refused(&[], 3, "the diagnosis.json of a diagnosis was expected");
}
