//! Logs of every kind, read, described and prepared.

use std::fmt::Write as _;
use std::io::{Cursor, Read, Write as _};
use std::path::Path;
use std::sync::{Arc, LazyLock};

use arrow_array::types::Float64Type;
use arrow_array::{ArrayRef, Float64Array, ListArray, RecordBatch};
use checks::arms::workspace_root;
use checks::mutated;
use flate2::Compression;
use flate2::read::ZlibDecoder;
use flate2::write::{GzEncoder, ZlibEncoder};
use logs::{
    ColumnMap, PrepareSettings, ReadOptions, log_info, prepare, read_run, read_run_until_damage,
};
use parquet::arrow::ArrowWriter;
use rand::RngExt;
use rand_chacha::ChaCha8Rng;
use robot::Robot;
use zip::{ZipArchive, ZipWriter, write::SimpleFileOptions};

use super::{Reader, Seeds, robots, tables};

pub static ROBOT: LazyLock<Robot> = LazyLock::new(|| Robot::from_urdf(robots::URDF).unwrap());

pub fn readers() -> Vec<Reader> {
    let of = |name, words, seeds, change| Reader {
        name,
        file: "run",
        short: 1500,
        seeds,
        parsed: None,
        change,
        read,
        parse: |path| parse_with(path, &ReadOptions::default()),
        words,
    };
    let with = |parsed: Seeds, reader| Reader { parsed: Some(parsed), ..reader };
    let arrays = |name, words, seeds, change| Reader {
        read: read_arrays,
        parse: |path| parse_with(path, &arrays_of_joints()),
        ..of(name, words, seeds, change)
    };
    let binary = |bytes: &[u8], random: &mut ChaCha8Rng| mutated::bytes(bytes, random);
    vec![
        with(
            |_| vec![rows(FEW).into_bytes()],
            of("CSV", TEXT, |_| vec![csv().into_bytes()], robots::changed_text),
        ),
        with(
            |_| vec![gzip(rows(FEW).as_bytes())],
            of("gzip", &["\x1f"], |_| vec![gzip(csv().as_bytes())], packed),
        ),
        with(
            |_| vec![zstd(rows(FEW).as_bytes())],
            of("zstd", &["(\u{fd}"], |_| vec![zstd(csv().as_bytes())], packed),
        ),
        with(
            |folder| parquet(folder, &rows(FEW)),
            of("Parquet", tables::PARQUET, |folder| parquet(folder, &csv()), tables::changed),
        ),
        arrays("Parquet of lists", tables::PARQUET, parquet_of_lists, tables::changed),
        of("MCAP", BAG, |_| golden(&["mcap_none.mcap", "mcap_zstd.mcap", "mcap_lz4.mcap"]), binary),
        of("SQLite", BAG, |_| golden(&["sqlite_bag.db3", "sqlite_small_pages.db3"]), binary),
        arrays("npy", NUMPY, |_| golden(&["numpy_records.npy"]), array),
        arrays("npz", NUMPY, |_| golden(&["numpy_plain.npz", "numpy_turned.npz"]), archive),
        arrays("MAT 7.3", HDF5, |_| golden(&["matlab73_plain.mat", "matlab73_packed.mat"]), binary),
        arrays("HDF5", HDF5, |_| golden(&["hdf5_plain.h5", "hdf5_packed.h5"]), binary),
        arrays("MAT", MATLAB, |_| golden(&["matlab_plain.mat", "matlab_packed.mat"]), matlab),
    ]
}

/// Words of logs as text.
pub const TEXT: &[&str] = &[
    "time,",
    "j1.position",
    "%time,field.name0,field.position0",
    "\"",
    "\"\"",
    ",",
    ";",
    "\t",
    "\r\n",
    "\n",
    "#",
    "nan",
    "1e400",
    "\u{feff}",
    "0,5",
];

/// Words of bags, of their records and of the commands that make their tables.
pub const BAG: &[&str] = &[
    "CREATE TABLE topics(id INTEGER PRIMARY KEY, name TEXT)",
    "messages",
    "/joint_states",
    "sensor_msgs/msg/JointState",
    "cdr",
    "ros2",
    "zstd",
    "lz4",
    "\u{0}\u{1}\u{0}\u{0}",
    "(",
    "\"",
    "\x0d",
    "\x7f\x7f\x7f\x7f",
];

/// Words of headers of arrays.
const NUMPY: &[&str] = &[
    "{'descr': '<f8', 'fortran_order': False, 'shape': (3,), }",
    "'>f4'",
    "'|O'",
    "('q', '<f8', (2,))",
    "(",
    ")",
    "[",
    "True",
    "99999999999999999999",
    ",",
    "PK\x01\x02",
    "PK\x03\x04",
    "PK\x05\x06",
    ".npy",
];

/// First bytes of the parts of HDF5.
const HDF5: &[&str] =
    &["TREE", "HEAP", "SNOD", "OHDR", "GCOL", "BTHD", "BTLF", "FRHP", "FADB", "EAHD", "time", "q"];

/// Names of arrays and first bytes of elements of MATLAB.
const MATLAB: &[&str] = &["\x0e\0\0\0", "\x0f\0\0\0", "\x09\0\0\0", "time", "q", "MI", "IM"];

/// Rows that say as much as many.
const FEW: u32 = 12;

/// Two joints for a second and a half.
fn csv() -> String {
    rows(150)
}

/// Two joints for twelve seconds.
pub fn long_csv() -> String {
    rows(1200)
}

pub fn rows(count: u32) -> String {
    let mut text = "time,j1.position,j1.velocity,j1.effort,j2.position,j2.effort,note\n".to_owned();
    for k in 0..count {
        let t = 0.01 * f64::from(k);
        let (a, b) = ((5.0 * t).sin(), (7.0 * t).cos());
        let (qd, tau) = (5.0 * (5.0 * t).cos(), 3.0 + 4.0 * b);
        writeln!(text, "{t:.2},{a:.5},{qd:.4},{tau:.3},{b:.5},{:.3},{k}", 2.0 * a).unwrap();
    }
    text
}

pub fn golden(names: &[&str]) -> Vec<Vec<u8>> {
    let folder = workspace_root().join("tests/golden/logs");
    names.iter().map(|name| std::fs::read(folder.join(name)).unwrap()).collect()
}

fn parquet(folder: &Path, text: &str) -> Vec<Vec<u8>> {
    let path = folder.join("run.csv");
    std::fs::write(&path, text).unwrap();
    let run = read_run(&path, &ROBOT, &ReadOptions::default()).unwrap();
    logs::write_parquet(&path, &run).unwrap();
    vec![std::fs::read(&path).unwrap()]
}

/// The joints are entries of the lists `q` and `tau`.
fn parquet_of_lists(folder: &Path) -> Vec<Vec<u8>> {
    let path = folder.join("run.parquet");
    let time: Vec<f64> = (0..150).map(|k| 0.01 * f64::from(k)).collect();
    let lists = |scale: f64| -> ArrayRef {
        let row = |t: &f64| Some([(5.0 * t).sin(), (7.0 * t).cos()].map(|x| Some(scale * x)));
        Arc::new(ListArray::from_iter_primitive::<Float64Type, _, _>(time.iter().map(row)))
    };
    let columns = [("q", lists(1.0)), ("tau", lists(3.0))];
    let clock: ArrayRef = Arc::new(Float64Array::from(time.clone()));
    let batch = RecordBatch::try_from_iter([("time", clock)].into_iter().chain(columns)).unwrap();
    let file = std::fs::File::create(&path).unwrap();
    let mut writer = ArrowWriter::try_new(file, batch.schema(), None).unwrap();
    writer.write(&batch).unwrap();
    writer.close().unwrap();
    vec![std::fs::read(&path).unwrap()]
}

fn gzip(bytes: &[u8]) -> Vec<u8> {
    let mut packed = GzEncoder::new(Vec::new(), Compression::fast());
    packed.write_all(bytes).unwrap();
    packed.finish().unwrap()
}

fn zstd(bytes: &[u8]) -> Vec<u8> {
    zstd::encode_all(bytes, 1).unwrap()
}

/// What is packed is changed in two of three inputs, the packing in the others.
fn packed(bytes: &[u8], random: &mut ChaCha8Rng) -> Vec<u8> {
    if random.random_ratio(1, 3) {
        return mutated::bytes(bytes, random);
    }
    let text = mutated::text(&csv(), random);
    if bytes.starts_with(&[0x1f, 0x8b]) { gzip(&text) } else { zstd(&text) }
}

/// The header of an array, its length put right in most inputs, or the bytes.
fn array(bytes: &[u8], random: &mut ChaCha8Rng) -> Vec<u8> {
    let length = usize::from(u16::from_le_bytes([bytes[8], bytes[9]]));
    let end = 10 + length;
    if random.random_ratio(1, 2) {
        return mutated::bytes(bytes, random);
    }
    let header = mutated::text(&String::from_utf8_lossy(&bytes[10..end]), random);
    let told = if random.random_ratio(1, 8) { length } else { header.len() } as u16;
    [&bytes[..8], &told.to_le_bytes(), &header, &bytes[end..]].concat()
}

/// One array of an archive, packed again with a checksum that holds, or the bytes.
fn archive(bytes: &[u8], random: &mut ChaCha8Rng) -> Vec<u8> {
    if random.random_ratio(1, 3) {
        return mutated::bytes(bytes, random);
    }
    let mut old = ZipArchive::new(Cursor::new(bytes)).unwrap();
    let mut new = ZipWriter::new(Cursor::new(Vec::new()));
    let changed = random.random_range(0..old.len());
    for index in 0..old.len() {
        let mut entry = old.by_index(index).unwrap();
        let (name, mut content) = (entry.name().unwrap().into_owned(), Vec::new());
        entry.read_to_end(&mut content).unwrap();
        if index == changed {
            content = array(&content, random);
        }
        new.start_file(name, SimpleFileOptions::default()).unwrap();
        new.write_all(&content).unwrap();
    }
    new.finish().unwrap().into_inner()
}

/// A variable of a file, packed again where it was packed, or the bytes.
fn matlab(bytes: &[u8], random: &mut ChaCha8Rng) -> Vec<u8> {
    const HEADER: usize = 128;
    const PACKED: u32 = 15;
    let word = |at: usize| u32::from_le_bytes(bytes[at..at + 4].try_into().unwrap());
    if random.random_ratio(1, 3) || word(HEADER) != PACKED {
        return mutated::bytes(bytes, random);
    }
    let (mut changed, mut at) = (bytes[..HEADER].to_vec(), HEADER);
    while at < bytes.len() {
        let end = at + 8 + word(at + 4) as usize;
        let mut content = Vec::new();
        ZlibDecoder::new(&bytes[at + 8..end]).read_to_end(&mut content).unwrap();
        if random.random_ratio(1, 3) {
            content = mutated::bytes(&content, random);
        }
        let mut packed = ZlibEncoder::new(Vec::new(), Compression::fast());
        packed.write_all(&content).unwrap();
        let packed = packed.finish().unwrap();
        changed.extend([PACKED.to_le_bytes(), (packed.len() as u32).to_le_bytes()].concat());
        changed.extend(packed);
        at = end;
    }
    changed
}

fn read(path: &Path) -> Result<(), String> {
    read_with(path, &ReadOptions::default())
}

/// The joints are columns of the arrays `q` and `tau`.
fn arrays_of_joints() -> ReadOptions<'static> {
    static MAP: LazyLock<ColumnMap> = LazyLock::new(|| {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("map.toml");
        std::fs::write(&path, "position = \"q[:]\"\neffort = \"tau[:]\"\n").unwrap();
        ColumnMap::load(&path).unwrap()
    });
    ReadOptions { map: Some(&MAP), ..ReadOptions::default() }
}

fn read_arrays(path: &Path) -> Result<(), String> {
    read_with(path, &arrays_of_joints())
}

pub fn parse_with(path: &Path, options: &ReadOptions<'_>) -> Result<(), String> {
    read_run(path, &ROBOT, options).map(drop).map_err(|error| told(&error))
}

pub fn read_with(path: &Path, options: &ReadOptions<'_>) -> Result<(), String> {
    // What is there before the damage has to be usable as well.
    let torn = read_run_until_damage(path, &ROBOT, options);
    let run = match read_run(path, &ROBOT, options) {
        Ok(run) => run,
        Err(error) => {
            if let Ok((run, _)) = torn {
                let _ = prepare(&[run], &PrepareSettings::default());
            }
            return Err(told(&error));
        }
    };
    log_info(&run, &ROBOT);
    // Runs of few rows are too short to be prepared.
    let _ = prepare(&[run], &PrepareSettings::default());
    Ok(())
}

/// One sentence of few characters.
fn told(error: &logs::LogError) -> String {
    let told = error.to_string();
    // What the decoder of Parquet says is quoted as it is.
    let own = told.split("(Parquet ").next().unwrap();
    let is_one = !own.split(". ").skip(1).any(|next| next.starts_with(char::is_uppercase));
    assert!(is_one && !told.contains(char::is_control), "{told}");
    assert!(told.chars().count() < 600, "{told}");
    told
}
