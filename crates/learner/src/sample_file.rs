use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::{Path, PathBuf};
use std::sync::Arc;

use arrow_array::cast::AsArray;
use arrow_array::types::Float64Type;
use arrow_array::{Array, ArrayRef, Float64Array, RecordBatch};
use dynamics::DynamicsError;
use logs::{LogError, WholeFile};
use parquet::arrow::ArrowWriter;
use parquet::arrow::arrow_reader::{ParquetRecordBatchReader, ParquetRecordBatchReaderBuilder};
use parquet::file::properties::WriterProperties;

use crate::error::LearnerError;
use crate::sample_source::{BLOCK, SampleSource};
use crate::samples::{SampleSlices, Samples};

/// Signals of a sample, in the order of the columns.
const SIGNALS: [&str; 4] = ["q", "qd", "qdd", "tau"];

/// What is said of a file at which the decoder panics.
const GAVE_UP: &str = "the decoder gave up";

/// Rows of a part of the file, which the writer holds until it is full.
const ROW_GROUP: usize = 2 * BLOCK;

/// Samples in a Parquet file that are learned from without being held in memory: columns `q_1` .., `qd_1` ..,
/// `qdd_1` .., `tau_1` .., one a joint, in rad, rad/s, rad/s² and N·m (m, m/s, m/s² and N at a prismatic joint).
#[derive(Debug, Clone)]
pub struct SampleFile {
    path: PathBuf,
    joints: usize,
    samples: usize,
}

/// Writes a [`SampleFile`], stretch after stretch.
pub struct SampleWriter<'a> {
    path: &'a Path,
    joints: usize,
    writer: ArrowWriter<&'a mut WholeFile>,
}

impl SampleFile {
    /// Writes the samples of `joints` joints that `fill` adds. The file appears under its name when it is complete.
    ///
    /// # Errors
    ///
    /// What `fill` returns, and [`LearnerError::Log`] when the file cannot be written; an earlier file of that name is then
    /// untouched.
    pub fn write(
        path: &Path,
        joints: usize,
        fill: impl FnOnce(&mut SampleWriter) -> Result<(), LearnerError>,
    ) -> Result<Self, LearnerError> {
        let mut refusal = None;
        let written = logs::replace_file(path, |file| {
            let mut writer = SampleWriter::new(file, path, joints)?;
            refusal = fill(&mut writer).err();
            match refusal {
                Some(_) => Err("what was to be written was refused".into()),
                None => writer.writer.close().map(|_| ()).map_err(Into::into),
            }
        });
        refusal.map_or(Ok(()), Err)?;
        written?;
        Self::open(path)
    }

    /// The samples of a file that [`SampleFile::write`] has written.
    ///
    /// # Errors
    ///
    /// [`LearnerError::NotSamples`] for a file that cannot be read, or has other columns.
    pub fn open(path: &Path) -> Result<Self, LearnerError> {
        let found = columns_and_rows(path);
        let (names, samples) = found.map_err(|reason| refusal(path, reason))?;
        let joints = names.len() / SIGNALS.len();
        let expected = column_names(joints.max(1));
        if names != expected {
            let first = names.iter().zip(&expected).find(|(found, expected)| found != expected);
            let reason = match first {
                Some((found, expected)) => format!("column {found} was found, {expected} expected"),
                None => format!("{} columns were found, {} expected", names.len(), expected.len()),
            };
            return Err(refusal(path, reason));
        }
        Ok(Self { path: path.to_owned(), joints, samples })
    }

    /// The samples `first + k` of a batch that come next in `chosen`, an ascending sequence.
    fn chosen_of(batch: &Samples, first: usize, chosen: &[usize]) -> Samples {
        let from = chosen.partition_point(|&i| i < first);
        let to = chosen.partition_point(|&i| i < first + batch.len());
        batch.select(chosen[from..to].iter().map(|i| i - first))
    }
}

impl SampleSource for SampleFile {
    fn joints(&self) -> usize {
        self.joints
    }

    fn len(&self) -> usize {
        self.samples
    }

    fn blocks(
        &self,
        take: &mut dyn FnMut(&Samples) -> Result<(), LearnerError>,
    ) -> Result<(), LearnerError> {
        let reader = builder(&self.path).and_then(|builder| {
            let built: Result<ParquetRecordBatchReader, _> = builder.with_batch_size(BLOCK).build();
            built.map_err(|e| e.to_string())
        });
        let mut reader = reader.map_err(|reason| refusal(&self.path, reason))?;
        // Damaged pages, as a damaged footer (see `builder`).
        let mut next = || catch_unwind(AssertUnwindSafe(|| reader.next()));
        while let Some(batch) = next().map_err(|_| refusal(&self.path, GAVE_UP.to_owned()))? {
            let batch = batch.map_err(|e| refusal(&self.path, e.to_string()))?;
            let samples = samples_of(&batch, self.joints);
            take(&samples.map_err(|reason| refusal(&self.path, reason))?)?;
        }
        Ok(())
    }

    fn thin(&self, points: usize) -> Result<Samples, LearnerError> {
        let n = self.samples;
        let points = points.min(n);
        let chosen: Vec<usize> = (0..points).map(|i| i * n / points).collect();
        let (mut kept, mut first) =
            (Samples::of_signals(self.joints, [(); 4].map(|()| Vec::new())), 0);
        self.blocks(&mut |block| {
            kept.append(&Self::chosen_of(block, first, &chosen));
            first += block.len();
            Ok(())
        })?;
        Ok(kept)
    }
}

impl<'a> SampleWriter<'a> {
    fn new(file: &'a mut WholeFile, path: &'a Path, joints: usize) -> Result<Self, String> {
        let none = SampleSlices { q: &[], qd: &[], qdd: &[], tau: &[] };
        let schema = batch_of(joints, none)?.schema();
        let properties = WriterProperties::builder().set_max_row_group_row_count(Some(ROW_GROUP));
        let writer = ArrowWriter::try_new(file, schema, Some(properties.build()));
        Ok(Self { path, joints, writer: writer.map_err(|e| e.to_string())? })
    }

    /// Adds the next samples.
    ///
    /// # Errors
    ///
    /// [`DynamicsError::WrongLength`] when the signals do not have the same whole number of samples of all joints, and
    /// [`LearnerError::Log`].
    pub fn add(&mut self, stretch: SampleSlices) -> Result<(), LearnerError> {
        let rows = stretch.q.len() / self.joints.max(1);
        let named =
            [("q", stretch.q), ("qd", stretch.qd), ("qdd", stretch.qdd), ("tau", stretch.tau)];
        for (vector, values) in named {
            let (expected, got) = (rows * self.joints, values.len());
            if got != expected {
                return Err(DynamicsError::WrongLength { vector, expected, got }.into());
            }
        }
        let written = batch_of(self.joints, stretch)
            .and_then(|batch| self.writer.write(&batch).map_err(|e| e.to_string()));
        let unwritable = |reason| LogError::Unwritable { path: self.path.to_owned(), reason };
        Ok(written.map_err(unwritable)?)
    }
}

fn refusal(path: &Path, reason: String) -> LearnerError {
    LearnerError::NotSamples { path: path.to_owned(), reason }
}

fn builder(path: &Path) -> Result<ParquetRecordBatchReaderBuilder<std::fs::File>, String> {
    let file = files::open(path).map_err(|e| e.to_string())?;
    logs::check_parquet_nesting(&file)?;
    // The decoder panics at some damaged files instead of refusing them.
    let built = catch_unwind(|| ParquetRecordBatchReaderBuilder::try_new(file));
    built.map_err(|_| GAVE_UP.to_owned())?.map_err(|e| e.to_string())
}

fn columns_and_rows(path: &Path) -> Result<(Vec<String>, usize), String> {
    let builder = builder(path)?;
    let names = builder.schema().fields().iter().map(|field| field.name().clone()).collect();
    let rows = builder.metadata().file_metadata().num_rows();
    Ok((names, usize::try_from(rows).map_err(|_| format!("{rows} rows"))?))
}

/// `q_1`, `q_2` .. `tau_1`, `tau_2` ..
fn column_names(joints: usize) -> Vec<String> {
    let of = |signal: &str| (1..=joints).map(move |j| format!("{signal}_{j}")).collect::<Vec<_>>();
    SIGNALS.iter().flat_map(|signal| of(signal)).collect()
}

fn batch_of(joints: usize, stretch: SampleSlices) -> Result<RecordBatch, String> {
    let signals = [stretch.q, stretch.qd, stretch.qdd, stretch.tau];
    let column = |signal: &[f64], j: usize| -> ArrayRef {
        let values: Vec<f64> = signal.iter().skip(j).step_by(joints).copied().collect();
        Arc::new(Float64Array::from(values))
    };
    let columns = signals.iter().flat_map(|signal| (0..joints).map(move |j| (*signal, j)));
    let columns = columns.map(|(signal, j)| column(signal, j));
    let batch = RecordBatch::try_from_iter(column_names(joints).into_iter().zip(columns));
    batch.map_err(|e| e.to_string())
}

fn samples_of(batch: &RecordBatch, joints: usize) -> Result<Samples, String> {
    let rows = batch.num_rows();
    let mut signals = [(); SIGNALS.len()].map(|()| vec![0.0; rows * joints]);
    for (index, (name, array)) in column_names(joints).iter().zip(batch.columns()).enumerate() {
        let numbers = array.as_primitive_opt::<Float64Type>().filter(|a| a.null_count() == 0);
        let numbers = numbers.ok_or_else(|| format!("column {name} does not hold numbers"))?;
        let signal = signals[index / joints].iter_mut().skip(index % joints).step_by(joints);
        signal.zip(numbers.values()).for_each(|(to, from)| *to = *from);
    }
    Ok(Samples::of_signals(joints, signals))
}
