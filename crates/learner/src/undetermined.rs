use std::fmt;

use dynamics::{BaseParameters, RegressorColumn};
use nalgebra::DMatrix;

/// Length, in sizes of the parameters, below which what is left of a direction is rounding.
const ROUNDING: f64 = 1e-6;

/// Share of a direction's largest change below which a parameter is not named.
const NAMED: f64 = 0.1;

/// Base parameters that can change together without a change of the torque of the samples.
#[derive(Debug, Clone, PartialEq)]
pub struct Direction {
    /// The columns kept for these base parameters, with the change of each that belongs to a
    /// unit of the first (in their units).
    pub changes: Vec<(RegressorColumn, f64)>,
}

impl fmt::Display for Direction {
    /// `Izz1`, or `Izz1 with 0.43 Ia1`.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (place, (column, change)) in self.changes.iter().enumerate() {
            match place {
                0 => write!(f, "{column}")?,
                1 => write!(f, " with {change:.3} {column}")?,
                _ => write!(f, ", {change:.3} {column}")?,
            }
        }
        Ok(())
    }
}

/// The directions that the columns of `spanned` span in the base parameters, each led by a
/// parameter that no other direction changes.
///
/// Gauss-Jordan elimination with complete pivoting, in units of the sizes of the base
/// parameters; what changes no base parameter (it lies in the structure of the robot) is left
/// out.
pub(crate) fn directions(
    base: &BaseParameters,
    sizes: &[f64],
    spanned: &DMatrix<f64>,
) -> Vec<Direction> {
    let mut rest =
        DMatrix::from_fn(spanned.nrows(), spanned.ncols(), |i, c| spanned[(i, c)] / sizes[i]);
    let mut found: Vec<(usize, usize)> = Vec::new();
    while found.len() < rest.nrows().min(rest.ncols()) {
        let free_columns = (0..rest.ncols()).filter(|c| found.iter().all(|(_, taken)| taken != c));
        let (row, column) = free_columns
            .map(|c| (rest.column(c).iamax(), c))
            .max_by(|&a, &b| rest[a].abs().total_cmp(&rest[b].abs()))
            .unwrap_or((0, 0));
        let pivot = rest[(row, column)];
        if pivot.abs() <= ROUNDING {
            break;
        }
        let direction = rest.column(column) / pivot;
        for c in 0..rest.ncols() {
            let share = rest[(row, c)];
            rest.column_mut(c).axpy(-share, &direction, 1.0);
        }
        rest.set_column(column, &direction);
        found.push((row, column));
    }
    found.sort_unstable();
    let named = |&(leader, column): &(usize, usize)| {
        let change = |i: usize| rest[(i, column)];
        let largest = rest.column(column).amax();
        let others = (0..rest.nrows()).filter(|&i| i != leader);
        let mut shown: Vec<usize> =
            others.filter(|&i| change(i).abs() >= NAMED * largest).collect();
        shown.sort_by(|&a, &b| change(b).abs().total_cmp(&change(a).abs()));
        let in_units = |i: usize| {
            let share = change(i) * sizes[i] / sizes[leader];
            (base.columns[base.independent[i]], share)
        };
        let changes = std::iter::once(leader).chain(shown).map(in_units).collect();
        Direction { changes }
    };
    found.iter().map(named).collect()
}
