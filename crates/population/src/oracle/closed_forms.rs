//! The torque of each hidden thing along a motion, against what is written by hand.

use std::f64::consts::TAU;

use logs::{Channels, Run};
use nalgebra::DMatrix;
use robot::Robot;
use simulator::effects::EffectSpec;
use simulator::strangers::StrangerSpec;
use simulator::{ArmState, EffortSource, PositionSide, TrueRow, TrueRun};

use crate::hidden::{HiddenThings, Which};
use crate::oracle::along::{HiddenArm, Sensing, added_torque};
use crate::oracle::motion::{SeenRun, means};

const STEP_S: f64 = 2e-3;
const ROWS: usize = 1500;
const G: f64 = 9.81;
/// Mass (kg), distance of its centre (m) and inertia about the axis (kg m2) of the boom.
const MASS: f64 = 2.0;
const REACH: f64 = 0.5;
const INERTIA: f64 = 0.02 + MASS * REACH * REACH;
const ROTOR: f64 = 0.1;
const DRY: f64 = 0.7;

/// An upright yaw, and a link that a positive position lifts: `tau = (I + m c^2 + J) qdd + m g c cos q`.
fn arm() -> Robot {
    let mut robot = Robot::from_urdf(
        r#"<robot name="arm"><link name="base"/>
        <link name="post"><inertial><origin xyz="0 0 0"/><mass value="1"/>
        <inertia ixx="0.01" ixy="0" ixz="0" iyy="0.01" iyz="0" izz="0.05"/></inertial></link>
        <link name="boom"><inertial><origin xyz="0.5 0 0"/><mass value="2"/>
        <inertia ixx="0.001" ixy="0" ixz="0" iyy="0.02" iyz="0" izz="0.02"/></inertial></link>
        <joint name="yaw" type="revolute"><parent link="base"/><child link="post"/><axis xyz="0 0 1"/>
        <limit lower="-3" upper="3" velocity="3" effort="50"/></joint>
        <joint name="lift" type="revolute"><parent link="post"/><child link="boom"/><axis xyz="0 -1 0"/>
        <limit lower="-3" upper="3" velocity="3" effort="50"/></joint></robot>"#,
    )
    .unwrap();
    for j in 0..2 {
        robot.link_mut(j).unwrap().actuator.rotor_inertia = ROTOR;
    }
    robot
}

/// A sine of an amplitude and a frequency about a place: position, velocity, acceleration at a time.
#[derive(Clone, Copy)]
struct Sine(f64, f64, f64);

impl Sine {
    fn at(self, t: f64) -> [f64; 3] {
        let Self(amplitude, hz, middle) = self;
        let w = TAU * hz;
        let (sin, cos) = (w * t).sin_cos();
        [middle + amplitude * sin, amplitude * w * cos, -amplitude * w * w * sin]
    }
}

const STILL: Sine = Sine(0.0, 1.0, 0.2);
const SWING: Sine = Sine(0.6, 0.5, 0.1);
/// Speeds of 1.3e-3 rad/s over .0004 rad, as a joint has that its friction holds.
const CREEP: Sine = Sine(2e-4, 1.0, 0.2);

/// A run along two sines. The commands are sines of their own.
fn run([yaw, lift]: [Sine; 2]) -> TrueRun {
    let time: Vec<f64> = (0..ROWS).map(|i| i as f64 * STEP_S).collect();
    let row = |t: &f64| {
        let (a, b) = (yaw.at(*t), lift.at(*t));
        let (q, qd) = (vec![a[0], b[0]], vec![a[1], b[1]]);
        let state =
            ArmState { motor_q: q.clone(), motor_qd: qd.clone(), q, qd, load: vec![0.0, boom(b)] };
        TrueRow { time_s: *t, state, command: vec![0.0, command(*t)] }
    };
    let rows: Vec<TrueRow> = time.iter().map(row).collect();
    let joint = |j: usize| Channels {
        position: rows.iter().map(|r| r.state.q[j]).collect(),
        velocity: Some(rows.iter().map(|r| r.state.qd[j]).collect()),
        effort: rows.iter().map(|r| r.command[j]).collect(),
        ..Channels::default()
    };
    let log = Run {
        name: "run".to_owned(),
        source: Default::default(),
        sha256: String::new(),
        is_torn: false,
        mended: Vec::new(),
        time: time.clone(),
        joints: vec![joint(0), joint(1)],
        extra: Default::default(),
    };
    let start_q = rows[0].state.q.clone();
    TrueRun { log, rows, start_q, lead_in_s: 0.0 }
}

/// What the boom asks of its transmission.
fn boom([q, _, qdd]: [f64; 3]) -> f64 {
    INERTIA * qdd + MASS * G * REACH * q.cos()
}

fn command(t: f64) -> f64 {
    3.0 * (TAU * 0.5 * t).sin()
}

#[derive(Clone, Copy)]
struct Case {
    motion: [Sine; 2],
    effort: EffortSource,
    side: PositionSide,
}

const MOTOR: Case =
    Case { motion: [STILL, SWING], effort: EffortSource::Motor, side: PositionSide::Motor };
const COMMAND: Case = Case { effort: EffortSource::Commanded, ..MOTOR };
const BEHIND: Case = Case { effort: EffortSource::Link, ..MOTOR };

/// Torque of a hidden thing, the last of those given, at both joints.
fn torque(text: &str, case: Case) -> DMatrix<f64> {
    along(text, case, run(case.motion))
}

fn along(text: &str, case: Case, run: TrueRun) -> DMatrix<f64> {
    #[derive(serde::Deserialize)]
    struct Things {
        #[serde(default)]
        effect: Vec<EffectSpec>,
        #[serde(default)]
        stranger: Vec<StrangerSpec>,
    }
    let Things { effect: causes, stranger: strangers } = toml::from_str(text).unwrap();
    let which = match strangers.len() {
        0 => Which::Cause(causes.len() - 1),
        n => Which::Stranger(n - 1),
    };
    let friction = r#"effect = [{ coulomb_friction = { joint = "lift", level_nm = 0.7 } }]"#;
    let Things { effect: base, .. } = toml::from_str(friction).unwrap();
    let (robot, hidden) = (arm(), HiddenThings { causes, strangers });
    let sensing = Sensing { effort: case.effort, side: case.side };
    let seen = [SeenRun::new(&robot, &run.log)];
    let arm = HiddenArm { robot: &robot, sensing, base: &base, hidden: &hidden };
    added_torque(arm, &[run], &seen, which).unwrap().remove(0)
}

fn effect(body: &str) -> String {
    format!("effect = [{{ {body} }}]")
}

fn stranger(body: &str) -> String {
    format!("stranger = [{{ {body} }}]")
}

/// Asserts a torque at `joint`, and none at the other where `alone`.
fn assert_is(text: &str, case: Case, joint: usize, form: &dyn Fn(f64, [f64; 3]) -> f64) {
    let found = torque(text, case);
    let expected = DMatrix::from_fn(ROWS, 1, |i, _| {
        let t = i as f64 * STEP_S;
        form(t, case.motion[joint].at(t))
    });
    let expected = means(&expected, 10);
    let most = expected.amax().max(1e-9);
    // The ends have derivatives of one side.
    for i in 1..found.nrows() - 1 {
        let off = (found[(i, joint)] - expected[(i, 0)]).abs();
        assert!(off < 4e-3 * most, "{text} at {i}: {} for {}", found[(i, joint)], expected[(i, 0)]);
    }
}

fn assert_none(text: &str, case: Case) {
    let most = torque(text, case).amax();
    assert!(most < 1e-9, "{text}: {most}");
}

/// The sign of a velocity; a joint that creeps has none.
fn sign(qd: f64) -> f64 {
    if qd.abs() > 2e-3 { qd.signum() } else { 0.0 }
}

/// The cases of the oracle that once saw friction that had come loose at another instant.
#[test]
fn what_cannot_be_seen_has_no_torque() {
    let turning = Case { motion: [SWING, STILL], ..MOTOR };
    assert_none(&effect(r#"encoder_offset = { joint = "yaw", offset_rad = 0.1 }"#), turning);
    let creeping = Case { motion: [STILL, CREEP], ..MOTOR };
    for friction in [
        r#"load_dependent_friction = { joint = "lift", coefficient = 0.3 }"#,
        r#"asymmetric_friction = { joint = "lift", forward_nm = 2.0, backward_nm = 1.0 }"#,
        r#"coulomb_friction = { joint = "lift", level_nm = 2.0 }"#,
        r#"stribeck_friction = { joint = "lift", coulomb_nm = 1.0, breakaway_nm = 2.0, stribeck_velocity_rad_per_s = 0.05 }"#,
        r#"position_dependent_friction = { joint = "lift", level_nm = 2.0, share = 0.3, periods_per_turn = 3.0 }"#,
        r#"differential_coupling = { joint_a = "yaw", joint_b = "lift", ratio = 0.8, level_sum_nm = 1.0, level_difference_nm = 0.9 }"#,
    ] {
        assert_none(&effect(friction), creeping);
        // A joint torque is measured behind the friction of the drive.
        assert_none(&effect(friction), BEHIND);
    }
    let still = Case { motion: [STILL, STILL], ..MOTOR };
    let bristles = effect(
        r#"presliding_friction = { joint = "lift", stiffness_nm_per_rad = 500.0, damping_nm_s_per_rad = 0.1, level_nm = 1.0 }"#,
    );
    assert_none(&bristles, still);
    assert_none(&bristles, BEHIND);
}

/// A current is measured behind lag and delay of the drive, so is a joint torque.
#[test]
fn what_is_late_before_the_current_is_none_of_it() {
    for late in [
        r#"actuator_delay = { joint = "lift", delay_ms = 20.0 }"#,
        r#"actuator_lag = { joint = "lift", time_constant_ms = 20.0 }"#,
    ] {
        assert_none(&effect(late), MOTOR);
        assert_none(&effect(late), BEHIND);
    }
    for drive in [
        r#"drive_dead_zone = { joint = "lift", width_nm = 0.5 }"#,
        r#"integrator_windup = { joint = "lift", time_constant_s = 0.3, limit_nm = 1.0 }"#,
        r#"torque_rate_limit = { joint = "lift", rate_nm_per_s = 2.0 }"#,
        r#"torque_dropout = { joint = "lift", per_minute = 300.0, length_ms = 20.0, seed = 3 }"#,
    ] {
        assert_none(&stranger(drive), MOTOR);
    }
}

#[test]
fn a_command_holds_what_is_lost_on_its_way() {
    let late = effect(r#"actuator_delay = { joint = "lift", delay_ms = 20.0 }"#);
    assert_is(&late, COMMAND, 1, &|t, _| {
        if t < 0.02 { command(t) } else { command(t) - command(t - 0.02) }
    });
    // A sine through `1 / (T s + 1)`, with what is left of its start.
    let lag = effect(r#"actuator_lag = { joint = "lift", time_constant_ms = 20.0 }"#);
    assert_is(&lag, COMMAND, 1, &|t, _| {
        let (w, time) = (TAU * 0.5, 0.02);
        let (sin, cos) = (w * t).sin_cos();
        let follows =
            (sin - w * time * cos + w * time * (-t / time).exp()) / (1.0 + (w * time).powi(2));
        command(t) - 3.0 * follows
    });
    let zone = stranger(r#"drive_dead_zone = { joint = "lift", width_nm = 0.5 }"#);
    assert_is(&zone, COMMAND, 1, &|t, _| command(t).clamp(-0.5, 0.5));
    // z = integral of u / T = 3 (1 - cos w t) / (w T), below its limit.
    let wound = stranger(
        r#"integrator_windup = { joint = "lift", time_constant_s = 3.0, limit_nm = 1.0 }"#,
    );
    assert_is(&wound, COMMAND, 1, &|t, _| {
        let w = TAU * 0.5;
        -3.0 * (1.0 - (w * t).cos()) / (3.0 * w)
    });
    let saturated = effect(r#"torque_saturation = { joint = "lift", limit_nm = 2.0 }"#);
    assert_is(&saturated, COMMAND, 1, &|t, _| command(t) - command(t).clamp(-2.0, 2.0));
}

#[test]
fn dry_friction_is_its_level_against_the_motion() {
    let asymmetric =
        effect(r#"asymmetric_friction = { joint = "lift", forward_nm = 2.0, backward_nm = 1.0 }"#);
    assert_is(&asymmetric, MOTOR, 1, &|_, [_, qd, _]| 0.5 * sign(qd).abs() + 1.5 * sign(qd));
    let load = effect(r#"load_dependent_friction = { joint = "lift", coefficient = 0.3 }"#);
    assert_is(&load, MOTOR, 1, &|_, x| 0.3 * boom(x).abs() * sign(x[1]));
    let stribeck = effect(
        r#"stribeck_friction = { joint = "lift", coulomb_nm = 1.0, breakaway_nm = 2.0, stribeck_velocity_rad_per_s = 0.5 }"#,
    );
    assert_is(&stribeck, MOTOR, 1, &|_, [_, qd, _]| (1.0 + (-(qd / 0.5).powi(2)).exp()) * sign(qd));
    let wavy = effect(
        r#"position_dependent_friction = { joint = "lift", level_nm = 2.0, share = 0.3, periods_per_turn = 3.0, phase_rad = 0.4 }"#,
    );
    assert_is(&wavy, MOTOR, 1, &|_, [q, qd, _]| {
        2.0 * (1.0 + 0.3 * (3.0 * q + 0.4).cos()) * sign(qd)
    });
    let snag =
        stranger(r#"snag = { joint = "lift", centre_rad = 0.2, width_rad = 0.05, peak_nm = 3.0 }"#);
    assert_is(&snag, MOTOR, 1, &|_, [q, qd, _]| {
        3.0 * (-0.5 * ((q - 0.2) / 0.05).powi(2)).exp() * sign(qd)
    });
    // Friction of .7 N m, cold, loses 60 % with a time constant of 2 s.
    let warming = effect(
        r#"friction_temperature_drift = { joint = "lift", share = 0.6, time_constant_s = 2.0 }"#,
    );
    assert_is(&warming, MOTOR, 1, &|t, [_, qd, _]| DRY * 0.6 * (-t / 2.0).exp_m1() * sign(qd));
    // The yaw stands, so that both motors turn with the lift alone: r (sum + difference) sign(qd).
    let shared = effect(
        r#"differential_coupling = { joint_a = "yaw", joint_b = "lift", ratio = 0.8, level_sum_nm = 1.0, level_difference_nm = 0.9 }"#,
    );
    let found = torque(&shared, MOTOR);
    for i in 0..found.nrows() {
        // Their bristles turn over within 20 ms.
        let [_, qd, _] = SWING.at((10 * i + 5) as f64 * STEP_S);
        let expected = 0.8 * 1.9 * sign(qd);
        let off = (found[(i, 1)] - expected).abs();
        assert!(qd.abs() < 0.15 || off < 1e-6 * expected.abs(), "{i}: {off}");
    }
}

/// Bristles that slide after a way of level / stiffness: from one end to the other as `1 - 2 exp(-way / 2 mrad)`.
#[test]
fn bristles_turn_over_their_way() {
    let bristles = effect(
        r#"presliding_friction = { joint = "lift", stiffness_nm_per_rad = 50.0, damping_nm_s_per_rad = 0.0, level_nm = 1.0 }"#,
    );
    assert_is(&bristles, MOTOR, 1, &|t, [q, qd, _]| {
        let way = 0.02;
        let turn = |far: f64, from: f64| 1.0 - (1.0 - from) * (-far / way).exp();
        // Up from .1 to .7 until .5 s, down to -.5 until 1.5 s, up to .7 until 2.5 s.
        let held = match t {
            ..0.5 => turn(q - 0.1, 0.0),
            ..1.5 => -turn(0.7 - q, -1.0),
            ..2.5 => turn(q + 0.5, -1.0),
            _ => -turn(0.7 - q, -1.0),
        };
        held * sign(qd).abs()
    });
}

#[test]
fn drives_scale_shift_and_ripple() {
    // effort = g tau + o: the offset is itself, and the gain its part beyond one of what a model says, no friction.
    let offset = effect(r#"torque_offset = { joint = "lift", offset_nm = -0.4 }"#);
    let gain = effect(r#"torque_constant = { joint = "lift", gain = 1.2 }"#);
    let drive = |x: [f64; 3]| boom(x) + ROTOR * x[2];
    for case in [MOTOR, COMMAND] {
        assert_is(&offset, case, 1, &|_, _| -0.4);
        assert_is(&gain, case, 1, &|_, x| 0.2 * drive(x));
    }
    assert_is(&gain, BEHIND, 1, &|_, x| 0.2 * boom(x));
    let ripple = effect(
        r#"torque_ripple = { joint = "lift", amplitude_nm = 0.5, periods_per_turn = 20.0, phase_rad = 0.3 }"#,
    );
    assert_is(&ripple, MOTOR, 1, &|_, [q, _, _]| 0.5 * (20.0 * q + 0.3).sin());
    assert_none(&ripple, BEHIND);
    let rotor = effect(r#"rotor_inertia = { joint = "lift", inertia_kg_m2 = 0.3 }"#);
    assert_is(&rotor, MOTOR, 1, &|_, [_, _, qdd]| 0.3 * qdd);
    assert_none(&rotor, BEHIND);
    let viscous = effect(r#"viscous_friction = { joint = "lift", viscous_nm_s_per_rad = 0.8 }"#);
    assert_is(&viscous, MOTOR, 1, &|_, [_, qd, _]| 0.8 * qd);
}

/// The model of the arm is told where the encoder says it is.
#[test]
fn what_an_encoder_reads_is_what_the_model_is_told() {
    let offset = effect(r#"encoder_offset = { joint = "lift", offset_rad = 0.1 }"#);
    assert_is(&offset, MOTOR, 1, &|_, [q, _, _]| MASS * G * REACH * (q.cos() - (q + 0.1).cos()));
    let ratio = effect(r#"transmission_ratio = { joint = "lift", ratio = 1.1 }"#);
    assert_is(&ratio, MOTOR, 1, &|_, [q, qd, qdd]| {
        let told = |part: f64| boom([q / part, qd / part, qdd / part]) + ROTOR * qdd / part;
        1.1 * told(1.0) - told(1.1)
    });
    let eccentric = stranger(
        r#"eccentric_encoder = { joint = "lift", eccentricity_rad = 0.05, phase_rad = 1.0 }"#,
    );
    let found = torque(&eccentric, MOTOR);
    let weight = |t: f64| {
        let [q, _, _] = SWING.at(t);
        MASS * G * REACH * (q.cos() - (q + 0.05 * (q + 1.0).sin()).cos())
    };
    // The weight is most of it; its second derivative takes the rest.
    let expected = means(&DMatrix::from_fn(ROWS, 1, |i, _| weight(i as f64 * STEP_S)), 10);
    let off = (found.column(1) - expected.column(0)).norm();
    assert!(off < 0.6 * expected.norm() && off > 0.0, "{off} of {}", expected.norm());
}

#[test]
fn what_pulls_at_the_link_is_seen_by_every_sensor() {
    let spring = effect(
        r#"cable_spring = { joint = "lift", stiffness_nm_per_rad = 2.0, rest_rad = 0.3, cubic_nm_per_rad3 = 1.0 }"#,
    );
    let shaken = effect(
        r#"external_disturbance = { periodic = { joint = "lift", amplitude_nm = 0.5, frequency_hz = 3.0, phase_rad = 0.2 } }"#,
    );
    let balance =
        effect(r#"counterbalance = { joint = "lift", amplitude_nm = 2.0, phase_rad = 0.4 }"#);
    let drag = stranger(r#"square_drag = { joint = "lift", coefficient_nm_s2_per_rad2 = 0.7 }"#);
    let well = stranger(
        r#"magnet_well = { joint = "lift", centre_rad = 0.2, width_rad = 0.1, peak_nm = 1.5 }"#,
    );
    let wall = stranger(
        r#"soft_wall = { joint = "lift", wall_rad = 0.4, side = "above", stiffness_nm_per_rad = 20.0, damping_nm_s_per_rad = 0.0 }"#,
    );
    for case in [MOTOR, COMMAND, BEHIND] {
        assert_is(&spring, case, 1, &|_, [q, _, _]| 2.0 * (q - 0.3) + (q - 0.3).powi(3));
        assert_is(&shaken, case, 1, &|t, _| -0.5 * (TAU * 3.0 * t + 0.2).sin());
        assert_is(&balance, case, 1, &|_, [q, _, _]| 2.0 * (q + 0.4).sin());
        assert_is(&drag, case, 1, &|_, [_, qd, _]| 0.7 * qd * qd.abs());
        assert_is(&well, case, 1, &|_, [q, _, _]| {
            let x = (q - 0.2) / 0.1;
            1.5 * x * (0.5 * (1.0 - x * x)).exp()
        });
        assert_is(&wall, case, 1, &|_, [q, _, _]| 20.0 * (q - 0.4).max(0.0));
    }
    let talk = stranger(
        r#"speed_crosstalk = { joint = "yaw", other = "lift", coefficient_nm_s_per_rad = 0.6 }"#,
    );
    let found = torque(&talk, MOTOR);
    let speed = means(&DMatrix::from_fn(ROWS, 1, |i, _| 0.6 * SWING.at(i as f64 * STEP_S)[1]), 10);
    assert!((found.column(0) - speed.column(0)).amax() < 1e-3 && found.column(1).amax() < 1e-9);
}

#[test]
fn bodies_and_gravity_weigh_what_they_weigh() {
    let payload = effect(
        r#"payload = { link = "boom", mass_kg = 0.5, com_m = [0.8, 0.0, 0.0], inertia_kg_m2 = [0.003, 0.004, 0.004, 0.0, 0.0, 0.0] }"#,
    );
    assert_is(&payload, BEHIND, 1, &|_, [q, _, qdd]| {
        (0.5 * 0.64 + 0.004) * qdd + 0.5 * G * 0.8 * q.cos()
    });
    let heavier = effect(
        r#"inertial_parameters = { link = "boom", mass_kg = 2.5, com_m = [0.5, 0.0, 0.0] }"#,
    );
    assert_is(&heavier, MOTOR, 1, &|_, x| 0.25 * boom(x));
    // Gravity that is turned about y by .1: the boom seems to be turned by as much.
    let tilted = effect(r#"gravity_direction = { tilt_x_rad = 0.0, tilt_y_rad = 0.1 }"#);
    let weight = |q: f64| MASS * G * REACH * q.cos();
    let found = torque(&tilted, MOTOR);
    let of = |by: f64| {
        // The yaw stands at .2, so that a part cos(.2) of the tilt is about the axis of the lift.
        means(
            &DMatrix::from_fn(ROWS, 1, |i, _| {
                let [q, _, _] = SWING.at(i as f64 * STEP_S);
                MASS * G
                    * REACH
                    * (q.cos() * f64::cos(0.1) + by * q.sin() * f64::sin(0.1) * f64::cos(0.2))
                    - weight(q)
            }),
            10,
        )
    };
    let off = |by| (found.column(1) - of(by).column(0)).amax();
    assert!(off(1.0).min(off(-1.0)) < 1e-6, "{} {}", off(1.0), off(-1.0));
}

/// A twist `load / k` of the link against its motor, whose position is read, moves the weight.
#[test]
fn what_bends_moves_the_link_against_what_is_read() {
    let mut bent = run(MOTOR.motion);
    let twist = |x: [f64; 3]| -boom(x) / 400.0;
    for row in &mut bent.rows {
        row.state.q[1] += twist(SWING.at(row.time_s));
    }
    let spring = effect(
        r#"joint_elasticity = { joint = "lift", stiffness_nm_per_rad = 400.0, damping_nm_s_per_rad = 0.0 }"#,
    );
    let found = along(&spring, MOTOR, bent);
    let expected = DMatrix::from_fn(ROWS, 1, |i, _| {
        let [q, qd, qdd] = SWING.at(i as f64 * STEP_S);
        MASS * G * REACH * ((q + twist([q, qd, qdd])).cos() - q.cos())
    });
    let expected = means(&expected, 10);
    let off = (found.column(1) - expected.column(0)).amax();
    assert!(off < 4e-3 * expected.amax(), "{off} of {}", expected.amax());
    // Behind the transmission, read at the link, nothing of it is seen.
    assert_none(&spring, Case { side: PositionSide::Link, ..BEHIND });
}

#[test]
fn a_skewed_clock_shifts_the_effort_against_the_motion() {
    for skew_ms in [20.0, -20.0] {
        let skew = effect(&format!("time_skew = {{ skew_ms = {skew_ms:?} }}"));
        assert_is(&skew, COMMAND, 1, &|t, _| {
            let last = (ROWS - 1) as f64 * STEP_S;
            command(t) - command((t + 1e-3 * skew_ms).clamp(0.0, last))
        });
    }
}
