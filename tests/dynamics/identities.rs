//! Identities of mechanics, on a tree with revolute and prismatic joints about random axes.

use dynamics::{Dynamics, Rotors};
use nalgebra::{DMatrix, DVector};
use robot::Robot;

use checks::arms::{draw, draw_vector, generator, kinetic_energy, potential_energy, random_tree};

const SEEDS: std::ops::Range<u64> = 0..10;

/// Rounding of a few hundred operations on numbers up to 100.
const ROUNDING: f64 = 1e-11;

/// Central differences with this step are good to `DIFFERENCE`.
const STEP: f64 = 1e-5;
const DIFFERENCE: f64 = 1e-6;

struct Case {
    robot: Robot,
    dynamics: Dynamics,
    q: Vec<f64>,
    qd: Vec<f64>,
    qdd: Vec<f64>,
}

fn cases() -> impl Iterator<Item = Case> {
    SEEDS.map(|seed| {
        let robot = random_tree(seed);
        let (dynamics, n) = (Dynamics::new(&robot), robot.joint_count());
        let mut rng = generator(1000 + seed);
        let (q, qd) = (draw(&mut rng, n, 1.5), draw(&mut rng, n, 2.0));
        Case { robot, dynamics, q, qd, qdd: draw(&mut rng, n, 4.0) }
    })
}

fn along(q: &[f64], direction: &[f64], step: f64) -> Vec<f64> {
    q.iter().zip(direction).map(|(q, d)| q + step * d).collect()
}

#[test]
fn the_mass_matrix_gives_the_kinetic_energy() {
    for Case { robot, dynamics, q, qd, .. } in cases() {
        let rates = DVector::from_column_slice(&qd);
        let energy = 0.5 * rates.dot(&(dynamics.mass_matrix(&q).unwrap() * &rates));
        let expected = kinetic_energy(&robot, &q, &qd);
        assert!(expected > 0.1 && (energy - expected).abs() < ROUNDING * expected);
    }
}

#[test]
fn unit_accelerations_give_the_columns_of_the_mass_matrix() {
    for Case { dynamics, q, .. } in cases() {
        let n = q.len();
        let gravity = dynamics.gravity(&q).unwrap();
        let columns: Vec<DVector<f64>> = (0..n)
            .map(|i| {
                let unit = DVector::from_fn(n, |j, _| if i == j { 1.0 } else { 0.0 });
                let rest = vec![0.0; n];
                dynamics.inverse_dynamics(&q, &rest, unit.as_slice()).unwrap() - &gravity
            })
            .collect();
        let difference = DMatrix::from_columns(&columns) - dynamics.mass_matrix(&q).unwrap();
        assert!(difference.amax() < ROUNDING);
    }
}

#[test]
fn the_terms_add_up_to_inverse_dynamics() {
    for Case { dynamics, q, qd, qdd, .. } in cases() {
        let sum = dynamics.mass_matrix(&q).unwrap() * DVector::from_column_slice(&qdd)
            + dynamics.coriolis(&q, &qd).unwrap()
            + dynamics.gravity(&q).unwrap();
        let tau = dynamics.inverse_dynamics(&q, &qd, &qdd).unwrap();
        assert!((sum - &tau).amax() < ROUNDING * tau.amax());
    }
}

#[test]
fn forward_dynamics_undoes_inverse_dynamics_with_and_without_rotors() {
    for Case { dynamics, q, qd, qdd, .. } in cases() {
        let mut tau = dynamics.inverse_dynamics(&q, &qd, &qdd).unwrap();
        let expected = DVector::from_column_slice(&qdd);
        let back = |tau: &DVector<f64>, rotors| {
            dynamics.forward_dynamics(&q, &qd, tau.as_slice(), rotors).unwrap() - &expected
        };
        assert!(back(&tau, Rotors::Excluded).amax() < 1e-8);
        assert!(back(&tau, Rotors::Included).amax() > 1e-3);
        dynamics.add_rotor_torque(&qdd, tau.as_mut_slice()).unwrap();
        assert!(back(&tau, Rotors::Included).amax() < 1e-8);
    }
}

/// With `C` from the Christoffel symbols, `Mdot - 2 C` is skew; on the vector `C qd` that
/// says `qd' Mdot qd = 2 qd' C qd` for every `qd`.
#[test]
fn the_rate_of_the_mass_matrix_less_twice_coriolis_is_skew() {
    for Case { dynamics, q, qd, .. } in cases() {
        let ahead = dynamics.mass_matrix(&along(&q, &qd, STEP)).unwrap();
        let behind = dynamics.mass_matrix(&along(&q, &qd, -STEP)).unwrap();
        let rate = (ahead - behind) / (2.0 * STEP);
        let velocity = DVector::from_column_slice(&qd);
        let left = velocity.dot(&(rate * &velocity));
        let right = 2.0 * velocity.dot(&dynamics.coriolis(&q, &qd).unwrap());
        assert!((left - right).abs() < DIFFERENCE * (1.0 + left.abs()), "{left} and {right}");
    }
}

#[test]
fn gravity_is_the_gradient_of_the_potential_energy() {
    for Case { robot, dynamics, q, .. } in cases() {
        let gravity = dynamics.gravity(&q).unwrap();
        for i in 0..q.len() {
            let unit: Vec<f64> = (0..q.len()).map(|j| if i == j { 1.0 } else { 0.0 }).collect();
            let rise = potential_energy(&robot, &along(&q, &unit, STEP))
                - potential_energy(&robot, &along(&q, &unit, -STEP));
            assert!((rise / (2.0 * STEP) - gravity[i]).abs() < DIFFERENCE);
        }
    }
}

/// Along `q + qd t + qdd t²/2`, the power of the torque is the rate of the total energy.
#[test]
fn power_is_the_rate_of_the_energy() {
    for Case { robot, dynamics, q, qd, qdd } in cases() {
        let energy = |t: f64| {
            let q = along(&along(&q, &qd, t), &qdd, 0.5 * t * t);
            let qd = along(&qd, &qdd, t);
            kinetic_energy(&robot, &q, &qd) + potential_energy(&robot, &q)
        };
        let rate = (energy(STEP) - energy(-STEP)) / (2.0 * STEP);
        let power =
            dynamics.inverse_dynamics(&q, &qd, &qdd).unwrap().dot(&DVector::from_column_slice(&qd));
        assert!((rate - power).abs() < DIFFERENCE * (1.0 + power.abs()), "{rate} and {power}");
    }
}

/// Central differences of the inverse dynamics, whose steps leave errors of 1e-9 in torques of 100 N m.
#[test]
fn the_derivatives_are_those_of_the_inverse_dynamics() {
    for Case { dynamics, q, qd, qdd, .. } in cases() {
        let n = q.len();
        let found = dynamics.inverse_dynamics_derivatives(&q, &qd, &qdd).unwrap();
        let tau = |state: &[Vec<f64>; 3]| {
            dynamics.inverse_dynamics(&state[0], &state[1], &state[2]).unwrap()
        };
        for (k, derivatives) in [&found.dq, &found.dqd, &found.dqdd].into_iter().enumerate() {
            for j in 0..n {
                let unit: Vec<f64> = (0..n).map(|i| if i == j { 1.0 } else { 0.0 }).collect();
                let mut states =
                    [[q.clone(), qd.clone(), qdd.clone()], [q.clone(), qd.clone(), qdd.clone()]];
                states[0][k] = along(&states[0][k], &unit, STEP);
                states[1][k] = along(&states[1][k], &unit, -STEP);
                let expected = (tau(&states[0]) - tau(&states[1])) / (2.0 * STEP);
                let worst = (derivatives.column(j) - &expected).amax();
                assert!(worst < DIFFERENCE * (1.0 + expected.amax()), "{k}, joint {j}: {worst}");
            }
        }
        let inertia = dynamics.mass_matrix(&q).unwrap();
        assert!((found.dqdd - &inertia).amax() < ROUNDING * inertia.amax());
    }
}

#[test]
fn the_regressor_times_the_parameters_is_inverse_dynamics() {
    for Case { robot, dynamics, q, qd, qdd } in cases() {
        let pi = robot.links().iter().flat_map(|link| link.inertia.parameters());
        let pi = DVector::from_iterator(10 * q.len(), pi);
        let tau = dynamics.inverse_dynamics(&q, &qd, &qdd).unwrap();
        let from_regressor = dynamics.torque_regressor(&q, &qd, &qdd).unwrap() * pi;
        assert!((from_regressor - &tau).amax() < ROUNDING * tau.amax());
    }
}

#[test]
fn the_regressor_of_a_link_is_its_columns_of_the_whole_to_the_bit() {
    for Case { dynamics, q, qd, qdd, .. } in cases() {
        let (n, whole) = (q.len(), dynamics.torque_regressor(&q, &qd, &qdd).unwrap());
        for link in 0..n {
            // A new one: what links carry is written for this link alone.
            let mut ws = dynamics.workspace();
            let mut own = vec![f64::NAN; 10 * n];
            dynamics.link_regressor_into(&mut ws, link, [&q, &qd, &qdd], &mut own);
            let own = DMatrix::from_row_slice(n, 10, &own);
            assert_eq!(own, whole.columns(10 * link, 10), "link {link}");
        }
    }
}

#[test]
fn the_gravity_regressor_gives_the_torque_of_any_gravity() {
    for Case { robot, dynamics, q, .. } in cases() {
        let other = draw_vector(&mut generator(7), 10.0);
        let expected = Dynamics::new(&robot.with_gravity(other)).gravity(&q).unwrap();
        let found = dynamics.gravity_regressor(&q).unwrap() * other;
        assert!((found - expected).amax() < ROUNDING);
    }
}
