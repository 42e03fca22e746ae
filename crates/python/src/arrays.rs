use numpy::{PyArray, PyArray1, PyArrayDyn, PyArrayMethods, PyUntypedArrayMethods};
use pyo3::exceptions::{PyTypeError, PyValueError};
use pyo3::prelude::*;
use pyo3::types::PyDict;

/// Kinds of NumPy's types that are read as numbers: integers with and without a sign, and floats.
const KINDS: &str = "iuf";

/// Numbers that are checked together.
const BLOCK: usize = 1024;

/// What the columns of a table are.
#[derive(Clone, Copy)]
pub enum TableColumns<'a> {
    /// Those of joints with names.
    Joints(&'a [String]),
    /// As many as another table has.
    Count(usize),
    /// Any number, of a table.
    Any,
}

impl TableColumns<'_> {
    fn fit(self, shape: &[usize]) -> bool {
        match (self, shape) {
            (Self::Joints(joints), [.., n]) => *n == joints.len() && shape.len() <= 2,
            (Self::Count(count), [.., n]) => *n == count && shape.len() <= 2,
            (Self::Any, [_, n]) => *n > 0,
            _ => false,
        }
    }

    /// What was expected of a shape.
    fn words(self) -> String {
        match self {
            Self::Joints(joints) => {
                let (n, names) = (joints.len(), joints.join(", "));
                format!("(samples, {n}) was expected, one column a joint: {names}")
            }
            Self::Count(n) => format!("(samples, {n}) was expected, one column a joint as in q"),
            Self::Any => "(samples, joints) was expected".to_owned(),
        }
    }

    fn place(self, column: usize) -> String {
        match self {
            Self::Joints(joints) => format!("joint {}", joints[column]),
            Self::Count(_) | Self::Any => format!("column {column}"),
        }
    }
}

/// Rows of numbers, one column a joint, row by row.
pub struct SampleRows {
    numbers: Vec<f64>,
    shape: [usize; 2],
    /// Whether one row was given, and not a table of rows.
    pub is_single: bool,
}

impl SampleRows {
    /// The argument `name`, of the shape (samples, joints) or (joints,).
    ///
    /// The numbers are a copy, made and checked while this thread holds the lock of the interpreter: NumPy lets another
    /// thread write into an array that is being read.
    ///
    /// # Errors
    ///
    /// `TypeError` for what holds no real numbers, `ValueError` for another shape and for a number that
    /// is masked or not finite; both name the argument.
    pub fn new(name: &str, value: &Bound<'_, PyAny>, columns: TableColumns<'_>) -> PyResult<Self> {
        let array = numbers(name, value)?;
        let shape = array.shape().to_vec();
        let n = match shape.last() {
            Some(n) if columns.fit(&shape) => *n,
            _ => {
                let (shape, expected) = (shape_words(&shape), columns.words());
                return Err(PyValueError::new_err(format!(
                    "{name}: its shape is {shape}, {expected}"
                )));
            }
        };
        let is_single = shape.len() == 1;
        let rows = shape.iter().product::<usize>() / n.max(1);
        let numbers = copy(name, &array)?;
        finite(name, &numbers, |index| {
            let row = if is_single { String::new() } else { format!("row {}, ", index / n) };
            format!("{row}{}", columns.place(index % n))
        })?;
        Ok(Self { numbers, shape: [rows, n], is_single })
    }

    /// Number of columns.
    pub fn width(&self) -> usize {
        self.shape[1]
    }

    /// Number of rows.
    pub fn len(&self) -> usize {
        self.shape[0]
    }

    /// The numbers, row by row.
    pub fn as_slice(&self) -> &[f64] {
        &self.numbers
    }

    /// The numbers, row by row.
    pub fn into_numbers(self) -> Vec<f64> {
        self.numbers
    }

    /// The columns, one a joint.
    pub fn columns(&self) -> Vec<Vec<f64>> {
        let n = self.width();
        let column = |j| self.numbers.iter().skip(j).step_by(n.max(1)).copied().collect();
        (0..n).map(column).collect()
    }
}

/// Refuses arguments that do not have as many rows as the first.
pub fn same_rows(rows: [(&str, &SampleRows); 3]) -> PyResult<()> {
    let [(first_name, first), ..] = rows;
    let other = rows.iter().find(|(_, r)| r.len() != first.len() || r.is_single != first.is_single);
    match other {
        None => Ok(()),
        Some((name, other)) => Err(PyValueError::new_err(format!(
            "{name}: its shape is {}, that of {first_name} is {}: both were expected to be alike",
            shape_words(other.shape()),
            shape_words(first.shape())
        ))),
    }
}

impl SampleRows {
    fn shape(&self) -> &[usize] {
        if self.is_single { &self.shape[1..] } else { &self.shape }
    }
}

/// The argument `name` as a vector of numbers.
///
/// # Errors
///
/// As [`SampleRows::new`].
pub fn vector(name: &str, value: &Bound<'_, PyAny>) -> PyResult<Vec<f64>> {
    let array = numbers(name, value)?;
    if array.ndim() != 1 {
        let shape = shape_words(array.shape());
        return Err(PyValueError::new_err(format!(
            "{name}: its shape is {shape}, (samples,) was expected"
        )));
    }
    copy(name, &array)
}

/// A table as an array of NumPy, made of its numbers row by row without a copy; of one row alone a
/// vector.
pub fn table<'py>(
    py: Python<'py>,
    numbers: Vec<f64>,
    columns: usize,
    is_single: bool,
) -> PyResult<Bound<'py, PyArrayDyn<f64>>> {
    let rows = numbers.len() / columns.max(1);
    let array = PyArray1::from_vec(py, numbers);
    array.reshape(if is_single { vec![columns] } else { vec![rows, columns] })
}

/// Columns as a table.
pub fn rows_of(columns: &[&[f64]]) -> Vec<f64> {
    let samples = columns.first().map_or(0, |column| column.len());
    (0..samples).flat_map(|k| columns.iter().map(move |column| column[k])).collect()
}

/// The numbers of an array in the order of C, copied.
fn copy(name: &str, array: &Bound<'_, PyArrayDyn<f64>>) -> PyResult<Vec<f64>> {
    let array = array.try_readonly().map_err(|e| busy(name, &e))?;
    Ok(array.as_slice()?.to_vec())
}

/// Float64 in the order of C, of whatever NumPy takes for an array of real numbers.
fn numbers<'py>(name: &str, value: &Bound<'py, PyAny>) -> PyResult<Bound<'py, PyArrayDyn<f64>>> {
    let py = value.py();
    let numpy = py.import("numpy")?;
    let no_numbers = |found: String| {
        PyTypeError::new_err(format!(
            "{name}: found {found}, an array of real numbers was expected"
        ))
    };
    if numpy.getattr("ma")?.call_method1("is_masked", (value,))?.extract()? {
        return Err(PyValueError::new_err(format!(
            "{name}: some of its numbers are masked, an array of all of them was expected"
        )));
    }
    let array = numpy
        .call_method1("asarray", (value,))
        .map_err(|error| no_numbers(format!("{} ({})", type_name(value), error.value(py))))?;
    let dtype = array.getattr("dtype")?;
    let kind: String = dtype.getattr("kind")?.extract()?;
    if !KINDS.contains(&kind) {
        return Err(no_numbers(format!("{} of dtype {dtype}", type_name(value))));
    }
    let options = PyDict::new(py);
    options.set_item("dtype", "float64")?;
    // A vector or scalar of no dimension stays so: ascontiguousarray would give it one.
    options.set_item("order", "C")?;
    let array = numpy.call_method("asarray", (array,), Some(&options))?;
    let array = array.cast_into::<PyArray<f64, _>>().map_err(PyErr::from)?;
    if array.is_c_contiguous() && array.getattr("flags")?.getattr("aligned")?.extract()? {
        return Ok(array);
    }
    let copy = array.call_method0("copy")?;
    copy.cast_into::<PyArray<f64, _>>().map_err(PyErr::from)
}

fn finite(name: &str, all: &[f64], place: impl Fn(usize) -> String) -> PyResult<()> {
    // Without an end at the first one, so that several are looked at at once.
    let holds = |block: &[f64]| block.iter().fold(true, |holds, x| holds & x.is_finite());
    if all.chunks(BLOCK).all(holds) {
        return Ok(());
    }
    match all.iter().position(|x| !x.is_finite()) {
        None => Ok(()),
        Some(index) => Err(PyValueError::new_err(format!(
            "{name}: {}: found {}, a finite number was expected",
            place(index),
            all[index]
        ))),
    }
}

fn busy(name: &str, error: &numpy::BorrowError) -> PyErr {
    PyValueError::new_err(format!("{name}: it is being written: {error}"))
}

/// The name of a value's type.
pub fn type_name(value: &Bound<'_, PyAny>) -> String {
    value.get_type().name().map_or_else(|_| "a value".to_owned(), |name| name.to_string())
}

/// A shape as Python writes it.
fn shape_words(shape: &[usize]) -> String {
    match shape {
        [only] => format!("({only},)"),
        all => format!("({})", all.iter().map(usize::to_string).collect::<Vec<_>>().join(", ")),
    }
}
