use crate::samples::Samples;
use crate::torque_model::TorqueModel;

/// Half-width of an interval that holds 95 % of a normal distribution (standard deviations).
const NORMAL_95: f64 = 1.959_963_984_540_054;

/// How well a model predicts torques that it has not seen, per joint.
#[derive(Debug, Clone, PartialEq)]
pub struct TorqueScore {
    /// Mean square error over the variance of the torque about its mean; NaN where the torque
    /// is constant.
    pub nmse: Vec<f64>,
    /// Root mean square error (N m or N).
    pub rmse: Vec<f64>,
    /// Share of the torques inside their 95 % interval; NaN where the model tells no variance.
    pub coverage: Vec<f64>,
    /// Mean logarithm of the predictive density (of torques in N m or N); NaN likewise.
    pub log_density: Vec<f64>,
}

impl TorqueScore {
    /// Scores `model` on `test`.
    ///
    /// # Panics
    ///
    /// When the samples are of another number of joints.
    pub fn of(model: &dyn TorqueModel, test: &Samples) -> Self {
        let joints = model.joints();
        let (torque, variance) = (model.torque(test), model.variance(test));
        let n = test.len() as f64;
        let mut score = Self { nmse: vec![], rmse: vec![], coverage: vec![], log_density: vec![] };
        for k in 0..joints {
            let of =
                |all: &[f64]| -> Vec<f64> { all.iter().skip(k).step_by(joints).copied().collect() };
            let measured: Vec<f64> = (0..test.len()).map(|i| test.tau(i)[k]).collect();
            let errors: Vec<f64> = measured.iter().zip(of(&torque)).map(|(m, t)| m - t).collect();
            let mean = measured.iter().sum::<f64>() / n;
            let spread = measured.iter().map(|m| (m - mean) * (m - mean)).sum::<f64>() / n;
            let square = errors.iter().map(|e| e * e).sum::<f64>() / n;
            let variance = of(&variance);
            let inside = |(e, v): (&f64, &f64)| e.abs() <= NORMAL_95 * v.sqrt();
            let density =
                |(e, v): (&f64, &f64)| -0.5 * (e * e / v + (std::f64::consts::TAU * v).ln());
            let known = variance.iter().all(|v| v.is_finite());
            let share =
                errors.iter().zip(&variance).filter(|&pair| inside(pair)).count() as f64 / n;
            let density = errors.iter().zip(&variance).map(density).sum::<f64>() / n;
            score.nmse.push(if spread > 0.0 { square / spread } else { f64::NAN });
            score.rmse.push(square.sqrt());
            score.coverage.push(if known { share } else { f64::NAN });
            score.log_density.push(density);
        }
        score
    }
}
