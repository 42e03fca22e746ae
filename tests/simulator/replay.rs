use checks::arms::{wam, workspace_root};
use logs::{PreparedJoint, PreparedRun};
use robot::{Actuator, PdGain, Robot, TorqueSource};
use simulator::scenario::Scenario;
use simulator::{SimulatorError, Windows, replay_motion, replay_torque};

use crate::scenario::document;

/// The states and torques that the simulation of the WAM itself went through, as a record.
fn record(effort: &str, more: &str) -> PreparedRun {
    let mut document = document(more);
    document.set("run.0.motion.sinusoids.duration_s=2.4").unwrap();
    document.set("run.0.motion.sinusoids.fade_s=0.5").unwrap();
    document.set("run.0.motion.sinusoids.highest_hz=0.5").unwrap();
    document.set("run.0.lead_in_s=0.8").unwrap();
    // Steps of the order of a replay: those of the first are 1e-6 rad off after 50 ms.
    document.set("engine.order=second").unwrap();
    document.set(&format!("sensors.effort={effort}")).unwrap();
    let scenario = Scenario::from_document(&document).unwrap();
    let run = simulator::simulate(&scenario, &|| {}).unwrap().runs.remove(0);
    let joint = |c: logs::Channels| {
        let state = [c.position, c.velocity.unwrap(), c.desired_acceleration.unwrap()];
        PreparedJoint::exact(state, c.effort)
    };
    let joints = run.joints.into_iter().map(joint).collect();
    PreparedRun { name: run.name, rate_hz: 500.0, time: run.time, session_start_s: 0.0, joints }
}

/// The WAM whose efforts come from there.
fn wam_with(source: TorqueSource) -> Robot {
    let mut robot = wam();
    for i in 0..robot.joint_count() {
        robot.link_mut(i).unwrap().actuator.torque_source = source;
    }
    robot
}

fn drift(robot: &Robot, record: &PreparedRun, window_s: f64) -> Vec<f64> {
    let replay = replay_torque(robot, record, Windows::of(window_s)).unwrap();
    replay.drift_rms.unwrap()
}

fn largest(values: &[f64]) -> f64 {
    values.iter().copied().fold(0.0, f64::max)
}

/// Lengths of time (s), and the drift (rad) that is allowed after them: ten times what there is,
/// which is the jump from the command before the window, and what its error grows to.
const ALLOWED: [(f64, f64); 3] = [(0.05, 1e-7), (0.2, 5e-7), (1.0, 5e-5)];

#[test]
fn a_simulation_under_its_own_commands_goes_where_it_went() {
    let (robot, record) = (wam_with(TorqueSource::Commanded), record("commanded", ""));
    for (window_s, allowed) in ALLOWED {
        let drift = largest(&drift(&robot, &record, window_s));
        assert!(drift < allowed, "{drift:.2e} rad after {window_s} s");
    }
}

#[test]
fn a_simulation_without_the_payload_of_the_log_drifts_away() {
    let load = "[[effect]]\npayload = { link = 'palm', mass_kg = 1.0, com_m = [0.0, 0.02, 0.05] }";
    let (robot, record) = (wam_with(TorqueSource::Commanded), record("commanded", load));
    for (window_s, allowed) in &ALLOWED[..2] {
        let drift = largest(&drift(&robot, &record, *window_s));
        assert!(drift > 1e5 * allowed, "{drift:.2e} rad after {window_s} s");
    }
}

/// What a description says of a drive.
type Describe = fn(&mut Actuator);

/// A robot that says what its elbow has goes with the record, one that does not drifts away.
#[test]
fn a_record_of_an_arm_with_an_effect_is_replayed_by_a_robot_that_says_so() {
    let elbow = "joint = 'j4_elbow_pitch'";
    let cases: [(String, Describe); 6] = [
        (format!("actuator_delay = {{ {elbow}, delay_ms = 1.5 }}"), |a| a.delay_s = 0.0015),
        (format!("backlash = {{ {elbow}, gap_rad = 0.002 }}"), |a| a.backlash = 0.002),
        (format!("actuator_lag = {{ {elbow}, time_constant_ms = 2.0 }}"), |a| a.lag_s = 0.002),
        (format!("encoder_offset = {{ {elbow}, offset_rad = 0.05 }}"), |a| {
            a.encoder_offset = 0.05;
        }),
        (format!("transmission_ratio = {{ {elbow}, ratio = 1.1 }}"), |a| {
            a.transmission_ratio = 1.1;
        }),
        (
            format!(
                "transmission_ratio = {{ {elbow}, ratio = 1.1 }}\n[[effect]]\n\
                 encoder_offset = {{ {elbow}, offset_rad = 0.3 }}"
            ),
            |a| (a.transmission_ratio, a.encoder_offset) = (1.1, 0.3),
        ),
    ];
    let rigid = wam_with(TorqueSource::Commanded);
    for (effect, describe) in cases {
        let record = record("commanded", &format!("[[effect]]\n{effect}"));
        let mut described = rigid.clone();
        describe(&mut described.link_mut(3).unwrap().actuator);
        let [with, without] = [&described, &rigid].map(|robot| drift(robot, &record, 0.05)[3]);
        assert!(50.0 * with < without, "{effect}: {with:.2e} rad, {without:.2e} without");
    }
}

/// What the bristles hold at the start of a window is known where the joint has slid, and not
/// within a way of the last reversal.
#[test]
fn a_record_of_an_arm_with_presliding_friction_is_replayed_as_one_that_slid_before() {
    let bristles = "[[effect]]\npresliding_friction = { joint = 'j4_elbow_pitch', \
                    stiffness_nm_per_rad = 1000.0, damping_nm_s_per_rad = 5.9, level_nm = 0.5 }";
    let record = record("commanded", bristles);
    let mut robot = wam_with(TorqueSource::Commanded);
    let mut found = Vec::new();
    for (coulomb, presliding) in [(0.0, None), (0.5, None), (0.5, Some(0.0005))] {
        let a = &mut robot.link_mut(3).unwrap().actuator;
        (a.coulomb_forward, a.coulomb_backward, a.presliding) = (coulomb, coulomb, presliding);
        found.push(drift(&robot, &record, 0.05)[3]);
    }
    let [none, level, bent] = found[..] else { panic!("{found:?}") };
    assert!(20.0 * bent < none && bent < level, "{found:?} rad");
}

/// A motor's torque is that of its instant, half of the command before and half of the next.
#[test]
fn a_torque_that_was_commanded_is_held_and_one_that_was_measured_is_averaged() {
    let commanded = wam_with(TorqueSource::Commanded);
    let (held, measured) = (record("commanded", ""), record("motor", ""));
    for source in [TorqueSource::Measured, TorqueSource::Current] {
        let other = wam_with(source);
        for (record, right, wrong, allowed) in
            [(&held, &commanded, &other, 1e-7), (&measured, &other, &commanded, 5e-6)]
        {
            let [right, wrong] = [right, wrong].map(|robot| largest(&drift(robot, record, 0.05)));
            assert!(right < allowed, "{source:?}: {right:.2e} rad");
            assert!(wrong > 10.0 * allowed, "{source:?}: {wrong:.2e} rad");
        }
    }
}

/// One window, at whose end one joint was measured elsewhere.
#[test]
fn drift_is_told_of_the_joint_that_drifted() {
    let robot = wam_with(TorqueSource::Commanded);
    let mut record = record("commanded", "");
    record.joints[3].q[700] += 0.5;
    let replay = replay_torque(&robot, &record, Windows::of(1.4)).unwrap();
    assert_eq!((replay.starts.len(), replay.window_s), (1, 1.4));
    for (joint, drift) in replay.drift_rms.unwrap().iter().enumerate() {
        let expected = if joint == 3 { 0.5 } else { 0.0 };
        assert!((drift - expected).abs() < 1e-2, "joint {joint}: {drift} rad");
    }
    assert_eq!(replay.motion.joints[3].name, "j4_elbow_pitch");
    let measured = &replay.motion.extra["j4_elbow_pitch.measured_position"];
    assert_eq!(measured[..], record.joints[3].q[1..=700]);
    assert_eq!(replay.motion.time[..], record.time[1..=700]);
}

fn gains() -> Vec<PdGain> {
    let loaded = Robot::load(&workspace_root().join("robots/wam7/robot.toml")).unwrap();
    loaded.control.gains.iter().map(|gain| gain.unwrap()).collect()
}

/// Root mean square of the torque error over that of the torque, at the four big joints.
fn torque_error(record: &PreparedRun) -> Vec<f64> {
    let replay = replay_motion(&wam(), &gains(), record).unwrap();
    let rms = |x: &[f64]| f64::sqrt(x.iter().map(|x| x * x).sum::<f64>() / x.len() as f64);
    let errors = replay.torque_error_rms.iter().zip(&record.joints);
    errors.take(4).map(|(error, joint)| error / rms(&joint.effort)).collect()
}

#[test]
fn along_the_motion_of_a_log_a_simulation_asks_for_the_torque_of_the_log() {
    for error in torque_error(&record("motor", "")) {
        assert!(error < 0.02, "{error:.3} of the torque");
    }
    let load = "[[effect]]\npayload = { link = 'palm', mass_kg = 1.0, com_m = [0.0, 0.02, 0.05] }";
    for error in torque_error(&record("motor", load)) {
        assert!(error > 0.2, "{error:.3} of the torque with a payload");
    }
}

#[test]
fn a_record_that_is_too_short_is_refused() {
    let (robot, mut record) = (wam(), record("motor", ""));
    let refused = |found_s: f64, window_s: f64| {
        let run = "one".to_owned();
        Some(SimulatorError::TooShort { run, found_s, window_s })
    };
    assert_eq!(replay_torque(&robot, &record, Windows::of(2.5)).err(), refused(2.4, 2.5));
    for left in [1, 0] {
        record.time.truncate(left);
        assert_eq!(replay_torque(&robot, &record, Windows::of(0.002)).err(), refused(0.0, 0.002));
        assert_eq!(replay_motion(&robot, &gains(), &record).err(), refused(0.0, 0.002));
    }
}

/// No window is left to speak of.
#[test]
fn a_drift_that_no_window_shows_is_not_zero() {
    let (robot, mut record) = (wam_with(TorqueSource::Commanded), record("commanded", ""));
    record.joints[6].effort.fill(1e6);
    let replay = replay_torque(&robot, &record, Windows::of(0.2)).unwrap();
    assert_eq!((replay.runaways.len(), replay.starts.len(), replay.drift_rms), (12, 12, None));
}

/// Descriptions of published arms round the inertia of a last link to zero, which leaves the mass matrix without an inverse.
#[test]
fn a_joint_without_inertia_is_named_and_the_others_are_not() {
    let (mut robot, record) = (wam_with(TorqueSource::Commanded), record("commanded", ""));
    let palm = robot.link_mut(6).unwrap();
    // A point on the axis.
    (palm.inertia.com_in_link.x, palm.inertia.com_in_link.y) = (0.0, 0.0);
    palm.inertia.about_com.fill(0.0);
    palm.actuator.rotor_inertia = 0.0;
    let replay = replay_torque(&robot, &record, Windows::of(0.2)).unwrap();
    let blamed: Vec<&str> = replay.runaways.iter().map(|fault| fault.joint.as_str()).collect();
    assert_eq!(blamed, ["j7_palm_yaw"; 12]);
    assert!(replay.runaways[0].found.contains("have an inertia about its axis"), "{blamed:?}");
}
