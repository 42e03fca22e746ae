use std::collections::BTreeMap;
use std::path::PathBuf;

use document::{Document, DocumentError, KeyPath};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::corner::{ArmClass, MotionClass, Origin};
use crate::instruments::Instruments;
use crate::log_kind::LogKind;
use crate::robot_shares::RobotShares;

/// Version of the draws, the simulator and the oracle, from which logs and sheets follow beside a
/// [`PopulationSpec`].
pub const FORMAT: u32 = 5;

/// Most trials of a population.
const MOST_TRIALS: usize = 1_000_000;
/// Most causes hidden at a time.
const MOST_CAUSES: usize = 6;
/// Most logs of a trial.
const MOST_LOGS: usize = 8;

/// A population of trials: what a workshop varies, and how many are drawn.
///
/// Tasks `0 .. trials` are simulated, the `recorded.trials` after them come from recorded logs, a plain one
/// and two transplants in turn.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct PopulationSpec {
    /// Simulated trials, 1 to 1000000.
    pub trials: usize,
    /// Seed from which, with its number, that of every trial follows.
    #[serde(default)]
    pub seed: u64,
    /// Kinds of arm, each as likely; all of them where it is left out.
    #[serde(default = "all_arms")]
    pub arms: Vec<ArmClass>,
    /// Kinds of motion, each as likely; all of them where it is left out.
    #[serde(default = "all_motions")]
    pub motions: Vec<MotionClass>,
    /// Least and largest number of logs, 1 to 8.
    #[serde(default = "one_to_eight")]
    pub logs: [usize; 2],
    /// Least and largest length of a log (s), 5 to 60.
    #[serde(default = "five_to_sixty")]
    pub log_s: [f64; 2],
    /// Largest length of all logs of a trial together (s), 5 to 480: what a diagnosis costs grows with it.
    #[serde(default = "two_minutes")]
    pub longest_s: f64,
    /// Least and largest number of causes beyond everyday friction, 0 to 6.
    #[serde(default = "none_to_six")]
    pub causes: [usize; 2],
    /// Share of trials in which an effect of no catalogue is hidden too, 0 to 1.
    #[serde(default = "one_in_five")]
    pub strangers: f64,
    /// Share of trials in which nothing above the floor is wrong, 0 to 1.
    #[serde(default = "one_in_ten")]
    pub clean: f64,
    /// Share of trials whose logs are spoilt as loggers spoil them, 0 to 1: a turned sign, another unit, a stuck
    /// encoder.
    #[serde(default = "one_in_ten")]
    pub spoilt: f64,
    /// Shares of trials with what robots in use have and all other draws lack; none where it is left out.
    #[serde(default, skip_serializing_if = "RobotShares::is_none")]
    pub robots: RobotShares,
    /// What logs are read with, in place of what arms of a class have: a ledger of false alarms crosses them.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub instruments: Option<Instruments>,
    /// In what logs differ from usual ones, kind by kind.
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    pub log_kinds: BTreeMap<LogKind, LogKindSpec>,
    /// Hobby arms whose servos follow goals and log no effort; none where it is left out.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub servos: Option<ServoShareSpec>,
    /// Recorded logs, where they are present.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub recorded: Option<RecordedSpec>,
}

/// How often logs are of a kind, and its size.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct LogKindSpec {
    /// Share of trials, 0 to 1. Of kinds that spoil logs a trial has one at most, the first of those drawn, and a
    /// clean one none; zeros, signs and units of efforts are not drawn for servos, which log none.
    pub share: f64,
    /// Its size; drawn where it is left out.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub size: Option<f64>,
}

/// How often an arm has servos that log goals and positions alone, and how late its goals come.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct ServoShareSpec {
    /// Share of trials, 0 to 1.
    pub share: f64,
    /// Least and largest time by which goals come late (ms), 0 to 200; a quarter of the arms has the least.
    #[serde(default = "up_to_60")]
    pub delay_ms: [f64; 2],
}

/// Recorded logs as trials.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct RecordedSpec {
    /// Folder of the recorded logs, relative to this file; without it these trials are left out.
    pub data: PathBuf,
    /// How many.
    pub trials: usize,
}

impl PopulationSpec {
    /// Reads the population at a key of a document, with absolute paths and without recorded trials whose folder
    /// is absent.
    ///
    /// # Errors
    ///
    /// [`DocumentError`] at an impossible value.
    pub fn from_document(
        document: &Document,
        key: &KeyPath,
        mut spec: Self,
    ) -> Result<Self, DocumentError> {
        let check = Check { document, key };
        check.number("trials", spec.trials as f64, [1.0, MOST_TRIALS as f64])?;
        check.not_empty("arms", spec.arms.len())?;
        check.not_empty("motions", spec.motions.len())?;
        check.range("logs", spec.logs.map(|n| n as f64), [1.0, MOST_LOGS as f64])?;
        check.range("log_s", spec.log_s, [5.0, 60.0])?;
        check.number("longest_s", spec.longest_s, [5.0, 480.0])?;
        if spec.longest_s < spec.log_s[0] * spec.logs[0] as f64 {
            let found = format!(
                "{}, at least {} s for {} logs of {} s was expected",
                spec.longest_s,
                spec.log_s[0] * spec.logs[0] as f64,
                spec.logs[0],
                spec.log_s[0]
            );
            return Err(check.mistake("longest_s", found));
        }
        check.range("causes", spec.causes.map(|n| n as f64), [0.0, MOST_CAUSES as f64])?;
        check.number("strangers", spec.strangers, [0.0, 1.0])?;
        check.number("clean", spec.clean, [0.0, 1.0])?;
        check.number("spoilt", spec.spoilt, [0.0, 1.0])?;
        let robots = Check { document, key: &key.clone().key("robots") };
        for (name, share) in spec.robots.by_key() {
            robots.number(name, share, [0.0, 1.0])?;
        }
        spec.instruments.iter().try_for_each(|all| all.check(document, key))?;
        for (kind, log) in &spec.log_kinds {
            let of = |name: &str| format!("log_kinds.{kind}.{name}");
            check.number(&of("share"), log.share, [0.0, 1.0])?;
            match (log.size, kind.sizes()) {
                (Some(size), Some(sizes)) => check.number(&of("size"), size, sizes)?,
                (Some(size), None) => {
                    let found = format!("{size}, no size was expected of {kind}");
                    return Err(check.mistake(&of("size"), found));
                }
                (None, _) => {}
            }
        }
        if let Some(servos) = spec.servos {
            check.number("servos.share", servos.share, [0.0, 1.0])?;
            check.range("servos.delay_ms", servos.delay_ms, [0.0, 200.0])?;
            if servos.share > 0.0 && !spec.arms.contains(&ArmClass::Hobby) {
                let found = "servos of hobby arms, hobby among the arms was expected".to_owned();
                return Err(check.mistake("servos.share", found));
            }
        }
        if let Some(recorded) = &mut spec.recorded {
            let path = key.clone().key("recorded").key("data");
            let folder = document.directory_of(&path).join(&recorded.data);
            recorded.data = folder.canonicalize().unwrap_or(folder);
        }
        spec.recorded = spec.recorded.filter(|recorded| recorded.data.is_dir());
        Ok(spec)
    }

    /// Number of its trials.
    pub fn tasks(&self) -> usize {
        self.trials + self.recorded.as_ref().map_or(0, |recorded| recorded.trials)
    }

    /// Origin of the logs of a task.
    pub fn origin(&self, task: usize) -> Origin {
        match task.checked_sub(self.trials) {
            None => Origin::Simulated,
            Some(number) if number % 3 == 0 => Origin::Recorded,
            Some(_) => Origin::Transplant,
        }
    }

    /// Everything but the seed that determines a simulated trial, as one text. It does not depend on the number
    /// of trials, so that a larger population contains the trials of a smaller one.
    pub(crate) fn draws(&self) -> String {
        let spec = Self { trials: 0, seed: 0, recorded: None, ..self.clone() };
        serde_json::to_string(&spec).unwrap_or_default()
    }

    /// Everything that determines its trials, as one text without paths.
    pub fn identity(&self) -> String {
        let recorded = self.recorded.clone();
        let recorded = recorded.map(|r| RecordedSpec { data: PathBuf::new(), ..r });
        let spec = Self { recorded, ..self.clone() };
        format!("{}\n{}", FORMAT, serde_json::to_string(&spec).unwrap_or_default())
    }
}

/// Checks the values of a population.
struct Check<'a> {
    document: &'a Document,
    key: &'a KeyPath,
}

impl Check<'_> {
    fn mistake(&self, name: &str, found: String) -> DocumentError {
        let key = name.split('.').fold(self.key.clone(), |key, part| key.key(part));
        self.document.mistake(&key, found, None)
    }

    fn number(&self, name: &str, value: f64, [low, high]: [f64; 2]) -> Result<(), DocumentError> {
        if value.is_finite() && (low..=high).contains(&value) {
            return Ok(());
        }
        Err(self.mistake(name, format!("{value}, a number from {low} to {high} was expected")))
    }

    fn range(
        &self,
        name: &str,
        value: [f64; 2],
        [low, high]: [f64; 2],
    ) -> Result<(), DocumentError> {
        let [least, largest] = value;
        if least >= low && least <= largest && largest <= high {
            return Ok(());
        }
        let found = format!(
            "[{least}, {largest}], the least and the largest from {low} to {high} were expected"
        );
        Err(self.mistake(name, found))
    }

    fn not_empty(&self, name: &str, count: usize) -> Result<(), DocumentError> {
        if count > 0 {
            return Ok(());
        }
        Err(self.mistake(name, "nothing, at least one kind was expected".to_owned()))
    }
}

fn all_arms() -> Vec<ArmClass> {
    ArmClass::ALL.to_vec()
}

fn all_motions() -> Vec<MotionClass> {
    MotionClass::ALL.to_vec()
}

fn one_to_eight() -> [usize; 2] {
    [1, MOST_LOGS]
}

fn five_to_sixty() -> [f64; 2] {
    [5.0, 60.0]
}

fn two_minutes() -> f64 {
    120.0
}

fn none_to_six() -> [usize; 2] {
    [0, MOST_CAUSES]
}

fn one_in_five() -> f64 {
    0.2
}

fn one_in_ten() -> f64 {
    0.1
}

fn up_to_60() -> [f64; 2] {
    [0.0, 60.0]
}
