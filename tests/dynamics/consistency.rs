//! The nearest physical inertias: recovered, enforced, left alone.

use dynamics::{ConsistentFit, ConsistentInertias, DynamicsError, FitOutcome};
use nalgebra::{DMatrix, DVector, Matrix4};
use robot::{Inertia, Robot};

use checks::arms::{draw, draw_inertia, generator, random_tree};

fn parameters(robot: &Robot) -> Vec<f64> {
    robot.links().iter().flat_map(|link| link.inertia.parameters()).collect()
}

fn inertia(pi: &[f64], link: usize) -> Inertia {
    Inertia::from_parameters(pi[10 * link..10 * link + 10].try_into().unwrap())
}

fn smallest_eigenvalue(j: Matrix4<f64>) -> f64 {
    j.symmetric_eigenvalues().min()
}

/// Information of `rows` random measurements; singular when there are fewer than parameters.
fn information(n: usize, rows: usize, seed: u64) -> DMatrix<f64> {
    let y = DMatrix::from_iterator(rows, n, draw(&mut generator(seed), rows * n, 1.0));
    y.tr_mul(&y)
}

fn solve(
    robot: &Robot,
    information: &DMatrix<f64>,
    estimate: &[f64],
    links: &[usize],
    prior_weight: f64,
) -> ConsistentInertias {
    ConsistentFit { robot, information, estimate, links, prior_weight }.solve().unwrap()
}

fn assert_converged(fit: &ConsistentInertias) {
    assert!(matches!(fit.outcome, FitOutcome::Converged { .. }), "{:?}", fit.outcome);
}

/// Gradient of the objective over the free parameters, by the definition of its terms.
fn gradient(
    prior: &Robot,
    information: &DMatrix<f64>,
    estimate: &[f64],
    weight: f64,
    pi: &[f64],
) -> DVector<f64> {
    let n = pi.len();
    let error = DVector::from_iterator(n, pi.iter().zip(estimate).map(|(p, e)| p - e));
    let mut gradient = information * error;
    for link in 0..n / 10 {
        let prior = prior.links()[link].inertia.pseudo_inertia().try_inverse().unwrap();
        let here = inertia(pi, link).pseudo_inertia();
        for k in 0..10 {
            // J is linear: a difference is its derivative.
            let mut moved = pi[10 * link..10 * link + 10].to_vec();
            moved[k] += 1.0;
            let e = inertia(&moved, 0).pseudo_inertia() - here;
            gradient[10 * link + k] += weight * ((prior - here.try_inverse().unwrap()) * e).trace();
        }
    }
    gradient
}

#[test]
fn a_physical_estimate_is_recovered_when_the_prior_weighs_nothing() {
    let robot = random_tree(2);
    let all: Vec<usize> = (0..robot.joint_count()).collect();
    let mut rng = generator(21);
    let estimate: Vec<f64> = all.iter().flat_map(|_| draw_inertia(&mut rng).parameters()).collect();
    let information = information(estimate.len(), 400, 22);
    let fit = solve(&robot, &information, &estimate, &all, 1e-12);
    assert_converged(&fit);
    assert!(fit.shifted.is_empty());
    for (found, expected) in fit.parameters.iter().zip(&estimate) {
        assert!((found - expected).abs() < 1e-7, "{found} and {expected}");
    }
}

#[test]
fn an_impossible_estimate_gives_physical_inertias_at_the_optimum() {
    let robot = random_tree(3);
    let all: Vec<usize> = (0..robot.joint_count()).collect();
    let mut estimate = parameters(&robot);
    estimate[10] = -2.0;
    estimate[34] = -0.5;
    let information = information(estimate.len(), 400, 23);
    for weight in [1e2, 1.0, 1e-3, 1e-6] {
        let fit = solve(&robot, &information, &estimate, &all, weight);
        assert_converged(&fit);
        for &link in &all {
            assert!(smallest_eigenvalue(inertia(&fit.parameters, link).pseudo_inertia()) > 0.0);
        }
    }
    let fit = solve(&robot, &information, &estimate, &all, 1e-3);
    let gradient = gradient(&robot, &information, &estimate, 1e-3, &fit.parameters);
    assert!(gradient.amax() < 1e-7, "{}", gradient.amax());
    // Negative control: at the prior the gradient is far from zero.
    let there = self::gradient(&robot, &information, &estimate, 1e-3, &parameters(&robot));
    assert!(there.amax() > 1.0);
}

#[test]
fn directions_without_information_stay_at_the_prior() {
    let robot = random_tree(4);
    let (all, prior) = ((0..robot.joint_count()).collect::<Vec<_>>(), parameters(&robot));
    let mut estimate = prior.clone();
    // Only the mass of link 2 is known, and nothing at all about the others.
    estimate[20] *= 1.5;
    let mut information = DMatrix::zeros(prior.len(), prior.len());
    information[(20, 20)] = 1e6;
    let fit = solve(&robot, &information, &estimate, &all, 1e-3);
    assert_converged(&fit);
    assert!((fit.parameters[20] / prior[20] - 1.5).abs() < 1e-6);
    for i in (0..prior.len()).filter(|i| !(20..30).contains(i)) {
        assert!((fit.parameters[i] - prior[i]).abs() < 1e-9);
    }
}

#[test]
fn links_that_are_not_free_stay_and_the_others_make_up_for_them() {
    let robot = random_tree(6);
    let prior = parameters(&robot);
    let n = prior.len();
    let mut rng = generator(24);
    // Data of a truth that differs in link 1 only; link 1 and 4 are free, all is coupled.
    let mut truth = prior.clone();
    truth[10..20].copy_from_slice(&draw_inertia(&mut rng).parameters());
    let fit = solve(&robot, &information(n, 400, 25), &truth, &[4, 1], 1e-10);
    assert_converged(&fit);
    for (found, expected) in fit.parameters.iter().zip(&truth) {
        assert!((found - expected).abs() < 1e-6, "{found} and {expected}");
    }
}

#[test]
fn a_prior_that_is_not_physical_is_moved_and_named() {
    let mut robot = random_tree(7);
    robot.link_mut(2).unwrap().inertia.about_com *= -1.0;
    let prior = parameters(&robot);
    let information = information(prior.len(), 400, 26);
    let fit = solve(&robot, &information, &prior, &[1, 2], 1e-2);
    assert_converged(&fit);
    assert_eq!(fit.shifted.iter().map(|s| s.link).collect::<Vec<_>>(), [2]);
    assert!(fit.shifted[0].distance > 1e-3);
    assert!(smallest_eigenvalue(inertia(&fit.parameters, 2).pseudo_inertia()) > 0.0);
}

#[test]
fn questions_without_an_answer_are_refused() {
    let robot = random_tree(8);
    let estimate = parameters(&robot);
    let information = DMatrix::identity(estimate.len(), estimate.len());
    let ask = |links: &[usize], prior_weight| {
        ConsistentFit {
            robot: &robot,
            information: &information,
            estimate: &estimate,
            links,
            prior_weight,
        }
        .solve()
        .map(|_| ())
    };
    assert_eq!(ask(&[0, 8], 1.0), Err(DynamicsError::NoSuchLink { link: 8, count: 8 }));
    assert_eq!(ask(&[3, 3], 1.0), Err(DynamicsError::NoSuchLink { link: 3, count: 8 }));
    assert_eq!(
        ask(&[0], 0.0),
        Err(DynamicsError::NotPositive { name: "prior_weight", value: 0.0 })
    );
}
