use logs::Run;
use nalgebra::DMatrix;
use rand::RngExt;
use rand_chacha::ChaCha8Rng;
use robot::{Loaded, Robot};

use crate::dice::{between, happens, log_uniform_between};
use crate::error::PopulationError;
use crate::log_kind::LogKind;
use crate::oracle::motion::SeenRun;
use crate::robot_files::RobotFiles;
use crate::sheet::{LogSpoiling, Strength, TrueStranger};
use crate::trial::spoilt::channels::{efforts, exchange_efforts, positions_and_derivatives};
use crate::trial::spoilt::clocks::run_faster;
use crate::trial::spoilt::efforts::{into_amperes, lift, put_spikes, scale_each, zero};
use crate::trial::spoilt::held_values::{repeat, repeat_some};
use crate::trial::spoilt::moments;
use crate::trial::spoilt::normalised_units::normalise;
use crate::trial::spoilt::rows::last_rows;
use crate::trial::spoilt::stated_limit::lower;

/// Rates at which a merged log repeats its messages (Hz).
const REPEATED_HZ: [f64; 2] = [500.0, 1000.0];

/// Share by which all clocks run slow where no size is given.
const SLOW: f64 = 0.1;

/// What is done to the logs of a trial, with all that was drawn of it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct LogDamage {
    /// Of what kind.
    pub kind: LogKind,
    /// The joint, and another one where there is one.
    pub joints: [usize; 2],
    /// When it begins, as a share of the first log.
    pub from: f64,
    /// Its size, as [`LogKind`] says; `None` for the usual one.
    pub size: Option<f64>,
    /// Seed of what is drawn sample by sample.
    pub seed: u64,
}

impl LogDamage {
    /// Draws one of the kinds that [`PopulationSpec::spoilt`](crate::PopulationSpec::spoilt) asks for.
    pub fn draw(robot: &Robot, random: &mut ChaCha8Rng) -> Self {
        let count = robot.joint_count();
        let joint = random.random_range(0..count);
        let from = random.random_range(0.3..0.6);
        let mut kind = LogKind::SPOILT[random.random_range(0..LogKind::SPOILT.len())];
        if kind == LogKind::EffortsExchanged && count == 1 {
            kind = LogKind::EffortSign;
        }
        Self { kind, joints: [joint, (joint + 1) % count], from, size: None, seed: 0 }
    }

    /// Draws damage of a kind, and its size where none is given; `None` where the arm or so many runs cannot have it.
    pub fn of_kind(
        kind: LogKind,
        size: Option<f64>,
        (robot, runs): (&Robot, usize),
        random: &mut ChaCha8Rng,
    ) -> Option<Self> {
        let count = robot.joint_count();
        let joint = random.random_range(0..count);
        let from = random.random_range(0.3..0.6);
        let seed = random.random::<u64>();
        let usual = match kind {
            LogKind::EffortZeros => Some(log_uniform_between(random, [0.001, 0.5])),
            LogKind::BeyondStatedLimit => Some(between(random, [0.05, 0.4])),
            LogKind::OtherClock => {
                let by = between(random, [0.02, 0.2]);
                Some(if happens(random, 0.5) { by } else { -by })
            }
            _ => None,
        };
        let alone = kind == LogKind::EffortsExchanged && count == 1;
        let lacks_runs = kind == LogKind::OtherClock && runs < 2;
        let joints = [joint, (joint + 1) % count];
        (!alone && !lacks_runs).then_some(Self { kind, joints, from, size: size.or(usual), seed })
    }

    /// Applies it: what is momentary to the first log, all else to every log.
    pub fn spoil(&self, robot: &Robot, runs: &mut [Run]) {
        for (number, run) in runs.iter_mut().enumerate() {
            self.spoil_run(robot, run, number as u64);
        }
        if let Some(first) = runs.first_mut() {
            self.spoil_moments(robot, first);
        }
        if let (LogKind::OtherClock, [_, second, ..]) = (self.kind, runs) {
            run_faster(second, 1.0 + self.size.unwrap_or(SLOW), 0);
        }
    }

    /// The description beside the logs, where the damage is in it; `files` are those of `described`.
    pub fn describe(
        &self,
        files: &RobotFiles,
        described: &Loaded,
        runs: &[Run],
    ) -> Result<Option<RobotFiles>, PopulationError> {
        let LogKind::BeyondStatedLimit = self.kind else { return Ok(None) };
        let excess = (self.joints[0], self.size.unwrap_or(0.0));
        lower(files, described, runs, excess).map(Some)
    }

    fn spoil_run(&self, robot: &Robot, run: &mut Run, number: u64) {
        let [own, other] = self.joints;
        let rows = last_rows(run.time.len(), self.size);
        let seed = (self.seed, number);
        match self.kind {
            LogKind::EffortSign => {
                efforts(&mut run.joints[own], rows).for_each(|tau| *tau = -*tau);
            }
            LogKind::PositionSign => {
                positions_and_derivatives(&mut run.joints[own], rows).for_each(|x| *x = -*x);
            }
            LogKind::EffortsExchanged => exchange_efforts(run, own, other, rows),
            LogKind::EffortUnit => {
                let all = run.joints.iter_mut().flat_map(|joint| efforts(joint, rows.clone()));
                all.for_each(|tau| *tau *= 1e3);
            }
            LogKind::EffortWithoutGravity => {
                let share = self.size.unwrap_or(1.0);
                (0..run.time.len()).for_each(|row| lift(robot, run, row, share));
            }
            LogKind::TimeUnit => run_faster(run, 1e3, rows.start),
            LogKind::TimeStretched => run_faster(run, 1.0 + self.size.unwrap_or(SLOW), 0),
            LogKind::EffortZeros => zero(run, own, self.size.unwrap_or(1.0), seed),
            LogKind::EffortWithoutSign => {
                for joint in &mut run.joints {
                    efforts(joint, rows.clone()).for_each(|tau| *tau = tau.abs());
                    joint.commanded_effort = None;
                }
            }
            LogKind::EffortInAmperes => match self.size {
                None => into_amperes(robot, run, self.seed),
                Some(size) => scale_each(run, size, self.seed),
            },
            LogKind::NormalisedUnits => normalise(robot, run),
            LogKind::HeldValues => match self.size {
                None => repeat(run, REPEATED_HZ[(self.seed % 2) as usize]),
                Some(share) => repeat_some(run, share, seed),
            },
            _ => {}
        }
    }

    fn spoil_moments(&self, robot: &Robot, run: &mut Run) {
        let rows = run.time.len();
        let usual = (self.from * rows as f64) as usize;
        let sized = self.size.map(|share| (share * rows as f64).round().max(1.0) as usize);
        let from = sized.map_or(usual, |sized| rows.saturating_sub(sized));
        let joint = self.joints[0];
        match self.kind {
            LogKind::StuckEncoder => moments::stick(run, joint, [from, rows]),
            LogKind::HeldByLogger => {
                let middle = sized.map_or(usual, |sized| rows.saturating_sub(sized) / 2);
                moments::hold(run, middle, sized);
            }
            LogKind::Spikes => match self.size {
                None => moments::put_five_spikes(run, joint, from),
                Some(share) => moments::put_spikes(run, joint, share, self.seed),
            },
            LogKind::TurnJump => moments::turn(run, joint, from),
            LogKind::EffortSpikes => put_spikes(robot, run, joint, self.size, (self.seed, 0)),
            _ => {}
        }
    }

    /// Its entry in the sheet; `clean` are the logs without noise and without the damage.
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
        let sigmas = 100.0 * share * (count as f64).sqrt();
        let spoiling = self.spoiling(robot);
        TrueStranger {
            name: self.kind.stranger().to_owned(),
            joint: spoiling.joints.first().cloned().filter(|_| self.kind.joints().is_some()),
            strength: Strength { sigmas, share, torque: share },
            spoiling: Some(spoiling),
        }
    }

    /// What is known of it.
    pub fn spoiling(&self, robot: &Robot) -> LogSpoiling {
        let name = |joint: &usize| robot.joint_names().nth(*joint).map(str::to_owned);
        let joints = match self.kind.joints() {
            Some(count) => self.joints.iter().take(count).filter_map(name).collect(),
            None => robot.joint_names().map(str::to_owned).collect(),
        };
        LogSpoiling { kind: self.kind, joints, size: self.size, readable: self.kind.is_readable() }
    }
}

#[cfg(test)]
mod tests {
    use std::f64::consts::TAU;

    use logs::Channels;
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

    fn damage(kind: LogKind, size: Option<f64>) -> LogDamage {
        LogDamage { kind, joints: [0, 1], from: 0.5, size, seed: 3 }
    }

    fn spoilt(kind: LogKind) -> Run {
        sized(kind, None)
    }

    fn sized(kind: LogKind, size: Option<f64>) -> Run {
        let mut runs = vec![still()];
        damage(kind, size).spoil(&pendulum(), &mut runs);
        runs.remove(0)
    }

    #[test]
    fn each_fault_does_what_its_name_says() {
        let tau = 9.81 * 1.1;
        assert!((spoilt(LogKind::EffortSign).joints[0].effort[7] + tau).abs() < 1e-12);
        let exchanged = spoilt(LogKind::EffortsExchanged);
        assert!((exchanged.joints[1].effort[7] - tau).abs() < 1e-12);
        assert!(exchanged.joints[0].effort[7].abs() < 1e-12);
        assert!((spoilt(LogKind::EffortUnit).joints[0].effort[7] - 1e3 * tau).abs() < 1e-9);
        assert!(spoilt(LogKind::EffortWithoutGravity).joints[0].effort[7].abs() < 1e-12);
        assert!((spoilt(LogKind::TimeUnit).time[100] - 1e3).abs() < 1e-9);
        assert!((spoilt(LogKind::TimeStretched).time[100] - 1.1).abs() < 1e-12);
        assert!((spoilt(LogKind::TurnJump).joints[0].position[300] - TAU).abs() < 1e-12);
        let spikes =
            spoilt(LogKind::Spikes).joints[0].position.iter().filter(|q| **q > 0.0).count();
        assert_eq!(spikes, 5);
    }

    /// A turned sign is off by twice the torque; nothing is said of the arm's other joint.
    #[test]
    fn a_turned_sign_weighs_twice_the_torque() {
        let scales = [9.81 * 1.1, 1.0];
        let told =
            damage(LogKind::EffortSign, None).true_stranger(&pendulum(), &[still()], &scales);
        assert!((told.strength.share - 2.0).abs() < 1e-9, "{}", told.strength.share);
        assert_eq!(told.joint.as_deref(), Some("one"));
        assert!(told.strength.visible());
    }

    #[test]
    fn every_fault_is_drawn() {
        let mut random = ChaCha8Rng::seed_from_u64(1);
        let drawn: Vec<LogKind> =
            (0..300).map(|_| LogDamage::draw(&pendulum(), &mut random).kind).collect();
        assert!(LogKind::SPOILT.iter().all(|fault| drawn.contains(fault)));
    }

    #[test]
    fn zeros_stand_in_the_share_of_rows_that_is_given() {
        let run = sized(LogKind::EffortZeros, Some(0.25));
        let zeros = run.joints[0].effort.iter().filter(|tau| tau.abs() <= 0.0).count();
        // Four deviations of a binomial count.
        assert!((zeros as f64 - 100.0).abs() < 4.0 * 75_f64.sqrt(), "{zeros}");
        assert_eq!(run.joints[0].position, still().joints[0].position);
    }

    #[test]
    fn single_efforts_are_beyond_the_limit() {
        let run = spoilt(LogKind::EffortSpikes);
        let limit = 1.0;
        let off = run.joints[0].effort.iter().filter(|tau| (**tau - 9.81 * 1.1).abs() > 1e-9);
        let off: Vec<f64> = off.copied().collect();
        assert!((1..=3).contains(&off.len()), "{off:?}");
        assert!(off.iter().all(|tau| tau.abs() >= 1.5 * limit), "{off:?}");
    }

    #[test]
    fn efforts_lose_sign_gravity_and_unit() {
        let tau = 9.81 * 1.1;
        let mut turned = vec![still()];
        turned[0].joints[0].effort.fill(-tau);
        damage(LogKind::EffortWithoutSign, None).spoil(&pendulum(), &mut turned);
        assert!(turned[0].joints[0].effort.iter().all(|x| (x - tau).abs() < 1e-12));
        let half = sized(LogKind::EffortWithoutGravity, Some(0.5));
        assert!((half.joints[0].effort[7] - 0.5 * tau).abs() < 1e-9);
        let amperes = spoilt(LogKind::EffortInAmperes);
        let ratio = amperes.joints[0].effort[0] / tau;
        // A joint without a limit counts as one of 1 N m.
        assert!((2.0..=40.0).contains(&ratio), "{ratio}");
        let off = sized(LogKind::EffortInAmperes, Some(0.1)).joints[0].effort[0] / tau;
        assert!((0.05..=0.1).contains(&(off - 1.0).abs()), "{off}");
    }

    #[test]
    fn only_the_second_run_has_another_clock() {
        let mut runs = vec![still(), still()];
        damage(LogKind::OtherClock, Some(-0.2)).spoil(&pendulum(), &mut runs);
        assert_eq!(runs[0].time, still().time);
        assert!((runs[1].time[100] - 0.8).abs() < 1e-12);
    }

    #[test]
    fn a_size_limits_the_rows_that_are_spoilt() {
        let tau = 9.81 * 1.1;
        let run = sized(LogKind::EffortSign, Some(0.1));
        let turned = run.joints[0].effort.iter().filter(|x| **x < 0.0).count();
        assert_eq!((turned, run.joints[0].effort[359] > 0.0), (40, true));
        let stuck = sized(LogKind::TurnJump, Some(0.1));
        assert_eq!(stuck.joints[0].position.iter().filter(|q| **q > 1.0).count(), 40);
        let unit = sized(LogKind::EffortUnit, Some(0.5));
        assert!((unit.joints[0].effort[0] - tau).abs() < 1e-12);
        assert!((unit.joints[0].effort[399] - 1e3 * tau).abs() < 1e-9);
    }

    /// A ramp of 500 rows a second, whose messages of 100 Hz fill five or ten rows each.
    #[test]
    fn held_values_are_messages_of_100_hz() {
        let mut run = still();
        run.time = (0..400).map(|i| 0.002 * f64::from(i)).collect();
        run.joints[0].position = run.time.clone();
        for (seed, each) in [(4, 5), (3, 10)] {
            let mut runs = vec![run.clone()];
            LogDamage { seed, ..damage(LogKind::HeldValues, None) }.spoil(&pendulum(), &mut runs);
            let held = &runs[0];
            let rate = 100.0 * f64::from(each);
            assert!((held.time[1] - held.time[0] - 1.0 / rate).abs() < 1e-12);
            for (time, q) in held.time.iter().zip(&held.joints[0].position) {
                assert!((q - (time * 100.0 + 1e-6).floor() / 100.0).abs() < 1e-9, "{q} at {time}");
            }
            assert!(held.joints.iter().all(|joint| joint.effort.len() == held.time.len()));
        }
        let mut runs = vec![run.clone()];
        damage(LogKind::HeldValues, Some(0.3)).spoil(&pendulum(), &mut runs);
        let stale = runs[0].joints[0].position.windows(2).filter(|q| q[1] <= q[0]).count();
        assert!((stale as f64 - 120.0).abs() < 4.0 * 84_f64.sqrt(), "{stale}");
    }

    #[test]
    fn normalised_units_are_a_hundred_at_the_ends_of_the_range() {
        let mut run = still();
        run.joints[0].position = vec![std::f64::consts::PI; 400];
        run.joints[0].desired_position = Some(vec![-std::f64::consts::PI; 400]);
        let mut runs = vec![run];
        damage(LogKind::NormalisedUnits, None).spoil(&pendulum(), &mut runs);
        assert!((runs[0].joints[0].position[0] - 100.0).abs() < 1e-9);
        let goal = runs[0].joints[0].desired_position.as_ref().unwrap()[0];
        assert!((goal + 100.0).abs() < 1e-9);
        assert!(runs[0].joints[1].position[0].abs() < 1e-9);
    }
}
