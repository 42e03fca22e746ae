/// Twist of the transmission of one joint under a torque, while its motor keeps to its motion.
///
/// With a compliance `c` the twist `s = theta - q` changes the load that makes it:
///
/// ```text
/// D s = f,   D = 1 + c (dload/dq + dload/dqd d/dt) + E,   E = c dload/dqdd d²/dt²
/// ```
///
/// Far below the resonance of the link on its spring `s = f`. Close to the resonance of a drive without damping the
/// twist would grow without bounds, so `s` minimises `|D s - f|² + RESISTANCE² |E s|²`, which leaves slow twists as
/// they are.
#[derive(Debug, Clone)]
pub(crate) struct Compliance {
    /// `D`, row by row: factors of the twist one sample before, at the sample and one sample after.
    rows: Vec<[f64; 3]>,
    /// `D'D + RESISTANCE² E'E`, diagonal and the two below, as `L diag(d) L'`.
    pivots: Vec<f64>,
    below: [Vec<f64>; 2],
}

/// Weight that bounds the twist: close to the resonance of the link the twist grows to about half the inverse of this
/// weight, and at the resonance it vanishes.
const RESISTANCE: f64 = 0.2;

/// Least pivot, for a load that falls with the twist as fast as the spring torque grows.
const LEAST: f64 = 1e-6;

impl Compliance {
    /// From the derivatives of the load by position, velocity and acceleration, every `period_s`.
    pub fn new(compliance: f64, slopes: &[Vec<f64>; 3], period_s: f64) -> Self {
        let [dq, dqd, dqdd] = slopes;
        let samples = dq.len();
        let inner = |t: usize| t > 0 && t + 1 < samples;
        let swing = |t: usize| {
            let along = if inner(t) { compliance * dqdd[t] / (period_s * period_s) } else { 0.0 };
            [along, -2.0 * along, along]
        };
        let row = |t: usize| {
            let drag = if inner(t) { compliance * dqd[t] / (2.0 * period_s) } else { 0.0 };
            let [before, here, after] = swing(t);
            [before - drag, 1.0 + compliance * dq[t] + here, after + drag]
        };
        let rows: Vec<[f64; 3]> = (0..samples).map(row).collect();
        let swings: Vec<[f64; 3]> = (0..samples).map(swing).collect();
        // Entry `k` below the diagonal in column `t`: the rows that have both `t` and `t + k`.
        let entry = |of: &[[f64; 3]], t: usize, k: usize| -> f64 {
            let both = |row: usize| {
                let of = of.get(row)?;
                Some(of.get(t + 1 - row)? * of.get(t + k + 1 - row)?)
            };
            let first = (t + k).saturating_sub(1);
            (first..=t + 1).filter_map(both).sum()
        };
        let matrix = |t: usize, k: usize| {
            entry(&rows, t, k) + RESISTANCE * RESISTANCE * entry(&swings, t, k)
        };
        let mut pivots: Vec<f64> = Vec::with_capacity(samples);
        let mut below = [Vec::with_capacity(samples), Vec::with_capacity(samples)];
        for t in 0..samples {
            let earlier = |k: usize, of: &[Vec<f64>; 2]| {
                t.checked_sub(k).map_or(0.0, |s| of[k - 1][s] * of[k - 1][s] * pivots[s])
            };
            let pivot = (matrix(t, 0) - earlier(1, &below) - earlier(2, &below)).max(LEAST);
            let crossed = t.checked_sub(1).map_or(0.0, |s| below[0][s] * below[1][s] * pivots[s]);
            below[0].push((matrix(t, 1) - crossed) / pivot);
            below[1].push(matrix(t, 2) / pivot);
            pivots.push(pivot);
        }
        Self { rows, pivots, below }
    }

    /// The twist, where the torque alone would twist by `f`.
    pub fn twist_under(&self, f: &[f64]) -> Vec<f64> {
        let samples = self.rows.len();
        let across = |t: usize| {
            let from =
                |row: usize| Some(self.rows.get(row)?[(t + 1).checked_sub(row)?] * f.get(row)?);
            (t.saturating_sub(1)..=t + 1).filter_map(from).sum()
        };
        let mut s: Vec<f64> = (0..samples).map(across).collect();
        let [one, two] = &self.below;
        for t in 0..samples {
            let known = |k: usize, of: &[f64]| t.checked_sub(k).map_or(0.0, |u| of[u] * s[u]);
            s[t] -= known(1, one) + known(2, two);
        }
        for t in (0..samples).rev() {
            let known = |k: usize, of: &[f64]| s.get(t + k).map_or(0.0, |later| of[t] * later);
            s[t] = s[t] / self.pivots[t] - known(1, one) - known(2, two);
        }
        s
    }
}

/// The rate of a twist (1/s), by the differences that [`Compliance`] has; the twist is constant beyond its ends.
pub(crate) fn rate(x: &[f64], period_s: f64) -> Vec<f64> {
    let last = x.len().saturating_sub(1);
    let at = |t: usize| {
        let (before, after) = (t.saturating_sub(1), (t + 1).min(last));
        (x[after] - x[before]) / (2.0 * period_s)
    };
    (0..x.len()).map(at).collect()
}

/// The second derivative of a twist (1/s²), by the differences that [`Compliance`] has; 0 at its ends.
pub(crate) fn curvature(x: &[f64], period_s: f64) -> Vec<f64> {
    let at = |t: usize| match (t.checked_sub(1), x.get(t + 1)) {
        (Some(before), Some(after)) => (x[before] - 2.0 * x[t] + after) / (period_s * period_s),
        _ => 0.0,
    };
    (0..x.len()).map(at).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    const PERIOD_S: f64 = 0.002;

    /// Of a link of 0.5 kg m² on a spring of 200 N·m/rad, and the twist under a sine of 0.01 rad at
    /// `hz`, over what the torque alone would twist.
    fn grows(hz: f64) -> f64 {
        let samples = 4000;
        let slopes = [vec![0.0; samples], vec![0.0; samples], vec![0.5; samples]];
        let sine = |t: usize| 0.01 * (std::f64::consts::TAU * hz * PERIOD_S * t as f64).sin();
        let f: Vec<f64> = (0..samples).map(sine).collect();
        let s = Compliance::new(1.0 / 200.0, &slopes, PERIOD_S).twist_under(&f);
        let inner = 1000..3000;
        let product = |a: &[f64], b: &[f64]| inner.clone().map(|t| a[t] * b[t]).sum::<f64>();
        product(&s, &f) / product(&f, &f)
    }

    /// `1 / (1 - r)` with `r = (f / 3.183 Hz)²`, and bounded where the link rings.
    #[test]
    fn oracle_a_twist_grows_towards_the_frequency_at_which_its_link_rings() {
        let rings = (200.0_f64 / 0.5).sqrt() / std::f64::consts::TAU;
        for hz in [0.2, 0.5, 1.0, 1.5] {
            let r = (hz / rings).powi(2);
            assert!((grows(hz) * (1.0 - r) - 1.0).abs() < 0.005, "{} at {hz} Hz", grows(hz));
        }
        assert!(grows(rings).abs() < 0.5, "{} where it rings", grows(rings));
        let r = 4.0_f64;
        assert!((grows(2.0 * rings) * (1.0 - r) - 1.0).abs() < 0.1, "{}", grows(2.0 * rings));
    }

    /// A load that only leans on the twist: `(1 + c k) s = f`, to the ends.
    #[test]
    fn a_load_that_grows_with_the_twist_holds_it_back() {
        let slopes = [vec![300.0; 5], vec![0.0; 5], vec![0.0; 5]];
        let compliance = Compliance::new(0.01, &slopes, PERIOD_S);
        assert!(compliance.twist_under(&[4.0; 5]).iter().all(|s| (s - 1.0).abs() < 1e-12));
        assert!(
            Compliance::new(0.01, &[vec![], vec![], vec![]], PERIOD_S).twist_under(&[]).is_empty()
        );
    }
}
