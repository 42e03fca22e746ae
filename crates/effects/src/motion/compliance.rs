use robot::Actuator;

/// The spring between the motor and the link of a joint.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Spring {
    /// Twist per unit of load (rad/(N m) or m/N).
    pub compliance: f64,
    /// Damping over stiffness (s); `None` where the damping is unknown.
    pub damping_s: Option<f64>,
}

impl Spring {
    /// The spring of a drive; `None` for a rigid one.
    pub fn of(drive: &Actuator) -> Option<Self> {
        let compliance = drive.elasticity?.recip();
        Some(Self { compliance, damping_s: drive.elasticity_damping.map(|d| d * compliance) })
    }
}

/// Twist of the transmission of one joint under a torque, while its motor keeps to its motion.
///
/// With a compliance `c` the twist `s = theta - q` changes the load that makes it:
///
/// ```text
/// D s = f,   D = 1 + damping_s d/dt + c (dload/dq + dload/dqd d/dt) + E,   E = c dload/dqdd d²/dt²
/// ```
///
/// Far below the resonance of the link on its spring `s = f`. A spring of known damping is followed forward in time, on
/// both sides of the resonance. Close to the resonance of one of unknown damping the twist would grow without bounds, so
/// `s` minimises `|D s - f|² + RESISTANCE² |E s|²`, which leaves slow twists as they are.
#[derive(Debug, Clone)]
pub(crate) struct Compliance {
    /// `D`, row by row: factors of the twist one sample before, at the sample and one sample after.
    rows: Vec<[f64; 3]>,
    solution: Solution,
}

/// How the twist follows from `D`.
#[derive(Debug, Clone)]
enum Solution {
    /// From the twist of the first two samples, sample by sample.
    Forward,
    /// At once, from `D'D + RESISTANCE² E'E`, diagonal and the two below, as `L diag(d) L'`.
    Bounded { pivots: Vec<f64>, below: [Vec<f64>; 2] },
}

/// Weight that bounds the twist: close to the resonance of the link the twist grows to about half the inverse of this
/// weight, and at the resonance it vanishes.
const RESISTANCE: f64 = 0.2;

/// Least `c dload/dqdd / period²` of a spring that is followed forward in time (1). Below a quarter the differences have no
/// stable solution; at four, a thirteenth of the rate, they err by 1 per cent in the resonance.
const LEAST_SWING: f64 = 4.0;

/// Least pivot, for a load that falls with the twist as fast as the spring torque grows.
const LEAST: f64 = 1e-6;

impl Compliance {
    /// From the derivatives of the load by position, velocity and acceleration, every `period_s`.
    pub fn new(spring: Spring, slopes: &[Vec<f64>; 3], period_s: f64) -> Self {
        let Spring { compliance, damping_s } = spring;
        let own = damping_s.unwrap_or(0.0);
        let [dq, dqd, dqdd] = slopes;
        let samples = dq.len();
        let inner = |t: usize| t > 0 && t + 1 < samples;
        let swing = |t: usize| {
            let along = if inner(t) { compliance * dqdd[t] / (period_s * period_s) } else { 0.0 };
            [along, -2.0 * along, along]
        };
        let row = |t: usize| {
            let drag = if inner(t) { own + compliance * dqd[t] } else { 0.0 } / (2.0 * period_s);
            let [before, here, after] = swing(t);
            [before - drag, 1.0 + compliance * dq[t] + here, after + drag]
        };
        let rows: Vec<[f64; 3]> = (0..samples).map(row).collect();
        let least = dqdd.iter().fold(f64::INFINITY, |least: f64, m| least.min(*m));
        if damping_s.is_some() && compliance * least > LEAST_SWING * period_s * period_s {
            return Self { rows, solution: Solution::Forward };
        }
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
        let solution = Solution::factorise(samples, matrix);
        Self { rows, solution }
    }

    /// Whether the twist is followed forward in time, from the first sample of `f`.
    pub fn is_forward(&self) -> bool {
        matches!(self.solution, Solution::Forward)
    }

    /// The twist, where the torque alone would twist by `f`. Forward in time, the first value of `f` is the twist at the
    /// begin, where motor and link move alike.
    pub fn twist_under(&self, f: &[f64]) -> Vec<f64> {
        match &self.solution {
            Solution::Forward => self.follow([f.first().copied().unwrap_or(0.0); 2], f),
            Solution::Bounded { pivots, below } => self.solve(f, pivots, below),
        }
    }

    /// The twists of a link that swings on its spring from a twist of one, and from a twist of one in the second sample;
    /// `None` where the twist is not followed in time.
    pub fn swings(&self) -> Option<[Vec<f64>; 2]> {
        let still = vec![0.0; self.rows.len()];
        self.is_forward().then(|| [[1.0, 1.0], [0.0, 1.0]].map(|begin| self.follow(begin, &still)))
    }

    /// The twist from those of the first two samples.
    fn follow(&self, begin: [f64; 2], f: &[f64]) -> Vec<f64> {
        let mut s = Vec::with_capacity(f.len());
        s.extend(begin.into_iter().take(f.len()));
        for (t, [before, here, after]) in self.rows.iter().enumerate().skip(1) {
            if t + 1 < f.len() {
                s.push((f[t] - here * s[t] - before * s[t - 1]) / after);
            }
        }
        s
    }
    fn solve(&self, f: &[f64], pivots: &[f64], below: &[Vec<f64>; 2]) -> Vec<f64> {
        let samples = self.rows.len();
        let across = |t: usize| {
            let from =
                |row: usize| Some(self.rows.get(row)?[(t + 1).checked_sub(row)?] * f.get(row)?);
            (t.saturating_sub(1)..=t + 1).filter_map(from).sum()
        };
        let mut s: Vec<f64> = (0..samples).map(across).collect();
        let [one, two] = below;
        for t in 0..samples {
            let known = |k: usize, of: &[f64]| t.checked_sub(k).map_or(0.0, |u| of[u] * s[u]);
            s[t] -= known(1, one) + known(2, two);
        }
        for t in (0..samples).rev() {
            let known = |k: usize, of: &[f64]| s.get(t + k).map_or(0.0, |later| of[t] * later);
            s[t] = s[t] / pivots[t] - known(1, one) - known(2, two);
        }
        s
    }
}

impl Solution {
    /// From the entries of a symmetric matrix, by column and distance below the diagonal.
    fn factorise(samples: usize, matrix: impl Fn(usize, usize) -> f64) -> Self {
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
        Self::Bounded { pivots, below }
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

    fn undamped(compliance: f64) -> Spring {
        Spring { compliance, damping_s: None }
    }

    /// Of a link of 0.5 kg m² on a spring of 200 N·m/rad, and the twist under a sine of 0.01 rad at
    /// `hz`, over what the torque alone would twist.
    fn grows(hz: f64) -> f64 {
        let samples = 4000;
        let slopes = [vec![0.0; samples], vec![0.0; samples], vec![0.5; samples]];
        let sine = |t: usize| 0.01 * (std::f64::consts::TAU * hz * PERIOD_S * t as f64).sin();
        let f: Vec<f64> = (0..samples).map(sine).collect();
        let s = Compliance::new(undamped(1.0 / 200.0), &slopes, PERIOD_S).twist_under(&f);
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

    /// `s = f / (1 - r² + i r w damping_s)` with `r = w / w_resonance`, once the swing from the begin is gone.
    #[test]
    fn oracle_a_damped_spring_is_followed_through_its_resonance() {
        let (samples, damping_s, rings) = (4000, 0.01, 20.0);
        let slopes = [vec![0.0; samples], vec![0.0; samples], vec![0.5; samples]];
        let spring = Spring { compliance: 1.0 / 200.0, damping_s: Some(damping_s) };
        let compliance = Compliance::new(spring, &slopes, PERIOD_S);
        assert!(compliance.is_forward());
        for r in [0.5, 1.0, 2.0] {
            let w = r * rings;
            let f: Vec<f64> = (0..samples).map(|t| (w * PERIOD_S * t as f64).cos()).collect();
            let s = compliance.twist_under(&f);
            let [along, late] = [1.0 - r * r, w * damping_s];
            for (t, s) in s.iter().enumerate().skip(3000) {
                let phase = w * PERIOD_S * t as f64;
                let expected =
                    (along * phase.cos() + late * phase.sin()) / along.hypot(late).powi(2);
                assert!(
                    (s - expected).abs() < 0.02 / along.hypot(late),
                    "{s}, not {expected}, r {r}"
                );
            }
        }
    }

    /// A load that only leans on the twist: `(1 + c k) s = f`, to the ends.
    #[test]
    fn a_load_that_grows_with_the_twist_holds_it_back() {
        let slopes = [vec![300.0; 5], vec![0.0; 5], vec![0.0; 5]];
        let compliance = Compliance::new(undamped(0.01), &slopes, PERIOD_S);
        assert!(compliance.twist_under(&[4.0; 5]).iter().all(|s| (s - 1.0).abs() < 1e-12));
        assert!(
            Compliance::new(undamped(0.01), &[vec![], vec![], vec![]], PERIOD_S)
                .twist_under(&[])
                .is_empty()
        );
    }
}
