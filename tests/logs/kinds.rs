//! Files of all kinds under any name: read, or refused with what they are and what to do.

use std::fs;
use std::path::PathBuf;

use checks::recorded;
use logs::{ReadOptions, read_run};

use crate::support::{Scratch, two_joints};

/// The message for a file with these bytes, whatever its name.
fn told(bytes: &[u8]) -> String {
    let messages = ["run.csv", "run.parquet", "run"]
        .map(|name| Scratch::new(name, bytes).message(&two_joints()).replacen(name, "FILE", 1));
    assert!(messages.iter().all(|message| *message == messages[0]), "{messages:?}");
    messages[0].clone()
}

#[test]
fn a_kind_that_is_not_read_is_told_with_what_to_do() {
    let cases: [(&[u8], &str); 4] = [
        (
            b"\x80\x04\x95\0",
            "FILE: this is a Python pickle, which can run a program when it is opened; \
             write its arrays with numpy.savez, or as CSV or Parquet",
        ),
        (b"BZh91AY&SY", "FILE: this is packed with bzip2; unpack it first"),
        (
            b"version https://git-lfs.github.com/spec/v1\noid sha256:0\n",
            "FILE: this is a pointer of Git LFS, not the file itself; git lfs pull brings it",
        ),
        (b"\xff\xfet\0i\0m\0e\0", "FILE: this is text in UTF-16; save it as UTF-8"),
    ];
    for (bytes, expected) in cases {
        assert_eq!(told(bytes), expected);
    }
}

/// What a shell's `*` picks up beside the logs: a README, a file of settings, a list of names.
#[test]
fn a_text_without_rows_is_told_to_be_no_log() {
    for text in [
        "# The arm\n\nThree runs, 30 s each, at noon.\nThe gripper was off, and 2 kg light.\n",
        "[arm]\nname = \"elbow\"\ngains = [3, 4]\n",
        "shoulder\nelbow\nwrist\n",
        "# A scenario\nduration_s = 8\nseed = 1\ntimes_s = [\n    0.5,\n    1.5,\n]\n",
        "name: elbow\nrate_hz: 500\n",
    ] {
        assert_eq!(
            told(text.as_bytes()),
            "FILE: this is text without a row of numbers in its first lines; \
             a log has a line of names, then one of numbers for every moment"
        );
    }
}

/// A file of `formats` beside the recorded logs.
pub fn given(name: &str) -> Option<PathBuf> {
    Some(recorded::folder()?.join("formats").join(name)).filter(|path| {
        let there = path.exists();
        if !there {
            println!("skipped: there is no {}", path.display());
        }
        there
    })
}

#[test]
fn given_files_that_are_not_read_are_told_with_what_to_do() {
    for (name, expected) in [
        ("bag_sqlite3/metadata.yaml", "this is the description of a rosbag2"),
        ("ur5_robot.urdf", "this is XML"),
    ] {
        let Some(path) = given(name) else { continue };
        for copied in ["run", "run.csv", "run.parquet"] {
            let file = Scratch::new(copied, fs::read(&path).unwrap());
            let error = read_run(&file.path, &two_joints(), &ReadOptions::default()).unwrap_err();
            assert!(error.to_string().contains(expected), "{error}");
        }
    }
}
