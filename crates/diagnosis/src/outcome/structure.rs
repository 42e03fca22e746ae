use std::ops::Range;

use nalgebra::{DMatrix, DVector};
use robot::Robot;

use crate::columns::design::Design;
use crate::columns::run_design::RunDesign;
use crate::regression::blocks::{Block, Fold};
use crate::regression::noise::integrated_time;
use crate::result::Dependence;

/// Knots of the piecewise linear functions.
const KNOTS: usize = 9;

/// Prior standard deviations of a knot's value that are tried, in RMS of the residual.
const SPREADS: [f64; 3] = [0.1, 0.4, 1.5];

/// Number of signals named.
const LISTED: usize = 3;

/// Structure in a residual, found by a flexible predictor.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Structure {
    /// Share of the residual's power that the predictor explains on held-out data; zero if none.
    pub share: f64,
    /// The signals that the residual follows, the strongest first.
    pub depends_on: Vec<Dependence>,
}

/// A signal of the state.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Signal {
    Position(usize),
    Velocity(usize),
    Acceleration(usize),
    Load(usize),
}

impl Signal {
    fn values(self, run: &RunDesign) -> &[f64] {
        match self {
            Self::Position(j) => &run.joints[j].state[0],
            Self::Velocity(j) => &run.joints[j].state[1],
            Self::Acceleration(j) => &run.joints[j].state[2],
            Self::Load(j) => &run.joints[j].nominal,
        }
    }

    fn words(self, robot: &Robot) -> String {
        let (what, j) = match self {
            Self::Position(j) => ("position", j),
            Self::Velocity(j) => ("velocity", j),
            Self::Acceleration(j) => ("acceleration", j),
            Self::Load(j) => ("load", j),
        };
        format!("{what} of {}", robot.links()[j].joint.name)
    }
}

/// What multiplies the functions of a signal.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Factor {
    One,
    /// The direction of the joint's motion.
    Direction,
}

/// The functions of one signal, and their columns among the features.
#[derive(Debug, Clone)]
struct Family {
    signal: Signal,
    factor: Factor,
    columns: Range<usize>,
}

/// A flexible predictor of one joint's residual: a sum of piecewise linear functions,
///
/// ```text
/// r = sum_k (f_k(q_k) + v_k(qd_k)) + f_a(qdd) + f_load(tau) + sign(qd) (h_q(q) + h_load(tau))
/// ```
///
/// each with nine knots and ridge regularisation, judged on held-out parts only.
#[derive(Debug)]
pub(crate) struct Probe<'a> {
    robot: &'a Robot,
    blocks: &'a [Block],
    folds: &'a [Fold],
    families: Vec<Family>,
    /// Which samples of every run are informative.
    is_informative: Vec<&'a [bool]>,
    /// Features of every block, samples by columns.
    features: Vec<DMatrix<f64>>,
}

impl<'a> Probe<'a> {
    /// The predictor for `joint`, with parts held out as the folds say.
    pub fn new(
        robot: &'a Robot,
        design: &'a Design,
        (blocks, folds): (&'a [Block], &'a [Fold]),
        joint: usize,
    ) -> Self {
        let families = families(design, joint);
        let width = families.last().map_or(0, |f| f.columns.end);
        let spans: Vec<(f64, f64)> = families.iter().map(|f| span(design, f.signal)).collect();
        let features = |block: &Block| {
            let run = &design.runs[block.run];
            let mut x = DMatrix::zeros(block.samples.len(), width);
            for (family, &(low, high)) in families.iter().zip(&spans) {
                let (values, qd) = (family.signal.values(run), &run.joints[joint].state[1]);
                let counts = |&(_, t): &(usize, usize)| run.joints[joint].is_informative[t];
                for (row, t) in block.samples.clone().enumerate().filter(counts) {
                    let factor = match family.factor {
                        Factor::One => 1.0,
                        Factor::Direction => qd[t].signum(),
                    };
                    let place = (values[t] - low) / (high - low).max(f64::MIN_POSITIVE);
                    for knot in 0..KNOTS {
                        let hat = 1.0 - (place * (KNOTS - 1) as f64 - knot as f64).abs();
                        x[(row, family.columns.start + knot)] = factor * hat.max(0.0);
                    }
                }
            }
            x
        };
        let features = blocks.iter().map(features).collect();
        let is_informative =
            design.runs.iter().map(|run| run.joints[joint].is_informative.as_slice()).collect();
        Self { robot, blocks, folds, families, is_informative, features }
    }

    /// The structure in a residual, `[run][sample]`, with the signals that predict at least `share` of it.
    pub fn structure(&self, residual: &[Vec<f64>], share: f64) -> Structure {
        let part = |b: &Block| {
            let samples = residual[b.run][b.samples.clone()]
                .iter()
                .zip(&self.is_informative[b.run][b.samples.clone()]);
            DVector::from_iterator(
                b.samples.len(),
                samples.map(|(left, is)| if *is { *left } else { 0.0 }),
            )
        };
        let parts: Vec<DVector<f64>> = self.blocks.iter().map(part).collect();
        let time = integrated_time(residual);
        let all = 0..self.families.last().map_or(0, |f| f.columns.end);
        let mut depends_on: Vec<(Signal, f64)> = Vec::new();
        for family in &self.families {
            let share = self.predicted_share(&parts, time, family.columns.clone());
            // A signal may come with and without the direction: the stronger is kept.
            match depends_on.iter_mut().find(|(signal, _)| *signal == family.signal) {
                Some((_, known)) => *known = known.max(share),
                None => depends_on.push((family.signal, share)),
            }
        }
        depends_on.retain(|(_, predicted)| *predicted >= share);
        depends_on.sort_by(|a, b| b.1.total_cmp(&a.1));
        depends_on.truncate(LISTED);
        let named =
            |(signal, share): (Signal, f64)| Dependence { signal: signal.words(self.robot), share };
        Structure {
            share: self.predicted_share(&parts, time, all),
            depends_on: depends_on.into_iter().map(named).collect(),
        }
    }

    /// Share of the residual's power that the features in `columns` predict on held-out parts, with the best of the
    /// spreads.
    fn predicted_share(&self, y: &[DVector<f64>], time: f64, columns: Range<usize>) -> f64 {
        let power: f64 = y.iter().map(DVector::norm_squared).sum();
        if power <= 0.0 {
            return 0.0;
        }
        let x: Vec<_> = self.features.iter().map(|f| f.columns_range(columns.clone())).collect();
        let grams: Vec<(DMatrix<f64>, DVector<f64>)> =
            x.iter().zip(y).map(|(x, y)| (x.transpose() * x, x.tr_mul(y))).collect();
        let remaining_power = |spread: f64| -> f64 {
            // Variance of the noise over that of the prior; n samples count as n / time.
            let ridge = time / (spread * spread);
            let fold = |fold: &Fold| {
                let mut a = DMatrix::identity(columns.len(), columns.len()) * ridge;
                let mut g = DVector::zeros(columns.len());
                for &b in &fold.train {
                    a += &grams[b].0;
                    g += &grams[b].1;
                }
                let Some(factor) = a.cholesky() else { return f64::INFINITY };
                let w = factor.solve(&g);
                fold.test.iter().map(|&b| (&y[b] - x[b] * &w).norm_squared()).sum::<f64>()
            };
            self.folds.iter().map(fold).sum()
        };
        SPREADS.iter().map(|&spread| 1.0 - remaining_power(spread) / power).fold(0.0, f64::max)
    }
}

fn families(design: &Design, joint: usize) -> Vec<Family> {
    let moving_joints = || (0..design.joints()).filter(|&j| design.moved[j]);
    let mut all: Vec<(Signal, Factor)> = Vec::new();
    all.extend(moving_joints().map(|j| (Signal::Position(j), Factor::One)));
    all.extend(moving_joints().map(|j| (Signal::Velocity(j), Factor::One)));
    all.push((Signal::Acceleration(joint), Factor::One));
    all.push((Signal::Load(joint), Factor::One));
    all.push((Signal::Position(joint), Factor::Direction));
    all.push((Signal::Load(joint), Factor::Direction));
    let family = |(k, (signal, factor)): (usize, (Signal, Factor))| Family {
        signal,
        factor,
        columns: KNOTS * k..KNOTS * (k + 1),
    };
    all.into_iter().enumerate().map(family).collect()
}

/// Smallest and largest value of a signal over all runs.
fn span(design: &Design, signal: Signal) -> (f64, f64) {
    let all = design.runs.iter().flat_map(|r| signal.values(r));
    all.fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), v| (l.min(*v), h.max(*v)))
}
