//! Logs as arrays of NumPy.

use std::fs;

use logs::{ColumnMap, ReadOptions, Run, read_run};

use crate::kinds::given;
use crate::support::{Scratch, assert_golden, golden, two_joints};

const MAP: &str = "[joint.j1]\nposition = { column = \"q[0]\" }\neffort = { column = \"tau[0]\" }\n\
     [joint.j2]\nposition = { column = \"q[1]\" }\neffort = { column = \"tau[1]\" }\n";

fn map(text: &str) -> ColumnMap {
    ColumnMap::load(&Scratch::new("map.toml", text).path).unwrap()
}

fn read(bytes: impl AsRef<[u8]>, map_text: &str) -> Result<Run, String> {
    let (file, map) = (Scratch::new("run", bytes), map(map_text));
    let options = ReadOptions { map: Some(&map), ..ReadOptions::default() };
    read_run(&file.path, &two_joints(), &options).map_err(|error| file.told::<Run>(Err(error)))
}

#[test]
fn arrays_of_an_npz_are_columns_by_their_names() {
    let run = read(golden("numpy_plain.npz"), MAP).unwrap();
    assert_golden(&run);
    assert!(run.extra.is_empty(), "{:?}", run.extra.keys());
}

#[test]
fn arrays_that_lie_the_other_way_packed_and_of_other_types_are_the_same() {
    let run = read(golden("numpy_turned.npz"), MAP).unwrap();
    assert_golden(&run);
    assert_eq!(run.extra["temperature"], [20.0, 21.0, 22.0, 23.0, 24.0]);
}

#[test]
fn records_are_columns_by_their_names() {
    let run = read(golden("numpy_records.npy"), MAP).unwrap();
    assert_golden(&run);
    let within = MAP.replace("\"q", "\"log.q").replace("\"tau", "\"log.tau");
    let within = format!("time = {{ column = \"log.time\" }}\n{within}");
    assert_golden(&read(golden("numpy_records.npz"), &within).unwrap());
}

#[test]
fn a_single_array_has_columns_without_names() {
    let bytes = golden("numpy_columns.npy");
    let told = Scratch::new("run.npy", &bytes).message(&two_joints());
    let expected = "run.npy: its columns have no names; they are called column_1 to column_5, \
         a column map that says which is which was expected";
    assert_eq!(told, expected);
    let mut numbered = format!("time = {{ column = \"column_1\" }}\n{MAP}");
    for (name, number) in [("q[0]", 2), ("q[1]", 3), ("tau[0]", 4), ("tau[1]", 5)] {
        numbered = numbered.replace(name, &format!("column_{number}"));
    }
    assert_golden(&read(bytes, &numbered).unwrap());
}

#[test]
fn what_is_no_table_is_told() {
    let npz = |map: &str| read(golden("numpy_plain.npz"), map).unwrap_err();
    let expected = "run: there is no column q[2], the column map names it for the position of \
         joint j2; its columns are time, q[0], q[1], tau[0], tau[1], short; did you mean q[0]?";
    let told = npz(&MAP.replace("q[1]", "q[2]"));
    assert_eq!(told.replace("q[1]?", "q[0]?"), expected);
    let expected = "run: column short has 3 values, 5 were expected as in time";
    assert_eq!(npz(&MAP.replace("q[1]", "short")), expected);
    let expected = "run: this is an array of NumPy that is no table of numbers; an array of \
         samples x columns was expected";
    assert_eq!(read(golden("numpy_objects.npy"), "").unwrap_err(), expected);
}

#[test]
fn a_cut_file_is_told() {
    let (npy, npz) = (golden("numpy_columns.npy"), golden("numpy_turned.npz"));
    let numbered = "time = { column = \"column_1\" }\n[joint.j1]\nposition = { column = \"column_2\" }\n\
         effort = { column = \"column_2\" }\n[joint.j2]\nposition = { column = \"column_2\" }\n\
         effort = { column = \"column_2\" }\n";
    for (bytes, map) in [(npy, numbered), (npz, MAP)] {
        for cut in 8..bytes.len() {
            let told = read(&bytes[..cut], map).unwrap_err();
            assert!(told.contains("not a whole NumPy file"), "cut at {cut}: {told}");
        }
    }
}

/// An array of `f8` zeros with this shape, whose file ends behind the header.
fn only_a_header(shape: &str) -> Vec<u8> {
    let text = format!("{{'descr': '<f8', 'fortran_order': False, 'shape': {shape}, }}\n");
    let length = u16::try_from(text.len()).unwrap().to_le_bytes();
    [b"\x93NUMPY\x01\x00", &length[..], text.as_bytes()].concat()
}

#[test]
fn sizes_that_a_header_only_says_are_not_believed() {
    let map = MAP.replace("q[0]", "column_2").replace("q[1]", "column_2");
    let map = map.replace("tau[0]", "column_2").replace("tau[1]", "column_2");
    let map = format!("time = {{ column = \"column_1\" }}\n{map}");
    for shape in ["(1000000000000, 2)", "(18446744073709551615, 2)", "(9223372036854775808, 4)"] {
        let told = read(only_a_header(shape), &map).unwrap_err();
        assert!(told.contains("not a whole NumPy file"), "{told}");
    }
    for shape in ["(2, 1000000000000)", "(18446744073709551616, 2)", "()", "(2, 2, 2)", "(5, 0)"] {
        let told = read(only_a_header(shape), &map).unwrap_err();
        assert!(told.starts_with("run: ") && told.len() < 200, "{told}");
    }
    let mut long = only_a_header("(2, 2)");
    long.splice(6..10, [2, 0, 0xff, 0xff, 0xff, 0xff]);
    let told = read(long, &map).unwrap_err();
    assert!(told.contains("its header is too long"), "{told}");
}

#[test]
fn an_archive_that_was_made_to_be_large_is_refused() {
    let map = "[joint.j1]\nposition = { column = \"time\" }\neffort = { column = \"time\" }\n\
         [joint.j2]\nposition = { column = \"time\" }\neffort = { column = \"time\" }\n";
    let expected =
        "run: unpacked it takes more than the 65 MB that are allowed of a packed file of this size";
    assert_eq!(read(golden("numpy_bomb.npz"), map).unwrap_err(), expected);
}

#[test]
fn a_given_file_is_read() {
    let Some(path) = given("log.npz") else { return };
    let text = MAP.replace("q[1]", "q[5]").replace("tau[1]", "tau[5]");
    let run = read(fs::read(path).unwrap(), &text).unwrap();
    assert_eq!(run.time.len(), 600);
    assert!((run.joints[0].position[1] - 1.449495).abs() < 1e-6);
    let further = ["dq[0]", "dq[1]", "dq[2]", "dq[3]", "dq[4]", "dq[5]"];
    assert!(further.iter().all(|name| run.extra.contains_key(*name)), "{:?}", run.extra.keys());
    assert_eq!(run.extra.len(), 6 + 4 + 4);
}
