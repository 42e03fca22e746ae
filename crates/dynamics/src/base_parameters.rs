use faer::Mat;
use nalgebra::{DMatrix, DVector};
use robot::Robot;

use crate::columns::{ColumnSet, RegressorColumn};
use crate::error::{DynamicsError, check};
use crate::model::Dynamics;

/// A column counts as dependent when less than this is left of it after projection on
/// the columns already kept, in units of the longest column of its kind.
///
/// Above the 1e-5 that angles written with five digits leave (5e-6 on the Kinova Gen3), and
/// below real directions: their smallest singular value is 0.1 on the arms of the tests.
const DEPENDENT_SHARE: f64 = 1e-4;

/// Rows of the regressor beyond which no more states are added, but for [`FEWEST_STATES`]: every state gives a row a
/// joint.
const MOST_ROWS: usize = 2800;

/// Number of states that separates the parameters of every link and drive: four times as many as a
/// link and its drive have, as the first row of a state alone tells those of the first link.
const FEWEST_STATES: usize = 56;

/// Entries of the mapping below this are rounding errors and set to zero.
const MAPPING_ROUNDING: f64 = 1e-9;

/// The combinations of parameters that motions can determine.
///
/// ```text
/// tau = Y pi = Y_b pi_base,   pi_base = pi[independent] + mapping pi[dependent]
/// ```
///
/// with `Y_b` the independent columns of `Y`. Gautier & Khalil 1990.
#[derive(Debug, Clone, PartialEq)]
pub struct BaseParameters {
    /// All columns, in the order of [`ColumnSet::columns`].
    pub columns: Vec<RegressorColumn>,
    /// Indices of the columns kept, ascending.
    pub independent: Vec<usize>,
    /// Indices of the other columns, ascending.
    pub dependent: Vec<usize>,
    /// How the dependent parameters enter the independent ones: rank x dependents.
    pub mapping: DMatrix<f64>,
    /// Singular values of the stacked regressor, largest first, with the longest column of
    /// each kind scaled to norm 1: the gap behind entry `rank - 1` is the certainty of the
    /// count.
    pub singular_values: Vec<f64>,
}

impl BaseParameters {
    /// Number of base parameters.
    pub fn rank(&self) -> usize {
        self.independent.len()
    }

    /// Indices of the columns that no motion shows, neither alone nor combined with others.
    pub fn invisible(&self) -> Vec<usize> {
        let silent = |d: &usize| self.mapping.column(*d).iter().all(|&share| share == 0.0);
        (0..self.dependent.len()).filter(silent).map(|d| self.dependent[d]).collect()
    }

    /// The base parameters of the full parameters `pi` (units of the columns kept).
    ///
    /// # Errors
    ///
    /// [`DynamicsError::WrongLength`] and [`DynamicsError::NotFinite`].
    pub fn project(&self, pi: &[f64]) -> Result<DVector<f64>, DynamicsError> {
        check("pi", pi, self.columns.len())?;
        let pick = |indices: &[usize]| {
            DVector::from_iterator(indices.len(), indices.iter().map(|&i| pi[i]))
        };
        Ok(pick(&self.independent) + &self.mapping * pick(&self.dependent))
    }
}

/// The base parameters of a robot for the columns of `set`.
///
/// Stacks the regressor over fixed pseudo-random states that ignore the joint limits,
/// scales the kinds of columns alike, reduces them to a triangle by QR, and keeps
/// every column that is not a combination of those kept before it. Drive columns come
/// first, then links from the last to the first (inertias before the mass),
/// rotor inertias last: so distal links keep their own parameters, and a rotor that a
/// link can take over is taken over.
///
/// The answer depends on the direction of gravity: tilting the base reveals more. The cost grows with the
/// cube of the number of joints.
pub fn base_parameters(robot: &Robot, set: ColumnSet) -> BaseParameters {
    let columns = set.columns(robot.joint_count());
    let reduced = Reduced::of(robot, set, &columns);
    let mut independent = reduced.independent();
    independent.sort_unstable();
    let dependent: Vec<usize> =
        (0..columns.len()).filter(|c| independent.binary_search(c).is_err()).collect();
    let mapping = reduced.mapping(&independent, &dependent);
    let singular_values = reduced.singular_values();
    BaseParameters { columns, independent, dependent, mapping, singular_values }
}

/// How many base parameters a robot has for the columns of `set`: the rank of [`base_parameters`].
pub fn base_parameter_count(robot: &Robot, set: ColumnSet) -> usize {
    let columns = set.columns(robot.joint_count());
    Reduced::of(robot, set, &columns).independent().len()
}

/// Order in which columns are offered (see [`base_parameters`]).
fn preference(columns: &[RegressorColumn]) -> Vec<usize> {
    let rank = |column: &RegressorColumn| match *column {
        RegressorColumn::Viscous { .. }
        | RegressorColumn::Coulomb { .. }
        | RegressorColumn::Offset { .. } => 0,
        RegressorColumn::Inertial { .. } => 1,
        RegressorColumn::Rotor { .. } => 2,
    };
    let mut order: Vec<usize> = (0..columns.len()).rev().collect();
    order.sort_by_key(|&c| rank(&columns[c]));
    order
}

/// The regressor over enough states to separate all columns that can be separated.
fn stack_regressors(robot: &Robot, set: ColumnSet, width: usize) -> DMatrix<f64> {
    let dynamics = Dynamics::new(robot);
    let (n, mut ws) = (dynamics.joint_count(), dynamics.workspace());
    let states = (2 * width).min((MOST_ROWS / n.max(1)).max(FEWEST_STATES));
    let mut rows = vec![0.0; n * width];
    let mut w = DMatrix::zeros(states * n, width);
    let mut number = uniform();
    let mut draw = |half_range: f64| -> Vec<f64> {
        (0..n).map(|_| half_range * (2.0 * number() - 1.0)).collect()
    };
    for state in 0..states {
        let (q, qd, qdd) = (draw(std::f64::consts::PI), draw(2.0), draw(5.0));
        dynamics.columns_into(&mut ws, [&q, &qd, &qdd], set, &mut rows);
        for (i, row) in rows.chunks_exact(width).enumerate() {
            row.iter().enumerate().for_each(|(c, &value)| w[(state * n + i, c)] = value);
        }
    }
    w
}

/// Uniform numbers in (0, 1), always the same: splitmix64 (Steele, Lea & Flood 2014).
fn uniform() -> impl FnMut() -> f64 {
    let mut counter = 0_u64;
    move || {
        counter = counter.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let mut z = counter;
        z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        ((z ^ (z >> 31)) >> 11) as f64 / (1_u64 << 53) as f64
    }
}

/// Number of kinds of columns.
const KINDS: usize = 7;

/// Columns of one kind share their unit.
fn kind(column: &RegressorColumn) -> usize {
    match *column {
        RegressorColumn::Inertial { parameter: 0, .. } => 0,
        RegressorColumn::Inertial { parameter: 1..=3, .. } => 1,
        RegressorColumn::Inertial { .. } => 2,
        RegressorColumn::Rotor { .. } => 3,
        RegressorColumn::Viscous { .. } => 4,
        RegressorColumn::Coulomb { .. } => 5,
        RegressorColumn::Offset { .. } => 6,
    }
}

/// The regressor over many states, reduced to a triangle:
///
/// ```text
/// W diag(1 / scales) P = Q R
/// ```
///
/// `P` puts the columns in the order in which they are preferred.
struct Reduced {
    /// `R`.
    triangle: DMatrix<f64>,
    /// Index of the column of `W` that is the k-th column of `R`.
    order: Vec<usize>,
    /// Of every column of `W`, the norm of the longest one of its kind.
    scales: Vec<f64>,
}

impl Reduced {
    fn of(robot: &Robot, set: ColumnSet, columns: &[RegressorColumn]) -> Self {
        let w = stack_regressors(robot, set, columns.len());
        let mut longest = [0.0_f64; KINDS];
        for (c, column) in columns.iter().enumerate() {
            let of_kind = &mut longest[kind(column)];
            *of_kind = of_kind.max(w.column(c).norm());
        }
        let longest = longest.map(|norm| if norm > 0.0 { norm } else { 1.0 });
        let scales: Vec<f64> = columns.iter().map(|column| longest[kind(column)]).collect();
        let order = preference(columns);
        let scaled = Mat::from_fn(w.nrows(), w.ncols(), |i, k| w[(i, order[k])] / scales[order[k]]);
        let qr = scaled.qr();
        let r = qr.thin_R();
        let upper = |i, c| if i > c { 0.0 } else { r[(i, c)] };
        let triangle = DMatrix::from_fn(r.nrows(), r.ncols(), upper);
        Self { triangle, order, scales }
    }

    /// Indices of the columns of `W` of which more than [`DEPENDENT_SHARE`] is left after projection on those before.
    ///
    /// Householder reflections turn the triangle into steps: the k-th column kept ends in row k. What is left of a later
    /// column is its norm below the rows of those kept.
    fn independent(&self) -> Vec<usize> {
        let mut steps = self.triangle.clone();
        let mut kept = Vec::new();
        for c in 0..steps.ncols() {
            let (row, end) = (kept.len(), steps.nrows().min(c + 1));
            let rest = steps.view((row, c), (end - row, 1)).into_owned();
            if rest.norm() > DEPENDENT_SHARE {
                kept.push(self.order[c]);
                reflect(&mut steps, row, c + 1, rest);
            }
        }
        kept
    }

    /// The columns of `R` that belong to these of `W`.
    fn pick(&self, indices: &[usize]) -> DMatrix<f64> {
        let mut place = vec![0; self.order.len()];
        self.order.iter().enumerate().for_each(|(k, &column)| place[column] = k);
        let rows = self.triangle.nrows();
        DMatrix::from_fn(rows, indices.len(), |i, c| self.triangle[(i, place[indices[c]])])
    }

    /// Least squares `Y_b mapping = Y_dependent`, undone for the scales.
    fn mapping(&self, independent: &[usize], dependent: &[usize]) -> DMatrix<f64> {
        let (q, r) = self.pick(independent).qr().unpack();
        let mut solution = q.transpose() * self.pick(dependent);
        let solved = r.solve_upper_triangular_mut(&mut solution);
        // The columns kept are independent by construction, so that no diagonal entry vanishes.
        assert!(solved, "independent columns");
        DMatrix::from_fn(independent.len(), dependent.len(), |i, d| {
            let share = solution[(i, d)];
            let unscaled = share * self.scales[dependent[d]] / self.scales[independent[i]];
            if share.abs() < MAPPING_ROUNDING { 0.0 } else { unscaled }
        })
    }

    /// Singular values, largest first; none where they do not converge.
    fn singular_values(&self) -> Vec<f64> {
        let (rows, columns) = self.triangle.shape();
        let square = Mat::from_fn(rows, columns, |i, c| self.triangle[(i, c)]);
        square.singular_values().unwrap_or_default()
    }
}

/// Reflects the columns of `steps` from `first` on, so that `rest`, from row `row` on, would become a multiple of the
/// first unit vector: `x - 2 v v'x / v'v`, `v = rest ± |rest| e_1`.
fn reflect(steps: &mut DMatrix<f64>, row: usize, first: usize, mut rest: DMatrix<f64>) {
    rest[0] += rest.norm().copysign(rest[0]);
    let square = rest.norm_squared();
    for c in first..steps.ncols() {
        let mut column = steps.view_mut((row, c), (rest.nrows(), 1));
        let along = 2.0 * column.dot(&rest) / square;
        column.zip_apply(&rest, |x, v| *x -= along * v);
    }
}
