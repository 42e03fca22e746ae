use effects::{Hypothesis, hypotheses};
use robot::Robot;

use crate::columns::design::Design;
use crate::columns::prior::Prior;
use crate::error::DiagnosisError;
use crate::regression::fit::Fit;
use crate::regression::problem::HypothesisSet;
use crate::search::inputs::Inputs;
use crate::settings::Settings;
use crate::signals::log::Log;

/// How far the described bodies of a robot are off, in errors of CAD: the one of
/// [`crate::thresholds::search::SearchThresholds::body_errors`] that gives the model of an arm as arms are the most
/// evidence. This model has the everyday effects of every joint and all ten parameters of every link.
///
/// A description of CAD is good to a tenth and a centimetre, a published one may err by several times that. One prior
/// for all of them either hides the errors of the one or lets a link of the other take the work of rotors.
pub(crate) fn choose_body_errors(
    about: &Robot,
    settings: &Settings,
    log: &Log,
    inadequate: &[Option<String>],
) -> Result<f64, DiagnosisError> {
    let is_asked =
        |h: &Hypothesis| log.includes(*h) && (h.is_everyday() || is_body(*h, about, log));
    let asked: Vec<Hypothesis> = hypotheses(about).into_iter().filter(is_asked).collect();
    let design = Design::of(about, log, &asked)?;
    let inputs =
        Inputs { nominal: about, robot: about, settings, log: *log, design: &design, inadequate };
    inputs.with_dataset(|dataset| {
        let all: Vec<usize> = (0..dataset.blocks.len()).collect();
        let problem = dataset.problem(&all);
        let model: HypothesisSet = (0..design.groups.len()).collect();
        let noise = problem.noise(&model);
        let problem = problem.with_weights(noise.weights(&design.moved));
        let columns = problem.columns(&model);
        let evidence = |errors: f64| {
            let sd = prior_of_bodies(&design, about, errors, log);
            let prior = Prior { sd: &sd, bounds: &design.bounds };
            let fit = Fit::new(&problem.info, columns.clone(), prior);
            fit.map_or(f64::NEG_INFINITY, |fit| fit.evidence)
        };
        let candidates = log.thresholds.search.body_errors.iter().copied();
        let best = candidates.max_by(|a, b| evidence(*a).total_cmp(&evidence(*b)));
        best.unwrap_or(log.thresholds.priors.body_errors)
    })
}

/// Whether `h` is a change of a link whose inertia is described.
fn is_body(h: Hypothesis, about: &Robot, log: &Log) -> bool {
    let is_described = h.link().is_some_and(|l| about.links()[l].inertia.mass > 0.0);
    is_described && h.cad_error_sd(about, &log.thresholds.priors).is_some()
}

/// Prior standard deviations of all weights, those of the links `errors` times the errors of CAD.
fn prior_of_bodies(design: &Design, about: &Robot, errors: f64, log: &Log) -> Vec<f64> {
    let mut prior = design.prior.clone();
    for group in &design.groups {
        let Some(cad) = group.hypothesis.cad_error_sd(about, &log.thresholds.priors) else {
            continue;
        };
        group.columns.iter().zip(cad).for_each(|(&k, sd)| prior[k] = errors * sd);
    }
    prior
}
