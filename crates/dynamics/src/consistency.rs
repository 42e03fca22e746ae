use nalgebra::{Cholesky, DMatrix, DVector, Matrix4, SMatrix, SVector, SymmetricEigen};
use robot::Robot;

use crate::error::{DynamicsError, check};
use crate::regressor::PARAMETERS_PER_LINK;

type Parameters = SVector<f64, PARAMETERS_PER_LINK>;

/// Newton decrement from which one more full step ends the fit: the step squares it, and
/// the objective is then within `prior_weight * 1e-24` of its minimum, or within rounding.
const DECREMENT: f64 = 1e-6;

/// Newton decrement at which a stage ends and the prior weight is lowered.
const STAGE_DECREMENT: f64 = 0.1;

/// Newton steps allowed per prior weight, and prior weights tried on the way down.
const STEPS_PER_STAGE: usize = 60;
const STAGES: usize = 60;

/// Ridges tried on a Newton system with unit diagonal: rounding is about 1e-16 times its size.
const RIDGES: [f64; 6] = [0.0, 1e-14, 1e-13, 1e-12, 1e-11, 1e-10];

/// Smallest eigenvalue of a shifted prior's pseudo-inertia, as a share of its trace.
const PRIOR_FLOOR: f64 = 1e-6;

/// The smallest trace of a pseudo-inertia that a floor is taken from: one gram.
const PRIOR_TRACE: f64 = 1e-3;

/// The problem of finding the physical inertias nearest to an estimate:
///
/// ```text
/// minimise  1/2 (pi - pi_hat)' H (pi - pi_hat)
///           + gamma sum_k [ tr(P_k^-1 J_k) - log det(P_k^-1 J_k) - 4 ]
/// ```
///
/// over the parameters of the free links `k`; the others stay at the prior. `J_k` is the
/// pseudo-inertia of link `k`, `P_k` that of the prior (the robot as it is described),
/// and the bracket their log-determinant divergence (Lee, Wensing & Park 2020): zero at
/// the prior, infinite at the edge of what is physical, the same in every frame.
/// Directions that `H` does not see therefore stay at the prior.
#[derive(Debug, Clone)]
pub struct ConsistentFit<'a> {
    /// The prior: inertias as described.
    pub robot: &'a Robot,
    /// `H`, 10 n x 10 n, symmetric and positive semidefinite (inverse covariance of the estimate).
    pub information: &'a DMatrix<f64>,
    /// `pi_hat`, 10 n entries in the order of the torque regressor.
    pub estimate: &'a [f64],
    /// Indices of the links whose parameters are free, each once.
    pub links: &'a [usize],
    /// `gamma`: how many units of the first term one unit of divergence weighs.
    pub prior_weight: f64,
}

/// How an iteration ended.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum FitOutcome {
    /// The minimum is found, to rounding.
    Converged {
        /// Newton steps taken.
        iterations: usize,
        /// Newton decrement of the objective over its prior weight, before the last step.
        decrement: f64,
    },
    /// Rounding stopped the descent before the minimum: the result is physical, but
    /// raise the prior weight or rescale the information before relying on it.
    Stalled {
        /// Newton steps taken.
        iterations: usize,
        /// Newton decrement reached.
        decrement: f64,
    },
}

/// A prior that was not physical and was moved to the nearest pseudo-inertia that is.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ShiftedPrior {
    /// Index of the link.
    pub link: usize,
    /// Frobenius distance between the pseudo-inertias (kg, kg m and kg m² together).
    pub distance: f64,
}

/// The solution of a [`ConsistentFit`]: physical inertias for every free link.
#[derive(Debug, Clone, PartialEq)]
pub struct ConsistentInertias {
    /// All 10 n parameters; those of links that were not free are the prior's.
    pub parameters: Vec<f64>,
    /// How the iteration ended.
    pub outcome: FitOutcome,
    /// Priors that had to be made physical first.
    pub shifted: Vec<ShiftedPrior>,
}

impl ConsistentFit<'_> {
    /// Solves the fit by Newton's method with a line search that stays inside the cone,
    /// from the prior, lowering the prior weight tenfold until the one asked for.
    ///
    /// The objective divided by `gamma` is convex and self-concordant in `pi` itself, so Newton's
    /// method converges from anywhere and its decrement bounds the error (Boyd & Vandenberghe 2004,
    /// section 9.6). A log-Cholesky parametrisation with a general optimiser would lose both
    /// properties, and the invariance to the units of mass and inertia.
    ///
    /// # Errors
    ///
    /// [`DynamicsError::WrongLength`], [`DynamicsError::NotFinite`],
    /// [`DynamicsError::NotPositive`] for the prior weight, [`DynamicsError::NoSuchLink`],
    /// and [`DynamicsError::NotPositiveDefinite`] for an `information` with a negative direction.
    pub fn solve(&self) -> Result<ConsistentInertias, DynamicsError> {
        self.check()?;
        let mut parameters: Vec<f64> =
            self.robot.links().iter().flat_map(|link| link.inertia.parameters()).collect();
        let (prior, shifted) = self.physical_prior();
        let objective = self.objective(&parameters, &prior);
        let start = DVector::from_iterator(
            PARAMETERS_PER_LINK * prior.len(),
            prior.iter().flat_map(|j| parameters_of(j).iter().copied().collect::<Vec<_>>()),
        );
        let (pi, outcome) = objective.minimise(start, self.prior_weight)?;
        for (k, &link) in self.links.iter().enumerate() {
            let at = PARAMETERS_PER_LINK * link;
            let found = pi.rows(PARAMETERS_PER_LINK * k, PARAMETERS_PER_LINK);
            parameters[at..at + PARAMETERS_PER_LINK]
                .iter_mut()
                .zip(found.iter())
                .for_each(|(slot, &value)| *slot = value);
        }
        Ok(ConsistentInertias { parameters, outcome, shifted })
    }

    fn check(&self) -> Result<(), DynamicsError> {
        let count = self.robot.joint_count();
        let n = PARAMETERS_PER_LINK * count;
        check("information", self.information.as_slice(), n * n)?;
        check("estimate", self.estimate, n)?;
        if self.prior_weight.is_nan() || self.prior_weight <= 0.0 {
            return Err(DynamicsError::NotPositive {
                name: "prior_weight",
                value: self.prior_weight,
            });
        }
        let repeated = |(at, link): (usize, &usize)| self.links[..at].contains(link);
        match self.links.iter().enumerate().find(|&(at, &l)| l >= count || repeated((at, &l))) {
            Some((_, &link)) => Err(DynamicsError::NoSuchLink { link, count }),
            None => Ok(()),
        }
    }

    /// Pseudo-inertias of the free links' priors, moved into the cone where necessary.
    fn physical_prior(&self) -> (Vec<Matrix4<f64>>, Vec<ShiftedPrior>) {
        let mut shifted = Vec::new();
        let links = self.robot.links();
        let prior = self.links.iter().map(|&link| {
            let j = links[link].inertia.pseudo_inertia();
            let floor = PRIOR_FLOOR * j.trace().max(PRIOR_TRACE);
            if Cholesky::new(j).is_some() {
                return j;
            }
            let mut eigen = SymmetricEigen::new(j);
            eigen.eigenvalues.apply(|value| *value = value.max(floor));
            let moved = eigen.recompose();
            shifted.push(ShiftedPrior { link, distance: (moved - j).norm() });
            moved
        });
        (prior.collect(), shifted)
    }

    /// The objective over the free parameters: the fixed ones enter its linear term.
    fn objective(&self, fixed: &[f64], prior: &[Matrix4<f64>]) -> Objective {
        let free: Vec<usize> = self
            .links
            .iter()
            .flat_map(|&link| (0..PARAMETERS_PER_LINK).map(move |p| PARAMETERS_PER_LINK * link + p))
            .collect();
        let mut offset: DVector<f64> = DVector::from_iterator(
            fixed.len(),
            fixed.iter().zip(self.estimate).map(|(f, e)| f - e),
        );
        // gradient = H (pi - pi_hat) = H_free pi_free + H (fixed - pi_hat), free entries of fixed 0.
        free.iter().for_each(|&i| offset[i] = -self.estimate[i]);
        let linear = (self.information * offset).select_rows(&free);
        let hessian = self.information.select_rows(&free).select_columns(&free);
        let basis = basis();
        let pull = prior.iter().map(|p| {
            let inverse = inverse(p);
            Parameters::from_fn(|k, _| (inverse * basis[k]).trace())
        });
        Objective { linear, hessian, pull: pull.collect(), basis }
    }
}

/// The objective over the free parameters, link after link.
struct Objective {
    /// Gradient of the quadratic term at `pi = 0`.
    linear: DVector<f64>,
    /// Its Hessian.
    hessian: DMatrix<f64>,
    /// Gradient of `tr(P^-1 J)` for every link.
    pull: Vec<Parameters>,
    basis: [Matrix4<f64>; PARAMETERS_PER_LINK],
}

/// Derivatives of the objective divided by its prior weight, at one point.
struct Derivatives {
    gradient: DVector<f64>,
    hessian: DMatrix<f64>,
}

impl Objective {
    /// Minimises for a falling prior weight, each stage from the minimum of the last.
    fn minimise(
        &self,
        mut pi: DVector<f64>,
        prior_weight: f64,
    ) -> Result<(DVector<f64>, FitOutcome), DynamicsError> {
        let mut weight = self.first_weight(&pi)?.max(prior_weight);
        let mut iterations = 0;
        for _ in 0..STAGES {
            let last = weight <= prior_weight;
            let goal = if last { DECREMENT } else { STAGE_DECREMENT };
            let (steps, decrement) = self.newton(&mut pi, weight, goal)?;
            iterations += steps;
            if last {
                let outcome = if decrement <= DECREMENT {
                    FitOutcome::Converged { iterations, decrement }
                } else {
                    FitOutcome::Stalled { iterations, decrement }
                };
                return Ok((pi, outcome));
            }
            weight = (0.1 * weight).max(prior_weight);
        }
        Ok((pi, FitOutcome::Stalled { iterations, decrement: f64::INFINITY }))
    }

    /// The prior weight for which the first Newton step from the prior has unit length.
    fn first_weight(&self, prior: &DVector<f64>) -> Result<f64, DynamicsError> {
        let Derivatives { gradient, mut hessian } = self.derivatives(prior, 1.0);
        hessian -= &self.hessian;
        let step = newton_step(&gradient, hessian)?;
        Ok(gradient.dot(&step).max(0.0).sqrt())
    }

    /// Newton's method at one prior weight until the decrement is at most `goal`: the
    /// steps taken and the decrement before the last of them.
    fn newton(
        &self,
        pi: &mut DVector<f64>,
        weight: f64,
        goal: f64,
    ) -> Result<(usize, f64), DynamicsError> {
        let mut decrement = f64::INFINITY;
        for steps in 1..=STEPS_PER_STAGE {
            let Derivatives { gradient, hessian } = self.derivatives(pi, weight);
            let step = newton_step(&gradient, hessian)?;
            decrement = gradient.dot(&step).max(0.0).sqrt();
            self.descend(pi, &step, decrement, weight);
            if decrement <= goal {
                return Ok((steps, decrement));
            }
        }
        Ok((STEPS_PER_STAGE, decrement))
    }

    /// One step: the full one when it stays inside and descends enough, else the damped
    /// one `1 / (1 + decrement)`, which a self-concordant function guarantees to do both.
    fn descend(&self, pi: &mut DVector<f64>, step: &DVector<f64>, decrement: f64, weight: f64) {
        let guaranteed = 1.0 / (1.0 + decrement);
        let here = self.value(pi, weight);
        let mut length = 1.0;
        loop {
            let there = self.value(&(&*pi - length * step), weight);
            let descends = there < here - 0.1 * length * decrement * decrement;
            if descends || (length <= guaranteed && there.is_finite()) {
                return pi.axpy(-length, step, 1.0);
            }
            length =
                if length > guaranteed { (0.7 * length).max(guaranteed) } else { 0.5 * length };
        }
    }

    /// Objective over `weight`, infinite outside the cone; constants are left out.
    fn value(&self, pi: &DVector<f64>, weight: f64) -> f64 {
        let quadratic = self.linear.dot(pi) + 0.5 * pi.dot(&(&self.hessian * pi));
        let divergence = self.pull.iter().enumerate().map(|(k, pull)| {
            let link = link_parameters(pi, k);
            let log_det = Cholesky::new(pseudo_inertia(&self.basis, &link))
                .map_or(f64::NEG_INFINITY, |j| j.ln_determinant());
            pull.dot(&link) - log_det
        });
        quadratic / weight + divergence.sum::<f64>()
    }

    /// ```text
    /// d(-log det J) / d pi_a = -tr(J^-1 E_a),   its derivative by pi_b = tr(J^-1 E_a J^-1 E_b)
    /// ```
    fn derivatives(&self, pi: &DVector<f64>, weight: f64) -> Derivatives {
        let mut gradient = (&self.linear + &self.hessian * pi) / weight;
        let mut hessian = &self.hessian / weight;
        for (k, pull) in self.pull.iter().enumerate() {
            let inverse = inverse(&pseudo_inertia(&self.basis, &link_parameters(pi, k)));
            let pushed = self.basis.map(|e| inverse * e);
            let barrier =
                SMatrix::<f64, PARAMETERS_PER_LINK, PARAMETERS_PER_LINK>::from_fn(|a, b| {
                    pushed[a].component_mul(&pushed[b].transpose()).sum()
                });
            let at = PARAMETERS_PER_LINK * k;
            let mut part = gradient.rows_mut(at, PARAMETERS_PER_LINK);
            part += pull - Parameters::from_fn(|a, _| pushed[a].trace());
            let mut block = hessian.view_mut((at, at), (PARAMETERS_PER_LINK, PARAMETERS_PER_LINK));
            block += barrier;
        }
        Derivatives { gradient, hessian }
    }
}

/// `hessian^-1 gradient`, in units in which the diagonal of the Hessian is one.
///
/// Near the edge of the cone the Hessian loses definiteness to rounding; then a ridge, as
/// small as does it, keeps the step one of descent (Levenberg).
fn newton_step(
    gradient: &DVector<f64>,
    hessian: DMatrix<f64>,
) -> Result<DVector<f64>, DynamicsError> {
    let n = gradient.len();
    let unit = hessian.diagonal().map(|d| if d > 0.0 { d.sqrt().recip() } else { 1.0 });
    let scaled = DMatrix::from_fn(n, n, |i, k| unit[i] * hessian[(i, k)] * unit[k]);
    let mut failure = (0, 0.0);
    for ridge in RIDGES {
        let mut factor = scaled.clone() + DMatrix::identity(n, n) * ridge;
        match crate::cholesky::factor(factor.as_mut_slice(), n) {
            Ok(()) => {
                let mut step = gradient.component_mul(&unit);
                crate::cholesky::solve_factored(factor.as_slice(), step.as_mut_slice());
                return Ok(step.component_mul(&unit));
            }
            Err(found) => failure = found,
        }
    }
    let (row, pivot) = failure;
    Err(DynamicsError::NotPositiveDefinite { matrix: "information", row, pivot })
}

fn link_parameters(pi: &DVector<f64>, k: usize) -> Parameters {
    pi.fixed_rows::<PARAMETERS_PER_LINK>(PARAMETERS_PER_LINK * k).into_owned()
}

/// `J(pi) = sum_k pi_k E_k` of [`robot::Inertia::pseudo_inertia`].
fn basis() -> [Matrix4<f64>; PARAMETERS_PER_LINK] {
    let at = |entries: &[(usize, usize, f64)]| {
        let mut e = Matrix4::zeros();
        for &(i, j, value) in entries {
            e[(i, j)] = value;
            e[(j, i)] = value;
        }
        e
    };
    let moment = |axis: usize| {
        let mut e = Matrix4::from_diagonal(&nalgebra::Vector4::new(0.5, 0.5, 0.5, 0.0));
        e[(axis, axis)] = -0.5;
        e
    };
    [
        at(&[(3, 3, 1.0)]),
        at(&[(0, 3, 1.0)]),
        at(&[(1, 3, 1.0)]),
        at(&[(2, 3, 1.0)]),
        moment(0),
        at(&[(0, 1, -1.0)]),
        moment(1),
        at(&[(0, 2, -1.0)]),
        at(&[(1, 2, -1.0)]),
        moment(2),
    ]
}

fn pseudo_inertia(basis: &[Matrix4<f64>; PARAMETERS_PER_LINK], pi: &Parameters) -> Matrix4<f64> {
    basis.iter().zip(pi.iter()).map(|(e, p)| e * *p).sum()
}

/// The parameters of a pseudo-inertia: with `S` its upper left block, `I = tr(S) 1 - S`.
fn parameters_of(j: &Matrix4<f64>) -> Parameters {
    let trace = j.m11 + j.m22 + j.m33;
    Parameters::from([
        j.m44,
        j.m14,
        j.m24,
        j.m34,
        trace - j.m11,
        -j.m12,
        trace - j.m22,
        -j.m13,
        -j.m23,
        trace - j.m33,
    ])
}

/// Inverse of a positive definite matrix. Every point of the descent is one; a NaN would
/// end it as an error of the next Newton step.
fn inverse(j: &Matrix4<f64>) -> Matrix4<f64> {
    Cholesky::new(*j).map_or_else(|| Matrix4::from_element(f64::NAN), |factor| factor.inverse())
}
