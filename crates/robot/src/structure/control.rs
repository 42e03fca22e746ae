use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

/// Gains of the joint controller: `tau = kp error + kd error_rate`.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct PdGain {
    /// Position gain (N·m/rad or N/m).
    pub kp: f64,
    /// Velocity gain (N·m·s/rad or N·s/m).
    pub kd: f64,
}

/// How the real robot is controlled, as far as `robot.toml` says so.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct ControlSettings {
    /// Rate of the control loop (Hz).
    pub rate_hz: Option<f64>,
    /// The gains in use, one entry per joint.
    pub gains: Vec<Option<PdGain>>,
    /// Named sets of gains, each with one entry per joint.
    pub gain_sets: BTreeMap<String, Vec<PdGain>>,
    /// Pairs of joints, by index, that two motors drive together.
    ///
    /// One motor turns with the sum of both joints, the other with their difference. The torque
    /// limit of such a joint holds while the other joint is unloaded. The feasible torques of a pair
    /// form a diamond:
    ///
    /// ```text
    /// |tau_a| / limit_a + |tau_b| / limit_b <= 1
    /// ```
    pub differentials: Vec<[usize; 2]>,
}
