use dynamics::{ConsistentFit, PARAMETERS_PER_LINK};
use nalgebra::{DMatrix, DVector};
use robot::Robot;

use crate::design::Design;
use crate::fit::{Fit, pick};
use crate::gram::Information;
use crate::problem::{Model, Problem};

/// Weight of the divergence from the nominal inertias, in units of the log-likelihood: a
/// pseudo-inertia that differs by its own size counts like one standard deviation.
const PRIOR_WEIGHT: f64 = 1.0;

/// Share of the largest information below which a direction counts as unseen.
const UNSEEN: f64 = 1e-9;

/// Weights of a model with every inertia physical.
///
/// Links of the model are profiled against all other columns, moved to the physically
/// consistent inertias nearest in likelihood (see [`ConsistentFit`]), and the other
/// columns are fitted again with the links held.
pub(crate) fn settle(
    problem: &Problem,
    model: &Model,
    info: &Information,
    robot: &Robot,
) -> Vec<f64> {
    let design = problem.design;
    let links = links(design, model);
    let all = problem.columns(model);
    if links.is_empty() {
        let fit = Fit::new(info, all, design.beliefs());
        return fit.map_or_else(|| vec![0.0; design.width], |f| f.expand(design.width));
    }
    let body: Vec<usize> = links.iter().flat_map(|(_, c)| c.iter().copied()).collect();
    let rest: Vec<usize> = all.into_iter().filter(|k| !body.contains(k)).collect();
    let Some(others) = Fit::new(info, rest.clone(), design.beliefs()) else {
        return vec![0.0; design.width];
    };
    let change = consistent_change(&others, info, robot, &links, design);
    let mut weights = vec![0.0; design.width];
    body.iter().zip(&change).for_each(|(&k, &w)| weights[k] = w);
    // With the links held, the rest answers what is left: g_R - H_RL w_L.
    let held = Information {
        h: info.h.clone(),
        g: &info.g - &info.h * DVector::from_column_slice(&weights),
        yy: info.yy,
    };
    if let Some(fit) = Fit::new(&held, rest, design.beliefs()) {
        let others = fit.expand(design.width);
        weights.iter_mut().zip(others).for_each(|(w, other)| *w += other);
    }
    weights
}

/// The links of a model, each with its ten columns.
pub(crate) fn links(design: &Design, model: &Model) -> Vec<(usize, Vec<usize>)> {
    let of = |&g: &usize| {
        let group = &design.groups[g];
        group.hypothesis.link().map(|link| (link, group.columns.clone()))
    };
    model.iter().filter_map(of).collect()
}

/// Changes of the links' parameters, in the order of `links`, that keep every inertia
/// physical; zero where the solver found no answer.
fn consistent_change(
    others: &Fit,
    info: &Information,
    robot: &Robot,
    links: &[(usize, Vec<usize>)],
    design: &Design,
) -> Vec<f64> {
    let body: Vec<usize> = links.iter().flat_map(|(_, c)| c.iter().copied()).collect();
    let flat = vec![f64::INFINITY; design.width];
    let (complement, u) = others.beyond(info, &body, &flat);
    let h = &complement.b;
    let prior = pick(&DVector::from_column_slice(&design.prior), &body);
    // Seen directions are solved for, unseen ones stay: (P H P + eps) x = P u.
    let scaled = DMatrix::from_fn(h.nrows(), h.ncols(), |i, k| prior[i] * h[(i, k)] * prior[k]);
    let eps = UNSEEN * scaled.diagonal().max();
    let solved = (scaled + DMatrix::identity(h.nrows(), h.ncols()) * eps)
        .cholesky()
        .map(|c| c.solve(&u.component_mul(&prior)).component_mul(&prior));
    let Some(estimate) = solved else { return vec![0.0; body.len()] };
    let nominal: Vec<f64> = robot.links().iter().flat_map(|l| l.inertia.parameters()).collect();
    let place: Vec<usize> = links
        .iter()
        .flat_map(|(link, _)| (0..PARAMETERS_PER_LINK).map(move |p| PARAMETERS_PER_LINK * link + p))
        .collect();
    let mut information = DMatrix::zeros(nominal.len(), nominal.len());
    let mut target = nominal.clone();
    for (i, &row) in place.iter().enumerate() {
        target[row] += estimate[i];
        for (k, &column) in place.iter().enumerate() {
            information[(row, column)] = 0.5 * (h[(i, k)] + h[(k, i)]);
        }
    }
    let fit = ConsistentFit {
        robot,
        information: &information,
        estimate: &target,
        links: &links.iter().map(|(link, _)| *link).collect::<Vec<_>>(),
        prior_weight: PRIOR_WEIGHT,
    };
    match fit.solve() {
        Ok(found) => place.iter().map(|&k| found.parameters[k] - nominal[k]).collect(),
        Err(_) => vec![0.0; body.len()],
    }
}
