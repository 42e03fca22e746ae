use catalogue::EffectKind;
use logs::{LogError, Prepared};
use robot::Robot;

use crate::design::Design;
use crate::gram::Grams;
use crate::problem::{Model, Problem};
use crate::settle::settle;

/// Rounds of fitting anew about the extended robot.
const ROUNDS: usize = 2;

/// Whether the columns of an effect are those of a small change only, or follow from what the
/// other findings change.
fn is_tangent(kind: EffectKind) -> bool {
    is_made_of_torque(kind)
        || matches!(kind, EffectKind::TorqueConstant | EffectKind::GravityDirection)
}

/// Whether the columns of an effect are made of the model's own torque, which is wrong wherever
/// something else is.
pub(crate) fn is_made_of_torque(kind: EffectKind) -> bool {
    use EffectKind as K;
    matches!(
        kind,
        K::LoadDependentFriction
            | K::EncoderOffset
            | K::TransmissionRatio
            | K::Backlash
            | K::JointElasticity
            | K::TimeSkew
            | K::ActuatorDelay
            | K::ActuatorLag
    )
}

/// The robot changed by the weights of a model.
pub(crate) fn extended(robot: &Robot, design: &Design, model: &Model, weights: &[f64]) -> Robot {
    let mut changed = robot.clone();
    for &g in model {
        let group = &design.groups[g];
        let own: Vec<f64> = group.columns.iter().map(|&k| weights[k]).collect();
        group.hypothesis.extend(&mut changed, &own, &design.frame);
    }
    changed
}

/// The robot changed by the weights of a model, with what is left of the changes fitted
/// again about it where columns are tangents only: a gain scales what the other findings
/// add, and a tilt turns gravity on a circle. A Gauss-Newton iteration.
pub(crate) fn extended_anew(
    robot: &Robot,
    prepared: &Prepared,
    problem: &Problem,
    (model, weights): (&Model, &[f64]),
) -> Result<Robot, LogError> {
    let mut changed = extended(robot, problem.design, model, weights);
    let tangent = |&g: &usize| is_tangent(problem.design.groups[g].hypothesis.kind);
    if !model.iter().any(tangent) {
        return Ok(changed);
    }
    for _ in 0..ROUNDS {
        let design = Design::new(&changed, prepared, &problem.design.moved)?;
        let same = model.iter().filter_map(|&g| design.find(problem.design.groups[g].hypothesis));
        let model: Model = same.collect();
        let grams = Grams::new(&design, problem.blocks);
        let weight = problem.weight.clone();
        let about = Problem::new(&design, problem.blocks, &grams, &problem.of, weight);
        let weights = settle(&about, &model, &about.info, &changed);
        changed = extended(&changed, &design, &model, &weights);
    }
    Ok(changed)
}
