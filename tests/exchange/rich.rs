//! A WAM with something of every kind that a format may hold.

use std::path::Path;

use checks::arms::{draw, generator, workspace_root};
use dynamics::Dynamics;
use effects::drive_torque;
use rand::RngExt;
use robot::{Loaded, Robot};

/// What the drives add to rigid bodies; its keys beside `urdf` are those of a robot.toml.
pub const DRIVES: &str = r#"
gravity_m_per_s2 = [0.3, -0.2, -9.79]
[joint.j1_base_yaw]
rotor_inertia_kg_m2 = 0.205
coulomb_forward_nm = 2.0
coulomb_backward_nm = 1.5
viscous_nm_s_per_rad = 0.7
encoder_offset_rad = 0.1
torque_limit_nm = 50.0
[joint.j2_shoulder_pitch]
rotor_inertia_kg_m2 = 0.189
encoder_offset_rad = -0.2
coulomb_nm = 1.0
spring_stiffness_nm_per_rad = 3.0
spring_rest_rad = 0.5
spring_cubic_nm_per_rad3 = 0.5
coupling = { with = "j3_shoulder_yaw", ratio = 1.3, coulomb_sum_nm = 0.6, coulomb_difference_nm = 0.4, viscous_sum_nm_s_per_rad = 0.2, viscous_difference_nm_s_per_rad = 0.1 }
[joint.j3_shoulder_yaw]
rotor_inertia_kg_m2 = 0.067
actuator_delay_ms = 6.0
actuator_lag_ms = 4.0
[joint.j4_elbow_pitch]
rotor_inertia_kg_m2 = 0.0346
coulomb_forward_nm = 0.8
coulomb_backward_nm = 0.6
spring_stiffness_nm_per_rad = 2.0
spring_rest_rad = 0.4
[joint.j5_wrist_yaw]
rotor_inertia_kg_m2 = 0.0032
coulomb_nm = 0.05
[link.palm]
mass_kg = 1.5
com_m = [0.01, 0.02, 0.05]
inertia_kg_m2 = { xx = 0.004, xy = 0.0001, xz = 0.0, yy = 0.003, yz = 0.0, zz = 0.002 }
"#;

/// The text of the WAM's URDF.
pub fn urdf() -> String {
    std::fs::read_to_string(workspace_root().join("robots/wam7/robot.urdf")).unwrap()
}

/// The WAM with `keys`, described in `folder`.
pub fn wam_with(folder: &Path, keys: &str) -> Loaded {
    std::fs::write(folder.join("robot.urdf"), urdf()).unwrap();
    let toml = format!("urdf = \"robot.urdf\"\n{keys}");
    std::fs::write(folder.join("robot.toml"), toml).unwrap();
    Robot::load(&folder.join("robot.toml")).unwrap()
}

/// A reported position, a velocity away from rest and an acceleration.
pub type State = [Vec<f64>; 3];

/// States of an arm with `n` joints.
pub fn states(n: usize, count: usize) -> Vec<State> {
    let mut rng = generator(17);
    let mut state = || {
        let speed = |rng: &mut rand_chacha::ChaCha8Rng| {
            let sign = if rng.random_bool(0.5) { 1.0 } else { -1.0 };
            sign * rng.random_range(0.3..1.5)
        };
        // Within all limits, which would push.
        let q = draw(&mut rng, n, 0.8);
        let qd = (0..n).map(|_| speed(&mut rng)).collect();
        [q, qd, draw(&mut rng, n, 3.0)]
    };
    (0..count).map(|_| state()).collect()
}

/// Torque that the model of this program needs in a reported state (N·m).
pub fn torque(robot: &Robot, [reported, qd, qdd]: &State) -> Vec<f64> {
    let offset = |i: usize| robot.links()[i].actuator.encoder_offset;
    let q: Vec<f64> = reported.iter().enumerate().map(|(i, q)| q - offset(i)).collect();
    let rigid = Dynamics::new(robot).inverse_dynamics(&q, qd, qdd).unwrap();
    let mut tau: Vec<f64> = vec![0.0; q.len()];
    for (i, link) in robot.links().iter().enumerate() {
        let state = [q[i], qd[i], qdd[i]];
        tau[i] += rigid[i] + drive_torque(&link.actuator, state, qd[i].signum(), rigid[i]);
        let Some(c) = link.actuator.coupling else { continue };
        let motor = |w: f64, k: usize| c.viscous[k] * w + c.level[k] * w.signum();
        let sum = motor(qd[i] + c.ratio * qd[c.other], 0);
        let difference = motor(qd[i] - c.ratio * qd[c.other], 1);
        tau[i] += sum + difference;
        tau[c.other] += c.ratio * (sum - difference);
    }
    tau
}
