//! Logs as arrays of HDF5.

use logs::{ColumnMap, LogError, ReadOptions, Run, read_run};

use crate::support::{Scratch, assert_golden, golden, two_joints};

const MAP: &str = "position = \"q[:]\"\neffort = \"tau[:]\"\n";

fn read(bytes: impl AsRef<[u8]>, map_text: &str) -> Result<Run, LogError> {
    let map = ColumnMap::load(&Scratch::new("map.toml", map_text).path).unwrap();
    let options = ReadOptions { map: Some(&map), ..ReadOptions::default() };
    read_run(&Scratch::new("run", bytes).path, &two_joints(), &options)
}

#[test]
fn arrays_of_a_file_are_columns_by_their_names() {
    let run = read(golden("hdf5_plain.h5"), MAP).unwrap();
    assert_golden(&run);
    assert!(run.extra.is_empty(), "{:?}", run.extra.keys());
}

#[test]
fn arrays_that_lie_the_other_way_packed_and_of_other_types_are_the_same() {
    let run = read(golden("hdf5_packed.h5"), MAP).unwrap();
    assert_golden(&run);
    assert_eq!(run.extra["temperature"], [20.0, 21.0, 22.0, 23.0, 24.0]);
}

#[test]
fn arrays_in_groups_are_named_behind_them() {
    let within = "time = \"log.time\"\nposition = \"log.arm.q[:]\"\neffort = \"log.arm.tau[:]\"\n";
    assert_golden(&read(golden("hdf5_groups.h5"), within).unwrap());
}

#[test]
fn a_file_that_is_cut_off_is_told() {
    let bytes = golden("hdf5_packed.h5");
    let mut refused = 0;
    for cut in (8..bytes.len()).step_by(37) {
        match read(&bytes[..cut], MAP) {
            Ok(run) => assert_golden(&run),
            Err(error) => {
                let told = error.to_string();
                assert!(told.contains("not a whole HDF5 file"), "cut at {cut}: {told}");
                refused += 1;
            }
        }
    }
    assert!(refused > 30, "{refused} refused");
}

#[test]
fn a_file_that_was_made_to_be_large_is_refused() {
    for name in ["hdf5_bomb.h5", "hdf5_large.h5"] {
        let error = read(golden(name), MAP).unwrap_err().to_string();
        assert!(error.contains("more than is allowed of a file of this size"), "{name}: {error}");
    }
}
