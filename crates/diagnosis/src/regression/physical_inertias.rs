use catalogue::EffectKind;
use dynamics::{ConsistentFit, PARAMETERS_PER_LINK};
use nalgebra::{DMatrix, DVector, Matrix3, SymmetricEigen};
use robot::{Inertia, Robot};

use crate::columns::design::Design;
use crate::regression::fit::{Fit, pick};
use crate::regression::gram::Information;
use crate::regression::problem::HypothesisSet;
use crate::thresholds::sizes::SizeThresholds;

/// Weights of a model with every inertia physical.
///
/// The links of the model are profiled against all other columns, then moved to the physically consistent inertias
/// nearest in likelihood (see [`ConsistentFit`]). The other columns are fitted again with the links held.
pub(crate) fn physical_inertias(
    design: &Design,
    model: &HypothesisSet,
    info: &Information,
    robot: &Robot,
    t: &SizeThresholds,
) -> Vec<f64> {
    let links = links(design, model);
    let all = design.columns(model);
    if links.is_empty() {
        let fit = Fit::new(info, all, design.weight_prior());
        return fit.map_or_else(|| vec![0.0; design.width], |f| f.expand(design.width));
    }
    let body: Vec<usize> = links.iter().flat_map(|l| l.columns.iter().copied()).collect();
    let rest: Vec<usize> = all.into_iter().filter(|k| !body.contains(k)).collect();
    let Some(others) = Fit::new(info, rest.clone(), design.weight_prior()) else {
        return vec![0.0; design.width];
    };
    let change = consistent_change(&others, info, robot, &links, design, t);
    let mut weights = vec![0.0; design.width];
    body.iter().zip(&change).for_each(|(&k, &w)| weights[k] = w);
    // With the links held, the rest is fitted to the remainder: g_R - H_RL w_L.
    let held = Information {
        h: info.h.clone(),
        g: &info.g - &info.h * DVector::from_column_slice(&weights),
        yy: info.yy,
    };
    if let Some(fit) = Fit::new(&held, rest, design.weight_prior()) {
        let others = fit.expand(design.width);
        weights.iter_mut().zip(others).for_each(|(w, other)| *w += other);
    }
    weights
}

/// A link of a model: its index, its ten columns, and whether they are those of a payload that it holds.
struct LinkOfModel {
    link: usize,
    columns: Vec<usize>,
    holds: bool,
}

/// The links of a model.
fn links(design: &Design, model: &HypothesisSet) -> Vec<LinkOfModel> {
    let of = |&g: &usize| {
        let group = &design.groups[g];
        let holds = group.hypothesis.kind == EffectKind::Payload;
        let columns = group.columns.clone();
        group.hypothesis.link().map(|link| LinkOfModel { link, columns, holds })
    };
    model.iter().filter_map(of).collect()
}

/// Changes of the links' parameters, in the order of `links`, with which every inertia stays physical.
fn consistent_change(
    others: &Fit,
    info: &Information,
    robot: &Robot,
    links: &[LinkOfModel],
    design: &Design,
    t: &SizeThresholds,
) -> Vec<f64> {
    let body: Vec<usize> = links.iter().flat_map(|l| l.columns.iter().copied()).collect();
    let flat = vec![f64::INFINITY; design.width];
    let (complement, score) = others.beyond(info, &body, &flat);
    let prior = pick(&DVector::from_column_slice(&design.prior), &body);
    let (h, change) = shrink_change(&complement.b, &score, &prior, t.sharpest_inertia);
    let nominal: Vec<f64> = robot.links().iter().flat_map(|l| l.inertia.parameters()).collect();
    let place: Vec<usize> = links
        .iter()
        .flat_map(|l| (0..PARAMETERS_PER_LINK).map(move |p| PARAMETERS_PER_LINK * l.link + p))
        .collect();
    let mut information = DMatrix::zeros(nominal.len(), nominal.len());
    let mut estimate = nominal.clone();
    for (i, &row) in place.iter().enumerate() {
        estimate[row] += change[i];
        place.iter().enumerate().for_each(|(k, &column)| information[(row, column)] = h[(i, k)]);
    }
    let indices: Vec<usize> = links.iter().map(|l| l.link).collect();
    let fit = ConsistentFit {
        robot: &with_held_bodies(robot, links, &estimate, t.held_thickness),
        information: &information,
        estimate: &estimate,
        links: &indices,
        prior_weight: t.inertia_prior,
    };
    // A change that is physical as it stands is kept. Otherwise the nearer in likelihood of two physical changes is
    // taken; the second of them exists even where the solver fails.
    let back = largest_physical_part(&nominal, &place, &change);
    let found = fit.solve().ok().map(|found| {
        DVector::from_iterator(place.len(), place.iter().map(|&k| found.parameters[k] - nominal[k]))
    });
    let distance = |w: &DVector<f64>| (w - &change).dot(&(&h * (w - &change)));
    let nearest = found.filter(|w| distance(w) < distance(&back)).unwrap_or(back);
    nearest.iter().copied().collect()
}

/// The robot from whose inertias a change is measured.
///
/// The inertia of a link says nothing of what it holds, which may weigh many times as much. A change by a payload is
/// therefore measured from a body of the estimated mass and centre; without a positive mass, from the link.
fn with_held_bodies(
    robot: &Robot,
    links: &[LinkOfModel],
    estimate: &[f64],
    thickness: f64,
) -> Robot {
    let mut robot = robot.clone();
    let (of_links, _) = estimate.as_chunks::<PARAMETERS_PER_LINK>();
    for LinkOfModel { link, .. } in links.iter().filter(|l| l.holds) {
        let body = of_links.get(*link);
        let body = body.and_then(|pi| thicken(&Inertia::from_parameters(pi), thickness));
        if let (Some(body), Some(link)) = (body, robot.link_mut(*link)) {
            link.inertia = body;
        }
    }
    robot
}

/// The body of the same mass and centre of mass that has at least a thickness along every axis, a share of its distance
/// from the origin. `None` where the mass is not positive.
///
/// ```text
/// S_com = tr(I_com)/2 1 - I_com >= m (thickness r)^2,   m r^2 = m |c|^2 + tr|S_com|
/// ```
fn thicken(body: &Inertia, thickness: f64) -> Option<Inertia> {
    if body.mass.is_nan() || body.mass <= 0.0 {
        return None;
    }
    let half = 0.5 * body.about_com.trace();
    let mut moments = SymmetricEigen::new(Matrix3::identity() * half - body.about_com);
    let about_origin =
        moments.eigenvalues.abs().sum() + body.mass * body.com_in_link.norm_squared();
    let least = thickness * thickness * about_origin;
    moments.eigenvalues.apply(|value| *value = value.max(least));
    let about_com = Matrix3::identity() * moments.eigenvalues.sum() - moments.recompose();
    (least > 0.0).then_some(Inertia { about_com, ..body.clone() })
}

/// Information and most likely change of some weights, in the eigenvectors of
/// `P H P = V diag(l) V'` with `P` the priors' standard deviations:
///
/// ```text
/// l' = l / (1 + l sharpest^2),  change = P V diag(1 / (1 + l)) V' P score
/// ```
///
/// Each direction keeps a standard deviation of at least the share `sharpest` of its prior, which keeps the problem
/// well conditioned. Directions that the data do not show stay unchanged.
fn shrink_change(
    h: &DMatrix<f64>,
    score: &DVector<f64>,
    prior: &DVector<f64>,
    sharpest: f64,
) -> (DMatrix<f64>, DVector<f64>) {
    let n = h.nrows();
    let scaled = DMatrix::from_fn(n, n, |i, k| 0.5 * prior[i] * (h[(i, k)] + h[(k, i)]) * prior[k]);
    if scaled.iter().any(|v| !v.is_finite()) {
        return (DMatrix::zeros(n, n), DVector::zeros(n));
    }
    let eigen = SymmetricEigen::new(scaled);
    let seen = eigen.eigenvalues.map(|l| l.max(0.0));
    let kept = seen.map(|l| l / (1.0 + l * sharpest * sharpest));
    let shrunk = seen.map(|l| 1.0 / (1.0 + l));
    let v = &eigen.eigenvectors;
    let change = v * shrunk.component_mul(&v.tr_mul(&score.component_mul(prior)));
    let known = v * DMatrix::from_diagonal(&kept) * v.transpose();
    let information = DMatrix::from_fn(n, n, |i, k| {
        0.5 * (known[(i, k)] + known[(k, i)]) / (prior[i] * prior[k])
    });
    (information, change.component_mul(prior))
}

/// The largest part of a change, in tenths, with which every inertia stays physical.
fn largest_physical_part(nominal: &[f64], place: &[usize], change: &DVector<f64>) -> DVector<f64> {
    let part = |tenths: u32| change.map(|c| c * f64::from(tenths) / 10.0);
    let physical = |change: &DVector<f64>| {
        let mut all = nominal.to_vec();
        place.iter().zip(change.iter()).for_each(|(&k, c)| all[k] += c);
        let is_changed = |link: usize| place.iter().any(|k| k / PARAMETERS_PER_LINK == link);
        all.as_chunks::<PARAMETERS_PER_LINK>().0.iter().enumerate().all(|(link, pi)| {
            !is_changed(link) || Inertia::from_parameters(pi).pseudo_inertia().cholesky().is_some()
        })
    };
    let largest = (1..=10).rev().map(part).find(physical);
    largest.unwrap_or_else(|| DVector::zeros(place.len()))
}
