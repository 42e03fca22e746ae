//! Effects of no catalogue, one file each: what a workshop has and a diagnosis has no name for.

pub(crate) mod drive_dead_zone;
pub(crate) mod eccentric_encoder;
pub(crate) mod integrator_windup;
pub(crate) mod kind;
pub(crate) mod magnet_well;
pub(crate) mod snag;
pub(crate) mod soft_mount;
pub(crate) mod soft_wall;
pub(crate) mod spec;
pub(crate) mod speed_crosstalk;
pub(crate) mod square_drag;
pub(crate) mod tilting_bearing;
pub(crate) mod torque_dropout;
pub(crate) mod torque_rate_limit;
pub(crate) mod truth;

use rand_chacha::ChaCha8Rng;
use robot::Robot;

pub use drive_dead_zone::DriveDeadZone;
pub use eccentric_encoder::EccentricEncoder;
pub use integrator_windup::IntegratorWindup;
pub use kind::StrangerKind;
pub use magnet_well::MagnetWell;
pub use snag::Snag;
pub use soft_mount::SoftMount;
pub use soft_wall::{Side, SoftWall};
pub use spec::StrangerSpec;
pub use speed_crosstalk::SpeedCrosstalk;
pub use square_drag::SquareDrag;
pub use tilting_bearing::TiltingBearing;
pub use torque_dropout::TorqueDropout;
pub use torque_rate_limit::TorqueRateLimit;
pub use truth::StrangerTruth;

use crate::effects::{Mistake, Surroundings, joint_of, within};
use crate::inject::Inject;

/// Largest angular frequency at which a drawn spring rings on what its joint turns (rad/s), so
/// that steps of up to 2 ms do.
const LARGEST_RING: f64 = 100.0;

/// An effect of no catalogue as a scenario states it.
pub trait Stranger: Sized {
    /// Its name.
    const KIND: StrangerKind;

    /// Where it acts, and its parameters (SI).
    fn truth(&self) -> StrangerTruth;

    /// The stranger ready to act on a robot. Refuses what no arm has; the joints named must be
    /// the robot's.
    ///
    /// # Errors
    ///
    /// [`Mistake`], the first found.
    fn inject(&self, robot: &Robot) -> Result<Box<dyn Inject>, Mistake>;

    /// A stranger whose torque has about `share` of the joint's torque root mean square, and
    /// more the larger `share` is; what does not set the size is drawn.
    fn draw(at: &Surroundings<'_>, share: f64, random: &mut ChaCha8Rng) -> Self;
}

/// Strangers ready to act: those ahead of the effects of a scenario, and those behind them.
pub(crate) struct Injected {
    pub ahead: Vec<Box<dyn Inject>>,
    pub behind: Vec<Box<dyn Inject>>,
}

/// Strangers ready to act, in the order of the chain from command to reading.
///
/// What the drive makes of a command (windup, dead zone, limited rate, in this order) comes before
/// saturation, delay and lag of the scenario; every other stranger comes after all its effects, so
/// that a payload weighs on a soft mount and a dropout takes away what the motor would have given.
///
/// # Errors
///
/// The index of the first stranger that cannot act on the robot, with its mistake.
pub(crate) fn injected(
    strangers: &[StrangerSpec],
    robot: &Robot,
) -> Result<Injected, (usize, Mistake)> {
    let mut ranked = Vec::with_capacity(strangers.len());
    for (index, stranger) in strangers.iter().enumerate() {
        let inject = stranger.inject(robot).map_err(|mistake| (index, mistake))?;
        ranked.push((chain_rank(stranger.kind()), inject));
    }
    ranked.sort_by_key(|(rank, _)| *rank);
    let first_behind = ranked.partition_point(|(rank, _)| *rank < BEHIND);
    let behind = ranked.split_off(first_behind);
    let plain = |ranked: Vec<(usize, Box<dyn Inject>)>| ranked.into_iter().map(|r| r.1).collect();
    Ok(Injected { ahead: plain(ranked), behind: plain(behind) })
}

/// Rank from which on a stranger comes after the effects.
const BEHIND: usize = 3;

/// Place of a stranger in the chain from command to motion.
fn chain_rank(kind: StrangerKind) -> usize {
    use StrangerKind as K;
    match kind {
        K::IntegratorWindup => 0,
        K::DriveDeadZone => 1,
        K::TorqueRateLimit => 2,
        _ => BEHIND,
    }
}

/// Stiffest spring that is drawn for a joint (N m/rad or N/m).
fn stiffest(at: &Surroundings<'_>) -> f64 {
    (LARGEST_RING * LARGEST_RING * at.inertia).min(1e5)
}

/// Length of a joint's range (rad or m), above zero.
fn span(at: &Surroundings<'_>) -> f64 {
    (at.range.1 - at.range.0).max(1e-3)
}
