//! Rapier's equations of motion against Pinocchio's numbers and against `dynamics`, the other
//! engine of this workspace.

use checks::arms::{
    data, draw, generator, kinetic_energy, potential_energy, random_tree, wam, workspace_root,
};
use checks::golden::State;
use dynamics::Dynamics;
use nalgebra::Vector3;
use robot::{Inertia, Machine, Robot};
use simulator::{Sensors, Simulator, StepOrder, Stepping};

use crate::rig::run;

/// Gains that suit the WAM's joints (N m/rad).
const STIFF: [f64; 7] = [200.0, 300.0, 100.0, 100.0, 10.0, 10.0, 2.5];

fn perfect(robot: &Robot, stepping: Stepping) -> Simulator {
    Simulator::new(robot, Vec::new(), Sensors::perfect(robot.joint_count()), stepping).unwrap()
}

fn single(step_s: f64) -> Stepping {
    Stepping { step_s, steps_per_period: 1, stops: false, order: StepOrder::First }
}

/// Acceleration over one step: `(qd(dt) - qd(0)) / dt`.
fn acceleration(robot: &Robot, step_s: f64, q: &[f64], qd: &[f64], tau: &[f64]) -> Vec<f64> {
    let mut arm = perfect(robot, single(step_s));
    arm.start_moving(q, qd);
    arm.actuate(tau).unwrap();
    arm.qd_true().iter().zip(qd).map(|(after, before)| (after - before) / step_s).collect()
}

fn relative_error(found: &[f64], expected: &[f64]) -> f64 {
    let largest = expected.iter().fold(0.0_f64, |s, e| s.max(e.abs()));
    found.iter().zip(expected).map(|(f, e)| (f - e).abs()).fold(0.0, f64::max) / largest
}

fn golden(name: &str, urdf: &std::path::Path) -> (Robot, Vec<State>) {
    let golden = checks::golden::golden(name);
    let mut robot = Robot::load(urdf).unwrap().robot.with_gravity(golden.gravity.into());
    for (i, pi) in golden.inertial_parameters.iter().enumerate() {
        let link = robot.link_mut(i).unwrap();
        link.inertia = Inertia::from_parameters(pi);
        link.actuator = robot::Actuator {
            rotor_inertia: golden.rotor_inertia[i],
            ..robot::Actuator::default()
        };
    }
    (robot, golden.states)
}

/// A moving state's error falls as `dt`, a resting state has none but rounding.
fn check_first_order(robot: &Robot, states: &[State]) {
    let mut worst = [0.0_f64; 3];
    for state in states.iter().filter(|s| s.qdd.iter().any(|a| a.abs() > 0.0)) {
        for (step_s, worst) in [1e-4, 1e-6, 1e-8].into_iter().zip(&mut worst) {
            let a = acceleration(robot, step_s, &state.q, &state.qd, &state.tau_with_rotor);
            *worst = worst.max(relative_error(&a, &state.qdd));
        }
    }
    println!("largest relative error at 1e-4, 1e-6, 1e-8 s: {worst:?}");
    assert!(worst[2] < 1e-6, "{worst:?}");
    assert!((50.0..200.0).contains(&(worst[0] / worst[1])), "not first order: {worst:?}");
}

#[test]
fn oracle_acceleration_converges_to_pinocchios_for_the_wam() {
    let (robot, states) = golden("wam7", &workspace_root().join("robots/wam7/robot.urdf"));
    check_first_order(&robot, &states);
}

#[test]
fn oracle_acceleration_converges_to_pinocchios_for_the_lwr4() {
    let Some(urdf) = data("kuka_lwr4/robot.urdf") else { return };
    let (robot, states) = golden("kuka_lwr4", &urdf);
    check_first_order(&robot, &states);
}

/// Trees with branches, slides and two roots: rapier's acceleration, put through inverse
/// dynamics, is the torque that was applied, the better the shorter the step.
#[test]
fn contract_the_torque_of_rapiers_acceleration_is_the_torque_applied() {
    for seed in 0..10 {
        let robot = random_tree(seed);
        let dynamics = Dynamics::new(&robot);
        let mut rng = generator(100 + seed);
        let n = robot.joint_count();
        let (q, qd) = (draw(&mut rng, n, 2.0), draw(&mut rng, n, 1.5));
        let tau = draw(&mut rng, n, 20.0);
        let mut errors = Vec::new();
        for step_s in [1e-4, 1e-6, 1e-8] {
            let a = acceleration(&robot, step_s, &q, &qd, &tau);
            let mut found = dynamics.inverse_dynamics(&q, &qd, &a).unwrap();
            dynamics.add_rotor_torque(&a, found.as_mut_slice()).unwrap();
            errors.push(relative_error(found.as_slice(), &tau));
        }
        assert!(errors[2] < 1e-5 && errors[1] < 0.05 * errors[0], "seed {seed}: {errors:?}");
    }
}

fn energy(robot: &Robot, q: &[f64], qd: &[f64]) -> f64 {
    let rotors = robot.links().iter().zip(qd);
    let rotors: f64 = rotors.map(|(l, v)| 0.5 * l.actuator.rotor_inertia * v * v).sum();
    potential_energy(robot, q) + kinetic_energy(robot, q, qd) + rotors
}

/// The engine loses a little energy, in proportion to its step: less than 0.1 % of the swing's
/// 60 J in the first second at 0.1 ms.
#[test]
fn oracle_a_passive_swing_keeps_its_energy_to_first_order_in_the_step() {
    let robot = wam();
    let start = [0.3, 1.2, -0.4, 1.0, 0.2, 0.5, 0.1];
    let lost = |step_s: f64| {
        let stepping = Stepping {
            step_s,
            steps_per_period: (2e-3 / step_s).round() as usize,
            stops: false,
            order: StepOrder::First,
        };
        let mut arm = perfect(&robot, stepping);
        arm.start(&start);
        let rows = run(&mut arm, 1.0, |_| vec![0.0; 7]).unwrap();
        let of = |row: &crate::rig::Row| energy(&robot, &row.q_true, &row.qd_true);
        of(&rows[0]) - of(rows.last().unwrap())
    };
    let (coarse, fine) = (lost(1e-3), lost(1e-4));
    println!("energy lost in 1 s: {coarse:.4} J at 1 ms, {fine:.4} J at 0.1 ms");
    assert!(fine.abs() < 0.06, "{fine}");
    assert!((5.0..20.0).contains(&(coarse / fine)), "{coarse} and {fine}");
}

/// Without gravity and torque, `kinetic energy = sum level path`: friction's work is all that
/// stops the arm, and the arm then rests for good.
#[test]
fn oracle_friction_alone_stops_the_arm_and_does_the_work_of_its_energy() {
    let mut robot = wam().with_gravity(Vector3::zeros());
    let level = [1.6, 0.53, 0.37, 0.64, 0.036, 0.071, 0.0125];
    for (i, level) in level.into_iter().enumerate() {
        let actuator = &mut robot.link_mut(i).unwrap().actuator;
        actuator.coulomb_forward = level;
        actuator.coulomb_backward = level;
    }
    let stepping =
        Stepping { step_s: 1e-4, steps_per_period: 1, stops: false, order: StepOrder::First };
    let mut arm = perfect(&robot, stepping);
    let (q, qd) = ([0.0, 0.4, 0.2, 1.2, 0.0, 0.3, 0.0], [1.5, -1.0, 1.0, 1.5, -2.0, 2.0, 1.0]);
    arm.start_moving(&q, &qd);
    let rows = run(&mut arm, 4.0, |_| vec![0.0; 7]).unwrap();
    let work: f64 = rows
        .windows(2)
        .flat_map(|w| (0..7).map(|i| level[i] * (w[1].q_true[i] - w[0].q_true[i]).abs()))
        .sum();
    let initial = energy(&robot, &q, &qd);
    println!("energy {initial:.4} J, work of friction {work:.4} J");
    assert!((work / initial - 1.0).abs() < 1e-3, "{work} J of {initial} J");
    let (last, earlier) = (rows.last().unwrap(), &rows[rows.len() - 5000]);
    for i in 0..7 {
        assert!((last.q_true[i] - earlier.q_true[i]).abs() < 1e-8, "joint {i} creeps");
    }
}

#[test]
fn a_repeated_run_is_bitwise_the_same() {
    let robot = wam();
    let once = || {
        let mut arm = perfect(&robot, crate::rig::STEPPING);
        arm.start(&[0.1; 7]);
        run(&mut arm, 0.5, |r| (0..7).map(|i| -STIFF[i] * r.q[i]).collect()).unwrap()
    };
    assert_eq!(once(), once());
}

/// A joint that is driven into its limit stays there and does not bounce.
#[test]
fn a_joint_stops_at_its_limit() {
    let robot = wam();
    let limit = robot.links()[0].joint.limits.position.unwrap().1;
    let stepping = Stepping { stops: true, ..crate::rig::STEPPING };
    let mut arm = perfect(&robot, stepping);
    arm.start(&[limit - 0.2, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0]);
    let rows = run(&mut arm, 1.5, |r| {
        let mut tau: Vec<f64> =
            (0..7).map(|i| -STIFF[i] * r.q[i] - 0.1 * STIFF[i].sqrt() * r.qd[i]).collect();
        tau[0] = 10.0;
        tau
    })
    .unwrap();
    let largest = rows.iter().map(|r| r.q_true[0]).fold(f64::MIN, f64::max);
    println!("limit {limit}, largest {largest}");
    assert!(largest < limit + 1e-3, "{largest}");
    assert!((rows.last().unwrap().q_true[0] - limit).abs() < 1e-4);
}
