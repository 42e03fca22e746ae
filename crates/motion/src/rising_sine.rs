use std::f64::consts::TAU;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// One sine whose frequency goes from `from_hz` to `to_hz` in `over_s`:
///
/// ```text
/// x = centre + amplitude sin(phi(t))
/// linear:       phi = 2 pi (f0 t + (f1 - f0) t^2 / (2 T))
/// logarithmic:  phi = 2 pi f0 T / ln(f1/f0) ((f1/f0)^(t/T) - 1)
/// ```
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct RisingSine {
    /// Position of each joint about which it swings (rad or m).
    pub centre: Vec<f64>,
    /// Amplitude of each joint (rad or m).
    pub amplitude: Vec<f64>,
    pub from_hz: f64,
    pub to_hz: f64,
    pub over_s: f64,
    pub growth: Growth,
}

/// How the frequency of a chirp changes.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Growth {
    /// By the same difference in the same time.
    #[default]
    Linear,
    /// By the same factor in the same time.
    Logarithmic,
}

impl RisingSine {
    pub(crate) fn at(&self, joint: usize, t: f64) -> [f64; 3] {
        let [phi, dphi, ddphi] = self.phase(t);
        let (s, c) = phi.sin_cos();
        let amplitude = self.amplitude[joint];
        [
            self.centre[joint] + amplitude * s,
            amplitude * dphi * c,
            amplitude * (ddphi * c - dphi * dphi * s),
        ]
    }

    pub(crate) fn highest_hz(&self) -> f64 {
        self.from_hz.max(self.to_hz)
    }

    /// `phi` (rad) and its two derivatives.
    fn phase(&self, t: f64) -> [f64; 3] {
        let (w0, w1) = (TAU * self.from_hz, TAU * self.to_hz);
        // ln(f1 / f0) / T: how fast the frequency grows, relative to itself (1/s).
        let rate = (w1 / w0).ln() / self.over_s;
        match self.growth {
            Growth::Logarithmic if rate.abs() > 0.0 => {
                let phi = w0 * (rate * t).exp_m1() / rate;
                let w = w0 * (rate * t).exp();
                [phi, w, rate * w]
            }
            _ => {
                let slope = (w1 - w0) / self.over_s;
                [w0 * t + 0.5 * slope * t * t, w0 + slope * t, slope]
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_frequency_runs_from_one_end_to_the_other_in_the_way_asked_for() {
        let mut sine = RisingSine {
            centre: vec![0.0],
            amplitude: vec![1.0],
            from_hz: 0.5,
            to_hz: 8.0,
            over_s: 4.0,
            growth: Growth::Linear,
        };
        let hz = |sine: &RisingSine, t| sine.phase(t)[1] / TAU;
        assert!((hz(&sine, 2.0) - 4.25).abs() < 1e-12);
        sine.growth = Growth::Logarithmic;
        assert!((hz(&sine, 2.0) - 2.0).abs() < 1e-12);
        assert!((hz(&sine, 4.0) - 8.0).abs() < 1e-12);
        let turns = 0.5 * 4.0 / 16_f64.ln() * 15.0;
        assert!((sine.phase(4.0)[0] / TAU - turns).abs() < 1e-12);
    }
}
