//! Arms in a vertical plane, by their closed forms, for the tests.

use nalgebra::{DMatrix, DVector};
use rand::{Rng, RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use robot::Robot;

use crate::samples::SampleSlices;

/// Length of the first link (m).
const L1: f64 = 0.7;
/// Gravity (m/s²).
const G: f64 = 9.81;

const LINK: &str = r#"<inertial><origin xyz="0.4 0 0.05"/><mass value="3"/>
    <inertia ixx="0.02" ixy="0" ixz="0" iyy="0.03" iyz="0" izz="0.025"/></inertial>"#;

/// An arm of two links whose hinges turn about `-y`: positive is up.
pub fn arm() -> Robot {
    let urdf = format!(
        r#"<robot name="arm"><link name="base"/><link name="upper">{LINK}</link>
        <link name="lower">{LINK}</link>
        <joint name="shoulder" type="continuous"><parent link="base"/><child link="upper"/>
          <axis xyz="0 -1 0"/></joint>
        <joint name="elbow" type="continuous"><origin xyz="{L1} 0 0"/><parent link="upper"/>
          <child link="lower"/><axis xyz="0 -1 0"/></joint></robot>"#
    );
    Robot::from_urdf(&urdf).unwrap()
}

/// Its first link alone.
pub fn pendulum() -> Robot {
    let urdf = format!(
        r#"<robot name="pendulum"><link name="base"/><link name="upper">{LINK}</link>
        <joint name="shoulder" type="continuous"><parent link="base"/><child link="upper"/>
          <axis xyz="0 -1 0"/></joint></robot>"#
    );
    Robot::from_urdf(&urdf).unwrap()
}

/// Signals that a stretch borrows.
#[derive(Clone)]
pub struct PlanarRecord {
    pub q: Vec<f64>,
    pub qd: Vec<f64>,
    pub qdd: Vec<f64>,
    pub tau: Vec<f64>,
}

impl PlanarRecord {
    /// `samples` at 500 Hz of joints that swing at two frequencies each, without torque.
    pub fn motion(joints: usize, samples: usize) -> Self {
        let mut record = Self { q: vec![], qd: vec![], qdd: vec![], tau: vec![] };
        for k in 0..samples {
            let t = k as f64 / 500.0;
            for joint in 0..joints {
                let (a, b) = (4.1 + 1.3 * joint as f64, 6.7 - 0.6 * joint as f64);
                record.q.push((a * t).sin() + 0.7 * (b * t).cos());
                record.qd.push(a * (a * t).cos() - 0.7 * b * (b * t).sin());
                record.qdd.push(-a * a * (a * t).sin() - 0.7 * b * b * (b * t).cos());
            }
        }
        record.tau = vec![0.0; record.q.len()];
        record
    }

    /// With the torque `columns theta` and noise.
    pub fn with(mut self, columns: &[DMatrix<f64>], theta: &[f64], noise: &[f64]) -> Self {
        let theta = DVector::from_column_slice(theta);
        for (joint, y) in columns.iter().enumerate() {
            let tau = y * &theta;
            for (k, tau) in tau.iter().enumerate() {
                let at = k * columns.len() + joint;
                self.tau[at] = tau + noise.get(at).copied().unwrap_or(0.0);
            }
        }
        self
    }

    /// Torque of one joint.
    pub fn tau_of(&self, joint: usize, joints: usize) -> DVector<f64> {
        DVector::from_iterator(
            self.tau.len() / joints,
            self.tau.iter().skip(joint).step_by(joints).copied(),
        )
    }

    pub fn stretch(&self) -> SampleSlices<'_> {
        SampleSlices { q: &self.q, qd: &self.qd, qdd: &self.qdd, tau: &self.tau }
    }

    /// The columns of the pendulum: `tau = I qdd + g (mx cos q - mz sin q)` for
    /// `theta = [I, mx, mz]`.
    pub fn pendulum_columns(&self) -> DMatrix<f64> {
        DMatrix::from_fn(self.q.len(), 3, |k, c| {
            [self.qdd[k], G * self.q[k].cos(), -G * self.q[k].sin()][c]
        })
    }

    /// The columns of both joints of the arm for `theta = [A, H, Z, I2, x, z]`: with
    /// `C = x cos q2 - z sin q2`, `S = x sin q2 + z cos q2` and `q12 = q1 + q2`,
    ///
    /// ```text
    /// w    = I2 (qdd1 + qdd2) + g (x cos q12 - z sin q12)
    /// tau2 = w + l1 (C qdd1 + S qd1²)
    /// tau1 = w + l1 (2 C qdd1 + C qdd2 - S (2 qd1 qd2 + qd2²))
    ///          + A qdd1 + g (H cos q1 - Z sin q1)
    /// ```
    pub fn arm_columns(&self) -> [DMatrix<f64>; 2] {
        let row = |k: usize| {
            let [q, qd, qdd] = [&self.q, &self.qd, &self.qdd].map(|s| [s[2 * k], s[2 * k + 1]]);
            let ((s1, c1), (s2, c2)) = (q[0].sin_cos(), q[1].sin_cos());
            let (s12, c12) = (q[0] + q[1]).sin_cos();
            let both = qdd[0] + qdd[1];
            let spin = 2.0 * qd[0] * qd[1] + qd[1] * qd[1];
            let swing = 2.0 * qdd[0] + qdd[1];
            let centre = qd[0] * qd[0];
            let first = [
                qdd[0],
                G * c1,
                -G * s1,
                both,
                G * c12 + L1 * (c2 * swing - s2 * spin),
                -G * s12 + L1 * (-s2 * swing - c2 * spin),
            ];
            let second = [
                0.0,
                0.0,
                0.0,
                both,
                G * c12 + L1 * (c2 * qdd[0] + s2 * centre),
                -G * s12 + L1 * (-s2 * qdd[0] + c2 * centre),
            ];
            [first, second]
        };
        let rows: Vec<[[f64; 6]; 2]> = (0..self.q.len() / 2).map(row).collect();
        [0, 1].map(|joint| DMatrix::from_fn(rows.len(), 6, |k, c| rows[k][joint][c]))
    }
}

/// `[A, H, Z, I2, x, z]` of [`PlanarRecord::arm_columns`] for the ten parameters of each link.
pub fn arm_theta(pi: &[f64]) -> [f64; 6] {
    [pi[6] + pi[10] * L1 * L1, pi[1] + pi[10] * L1, pi[3], pi[16], pi[11], pi[13]]
}

/// `[I, mx, mz]` of [`PlanarRecord::pendulum_columns`] for the ten parameters of the link.
pub fn pendulum_theta(pi: &[f64]) -> [f64; 3] {
    [pi[6], pi[1], pi[3]]
}

/// A generator of its own for every test.
pub fn generator(seed: u64) -> ChaCha8Rng {
    ChaCha8Rng::seed_from_u64(seed)
}

/// A standard normal number (Box & Muller).
pub fn normal(rng: &mut impl Rng) -> f64 {
    let (u, v): (f64, f64) = (rng.random(), rng.random());
    (-2.0 * (1.0 - u).ln()).sqrt() * (std::f64::consts::TAU * v).cos()
}
