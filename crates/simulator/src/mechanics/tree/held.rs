/// Rounds in which every degree of freedom in a wrong place changes it at once; after them the first alone does, so that no
/// round comes back (block principal pivoting, Júdice & Pires 1994).
const ROUNDS_AT_ONCE: usize = 8;

/// Share of a level of dry friction by which a hold may exceed it: rounding alone.
const ROUNDING: f64 = 1e-12;

/// What holds one degree of freedom: a force against the sign of its rate, and bounds of that rate.
#[derive(Debug, Clone, Copy)]
pub(super) struct Hold {
    /// Level of dry friction.
    pub dry: f64,
    /// Least rate.
    pub least: f64,
    /// Largest rate.
    pub most: f64,
}

impl Hold {
    /// Nothing.
    pub const NONE: Self = Self::dry(0.0);

    /// Dry friction alone.
    pub const fn dry(level: f64) -> Self {
        Self { dry: level, least: f64::NEG_INFINITY, most: f64::INFINITY }
    }
}

/// Where a rate is found on the law of its hold.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Place {
    Least,
    Negative,
    Resting,
    Positive,
    Most,
}

/// Solves for rates under forces and holds:
///
/// ```text
/// A x = force + hold,    hold in -dry sign(x),    least <= x <= most
/// ```
///
/// with `sign(0) = [-1, 1]` and any force towards the inside at a bound. `A` is positive definite, so that there is one
/// `x`; it is found by pivoting between the places where each law is a line.
#[derive(Debug, Clone, Default)]
pub(super) struct HeldSystem {
    place: Vec<Place>,
    free: Vec<usize>,
    factor: Vec<f64>,
    right: Vec<f64>,
    /// `x`.
    pub rate: Vec<f64>,
    /// `hold`.
    pub held: Vec<f64>,
}

impl HeldSystem {
    /// Room for `count` degrees of freedom.
    pub fn new(count: usize) -> Self {
        Self {
            place: vec![Place::Positive; count],
            free: Vec::with_capacity(count),
            factor: vec![0.0; count * count],
            right: vec![0.0; count],
            rate: vec![0.0; count],
            held: vec![0.0; count],
        }
    }

    /// Solves with the lower triangle of `A`, row by row.
    pub fn solve(&mut self, matrix: &[f64], force: &[f64], holds: &[Hold]) {
        for (place, hold) in self.place.iter_mut().zip(holds) {
            // Where it was found last is where it is sought first.
            if hold.dry <= 0.0 && matches!(*place, Place::Negative | Place::Resting) {
                *place = Place::Positive;
            }
            let bounded = match *place {
                Place::Least => hold.least.is_finite(),
                Place::Most => hold.most.is_finite(),
                _ => true,
            };
            if !bounded {
                *place = if hold.dry > 0.0 { Place::Resting } else { Place::Positive };
            }
        }
        let rounds = ROUNDS_AT_ONCE + 20 * self.place.len();
        for round in 0..rounds {
            self.solve_in_place(matrix, force, holds);
            let mut fits = true;
            for (i, hold) in holds.iter().enumerate() {
                let next = next_place(self.place[i], self.rate[i], self.held[i], hold);
                if next == self.place[i] {
                    continue;
                }
                fits = false;
                self.place[i] = next;
                if round >= ROUNDS_AT_ONCE {
                    break;
                }
            }
            if fits {
                return;
            }
        }
    }

    /// Whether a degree of freedom was found at a bound of its rate.
    pub fn is_bounded(&self, i: usize) -> bool {
        matches!(self.place[i], Place::Least | Place::Most)
    }

    /// Rates and holds where every law is taken for its line: the rate of some is given, the force on the others.
    fn solve_in_place(&mut self, matrix: &[f64], force: &[f64], holds: &[Hold]) {
        let count = force.len();
        self.free.clear();
        for (i, hold) in holds.iter().enumerate() {
            let given = match self.place[i] {
                Place::Least => hold.least,
                Place::Resting => 0.0,
                Place::Most => hold.most,
                Place::Negative | Place::Positive => {
                    self.held[i] =
                        if self.place[i] == Place::Negative { hold.dry } else { -hold.dry };
                    self.free.push(i);
                    continue;
                }
            };
            self.rate[i] = given;
        }
        let all_free = self.free.len() == count;
        let given_rate = |place: Place| !matches!(place, Place::Negative | Place::Positive);
        for (row, &i) in self.free.iter().enumerate() {
            let mut right = force[i] + self.held[i];
            if !all_free {
                for j in (0..count).filter(|&j| given_rate(self.place[j])) {
                    right -= element(matrix, count, i, j) * self.rate[j];
                }
            }
            self.right[row] = right;
        }
        self.factor_free(matrix, count);
        substitute(&self.factor, &mut self.right, self.free.len());
        for (row, &i) in self.free.iter().enumerate() {
            self.rate[i] = self.right[row];
        }
        if all_free {
            return;
        }
        for i in (0..count).filter(|&i| given_rate(self.place[i])) {
            let carried: f64 =
                (0..count).map(|j| element(matrix, count, i, j) * self.rate[j]).sum();
            self.held[i] = carried - force[i];
        }
    }

    /// `A = L L^T` of the free rows and columns, with the inverse of each diagonal element of `L` in its place.
    fn factor_free(&mut self, matrix: &[f64], count: usize) {
        let size = self.free.len();
        let l = &mut self.factor;
        for row in 0..size {
            let source = self.free[row] * count;
            for column in 0..=row {
                let mut sum = matrix[source + self.free[column]];
                let (a, b) = (row * size, column * size);
                for k in 0..column {
                    sum -= l[a + k] * l[b + k];
                }
                l[a + column] =
                    if row == column { sum.sqrt().recip() } else { sum * l[b + column] };
            }
        }
    }
}

/// Element of a symmetric matrix of which the lower triangle is there.
fn element(matrix: &[f64], count: usize, i: usize, j: usize) -> f64 {
    if i >= j { matrix[i * count + j] } else { matrix[j * count + i] }
}

/// Solves `L L^T x = right` in place.
fn substitute(l: &[f64], right: &mut [f64], size: usize) {
    for row in 0..size {
        let mut sum = right[row];
        for k in 0..row {
            sum -= l[row * size + k] * right[k];
        }
        right[row] = sum * l[row * size + row];
    }
    for row in (0..size).rev() {
        let value = right[row] * l[row * size + row];
        right[row] = value;
        for k in 0..row {
            right[k] -= l[row * size + k] * value;
        }
    }
}

/// The place to try after one in which `rate` and `held` were found; the same place when they fit it.
fn next_place(place: Place, rate: f64, held: f64, hold: &Hold) -> Place {
    let slack = hold.dry * (1.0 + ROUNDING);
    match place {
        Place::Positive | Place::Negative if rate > hold.most => Place::Most,
        Place::Positive | Place::Negative if rate < hold.least => Place::Least,
        Place::Positive if hold.dry > 0.0 && rate < 0.0 => Place::Resting,
        Place::Negative if hold.dry > 0.0 && rate > 0.0 => Place::Resting,
        Place::Resting if hold.most < 0.0 => Place::Most,
        Place::Resting if hold.least > 0.0 => Place::Least,
        Place::Resting if held > slack => Place::Negative,
        Place::Resting if held < -slack => Place::Positive,
        // What pulls outwards at a bound is friction alone.
        Place::Most if hold.most > 0.0 && held > -hold.dry => Place::Positive,
        Place::Most if hold.most <= 0.0 && held > slack => Place::Negative,
        Place::Least if hold.least < 0.0 && held < hold.dry => Place::Negative,
        Place::Least if hold.least >= 0.0 && held < -slack => Place::Positive,
        same => same,
    }
}
