use std::f64::consts::TAU;

use checks::arms::{base_from_links, wam};
use dynamics::Dynamics;
use nalgebra::{Matrix3, Unit, Vector3};
use robot::{Actuator, Inertia, JointKind, Machine, Robot};
use simulator::{StepOrder, Stepping};

use crate::rig::{STEPPING, flywheel, link, run, simulator};

/// `I qdd = A sin(w t + p)` from rest:
/// `q = A / (I w) (t cos(p) - (sin(w t + p) - sin(p)) / w)`.
#[test]
fn oracle_a_periodic_torque_moves_a_wheel_with_its_amplitude_frequency_and_phase() {
    let (amplitude, frequency, phase) = (2.0, 7.0, 0.6_f64);
    let effects = format!(
        "[[effect]]\nexternal_disturbance.periodic = {{ joint = 'joint', amplitude_nm = {amplitude}, frequency_hz = {frequency}, phase_rad = {phase} }}"
    );
    let mut wheel = simulator(&flywheel(0.4, 0.1), &effects, STEPPING).unwrap();
    wheel.start(&[0.0]);
    let rows = run(&mut wheel, 1.0, |_| vec![0.0]).unwrap();
    let w = TAU * frequency;
    for row in &rows {
        let t = row.time_s;
        let wave = ((w * t + phase).sin() - phase.sin()) / w;
        let expected = amplitude / (0.5 * w) * (t * phase.cos() - wave);
        // A sum for an integral: (w dt)^2 / 12 of the swing and of the drift.
        assert!((row.q_true[0] - expected).abs() < 1e-6, "{} at {t} s", row.q_true[0] - expected);
    }
}

/// The torque that explains the acceleration, by the other engine, is the motors' and
/// `J^T F`, with `J` by differences along the robot's kinematics.
#[test]
fn oracle_a_push_acts_on_every_joint_through_the_jacobian_of_its_link() {
    let robot = wam();
    let force = Vector3::new(12.0, -7.0, 20.0);
    let q = [0.3, 1.2, -0.4, 1.0, 0.2, 0.5, 0.1];
    let tau = [1.0, -20.0, 2.0, 5.0, 0.3, 0.2, 0.1];
    let stepping =
        Stepping { step_s: 1e-6, steps_per_period: 1, stops: false, order: StepOrder::First };
    for carrier in [3, 6] {
        let name = &robot.links()[carrier].name;
        let effects = format!(
            "[[effect]]\nexternal_disturbance.push = {{ link = '{name}', force_n = [12, -7, 20], start_s = 0.0, duration_s = 1.0 }}"
        );
        let mut arm = simulator(&robot, &effects, stepping).unwrap();
        arm.start(&q);
        arm.actuate(&tau).unwrap();
        let qdd: Vec<f64> = arm.qd_true().iter().map(|qd| qd / stepping.step_s).collect();
        let dynamics = Dynamics::new(&robot);
        let mut acting = dynamics.inverse_dynamics(&q, &[0.0; 7], &qdd).unwrap();
        dynamics.add_rotor_torque(&qdd, acting.as_mut_slice()).unwrap();
        let work = |q: &[f64]| force.dot(&base_from_links(&robot, q)[carrier].translation.vector);
        for i in 0..7 {
            let shifted = |by: f64| {
                let mut q = q;
                q[i] += by;
                work(&q)
            };
            let pushed = (shifted(1e-5) - shifted(-1e-5)) / 2e-5;
            let found = acting[i] - tau[i];
            assert!((found - pushed).abs() < 1e-6, "joint {i}: {found} N m, not {pushed} N m");
        }
    }
}

/// A slide of 3 kg along (0, 1, 0): a push gives it `F_y duration`, begun and ended at any time.
#[test]
fn oracle_a_push_gives_its_impulse_whatever_its_times() {
    let body =
        Inertia { mass: 3.0, com_in_link: Vector3::zeros(), about_com: Matrix3::identity() * 0.1 };
    let mut slide = link("slide", None, JointKind::Prismatic, body, Actuator::default());
    slide.joint.axis_in_joint = Unit::new_normalize(Vector3::y());
    let robot = Robot::new("rig", Vector3::new(0.0, 0.0, -9.81), vec![slide]).unwrap();
    for (start, duration) in [(0.0, 0.02), (0.100_03, 0.020_04), (0.2, 0.000_02)] {
        let effects = format!(
            "[[effect]]\nexternal_disturbance.push = {{ link = 'slide_link', force_n = [3, 15, -4], start_s = {start}, duration_s = {duration} }}"
        );
        let mut slide = simulator(&robot, &effects, STEPPING).unwrap();
        slide.start(&[0.0]);
        let rows = run(&mut slide, 0.3, |_| vec![0.0]).unwrap();
        let speed = rows.last().unwrap().qd_true[0];
        let expected = 15.0 * duration / 3.0;
        assert!((speed - expected).abs() < 1e-9 * expected, "{speed} m/s, not {expected} m/s");
        let before = rows.iter().filter(|r| r.time_s < start);
        assert!(before.fold(0.0, |s: f64, r| s.max(r.qd_true[0].abs())) < 1e-12);
    }
}
