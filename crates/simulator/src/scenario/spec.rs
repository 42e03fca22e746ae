use std::collections::BTreeMap;
use std::path::PathBuf;

use catalogue::EffectKind;
use motion::MotionSpec;
use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde::{Deserialize, Serialize};

use crate::effects::spec::EffectSpec;
use crate::mechanics::step_order::StepOrder;
use crate::sensors::{EffortSource, PositionSide, VelocitySource};
use crate::strangers::spec::StrangerSpec;

/// A scenario: a robot, what is put into it, its sensors and the motions that are logged.
///
/// At a prismatic joint `nm` stands for N, `rad` for m and `kg_m2` for kg.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(title = "Plumbline scenario")]
pub struct ScenarioSpec {
    /// The robot's `robot.toml` or URDF, relative to this file.
    pub robot: PathBuf,
    /// Where every random draw comes from, unless a part has a seed of its own.
    #[serde(default)]
    pub seed: u64,
    /// How the engine is stepped.
    #[serde(default)]
    pub engine: EngineSpec,
    /// The controller that follows the motions.
    #[serde(default)]
    pub control: ControlSpec,
    /// What the log sees.
    #[serde(default)]
    pub sensors: SensorSpec,
    /// Effects put into the arm, each with its parameters.
    #[serde(default)]
    pub effect: Vec<EffectSpec>,
    /// Effects of no catalogue put into the arm, each with its parameters.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub stranger: Vec<StrangerSpec>,
    /// Effects to be drawn, which `truth.json` alone tells.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub hidden: Option<HiddenSpec>,
    /// The runs, each a log.
    pub run: Vec<RunSpec>,
}

/// How the engine is stepped.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct EngineSpec {
    /// Length of a step (ms), 0.001 to 5; a command is held for a whole number of steps.
    pub step_ms: f64,
    /// Whether joints stop at their position limits.
    pub joint_stops: bool,
    /// Power of the step with which the error falls: `first`, or `second`, which takes far fewer steps.
    #[serde(skip_serializing_if = "is_first")]
    pub order: StepOrder,
}

fn is_first(order: &StepOrder) -> bool {
    *order == StepOrder::First
}

impl Default for EngineSpec {
    fn default() -> Self {
        Self { step_ms: 0.1, joint_stops: true, order: StepOrder::First }
    }
}

/// A controller without a model: `tau = kp (q_ref - q) + kd (qd_ref - qd)`, held at its rate.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct ControlSpec {
    /// Rate (Hz); the robot's `control_rate_hz` or else 500 where it is left out.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub rate_hz: Option<f64>,
    /// A set of gains of `robot.toml`; its gains in use where it is left out.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub gains: Option<String>,
    /// Gains of joints that differ from the set (N m/rad).
    #[serde(skip_serializing_if = "BTreeMap::is_empty")]
    pub kp_nm_per_rad: BTreeMap<String, f64>,
    /// Gains of joints that differ from the set (N m s/rad).
    #[serde(skip_serializing_if = "BTreeMap::is_empty")]
    pub kd_nm_s_per_rad: BTreeMap<String, f64>,
    /// The joints are servos that follow goals.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub servo: Option<ServoSpec>,
}

/// Servos: a goal is sent at a rate, held until the next one, and reaches the position loop late.
///
/// ```text
/// goal(t) = q_ref(floor(t rate) / rate)
/// tau     = kp (goal(t - delay) - q) - kd qd
/// ```
///
/// The log has `goal(t)` as the desired position, and no desired velocity or acceleration.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct ServoSpec {
    /// Rate at which goals are sent (Hz), 1 to that of the controller.
    pub goal_rate_hz: f64,
    /// Time from a goal's row in the log to the position loop (ms), 0 to 1000.
    #[serde(default)]
    pub goal_delay_ms: f64,
}

/// What the log sees.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct SensorSpec {
    /// Where position is measured.
    pub position: PositionSide,
    /// What the effort is.
    pub effort: EffortSource,
    /// How velocity comes to be.
    pub velocity: VelocitySource,
    /// Step of the position reading of each joint (rad), none where it is left out.
    #[serde(skip_serializing_if = "BTreeMap::is_empty")]
    pub position_resolution_rad: BTreeMap<String, f64>,
    /// Standard deviation of the position reading of each joint (rad).
    #[serde(skip_serializing_if = "BTreeMap::is_empty")]
    pub position_noise_rad: BTreeMap<String, f64>,
    /// Step of a second encoder, at the link, of each joint that has one (rad); 0 for one
    /// without steps.
    #[serde(skip_serializing_if = "BTreeMap::is_empty")]
    pub link_position_resolution_rad: BTreeMap<String, f64>,
    /// Standard deviation of the reading of a second encoder, at the link, of each joint that
    /// has one (rad).
    #[serde(skip_serializing_if = "BTreeMap::is_empty")]
    pub link_position_noise_rad: BTreeMap<String, f64>,
    /// Standard deviation of the effort reading of each joint (N m).
    #[serde(skip_serializing_if = "BTreeMap::is_empty")]
    pub effort_noise_nm: BTreeMap<String, f64>,
    /// Step of the effort reading of each joint (N m), none where it is left out.
    #[serde(skip_serializing_if = "BTreeMap::is_empty")]
    pub effort_resolution_nm: BTreeMap<String, f64>,
    /// Time by which the readings of the encoders at the links are older than their rows (ms).
    pub link_position_lag_ms: f64,
    /// Whether the log has a velocity.
    pub velocity_logged: Logged,
    /// Stretches of rows that are lost one after the other.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub dropouts: Option<DropoutSpec>,
    /// Rate of the log (Hz), a whole part of the controller's; the controller's where it is left
    /// out.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub log_rate_hz: Option<f64>,
    /// Standard deviation of the time stamps (ms), at most a fifth of the log's period.
    pub time_jitter_ms: f64,
    /// Share of rows that are lost, 0 to 0.5.
    pub dropped_share: f64,
}

impl Default for SensorSpec {
    fn default() -> Self {
        Self {
            position: PositionSide::default(),
            effort: EffortSource::default(),
            velocity: VelocitySource::FilteredDifference { cutoff_hz: 28.6 },
            position_resolution_rad: BTreeMap::new(),
            position_noise_rad: BTreeMap::new(),
            link_position_resolution_rad: BTreeMap::new(),
            link_position_noise_rad: BTreeMap::new(),
            effort_noise_nm: BTreeMap::new(),
            effort_resolution_nm: BTreeMap::new(),
            link_position_lag_ms: 0.0,
            velocity_logged: Logged::default(),
            dropouts: None,
            log_rate_hz: None,
            time_jitter_ms: 0.0,
            dropped_share: 0.0,
        }
    }
}

/// Whether a signal is in the log.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Logged {
    /// It is.
    #[default]
    Yes,
    /// It is not.
    No,
}

/// Stretches of rows that are lost one after the other, at random times.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct DropoutSpec {
    /// How many a minute, on average, 0 to 60.
    pub per_minute: f64,
    /// Length of one (ms), 1 to 2000.
    pub length_ms: f64,
}

/// Effects to be drawn: which, where and how large.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct HiddenSpec {
    /// Least and largest number of effects.
    pub count: [usize; 2],
    /// The effects to draw from; all of them where it is left out.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    #[schemars(schema_with = "kinds_of_effects")]
    pub from: Vec<EffectKind>,
    /// Seed of the draw; the scenario's where it is left out.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub seed: Option<u64>,
    /// Least and largest size: root mean square of the torque that an effect adds over that of
    /// the joint's torque as its sensor reports it, noise included.
    #[serde(default = "usual_share")]
    pub torque_share: [f64; 2],
}

fn kinds_of_effects(_: &mut SchemaGenerator) -> Schema {
    let names = EffectKind::ALL.map(EffectKind::name);
    json_schema!({ "type": "array", "items": { "type": "string", "enum": names } })
}

fn usual_share() -> [f64; 2] {
    [0.03, 0.3]
}

/// A run: one motion, one log.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct RunSpec {
    /// Name of the log's file, without extension.
    pub name: String,
    /// The motion that is followed.
    pub motion: MotionSpec,
    /// Time that the arm is held at the start of the motion before the log begins (s).
    #[serde(default = "usual_lead_in")]
    pub lead_in_s: f64,
    /// Effects put into the arm during this run alone, beside those of the scenario: a payload that changes
    /// between runs.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub effect: Vec<EffectSpec>,
}

fn usual_lead_in() -> f64 {
    1.0
}
