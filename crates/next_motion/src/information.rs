use std::ops::Range;

use effects::{Hypothesis, RunMotion};
use logs::{LogError, LowPass};
use nalgebra::{DMatrix, DVector, Dyn, SymmetricEigen};

/// Order of the low-pass filter, before it runs forward and backward.
pub(crate) const ORDER: usize = 4;

/// Eigenvalue of the normalised normal equations below which a direction is left out.
const RANK: f64 = 1e-10;

/// The hypotheses of a question, and the positions of their columns.
#[derive(Debug, Clone)]
pub(crate) struct ColumnLayout {
    /// The hypotheses.
    pub hypotheses: Vec<Hypothesis>,
    /// Number of columns of each.
    pub widths: Vec<usize>,
    /// Noise of each joint: variance times autocorrelation time ((N·m)² s); none where
    /// nothing is known of the joint.
    pub noise: Vec<Option<f64>>,
    /// Cut-off of the low-pass that columns and efforts pass (Hz).
    pub cutoff_hz: f64,
}

/// Normal equations of all columns, weighted by the noise of each joint:
///
/// ```text
/// xx = sum_j 1/noise_j integral x_j x_j' dt,   xy = sum_j 1/noise_j integral x_j y_j dt
/// ```
#[derive(Debug, Clone)]
pub(crate) struct ColumnInformation {
    pub xx: DMatrix<f64>,
    pub xy: DVector<f64>,
}

impl ColumnLayout {
    /// The columns of some hypotheses.
    pub fn columns(&self, hypotheses: &[Hypothesis]) -> Vec<usize> {
        let start = |at: usize| self.widths[..at].iter().sum::<usize>();
        let index = |h: &Hypothesis| self.hypotheses.iter().position(|own| own == h);
        let places = hypotheses.iter().filter_map(index);
        places.flat_map(|at| start(at)..start(at + 1)).collect()
    }

    /// The information of no motion: zeros.
    pub fn no_information(&self) -> ColumnInformation {
        let width = self.widths.iter().sum();
        ColumnInformation { xx: DMatrix::zeros(width, width), xy: DVector::zeros(width) }
    }

    /// The normal equations of a motion, one for each of its equal `stretches`. `measured` is the
    /// low-passed effort of each joint, if there is any; the columns explain what the nominal robot
    /// leaves of it.
    pub fn information_along(
        &self,
        motion: &RunMotion,
        measured: Option<&[Vec<f64>]>,
        stretches: usize,
    ) -> Result<Vec<ColumnInformation>, LogError> {
        let filter = LowPass::new(ORDER, self.cutoff_hz, motion.period_s.recip())?;
        let columns = self.hypotheses.iter().flat_map(|h| h.columns(motion));
        let mut signals: Vec<Vec<(usize, Vec<f64>)>> = vec![Vec::new(); self.noise.len()];
        for (index, column) in columns.enumerate() {
            for mut part in column {
                filter.apply(&mut part.values);
                signals[part.joint].push((index, part.values));
            }
        }
        let mut sums = vec![self.no_information(); stretches];
        for (j, signals) in signals.iter().enumerate() {
            let Some(noise) = self.noise[j] else { continue };
            let target = measured.map(|measured| {
                let mut y = motion.effort[j].clone();
                filter.apply(&mut y);
                y.iter_mut().zip(&measured[j]).for_each(|(y, effort)| *y = effort - *y);
                y
            });
            for (k, sum) in sums.iter_mut().enumerate() {
                let samples =
                    motion.samples() * k / stretches..motion.samples() * (k + 1) / stretches;
                sum.add(signals, samples, motion.period_s / noise, target.as_deref());
            }
        }
        Ok(sums)
    }
}

impl ColumnInformation {
    fn add(
        &mut self,
        signals: &[(usize, Vec<f64>)],
        samples: Range<usize>,
        weight: f64,
        target: Option<&[f64]>,
    ) {
        let dot = |a: &[f64], b: &[f64]| {
            let pairs = a[samples.clone()].iter().zip(&b[samples.clone()]);
            pairs.map(|(a, b)| a * b).sum::<f64>()
        };
        for (a, (row, x)) in signals.iter().enumerate() {
            for (column, z) in &signals[..=a] {
                let value = weight * dot(x, z);
                self.xx[(*row, *column)] += value;
                if row != column {
                    self.xx[(*column, *row)] += value;
                }
            }
            if let Some(y) = target {
                self.xy[*row] += weight * dot(x, y);
            }
        }
    }

    /// The sum over all motions; none without motions.
    pub fn sum(all: &[Self]) -> Option<Self> {
        let (first, rest) = all.split_first()?;
        Some(rest.iter().fold(first.clone(), |mut sum, other| {
            sum.xx += &other.xx;
            sum.xy += &other.xy;
            sum
        }))
    }

    /// The weights of `columns` that explain the residual best where each is believed to be zero
    /// with the standard deviation `prior`: `(xx + 1/prior^2)^-1 xy`. A weight without prior
    /// spread is zero.
    pub fn weights(&self, columns: &[usize], prior: &[f64]) -> DVector<f64> {
        // In units of the prior.
        let scaled = DMatrix::from_fn(columns.len(), columns.len(), |i, k| {
            let own = if i == k { 1.0 } else { 0.0 };
            own + prior[i] * prior[k] * self.xx[(columns[i], columns[k])]
        });
        let scale = DVector::from_column_slice(prior);
        let seen = self.xy.select_rows(columns).component_mul(&scale);
        let solved = scaled.cholesky().map_or_else(|| 0.0 * &seen, |l| l.solve(&seen));
        solved.component_mul(&scale)
    }

    /// The weights, among all columns, of the signal `columns[truth] weights` minus its best fit by
    /// the columns `model`: `(w, -xx_mm^+ xx_mt w)`.
    pub fn residual_weights(
        &self,
        truth: &[usize],
        weights: &DVector<f64>,
        model: &[usize],
    ) -> DVector<f64> {
        let signal = self.expand(truth, weights);
        let seen = &self.xx * &signal;
        let fitted = Inverse::new(self, model).solve(&seen.select_rows(model));
        signal - self.expand(model, &fitted)
    }

    /// Weights of some columns among those of all.
    pub fn expand(&self, columns: &[usize], weights: &DVector<f64>) -> DVector<f64> {
        let mut all = DVector::zeros(self.xy.len());
        columns.iter().zip(weights.iter()).for_each(|(&k, w)| all[k] += w);
        all
    }

    /// `w' xx w`: the deviance of the signal with these weights of all columns.
    pub fn deviance(&self, weights: &DVector<f64>) -> f64 {
        weights.dot(&(&self.xx * weights)).max(0.0)
    }

    /// The information about `columns` that is left when the columns `others` are free.
    pub fn information_about(&self, columns: &[usize], others: &[usize]) -> DMatrix<f64> {
        let block = |rows: &[usize], of: &[usize]| self.xx.select_rows(rows).select_columns(of);
        let inverse = Inverse::new(self, others);
        let cross = block(others, columns);
        let mut free = block(columns, columns);
        for k in 0..columns.len() {
            let taken = cross.tr_mul(&inverse.solve(&cross.column(k).into_owned()));
            let mut column = free.column_mut(k);
            column -= taken;
        }
        0.5 * (&free + free.transpose())
    }
}

/// The pseudo-inverse of a part of the normal equations, its columns scaled to one.
struct Inverse {
    scale: DVector<f64>,
    /// None without columns.
    eigen: Option<SymmetricEigen<f64, Dyn>>,
}

impl Inverse {
    fn new(information: &ColumnInformation, columns: &[usize]) -> Self {
        let norm = |&k: &usize| {
            let power = information.xx[(k, k)];
            if power > 0.0 && power.is_finite() { power.sqrt().recip() } else { 0.0 }
        };
        let scale = DVector::from_iterator(columns.len(), columns.iter().map(norm));
        let scaled = DMatrix::from_fn(columns.len(), columns.len(), |i, k| {
            let scale = scale[i] * scale[k];
            if scale > 0.0 { information.xx[(columns[i], columns[k])] * scale } else { 0.0 }
        });
        Self { scale, eigen: (!columns.is_empty()).then(|| scaled.symmetric_eigen()) }
    }

    fn solve(&self, b: &DVector<f64>) -> DVector<f64> {
        let b = b.component_mul(&self.scale);
        let mut x = DVector::zeros(b.len());
        if let Some(SymmetricEigen { eigenvectors, eigenvalues }) = &self.eigen {
            let pairs = eigenvalues.iter().zip(eigenvectors.column_iter());
            for (value, vector) in pairs.filter(|(value, _)| **value > RANK) {
                x.axpy(vector.dot(&b) / value, &vector, 1.0);
            }
        }
        x.component_mul(&self.scale)
    }
}

#[cfg(test)]
mod tests {
    use std::f64::consts::TAU;

    use catalogue::EffectKind;
    use effects::{Frame, Place};

    use super::*;
    use crate::motion_record::MotionRecord;
    use crate::testing::turntable;

    const NOISE: f64 = 0.02;
    const SPRING: f64 = 3.0;

    /// What `sum a sin(2 pi hz t)`, over whole periods, says of a cable spring and of a rotor.
    fn along(waves: &[(f64, f64)]) -> [ColumnInformation; 2] {
        let (rate_hz, duration_s) = (200.0, 20.0);
        let signal = |derivative: i32| -> Vec<f64> {
            let at = |t: f64| {
                let wave = |&(a, hz): &(f64, f64)| {
                    let w = TAU * hz;
                    let phase = w * t + f64::from(derivative) * TAU / 4.0;
                    a * w.powi(derivative) * phase.sin()
                };
                waves.iter().map(wave).sum()
            };
            (0..(duration_s * rate_hz) as u32).map(|k| at(f64::from(k) / rate_hz)).collect()
        };
        let [q, qd, qdd] = [0, 1, 2].map(|d| vec![signal(d)]);
        let record = MotionRecord { state: [q, qd, qdd], period_s: 1.0 / rate_hz };
        let frame = Frame {
            rest_speed: vec![1e-6],
            centre: vec![0.0],
            reach: vec![1.0],
            resolution: vec![0.0],
            trial_gaps: vec![0.0],
            trial_springs: vec![None],
            trial_lateness_s: 0.0,
        };
        let at = |kind| Hypothesis { kind, place: Place::Joint(0) };
        let layout = ColumnLayout {
            hypotheses: vec![at(EffectKind::CableSpring), at(EffectKind::RotorInertia)],
            widths: vec![1, 1],
            noise: vec![Some(NOISE)],
            cutoff_hz: 40.0,
        };
        let motion = record.evaluate(&turntable(), &frame);
        let halves =
            layout.information_along(&motion, Some(&[motion.effort[0].clone()]), 2).unwrap();
        halves.try_into().unwrap()
    }

    fn deviance(waves: &[(f64, f64)]) -> f64 {
        let whole = ColumnInformation::sum(&along(waves)).unwrap();
        let left = whole.residual_weights(&[0], &DVector::from_element(1, SPRING), &[1]);
        whole.deviance(&left)
    }

    /// With `q = sum a sin(w t)` over a time `T` and the torque `k q` of a spring, a rotor with
    /// the torque `J qdd` leaves
    ///
    /// ```text
    /// D = k^2 T / (2 noise) (sum a^2 - (sum a^2 w^2)^2 / sum a^2 w^4)
    /// ```
    #[test]
    fn a_rotor_imitates_a_spring_on_one_sine_and_on_two_leaves_the_closed_form() {
        assert!(deviance(&[(0.8, 0.5)]) < 1e-6 * SPRING.powi(2) * 0.32 * 20.0 / NOISE);
        let waves = [(0.8, 0.5), (0.3, 1.25)];
        let sum = |power: i32| -> f64 {
            waves.iter().map(|(a, hz): &(f64, f64)| a * a * (TAU * hz).powi(power)).sum()
        };
        let scale = SPRING.powi(2) * 20.0 / (2.0 * NOISE);
        let expected = scale * (sum(0) - sum(2).powi(2) / sum(4));
        let found = deviance(&waves);
        assert!((found / expected - 1.0).abs() < 1e-3, "{found} {expected}");
    }

    #[test]
    fn stretches_add_up_to_the_whole() {
        let [first, second] = along(&[(0.8, 0.5), (0.3, 1.25)]);
        let both = ColumnInformation::sum(&[first.clone(), second.clone()]).unwrap();
        assert!((&both.xx - &first.xx - &second.xx).amax() < 1e-9 * both.xx.amax());
        assert!(first.xx[(0, 0)] > 0.0 && second.xx[(0, 0)] > 0.0);
    }

    /// An effort that the spring explains with weight 2, believed to be 0 give or take `s`, is
    /// `2 xx / (xx + 1/s^2)`.
    #[test]
    fn weights_are_drawn_to_zero_by_what_is_believed() {
        let mut one = ColumnInformation::sum(&along(&[(0.8, 0.5)])).unwrap();
        one.xy = one.xx.column(0) * 2.0;
        let power = one.xx[(0, 0)];
        for believed in [1e6, 1.0, power.recip().sqrt()] {
            let found = one.weights(&[0], &[believed])[0];
            let expected = 2.0 * power / (power + believed.powi(-2));
            assert!((found - expected).abs() < 1e-9, "{found} {expected}");
        }
        assert!(one.weights(&[0], &[0.0])[0].abs() < 1e-300);
    }

    #[test]
    fn what_is_known_of_one_column_is_less_by_what_the_other_takes() {
        let whole = ColumnInformation::sum(&along(&[(0.8, 0.5), (0.3, 1.25)])).unwrap();
        let [a, b, c] = [whole.xx[(0, 0)], whole.xx[(0, 1)], whole.xx[(1, 1)]];
        let found = whole.information_about(&[0], &[1])[(0, 0)];
        assert!((found - (a - b * b / c)).abs() < 1e-9 * a);
        assert!((whole.information_about(&[0], &[])[(0, 0)] - a).abs() < 1e-9 * a);
    }

    #[test]
    fn signals_that_are_no_numbers_say_nothing_and_end() {
        let mut whole = ColumnInformation::sum(&along(&[(0.8, 0.5)])).unwrap();
        whole.xx.fill(f64::NAN);
        let left = whole.residual_weights(&[0], &DVector::from_element(1, 1.0), &[1]);
        assert!(whole.deviance(&left) <= 0.0);
    }
}
