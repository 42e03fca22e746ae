use catalogue::EffectKind;
use effects::{ColumnPart, MODELLED};
use logs::LogError;
use nalgebra::DVector;
use rayon::prelude::*;
use robot::Robot;

use crate::columns::design::Design;
use crate::columns::linear_rest::LinearRest;
use crate::signals::along::Along;
use crate::signals::log::Log;

/// Trial times by which goals are late (s): a bus takes milliseconds, a program that sends at 30 Hz some hundred.
const STEP_S: f64 = 0.005;
const STEPS: usize = 40;

/// Halvings of the step about the best trial time: to .01 ms.
const HALVINGS: usize = 9;

/// The time by which goals are later than described that explains the efforts best, beside dry friction and offsets (s); 0
/// where efforts are logged, or none explains anything.
///
/// ```text
/// least sum over joints of |P (y - kp (goal(t) - goal(t - lateness)))|^2 / |P y|^2,   y measured less nominal effort
/// ```
///
/// with `P` what is left by dry friction and offset. Viscous friction and rotors stand for late goals to first order, so they
/// take no part.
pub(crate) fn best_lateness_s(robot: &Robot, log: &Log, runs: &[Along]) -> Result<f64, LogError> {
    let has_goals = runs.iter().any(|along| along.motion.late_goals(0, 0.0).is_some());
    if !has_goals || log.without.contains(&EffectKind::GoalDelay) {
        return Ok(0.0);
    }
    let beside = [EffectKind::CoulombFriction, EffectKind::TorqueOffset];
    let without: Vec<EffectKind> =
        MODELLED.into_iter().filter(|kind| !beside.contains(kind)).collect();
    let design = Design::new(robot, &Log { without: &without, ..*log })?;
    let left: Vec<Option<LinearRest>> = (0..design.joints())
        .into_par_iter()
        .map(|j| log.moved[j].then(|| LinearRest::new(&design, j))?)
        .collect();
    let misfit = |lateness_s: f64| misfit(&left, runs, lateness_s);
    let trials: Vec<f64> = (0..=STEPS).map(|k| STEP_S * k as f64).collect();
    let misfits: Vec<f64> = trials.par_iter().map(|s| misfit(*s)).collect();
    let best = (0..trials.len()).min_by(|&a, &b| misfits[a].total_cmp(&misfits[b])).unwrap_or(0);
    if best == 0 {
        return Ok(0.0);
    }
    let (mut lateness_s, mut least, mut step_s) = (trials[best], misfits[best], STEP_S);
    for _ in 0..HALVINGS {
        step_s *= 0.5;
        for trial_s in [lateness_s - step_s, lateness_s + step_s] {
            let found = misfit(trial_s);
            if found < least {
                (lateness_s, least) = (trial_s, found);
            }
        }
    }
    Ok(lateness_s)
}

/// What late goals leave of the residual efforts, in units of their mean squares and summed over the joints.
fn misfit(left: &[Option<LinearRest>], runs: &[Along], lateness_s: f64) -> f64 {
    let columns = |along: &Along| {
        let joints = 0..left.len();
        let part =
            |joint| Some(ColumnPart { joint, values: along.motion.late_goals(joint, lateness_s)? });
        along.finish_columns(vec![joints.filter_map(part).collect()])
    };
    let finished: Vec<_> = runs.iter().map(columns).collect();
    let of_joint = |(j, rest): (usize, &LinearRest)| {
        let part = |run: &Vec<effects::EffectColumn>| {
            run[0].iter().find(|part| part.joint == j).map(|part| part.values.clone())
        };
        let parts: Option<Vec<Vec<f64>>> = finished.iter().map(part).collect();
        let Some(parts) = parts else { return 0.0 };
        let late = DVector::from_vec(parts.concat()).component_mul(&rest.is_informative);
        let late = &late - &rest.x * rest.normal.solve(&rest.x.tr_mul(&late));
        (&rest.residual - late).norm_squared() * rest.weight
    };
    let joints = left.iter().enumerate().filter_map(|(j, rest)| Some((j, rest.as_ref()?)));
    joints.map(of_joint).sum()
}
