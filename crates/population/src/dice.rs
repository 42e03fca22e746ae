//! Draws from a seeded generator.

use nalgebra::{Rotation3, Unit, Vector3};
use rand::RngExt;
use rand_chacha::ChaCha8Rng;

/// Uniform between two numbers.
pub(crate) fn between(random: &mut ChaCha8Rng, [low, high]: [f64; 2]) -> f64 {
    low + (high - low) * random.random::<f64>()
}

/// Uniform in the logarithm between two positive numbers.
pub(crate) fn log_uniform_between(random: &mut ChaCha8Rng, [low, high]: [f64; 2]) -> f64 {
    low * (high / low).powf(random.random::<f64>())
}

/// Whether something happens that does so with this probability.
pub(crate) fn happens(random: &mut ChaCha8Rng, probability: f64) -> bool {
    random.random::<f64>() < probability
}

/// One of some, each as likely.
pub(crate) fn one_of<T: Copy, const N: usize>(random: &mut ChaCha8Rng, from: [T; N]) -> T {
    from[random.random_range(0..N)]
}

/// An index, as likely as its weight says.
pub(crate) fn weighted_index(random: &mut ChaCha8Rng, weights: &[f64]) -> usize {
    let mut left = random.random::<f64>() * weights.iter().sum::<f64>();
    for (index, weight) in weights.iter().enumerate() {
        left -= weight;
        if left < 0.0 {
            return index;
        }
    }
    weights.len().saturating_sub(1)
}

/// A direction, each as likely.
pub(crate) fn direction(random: &mut ChaCha8Rng) -> Unit<Vector3<f64>> {
    let z = between(random, [-1.0, 1.0]);
    let (sin, cos) = between(random, [0.0, std::f64::consts::TAU]).sin_cos();
    let r = (1.0 - z * z).max(0.0).sqrt();
    Unit::new_normalize(Vector3::new(r * cos, r * sin, z))
}

/// A rotation by at most `largest` (rad) about any axis.
pub(crate) fn small_rotation(random: &mut ChaCha8Rng, largest: f64) -> Rotation3<f64> {
    let axis = direction(random);
    Rotation3::from_axis_angle(&axis, between(random, [-largest, largest]))
}

/// A number to so many significant digits, as data sheets have them.
pub(crate) fn round_to_digits(value: f64, digits: usize) -> f64 {
    format!("{value:.*e}", digits.saturating_sub(1)).parse().unwrap_or(value)
}
