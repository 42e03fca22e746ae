//! Every bad log ends with one message that says where, what was found and what was expected.

use std::fs;

use logs::{ColumnMap, LogError, PrepareSettings, ReadOptions, prepare, read_run, write_parquet};
use robot::JointKind;

use crate::support::{Scratch, clock, follows, robot, run, two_joints};

const HEADER: &str = "time,j1.position,j1.effort,j2.position,j2.effort";

/// The message for a CSV file with the usual header and these rows.
fn csv(rows: &str) -> String {
    Scratch::new("run.csv", format!("{HEADER}\n{rows}")).message(&two_joints())
}

#[test]
fn a_good_file_is_read() {
    let file = Scratch::new("run.csv", format!("{HEADER}\n0,1,2,3,4\n0.1,1.5,2,3,4\n"));
    let read = file.read(&two_joints()).unwrap();
    assert_eq!(read.time, [0.0, 0.1]);
    assert_eq!(read.joints[0].position, [1.0, 1.5]);
    assert_eq!(read.joints[1].effort, [4.0, 4.0]);
}

#[test]
fn missing_file() {
    let file = Scratch::new("other.csv", "x");
    let result =
        read_run(&file.folder.path().join("run.csv"), &two_joints(), &ReadOptions::default());
    assert_eq!(file.told(result), "run.csv: there is no such file");
}

#[test]
fn directory() {
    let file = Scratch::new("other.csv", "x");
    let folder = file.folder.path().join("logs");
    fs::create_dir(&folder).unwrap();
    let result = read_run(&folder, &two_joints(), &ReadOptions::default());
    let expected = "logs: this is a directory, the file of a log was expected";
    assert_eq!(file.told(result), expected);
}

#[test]
fn empty_file() {
    let message = Scratch::new("run.csv", "").message(&two_joints());
    assert_eq!(message, "run.csv: the file is empty, a log was expected");
}

#[test]
fn truncated_parquet() {
    let time = clock(100, 100.0);
    let (j1, j2) = (follows("j1", &time, f64::sin), follows("j2", &time, f64::cos));
    let file = Scratch::new("run.parquet", "");
    write_parquet(&file.path, &run(time, vec![j1, j2])).unwrap();
    let whole = fs::read(&file.path).unwrap();
    assert!(file.read(&two_joints()).is_ok());
    for kept in [4, 5, 12, whole.len() / 2, whole.len() - 1] {
        fs::write(&file.path, &whole[..kept]).unwrap();
        let message = file.message(&two_joints());
        assert!(message.starts_with("run.parquet: not a whole Parquet file ("), "{message}");
        assert!(!message.contains('\n'), "{message}");
    }
}

#[test]
fn damaged_parquet_never_panics() {
    let time = clock(100, 100.0);
    let (j1, j2) = (follows("j1", &time, f64::sin), follows("j2", &time, f64::cos));
    let file = Scratch::new("run.parquet", "");
    write_parquet(&file.path, &run(time, vec![j1, j2])).unwrap();
    let whole = fs::read(&file.path).unwrap();
    let mut refused = 0;
    // Every third byte of the file's description, which is at its end.
    for position in (whole.len() - 1500..whole.len()).step_by(3) {
        let mut damaged = whole.clone();
        damaged[position] ^= 0x55;
        fs::write(&file.path, &damaged).unwrap();
        refused += usize::from(file.read(&two_joints()).is_err());
    }
    assert!(refused > 50, "{refused}");
}

#[test]
fn a_name_says_nothing_of_the_kind() {
    let message = Scratch::new("run.parquet", "time,j1.position\n").message(&two_joints());
    assert!(message.starts_with("run.parquet: there is no column j1.effort,"), "{message}");
    let message = Scratch::new("run.parquet", "\0\0\0\0").message(&two_joints());
    assert_eq!(
        message,
        "run.parquet: not a whole Parquet file (it does not begin with PAR1); \
         was it cut off while being copied?"
    );
}

#[test]
fn short_row() {
    let expected = "run.csv: row 2 has 3 fields, 5 were expected as in the header";
    assert_eq!(csv("0,1,2,3,4\n0.1,1,2\n"), expected);
}

#[test]
fn text_in_a_number() {
    let expected = "run.csv: row 2, column j2.position: found \"3,4\", a number was expected";
    assert_eq!(csv("0,1,2,3,4\n0.1,1,2,\"3,4\",4\n"), expected);
}

#[test]
fn missing_value() {
    let expected = "run.csv: row 2, column j1.effort: the value is missing, a number was expected";
    assert_eq!(csv("0,1,2,3,4\n0.1,1,,3,4\n"), expected);
}

#[test]
fn nan_and_infinity() {
    let nan = "run.csv: row 2, column j1.position: found NaN, a finite number was expected";
    assert_eq!(csv("0,1,2,3,4\n0.1,nan,2,3,4\n"), nan);
    let infinite = "run.csv: row 1, column j2.effort: found -inf, a finite number was expected";
    assert_eq!(csv("0,1,2,3,-inf\n0.1,1,2,3,4\n"), infinite);
}

#[test]
fn time_backwards_or_repeated() {
    let backwards =
        "run.csv: row 3, column time: time is 0.05 s after 0.1 s, it must increase from row to row";
    assert_eq!(csv("0,1,2,3,4\n0.1,1,2,3,4\n0.05,1,2,3,4\n"), backwards);
    let repeated =
        "run.csv: row 2, column time: time is 0 s after 0 s, it must increase from row to row";
    assert_eq!(csv("0,1,2,3,4\n0,1,2,3,4\n"), repeated);
}

#[test]
fn one_sample_or_none() {
    let one = "run.csv: 1 rows of data, at least 2 were expected";
    assert_eq!(csv("0,1,2,3,4\n"), one);
    assert_eq!(csv(""), "run.csv: 0 rows of data, at least 2 were expected");
}

#[test]
fn joint_of_the_robot_absent_from_the_log() {
    let file = Scratch::new("run.csv", "time,j1.position,j1.effort,j_2.position,j_2.effort\n");
    assert_eq!(
        file.message(&two_joints()),
        "run.csv: joint j2 of the robot is not in the log, a column j2.position was expected; \
         the log has j1, j_2; did you mean j_2?"
    );
}

#[test]
fn unknown_joint_beside_all_of_the_robot_is_a_warning() {
    let rows: String =
        (0..500).map(|k| format!("{},{},1,0,1,0\n", k as f64 * 0.01, k % 7)).collect();
    let header = "time,j1.position,j1.effort,j2.position,j2.effort,gripper.position";
    let file = Scratch::new("run.csv", format!("{header}\n{rows}"));
    let read = file.read(&two_joints()).unwrap();
    let prepared = prepare(&[read], &PrepareSettings { cutoff_hz: Some(5.0) }).unwrap();
    let warnings: Vec<String> = prepared.warnings.iter().map(ToString::to_string).collect();
    let expected = "run: joint gripper of the log is not in the robot, it is left out";
    assert!(warnings.contains(&expected.to_owned()), "{warnings:?}");
}

#[test]
fn no_effort_column() {
    let file = Scratch::new("run.csv", "time,j1.position,j1.efort,j2.position,j2.effort\n");
    assert_eq!(
        file.message(&two_joints()),
        "run.csv: there is no column j1.effort, the effort of joint j1 was expected there; \
         its columns are time, j1.position, j1.efort, j2.position, j2.effort; did you mean j1.efort?"
    );
    let options = ReadOptions { effort: "effort_sensor", ..ReadOptions::default() };
    let file = Scratch::new("run.csv", format!("{HEADER}\n0,1,2,3,4\n1,1,2,3,4\n"));
    let message = file.told(read_run(&file.path, &two_joints(), &options));
    assert!(message.starts_with("run.csv: there is no column j1.effort_sensor,"), "{message}");
}

#[test]
fn a_joint_without_an_effort_beside_one_that_has_it_is_named() {
    let header = "time,j1.position,j1.effort,j2.position,j2.velocity";
    let file = Scratch::new("run.csv", format!("{header}\n0,1,2,3,4\n1,1,2,3,4\n"));
    assert_eq!(
        file.message(&two_joints()),
        "run.csv: joint j2 has no effort: there is no column j2.effort; \
         its columns are time, j1.position, j1.effort, j2.position, j2.velocity"
    );
    let file = Scratch::new("run.csv", format!("{HEADER}\n0,1,2,3,NaN\n1,1,2,3,NaN\n"));
    let Err(LogError::EffortAbsent { joint, what, others, .. }) = file.read(&two_joints()) else {
        panic!("an effort without a number was read")
    };
    assert_eq!((joint.as_str(), others.as_ref()), ("j2", &["j1".to_owned()][..]));
    assert_eq!(&*what, "column j2.effort holds no number in 2 rows");
    // One that is not finite now and then is a mistake in that row.
    let file = Scratch::new("run.csv", format!("{HEADER}\n0,1,2,3,4\n1,1,2,3,NaN\n"));
    let message = file.message(&two_joints());
    assert!(message.contains("row 2, column j2.effort: found NaN"), "{message}");
}

#[test]
fn no_time_column() {
    let file = Scratch::new("run.csv", "times,j1.position,j1.effort\n");
    assert_eq!(
        file.message(&two_joints()),
        "run.csv: there is no column time, the time of every row (s) was expected; \
         its columns are times, j1.position, j1.effort; did you mean times?"
    );
}

#[test]
fn two_columns_of_one_name() {
    let file = Scratch::new("run.csv", "time,j1.position,j1.position\n");
    let expected = "run.csv: two columns are called j1.position, names must be unique";
    assert_eq!(file.message(&two_joints()), expected);
}

#[test]
fn degrees_beyond_the_limits() {
    assert_eq!(
        csv("0,1,2,3,4\n0.1,-87.5,2,3,4\n0.2,20,2,3,4\n"),
        "run.csv: column j1.position, row 2: found -87.5, but joint j1 is limited to -2.9 .. 2.9 rad; \
         this looks like degrees where radians were expected: convert it, \
         or give the column its unit in a column map"
    );
}

/// A counter that wraps leaves the limits, and is no log in degrees.
#[test]
fn a_jump_by_a_turn_is_not_degrees() {
    let told = |written: fn(f64) -> f64| {
        let at = |k: u32| (0.01 * f64::from(k), (0.02 * f64::from(k)).sin());
        let rows = (0..400).map(at).map(|(t, q)| format!("{t},{},0,0,0\n", written(q)));
        let file = Scratch::new("run.csv", format!("{HEADER}\n{}", rows.collect::<String>()));
        read_run(&file.path, &two_joints(), &ReadOptions::default()).map_err(|e| e.to_string())
    };
    let wrapped = told(|q| if q > 0.5 { q + std::f64::consts::TAU } else { q });
    assert!(wrapped.is_ok(), "{wrapped:?}");
    let degrees = told(f64::to_degrees).unwrap_err();
    assert!(degrees.contains("looks like degrees"), "{degrees}");
}

#[test]
fn degrees_against_the_velocity_column() {
    let arm = robot(&[("j1", JointKind::Continuous)]);
    let rows: String = (0..100)
        .map(|k| f64::from(k) * 0.01)
        .map(|t| {
            format!("{t},{},{},0\n", 3.0 * (2.0 * t).sin(), 6.0_f64.to_radians() * (2.0 * t).cos())
        })
        .collect();
    let file = Scratch::new("run.csv", format!("time,j1.position,j1.velocity,j1.effort\n{rows}"));
    let message = file.message(&arm);
    assert!(message.contains("has a velocity column that is pi/180 times"), "{message}");
}

#[test]
fn degrees_against_the_speed_limit() {
    let arm = robot(&[("j1", JointKind::Continuous)]);
    let turning = |speed: f64| {
        let rows: String = (0..100)
            .map(|k| format!("{},{},0\n", f64::from(k) * 0.1, f64::from(k) * 0.1 * speed))
            .collect();
        Scratch::new("run.csv", format!("time,j1.position,j1.effort\n{rows}"))
    };
    let message = turning(60.0).message(&arm);
    assert!(
        message.contains("is limited to 2 rad/s and would mostly be above 60.0 rad/s"),
        "{message}"
    );
    // Three turns at an allowed speed are no degrees.
    assert!(turning(1.9).read(&arm).is_ok());
}

#[test]
fn a_link_in_degrees_beside_its_motor_in_radians() {
    let arm = robot(&[("j1", JointKind::Continuous)]);
    let log = |scale: f64| {
        let row = |k: i32| {
            let q = (0.1 * f64::from(k)).sin();
            format!("{k},{q},0,{}\n", scale * (q - 0.002))
        };
        let rows: String = (0..100).map(row).collect();
        Scratch::new("run.csv", format!("time,j1.position,j1.effort,j1.link_position\n{rows}"))
    };
    let message = log(1.0_f64.to_degrees()).message(&arm);
    assert!(message.starts_with("run.csv: column j1.link_position, row "), "{message}");
    assert!(
        message.contains("j1 has a position column that is pi/180 times this one"),
        "{message}"
    );
    // A gear ratio that is wrong, even by much, is for a diagnosis to find.
    assert!(log(20.0).read(&arm).is_ok() && log(-1.0).read(&arm).is_ok());
}

#[test]
fn a_link_position_that_is_missing_in_a_row() {
    let content = "time,j1.position,j1.effort,j1.link_position\n0,1,2,1\n1,1,2,nan\n";
    let file = Scratch::new("run.csv", content);
    let expected = "run.csv: row 2, column j1.link_position: ";
    assert!(file.message(&robot(&[("j1", JointKind::Revolute)])).starts_with(expected));
}

#[test]
fn positions_a_little_beyond_the_limits_are_read() {
    let file = Scratch::new("run.csv", format!("{HEADER}\n0,3.2,2,3,4\n0.1,3.3,2,3,4\n"));
    assert!(file.read(&two_joints()).is_ok());
}

#[test]
fn too_short_for_the_filter() {
    let time = clock(100, 100.0);
    let short = run(time.clone(), vec![follows("j1", &time, f64::sin)]);
    let error = prepare(&[short], &PrepareSettings { cutoff_hz: Some(2.0) }).unwrap_err();
    assert_eq!(
        error.to_string(),
        "run: its longest piece without a gap is 0.990 s, at least 2.250 s were expected \
         (4.5 periods of the 2.00 Hz cut-off)"
    );
}

#[test]
fn runs_that_cannot_be_prepared_together() {
    let settings = PrepareSettings::default();
    assert_eq!(prepare(&[], &settings), Err(LogError::NoRuns));
    let time = clock(500, 100.0);
    let one = run(time.clone(), vec![follows("j1", &time, f64::sin)]);
    let other = run(time.clone(), vec![follows("j2", &time, f64::sin)]);
    assert_eq!(
        prepare(&[one.clone(), other], &settings).unwrap_err().to_string(),
        "run: its joints are j2, but those of run are j1"
    );
    let mut ragged = one.clone();
    ragged.joints[0].effort.pop();
    assert_eq!(
        prepare(&[ragged], &settings).unwrap_err().to_string(),
        "run: j1.effort has 499 samples, 500 were expected as in time"
    );
    let expected = LogError::CutoffOutOfRange { found_hz: 50.0, nyquist_hz: 50.0 };
    assert_eq!(prepare(&[one], &PrepareSettings { cutoff_hz: Some(50.0) }), Err(expected));
}

/// The message of a column map used on the robot with joints `j1` and `j2`.
fn map(text: &str) -> String {
    let map = Scratch::new("map.toml", text);
    map.told(ColumnMap::load(&map.path).and_then(|m| m.for_robot(&two_joints())))
}

#[test]
fn column_map_with_a_joint_the_robot_does_not_have() {
    let expected =
        "map.toml: [joint.j11]: the robot has no such joint, it has j1, j2; did you mean j1?";
    assert_eq!(map("[joint.j11]\nposition = { column = \"q\" }\n"), expected);
}

#[test]
fn column_map_with_a_unit_of_another_quantity() {
    assert_eq!(
        map("[joint.j1]\nposition = { column = \"q\", unit = \"deg/s\" }\n"),
        "map.toml: joint.j1.position: found the unit \"deg/s\", a unit of angle (rad, deg, rev, raw) was expected"
    );
    assert!(map("time = { column = \"t\", unit = \"raw\" }\n").contains("a unit of time"));
}

#[test]
fn column_map_with_unknown_keys_units_or_numbers() {
    assert!(map("tiem = { column = \"t\" }\n").contains("unknown key `tiem`"));
    assert!(map("time = { column = \"t\", unit = \"h\" }\n").contains("`h`"));
    assert!(map("time = { column = \"t\", scale = 0.0 }\n").contains("found scale 0 and offset 0"));
    assert!(map("time = { column = \"t\", offset = nan }\n").contains("offset NaN"));
}

#[test]
fn column_map_that_names_a_column_the_log_does_not_have() {
    let map = Scratch::new("map.toml", "[joint.j1]\nvelocity = { column = \"speed\" }\n");
    let map = ColumnMap::load(&map.path).unwrap();
    let file = Scratch::new("run.csv", format!("{HEADER}\n0,1,2,3,4\n1,1,2,3,4\n"));
    let options = ReadOptions { map: Some(&map), ..ReadOptions::default() };
    assert_eq!(
        file.told(read_run(&file.path, &two_joints(), &options)),
        "run.csv: there is no column speed, the column map names it for the velocity of joint j1; \
         its columns are time, j1.position, j1.effort, j2.position, j2.effort"
    );
}
