//! The columns from which velocity and acceleration are taken.

use crate::{
    error::LogError,
    signals::{
        agreement::Agreement,
        filter::LowPass,
        filtered::{FilteredSignals, ORDER, settled_range},
        origin::{Origin, Sources},
        uniform::UniformRun,
        warning::LogWarning,
    },
};

/// A measured column that does not agree with the derivative.
pub(crate) struct Disagreement {
    piece: usize,
    agreement: Agreement,
    derivative: Derivative,
}

/// Order of the derivative of the position that a column holds.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Derivative {
    Velocity,
    Acceleration,
}

/// The bands in which columns and derivatives are compared.
#[derive(Debug, Clone, Copy)]
pub(crate) struct ComparisonBands {
    /// Cut-off of the low-pass (Hz).
    pub cutoff_hz: f64,
    /// Frequency below which the motion lies (Hz).
    pub motion_hz: f64,
}

impl ComparisonBands {
    /// The sources of a joint's signals: its columns where they agree with the derivatives in every piece in
    /// which the joint moves (`in_motion`). Returns the disagreements too.
    pub(crate) fn sources(
        &self,
        pieces: &[UniformRun],
        in_motion: &[bool],
        joint: usize,
    ) -> Result<(Sources, Vec<Disagreement>), LogError> {
        let (mut sources, mut disagreements) = (Sources::POSITION, Vec::new());
        let has_none = |p: &UniformRun| {
            let raw = &p.joints[joint];
            raw.velocity.is_none() && raw.acceleration.is_none()
        };
        if pieces.iter().all(has_none) {
            return Ok((sources, disagreements));
        }
        let bands = |sources: Sources| -> Result<Vec<FilteredSignals>, LogError> {
            let band = |p: &UniformRun| {
                let low_pass = LowPass::new(ORDER, self.cutoff_hz, p.rate_hz)?;
                Ok(FilteredSignals::of(&p.joints[joint], &low_pass, p.rate_hz)
                    .take(sources, p.rate_hz))
            };
            pieces.iter().map(band).collect()
        };
        for derivative in [Derivative::Velocity, Derivative::Acceleration] {
            let bands = bands(sources)?;
            let worst = self.worst(pieces, in_motion, |piece| derivative.pair(&bands[piece]));
            match worst {
                Some((_, agreement)) if agreement.holds(self.motion_hz) => {
                    *derivative.origin(&mut sources) = Origin::Measured;
                }
                Some((piece, agreement)) => {
                    disagreements.push(Disagreement { piece, agreement, derivative });
                }
                None => {}
            }
        }
        Ok((sources, disagreements))
    }

    /// The worst agreement of a measured column with its derivative over the pieces in motion;
    /// `None` where a piece lacks the column, and where all pieces are too short or constant.
    fn worst<'b>(
        &self,
        pieces: &[UniformRun],
        in_motion: &[bool],
        pair: impl Fn(usize) -> Option<(&'b [f64], &'b [f64])>,
    ) -> Option<(usize, Agreement)> {
        let pairs: Option<Vec<_>> = (0..pieces.len()).map(pair).collect();
        let compared = pieces.iter().zip(pairs?).enumerate().filter(|(k, _)| in_motion[*k]);
        compared
            .filter_map(|(k, (piece, (m, d)))| Some((k, self.agreement(piece.rate_hz, m, d)?)))
            .max_by(|a, b| a.1.deviation(self.motion_hz).total_cmp(&b.1.deviation(self.motion_hz)))
    }

    /// Compares a measured column with its derivative, both low-passed and without their ends.
    fn agreement(&self, rate_hz: f64, measured: &[f64], derived: &[f64]) -> Option<Agreement> {
        let kept = settled_range(measured.len(), rate_hz, self.cutoff_hz);
        Agreement::of(&measured[kept.clone()], &derived[kept], rate_hz, self.cutoff_hz)
    }

    /// Compares the velocity column of a joint with the derivative of its position.
    pub(crate) fn velocity_agreement(&self, piece: &UniformRun, joint: usize) -> Option<Agreement> {
        let low_pass = LowPass::new(ORDER, self.cutoff_hz, piece.rate_hz).ok()?;
        let band = FilteredSignals::of(&piece.joints[joint], &low_pass, piece.rate_hz);
        self.agreement(piece.rate_hz, band.velocity.as_deref()?, &band.qd)
    }
}

impl Derivative {
    /// The column, and the derivative of the signal one order below.
    fn pair(self, band: &FilteredSignals) -> Option<(&[f64], &[f64])> {
        match self {
            Self::Velocity => Some((band.velocity.as_deref()?, &band.qd)),
            Self::Acceleration => Some((band.acceleration.as_deref()?, &band.qdd)),
        }
    }

    fn origin(self, sources: &mut Sources) -> &mut Origin {
        match self {
            Self::Velocity => &mut sources.velocity,
            Self::Acceleration => &mut sources.acceleration,
        }
    }
}

impl Disagreement {
    pub(crate) fn warning(&self, pieces: &[UniformRun], joint: &str) -> LogWarning {
        let (run, joints) = (pieces[self.piece].name.clone(), vec![joint.to_owned()]);
        let Agreement { lag_s, scale, .. } = self.agreement;
        match self.derivative {
            Derivative::Velocity => LogWarning::VelocityDisagrees { run, joints, lag_s, scale },
            Derivative::Acceleration => {
                LogWarning::AccelerationDisagrees { run, joints, lag_s, scale }
            }
        }
    }
}
