use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::curve::Curve;
use crate::error::MotionError;
use crate::motion::ClockedCurve;
use crate::rising_sine::{Growth, RisingSine};
use crate::site::Site;
use crate::spec::defaults::{ByJoint, two_seconds};

/// Sines in step at one or more joints, whose frequency changes from one end of a band to
/// the other.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Chirp {
    /// Amplitudes of the joints that move.
    pub amplitude_rad: ByJoint,
    /// Positions about which the joints swing or rest.
    #[serde(default, skip_serializing_if = "ByJoint::is_empty")]
    pub posture_rad: ByJoint,
    /// Frequency at the beginning (Hz).
    pub from_hz: f64,
    /// Frequency at the end (Hz), at most 100.
    pub to_hz: f64,
    /// How the frequency changes.
    #[serde(default)]
    pub growth: Growth,
    /// Length of the motion, fades included (s).
    pub duration_s: f64,
    /// Time over which the motion starts, and stops, smoothly (s). The band is passed
    /// between the middles of both.
    #[serde(default = "two_seconds")]
    pub fade_s: f64,
}

impl Chirp {
    pub(super) fn parts(&self, site: &Site) -> Result<Vec<ClockedCurve>, MotionError> {
        site.duration(self.duration_s)?;
        site.frequency("from_hz", self.from_hz, self.duration_s)?;
        site.frequency("to_hz", self.to_hz, self.duration_s)?;
        let clock = site.clock(self.duration_s, self.fade_s)?;
        let centre = site.posture("posture_rad", &self.posture_rad)?;
        let mut amplitude = vec![0.0; centre.len()];
        for (joint, &value) in &self.amplitude_rad {
            site.number(&["amplitude_rad", joint], value, ..)?;
            amplitude[site.joint_index("amplitude_rad", joint)?] = value;
        }
        let sine = RisingSine {
            centre,
            amplitude,
            from_hz: self.from_hz,
            to_hz: self.to_hz,
            over_s: clock.run_s(),
            growth: self.growth,
        };
        site.part(Curve::RisingSine(sine), clock)
    }
}
