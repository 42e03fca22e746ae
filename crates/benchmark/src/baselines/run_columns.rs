use dynamics::{Dynamics, PARAMETERS_PER_LINK};
use logs::{PreparedRun, decimate};
use robot::Robot;

use crate::baselines::scales::Scales;
use crate::baselines::shape::Shape;

/// Signals as `[joint][sample]`.
type Signals = Vec<Vec<f64>>;

/// The motion of a run and all signals from which its columns are made.
pub(super) struct RunColumns<'a> {
    robot: &'a Robot,
    dynamics: Dynamics,
    state: [Signals; 3],
    sign: Signals,
}

impl<'a> RunColumns<'a> {
    /// Every `stride`-th sample of a run, corrected for the described encoder errors: `q = ratio (q_reported -
    /// offset)`.
    pub fn new(robot: &'a Robot, scales: &'a Scales, run: &PreparedRun, stride: usize) -> Self {
        let mut state = [Vec::new(), Vec::new(), Vec::new()];
        for (link, joint) in robot.links().iter().zip(&run.joints) {
            let (ratio, offset) = (link.actuator.transmission_ratio, link.actuator.encoder_offset);
            let wide = &joint.wide;
            let own = [(&wide.q, offset), (&wide.qd, 0.0), (&wide.qdd, 0.0)];
            for (state, (x, zero)) in state.iter_mut().zip(own) {
                let seen = decimate(x, stride).into_iter().map(|x| ratio * (x - zero));
                state.push(seen.collect::<Vec<f64>>());
            }
        }
        let speeds = state[1].iter().zip(&scales.sign_speed);
        let sign = speeds.map(|(qd, s)| qd.iter().map(|v| (v / s).tanh()).collect()).collect();
        Self { robot, dynamics: Dynamics::new(robot), state, sign }
    }

    /// Number of samples.
    pub fn samples(&self) -> usize {
        self.sign.first().map_or(0, Vec::len)
    }

    /// The columns of `shapes`, listed by joint, along the run: `[joint][shape][sample]`.
    pub fn columns(&self, shapes: &[Vec<Shape>]) -> Vec<Vec<Vec<f64>>> {
        let simple = |(j, shapes): (usize, &Vec<Shape>)| {
            shapes.iter().map(|shape| self.simple(j, *shape)).collect()
        };
        let mut columns: Vec<Vec<Vec<f64>>> = shapes.iter().enumerate().map(simple).collect();
        self.fill_bodies(shapes, &mut columns);
        columns
    }

    /// A column that is a function of the joint's own signals; empty for other columns.
    fn simple(&self, j: usize, shape: Shape) -> Vec<f64> {
        let [q, qd, qdd] = [0, 1, 2].map(|i| &self.state[i][j]);
        match shape {
            Shape::Velocity => qd.clone(),
            Shape::Sign => self.sign[j].clone(),
            Shape::One => vec![1.0; q.len()],
            Shape::Acceleration => qdd.clone(),
            Shape::Body { .. } => Vec::new(),
        }
    }

    fn fill_bodies(&self, shapes: &[Vec<Shape>], columns: &mut [Vec<Vec<f64>>]) {
        let n = self.robot.joint_count();
        let width = PARAMETERS_PER_LINK * n;
        let mut places = Vec::new();
        for (j, shapes) in shapes.iter().enumerate() {
            for (at, shape) in shapes.iter().enumerate() {
                if let Shape::Body { link, parameter } = *shape {
                    places.push((j, at, j * width + PARAMETERS_PER_LINK * link + parameter));
                    columns[j][at].reserve(self.samples());
                }
            }
        }
        let mut y = vec![0.0; n * width];
        let mut ws = self.dynamics.workspace();
        let mut at = vec![vec![0.0; n]; 3];
        for k in 0..self.samples() {
            for (at, state) in at.iter_mut().zip(&self.state) {
                at.iter_mut().zip(state).for_each(|(at, x)| *at = x[k]);
            }
            self.dynamics.torque_regressor_into(&mut ws, &at[0], &at[1], &at[2], &mut y);
            for (j, at, index) in &places {
                columns[*j][*at].push(y[*index]);
            }
        }
    }
}
