//! The cut-off, the columns and the noise of a log, chosen before it is filtered.

use crate::{
    error::LogError,
    runs::run::Run,
    signals::{
        cutoff::{self, Bounds, Cutoff},
        filter::LowPass,
        filtered::{ORDER, SETTLING_PERIODS},
        motion_band::BandInputs,
        noise::JointNoise,
        noise_readings::NoiseReadings,
        origin::Sources,
        sources::{ComparisonBands, Disagreement},
        uniform::{UniformRun, moving},
        warning::LogWarning,
    },
};

/// The choices for a log, the same for all of its runs.
pub(crate) struct Choice {
    pub cutoff: Cutoff,
    /// Sources of each joint's signals.
    pub sources: Vec<Sources>,
    /// Noise of each joint's channels.
    pub noise: Vec<JointNoise>,
    /// Warnings of columns that are not used.
    pub warnings: Vec<LogWarning>,
}

/// Chooses for runs and their pieces; `given_hz` is a cut-off that was asked for.
///
/// The noise of the positions gives the band of the motion. That band decides which columns agree with
/// their derivatives. The noise of the chosen columns limits the band in which acceleration is known.
///
/// # Errors
///
/// [`LogError::CutoffOutOfRange`].
pub(crate) fn choose(
    runs: &[Run],
    pieces: &[UniformRun],
    given_hz: Option<f64>,
) -> Result<Choice, LogError> {
    let moving = &moving(pieces);
    let readings = NoiseReadings { runs, pieces, moving };
    let joints = 0..pieces.first().map_or(0, |piece| piece.joints.len());
    let (positions, in_pieces): (Vec<_>, Vec<_>) =
        joints.clone().map(|j| readings.position(j)).unzip();
    let motion = BandInputs { pieces, moving, noise: &in_pieces }.band();
    let slowest_hz = pieces.iter().map(|p| p.rate_hz).fold(f64::INFINITY, f64::min);
    let bounds = Bounds::new(&motion, slowest_hz);
    let motion_hz = bounds.motion_hz();
    let comparison =
        ComparisonBands { cutoff_hz: given_hz.unwrap_or(bounds.by_motion()), motion_hz };
    for piece in pieces {
        LowPass::new(ORDER, comparison.cutoff_hz, piece.rate_hz)?;
    }

    let names: Vec<&str> =
        runs.iter().take(1).flat_map(|run| &run.joints).map(|j| j.name.as_str()).collect();
    let mut chosen = Columns { pieces, moving, comparison, names: &names, warnings: Vec::new() };
    let sources: Result<Vec<_>, _> = joints.clone().map(|j| chosen.sources(j)).collect();
    let (sources, warnings) = (sources?, chosen.warnings);
    let noise: Vec<_> = joints.map(|j| readings.noise(j, sources[j], positions[j])).collect();
    let cutoff = match given_hz {
        Some(hz) => Cutoff { cutoff_hz: hz, motion_hz, reason: format!("{hz} Hz: it was given") },
        None => cutoff::choose(&bounds, &motion, &noise, &names),
    };
    Ok(Choice { cutoff, sources, noise, warnings })
}

/// Chooses the columns that are used.
struct Columns<'a> {
    pieces: &'a [UniformRun],
    moving: &'a [Vec<bool>],
    comparison: ComparisonBands,
    names: &'a [&'a str],
    warnings: Vec<LogWarning>,
}

impl Columns<'_> {
    /// The sources of a joint's signals. Warnings are kept.
    fn sources(&mut self, joint: usize) -> Result<Sources, LogError> {
        let shortest_s = 3.0 * SETTLING_PERIODS / self.comparison.cutoff_hz;
        let in_motion: Vec<bool> = self
            .pieces
            .iter()
            .zip(self.moving)
            .map(|(piece, m)| m[joint] && piece.duration_s() >= shortest_s)
            .collect();
        let (sources, found) = self.comparison.sources(self.pieces, &in_motion, joint)?;
        let name = self.names.get(joint).copied().unwrap_or_default();
        for warning in found.iter().map(|d: &Disagreement| d.warning(self.pieces, name)) {
            let left = self.warnings.iter_mut().try_fold(warning, |left, known| known.join(left));
            self.warnings.extend(left);
        }
        Ok(sources)
    }
}
