use crate::pieces::RunPiece;
use crate::thresholds::InspectionThresholds;

/// Least scale in samples: derivatives over a quarter of it either way are then those of the motion.
const LEAST: f64 = 3.0;

/// Triples of samples of a piece that a second difference is worked out from.
const LOOKED_AT: usize = 1000;

/// Time over which motion is looked at (s): between the span at which it prevails over the noise of the encoders
/// and that at which it is smooth. `None` without motion.
///
/// All joints and pieces count together, those that move most count most.
pub(crate) fn scale_s(pieces: &[RunPiece], t: &InspectionThresholds) -> Option<f64> {
    let step_s = pieces.iter().map(|p| p.step_s).fold(f64::INFINITY, f64::min);
    let longest_s = pieces.iter().map(|p| p.step_s * p.len() as f64).fold(0.0, f64::max);
    let most = (longest_s / step_s / t.spans_of_piece) as usize;
    let mut spans: Vec<usize> = Vec::new();
    let mut span = 1.0_f64;
    while (span as usize) < most {
        if spans.last() != Some(&(span as usize)) {
            spans.push(span as usize);
        }
        span *= std::f64::consts::SQRT_2;
    }
    let bend = |s: usize| -> f64 {
        pieces
            .iter()
            .map(|p| bend(p, (s as f64 * step_s / p.step_s).round().max(1.0) as usize))
            .sum()
    };
    let neighbours = bend(1).sqrt();
    let sizes: Vec<(usize, f64)> = spans.iter().map(|&s| (s, bend(s).sqrt())).collect();
    let above = sizes.iter().find(|(_, size)| *size >= t.above_noise * neighbours)?.0;
    let is_smooth = |s: &usize| bend(2 * s).sqrt() >= t.smooth * bend(*s).sqrt();
    let smooth = spans.iter().copied().rev().take_while(|s| *s >= above).find(is_smooth);
    let scale = (above as f64 * smooth.unwrap_or(above) as f64).sqrt();
    Some(scale.max(LEAST) * step_s)
}

/// Sum over joints of the mean square of the second difference over `s` samples.
fn bend(piece: &RunPiece, s: usize) -> f64 {
    let length = piece.len();
    let step = (length / LOOKED_AT).max(1);
    let of = |q: &[f64]| -> f64 {
        let rows = (0..length.saturating_sub(2 * s)).step_by(step);
        let count = rows.len().max(1) as f64;
        rows.map(|k| (q[k] - 2.0 * q[k + s] + q[k + 2 * s]).powi(2)).sum::<f64>() / count
    };
    piece.joints.iter().map(|joint| of(&joint.position)).sum()
}
