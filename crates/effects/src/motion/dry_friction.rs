use robot::Actuator;

/// Torque that dry friction takes from a motor (N·m or N), in the state `q, qd` of the motor,
/// with `direction` of motion in [-1, 1], under the `load` that the joint carries (N·m or N):
///
/// ```text
/// level = coulomb (1 + share cos(periods q + phase)) + excess exp(-(qd / velocity)²)
///         + load_friction |load|
/// level direction
/// ```
///
/// `coulomb` is that of the direction. With presliding, `direction` is the share of the level
/// that the bristles hold.
pub(crate) fn dry_friction(drive: &Actuator, [q, qd]: [f64; 2], direction: f64, load: f64) -> f64 {
    let coulomb = if direction > 0.0 { drive.coulomb_forward } else { drive.coulomb_backward };
    let wave = drive.friction_wave.map_or(0.0, |w| w.share * (w.periods * q + w.phase).cos());
    let excess = drive.stribeck.map_or(0.0, |s| s.excess * (-(qd / s.velocity).powi(2)).exp());
    direction * (coulomb * (1.0 + wave) + excess + drive.load_friction * load.abs())
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
                let plain = dry_friction(&coulomb, [q, 0.1], direction, -8.0);
                assert!((plain - level * direction).abs() < 1e-15);
                let expected = direction * (level * wave + 0.5 / 1.0_f64.exp() + 0.05 * 8.0);
                let found = dry_friction(&all, [q, 0.1], direction, -8.0);
                assert!((found - expected).abs() < 1e-12, "{found}, not {expected}");
            }
        }
    }
}
