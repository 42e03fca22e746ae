use robot::Actuator;

/// Torque that dry friction takes from a motor (N·m or N), in the state `q, qd` of the motor, with `direction` of motion in
/// [-1, 1] and a share `skewed` of half the difference of its levels, under the `load` that the joint carries (N·m or N):
///
/// ```text
/// level = coulomb (1 + share cos(periods q + phase)) + excess exp(-(qd / velocity)²)
///         + load_friction |load|
/// level direction + skewed skew (1 + share cos(periods q + phase))
/// coulomb = (forward + backward) / 2,   skew = (forward - backward) / 2
/// ```
///
/// In motion `skewed` is one. With presliding `direction` is the share of the level that the bristles hold.
pub(crate) fn dry_friction(
    drive: &Actuator,
    [q, qd]: [f64; 2],
    [direction, skewed]: [f64; 2],
    load: f64,
) -> f64 {
    let [coulomb, skew] = mean_and_skew(drive);
    let wave = drive.friction_wave.map_or(0.0, |w| w.share * (w.periods * q + w.phase).cos());
    let excess = drive.stribeck.map_or(0.0, |s| s.excess * (-(qd / s.velocity).powi(2)).exp());
    let level = coulomb * (1.0 + wave) + excess + drive.load_friction * load.abs();
    direction * level + skewed * skew * (1.0 + wave)
}

/// The mean of the two levels of Coulomb friction of a drive, and half their difference (N·m or N).
pub(crate) fn mean_and_skew(drive: &Actuator) -> [f64; 2] {
    let (forward, backward) = (drive.coulomb_forward, drive.coulomb_backward);
    [0.5 * (forward + backward), 0.5 * (forward - backward)]
}

/// A direction along a log, and the share of half the difference of its levels that a drive has there, as [`dry_friction`]
/// takes them.
///
/// A direction between -1 and 1 is the mean over a reversal whose instant is unknown: the friction is the forward level for
/// a part of the time and the backward level for the rest, so that half their difference is there throughout. Bristles
/// without tension hold nothing.
pub(crate) fn along_a_log(drive: &Actuator, direction: f64) -> [f64; 2] {
    [direction, if drive.presliding.is_some() { direction.abs() } else { 1.0 }]
}

#[cfg(test)]
mod tests {
    use robot::{FrictionWave, Stribeck};

    use super::*;

    #[test]
    fn dry_friction_is_the_sum_of_its_parts_in_the_direction_of_motion() {
        let coulomb =
            Actuator { coulomb_forward: 0.6, coulomb_backward: 0.4, ..Actuator::default() };
        let all = Actuator {
            stribeck: Some(Stribeck { excess: 0.5, velocity: 0.1 }),
            load_friction: 0.05,
            friction_wave: Some(FrictionWave { share: 0.25, periods: 4.0, phase: 1.0 }),
            ..coulomb.clone()
        };
        // At the Stribeck velocity, on the top of the wave and half a period on.
        let (top, half) = (-0.25, std::f64::consts::PI / 4.0);
        for (q, wave) in [(top, 1.25), (top + half, 0.75)] {
            for (direction, level) in [(1.0, 0.6), (0.5, 0.6), (-1.0, 0.4), (0.0, 0.0)] {
                let plain = dry_friction(&coulomb, [q, 0.1], [direction, direction.abs()], -8.0);
                assert!((plain - level * direction).abs() < 1e-15);
                let expected = direction * (level * wave + 0.5 / 1.0_f64.exp() + 0.05 * 8.0);
                let found = dry_friction(&all, [q, 0.1], [direction, direction.abs()], -8.0);
                assert!((found - expected).abs() < 1e-12, "{found}, not {expected}");
            }
        }
    }
}
