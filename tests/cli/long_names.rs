//! Names and numbers of hundreds of characters in files of every kind, and the messages that quote them.

use std::fs;
use std::path::Path;
use std::sync::Arc;

use arrow_array::{ArrayRef, Float64Array, RecordBatch};
use files::{MESSAGE, WORD};
use parquet::arrow::ArrowWriter;

use crate::arm::{self, Gap};
use crate::program::run;

/// Names of one word, of many, and of digits alone.
fn names() -> [String; 4] {
    [
        "9".repeat(250),
        format!("q_{}", "x".repeat(5000)),
        "a long name ".repeat(700),
        "é".repeat(400),
    ]
}

/// A log of Parquet with columns of a time and of this name.
fn parquet_log(path: &Path, name: &str) {
    let numbers =
        || -> ArrayRef { Arc::new((0..40).map(|k| Some(f64::from(k))).collect::<Float64Array>()) };
    let columns = ["time".to_owned(), format!("{name}.position"), format!("{name}.effort")];
    let batch = RecordBatch::try_from_iter(columns.map(|name| (name, numbers()))).unwrap();
    let mut writer =
        ArrowWriter::try_new(fs::File::create(path).unwrap(), batch.schema(), None).unwrap();
    writer.write(&batch).unwrap();
    writer.close().unwrap();
}

/// Robots with the name where it goes wrong.
fn robots(name: &str) -> Vec<(&'static str, String)> {
    let digits = "9".repeat(300);
    let joint = |to: &str| arm::URDF.replace("\"elbow\"", to);
    vec![
        ("joint.urdf", joint(&format!("\"{name}\"")).replace("revolute", "planar")),
        (
            "link.urdf",
            arm::URDF.replace("\"fore\"", &format!("\"{name}\"")).replace("\"2\"", "\"-1\""),
        ),
        ("mass.urdf", arm::URDF.replace("\"2\"", "\"1e300\"")),
        ("digits.urdf", arm::URDF.replace("\"2\"", &format!("\"{digits}x\""))),
        ("type.urdf", arm::URDF.replace("\"revolute\"", &format!("\"{name}\""))),
        ("mimic.urdf", arm::URDF.replace("<axis", &format!("<mimic joint=\"{name}\"/><axis"))),
        ("key.toml", format!("urdf = \"arm.urdf\"\n\"{name}\" = 1\n")),
        ("value.toml", format!("urdf = \"arm.urdf\"\ngravity_m_per_s2 = \"{name}\"\n")),
        (
            "joint.toml",
            format!("urdf = \"arm.urdf\"\n[joint.\"{name}\"]\nrotor_inertia_kg_m2 = 1.0\n"),
        ),
        (
            "number.toml",
            format!("urdf = \"arm.urdf\"\n[joint.elbow]\nrotor_inertia_kg_m2 = -{digits}.0\n"),
        ),
        ("file.toml", format!("urdf = \"{name}\"\n")),
        (
            "body.xml",
            format!(
                "<mujoco><worldbody><body name=\"{name}\"><joint name=\"{name}\" type=\"{name}\"/></body></worldbody></mujoco>"
            ),
        ),
    ]
}

/// Files with the name where they go wrong, and the commands that say so.
fn refused(folder: &Path, name: &str) -> Vec<(String, Vec<String>)> {
    let digits = "9".repeat(300);
    let log = arm::log(0, Gap::None);
    let row = |from: &str, to: &str| log.replacen(from, to, 1);
    let logs = [
        ("absent.csv", row("elbow.position", name)),
        ("twice.csv", row("time,", &format!("time,{name},{name},"))),
        ("other.csv", row("elbow.", &format!("{name}."))),
        ("text.csv", row("\n0.005,", &format!("\n0.005{name},"))),
        ("clock.csv", row("\n0.005,", "\n1e300,")),
        ("size.csv", row("\n0.005,", &format!("\n0.005,{digits}"))),
    ];
    let robots = robots(name);
    let maps = [
        (
            "joint.map",
            format!("time = \"time\"\n[joint.\"{name}\"]\nposition = \"elbow.position\"\n"),
        ),
        ("column.map", format!("time = \"{name}\"\n")),
        ("unit.map", format!("time = {{ column = \"time\", unit = \"{name}\" }}\n")),
    ];
    let scenarios = [
        (
            "joint.scenario",
            format!(
                "robot = \"arm.urdf\"\n[[run]]\nname = \"{name}\"\nmotion.hold = {{ joint = \"{name}\" }}\n"
            ),
        ),
        ("robot.scenario", format!("robot = \"{name}\"\n")),
    ];
    parquet_log(&folder.join("absent.parquet"), name);
    for (file, content) in logs.iter().chain(&robots).chain(&maps).chain(&scenarios) {
        arm::write(folder, file, content);
    }
    let words = |text: String| text.split(' ').map(str::to_owned).collect::<Vec<_>>();
    let mut commands = vec![words("log info absent.parquet --robot arm.urdf".to_owned())];
    commands
        .extend(logs.iter().map(|(file, _)| words(format!("log info {file} --robot arm.urdf"))));
    commands
        .push(words("diagnose --robot arm.urdf --log clock.csv run_1.csv --out out".to_owned()));
    commands.extend(robots.iter().map(|(file, _)| words(format!("robot check {file}"))));
    commands.extend(
        maps.iter()
            .map(|(file, _)| words(format!("log info run_0.csv --robot arm.urdf --map {file}"))),
    );
    commands.extend(scenarios.iter().map(|(file, _)| words(format!("simulate {file} --out out"))));
    commands.push(vec!["explain".to_owned(), name.to_owned()]);
    commands.into_iter().map(|words| (words.join(" ").chars().take(60).collect(), words)).collect()
}

/// Most characters of a line of a file that is shown with what is wrong in it.
const SHOWN_LINE: usize = 400;

/// Whether a line shows one of a file, or underlines a part of it: ` 12 | urdf = "arm.urdf"`.
fn is_of_a_file(line: &str) -> bool {
    line.trim_start_matches(|c: char| c.is_ascii_digit() || c == ' ').starts_with('|')
}

/// What is wrong with a message.
fn too_long(message: &str) -> Option<String> {
    let (of_files, words): (Vec<&str>, Vec<&str>) =
        message.lines().partition(|line| is_of_a_file(line));
    let length = |text: &str| text.chars().count();
    let line = of_files.into_iter().map(length).max().unwrap_or(0);
    let is_end = |c: char| c.is_whitespace() || matches!(c, ',' | '/');
    let word = words.iter().flat_map(|line| line.split(is_end)).map(length).max().unwrap_or(0);
    let all = length(message);
    // An error with advice is two messages; styles, `error:` and `help:` stand before them.
    let is_long = word > WORD + 10 || line > SHOWN_LINE || all > 2 * MESSAGE + 100;
    is_long.then(|| format!("{word} characters in a word, {line} in a line, {all} in all"))
}

#[test]
fn no_message_is_as_long_as_the_names_that_it_quotes() {
    let folder = arm::folder(Gap::None);
    let mut broken = Vec::new();
    let (mut refusals, mut quoted) = (0, 0);
    for name in names() {
        for (command, words) in refused(folder.path(), &name) {
            let words: Vec<&str> = words.iter().map(String::as_str).collect();
            let answer = run(folder.path(), &words);
            refusals += usize::from(answer.code > 1);
            quoted += usize::from(answer.err.contains('…'));
            broken.extend(
                too_long(&answer.err).map(|what| format!("{command}: {what}: {}", answer.err)),
            );
        }
    }
    assert!(broken.is_empty(), "{}", broken.join("\n"));
    assert!(refusals > 60 && quoted > 40, "{refusals} refusals, {quoted} with a name that is cut");
}
