use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::error::MotionError;
use crate::knots::Knots;
use crate::motion::ClockedCurve;
use crate::site::{Site, above_up_to};
use crate::spec::defaults::ByJoint;

/// From one posture to another at constant speed.
///
/// It starts and ends at rest; the velocity rises and falls by `3 u^2 - 2 u^3`.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Ramp {
    /// Positions at the beginning.
    #[serde(default, skip_serializing_if = "ByJoint::is_empty")]
    pub from_rad: ByJoint,
    /// Positions at the end; a joint that is not named keeps its place.
    pub to_rad: ByJoint,
    /// Length of the motion (s).
    pub duration_s: f64,
    /// Time over which the speed rises, and falls (s), at most half of the duration.
    #[serde(default = "half_a_second")]
    pub blend_s: f64,
}

fn half_a_second() -> f64 {
    0.5
}

impl Ramp {
    pub(super) fn parts(&self, site: &Site) -> Result<Vec<ClockedCurve>, MotionError> {
        site.duration(self.duration_s)?;
        site.number(&["blend_s"], self.blend_s, above_up_to(0.0, 0.5 * self.duration_s))?;
        let from = site.posture("from_rad", &self.from_rad)?;
        let mut to = from.clone();
        for (joint, &value) in &self.to_rad {
            site.number(&["to_rad", joint], value, ..)?;
            to[site.joint_index("to_rad", joint)?] = value;
        }
        let mut knots = Knots::at_rest(from);
        knots.stroke(&to, self.duration_s, self.blend_s);
        site.evenly(knots)
    }
}
