use std::f64::consts::TAU;

use catalogue::EffectKind;
use effects::{Hypothesis, Place};
use nalgebra::Complex;
use robot::{Ripple, Robot};

/// The variable that the phase of a tone follows.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Beat {
    /// The position of the motor: phase per way (1 or rad/m).
    Position(f64),
    /// The clock: frequency (Hz).
    Clock(f64),
}

/// An oscillation of the effort of one joint with one period, in position or in time.
///
/// ```text
/// Re(z exp(i periods q))   or   Re(z exp(i 2 pi frequency t))
/// ```
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Tone {
    /// Index of the joint.
    pub joint: usize,
    /// The variable that its phase follows.
    pub beat: Beat,
    /// `z` of every run (N·m or N), the same in all runs for a tone that follows the position.
    pub z: Vec<Complex<f64>>,
    /// Standard error of the mean amplitude (N·m or N), of the beat and of the phase at beat zero (rad).
    pub error: [f64; 3],
    /// How rare a line as strong is in noise with the spectrum around it (nats).
    pub stands_out: f64,
    /// Share of the joint's residual, over the whole band, that is this tone.
    pub share: f64,
}

impl Beat {
    /// Phase per unit (1 or rad/m; rad/s).
    pub fn rate(self) -> f64 {
        match self {
            Self::Position(periods) => periods,
            Self::Clock(frequency_hz) => TAU * frequency_hz,
        }
    }
}

impl Tone {
    /// The effect and its joint.
    pub fn hypothesis(&self) -> Hypothesis {
        let kind = match self.beat {
            Beat::Position(_) => EffectKind::TorqueRipple,
            Beat::Clock(_) => EffectKind::ExternalDisturbance,
        };
        Hypothesis { kind, place: Place::Joint(self.joint) }
    }

    /// Mean amplitude over the runs (N·m or N).
    pub fn amplitude(&self) -> f64 {
        self.z.iter().map(|z| z.norm()).sum::<f64>() / self.z.len().max(1) as f64
    }

    /// The phase of `sin(beat + phase)` and its standard error (rad). `None` where the mean of the runs' unit phasors
    /// is shorter than `common_phase`.
    ///
    /// A ripple is torque that the motor gives, a disturbance torque that acts on it: their signs differ.
    pub fn sine_phase(&self, common_phase: f64) -> Option<(f64, f64)> {
        let unit: Complex<f64> = self.z.iter().map(|z| z / z.norm().max(f64::MIN_POSITIVE)).sum();
        let alike = unit.norm() / self.z.len().max(1) as f64;
        let sign = match self.beat {
            Beat::Position(_) => 1.0,
            Beat::Clock(_) => -1.0,
        };
        // Re(z e^(i x)) = |z| sin(x + arg(z) + pi / 2)
        let phase = (sign * unit * Complex::i()).arg();
        let [_, _, error] = self.error;
        (alike > common_phase).then_some((phase, error))
    }

    /// Adds the ripple to the drive of the joint. A disturbance is not part of a robot and is left out.
    pub fn extend(&self, robot: &mut Robot, common_phase: f64) {
        let phase = self.sine_phase(common_phase);
        let (Beat::Position(periods), Some((phase, _))) = (self.beat, phase) else {
            return;
        };
        if let Some(link) = robot.link_mut(self.joint) {
            let amplitude = self.amplitude();
            link.actuator.ripple = Some(Ripple { amplitude, periods, phase });
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// `Re(z exp(i rate beat))`
    fn effort(tone: &Tone, beat: f64) -> f64 {
        (tone.z[0] * Complex::cis(tone.beat.rate() * beat)).re
    }

    fn tone(beat: Beat, z: Complex<f64>) -> Tone {
        let z = vec![z; 2];
        Tone { joint: 0, beat, z, error: [0.0; 3], stands_out: 0.0, share: 0.0 }
    }

    #[test]
    fn a_tone_is_the_sine_whose_amplitude_and_phase_it_tells() {
        let (amplitude, z) = (0.7, Complex::from_polar(0.7, 0.4));
        let ripple = tone(Beat::Position(30.0), z);
        let phase = ripple.sine_phase(0.95).unwrap().0;
        for q in [-0.3, 0.0, 1.1] {
            let expected = amplitude * (30.0 * q + phase).sin();
            assert!((effort(&ripple, q) - expected).abs() < 1e-12);
        }
        let hum = tone(Beat::Clock(2.5), z);
        let phase = hum.sine_phase(0.95).unwrap().0;
        let expected = -amplitude * (TAU * 2.5 * 0.37 + phase).sin();
        assert!((effort(&hum, 0.37) - expected).abs() < 1e-12);
    }

    #[test]
    fn runs_that_differ_have_no_phase_in_common() {
        let mut hum = tone(Beat::Clock(1.0), Complex::new(1.0, 0.0));
        hum.z[1] = Complex::new(-1.0, 0.0);
        assert_eq!(hum.sine_phase(0.95), None);
    }
}
