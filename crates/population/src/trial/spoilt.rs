use std::f64::consts::TAU;

use logs::{Channels, Run};
use nalgebra::DMatrix;
use rand::RngExt;
use rand_chacha::ChaCha8Rng;
use robot::Robot;

use crate::moving::body_torque;
use crate::oracle::motion::SeenRun;
use crate::sheet::{Strength, TrueStranger};

/// Periods of a log that a logger holds (s).
const HELD_S: f64 = 1.5;

/// Height of a spike in position (rad or m).
const SPIKE: f64 = 0.05;

/// A fault of a logger or its configuration.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum LogFault {
    /// The effort of a joint has the other sign.
    EffortSign,
    /// Position and velocity of a joint have the other sign.
    PositionSign,
    /// Two joints have each other's effort.
    EffortsExchanged,
    /// Efforts are in mN m.
    EffortUnit,
    /// Efforts are without the torque of gravity, which the controller adds.
    EffortWithoutGravity,
    /// Time is in ms.
    TimeUnit,
    /// Time runs a tenth slower than it should.
    TimeStretched,
    /// An encoder stands still from the middle of a log.
    StuckEncoder,
    /// All signals stand still for 1.5 s while time goes on.
    HeldByLogger,
    /// Five samples of a position are off.
    Spikes,
    /// A position jumps by a turn.
    TurnJump,
}

impl LogFault {
    const ALL: [Self; 11] = [
        Self::EffortSign,
        Self::PositionSign,
        Self::EffortsExchanged,
        Self::EffortUnit,
        Self::EffortWithoutGravity,
        Self::TimeUnit,
        Self::TimeStretched,
        Self::StuckEncoder,
        Self::HeldByLogger,
        Self::Spikes,
        Self::TurnJump,
    ];

    fn name(self) -> &'static str {
        match self {
            Self::EffortSign => "log: effort sign",
            Self::PositionSign => "log: position sign",
            Self::EffortsExchanged => "log: efforts exchanged",
            Self::EffortUnit => "log: effort in mN m",
            Self::EffortWithoutGravity => "log: effort without gravity",
            Self::TimeUnit => "log: time in ms",
            Self::TimeStretched => "log: time stretched",
            Self::StuckEncoder => "log: stuck encoder",
            Self::HeldByLogger => "log: held by logger",
            Self::Spikes => "log: spikes",
            Self::TurnJump => "log: jump by a turn",
        }
    }
}

/// A fault of the logs of a trial, with all that was drawn of it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Spoilt {
    fault: LogFault,
    /// The joint, and another one where there is one.
    joints: [usize; 2],
    /// When it begins, as a share of the first log.
    from: f64,
}

impl Spoilt {
    /// Draws a fault that the arm can have.
    pub fn draw(robot: &Robot, random: &mut ChaCha8Rng) -> Self {
        let count = robot.joint_count();
        let joint = random.random_range(0..count);
        let other = (joint + 1) % count;
        let from = random.random_range(0.3..0.6);
        let mut fault = LogFault::ALL[random.random_range(0..LogFault::ALL.len())];
        if fault == LogFault::EffortsExchanged && count == 1 {
            fault = LogFault::EffortSign;
        }
        Self { fault, joints: [joint, other], from }
    }

    /// Applies the fault: momentary ones to the first log, all others to every log.
    pub fn spoil(&self, robot: &Robot, runs: &mut [Run]) {
        let [own, other] = self.joints;
        for run in runs.iter_mut() {
            let length = run.time.len();
            match self.fault {
                LogFault::EffortSign => efforts(&mut run.joints[own]).for_each(|tau| *tau = -*tau),
                LogFault::PositionSign => {
                    positions_and_derivatives(&mut run.joints[own]).for_each(|x| *x = -*x)
                }
                LogFault::EffortsExchanged => exchange(run, own, other),
                LogFault::EffortUnit => {
                    run.joints.iter_mut().flat_map(efforts).for_each(|tau| *tau *= 1e3);
                }
                LogFault::EffortWithoutGravity => (0..length).for_each(|i| lift(robot, run, i)),
                LogFault::TimeUnit => run.time.iter_mut().for_each(|t| *t *= 1e3),
                LogFault::TimeStretched => run.time.iter_mut().for_each(|t| *t *= 1.1),
                LogFault::StuckEncoder
                | LogFault::HeldByLogger
                | LogFault::Spikes
                | LogFault::TurnJump => {}
            }
        }
        if let Some(first) = runs.first_mut() {
            self.spoil_moments(first);
        }
    }

    fn spoil_moments(&self, run: &mut Run) {
        let from = (self.from * run.time.len() as f64) as usize;
        let joint = self.joints[0];
        match self.fault {
            LogFault::StuckEncoder => {
                let still = run.joints[joint].position[from];
                run.joints[joint].position[from..].fill(still);
                if let Some(velocity) = &mut run.joints[joint].velocity {
                    velocity[from..].fill(0.0);
                }
            }
            LogFault::HeldByLogger => {
                let end = run.time[from] + HELD_S;
                let until = run.time.partition_point(|t| *t < end);
                for signal in run.joints.iter_mut().flat_map(signals) {
                    let still = signal[from];
                    signal[from..until].fill(still);
                }
            }
            LogFault::Spikes => {
                let every = (run.time.len() - from) / 6;
                for k in 1..=5 {
                    run.joints[joint].position[from + k * every] += SPIKE;
                }
            }
            LogFault::TurnJump => {
                run.joints[joint].position[from..].iter_mut().for_each(|q| *q += TAU);
            }
            _ => {}
        }
    }

    /// Its entry in the sheet; `clean` are the logs without noise and without the fault.
    ///
    /// ```text
    /// share = torque = root of the mean of the sum over j of (r_spoilt - r_clean)^2 / scale^2
    /// ```
    ///
    /// with `r` the efforts beyond the bodies along the logged motion. `sigmas` assumes a noise of a hundredth of the
    /// torque in every sample.
    pub fn true_stranger(&self, robot: &Robot, clean: &[Run], scales: &[f64]) -> TrueStranger {
        let mut spoilt = clean.to_vec();
        self.spoil(robot, &mut spoilt);
        let (mut sum, mut count) = (0.0, 0);
        for (clean, spoilt) in clean.iter().zip(&mut spoilt) {
            let before = SeenRun::new(robot, clean);
            spoilt.joints.iter_mut().for_each(|joint| joint.velocity = None);
            let after = SeenRun::thin(robot, spoilt, before.thinned);
            let rows = before.rows().min(after.rows());
            let other: DMatrix<f64> = after.beyond.rows(0, rows) - before.beyond.rows(0, rows);
            for (column, scale) in other.column_iter().zip(scales) {
                sum += column.norm_squared() / (scale * scale);
            }
            count += rows;
        }
        let share = (sum / count.max(1) as f64).sqrt();
        let joint = robot.joint_names().nth(self.joints[0]).map(str::to_owned);
        let sigmas = 100.0 * share * (count as f64).sqrt();
        TrueStranger {
            name: self.fault.name().to_owned(),
            joint: self.at_joint().then_some(joint).flatten(),
            strength: Strength { sigmas, share, torque: share },
        }
    }

    fn at_joint(&self) -> bool {
        !matches!(
            self.fault,
            LogFault::EffortUnit
                | LogFault::EffortWithoutGravity
                | LogFault::TimeUnit
                | LogFault::TimeStretched
                | LogFault::HeldByLogger
        )
    }
}

/// The efforts of a joint, reported and commanded.
fn efforts(joint: &mut Channels) -> impl Iterator<Item = &mut f64> {
    joint.effort.iter_mut().chain(joint.commanded_effort.iter_mut().flatten())
}

/// Position and velocity of a joint, and their references.
fn positions_and_derivatives(joint: &mut Channels) -> impl Iterator<Item = &mut f64> {
    let Channels { position, velocity, desired_position, desired_velocity, .. } = joint;
    let asked = [desired_position, desired_velocity, &mut joint.desired_acceleration];
    let link = joint.link_position.iter_mut().flatten();
    let asked = asked.into_iter().flatten().flatten();
    position.iter_mut().chain(velocity.iter_mut().flatten()).chain(asked).chain(link)
}

/// Every signal of a joint.
fn signals(joint: &mut Channels) -> impl Iterator<Item = &mut Vec<f64>> {
    let Channels { position, effort, velocity, commanded_effort, link_position, .. } = joint;
    [position, effort].into_iter().chain(velocity).chain(commanded_effort).chain(link_position)
}

fn exchange(run: &mut Run, one: usize, other: usize) {
    let of = |joint: &Channels| (joint.effort.clone(), joint.commanded_effort.clone());
    let (a, b) = (of(&run.joints[one]), of(&run.joints[other]));
    (run.joints[one].effort, run.joints[one].commanded_effort) = b;
    (run.joints[other].effort, run.joints[other].commanded_effort) = a;
}

/// Subtracts the torque of gravity from the efforts of a row.
fn lift(robot: &Robot, run: &mut Run, row: usize) {
    let q: Vec<f64> = run.joints.iter().map(|joint| joint.position[row]).collect();
    let rest = vec![0.0; q.len()];
    let mut held = rest.clone();
    body_torque(robot, &q, &rest, &rest, &mut held);
    for (joint, held) in run.joints.iter_mut().zip(held) {
        joint.effort[row] -= held;
        if let Some(commanded) = &mut joint.commanded_effort {
            commanded[row] -= held;
        }
    }
}

#[cfg(test)]
mod tests {
    use rand_chacha::rand_core::SeedableRng;

    use super::*;

    fn pendulum() -> Robot {
        Robot::from_urdf(
            r#"<robot name="arm"><link name="base"/>
            <link name="a"><inertial><origin xyz="0.5 0 0"/><mass value="2"/>
            <inertia ixx="0.01" ixy="0" ixz="0" iyy="0.01" iyz="0" izz="0.02"/></inertial></link>
            <link name="b"><inertial><origin xyz="0.1 0 0"/><mass value="1"/>
            <inertia ixx="0.01" ixy="0" ixz="0" iyy="0.01" iyz="0" izz="0.02"/></inertial></link>
            <joint name="one" type="continuous"><parent link="base"/><child link="a"/><axis xyz="0 -1 0"/></joint>
            <joint name="two" type="continuous"><parent link="a"/><child link="b"/><axis xyz="0 0 1"/></joint>
            </robot>"#,
        )
        .unwrap()
    }

    /// Both joints at rest for 4 s: the first carries `9.81 (2 * 0.5 + 0.1)` N m.
    fn still() -> Run {
        let time: Vec<f64> = (0..400).map(|i| 0.01 * f64::from(i)).collect();
        let joint = |name: &str, effort: f64| Channels {
            name: name.to_owned(),
            position: vec![0.0; 400],
            effort: vec![effort; 400],
            velocity: Some(vec![0.0; 400]),
            ..Channels::default()
        };
        Run {
            name: "run".to_owned(),
            source: Default::default(),
            sha256: String::new(),
            is_torn: false,
            mended: Vec::new(),
            time,
            joints: vec![joint("one", 9.81 * 1.1), joint("two", 0.0)],
            extra: Default::default(),
        }
    }

    fn spoilt(fault: LogFault) -> Run {
        let mut runs = vec![still()];
        Spoilt { fault, joints: [0, 1], from: 0.5 }.spoil(&pendulum(), &mut runs);
        runs.remove(0)
    }

    #[test]
    fn each_fault_does_what_its_name_says() {
        let tau = 9.81 * 1.1;
        assert!((spoilt(LogFault::EffortSign).joints[0].effort[7] + tau).abs() < 1e-12);
        let exchanged = spoilt(LogFault::EffortsExchanged);
        assert!((exchanged.joints[1].effort[7] - tau).abs() < 1e-12);
        assert!(exchanged.joints[0].effort[7].abs() < 1e-12);
        assert!((spoilt(LogFault::EffortUnit).joints[0].effort[7] - 1e3 * tau).abs() < 1e-9);
        assert!(spoilt(LogFault::EffortWithoutGravity).joints[0].effort[7].abs() < 1e-12);
        assert!((spoilt(LogFault::TimeUnit).time[100] - 1e3).abs() < 1e-9);
        assert!((spoilt(LogFault::TimeStretched).time[100] - 1.1).abs() < 1e-12);
        assert!((spoilt(LogFault::TurnJump).joints[0].position[300] - TAU).abs() < 1e-12);
        let spikes =
            spoilt(LogFault::Spikes).joints[0].position.iter().filter(|q| **q > 0.0).count();
        assert_eq!(spikes, 5);
    }

    /// A turned sign is off by twice the torque; nothing is said of the arm's other joint.
    #[test]
    fn a_turned_sign_weighs_twice_the_torque() {
        let fault = Spoilt { fault: LogFault::EffortSign, joints: [0, 1], from: 0.5 };
        let told = fault.true_stranger(&pendulum(), &[still()], &[9.81 * 1.1, 1.0]);
        assert!((told.strength.share - 2.0).abs() < 1e-9, "{}", told.strength.share);
        assert_eq!(told.joint.as_deref(), Some("one"));
        assert!(told.strength.visible());
    }

    #[test]
    fn every_fault_is_drawn() {
        let mut random = ChaCha8Rng::seed_from_u64(1);
        let drawn: Vec<LogFault> =
            (0..300).map(|_| Spoilt::draw(&pendulum(), &mut random).fault).collect();
        assert!(LogFault::ALL.iter().all(|fault| drawn.contains(fault)));
    }
}
