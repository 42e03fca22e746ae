use std::ops::Range;

use crate::{
    error::LogError,
    signals::{
        differentiate::differentiate,
        filter::LowPass,
        origin::{Origin, Sources},
        uniform::{UniformJoint, UniformRun},
    },
};

/// Order of the low-pass in one pass.
pub(crate) const ORDER: usize = 4;

/// Length cut from either end, in periods of the cut-off. The slowest pole of the filter
/// decays by `exp(-2 pi sin(pi / 8))` per period: 3 % of an error at the end remains.
pub(crate) const SETTLING_PERIODS: f64 = 1.5;

/// The low-passed signals of a piece of a run.
pub(crate) struct FilteredRun {
    rate_hz: f64,
    cutoff_hz: f64,
    samples: usize,
    pub joints: Vec<FilteredJoint>,
}

pub(crate) struct FilteredJoint {
    /// Signals low-passed at the cut-off.
    pub own: FilteredSignals,
    /// Signals low-passed at [`WIDE`] times the cut-off.
    pub wide: FilteredSignals,
    /// Position, velocity and acceleration of the link.
    pub link: Option<[Vec<f64>; 3]>,
}

/// The signals of a joint after one low-pass. `qd` and `qdd` are derivatives of `q` until
/// [`FilteredSignals::take`] replaces them by measured ones.
pub(crate) struct FilteredSignals {
    pub q: Vec<f64>,
    pub qd: Vec<f64>,
    pub qdd: Vec<f64>,
    pub velocity: Option<Vec<f64>>,
    pub acceleration: Option<Vec<f64>>,
}

/// Ratio of the cut-off of the wide signals to that of the others. The wide low-pass weakens a signal at the narrow
/// cut-off by only 2e-5. Its ringing where a motion starts and stops is a quarter
/// as long.
pub(crate) const WIDE: f64 = 4.0;

/// Largest cut-off, as a share of the sampling rate.
const WIDEST: f64 = 0.2;

impl FilteredRun {
    /// The signals of a piece, from the columns that `sources` gives for each joint.
    pub(crate) fn of(
        piece: &UniformRun,
        cutoff_hz: f64,
        sources: &[Sources],
    ) -> Result<Self, LogError> {
        let rate_hz = piece.rate_hz;
        let low_pass = LowPass::new(ORDER, cutoff_hz, rate_hz)?;
        let wide_hz = (WIDE * cutoff_hz).min(WIDEST * rate_hz).max(cutoff_hz);
        let wide = LowPass::new(ORDER, wide_hz, rate_hz)?;
        let joint = |(raw, from): (&UniformJoint, &Sources)| FilteredJoint {
            own: FilteredSignals::of(raw, &low_pass, rate_hz).take(*from, rate_hz),
            wide: FilteredSignals::of(raw, &wide, rate_hz).take(*from, rate_hz),
            link: raw
                .link
                .as_ref()
                .map(|link| with_derivatives(low_pass_copy(&low_pass, link), rate_hz)),
        };
        let joints = piece.joints.iter().zip(sources).map(joint).collect();
        Ok(Self { rate_hz, cutoff_hz, samples: piece.time.len(), joints })
    }

    /// The samples at which the filter has settled: all but `1.5 / cutoff` at both ends.
    pub(crate) fn settled_range(&self) -> Range<usize> {
        settled_range(self.samples, self.rate_hz, self.cutoff_hz)
    }
}

/// The samples at which a low-pass has settled: all but `1.5 / cutoff` at both ends.
pub(crate) fn settled_range(samples: usize, rate_hz: f64, cutoff_hz: f64) -> Range<usize> {
    let end = (SETTLING_PERIODS * rate_hz / cutoff_hz).ceil() as usize;
    let end = end.min(samples.saturating_sub(1) / 2);
    end..samples - end
}

impl FilteredSignals {
    pub(crate) fn of(raw: &UniformJoint, low_pass: &LowPass, rate_hz: f64) -> Self {
        let pass = |x: &Vec<f64>| low_pass_copy(low_pass, x);
        let [q, qd, qdd] = with_derivatives(pass(&raw.q), rate_hz);
        let velocity = raw.velocity.as_ref().map(pass);
        let acceleration = raw.acceleration.as_ref().map(pass);
        Self { q, qd, qdd, velocity, acceleration }
    }

    /// Replaces velocity and acceleration by the measured ones where these are the sources.
    pub(crate) fn take(mut self, sources: Sources, rate_hz: f64) -> Self {
        if sources.velocity == Origin::Measured
            && let Some(velocity) = self.velocity.take()
        {
            self.qdd = differentiate(&velocity, rate_hz);
            self.qd = velocity;
        }
        if sources.acceleration == Origin::Measured
            && let Some(acceleration) = self.acceleration.take()
        {
            self.qdd = acceleration;
        }
        self
    }
}

/// A low-passed copy of a signal.
fn low_pass_copy(low_pass: &LowPass, x: &[f64]) -> Vec<f64> {
    let mut x = x.to_vec();
    low_pass.apply(&mut x);
    x
}

/// The position with its velocity and acceleration.
fn with_derivatives(q: Vec<f64>, rate_hz: f64) -> [Vec<f64>; 3] {
    let qd = differentiate(&q, rate_hz);
    let qdd = differentiate(&qd, rate_hz);
    [q, qd, qdd]
}
