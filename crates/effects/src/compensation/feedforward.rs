use dynamics::{Dynamics, Workspace};
use robot::{Actuator, Robot, SensingSide};

use crate::compensation::lead::{
    CROSSING_ACCELERATION, SPACING_S, differences, is_rigid, lead, rate,
};
use crate::motion::drive::{motor_torque, spring_torque};

/// Feedforward efforts of the motors with which the links follow a motion, for a robot that is extended by named
/// effects.
///
/// The links need `tau_link`, which passes through compliant transmissions with free play:
///
/// ```text
/// tau_link  = M(q) qdd + C(q, qd) qd + g(q) + spring_stiffness x + spring_cubic x³
///             + spring_hysteresis tanh(qd / rest_speed) + counterbalance(q),   x = q - spring_rest
/// q_motor   = q + tau_link / elasticity + (backlash / 2) tanh(tau_link / tau_0)
/// tau_motor = tau_link + rotor_inertia qdd_motor + viscous qd_motor + ripple(q_motor)
///             + level(q_motor, qd_motor, tau_link) direction + friction of shared motors(qd)
/// direction = tanh(qd_motor / rest_speed)
/// tau       = transmission_ratio torque_gain (tau_motor + lag d(tau_motor)/dt) + torque_offset
/// q_seen    = q_motor / transmission_ratio + encoder_offset
/// ```
///
/// with the level of dry friction and the ripple of [`Actuator`]. The ways over which presliding
/// friction and the loop of a spring build up after a reversal are left out: only their levels are
/// asked for.
///
/// `qd_motor` and `qdd_motor` are those of the motion plus central differences of `q_motor - q`. `tau_0 = M_jj(q) x 1
/// rad/s²` is the load that gives the links one unit of acceleration: above it the sign of the load sets the side of
/// the gap. The damping of a transmission has no key in the description and is left out.
/// Friction stays within its levels, the lead within `backlash / 2` plus the twist `|tau_link| / elasticity`. Both
/// are smooth, so that they do not jump at a reversal.
///
/// An actuator with a delay needs the `tau` of the motion [`delay_s`](Self::delay_s) ahead. Leads are those of the
/// present.
///
/// # Source
///
/// Spong 1987 for the elastic joint, Nordin & Gutman 2002 for the inverse of backlash, smoothed
/// here.
#[derive(Debug, Clone)]
pub struct Compensation {
    dynamics: Dynamics,
    drives: Vec<Actuator>,
    rest_speed: Vec<f64>,
    delay_s: Vec<f64>,
}

/// Result of [`Compensation::fill`], one entry a joint.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct FeedforwardEfforts {
    /// Commanded effort (N·m or N).
    pub tau: Vec<f64>,
    /// Lead of the reported position over the reference, `q_seen - q` (rad or m). Where the encoder is at the link,
    /// `q_seen` follows the link instead of the motor. An encoder whose side is not stated counts as the motor's.
    pub q_lead: Vec<f64>,
    /// The same for the velocity (rad/s or m/s).
    pub qd_lead: Vec<f64>,
}

/// Scratch memory of [`Compensation::fill`], made once by [`Compensation::workspace`].
#[derive(Debug, Clone)]
pub struct CompensationWorkspace {
    dynamics: Workspace,
    /// Torque through the transmissions, `[instant][joint]`.
    tau_link: Vec<Vec<f64>>,
    /// Row-major n x n.
    mass_matrix: Vec<f64>,
    /// Friction of motors that joints share, one entry a joint.
    shared: Vec<f64>,
}

impl FeedforwardEfforts {
    /// Zeros, for `joint_count` joints.
    pub fn zero(joint_count: usize) -> Self {
        let zero = vec![0.0; joint_count];
        Self { tau: zero.clone(), q_lead: zero.clone(), qd_lead: zero }
    }
}

impl Compensation {
    /// Time between the states that [`fill`](Self::fill) takes (s). Differences over it are off
    /// by `(w h)² / 12`, 1e-3 at 17 Hz.
    pub const SPACING_S: f64 = SPACING_S;

    /// Largest number of states that [`fill`](Self::fill) takes.
    pub const MOST_STATES: usize = 5;

    /// The compensation for `robot`, whose joints count as at rest below `rest_speed` (rad/s or
    /// m/s, one entry a joint).
    ///
    /// # Panics
    ///
    /// When `rest_speed` does not have one entry a joint.
    pub fn new(robot: &Robot, rest_speed: Vec<f64>) -> Self {
        assert_eq!(rest_speed.len(), robot.joint_count(), "one rest speed a joint");
        let drives: Vec<Actuator> = robot.links().iter().map(|l| l.actuator.clone()).collect();
        let delay_s = drives.iter().map(|a| a.delay_s).collect();
        Self { dynamics: Dynamics::new(robot), drives, rest_speed, delay_s }
    }

    /// Number of states that [`fill`](Self::fill) takes: the instant itself, and one more on each side for compliant
    /// transmissions and for torques that lag.
    pub fn state_count(&self) -> usize {
        let some = |has: fn(&Actuator) -> bool| 2 * usize::from(self.drives.iter().any(has));
        1 + some(|drive| !is_rigid(drive)) + some(|drive| drive.lag_s > 0.0)
    }

    /// Whether the reported position can be ahead of the reference at any joint.
    pub fn leads(&self) -> bool {
        let truly = |a: &Actuator| {
            a.transmission_ratio.total_cmp(&1.0).is_eq() && a.encoder_offset.abs() <= 0.0
        };
        !self.drives.iter().all(|drive| is_rigid(drive) && truly(drive))
    }

    /// Time by which the torque of each joint has to be commanded ahead (s).
    pub fn delay_s(&self) -> &[f64] {
        &self.delay_s
    }

    /// Scratch memory of the right size.
    pub fn workspace(&self) -> CompensationWorkspace {
        let n = self.drives.len();
        CompensationWorkspace {
            dynamics: self.dynamics.workspace(),
            tau_link: vec![vec![0.0; n]; self.state_count()],
            mass_matrix: vec![0.0; n * n],
            shared: vec![0.0; n],
        }
    }

    /// Computes the efforts of one instant; allocates nothing.
    ///
    /// `states` are `[q, qd, qdd]` (rad, rad/s, rad/s² or m, m/s, m/s²) of the motion that the
    /// links should follow: as many as [`state_count`](Self::state_count) says,
    /// [`SPACING_S`](Self::SPACING_S) apart, with the instant in their middle.
    ///
    /// # Panics
    ///
    /// When the number of states differs, or any length differs from the number of joints.
    pub fn fill(
        &self,
        ws: &mut CompensationWorkspace,
        states: &[[&[f64]; 3]],
        out: &mut FeedforwardEfforts,
    ) {
        assert_eq!(states.len(), self.state_count(), "states of the motion");
        let now = states.len() / 2;
        let [q_now, qd_now, _] = states[now];
        let (dynamics, n) = (&mut ws.dynamics, self.drives.len());
        for (tau, [q, qd, qdd]) in ws.tau_link.iter_mut().zip(states) {
            self.dynamics.inverse_dynamics_into(dynamics, q, qd, qdd, tau);
            for (j, (tau, drive)) in tau.iter_mut().zip(&self.drives).enumerate() {
                let dragged = drive.spring_hysteresis * self.direction(j, qd[j]);
                *tau += spring_torque(drive, q[j]) + dragged;
            }
        }
        if !self.drives.iter().all(is_rigid) {
            self.dynamics.mass_matrix_into(dynamics, q_now, &mut ws.mass_matrix);
        }
        self.add_shared_friction(qd_now, &mut ws.shared);
        for (j, drive) in self.drives.iter().enumerate() {
            let tau_0 = CROSSING_ACCELERATION * ws.mass_matrix[j * n + j];
            let motor = |at: usize| {
                let lead = if is_rigid(drive) {
                    [0.0; 3]
                } else {
                    differences([at - 1, at, at + 1].map(|t| lead(drive, ws.tau_link[t][j], tau_0)))
                };
                let [q, qd, qdd] = states[at];
                let state = [q[j] + lead[0], qd[j] + lead[1], qdd[j] + lead[2]];
                (self.motor_torque(j, state, ws.tau_link[at][j]), lead)
            };
            let (mut tau_motor, [q_lead, qd_lead, _]) = motor(now);
            tau_motor += ws.shared[j];
            if drive.lag_s > 0.0 {
                tau_motor += drive.lag_s * rate(motor(now - 1).0, motor(now + 1).0);
            }
            let ratio = drive.transmission_ratio;
            out.tau[j] = ratio * drive.torque_gain * tau_motor + drive.torque_offset;
            let seen = if drive.sensing == SensingSide::Link { 0.0 } else { ratio.recip() };
            let stretch = ratio.recip() - 1.0;
            out.q_lead[j] = seen * q_lead + drive.encoder_offset + stretch * q_now[j];
            out.qd_lead[j] = seen * qd_lead + stretch * qd_now[j];
        }
    }

    /// Friction of the motors that joints share, at the velocities of the motion (N·m or N).
    fn add_shared_friction(&self, qd: &[f64], shared: &mut [f64]) {
        shared.fill(0.0);
        for (j, drive) in self.drives.iter().enumerate() {
            let Some(c) = drive.coupling else { continue };
            let rest = self.rest_speed[j] + c.ratio * self.rest_speed[c.other];
            for (k, way) in [c.ratio, -c.ratio].into_iter().enumerate() {
                let speed = qd[j] + way * qd[c.other];
                let direction = (speed / rest.max(f64::MIN_POSITIVE)).tanh();
                let friction = c.viscous[k] * speed + c.level[k] * direction;
                shared[j] += friction;
                shared[c.other] += way * friction;
            }
        }
    }

    /// Torque of motor `j` in its state `q, qd, qdd` while its link takes `tau_link`
    /// (N·m or N).
    fn motor_torque(&self, j: usize, [q, qd, qdd]: [f64; 3], tau_link: f64) -> f64 {
        let drive = &self.drives[j];
        let direction = self.direction(j, qd);
        let direction = [direction, direction.abs()];
        tau_link + motor_torque(drive, [q, qd, qdd], direction, tau_link, 1.0)
    }

    /// Direction of motion of joint `j`, in [-1, 1].
    fn direction(&self, j: usize, qd: f64) -> f64 {
        (qd / self.rest_speed[j].max(f64::MIN_POSITIVE)).tanh()
    }
}

#[cfg(test)]
#[allow(clippy::float_cmp, reason = "the same arithmetic gives the same bits")]
mod tests {
    use std::f64::consts::TAU;

    use proptest::prelude::*;
    use robot::{FrictionWave, Ripple, Robot, Stribeck};

    use super::*;
    use crate::motion::drive::drive_torque;

    const H: f64 = Compensation::SPACING_S;
    const REST: f64 = 0.02;

    /// A hinge at the origin that carries a point of 2 kg at 0.5 m along x; gravity moves it
    /// where the axis lies level.
    fn hinge(axis: &str, describe: impl Fn(&mut Actuator)) -> Robot {
        let mut robot = Robot::from_urdf(&format!(
            r#"<robot name="hinge"><link name="base"/>
            <link name="arm"><inertial><origin xyz="0.5 0 0"/><mass value="2"/>
              <inertia ixx="0" ixy="0" ixz="0" iyy="0" iyz="0" izz="0"/></inertial></link>
            <joint name="joint" type="continuous"><parent link="base"/><child link="arm"/>
              <axis xyz="{axis}"/></joint></robot>"#
        ))
        .unwrap();
        describe(&mut robot.link_mut(0).unwrap().actuator);
        robot
    }

    const INERTIA: f64 = 2.0 * 0.5 * 0.5;
    const WEIGHT: f64 = 2.0 * 9.81 * 0.5;

    /// Everything at once.
    fn wear(a: &mut Actuator) {
        (a.rotor_inertia, a.viscous) = (0.1, 0.3);
        (a.coulomb_forward, a.coulomb_backward) = (0.6, 0.4);
        (a.spring_stiffness, a.spring_rest) = (0.5, 0.2);
        (a.torque_gain, a.torque_offset) = (1.1, 0.05);
        (a.backlash, a.elasticity, a.sensing) = (0.002, Some(500.0), SensingSide::Motor);
    }

    /// Along a motion of one joint, which gives `[q, qd, qdd]` at a time.
    fn along(robot: &Robot, motion: impl Fn(f64) -> [f64; 3], time_s: f64) -> [f64; 3] {
        let compensation = Compensation::new(robot, vec![REST]);
        let mut out = FeedforwardEfforts::zero(1);
        let side = i32::try_from(compensation.state_count() / 2).unwrap();
        let at = |k: i32| motion(time_s + f64::from(k) * H);
        let states: Vec<[f64; 3]> = (-side..=side).map(at).collect();
        let states: Vec<[&[f64]; 3]> =
            states.iter().map(|s| [0, 1, 2].map(|i| &s[i..=i])).collect();
        compensation.fill(&mut compensation.workspace(), &states, &mut out);
        [out.tau[0], out.q_lead[0], out.qd_lead[0]]
    }

    fn sine(amplitude: f64, omega: f64) -> impl Fn(f64) -> [f64; 3] {
        move |t| {
            let (sin, cos) = (omega * t).sin_cos();
            [sin, omega * cos, -omega * omega * sin].map(|x| amplitude * x)
        }
    }

    /// A link on a spring follows `A sin(w t)` when the motor does
    ///
    /// ```text
    /// q_motor = A (1 - I w² / k) sin(w t)
    /// tau     = -w² (I A + J A (1 - I w² / k)) sin(w t) + b w A (1 - I w² / k) cos(w t)
    /// ```
    #[test]
    fn a_link_on_a_spring_under_a_sine_gets_the_torque_of_the_closed_form() {
        let (rotor, viscous, stiffness, amplitude) = (0.1, 0.3, 500.0, 0.4);
        let wheel = hinge("0 0 1", |a| {
            (a.rotor_inertia, a.viscous, a.elasticity) = (rotor, viscous, Some(stiffness));
        });
        for omega in [1.0, 10.0, 30.0] {
            let motor = amplitude * (1.0 - INERTIA * omega * omega / stiffness);
            // What central differences take off the twist.
            let share = (omega * H).powi(2) / 6.0 + 1e-9;
            let twist = (motor - amplitude).abs();
            for step in 0..40 {
                let t = 0.05 * f64::from(step) / omega * TAU;
                let (sin, cos) = (omega * t).sin_cos();
                let [tau, lead, lead_rate] = along(&wheel, sine(amplitude, omega), t);
                let inertial = -omega * omega * (INERTIA * amplitude + rotor * motor) * sin;
                let expected = inertial + viscous * omega * motor * cos;
                let allowed = share * twist * (rotor * omega * omega + viscous * omega);
                assert!((tau - expected).abs() <= allowed, "{tau}, not {expected}, at {omega}");
                assert!((lead - (motor - amplitude) * sin).abs() < 1e-12);
                let rate = omega * (motor - amplitude) * cos;
                assert!((lead_rate - rate).abs() <= share * omega * twist, "{lead_rate}, {rate}");
            }
        }
    }

    /// Held level, at `mgl / I = g / l` times the acceleration at which a load counts.
    #[test]
    fn a_motor_leads_by_half_the_gap_and_the_twist_on_the_side_of_the_load() {
        // A positive turn about y lowers x, so the load is negative.
        for (axis, side) in [("0 1 0", -1.0), ("0 -1 0", 1.0)] {
            let at_rest = |_| [0.0; 3];
            let play = hinge(axis, |a| a.backlash = 0.004);
            let [tau, lead, rate] = along(&play, at_rest, 0.0);
            assert!((tau - side * WEIGHT).abs() < 1e-12, "{tau}");
            assert!((lead - side * 0.002).abs() < 1e-12 && rate.abs() < 1e-12, "{lead}, {rate}");
            let both = hinge(axis, |a| (a.backlash, a.elasticity) = (0.004, Some(500.0)));
            let [_, lead, _] = along(&both, at_rest, 0.0);
            assert!((lead - side * (0.002 + WEIGHT / 500.0)).abs() < 1e-12, "{lead}");
        }
    }

    #[test]
    fn where_the_link_is_measured_nothing_leads_and_the_torque_stays() {
        let motor = hinge("0 1 0", wear);
        let mut link = motor.clone();
        link.link_mut(0).unwrap().actuator.sensing = SensingSide::Link;
        let mut unknown = motor.clone();
        unknown.link_mut(0).unwrap().actuator.sensing = SensingSide::Unknown;
        let of = |robot| along(robot, sine(0.4, 8.0), 0.13);
        let [tau, lead, rate] = of(&motor);
        assert!(lead.abs() > 1e-3 && rate.abs() > 1e-3);
        assert_eq!(of(&link), [tau, 0.0, 0.0]);
        assert_eq!(of(&unknown), [tau, lead, rate]);
    }

    #[test]
    fn a_rigid_robot_gets_inverse_dynamics_and_the_law_of_its_drive() {
        let robot = hinge("0 1 0", |a| {
            wear(a);
            (a.backlash, a.elasticity) = (0.0, None);
        });
        assert_eq!(Compensation::new(&robot, vec![REST]).state_count(), 1);
        for t in [0.0, 0.1, 0.196, 0.3, 0.7] {
            let [q, qd, qdd] = sine(0.4, 8.0)(t);
            let rigid_body = INERTIA * qdd - WEIGHT * q.cos();
            let drive = &robot.links()[0].actuator;
            let direction = (qd / REST).tanh();
            let torque = rigid_body + drive_torque(drive, [q, qd, qdd], direction, rigid_body);
            let [tau, lead, rate] = along(&robot, sine(0.4, 8.0), t);
            assert!((tau - (1.1 * torque + 0.05)).abs() < 1e-12, "{tau} at {t} s");
            assert_eq!([lead, rate], [0.0; 2]);
        }
    }

    /// Held against its weight and a cable, together `w`, while it creeps: with `x = periods q + phase`,
    ///
    /// ```text
    /// tau = w + (coulomb (1 + share cos(x)) + excess exp(-(qd / velocity)²) + c |w|) direction
    ///       + amplitude sin(x)
    /// ```
    #[test]
    fn cables_friction_beyond_the_coulomb_level_and_ripple_are_asked_for_as_the_closed_form_says() {
        let robot = hinge("0 1 0", |a| {
            (a.coulomb_forward, a.coulomb_backward) = (0.6, 0.4);
            a.stribeck = Some(Stribeck { excess: 0.3, velocity: 0.05 });
            a.load_friction = 0.04;
            (a.spring_stiffness, a.spring_rest) = (2.0, 0.1);
            (a.spring_cubic, a.spring_hysteresis) = (0.5, 0.15);
            a.friction_wave = Some(FrictionWave { share: 0.3, periods: 3.0, phase: 0.5 });
            a.ripple = Some(Ripple { amplitude: 0.2, periods: 40.0, phase: -1.0 });
        });
        for qd in [-0.2_f64, -0.01, 0.0, 0.01, 0.2] {
            let q = 0.7_f64;
            let direction = (qd / REST).tanh();
            let load = -WEIGHT * q.cos() + 2.0 * 0.6 + 0.5 * 0.6_f64.powi(3) + 0.15 * direction;
            let coulomb = if qd > 0.0 { 0.6 } else { 0.4 };
            let level = coulomb * (1.0 + 0.3 * (3.0 * q + 0.5).cos())
                + 0.3 * (-(qd / 0.05).powi(2)).exp()
                + 0.04 * load.abs();
            let expected = load + level * direction + 0.2 * (40.0 * q - 1.0).sin();
            let [tau, ..] = along(&robot, |_| [q, qd, 0.0], 0.0);
            assert!((tau - expected).abs() < 1e-12, "{tau}, not {expected}, at {qd} rad/s");
        }
    }

    /// A wheel needs `tau = -I A w² sin(w t)` and behind a lag `T` has to be asked for
    /// `tau + T d(tau)/dt`; on a spring as well, where the motor's way is `1 - I w² / k` of it.
    #[test]
    fn a_torque_that_lags_is_asked_for_with_its_rate() {
        let (lag, amplitude, rotor, stiffness) = (0.004, 0.4, 0.1, 500.0);
        for elasticity in [None, Some(stiffness)] {
            let wheel = hinge("0 0 1", |a| {
                (a.lag_s, a.rotor_inertia, a.elasticity) = (lag, rotor, elasticity);
            });
            let needed = if elasticity.is_none() { 3 } else { 5 };
            assert_eq!(Compensation::new(&wheel, vec![REST]).state_count(), needed);
            for omega in [1.0, 10.0, 30.0] {
                let motor = 1.0 - elasticity.map_or(0.0, |k| INERTIA * omega * omega / k);
                let peak = -omega * omega * amplitude * (INERTIA + rotor * motor);
                for step in 0..20 {
                    let t = 0.1 * f64::from(step) / omega * TAU;
                    let (sin, cos) = (omega * t).sin_cos();
                    let expected = peak * (sin + lag * omega * cos);
                    let [tau, ..] = along(&wheel, sine(amplitude, omega), t);
                    // What central differences take off.
                    let allowed = peak.abs() * (omega * H).powi(2) / 6.0 + 1e-9;
                    assert!((tau - expected).abs() <= allowed, "{tau}, not {expected}");
                }
            }
        }
    }

    /// The motor is to stand at `q + twist` where its encoder says `(q + twist) / ratio + offset`.
    #[test]
    fn an_encoder_that_errs_is_led_to_what_it_says_of_the_motion() {
        let (ratio, offset, stiffness) = (1.25, 0.1, 500.0);
        for (sensing, share) in [(SensingSide::Motor, 1.0), (SensingSide::Link, 0.0)] {
            let robot = hinge("0 1 0", |a| {
                (a.transmission_ratio, a.encoder_offset) = (ratio, offset);
                (a.elasticity, a.sensing) = (Some(stiffness), sensing);
            });
            assert!(Compensation::new(&robot, vec![REST]).leads());
            let (q, qd) = (0.7_f64, 0.3);
            let load = -WEIGHT * q.cos();
            let [tau, q_lead, qd_lead] = along(&robot, |t| [q + qd * t, qd, 0.0], 0.0);
            let said = (q + share * load / stiffness) / ratio + offset;
            assert!((q_lead - (said - q)).abs() < 1e-12, "{q_lead}");
            let load_rate = WEIGHT * q.sin() * qd;
            let rate = (qd + share * load_rate / stiffness) / ratio;
            assert!((qd_lead - (rate - qd)).abs() < 1e-6, "{qd_lead}");
            assert!((tau - ratio * load).abs() < 1e-9, "{tau}");
        }
        assert!(!Compensation::new(&hinge("0 1 0", |a| a.lag_s = 0.01), vec![REST]).leads());
    }

    /// Ten times finer steps make the largest change ten times smaller: there is no jump.
    #[test]
    fn nothing_jumps_along_a_fast_sine() {
        let robot = hinge("0 1 0", wear);
        // It passes the vertical, where gravity changes its side of the gap.
        let swing = |t: f64| {
            let [q, qd, qdd] = sine(1.0, 6.0)(t);
            [q + 0.5 * std::f64::consts::PI, qd, qdd]
        };
        let largest = |dt: f64| {
            let steps = (1.2 / dt) as u32;
            let mut before = along(&robot, swing, 0.0);
            let mut largest = [0.0_f64; 3];
            for step in 1..=steps {
                let now = along(&robot, swing, dt * f64::from(step));
                for i in 0..3 {
                    largest[i] = largest[i].max((now[i] - before[i]).abs());
                }
                before = now;
            }
            largest
        };
        let (coarse, fine) = (largest(1e-4), largest(1e-5));
        for i in 0..3 {
            assert!(fine[i] > 0.0 && fine[i] < 0.11 * coarse[i], "{coarse:?}, {fine:?}");
        }
    }

    proptest! {
        #[test]
        fn friction_and_leads_are_bounded_by_their_causes(
            states in prop::array::uniform3(prop::array::uniform3(-20.0..20.0f64)),
            gap in 0.0..0.5f64,
            stiffness in prop::option::of(1.0..1e5f64),
            level in prop::array::uniform2(0.0..50.0f64),
        ) {
            let smooth = hinge("0 1 0", |a| (a.backlash, a.elasticity) = (gap, stiffness));
            let rough = hinge("0 1 0", |a| {
                (a.backlash, a.elasticity) = (gap, stiffness);
                [a.coulomb_forward, a.coulomb_backward] = level;
            });
            let at = |t: f64| states[(1.0 + t / H).round() as usize];
            let [q, _, qdd] = states[1];
            let load = INERTIA * qdd - WEIGHT * q.cos();
            let [tau, lead, rate] = along(&smooth, at, 0.0);
            let most = 0.5 * gap + stiffness.map_or(0.0, |k| load.abs() / k);
            prop_assert!(lead.abs() <= most * (1.0 + 1e-12) && rate.is_finite());
            prop_assert!(lead * load >= 0.0);
            let friction = along(&rough, at, 0.0)[0] - tau;
            let rounding = 1e-12 * (1.0 + tau.abs());
            prop_assert!(friction <= level[0] + rounding && -friction <= level[1] + rounding);
        }
    }
}
