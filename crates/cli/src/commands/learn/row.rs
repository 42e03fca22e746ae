use gaussian_process::SearchEnd;
use learner::{JointFit, ModelKind, TorqueScore, TrainedModel};
use report::{KernelRow, ModelRow};
use robot::Robot;

/// The row of the report of a model: what was learned, and its errors on the test.
pub fn row(fitted: &TrainedModel, score: TorqueScore, robot: &Robot) -> ModelRow {
    let model = &fitted.model;
    let kernels: Option<Vec<KernelRow>> =
        (0..fitted.joints.len()).map(|joint| kernel(fitted, joint, robot)).collect();
    let is_known = score.coverage.iter().any(|share| share.is_finite());
    ModelRow {
        name: model.kind.name().to_owned(),
        words: model.kind.words().to_owned(),
        points: model.process.as_ref().map_or(0, |process| process.sum.len()),
        nmse: score.nmse,
        rmse_nm: score.rmse,
        coverage_95: is_known.then_some(score.coverage),
        log_likelihood: fitted.log_likelihood,
        training_s: f64::NAN,
        prediction_us: f64::NAN,
        kernels: kernels.filter(|kernels| !kernels.is_empty()),
        remarks: remarks(fitted, robot),
    }
}

fn kernel(fitted: &TrainedModel, joint: usize, robot: &Robot) -> Option<KernelRow> {
    let JointFit { kernel, log_likelihood, lambda, .. } = fitted.joints.get(joint)?;
    let (found, inputs) = (kernel.as_ref()?, &fitted.model.process.as_ref()?.inputs);
    let scales = found.kernel.length_scales.iter().zip(&inputs.deviation);
    Some(KernelRow {
        signal_variance_nm2: found.kernel.signal_variance,
        length_scales: input_names(robot).zip(scales.map(|(l, deviation)| l * deviation)).collect(),
        noise_variance_nm2: found.noise_variance,
        log_likelihood: *log_likelihood,
        search: found.end.words(),
        evaluations: found.evaluations,
        lambda: *lambda,
        at_bounds: found.at_bounds.clone(),
        jitter_nm2: found.jitter.1,
    })
}

/// Names of the inputs with their units, in the order of the learner: positions, velocities,
/// accelerations, directions.
fn input_names(robot: &Robot) -> impl Iterator<Item = String> {
    let signals =
        [("position", ""), ("velocity", "/s"), ("acceleration", "/s²"), ("direction", "")];
    signals.into_iter().flat_map(|(signal, rate)| {
        robot.links().iter().map(move |link| {
            let unit = if link.joint.kind.is_rotation() { "rad" } else { "m" };
            match signal {
                "direction" => format!("{}.direction", link.joint.name),
                _ => format!("{}.{signal} ({unit}{rate})", link.joint.name),
            }
        })
    })
}

/// Remarks on a model: searches that did not converge, jitter, inducing points without a
/// likelihood, and the lambdas of cross-validation.
fn remarks(fitted: &TrainedModel, robot: &Robot) -> Vec<String> {
    let joints = || robot.joint_names().zip(&fitted.joints);
    let mut remarks = Vec::new();
    let mut ends: Vec<&SearchEnd> = Vec::new();
    for (_, fit) in joints() {
        let end = fit.kernel.as_ref().map(|found| &found.end);
        ends.extend(end.filter(|end| **end != SearchEnd::Converged && !ends.contains(end)));
    }
    for end in ends {
        let is_this = |fit: &JointFit| fit.kernel.as_ref().is_some_and(|found| found.end == *end);
        let names: Vec<&str> =
            joints().filter(|(_, fit)| is_this(fit)).map(|(name, _)| name).collect();
        remarks.push(format!("the search at {}: {}", names.join(", "), end.words()));
    }
    let jittered: Vec<&str> = joints()
        .filter(|(_, fit)| fit.kernel.as_ref().is_some_and(|found| found.jitter.0 > 0))
        .map(|(name, _)| name)
        .collect();
    if !jittered.is_empty() {
        remarks.push(format!(
            "at {} the covariance was not positive definite in rounding for some hyperparameters, \
             and a little was added to its diagonal",
            jittered.join(", ")
        ));
    }
    let is_of_all = matches!(
        fitted.model.kind,
        ModelKind::GpInducing | ModelKind::GpRbdInducing | ModelKind::NamedGpInducing
    );
    if is_of_all {
        remarks.push("it sums all samples, those between two points as one, so it has no likelihood to compare".to_owned());
    }
    let lambdas: Vec<String> =
        fitted.joints.iter().filter_map(|fit| fit.lambda).map(|l| l.to_string()).collect();
    if !lambdas.is_empty() {
        remarks.push(format!("lambda by cross-validation, joint by joint: {}", lambdas.join(", ")));
    }
    remarks
}
