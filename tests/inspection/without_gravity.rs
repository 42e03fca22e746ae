//! Efforts that lack gravity, of arms whose friction is as large as in use: Coulomb friction of up to a half of the effort.

use checks::synthetic::{Noise, Truth, run};
use dynamics::Dynamics;
use inspection::{ObservationKind, correct, inspect};
use logs::Run;
use robot::{Robot, TorqueSource};

/// Arm, Coulomb friction (N m) and viscous friction (N m s/rad) of its joints.
const ARMS: [(&str, &[f64], &[f64]); 2] = [
    ("ur5e", &[6.0, 8.0, 5.0, 1.2, 1.2, 1.0], &[8.0, 9.0, 5.0, 1.5, 1.4, 1.2]),
    ("panda", &[0.6, 0.6, 0.5, 0.5, 0.3, 0.3, 0.25], &[0.6, 0.6, 0.4, 0.4, 0.2, 0.2, 0.2]),
];

fn arm(name: &str) -> Robot {
    let path = format!("{}/../robots/{name}/robot.toml", env!("CARGO_MANIFEST_DIR"));
    let mut robot = Robot::load(path.as_ref()).unwrap().robot;
    for j in 0..robot.joint_count() {
        robot.link_mut(j).unwrap().actuator.torque_source = TorqueSource::Measured;
    }
    robot
}

/// Two runs of 15 s with so many times the friction; every joint of the true arm has a rotor that the description lacks.
fn runs(robot: &Robot, [coulomb, viscous]: [&[f64]; 2], friction: f64, seed: u64) -> Vec<Run> {
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

fn take_gravity_off(robot: &Robot, runs: &mut [Run]) {
    let dynamics = Dynamics::new(robot);
    let still = vec![0.0; robot.joint_count()];
    for run in runs {
        for t in 0..run.time.len() {
            let q: Vec<f64> = run.joints.iter().map(|joint| joint.position[t]).collect();
            let held = dynamics.inverse_dynamics(&q, &still, &still).unwrap();
            run.joints
                .iter_mut()
                .zip(held.iter())
                .for_each(|(joint, held)| joint.effort[t] -= held);
        }
    }
}

/// It is told and read so, and of whole efforts nothing is told: with no friction, a third, all and twice of it.
#[test]
fn efforts_without_gravity_are_told_and_read_so_whatever_the_friction() {
    for (name, coulomb, viscous) in ARMS {
        let robot = arm(name);
        for (friction, seed) in
            [0.0, 0.3, 1.0, 2.0].into_iter().flat_map(|f| (0..5).map(move |s| (f, s)))
        {
            let whole = runs(&robot, [coulomb, viscous], friction, 300 + seed);
            let of = format!("{name}, friction x {friction}, seed {seed}");
            assert_eq!(inspect(&robot, &whole), [], "{of}: whole efforts");
            let mut without = whole.clone();
            take_gravity_off(&robot, &mut without);
            let read = correct(&robot, &without);
            let told: Vec<ObservationKind> = read.mended.iter().map(|o| o.kind).collect();
            assert_eq!(told, [ObservationKind::EffortWithoutGravity], "{of}: {:?}", read.left);
            let read = read.runs.unwrap();
            let apart = |(a, b): (&Run, &Run)| -> f64 {
                let joints = a.joints.iter().zip(&b.joints);
                let efforts = joints.flat_map(|(a, b)| a.effort.iter().zip(&b.effort));
                efforts.map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
            };
            assert!(read.iter().zip(&whole).map(apart).fold(0.0, f64::max) < 1e-3, "{of}");
        }
    }
}
