/// Rows of a panel: three registers of eight numbers.
pub(crate) const ROWS: usize = 24;

/// Numbers in a square block of a panel.
pub(crate) const SQUARE: usize = ROWS * ROWS;

/// A matrix in panels of [`ROWS`] rows, each column after column, so that what a product reads
/// of its three matrices is contiguous as it stands. The last panel is filled up with zeros.
#[derive(Debug, Clone, Default)]
pub(crate) struct Panels {
    values: Vec<f64>,
    columns: usize,
}

impl Panels {
    /// The matrix of `rows` rows and `columns` columns with these entries.
    pub fn new(rows: usize, columns: usize, entry: impl Fn(usize, usize) -> f64) -> Self {
        let mut values = Vec::with_capacity(rows.next_multiple_of(ROWS) * columns);
        for first in (0..rows).step_by(ROWS) {
            for column in 0..columns {
                let value = |row| if row < rows { entry(row, column) } else { 0.0 };
                values.extend((first..first + ROWS).map(value));
            }
        }
        Self { values, columns }
    }

    /// Number of columns.
    pub fn columns(&self) -> usize {
        self.columns
    }

    /// All panels, one after the other.
    pub fn values(&self) -> &[f64] {
        &self.values
    }

    /// Panel `p`.
    pub fn panel(&self, p: usize) -> &[f64] {
        let width = self.columns * ROWS;
        &self.values[p * width..][..width]
    }
}

/// The transpose of a square block.
#[inline(always)]
pub(crate) fn transpose(from: &[f64], to: &mut [f64]) {
    for (i, column) in from.chunks_exact(ROWS).enumerate() {
        for (j, &value) in column.iter().enumerate() {
            to[i + ROWS * j] = value;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_panel_is_columns_of_its_rows_filled_up_with_zeros() {
        let panels = Panels::new(ROWS + 1, 2, |row, column| (10 * row + column) as f64 + 1.0);
        let first = (0..2 * ROWS).map(|at| (10 * (at % ROWS) + at / ROWS) as f64 + 1.0);
        assert_eq!(panels.panel(0), first.collect::<Vec<_>>());
        let mut last = vec![0.0; 2 * ROWS];
        (last[0], last[ROWS]) = (241.0, 242.0);
        assert_eq!(panels.panel(1), last);
        assert_eq!((panels.columns(), panels.values().len()), (2, 4 * ROWS));
    }
}
