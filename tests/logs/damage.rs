//! Damaged logs read up to the damage.

use logs::{LogError, ReadOptions, Run, read_run_until_damage};

use crate::support::{Scratch, assert_golden, golden, two_joints};

fn read(name: &str, bytes: impl AsRef<[u8]>) -> Result<(Run, Option<String>), String> {
    let file = Scratch::new(name, bytes);
    let result = read_run_until_damage(&file.path, &two_joints(), &ReadOptions::default());
    let told = |error: LogError| file.told::<()>(Err(error));
    match result {
        Ok((run, damage)) => Ok((run, damage.map(|error| told(*error)))),
        Err(error) => Err(told(error)),
    }
}

/// Six rows; `row` is in the place of the fifth.
fn csv(row: &str) -> String {
    let mut text = "time,j1.position,j1.effort,j2.position,j2.effort\n".to_owned();
    for k in 0..6 {
        let whole = format!("0.{k},1,2,3,4");
        text.push_str(if k == 4 { row } else { &whole });
        text.push('\n');
    }
    text
}

#[test]
fn csv_is_read_up_to_the_row_that_cannot_be_read() {
    for (row, expected) in [
        ("0.4,1,x,3,4", "row 5, column j1.effort: found \"x\""),
        ("0.4,1,2,,4", "row 5, column j2.position: the value is missing"),
        ("0.4,1,2", "row 5"),
        ("0.4,1,nan,3,4", "row 5, column j1.effort: found NaN"),
        ("0.2,1,2,3,4", "row 5, column time"),
    ] {
        let (run, damage) = read("run.csv", csv(row)).unwrap();
        assert_eq!(run.time, [0.0, 0.1, 0.2, 0.3], "{row}");
        assert_eq!(run.joints[1].effort, [4.0; 4], "{row}");
        let damage = damage.unwrap();
        assert!(damage.contains(expected), "{expected} is missing in {damage}");
        let refused = Scratch::new("run.csv", csv(row)).message(&two_joints());
        assert_eq!(refused, damage, "without it the log is refused in the same words");
    }
}

#[test]
fn two_mistakes_are_cut_off_at_the_first() {
    let text = csv("0.4,1,nan,3,4").replace("0.2,1", "0.2,inf");
    let (run, damage) = read("run.csv", text).unwrap();
    assert_eq!(run.time.len(), 2);
    assert!(damage.is_some());
}

#[test]
fn a_whole_log_has_no_damage() {
    let (run, damage) = read("run.csv", csv("0.4,1,2,3,4")).unwrap();
    assert_eq!((run.time.len(), damage), (6, None));
}

#[test]
fn a_log_that_is_damaged_at_its_start_or_is_none_is_refused() {
    assert!(read("run.csv", csv("0.4,1,2,3,4").replace("0.1,1", "0.1,x")).is_err());
    assert!(read("run.csv", "time,j1.position\n0,1\n1,1\n").is_err());
    assert!(read("run.csv", "").is_err());
}

#[test]
fn a_bag_that_is_cut_off_is_read_up_to_there() {
    let bytes = golden("mcap_one_topic.mcap");
    let (whole, damage) = read("run.mcap", &bytes).unwrap();
    assert_golden(&whole);
    assert_eq!(damage, None);
    let mut shorter = 0;
    for end in (bytes.len() / 4..bytes.len()).step_by(7) {
        let Ok((run, damage)) = read("run.mcap", &bytes[..end]) else { continue };
        assert_eq!(run.time[..], whole.time[..run.time.len()]);
        if run.time.len() < whole.time.len() {
            shorter += 1;
            assert!(damage.is_some_and(|told| told.contains("run.mcap")));
        }
    }
    println!("{shorter} of the pieces hold some messages and not all");
}

/// A footer that is longer than its file, of which the decoder says two sentences.
#[test]
fn what_a_decoder_says_of_a_broken_file_is_one_sentence() {
    let footer = 0x00ff_ffff_u32.to_le_bytes();
    let bytes = [b"PAR1".as_slice(), &[0; 8], &footer, b"PAR1"].concat();
    let message = Scratch::new("run.parquet", bytes).message(&two_joints());
    assert!(message.contains("not a whole Parquet file"), "{message}");
    assert!(!message.contains(". ") && !message.contains('\n'), "{message}");
}
