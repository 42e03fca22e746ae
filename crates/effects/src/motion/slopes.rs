use dynamics::Dynamics;
use robot::Robot;

use crate::motion::drive::spring_slope;
use crate::motion::encoders::JointMotions;
use crate::motion::rigid_bodies::{along, samples};

/// Derivatives of the loads of all joints by the motion of the links.
#[derive(Debug, Clone)]
pub(crate) struct Slopes {
    /// `[moved][joint]`: the load's derivatives by position, velocity and acceleration of the link that
    /// is moved, sample by sample.
    of: Vec<Vec<[Vec<f64>; 3]>>,
}

impl Slopes {
    /// The derivatives of rigid-body and spring torques along `link` by the state of every joint, without
    /// the loop of the spring, which depends on the past.
    pub fn new(robot: &Robot, link: &JointMotions) -> Self {
        let n = robot.joint_count();
        let mut of = vec![vec![[(); 3].map(|()| vec![0.0; samples(link)]); n]; n];
        let dynamics = Dynamics::new(robot);
        let mut ws = dynamics.workspace();
        let mut matrices = [(); 3].map(|()| vec![0.0; n * n]);
        along(link, |t, [q, qd, qdd]| {
            let [dq, dqd, dqdd] = &mut matrices;
            dynamics.inverse_dynamics_derivatives_into(&mut ws, [q, qd, qdd], [dq, dqd, dqdd]);
            for (j, link) in robot.links().iter().enumerate() {
                matrices[0][j * n + j] += spring_slope(&link.actuator, q[j]);
            }
            for (j, moved) in of.iter_mut().enumerate() {
                for (i, slopes) in moved.iter_mut().enumerate() {
                    slopes.iter_mut().zip(&matrices).for_each(|(s, m)| s[t] = m[i * n + j]);
                }
            }
        });
        Self { of }
    }

    /// Derivatives of the load of each joint by position, velocity and acceleration of the link of joint `j`.
    pub fn by(&self, j: usize) -> &[[Vec<f64>; 3]] {
        &self.of[j]
    }
}
