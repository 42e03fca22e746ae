//! Logs as arrays of MATLAB.

use std::fs;

use logs::{ColumnMap, LogError, ReadOptions, Run, read_run, recognise};
use robot::JointKind;

use crate::kinds::given;
use crate::support::{Scratch, assert_golden, golden, robot, two_joints};

const MAP: &str = "position = \"q[:]\"\neffort = \"tau[:]\"\n";

fn map(text: &str) -> ColumnMap {
    ColumnMap::load(&Scratch::new("map.toml", text).path).unwrap()
}

fn read(bytes: impl AsRef<[u8]>, map_text: &str) -> Result<Run, LogError> {
    let map = map(map_text);
    let options = ReadOptions { map: Some(&map), ..ReadOptions::default() };
    read_run(&Scratch::new("run", bytes).path, &two_joints(), &options)
}

#[test]
fn arrays_of_a_mat_file_are_columns_by_their_names() {
    let run = read(golden("matlab_plain.mat"), MAP).unwrap();
    assert_golden(&run);
    assert!(run.extra.is_empty(), "{:?}", run.extra.keys());
    let run = read(golden("matlab73_plain.mat"), MAP).unwrap();
    assert_golden(&run);
    assert!(run.extra.is_empty(), "{:?}", run.extra.keys());
}

#[test]
fn arrays_that_lie_the_other_way_packed_and_of_other_types_are_the_same() {
    let run = read(golden("matlab_packed.mat"), MAP).unwrap();
    assert_golden(&run);
    assert_eq!(run.extra["temperature"], [20.0, 21.0, 22.0, 23.0, 24.0]);
    let run = read(golden("matlab73_packed.mat"), MAP).unwrap();
    assert_golden(&run);
    assert_eq!(run.extra["temperature"], [20.0, 21.0, 22.0, 23.0, 24.0]);
    assert_eq!(run.extra["on"], [0.0, 0.0, 0.0, 1.0, 1.0]);
}

#[test]
fn fields_of_structures_are_named_behind_them() {
    let within = "time = \"log.time\"\nposition = \"log.arm.q[:]\"\neffort = \"log.arm.tau[:]\"\n";
    assert_golden(&read(golden("matlab_struct.mat"), within).unwrap());
    assert_golden(&read(golden("matlab73_struct.mat"), within).unwrap());
}

/// Its last kilobytes are free.
#[test]
fn a_file_of_matlab_7_3_that_is_cut_off_is_told() {
    let bytes = golden("matlab73_packed.mat");
    let mut refused = 0;
    for cut in (512..bytes.len()).step_by(97) {
        match read(&bytes[..cut], MAP) {
            Ok(run) => assert_golden(&run),
            Err(error) => {
                let told = error.to_string();
                assert!(told.contains("not a whole MATLAB file"), "cut at {cut}: {told}");
                refused += 1;
            }
        }
    }
    assert!(refused > 50, "{refused} refused");
}

#[test]
fn an_array_of_another_length_is_told() {
    let map = "time = \"q[0]\"\nposition = \"q[:]\"\neffort = [\"tau[0]\", \"picture\"]\n";
    let error = read(golden("matlab_plain.mat"), map).unwrap_err().to_string();
    assert!(error.contains("there is no column picture"), "{error}");
}

/// 120 MB of zeros in 117 kB, a chunk of 100 MB in 104 kB, and 8 GB that were never written.
#[test]
fn a_file_that_was_made_to_be_large_is_refused() {
    for name in ["matlab_bomb.mat", "matlab73_bomb.mat", "matlab73_large.mat"] {
        let error = read(golden(name), MAP).unwrap_err().to_string();
        assert!(error.contains("more than is allowed of a file of this size"), "{name}: {error}");
    }
}

#[test]
fn the_given_file_is_recognised_and_read() {
    let Some(path) = given("log.mat") else { return };
    let joints: Vec<String> = (0..6).map(|k| format!("j{k}")).collect();
    let joints: Vec<_> = joints.iter().map(|name| (name.as_str(), JointKind::Revolute)).collect();
    let arm = robot(&joints);
    for copied in ["run.mat", "run.csv"] {
        let file = Scratch::new(copied, fs::read(&path).unwrap());
        let found = recognise(&file.path, &arm, None, &ReadOptions::default()).unwrap().unwrap();
        assert_eq!(found.name, "numpy");
        let options = ReadOptions { map: Some(&found.map), ..ReadOptions::default() };
        let run = read_run(&file.path, &arm, &options).unwrap();
        assert_eq!(run.time.len(), 600);
        assert!((run.joints[0].position[1] - 1.449495).abs() < 1e-6);
        assert!(run.joints[5].velocity.is_some());
    }
}
