//! Names that mean something to a format, in the TOML, JSON and HTML that commands write.

use std::fs;
use std::path::Path;

use checks::hostile_names::{HOSTILE_NAMES, held_by_xml, in_xml};

use crate::arm::{self, Gap};
use crate::program::run;

/// Parts of a page that only the page itself may have.
const OF_A_PAGE: [&str; 4] = ["<script", "</script", "<!--", "<a href"];

/// The arm under this name, with a base of this name.
fn named(folder: &Path, name: &str) {
    let urdf = arm::URDF.replace("name=\"arm\"", &format!("name=\"{}\"", in_xml(name)));
    arm::write(folder, "named.urdf", &urdf.replace("\"base\"", &format!("\"{}\"", in_xml(name))));
}

/// The names that the program's own reader of URDFs takes.
fn is_read(folder: &Path) -> bool {
    run(folder, &["robot", "check", "named.urdf"]).code == 0
}

fn table(path: &Path) -> toml::Table {
    let text = fs::read_to_string(path).unwrap();
    text.parse().map_err(|error| format!("{}: {error}\n{text}", path.display())).unwrap()
}

#[test]
fn what_robot_init_writes_says_the_same_for_every_name() {
    let folder = arm::folder(Gap::None);
    let written = |name: &str| {
        named(folder.path(), name);
        if !is_read(folder.path()) {
            return None;
        }
        let answer = run(folder.path(), &["robot", "init", "named.urdf", "--out", "described"]);
        assert_eq!(answer.code, 0, "{name:?}: {answer:?}");
        let files = ["robot.toml", "scenario.toml"];
        let tables = files.map(|file| table(&folder.path().join("described").join(file)));
        fs::remove_dir_all(folder.path().join("described")).unwrap();
        Some(tables)
    };
    let plain = written("plain");
    let read: Vec<_> =
        HOSTILE_NAMES.iter().filter_map(|name| Some((name, written(name)?))).collect();
    assert!(plain.is_some() && read.len() > 15, "{} names are read", read.len());
    for (name, tables) in read {
        assert_eq!(Some(tables), plain, "{name:?}");
    }
}

#[test]
fn what_diagnose_writes_has_the_same_parts_for_every_name() {
    let folder = arm::folder(Gap::Friction(1.0));
    let written = |name: &str| {
        named(folder.path(), name);
        let logs = ["--log", "run_0.csv", "run_1.csv", "--no-recording", "--quiet"];
        let answer =
            run(folder.path(), &[&["diagnose", "--robot", "named.urdf"][..], &logs].concat());
        assert!(answer.code <= 1, "{name:?}: {answer:?}");
        let out = folder.path().join("out/diagnose");
        let page = fs::read_to_string(out.join("report.html")).unwrap();
        let json = fs::read(out.join("diagnosis.json")).unwrap();
        let json: serde_json::Value = serde_json::from_slice(&json).unwrap();
        let mut extended = table(&out.join("extended.toml"));
        extended.remove("urdf");
        (OF_A_PAGE.map(|part| page.matches(part).count()), json["robot"].clone(), extended)
    };
    let is_of_one_line =
        |name: &&&str| !name.contains(char::is_control) && held_by_xml(name) == **name;
    let together: String = HOSTILE_NAMES.iter().filter(is_of_one_line).copied().collect();
    let (parts, _, extended) = written("plain");
    for name in [together.as_str(), "a\nb = 1\n#", "a\u{85}b\u{9b}c"] {
        let (found, robot, table) = written(name);
        assert_eq!((found, &table), (parts, &extended), "{name:?}");
        assert!(robot.to_string().contains('a'), "{robot}");
    }
}
