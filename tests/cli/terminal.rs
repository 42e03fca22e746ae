//! What a terminal would obey: names in files of every kind, printed on a terminal. `script` makes one.

use std::fs;
use std::path::Path;
use std::process::Command;
use std::sync::Arc;

use arrow_array::{ArrayRef, Float64Array, RecordBatch};
use parquet::arrow::ArrowWriter;
use serde_json::Value;

use crate::arm::{self, Gap};
use crate::program::{PROGRAM, run};

/// Names that would set the title, ring the bell, clear the screen, write over the line, or turn the direction.
const HOSTILE: [&str; 6] = [
    "a\u{1b}]0;owned\u{7}b",
    "a\u{1b}[2Jb",
    "a\u{9b}2Jb",
    "a\u{8}\u{8}b",
    "a\u{202e}b\u{2066}c",
    "a\u{1b}[8mb",
];

/// What of these names must not arrive at a terminal.
const OBEYED: [&str; 9] = [
    "\u{1b}]",
    "\u{7}",
    "\u{1b}[2J",
    "\u{9b}",
    "\u{8}",
    "\u{202e}",
    "\u{2066}",
    "\u{1b}[8m",
    "\r forged",
];

/// What arrives at a terminal; none where there is no `script` to make one.
fn on_a_terminal(folder: &Path, arguments: &[&str]) -> Option<String> {
    let quoted = arguments.iter().map(|word| format!("'{word}'")).collect::<Vec<_>>().join(" ");
    let mut script = Command::new("script");
    script.current_dir(folder).env("TERM", "xterm").args([
        "-qec",
        &format!("{PROGRAM} {quoted}"),
        "typescript",
    ]);
    let output = match script.output() {
        Ok(output) => output,
        Err(_) => {
            eprintln!("skipped: no program `script`, which makes a terminal");
            return None;
        }
    };
    Some(String::from_utf8_lossy(&output.stdout).into_owned())
}

/// A log of Parquet with a further column of this name.
fn parquet_log(path: &Path, name: &str) {
    let numbers = |from: f64| -> ArrayRef {
        Arc::new((0..400).map(|k| Some(from + f64::from(k) / 200.0)).collect::<Float64Array>())
    };
    let columns =
        ["time", "shoulder.position", "shoulder.effort", "elbow.position", "elbow.effort", name];
    let batch = RecordBatch::try_from_iter(columns.map(|name| (name, numbers(0.1)))).unwrap();
    let mut writer =
        ArrowWriter::try_new(fs::File::create(path).unwrap(), batch.schema(), None).unwrap();
    writer.write(&batch).unwrap();
    writer.close().unwrap();
}

/// A bag whose topic and one of whose joints have the name, as far as there is room in the pages of the database.
fn bag(name: &str) -> Vec<u8> {
    let golden = checks::arms::workspace_root().join("tests/golden/logs/sqlite_small_pages.db3");
    let mut bytes = fs::read(golden).unwrap();
    for old in [&b"/joint_states"[..], b"finger"] {
        let ends = name.char_indices().map(|(at, c)| at + c.len_utf8());
        let end = ends.take_while(|end| *end <= old.len()).last().unwrap_or_default();
        let new = format!("{}{}", &name[..end], "c".repeat(old.len() - end));
        let places: Vec<usize> =
            (0..bytes.len()).filter(|at| bytes[*at..].starts_with(old)).collect();
        assert!(!places.is_empty());
        places.into_iter().for_each(|at| bytes[at..at + old.len()].copy_from_slice(new.as_bytes()));
    }
    bytes
}

/// A name as an attribute of XML, control characters by their number.
fn in_xml(name: &str) -> String {
    let shown =
        |c: char| if c.is_ascii_control() { format!("&#{};", u32::from(c)) } else { c.to_string() };
    name.chars().map(shown).collect()
}

/// A name as a key of TOML, every character by its number.
fn in_toml(name: &str) -> String {
    let numbers: String = name.chars().map(|c| format!("\\U{:08X}", u32::from(c))).collect();
    format!("\"{numbers}\"")
}

/// Files with the name in every place where a file can have one.
fn folder(name: &str) -> tempfile::TempDir {
    let folder = arm::folder(Gap::None);
    let (path, xml) = (folder.path(), in_xml(name));
    arm::write(path, "hostile.urdf", &arm::URDF.replace("\"elbow\"", &format!("\"{xml}\"")));
    let mjcf = format!(
        "<mujoco model=\"{xml}\"><worldbody><body name=\"{xml}\"><joint name=\"{xml}\" type=\"hinge\"/>\
         <inertial pos=\"0 0 .1\" mass=\"1\" diaginertia=\"1 1 1\"/></body></worldbody></mujoco>"
    );
    arm::write(path, "hostile.xml", &mjcf);
    let toml =
        format!("urdf = \"arm.urdf\"\n[joint.{}]\nrotor_inertia_kg_m2 = 1.0\n", in_toml(name));
    arm::write(path, "hostile.toml", &toml);
    parquet_log(&path.join("hostile.parquet"), name);
    fs::write(path.join("hostile.db3"), bag(name)).unwrap();
    fs::copy(path.join("run_0.csv"), path.join(format!("{name}.csv"))).unwrap();
    folder
}

/// What commands that print the name show on a terminal.
fn shown(name: &str) -> Vec<(String, String)> {
    let folder = folder(name);
    let csv = format!("{name}.csv");
    let commands: [&[&str]; 14] = [
        &["log", "info", "hostile.parquet"],
        &["log", "info", "hostile.parquet", "--robot", "arm.urdf"],
        &["log", "info", "hostile.parquet", "--robot", "arm.urdf", "--json"],
        &["log", "info", "hostile.db3"],
        &["log", "info", "hostile.db3", "--topic", "none"],
        &["log", "info", &csv, "--robot", "arm.urdf"],
        &["log", "info", "run_0.csv", "--robot", "hostile.urdf"],
        &["log", "info", "run_0.csv", "--robot", "arm.urdf", "--map", &csv],
        &["robot", "check", "hostile.urdf"],
        &["robot", "check", "hostile.urdf", "--json"],
        &["robot", "check", "hostile.xml"],
        &["robot", "check", "hostile.toml"],
        &["robot", "check", &csv],
        &["explain", name],
    ];
    let shown =
        |command: &&[&str]| Some((command.join(" "), on_a_terminal(folder.path(), command)?));
    commands.iter().filter_map(shown).collect()
}

#[test]
fn a_terminal_obeys_no_name() {
    let mut broken = Vec::new();
    for name in HOSTILE {
        for (command, shown) in shown(name) {
            let obeyed = OBEYED.iter().filter(|obeyed| shown.contains(**obeyed));
            broken.extend(obeyed.map(|obeyed| format!("{obeyed:?} of {command:?}: {shown:?}")));
        }
    }
    assert!(broken.is_empty(), "{}", broken.join("\n"));
}

#[test]
fn styles_of_the_program_arrive_at_a_terminal() {
    let folder = arm::folder(Gap::None);
    let Some(shown) = on_a_terminal(folder.path(), &["robot", "check", "none.urdf"]) else {
        return;
    };
    assert!(shown.contains("\u{1b}[1m\u{1b}[31merror:\u{1b}[0m"), "{shown:?}");
}

#[test]
fn json_keeps_the_names_that_a_terminal_would_obey() {
    // XML has no other control characters.
    for name in HOSTILE.into_iter().filter(|name| !name.contains(|c: char| c.is_ascii_control())) {
        let folder = folder(name);
        let answer = run(folder.path(), &["robot", "check", "hostile.urdf", "--json"]);
        let json: Value = serde_json::from_str(&answer.out).unwrap();
        assert!(names_in(&json).contains(&name), "{name:?}: {json}");
        assert!(
            !answer.out.contains(|c: char| OBEYED.concat().contains(c)
                && !c.is_ascii_graphic()
                && c != ' '),
            "{}",
            answer.out
        );
    }
}

/// All strings of a JSON.
fn names_in(json: &Value) -> Vec<&str> {
    match json {
        Value::String(text) => vec![text],
        Value::Array(all) => all.iter().flat_map(names_in).collect(),
        Value::Object(all) => all.values().flat_map(names_in).collect(),
        _ => Vec::new(),
    }
}

#[test]
fn a_name_with_lines_writes_no_key_into_the_extended_robot() {
    let folder = arm::folder(Gap::Friction(2.0));
    let path = folder.path();
    let key = "gravity_m_per_s2 = [0.0, 0.0, -1.0]";
    let name = format!("elbow\n{key}\r{key}\r\n{key}\n#");
    let urdf = arm::URDF.replace("name=\"arm\"", &format!("name=\"{}\"", in_xml(&name)));
    let urdf = urdf.replace("\"elbow\"", &format!("\"{}\"", in_xml(&name)));
    arm::write(path, "hostile.urdf", &urdf);
    let columns =
        |joint: &str| format!("position = \"{joint}.position\"\neffort = \"{joint}.effort\"\n");
    let map = format!(
        "[joint.shoulder]\n{}[joint.{}]\n{}",
        columns("shoulder"),
        in_toml(&name),
        columns("elbow")
    );
    arm::write(path, "map.toml", &map);
    let logs = ["--log", "run_0.csv", "run_1.csv", "--map", "map.toml", "--out", "out"];
    let answer = run(path, &[&["diagnose", "--robot", "hostile.urdf"], &logs[..]].concat());
    assert!(answer.code <= 1, "{}", answer.err);
    let text = fs::read_to_string(path.join("out/extended.toml")).unwrap();
    let has_key = |line: &str| line.starts_with("gravity");
    assert!(!text.split(['\n', '\r']).any(has_key), "{text}");
    let checked = run(path, &["robot", "check", "out/extended.toml"]);
    assert!(checked.code <= 1, "{}", checked.err);
}
