use std::path::Path;

use serde::{Deserialize, Serialize};
use simulator::Truth;

use crate::corner::Corner;
use crate::error::PopulationError;
use crate::text_file::write_text;

/// What is true of a trial: `sheet.json`, sealed until its logs are diagnosed.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Sheet {
    /// The seed that everything was drawn from.
    pub seed: u64,
    /// Where in the population it lies.
    pub corner: Corner,
    /// Whether `causes` and `strangers` are all there is.
    pub knowledge: Knowledge,
    /// Names of the joints.
    pub joints: Vec<String>,
    /// What torques of each joint count by: RMS of its effort over the logs, at least the deviation of its noise
    /// and a thousandth of the drive's limit (N m or N).
    pub torque_rms: Vec<f64>,
    /// Effects of the catalogue by which the arm differs from its nominal model.
    pub causes: Vec<Cause>,
    /// Effects of no catalogue in the arm.
    pub strangers: Vec<Unnamed>,
}

/// How much of what is in the logs is known.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Knowledge {
    /// All of it.
    Whole,
    /// What was added to a recorded log.
    Added,
    /// Nothing.
    None,
}

/// An effect of the catalogue by which an arm differs from its nominal model.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Cause {
    /// Why it is there.
    pub role: Role,
    /// The effect, its place, and its parameters beyond the nominal model.
    #[serde(flatten)]
    pub truth: Truth,
    /// What an oracle sees of it.
    pub strength: Strength,
}

/// Why a cause is there.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Role {
    /// Everyday friction of a joint.
    Background,
    /// The nominal model errs: a body, a rotor.
    Nominal,
    /// Hidden on purpose.
    Hidden,
}

/// An effect of no catalogue in an arm.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Unnamed {
    /// Its name among the strangers of the simulator.
    pub name: String,
    /// The joint it acts at, where it has one.
    pub joint: Option<String>,
    /// What an oracle sees of it.
    pub strength: Strength,
}

/// What an oracle that knows the true model, the motion and the sensors sees of a cause.
///
/// ```text
/// c_j      the cause's torque at joint j along the motion
/// A w      the best that everything else can do: all other causes; dry and viscous friction, offset and rotor of
///          every joint, of any size; every body, known to a twentieth
/// S_j(f)   spectrum of the torque noise of joint j: sensor, and encoder carried through M_jj (2 pi f)^2
/// sigmas = root of the least sum over f and j of |c_j(f) - A_j(f) w|^2 / S_j(f)   its size over its
///                                                                        Cramer-Rao deviation
/// share  = root of the least mean of the sum over j of (c_j - A_j w)^2 / scale_j^2
/// torque = root of the mean of the sum over j of c_j^2 / scale_j^2
/// ```
///
/// with the scales of [`Sheet::torque_rms`].
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Strength {
    /// Its size over the least standard deviation that an unbiased estimate can have.
    pub sigmas: f64,
    /// The part of its torque that nothing else can stand in for, over the torque of its joints.
    pub share: f64,
    /// Its torque over that of its joints, whatever could stand in for it: the weight of the cause.
    pub torque: f64,
}

impl Strength {
    /// Deviations from which on a cause counts as visible: twice what any test at 1 in 100 needs.
    pub const SIGMAS: f64 = 5.0;

    /// Share of torque from which on a cause counts: what is below is the floor of a trial.
    pub const FLOOR: f64 = 0.02;

    /// Whether an oracle sees it and it is above the floor.
    pub fn visible(&self) -> bool {
        self.sigmas >= Self::SIGMAS && self.share >= Self::FLOOR
    }
}

impl Sheet {
    /// Name of its file.
    pub const FILE: &str = "sheet.json";

    /// Writes it into a folder, whole or not at all.
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
        let text = std::fs::read_to_string(&path).map_err(|e| unreadable(e.to_string()))?;
        serde_json::from_str(&text).map_err(|e| unreadable(e.to_string()))
    }

    /// Whether something that an oracle sees is in the logs.
    pub fn hides(&self) -> bool {
        self.causes.iter().any(|cause| cause.strength.visible())
            || self.strangers.iter().any(|stranger| stranger.strength.visible())
    }
}
