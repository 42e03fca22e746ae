//! Positions in degrees where radians were expected.

use std::f64::consts::{FRAC_PI_2, PI, TAU};

use robot::Joint;

use crate::runs::run::{Channels, range};

/// Radians per degree.
const DEGREE: f64 = PI / 180.0;

/// Largest distance of a jump between two samples from a whole number of turns (rad).
const NEAR_A_TURN: f64 = 0.5;

/// Why the positions of a rotation must be degrees, as the end of `joint j1 ...`;
/// `None` where radians are possible.
///
/// One of three observations is enough:
///
/// ```text
/// limits    |q| > 2 pi, and q exceeds twice the limits in radians but keeps them in degrees
///           (a revolute joint without limits counts as limited to two turns either way);
///           not used where the position jumps by full turns, as a wrapping counter does
/// velocity  the velocity column is pi/180 times the derivative of the position
/// speed     |q| > 4 pi, and most of the motion is above 3 times the highest speed,
///           which it keeps in degrees
/// ```
///
/// A continuous joint that truly turns several times shows none of them.
pub(crate) fn evidence(joint: &Joint, time: &[f64], channels: &Channels) -> Option<String> {
    if !joint.kind.is_rotation() {
        return None;
    }
    let found = farthest(&channels.position).1.abs();
    if found > TAU
        && !jumps_by_turns(&channels.position)
        && let Some(expectation) = beyond_limits(joint, &channels.position)
    {
        return Some(expectation);
    }
    let rate = derivative(time, &channels.position);
    if let Some(expectation) = slow_velocity(channels, &rate) {
        return Some(expectation);
    }
    if found > 2.0 * TAU { beyond_speed(joint, &rate) } else { None }
}

/// Whether a position exceeds twice the limits of a rotation when read as radians, and keeps
/// the limits when read as degrees.
pub(crate) fn beyond_limits(joint: &Joint, position: &[f64]) -> Option<String> {
    let (lower, upper) = match (joint.limits.position, joint.kind) {
        (Some(limits), _) => limits,
        (None, robot::JointKind::Revolute) => (-2.0 * TAU, 2.0 * TAU),
        _ => return None,
    };
    let (low, high) = range(position);
    let reach = lower.abs().max(upper.abs());
    let (span, (low_rad, high_rad)) = (upper - lower, (low * DEGREE, high * DEGREE));
    // Limits are often kept only about: a tenth of the span more is let through.
    let fits = low_rad >= lower - 0.1 * span && high_rad <= upper + 0.1 * span;
    let beyond = low.abs().max(high.abs()) > 2.0 * reach;
    (joint.kind.is_rotation() && beyond && fits)
        .then(|| format!("is limited to {lower} .. {upper} rad"))
}

/// Whether some steps are full turns and no other is a quarter turn.
fn jumps_by_turns(position: &[f64]) -> bool {
    let mut jumps = false;
    for pair in position.windows(2) {
        let step = pair[1] - pair[0];
        let turns = (step / TAU).round();
        if turns.abs() > 0.0 && (step - turns * TAU).abs() < NEAR_A_TURN {
            jumps = true;
        } else if step.abs() >= FRAC_PI_2 {
            return false;
        }
    }
    jumps
}

fn slow_velocity(channels: &Channels, rate: &[f64]) -> Option<String> {
    let velocity = channels.velocity.as_deref()?;
    let (low, high) = range(&channels.position);
    let dot = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(x, y)| x * y).sum::<f64>();
    let (vr, rr, vv) = (dot(velocity, rate), dot(rate, rate), dot(velocity, velocity));
    let alike = vr > 0.9 * (rr * vv).sqrt();
    let scale = vr / rr;
    // Half a degree of motion, and a scale that noise does not make by chance.
    (high - low > 0.5 && alike && (scale / DEGREE - 1.0).abs() < 0.1)
        .then(|| "has a velocity column that is pi/180 times the derivative of this one".to_owned())
}

fn beyond_speed(joint: &Joint, rate: &[f64]) -> Option<String> {
    let limit = joint.limits.velocity.filter(|&v| v > 0.0)?;
    let mut speed: Vec<f64> = rate.iter().map(|r| r.abs()).collect();
    speed.sort_unstable_by(f64::total_cmp);
    // Half of the samples above, and all but the noisiest hundredth within in degrees.
    let middle = speed.get(speed.len() / 2)?;
    let highest = speed.get(speed.len() * 99 / 100)?;
    (*middle > 3.0 * limit && highest * DEGREE <= limit)
        .then(|| format!("is limited to {limit} rad/s and would mostly be above {middle:.1} rad/s"))
}

/// Why the position of a rotation's link must be degrees, where that of its motor is in radians.
pub(crate) fn link_evidence(joint: &Joint, position: &[f64], link: &[f64]) -> Option<String> {
    let middle = |x: &[f64]| x.iter().sum::<f64>() / x.len().max(1) as f64;
    let (a, b) = (middle(position), middle(link));
    let (mut qq, mut ql, mut ll) = (0.0, 0.0, 0.0);
    for (q, l) in position.iter().zip(link) {
        let (q, l) = (q - a, l - b);
        (qq, ql, ll) = (qq + q * q, ql + q * l, ll + l * l);
    }
    let alike = ql > 0.9 * (qq * ll).sqrt();
    (joint.kind.is_rotation() && alike && (ql / qq * DEGREE - 1.0).abs() < 0.1)
        .then(|| "has a position column that is pi/180 times this one".to_owned())
}

/// Index and value of the position farthest from zero; `(0, 0)` for none.
pub(crate) fn farthest(position: &[f64]) -> (usize, f64) {
    let all = position.iter().copied().enumerate();
    all.max_by(|a, b| a.1.abs().total_cmp(&b.1.abs())).unwrap_or((0, 0.0))
}

/// Central differences on the clock of the file, one-sided at the ends.
fn derivative(time: &[f64], x: &[f64]) -> Vec<f64> {
    let last = time.len().saturating_sub(1);
    (0..time.len().min(x.len()))
        .map(|k| {
            let (a, b) = (k.saturating_sub(1), (k + 1).min(last));
            (x[b] - x[a]) / (time[b] - time[a])
        })
        .collect()
}
