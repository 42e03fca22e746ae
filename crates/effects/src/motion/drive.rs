use robot::{Actuator, Warming};

use crate::motion::dry_friction::dry_friction;

/// Torque that a joint's drive needs beside the rigid bodies (N·m or N), in the state
/// `q, qd, qdd`, with `direction` of motion in [-1, 1] and `tau_rb` the rigid bodies' torque:
///
/// ```text
/// load = tau_rb + stiffness x + cubic x³ + hysteresis direction + counterbalance(q),   x = q - rest
/// load - tau_rb + rotor_inertia qdd + viscous qd + dry friction(q, qd, direction, load) + ripple(q)
/// ```
///
/// The friction is that of a warm drive, without the damping of bristles, which depends on the motion before.
pub fn drive_torque(drive: &Actuator, state: [f64; 3], direction: f64, tau_rb: f64) -> f64 {
    let spring = spring_torque(drive, state[0]) + drive.spring_hysteresis * direction;
    spring + motor_torque(drive, state, [direction, direction.abs()], tau_rb + spring, 1.0)
}

/// Warm-up of a drive after `time` time constants: `1 - exp(-time)`.
pub(crate) fn warmth(time: f64) -> f64 {
    -(-time.max(0.0)).exp_m1()
}

/// The part of the drive's torque that acts at the motor (N·m or N), under the `load` of its transmission, with the
/// warm-up `warmth` of the drive in [0, 1] and without the damping of its bristles.
pub(crate) fn motor_torque(
    drive: &Actuator,
    [q, qd, qdd]: [f64; 3],
    direction: [f64; 2],
    load: f64,
    warmth: f64,
) -> f64 {
    let ripple = drive.ripple.map_or(0.0, |r| r.amplitude * (r.periods * q + r.phase).sin());
    let friction = drive.viscous * qd + dry_friction(drive, [q, qd], direction, load);
    let lost = |w: Warming| warmth * (w.viscous_lost * qd + w.coulomb_lost * direction[0]);
    let friction = friction - drive.warming.map_or(0.0, lost);
    drive.rotor_inertia * qdd + friction + ripple
}

/// The torque of a joint's spring without its loop and of its counterbalance (N·m or N):
///
/// ```text
/// stiffness x + cubic x³ + amplitude sin(q + phase),   x = q - rest
/// ```
pub(crate) fn spring_torque(drive: &Actuator, q: f64) -> f64 {
    let x = q - drive.spring_rest;
    let balance = drive.counterbalance.map_or(0.0, |c| c.amplitude * (q + c.phase).sin());
    drive.spring_stiffness * x + drive.spring_cubic * x.powi(3) + balance
}

/// Its derivative by the position (N·m/rad or N/m).
pub(crate) fn spring_slope(drive: &Actuator, q: f64) -> f64 {
    let x = q - drive.spring_rest;
    let balance = drive.counterbalance.map_or(0.0, |c| c.amplitude * (q + c.phase).cos());
    drive.spring_stiffness + 3.0 * drive.spring_cubic * x * x + balance
}

/// Bristles along a motion.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Bristles {
    /// The share `s` of dry friction that they hold, in [-1, 1].
    pub held: Vec<f64>,
    /// The speed `way ds/dt = qd - |qd| s` at which they bend (rad or m a sample).
    pub bending: Vec<f64>,
}

/// The bristles of a joint that follows `q`:
///
/// ```text
/// ds = (dq - |dq| s) / way
/// ```
///
/// The solution is exact for a position that is linear between samples. They bend for moments shorter than a sample, so
/// both signals are means from half a sample before to half a sample after. They start without tension.
pub(crate) fn bristles(q: &[f64], way: f64) -> Bristles {
    let mut s = 0.0;
    // The mean of s over a way, at whose end s stands.
    let mut pull = |moved: f64| {
        let (end, ways) = (if moved < 0.0 { -1.0 } else { 1.0 }, moved.abs() / way);
        let beside = s - end;
        s = end + beside * (-ways).exp();
        let mean = end + beside * if ways > 0.0 { -(-ways).exp_m1() / ways } else { 1.0 };
        (mean, s)
    };
    let moved = |t: usize| q.get(t).zip(q.get(t + 1)).map(|(from, to)| to - from);
    let mut before = 0.0;
    let sample = |t: usize| {
        let halves = [t.checked_sub(1).and_then(moved), moved(t)].into_iter().flatten();
        let (mut sum, mut after, mut count) = (0.0, before, 0.0);
        for half in halves {
            let (mean, end) = pull(0.5 * half);
            (sum, after, count) = (sum + mean, end, count + 1.0);
        }
        let bent = way * (after - std::mem::replace(&mut before, after));
        match count > 0.0 {
            true => (sum / count, 2.0 * bent / count),
            false => (after, 0.0),
        }
    };
    let (held, bending) = (0..q.len()).map(sample).unzip();
    Bristles { held, bending }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// `[held, bending]` of samples between which the joint goes over lines, by 10,000 explicit steps a sample.
    fn by_small_steps(q: &[f64], way: f64) -> Vec<[f64; 2]> {
        const STEPS: usize = 10_000;
        let mut s = 0.0;
        let mut along = Vec::new();
        for pair in q.windows(2) {
            let dq = (pair[1] - pair[0]) / STEPS as f64;
            for _ in 0..STEPS {
                along.push(s);
                s += (dq - dq.abs() * s) / way;
            }
        }
        let inner = 1..q.len() - 1;
        inner
            .map(|t| {
                let around = &along[t * STEPS - STEPS / 2..=t * STEPS + STEPS / 2];
                let mean = around.iter().sum::<f64>() / around.len() as f64;
                [mean, way * (around[STEPS] - around[0])]
            })
            .collect()
    }

    #[test]
    fn bristles_that_bend_within_a_sample_have_their_whole_way() {
        let way = 0.01;
        let q: Vec<f64> = (0..60).map(|t| 0.2 * (0.21 * f64::from(t)).cos()).collect();
        let Bristles { held, bending } = bristles(&q, way);
        for (t, [share, bent]) in by_small_steps(&q, way).into_iter().enumerate() {
            let found = [held[t + 1], bending[t + 1]];
            assert!((found[0] - share).abs() < 1e-3, "{t}: {found:?}, not {share}");
            assert!((found[1] - bent).abs() < 1e-3 * way, "{t}: {found:?}, not {bent}");
        }
        // Down from no tension, and three turns, each of which bends them over twice their way.
        let turns: f64 = bending.iter().map(|bent| bent.abs()).sum();
        assert!((turns / way - 7.0).abs() < 0.2, "{}", turns / way);
    }

    #[test]
    fn bristles_start_without_tension() {
        let moving: Vec<f64> = (0..9).map(|t| -0.01 * f64::from(t)).collect();
        let Bristles { held, .. } = bristles(&moving, 0.01);
        // The mean of exp(-x) - 1 over half a way, and the end.
        let first = 2.0 * (1.0 - (-0.5_f64).exp()) - 1.0;
        assert!((held[0] - first).abs() < 1e-9, "{held:?}");
        assert!((held[8] + 1.0).abs() < 1e-3, "{held:?}");
        assert_eq!(bristles(&[0.3; 3], 0.01).held, [0.0; 3]);
        assert_eq!(bristles(&[0.3], 0.01), Bristles { held: vec![0.0], bending: vec![0.0] });
        assert_eq!(bristles(&[], 0.01), Bristles { held: Vec::new(), bending: Vec::new() });
    }
}
