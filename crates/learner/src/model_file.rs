use std::panic::catch_unwind;
use std::path::Path;
use std::sync::Arc;

use arrow_array::builder::{Float64Builder, ListBuilder};
use arrow_array::cast::AsArray;
use arrow_array::types::Float64Type;
use arrow_array::{Array, ArrayRef, Float64Array};
use gaussian_process::{GaussianKernel, KernelSum, Likelihood};
use logs::LogError;
use parquet::arrow::arrow_reader::ParquetRecordBatchReaderBuilder;
use parquet::file::metadata::KeyValue;
use robot::Robot;

use crate::error::LearnerError;
use crate::model::{Mean, Model, Process};
use crate::saved::{ModelHeader, VERSION, symmetric, tree_sha256};
use crate::spread::Spread;
use crate::training;

/// Key of the header among the metadata of the file.
const HEADER: &str = "plumbline.model";

impl Model {
    /// Writes the model as Parquet: one row a point with its inputs (`x_1` ..), the weight of
    /// every joint (`alpha_1` ..) and, of inducing points, a row of the factor of the variance
    /// (`variance_factor_1` ..); everything else as JSON in the metadata.
    ///
    /// The inverse covariances of an exact process are not written: see
    /// [`with_variance`](Self::with_variance).
    ///
    /// # Errors
    ///
    /// [`LearnerError::Log`] when the file cannot be written; what was there before stays.
    pub fn save(&self, path: &Path) -> Result<(), LearnerError> {
        Ok(logs::write_table(path, self.table(), vec![self.header(path)?])?)
    }

    /// The bytes of the file that [`Model::save`] writes.
    ///
    /// # Errors
    ///
    /// [`LearnerError::Log`] with `path`, the file that they are for.
    pub fn bytes(&self, path: &Path) -> Result<Vec<u8>, LearnerError> {
        Ok(logs::table_bytes(path, self.table(), vec![self.header(path)?])?)
    }

    fn header(&self, path: &Path) -> Result<KeyValue, LearnerError> {
        let unwritable = |e: serde_json::Error| LogError::Unwritable {
            path: path.to_owned(),
            reason: e.to_string(),
        };
        let header = serde_json::to_string(&ModelHeader::of(self)).map_err(unwritable)?;
        Ok(KeyValue::new(HEADER.to_owned(), header))
    }

    fn table(&self) -> Vec<(String, ArrayRef)> {
        let column = |values: Vec<f64>| Arc::new(Float64Array::from(values)) as ArrayRef;
        let Some(process) = &self.process else {
            return vec![("x_1".to_owned(), column(Vec::new()))];
        };
        let (points, width) = (process.sum.points(), process.inputs.width());
        let mut columns: Vec<(String, ArrayRef)> = (0..width)
            .map(|d| {
                let values = points.iter().skip(d).step_by(width).copied().collect();
                (format!("x_{}", d + 1), column(values))
            })
            .collect();
        for k in 0..self.noise_variance.len() {
            columns.push((format!("alpha_{}", k + 1), column(process.sum.alpha(k))));
        }
        if let Some(Spread::Inducing(posteriors)) = &process.spread {
            for (k, posterior) in posteriors.iter().enumerate() {
                let rows = lower_rows(&posterior.variance_factor, posterior.alpha.len());
                columns.push((format!("variance_factor_{}", k + 1), rows));
            }
        }
        columns
    }

    /// Reads a model of `robot` that [`save`](Self::save) has written.
    ///
    /// A process over all its points has its mean alone; [`with_variance`](Self::with_variance)
    /// computes the rest.
    ///
    /// # Errors
    ///
    /// [`LearnerError::NotAModel`] for a file that is damaged, of another version, or whose
    /// parts do not fit together; [`LearnerError::OtherRobot`] for a model of a robot with
    /// other joints.
    pub fn load(path: &Path, robot: &Robot) -> Result<Self, LearnerError> {
        let broken = |reason: String| LearnerError::NotAModel { path: path.to_owned(), reason };
        // The decoder panics at some damaged files instead of refusing them.
        let read =
            catch_unwind(|| read(path)).unwrap_or_else(|_| Err("the decoder gave up".into()));
        let (header, columns) = read.map_err(broken)?;
        if header.version != VERSION {
            let found = header.version;
            return Err(broken(format!("version {found}, this program reads version {VERSION}")));
        }
        if header.tree_sha256 != tree_sha256(robot) {
            return Err(LearnerError::OtherRobot {
                path: path.to_owned(),
                found: header.robot,
                found_joints: header.joints.join(", "),
                expected: robot.name().to_owned(),
            });
        }
        restore(&header, columns, robot).map_err(broken)
    }

    /// The model with what its variance is computed from. It is computed again where the file lacks
    /// it: an inversion of the covariance of all points for every joint.
    ///
    /// # Errors
    ///
    /// [`LearnerError::Memory`] and what the Gaussian process refuses.
    pub fn with_variance(mut self) -> Result<Self, LearnerError> {
        let uncertain = !self.weights.is_empty();
        let robot = self.robot().clone();
        let Some(process) = &mut self.process else { return Ok(self) };
        if process.spread.is_some() {
            return Ok(self);
        }
        let (points, joints) = (process.sum.points(), self.noise_variance.len());
        crate::memory::check(process.sum.len(), joints)?;
        let mut inverse = Vec::new();
        for (kernel, &noise) in process.sum.kernels().iter().zip(&self.noise_variance) {
            let likelihood = Likelihood::new(&points, process.inputs.width())?;
            inverse.push(likelihood.condition(kernel, noise)?);
        }
        let features = match &self.mean {
            Mean::Columns { set, .. } if uncertain => {
                training::features(&robot, *set, &process.inputs.samples(&points))
            }
            _ => Vec::new(),
        };
        process.spread = Some(Spread::Exact { inverse, features });
        Ok(self)
    }
}

/// Row `i` of a lower triangular matrix as a list of `i + 1` numbers.
fn lower_rows(matrix: &[f64], width: usize) -> ArrayRef {
    let mut rows = ListBuilder::new(Float64Builder::new());
    for (i, row) in matrix.chunks_exact(width.max(1)).enumerate() {
        rows.values().append_slice(&row[..=i]);
        rows.append(true);
    }
    Arc::new(rows.finish())
}

/// Columns by name; lists are of numbers, one after the other.
type Columns = Vec<(String, Vec<f64>)>;

fn read(path: &Path) -> Result<(ModelHeader, Columns), String> {
    let say = |e: &dyn std::fmt::Display| e.to_string();
    let file = files::open(path).map_err(|e| say(&e))?;
    logs::check_parquet_nesting(&file)?;
    let builder = ParquetRecordBatchReaderBuilder::try_new(file).map_err(|e| say(&e))?;
    let metadata = builder.metadata().file_metadata().key_value_metadata();
    let header = metadata.and_then(|all| all.iter().find(|entry| entry.key == HEADER));
    let header = header.and_then(|entry| entry.value.as_deref());
    let header = header.ok_or("it has no header of a model")?;
    let version: serde_json::Value = serde_json::from_str(header).map_err(|e| say(&e))?;
    if let Some(version) = version.get("version").filter(|v| **v != VERSION) {
        return Err(format!("version {version}, this program reads version {VERSION}"));
    }
    let header: ModelHeader = serde_json::from_str(header).map_err(|e| say(&e))?;
    let mut columns: Columns = Vec::new();
    for batch in builder.build().map_err(|e| say(&e))? {
        let batch = batch.map_err(|e| say(&e))?;
        for (index, (field, array)) in
            batch.schema().fields().iter().zip(batch.columns()).enumerate()
        {
            if columns.len() == index {
                columns.push((field.name().clone(), Vec::new()));
            }
            append(array, &mut columns[index].1)
                .ok_or_else(|| format!("column {} does not hold numbers", field.name()))?;
        }
    }
    Ok((header, columns))
}

fn append(array: &ArrayRef, values: &mut Vec<f64>) -> Option<()> {
    let numbers = match array.as_list_opt::<i32>() {
        Some(list) => list.values().clone(),
        None => array.clone(),
    };
    let numbers = numbers.as_primitive_opt::<Float64Type>().filter(|n| n.null_count() == 0)?;
    values.extend_from_slice(numbers.values());
    Some(())
}

fn restore(header: &ModelHeader, columns: Columns, robot: &Robot) -> Result<Model, String> {
    let kind = header.kind.parse()?;
    let joints = robot.joint_count();
    let mean = header.mean.restore(robot).ok_or("the mean does not fit the robot")?;
    if header.noise_variance.len() != joints {
        return Err(format!("{} noise variances for {joints} joints", header.noise_variance.len()));
    }
    let width = match &mean {
        Mean::Columns { beta, .. } => beta.first().map_or(0, Vec::len),
        Mean::Zero | Mean::Robot(_) => 0,
    };
    let mut model = Model::new(kind, robot, mean, header.noise_variance.clone());
    let weights = header.weights.iter().map(|triangle| symmetric(triangle, width));
    model.weights = weights.collect::<Option<_>>().ok_or("the covariance of the weights")?;
    if !model.weights.is_empty() && model.weights.len() != joints {
        return Err(format!("{} covariances of weights for {joints} joints", model.weights.len()));
    }
    model.process = process(header, columns, joints)?;
    Ok(model)
}

fn process(
    header: &ModelHeader,
    columns: Columns,
    joints: usize,
) -> Result<Option<Process>, String> {
    let Some(saved) = &header.process else { return Ok(None) };
    let inputs = saved.inputs(joints).ok_or("inputs and kernels do not fit the robot")?;
    let mut columns: std::collections::BTreeMap<String, Vec<f64>> = columns.into_iter().collect();
    let mut take = |name: String| columns.remove(&name).ok_or(format!("column {name} is missing"));
    let width = inputs.width();
    let x: Vec<Vec<f64>> = (1..=width).map(|d| take(format!("x_{d}"))).collect::<Result<_, _>>()?;
    let alpha: Vec<Vec<f64>> =
        (1..=joints).map(|k| take(format!("alpha_{k}"))).collect::<Result<_, _>>()?;
    let n = x.first().map_or(0, Vec::len);
    if x.iter().chain(&alpha).any(|column| column.len() != n) {
        return Err("its columns are of unequal length".to_owned());
    }
    let points: Vec<f64> = (0..n).flat_map(|i| x.iter().map(move |column| column[i])).collect();
    let kernels: Vec<GaussianKernel> = saved.kernels.iter().map(|k| k.restore()).collect();
    let sum = KernelSum::new(&points, width, &kernels, &alpha).map_err(|e| e.to_string())?;
    let mut spread = None;
    if let Some(all) = &saved.inducing {
        if all.len() != joints {
            return Err(format!("variances of {} joints, {joints} were expected", all.len()));
        }
        let mut posteriors = Vec::new();
        for (k, (saved, alpha)) in all.iter().zip(&alpha).enumerate() {
            let rows = take(format!("variance_factor_{}", k + 1))?;
            let factor = square(&rows, n).ok_or("a factor of the variance is not whole")?;
            posteriors.push(saved.restore(alpha.clone(), factor));
        }
        spread = Some(Spread::Inducing(posteriors));
    }
    Ok(Some(Process { inputs, sum, spread }))
}

/// The lower triangular matrix of its rows, row-major; none when they are not of `width`.
fn square(rows: &[f64], width: usize) -> Option<Vec<f64>> {
    let mut matrix = vec![0.0; width.checked_mul(width)?];
    let mut rest = rows;
    for (i, row) in matrix.chunks_exact_mut(width.max(1)).enumerate() {
        let (head, tail) = rest.split_at_checked(i + 1)?;
        row[..=i].copy_from_slice(head);
        rest = tail;
    }
    rest.is_empty().then_some(matrix)
}
