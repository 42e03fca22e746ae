//! The noise of channels, estimated from steps and spectra.

use crate::{
    runs::run::{Channels, Run, range},
    signals::{
        fourier_transform::FourierTransform,
        lattice,
        noise::{ChannelNoise, JointNoise, NoiseSource},
        origin::{Origin, Sources},
        spectrum::{Density, Flat},
        uniform::{UniformJoint, UniformRun},
    },
};

/// Share of the power of the positions that counts as motion at any noise.
const MOTION_SHARE: f64 = 0.999;
/// Noise is searched above this multiple of the motion's highest frequency.
const ABOVE: f64 = 2.0;
/// Highest frequency above which noise is searched, as a share of the sampling rate. Where noise is more than a
/// thousandth of the power, the motion seems to reach as far as the noise.
const HIGHEST_SHARE: f64 = 0.125;

/// The inputs of the noise estimates.
pub(crate) struct NoiseReadings<'a> {
    /// The runs as they were read. Resampling removes their steps.
    pub runs: &'a [Run],
    /// The pieces of the runs on uniform clocks.
    pub pieces: &'a [UniformRun],
    /// Which joints move, per piece.
    pub moving: &'a [Vec<bool>],
}

impl NoiseReadings<'_> {
    /// The noise of a joint; `position` is that of its position. It is the mean over the pieces in which the joint
    /// moves, weighted by their length, or over all pieces if the joint never moves. The mean is taken, not
    /// the worst, since a fit weighs all samples of a log.
    pub(crate) fn noise(
        &self,
        joint: usize,
        sources: Sources,
        position: ChannelNoise,
    ) -> JointNoise {
        let acceleration = (sources.acceleration == Origin::Measured)
            .then(|| self.of(joint, |r| r.acceleration.as_deref(), |p| p.acceleration.as_deref()));
        let has_link = self.pieces.iter().all(|p| p.joints[joint].link.is_some());
        let link =
            has_link.then(|| self.of(joint, |r| r.link_position.as_deref(), |p| p.link.as_deref()));
        let effort = self.of(joint, |r| Some(&r.effort), |p| Some(&p.effort));
        let velocity = match sources.velocity {
            Origin::Measured => self.velocity(joint),
            Origin::Derived => None,
        };
        JointNoise { position, velocity, acceleration, link, effort }
    }

    /// The noise of a joint's position, and its noise in each piece. In a piece it is the larger of the piece's own
    /// noise and the mean of all, since a short piece may show too little.
    pub(crate) fn position(&self, joint: usize) -> (ChannelNoise, Vec<ChannelNoise>) {
        let each = self.each(joint, |r| Some(&r.position), |p| Some(&p.q));
        let own: Vec<(usize, ChannelNoise)> =
            each.iter().map(|(k, sum)| (*k, sum.noise())).collect();
        let noise = together(each);
        let mut all = vec![noise; self.pieces.len()];
        for (piece, own) in own.into_iter().filter(|(_, own)| own.density > noise.density) {
            all[piece] = own;
        }
        (noise, all)
    }

    /// The noise of the velocity column of a joint. `None` where it is unknown, and where the spectrum is flat over
    /// more octaves as the noise of a position than as that of a velocity.
    fn velocity(&self, joint: usize) -> Option<ChannelNoise> {
        let octaves = |kind: fn(&Density) -> Density| -> f64 {
            let flats = self.chosen(joint).filter_map(|(_, piece, quiet_hz)| {
                let velocity = piece.joints[joint].velocity.as_deref()?;
                Some(kind(&density(velocity, piece)).flat_above(quiet_hz)?.octaves)
            });
            flats.sum()
        };
        let is_own = octaves(Density::integrate) <= octaves(Density::clone);
        let own = self.of(joint, |r| r.velocity.as_deref(), |p| p.velocity.as_deref());
        (is_own && own.source != NoiseSource::Unknown).then_some(own)
    }

    /// The pieces from which a joint's noise is estimated, with their numbers and the lowest frequency
    /// used (Hz).
    fn chosen(&self, joint: usize) -> impl Iterator<Item = (usize, &UniformRun, f64)> {
        let moves_at_all = self.moving.iter().any(|m| m[joint]);
        let all = self.pieces.iter().zip(self.moving).enumerate();
        all.filter(move |(_, (_, m))| m[joint] || !moves_at_all).map(move |(k, (piece, moves))| {
            let motion_hz = match moves[joint] {
                true => density(&piece.joints[joint].q, piece).edge_hz(MOTION_SHARE),
                false => 0.0,
            };
            (k, piece, (ABOVE * motion_hz).min(HIGHEST_SHARE * piece.rate_hz))
        })
    }

    /// The noise of a channel of a joint.
    fn of<'a>(
        &'a self,
        joint: usize,
        raw: impl Fn(&'a Channels) -> Option<&'a [f64]>,
        uniform: impl Fn(&'a UniformJoint) -> Option<&'a [f64]>,
    ) -> ChannelNoise {
        together(self.each(joint, raw, uniform))
    }

    /// The noise of a joint's channel in each piece, with the number of the piece.
    fn each<'a>(
        &'a self,
        joint: usize,
        raw: impl Fn(&'a Channels) -> Option<&'a [f64]>,
        uniform: impl Fn(&'a UniformJoint) -> Option<&'a [f64]>,
    ) -> Vec<(usize, Sum)> {
        let rounding: Vec<Option<Rounding>> =
            self.runs.iter().map(|run| Rounding::of(raw(&run.joints[joint])?, &run.time)).collect();
        let pieces = self.chosen(joint).filter_map(|(k, piece, quiet_hz)| {
            let x = uniform(&piece.joints[joint])?;
            let flat = density(x, piece).flat_above(quiet_hz);
            Some((k, Sum::of((piece, x), rounding[piece.run], flat)))
        });
        pieces.collect()
    }
}

/// The mean noise of several pieces.
fn together(each: Vec<(usize, Sum)>) -> ChannelNoise {
    each.into_iter().map(|(_, sum)| sum).reduce(Sum::and).unwrap_or_default().noise()
}

fn density(x: &[f64], piece: &UniformRun) -> Density {
    Density::of(x, piece.rate_hz, &mut FourierTransform::default())
}

/// Rounding of a signal to steps.
#[derive(Debug, Clone, Copy)]
struct Rounding {
    step: f64,
    /// Steps that the signal passes per second (Hz).
    changes_hz: f64,
}

impl Rounding {
    fn of(x: &[f64], time: &[f64]) -> Option<Self> {
        let step = lattice::step(x)?;
        let duration_s = time.last()? - time.first()?;
        let way: f64 = x.windows(2).map(|x| (x[1] - x[0]).abs()).sum();
        Some(Self { step, changes_hz: way / (step * duration_s) })
    }

    /// Density of the rounding error (unit^2/Hz):
    ///
    /// ```text
    /// h^2 / (12 B),   B = min(rate / 2, sum |x[k+1] - x[k]| / (h duration))
    /// ```
    ///
    /// The error has a variance of `h^2 / 12` and changes as often as the readings. Where the readings change rarely,
    /// the error lies below that many Hz.
    fn density(&self, rate_hz: f64) -> f64 {
        self.step.powi(2) / (12.0 * self.changes_hz.min(0.5 * rate_hz))
    }
}

/// Least noise of any sensor, as a share of the range of a signal: 17 bits.
const LEAST_NOISE: f64 = 1e-5;

/// Whether a signal was low-passed before it was written: it has no steps, a very low flat density, and a
/// steep fall before it.
fn is_smooth(flat: &Flat, x: &[f64], piece: &UniformRun) -> bool {
    let (low, high) = range(x);
    let noise = (0.5 * piece.rate_hz * flat.density).sqrt();
    flat.is_filtered && noise < LEAST_NOISE * (high - low)
}

/// Factor above which noise that exceeds that of the steps has another origin too.
const MORE_THAN_STEPS: f64 = 1.5;

/// Densities of pieces, weighted by their lengths (s).
#[derive(Default)]
struct Sum {
    length_s: f64,
    rounding: f64,
    /// The larger of the density of rounding and the flat density above the motion.
    larger: f64,
    /// Whether any piece was low-passed before it was written. All pieces then count as low-passed.
    is_filtered: bool,
    step: Option<f64>,
}

impl Sum {
    /// The larger of rounding and flat density in each piece. The flat density above the motion includes the rounding,
    /// but the rounding of a slow joint lies below it in frequency.
    fn of(
        (piece, x): (&UniformRun, &[f64]),
        rounding: Option<Rounding>,
        flat: Option<Flat>,
    ) -> Self {
        let length_s = piece.duration_s();
        let step = rounding.map(|r| r.step);
        let rounding = rounding.map_or(0.0, |r| r.density(piece.rate_hz));
        let above = flat.map_or(0.0, |f| f.density);
        Self {
            length_s,
            rounding: length_s * rounding,
            larger: length_s * above.max(rounding),
            is_filtered: step.is_none() && flat.is_some_and(|f| is_smooth(&f, x, piece)),
            step,
        }
    }

    /// The sum of both. Of two steps the coarser is kept, since a file may hold more digits of small numbers.
    fn and(self, other: Self) -> Self {
        Self {
            length_s: self.length_s + other.length_s,
            rounding: self.rounding + other.rounding,
            larger: self.larger + other.larger,
            is_filtered: self.is_filtered || other.is_filtered,
            step: self.step.into_iter().chain(other.step).reduce(f64::max),
        }
    }

    fn noise(&self) -> ChannelNoise {
        let larger = if self.is_filtered { self.rounding } else { self.larger };
        let source = if larger > MORE_THAN_STEPS * self.rounding {
            NoiseSource::AboveTheMotion
        } else if self.rounding > 0.0 {
            NoiseSource::Step
        } else {
            NoiseSource::Unknown
        };
        let density = if self.length_s > 0.0 { larger / self.length_s } else { 0.0 };
        ChannelNoise { density, step: self.step, source }
    }
}
