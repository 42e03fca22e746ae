use faer::Mat;

/// Share of a column's square below which it counts as dependent on the columns before it.
const DEPENDENT: f64 = 1e-10;

/// Least squares on some columns, from their Gram matrix.
pub(super) struct Fit {
    /// One weight per column; 0 for columns that depend on others.
    pub weights: Vec<f64>,
    /// Sum of squares of the residual.
    pub square: f64,
}

/// Weights of `columns` for the column `target` of a Gram matrix, by elimination that takes the column with the
/// largest remaining share of its square first: `m³ / 3` multiplications for `m` columns.
///
/// A column is left out once less than 1e-10 of its square remains.
pub(super) fn fit(gram: &Mat<f64>, columns: &[usize], target: usize) -> Fit {
    let m = columns.len();
    let mut a: Vec<f64> =
        columns.iter().flat_map(|&i| columns.iter().map(move |&k| gram[(i, k)])).collect();
    let mut b: Vec<f64> = columns.iter().map(|&i| gram[(i, target)]).collect();
    let whole: Vec<f64> = columns.iter().map(|&i| gram[(i, i)]).collect();
    let (mut square, mut order) = (gram[(target, target)], Vec::with_capacity(m));
    let mut open: Vec<usize> = (0..m).collect();
    loop {
        let remaining_share = |p: usize| if whole[p] > 0.0 { a[p * m + p] / whole[p] } else { 0.0 };
        let best = (0..open.len())
            .max_by(|x, y| remaining_share(open[*x]).total_cmp(&remaining_share(open[*y])));
        let Some(best) = best.filter(|best| remaining_share(open[*best]) > DEPENDENT) else {
            break;
        };
        let p = open.swap_remove(best);
        let (pivot, row) = (a[p * m + p], a[p * m..(p + 1) * m].to_vec());
        square -= b[p] * b[p] / pivot;
        for &i in &open {
            let share = row[i] / pivot;
            b[i] -= share * b[p];
            for &k in &open {
                a[i * m + k] -= share * row[k];
            }
        }
        order.push(p);
    }
    let mut weights = vec![0.0; m];
    for &p in order.iter().rev() {
        // Rows keep the coefficients of what was open when they were eliminated.
        let later: f64 = (0..m).map(|k| a[p * m + k] * weights[k]).sum();
        weights[p] = (b[p] - later) / a[p * m + p];
    }
    Fit { weights, square: square.max(0.0) }
}

/// Sum of squares of the target minus `weights` times the columns, on the samples of a Gram matrix.
pub(super) fn square_left(
    gram: &Mat<f64>,
    columns: &[usize],
    weights: &[f64],
    target: usize,
) -> f64 {
    let mut square = gram[(target, target)];
    for (&i, w) in columns.iter().zip(weights) {
        square -= 2.0 * w * gram[(i, target)];
        for (&k, other) in columns.iter().zip(weights) {
            square += w * other * gram[(i, k)];
        }
    }
    square.max(0.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Columns (1, 1, 1), (0, 1, 2) and their sum, target (1, 3, 5): 1 + 2 k.
    #[test]
    fn a_line_is_fitted_and_a_dependent_column_takes_no_part() {
        let rows = [[1.0, 0.0, 1.0, 1.0], [1.0, 1.0, 2.0, 3.0], [1.0, 2.0, 3.0, 5.0]];
        let sum = |i: usize, k: usize| rows.iter().map(|r| r[i] * r[k]).sum::<f64>();
        let gram = Mat::from_fn(4, 4, sum);
        let line = fit(&gram, &[0, 1], 3);
        assert!((line.weights[0] - 1.0).abs() < 1e-12 && (line.weights[1] - 2.0).abs() < 1e-12);
        assert!(line.square < 1e-12);
        let all = fit(&gram, &[0, 1, 2], 3);
        assert!(all.square < 1e-12);
        assert!(square_left(&gram, &[0, 1, 2], &all.weights, 3) < 1e-12);
        // The constant alone leaves (-2, 0, 2).
        let constant = fit(&gram, &[0], 3);
        assert!((constant.square - 8.0).abs() < 1e-12);
        assert!((square_left(&gram, &[0], &[3.0], 3) - 8.0).abs() < 1e-12);
    }
}
