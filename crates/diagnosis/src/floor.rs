use logs::Prepared;
use realfft::RealFftPlanner;

use crate::design::Design;
use crate::repeats::repeats;
use crate::result::NoiseFloorSource;

/// Noise above the band begins at so many cut-offs.
const ABOVE_BAND: f64 = 3.0;

/// Autocorrelation time (samples) above which a residual is too slow to be noise.
const SLOW: f64 = 2.5;

/// Noise floors measured without any model: none where the logs do not allow it.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Floors {
    /// RMS difference of runs that repeat a motion, over `sqrt 2`, per joint (N·m or N).
    pub repeats: Option<Vec<f64>>,
    /// RMS in the band of white noise seen above it, per joint (N·m or N).
    pub white: Option<Vec<f64>>,
}

impl Floors {
    /// Measures both.
    pub fn new(design: &Design, prepared: &Prepared) -> Self {
        Self { repeats: repeats(design), white: white(prepared) }
    }

    /// The noise floor of joint `j`: what repeats say; otherwise what a flexible predictor
    /// leaves, `flexible`. Where that is slow (`time` in samples) although the effort's own
    /// noise is white and smaller, it is not noise, and the white noise is the floor.
    pub fn choose(&self, j: usize, flexible: f64, time: f64) -> (f64, NoiseFloorSource) {
        let below = |floors: &Option<Vec<f64>>| {
            floors.as_ref().map(|rms| rms[j]).filter(|rms| *rms <= flexible)
        };
        match (below(&self.repeats), below(&self.white)) {
            (Some(rms), _) => (rms, NoiseFloorSource::Repeats),
            (None, Some(rms)) if time > SLOW => (rms, NoiseFloorSource::HighFrequencyBand),
            _ => (flexible, NoiseFloorSource::FlexiblePredictor),
        }
    }
}

/// RMS in the band of white noise whose density is the median of the effort's periodogram
/// above three cut-offs:
///
/// ```text
/// rms^2 = S cutoff integral_0^inf dx / (1 + x^8)^2 = 0.898 S cutoff
/// ```
///
/// The median of a periodogram of white noise is `ln 2` of its mean.
fn white(prepared: &Prepared) -> Option<Vec<f64>> {
    let joints = prepared.runs.first()?.joints.len();
    let mut planner = RealFftPlanner::<f64>::new();
    let mut densities = vec![Vec::new(); joints];
    for run in &prepared.runs {
        let n = run.time.len();
        let first = (ABOVE_BAND * prepared.cutoff_hz * n as f64 / run.rate_hz).ceil() as usize;
        let last = (0.45 * n as f64) as usize;
        if first + 16 > last {
            return None;
        }
        let transform = planner.plan_fft_forward(n);
        for (joint, density) in run.joints.iter().zip(&mut densities) {
            // A Hann window keeps the power of the motion from leaking into the band of the noise.
            let angle = std::f64::consts::TAU / n as f64;
            let hann = |t: usize| 0.5 - 0.5 * (angle * t as f64).cos();
            let mut x: Vec<f64> =
                joint.effort.iter().enumerate().map(|(t, e)| e * hann(t)).collect();
            let mut spectrum = transform.make_output_vec();
            transform.process(&mut x, &mut spectrum).ok()?;
            let scale = 2.0 / (run.rate_hz * 0.375 * n as f64);
            density.extend(spectrum[first..last].iter().map(|c| c.norm_sqr() * scale));
        }
    }
    let rms = |mut density: Vec<f64>| {
        density.sort_by(f64::total_cmp);
        let median = density.get(density.len() / 2).copied().unwrap_or(0.0);
        (0.898 * prepared.cutoff_hz * median / std::f64::consts::LN_2).sqrt()
    };
    Some(densities.into_iter().map(rms).collect())
}
