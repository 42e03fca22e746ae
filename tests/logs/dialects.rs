//! Logs as text, as other programs write them.

use logs::{ColumnMap, ReadOptions, read_run};
use robot::JointKind;

use crate::kinds::given;
use crate::support::{Scratch, robot, two_joints};

/// Time, positions and efforts of the two joints, as a log of this text has them.
fn read(text: impl AsRef<[u8]>) -> Vec<Vec<f64>> {
    let run = Scratch::new("run.csv", text).read(&two_joints()).unwrap();
    let [one, two] = [&run.joints[0], &run.joints[1]];
    vec![
        run.time.clone(),
        one.position.clone(),
        one.effort.clone(),
        two.position.clone(),
        two.effort.clone(),
    ]
}

#[test]
fn the_same_numbers_are_read_from_every_dialect() {
    let expected = [[0.0, 0.5], [1.25, 1.5], [-2.0, 0.002], [0.25, 0.5], [4.0, -4.5]];
    let names = "time,j1.position,j1.effort,j2.position,j2.effort";
    let rows = "0,1.25,-2,0.25,4\n0.5,1.5,2e-3,0.5,-4.5\n";
    let points = format!("{names}\n{rows}");
    let commas = |separator: &str| points.replace(',', separator).replace('.', ",");
    let named = |text: String| text.replace("j1,", "j1.").replace("j2,", "j2.");
    let texts = [
        points.clone(),
        points.replace('\n', "\r\n"),
        points.replace('\n', ",\n"),
        points.replace(rows, &rows.replace('\n', ",\n")),
        points.replace(',', ", "),
        points.replace(',', ";"),
        points.replace(',', "\t"),
        points.replace(',', " "),
        points.replace(',', "   ").replace("\n0", "\n  0"),
        named(commas(";")),
        named(commas("\t")),
        named(commas(" ")),
        format!("\u{feff}{points}"),
        format!("\u{feff}\"{}\"\n{rows}", names.replace(',', "\",\"")),
        format!("# {}", points.replace(',', " ")),
        format!("# an arm, at noon\n%{points}"),
        format!("{points}\n\n"),
    ];
    for text in texts {
        assert_eq!(read(&text), expected, "{text}");
    }
}

#[test]
fn a_name_in_latin_1_is_no_obstacle() {
    let text =
        b"time;j1.position;j1.effort;j2.position;j2.effort;gr\xf6\xdfe\n0;1;2;3;4;5\n1;1;2;3;4;5\n";
    assert_eq!(read(text)[0], [0.0, 1.0]);
}

#[test]
fn points_beside_commas_in_one_column_are_refused() {
    let text = "time;j1.position;j1.effort;j2.position;j2.effort\n0;1,5;2;3;4\n1;1.5;2;3;4\n";
    assert_eq!(
        Scratch::new("run.csv", text).message(&two_joints()),
        "run.csv: row 2, column j1.position: found \"1.5\", a number was expected"
    );
}

#[test]
fn a_log_without_names_asks_for_a_map_and_is_read_with_one() {
    let file = Scratch::new("run.txt", "0 1.5 2\n1 1.6 3\n2 1.7 4\n");
    let arm = robot(&[("j1", JointKind::Revolute)]);
    assert_eq!(
        file.message(&arm),
        "run.txt: its columns have no names; they are called column_1 to \
         column_3, a column map that says which is which was expected"
    );
    let map = Scratch::new(
        "map.toml",
        "time = { column = \"column_1\" }\n[joint.j1]\nposition = { column = \"column_2\" }\n\
         effort = { column = \"column_3\" }\n",
    );
    let map = ColumnMap::load(&map.path).unwrap();
    let options = ReadOptions { map: Some(&map), ..ReadOptions::default() };
    let run = read_run(&file.path, &arm, &options).unwrap();
    assert_eq!((run.time[0], run.joints[0].position[2], run.joints[0].effort[2]), (0.0, 1.7, 4.0));
}

#[test]
fn rows_of_another_topic_are_left_out() {
    let header = "time,j1.position,j1.effort,j2.position,j2.effort,command";
    let rows = "0,1,2,3,4,\n0.05,,,,,7\n0.1,1,2,3,4,\n0.15,,,,,8\n0.2,nan,2,3,4,\n";
    let file = Scratch::new("run.csv", format!("{header}\n{rows}"));
    let expected = "run.csv: row 5, column j1.position: found NaN, a finite number was expected";
    assert_eq!(file.message(&two_joints()), expected, "rows keep their numbers");
    let file = Scratch::new("run.csv", format!("{header}\n{}", rows.replace("nan", "1")));
    let run = file.read(&two_joints()).unwrap();
    assert_eq!(run.time, [0.0, 0.1, 0.2]);
    assert!(run.extra.is_empty(), "a column that rows lack is not kept");
    let file = Scratch::new("run.csv", format!("{header}\n0,1,2,3,4,\n0.1,1,,,,\n"));
    let expected = "run.csv: row 2, column j1.effort: the value is missing, a number was expected";
    assert_eq!(file.message(&two_joints()), expected);
}

/// The arm of the given files.
fn ur5() -> robot::Robot {
    let names = ["shoulder_pan", "shoulder_lift", "elbow", "wrist_1", "wrist_2", "wrist_3"];
    let joints = names.map(|name| (format!("{name}_joint"), JointKind::Revolute));
    robot(&joints.each_ref().map(|(name, kind)| (name.as_str(), *kind)))
}

#[test]
fn given_files_are_read() {
    for (log, map, rows) in [
        ("ur_rtde.csv", "ur_rtde.map.toml", 600),
        ("plotjuggler.csv", "pj.map.toml", 250),
        ("libfranka.csv", "franka.map.toml", 300),
    ] {
        let Some((log, map)) = given(log).zip(given(map)) else { continue };
        let map = ColumnMap::load(&map).unwrap();
        let options = ReadOptions { map: Some(&map), ..ReadOptions::default() };
        let run = read_run(&log, &ur5(), &options).unwrap();
        assert_eq!(run.time.len(), rows, "{}", log.display());
        assert!((run.joints[0].position[1] - 1.449495).abs() < 1e-12);
        assert!((run.joints[1].effort[0] + 71.242778).abs() < 1e-3);
        assert!((run.time[1] - run.time[0] - 0.008).abs() < 1e-6);
    }
}
