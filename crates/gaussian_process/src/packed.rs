use crate::panels::{ROWS, SQUARE};

/// A symmetric matrix, every panel of it up to its diagonal block: panel `p` holds the columns
/// `0..ROWS (p + 1)`. Diagonal blocks are whole.
#[derive(Debug, Clone)]
pub(crate) struct Packed {
    values: Vec<f64>,
    rows: usize,
}

/// Numbers before panel `p`.
fn offset(p: usize) -> usize {
    SQUARE * (p * (p + 1) / 2)
}

impl Packed {
    /// Zero, of `rows` rows.
    pub fn new(rows: usize) -> Self {
        Self { values: vec![0.0; Self::numbers(rows)], rows }
    }

    /// Numbers stored of `rows` rows.
    pub fn numbers(rows: usize) -> usize {
        offset(rows.div_ceil(ROWS))
    }

    /// Number of rows.
    pub fn rows(&self) -> usize {
        self.rows
    }

    /// Number of panels.
    pub fn panels(&self) -> usize {
        self.rows.div_ceil(ROWS)
    }

    /// Panel `p`.
    pub fn panel(&self, p: usize) -> &[f64] {
        &self.values[offset(p)..offset(p + 1)]
    }

    /// Square block `j` of panel `p`, for `j <= p`.
    pub fn block(&self, p: usize, j: usize) -> &[f64] {
        &self.panel(p)[j * SQUARE..][..SQUARE]
    }

    /// The diagonal.
    pub fn diagonal(&self) -> impl Iterator<Item = f64> {
        (0..self.rows).map(|i| self.values[diagonal(i)])
    }

    /// The rows that fill up the last panel become those of `value` times the identity.
    pub fn fill(&mut self, value: f64) {
        let (n, last) = (self.rows, self.panels() - 1);
        let end = self.panels() * ROWS;
        let panel = &mut self.values[offset(last)..];
        for (column, rows) in panel.chunks_exact_mut(ROWS).enumerate() {
            let from = if column < n { n } else { last * ROWS };
            rows[from - last * ROWS..].fill(0.0);
        }
        for i in n..end {
            self.values[diagonal(i)] = value;
        }
    }

    /// Panels in groups of at most `size`.
    pub fn groups_mut(&mut self, size: usize) -> Vec<PanelGroup<'_>> {
        let panels = self.panels();
        let mut rest = self.values.as_mut_slice();
        let mut groups = Vec::with_capacity(panels.div_ceil(size));
        for first in (0..panels).step_by(size) {
            let end = (first + size).min(panels);
            let (values, after) = rest.split_at_mut(offset(end) - offset(first));
            groups.push(PanelGroup { first, end, values });
            rest = after;
        }
        groups
    }
}

/// Where entry `(i, i)` is.
fn diagonal(i: usize) -> usize {
    offset(i / ROWS) + i * ROWS + i % ROWS
}

/// Consecutive panels `first..end`.
#[derive(Debug)]
pub(crate) struct PanelGroup<'a> {
    pub first: usize,
    pub end: usize,
    values: &'a mut [f64],
}

impl PanelGroup<'_> {
    /// Panel `p`.
    pub fn panel(&mut self, p: usize) -> &mut [f64] {
        let start = offset(self.first);
        &mut self.values[offset(p) - start..offset(p + 1) - start]
    }
}

#[cfg(test)]
impl Packed {
    /// The matrix with these entries of its lower triangle, padded with the identity.
    pub fn from_entries(rows: usize, entry: impl Fn(usize, usize) -> f64) -> Self {
        let mut matrix = Self::new(rows);
        for p in 0..matrix.panels() {
            let start = offset(p);
            for column in 0..(p + 1) * ROWS {
                for row in p * ROWS..((p + 1) * ROWS).min(rows) {
                    let at = start + column * ROWS + row % ROWS;
                    matrix.values[at] = entry(row.max(column), row.min(column));
                }
            }
        }
        matrix.fill(1.0);
        matrix
    }

    /// Entry `(i, j)`.
    pub fn entry(&self, i: usize, j: usize) -> f64 {
        let (i, j) = (i.max(j), i.min(j));
        self.panel(i / ROWS)[j * ROWS + i % ROWS]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_rows_that_fill_up_the_last_panel_are_those_of_the_identity() {
        let matrix = Packed::from_entries(25, |_, _| 7.0);
        assert_eq!(matrix.panels(), 2);
        for i in 0..48 {
            for j in 0..48 {
                let expected = if i.max(j) < 25 { 7.0 } else { f64::from(i == j) };
                assert_eq!(matrix.entry(i, j).to_bits(), f64::to_bits(expected), "({i}, {j})");
            }
        }
    }

    #[test]
    fn groups_are_the_panels_in_order() {
        let mut matrix = Packed::from_entries(5 * ROWS, |i, j| (1000 * i + j) as f64);
        let copy = matrix.clone();
        let mut next = 0;
        for mut group in matrix.groups_mut(2) {
            assert_eq!(group.first, next);
            for p in group.first..group.end {
                assert_eq!(group.panel(p), copy.panel(p));
            }
            next = group.end;
        }
        assert_eq!(next, 5);
    }
}
