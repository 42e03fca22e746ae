use catalogue::EffectKind;
use effects::{Hypothesis, Place, ShapedRobot, TrialSpring};
use logs::LogError;

use crate::columns::design::Design;
use crate::regression::blocks::blocks;
use crate::regression::fitted_model::fit_model;
use crate::regression::gram::Grams;
use crate::regression::noise::Noise;
use crate::regression::problem::{HypothesisSet, Problem};
use crate::signals::log::Log;

/// Fits stiffness and damping of the trial springs of a robot, together with the everyday effects of their joints. A design
/// about the robot that has them shows what else there is.
pub(crate) fn fit_trial_springs(shaped: &mut ShapedRobot, log: &Log) -> Result<(), LogError> {
    let tried: Vec<usize> =
        (0..shaped.trial_springs.len()).filter(|j| shaped.trial_springs[*j].is_some()).collect();
    if tried.is_empty() {
        return Ok(());
    }
    let kinds = [
        EffectKind::ViscousFriction,
        EffectKind::CoulombFriction,
        EffectKind::TorqueOffset,
        EffectKind::RotorInertia,
        EffectKind::JointElasticity,
    ];
    let of_joint = |&j: &usize| kinds.map(|kind| Hypothesis { kind, place: Place::Joint(j) });
    let hypotheses: Vec<Hypothesis> =
        tried.iter().flat_map(of_joint).filter(|h| log.includes(*h)).collect();
    let design = Design::of_shaped_with(shaped, log, &hypotheses)?;
    let t = log.thresholds;
    let blocks = blocks(&design, 1.0, &t.blocks);
    let grams = Grams::new(&design, &blocks);
    let all: Vec<usize> = (0..blocks.len()).collect();
    let noise = Noise::of_grams(&grams.sums(&all), t.signals.least_sliding);
    let weight = noise.weights(&design.moved);
    let problem = Problem::new(&design, &blocks, &grams, &all, weight, t);
    let model: HypothesisSet = (0..design.groups.len()).collect();
    let fitted = fit_model(&shaped.robot, log, &problem, &model)?;
    for j in tried {
        let drive = &fitted.robot.links()[j].actuator;
        let spring = drive.elasticity.zip(drive.elasticity_damping);
        shaped.trial_springs[j] =
            spring.map(|(stiffness, damping)| TrialSpring { stiffness, damping });
    }
    Ok(())
}
