//! The lag between the two encoders of a joint.

use crate::{
    error::LogError,
    runs::run::Run,
    signals::{
        filter::LowPass,
        filtered::{FilteredSignals, ORDER, settled_range},
        uniform::{UniformRun, moving},
        warning::LogWarning,
    },
};

/// Largest plausible lag (s).
const LARGEST_S: f64 = 0.02;
/// Least lag that is corrected (s), and the least in standard errors.
const LEAST_S: f64 = 1e-4;
const LEAST_STANDARD_ERRORS: f64 = 4.0;
/// Length of a block, in periods of the cut-off. The error of each block counts as one independent value.
const BLOCK_PERIODS: f64 = 5.0;
/// Fewest blocks from which a standard error is computed.
const FEWEST_BLOCKS: usize = 6;
/// Samples used per period of the cut-off.
const PER_PERIOD: f64 = 10.0;
/// Least part of a column that other columns do not explain. Below it the column is not used.
const LEAST_LEFT: f64 = 1e-6;

/// Lag of the second encoder of a joint.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Lag {
    lag_s: f64,
    std_s: f64,
}

/// Shifts second encoders to the clock of the first. Only lags, late or early, of more than four standard errors and a
/// tenth of a millisecond are corrected. Returns a warning with each lag.
///
/// The link follows the motor except for a twist under load, so that over a log
///
/// ```text
/// link - q = -lag qd + a qdd + b q + c sin q + d cos q + e sign(qd) + offset
/// ```
///
/// `a` is the inertia behind the spring over its stiffness. `b`, `c` and `d` are gravity and the
/// scale of either encoder. `e` is dry friction or play. A viscous friction of the link over the
/// stiffness of the joint cannot be told from a lag and is corrected as one. The standard error is computed from
/// blocks of five periods of the cut-off. Only joints that move show a lag.
pub(crate) fn remove_lags(
    pieces: &mut [UniformRun],
    first: &Run,
    cutoff_hz: f64,
) -> Result<Vec<LogWarning>, LogError> {
    let moving = moving(pieces);
    let mut warnings = Vec::new();
    for (j, channels) in first.joints.iter().enumerate() {
        let Some(mut lag) = estimate(pieces, &moving, j, cutoff_hz)?.filter(Lag::is_significant)
        else {
            continue;
        };
        shift(pieces, j, lag.lag_s);
        // The equation is that of a small lag; what it missed of a large one is small.
        if let Some(rest) =
            estimate(pieces, &moving, j, cutoff_hz)?.filter(|l| l.lag_s.abs() < lag.lag_s.abs())
        {
            shift(pieces, j, rest.lag_s);
            lag.lag_s += rest.lag_s;
        }
        let (joint, lag_s, lag_std_s) = (channels.name.clone(), lag.lag_s, lag.std_s);
        warnings.push(LogWarning::LinkLag { joint, lag_s, lag_std_s });
    }
    Ok(warnings)
}

impl Lag {
    fn is_significant(&self) -> bool {
        let size = self.lag_s.abs();
        (LEAST_S..=LARGEST_S).contains(&size) && size > LEAST_STANDARD_ERRORS * self.std_s
    }
}

/// Rows of all pieces: the explained quantity, the columns that a twist may depend on, and the block of
/// each row.
#[derive(Default)]
struct Rows {
    difference: Vec<f64>,
    late: Vec<f64>,
    twist: [Vec<f64>; 5],
    /// Piece of each row. The offset of an encoder may differ between recordings, so each piece has its own.
    piece: Vec<usize>,
    block: Vec<usize>,
}

/// The lag of the second encoder of joint `j`; `None` without the encoder or with too little motion.
fn estimate(
    pieces: &[UniformRun],
    moving: &[Vec<bool>],
    j: usize,
    cutoff_hz: f64,
) -> Result<Option<Lag>, LogError> {
    let mut rows = Rows::default();
    let in_motion = pieces.iter().zip(moving).enumerate().filter(|(_, (_, moves))| moves[j]);
    for (index, (piece, _)) in in_motion {
        rows.add(piece, (index, j), cutoff_hz)?;
    }
    Ok(rows.lag())
}

impl Rows {
    fn add(
        &mut self,
        piece: &UniformRun,
        (index, j): (usize, usize),
        cutoff_hz: f64,
    ) -> Result<(), LogError> {
        let joint = &piece.joints[j];
        let Some(link) = &joint.link else { return Ok(()) };
        let low_pass = LowPass::new(ORDER, cutoff_hz, piece.rate_hz)?;
        let band = FilteredSignals::of(joint, &low_pass, piece.rate_hz);
        let mut link = link.clone();
        low_pass.apply(&mut link);
        let stride = ((piece.rate_hz / (PER_PERIOD * cutoff_hz)) as usize).max(1);
        let in_block = (BLOCK_PERIODS * piece.rate_hz / cutoff_hz).max(1.0) as usize;
        let kept = settled_range(link.len(), piece.rate_hz, cutoff_hz);
        let before = self.block.last().map_or(0, |last| last + 1);
        for k in kept.clone().step_by(stride) {
            let (q, qd) = (band.q[k], band.qd[k]);
            self.difference.push(link[k] - q);
            self.late.push(-qd);
            let columns = [band.qdd[k], q, q.sin(), q.cos(), qd.signum()];
            self.twist.iter_mut().zip(columns).for_each(|(all, x)| all.push(x));
            self.piece.push(index);
            self.block.push(before + (k - kept.start) / in_block);
        }
        Ok(())
    }

    /// Least squares by orthogonal columns: the lag is fitted to the part of `-qd` that no other column explains.
    fn lag(mut self) -> Option<Lag> {
        let blocks = self.block.last()? + 1;
        if blocks < FEWEST_BLOCKS {
            return None;
        }
        let centre = |x: &mut Vec<f64>| without_means(x, &self.piece);
        centre(&mut self.difference);
        centre(&mut self.late);
        self.twist.iter_mut().for_each(centre);
        let mut basis: Vec<Vec<f64>> = Vec::new();
        for mut column in self.twist {
            let whole = dot(&column, &column);
            basis.iter().for_each(|b| take_out(&mut column, b));
            if dot(&column, &column) > LEAST_LEFT * whole {
                basis.push(column);
            }
        }
        let whole = dot(&self.late, &self.late);
        for column in &basis {
            take_out(&mut self.late, column);
            take_out(&mut self.difference, column);
        }
        let own = dot(&self.late, &self.late);
        if own <= LEAST_LEFT * whole {
            return None;
        }
        let lag_s = dot(&self.late, &self.difference) / own;
        let mut scores = vec![0.0; blocks];
        for ((late, difference), block) in self.late.iter().zip(&self.difference).zip(&self.block) {
            scores[*block] += late * (difference - lag_s * late);
        }
        let std_s = scores.iter().map(|s| s * s).sum::<f64>().sqrt() / own;
        (lag_s.is_finite() && std_s.is_finite()).then_some(Lag { lag_s, std_s })
    }
}

/// Removes the mean of each piece from a column.
fn without_means(x: &mut [f64], piece: &[usize]) {
    let mut start = 0;
    for group in piece.chunk_by(|a, b| a == b) {
        let end = start + group.len();
        let own = &mut x[start..end];
        let mean = own.iter().sum::<f64>() / group.len() as f64;
        own.iter_mut().for_each(|x| *x -= mean);
        start = end;
    }
}

/// Removes from a column its part proportional to another.
fn take_out(x: &mut [f64], other: &[f64]) {
    let share = dot(x, other) / dot(other, other).max(f64::MIN_POSITIVE);
    x.iter_mut().zip(other).for_each(|(x, o)| *x -= share * o);
}

fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(x, y)| x * y).sum()
}

/// The position of the link a lag later: `link(t + lag)`, by cubics through four samples.
fn shift(pieces: &mut [UniformRun], j: usize, lag_s: f64) {
    for piece in pieces {
        let steps = lag_s * piece.rate_hz;
        if let Some(link) = &mut piece.joints[j].link {
            *link = (0..link.len()).map(|k| at(link, k as f64 + steps)).collect();
        }
    }
}

/// A signal between its samples (Catmull-Rom); beyond its ends it is constant.
fn at(x: &[f64], place: f64) -> f64 {
    let last = x.len().saturating_sub(1);
    let place = place.clamp(0.0, last as f64);
    let k = place.floor();
    let (s, k) = (place - k, k as isize);
    let [a, b, c, d] = [k - 1, k, k + 1, k + 2].map(|i| x[i.clamp(0, last as isize) as usize]);
    let (m0, m1) = (0.5 * (c - a), 0.5 * (d - b));
    let (s2, s3) = (s * s, s * s * s);
    (2.0 * s3 - 3.0 * s2 + 1.0) * b
        + (s3 - 2.0 * s2 + s) * m0
        + (3.0 * s2 - 2.0 * s3) * c
        + (s3 - s2) * m1
}
