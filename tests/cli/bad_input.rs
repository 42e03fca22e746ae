use std::fs;
use std::path::Path;

use logs::{ReadOptions, read_run, write_parquet};
use robot::Robot;

use crate::arm::{self, Gap};
use crate::program::{Answer, run};

/// A folder with the arm, a good log, and an output folder that holds something.
fn folder() -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    arm::write(folder.path(), "arm.urdf", arm::URDF);
    arm::write(folder.path(), "good.csv", &arm::log(0, Gap::None));
    fs::create_dir(folder.path().join("out")).unwrap();
    arm::write(folder.path(), "out/diagnosis.json", "of yesterday");
    folder
}

/// Diagnoses and checks that one message with all `expected` comes, with this exit code,
/// and that the output folder is as it was.
fn refused(folder: &Path, robot: &str, log: &str, more: &[&str], code: i32, expected: &[&str]) {
    let base = ["diagnose", "--robot", robot, "--log", "good.csv", "--log", log, "--out", "out"];
    let Answer { code: found, out, err } = run(folder, &[&base, more].concat());
    assert_eq!((found, out.as_str()), (code, ""), "{log}: {err}");
    assert!(err.starts_with("error: "), "{err}");
    assert_eq!(err.lines().filter(|l| l.starts_with("error:")).count(), 1, "{err}");
    assert!(!err.contains("panicked") && !err.contains('\u{1b}'), "{err}");
    for part in expected {
        assert!(err.contains(part), "{part} is missing in\n{err}");
    }
    let left: Vec<_> = fs::read_dir(folder.join("out")).unwrap().map(|e| e.unwrap()).collect();
    assert_eq!(left.len(), 1, "{left:?}");
    assert_eq!(fs::read_to_string(folder.join("out/diagnosis.json")).unwrap(), "of yesterday");
}

/// The good log with line `line` (the header is 1) changed.
fn changed(line: usize, change: impl Fn(&str) -> String) -> String {
    let log = arm::log(0, Gap::None);
    let lines = log.lines().enumerate();
    lines
        .map(|(i, text)| if i + 1 == line { change(text) } else { text.to_owned() } + "\n")
        .collect()
}

/// The good log with a field of line 12 replaced.
fn with_field(column: usize, value: &str) -> String {
    changed(12, |line| {
        let mut fields: Vec<&str> = line.split(',').collect();
        fields[column] = value;
        fields.join(",")
    })
}

#[test]
fn files_that_are_none() {
    let folder = folder();
    let path = folder.path();
    arm::write(path, "empty.csv", "");
    fs::create_dir(path.join("folder.csv")).unwrap();
    refused(path, "arm.urdf", "no.csv", &[], 3, &["no.csv"]);
    refused(path, "arm.urdf", "folder.csv", &[], 3, &["folder.csv", "directory"]);
    refused(path, "arm.urdf", "empty.csv", &[], 3, &["empty.csv", "empty"]);
    refused(path, "no.urdf", "good.csv", &[], 3, &["no.urdf", "there is no such file"]);
    refused(path, "folder.csv", "good.csv", &[], 3, &["folder.csv", "it is a directory"]);
    refused(path, "empty.csv", "good.csv", &[], 3, &["empty.csv", "empty"]);
    refused(path, "arm.urdf", "good.csv", &["--map", "no.toml"], 3, &["no.toml"]);
}

#[test]
fn a_parquet_file_that_was_cut_off() {
    let folder = folder();
    let robot = Robot::from_urdf(arm::URDF).unwrap();
    let run = read_run(&folder.path().join("good.csv"), &robot, &ReadOptions::default()).unwrap();
    let path = folder.path().join("cut.parquet");
    write_parquet(&path, &run).unwrap();
    let bytes = fs::read(&path).unwrap();
    fs::write(&path, &bytes[..bytes.len() / 2]).unwrap();
    let expected = ["cut.parquet", "not a whole Parquet file"];
    refused(folder.path(), "arm.urdf", "cut.parquet", &[], 3, &expected);
}

#[test]
fn fields_that_are_no_numbers() {
    let folder = folder();
    let short = changed(12, |line| line.rsplit_once(',').unwrap().0.to_owned());
    let cases: [(String, &[&str]); 5] = [
        (short, &["row 11", "6 fields", "7 were expected"]),
        (with_field(3, "broken"), &["row 11", "shoulder.effort", "\"broken\"", "a number"]),
        (with_field(4, "NaN"), &["row 11", "elbow.position", "NaN", "a finite number"]),
        (with_field(6, "inf"), &["row 11", "elbow.effort", "inf", "a finite number"]),
        (with_field(1, ""), &["row 11", "shoulder.position", "a number was expected"]),
    ];
    for (content, expected) in cases {
        arm::write(folder.path(), "bad.csv", &content);
        refused(folder.path(), "arm.urdf", "bad.csv", &[], 3, &[&["bad.csv"], expected].concat());
    }
}

#[test]
fn time_that_does_not_increase() {
    let folder = folder();
    arm::write(folder.path(), "back.csv", &with_field(0, "0.01"));
    let expected = ["back.csv", "row 11", "column time", "0.01", "0.045", "must increase"];
    refused(folder.path(), "arm.urdf", "back.csv", &[], 3, &expected);
    arm::write(folder.path(), "twice.csv", &with_field(0, "0.045"));
    let expected = ["twice.csv", "row 11", "column time", "must increase"];
    refused(folder.path(), "arm.urdf", "twice.csv", &[], 3, &expected);
    let log = arm::log(0, Gap::None);
    let one: Vec<&str> = log.lines().take(2).collect();
    arm::write(folder.path(), "one.csv", &one.join("\n"));
    let expected = ["one.csv", "1 rows", "at least 2"];
    refused(folder.path(), "arm.urdf", "one.csv", &[], 3, &expected);
}

#[test]
fn joints_and_columns_that_do_not_fit_the_robot() {
    let folder = folder();
    let log = arm::log(0, Gap::None);
    arm::write(folder.path(), "other.csv", &log.replace("elbow.", "elbwo."));
    let expected = ["other.csv", "joint elbow", "elbow.position", "did you mean elbwo?", "help:"];
    refused(folder.path(), "arm.urdf", "other.csv", &[], 3, &expected);
    arm::write(folder.path(), "mute.csv", &log.replace("elbow.effort", "elbow.current"));
    let expected = ["mute.csv", "elbow.effort", "help:"];
    refused(folder.path(), "arm.urdf", "mute.csv", &[], 3, &expected);
    let expected = ["good.csv", "shoulder.effort_sensor"];
    let more = ["--effort", "effort_sensor"];
    refused(folder.path(), "arm.urdf", "good.csv", &more, 3, &expected);
    arm::write(folder.path(), "map.toml", "[joint.elbwo]\nposition = { column = \"q\" }\n");
    let expected = ["map.toml", "joint.elbwo", "did you mean elbow?"];
    refused(folder.path(), "arm.urdf", "good.csv", &["--map", "map.toml"], 3, &expected);
}

#[test]
fn degrees_where_radians_were_expected() {
    let folder = folder();
    let log = arm::log(0, Gap::None);
    let degrees = log.lines().enumerate().map(|(i, line)| {
        let field = |(column, text): (usize, &str)| match (i, column) {
            (1.., 1 | 2 | 4 | 5) => text.parse::<f64>().unwrap().to_degrees().to_string(),
            _ => text.to_owned(),
        };
        line.split(',').enumerate().map(field).collect::<Vec<String>>().join(",") + "\n"
    });
    arm::write(folder.path(), "degrees.csv", &degrees.collect::<String>());
    let expected = ["degrees.csv", "shoulder.position", "degrees", "radians", "help:"];
    refused(folder.path(), "arm.urdf", "degrees.csv", &[], 3, &expected);
}

#[test]
fn robots_that_are_none() {
    let folder = folder();
    let path = folder.path();
    let tail = "</robot>";
    let back = r#"<joint name="back" type="fixed"><parent link="fore"/><child link="upper"/></joint></robot>"#;
    arm::write(path, "loop.urdf", &arm::URDF.replace(tail, back));
    refused(path, "loop.urdf", "good.csv", &[], 3, &["loop.urdf", "upper"]);
    arm::write(
        path,
        "light.urdf",
        &arm::URDF.replace("<mass value=\"2\"/>", "<mass value=\"-2\"/>"),
    );
    let expected = ["light.urdf", "fore", "-2", "a positive number was expected"];
    refused(path, "light.urdf", "good.csv", &[], 3, &expected);
    arm::write(path, "cut.urdf", &arm::URDF[..400]);
    refused(path, "cut.urdf", "good.csv", &[], 3, &["cut.urdf", "line"]);
}

#[test]
fn an_output_folder_that_is_a_file() {
    let folder = folder();
    arm::write(folder.path(), "taken", "mine");
    let arguments = ["diagnose", "--robot", "arm.urdf", "--log", "good.csv", "--out", "taken"];
    let answer = run(folder.path(), &arguments);
    assert_eq!(answer.code, 2, "{}", answer.err);
    assert!(answer.err.contains("taken: it is a file"), "{}", answer.err);
    assert_eq!(fs::read_to_string(folder.path().join("taken")).unwrap(), "mine");
}

#[test]
fn a_log_in_the_place_of_the_robot_and_the_other_way_round() {
    let folder = folder();
    let kinds = "a robot is a URDF, an MJCF or a robot.toml";
    refused(folder.path(), "good.csv", "good.csv", &[], 3, &["good.csv", "help:", kinds]);
    refused(folder.path(), "arm.urdf", "arm.urdf", &[], 3, &["arm.urdf", "help:", kinds]);
}
