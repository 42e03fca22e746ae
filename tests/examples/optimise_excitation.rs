//! Searches an excitation of the WAM that shows all its base parameters, and writes it to
//! `robots/wam7/excitation.toml`:
//!
//! ```text
//! cargo run --release -p checks --example optimise_excitation
//! ```
//!
//! The motion is a Fourier series (Swevers 1997) of one period of 10 s. What is made small
//! is the condition number of the base regressor stacked over the period, in SI units,
//!
//! ```text
//! cond = sigma_1(W) / sigma_r(W),   W = (Y(t_1); Y(t_2); ...),   r = 69 of 98 columns
//! ```
//!
//! the factor by which errors of the torque can grow in the parameters. The singular values
//! are those of all columns, the zeros left out: which columns stand for the base
//! parameters is a choice, and this is the number for orthonormal combinations of them.
//!
//! It is searched by gradient descent (Adam of Kingma and Ba, 2015) from several starts, every draw
//! from one seed.
#![allow(clippy::unwrap_used, reason = "a program for the desk may stop")]

use std::collections::BTreeMap;
use std::f64::consts::TAU;
use std::path::Path;

use checks::synthetic::wam;
use dynamics::{ColumnSet, Dynamics, RegressorColumn, Workspace, base_parameters};
use motion::{FourierJoint, FourierSeries};
use nalgebra::{DMatrix, Dyn, SymmetricEigen};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use rayon::prelude::*;
use robot::Robot;

const SEED: u64 = 1;
const STARTS: u64 = 4;
const STEPS: i32 = 1000;

const BASE_HZ: f64 = 0.1;
const HARMONICS: usize = 5;
/// States over one period: 40 in that of the highest harmonic.
const STATES: usize = 200;
/// Share of the limits of position and velocity that is used.
const SHARE: f64 = 0.9;
/// Largest acceleration (rad/s²).
const ACCELERATION: f64 = 6.0;
/// Share of the bounds from which on a state is pushed back.
const PUSHED_FROM: f64 = 0.98;
/// Weight of that push, beside `log cond`.
const PUSH: f64 = 4000.0;

/// Coefficients of one joint: offset (rad), then a and b of every harmonic (rad/s).
type Genes = [f64; GENES];
const GENES: usize = 1 + 2 * HARMONICS;

struct Problem {
    dynamics: Dynamics,
    columns: Vec<RegressorColumn>,
    /// Orthonormal basis of the combinations of parameters that motion shows: columns x r.
    basis: DMatrix<f64>,
    /// Middle and half width of position, velocity and acceleration of each joint.
    bounds: Vec<[(f64, f64); 3]>,
}

/// The regressors of a series, and the eigenvalues of `W^T W` on the basis.
struct Seen {
    y: Vec<DMatrix<f64>>,
    eigen: SymmetricEigen<f64, Dyn>,
}

impl Problem {
    fn new(robot: &Robot) -> Self {
        let base = base_parameters(robot, ColumnSet::ALL);
        // pi_base = pi[independent] + mapping pi[dependent]
        let mut shown = DMatrix::zeros(base.columns.len(), base.rank());
        for (i, &c) in base.independent.iter().enumerate() {
            shown[(c, i)] = 1.0;
        }
        for (d, &c) in base.dependent.iter().enumerate() {
            shown.set_row(c, &base.mapping.column(d).transpose());
        }
        let bounds = robot.links().iter().map(|link| {
            let limits = &link.joint.limits;
            let ((low, high), speed) = (limits.position.unwrap(), limits.velocity.unwrap());
            let position = (0.5 * (low + high), 0.5 * SHARE * (high - low));
            [position, (0.0, SHARE * speed), (0.0, ACCELERATION)]
        });
        Self {
            dynamics: Dynamics::new(robot),
            basis: shown.qr().q(),
            columns: base.columns,
            bounds: bounds.collect(),
        }
    }

    fn regressor(&self, workspace: &mut Workspace, x: &[Vec<f64>; 3]) -> DMatrix<f64> {
        let (n, width) = (self.bounds.len(), self.columns.len());
        let mut rows = vec![0.0; n * width];
        let signals = [&x[0][..], &x[1], &x[2]];
        self.dynamics.columns_into(workspace, signals, ColumnSet::ALL, &mut rows);
        DMatrix::from_row_slice(n, width, &rows)
    }

    fn see(&self, series: &[Genes]) -> Seen {
        let mut workspace = self.dynamics.workspace();
        let regressor = |t| self.regressor(&mut workspace, &state(series, &waves(t)));
        let y: Vec<DMatrix<f64>> = times().map(regressor).collect();
        let width = self.columns.len();
        let gram = y.iter().fold(DMatrix::zeros(width, width), |gram, y| gram + y.tr_mul(y));
        let eigen = (self.basis.tr_mul(&gram) * &self.basis).symmetric_eigen();
        Seen { y, eigen }
    }

    fn condition(&self, series: &[Genes]) -> f64 {
        let l = self.see(series).eigen.eigenvalues;
        (l.max() / l.min()).sqrt()
    }

    /// Gradient of `log cond`, made smooth, and of a push into the bounds. With the
    /// eigenvalues `l_i` and eigenvectors `u_i` of `W^T W`,
    ///
    /// ```text
    /// F  = 1/(2 p) (log sum l_i^p + log sum l_i^-p)        log cond as p grows
    /// dF = sum_t tr(dY_t^T Z_t),   Z_t = 2 Y_t sum_i dF/dl_i u_i u_i^T
    /// ```
    fn gradient(&self, series: &[Genes], p: f64) -> Vec<Genes> {
        let Seen { y, eigen } = self.see(series);
        let l = &eigen.eigenvalues;
        let (largest, smallest) = (l.max(), l.min());
        let (up, down) = (l.map(|l| (l / largest).powf(p)), l.map(|l| (smallest / l).powf(p)));
        let weights = (&up / up.sum() - &down / down.sum()).component_div(l) * 0.5;
        let u = &self.basis * &eigen.eigenvectors;
        let s = &u * DMatrix::from_diagonal(&weights) * u.transpose();
        let mut workspace = self.dynamics.workspace();
        let mut gradient = vec![[0.0; GENES]; series.len()];
        for (t, y) in times().zip(y) {
            let (waves, mut z) = (waves(t), 2.0 * y * &s);
            // A sign has no slope.
            let is_sign = |c: &usize| matches!(self.columns[*c], RegressorColumn::Coulomb { .. });
            (0..z.ncols()).filter(is_sign).for_each(|c| z.column_mut(c).fill(0.0));
            let x = state(series, &waves);
            for (joint, gradient) in gradient.iter_mut().enumerate() {
                for (k, wave) in waves.iter().enumerate() {
                    let slope = self.slope(&mut workspace, &x, (k, joint), &z)
                        + self.push(joint, k, x[k][joint]);
                    gradient.iter_mut().zip(wave).for_each(|(g, part)| *g += slope * part);
                }
            }
        }
        gradient
    }

    /// `tr(dY^T Z) / dx` for one signal of one joint, by a central difference.
    fn slope(
        &self,
        workspace: &mut Workspace,
        x: &[Vec<f64>; 3],
        (k, joint): (usize, usize),
        z: &DMatrix<f64>,
    ) -> f64 {
        const STEP: f64 = 1e-6;
        let mut moved = |by: f64| {
            let mut x = x.clone();
            x[k][joint] += by;
            self.regressor(workspace, &x).dot(z)
        };
        (moved(STEP) - moved(-STEP)) / (2.0 * STEP)
    }

    /// Slope of `PUSH / STATES max(0, |x - middle| / half - PUSHED_FROM)^2`.
    fn push(&self, joint: usize, k: usize, x: f64) -> f64 {
        let (middle, half) = self.bounds[joint][k];
        let share = (x - middle) / half;
        let over = (share.abs() - PUSHED_FROM).max(0.0);
        2.0 * PUSH / STATES as f64 * over * share.signum() / half
    }

    /// The nearest series within the bounds: smaller, then moved.
    fn within_bounds(&self, series: &[Genes]) -> Vec<Genes> {
        let bounded = |(genes, bounds): (&Genes, &[(f64, f64); 3])| {
            let [(middle, half), (_, speed), (_, acceleration)] = *bounds;
            let signal = |k: usize| times().map(move |t| dot(genes, &waves(t)[k]));
            let largest = |k: usize| signal(k).map(f64::abs).fold(0.0, f64::max);
            let (low, high) =
                (signal(0).fold(f64::MAX, f64::min), signal(0).fold(f64::MIN, f64::max));
            let by_speed = (speed / largest(1)).min(acceleration / largest(2));
            let scale = (2.0 * half / (high - low)).min(by_speed).min(1.0);
            let (below, above) = (scale * (genes[0] - low), scale * (high - genes[0]));
            let mut genes = genes.map(|gene| scale * gene);
            genes[0] = (genes[0] / scale).max(middle - half + below).min(middle + half - above);
            genes
        };
        series.iter().zip(&self.bounds).map(bounded).collect()
    }

    /// One start: the best series on the way, and its condition number.
    fn search(&self, start: u64) -> (f64, Vec<Genes>) {
        let mut rng = ChaCha8Rng::seed_from_u64(SEED);
        rng.set_stream(start);
        let mut draw = || std::array::from_fn(|_| rng.random_range(-0.6..0.6));
        let mut series: Vec<Genes> = self.bounds.iter().map(|_| draw()).collect();
        series = self.within_bounds(&series);
        let mut best = (self.condition(&series), series.clone());
        println!("start {start}: {:.1} to begin with", best.0);
        let (mut mean, mut square) =
            (vec![[0.0; GENES]; series.len()], vec![[0.0; GENES]; series.len()]);
        for step in 1..=STEPS {
            let share = f64::from(step) / f64::from(STEPS);
            let gradient = self.gradient(&series, 1.0 + 7.0 * share);
            let rate = 0.03 * (1.0 - share) + 0.0005;
            for (joint, genes) in series.iter_mut().enumerate() {
                for (k, gene) in genes.iter_mut().enumerate() {
                    let (g, m, v) =
                        (gradient[joint][k], &mut mean[joint][k], &mut square[joint][k]);
                    *m += 0.1 * (g - *m);
                    *v += 0.01 * (g * g - *v);
                    let m = *m / (1.0 - 0.9_f64.powi(step));
                    let v = *v / (1.0 - 0.99_f64.powi(step));
                    *gene -= rate * m / (v.sqrt() + 1e-9);
                }
            }
            let bounded = self.within_bounds(&series);
            let condition = self.condition(&bounded);
            if condition < best.0 {
                best = (condition, bounded);
            }
        }
        println!("start {start}: {:.1} in the end", best.0);
        best
    }
}

/// The times of the states in one period (s).
fn times() -> impl Iterator<Item = f64> {
    (0..STATES).map(|k| k as f64 / (BASE_HZ * STATES as f64))
}

/// What one unit of every gene adds to position, velocity and acceleration at a time (s),
/// as in [`FourierSeries`].
fn waves(t: f64) -> [Genes; 3] {
    let mut waves = [[0.0; GENES]; 3];
    waves[0][0] = 1.0;
    for k in 0..HARMONICS {
        let w = TAU * BASE_HZ * (k + 1) as f64;
        let (s, c) = (w * t).sin_cos();
        let (a, b) = (1 + k, 1 + HARMONICS + k);
        for (wave, (of_a, of_b)) in waves.iter_mut().zip([(s / w, -c / w), (c, s), (-w * s, w * c)])
        {
            (wave[a], wave[b]) = (of_a, of_b);
        }
    }
    waves
}

fn dot(x: &Genes, y: &Genes) -> f64 {
    x.iter().zip(y).map(|(x, y)| x * y).sum()
}

/// Position, velocity and acceleration of all joints.
fn state(series: &[Genes], waves: &[Genes; 3]) -> [Vec<f64>; 3] {
    waves.each_ref().map(|wave| series.iter().map(|genes| dot(genes, wave)).collect())
}

fn main() {
    let robot = wam();
    let problem = Problem::new(&robot);
    let found: Vec<_> = (0..STARTS).into_par_iter().map(|start| problem.search(start)).collect();
    let (_, best) = found.into_iter().min_by(|x, y| x.0.total_cmp(&y.0)).unwrap();

    // Five decimals: 1e-5 rad/s of a velocity of 2 rad/s.
    let rounded = |x: f64| (x * 1e5).round() / 1e5;
    let best: Vec<Genes> = best.iter().map(|genes| genes.map(rounded)).collect();
    let condition = problem.condition(&best);
    let joint = |(name, genes): (&str, &Genes)| {
        let (a, b) = genes[1..].split_at(HARMONICS);
        let (a_rad_per_s, b_rad_per_s) = (a.to_vec(), b.to_vec());
        (name.to_owned(), FourierJoint { offset_rad: genes[0], a_rad_per_s, b_rad_per_s })
    };
    let joint: BTreeMap<_, _> = robot.joint_names().zip(&best).map(joint).collect();
    let series = FourierSeries { base_hz: BASE_HZ, joint };
    let rank = problem.basis.ncols();
    let text = format!(
        "# Excitation of the WAM, a Fourier series with a period of {} s. The base regressor over\n\
        # one period ({rank} base parameters: links, rotors, viscous and Coulomb friction, offsets)\n\
        # has the condition number {condition:.1}. Written by\n\
        #     cargo run --release -p checks --example optimise_excitation\n{}",
        1.0 / BASE_HZ,
        toml::to_string(&series).unwrap()
    );
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../robots/wam7/excitation.toml");
    std::fs::write(&path, text).unwrap();
    println!("condition number {condition:.2} of {rank} columns: {}", path.display());
}
