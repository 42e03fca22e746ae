use std::path::Path;

use serde::{Deserialize, Serialize};
use simulator::Truth;

use crate::corner::Corner;
use crate::error::PopulationError;
use crate::log_kind::LogKind;
use crate::text_file::write_text;

/// The truth about a trial, `sheet.json`, kept apart until its logs are diagnosed.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct TruthSheet {
    /// The seed of every draw.
    pub seed: u64,
    /// The class of the trial.
    pub corner: Corner,
    /// Whether `causes` and `strangers` are complete.
    pub knowledge: Knowledge,
    /// Names of the joints.
    pub joints: Vec<String>,
    /// Scale of torques at each joint (N m or N): RMS of its effort over the logs, at least the deviation of its
    /// noise and a thousandth of the drive's limit.
    pub torque_rms: Vec<f64>,
    /// Effects of the catalogue by which the arm differs from its nominal model.
    pub causes: Vec<TrueCause>,
    /// Effects outside the catalogue in the arm.
    pub strangers: Vec<TrueStranger>,
}

/// How much of the causes in the logs is known.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Knowledge {
    /// All causes.
    Whole,
    /// The cause that was added to a recorded log.
    Added,
    /// No cause.
    None,
}

/// An effect of the catalogue by which an arm differs from its nominal model.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct TrueCause {
    /// Why it is there.
    pub role: CauseRole,
    /// The effect, its place, and its parameters beyond the nominal model.
    #[serde(flatten)]
    pub truth: Truth,
    /// How visible it is to an oracle.
    pub strength: Strength,
}

/// Why a cause is there.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum CauseRole {
    /// Everyday friction of a joint.
    Background,
    /// An error of the nominal model: a body, a rotor.
    Nominal,
    /// Hidden on purpose.
    Hidden,
}

/// An effect outside the catalogue in an arm.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct TrueStranger {
    /// Its name among the strangers of the simulator.
    pub name: String,
    /// The joint it acts at, where it has one.
    pub joint: Option<String>,
    /// How visible it is to an oracle.
    pub strength: Strength,
    /// Of what kind it is, where it is not in the arm but in its logs.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub spoiling: Option<LogSpoiling>,
}

/// What spoils the logs of a trial.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct LogSpoiling {
    /// Its kind.
    pub kind: LogKind,
    /// The joints whose signals or description it is in.
    pub joints: Vec<String>,
    /// Its size, as [`LogKind`] says; `None` for the usual one.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub size: Option<f64>,
    /// Whether a program could read the logs rightly all the same: [`LogKind::is_readable`].
    pub readable: bool,
}

/// Visibility of a cause to an oracle that knows the true model, the motion and the sensors.
///
/// ```text
/// c_j      the cause's torque at joint j along the motion
/// A w      the best fit by everything else: all other causes; dry and viscous friction, offset and rotor of
///          every joint, of any size; every body, known to a twentieth
/// S_j(f)   spectrum of the torque noise of joint j: sensor, what gains make of encoder steps in a logged command,
///          and encoder carried through M_jj (2 pi f)^2
/// sigmas = root of the least sum over f and j of |c_j(f) - A_j(f) w|^2 / S_j(f)   its size over its
///                                                                        Cramer-Rao deviation
/// share  = root of the least mean of the sum over j of (c_j - A_j w)^2 / scale_j^2
/// torque = root of the mean of the sum over j of c_j^2 / scale_j^2
/// ```
///
/// with the scales of [`TruthSheet::torque_rms`].
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Strength {
    /// Its size over the least standard deviation that an unbiased estimate can have.
    pub sigmas: f64,
    /// The part of its torque that nothing else can explain, over the torque of its joints.
    pub share: f64,
    /// Its whole torque over that of its joints: the weight of the cause.
    pub torque: f64,
}

impl Strength {
    /// Least `sigmas` of a visible cause: twice that of a test at the level of 1 %.
    pub const SIGMAS: f64 = 5.0;

    /// Least `share` of a visible cause: the floor of a trial.
    pub const FLOOR: f64 = 0.02;

    /// Whether the cause is visible to the oracle and above the floor.
    pub fn visible(&self) -> bool {
        self.sigmas >= Self::SIGMAS && self.share >= Self::FLOOR
    }
}

impl TruthSheet {
    /// Name of its file.
    pub const FILE: &str = "sheet.json";

    /// Writes it into a folder atomically.
    ///
    /// # Errors
    ///
    /// [`PopulationError::Log`] when it cannot be written.
    pub fn write(&self, folder: &Path) -> Result<(), PopulationError> {
        let text = serde_json::to_string_pretty(self).unwrap_or_default() + "\n";
        write_text(&folder.join(Self::FILE), &text)
    }

    /// Opens the sheet of a folder.
    ///
    /// # Errors
    ///
    /// [`PopulationError::UnreadableSheet`].
    pub fn open(folder: &Path) -> Result<Self, PopulationError> {
        let path = folder.join(Self::FILE);
        let unreadable = |reason| PopulationError::UnreadableSheet { path: path.clone(), reason };
        let text = files::text(&path, files::KEPT_BYTES).map_err(|e| unreadable(e.to_string()))?;
        serde_json::from_str(&text).map_err(|e| unreadable(e.to_string()))
    }

    /// Whether the logs contain a visible cause or stranger.
    pub fn hides(&self) -> bool {
        self.causes.iter().any(|cause| cause.strength.visible())
            || self.strangers.iter().any(|stranger| stranger.strength.visible())
    }
}
