use dynamics::ColumnSet;
use faer::Mat;
use gaussian_process::{GaussianKernel, InducingPosterior};
use robot::{Actuator, Inertia, Robot};
use serde::{Deserialize, Serialize};
use sha2::{Digest, Sha256};

use crate::inputs::ProcessInputs;
use crate::model::{Mean, Model};
use crate::robot_torque::RobotTorque;
use crate::spread::Spread;

/// Version of the format; a file of another one is refused.
pub(crate) const VERSION: u32 = 2;

/// What a model file says beside its table of points.
#[derive(Debug, Clone, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct ModelHeader {
    pub version: u32,
    pub kind: String,
    pub robot: String,
    pub joints: Vec<String>,
    /// Of joints, axes and origins: what the columns of the regressor depend on.
    pub tree_sha256: String,
    pub mean: SavedMean,
    /// Lower triangles of the covariance of the weights, row by row.
    pub weights: Vec<Vec<f64>>,
    pub noise_variance: Vec<f64>,
    pub process: Option<SavedProcess>,
}

#[derive(Debug, Clone, Serialize, Deserialize)]
#[serde(deny_unknown_fields, rename_all = "snake_case")]
pub(crate) enum SavedMean {
    Zero,
    Columns { families: Families, beta: Vec<Vec<f64>> },
    Robot { gravity_in_base: [f64; 3], rest_speed: Vec<f64>, links: Vec<SavedLink> },
}

/// The families of columns beside the inertial ones.
#[derive(Debug, Clone, Copy, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct Families {
    rotor: bool,
    viscous: bool,
    coulomb: bool,
    offset: bool,
}

#[derive(Debug, Clone, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct SavedLink {
    mass: f64,
    com_in_link: [f64; 3],
    /// Row by row.
    about_com: [f64; 9],
    drive: Actuator,
}

#[derive(Debug, Clone, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct SavedProcess {
    pub input_mean: Vec<f64>,
    pub input_deviation: Vec<f64>,
    pub rest_speed: Vec<f64>,
    pub kernels: Vec<SavedKernel>,
    /// The posterior of each joint over inducing points; absent in a process over all its points.
    pub inducing: Option<Vec<SavedInducing>>,
}

#[derive(Debug, Clone, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct SavedKernel {
    pub signal_variance: f64,
    pub length_scales: Vec<f64>,
}

#[derive(Debug, Clone, Copy, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct SavedInducing {
    pub log_likelihood: f64,
    pub unexpressed_variance: f64,
    pub jitter: f64,
    pub samples: usize,
}

impl ModelHeader {
    /// Of a model.
    pub fn of(model: &Model) -> Self {
        let robot = model.robot();
        Self {
            version: VERSION,
            kind: model.kind.name().to_owned(),
            robot: robot.name().to_owned(),
            joints: robot.joint_names().map(str::to_owned).collect(),
            tree_sha256: tree_sha256(robot),
            mean: SavedMean::of(&model.mean),
            weights: model.weights.iter().map(lower_triangle).collect(),
            noise_variance: model.noise_variance.clone(),
            process: model.process.as_ref().map(|process| SavedProcess {
                input_mean: process.inputs.mean.clone(),
                input_deviation: process.inputs.deviation.clone(),
                rest_speed: process.inputs.rest_speed.clone(),
                kernels: process.sum.kernels().iter().map(SavedKernel::of).collect(),
                inducing: match &process.spread {
                    Some(Spread::Inducing(all)) => {
                        Some(all.iter().map(SavedInducing::of).collect())
                    }
                    Some(Spread::Exact { .. }) | None => None,
                },
            }),
        }
    }
}

impl SavedMean {
    fn of(mean: &Mean) -> Self {
        match mean {
            Mean::Zero => Self::Zero,
            Mean::Columns { set, beta } => {
                let ColumnSet { rotor, viscous, coulomb, offset } = *set;
                let families = Families { rotor, viscous, coulomb, offset };
                Self::Columns { families, beta: beta.clone() }
            }
            Mean::Robot(torque) => Self::Robot {
                gravity_in_base: torque.robot().gravity_in_base().into(),
                rest_speed: torque.rest_speed().to_vec(),
                links: torque.robot().links().iter().map(SavedLink::of).collect(),
            },
        }
    }

    /// The mean that was saved, of `robot`; none when it does not fit.
    pub fn restore(&self, robot: &Robot) -> Option<Mean> {
        let joints = robot.joint_count();
        match self {
            Self::Zero => Some(Mean::Zero),
            Self::Columns { families, beta } => {
                let Families { rotor, viscous, coulomb, offset } = *families;
                let set = ColumnSet { rotor, viscous, coulomb, offset };
                let width = set.columns(joints).len();
                let fits = beta.len() == joints && beta.iter().all(|row| row.len() == width);
                fits.then(|| Mean::Columns { set, beta: beta.clone() })
            }
            Self::Robot { gravity_in_base, rest_speed, links } => {
                if links.len() != joints || rest_speed.len() != joints {
                    return None;
                }
                let mut robot = robot.clone().with_gravity((*gravity_in_base).into());
                for (index, saved) in links.iter().enumerate() {
                    saved.restore(robot.link_mut(index)?);
                }
                Some(Mean::Robot(Box::new(RobotTorque::new(robot, rest_speed.clone()))))
            }
        }
    }
}

impl SavedLink {
    fn of(link: &robot::Link) -> Self {
        let inertia = &link.inertia;
        let mut about_com = [0.0; 9];
        about_com.iter_mut().zip(inertia.about_com.transpose().iter()).for_each(|(a, b)| *a = *b);
        Self {
            mass: inertia.mass,
            com_in_link: inertia.com_in_link.into(),
            about_com,
            drive: link.actuator.clone(),
        }
    }

    fn restore(&self, link: &mut robot::Link) {
        link.inertia = Inertia {
            mass: self.mass,
            com_in_link: self.com_in_link.into(),
            about_com: nalgebra::Matrix3::from_row_slice(&self.about_com),
        };
        link.actuator = self.drive.clone();
    }
}

impl SavedProcess {
    /// How a state becomes an input; none when the lengths do not fit.
    pub fn inputs(&self, joints: usize) -> Option<ProcessInputs> {
        let directions = self.rest_speed.len();
        let width = 3 * joints + directions;
        let fits = (directions == 0 || directions == joints)
            && self.input_mean.len() == width
            && self.input_deviation.len() == width
            && self.kernels.len() == joints
            && self.kernels.iter().all(|k| k.length_scales.len() == width);
        let [mean, deviation] = [&self.input_mean, &self.input_deviation].map(Clone::clone);
        fits.then(|| ProcessInputs::from_parts(mean, deviation, self.rest_speed.clone()))
    }
}

impl SavedKernel {
    fn of(kernel: &GaussianKernel) -> Self {
        let GaussianKernel { signal_variance, length_scales } = kernel.clone();
        Self { signal_variance, length_scales }
    }

    /// The kernel again.
    pub fn restore(&self) -> GaussianKernel {
        let Self { signal_variance, length_scales } = self.clone();
        GaussianKernel { signal_variance, length_scales }
    }
}

impl SavedInducing {
    fn of(posterior: &InducingPosterior) -> Self {
        let InducingPosterior { log_likelihood, unexpressed_variance, jitter, samples, .. } =
            *posterior;
        Self { log_likelihood, unexpressed_variance, jitter, samples }
    }

    /// The posterior over inducing points, from its saved part, its weights and its factor.
    pub fn restore(&self, alpha: Vec<f64>, variance_factor: Vec<f64>) -> InducingPosterior {
        let Self { log_likelihood, unexpressed_variance, jitter, samples } = *self;
        InducingPosterior {
            alpha,
            variance_factor,
            log_likelihood,
            unexpressed_variance,
            jitter,
            samples,
        }
    }
}

fn lower_triangle(matrix: &Mat<f64>) -> Vec<f64> {
    (0..matrix.nrows()).flat_map(|i| (0..=i).map(move |j| matrix[(i, j)])).collect()
}

/// The symmetric matrix of a lower triangle, row by row; none when it is not of `width` rows.
pub(crate) fn symmetric(triangle: &[f64], width: usize) -> Option<Mat<f64>> {
    let at = |i: usize, j: usize| triangle[i * (i + 1) / 2 + j];
    let fits = triangle.len() == width * (width + 1) / 2;
    fits.then(|| Mat::from_fn(width, width, |i, j| at(i.max(j), i.min(j))))
}

/// SHA-256 of the tree of joints: parents, kinds, axes and origins, bit by bit.
pub(crate) fn tree_sha256(robot: &Robot) -> String {
    let mut hash = Sha256::new();
    for link in robot.links() {
        let joint = &link.joint;
        hash.update(format!("{:?} {:?} {:?};", link.parent, joint.kind, joint.name));
        let numbers = joint.parent_from_joint.to_homogeneous();
        let numbers = numbers.iter().chain(joint.axis_in_joint.iter());
        numbers.for_each(|x| hash.update(x.to_le_bytes()));
    }
    hash.finalize().iter().map(|byte| format!("{byte:02x}")).collect()
}
