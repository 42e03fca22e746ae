use crate::samples::{SampleState, Samples};

/// The inputs that a Gaussian process computes from a state, and their scaling.
///
/// ```text
/// x = ( (q, qd, qdd, direction) - mean ) / deviation
/// direction_j = clamp(qd_j / rest_speed_j, -1, 1)
/// ```
///
/// with mean and standard deviation over the training points; the directions of motion are there
/// only where they are asked for. An input that is constant in training has deviation one, so that
/// its length scale alone decides its effect elsewhere.
#[derive(Debug, Clone, PartialEq)]
pub struct ProcessInputs {
    /// Mean of every input: positions, velocities, accelerations, then directions.
    pub mean: Vec<f64>,
    /// Standard deviation of every input.
    pub deviation: Vec<f64>,
    /// Speed below which a joint counts as at rest (rad/s or m/s), one entry a joint, where
    /// directions are inputs; else empty.
    pub rest_speed: Vec<f64>,
    joints: usize,
}

impl ProcessInputs {
    /// The scaling to zero mean and unit variance over `samples`. `rest_speed` has one entry a
    /// joint if directions of motion are to be inputs, none if not.
    pub fn new(samples: &Samples, rest_speed: Vec<f64>) -> Self {
        let joints = samples.joints();
        let width = 3 * joints + rest_speed.len();
        let mut inputs =
            Self { mean: vec![0.0; width], deviation: vec![1.0; width], rest_speed, joints };
        let n = samples.len().max(1) as f64;
        let raw = inputs.points(samples);
        let column = |d: usize| raw.iter().skip(d).step_by(width);
        let mean: Vec<f64> = (0..width).map(|d| column(d).sum::<f64>() / n).collect();
        let deviation = |d: usize| {
            let variance = column(d).map(|x| (x - mean[d]) * (x - mean[d])).sum::<f64>() / n;
            // Rounding of a constant is no variation.
            let least = 1e-12 * mean[d].abs().max(f64::MIN_POSITIVE);
            Some(variance.sqrt()).filter(|s| *s > least).unwrap_or(1.0)
        };
        inputs.deviation = (0..width).map(deviation).collect();
        inputs.mean = mean;
        inputs
    }

    /// The scaling that was saved with a model.
    pub fn from_parts(mean: Vec<f64>, deviation: Vec<f64>, rest_speed: Vec<f64>) -> Self {
        let joints = (mean.len() - rest_speed.len().min(mean.len())) / 3;
        Self { mean, deviation, rest_speed, joints }
    }

    /// Number of inputs.
    pub fn width(&self) -> usize {
        self.mean.len()
    }

    /// Names of the inputs, 1-based: `q1`, `qd1`, `qdd1`, `direction1`.
    pub fn names(&self) -> Vec<String> {
        let kinds = ["q", "qd", "qdd", "direction"];
        let named = |d: usize| format!("{}{}", kinds[d / self.joints.max(1)], d % self.joints + 1);
        (0..self.width()).map(named).collect()
    }

    /// Fills `x` with the inputs in a state.
    ///
    /// # Panics
    ///
    /// When the state is of another number of joints or `x` has the wrong length.
    pub fn fill(&self, state: SampleState, x: &mut [f64]) {
        let n = self.joints;
        assert!(state.q.len() == n && x.len() == self.width(), "inputs of {n} joints");
        let direction = state.qd.iter().zip(&self.rest_speed);
        let direction = direction.map(|(v, rest)| (v / rest).clamp(-1.0, 1.0));
        let raw = state.q.iter().chain(state.qd).chain(state.qdd).copied().chain(direction);
        let scaled = raw.zip(&self.mean).zip(&self.deviation).map(|((v, m), s)| (v - m) / s);
        x.iter_mut().zip(scaled).for_each(|(x, v)| *x = v);
    }

    /// The inputs of every sample, row-major.
    pub fn points(&self, samples: &Samples) -> Vec<f64> {
        let mut points = vec![0.0; samples.len() * self.width()];
        let rows = points.chunks_exact_mut(self.width().max(1)).enumerate();
        rows.for_each(|(i, row)| self.fill(samples.state(i), row));
        points
    }

    /// The samples, without torques, whose inputs are `points`.
    pub(crate) fn samples(&self, points: &[f64]) -> Samples {
        let raw = |row: &[f64], d: usize| row[d] * self.deviation[d] + self.mean[d];
        let rows = || points.chunks_exact(self.width().max(1));
        let signal = |kind: usize| -> Vec<f64> {
            let of = kind * self.joints..(kind + 1) * self.joints;
            rows().flat_map(|row| of.clone().map(|d| raw(row, d))).collect()
        };
        Samples::of_states(self.joints, [signal(0), signal(1), signal(2)])
    }
}
