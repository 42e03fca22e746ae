//! Logs that are written while they grow, and what is left of them.

use std::fs;

use logs::{Channel, LogError, LogWarning, LogWriter, PrepareSettings, prepare, write_csv};
use proptest::prelude::*;

use crate::support::{Scratch, clock, follows, run, two_joints};

const CHANNELS: [Channel; 2] = [Channel::Position, Channel::Effort];

/// A file that a writer has written these rows to.
fn grown(rows: &[[f64; 6]]) -> Scratch {
    let file = Scratch::new("run.csv", "replaced");
    let mut writer = LogWriter::create(&file.path, &["j1", "j2"], &CHANNELS, &["gauge"]).unwrap();
    rows.iter().for_each(|row| writer.row(row).unwrap());
    writer.finish().unwrap();
    file
}

/// Rows as they are read back: time, positions, efforts, gauge.
fn read(file: &Scratch) -> Result<Vec<[f64; 6]>, LogError> {
    let run = file.read(&two_joints())?;
    let (one, two) = (&run.joints[0], &run.joints[1]);
    let gauge = &run.extra["gauge"];
    let row = |k: usize| {
        let [a, b] = [one, two].map(|joint| (joint.position[k], joint.effort[k]));
        [run.time[k], a.0, b.0, a.1, b.1, gauge[k]]
    };
    Ok((0..run.time.len()).map(row).collect())
}

fn bits(rows: &[[f64; 6]]) -> Vec<[u64; 6]> {
    rows.iter().map(|row| row.map(f64::to_bits)).collect()
}

/// Rows of numbers of every size at rising times.
fn any_rows() -> impl Strategy<Value = Vec<[f64; 6]>> {
    let angle = || -2.0..2.0_f64;
    let row = (angle(), angle(), prop::num::f64::NORMAL, prop::num::f64::SUBNORMAL, any::<i32>());
    prop::collection::vec(row, 2..6).prop_map(|rows| {
        let row = |(k, (a, b, c, d, gauge)): (usize, (f64, f64, f64, f64, i32))| {
            [0.4 * k as f64, a, b, c, d, f64::from(gauge)]
        };
        rows.into_iter().enumerate().map(row).collect()
    })
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 24, failure_persistence: None, ..Default::default() })]

    #[test]
    fn a_log_that_is_cut_at_any_byte_reads_back_its_whole_rows_to_the_last_bit(rows in any_rows()) {
        let file = grown(&rows);
        let bytes = fs::read(&file.path).unwrap();
        prop_assert_eq!(bits(&read(&file).unwrap()), bits(&rows));
        for cut in 0..bytes.len() {
            fs::write(&file.path, &bytes[..cut]).unwrap();
            // Whole are the rows with a newline, and the one that lacks nothing else.
            let ended = bytes[..cut].iter().filter(|&&byte| byte == b'\n').count();
            let whole = (ended + usize::from(bytes[cut] == b'\n')).saturating_sub(1);
            match read(&file) {
                Ok(left) => prop_assert_eq!(bits(&left), bits(&rows[..whole]), "cut at {}", cut),
                Err(error) => prop_assert!(whole < 2, "cut at {cut}: {error}"),
            }
        }
    }
}

fn rows(count: u32) -> Vec<[f64; 6]> {
    (0..count).map(f64::from).map(|k| [0.002 * k, k.sin(), k.cos(), k, -k, 0.5 * k]).collect()
}

#[test]
fn a_log_without_a_whole_row_is_a_clear_error() {
    let file = grown(&rows(3));
    let text = fs::read_to_string(&file.path).unwrap();
    let header = text.lines().next().unwrap();
    assert_eq!(header, "time,j1.position,j2.position,j1.effort,j2.effort,\"gauge\"");
    let cut = |at: usize| {
        fs::write(&file.path, &text[..at]).unwrap();
        file.message(&two_joints())
    };
    assert_eq!(cut(header.len()), "run.csv: 0 rows of data, at least 2 were expected");
    let message = cut("time,j1.position,j2.pos".len());
    let expected = "run.csv: there is no column j1.effort, the effort of joint j1 was expected there; \
         its columns are time, j1.position, j2.pos";
    assert_eq!(message, expected);
}

#[test]
fn rows_are_in_the_file_a_second_later() {
    let file = Scratch::new("run.csv", "");
    let mut writer = LogWriter::create(&file.path, &["j1", "j2"], &CHANNELS, &["gauge"]).unwrap();
    let rows = rows(1300);
    rows.iter().for_each(|row| writer.row(row).unwrap());
    // 2.6 s: blocks of 501 rows end at 1.000 s and 2.002 s.
    assert_eq!(read(&file).unwrap().len(), 1002);
    drop(writer);
    assert_eq!(bits(&read(&file).unwrap()), bits(&rows));
}

#[test]
fn a_torn_row_is_told() {
    let file = grown(&rows(3000));
    let whole = file.read(&two_joints()).unwrap();
    let bytes = fs::read(&file.path).unwrap();
    fs::write(&file.path, &bytes[..bytes.len() - 3]).unwrap();
    let torn = file.read(&two_joints()).unwrap();
    assert_eq!((whole.is_torn, torn.is_torn, torn.time.len()), (false, true, 2999));
    let settings = PrepareSettings { cutoff_hz: Some(20.0) };
    let warnings = |run| prepare(&[run], &settings).unwrap().warnings;
    let told = LogWarning::TornLastRow { run: "run".to_owned() };
    assert!(warnings(torn).contains(&told) && !warnings(whole).contains(&told));
}

#[test]
fn a_file_of_another_program_that_lacks_its_last_newline_keeps_its_last_row() {
    let header = "time,j1.position,j1.effort,j2.position,j2.effort,note";
    let cases = [
        // Nothing in quotes; words in quotes; everything in quotes; quotes where they are needed.
        "0,1,2,3,4,x\n1,1,2,3,4,x",
        "0,1,2,3,4,\"x\"\n1,1,2,3,4,\"x\"",
        "\"0\",\"1\",\"2\",\"3\",\"4\",\"5\"\r\n\"1\",\"1\",\"2\",\"3\",\"4\",\"5\"",
        "0,1,2,3,4,\"1,5\"\n1,1,2,3,4,15",
        "0,1,2,3,4,\"a \"\"1\"\"\"\n1,1,2,3,4,b",
        "0,1,2,3,4,5\n1,1,2,3,4,5   ",
    ];
    for rows in cases {
        let file = Scratch::new("run.csv", format!("{header}\n{rows}"));
        let read = file.read(&two_joints()).unwrap();
        assert_eq!((read.time.len(), read.is_torn), (2, false), "{rows}");
    }
    let time = clock(20, 100.0);
    let (j1, j2) = (follows("j1", &time, f64::sin), follows("j2", &time, f64::cos));
    let file = Scratch::new("run.csv", "");
    write_csv(&file.path, &run(time, vec![j1, j2])).unwrap();
    let text = fs::read_to_string(&file.path).unwrap();
    fs::write(&file.path, text.trim_end()).unwrap();
    assert_eq!(file.read(&two_joints()).unwrap().time.len(), 20);
}

#[test]
fn what_does_not_fit_is_refused_and_the_log_goes_on() {
    let file = Scratch::new("run.csv", "");
    let mut writer = LogWriter::create(&file.path, &["j1", "j2"], &CHANNELS, &["gauge"]).unwrap();
    for wrong in [&[][..], &[1.0], &[0.0; 7]] {
        let expected = format!(
            "{}: row 1 has {} fields, 6 were expected as in the header",
            file.path.display(),
            wrong.len()
        );
        assert_eq!(writer.row(wrong).unwrap_err().to_string(), expected);
    }
    rows(3).iter().for_each(|row| writer.row(row).unwrap());
    writer.finish().unwrap();
    assert_eq!(read(&file).unwrap().len(), 3);
    let nowhere = file.folder.path().join("missing/run.csv");
    let error = LogWriter::create(&nowhere, &["j1"], &CHANNELS, &[]).unwrap_err();
    assert!(matches!(error, LogError::Unwritable { path, .. } if path == nowhere));
}

#[test]
fn names_with_commas_and_quotes_are_names() {
    let file = Scratch::new("run.csv", "");
    let further = ["a,b", "say \"x\""];
    let mut writer = LogWriter::create(&file.path, &["j1", "j2"], &CHANNELS, &further).unwrap();
    for row in rows(3) {
        writer.row(&[row[0], row[1], row[2], row[3], row[4], row[5], 7.0]).unwrap();
    }
    writer.finish().unwrap();
    let read = file.read(&two_joints()).unwrap();
    assert_eq!(read.extra.keys().collect::<Vec<_>>(), further.iter().collect::<Vec<_>>());
    assert_eq!(read.extra["say \"x\""], [7.0; 3]);
}
