//! Commands that read some seconds of their logs.

use std::fs;
use std::path::Path;

use crate::arm::{self, Gap};
use crate::files::json;
use crate::program::run;

/// What of the logs is read.
const SECONDS: [&str; 4] = ["--from-s", "4.5", "--to-s", "20"];

/// The rows of a log between these seconds, cut by hand.
fn cut(log: &str) -> String {
    let mut lines = log.lines();
    let mut text = format!("{}\n", lines.next().unwrap());
    for line in lines {
        let time: f64 = line.split(',').next().unwrap().trim_matches('"').parse().unwrap();
        if (4.5..=20.0).contains(&time) {
            text.push_str(&format!("{line}\n"));
        }
    }
    text
}

/// Whole logs in `whole`, and what of them is read in `cut`.
fn folder() -> tempfile::TempDir {
    let folder = arm::folder(Gap::Friction(1.5));
    for number in 0..2 {
        let name = format!("run_{number}.csv");
        let log = arm::log(number, Gap::Friction(1.5));
        for (place, text) in [("whole", &log), ("cut", &cut(&log))] {
            fs::create_dir_all(folder.path().join(place)).unwrap();
            arm::write(&folder.path().join(place), &name, text);
        }
    }
    folder
}

/// Runs a command on logs in a place and leaves its output in `out` there.
fn output(folder: &Path, place: &str, command: &str, more: &[&str]) {
    let words = command.replace("LOGS", place);
    let out = format!("{place}/out");
    let words = words.split(' ').chain(["--out", &out]).chain(more.iter().copied());
    let answer = run(folder, &words.collect::<Vec<_>>());
    assert!(answer.code <= 1, "{command}: {}", answer.err);
}

#[test]
fn the_seconds_that_are_asked_for_give_what_a_log_gives_that_holds_no_others() {
    let folder = folder();
    let diagnose = "diagnose --robot arm.urdf --no-recording --log LOGS/run_0.csv LOGS/run_1.csv";
    let compare = "compare --robot arm.urdf --before LOGS/run_0.csv --after LOGS/run_1.csv";
    let learn = "learn --robot arm.urdf --train LOGS/run_0.csv --test LOGS/run_1.csv --models rbd";
    let replay = "replay --robot arm.urdf --window-ms 200 --log LOGS/run_0.csv";
    let of_a_diagnosis =
        ["/findings", "/joints", "/gain", "/data/runs/0/samples", "/data/cutoff_hz"];
    let looked_at: [(&str, &str, &[&str]); 3] = [
        (diagnose, "diagnosis.json", &of_a_diagnosis),
        (compare, "after/diagnosis.json", &of_a_diagnosis),
        (learn, "learning.json", &["/train/rows", "/test/rows", "/cutoff_hz"]),
    ];
    for (command, file, pointers) in looked_at {
        output(folder.path(), "whole", command, &SECONDS);
        output(folder.path(), "cut", command, &[]);
        let [asked, cut] =
            ["whole", "cut"].map(|place| json(&folder.path().join(place).join("out").join(file)));
        for pointer in pointers {
            assert!(asked.pointer(pointer).is_some(), "{command}: {pointer}");
            assert_eq!(asked.pointer(pointer), cut.pointer(pointer), "{command}: {pointer}");
        }
    }
    output(folder.path(), "whole", replay, &SECONDS);
    output(folder.path(), "cut", replay, &[]);
    let [asked, cut] = ["whole", "cut"].map(|place| {
        let out = folder.path().join(place).join("out");
        fs::read(out.join("run_0_forward_200ms.parquet")).unwrap()
    });
    assert!(asked == cut, "{replay}");
}

#[test]
fn seconds_that_no_log_has_and_times_before_it_are_refused() {
    let folder = arm::folder(Gap::None);
    let diagnose = |more: &[&str]| {
        let command = ["diagnose", "--robot", "arm.urdf", "--log", "run_0.csv", "--out", "out"];
        run(folder.path(), &[&command, more].concat())
    };
    let answer = diagnose(&["--from-s", "3600"]);
    assert_eq!(answer.code, 3);
    let expected =
        "run_0.csv, from 3600 s on after its first row: 0 rows of data, at least 2 were expected";
    assert!(answer.err.contains(expected), "{}", answer.err);
    let answer = diagnose(&["--to-s", "-1"]);
    assert_eq!(answer.code, 2);
    assert!(answer.err.contains("a number of seconds, 0 or more, was expected"), "{}", answer.err);
}
