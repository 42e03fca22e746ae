use rayon::prelude::*;

use crate::samples::{SampleState, Samples};

/// Samples that one thread predicts at a time.
const CHUNK: usize = 64;

/// Scratch memory of a model that predicts.
#[derive(Debug, Clone)]
pub struct TorqueWorkspace {
    pub(crate) dynamics: dynamics::Workspace,
    /// Inputs of a process.
    pub(crate) x: Vec<f64>,
    /// Rows of the regressor, row-major.
    pub(crate) rows: Vec<f64>,
    /// Covariances with the points.
    pub(crate) k_star: Vec<f64>,
    /// The same, multiplied by the inverse covariance of the points.
    pub(crate) solved: Vec<f64>,
    /// A row of the regressor minus its part that the process explains.
    pub(crate) left: Vec<f64>,
    /// The torque that the process adds to the mean.
    pub(crate) process: Vec<f64>,
}

/// A model of the torque that is ready to predict.
pub trait TorqueModel: Sync {
    /// Number of joints.
    fn joints(&self) -> usize;

    /// What the model is, in words.
    fn words(&self) -> String;

    /// Room for one thread to predict in.
    fn workspace(&self) -> TorqueWorkspace;

    /// Fills `tau` with the torque of every joint (N m or N); allocates nothing.
    ///
    /// # Panics
    ///
    /// When the state or `tau` is of another number of joints, or `ws` of another model.
    fn torque_into(&self, ws: &mut TorqueWorkspace, state: SampleState, tau: &mut [f64]);

    /// Fills `variance` with that of a measured torque about the prediction, noise included (N² m²
    /// or N²), NaN where the model has no variance; allocates nothing.
    ///
    /// # Panics
    ///
    /// As [`torque_into`](Self::torque_into).
    fn variance_into(&self, ws: &mut TorqueWorkspace, state: SampleState, variance: &mut [f64]);

    /// The torque in every sample, row-major; in parallel, the same for any number of threads.
    fn torque(&self, samples: &Samples) -> Vec<f64> {
        each(self, samples, |ws, state, tau| self.torque_into(ws, state, tau))
    }

    /// The variance in every sample, row-major, to rounding that of
    /// [`variance_into`](Self::variance_into); in parallel, the same for any number of threads.
    fn variance(&self, samples: &Samples) -> Vec<f64> {
        each(self, samples, |ws, state, variance| self.variance_into(ws, state, variance))
    }
}

/// The numbers that `fill` computes for every sample, row-major.
pub(crate) fn each<M: TorqueModel + ?Sized>(
    model: &M,
    samples: &Samples,
    fill: impl Fn(&mut TorqueWorkspace, SampleState, &mut [f64]) + Sync,
) -> Vec<f64> {
    let joints = model.joints();
    let mut all = vec![0.0; samples.len() * joints];
    all.par_chunks_mut(CHUNK * joints.max(1)).enumerate().for_each_init(
        || model.workspace(),
        |ws, (chunk, rows)| {
            for (k, row) in rows.chunks_exact_mut(joints.max(1)).enumerate() {
                fill(ws, samples.state(chunk * CHUNK + k), row);
            }
        },
    );
    all
}
