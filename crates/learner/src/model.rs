use std::ops::Range;

use dynamics::{ColumnSet, Dynamics};
use faer::Mat;
use gaussian_process::KernelSum;
use rayon::prelude::*;
use robot::Robot;

use crate::error::LearnerError;
use crate::inputs::ProcessInputs;
use crate::model_kind::ModelKind;
use crate::robot_torque::RobotTorque;
use crate::samples::{SampleState, Samples};
use crate::spread::Spread;
use crate::torque_model::{TorqueModel, TorqueWorkspace, each};

/// Queries whose variance is worked out together.
const BLOCK: usize = 64;

/// Signal variance of a joint without a process, as a kernel must have one.
const NO_SIGNAL: f64 = 1e-100;

/// A learned model of the torque of every joint:
///
/// ```text
/// tau_k = mean_k(q, qd, qdd) + sum_i alpha_ki k_k(x, x_i)
/// ```
///
/// which all models of Nguyen-Tuong & Peters 2010 are once their parameters are known: the
/// prior on the parameters (equation 7) only moves `beta`, and the rigid-body kernel
/// (equation 10) sums up to `beta = W Phi' alpha`.
#[derive(Debug, Clone)]
pub struct Model {
    /// What was learned.
    pub kind: ModelKind,
    /// The mean that the process is about.
    pub mean: Mean,
    /// Covariance of the weights of the mean, for every joint, where they are uncertain.
    pub weights: Vec<Mat<f64>>,
    /// Variance of the noise of every joint (N² m² or N²).
    pub noise_variance: Vec<f64>,
    /// The process; absent where only the mean was learned.
    pub process: Option<Process>,
    robot: Robot,
    dynamics: Dynamics,
}

/// The mean of a model, without its process.
#[derive(Debug, Clone)]
pub enum Mean {
    /// Nothing.
    Zero,
    /// Columns of the regressor with weights of every joint's own, `phi_k' beta_k`.
    Columns {
        /// The columns.
        set: ColumnSet,
        /// `beta`, one row a joint.
        beta: Vec<Vec<f64>>,
    },
    /// A description of the robot.
    Robot(Box<RobotTorque>),
}

/// Gaussian processes of all joints over the same points.
#[derive(Debug, Clone)]
pub struct Process {
    /// How a state becomes an input.
    pub inputs: ProcessInputs,
    /// Points, kernels and `alpha` of every joint.
    pub sum: KernelSum,
    /// What the variance is computed from; absent where only the mean is needed.
    pub spread: Option<Spread>,
}

impl Model {
    /// A model of `robot` from its parts.
    pub fn new(kind: ModelKind, robot: &Robot, mean: Mean, noise_variance: Vec<f64>) -> Self {
        let (weights, process) = (Vec::new(), None);
        let dynamics = Dynamics::new(robot);
        Self { kind, mean, weights, noise_variance, process, robot: robot.clone(), dynamics }
    }

    /// The robot it is a model of.
    pub fn robot(&self) -> &Robot {
        &self.robot
    }

    /// Removes the process at one joint. Its torque is then the mean, with a noise of
    /// `noise_variance` (N² m² or N²).
    ///
    /// # Errors
    ///
    /// [`LearnerError::GaussianProcess`] where that is no number.
    pub fn drop_process(&mut self, joint: usize, noise_variance: f64) -> Result<(), LearnerError> {
        let Some(process) = &mut self.process else { return Ok(()) };
        let Process { inputs, sum, .. } = process;
        let mut kernels = sum.kernels().to_vec();
        let mut alpha: Vec<Vec<f64>> = (0..kernels.len()).map(|k| sum.alpha(k)).collect();
        kernels[joint].signal_variance = NO_SIGNAL;
        alpha[joint].fill(0.0);
        *sum = KernelSum::new(&sum.points(), inputs.width(), &kernels, &alpha)?;
        self.noise_variance[joint] = noise_variance;
        Ok(())
    }

    /// Fills `ws.rows` with the rows of the regressor, where the mean has any.
    fn rows(&self, ws: &mut TorqueWorkspace, state: SampleState) {
        if let Mean::Columns { set, .. } = &self.mean {
            let state = [state.q, state.qd, state.qdd];
            self.dynamics.columns_into(&mut ws.dynamics, state, *set, &mut ws.rows);
        }
    }

    /// The variance in the samples `block`, row-major; empty without a process and its spread.
    fn block_variance(&self, samples: &Samples, block: Range<usize>) -> Vec<f64> {
        let Some(process) = &self.process else { return Vec::new() };
        let Some(spread) = &process.spread else { return Vec::new() };
        let (joints, width, n) = (self.joints(), self.width(), process.sum.len());
        let mut ws = self.workspace();
        let (mut x, mut rows) = (Vec::new(), Vec::new());
        for state in block.clone().map(|i| samples.state(i)) {
            process.inputs.fill(state, &mut ws.x);
            self.rows(&mut ws, state);
            x.push(ws.x.clone());
            rows.push(ws.rows.clone());
        }
        let mut variance = self.noise_variance.repeat(block.len());
        let mut k_star = vec![0.0; block.len() * n];
        let mut solved = vec![0.0; block.len() * n];
        for k in 0..joints {
            let queries = k_star.par_chunks_exact_mut(n).zip(&x);
            queries.for_each(|(k_star, x)| process.sum.covariances_into(k, x, k_star));
            let explained = spread.explain_each(k, &k_star, &mut solved);
            let prior = process.sum.kernels()[k].signal_variance;
            for (i, explained) in explained.into_iter().enumerate() {
                let variance = &mut variance[i * joints + k];
                *variance += (prior - explained).max(0.0);
                ws.left.copy_from_slice(&rows[i][k * width..(k + 1) * width]);
                spread.take_from(k, &solved[i * n..(i + 1) * n], &mut ws.left);
                if let Some(covariance) = self.weights.get(k) {
                    *variance += quadratic(covariance, &ws.left);
                }
            }
        }
        variance
    }

    /// Number of columns of the mean.
    fn width(&self) -> usize {
        match &self.mean {
            Mean::Columns { beta, .. } => beta.first().map_or(0, Vec::len),
            Mean::Zero | Mean::Robot(_) => 0,
        }
    }
}

impl TorqueModel for Model {
    fn joints(&self) -> usize {
        self.noise_variance.len()
    }

    fn words(&self) -> String {
        match &self.process {
            None => self.kind.words().to_owned(),
            Some(process) => {
                let (points, inputs) = (process.sum.len(), process.inputs.width());
                format!("{}; {points} points, {inputs} inputs", self.kind.words())
            }
        }
    }

    fn workspace(&self) -> TorqueWorkspace {
        let points = self.process.as_ref().map_or(0, |p| p.sum.len());
        let inputs = self.process.as_ref().map_or(0, |p| p.inputs.width());
        TorqueWorkspace {
            dynamics: self.dynamics.workspace(),
            x: vec![0.0; inputs],
            rows: vec![0.0; self.joints() * self.width()],
            k_star: vec![0.0; points],
            solved: vec![0.0; points],
            left: vec![0.0; self.width()],
            process: vec![0.0; self.joints()],
        }
    }

    fn torque_into(&self, ws: &mut TorqueWorkspace, state: SampleState, tau: &mut [f64]) {
        match &self.mean {
            Mean::Zero => tau.fill(0.0),
            Mean::Columns { beta, .. } => {
                self.rows(ws, state);
                let rows = ws.rows.chunks_exact(self.width().max(1));
                for ((tau, row), beta) in tau.iter_mut().zip(rows).zip(beta) {
                    *tau = dot(row, beta);
                }
            }
            Mean::Robot(torque) => torque.fill(&mut ws.dynamics, state, tau),
        }
        if let Some(process) = &self.process {
            process.inputs.fill(state, &mut ws.x);
            process.sum.evaluate_into(&ws.x, &mut ws.process);
            tau.iter_mut().zip(&ws.process).for_each(|(tau, f)| *tau += f);
        }
    }

    fn variance_into(&self, ws: &mut TorqueWorkspace, state: SampleState, variance: &mut [f64]) {
        variance.copy_from_slice(&self.noise_variance);
        self.rows(ws, state);
        let spread = match &self.process {
            None => None,
            Some(process) => {
                process.inputs.fill(state, &mut ws.x);
                let Some(spread) = &process.spread else { return variance.fill(f64::NAN) };
                Some((process, spread))
            }
        };
        let width = self.width();
        for (k, variance) in variance.iter_mut().enumerate() {
            ws.left.copy_from_slice(&ws.rows[k * width..(k + 1) * width]);
            if let Some((process, spread)) = spread {
                process.sum.covariances_into(k, &ws.x, &mut ws.k_star);
                let explained = spread.explain(k, &ws.k_star, &mut ws.solved);
                *variance += (process.sum.kernels()[k].signal_variance - explained).max(0.0);
                spread.take_from(k, &ws.solved, &mut ws.left);
            }
            if let Some(covariance) = self.weights.get(k) {
                *variance += quadratic(covariance, &ws.left);
            }
        }
    }

    /// As in [`TorqueModel::variance`], to rounding: queries are worked through in blocks, so
    /// that the inverse covariance of a joint is read once for many.
    fn variance(&self, samples: &Samples) -> Vec<f64> {
        match &self.process {
            Some(Process { spread: Some(_), .. }) => {
                let block = |start: usize| start..(start + BLOCK).min(samples.len());
                let starts = (0..samples.len()).step_by(BLOCK);
                starts.flat_map(|start| self.block_variance(samples, block(start))).collect()
            }
            _ => each(self, samples, |ws, state, variance| self.variance_into(ws, state, variance)),
        }
    }
}

fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

/// `x' S x`.
fn quadratic(s: &Mat<f64>, x: &[f64]) -> f64 {
    let column = |j: usize| -> f64 { (0..x.len()).map(|i| s[(i, j)] * x[i]).sum() };
    (0..x.len()).map(|j| x[j] * column(j)).sum()
}
