use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::error::MotionError;
use crate::knots::Knots;
use crate::motion::ClockedCurve;
use crate::site::Site;
use crate::spec::defaults::ByJoint;

/// Rest in a posture.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Hold {
    /// Positions of the joints.
    #[serde(default, skip_serializing_if = "ByJoint::is_empty")]
    pub posture_rad: ByJoint,
    /// Length of the motion (s).
    pub duration_s: f64,
}

impl Hold {
    pub(super) fn parts(&self, site: &Site) -> Result<Vec<ClockedCurve>, MotionError> {
        site.duration(self.duration_s)?;
        let mut knots = Knots::at_rest(site.posture("posture_rad", &self.posture_rad)?);
        knots.hold(self.duration_s);
        site.evenly(knots)
    }
}
