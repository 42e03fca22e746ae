use std::collections::{BTreeMap, BTreeSet};

use catalogue::EffectKind;
use effects::{EffectColumn, Frame, Hypothesis, Scale, ShapedRobot, TrialShape, trial_shapes};
use logs::LogError;
use nalgebra::{DMatrix, DVector};
use rayon::prelude::*;
use robot::Robot;

use crate::columns::design::Design;
use crate::columns::late_goals::best_lateness_s;
use crate::columns::linear_rest::LinearRest;
use crate::columns::springs::trial_springs;
use crate::signals::along::Along;
use crate::signals::log::Log;

/// Number of trial shapes that are evaluated at once: before they are decimated, their columns are as long as the
/// motion.
const AT_ONCE: usize = 8;

/// The robot with the best trial shape of every effect whose columns are not linear in one of its parameters. The
/// best value explains most of the residual of the linear effects.
///
/// With `X` the columns of the linear effects, `C` those of a trial shape and `r = y - X w`,
///
/// ```text
/// explained = r' C (C' C - C' X (X' X + 1 / prior^2)^-1 X' C)^-1 C' r
/// ```
///
/// summed over the joints that the shape reaches, each weighted by the inverse power of its `r`.
pub(crate) fn with_best_shapes(robot: &Robot, log: &Log) -> Result<ShapedRobot, LogError> {
    let (prepared, moved) = (log.prepared, log.moved);
    let relevant = |g: &TrialShape| {
        let looked_for = !log.without.contains(&g.hypothesis.kind);
        looked_for && g.hypothesis.joint().is_some_and(|j| moved[j])
    };
    let shapes: Vec<TrialShape> =
        trial_shapes(robot, &Scale::of_logs(robot, prepared), &log.thresholds.priors)
            .into_iter()
            .filter(relevant)
            .collect();
    let kinds = shapes.iter().map(|shape| shape.hypothesis.kind).chain(log.without.iter().copied());
    let without: Vec<EffectKind> = kinds.collect::<BTreeSet<_>>().into_iter().collect();
    let design = Design::new(robot, &Log { without: &without, ..*log })?;
    let frame = Frame::of_logs(prepared);
    let mut runs = log.along(robot, &frame)?;
    let left: Vec<Option<LinearRest>> = (0..design.joints())
        .into_par_iter()
        .map(|j| moved[j].then(|| LinearRest::new(&design, j))?)
        .collect();
    let mut explained = Vec::with_capacity(shapes.len());
    for some in shapes.chunks(AT_ONCE) {
        let columns = columns(some, &mut runs);
        let of_each =
            columns.into_par_iter().map(|runs| explained_power(&left, &runs).unwrap_or(0.0));
        explained.extend(of_each.collect::<Vec<f64>>());
    }
    let mut best: BTreeMap<Hypothesis, (f64, TrialShape)> = BTreeMap::new();
    for (shape, explained) in shapes.into_iter().zip(explained) {
        let known = best.entry(shape.hypothesis).or_insert((explained, shape));
        if explained > known.0 {
            *known = (explained, shape);
        }
    }
    let mut shaped = ShapedRobot::new(robot.clone());
    best.into_values().for_each(|(_, shape)| shaped.set_shape(shape));
    shaped.trial_springs = trial_springs(robot, log, &left, &runs)?;
    shaped.trial_lateness_s = best_lateness_s(robot, log, &runs)?;
    Ok(shaped)
}

/// The columns of some trial shapes, `[shape][run][weight]`.
fn columns(shapes: &[TrialShape], runs: &mut [Along]) -> Vec<Vec<Vec<EffectColumn>>> {
    let mut all = vec![Vec::new(); shapes.len()];
    for along in runs {
        let raw: Vec<Vec<EffectColumn>> =
            shapes.iter().map(|g| g.columns(&mut along.motion)).collect();
        let finished = raw.into_par_iter().map(|c| along.finish_columns(c)).collect::<Vec<_>>();
        all.iter_mut().zip(finished).for_each(|(of, columns)| of.push(columns));
    }
    all
}

/// Power of the residual efforts that the columns of one trial shape, `[run][weight]`, explain, in units of their
/// mean squares.
fn explained_power(left: &[Option<LinearRest>], runs: &[Vec<EffectColumn>]) -> Option<f64> {
    let width = runs.first()?.len();
    let (mut normal, mut score) = (DMatrix::zeros(width, width), DVector::zeros(width));
    for (j, left) in left.iter().enumerate() {
        let Some(left) = left else { continue };
        let column = |k: usize| -> Option<DVector<f64>> {
            let part = |run: &Vec<EffectColumn>| {
                run[k].iter().find(|p| p.joint == j).map(|p| p.values.clone())
            };
            let parts: Option<Vec<Vec<f64>>> = runs.iter().map(part).collect();
            Some(DVector::from_vec(parts?.concat()).component_mul(&left.is_informative))
        };
        let Some(columns) = (0..width).map(column).collect::<Option<Vec<_>>>() else { continue };
        let c = DMatrix::from_columns(&columns);
        let across = left.x.tr_mul(&c);
        normal += (c.tr_mul(&c) - across.tr_mul(&left.normal.solve(&across))) * left.weight;
        score += c.tr_mul(&left.residual) * left.weight;
    }
    // A direction that the linear effects have already explains nothing more.
    for k in 0..width {
        normal[(k, k)] *= 1.0 + 1e-9;
    }
    let weights = normal.cholesky()?.solve(&score);
    Some(score.dot(&weights))
}
