//! Logs of arms whose friction is as large as in use: Coulomb friction of up to a half of the effort.

use checks::synthetic::{Noise, Truth, run};
use logs::Run;
use robot::{Robot, TorqueSource};

/// Arm, Coulomb friction (N m) and viscous friction (N m s/rad) of its joints.
pub const ARMS: [(&str, &[f64], &[f64]); 2] = [
    ("ur5e", &[6.0, 8.0, 5.0, 1.2, 1.2, 1.0], &[8.0, 9.0, 5.0, 1.5, 1.4, 1.2]),
    ("panda", &[0.6, 0.6, 0.5, 0.5, 0.3, 0.3, 0.25], &[0.6, 0.6, 0.4, 0.4, 0.2, 0.2, 0.2]),
];

/// The arm as it is described, with measured efforts.
pub fn arm(name: &str) -> Robot {
    let path = format!("{}/../robots/{name}/robot.toml", env!("CARGO_MANIFEST_DIR"));
    let mut robot = Robot::load(path.as_ref()).unwrap().robot;
    for j in 0..robot.joint_count() {
        robot.link_mut(j).unwrap().actuator.torque_source = TorqueSource::Measured;
    }
    robot
}

/// Two runs of 15 s with so many times the friction; every joint of the true arm has a rotor that the description lacks.
pub fn runs(robot: &Robot, [coulomb, viscous]: [&[f64]; 2], friction: f64, seed: u64) -> Vec<Run> {
    let mut arm = robot.clone();
    for (j, level) in coulomb.iter().enumerate() {
        arm.link_mut(j).unwrap().actuator.rotor_inertia += 0.05 * level;
    }
    let torque = |j: usize, [_, qd, _]: [f64; 3]| {
        friction * (coulomb[j] * (qd / 0.01).tanh() + viscous[j] * qd)
    };
    let truth = Truth { torque: &torque, ..Truth::of(&arm) };
    let effort = coulomb.iter().map(|level| 0.02 * level).collect();
    let noise = Noise { effort, ..Noise::of_a_wam() };
    (0..2).map(|k| run(&truth, &noise, 15.0, 10 * seed + k)).collect()
}
