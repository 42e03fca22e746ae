use robot::{JointKind, Robot};

use crate::rig::{Row, STEPPING, effects, flywheel, link, run, simulator};

const RATIO: f64 = 0.6;
const SUM: f64 = 0.5;
const DIFFERENCE: f64 = 0.3;
const FRICTION: &str = "[[effect]]\n\
    differential_coupling = { joint_a = 'a', joint_b = 'b', ratio = 0.6, level_sum_nm = 0.5, \
    level_difference_nm = 0.3 }";
/// With its rotor, of either wheel (kg m²).
const INERTIA: f64 = 0.5;
/// Of either rotor (kg m²).
const ROTOR: f64 = 0.1;
/// Frequency of a rotor on both bristles (Hz), as documented.
const BRISTLE_HZ: f64 = 150.0;

/// Two wheels that have nothing to do with each other but the motors that drive them.
fn wheels() -> Robot {
    let one = flywheel(INERTIA - ROTOR, ROTOR).links()[0].clone();
    let wheel = |name: &str| {
        let mut link =
            link(name, None, JointKind::Continuous, one.inertia.clone(), one.actuator.clone());
        link.joint.axis_in_joint = one.joint.axis_in_joint;
        link
    };
    Robot::new("wheels", nalgebra::Vector3::zeros(), vec![wheel("a"), wheel("b")]).unwrap()
}

fn spin(qd: [f64; 2], duration_s: f64) -> Vec<Row> {
    let mut wheels = simulator(&wheels(), FRICTION, STEPPING).unwrap();
    wheels.start_moving(&[0.0, 0.0], &qd);
    run(&mut wheels, duration_s, |_| vec![0.0, 0.0]).unwrap()
}

/// With joint a alone both motors resist it; once joint b turns them the other way round, the
/// motor of the difference drives it:
///
/// ```text
/// a alone:          I qdd_a = -(sum + difference),  I qdd_b = -ratio (sum - difference)
/// ratio qd_b > qd_a: I qdd_a = -(sum - difference),  I qdd_b = -ratio (sum + difference)
/// ```
#[test]
fn oracle_motion_of_joint_b_changes_the_friction_of_joint_a() {
    for (qd, on_a, on_b) in [
        ([3.0, 0.0], SUM + DIFFERENCE, SUM - DIFFERENCE),
        ([0.5, 8.0], SUM - DIFFERENCE, SUM + DIFFERENCE),
        ([0.5, -8.0], DIFFERENCE - SUM, -SUM - DIFFERENCE),
        ([-3.0, 0.1], -SUM - DIFFERENCE, DIFFERENCE - SUM),
    ] {
        let rows = spin(qd, 0.3);
        let (early, late) = (&rows[10], &rows[140]);
        let torque = |i: usize| {
            INERTIA * (early.qd_true[i] - late.qd_true[i]) / (late.time_s - early.time_s)
        };
        assert!((torque(0) / on_a - 1.0).abs() < 1e-6, "{qd:?}: {} on a", torque(0));
        assert!((torque(1) / (RATIO * on_b) - 1.0).abs() < 1e-6, "{qd:?}: {} on b", torque(1));
    }
}

/// Motor torques `f` are the load `f_sum + f_difference` on a and `ratio (f_sum - f_difference)` on
/// b: without a load on b both motors carry the same, and the weaker one breaks away alone when a
/// is loaded with twice its level. A load of both levels breaks both away. Up to then, laid on
/// slowly enough not to ring, it bends the bristles of stiffness `k` and they stay:
///
/// ```text
/// k = ROTOR (2 pi BRISTLE_HZ)² / 2,   a + ratio b = f_sum / k,   a - ratio b = f_difference / k
/// ```
#[test]
fn oracle_loaded_joints_stick_for_good_and_break_away_at_the_level_of_a_motor() {
    for load in [[2.0 * DIFFERENCE, 0.0], [SUM + DIFFERENCE, RATIO * (SUM - DIFFERENCE)]] {
        let mut wheels = simulator(&wheels(), FRICTION, STEPPING).unwrap();
        wheels.start(&[0.0, 0.0]);
        let share = |t: f64| 0.9 * t.min(1.0) + 0.1 * (t - 8.0).max(0.0);
        let torque = |t: f64| load.map(|l| l * share(t)).to_vec();
        let rows = run(&mut wheels, 9.5, |r| torque(r.time_s)).unwrap();
        let (soon, late) = (&rows[1000], &rows[3999]);
        let stiffness = 0.5 * ROTOR * (2.0 * std::f64::consts::PI * BRISTLE_HZ).powi(2);
        let bent = [load[0] / 2.0, load[1] / (2.0 * RATIO * RATIO)].map(|f| 0.9 * f / stiffness);
        for i in 0..2 {
            let off = (late.q_true[i] - bent[i]).abs() / bent[0];
            assert!(off < 1e-3, "joint {i} at {} rad, not {}", late.q_true[i], bent[i]);
            assert!((late.q_true[i] - soon.q_true[i]).abs() < 1e-12, "joint {i} creeps");
        }
        let moving = rows[4000..].iter().find(|r| r.qd_true[0] > 2e-6).unwrap();
        assert!((moving.time_s - 9.0).abs() < 0.02, "{}", moving.time_s);
        let [a, b] = [0, 1].map(|i| rows.last().unwrap().qd_true[i]);
        let sum = (a + RATIO * b).abs() / a;
        assert!(if load[1] > 0.0 { sum > 1.0 } else { sum < 1e-3 }, "{a} and {b} rad/s");
    }
}

/// All energy goes into the work of the two motors' friction, `sum |w_sum| + difference
/// |w_difference|` a second, and then both wheels rest.
#[test]
fn oracle_friction_at_the_motors_does_the_work_of_the_energy() {
    let rows = spin([2.0, 5.0], 12.0);
    let energy = 0.5 * INERTIA * (4.0 + 25.0);
    let work: f64 = rows
        .windows(2)
        .map(|w| {
            let [a, b] = [0, 1].map(|i| w[1].q_true[i] - w[0].q_true[i]);
            SUM * (a + RATIO * b).abs() + DIFFERENCE * (a - RATIO * b).abs()
        })
        .sum();
    assert!((work / energy - 1.0).abs() < 1e-3, "{work} J of {energy} J");
    let last = rows.last().unwrap();
    assert!(last.qd_true.iter().all(|qd| qd.abs() < 1e-9), "{:?}", last.qd_true);
}

#[test]
fn a_pair_of_one_joint_or_without_rotors_is_refused() {
    let refusal = |effect: &str, robot: &Robot| {
        let mistake = effects(effect)[0].inject(robot).err().unwrap();
        format!("{}: {}", mistake.key, mistake.found)
    };
    assert_eq!(
        refusal(&FRICTION.replace("'b'", "'a'"), &wheels()),
        "joint_b: a, another joint than joint_a was expected"
    );
    let mut bare = wheels();
    bare.link_mut(0).unwrap().actuator.rotor_inertia = 0.0;
    assert_eq!(
        refusal(FRICTION, &bare),
        "joint_a: a, whose rotor inertia is 0 kg m^2, a positive one was expected: \
         give rotor_inertia_kg_m2 in robot.toml"
    );
}
