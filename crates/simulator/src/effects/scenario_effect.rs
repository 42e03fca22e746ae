use catalogue::EffectKind;
use rand_chacha::ChaCha8Rng;
use robot::Robot;

use crate::effects::mistake::Mistake;
use crate::effects::surroundings::Surroundings;
use crate::effects::truth::Truth;
use crate::mechanics::inject::Inject;

/// An effect as a scenario states it.
pub trait ScenarioEffect: Sized {
    /// Its name.
    const KIND: EffectKind;

    /// Where it acts, and its parameters under the catalogue's names.
    fn truth(&self) -> Truth;

    /// Prepares the effect for a robot. Refuses impossible values and joints or links that the robot
    /// does not have.
    ///
    /// # Errors
    ///
    /// [`Mistake`], the first found.
    fn inject(&self, robot: &Robot) -> Result<Box<dyn Inject>, Mistake>;

    /// Draws an effect whose torque is about `share` of the joint's torque, both as root mean squares,
    /// and grows with `share`. Parameters that do not set the size are random.
    fn draw(at: &Surroundings<'_>, share: f64, random: &mut ChaCha8Rng) -> Self;
}

/// Place of an effect in the chain from command to motion: its hooks run in this order.
///
/// Commands are limited, delayed and lagged before they become torque. An effect that scales friction
/// comes after every friction.
pub(crate) fn chain_rank(kind: EffectKind) -> usize {
    use EffectKind as K;
    match kind {
        K::TorqueSaturation => 0,
        K::ActuatorDelay => 1,
        K::ActuatorLag => 2,
        K::TransmissionRatio => 3,
        K::TorqueRipple => 4,
        K::FrictionTemperatureDrift => 6,
        _ => 5,
    }
}
