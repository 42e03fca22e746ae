use std::collections::BTreeMap;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::error::{LimitedQuantity, MotionError};
use crate::knots::{Knots, blend_s, fastest, glide_s};
use crate::motion::ClockedCurve;
use crate::site::{LONGEST_S, Site, above, above_up_to};
use crate::spec::defaults::{ByJoint, four_fifths};

/// One joint after the other back and forth over its range, once at each constant speed,
/// while the others rest.
///
/// A joint leaves its posture for the low end, goes up and down again at every speed in
/// turn, and returns.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Sweep {
    /// The speeds, at least one.
    pub speeds_rad_per_s: Vec<f64>,
    /// The joints in turn; all of the robot's by default.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub joints: Option<Vec<String>>,
    /// Low and high end of joints that are not to use their share. Needed where a joint has
    /// no position limits.
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    pub range_rad: BTreeMap<String, [f64; 2]>,
    /// Positions of the joints that rest.
    #[serde(default, skip_serializing_if = "ByJoint::is_empty")]
    pub posture_rad: ByJoint,
    /// Largest acceleration, where the motion starts and turns.
    #[serde(default = "two")]
    pub acceleration_rad_per_s2: f64,
    /// Rest at both ends of every stroke (s).
    #[serde(default)]
    pub dwell_s: f64,
    /// Share of the position range, about its middle, that is swept.
    #[serde(default = "four_fifths")]
    pub position_share: f64,
}

fn two() -> f64 {
    2.0
}

impl Sweep {
    pub(super) fn parts(&self, site: &Site) -> Result<Vec<ClockedCurve>, MotionError> {
        self.check(site)?;
        let posture = site.posture("posture_rad", &self.posture_rad)?;
        let given = site.by_index("range_rad", &self.range_rad)?;
        let mut knots = Knots::at_rest(posture.clone());
        for index in self.order(site)? {
            let range = match given[index] {
                Some(&[low, high]) => [low, high],
                None => self.shared_range(site, index)?,
            };
            self.sweep(site, &mut knots, &posture, index, range)?;
        }
        site.evenly(knots)
    }

    fn check(&self, site: &Site) -> Result<(), MotionError> {
        if self.speeds_rad_per_s.is_empty() {
            return Err(MotionError::WrongLength {
                key: site.key(&["speeds_rad_per_s"]),
                found: 0,
                expected: "at least 1 was".to_owned(),
            });
        }
        for (k, &speed) in self.speeds_rad_per_s.iter().enumerate() {
            site.number(&["speeds_rad_per_s", &k.to_string()], speed, above(0.0))?;
        }
        site.number(&["acceleration_rad_per_s2"], self.acceleration_rad_per_s2, above(0.0))?;
        site.number(&["dwell_s"], self.dwell_s, 0.0..=LONGEST_S)?;
        site.share("position_share", self.position_share)?;
        for (joint, &[low, high]) in &self.range_rad {
            site.number(&["range_rad", joint, "0"], low, ..)?;
            site.number(&["range_rad", joint, "1"], high, above(low))?;
        }
        Ok(())
    }

    fn order(&self, site: &Site) -> Result<Vec<usize>, MotionError> {
        let Some(names) = &self.joints else { return Ok((0..site.robot.joint_count()).collect()) };
        let index = |(k, name): (usize, &String)| {
            let unknown = |error| match error {
                MotionError::UnknownJoint { joint, expected, .. } => {
                    let key = site.key(&["joints", &k.to_string()]);
                    MotionError::UnknownJoint { key, joint, expected }
                }
                other => other,
            };
            site.joint_index("joints", name).map_err(unknown)
        };
        names.iter().enumerate().map(index).collect()
    }

    fn shared_range(&self, site: &Site, index: usize) -> Result<[f64; 2], MotionError> {
        let joint = site.joint(index);
        let (low, high) = joint.limits.position.ok_or_else(|| MotionError::Missing {
            key: site.key(&["range_rad", &joint.name]),
            joint: joint.name.clone(),
            limit: LimitedQuantity::Position,
        })?;
        let (middle, half) = (0.5 * (low + high), 0.5 * (high - low) * self.position_share);
        Ok([middle - half, middle + half])
    }

    fn sweep(
        &self,
        site: &Site,
        knots: &mut Knots,
        posture: &[f64],
        joint: usize,
        [low, high]: [f64; 2],
    ) -> Result<(), MotionError> {
        let with = |position: f64| {
            let mut posture = posture.to_vec();
            posture[joint] = position;
            posture
        };
        let (most, start) = (self.acceleration_rad_per_s2, posture[joint]);
        let slowest = self.speeds_rad_per_s.iter().copied().fold(f64::INFINITY, f64::min);
        let to_start = glide_s((start - low).abs(), slowest, most);
        knots.glide(&with(low), to_start);
        knots.hold(self.dwell_s);
        for (k, &speed) in self.speeds_rad_per_s.iter().enumerate() {
            // What is left of the way at constant speed: distance - speed blend, not below 0.
            let highest = fastest(high - low, most);
            site.number(&["speeds_rad_per_s", &k.to_string()], speed, above_up_to(0.0, highest))?;
            let blend = blend_s(speed, most);
            let duration = (high - low) / speed + blend;
            for end in [high, low] {
                knots.stroke(&with(end), duration, blend);
                knots.hold(self.dwell_s);
            }
        }
        knots.glide(posture, to_start);
        site.short_enough(&["speeds_rad_per_s"], knots.duration_s())
    }
}
