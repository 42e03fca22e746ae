/// Polynomials of degree five between knots at which position, velocity and acceleration
/// are given: continuous in all three.
///
/// ```text
/// x(u) = c0 + c1 u + ... + c5 u^5,   u = (t - t0) / h
/// ```
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Knots {
    /// Increasing times (s), the first is 0.
    times: Vec<f64>,
    /// At every time, `[x, x', x'']` of every joint.
    states: Vec<Vec<[f64; 3]>>,
}

/// Peak speed of [`Knots::glide`] in units of distance / duration.
const GLIDE_SPEED: f64 = 1.875;
/// Its peak acceleration in units of distance / duration²: 10 / sqrt(3).
const GLIDE_ACCELERATION: f64 = 5.773_502_691_896_258;
/// Peak acceleration where a stroke begins and ends, in units of speed / blend.
const BLEND_ACCELERATION: f64 = 1.5;

/// How long a glide over `distance` takes that keeps a speed and an acceleration (s).
pub(crate) fn glide_s(distance: f64, speed: f64, acceleration: f64) -> f64 {
    let by_speed = GLIDE_SPEED * distance / speed;
    by_speed.max((GLIDE_ACCELERATION * distance / acceleration).sqrt())
}

/// How long a stroke needs from rest to a speed at an acceleration (s).
pub(crate) fn blend_s(speed: f64, acceleration: f64) -> f64 {
    BLEND_ACCELERATION * speed / acceleration
}

/// The highest speed that a stroke over `distance` reaches at an acceleration.
pub(crate) fn fastest(distance: f64, acceleration: f64) -> f64 {
    (distance * acceleration / BLEND_ACCELERATION).sqrt()
}

impl Knots {
    /// At rest in a posture, for no time yet.
    pub(crate) fn at_rest(posture: Vec<f64>) -> Self {
        let state = posture.into_iter().map(|q| [q, 0.0, 0.0]).collect();
        Self { times: vec![0.0], states: vec![state] }
    }

    /// Knots with all their states; times increase from 0.
    pub(crate) fn new(times: Vec<f64>, states: Vec<Vec<[f64; 3]>>) -> Self {
        Self { times, states }
    }

    /// Time of the last knot (s).
    pub(crate) fn duration_s(&self) -> f64 {
        self.times.last().copied().unwrap_or_default()
    }

    /// Rests for a while (s).
    pub(crate) fn hold(&mut self, duration_s: f64) {
        if let Some(state) = self.states.last().cloned() {
            self.push(duration_s, state);
        }
    }

    /// Moves on to a posture at rest, by `10 u^3 - 15 u^4 + 6 u^5` where it was at rest.
    pub(crate) fn glide(&mut self, to: &[f64], duration_s: f64) {
        self.push(duration_s, to.iter().map(|&q| [q, 0.0, 0.0]).collect());
    }

    /// Moves from rest to rest at constant speed but for `blend_s` at either end, where the
    /// velocity rises by `3 u^2 - 2 u^3`; `duration_s` is at least twice that.
    pub(crate) fn stroke(&mut self, to: &[f64], duration_s: f64, blend_s: f64) {
        let Some(from) = self.states.last().cloned() else { return };
        let cruise = |share: f64| {
            let state = |(from, to): (&[f64; 3], &f64)| {
                let speed = (to - from[0]) / (duration_s - blend_s);
                let near = if share < 0.5 { from[0] } else { *to };
                let past = if share < 0.5 { 0.5 * blend_s } else { -0.5 * blend_s };
                [near + speed * past, speed, 0.0]
            };
            from.iter().zip(to).map(state).collect::<Vec<_>>()
        };
        self.push(blend_s, cruise(0.0));
        self.push(duration_s - 2.0 * blend_s, cruise(1.0));
        self.push(blend_s, to.iter().map(|&q| [q, 0.0, 0.0]).collect());
    }

    fn push(&mut self, after_s: f64, state: Vec<[f64; 3]>) {
        let time = self.duration_s() + after_s;
        if time > self.duration_s() {
            self.times.push(time);
            self.states.push(state);
        }
    }

    pub(crate) fn at(&self, joint: usize, t: f64) -> [f64; 3] {
        let right = self.times.partition_point(|&time| time <= t);
        let right = right.min(self.times.len() - 1);
        let left = right.saturating_sub(1);
        let (from, to) = (self.states[left][joint], self.states[right][joint]);
        quintic(from, to, self.times[right] - self.times[left], t - self.times[left])
    }

    /// Every knot and `per_piece - 1` times evenly between it and the next.
    pub(crate) fn instants(&self, per_piece: usize) -> impl Iterator<Item = f64> {
        let piece = move |pair: &[f64]| {
            let (start, step) = (pair[0], (pair[1] - pair[0]) / per_piece as f64);
            (0..per_piece).map(move |k| start + step * k as f64)
        };
        self.times.windows(2).flat_map(piece).chain(self.times.last().copied())
    }
}

/// The polynomial of degree five between two states `h` seconds apart, `t` seconds after
/// the first.
fn quintic([q0, v0, a0]: [f64; 3], [q1, v1, a1]: [f64; 3], h: f64, t: f64) -> [f64; 3] {
    if h <= 0.0 {
        return [q0, v0, a0];
    }
    let (u, distance) = (t / h, q1 - q0);
    // Velocities and accelerations in units of u.
    let (v0, v1, a0, a1) = (h * v0, h * v1, h * h * a0, h * h * a1);
    let c2 = 0.5 * a0;
    let c3 = 10.0 * distance - 6.0 * v0 - 4.0 * v1 - 1.5 * a0 + 0.5 * a1;
    let c4 = -15.0 * distance + 8.0 * v0 + 7.0 * v1 + 1.5 * a0 - a1;
    let c5 = 6.0 * distance - 3.0 * (v0 + v1) - 0.5 * (a0 - a1);
    [
        q0 + u * (v0 + u * (c2 + u * (c3 + u * (c4 + u * c5)))),
        (v0 + u * (2.0 * c2 + u * (3.0 * c3 + u * (4.0 * c4 + u * 5.0 * c5)))) / h,
        (2.0 * c2 + u * (6.0 * c3 + u * (12.0 * c4 + u * 20.0 * c5))) / (h * h),
    ]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn between_knots_of_a_quintic_stands_the_quintic() {
        // x = t^5 - 2 t^3 + t
        let state = |t: f64| {
            [t.powi(5) - 2.0 * t.powi(3) + t, 5.0 * t.powi(4) - 6.0 * t * t + 1.0, {
                20.0 * t.powi(3) - 12.0 * t
            }]
        };
        let times = vec![0.0, 0.4, 1.3];
        let knots = Knots::new(times.clone(), times.iter().map(|&t| vec![state(t)]).collect());
        for t in [0.0, 0.1, 0.4, 0.9, 1.3] {
            for (found, expected) in knots.at(0, t).into_iter().zip(state(t)) {
                assert!((found - expected).abs() < 1e-13, "{found} {expected} at {t}");
            }
        }
    }

    #[test]
    fn a_glide_peaks_where_its_duration_says() {
        let mut knots = Knots::at_rest(vec![0.0]);
        let duration = glide_s(2.0, 1.0, 1e9);
        knots.glide(&[2.0], duration);
        assert!((knots.at(0, 0.5 * duration)[1] - 1.0).abs() < 1e-12);
        let mut knots = Knots::at_rest(vec![0.0]);
        let duration = glide_s(2.0, 1e9, 1.0);
        knots.glide(&[2.0], duration);
        let peak = duration * (0.5 - 3_f64.sqrt() / 6.0);
        assert!((knots.at(0, peak)[2] - 1.0).abs() < 1e-12);
    }

    #[test]
    fn a_stroke_has_constant_speed_between_its_blends() {
        let mut knots = Knots::at_rest(vec![1.0, -0.5]);
        knots.stroke(&[0.0, 1.0], 3.0, 1.0);
        for t in [1.0, 1.4, 2.0] {
            let close = |found: f64, expected: f64| assert!((found - expected).abs() < 1e-14);
            close(knots.at(0, t)[1], -0.5);
            close(knots.at(1, t)[1], 0.75);
            close(knots.at(0, t)[2], 0.0);
        }
        let blend = blend_s(0.75, 1.125);
        assert!((knots.at(1, 0.5)[2] - 1.125).abs() < 1e-14 && (blend - 1.0).abs() < 1e-14);
        assert!(
            (knots.at(1, 3.0)[0] - 1.0).abs() < 1e-15 && (knots.duration_s() - 3.0).abs() < 1e-15
        );
    }
}
