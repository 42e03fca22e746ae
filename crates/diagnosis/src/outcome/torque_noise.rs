use dynamics::Dynamics;
use logs::Prepared;
use nalgebra::DMatrix;
use robot::Robot;

use crate::columns::design::Design;
use crate::columns::repeats::noise_of_repeats;
use crate::result::NoiseFloorSource;
use crate::thresholds::signals::SignalThresholds;

/// Postures at which the inertia is averaged.
const POSTURES: usize = 100;

/// Points of a spectrum.
const POINTS: usize = 24;

/// Lowest frequency of a spectrum, in cut-offs.
const LOWEST: f64 = 0.02;

/// Noise of the efforts, from sources other than the residuals of a model.
///
/// ```text
/// S_i(f) = S_effort,i + gain_i^2 sum_j mean(M_ij^2) S_qdd,j(f)
/// rms_i^2 = integral S_i(f) / (1 + (f / cutoff)^8)^2 df
/// ```
///
/// with `M` the inertia of bodies and rotors, its squares averaged over the postures of the logs,
/// `S_effort` the effort's own noise, and `S_qdd` the noise of the encoders in the acceleration. Where runs repeat a motion,
/// their difference says more and is used instead.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct TorqueNoise {
    joints: Vec<Sources>,
    repeats: Option<Vec<f64>>,
}

/// Sources of the noise of one joint, as RMS in the band (N·m or N), and over frequency.
#[derive(Debug, Clone, PartialEq)]
struct Sources {
    effort: f64,
    encoders: f64,
    /// Frequency (Hz) and one-sided density behind the low-pass ((N·m)²/Hz or N²/Hz).
    spectrum: Vec<(f64, f64)>,
}

impl TorqueNoise {
    /// The noise of the efforts of the logs from which `design` is made.
    pub fn new(
        robot: &Robot,
        design: &Design,
        prepared: &Prepared,
        thresholds: &SignalThresholds,
    ) -> Self {
        let carried = inertia_squares(robot, prepared);
        let cutoff_hz = prepared.cutoff_hz;
        let sources = |i: usize| {
            let effort = prepared.noise[i].effort.density;
            let encoders = |hz: f64| -> f64 {
                let of = |(j, noise): (usize, &logs::JointNoise)| {
                    carried[(i, j)] * noise.acceleration_density(hz)
                };
                prepared.noise.iter().enumerate().map(of).sum()
            };
            let square = |(j, noise): (usize, &logs::JointNoise)| {
                carried[(i, j)] * noise.acceleration_rms(cutoff_hz).powi(2)
            };
            let filter_gain = |hz: f64| (1.0 + (hz / cutoff_hz).powi(8)).powi(-2);
            let point = |hz: f64| (hz, filter_gain(hz) * (effort + encoders(hz)));
            Sources {
                effort: (PASSED * cutoff_hz * effort).sqrt(),
                encoders: prepared.noise.iter().enumerate().map(square).sum::<f64>().sqrt(),
                spectrum: frequencies(cutoff_hz).map(point).collect(),
            }
        };
        let joints = (0..robot.joint_count()).map(sources).collect();
        let repeats = noise_of_repeats(design.runs_to_compare(thresholds));
        Self { joints, repeats }
    }

    /// RMS of the noise of joint `j` in the band (N·m or N), and its source; zero where no source is known.
    pub fn rms(&self, j: usize) -> (f64, NoiseFloorSource) {
        if let Some(rms) = self.repeats.as_ref().map(|rms| rms[j]) {
            return (rms, NoiseFloorSource::Repeats);
        }
        let Sources { effort, encoders, .. } = self.joints[j];
        let source = match (effort, encoders) {
            (e, p) if e.max(p) <= 0.0 => NoiseFloorSource::Unknown,
            (e, p) if p > e => NoiseFloorSource::Encoders,
            _ => NoiseFloorSource::Effort,
        };
        (effort.hypot(encoders), source)
    }

    /// RMS in the band of the effort's own noise of joint `j`, and of the noise of the encoders carried to torque (N·m
    /// or N).
    pub fn sources(&self, j: usize) -> [f64; 2] {
        let Sources { effort, encoders, .. } = self.joints[j];
        [effort, encoders]
    }

    /// Frequencies (Hz) and densities of the noise of joint `j` behind the low-pass.
    pub fn spectrum(&self, j: usize) -> &[(f64, f64)] {
        &self.joints[j].spectrum
    }
}

/// Integral over all `x` of `1 / (1 + x^8)^2`.
const PASSED: f64 = 0.897_91;

/// The frequencies of a spectrum (Hz), each a constant factor above the one before.
pub(crate) fn frequencies(cutoff_hz: f64) -> impl Iterator<Item = f64> {
    let last = (POINTS - 1) as f64;
    (0..POINTS).map(move |k| cutoff_hz * LOWEST.powf(1.0 - k as f64 / last))
}

/// `gain_i^2 mean(M_ij^2)`, over postures of the logs.
fn inertia_squares(robot: &Robot, prepared: &Prepared) -> DMatrix<f64> {
    let joints = robot.joint_count();
    let dynamics = Dynamics::new(robot);
    let total: usize = prepared.runs.iter().map(|run| run.time.len()).sum();
    let every = (total / POSTURES).max(1);
    let (mut sum, mut count) = (DMatrix::zeros(joints, joints), 0_usize);
    for run in &prepared.runs {
        for t in (0..run.time.len()).step_by(every) {
            let q: Vec<f64> = run.joints.iter().map(|j| j.q[t]).collect();
            let Ok(mut mass) = dynamics.mass_matrix(&q) else { continue };
            for (j, link) in robot.links().iter().enumerate() {
                mass[(j, j)] += link.actuator.rotor_inertia;
            }
            sum += mass.component_mul(&mass);
            count += 1;
        }
    }
    for (i, link) in robot.links().iter().enumerate() {
        let gain = link.actuator.transmission_ratio * link.actuator.torque_gain;
        sum.row_mut(i).scale_mut(gain * gain / count.max(1) as f64);
    }
    sum
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn frequencies_end_at_the_cut_off() {
        let all: Vec<f64> = frequencies(10.0).collect();
        assert!((all[0] - 0.2).abs() < 1e-12);
        assert!((all[POINTS - 1] - 10.0).abs() < 1e-12);
    }
}
