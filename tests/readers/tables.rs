//! Tables that the program writes and reads again: shards of campaigns and learned models.

use std::path::Path;
use std::sync::{Arc, LazyLock};

use arrow_array::cast::AsArray;
use arrow_array::types::{Float64Type, UInt64Type};
use arrow_array::{Array, ArrayRef, Float64Array, RecordBatch, StringArray, UInt64Array};
use benchmark::{Answers, Costs, HeldOut, Judgement, Record};
use checks::mutated;
use learner::{Model, ModelKind, Samples, SilentTraining, TrainSettings, Training};
use logs::{PrepareSettings, ReadOptions, prepare, read_run, rest_speeds};
use parquet::arrow::arrow_reader::ParquetRecordBatchReaderBuilder;
use parquet::file::metadata::KeyValue;
use population::{
    CauseRole, Corner, EffortClass, Knowledge, MotionClass, Origin, Strength, TrueCause, TruthSheet,
};
use rand::RngExt;
use rand_chacha::ChaCha8Rng;
use robot::Robot;
use simulator::Truth;

use super::{Reader, logs_of_kinds, robots};

static ROBOT: LazyLock<Robot> = LazyLock::new(|| Robot::from_urdf(robots::URDF).unwrap());

/// First and last bytes, names of types and of keys of Parquet, of shards and of models.
pub const PARQUET: &[&str] = &[
    "PAR1",
    "ARROW:schema",
    "time",
    "q",
    "plumbline.model",
    "{\"",
    "\":",
    "[[",
    "\x15",
    "\x2c",
    "\x4c",
];

pub fn readers() -> Vec<Reader> {
    let of = |name, seeds, read| Reader {
        name,
        file: "input.parquet",
        short: 800,
        seeds,
        parsed: None,
        change: changed,
        read,
        parse: read,
        words: PARQUET,
    };
    vec![
        of("shard", shards, |path| match Record::read(path) {
            Ok(_) => Ok(()),
            // The folder of a campaign says which file it is.
            Err(reason) => Err(format!("{}: {reason}", path.display())),
        }),
        of("model", models, |path| {
            let model = Model::load(path, &ROBOT).map_err(|e| e.to_string())?;
            drop(model.with_variance());
            Ok(())
        }),
    ]
}

/// A value, a name, a text of the metadata or a byte of a table is changed.
pub fn changed(bytes: &[u8], random: &mut ChaCha8Rng) -> Vec<u8> {
    if random.random_ratio(1, 4) {
        return mutated::bytes(bytes, random);
    }
    let builder = ParquetRecordBatchReaderBuilder::try_new(bytes::Bytes::copy_from_slice(bytes));
    let builder = builder.unwrap();
    let texts = builder.metadata().file_metadata().key_value_metadata().cloned();
    // The schema of Arrow is written anew.
    let mut texts: Vec<KeyValue> = texts.unwrap_or_default();
    texts.retain(|text| text.key != "ARROW:schema");
    let schema = Arc::clone(builder.schema());
    let rows = builder.build().unwrap().next();
    let batch = rows.map_or_else(|| RecordBatch::new_empty(schema), Result::unwrap);
    let mut columns: Vec<(String, ArrayRef)> = batch
        .schema()
        .fields()
        .iter()
        .map(|field| field.name().clone())
        .zip(batch.columns().iter().cloned())
        .collect();
    if !texts.is_empty() && random.random_ratio(1, 2) {
        let at = random.random_range(0..texts.len());
        let text = &mut texts[at];
        let old = text.value.clone().unwrap_or_default();
        text.value = Some(String::from_utf8_lossy(&mutated::text(&old, random)).into_owned());
    } else if !columns.is_empty() {
        let at = random.random_range(0..columns.len());
        match random.random_range(0..8) {
            0 => drop(columns.remove(at)),
            1 => {
                columns[at].0 =
                    String::from_utf8_lossy(&mutated::text(&columns[at].0, random)).into()
            }
            2 => {
                let other = random.random_range(0..columns.len());
                columns[at].1 = Arc::clone(&columns[other].1);
            }
            _ => columns[at].1 = changed_column(&columns[at].1, random),
        }
    }
    logs::table_bytes(Path::new("table"), columns, texts).unwrap_or_else(|_| bytes.to_vec())
}

/// The same with another value in one row.
fn changed_column(column: &ArrayRef, random: &mut ChaCha8Rng) -> ArrayRef {
    if column.is_empty() {
        return Arc::clone(column);
    }
    let row = random.random_range(0..column.len());
    if let Some(texts) = column.as_string_opt::<i32>() {
        let mut texts: Vec<Option<String>> = texts.iter().map(|t| t.map(str::to_owned)).collect();
        let old = texts[row].clone().unwrap_or_default();
        let new = String::from_utf8_lossy(&mutated::text(&old, random)).into_owned();
        texts[row] = (!random.random_ratio(1, 8)).then_some(new);
        return Arc::new(StringArray::from(texts));
    }
    if let Some(numbers) = column.as_primitive_opt::<Float64Type>() {
        let mut numbers: Vec<Option<f64>> = numbers.iter().collect();
        let new = mutated::odd_number(random);
        numbers[row] = (!random.random_ratio(1, 8)).then_some(new);
        return Arc::new(Float64Array::from(numbers));
    }
    if let Some(numbers) = column.as_primitive_opt::<UInt64Type>() {
        let mut numbers: Vec<Option<u64>> = numbers.iter().collect();
        numbers[row] = (!random.random_ratio(1, 8)).then(|| random.random());
        return Arc::new(UInt64Array::from(numbers));
    }
    Arc::new(StringArray::from(vec!["1"; column.len()]))
}

fn shards(folder: &Path) -> Vec<Vec<u8>> {
    let records: Vec<Record> = [Some("clean"), Some("backlash"), Some("any+any")]
        .into_iter()
        .chain([None, None])
        .enumerate()
        .map(|(task, hidden)| record(task, hidden))
        .collect();
    let mut failed = records[..2].to_vec();
    failed[0].score = Err("the log is too short".to_owned());
    [&records[..3], &records[3..], &failed]
        .map(|records| {
            let path = folder.join("shard.parquet");
            Record::write(&path, records).unwrap();
            std::fs::read(path).unwrap()
        })
        .to_vec()
}

/// A judged trial whose logs are refused.
fn record(task: usize, hidden: Option<&str>) -> Record {
    let truth = Truth::at_joint(catalogue::EffectKind::Backlash, "elbow", &[("gap", 0.001)]);
    let strength = Strength { sigmas: 50.0, share: 0.3, torque: 0.4 };
    let sheet = TruthSheet {
        seed: 40 + task as u64,
        corner: corner(),
        knowledge: Knowledge::Whole,
        joints: vec!["shoulder".to_owned(), "elbow".to_owned()],
        torque_rms: vec![10.0, 2.0],
        causes: vec![TrueCause { role: CauseRole::Hidden, truth, strength }],
        strangers: Vec::new(),
    };
    let answers = Answers {
        diagnosis: Err("the log is of another robot".to_owned()),
        held_out: HeldOut { nominal: Some(vec![Some(1.0), None]), ..HeldOut::default() },
        least_squares: Vec::new(),
        costs: Costs::default(),
    };
    Record {
        task,
        hidden: hidden.map(|name| name.parse().unwrap()),
        seed: sheet.seed,
        campaign: "0123456789".to_owned(),
        score: Ok(Box::new(Judgement::new(&sheet, &answers))),
    }
}

fn corner() -> Corner {
    Corner {
        origin: Origin::Simulated,
        arm: "cobot".to_owned(),
        motion: MotionClass::Sweep,
        effort: EffortClass::Current,
        joints: 2,
        encoder_step: 0.001,
        rate_hz: 250.0,
        logs: 2,
        length_s: 30.0,
        repeats: false,
        field: Vec::new(),
        log_kinds: Vec::new(),
        goal_delay_ms: None,
    }
}

fn models(folder: &Path) -> Vec<Vec<u8>> {
    let path = folder.join("run.csv");
    std::fs::write(&path, logs_of_kinds::long_csv()).unwrap();
    let run = read_run(&path, &ROBOT, &ReadOptions::default()).unwrap();
    let prepared = prepare(&[run], &PrepareSettings::default()).unwrap();
    let samples = Samples::new(&prepared);
    let search = gaussian_process::KernelSearch { starts: 1, start_points: 20, iterations: 5 };
    let settings =
        TrainSettings { points: 30, inducing_points: 10, search, ..TrainSettings::default() };
    let rest = rest_speeds(&prepared);
    let training = Training::new(&ROBOT, &samples, rest, &settings, &SilentTraining);
    let mut training = training.unwrap().with_named(&ROBOT);
    [ModelKind::Named, ModelKind::NamedGp, ModelKind::GpInducing]
        .map(|kind| {
            let path = folder.join("model.parquet");
            training.fit(kind).unwrap().model.save(&path).unwrap();
            std::fs::read(path).unwrap()
        })
        .to_vec()
}
