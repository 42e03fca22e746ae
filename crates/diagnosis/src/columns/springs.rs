use catalogue::EffectKind;
use effects::{Hypothesis, MODELLED, Place, TrialSpring};
use logs::LogError;
use nalgebra::DVector;
use rayon::prelude::*;
use robot::{Robot, SensingSide};

use crate::columns::design::Design;
use crate::columns::linear_rest::LinearRest;
use crate::signals::along::Along;
use crate::signals::log::Log;

/// The trial spring of the joint whose link seems most to move near its resonance on a spring: a link that swings shakes those
/// that carry it, as if these had springs too. `None` at every joint where no stiffness explains more than `least_gain` of what
/// all linear effects leave. The stiffness is the one that explains most of what the everyday effects leave, more than
/// `least_everyday_gain`: where there is no weight, another inertia of the link shifts it.
///
/// With `P` what linear effects leave of a signal, `r = P y` and `C` the change of the joint's effort by the spring,
///
/// ```text
/// gain = 1 - |r - P C|^2 / |r|^2
/// ```
///
/// A spring that is stiff for the motion needs no trial: the slope of the effort by the compliance, one of the linear
/// effects, is its column.
pub(crate) fn trial_springs(
    robot: &Robot,
    log: &Log,
    left: &[Option<LinearRest>],
    runs: &[Along],
) -> Result<Vec<Option<TrialSpring>>, LogError> {
    let of_joint = |(j, rest): (usize, &Option<LinearRest>)| {
        let hypothesis = Hypothesis { kind: EffectKind::JointElasticity, place: Place::Joint(j) };
        let drive = &robot.links()[j].actuator;
        let is_rigid = drive.elasticity.is_none() && drive.backlash <= 0.0;
        let is_tried = is_rigid && drive.sensing != SensingSide::Link && log.includes(hypothesis);
        let rest = rest.as_ref().filter(|_| is_tried)?;
        springs_in_reach(j, rest, log, runs).map(|(gain, trials)| (gain, j, trials))
    };
    let tried: Vec<Option<(f64, usize, Vec<Trial>)>> =
        left.par_iter().enumerate().map(of_joint).collect();
    let mut springs = vec![None; left.len()];
    let strongest = tried.into_iter().flatten().max_by(|a, b| a.0.total_cmp(&b.0));
    let Some((_, j, trials)) = strongest else { return Ok(springs) };
    let is_everyday = |kind| Hypothesis { kind, place: Place::Base }.is_everyday();
    let others = MODELLED.into_iter().filter(|kind| !is_everyday(*kind));
    let without: Vec<EffectKind> = others.chain(log.without.iter().copied()).collect();
    let design = Design::new(robot, &Log { without: &without, ..*log })?;
    let least = log.thresholds.springs.least_everyday_gain;
    if let Some(rest) = LinearRest::new(&design, j) {
        let gains = trials.into_iter().map(|trial| (trial.gain(&rest), trial.spring));
        let best = gains.max_by(|a, b| a.0.total_cmp(&b.0));
        springs[j] = best.filter(|(gain, _)| *gain > least).map(|(_, spring)| spring);
    }
    Ok(springs)
}

/// A spring, and the change of the effort of its joint over all runs.
struct Trial {
    spring: TrialSpring,
    change: DVector<f64>,
}

impl Trial {
    /// Share of what linear effects leave that the spring explains (power, 1).
    fn gain(&self, rest: &LinearRest) -> f64 {
        let change = self.change.component_mul(&rest.is_informative);
        let change = &change - &rest.x * rest.normal.solve(&rest.x.tr_mul(&change));
        1.0 - (&rest.residual - change).norm_squared() / rest.residual.norm_squared()
    }
}

/// The trials at joint `j` and the largest gain of one; `None` where no spring explains enough of what all linear effects
/// leave, `rest`.
fn springs_in_reach(
    j: usize,
    rest: &LinearRest,
    log: &Log,
    runs: &[Along],
) -> Option<(f64, Vec<Trial>)> {
    let samples: usize = runs.iter().map(|along| along.motion.samples()).sum();
    let whole = |along: &Along| along.motion.mean_inertia(j) * along.motion.samples() as f64;
    let inertia = runs.iter().map(whole).sum::<f64>() / samples.max(1) as f64;
    if inertia <= 0.0 {
        return None;
    }
    let stiffness_at = |hz: f64| inertia * (std::f64::consts::TAU * hz).powi(2);
    let t = &log.thresholds.springs;
    let [least, most] =
        [t.slowest, t.fastest].map(|share| stiffness_at(share * log.prepared.cutoff_hz));
    let trial = |stiffness: f64| {
        let part = |along: &Along| {
            let column = vec![along.motion.trial_compliance_part(j, stiffness.recip())];
            let finished = along.finish_columns(vec![column]);
            finished.into_iter().flatten().flat_map(|part| part.values).collect::<Vec<f64>>()
        };
        let column = DVector::from_vec(runs.iter().map(part).collect::<Vec<_>>().concat());
        let damping = 2.0 * t.damping_ratio * (stiffness * inertia).sqrt();
        Trial { spring: TrialSpring { stiffness, damping }, change: column / stiffness }
    };
    let all = std::iter::successors(Some(least), |k| Some(k * t.stiffness_ratio));
    let trials: Vec<Trial> = all.take_while(|k| *k <= most).map(trial).collect();
    let gain = trials.iter().map(|trial| trial.gain(rest)).fold(f64::NEG_INFINITY, f64::max);
    (gain > t.least_gain).then_some((gain, trials))
}
