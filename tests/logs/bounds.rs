//! Bounds of tables, the same in every format.

use std::{fs::File, sync::Arc, thread};

use arrow_array::{ArrayRef, Float64Array, RecordBatch};
use parquet::arrow::ArrowWriter;

use crate::support::{Scratch, golden, two_joints};

/// Most columns of a table.
const MOST: usize = 10_000;
/// Stack of a thread of Python or of a pool (bytes).
const SMALL_STACK: usize = 1 << 19;

fn csv(columns: usize) -> String {
    let further: String = (5..columns).map(|k| format!(",c{k}")).collect();
    let row = |t: f64| format!("{t},0.1,1.0,0.2,2.0{}\n", ",7".repeat(columns - 5));
    let names = "time,j1.position,j1.effort,j2.position,j2.effort";
    let rows: String = (0..20).map(|k| row(f64::from(k) * 0.01)).collect();
    format!("{names}{further}\n{rows}")
}

#[test]
fn a_table_of_ten_thousand_columns_is_read_and_one_more_is_refused() {
    let read = Scratch::new("run.csv", csv(MOST)).read(&two_joints()).unwrap();
    assert_eq!(read.extra.len(), MOST - 5);
    let told = Scratch::new("run.csv", csv(MOST + 1)).message(&two_joints());
    assert_eq!(told, "run.csv: it has more than 10000 columns, at most 10000 were expected");
}

#[test]
fn a_line_of_twenty_million_names_is_refused_before_it_is_held() {
    let text = format!("{}a\n{}1\n", "a,".repeat(20_000_000), "1,".repeat(5));
    let file = Scratch::new("run.csv", text);
    let mut told = String::new();
    let held = allocation_counter::measure(|| told = file.message(&two_joints()));
    assert_eq!(told, "run.csv: it has more than 10000 columns, at most 10000 were expected");
    assert!(held.bytes_max < 32 << 20, "{} bytes", held.bytes_max);
}

#[test]
fn a_line_without_end_is_refused() {
    let text = format!("{}0,{}\n", csv(5), "1".repeat(17 << 20));
    let told = Scratch::new("run.csv", text).message(&two_joints());
    assert!(told.contains("a line has more than 16 MiB"), "{told}");
}

#[test]
fn a_small_parquet_of_endless_rows_is_refused() {
    let names = ["time", "j1.position", "j1.effort", "j2.position", "j2.effort"];
    let numbers: ArrayRef = Arc::new(Float64Array::from(vec![0.5; 1_000_000]));
    let batch = RecordBatch::try_from_iter(names.map(|name| (name, numbers.clone()))).unwrap();
    let file = Scratch::new("run.parquet", "");
    let out = File::create(&file.path).unwrap();
    let mut writer = ArrowWriter::try_new(out, batch.schema(), None).unwrap();
    (0..3).for_each(|_| writer.write(&batch).unwrap());
    writer.close().unwrap();
    assert!(file.path.metadata().unwrap().len() < 100_000);
    let told = file.message(&two_joints());
    assert!(told.contains("takes more than the"), "{told}");
}

/// A NumPy array of records of zeros, whose file has no bytes on the disk but for its header.
fn zeros(rows: u64) -> Scratch {
    let names = ["time", "j1.position", "j1.effort", "j2.position", "j2.effort"];
    let fields: String = names.map(|name| format!("('{name}', '|i1'), ")).concat();
    let header = format!("{{'descr': [{fields}], 'fortran_order': False, 'shape': ({rows},), }}\n");
    let length = u16::try_from(header.len()).unwrap().to_le_bytes();
    let file =
        Scratch::new("run.npy", [b"\x93NUMPY\x01\x00", &length[..], header.as_bytes()].concat());
    let bytes = (10 + header.len()) as u64 + rows * names.len() as u64;
    File::options().write(true).open(&file.path).unwrap().set_len(bytes).unwrap();
    file
}

#[test]
fn a_hundred_million_rows_and_one_are_refused_before_they_are_held() {
    let told = zeros(1000).message(&two_joints());
    assert!(told.contains("time is 0 s after 0 s"), "{told}");
    let file = zeros(100_000_001);
    let mut told = String::new();
    let held = allocation_counter::measure(|| told = file.message(&two_joints()));
    assert_eq!(
        told,
        "run.npy: it has more than 100000000 rows of 5 columns, at most 100000000 were expected"
    );
    assert!(held.bytes_max < 1 << 20, "{} bytes", held.bytes_max);
}

#[test]
fn links_that_lead_into_one_another_end_nothing() {
    let work = || Scratch::new("run", golden("soft_links.mat")).message(&two_joints());
    let told = thread::Builder::new().stack_size(SMALL_STACK).spawn(work).unwrap().join().unwrap();
    assert!(told.starts_with("run: "), "{told}");
}

/// A Parquet that is a footer alone, whose schema is a chain of groups.
fn chain(groups: usize) -> Vec<u8> {
    let group = b"\x48\x01g\x15\x02\x00";
    let mut footer = b"\x15\x02\x19\xfc".to_vec();
    let mut count = groups + 1;
    while count > 127 {
        footer.push((count % 128) as u8 | 128);
        count /= 128;
    }
    footer.push(count as u8);
    (0..groups).for_each(|_| footer.extend(group));
    footer.extend(b"\x15\x0a\x38\x01x\x00\x16\x00\x19\x0c\x00");
    let length = u32::try_from(footer.len()).unwrap().to_le_bytes();
    [&b"PAR1"[..], &footer, &length, b"PAR1"].concat()
}

#[test]
fn columns_within_columns_end_nothing() {
    for groups in [33, 20_000, 500_000] {
        let told = Scratch::new("run.parquet", chain(groups)).message(&two_joints());
        assert!(told.contains("its columns are nested more than 32 deep"), "{told}");
    }
}

/// A bag in MCAP of so many topics without a message; channels have numbers of their own, or all the same.
fn topics(count: u16, number: impl Fn(u16) -> u16) -> Vec<u8> {
    const MAGIC: &[u8] = b"\x89MCAP0\r\n";
    let mut bytes = MAGIC.to_vec();
    let mut record = |opcode: u8, fields: &[&[u8]]| {
        let content = fields.concat();
        bytes.push(opcode);
        bytes.extend((content.len() as u64).to_le_bytes());
        bytes.extend(content);
    };
    let text = |text: &str| [&(text.len() as u32).to_le_bytes()[..], text.as_bytes()].concat();
    record(1, &[&text("ros2"), &text("")]);
    record(3, &[&1_u16.to_le_bytes(), &text("std_msgs/msg/String"), &text("ros2msg"), &text("")]);
    for k in 0..count {
        let [id, schema] = [number(k), 1].map(u16::to_le_bytes);
        record(4, &[&id, &schema, &text(&format!("/note_{k}")), &text("cdr"), &text("")]);
    }
    record(15, &[&[0; 4]]);
    record(2, &[&[0; 20]]);
    bytes.extend(MAGIC);
    bytes
}

#[test]
fn a_bag_of_ten_thousand_topics_is_looked_through_and_one_of_more_is_refused() {
    let told = |count, number: fn(u16) -> u16| {
        Scratch::new("bag.mcap", topics(count, number)).message(&two_joints())
    };
    let own: fn(u16) -> u16 = |k| k + 1;
    assert!(told(10_000, own).contains("no joint states"), "{}", told(10_000, own));
    for number in [own, |_| 7] {
        let told = told(10_001, number);
        assert!(told.contains("it has more than 10000 topics"), "{told}");
    }
}
