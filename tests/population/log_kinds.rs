//! Logs as users bring them: what each kind of log is, seen through the files of a trial.

use std::collections::BTreeMap;
use std::fs::File;
use std::path::{Path, PathBuf};

use arrow_array::RecordBatch;
use arrow_array::cast::AsArray;
use arrow_array::types::Float64Type;
use catalogue::EffectKind;
use logs::{ReadOptions, Run, read_run};
use parquet::arrow::arrow_reader::ParquetRecordBatchReaderBuilder;
use population::{
    ArmClass, LogDamageSpec, LogKind, LogKindSpec, PopulationSpec, ServoShareSpec, TrueCause,
    TruthSheet, damage_logs, make,
};
use robot::{Loaded, Robot};

use crate::made::{files, short};

/// Short trials of cobots whose logs are all of a kind.
fn of_kind(kind: LogKind, size: Option<f64>) -> PopulationSpec {
    let spec = short(ArmClass::Cobot, [0, 0]);
    PopulationSpec {
        logs: [2, 2],
        strangers: 0.0,
        log_kinds: BTreeMap::from([(kind, LogKindSpec { share: 1.0, size })]),
        ..spec
    }
}

fn servos(delay_ms: f64) -> PopulationSpec {
    let spec = short(ArmClass::Hobby, [0, 0]);
    let servos = ServoShareSpec { share: 1.0, delay_ms: [delay_ms; 2] };
    PopulationSpec { strangers: 0.0, servos: Some(servos), ..spec }
}

struct Made {
    folder: tempfile::TempDir,
    sheet: TruthSheet,
}

impl Made {
    fn new(spec: &PopulationSpec, seed: u64) -> Self {
        let folder = tempfile::tempdir().unwrap();
        let sheet = make(spec, seed, folder.path()).unwrap();
        Self { folder, sheet }
    }

    fn nominal(&self) -> Loaded {
        Robot::load(&self.folder.path().join("nominal/robot.toml")).unwrap()
    }

    fn log(&self, k: usize) -> PathBuf {
        self.folder.path().join(format!("logs/log_{k}.parquet"))
    }

    fn runs(&self, robot: &Robot) -> Vec<Run> {
        let read = |k| read_run(&self.log(k), robot, &ReadOptions::default()).unwrap();
        (1..=self.sheet.corner.logs).map(read).collect()
    }
}

/// A kind that is drawn with a share of zero, and one that never comes, change no byte.
#[test]
fn shares_of_zero_change_nothing() {
    let without = short(ArmClass::Cobot, [1, 1]);
    let kinds = LogKind::ALL.iter().map(|kind| (*kind, LogKindSpec { share: 0.0, size: None }));
    let servos = Some(ServoShareSpec { share: 0.0, delay_ms: [0.0, 60.0] });
    let with = PopulationSpec { log_kinds: kinds.collect(), servos, ..without.clone() };
    let [a, b] = [&without, &with].map(|spec| files(Made::new(spec, 11).folder.path()));
    assert_eq!(a.keys().collect::<Vec<_>>(), b.keys().collect::<Vec<_>>());
    // The path of the folder is no part of any file.
    assert!(a.iter().all(|(name, bytes)| b[name] == *bytes));
}

#[test]
fn slow_logs_are_of_20_to_50_hz() {
    let made = Made::new(&of_kind(LogKind::LowRate, None), 2);
    let rate_hz = made.sheet.corner.rate_hz;
    assert!((15.0..=65.0).contains(&rate_hz), "{rate_hz}");
    assert_eq!(made.sheet.corner.log_kinds, [LogKind::LowRate]);
    assert!(made.sheet.strangers.is_empty());
    let run = &made.runs(&made.nominal().robot)[0];
    let found = (run.time.len() - 1) as f64 / (run.time[run.time.len() - 1] - run.time[0]);
    assert!((found / rate_hz - 1.0).abs() < 0.06, "{found} Hz, {rate_hz} Hz in the sheet");
}

#[test]
fn logs_without_noise_are_those_of_the_simulation() {
    let made = Made::new(&of_kind(LogKind::NoNoise, None), 4);
    assert_eq!(made.sheet.corner.log_kinds, [LogKind::NoNoise]);
    assert!(made.sheet.corner.encoder_step <= 0.0);
    // Without steps hardly any two rows of a joint that moves are alike.
    let run = &made.runs(&made.nominal().robot)[0];
    let moves = |q: &&Vec<f64>| (q[0] - q[q.len() / 2]).abs() > 0.01;
    let q = run.joints.iter().map(|joint| &joint.position).find(moves).unwrap();
    let steps: Vec<f64> = q.windows(3).map(|q| q[2] - 2.0 * q[1] + q[0]).collect();
    let rough = steps.windows(2).filter(|s| s[0] * s[1] < 0.0).count();
    assert!(rough * 10 < steps.len(), "{rough} of {} second differences turn", steps.len());
}

#[test]
fn a_spoilt_log_is_told_in_the_sheet_with_its_joints_and_size() {
    let made = Made::new(&of_kind(LogKind::EffortZeros, Some(0.2)), 3);
    let stranger = made.sheet.strangers.iter().find(|s| s.spoiling.is_some()).unwrap();
    assert_eq!(stranger.name, "log: zeros in an effort");
    let spoiling = stranger.spoiling.as_ref().unwrap();
    assert_eq!((spoiling.kind, spoiling.size), (LogKind::EffortZeros, Some(0.2)));
    assert!(spoiling.readable && spoiling.joints.len() == 1);
    assert_eq!(stranger.joint.as_ref(), spoiling.joints.first());
    let robot = made.nominal().robot;
    for log in (1..=made.sheet.corner.logs).map(|k| made.log(k)) {
        let effort = column(&log, &spoiling.joints[0], "effort");
        let (zeros, rows) = (zeros(&effort).len() as f64, effort.len() as f64);
        // Four deviations of a binomial count.
        let far = 4.0 * (0.16 * rows).sqrt();
        assert!((zeros - 0.2 * rows).abs() < far, "{zeros} zeros");
        // The reader finds them between efforts of one sign.
        let refused = read_run(&log, &robot, &ReadOptions::default()).unwrap_err().to_string();
        assert!(refused.contains("found 0, but joint"), "{refused}");
    }
}

#[test]
fn the_stated_limit_is_below_the_efforts() {
    let made = Made::new(&of_kind(LogKind::BeyondStatedLimit, Some(0.25)), 5);
    let stranger = made.sheet.strangers.iter().find(|s| s.spoiling.is_some()).unwrap();
    // Nothing is wrong with the efforts themselves.
    assert!(!stranger.strength.visible());
    let robot = made.nominal().robot;
    let joint = robot.joint_index(stranger.joint.as_deref().unwrap()).unwrap();
    let limit = robot.links()[joint].joint.limits.effort.unwrap();
    let efforts = made.runs(&robot);
    let efforts = efforts.iter().flat_map(|run| &run.joints[joint].effort);
    let largest = efforts.fold(0.0, |most: f64, tau| most.max(tau.abs()));
    assert!((largest / limit - 1.25).abs() < 1e-6, "{largest} N m of {limit} N m");
}

/// The loop in robot.toml tells the torque of servos whose goals come on time; goals that come late are a cause, those on time none.
#[test]
fn servos_log_goals_and_positions_alone() {
    let made = Made::new(&servos(40.0), 6);
    assert_eq!(made.sheet.corner.goal_delay_ms, Some(40.0));
    let path = made.folder.path().join("logs/log_1.parquet");
    let robot = made.nominal().robot;
    // Without the loop the efforts are missing.
    let mut plain = robot.clone();
    for j in 0..plain.joint_count() {
        plain.link_mut(j).unwrap().actuator.position_loop = None;
    }
    let refused = read_run(&path, &plain, &ReadOptions::default()).unwrap_err().to_string();
    assert!(refused.contains("effort"), "{refused}");
    let run = read_run(&path, &robot, &ReadOptions::default()).unwrap();
    assert!(run.joints.iter().all(|joint| joint.desired_position.is_some()));
    assert!(run.joints.iter().all(|joint| joint.velocity.is_none()));
    let is_late = |cause: &&TrueCause| cause.truth.effect == EffectKind::GoalDelay;
    let late = made.sheet.causes.iter().find(is_late).unwrap();
    assert!((late.truth.parameters["delay"] - 0.04).abs() < 1e-12);
    assert!(late.strength.torque > 0.02 && late.strength.share <= late.strength.torque + 1e-9);
    let early = Made::new(&servos(0.0), 6);
    assert!(early.sheet.causes.iter().find(is_late).is_none());
}

/// The same rows of a larger share, and nothing else, are spoilt in logs that are there.
#[test]
fn logs_are_spoilt_by_a_share_after_they_are_made() {
    let made = Made::new(&short(ArmClass::Cobot, [0, 0]), 8);
    let to = tempfile::tempdir().unwrap();
    let damage = |size: f64| {
        let spec = LogDamageSpec { kind: LogKind::EffortZeros, size, seed: 1 };
        damage_logs(made.folder.path(), &spec, to.path()).unwrap().unwrap();
        let log = to.path().join("logs/log_1.parquet");
        let of = |signal: &str| -> Vec<Vec<f64>> {
            let robot = made.nominal().robot;
            robot.joint_names().map(|joint| column(&log, joint, signal)).collect()
        };
        [of("effort"), of("position")]
    };
    let [[few, positions], [many, same]] = [0.1, 0.5].map(damage);
    for (few, many) in few.iter().zip(&many) {
        let many = zeros(many);
        assert!(zeros(few).iter().all(|row| many.contains(row)));
    }
    assert_eq!(positions, same);
}

/// The rows in which a signal is zero.
fn zeros(signal: &[f64]) -> Vec<usize> {
    (0..signal.len()).filter(|&row| signal[row].abs() <= 0.0).collect()
}

/// A column of a log as it stands in the file.
fn column(log: &Path, joint: &str, signal: &str) -> Vec<f64> {
    let builder = ParquetRecordBatchReaderBuilder::try_new(File::open(log).unwrap()).unwrap();
    let name = format!("{joint}.{signal}");
    let of_batch = |batch: RecordBatch| -> Vec<f64> {
        batch.column_by_name(&name).unwrap().as_primitive::<Float64Type>().values().to_vec()
    };
    builder.build().unwrap().flat_map(|batch| of_batch(batch.unwrap())).collect()
}
