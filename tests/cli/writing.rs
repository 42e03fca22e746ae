//! Files that cannot be written, that are not finished, or that would lie over an input.

use std::fs;
use std::thread::sleep;
use std::time::{Duration, Instant};

use crate::arm::{self, Gap};
use crate::files::names;
#[cfg(target_os = "linux")]
use crate::limits::with_room;
use crate::program::{Answer, plumbline, run};

const DIAGNOSE: [&str; 6] = ["diagnose", "--robot", "arm.urdf", "--log", "run_0.csv", "run_1.csv"];

/// From nothing to enough for the recording.
#[cfg(target_os = "linux")]
#[test]
fn a_full_disk_ends_a_diagnosis_with_2_and_the_name_of_the_file() {
    let folder = arm::folder(Gap::Friction(1.5));
    let arguments = [&DIAGNOSE[..], &["--out", "out"]].concat();
    for (kb, file) in [(1, "out/"), (100, "out/report.html"), (250, "out/recording.rrd")] {
        let start = Instant::now();
        let answer = with_room(folder.path(), kb, &arguments);
        assert_eq!(answer.code, 2, "{kb} kB: {}", answer.err);
        let expected = format!("error: {file}");
        assert!(answer.err.contains(&expected), "{kb} kB: {}", answer.err);
        assert!(start.elapsed() < Duration::from_secs(60));
        let left = names(&folder.path().join("out"));
        assert!(
            left.iter().all(|name| !name.ends_with("rrd") && !name.starts_with('.')),
            "{left:?}"
        );
    }
}

#[cfg(target_os = "linux")]
#[test]
fn a_full_disk_ends_the_other_commands_with_2() {
    let folder = arm::folder(Gap::Friction(1.5));
    let arguments: [&[&str]; 3] = [
        &[
            "replay",
            "--robot",
            "arm.urdf",
            "--log",
            "run_0.csv",
            "--window-ms",
            "200",
            "--out",
            "out",
        ],
        &[
            "learn",
            "--robot",
            "arm.urdf",
            "--train",
            "run_0.csv",
            "--test",
            "run_1.csv",
            "--models",
            "rbd",
            "--out",
            "out",
        ],
        &[
            "compare",
            "--robot",
            "arm.urdf",
            "--before",
            "run_0.csv",
            "--after",
            "run_1.csv",
            "--out",
            "out",
        ],
    ];
    for arguments in arguments {
        let answer = with_room(folder.path(), 1, arguments);
        assert_eq!(answer.code, 2, "{arguments:?}: {}", answer.err);
        assert!(answer.err.contains("error: out/"), "{arguments:?}: {}", answer.err);
        assert!(!answer.err.contains(".plumbline-"), "{}", answer.err);
        assert!(names(&folder.path().join("out")).iter().all(|name| !name.starts_with('.')));
    }
}

/// Warnings, errors and where files lie go to the standard error: that it cannot be written changes no answer.
#[cfg(target_os = "linux")]
#[test]
fn a_standard_error_on_a_full_disk_changes_no_exit_code() {
    let folder = arm::folder(Gap::Friction(1.5));
    let path = folder.path();
    fs::write(path.join("broken.toml"), "robot = 1").unwrap();
    let answered: [&[&str]; 5] = [
        &[&DIAGNOSE[..], &["--no-recording", "--json", "--out", "out"]].concat(),
        &["diagnose", "--robot", "arm.urdf", "--log", "absent.csv", "--out", "none"],
        &["run", "broken.toml", "--out", "none"],
        &["robot", "check", "absent.urdf"],
        &["no-such-command"],
    ];
    for arguments in answered {
        let code = run(path, arguments).code;
        let full = fs::File::options().write(true).open("/dev/full").unwrap();
        let mut command = plumbline();
        command.current_dir(path).args(arguments).stderr(full);
        assert_eq!(command.output().unwrap().status.code(), Some(code), "{arguments:?}");
    }
}

/// A folder in the place of a file, as a name that cannot be written.
#[test]
fn a_file_that_cannot_be_written_ends_with_2() {
    let folder = arm::folder(Gap::Friction(1.5));
    let path = folder.path();
    let scenario = concat!(env!("CARGO_MANIFEST_DIR"), "/../../scenarios/demos/no_effects.toml");
    let answer = run(path, &[&DIAGNOSE[..], &["--out", "found"]].concat());
    assert!(answer.code <= 1, "{}", answer.err);
    let robot = ["--robot", "arm.urdf"];
    let commands: [(&str, &[&str]); 3] = [
        ("run_0_forward_200ms.parquet", &["replay", "--log", "run_0.csv", "--window-ms", "200"]),
        (
            "motion.csv",
            &["design", "--diagnosis", "found", "--separate", "FR02@elbow", "--from", "FR04@elbow"],
        ),
        ("models", &["learn", "--train", "run_0.csv", "--test", "run_1.csv", "--models", "rbd"]),
    ];
    for (file, command) in commands {
        let out = format!("out_{}", command[0]);
        if command[0] == "learn" {
            fs::create_dir(path.join(&out)).unwrap();
            fs::write(path.join(&out).join(file), "a file").unwrap();
        } else {
            fs::create_dir_all(path.join(&out).join(file).join("full")).unwrap();
        }
        let answer = run(path, &[command, &robot, &["--out", &out]].concat());
        assert_eq!(answer.code, 2, "{command:?}: {}{}", answer.out, answer.err);
        assert!(answer.err.contains(&format!("{out}/{file}")), "{command:?}: {}", answer.err);
    }
    fs::create_dir_all(path.join("sim/truth.json/full")).unwrap();
    let answer = run(path, &["simulate", scenario, "--out", "sim"]);
    assert_eq!(answer.code, 2, "{}", answer.err);
    assert!(answer.err.contains("sim/truth.json"), "{}", answer.err);
    fs::create_dir(path.join("run")).unwrap();
    fs::write(path.join("run/stages"), "a file").unwrap();
    let answer = run(path, &["run", scenario, "--out", "run"]);
    assert_eq!(answer.code, 2, "{}", answer.err);
    assert!(answer.err.contains("run/stages"), "{}", answer.err);
}

#[test]
fn an_input_is_not_written_over() {
    let folder = arm::folder(Gap::Friction(1.5));
    let path = folder.path();
    assert!(run(path, &[&DIAGNOSE[..], &["--out", "oe"]].concat()).code <= 1);
    let before = fs::read(path.join("oe/extended.toml")).unwrap();
    let again = ["diagnose", "--robot", "oe/extended.toml", "--log", "run_0.csv", "run_1.csv"];
    for out in ["oe", "./oe", "oe/../oe"] {
        let answer = run(path, &[&again[..], &["--out", out]].concat());
        assert_eq!(answer.code, 2, "{}", answer.err);
        assert!(answer.err.contains("error: oe/extended.toml: it is read"), "{}", answer.err);
        assert!(answer.err.contains("give --out another name"), "{}", answer.err);
        assert_eq!(fs::read(path.join("oe/extended.toml")).unwrap(), before);
    }
    let urdf = ["diagnose", "--robot", "oe/extended.urdf", "--log", "run_0.csv", "--out", "oe"];
    let answer = run(path, &urdf);
    assert_eq!(answer.code, 2, "{}", answer.err);
    assert!(answer.err.contains("error: oe/extended.urdf: it is read"), "{}", answer.err);
    assert!(run(path, &[&again[..], &["--out", "other"]].concat()).code <= 1);
}

#[test]
fn a_learning_that_is_killed_leaves_nothing_half_done() {
    let folder = arm::folder(Gap::Friction(1.5));
    let mut command = plumbline();
    command.current_dir(folder.path()).args(["learn", "--robot", "arm.urdf", "--quiet"]);
    command.args(["--train", "run_0.csv", "--test", "run_1.csv", "--points", "1500"]);
    let mut child = command.args(["--models", "rbd,gp,gp-rbd", "--out", "out"]).spawn().unwrap();
    let out = folder.path().join("out");
    let start = Instant::now();
    while !out.exists() && start.elapsed() < Duration::from_secs(60) {
        sleep(Duration::from_millis(5));
    }
    sleep(Duration::from_millis(300));
    child.kill().unwrap();
    child.wait().unwrap();
    assert_eq!(names(&out), Vec::<String>::new());
}

#[test]
fn a_diagnosis_is_the_same_but_for_the_way_to_its_files_wherever_it_is_written_and_on_any_number_of_threads()
 {
    let folder = arm::folder(Gap::Friction(1.5));
    let written = |out: &str, threads: &str| {
        let mut command = plumbline();
        command.current_dir(folder.path()).env("RAYON_NUM_THREADS", threads);
        let answer = command.args(DIAGNOSE).args(["--no-recording", "--out", out]).output();
        let answer = Answer::from(answer.unwrap());
        assert!(answer.code <= 1, "{}", answer.err);
        fs::read_to_string(folder.path().join(out).join("diagnosis.json")).unwrap()
    };
    let one = written("one", "1");
    assert!(one.contains("\"../arm.urdf\"") && !one.contains("../../"));
    for (out, threads) in [("further/down", "2"), ("four", "4")] {
        let up = "../".repeat(out.split('/').count());
        let other = written(out, threads).replace(&format!("\"{up}"), "\"../");
        assert!(other == one, "{threads} threads");
    }
}
