use dynamics::Dynamics;
use robot::Robot;

use crate::motion::State;

/// Steps of the central differences in position (rad or m) and velocity (rad/s or m/s).
const STEP: f64 = 1e-5;

/// What moving the link of one joint changes in the loads of all.
#[derive(Debug, Clone)]
pub(crate) struct Slopes {
    /// Per joint, the load's derivatives by position, velocity and acceleration of the link,
    /// sample by sample.
    pub of: Vec<[Vec<f64>; 3]>,
}

impl Slopes {
    /// The derivatives of rigid-body and spring torques along `link` by the state of joint `j`, but for
    /// the loop of the spring, which has a past.
    pub fn new(robot: &Robot, link: &State, j: usize) -> Self {
        let n = robot.joint_count();
        let samples = link[0].first().map_or(0, Vec::len);
        let mut of = vec![[0, 1, 2].map(|_| vec![0.0; samples]); n];
        let dynamics = Dynamics::new(robot);
        let mut ws = dynamics.workspace();
        let mut state = [vec![0.0; n], vec![0.0; n], vec![0.0; n]];
        let (mut up, mut down) = (vec![0.0; n], vec![0.0; n]);
        let drive = &robot.links()[j].actuator;
        // Torque is linear in the acceleration: a step of one is exact.
        let steps = [STEP, STEP, 0.5];
        for t in 0..samples {
            for (x, signal) in state.iter_mut().zip(link) {
                x.iter_mut().zip(signal).for_each(|(x, s)| *x = s[t]);
            }
            for (k, step) in steps.into_iter().enumerate() {
                let here = state[k][j];
                state[k][j] = here + step;
                dynamics.inverse_dynamics_into(&mut ws, &state[0], &state[1], &state[2], &mut up);
                state[k][j] = here - step;
                dynamics.inverse_dynamics_into(&mut ws, &state[0], &state[1], &state[2], &mut down);
                state[k][j] = here;
                for (i, slopes) in of.iter_mut().enumerate() {
                    slopes[k][t] = (up[i] - down[i]) / (2.0 * step);
                }
            }
            let x = state[0][j] - drive.spring_rest;
            of[j][0][t] += drive.spring_stiffness + 3.0 * drive.spring_cubic * x * x;
        }
        Self { of }
    }
}
