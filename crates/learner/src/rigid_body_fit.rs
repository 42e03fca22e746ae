use dynamics::{
    BaseParameters, ConsistentFit, ConsistentInertias, FitOutcome, PARAMETERS_PER_LINK,
    RegressorColumn, ShiftedPrior,
};
use nalgebra::{DMatrix, DVector, SymmetricEigen};
use robot::Robot;

use crate::error::LearnerError;
use crate::nominal_parameter::size;
use crate::prior::GaussianPrior;
use crate::regression::Regression;
use crate::undetermined::{Direction, directions};
use crate::weighting::{
    FitNoise, LEAST_INFORMATION, LeastSquaresProblem, Solution, Weighting, scale_columns, to_base,
};

/// Rigid-body parameters with their uncertainty: `tau = Y pi`.
#[derive(Debug, Clone, PartialEq)]
pub struct RigidBodyFit {
    /// What each parameter is, in the order of [`dynamics::ColumnSet::columns`].
    pub columns: Vec<RegressorColumn>,
    /// All parameters `pi` (units of the columns): those of least squares and, along undetermined
    /// directions, those nearest to the robot as described.
    pub parameters: Vec<f64>,
    /// Standard error of every parameter, valid for correlated noise. In an undetermined direction
    /// it is about the expected size of the parameter.
    pub standard_errors: Vec<f64>,
    /// Covariance of the parameters, with the standard errors squared on its diagonal.
    pub covariance: DMatrix<f64>,
    /// Which combinations of parameters any motion can reveal.
    pub base: BaseParameters,
    /// Noise of every joint.
    pub noise: Vec<FitNoise>,
    /// How the iteration of the joints' weights ended.
    pub weighting: Weighting,
    /// Number of directions that the samples, and the prior if there was one, determine.
    pub rank: usize,
    /// Ratio of the largest to the smallest standard deviation of these directions, in units
    /// of the parameters' sizes.
    pub condition: f64,
    /// Directions of base parameters that neither samples nor prior determine.
    pub undetermined: Vec<Direction>,
    /// Number of samples.
    pub samples: usize,
    /// Number of groups of consecutive samples whose spread makes the standard errors: an
    /// interval is `t` standard errors with one degree of freedom less. Zero where there are
    /// fewer than eight: then the errors are those of noise as the weights have it.
    pub groups: usize,
    /// Inverse covariance of the parameters over their sizes if the noise is as weighted.
    information: DMatrix<f64>,
    /// The sizes.
    sizes: DVector<f64>,
}

/// Physically consistent parameters nearest to a fit.
#[derive(Debug, Clone, PartialEq)]
pub struct ConsistentRigidBodies {
    /// All parameters, in the order and units of [`RigidBodyFit::columns`]: every link is
    /// physical, and the drives are the best for these links.
    pub parameters: Vec<f64>,
    /// How the fit ended.
    pub outcome: FitOutcome,
    /// Links whose descriptions were not physical and were replaced by physical ones as a start.
    pub shifted: Vec<ShiftedPrior>,
}

impl Regression {
    /// The parameters that the samples so far and `prior` give.
    ///
    /// Joints are weighed by their noise and its memory ([`Weighting`]). A parameter without a
    /// prior stays near its description in the directions that the samples leave open; in all
    /// others the fit is least squares.
    ///
    /// # Errors
    ///
    /// [`LearnerError::NoSamples`]; of the prior, [`dynamics::DynamicsError::WrongLength`],
    /// [`dynamics::DynamicsError::NotFinite`] and [`dynamics::DynamicsError::NotPositive`].
    pub fn fit(&self, prior: Option<&GaussianPrior>) -> Result<RigidBodyFit, LearnerError> {
        let total = self.sums.total().ok_or(LearnerError::NoSamples)?;
        prior.map_or(Ok(()), |p| p.check(self.base.columns.len()))?;
        let problem = LeastSquaresProblem::new(self, &total, prior);
        let (solution, noise, weighting) = problem.reweight();
        let (covariance, groups) = covariance(&problem, &solution, &noise);
        let columns = self.base.columns.clone();
        let base_sizes: Vec<f64> =
            self.base.independent.iter().map(|&c| size(&self.robot, columns[c])).collect();
        let spanned = &problem.base_from_z * &solution.undetermined;
        let undetermined = directions(&self.base, &base_sizes, &spanned);
        let spread = &solution.information;
        Ok(RigidBodyFit {
            parameters: (&problem.centre + problem.size.component_mul(&solution.z))
                .iter()
                .copied()
                .collect(),
            standard_errors: covariance.diagonal().iter().map(|v| v.max(0.0).sqrt()).collect(),
            covariance,
            base: self.base.clone(),
            noise,
            weighting,
            rank: solution.information.len(),
            condition: if spread.is_empty() { 1.0 } else { (spread.max() / spread.min()).sqrt() },
            undetermined,
            samples: total.samples,
            groups,
            information: information(&solution),
            sizes: problem.size,
            columns,
        })
    }
}

/// Covariance of the parameters: in determined directions that of the blocks, in the others
/// the squared size.
fn covariance(
    problem: &LeastSquaresProblem,
    solution: &Solution,
    noise: &[FitNoise],
) -> (DMatrix<f64>, usize) {
    let (mut z, groups) = problem.sandwich(solution, noise);
    z += &solution.undetermined * solution.undetermined.transpose();
    (z.map_with_location(|i, k, v| v * problem.size[i] * problem.size[k]), groups)
}

/// `V diag(l) V'` of all directions.
fn information(solution: &Solution) -> DMatrix<f64> {
    let strong = scale_columns(&solution.determined, &solution.information.map(f64::sqrt));
    let faint = scale_columns(&solution.undetermined, &solution.faint.map(f64::sqrt));
    &strong * strong.transpose() + &faint * faint.transpose()
}

impl RigidBodyFit {
    /// Base parameters and their covariance, in the order of [`BaseParameters::independent`],
    /// without the directions that the robot's structure leaves open.
    ///
    /// The diagonal is the prior `B` that a Gaussian process with these columns as its mean
    /// takes (Nguyen-Tuong & Peters 2010, eq. 6). That of [`RigidBodyFit::covariance`] would be
    /// far too wide there, as links that can exchange inertia have large errors each.
    pub fn base_parameters(&self) -> (DVector<f64>, DMatrix<f64>) {
        let to_base = to_base(&self.base);
        let covariance = &to_base * &self.covariance * to_base.transpose();
        (to_base * DVector::from_column_slice(&self.parameters), covariance)
    }

    /// The nearest parameters with which every link is a physical body.
    ///
    /// With `H` the information on links `l` and drives `d`, the drives are profiled out,
    ///
    /// ```text
    /// H_l = H_ll - H_ld H_dd^-1 H_dl
    /// ```
    ///
    /// the links are fitted ([`ConsistentFit`], all free, `robot` as its prior with weight
    /// `prior_weight`), and the drives follow: `d = d_hat - H_dd^-1 H_dl (l - l_hat)`. Those
    /// that the samples do not determine even for known links stay.
    ///
    /// # Errors
    ///
    /// Those of [`ConsistentFit::solve`].
    pub fn consistent(
        &self,
        robot: &Robot,
        prior_weight: f64,
    ) -> Result<ConsistentRigidBodies, LearnerError> {
        let links = self.columns.len().min(PARAMETERS_PER_LINK * robot.joint_count());
        let drives = self.columns.len() - links;
        let h = &self.information;
        let cross = h.view((links, 0), (drives, links));
        let own = h.view((links, links), (drives, drives)).into_owned();
        let follow = -determined_inverse(own) * cross;
        let profiled = h.view((0, 0), (links, links)) + cross.transpose() * &follow;
        let per_size = |i: usize, k: usize| 0.5 / (self.sizes[i] * self.sizes[k]);
        let information =
            (&profiled + profiled.transpose()).map_with_location(|i, k, v| v * per_size(i, k));
        let all: Vec<usize> = (0..robot.joint_count()).collect();
        let estimate = &self.parameters[..links];
        let ConsistentInertias { mut parameters, outcome, shifted } =
            ConsistentFit { robot, information: &information, estimate, links: &all, prior_weight }
                .solve()?;
        let moved = DVector::from_fn(links, |i, _| (parameters[i] - estimate[i]) / self.sizes[i]);
        let followed = (follow * moved).component_mul(&self.sizes.rows(links, drives));
        let drives = self.parameters[links..].iter().zip(followed.iter()).map(|(d, f)| d + f);
        parameters.extend(drives);
        Ok(ConsistentRigidBodies { parameters, outcome, shifted })
    }
}

/// Inverse of an information matrix in the directions that it determines, zero in the others.
fn determined_inverse(h: DMatrix<f64>) -> DMatrix<f64> {
    if h.is_empty() {
        return h;
    }
    let eigen = SymmetricEigen::new(h);
    let inverse = eigen.eigenvalues.map(|l| if l >= LEAST_INFORMATION { l.recip() } else { 0.0 });
    scale_columns(&eigen.eigenvectors, &inverse) * eigen.eigenvectors.transpose()
}

#[cfg(test)]
mod tests {
    use dynamics::{ColumnSet, DynamicsError};
    use robot::Inertia;

    use super::*;
    use crate::planar::{
        PlanarRecord, arm, arm_theta, generator, normal, pendulum, pendulum_theta,
    };

    const THETA: [f64; 6] = [2.2, 3.1, 0.2, 0.6, 1.4, -0.1];

    fn fit_set(robot: &Robot, set: ColumnSet, record: &PlanarRecord) -> RigidBodyFit {
        fit_set_with(robot, set, record, None)
    }

    fn fit_set_with(
        robot: &Robot,
        set: ColumnSet,
        record: &PlanarRecord,
        prior: Option<&GaussianPrior>,
    ) -> RigidBodyFit {
        let mut regression = Regression::new(robot, set);
        regression.add(record.stretch()).unwrap();
        regression.fit(prior).unwrap()
    }

    fn arm_record(samples: usize, sd: [f64; 2], seed: u64) -> PlanarRecord {
        let mut rng = generator(seed);
        let motion = PlanarRecord::motion(2, samples);
        let noise: Vec<f64> = (0..2 * samples).map(|at| sd[at % 2] * normal(&mut rng)).collect();
        let columns = motion.arm_columns();
        motion.with(&columns, &THETA, &noise)
    }

    #[test]
    fn parameters_of_an_arm_come_back_from_exact_torques() {
        let fit = fit_set(&arm(), ColumnSet::INERTIAL, &arm_record(2000, [0.0; 2], 0));
        for (found, expected) in arm_theta(&fit.parameters).iter().zip(THETA) {
            assert!((found - expected).abs() < 1e-8, "{found} and {expected}");
        }
        assert_eq!((fit.rank, fit.base.rank()), (6, 6));
        assert!(fit.undetermined.is_empty());
        // What no motion of a plane shows stays as described.
        assert!((fit.parameters[0] - 3.0).abs() < 1e-12 && fit.parameters[2].abs() < 1e-12);
        assert!((fit.standard_errors[0] - 3.0).abs() < 1e-12);
    }

    #[test]
    fn joints_are_weighed_by_their_noise() {
        let sd = [0.5, 0.02];
        let record = arm_record(4000, sd, 1);
        let fit = fit_set(&arm(), ColumnSet::INERTIAL, &record);
        assert!(matches!(fit.weighting, Weighting::Converged { .. }));
        let (mut h, mut g) = (DMatrix::zeros(6, 6), DVector::zeros(6));
        for (joint, y) in record.arm_columns().iter().enumerate() {
            let noise = fit.noise[joint];
            // The error of a standard deviation from 4000 numbers is 1.1 %.
            assert!((noise.standard_deviation / sd[joint] - 1.0).abs() < 0.04, "{noise:?}");
            assert!(noise.correlated_samples < 1.8, "{noise:?}");
            let weight = 1.0 / (noise.standard_deviation.powi(2) * noise.correlated_samples);
            h += y.tr_mul(y) * weight;
            g += y.tr_mul(&record.tau_of(joint, 2)) * weight;
        }
        let by_hand = h.cholesky().unwrap().solve(&g);
        for (found, expected) in arm_theta(&fit.parameters).iter().zip(by_hand.iter()) {
            assert!((found - expected).abs() < 1e-8, "{found} and {expected}");
        }
    }

    #[test]
    fn a_gaussian_prior_gives_the_posterior_by_hand() {
        let motion = PlanarRecord::motion(1, 600);
        let mut rng = generator(5);
        let noise: Vec<f64> = motion.q.iter().map(|_| 4.0 * normal(&mut rng)).collect();
        let columns = motion.pendulum_columns();
        let record = motion.with(std::slice::from_ref(&columns), &[0.8, 1.1, 0.0], &noise);
        let mut prior =
            GaussianPrior { mean: vec![0.0; 10], standard_deviations: vec![f64::INFINITY; 10] };
        for (i, mean, sd) in [(6, 0.5, 0.02), (1, 1.3, 0.05), (3, 0.1, 0.03)] {
            prior.mean[i] = mean;
            prior.standard_deviations[i] = sd;
        }
        let fit = fit_set_with(&pendulum(), ColumnSet::INERTIAL, &record, Some(&prior));
        let noise = fit.noise[0];
        let weight = 1.0 / (noise.standard_deviation.powi(2) * noise.correlated_samples);
        let believed = DVector::from_vec(vec![1.0 / 0.02_f64.powi(2), 400.0, 1.0 / 0.0009]);
        let mean = DVector::from_vec(vec![0.5, 1.3, 0.1]);
        let h = columns.tr_mul(&columns) * weight + DMatrix::from_diagonal(&believed);
        let g = columns.tr_mul(&record.tau_of(0, 1)) * weight + believed.component_mul(&mean);
        let posterior = h.cholesky().unwrap().solve(&g);
        for (found, expected) in pendulum_theta(&fit.parameters).iter().zip(posterior.iter()) {
            assert!((found - expected).abs() < 1e-9, "{found} and {expected}");
        }
        // Negative control: without the prior the answer is another one.
        let free = fit_set(&pendulum(), ColumnSet::INERTIAL, &record);
        assert!((free.parameters[6] - posterior[0]).abs() > 1e-3);
        prior.standard_deviations[2] = 0.0;
        let mut regression = Regression::new(&pendulum(), ColumnSet::INERTIAL);
        regression.add(record.stretch()).unwrap();
        let refused = regression.fit(Some(&prior)).unwrap_err();
        assert!(
            matches!(refused, LearnerError::Dynamics(DynamicsError::NotPositive { .. })),
            "{refused}"
        );
    }

    /// Share of 200 records whose 95 per cent interval holds the truth, for every parameter of
    /// the pendulum and its offset: of the fit, and of least squares that takes the noise for
    /// white.
    fn coverage(memory: f64, samples: usize) -> [[f64; 4]; 2] {
        const SEEDS: u64 = 200;
        let truth = [0.8, 1.1, -0.1, 0.3];
        let motion = PlanarRecord::motion(1, samples);
        let columns = motion.pendulum_columns().insert_column(3, 1.0);
        let gram = columns.tr_mul(&columns).try_inverse().unwrap();
        let set = ColumnSet { offset: true, ..ColumnSet::INERTIAL };
        let with_offset = |pi: &[f64]| {
            let [inertia, mx, mz] = pendulum_theta(pi);
            [inertia, mx, mz, pi[10]]
        };
        let mut inside = [[0.0; 4]; 2];
        for seed in 0..SEEDS {
            let mut rng = generator(seed);
            let mut state = normal(&mut rng);
            let fresh = (1.0 - memory * memory).sqrt();
            let mut step = || {
                state = memory * state + fresh * normal(&mut rng);
                0.3 * state
            };
            let noise: Vec<f64> = (0..samples).map(|_| step()).collect();
            let record = motion.clone().with(std::slice::from_ref(&columns), &truth, &noise);
            let fit = fit_set(&pendulum(), set, &record);
            let (found, errors) = (with_offset(&fit.parameters), with_offset(&fit.standard_errors));
            // Quantile 0.975 of Student's t, to 0.5 % from 7 degrees of freedom on.
            let nu = (fit.groups - 1) as f64;
            let t = 1.96 + 2.37 / nu + 2.82 / (nu * nu);
            for i in 0..4 {
                let off = (found[i] - truth[i]).abs();
                let white = 0.3 * gram[(i, i)].sqrt();
                inside[0][i] += f64::from(off < t * errors[i]) / SEEDS as f64;
                inside[1][i] += f64::from(off < 1.96 * white) / SEEDS as f64;
            }
        }
        inside
    }

    #[test]
    fn intervals_hold_the_truth_however_long_the_noise_remembers() {
        // 60 s and 15 s at 500 Hz; a memory of 0.99 makes 199 samples count as one.
        for (memory, samples) in [(0.0, 7500), (0.99, 30_000), (0.99, 7500)] {
            let [honest, white] = coverage(memory, samples);
            assert!(honest.iter().all(|&share| (0.88..=0.99).contains(&share)), "{honest:?}");
            let fooled = white.iter().all(|&share| share < 0.5);
            assert_eq!(fooled, memory > 0.5, "{white:?}");
        }
    }

    #[test]
    fn parameters_that_few_samples_pay_for_do_not_make_the_noise_small() {
        let motion = PlanarRecord::motion(1, 16);
        let mean = (0..400).map(|seed| {
            let mut rng = generator(seed);
            let noise: Vec<f64> = motion.q.iter().map(|_| 0.1 * normal(&mut rng)).collect();
            let columns = motion.pendulum_columns();
            let record = motion.clone().with(&[columns], &[0.8, 1.1, -0.1], &noise);
            let fit = fit_set(&pendulum(), ColumnSet::INERTIAL, &record);
            fit.noise[0].standard_deviation.powi(2) / 400.0
        });
        // Three of 16 samples pay: the squares alone would give 0.0081.
        let mean: f64 = mean.sum();
        assert!((mean / 0.01 - 1.0).abs() < 0.06, "{mean}");
    }

    #[test]
    fn directions_that_a_motion_leaves_open_are_named_and_stay_as_described() {
        // The shoulder is held level: nothing shows its inertia and what stands off its axis.
        let mut motion = PlanarRecord::motion(2, 3000);
        for k in 0..3000 {
            motion.q[2 * k] = 0.0;
            motion.qd[2 * k] = 0.0;
            motion.qdd[2 * k] = 0.0;
        }
        let mut rng = generator(9);
        let noise: Vec<f64> = motion.q.iter().map(|_| 0.1 * normal(&mut rng)).collect();
        let columns = motion.arm_columns();
        let record = motion.with(&columns, &THETA, &noise);
        let fit = fit_set(&arm(), ColumnSet::INERTIAL, &record);
        let words: Vec<String> = fit.undetermined.iter().map(ToString::to_string).collect();
        assert_eq!(words, ["mz1", "Iyy1"]);
        assert_eq!(fit.rank, 4);
        let described = arm().links()[0].inertia.parameters();
        let theta = arm_theta(&fit.parameters);
        assert!((theta[2] - described[3]).abs() < 1e-12);
        for i in [1, 3, 4, 5] {
            assert!((theta[i] - THETA[i]).abs() < 0.05, "{i}: {}", theta[i]);
        }
    }

    #[test]
    fn too_few_samples_and_samples_without_motion_give_a_fit_near_the_description() {
        let described: Vec<f64> =
            arm().links().iter().flat_map(|link| link.inertia.parameters()).collect();
        let full = arm_record(50, [0.1; 2], 4);
        for samples in [1, 2, 5] {
            let few = PlanarRecord {
                q: full.q[..2 * samples].to_vec(),
                qd: full.qd[..2 * samples].to_vec(),
                qdd: full.qdd[..2 * samples].to_vec(),
                tau: full.tau[..2 * samples].to_vec(),
            };
            let fit = fit_set(&arm(), ColumnSet::ALL, &few);
            assert!(fit.parameters.iter().chain(&fit.standard_errors).all(|v| v.is_finite()));
            assert!(fit.rank < fit.base.rank() && !fit.undetermined.is_empty());
            let off = fit.parameters.iter().zip(&described).map(|(a, b)| (a - b).abs());
            assert!(off.fold(0.0, f64::max) < 10.0);
        }
        let zeros = vec![0.0; 200];
        let still =
            PlanarRecord { q: zeros.clone(), qd: zeros.clone(), qdd: zeros.clone(), tau: zeros };
        let fit = fit_set(&arm(), ColumnSet::ALL, &still);
        assert!(fit.parameters.iter().chain(&fit.standard_errors).all(|v| v.is_finite()));
        assert!(fit.rank <= 2, "{}", fit.rank);
    }

    #[test]
    fn a_joint_that_reports_no_torque_has_no_part_in_the_fit() {
        let mut record = arm_record(4000, [0.1; 2], 7);
        record.tau.iter_mut().skip(1).step_by(2).for_each(|tau| *tau = 0.0);
        let fit = fit_set(&arm(), ColumnSet::INERTIAL, &record);
        assert!(fit.noise[1].standard_deviation <= 0.0);
        let [first, _] = record.arm_columns();
        let h = first.tr_mul(&first).cholesky().unwrap();
        let by_hand = h.solve(&first.tr_mul(&record.tau_of(0, 2)));
        for (found, expected) in arm_theta(&fit.parameters).iter().zip(by_hand.iter()) {
            assert!((found - expected).abs() < 1e-8, "{found} and {expected}");
        }
    }

    #[test]
    fn a_joint_without_noise_does_not_drown_the_others() {
        let fit = fit_set(&arm(), ColumnSet::INERTIAL, &arm_record(4000, [0.5, 0.0], 8));
        let [noisy, exact] = [0, 1].map(|joint| fit.noise[joint].standard_deviation);
        assert!((noisy / 0.5 - 1.0).abs() < 0.04 && (exact / noisy - 1e-3).abs() < 1e-9);
        assert!(fit.undetermined.is_empty());
        for (i, (found, expected)) in arm_theta(&fit.parameters).iter().zip(THETA).enumerate() {
            let tolerance = if i < 3 { 0.05 } else { 1e-4 };
            assert!((found - expected).abs() < tolerance, "{found} and {expected}");
        }
    }

    #[test]
    fn a_consistent_fit_has_physical_links_and_the_best_drives_for_them() {
        // A moment of inertia of 0.05 with a first moment of 1.1 asks for 24 kg on the spot.
        let motion = PlanarRecord::motion(1, 5000);
        let mut rng = generator(6);
        let noise: Vec<f64> = motion.q.iter().map(|_| 0.1 * normal(&mut rng)).collect();
        let body = motion.pendulum_columns();
        let drives =
            DMatrix::from_fn(5000, 3, |k, c| [motion.qd[k], motion.qd[k].signum(), 1.0][c]);
        let columns =
            DMatrix::from_fn(5000, 6, |k, c| if c < 3 { body[(k, c)] } else { drives[(k, c - 3)] });
        let record = motion.with(&[columns], &[0.05, 1.1, 0.0, 0.4, 0.7, 0.1], &noise);
        let set = ColumnSet { rotor: false, ..ColumnSet::ALL };
        let robot = pendulum();
        let fit = fit_set(&robot, set, &record);
        let physical = |pi: &[f64]| {
            let link = Inertia::from_parameters(pi[..10].try_into().unwrap());
            link.pseudo_inertia().symmetric_eigenvalues().min()
        };
        assert!(physical(&fit.parameters) < 0.0);
        let found = fit.consistent(&robot, 1.0).unwrap();
        assert!(matches!(found.outcome, FitOutcome::Converged { .. }), "{:?}", found.outcome);
        assert!(physical(&found.parameters) > 0.0);
        let held = DVector::from_column_slice(&pendulum_theta(&found.parameters));
        let left = record.tau_of(0, 1) - &body * held;
        let best = drives.tr_mul(&drives).cholesky().unwrap().solve(&drives.tr_mul(&left));
        for (found, expected) in found.parameters[10..].iter().zip(best.iter()) {
            assert!((found - expected).abs() < 1e-8, "{found} and {expected}");
        }
        // At the minimum over links and drives the slope of the squares is that of the
        // divergence: weight X'(tau - X l - D d) = tr((P^-1 - J^-1) E).
        let slope = body.tr_mul(&(left - drives * best)) * fit.noise[0].weight();
        let pseudo =
            |pi: &[f64]| Inertia::from_parameters(pi[..10].try_into().unwrap()).pseudo_inertia();
        let inverse = |j: nalgebra::Matrix4<f64>| j.try_inverse().unwrap();
        let prior = robot.links()[0].inertia.pseudo_inertia();
        let pull = inverse(prior) - inverse(pseudo(&found.parameters));
        for (place, slope) in [6, 1, 3].into_iter().zip(slope.iter()) {
            let mut moved = found.parameters.clone();
            moved[place] += 1.0;
            let e = pseudo(&moved) - pseudo(&found.parameters);
            let expected = (pull * e).trace();
            assert!((slope - expected).abs() < 1e-5 * expected.abs(), "{slope} and {expected}");
        }
    }
}
