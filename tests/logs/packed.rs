//! Packed logs: the content behind decides.

use logs::{ColumnMap, ReadOptions, read_run};

use crate::support::{Scratch, assert_golden, golden, two_joints};

fn told(name: &str) -> String {
    Scratch::new("run", golden(name)).message(&two_joints())
}

#[test]
fn a_packed_log_is_read_as_what_it_is() {
    for name in ["packed_log.csv.gz", "packed_parts.csv.gz", "packed_log.csv.zst"] {
        for called in ["run.csv", "run.csv.gz", "run"] {
            let run = Scratch::new(called, golden(name)).read(&two_joints()).unwrap();
            assert_golden(&run);
        }
    }
    let map = "[joint.j1]\nposition = { column = \"q[0]\" }\neffort = { column = \"tau[0]\" }\n\
         [joint.j2]\nposition = { column = \"q[1]\" }\neffort = { column = \"tau[1]\" }\n";
    let map = ColumnMap::load(&Scratch::new("map.toml", map).path).unwrap();
    let options = ReadOptions { map: Some(&map), ..ReadOptions::default() };
    let file = Scratch::new("run", golden("packed_log.npz.gz"));
    assert_golden(&read_run(&file.path, &two_joints(), &options).unwrap());
}

#[test]
fn what_is_no_log_is_told_before_it_is_unpacked() {
    assert_eq!(
        told("packed_pickle.gz"),
        "run: this is a Python pickle, which can run a program when it is opened; write its arrays with numpy.savez, \
         or as CSV or Parquet"
    );
    assert_eq!(told("packed_twice.csv.gz"), "run: this is packed twice; unpack it first");
    assert_eq!(told("packed_nothing.gz"), "run: the file is empty, a log was expected");
    let expected =
        "run: unpacked it takes more than the 68 MB that are allowed of a packed file of this size";
    assert_eq!(told("packed_bomb.csv.zst"), expected);
}

#[test]
fn a_cut_file_is_told() {
    for (name, kind) in [("packed_log.csv.gz", "gzip"), ("packed_log.csv.zst", "zstd")] {
        let bytes = golden(name);
        for cut in 4..bytes.len() {
            let told = Scratch::new("run", &bytes[..cut]).message(&two_joints());
            let is_told = told.contains(&format!("not a whole {kind} file"));
            // The first part of the zstd file is whole, and its last row is not.
            let is_torn = kind == "zstd" && told.contains("fields");
            assert!(is_told || is_torn, "cut at {cut}: {told}");
        }
    }
}
