use dynamics::{ColumnSet, Dynamics, Workspace};
use learner::{SampleState, Samples};
use robot::Robot;

/// The rigid-body part of equation 10 of Nguyen-Tuong & Peters 2010 as it stands there, with
/// the kernel evaluated for every training point:
///
/// ```text
/// tau_k(x) = sum_i alpha_ki phi_k(x)' W_k phi_k(x_i)
/// ```
///
/// [`learner::Model`] sums `W_k Phi_k' alpha_k` once instead, which gives the same torque.
pub struct RegressorKernel {
    dynamics: Dynamics,
    ws: Workspace,
    /// `phi_k(x)`, one row a joint.
    rows: Vec<f64>,
    /// `W_k phi_k(x_i)`, row-major, one matrix a joint.
    features: Vec<Vec<f64>>,
}

impl RegressorKernel {
    /// The kernel with `W = 1` over all samples.
    pub fn new(robot: &Robot, samples: &Samples) -> Self {
        let (dynamics, joints) = (Dynamics::new(robot), robot.joint_count());
        let width = ColumnSet::INERTIAL.columns(joints).len();
        let ws = dynamics.workspace();
        let features = vec![Vec::with_capacity(samples.len() * width); joints];
        let mut kernel = Self { dynamics, ws, rows: vec![0.0; joints * width], features };
        for index in 0..samples.len() {
            kernel.fill_rows(samples.state(index));
            let rows = kernel.rows.chunks_exact(width);
            kernel.features.iter_mut().zip(rows).for_each(|(f, row)| f.extend_from_slice(row));
        }
        kernel
    }

    fn fill_rows(&mut self, SampleState { q, qd, qdd }: SampleState) {
        let set = ColumnSet::INERTIAL;
        self.dynamics.columns_into(&mut self.ws, [q, qd, qdd], set, &mut self.rows);
    }

    /// Adds the torque of every joint to `tau`, with weights `alpha`, one row a joint.
    pub fn add_torque(&mut self, state: SampleState, alpha: &[Vec<f64>], tau: &mut [f64]) {
        self.fill_rows(state);
        let width = self.rows.len() / tau.len().max(1);
        let joints = self.rows.chunks_exact(width).zip(&self.features).zip(alpha);
        for (tau, ((row, features), alpha)) in tau.iter_mut().zip(joints) {
            for (phi, alpha) in features.chunks_exact(width).zip(alpha) {
                *tau += alpha * phi.iter().zip(row).map(|(a, b)| a * b).sum::<f64>();
            }
        }
    }
}
