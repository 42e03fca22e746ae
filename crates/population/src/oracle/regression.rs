use faer::prelude::*;
use faer::{Mat, Side};
use logs::FourierTransform;
use nalgebra::DMatrix;

use crate::oracle::column::{StandIn, TorqueColumn};
use crate::oracle::motion::SeenRun;
use crate::oracle::noise::OracleNoise;
use crate::sheet::Strength;

/// Highest frequency that counts (Hz): beyond it a rigid arm with a gear is none.
const HIGHEST_HZ: f64 = 25.0;

/// What an oracle sees of each of the first `causes` columns, all others unknown; see [`Strength`]. `scales` are
/// what torques count by, joint by joint (N m or N).
///
/// ```text
/// sigmas^2 = least over w of  sum over j, f of |c_j(f) - A_j(f) w|^2 / (N S_j(f))          + sum of prior w^2
/// share^2  = least over w of  mean over samples of sum over j of (c_j - A_j w)^2 / scale_j^2 + floor^2 sum of prior w^2
/// ```
///
/// with `A` all other columns but those that stand for the same, and `floor` that of [`Strength`]: what is known
/// of a stand-in weighs as much as torque of the floor. Costs `rows columns^2` flops for either Gram matrix, some
/// 3e8 for a minute of seven joints, and `columns^3 / 3` a cause.
pub(crate) fn strengths(
    runs: &[SeenRun],
    columns: &[TorqueColumn],
    causes: usize,
    noise: &[OracleNoise],
    scales: &[f64],
) -> Vec<Strength> {
    let likely = whiten(runs, columns, noise, scales);
    let plain = scale_columns(runs, columns, scales);
    let [likely, plain] = [likely, plain].map(|rows| rows.transpose() * &rows);
    let strength = |k: usize| Strength {
        sigmas: unexplained_norm(k, columns, &likely, 1.0),
        share: unexplained_norm(k, columns, &plain, Strength::FLOOR.powi(2)),
        torque: plain[(k, k)].sqrt(),
    };
    (0..causes).map(strength).collect()
}

/// RMS effort of a joint over all runs (N m or N).
pub(crate) fn effort_rms(runs: &[SeenRun], joint: usize) -> f64 {
    rms(runs.iter().map(|run| &run.effort), joint)
}

fn rms<'a>(torque: impl Iterator<Item = &'a DMatrix<f64>>, joint: usize) -> f64 {
    let (mut sum, mut count) = (0.0, 0_usize);
    for run in torque {
        sum += run.column(joint).norm_squared();
        count += run.nrows();
    }
    (sum / count.max(1) as f64).sqrt()
}

/// Fourier transforms of all columns, each frequency divided by the deviation of its noise.
fn whiten(
    runs: &[SeenRun],
    columns: &[TorqueColumn],
    noise: &[OracleNoise],
    scales: &[f64],
) -> Mat<f64> {
    let bins = |run: &SeenRun| {
        let length = run.rows() as f64 * run.step_s;
        (run.rows() / 2).min((HIGHEST_HZ * length) as usize) + 1
    };
    let height: usize = runs.iter().map(|run| 2 * bins(run) * noise.len()).sum();
    let mut rows = Mat::zeros(height, columns.len());
    let mut fourier = FourierTransform::default();
    let mut top = 0;
    for (r, run) in runs.iter().enumerate() {
        let (n, kept) = (run.rows(), bins(run));
        if n == 0 {
            continue;
        }
        for (j, noise) in noise.iter().enumerate() {
            // An effort without noise of its own still is a number of so many digits.
            let digits = (1e-4 * scales[j]).powi(2).max(1e-16);
            let weight = |bin: usize| {
                let hz = bin as f64 / (n as f64 * run.step_s);
                let twice = if bin == 0 { 1.0 } else { 2.0 };
                let variance = noise.at(hz, run.thinned) + digits;
                (twice / (n as f64 * variance)).sqrt()
            };
            for (c, column) in columns.iter().enumerate() {
                let values = column.torque[r].column(j);
                if values.iter().all(|value| value.abs() <= 0.0) {
                    continue;
                }
                let mut signal: Vec<f64> = values.iter().copied().collect();
                for (bin, value) in fourier.of(&mut signal).iter().enumerate().take(kept) {
                    rows[(top + 2 * bin, c)] = value.re * weight(bin);
                    rows[(top + 2 * bin + 1, c)] = value.im * weight(bin);
                }
            }
            top += 2 * kept;
        }
    }
    rows
}

/// Torques of all columns divided by the scale of their joint, so that a squared norm is a mean over samples.
fn scale_columns(runs: &[SeenRun], columns: &[TorqueColumn], scales: &[f64]) -> Mat<f64> {
    let samples: usize = runs.iter().map(SeenRun::rows).sum();
    let mut rows = Mat::zeros(samples * scales.len(), columns.len());
    let all = 1.0 / (samples.max(1) as f64).sqrt();
    for (c, column) in columns.iter().enumerate() {
        let mut top = 0;
        for torque in &column.torque {
            for (j, scale) in scales.iter().enumerate() {
                for (i, value) in torque.column(j).iter().enumerate() {
                    rows[(top + i, c)] = value * all / scale;
                }
                top += torque.nrows();
            }
        }
    }
    rows
}

/// Norm of column `k` after a fit by all columns that stand for something else. `weight` scales their priors.
fn unexplained_norm(k: usize, columns: &[TorqueColumn], gram: &Mat<f64>, weight: f64) -> f64 {
    let own = columns[k].stands_for;
    let same = |c: usize| own != StandIn::Itself && columns[c].stands_for == own;
    let free: Vec<usize> =
        (0..columns.len()).filter(|&c| c != k && !same(c) && gram[(c, c)] > 0.0).collect();
    if free.is_empty() || gram[(k, k)] <= 0.0 {
        return gram[(k, k)].max(0.0).sqrt();
    }
    // Columns are scaled to one, so that those of another unit do not count as none.
    let prior = |c: usize| weight * columns[c].prior;
    let scale: Vec<f64> = free.iter().map(|&c| (gram[(c, c)] + prior(c)).sqrt()).collect();
    let normal = Mat::from_fn(free.len(), free.len(), |a, b| {
        let diagonal = if a == b { prior(free[a]) } else { 0.0 };
        let ridge = if a == b { 1e-9 } else { 0.0 };
        (gram[(free[a], free[b])] + diagonal) / (scale[a] * scale[b]) + ridge
    });
    let right = Mat::from_fn(free.len(), 1, |a, _| gram[(free[a], k)] / scale[a]);
    // With its ridge the matrix is positive definite; one that is not tells nothing of the column.
    let Ok(factor) = normal.llt(Side::Lower) else { return 0.0 };
    let explained = (right.transpose() * factor.solve(&right))[(0, 0)];
    (gram[(k, k)] - explained).max(0.0).sqrt()
}

#[cfg(test)]
mod tests {
    use std::f64::consts::TAU;

    use super::*;
    use crate::oracle::noise::ReadingError;

    const ROWS: usize = 1000;
    const STEP_S: f64 = 0.01;

    fn wave(of: impl Fn(f64) -> f64) -> DMatrix<f64> {
        DMatrix::from_fn(ROWS, 1, |i, _| of(i as f64 * STEP_S))
    }

    fn run(effort: DMatrix<f64>) -> SeenRun {
        let zero = DMatrix::zeros(ROWS, 1);
        SeenRun {
            step_s: STEP_S,
            thinned: 1,
            q: zero.clone(),
            qd: zero.clone(),
            qdd: zero,
            beyond: effort.clone(),
            effort,
        }
    }

    fn itself(torque: DMatrix<f64>) -> TorqueColumn {
        TorqueColumn { stands_for: StandIn::Itself, torque: vec![torque], prior: 0.0 }
    }

    fn strengths_of(
        runs: &[SeenRun],
        columns: &[TorqueColumn],
        noise: &[OracleNoise],
    ) -> Vec<Strength> {
        let scale = effort_rms(runs, 0);
        strengths(runs, columns, 1, noise, &[scale])
    }

    /// `a sin` of whole periods in white noise has `a sqrt(N / 2) / sigma` deviations, a cosine beside it or not;
    /// with half of it said by another column, the half that is left.
    fn noise(effort: f64, position: f64, inertia: f64) -> OracleNoise {
        let error = |deviation| ReadingError { deviation, step: 0.0 };
        OracleNoise::new(error(effort), error(position), inertia)
    }

    #[test]
    fn a_sine_in_white_noise_is_as_sure_as_the_closed_form_says() {
        let sine = |a: f64| wave(move |t| a * (TAU * t).sin());
        let runs = [run(sine(2.0))];
        let noises = [noise(0.5, 0.0, 1.0)];
        let expected = 2.0 * (ROWS as f64 / 2.0).sqrt() / 0.5;
        let cosine = itself(wave(|t| (TAU * t).cos()));
        let [told] = strengths_of(&runs, &[itself(sine(2.0)), cosine], &noises)[..] else {
            panic!()
        };
        assert!((told.sigmas / expected - 1.0).abs() < 1e-3, "{} for {expected}", told.sigmas);
        assert!((told.share - 1.0).abs() < 1e-6 && (told.torque - 1.0).abs() < 1e-6);
        assert!(told.visible());

        let beside = itself(wave(|t| (TAU * t).sin() + (TAU * t).cos()));
        let [told] = strengths_of(&runs, &[itself(sine(2.0)), beside], &noises)[..] else {
            panic!()
        };
        assert!((told.sigmas / expected - 0.5_f64.sqrt()).abs() < 1e-3);

        let same = itself(sine(1.0));
        let [told] = strengths_of(&runs, &[itself(sine(2.0)), same], &noises)[..] else { panic!() };
        assert!(told.sigmas < 1e-3 * expected && !told.visible());
    }

    /// Noise of the encoder counts as `M (2 pi f)^2` times as much torque.
    #[test]
    fn noise_of_the_encoder_hides_what_is_fast() {
        let runs = [run(wave(|t| (TAU * t).sin()))];
        let fast = |hz: f64| vec![itself(wave(move |t| (TAU * hz * t).sin()))];
        let sigmas = |hz, sigma_q| {
            let noises = [noise(1e-3, sigma_q, 2.0)];
            strengths_of(&runs, &fast(hz), &noises)[0].sigmas
        };
        let carried = |hz: f64| 2.0 * (TAU * hz).powi(2) * 1e-3;
        for hz in [1.0, 10.0] {
            let expected =
                (1.0 + (carried(hz) / 1e-3_f64.hypot(1e-4 / 2.0_f64.sqrt())).powi(2)).sqrt();
            let ratio = sigmas(hz, 0.0) / sigmas(hz, 1e-3);
            assert!((ratio / expected - 1.0).abs() < 1e-2, "{ratio} for {expected}");
        }
    }

    /// What is known beforehand leaves what goes beyond it.
    #[test]
    fn a_stand_in_that_is_known_explains_no_more_than_it_may() {
        let sine = || wave(|t| (TAU * t).sin());
        let noises = [noise(0.1, 0.0, 1.0)];
        let known = |deviation: f64| TorqueColumn { prior: deviation.powi(-2), ..itself(sine()) };
        let sigmas = |deviation| {
            strengths_of(&[run(sine())], &[itself(sine()), known(deviation)], &noises)[0].sigmas
        };
        // One Gaussian of deviation d on top of another of 1 / sigmas.
        let alone = (ROWS as f64 / 2.0).sqrt() / 0.1;
        for deviation in [1e-3, 1e-2, 1e-1] {
            let expected = (alone.powi(-2) + f64::powi(deviation, 2)).powf(-0.5);
            assert!((sigmas(deviation) / expected - 1.0).abs() < 1e-2);
        }
    }
}
