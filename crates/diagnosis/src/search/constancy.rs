use effects::Law;
use nalgebra::{DMatrix, DVector};

use crate::columns::design::Design;
use crate::columns::run_design::RunDesign;
use crate::regression::gram::Information;
use crate::regression::linear_fit::LinearFit;
use crate::regression::problem::Problem;

/// Signals that a size may vary with: position, velocity and acceleration of the joint, and its load.
const SIGNALS: [&str; 4] = ["position", "velocity", "acceleration", "load"];

/// Number of functions of one signal.
const FUNCTIONS: usize = 2;

/// How the size of an effect would have to vary to reproduce the logs.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Variation {
    /// RMS variation as a share of the size.
    pub rms: f64,
    /// The signal that the size varies with; `None` where it differs from joint to joint.
    pub with: Option<&'static str>,
    /// Index of the joint.
    pub joint: usize,
}

/// Columns fitted in addition to a model: the torque `c` of one effect at one joint, times functions of a signal
/// there.
#[derive(Debug)]
struct Contrast {
    joint: usize,
    with: Option<&'static str>,
    /// Samples of every run by functions.
    factors: Vec<DMatrix<f64>>,
}

/// Normal equations of a model and of one [`Contrast`], over some blocks.
#[derive(Debug)]
struct Equations {
    h: DMatrix<f64>,
    g: DVector<f64>,
    yy: f64,
}

/// The variation that the size of an effect needs to reproduce the logs. `None` where a constant size may do, as it
/// does for a cause. `size` are the weights of the effect about the robot without it. About a robot with it, further
/// weights are those of its shape.
///
/// With `c` the torque of the effect, `b_k` functions of one signal z, and `X` the columns of the whole
/// model,
///
/// ```text
/// y = X w + sum_k g_k b_k(z) c,   b = z and z^2 - 1, or 1 at one of several joints,   g_k ~ N(0, 1)
/// share = (D(X) - D(X, b c)) / D(c | X without the effect)
/// ```
///
/// with `z` of zero mean and variance one. The numerator is the fall of `D` on held-out blocks, the denominator the
/// part of `c` that the other columns cannot explain. A size varies where the root of the share exceeds
/// [`variation`](crate::SearchThresholds::variation), or that of rough laws, for some signal. An effect that imitates
/// a cause of another kind explains only part of its torque, and the rest depends on the motion.
pub(crate) fn size_variation(fitted: &LinearFit, group: usize, size: &[f64]) -> Option<Variation> {
    let (problem, model) = (&*fitted.problem, fitted.model);
    let t = &problem.thresholds.search;
    let columns = problem.columns(model);
    let alone = power_alone(problem, &columns, group, size)?;
    let base = held_out_square(problem, &columns, None)?;
    let traits = problem.design.groups[group].hypothesis.traits();
    let is_rough = traits.is_some_and(|n| n.law == Law::Approximate);
    let most = if is_rough { t.variation_of_rough } else { t.variation };
    let mut largest: Option<(f64, Contrast)> = None;
    for contrast in contrasts(problem.design, group, size) {
        let fall = base - held_out_square(problem, &columns, Some(&contrast))?;
        let is_largest = largest.as_ref().is_none_or(|(least, _)| fall > *least);
        if is_largest && fall > 2.0 * t.variation_evidence && fall > most * most * alone {
            largest = Some((fall, contrast));
        }
    }
    let (fall, Contrast { joint, with, .. }) = largest?;
    Some(Variation { rms: (fall / alone).sqrt(), with, joint })
}

/// Weighted sum of squares of the torque of an effect that the other columns of a model cannot explain.
fn power_alone(problem: &Problem, columns: &[usize], group: usize, size: &[f64]) -> Option<f64> {
    let own = &problem.design.groups[group].columns;
    let others: Vec<usize> = columns.iter().copied().filter(|k| !own.contains(k)).collect();
    let h = &problem.info.h;
    let sized = own.len().min(size.len());
    let (own, size) = (&own[..sized], DVector::from_column_slice(&size[..sized]));
    let whole = size.dot(&(h.select_rows(own).select_columns(own) * &size));
    let shared = h.select_rows(&others).select_columns(own) * &size;
    let mut a = h.select_rows(&others).select_columns(&others);
    others.iter().enumerate().for_each(|(i, &k)| a[(i, i)] += problem.design.prior[k].powi(-2));
    let alone = whole - shared.dot(&a.cholesky()?.solve(&shared));
    (alone > 0.0).then_some(alone)
}

/// The variations that are tried for an effect.
fn contrasts(design: &Design, group: usize, size: &[f64]) -> Vec<Contrast> {
    let joints = &design.groups[group].joints;
    let of_joint = |&joint: &usize| {
        let torque: Vec<DVector<f64>> = design
            .runs
            .iter()
            .map(|run| effect_torque(design, run, (group, size), joint))
            .collect();
        let mut all: Vec<Contrast> = Vec::new();
        for (index, &with) in SIGNALS.iter().enumerate() {
            let (mean, sd) = spread(design, index, joint);
            let contrast_columns = |(run, torque): (&RunDesign, &DVector<f64>)| {
                let values = signal(run, index, joint);
                DMatrix::from_fn(torque.len(), FUNCTIONS, |t, k| {
                    let z = (values[t] - mean) / sd;
                    torque[t] * if k == 0 { z } else { z * z - 1.0 }
                })
            };
            let factors = design.runs.iter().zip(&torque).map(contrast_columns).collect();
            all.push(Contrast { joint, with: Some(with), factors });
        }
        if joints.len() > 1 {
            let factors =
                torque.iter().map(|c| DMatrix::from_columns(std::slice::from_ref(c))).collect();
            all.push(Contrast { joint, with: None, factors });
        }
        all
    };
    joints.iter().flat_map(of_joint).collect()
}

/// The torque of an effect of some size at a joint along a run (N·m or N).
fn effect_torque(
    design: &Design,
    run: &RunDesign,
    (group, size): (usize, &[f64]),
    joint: usize,
) -> DVector<f64> {
    let x = &run.joints[joint].x;
    let mut torque = DVector::zeros(x.nrows());
    for (k, size) in design.groups[group].columns.iter().zip(size) {
        if let Some(place) = design.local[joint].iter().position(|c| c == k) {
            torque.axpy(*size, &x.column(place), 1.0);
        }
    }
    torque
}

/// One of the [`SIGNALS`] of a joint.
fn signal(run: &RunDesign, index: usize, joint: usize) -> &[f64] {
    let joint = &run.joints[joint];
    joint.state.get(index).unwrap_or(&joint.nominal)
}

/// Mean and standard deviation of a signal over all runs.
fn spread(design: &Design, index: usize, joint: usize) -> (f64, f64) {
    let values = || design.runs.iter().flat_map(|run| signal(run, index, joint));
    let count = values().count().max(1) as f64;
    let mean = values().sum::<f64>() / count;
    let variance = values().map(|v| (v - mean).powi(2)).sum::<f64>() / count;
    (mean, variance.sqrt().max(f64::MIN_POSITIVE))
}

/// Weighted sum of squares of a model with a contrast, on blocks outside its fit.
fn held_out_square(
    problem: &Problem,
    columns: &[usize],
    contrast: Option<&Contrast>,
) -> Option<f64> {
    let mut left = 0.0;
    for (fold, training) in problem.folds.iter().zip(&problem.training) {
        let mut train = equations(problem, (training, &fold.train), columns, contrast);
        for i in 0..train.g.len() {
            let prior = columns.get(i).map_or(1.0, |&k| problem.design.prior[k]);
            train.h[(i, i)] += prior.powi(-2);
        }
        let w = train.h.cholesky()?.solve(&train.g);
        let test = problem.grams.own_information(&fold.test, &problem.weight);
        let Equations { h, g, yy } = equations(problem, (&test, &fold.test), columns, contrast);
        left += yy - 2.0 * w.dot(&g) + w.dot(&(h * &w));
    }
    Some(left)
}

/// Normal equations of the columns of a model over the blocks `of`, which `info` holds, bordered by those of a
/// contrast.
fn equations(
    problem: &Problem,
    (info, of): (&Information, &[usize]),
    columns: &[usize],
    contrast: Option<&Contrast>,
) -> Equations {
    let mut h = info.h.select_rows(columns).select_columns(columns);
    let mut g = info.g.select_rows(columns);
    let Some(Contrast { joint, factors, .. }) = contrast else {
        return Equations { h, g, yy: info.yy };
    };
    let (known, added) = (columns.len(), factors.first().map_or(0, DMatrix::ncols));
    h = h.resize(known + added, known + added, 0.0);
    g = g.resize_vertically(known + added, 0.0);
    let design = problem.design;
    for block in of.iter().map(|&b| &problem.blocks[b]) {
        let signals = &design.runs[block.run].joints[*joint];
        let (from, samples) = (block.samples.start, block.samples.len());
        let mut b = factors[block.run].rows(from, samples).into_owned();
        let weight = |t| signals.stratum(*joint, t).map_or(0.0, |s| problem.weight[s.index()]);
        let weights = DVector::from_iterator(samples, block.samples.clone().map(weight));
        let unweighted = b.clone();
        b.column_iter_mut().for_each(|mut column| column.component_mul_assign(&weights));
        let x = signals.x.rows(from, samples).tr_mul(&b);
        for (i, k) in columns.iter().enumerate() {
            let Some(place) = design.local[*joint].iter().position(|c| c == k) else { continue };
            for e in 0..added {
                h[(i, known + e)] += x[(place, e)];
                h[(known + e, i)] += x[(place, e)];
            }
        }
        let own = b.tr_mul(&unweighted);
        let mut corner = h.view_mut((known, known), (added, added));
        corner += own;
        let y = DVector::from_iterator(samples, signals.residual().skip(from).take(samples));
        let mut last = g.rows_mut(known, added);
        last += b.tr_mul(&y);
    }
    Equations { h, g, yy: info.yy }
}
