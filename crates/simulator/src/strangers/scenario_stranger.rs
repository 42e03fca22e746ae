use rand_chacha::ChaCha8Rng;
use robot::Robot;

use crate::effects::mistake::Mistake;
use crate::effects::surroundings::Surroundings;
use crate::mechanics::inject::Inject;
use crate::strangers::kind::StrangerKind;
use crate::strangers::truth::StrangerTruth;

/// Largest natural frequency of a drawn spring on its joint's inertia (rad/s), which steps of up to
/// 2 ms resolve.
const LARGEST_RING: f64 = 100.0;

/// An effect of no catalogue as a scenario states it.
pub trait ScenarioStranger: Sized {
    /// Its name.
    const KIND: StrangerKind;

    /// Where it acts, and its parameters (SI).
    fn truth(&self) -> StrangerTruth;

    /// Prepares the stranger for a robot. Refuses impossible values and joints that the robot does not
    /// have.
    ///
    /// # Errors
    ///
    /// [`Mistake`], the first found.
    fn inject(&self, robot: &Robot) -> Result<Box<dyn Inject>, Mistake>;

    /// Draws a stranger whose torque is about `share` of the joint's torque, both as root mean squares,
    /// and grows with `share`. Parameters that do not set the size are random.
    fn draw(at: &Surroundings<'_>, share: f64, random: &mut ChaCha8Rng) -> Self;
}

/// Stiffest spring that is drawn for a joint (N m/rad or N/m).
pub(crate) fn stiffest(at: &Surroundings<'_>) -> f64 {
    (LARGEST_RING * LARGEST_RING * at.inertia).min(1e5)
}

/// Length of a joint's range (rad or m), above zero.
pub(crate) fn span(at: &Surroundings<'_>) -> f64 {
    (at.range.1 - at.range.0).max(1e-3)
}
