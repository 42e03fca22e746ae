use nalgebra::{DMatrix, DVector};

/// Columns beside the constant: nominal torque, direction, velocity, acceleration.
pub(crate) const COLUMNS: usize = 4;

/// Parameters of a drive beside the model, which are fitted here and are no error of the logs.
///
/// ```text
/// effort = c tau + f sign(qd) + b qd + i qdd + offset,   gain[0] <= c <= gain[1],  f, b, i >= 0
/// ```
#[derive(Debug, Clone, Copy)]
pub(crate) struct Drive {
    /// Least and largest factor `c`.
    pub gain: [f64; 2],
}

/// The least squares fit of a drive.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Fitted {
    /// Squares of the residual over those of the effort about its mean.
    pub share: f64,
    /// `c`, `f`, `b`, `i` above, in units of the columns.
    pub coefficients: [f64; COLUMNS],
}

impl Fitted {
    /// Viscous friction `b`.
    pub fn b(&self) -> f64 {
        self.coefficients[2]
    }
}

/// Sums of products of the columns and the effort of a joint, about their means.
#[derive(Debug, Clone)]
pub(crate) struct ProductSums {
    gram: DMatrix<f64>,
    right: DVector<f64>,
    total: f64,
}

impl ProductSums {
    /// From columns and effort, one value a row.
    pub fn of(columns: [&[f64]; COLUMNS], effort: &[f64]) -> Self {
        let mean = |x: &[f64]| x.iter().sum::<f64>() / x.len().max(1) as f64;
        let centred = |x: &[f64]| {
            let mean = mean(x);
            x.iter().map(|v| v - mean).collect::<Vec<f64>>()
        };
        let columns = columns.map(centred);
        let effort = centred(effort);
        let dot = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(x, y)| x * y).sum::<f64>();
        Self {
            gram: DMatrix::from_fn(COLUMNS, COLUMNS, |i, k| dot(&columns[i], &columns[k])),
            right: DVector::from_fn(COLUMNS, |i, _| dot(&columns[i], &effort)),
            total: dot(&effort, &effort),
        }
    }

    /// Sum of squares of the effort about its mean.
    pub fn total(&self) -> f64 {
        self.total
    }

    /// The least squares fit within the bounds of a drive: the best of all its faces.
    pub fn fit(&self, drive: Drive) -> Fitted {
        self.fit_within(drive, [0.0; 3])
    }

    /// The same with viscous friction of either sign, where efforts are computed from goals: the gain by which a loop damps may
    /// be another one.
    pub fn fit_of_loop(&self, drive: Drive) -> Fitted {
        self.fit_within(drive, [0.0, f64::NEG_INFINITY, 0.0])
    }

    /// The fit with least values of `f`, `b` and `i`.
    fn fit_within(&self, drive: Drive, least: [f64; COLUMNS - 1]) -> Fitted {
        let mut best = Fitted { share: f64::INFINITY, coefficients: [0.0; COLUMNS] };
        let [low, high] = drive.gain;
        for others in 0..1_u32 << (COLUMNS - 1) {
            let free: Vec<usize> = (1..COLUMNS).filter(|i| others & (1 << (i - 1)) != 0).collect();
            let with: Vec<usize> = std::iter::once(0).chain(free.iter().copied()).collect();
            let at = |bound: f64| self.solve(&free, bound).filter(|_| bound.is_finite());
            let candidates = [self.solve(&with, 0.0), at(low), at(high)];
            for found in candidates.into_iter().flatten() {
                let inside = found.coefficients[0] >= low - 1e-12
                    && found.coefficients[0] <= high + 1e-12
                    && found.coefficients.iter().skip(1).zip(least).all(|(c, least)| *c >= least);
                if inside && found.share < best.share {
                    best = found;
                }
            }
        }
        best
    }

    /// Least squares over the free columns; a torque column that is not free has the factor `fixed`.
    fn solve(&self, free: &[usize], fixed: f64) -> Option<Fitted> {
        let fixed = if free.first() == Some(&0) { 0.0 } else { fixed };
        let mut coefficients = [0.0; COLUMNS];
        coefficients[0] = fixed;
        if !free.is_empty() {
            // Columns are scaled to one, so that a ridge of rounding size serves all units.
            let scale = |i: usize| self.gram[(i, i)].max(f64::MIN_POSITIVE).sqrt();
            let mut gram = DMatrix::from_fn(free.len(), free.len(), |a, b| {
                let (i, k) = (free[a], free[b]);
                self.gram[(i, k)] / (scale(i) * scale(k))
            });
            (0..free.len()).for_each(|a| gram[(a, a)] += 1e-9);
            let right = DVector::from_fn(free.len(), |a, _| {
                let i = free[a];
                (self.right[i] - fixed * self.gram[(i, 0)]) / scale(i)
            });
            let solution = gram.cholesky()?.solve(&right);
            for (a, &i) in free.iter().enumerate() {
                coefficients[i] = solution[a] / scale(i);
            }
        }
        let c = DVector::from_column_slice(&coefficients);
        let left = self.total - 2.0 * c.dot(&self.right) + (&self.gram * &c).dot(&c);
        let share = if self.total > 0.0 { left.max(0.0) / self.total } else { 1.0 };
        Some(Fitted { share, coefficients })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn columns() -> [Vec<f64>; COLUMNS] {
        let wave = |f: f64| (0..400).map(|k| (f * f64::from(k)).sin()).collect();
        [0.05, 0.11, 0.17, 0.29].map(wave)
    }

    fn fit(effort: [f64; COLUMNS], gain: [f64; 2]) -> Fitted {
        let columns = columns();
        let sum = |k: usize| 7.0 + columns.iter().zip(effort).map(|(c, x)| x * c[k]).sum::<f64>();
        let effort: Vec<f64> = (0..400).map(sum).collect();
        ProductSums::of(columns.each_ref().map(Vec::as_slice), &effort).fit(Drive { gain })
    }

    #[test]
    fn a_drive_within_its_bounds_leaves_nothing() {
        let found = fit([2.0, 0.5, 0.1, 0.3], [1.0 / 3.0, 3.0]);
        assert!(found.share < 1e-8, "{found:?}");
        assert!((found.coefficients[0] - 2.0).abs() < 1e-6);
    }

    #[test]
    fn friction_drives_nothing_and_no_drive_turns_the_torque() {
        assert!(fit([0.0, -1.0, 0.0, 0.0], [0.0, 3.0]).share > 0.9);
        let turned = fit([-1.0, 0.1, 0.1, 0.1], [1.0 / 3.0, 3.0]);
        assert!(turned.share > 1.0 && (turned.coefficients[0] - 1.0 / 3.0).abs() < 1e-9);
    }
}
