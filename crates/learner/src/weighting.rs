use dynamics::BaseParameters;
use nalgebra::{DMatrix, DVector, SymmetricEigen};

use crate::block_sums::{JointSums, Sums};
use crate::nominal_parameter::{nominal_parameter, size};
use crate::prior::GaussianPrior;
use crate::regression::Regression;

/// Change of the weights, relative, at which the reweighting has converged.
const SETTLED: f64 = 1e-8;

/// Most rounds of reweighting.
const ROUNDS: usize = 200;

/// Least information of a direction that is fitted, in units of the sizes of the parameters: below
/// it the standard deviation would be over twice the size, and the direction stays as described.
pub(crate) const LEAST_INFORMATION: f64 = 0.25;

/// Share of the largest eigenvalue below which an eigenvalue is rounding.
const ROUNDING: f64 = 1e-13;

/// Share of a joint's torque, squared, below which a residual is rounding.
const EXACT: f64 = 1e-14;

/// Least noise of a joint, as a share of the noisiest joint's: a torque that seems exact where
/// others are not must not outweigh them until they vanish in rounding.
const QUIETEST: f64 = 1e-3;

/// Fewest groups of blocks whose spread is taken for a variance.
const FEWEST_GROUPS: usize = 8;

/// Noise of one joint about a fit.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FitNoise {
    /// Standard deviation of one sample (N·m or N); zero for a joint that reports no torque, as
    /// all its samples are zero: it has no part in the fit.
    pub standard_deviation: f64,
    /// Number of samples that count as one independent sample, at least 1: the variance of the sums
    /// of blocks over that of independent samples. What the columns cannot explain counts as noise
    /// here.
    pub correlated_samples: f64,
}

impl FitNoise {
    /// `1 / (sigma² time)`, in the power of which the samples of a joint count.
    pub fn weight(&self) -> f64 {
        let variance = self.standard_deviation.powi(2) * self.correlated_samples;
        if variance > 0.0 { variance.recip() } else { 0.0 }
    }
}

/// How the reweighting ended.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Weighting {
    /// The noise of all joints agrees with the fit that it weighs.
    Converged {
        /// Fits made.
        rounds: usize,
    },
    /// The weights still change: too few samples to separate noise from parameters. A prior or more
    /// samples help.
    Unsettled {
        /// Relative change of the weights in the last round.
        change: f64,
    },
}

/// The least-squares problem of a regression, in deviations from a centre in units of the
/// sizes of the parameters:
///
/// ```text
/// pi = centre + S z,   pi_base = P pi
/// ```
pub(crate) struct LeastSquaresProblem<'a> {
    regression: &'a Regression,
    joints: Vec<JointTotal>,
    samples: f64,
    /// The prior's mean, as described where there is none.
    pub centre: DVector<f64>,
    /// Diagonal of `S`: the prior's standard deviation, the natural size where there is none.
    pub size: DVector<f64>,
    /// Information that the prior has on each `z`: 1 or 0.
    pub believed: DVector<f64>,
    /// `P S`.
    pub base_from_z: DMatrix<f64>,
    centre_base: DVector<f64>,
}

/// The sums over all samples of one joint.
struct JointTotal {
    gram: DMatrix<f64>,
    rhs: DVector<f64>,
    square: f64,
}

impl JointTotal {
    /// A torque that is zero in every sample was not measured, and is left out.
    fn new(sums: &JointSums) -> Self {
        let (gram, rhs, square) = (sums.gram(), sums.rhs(), sums.square());
        let gram = if square > 0.0 { gram } else { 0.0 * gram };
        Self { gram, rhs, square }
    }
}

/// The minimum for given weights.
pub(crate) struct Solution {
    /// Deviations, zero in undetermined directions.
    pub z: DVector<f64>,
    /// The base parameters.
    pub base: DVector<f64>,
    /// Eigenvalues of the information on `z`, determined directions only.
    pub information: DVector<f64>,
    /// Their eigenvectors.
    pub determined: DMatrix<f64>,
    /// Eigenvectors of the other directions.
    pub undetermined: DMatrix<f64>,
    /// Eigenvalues of the other directions.
    pub faint: DVector<f64>,
    /// Covariance of the base parameters if the noise is as weighted.
    base_covariance: DMatrix<f64>,
}

impl<'a> LeastSquaresProblem<'a> {
    pub fn new(regression: &'a Regression, total: &Sums, prior: Option<&GaussianPrior>) -> Self {
        let base = &regression.base;
        let columns = &base.columns;
        let width = columns.len();
        let believed = |i: usize| prior.filter(|p| p.standard_deviations[i].is_finite());
        let each = |value: &dyn Fn(usize) -> f64| DVector::from_fn(width, |i, _| value(i));
        let robot = &regression.robot;
        let centre = each(&|i| {
            believed(i).map_or_else(|| nominal_parameter(robot, columns[i]), |p| p.mean[i])
        });
        let size = each(&|i| {
            believed(i).map_or_else(|| size(robot, columns[i]), |p| p.standard_deviations[i])
        });
        let to_base = to_base(base);
        let centre_base = &to_base * &centre;
        let base_from_z = to_base * DMatrix::from_diagonal(&size);
        let joints = total.joints.iter().map(JointTotal::new);
        Self {
            regression,
            joints: joints.collect(),
            samples: total.samples as f64,
            believed: each(&|i| f64::from(believed(i).is_some())),
            centre,
            size,
            base_from_z,
            centre_base,
        }
    }

    /// Fit and noise that agree with each other, by iterated reweighting from the residual
    /// of the centre:
    ///
    /// ```text
    /// minimise  sum_k |tau_k - X_k pi|² / (sigma_k² time_k) + prior,   Sigma its covariance
    /// sigma_k² = (|tau_k - X_k pi|² + tr(X_k'X_k Sigma)) / n
    /// ```
    ///
    /// which divides the squares by `n` less the parameters that joint `k` pays for.
    pub fn reweight(&self) -> (Solution, Vec<FitNoise>, Weighting) {
        let joints = 0..self.joints.len();
        let start = |joint: usize| FitNoise {
            standard_deviation: (self.remaining(joint, &self.centre_base) / self.samples).sqrt(),
            correlated_samples: 1.0,
        };
        let mut noise = with_noise_floor(joints.clone().map(start).collect());
        let mut solution = self.solve(&noise);
        let mut change = f64::INFINITY;
        for rounds in 1..=ROUNDS {
            let next = with_noise_floor(joints.clone().map(|j| self.noise(j, &solution)).collect());
            let weighs = |pair: &(&FitNoise, &FitNoise)| pair.1.weight() > 0.0;
            let changes = next.iter().zip(&noise).filter(weighs);
            let changes = changes.map(|(n, o)| (n.weight() / o.weight()).ln().abs());
            change = changes.fold(0.0, f64::max);
            noise = next;
            solution = self.solve(&noise);
            if change <= SETTLED {
                return (solution, noise, Weighting::Converged { rounds });
            }
        }
        (solution, noise, Weighting::Unsettled { change })
    }

    /// `|tau - X pi|²` at a joint, not below rounding.
    fn remaining(&self, joint: usize, base: &DVector<f64>) -> f64 {
        let JointTotal { gram, rhs, square } = &self.joints[joint];
        let w = base.select_rows(&self.regression.seen[joint]);
        let remaining = square - 2.0 * w.dot(rhs) + w.dot(&(gram * &w));
        remaining.max(EXACT * square)
    }

    /// The noise of a joint about `solution`.
    fn noise(&self, joint: usize, solution: &Solution) -> FitNoise {
        let seen = &self.regression.seen[joint];
        let covariance = solution.base_covariance.select_rows(seen).select_columns(seen);
        let spent = self.joints[joint].gram.component_mul(&covariance).sum();
        let variance = (self.remaining(joint, &solution.base) + spent) / self.samples;
        let w = solution.base.select_rows(seen);
        let blocks = self.regression.sums.blocks();
        let scores = blocks.iter().map(|block| block.joints[joint].score(&w)).collect();
        let scores = Scores::widest(scores, |score| score.dot(&(&covariance * score)));
        let time = scores.spread / (variance * spent);
        FitNoise {
            standard_deviation: variance.sqrt(),
            correlated_samples: time.max(1.0).min(self.samples),
        }
    }

    /// The minimum for the weights that `noise` gives, in the eigenvectors of the information
    ///
    /// ```text
    /// H = S P' (sum_k weight_k X_k'X_k) P S + believed = V diag(l) V'
    /// z = V diag(1 / l) V' S P' sum_k weight_k X_k'(tau_k - X_k centre)
    /// ```
    ///
    /// Directions with too small an `l` are left out: they stay at the centre, and the
    /// prediction does not depend on them.
    fn solve(&self, noise: &[FitNoise]) -> Solution {
        let rank = self.centre_base.len();
        let (mut h, mut g) = (DMatrix::zeros(rank, rank), DVector::zeros(rank));
        for ((joint, noise), seen) in self.joints.iter().zip(noise).zip(&self.regression.seen) {
            let weight = noise.weight();
            let left = &joint.rhs - &joint.gram * self.centre_base.select_rows(seen);
            for (a, &row) in seen.iter().enumerate() {
                g[row] += weight * left[a];
                for (b, &column) in seen.iter().enumerate() {
                    h[(row, column)] += weight * joint.gram[(a, b)];
                }
            }
        }
        let mut information = self.base_from_z.tr_mul(&(h * &self.base_from_z));
        information += DMatrix::from_diagonal(&self.believed);
        let eigen = SymmetricEigen::new(information);
        let least = LEAST_INFORMATION.max(ROUNDING * eigen.eigenvalues.max());
        let (known, unknown): (Vec<usize>, Vec<usize>) =
            (0..eigen.eigenvalues.len()).partition(|&i| eigen.eigenvalues[i] >= least);
        let determined = eigen.eigenvectors.select_columns(&known);
        let information = eigen.eigenvalues.select_rows(&known);
        let pulled = determined.tr_mul(&self.base_from_z.tr_mul(&g));
        let z = &determined * pulled.component_div(&information);
        let root =
            &self.base_from_z * scale_columns(&determined, &information.map(|l| l.sqrt().recip()));
        Solution {
            base: &self.centre_base + &self.base_from_z * &z,
            z,
            base_covariance: &root * root.transpose(),
            undetermined: eigen.eigenvectors.select_columns(&unknown),
            faint: eigen.eigenvalues.select_rows(&unknown).map(|l| l.max(0.0)),
            determined,
            information,
        }
    }

    /// Covariance of `z` in the determined directions from the spread of the blocks, valid for
    /// correlated noise, and the number of groups of blocks (Liang & Zeger 1986):
    ///
    /// ```text
    /// H^-1 (B / (B - 1) sum_b s_b s_b' + believed) H^-1,   s_b the score of group b
    /// ```
    ///
    /// With fewer than eight blocks it is `H^-1`, and the number zero.
    pub fn sandwich(&self, solution: &Solution, noise: &[FitNoise]) -> (DMatrix<f64>, usize) {
        let bread = scale_columns(&solution.determined, &solution.information.map(f64::recip));
        let blocks = self.regression.sums.blocks();
        if blocks.len() < FEWEST_GROUPS {
            return (&bread * solution.determined.transpose(), 0);
        }
        let score = |block: &Sums| {
            let mut score = DVector::zeros(self.centre_base.len());
            for ((sums, noise), seen) in block.joints.iter().zip(noise).zip(&self.regression.seen) {
                let own = sums.score(&solution.base.select_rows(seen)) * noise.weight();
                seen.iter().zip(own.iter()).for_each(|(&row, s)| score[row] += s);
            }
            solution.determined.tr_mul(&self.base_from_z.tr_mul(&score))
        };
        let square =
            |s: &DVector<f64>| s.component_mul(s).component_div(&solution.information).sum();
        let Scores { groups, .. } = Scores::widest(blocks.iter().map(score).collect(), square);
        let believed = scale_columns(&solution.determined.transpose(), &self.believed);
        let mut meat = believed * &solution.determined;
        groups.iter().for_each(|s| meat.ger(factor(groups.len()), s, s, 1.0));
        (&bread * meat * bread.transpose(), groups.len())
    }
}

/// `P` of `pi_base = P pi`.
pub(crate) fn to_base(base: &BaseParameters) -> DMatrix<f64> {
    let mut to_base = DMatrix::zeros(base.rank(), base.columns.len());
    base.independent.iter().enumerate().for_each(|(i, &c)| to_base[(i, c)] = 1.0);
    for (d, &c) in base.dependent.iter().enumerate() {
        to_base.set_column(c, &base.mapping.column(d));
    }
    to_base
}

/// `a diag(scale)`.
pub(crate) fn scale_columns(a: &DMatrix<f64>, scale: &DVector<f64>) -> DMatrix<f64> {
    a * DMatrix::from_diagonal(scale)
}

/// The noise with a floor: no joint that reports torque has less than [`QUIETEST`] times the
/// largest one.
fn with_noise_floor(mut noise: Vec<FitNoise>) -> Vec<FitNoise> {
    let loudest = noise.iter().map(|n| n.standard_deviation).fold(0.0, f64::max);
    let reporting = noise.iter_mut().filter(|n| n.standard_deviation > 0.0);
    reporting.for_each(|n| n.standard_deviation = n.standard_deviation.max(QUIETEST * loudest));
    noise
}

/// Scores of the blocks, or of groups of 2, 4, ... neighbours as long as there are eight:
/// those with the largest spread, as blocks shorter than the noise's memory hide a part of it.
struct Scores {
    groups: Vec<DVector<f64>>,
    /// `B / (B - 1) sum_b square(s_b)`.
    spread: f64,
}

impl Scores {
    fn widest(blocks: Vec<DVector<f64>>, square: impl Fn(&DVector<f64>) -> f64) -> Self {
        let of = |groups: Vec<DVector<f64>>| {
            let spread = groups.iter().map(&square).sum::<f64>() * factor(groups.len());
            Self { groups, spread }
        };
        let mut widest = of(blocks.clone());
        let mut groups = blocks;
        while groups.len() >= 2 * FEWEST_GROUPS {
            groups = groups.chunks(2).map(|pair| pair.iter().sum()).collect();
            let coarser = of(groups.clone());
            if coarser.spread > widest.spread {
                widest = coarser;
            }
        }
        widest
    }
}

/// `B / (B - 1)`: the mean of the scores is zero.
fn factor(groups: usize) -> f64 {
    groups as f64 / groups.saturating_sub(1).max(1) as f64
}
