use nalgebra::{Matrix2, Vector2};

/// The smoothest curve through points: of all that have the given velocity and
/// acceleration at the ends, the one with the least integral of squared jerk.
///
/// It is a polynomial of degree five between the points, continuous up to the fourth
/// derivative. Returns `[x, x', x'']` at every point. The unknown velocities and
/// accelerations `y_i = (x'_i, x''_i)` solve, with `l` and `r` the time to the point before
/// and behind,
///
/// ```text
/// A_i y_(i-1) + B_i y_i + A_(i+1)^T y_(i+1) = d_i
///       | 168/l^3   24/l^2 |         | 192 (1/l^3 + 1/r^3)   36 (1/r^2 - 1/l^2) |
/// A_i = | -24/l^2   -3/l   |   B_i = | 36 (1/r^2 - 1/l^2)    9 (1/l + 1/r)      |
/// d_i = (360 (D_l/l^4 + D_r/r^4),  60 (D_r/r^3 - D_l/l^3)),   D the steps of x
/// ```
///
/// which is the derivative of that integral: symmetric, positive definite, and solved by
/// elimination from the first block to the last.
///
/// `times` increase and have one entry per point; `ends` are `[x', x'']` at both ends.
pub(crate) fn smoothest(times: &[f64], x: &[f64], ends: [[f64; 2]; 2]) -> Vec<[f64; 3]> {
    let last = x.len().saturating_sub(1);
    let mut y = vec![Vector2::zeros(); x.len()];
    if let Some(end) = y.first_mut() {
        *end = Vector2::from(ends[0]);
    }
    if let Some(end) = y.last_mut() {
        *end = Vector2::from(ends[1]);
    }

    // Forward: y_i = rest_i - gain_i y_(i+1).
    let (mut gain, mut rest) = (Matrix2::zeros(), y.first().copied().unwrap_or_default());
    let mut eliminated = Vec::with_capacity(x.len());
    for i in 1..last {
        let (l, r) = (times[i] - times[i - 1], times[i + 1] - times[i]);
        let a = coupling(l);
        let pivot = diagonal(l, r) - a * gain;
        let d = right_side([x[i] - x[i - 1], x[i + 1] - x[i]], l, r) - a * rest;
        let inverse = pivot.try_inverse().unwrap_or_default();
        (gain, rest) = (inverse * coupling(r).transpose(), inverse * d);
        eliminated.push((gain, rest));
    }

    // Backward.
    for i in (1..last).rev() {
        let (gain, rest) = eliminated[i - 1];
        y[i] = rest - gain * y[i + 1];
    }
    x.iter().zip(&y).map(|(&x, y)| [x, y[0], y[1]]).collect()
}

fn coupling(h: f64) -> Matrix2<f64> {
    Matrix2::new(168.0 / h.powi(3), 24.0 / h.powi(2), -24.0 / h.powi(2), -3.0 / h)
}

fn diagonal(l: f64, r: f64) -> Matrix2<f64> {
    let mixed = 36.0 * (r.powi(-2) - l.powi(-2));
    Matrix2::new(192.0 * (l.powi(-3) + r.powi(-3)), mixed, mixed, 9.0 * (1.0 / l + 1.0 / r))
}

fn right_side([before, behind]: [f64; 2], l: f64, r: f64) -> Vector2<f64> {
    Vector2::new(
        360.0 * (before / l.powi(4) + behind / r.powi(4)),
        60.0 * (behind / r.powi(3) - before / l.powi(3)),
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn through_points_of_a_quintic_the_smoothest_curve_is_the_quintic() {
        let state = |t: f64| {
            [t.powi(5) - t.powi(4) + 0.5 * t, 5.0 * t.powi(4) - 4.0 * t.powi(3) + 0.5, {
                20.0 * t.powi(3) - 12.0 * t * t
            }]
        };
        let times = [0.0, 0.2, 0.7, 1.0, 1.1, 1.6];
        let x = times.map(|t| state(t)[0]);
        let ends = [times[0], times[5]].map(|t| [state(t)[1], state(t)[2]]);
        for (t, found) in times.into_iter().zip(smoothest(&times, &x, ends)) {
            for (found, expected) in found.into_iter().zip(state(t)) {
                assert!((found - expected).abs() < 1e-11, "{found} {expected} at {t}");
            }
        }
    }

    #[test]
    fn a_long_fine_sine_is_followed_in_velocity_and_acceleration() {
        let times: Vec<f64> = (0..20_001).map(|k| 1e-3 * f64::from(k)).collect();
        let x: Vec<f64> = times.iter().map(|t| (3.0 * t).sin()).collect();
        let end = |t: f64| [3.0 * (3.0 * t).cos(), -9.0 * (3.0 * t).sin()];
        for (t, found) in times.iter().zip(smoothest(&times, &x, [end(0.0), end(20.0)])) {
            let [v, a] = end(*t);
            assert!((found[1] - v).abs() < 1e-9 && (found[2] - a).abs() < 1e-6, "{found:?} {t}");
        }
    }

    #[test]
    fn two_points_or_one_or_none_have_only_their_ends() {
        let ends = [[1.0, 2.0], [3.0, 4.0]];
        assert_eq!(smoothest(&[0.0, 1.0], &[5.0, 6.0], ends), [[5.0, 1.0, 2.0], [6.0, 3.0, 4.0]]);
        assert!(smoothest(&[], &[], ends).is_empty());
        assert_eq!(smoothest(&[0.0], &[5.0], ends).len(), 1);
    }
}
