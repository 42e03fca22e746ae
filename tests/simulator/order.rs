//! The step of second order against closed forms, Pinocchio's numbers, `dynamics` and rapier, whose step is of first
//! order: two engines written apart from the same equations.

use checks::arms::{
    draw, generator, kinetic_energy, potential_energy, random_tree, wam, workspace_root,
};
use dynamics::Dynamics;
use nalgebra::Vector3;
use robot::{Inertia, Machine, Reading, Robot};
use simulator::scenario::Scenario;
use simulator::{Sensors, Simulator, StepOrder, Stepping, simulate_noise_free};

use crate::rig::{GRAVITY, STEPPING, flywheel, pendulum, run};
use crate::scenario::{EFFECTS, document};
use crate::strangers::STRANGERS;

const SECOND: Stepping = Stepping { order: StepOrder::Second, ..STEPPING };

fn perfect(robot: &Robot, stepping: Stepping) -> Simulator {
    Simulator::new(robot, Vec::new(), Sensors::perfect(robot.joint_count()), stepping).unwrap()
}

/// Steps of this length (s), commands every 2 ms.
fn second_order(step_s: f64) -> Stepping {
    Stepping { step_s, steps_per_period: (2e-3 / step_s).round() as usize, ..SECOND }
}

fn largest(values: impl Iterator<Item = f64>) -> f64 {
    values.fold(0.0, f64::max)
}

/// Acceleration over one step of 1e-8 s: the error of the step is below the rounding of its quotient.
fn acceleration(robot: &Robot, q: &[f64], qd: &[f64], tau: &[f64]) -> Vec<f64> {
    let step_s = 1e-8;
    let mut arm = perfect(robot, Stepping { step_s, steps_per_period: 1, ..SECOND });
    arm.start_moving(q, qd);
    arm.actuate(tau).unwrap();
    arm.qd_true().iter().zip(qd).map(|(after, before)| (after - before) / step_s).collect()
}

fn relative_error(found: &[f64], expected: &[f64]) -> f64 {
    let scale = largest(expected.iter().map(|e| e.abs()));
    largest(found.iter().zip(expected).map(|(f, e)| (f - e).abs())) / scale
}

#[test]
fn oracle_acceleration_of_second_order_is_pinocchios() {
    let golden = checks::golden::golden("wam7");
    let urdf = workspace_root().join("robots/wam7/robot.urdf");
    let mut robot = Robot::load(&urdf).unwrap().robot.with_gravity(golden.gravity.into());
    for (i, pi) in golden.inertial_parameters.iter().enumerate() {
        let link = robot.link_mut(i).unwrap();
        link.inertia = Inertia::from_parameters(pi);
        link.actuator = robot::Actuator::default();
        link.actuator.rotor_inertia = golden.rotor_inertia[i];
    }
    let moving = golden.states.iter().filter(|s| s.qdd.iter().any(|a| a.abs() > 0.0));
    let error =
        largest(moving.map(|s| {
            relative_error(&acceleration(&robot, &s.q, &s.qd, &s.tau_with_rotor), &s.qdd)
        }));
    println!("largest relative error {error:.1e}");
    assert!(error < 1e-6, "{error:.2e}");
}

/// Trees with branches, slides and two roots.
#[test]
fn contract_the_torque_of_an_acceleration_of_second_order_is_the_torque_applied() {
    for seed in 0..10 {
        let robot = random_tree(seed);
        let mut rng = generator(100 + seed);
        let n = robot.joint_count();
        let (q, qd) = (draw(&mut rng, n, 2.0), draw(&mut rng, n, 1.5));
        let tau = draw(&mut rng, n, 20.0);
        let a = acceleration(&robot, &q, &qd, &tau);
        let dynamics = Dynamics::new(&robot);
        let mut found = dynamics.inverse_dynamics(&q, &qd, &a).unwrap();
        dynamics.add_rotor_torque(&a, found.as_mut_slice()).unwrap();
        let error = relative_error(found.as_slice(), &tau);
        assert!(error < 1e-5, "seed {seed}: {error:.2e}");
    }
}

fn energy(robot: &Robot, q: &[f64], qd: &[f64]) -> f64 {
    let rotors = robot.links().iter().zip(qd);
    let rotors: f64 = rotors.map(|(l, v)| 0.5 * l.actuator.rotor_inertia * v * v).sum();
    potential_energy(robot, q) + kinetic_energy(robot, q, qd) + rotors
}

/// Of the swing's 60 J the step of first order loses 0.06 J at 0.1 ms.
#[test]
fn oracle_a_passive_swing_keeps_its_energy_to_second_order_in_the_step() {
    let robot = wam();
    let lost = |step_s: f64| {
        let mut arm = perfect(&robot, second_order(step_s));
        arm.start(&[0.3, 1.2, -0.4, 1.0, 0.2, 0.5, 0.1]);
        let rows = run(&mut arm, 1.0, |_| vec![0.0; 7]).unwrap();
        let of = |row: &crate::rig::Row| energy(&robot, &row.q_true, &row.qd_true);
        of(&rows[0]) - of(rows.last().unwrap())
    };
    let (coarse, fine) = (lost(1e-3), lost(5e-4));
    println!("energy lost in 1 s: {coarse:.2e} J at 1 ms, {fine:.2e} J at 0.5 ms");
    assert!(coarse.abs() < 6e-3, "{coarse}");
    assert!((3.0..5.0).contains(&(coarse / fine)), "{coarse} and {fine}");
}

/// Positions (rad) after a second of a lively motion under a controller without a model.
fn second_of_the_wam(robot: &Robot, stepping: Stepping) -> Vec<f64> {
    const KP: [f64; 7] = [200.0, 300.0, 100.0, 100.0, 10.0, 10.0, 2.5];
    let mut arm = perfect(robot, stepping);
    arm.start(&[-0.5, -0.2, 0.4, 0.8, 0.3, -0.4, 0.5]);
    let torque = |r: &Reading| -> Vec<f64> {
        let wanted = 0.5 * (1.0 - (3.0 * r.time_s).cos());
        (0..7).map(|i| KP[i] * (wanted - r.q[i] - 0.04 * r.qd[i])).collect()
    };
    run(&mut arm, 1.0, torque).unwrap();
    arm.q_true().to_vec()
}

fn apart(a: &[f64], b: &[f64]) -> f64 {
    largest(a.iter().zip(b).map(|(a, b)| (a - b).abs()))
}

/// Against a step of a hundredth: four times less for half the step, and with viscous friction as well.
#[test]
fn the_error_falls_with_the_square_of_the_step() {
    let plain = wam();
    let mut damped = wam();
    for i in 0..7 {
        damped.link_mut(i).unwrap().actuator.viscous = [2.0, 1.0, 1.0, 0.5, 0.1, 0.1, 0.05][i];
    }
    for robot in [plain, damped] {
        let truth = second_of_the_wam(&robot, second_order(1e-5));
        let error = |step_s: f64| apart(&second_of_the_wam(&robot, second_order(step_s)), &truth);
        let (coarse, fine) = (error(1e-3), error(5e-4));
        let first = apart(&second_of_the_wam(&robot, STEPPING), &truth);
        println!(
            "{coarse:.1e} rad at 1 ms, {fine:.1e} at 0.5 ms; first order {first:.1e} at 0.1 ms"
        );
        assert!((3.3..4.7).contains(&(coarse / fine)), "{coarse:.2e} and {fine:.2e}");
        assert!(coarse < first, "{coarse:.2e} at 1 ms, first order {first:.2e} at 0.1 ms");
    }
}

/// A flywheel of 0.01 kg m² under a friction of 0.1 N m, thrown at 1.03 rad/s, rests after 0.103 s and 0.053045 rad; the
/// instant lies at the end of a step, whose second half is lost: `a dt²/8`.
#[test]
fn a_joint_under_dry_friction_comes_to_rest_where_it_should_and_stays() {
    let mut robot = flywheel(0.01, 0.0);
    let actuator = &mut robot.link_mut(0).unwrap().actuator;
    (actuator.coulomb_forward, actuator.coulomb_backward) = (0.1, 0.1);
    let mut arm = perfect(&robot, second_order(2e-3));
    arm.start_moving(&[0.0], &[1.03]);
    let rows = run(&mut arm, 0.5, |_| vec![0.0]).unwrap();
    let (last, early) = (rows.last().unwrap(), &rows[60]);
    let at = 1.03 * 1.03 / (2.0 * 10.0);
    println!("rests at {} rad, {at} expected", last.q_true[0]);
    assert!((last.q_true[0] - at).abs() < 1.001 * 10.0 * 2e-3_f64.powi(2) / 8.0);
    assert!(apart(&last.q_true, &early.q_true) <= 0.0 && last.qd_true[0].abs() <= 0.0);
}

/// A torque of 0.25 N m turns the same flywheel back: the friction changes its sign at the turn, which is inside a step.
///
/// ```text
/// v(t) = 1.03 - 35 t until t1 = 1.03/35, then -15 (t - t1)
/// ```
#[test]
fn a_joint_that_turns_round_inside_a_step_feels_its_friction_turn() {
    let mut robot = flywheel(0.01, 0.0);
    let actuator = &mut robot.link_mut(0).unwrap().actuator;
    (actuator.coulomb_forward, actuator.coulomb_backward) = (0.1, 0.1);
    let mut arm = perfect(&robot, second_order(2e-3));
    arm.start_moving(&[0.0], &[1.03]);
    let rows = run(&mut arm, 0.1, |_| vec![-0.25]).unwrap();
    let last = rows.last().unwrap();
    let expected = -15.0 * (last.time_s - 1.03 / 35.0);
    assert!((last.qd_true[0] - expected).abs() < 1e-9, "{} {expected}", last.qd_true[0]);
}

/// An arm that its friction holds against gravity does not creep, whatever couples its joints.
#[test]
fn an_arm_that_friction_holds_stays_bit_for_bit() {
    let mut robot = wam();
    let start = [0.3, 0.6, -0.4, 1.0, 0.2, 0.5, 0.1];
    let mut rest = vec![0.0; 7];
    let gravity = Dynamics::new(&robot).inverse_dynamics(&start, &rest, &rest).unwrap();
    for i in 0..7 {
        let actuator = &mut robot.link_mut(i).unwrap().actuator;
        let level = 1.001 * gravity[i].abs() + 1e-3;
        (actuator.coulomb_forward, actuator.coulomb_backward) = (level, level);
    }
    let mut arm = perfect(&robot, second_order(1e-3));
    arm.start(&start);
    run(&mut arm, 1.0, |_| vec![0.0; 7]).unwrap();
    rest.copy_from_slice(arm.q_true());
    assert_eq!(rest, start);
    // One joint a little too weak: it falls, and no other does.
    let loose = 1;
    let actuator = &mut robot.link_mut(loose).unwrap().actuator;
    actuator.coulomb_forward = 0.9 * gravity[loose].abs();
    actuator.coulomb_backward = actuator.coulomb_forward;
    let mut arm = perfect(&robot, second_order(1e-3));
    arm.start(&start);
    run(&mut arm, 0.02, |_| vec![0.0; 7]).unwrap();
    assert!((arm.q_true()[loose] - start[loose]).abs() > 1e-5, "{:?}", arm.q_true());
}

/// Without gravity and torque, `kinetic energy = sum level path`, at a step ten times as long as rapier's.
#[test]
fn oracle_friction_does_the_work_of_the_energy_in_steps_of_second_order() {
    let mut robot = wam().with_gravity(Vector3::zeros());
    let level = [1.6, 0.53, 0.37, 0.64, 0.036, 0.071, 0.0125];
    for (i, level) in level.into_iter().enumerate() {
        let actuator = &mut robot.link_mut(i).unwrap().actuator;
        (actuator.coulomb_forward, actuator.coulomb_backward) = (level, level);
    }
    let mut arm = perfect(&robot, Stepping { step_s: 1e-3, steps_per_period: 1, ..SECOND });
    let (q, qd) = ([0.0, 0.4, 0.2, 1.2, 0.0, 0.3, 0.0], [1.5, -1.0, 1.0, 1.5, -2.0, 2.0, 1.0]);
    arm.start_moving(&q, &qd);
    let rows = run(&mut arm, 4.0, |_| vec![0.0; 7]).unwrap();
    let path = |w: &[crate::rig::Row], i: usize| (w[1].q_true[i] - w[0].q_true[i]).abs();
    let work: f64 = rows.windows(2).flat_map(|w| (0..7).map(move |i| level[i] * path(w, i))).sum();
    let initial = energy(&robot, &q, &qd);
    println!("energy {initial:.6} J, work of friction {work:.6} J");
    assert!((work / initial - 1.0).abs() < 1e-4, "{work} J of {initial} J");
    assert!(apart(&rows.last().unwrap().q_true, &rows[rows.len() - 500].q_true) <= 0.0);
}

/// Driven into its limit, with friction and a neighbour that it shakes, a joint never passes it.
#[test]
fn a_joint_in_steps_of_second_order_stops_at_its_limit_and_never_passes_it() {
    let mut robot = wam();
    for i in 0..7 {
        let actuator = &mut robot.link_mut(i).unwrap().actuator;
        (actuator.coulomb_forward, actuator.coulomb_backward) = (0.3, 0.3);
    }
    let limit = robot.links()[0].joint.limits.position.unwrap().1;
    let mut arm = perfect(&robot, Stepping { stops: true, ..second_order(1e-3) });
    arm.start(&[limit - 0.2, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0]);
    let rows = run(&mut arm, 1.5, |r| {
        let mut tau: Vec<f64> = (0..7).map(|i| -20.0 * r.q[i] - 4.0 * r.qd[i]).collect();
        tau[0] = 10.0;
        tau
    })
    .unwrap();
    let most = rows.iter().map(|r| r.q_true[0]).fold(f64::MIN, f64::max);
    println!("limit {limit}, largest {most}");
    assert!(most < limit + 1e-12, "{most}");
    assert!((rows.last().unwrap().q_true[0] - limit).abs() < 1e-12);
}

/// A pendulum that hangs at a stop pulls itself off it when it is driven the other way.
#[test]
fn a_joint_leaves_its_stop_when_it_is_driven_off() {
    let mut robot = pendulum(1.0, 0.5);
    robot.link_mut(0).unwrap().joint.limits.position = Some((-1.0, 0.2));
    let mut arm = perfect(&robot, Stepping { stops: true, ..second_order(1e-3) });
    arm.start(&[0.0]);
    let rows =
        run(&mut arm, 1.0, |r| vec![if r.time_s < 0.5 { 0.0 } else { -2.0 * GRAVITY }]).unwrap();
    let falls = rows.iter().find(|r| r.time_s > 0.45).unwrap();
    assert!((falls.q_true[0] - 0.2).abs() < 1e-12, "{}", falls.q_true[0]);
    assert!((rows.last().unwrap().q_true[0] + 1.0).abs() < 1e-12);
}

#[test]
fn a_repeated_run_of_second_order_is_bitwise_the_same() {
    let robot = wam();
    let once = || second_of_the_wam(&robot, second_order(1e-3));
    assert_eq!(once(), once());
}

/// Largest difference of the positions of a scenario in both orders (rad).
fn between_orders(more: &str, step_ms: f64) -> f64 {
    let log = |order: &str| {
        let mut document = document(more);
        document.set(&format!("engine={{order='{order}', step_ms={step_ms}}}")).unwrap();
        let scenario = Scenario::from_document(&document).unwrap();
        let (effects, strangers) = (scenario.effects(), scenario.strangers());
        simulate_noise_free(&scenario, &|_| true, effects, strangers).unwrap().remove(0)
    };
    let (first, second) = (log("first"), log("second"));
    let joints = first.joints.iter().zip(&second.joints);
    largest(joints.map(|(a, b)| apart(&a.position, &b.position)))
}

/// Every effect and every stranger, in the same scenario with both engines: they differ by the error of the first, which is
/// a quarter in a quarter of the step.
#[test]
fn every_effect_moves_the_arm_alike_in_both_orders() {
    let effects = EFFECTS.map(|effect| format!("[[effect]]\n{effect}"));
    let strangers = STRANGERS.map(|stranger| format!("[[stranger]]\n{stranger}"));
    for more in effects.iter().chain(&strangers) {
        let (coarse, fine) = (between_orders(more, 0.2), between_orders(more, 0.05));
        println!("{coarse:.1e} rad at 0.2 ms, {fine:.1e} rad at 0.05 ms: {more}");
        assert!(coarse < 3e-4 && fine < 0.5 * coarse, "{coarse:.2e} and {fine:.2e}: {more}");
    }
}
