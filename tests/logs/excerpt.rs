//! Logs of which some seconds are read.

use logs::{ColumnMap, Excerpt, ReadOptions, Run, read_run, run_of_columns, write_parquet};

use crate::support::{Scratch, clock, follows, golden, run, two_joints};

/// Rows at 0.25 and 0.375 s of files whose rows are 0.125 s apart.
const MIDDLE: Excerpt = Excerpt { from_s: 0.25, to_s: 0.375 };

/// Files of other kinds, and whether they are read with the map.
const GOLDEN: [(&str, bool); 3] =
    [("numpy_plain.npz", true), ("matlab_plain.mat", true), ("mcap_one_topic.mcap", false)];

fn read(file: &Scratch, excerpt: Option<Excerpt>, map: Option<&ColumnMap>) -> Result<Run, String> {
    let options = ReadOptions { map, excerpt, ..ReadOptions::default() };
    let read = read_run(&file.path, &two_joints(), &options);
    read.map_err(|error| file.told::<Run>(Err(error)))
}

/// The rows of a whole run that lie in the middle.
fn assert_middle(part: &Run, whole: &Run) {
    assert_eq!(part.time, whole.time[2..4]);
    for (part, whole) in part.joints.iter().zip(&whole.joints) {
        assert_eq!(part.position, whole.position[2..4]);
        assert_eq!(part.effort, whole.effort[2..4]);
    }
}

/// Five rows that begin at 100 s; `row` is in the place of the last.
fn csv(row: &str) -> String {
    let mut text = "time,j1.position,j1.effort,j2.position,j2.effort\n".to_owned();
    for k in 0..5 {
        let whole = format!("{},0.{k},{k},1.{k},-{k}", 100.0 + 0.125 * f64::from(k));
        text.push_str(if k == 4 { row } else { &whole });
        text.push('\n');
    }
    text
}

const LAST: &str = "100.5,0.4,4,1.4,-4";

#[test]
fn of_every_kind_of_file_the_seconds_that_are_asked_for_are_read() {
    let map = "position = \"q[:]\"\neffort = \"tau[:]\"\n";
    let map = ColumnMap::load(&Scratch::new("map.toml", map).path).unwrap();
    for (name, map) in GOLDEN.map(|(name, is_mapped)| (name, is_mapped.then_some(&map))) {
        let file = Scratch::new(name, golden(name));
        let whole = read(&file, None, map).unwrap();
        assert_eq!(whole.time.len(), 5, "{name}");
        assert_middle(&read(&file, Some(MIDDLE), map).unwrap(), &whole);
    }
    let file = Scratch::new("run.csv", csv(LAST));
    assert_middle(&read(&file, Some(MIDDLE), None).unwrap(), &read(&file, None, None).unwrap());

    let columns = ["time", "j1.position", "j1.effort", "j2.position", "j2.effort"];
    let columns = columns.map(|name| (name.to_owned(), clock(5, 8.0)));
    let options = ReadOptions { excerpt: Some(MIDDLE), ..ReadOptions::default() };
    let part = run_of_columns("arrays", columns.into(), &two_joints(), &options).unwrap();
    assert_eq!(part.time, [0.25, 0.375]);
}

/// More rows than are decoded at once, so that the excerpt begins and ends within batches and leaves some out.
#[test]
fn an_excerpt_of_a_long_table_is_a_stretch_of_it() {
    let time = clock(20_000, 100.0);
    let joints = ["j1", "j2"].map(|name| follows(name, &time, |t| (0.1 * t).sin()));
    let whole = run(time, joints.into());
    let file = Scratch::new("run.parquet", "");
    write_parquet(&file.path, &whole).unwrap();
    let part = read(&file, Some(Excerpt { from_s: 50.0, to_s: 130.0 }), None).unwrap();
    assert_eq!(part.time, whole.time[5000..=13_000]);
    assert_eq!(part.joints[1].effort, whole.joints[1].effort[5000..=13_000]);
    let rest = read(&file, Some(Excerpt { from_s: 199.5, to_s: f64::INFINITY }), None).unwrap();
    assert_eq!(rest.joints[0].position, whole.joints[0].position[19_950..]);
}

#[test]
fn rows_outside_are_not_looked_at_and_rows_inside_keep_their_numbers() {
    for damaged in ["100.5,0.4,x,1.4,-4", "100.5,0.4,,1.4,-4", "100.5,nan,4,1.4,-4"] {
        let file = Scratch::new("run.csv", csv(damaged));
        assert!(read(&file, None, None).is_err(), "{damaged}");
        let part = read(&file, Some(MIDDLE), None).unwrap();
        assert_eq!(part.time, [100.25, 100.375], "{damaged}");
        let told = read(&file, Some(Excerpt { from_s: 0.25, to_s: 0.5 }), None).unwrap_err();
        assert!(told.contains("row 5, column j1."), "{told}");
    }
}

#[test]
fn an_excerpt_without_two_rows_is_refused_with_its_seconds() {
    let file = Scratch::new("run.csv", csv(LAST));
    let told =
        |from_s: f64, to_s: f64| read(&file, Some(Excerpt { from_s, to_s }), None).unwrap_err();
    let expected =
        "run.csv, from 0.5 s on after its first row: 1 rows of data, at least 2 were expected";
    assert_eq!(told(0.5, f64::INFINITY), expected);
    let expected =
        "run.csv, from 3 s to 1 s after its first row: 0 rows of data, at least 2 were expected";
    assert_eq!(told(3.0, 1.0), expected);
}
