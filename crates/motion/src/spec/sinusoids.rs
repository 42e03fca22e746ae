use std::f64::consts::TAU;

use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::curve::Curve;
use crate::error::{LimitedQuantity, MotionError};
use crate::extremes::extremes;
use crate::harmonics::{HarmonicSeries, Harmonics, Term};
use crate::motion::ClockedCurve;
use crate::site::{Site, above};
use crate::spec::defaults::{ByJoint, four_fifths, two_seconds};

/// A superposition of sinusoids at every joint, drawn from a seed:
///
/// ```text
/// q_j = centre_j + s_j sum_k a_jk sin(2 pi f_jk t + phi_jk)
/// f in lowest_hz to highest_hz,  a in 1/2 to 1,  phi in 0 to 2 pi, all uniform
/// ```
///
/// `s_j` is as large as the shares of the joint's limits allow, or gives the amplitude
/// asked for. Seed and robot settle the motion; other seeds give other motions of the same
/// kind, such as one for training, one for testing and one for tracking.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Sinusoids {
    /// Seed of frequencies, amplitudes and phases.
    pub seed: u64,
    /// Number of sinusoids at each joint, 1 to 64.
    pub terms: u32,
    /// Lowest frequency (Hz).
    pub lowest_hz: f64,
    /// Highest frequency (Hz), at most 100.
    pub highest_hz: f64,
    /// Length of the motion, fades included (s).
    pub duration_s: f64,
    /// Largest distance from the centre, for joints that are not to use their share; 0 keeps
    /// a joint at rest. Needed where a joint has no position limits.
    #[serde(default, skip_serializing_if = "ByJoint::is_empty")]
    pub amplitude_rad: ByJoint,
    /// Position about which a joint swings; the middle of its range by default.
    #[serde(default, skip_serializing_if = "ByJoint::is_empty")]
    pub centre_rad: ByJoint,
    /// Largest speed of joints whose amplitude is not given, needed where the robot states
    /// no velocity limit.
    #[serde(default, skip_serializing_if = "ByJoint::is_empty")]
    pub max_speed_rad_per_s: ByJoint,
    /// Share of the position range, about its middle, that is used.
    #[serde(default = "four_fifths")]
    pub position_share: f64,
    /// Share of the largest speed that is used.
    #[serde(default = "four_fifths")]
    pub velocity_share: f64,
    /// Time over which the motion starts, and stops, smoothly (s).
    #[serde(default = "two_seconds")]
    pub fade_s: f64,
}

/// Most sinusoids at a joint.
const MOST_TERMS: f64 = 64.0;

impl Sinusoids {
    pub(super) fn parts(&self, site: &Site) -> Result<Vec<ClockedCurve>, MotionError> {
        self.check(site)?;
        let clock = site.clock(self.duration_s, self.fade_s)?;
        let centre = site.posture("centre_rad", &self.centre_rad)?;
        let amplitude = site.by_index("amplitude_rad", &self.amplitude_rad)?;
        let largest = site.by_index("max_speed_rad_per_s", &self.max_speed_rad_per_s)?;
        let mut rng = ChaCha8Rng::seed_from_u64(self.seed);
        let mut joints = Vec::new();
        for (joint, &offset) in centre.iter().enumerate() {
            let unit = self.draw(&mut rng);
            let curve = Curve::Harmonics(Harmonics { joints: vec![unit.clone()] });
            let found = extremes(&curve, 0, clock.run_s());
            let speed = found.fastest.value.abs();
            let reach = found.highest.value.max(-found.lowest.value);
            let scale = match amplitude[joint] {
                Some(&amplitude) => {
                    let scale = amplitude / reach;
                    if let Some(&asked) = largest[joint] {
                        let place = ["max_speed_rad_per_s", &site.joint(joint).name];
                        site.number(&place, asked, scale * speed..)?;
                    }
                    scale
                }
                None => {
                    let room = self.room(site, joint, offset)?;
                    let highest = self.highest_speed(site, joint, largest[joint])?;
                    (room / reach).min(highest / speed)
                }
            };
            joints.push(HarmonicSeries { offset, ..unit.times(scale) });
        }
        site.part(Curve::Harmonics(Harmonics { joints }), clock)
    }

    fn check(&self, site: &Site) -> Result<(), MotionError> {
        site.number(&["terms"], f64::from(self.terms), 1.0..=MOST_TERMS)?;
        site.duration(self.duration_s)?;
        site.frequency("lowest_hz", self.lowest_hz, self.duration_s)?;
        site.frequency("highest_hz", self.highest_hz, self.duration_s)?;
        site.number(&["highest_hz"], self.highest_hz, self.lowest_hz..)?;
        site.share("position_share", self.position_share)?;
        site.share("velocity_share", self.velocity_share)?;
        for (joint, &value) in &self.amplitude_rad {
            site.number(&["amplitude_rad", joint], value, 0.0..)?;
        }
        let speeds = &mut self.max_speed_rad_per_s.iter();
        speeds
            .try_for_each(|(joint, &v)| site.number(&["max_speed_rad_per_s", joint], v, above(0.0)))
    }

    fn draw(&self, rng: &mut ChaCha8Rng) -> HarmonicSeries {
        let mut term = || {
            let hz = rng.random_range(self.lowest_hz..=self.highest_hz);
            let (sin, cos) = rng.random_range(0.0..TAU).sin_cos();
            let amplitude: f64 = rng.random_range(0.5..1.0);
            Term { hz, sin: amplitude * cos, cos: amplitude * sin }
        };
        HarmonicSeries { offset: 0.0, terms: (0..self.terms).map(|_| term()).collect() }
    }

    /// How far a joint may swing about its centre (rad or m).
    fn room(&self, site: &Site, index: usize, centre: f64) -> Result<f64, MotionError> {
        let joint = site.joint(index);
        let Some((low, high)) = joint.limits.position else {
            return Err(missing(site, "amplitude_rad", index, LimitedQuantity::Position));
        };
        let (middle, half) = (0.5 * (low + high), 0.5 * (high - low) * self.position_share);
        site.number(&["centre_rad", &joint.name], centre, middle - half..=middle + half)?;
        Ok(half - (centre - middle).abs())
    }

    /// How fast a joint may go (rad/s or m/s).
    fn highest_speed(
        &self,
        site: &Site,
        index: usize,
        largest: Option<&f64>,
    ) -> Result<f64, MotionError> {
        let own = site.joint(index).limits.velocity.map(|limit| self.velocity_share * limit);
        let asked = largest.copied();
        let lowest = own.into_iter().chain(asked).reduce(f64::min);
        lowest.ok_or_else(|| missing(site, "max_speed_rad_per_s", index, LimitedQuantity::Velocity))
    }
}

fn missing(site: &Site, key: &str, joint: usize, limit: LimitedQuantity) -> MotionError {
    let joint = site.joint(joint).name.clone();
    MotionError::Missing { key: site.key(&[key, &joint]), joint, limit }
}
