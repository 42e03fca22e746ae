use simulator::effects::EffectSpec;

use crate::hidden::SizedCause;

/// Largest skew of effort and position (ms): two drivers read one after the other, at 20 Hz.
const SKEW_MS: f64 = 50.0;

/// Largest delay or lag from command to torque (ms): two periods of a bus of 50 Hz. A loop that a hobby servo closes
/// is slower, but its arm is not moved by torques.
const LATE_MS: f64 = 40.0;

/// Largest tilt of a base that was taken for level (rad), 6 degrees: what is more is seen.
const TILT: f64 = 0.1;

/// Largest share of load that goes into friction: a worm gear at the edge of locking itself loses half.
const LOAD_SHARE: f64 = 0.5;

/// Largest share of cold friction that a warm drive has lost: the WAM's and harmonic drives lose up to two thirds
/// (Bittencourt & Gunnarsson 2012).
const WARM_SHARE: f64 = 0.67;

/// Largest zero error of an encoder (rad or m), 6 degrees: what is more is seen by eye, and a homing that missed by a
/// tooth is off by less.
const OFFSET: f64 = 0.1;

/// Largest play of a drive (rad or m), a degree and a half: that of a worn hobby servo.
const PLAY: f64 = 0.026;

impl SizedCause {
    /// The same, no larger than workshops have it. Other kinds have their largest size where they are drawn: ratio,
    /// constant of torque, elasticity, payload, bodies.
    pub fn within_workshops(mut self) -> Self {
        if let Self::Cause(effect) = &mut self {
            match effect {
                EffectSpec::TimeSkew(e) => e.skew_ms = e.skew_ms.clamp(-SKEW_MS, SKEW_MS),
                EffectSpec::ActuatorDelay(e) => e.delay_ms = e.delay_ms.min(LATE_MS),
                EffectSpec::ActuatorLag(e) => e.time_constant_ms = e.time_constant_ms.min(LATE_MS),
                EffectSpec::LoadDependentFriction(e) => {
                    e.coefficient = e.coefficient.min(LOAD_SHARE)
                }
                EffectSpec::FrictionTemperatureDrift(e) => e.share = e.share.min(WARM_SHARE),
                EffectSpec::EncoderOffset(e) => e.offset_rad = e.offset_rad.clamp(-OFFSET, OFFSET),
                EffectSpec::Backlash(e) => e.gap_rad = e.gap_rad.min(PLAY),
                EffectSpec::GravityDirection(e) => {
                    let factor = (TILT / e.tilt_x_rad.hypot(e.tilt_y_rad).max(1e-12)).min(1.0);
                    e.tilt_x_rad *= factor;
                    e.tilt_y_rad *= factor;
                }
                _ => {}
            }
        }
        self
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_size_is_that_of_a_workshop() {
        let sized = |text: &str| {
            let effect: EffectSpec = toml::from_str(text).unwrap();
            let SizedCause::Cause(effect) = SizedCause::Cause(effect).within_workshops() else {
                panic!()
            };
            effect.truth().parameters.into_values().collect::<Vec<f64>>()
        };
        assert_eq!(sized("time_skew = { skew_ms = -1000.0 }"), [-0.05]);
        assert_eq!(sized("time_skew = { skew_ms = 12.0 }"), [0.012]);
        assert_eq!(sized(r#"actuator_delay = { joint = "a", delay_ms = 300.0 }"#), [0.04]);
        let tilt = sized("gravity_direction = { tilt_x_rad = -0.3, tilt_y_rad = 0.4 }");
        assert!((tilt[0] + 0.06).abs() < 1e-12 && (tilt[1] - 0.08).abs() < 1e-12, "{tilt:?}");
    }
}
