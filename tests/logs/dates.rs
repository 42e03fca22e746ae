//! Time as dates, under another name, and where a file has none.

use std::fs::File;
use std::sync::Arc;

use arrow_array::{
    ArrayRef, Float64Array, RecordBatch, TimestampMicrosecondArray, TimestampNanosecondArray,
};
use logs::{ColumnMap, Excerpt, LogError, ReadOptions, Run, read_run, run_of_columns};
use parquet::arrow::ArrowWriter;

use crate::support::{Scratch, assert_golden, golden, two_joints};

/// The golden run as CSV, with the times and the name of their column as given.
fn table(name: &str, time: impl Fn(usize) -> String) -> String {
    let rows = (0..5).map(|k| {
        let (q, tau) = (0.25 * k as f64, k as f64);
        format!("{},{q},{tau},{},{}\n", time(k), q + 1.0, tau - 2.0)
    });
    format!("{name},j1.position,j1.effort,j2.position,j2.effort\n{}", rows.collect::<String>())
}

fn read(text: impl AsRef<[u8]>) -> Result<Run, LogError> {
    Scratch::new("run", text).read(&two_joints())
}

/// `date -u -d '2026-11-28 23:59:59.75' +%s` prints 1795910399.
const START_NS: i64 = 1_795_910_399_750_000_000;

#[test]
fn dates_in_text_count_from_the_first_row() {
    let clock =
        |k: usize| ["23:59:59.750", "23:59:59.875", "00:00:00", "00:00:00.125", "00:00:00.25"][k];
    let day = |k: usize| if k < 2 { "2026-11-28" } else { "2026-11-29" };
    for (separator, zone) in [(" ", ""), ("T", ""), ("T", "Z"), (" ", "+00:00"), ("T", "-05:00")] {
        for name in ["time", "", "Time"] {
            let date = |k| format!("{}{separator}{}{zone}", day(k), clock(k));
            assert_golden(&read(table(name, date)).unwrap());
        }
    }
    let torn =
        read(table(
            "time",
            |k| if k == 3 { "0.5".into() } else { format!("{} {}", day(k), clock(k)) },
        ));
    let told = torn.unwrap_err().to_string();
    assert!(told.contains("row 4") && told.contains("time") && told.contains("0.5"), "{told}");
}

#[test]
fn dates_of_a_table_of_arrow_count_from_the_first_row() {
    let numbers = |f: &dyn Fn(f64) -> f64| -> ArrayRef {
        Arc::new((0..5).map(|k| f(f64::from(k))).collect::<Float64Array>())
    };
    let nanoseconds = (0..5).map(|k| START_NS + 125_000_000 * k);
    let arrays: [ArrayRef; 3] = [
        Arc::new(TimestampNanosecondArray::from_iter_values(nanoseconds.clone())),
        Arc::new(
            TimestampNanosecondArray::from_iter_values(nanoseconds.clone()).with_timezone("UTC"),
        ),
        Arc::new(TimestampMicrosecondArray::from_iter_values(nanoseconds.map(|ns| ns / 1000))),
    ];
    for time in arrays {
        for name in ["time", "__index_level_0__", "timestamp"] {
            let columns = [
                ("j1.position", numbers(&|k| 0.25 * k)),
                ("j1.effort", numbers(&|k| k)),
                ("j2.position", numbers(&|k| 0.25 * k + 1.0)),
                ("j2.effort", numbers(&|k| k - 2.0)),
                (name, time.clone()),
            ];
            let batch = RecordBatch::try_from_iter(columns).unwrap();
            let file = Scratch::new("run.parquet", "replaced");
            let mut writer =
                ArrowWriter::try_new(File::create(&file.path).unwrap(), batch.schema(), None)
                    .unwrap();
            writer.write(&batch).unwrap();
            writer.close().unwrap();
            assert_golden(&file.read(&two_joints()).unwrap());
            // Counted from the first row of the file, which is not read here.
            let excerpt = Some(Excerpt { from_s: 0.2, to_s: 0.4 });
            let options = ReadOptions { excerpt, ..ReadOptions::default() };
            let part = read_run(&file.path, &two_joints(), &options).unwrap();
            assert_eq!(part.time, [0.25, 0.375], "{name}");
        }
    }
}

#[test]
fn time_may_have_another_name_where_only_one_column_has_it() {
    for name in ["Time", "t", "timestamp", "__time"] {
        assert_golden(&read(table(name, |k| (0.125 * k as f64).to_string())).unwrap());
    }
    let columns = ["t", "j1.position", "j1.effort", "j2.position", "j2.effort"];
    let scales = [(0.125, 0.0), (0.25, 0.0), (1.0, 0.0), (0.25, 1.0), (1.0, -2.0)];
    let samples = |(scale, offset)| (0..5).map(|k| scale * f64::from(k) + offset).collect();
    let in_memory = columns.map(str::to_owned).into_iter().zip(scales.map(samples)).collect();
    let options = ReadOptions::default();
    assert_golden(&run_of_columns("run", in_memory, &two_joints(), &options).unwrap());
    let two = read(table("t,stamp", |k| format!("{k},{k}"))).unwrap_err().to_string();
    assert!(two.contains("there is no column time"), "{two}");
}

fn read_with(bytes: impl AsRef<[u8]>, map_text: &str) -> Result<Run, LogError> {
    let map = ColumnMap::load(&Scratch::new("map.toml", map_text).path)?;
    let options = ReadOptions { map: Some(&map), ..ReadOptions::default() };
    read_run(&Scratch::new("run", bytes).path, &two_joints(), &options)
}

#[test]
fn the_rows_of_a_file_without_time_are_as_far_apart_as_the_map_says() {
    let arrays = "rate_hz = 8\nposition = \"q[:]\"\neffort = \"tau[:]\"\n";
    for name in ["hdf5_plain.h5", "hdf5_packed.h5", "numpy_plain.npz"] {
        assert_golden(&read_with(golden(name), arrays).unwrap());
    }
    assert_golden(&read_with(table("note", |k| format!("row {k}")), "rate_hz = 8\n").unwrap());
    for (map, expected) in [
        ("rate_hz = 0\n", "found 0 Hz, a finite number greater than 0 was expected"),
        ("rate_hz = nan\n", "found NaN Hz"),
        ("rate_hz = 8\ntime = \"t\"\n", "found 8 Hz beside time = \"t\", one of them was expected"),
    ] {
        let told = read_with("a,b\n1,2\n", map).unwrap_err().to_string();
        assert!(told.contains(expected), "{told}");
    }
}
