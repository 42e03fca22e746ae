use std::f64::consts::TAU;

/// A sum of sinusoids for every joint:
///
/// ```text
/// x = offset + sum sin_k sin(w_k t) + cos_k cos(w_k t),   w_k = 2 pi hz_k
/// ```
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Harmonics {
    pub joints: Vec<HarmonicSeries>,
}

/// The sum of one joint.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct HarmonicSeries {
    /// Position about which it swings (rad or m).
    pub offset: f64,
    pub terms: Vec<Term>,
}

/// One sinusoid; amplitudes in rad or m.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Term {
    pub hz: f64,
    pub sin: f64,
    pub cos: f64,
}

impl Harmonics {
    pub(crate) fn at(&self, joint: usize, t: f64) -> [f64; 3] {
        let series = &self.joints[joint];
        let mut x = [series.offset, 0.0, 0.0];
        for term in &series.terms {
            let w = TAU * term.hz;
            let (s, c) = (w * t).sin_cos();
            let swing = term.sin * s + term.cos * c;
            x[0] += swing;
            x[1] += w * (term.sin * c - term.cos * s);
            x[2] -= w * w * swing;
        }
        x
    }

    /// Bounds of the magnitude of a joint's acceleration and of its derivative:
    ///
    /// ```text
    /// sum w_k² a_k,  sum w_k³ a_k,   a_k = sqrt(sin_k² + cos_k²)
    /// ```
    pub(crate) fn steepest(&self, joint: usize) -> [f64; 2] {
        self.joints[joint].terms.iter().fold([0.0; 2], |[qdd, jerk], term| {
            let (w, amplitude) = (TAU * term.hz, term.sin.hypot(term.cos));
            [qdd + w * w * amplitude, jerk + w * w * w * amplitude]
        })
    }

    pub(crate) fn highest_hz(&self) -> f64 {
        let terms = self.joints.iter().flat_map(|series| &series.terms);
        terms.map(|term| term.hz).fold(0.0, f64::max)
    }
}

impl HarmonicSeries {
    /// The same with every amplitude multiplied.
    pub(crate) fn times(mut self, factor: f64) -> Self {
        for term in &mut self.terms {
            term.sin *= factor;
            term.cos *= factor;
        }
        self
    }

    /// The trigonometric polynomial through samples evenly spread over one period:
    ///
    /// ```text
    /// sin_k = 2/N sum x_i sin(2 pi k i / N),  cos_k likewise,  k < N / 2
    /// ```
    pub(crate) fn through(samples: &[f64], hz: f64) -> Self {
        let n = samples.len();
        let amplitude = |k: usize, wave: fn(f64) -> f64| {
            // The product is reduced before it becomes an angle: k i / N turns, less whole ones.
            let angle = |i: usize| TAU * ((k * i) % n) as f64 / n as f64;
            samples.iter().enumerate().map(|(i, x)| x * wave(angle(i))).sum::<f64>() / n as f64
        };
        let term = |k| Term {
            hz: hz * k as f64,
            sin: 2.0 * amplitude(k, f64::sin),
            cos: 2.0 * amplitude(k, f64::cos),
        };
        let mut terms: Vec<Term> = (1..n.div_ceil(2)).map(term).collect();
        while terms.pop_if(|t| t.sin.hypot(t.cos) < NEGLIGIBLE).is_some() {}
        Self { offset: amplitude(0, f64::cos), terms }
    }
}

/// Amplitude below which the last terms of a series are left out (rad or m).
const NEGLIGIBLE: f64 = 1e-12;

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_series_through_samples_gives_back_the_sinusoids_they_were_taken_from() {
        let terms = [(1, 0.3, -0.2), (3, 0.0, 0.05), (6, -0.01, 0.02)];
        let wave = |i: usize| {
            let of = |&(k, s, c): &(i32, f64, f64)| {
                let angle = TAU * f64::from(k) * i as f64 / 16.0;
                s * angle.sin() + c * angle.cos()
            };
            0.7 + terms.iter().map(of).sum::<f64>()
        };
        let samples: Vec<f64> = (0..16).map(wave).collect();
        let series = HarmonicSeries::through(&samples, 0.5);
        assert!((series.offset - 0.7).abs() < 1e-15);
        assert_eq!(series.terms.len(), 6, "what lies above is nothing");
        for (k, s, c) in terms {
            let term = series.terms[k as usize - 1];
            assert!((term.sin - s).abs() < 1e-15 && (term.cos - c).abs() < 1e-15, "{term:?}");
            assert!((term.hz - 0.5 * f64::from(k)).abs() < 1e-15);
        }
    }
}
