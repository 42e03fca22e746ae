use std::ops::Range;

use crate::{
    Agreement, LogError, LogWarning, LowPass,
    cutoff::MULTIPLE,
    differentiate,
    uniform::{UniformJoint, UniformRun},
};

/// Order of the low-pass in one pass.
pub(crate) const ORDER: usize = 4;

/// What is cut from either end, in periods of the cut-off. The slowest pole of the filter
/// decays by `exp(-2 pi sin(pi / 8))` in one period: 3 % of an error at the end is left.
pub(crate) const SETTLING_PERIODS: f64 = 1.5;

/// The low-passed signals of a piece of a run.
pub(crate) struct Filtered {
    rate_hz: f64,
    cutoff_hz: f64,
    samples: usize,
    pub joints: Vec<FilteredJoint>,
}

pub(crate) struct FilteredJoint {
    /// Behind the cut-off.
    pub own: Band,
    /// Behind [`WIDE`] times that.
    pub wide: Band,
    /// Position, velocity and acceleration of the link.
    pub link: Option<[Vec<f64>; 3]>,
}

/// The signals of a joint behind one low-pass. `qd` and `qdd` are derivatives of `q` until
/// [`choose_sources`] has looked at the measured ones.
pub(crate) struct Band {
    pub q: Vec<f64>,
    pub qd: Vec<f64>,
    pub qdd: Vec<f64>,
    velocity: Option<Vec<f64>>,
    acceleration: Option<Vec<f64>>,
}

/// Cut-off of the wide signals, in cut-offs of the others. What is as fast as the cut-off is weakened
/// by 2e-5 there, and a filter that rings where a motion starts and stops rings a quarter
/// as long.
const WIDE: f64 = 4.0;

/// Largest cut-off, as a share of the sampling rate.
const WIDEST: f64 = 0.2;

/// A measured column that is not the derivative it should be.
pub(crate) struct Disagreement {
    piece: usize,
    agreement: Agreement,
    is_velocity: bool,
}

impl Filtered {
    pub(crate) fn of(piece: &UniformRun, cutoff_hz: f64) -> Result<Self, LogError> {
        let rate_hz = piece.rate_hz;
        let low_pass = LowPass::new(ORDER, cutoff_hz, rate_hz)?;
        let wide_hz = (WIDE * cutoff_hz).min(WIDEST * rate_hz).max(cutoff_hz);
        let wide = LowPass::new(ORDER, wide_hz, rate_hz)?;
        let joint = |raw: &UniformJoint| FilteredJoint {
            own: Band::of(raw, &low_pass, rate_hz),
            wide: Band::of(raw, &wide, rate_hz),
            link: raw.link.as_ref().map(|link| derived(passed(&low_pass, link), rate_hz)),
        };
        let joints = piece.joints.iter().map(joint).collect();
        Ok(Self { rate_hz, cutoff_hz, samples: piece.time.len(), joints })
    }

    /// The samples at which the filter has settled: all but `1.5 / cutoff` at both ends.
    pub(crate) fn settled(&self) -> Range<usize> {
        let end = (SETTLING_PERIODS * self.rate_hz / self.cutoff_hz).ceil() as usize;
        let end = end.min(self.samples.saturating_sub(1) / 2);
        end..self.samples - end
    }

    /// The velocity column of a joint against the derivative of its position.
    pub(crate) fn velocity_agreement(&self, joint: usize) -> Option<Agreement> {
        let joint = &self.joints[joint].own;
        self.compare(joint.velocity.as_ref()?, &joint.qd)
    }

    fn compare(&self, measured: &[f64], derived: &[f64]) -> Option<Agreement> {
        let kept = self.settled();
        Agreement::of(&measured[kept.clone()], &derived[kept], self.rate_hz, self.cutoff_hz)
    }
}

impl Band {
    fn of(raw: &UniformJoint, low_pass: &LowPass, rate_hz: f64) -> Self {
        let pass = |x: &Vec<f64>| passed(low_pass, x);
        let [q, qd, qdd] = derived(pass(&raw.q), rate_hz);
        let velocity = raw.velocity.as_ref().map(pass);
        let acceleration = raw.acceleration.as_ref().map(pass);
        Self { q, qd, qdd, velocity, acceleration }
    }

    /// Takes the measured velocity.
    fn take_velocity(&mut self, rate_hz: f64) {
        self.qd = self.velocity.take().unwrap_or_default();
        self.qdd = differentiate(&self.qd, rate_hz);
    }

    /// Takes the measured acceleration.
    fn take_acceleration(&mut self) {
        self.qdd = self.acceleration.take().unwrap_or_default();
    }
}

/// The signal behind a low-pass.
fn passed(low_pass: &LowPass, x: &[f64]) -> Vec<f64> {
    let mut x = x.to_vec();
    low_pass.apply(&mut x);
    x
}

/// Position, velocity and acceleration.
fn derived(q: Vec<f64>, rate_hz: f64) -> [Vec<f64>; 3] {
    let qd = differentiate(&q, rate_hz);
    let qdd = differentiate(&qd, rate_hz);
    [q, qd, qdd]
}

/// Takes the measured velocity and acceleration of a joint where they agree with the
/// derivatives in every run in which it moves (`in_motion`), and tells where they do not.
pub(crate) fn choose_sources(
    pieces: &mut [Filtered],
    in_motion: &[bool],
    joint: usize,
    cutoff_hz: f64,
) -> Vec<Disagreement> {
    let motion_hz = cutoff_hz / MULTIPLE;
    let mut disagreements = Vec::new();
    let velocity = worst(pieces, in_motion, motion_hz, |piece| {
        let j = &piece.joints[joint].own;
        Some((j.velocity.as_ref()?, &j.qd))
    });
    if velocity.is_some_and(|(_, a)| a.holds(motion_hz)) {
        for piece in pieces.iter_mut() {
            let FilteredJoint { own, wide, .. } = &mut piece.joints[joint];
            own.take_velocity(piece.rate_hz);
            wide.take_velocity(piece.rate_hz);
        }
    } else if let Some((piece, agreement)) = velocity {
        disagreements.push(Disagreement { piece, agreement, is_velocity: true });
    }
    let acceleration = worst(pieces, in_motion, motion_hz, |piece| {
        let j = &piece.joints[joint].own;
        Some((j.acceleration.as_ref()?, &j.qdd))
    });
    if acceleration.is_some_and(|(_, a)| a.holds(motion_hz)) {
        for piece in pieces.iter_mut() {
            let FilteredJoint { own, wide, .. } = &mut piece.joints[joint];
            own.take_acceleration();
            wide.take_acceleration();
        }
    } else if let Some((piece, agreement)) = acceleration {
        disagreements.push(Disagreement { piece, agreement, is_velocity: false });
    }
    disagreements
}

/// The worst agreement of a measured column with its derivative over the runs in motion;
/// `None` where a run does not have the column or none can be compared.
fn worst<'p>(
    pieces: &'p [Filtered],
    in_motion: &[bool],
    motion_hz: f64,
    pair: impl Fn(&'p Filtered) -> Option<(&'p Vec<f64>, &'p Vec<f64>)>,
) -> Option<(usize, Agreement)> {
    let pairs: Option<Vec<_>> = pieces.iter().map(pair).collect();
    let compared = pieces.iter().zip(pairs?).enumerate().filter(|(index, _)| in_motion[*index]);
    compared
        .filter_map(|(index, (piece, (m, d)))| Some((index, piece.compare(m, d)?)))
        .max_by(|a, b| a.1.deviation(motion_hz).total_cmp(&b.1.deviation(motion_hz)))
}

impl Disagreement {
    pub(crate) fn warning(&self, pieces: &[UniformRun], joint: &str) -> LogWarning {
        let (run, joints) = (pieces[self.piece].name.clone(), vec![joint.to_owned()]);
        let Agreement { lag_s, scale, .. } = self.agreement;
        match self.is_velocity {
            true => LogWarning::VelocityDisagrees { run, joints, lag_s, scale },
            false => LogWarning::AccelerationDisagrees { run, joints, lag_s, scale },
        }
    }
}
