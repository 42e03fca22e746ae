use effects::Hypothesis;
use robot::Robot;

use crate::columns::design::Design;
use crate::columns::prior::Prior;
use crate::regression::fit::Fit;
use crate::regression::gram::Information;
use crate::regression::problem::HypothesisSet;
use crate::signals::log::Log;

/// Whether `h` is a change of a link whose inertia is described.
pub(crate) fn is_described_body(h: Hypothesis, about: &Robot, log: &Log) -> bool {
    let is_described = h.link().is_some_and(|l| about.links()[l].inertia.mass > 0.0);
    is_described && h.cad_error_sd(about, &log.thresholds.priors).is_some()
}

/// How far the described bodies of a robot are off, in errors of CAD: the one of `candidates` that gives a model with
/// many links the most evidence.
///
/// A description of CAD is good to a tenth and a centimetre, a published one may err by several times that. One prior
/// for all of them either hides the errors of the one or spoils the other.
pub(crate) fn choose_body_errors(
    design: &Design,
    about: &Robot,
    info: &Information,
    candidates: &[f64],
) -> Option<f64> {
    let model: HypothesisSet = (0..design.groups.len()).collect();
    let columns = design.columns(&model);
    let evidence = |errors: f64| {
        let sd = prior_of_bodies(design, about, errors);
        let prior = Prior { sd: &sd, of_any_scale: &[], ..design.weight_prior() };
        Fit::new(info, columns.clone(), prior).map_or(f64::NEG_INFINITY, |fit| fit.evidence)
    };
    candidates.iter().copied().max_by(|a, b| evidence(*a).total_cmp(&evidence(*b)))
}

/// Prior standard deviations of all weights of a design, those of the links `errors` times the errors of CAD.
pub(crate) fn prior_of_bodies(design: &Design, about: &Robot, errors: f64) -> Vec<f64> {
    let mut prior = design.prior.clone();
    for group in &design.groups {
        let Some(cad) = group.hypothesis.cad_error_sd(about, &design.priors) else { continue };
        group.columns.iter().zip(cad).for_each(|(&k, sd)| prior[k] = errors * sd);
    }
    prior
}
