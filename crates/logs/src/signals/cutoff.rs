//! The cut-off of the low-pass, chosen from the motion and the noise.

use std::f64::consts::TAU;

use crate::signals::{
    motion_band::{Accelerations, MotionBand},
    noise::{JointNoise, NoiseSource},
};

/// The cut-off as a multiple of the motion's bandwidth (Gautier's rule for identification).
pub(crate) const MULTIPLE: f64 = 5.0;
/// The least multiple, of the frequency below which 95 % of the motion lies. Motion at that
/// frequency passes within 4 %.
const LEAST_MULTIPLE: f64 = 1.5;
/// Largest noise of an acceleration, as a share of the acceleration that the motion needs. At the
/// cut-off with the smallest error of acceleration this share is 0.4 % for a smooth motion (sinusoids), 2 to 5 %
/// for sweeps and minimum jerk, and 20 % where the acceleration jumps (trapezoids of velocity).
/// Motion above the cut-off is removed from the effort alike, so its loss is no error; noise is one.
const NOISE_SHARE: f64 = 0.03;
/// The lowest cut-off chosen as five times the motion's bandwidth (Hz).
const LOWEST_HZ: f64 = 2.0;
/// The lowest cut-off chosen because of noise (Hz). A log loses three periods of
/// the cut-off at its ends.
const LOWEST_FOR_NOISE_HZ: f64 = 1.0;
/// The highest cut-off chosen, as a share of half the sampling rate.
const HIGHEST_SHARE: f64 = 0.4;
/// Ratio of the frequencies at which the noise is compared with its share, from the highest down.
const FINENESS: f64 = 1.02;

/// The cut-off, and the reason for it.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Cutoff {
    /// The cut-off (Hz).
    pub cutoff_hz: f64,
    /// Frequency below which the motion lies (Hz).
    pub motion_hz: f64,
    /// The reason, in a sentence.
    pub reason: String,
}

/// A joint, and the highest cut-off that its noise allows.
struct Worst<'a> {
    name: &'a str,
    noise: &'a JointNoise,
    motion: &'a Accelerations,
    /// Frequency at which its noise reaches the share (Hz).
    reached_hz: f64,
}

/// Bounds of the cut-off of a log (Hz).
#[derive(Debug, Clone, Copy)]
pub(crate) struct Bounds {
    motion_hz: Option<f64>,
    most_hz: Option<f64>,
    highest_hz: f64,
}

impl Bounds {
    /// The bounds for a motion in a log whose lowest sampling rate is `rate_hz`.
    pub(crate) fn new(motion: &MotionBand, rate_hz: f64) -> Self {
        Self {
            motion_hz: motion.motion_hz,
            most_hz: motion.most_hz,
            highest_hz: HIGHEST_SHARE * 0.5 * rate_hz,
        }
    }

    /// Five times the motion's bandwidth, between 2 Hz and 0.4 of half the sampling rate (Hz).
    pub(crate) fn by_motion(&self) -> f64 {
        let motion_hz = self.motion_hz.unwrap_or(LOWEST_HZ);
        let rounded = (10.0 * MULTIPLE * motion_hz).round() / 10.0;
        rounded.max(LOWEST_HZ).min(self.highest_hz)
    }

    /// The lowest cut-off that may be chosen because of noise (Hz).
    fn lowest(&self) -> f64 {
        (LEAST_MULTIPLE * self.most_hz.unwrap_or(LOWEST_HZ))
            .max(self.motion_hz.unwrap_or(LOWEST_HZ))
            .max(LOWEST_FOR_NOISE_HZ)
            .min(self.by_motion())
    }

    /// Frequency below which the motion lies (Hz); derived from the cut-off where nothing moves.
    pub(crate) fn motion_hz(&self) -> f64 {
        self.motion_hz.unwrap_or(self.by_motion() / MULTIPLE)
    }

    /// The reason, where the motion alone decides.
    fn by_motion_reason(&self) -> String {
        let cutoff = self.by_motion();
        let Some(motion) = self.motion_hz else {
            return format!("{cutoff:.1} Hz: no joint moves, so the data do not tell");
        };
        let below = format!("99 % of the motion lies below {motion:.2} Hz");
        if cutoff >= self.highest_hz {
            format!("{cutoff:.1} Hz: {below}; this is 0.4 of half the sampling rate")
        } else if cutoff > MULTIPLE * motion + 0.05 {
            format!("{cutoff:.1} Hz: {below}; no lower cut-off is chosen")
        } else {
            format!("{cutoff:.1} Hz: {below}; five times that is kept")
        }
    }
}

/// Chooses the cut-off (Hz) and gives the reason. It is five times the motion's bandwidth, or the lower frequency at
/// which the noise of a joint's acceleration reaches 3 % of the acceleration that its
/// motion needs.
///
/// ```text
/// acceleration_rms(cutoff) = .03 rms(qdd of the motion below the cut-off)
/// ```
///
/// All joints share the cut-off of the worst joint: coupled joints must be filtered alike, and a sum
/// over joints keeps the noise of the worst. The cut-off is at least one and a half times the
/// frequency below which 95 % of the motion lies, and at least the frequency below which 99 % lies.
pub(crate) fn choose(
    bounds: &Bounds,
    motion: &MotionBand,
    noise: &[JointNoise],
    names: &[&str],
) -> Cutoff {
    let by_motion = bounds.by_motion();
    let motion_hz = bounds.motion_hz();
    let joints = noise.iter().zip(&motion.accelerations).zip(names);
    let moving = joints.filter(|((_, motion), _)| motion.below(by_motion) > 0.0);
    let worst = moving.map(|((noise, motion), name)| {
        let reached_hz = noise_limit_hz(noise, motion, by_motion);
        Worst { name, noise, motion, reached_hz }
    });
    let worst = worst.min_by(|a, b| a.reached_hz.total_cmp(&b.reached_hz));
    match worst {
        Some(worst) if worst.reached_hz < by_motion => {
            let cutoff_hz = worst.reached_hz.max(bounds.lowest());
            let cutoff_hz = ((10.0 * cutoff_hz).round() / 10.0).min(by_motion);
            Cutoff { cutoff_hz, motion_hz, reason: worst.reason(cutoff_hz, motion_hz) }
        }
        _ => Cutoff { cutoff_hz: by_motion, motion_hz, reason: bounds.by_motion_reason() },
    }
}

/// The highest frequency up to `highest_hz` at which the noise is below its share (Hz).
fn noise_limit_hz(noise: &JointNoise, motion: &Accelerations, highest_hz: f64) -> f64 {
    let mut hz = highest_hz;
    while hz > 0.01 * highest_hz && noise.acceleration_rms(hz) > NOISE_SHARE * motion.below(hz) {
        hz /= FINENESS;
    }
    hz
}

impl Worst<'_> {
    fn reason(&self, cutoff_hz: f64, motion_hz: f64) -> String {
        let noise = self.noise.acceleration_rms(cutoff_hz);
        let percent = 100.0 * noise / self.motion.below(cutoff_hz);
        format!(
            "{cutoff_hz:.1} Hz: {} leaves an acceleration of {} there, {percent:.1} % of what its motion needs; \
             99 % of the motion lies below {motion_hz:.2} Hz",
            self.origin(cutoff_hz),
            short(noise),
        )
    }

    /// The origin of the noise at a frequency.
    fn origin(&self, hz: f64) -> String {
        let JointNoise { position, velocity, acceleration, .. } = self.noise;
        let differentiated = (TAU * hz).powi(2) * position.density;
        let channel = match (acceleration, velocity) {
            (Some(_), _) => "acceleration",
            (None, Some(velocity)) if velocity.density < differentiated => "velocity",
            _ => "position",
        };
        match (channel, position.source, position.step) {
            ("position", NoiseSource::Step, Some(step)) => {
                format!("the encoder of {}, in steps of {},", self.name, short(step))
            }
            _ => format!("the noise of the {channel} of {}", self.name),
        }
    }
}

/// A number with two digits. Its unit is that of the joint: rad or m, per s².
fn short(x: f64) -> String {
    let digits = (1.0 - x.abs().max(1e-12).log10().floor()).max(0.0) as usize;
    if digits > 5 { format!("{x:.1e}") } else { format!("{x:.digits$}") }
}
