use catalogue::EffectKind;
use effects::Frame;
use logs::LogError;
use nalgebra::{DMatrix, DVector};
use rayon::prelude::*;
use robot::{Robot, TorqueSource};

use crate::columns::design::Design;
use crate::columns::linear_rest::LinearRest;
use crate::regression::noise::integrated_time;
use crate::signals::along::Along;
use crate::signals::limit::Limit;
use crate::signals::log::Log;
use crate::thresholds::limits::LimitThresholds;

/// Number of trial limits, which are quantiles of the absolute effort.
const TRIALS: usize = 24;

/// Torque limits: joints at which effort beyond some limit moves nothing. Only commands can exceed a limit; measured
/// efforts are torque.
///
/// ```text
/// clamp(effort, -limit, limit) - nominal = columns w + noise
/// ```
///
/// with the limit that leaves the smallest sum of squares.
pub(crate) fn limits(robot: &Robot, log: &Log) -> Result<Vec<Limit>, LogError> {
    if log.without.contains(&EffectKind::TorqueSaturation) {
        return Ok(Vec::new());
    }
    let design = Design::new(robot, log)?;
    let frame = Frame::of_logs(log.prepared);
    let runs = log.along(robot, &frame)?;
    let is_commanded = |j: &usize| {
        let source = robot.links()[*j].actuator.torque_source;
        log.moved[*j] && source == TorqueSource::Commanded
    };
    let t = &log.thresholds.limits;
    let joints = (0..design.joints()).into_par_iter().filter(is_commanded);
    let found: Vec<Option<Limit>> = joints
        .map(|j| LinearRest::new(&design, j).map_or(Ok(None), |left| at_joint(&runs, &left, j, t)))
        .collect::<Result<_, LogError>>()?;
    Ok(found.into_iter().flatten().collect())
}

/// The fit of all effects to the clamped effort.
struct Trial {
    /// Sum of squares over all samples.
    deviance: f64,
    /// Residual of the informative samples, `[run][sample]`.
    rest: Vec<Vec<f64>>,
    /// The effort beyond the limit, low-passed; zero where a sample is not informative.
    beyond: DVector<f64>,
}

fn trial(runs: &[Along], left: &LinearRest, limit: &Limit) -> Result<Trial, LogError> {
    let beyond: Vec<Vec<f64>> = runs.iter().map(|run| run.beyond(limit)).collect();
    let lengths: Vec<usize> = beyond.iter().map(Vec::len).collect();
    let beyond = DVector::from_vec(beyond.concat()).component_mul(&left.is_informative);
    let clamped = &left.y - &beyond;
    let rest = &clamped - &left.x * left.normal.solve(&left.x.tr_mul(&clamped));
    let deviance = rest.norm_squared();
    let mut samples = rest.iter().zip(&left.is_informative);
    let mut informative = |n: usize| {
        let of_run = samples.by_ref().take(n);
        of_run.filter(|(_, is)| **is > 0.0).map(|(rest, _)| *rest).collect()
    };
    let rest = lengths.iter().map(|&n| informative(n)).collect();
    Ok(Trial { deviance, rest, beyond })
}

/// Whether effort beyond the limit moves nothing. The other effects are fitted to the samples below the limit; above
/// it they must predict the clamped effort and fail to predict the whole effort.
fn moves_nothing(left: &LinearRest, beyond: &DVector<f64>, t: &LimitThresholds) -> bool {
    let touched = t.touched * beyond.amax();
    let informative = (0..beyond.len()).filter(|&k| left.is_informative[k] > 0.0);
    let (above, below): (Vec<usize>, Vec<usize>) =
        informative.partition(|&k| beyond[k].abs() > touched);
    let (x, y) = (left.x.select_rows(&below), left.y.select_rows(&below));
    let normal = x.tr_mul(&x) + DMatrix::from_diagonal(&left.ridge);
    let Some(normal) = normal.cholesky() else { return false };
    let weights = normal.solve(&x.tr_mul(&y));
    let noise = (y - x * &weights).norm_squared() / below.len().max(1) as f64;
    let gap = left.y.select_rows(&above) - left.x.select_rows(&above) * weights;
    let clamped = &gap - beyond.select_rows(&above);
    let power = gap.norm_squared() / above.len().max(1) as f64;
    power > t.above_noise * noise && gap.norm_squared() > t.above_clamped * clamped.norm_squared()
}

/// The limit of joint `j`, if effort beyond it moves nothing.
fn at_joint(
    runs: &[Along],
    left: &LinearRest,
    j: usize,
    t: &LimitThresholds,
) -> Result<Option<Limit>, LogError> {
    let mut efforts: Vec<f64> = runs.iter().flat_map(|run| run.effort(j)).map(f64::abs).collect();
    efforts.sort_by(f64::total_cmp);
    let quantile = |k: usize| {
        let lowest = t.lowest_quantile;
        let share = lowest + (1.0 - lowest) * k as f64 / TRIALS as f64;
        efforts.get((share * efforts.len() as f64) as usize).copied().unwrap_or(0.0)
    };
    let at =
        |limit: f64| Limit { joint: j, limit, ci95: [limit; 2], share: 0.0, log_evidence: 0.0 };
    let deviance = |limit: f64| trial(runs, left, &at(limit)).map(|trial| trial.deviance);
    let mut curve: Vec<(f64, f64)> = Vec::new();
    for k in 0..TRIALS {
        curve.push((quantile(k), deviance(quantile(k))?));
    }
    let Some(best) = (0..TRIALS).min_by(|&a, &b| curve[a].1.total_cmp(&curve[b].1)) else {
        return Ok(None);
    };
    let unlimited = left.residual.norm_squared();
    // Where the smallest limit does best, a smaller effort would do better still: no limit explains that.
    if best == 0 || curve[best].1 > (1.0 - t.explained) * unlimited {
        return Ok(None);
    }
    // The trials next to the best bracket it: thirds of that are dropped until nothing is left.
    let mut low = curve[best.saturating_sub(1)].0;
    let mut high = curve[(best + 1).min(TRIALS - 1)].0;
    while high - low > 1e-4 * high {
        let third = (high - low) / 3.0;
        if deviance(low + third)? > deviance(high - third)? {
            low += third;
        } else {
            high -= third;
        }
    }
    let limit = at(0.5 * (low + high));
    let found = trial(runs, left, &limit)?;
    if !moves_nothing(left, &found.beyond, t) {
        return Ok(None);
    }
    let samples = found.rest.iter().map(Vec::len).sum::<usize>() as f64;
    let independent = samples / integrated_time(&found.rest);
    let rise = t.interval_rise * found.deviance / independent;
    let mut ci95 = [limit.limit; 2];
    for (end, way) in ci95.iter_mut().zip([-1.0, 1.0]) {
        let mut step = 1e-4 * limit.limit;
        while *end > 0.0 && deviance(*end)? - found.deviance < rise && step < limit.limit {
            *end = (*end + way * step).max(0.0);
            step *= 1.5;
        }
    }
    let left = (found.deviance / unlimited).clamp(f64::MIN_POSITIVE, 1.0);
    let log_evidence = -0.5 * independent * left.ln();
    Ok(Some(Limit { ci95, share: 1.0 - left, log_evidence, ..limit }))
}
