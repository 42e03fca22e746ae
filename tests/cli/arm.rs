//! A planar arm of two links and logs of it, by closed form.

use std::fmt::Write as _;
use std::fs;
use std::path::Path;

use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;
use rand_distr::{Distribution, Normal};

/// Both joints turn about -y: at zero the arm points along x, a positive angle lifts it.
pub const URDF: &str = r#"<robot name="arm">
  <link name="base"/>
  <link name="upper"><inertial><origin xyz="0.2 0 0"/><mass value="3"/>
    <inertia ixx="0.01" iyy="0.05" izz="0.05" ixy="0" ixz="0" iyz="0"/></inertial></link>
  <link name="fore"><inertial><origin xyz="0.15 0 0"/><mass value="2"/>
    <inertia ixx="0.01" iyy="0.03" izz="0.03" ixy="0" ixz="0" iyz="0"/></inertial></link>
  <joint name="shoulder" type="revolute"><parent link="base"/><child link="upper"/>
    <axis xyz="0 -1 0"/><limit lower="-2.9" upper="2.9" effort="80" velocity="6"/></joint>
  <joint name="elbow" type="revolute"><parent link="upper"/><child link="fore"/>
    <origin xyz="0.4 0 0"/><axis xyz="0 -1 0"/>
    <limit lower="-2.9" upper="2.9" effort="40" velocity="6"/></joint>
</robot>
"#;

/// What the real arm has and the model has not.
#[derive(Debug, Clone, Copy)]
pub enum Gap {
    None,
    /// Coulomb friction at the elbow (N m).
    Friction(f64),
    /// Torque that ripples with the position of the elbow, in no catalogue (N m).
    Ripple(f64),
}

/// Standard deviation of the noise of the effort (N m).
const NOISE: f64 = 0.05;

/// Torque of the planar double pendulum, angles from the horizontal:
///
/// ```text
/// a = I1 + m1 c1² + I2 + m2 (l² + c2² + 2 l c2 cos q2),  b = I2 + m2 (c2² + l c2 cos q2)
/// h = m2 l c2 sin q2,  g2 = m2 g c2 cos(q1 + q2)
/// tau1 = a qdd1 + b qdd2 - h (2 qd1 qd2 + qd2²) + (m1 c1 + m2 l) g cos q1 + g2
/// tau2 = b qdd1 + (I2 + m2 c2²) qdd2 + h qd1² + g2
/// ```
fn torque(q: [f64; 2], qd: [f64; 2], qdd: [f64; 2]) -> [f64; 2] {
    let (l, c1, c2, m1, m2, i1, i2, g) = (0.4, 0.2, 0.15, 3.0, 2.0, 0.05, 0.03, 9.81);
    let cos2 = q[1].cos();
    let a = i1 + m1 * c1 * c1 + i2 + m2 * (l * l + c2 * c2 + 2.0 * l * c2 * cos2);
    let b = i2 + m2 * (c2 * c2 + l * c2 * cos2);
    let h = m2 * l * c2 * q[1].sin();
    let g2 = m2 * g * c2 * (q[0] + q[1]).cos();
    [
        a * qdd[0] + b * qdd[1] - h * (2.0 * qd[0] * qd[1] + qd[1] * qd[1])
            + (m1 * c1 + m2 * l) * g * q[0].cos()
            + g2,
        b * qdd[0] + (i2 + m2 * c2 * c2) * qdd[1] + h * qd[0] * qd[0] + g2,
    ]
}

/// Position, velocity and acceleration of a sum of sines, other ones in every run.
fn motion(joint: usize, run: u32, t: f64) -> [f64; 3] {
    let shift = 0.9 * f64::from(run) + joint as f64;
    let waves = [(0.55, 0.31), (0.35, 0.53), (0.2, 0.97)];
    let mut state = [0.0; 3];
    for (k, (amplitude, hertz)) in waves.into_iter().enumerate() {
        let w = std::f64::consts::TAU * hertz * (1.0 + 0.07 * f64::from(run) + 0.11 * joint as f64);
        let phase = w * t + shift * (k as f64 + 1.0);
        state[0] += amplitude * phase.sin();
        state[1] += amplitude * w * phase.cos();
        state[2] -= amplitude * w * w * phase.sin();
    }
    state
}

/// A log of 30 s at 200 Hz as CSV.
pub fn log(run: u32, gap: Gap) -> String {
    let mut noise = ChaCha8Rng::seed_from_u64(u64::from(run));
    let normal = Normal::new(0.0, NOISE).unwrap();
    let mut text = "time,shoulder.position,shoulder.velocity,shoulder.effort,\
                    elbow.position,elbow.velocity,elbow.effort\n"
        .to_owned();
    for k in 0..6000 {
        let t = f64::from(k) * 0.005;
        let [s, e] = [motion(0, run, t), motion(1, run, t)];
        let mut tau = torque([s[0], e[0]], [s[1], e[1]], [s[2], e[2]]);
        tau[1] += match gap {
            Gap::None => 0.0,
            Gap::Friction(level) => level * e[1].signum(),
            Gap::Ripple(size) => size * (9.0 * e[0]).sin(),
        };
        let [a, b] = tau.map(|v| v + normal.sample(&mut noise));
        let (q, qd) = ([s[0], e[0]], [s[1], e[1]]);
        writeln!(text, "{t:.3},{},{},{a},{},{},{b}", q[0], qd[0], q[1], qd[1]).unwrap();
    }
    text
}

/// A log of an arm that stands still.
pub fn still() -> String {
    let header = "time,shoulder.position,shoulder.effort,elbow.position,elbow.effort\n";
    let rows = (0..4000).map(|k| {
        let ripple = 1e-3 * f64::from(k % 7);
        format!("{},0.1,{},0.2,{}\n", f64::from(k) * 0.005, 10.0 + ripple, 3.0 - ripple)
    });
    header.to_owned() + &rows.collect::<String>()
}

/// A folder with `arm.urdf` and the logs `run_0.csv`, `run_1.csv` and `run_2.csv`.
pub fn folder(gap: Gap) -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("arm.urdf"), URDF).unwrap();
    (0..3).for_each(|run| write(folder.path(), &format!("run_{run}.csv"), &log(run, gap)));
    folder
}

pub fn write(folder: &Path, name: &str, content: &str) {
    fs::write(folder.join(name), content).unwrap();
}
