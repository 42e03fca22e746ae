use dynamics::Dynamics;
use robot::Robot;

use crate::motion::drive::spring_slope;
use crate::motion::encoders::State;
use crate::motion::rigid_bodies::{along, samples};

/// What moving the links changes in the loads of all joints.
#[derive(Debug, Clone)]
pub(crate) struct Slopes {
    /// `[moved][joint]`: the load's derivatives by position, velocity and acceleration of the link that
    /// is moved, sample by sample.
    of: Vec<Vec<[Vec<f64>; 3]>>,
}

impl Slopes {
    /// The derivatives of rigid-body and spring torques along `link` by the state of every joint, but for
    /// the loop of the spring, which has a past.
    pub fn new(robot: &Robot, link: &State) -> Self {
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

    /// What moving the link of joint `j` changes: per joint, the load's derivatives by position, velocity
    /// and acceleration of that link.
    pub fn by(&self, j: usize) -> &[[Vec<f64>; 3]] {
        &self.of[j]
    }
}
