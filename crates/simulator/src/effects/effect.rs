use catalogue::EffectKind;
use rand_chacha::ChaCha8Rng;
use robot::Robot;

use crate::effects::mistake::Mistake;
use crate::effects::surroundings::Surroundings;
use crate::effects::truth::Truth;
use crate::mechanics::inject::Inject;

/// An effect as a scenario states it.
pub trait Effect: Sized {
    /// Its name.
    const KIND: EffectKind;

    /// Where it acts, and its parameters under the catalogue's names.
    fn truth(&self) -> Truth;

    /// The effect ready to act on a robot. Refuses what no arm has; the joints and links named
    /// must be the robot's.
    ///
    /// # Errors
    ///
    /// [`Mistake`], the first found.
    fn inject(&self, robot: &Robot) -> Result<Box<dyn Inject>, Mistake>;

    /// An effect whose torque has about `share` of the joint's torque root mean square, and more
    /// the larger `share` is; what does not set the size is drawn.
    fn draw(at: &Surroundings<'_>, share: f64, random: &mut ChaCha8Rng) -> Self;
}

/// Place of an effect in the chain from command to motion: its hooks run in this order.
///
/// Commands are limited, held back and lagged before they become torque; what scales friction
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
