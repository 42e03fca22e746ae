use nalgebra::{DMatrix, DVector};
use robot::Robot;

use crate::blocks::{Block, Fold};
use crate::design::{Design, RunDesign};
use crate::noise::integrated_time;
use crate::result::Dependence;

/// Knots of the piecewise linear functions.
const KNOTS: usize = 9;

/// Prior standard deviations tried for a knot's value, in RMS of the residual.
const SPREADS: [f64; 3] = [0.1, 0.4, 1.5];

/// Least share of a residual that a signal must predict to be named.
const NAMED: f64 = 0.03;

/// What a flexible predictor finds in a residual.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Structure {
    /// Share of the residual's power that is predicted on held-out data; zero if none.
    pub share: f64,
    /// The signals it follows, the strongest first.
    pub depends_on: Vec<Dependence>,
}

/// A flexible predictor of one joint's residual: a sum of piecewise linear functions,
///
/// ```text
/// r = sum_k (f_k(q_k) + v_k(qd_k)) + f_a(qdd) + f_load(tau) + sign(qd) (h_q(q) + h_load(tau))
/// ```
///
/// each on nine knots, ridge-regularised; judged on held-out parts only.
#[derive(Debug)]
pub(crate) struct Probe<'a> {
    blocks: &'a [Block],
    folds: &'a [Fold],
    /// Features of every block, and what signal each family of columns follows.
    features: Vec<DMatrix<f64>>,
    families: Vec<(String, std::ops::Range<usize>)>,
}

/// A signal of the state, and what multiplies its functions.
struct Family {
    name: String,
    values: Box<dyn Fn(&RunDesign) -> Vec<f64>>,
    directed: bool,
}

impl<'a> Probe<'a> {
    /// The predictor for `joint`, held out as `folds` say.
    pub fn new(
        robot: &Robot,
        design: &Design,
        (blocks, folds): (&'a [Block], &'a [Fold]),
        joint: usize,
    ) -> Self {
        let families = families(robot, design, joint);
        let mut columns = Vec::new();
        let mut ranges = Vec::new();
        for family in &families {
            let values: Vec<Vec<f64>> = design.runs.iter().map(|r| (family.values)(r)).collect();
            let all = values.iter().flatten();
            let (low, high) =
                all.fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), v| (l.min(*v), h.max(*v)));
            let start = columns.len();
            for knot in 0..KNOTS {
                let hat = |v: f64| {
                    let place =
                        (v - low) / (high - low).max(f64::MIN_POSITIVE) * (KNOTS - 1) as f64;
                    (1.0 - (place - knot as f64).abs()).max(0.0)
                };
                let column = |(r, v): (usize, &Vec<f64>)| -> Vec<f64> {
                    let direction = &design.runs[r].joints[joint].state[1];
                    let sign = |t: usize| if family.directed { direction[t].signum() } else { 1.0 };
                    v.iter().enumerate().map(|(t, v)| hat(*v) * sign(t)).collect()
                };
                columns.push(values.iter().enumerate().map(column).collect::<Vec<_>>());
            }
            ranges.push((family.name.clone(), start..columns.len()));
        }
        let matrix = |b: &Block| {
            DMatrix::from_fn(b.samples.len(), columns.len(), |t, k| {
                columns[k][b.run][b.samples.start + t]
            })
        };
        let features = blocks.iter().map(matrix).collect();
        Self { blocks, folds, features, families: ranges }
    }

    /// The structure in a residual, given `[run][sample]`.
    pub fn structure(&self, residual: &[Vec<f64>]) -> Structure {
        let parts: Vec<DVector<f64>> = self
            .blocks
            .iter()
            .map(|b| DVector::from_column_slice(&residual[b.run][b.samples.clone()]))
            .collect();
        let everything = 0..self.families.last().map_or(0, |(_, r)| r.end);
        let share = self.predicted(residual, &parts, everything);
        let mut depends_on: Vec<Dependence> = self
            .families
            .iter()
            .map(|(signal, range)| Dependence {
                signal: signal.clone(),
                share: self.predicted(residual, &parts, range.clone()),
            })
            .filter(|d| d.share >= NAMED)
            .collect();
        depends_on.sort_by(|a, b| b.share.total_cmp(&a.share));
        // A signal may appear with and without the direction: the stronger is kept.
        let mut seen = Vec::new();
        depends_on.retain(|d| {
            let new = !seen.contains(&d.signal);
            seen.push(d.signal.clone());
            new
        });
        depends_on.truncate(3);
        Structure { share, depends_on }
    }

    /// Share of the residual's power that the features in `range` predict when held out.
    fn predicted(
        &self,
        residual: &[Vec<f64>],
        y: &[DVector<f64>],
        range: std::ops::Range<usize>,
    ) -> f64 {
        let all: Vec<DMatrix<f64>> =
            self.features.iter().map(|f| f.columns_range(range.clone()).into_owned()).collect();
        let grams: Vec<(DMatrix<f64>, DVector<f64>)> =
            all.iter().zip(y).map(|(x, y)| (x.tr_mul(x), x.tr_mul(y))).collect();
        let (power, count) =
            y.iter().fold((0.0, 0), |(p, n), y| (p + y.norm_squared(), n + y.len()));
        if power <= 0.0 {
            return 0.0;
        }
        let rms = (power / count.max(1) as f64).sqrt();
        let weight = 1.0 / (rms * rms * integrated_time(residual));
        let best = SPREADS.iter().map(|spread| {
            let ridge = 1.0 / (weight * (spread * rms).powi(2));
            let left: f64 = self
                .folds
                .iter()
                .map(|fold| {
                    let mut a = DMatrix::identity(range.len(), range.len()) * ridge;
                    let mut g = DVector::zeros(range.len());
                    for &b in &fold.train {
                        a += &grams[b].0;
                        g += &grams[b].1;
                    }
                    let Some(factor) = a.cholesky() else { return f64::INFINITY };
                    let w = factor.solve(&g);
                    let part = |&b: &usize| (&y[b] - &all[b] * &w).norm_squared();
                    fold.test.iter().map(part).sum::<f64>()
                })
                .sum();
            1.0 - left / power
        });
        best.fold(0.0, f64::max)
    }
}

fn families(robot: &Robot, design: &Design, joint: usize) -> Vec<Family> {
    let state = move |which: usize, j: usize| -> Box<dyn Fn(&RunDesign) -> Vec<f64>> {
        Box::new(move |r| r.joints[j].state[which].clone())
    };
    let load = move || -> Box<dyn Fn(&RunDesign) -> Vec<f64>> {
        Box::new(move |r| r.joints[joint].nominal.clone())
    };
    let name = |what: &str, j: usize| {
        format!("{what} of {}", robot.links().get(j).map_or("", |l| l.joint.name.as_str()))
    };
    let family = |name, values, directed| Family { name, values, directed };
    let mut all: Vec<Family> = (0..design.joints())
        .filter(|&j| design.moved[j])
        .map(|j| family(name("position", j), state(0, j), false))
        .collect();
    let velocities = (0..design.joints()).filter(|&j| design.moved[j]);
    all.extend(velocities.map(|j| family(name("velocity", j), state(1, j), false)));
    all.push(family(name("acceleration", joint), state(2, joint), false));
    all.push(family(name("load", joint), load(), false));
    all.push(family(name("position", joint), state(0, joint), true));
    all.push(family(name("load", joint), load(), true));
    all
}
