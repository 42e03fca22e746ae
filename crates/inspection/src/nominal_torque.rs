use dynamics::{Dynamics, Workspace};
use nalgebra::Vector3;
use robot::Robot;

use crate::motion_samples::MotionSamples;

/// Nominal torque along samples, `rows x joints`: rigid bodies alone.
pub(crate) struct NominalTorque {
    whole: Dynamics,
    still: Dynamics,
    unit: [Dynamics; 3],
    workspace: Workspace,
}

impl NominalTorque {
    pub fn new(robot: &Robot) -> Self {
        let torque_under = |g: Vector3<f64>| Dynamics::new(&robot.clone().with_gravity(g));
        let whole = Dynamics::new(robot);
        Self {
            workspace: whole.workspace(),
            still: torque_under(Vector3::zeros()),
            unit: [Vector3::x(), Vector3::y(), Vector3::z()].map(torque_under),
            whole,
        }
    }

    /// `M qdd + C qd + g` along a motion.
    pub fn whole(&mut self, joints: usize, motion: &[Vec<f64>; 3]) -> Vec<f64> {
        along(&self.whole, &mut self.workspace, joints, motion)
    }

    /// `M qdd + C qd` along a motion.
    pub fn inertial(&mut self, samples: &MotionSamples) -> Vec<f64> {
        along(&self.still, &mut self.workspace, samples.joints, &samples.motion)
    }

    /// Torque of gravity per unit of its three components in the base frame.
    pub fn gravity(&mut self, samples: &MotionSamples) -> [Vec<f64>; 3] {
        let [q, qd, _] = &samples.motion;
        let rest = vec![0.0; qd.len()];
        let still = [q.clone(), rest.clone(), rest];
        let workspace = &mut self.workspace;
        self.unit.each_ref().map(|unit| along(unit, workspace, samples.joints, &still))
    }
}

fn along(
    dynamics: &Dynamics,
    workspace: &mut Workspace,
    joints: usize,
    [q, qd, qdd]: &[Vec<f64>; 3],
) -> Vec<f64> {
    let mut tau = vec![0.0; q.len()];
    let rows = q.chunks_exact(joints).zip(qd.chunks_exact(joints)).zip(qdd.chunks_exact(joints));
    for (((q, qd), qdd), tau) in rows.zip(tau.chunks_exact_mut(joints)) {
        dynamics.inverse_dynamics_into(workspace, q, qd, qdd, tau);
    }
    tau
}
