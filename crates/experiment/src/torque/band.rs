use logs::{LogError, LowPass, decimate};

/// Order of the low-pass, before it runs forward and backward.
const ORDER: usize = 4;

/// Rate at which columns are evaluated, in cut-off frequencies.
const EVALUATION_RATE: f64 = 16.0;

/// Rate of a regression, in cut-off frequencies.
const REGRESSION_RATE: f64 = 2.5;

/// Cut-off of the filter before the first decimation, in cut-offs of the band.
const GUARD: f64 = 4.0;

/// The band in which models are compared: a zero-phase low-pass, and the two decimations that bring the rate of a log
/// down to 2.5 cut-off frequencies.
///
/// Rates and filters are those of `diagnosis::unexplained_torque`, so that the errors of all models are of the same
/// samples.
pub struct Band {
    /// Number of samples of a log per sample of a column.
    pub stride: usize,
    second: usize,
    guard: Option<LowPass>,
    low_pass: LowPass,
}

impl Band {
    /// The band below `cutoff_hz` for logs with this rate (Hz).
    ///
    /// # Errors
    ///
    /// [`LogError`] for a cut-off that the rate does not allow.
    pub fn new(cutoff_hz: f64, rate_hz: f64) -> Result<Self, LogError> {
        let first = stride(rate_hz, EVALUATION_RATE * cutoff_hz);
        let rate = rate_hz / first as f64;
        let guard = (first > 1).then(|| LowPass::new(ORDER, GUARD * cutoff_hz, rate_hz));
        Ok(Self {
            stride: first,
            second: stride(rate, REGRESSION_RATE * cutoff_hz),
            guard: guard.transpose()?,
            low_pass: LowPass::new(ORDER, cutoff_hz, rate)?,
        })
    }

    /// Number of samples of a log per sample of the regression.
    pub fn whole_stride(&self) -> usize {
        self.stride * self.second
    }

    /// A signal at the rate of the log, low-passed and brought to the rate of the regression.
    pub fn of_log(&self, mut x: Vec<f64>) -> Vec<f64> {
        if let Some(guard) = &self.guard {
            guard.apply(&mut x);
            x = decimate(&x, self.stride);
        }
        self.of_column(x)
    }

    /// A signal at the rate of a column, low-passed and brought to the rate of the regression.
    pub fn of_column(&self, mut x: Vec<f64>) -> Vec<f64> {
        self.low_pass.apply(&mut x);
        decimate(&x, self.second)
    }
}

fn stride(rate: f64, wanted: f64) -> usize {
    ((rate / wanted) as usize).max(1)
}
