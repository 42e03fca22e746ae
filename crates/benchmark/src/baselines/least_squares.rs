use catalogue::EffectKind;
use diagnosis::EffectAt;
use dynamics::{ColumnSet, RegressorColumn, base_parameters};
use faer::Mat;
use logs::{PrepareSettings, Run};
use robot::Robot;

use crate::baselines::baseline::{Baseline, Weighted};
use crate::baselines::dataset::{Dataset, Joint};
use crate::baselines::fit::{fit, square_left};
use crate::baselines::memory::memory;
use crate::baselines::prepare_runs::prepare_runs;
use crate::baselines::scales::Scales;
use crate::baselines::shape::Shape;
use crate::error::BenchmarkError;

/// Number of standard errors by which a parameter must differ from its nominal value to be named.
const STANDARD_ERRORS: f64 = 3.0;

/// Least effort of that difference, as a share of the joint's effort.
const LEAST_SHARE: f64 = 0.02;

/// Least share of a column's square that is independent of all other columns, for its parameter to be known.
const KNOWN: f64 = 1e-6;

/// Least residual of a joint for its weight, as a share of its effort.
const FLOOR: f64 = 1e-4;

/// The standard model of robot identification, which replaces the nominal one:
///
/// ```text
/// effort = Y_b pi_b + rotor qdd + viscous qd + coulomb s + offset,   s = tanh(qd / noise of qd)
/// ```
///
/// Base parameters of the bodies and four parameters of every drive, by least squares over all joints, weighted first
/// by the RMS of the efforts and then by that of the residuals (Swevers et al. 1997).
///
/// Friction, offset and rotor are named where the estimate is three standard errors and 2 % of the joint's effort
/// away from the nominal value, most effort first. A standard error counts only independent samples, and includes the
/// uncertainty of all other parameters.
///
/// # Errors
///
/// [`ExperimentError::Log`](experiment::ExperimentError::Log) for runs that cannot be prepared.
pub fn least_squares(
    robot: &Robot,
    control_rate_hz: Option<f64>,
    runs: &[Run],
) -> Result<Baseline, BenchmarkError> {
    let logs = prepare_runs(robot, control_rate_hz, runs, &PrepareSettings::default())?;
    let scales = Scales::of(robot, &logs);
    let base = base_parameters(robot, ColumnSet::ALL);
    let columns: Vec<RegressorColumn> = base.independent.iter().map(|&c| base.columns[c]).collect();
    let columns: Vec<RegressorColumn> = columns.into_iter().filter(|c| shows(c, &scales)).collect();
    let at_joint = |j: usize| columns.iter().filter_map(|c| shape(robot, j, c)).collect();
    let shapes = (0..robot.joint_count()).map(at_joint).collect();
    let dataset = Dataset::of((robot, &scales), &logs, shapes)?;
    let mut fit = Fitted { robot, dataset, columns, deviations: Vec::new(), parameters: vec![] };
    fit.deviations = fit.dataset.joints.iter().map(|j| j.torque_rms).collect();
    fit.solve();
    fit.deviations = (0..robot.joint_count()).map(|j| fit.residual_rms(j)).collect();
    fit.solve();
    let weights = (0..robot.joint_count()).map(|j| fit.weights(j)).collect();
    Ok(Baseline::new(fit.names(), weights, scales))
}

/// Whether a drive's column is informative: a joint that does not move shows no friction.
fn shows(column: &RegressorColumn, scales: &Scales) -> bool {
    match *column {
        RegressorColumn::Inertial { .. } | RegressorColumn::Offset { .. } => true,
        RegressorColumn::Rotor { joint }
        | RegressorColumn::Viscous { joint }
        | RegressorColumn::Coulomb { joint } => scales.moves[joint],
    }
}

/// The column of a parameter at joint `j`, if it has one.
fn shape(robot: &Robot, j: usize, column: &RegressorColumn) -> Option<Shape> {
    let (joint, shape) = match *column {
        RegressorColumn::Inertial { link, parameter } => {
            let mut carriers = std::iter::successors(Some(link), |at| robot.links()[*at].parent);
            return carriers.any(|at| at == j).then_some(Shape::Body { link, parameter });
        }
        RegressorColumn::Rotor { joint } => (joint, Shape::Acceleration),
        RegressorColumn::Viscous { joint } => (joint, Shape::Velocity),
        RegressorColumn::Coulomb { joint } => (joint, Shape::Sign),
        RegressorColumn::Offset { joint } => (joint, Shape::One),
    };
    (joint == j).then_some(shape)
}

struct Fitted<'a> {
    robot: &'a Robot,
    dataset: Dataset,
    columns: Vec<RegressorColumn>,
    /// Divisor of the rows of each joint.
    deviations: Vec<f64>,
    /// One per column.
    parameters: Vec<f64>,
}

impl Fitted<'_> {
    /// Index among all columns of each column at joint `j`, in the order of the joint's columns.
    fn places(&self, j: usize) -> Vec<usize> {
        let here = |c: &usize| shape(self.robot, j, &self.columns[*c]).is_some();
        (0..self.columns.len()).filter(here).collect()
    }

    /// Gram matrix over all joints, the effort last.
    fn sums(&self) -> Mat<f64> {
        let width = self.columns.len();
        let mut sums = Mat::zeros(width + 1, width + 1);
        for (j, joint) in self.dataset.joints.iter().enumerate() {
            let mut places = self.places(j);
            places.push(width);
            let scale = |i: usize| joint.scales.get(i).copied().unwrap_or(1.0);
            let weight = self.deviations[j].max(f64::MIN_POSITIVE).powi(-2);
            for (i, &row) in places.iter().enumerate() {
                for (k, &column) in places.iter().enumerate() {
                    let product = joint.total[(i, k)] * scale(i) * scale(k);
                    sums[(row, column)] += weight * product;
                }
            }
        }
        sums
    }

    fn solve(&mut self) {
        let all: Vec<usize> = (0..self.columns.len()).collect();
        self.parameters = fit(&self.sums(), &all, all.len()).weights;
    }

    /// Parameters in the units of the joint's scaled columns.
    fn scaled_parameters(&self, j: usize) -> Vec<f64> {
        let scales = &self.dataset.joints[j].scales;
        self.places(j).iter().zip(scales).map(|(&at, scale)| self.parameters[at] * scale).collect()
    }

    /// RMS of the residual at joint `j`, with the floor.
    fn residual_rms(&self, j: usize) -> f64 {
        let joint = &self.dataset.joints[j];
        let own: Vec<usize> = (0..joint.target()).collect();
        let square = square_left(&joint.total, &own, &self.scaled_parameters(j), joint.target());
        let mean = square / joint.samples.max(1) as f64;
        (mean + (FLOOR * joint.torque_rms).powi(2)).sqrt()
    }

    fn weights(&self, j: usize) -> Vec<Weighted> {
        let shapes = self.dataset.joints[j].shapes.iter().zip(self.places(j));
        let with_weight = |(&shape, at)| Weighted { shape, weight: self.parameters[at] };
        shapes.map(with_weight).collect()
    }

    /// Number of samples at joint `j` that count as one independent sample.
    fn memory(&self, j: usize) -> f64 {
        let joint: &Joint = &self.dataset.joints[j];
        let own: Vec<usize> = (0..joint.target()).collect();
        memory(&joint.residual_of(&own, &self.scaled_parameters(j)), &self.dataset.runs)
    }

    fn names(&self) -> Vec<EffectAt> {
        let sums = self.sums();
        let memories: Vec<f64> = (0..self.dataset.joints.len()).map(|j| self.memory(j)).collect();
        let mut named: Vec<(f64, EffectAt)> = Vec::new();
        for (at, column) in self.columns.iter().enumerate() {
            let Some((effect, j, nominal)) = drive(self.robot, column) else { continue };
            let others: Vec<usize> = (0..self.columns.len()).filter(|c| *c != at).collect();
            let left = fit(&sums, &others, at).square;
            let off = self.parameters[at] - nominal;
            let joint = &self.dataset.joints[j];
            let own = joint.shapes.iter().position(|s| Some(*s) == shape(self.robot, j, column));
            let share = own.map_or(0.0, |own| off.abs() * joint.scales[own] / joint.torque_rms);
            let is_known = left > KNOWN * sums[(at, at)];
            let is_off = off * off * left > STANDARD_ERRORS * STANDARD_ERRORS * memories[j];
            if is_known && is_off && share > LEAST_SHARE {
                let joint = Some(self.robot.links()[j].joint.name.clone());
                named.push((share, EffectAt { effect, joint, link: None }));
            }
        }
        named.sort_by(|a, b| b.0.total_cmp(&a.0));
        named.into_iter().map(|(_, at)| at).collect()
    }
}

/// The cause that a parameter of a drive stands for, its joint and its value in the description.
fn drive(robot: &Robot, column: &RegressorColumn) -> Option<(EffectKind, usize, f64)> {
    let (effect, j) = match *column {
        RegressorColumn::Inertial { .. } => return None,
        RegressorColumn::Rotor { joint } => (EffectKind::RotorInertia, joint),
        RegressorColumn::Viscous { joint } => (EffectKind::ViscousFriction, joint),
        RegressorColumn::Coulomb { joint } => (EffectKind::CoulombFriction, joint),
        RegressorColumn::Offset { joint } => (EffectKind::TorqueOffset, joint),
    };
    let a = &robot.links()[j].actuator;
    let gain = a.transmission_ratio * a.torque_gain;
    let nominal = match effect {
        EffectKind::RotorInertia => gain * a.rotor_inertia,
        EffectKind::ViscousFriction => gain * a.viscous,
        EffectKind::CoulombFriction => 0.5 * gain * (a.coulomb_forward + a.coulomb_backward),
        _ => 0.5 * gain * (a.coulomb_forward - a.coulomb_backward) + a.torque_offset,
    };
    Some((effect, j, nominal))
}
