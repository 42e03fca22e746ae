use crate::common::bounds::MOST_COLUMNS;

/// An array of numbers, stored column by column.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Array {
    /// Name of the array, after the names of the structures that hold it: `log.q`.
    pub name: String,
    pub rows: u64,
    pub columns: u64,
    pub numbers: Vec<f64>,
}

/// Reason for refusing a small file that unpacks to too many numbers.
pub(crate) const TOO_LARGE: &str = "its numbers take more than is allowed of a file of this size";

impl Array {
    /// Whether it has one row or one column.
    pub(crate) fn is_vector(&self) -> bool {
        self.rows == 1 || self.columns == 1
    }

    /// Columns of the array by name; empty if it has too many. `samples` is the length of the column of time.
    pub(crate) fn columns(&self, samples: Option<u64>) -> Vec<(String, Vec<f64>)> {
        let Self { name, rows, columns, numbers } = self;
        if self.is_vector() {
            return vec![(name.clone(), numbers.clone())];
        }
        let is_turned = Some(*rows) != samples && Some(*columns) == samples;
        let width = if is_turned { *rows } else { *columns };
        // One with more is a picture or a list of features.
        if !(1..=MOST_COLUMNS as u64).contains(&width) {
            return vec![];
        }
        let (width, rows) = (width as usize, *rows as usize);
        let column = |k: usize| -> Vec<f64> {
            if is_turned {
                numbers.iter().skip(k).step_by(rows).copied().collect()
            } else {
                numbers.iter().skip(k * rows).take(rows).copied().collect()
            }
        };
        (0..width).map(|k| (format!("{name}[{k}]"), column(k))).collect()
    }
}
