use dynamics::{Dynamics, PARAMETERS_PER_LINK, Workspace};
use logs::{PreparedRun, decimate, differentiate};
use nalgebra::Vector3;
use robot::Robot;

use crate::baselines::drive::{Instant, effort};
use crate::baselines::scales::Scales;
use crate::baselines::shape::Shape;

/// Step of a difference by position and velocity (rad or m, and per s).
const STEP: f64 = 1e-4;

/// Signals as `[joint][sample]`.
type Signals = Vec<Vec<f64>>;

/// The motion of a run and all signals from which its columns are made.
pub(super) struct RunColumns<'a> {
    robot: &'a Robot,
    scales: &'a Scales,
    dynamics: Dynamics,
    rate_hz: f64,
    state: [Signals; 3],
    sign: Signals,
    body: Signals,
    /// Effort of the robot as described (N m or N).
    pub nominal: Signals,
}

impl<'a> RunColumns<'a> {
    /// Every `stride`-th sample of a run, corrected for the described encoder errors: `q = ratio (q_reported -
    /// offset)`.
    pub fn new(robot: &'a Robot, scales: &'a Scales, run: &PreparedRun, stride: usize) -> Self {
        let n = robot.joint_count();
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
        let mut run_columns = Self {
            robot,
            scales,
            dynamics: Dynamics::new(robot),
            rate_hz: run.rate_hz / stride.max(1) as f64,
            state,
            sign,
            body: vec![Vec::new(); n],
            nominal: vec![Vec::new(); n],
        };
        run_columns.evaluate();
        run_columns
    }

    /// Number of samples.
    pub fn samples(&self) -> usize {
        self.sign.first().map_or(0, Vec::len)
    }

    /// Computes the torque of the bodies and the nominal effort.
    fn evaluate(&mut self) {
        let n = self.robot.joint_count();
        let mut body = vec![Vec::with_capacity(self.samples()); n];
        self.each(|dynamics, ws, _, [q, qd, qdd]| {
            let mut tau = vec![0.0; n];
            dynamics.inverse_dynamics_into(ws, q, qd, qdd, &mut tau);
            body.iter_mut().zip(tau).for_each(|(body, tau)| body.push(tau));
        });
        self.body = body;
        for (j, link) in self.robot.links().iter().enumerate() {
            let at = |k: usize| Instant {
                q: self.state[0][j][k],
                qd: self.state[1][j][k],
                qdd: self.state[2][j][k],
                sign: self.sign[j][k],
                body: self.body[j][k],
            };
            let along = (0..self.samples()).map(|k| effort(&link.actuator, &at(k)));
            self.nominal[j] = along.collect();
        }
    }

    /// Calls `visit` with the state at every sample.
    fn each(&self, mut visit: impl FnMut(&Dynamics, &mut Workspace, usize, [&[f64]; 3])) {
        let n = self.robot.joint_count();
        let mut ws = self.dynamics.workspace();
        let mut at = vec![vec![0.0; n]; 3];
        for k in 0..self.samples() {
            for (at, state) in at.iter_mut().zip(&self.state) {
                at.iter_mut().zip(state).for_each(|(at, x)| *at = x[k]);
            }
            visit(&self.dynamics, &mut ws, k, [&at[0], &at[1], &at[2]]);
        }
    }

    /// The columns of `shapes`, listed by joint, along the run: `[joint][shape][sample]`.
    pub fn columns(&self, shapes: &[Vec<Shape>]) -> Vec<Vec<Vec<f64>>> {
        let simple = |(j, shapes): (usize, &Vec<Shape>)| {
            shapes.iter().map(|shape| self.simple(j, *shape)).collect()
        };
        let mut columns: Vec<Vec<Vec<f64>>> = shapes.iter().enumerate().map(simple).collect();
        let has_shape = |is: fn(&Shape) -> bool| shapes.iter().flatten().any(is);
        if has_shape(|s| matches!(s, Shape::Body { .. })) {
            self.fill_bodies(shapes, &mut columns);
        }
        if has_shape(|s| matches!(s, Shape::Tilt(_))) {
            self.fill_tilts(shapes, &mut columns);
        }
        if has_shape(|s| matches!(s, Shape::Spring { .. })) {
            self.fill_springs(shapes, &mut columns);
        }
        columns
    }

    /// A column that is a function of the joint's own signals; empty for other columns.
    fn simple(&self, j: usize, shape: Shape) -> Vec<f64> {
        let [q, qd, qdd] = [0, 1, 2].map(|i| &self.state[i][j]);
        let (sign, nominal) = (&self.sign[j], &self.nominal[j]);
        let wave = |k: u8, wave: fn(f64) -> f64| {
            let rate = f64::from(k) * self.scales.phase_per_way[j];
            q.iter().map(move |q| wave(rate * q))
        };
        let signed_wave =
            |k: u8, f: fn(f64) -> f64| wave(k, f).zip(sign).map(|(w, s)| w * s).collect();
        match shape {
            Shape::Velocity => qd.clone(),
            Shape::Sign => sign.clone(),
            Shape::One => vec![1.0; q.len()],
            Shape::Acceleration => qdd.clone(),
            Shape::Nominal => nominal.clone(),
            Shape::NominalRate => differentiate(nominal, self.rate_hz),
            Shape::Position => q.clone(),
            Shape::LoadSign => nominal.iter().zip(sign).map(|(n, s)| n.abs() * s).collect(),
            Shape::SineSign(k) => signed_wave(k, f64::sin),
            Shape::CosineSign(k) => signed_wave(k, f64::cos),
            Shape::Sine(k) => wave(k, f64::sin).collect(),
            Shape::Cosine(k) => wave(k, f64::cos).collect(),
            Shape::Tilt(_) | Shape::Body { .. } | Shape::Spring { .. } => Vec::new(),
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
        self.each(|dynamics, ws, _, [q, qd, qdd]| {
            dynamics.torque_regressor_into(ws, q, qd, qdd, &mut y);
            for (j, at, index) in &places {
                columns[*j][*at].push(y[*index]);
            }
        });
    }

    fn fill_tilts(&self, shapes: &[Vec<Shape>], columns: &mut [Vec<Vec<f64>>]) {
        let across = across(self.dynamics.gravity_in_base());
        let mut g = vec![0.0; 3 * self.robot.joint_count()];
        self.each(|dynamics, ws, _, [q, ..]| {
            dynamics.gravity_regressor_into(ws, q, &mut g);
            for ((row, shapes), columns) in g.chunks_exact(3).zip(shapes).zip(&mut *columns) {
                for (shape, column) in shapes.iter().zip(columns) {
                    if let Shape::Tilt(i) = *shape {
                        let along = &across[usize::from(i.min(1))];
                        column.push(row[0] * along.x + row[1] * along.y + row[2] * along.z);
                    }
                }
            }
        });
    }

    /// The link is off by `d = load / k` against the motor, whose position is measured:
    ///
    /// ```text
    /// change of tau = -(d tau/dq d + d tau/d qd d' + M d'')
    /// ```
    fn fill_springs(&self, shapes: &[Vec<Shape>], columns: &mut [Vec<Vec<f64>>]) {
        let springs = (0..shapes.len()).filter(|spring| {
            let shape = Shape::Spring { joint: *spring };
            shapes.iter().flatten().any(|other| *other == shape)
        });
        for joint in springs {
            let load = &self.body[joint];
            let rate = differentiate(load, self.rate_hz);
            let second = differentiate(&rate, self.rate_hz);
            let change = self.by_joint(joint, [load, &rate, &second]);
            let shape = Shape::Spring { joint };
            for ((shapes, columns), change) in shapes.iter().zip(&mut *columns).zip(change) {
                if let Some(at) = shapes.iter().position(|other| *other == shape) {
                    columns[at] = change;
                }
            }
        }
    }

    /// Minus the change of all torques when the state of one joint changes.
    fn by_joint(&self, joint: usize, by: [&[f64]; 3]) -> Signals {
        let n = self.robot.joint_count();
        let mut change = vec![Vec::with_capacity(self.samples()); n];
        let [mut moved, mut tau] = [vec![0.0; n], vec![0.0; n]];
        self.each(|dynamics, ws, k, state| {
            let mut total = vec![0.0; n];
            for (part, size) in [STEP, STEP, 1.0].into_iter().enumerate() {
                moved.copy_from_slice(state[part]);
                moved[joint] += size;
                let mut at = state;
                at[part] = &moved;
                dynamics.inverse_dynamics_into(ws, at[0], at[1], at[2], &mut tau);
                for (i, total) in total.iter_mut().enumerate() {
                    *total -= (tau[i] - self.body[i][k]) / size * by[part][k];
                }
            }
            change.iter_mut().zip(&total).for_each(|(change, total)| change.push(*total));
        });
        change
    }
}

/// Two vectors as long as gravity, orthogonal to it and to each other.
fn across(gravity: Vector3<f64>) -> [Vector3<f64>; 2] {
    let axis = match gravity.x.abs() < 0.5 * gravity.norm() {
        true => Vector3::x(),
        false => Vector3::y(),
    };
    let first = gravity.cross(&axis);
    let first = first * (gravity.norm() / first.norm().max(f64::MIN_POSITIVE));
    let second = gravity.cross(&first) / gravity.norm().max(f64::MIN_POSITIVE);
    [first, second]
}
