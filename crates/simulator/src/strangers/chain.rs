use robot::Robot;

use crate::effects::mistake::Mistake;
use crate::mechanics::inject::Inject;
use crate::strangers::kind::StrangerKind;
use crate::strangers::spec::StrangerSpec;

/// Prepared strangers: those that act before the effects of a scenario, and those that act after them.
pub(crate) struct InjectedStrangers {
    pub ahead: Vec<Box<dyn Inject>>,
    pub behind: Vec<Box<dyn Inject>>,
}

/// Prepares strangers, in the order of the chain from command to reading.
///
/// Strangers of the drive (windup, dead zone, rate limit, in this order) act before saturation, delay
/// and lag of the scenario. All others act after the effects, so that a payload loads a soft mount
/// and a dropout removes the final torque of the motor.
///
/// # Errors
///
/// The index of the first stranger that the robot cannot have, with its mistake.
pub(crate) fn inject_all(
    strangers: &[StrangerSpec],
    robot: &Robot,
) -> Result<InjectedStrangers, (usize, Mistake)> {
    let mut ranked = Vec::with_capacity(strangers.len());
    for (index, stranger) in strangers.iter().enumerate() {
        let inject = stranger.inject(robot).map_err(|mistake| (index, mistake))?;
        ranked.push((chain_rank(stranger.kind()), inject));
    }
    ranked.sort_by_key(|(rank, _)| *rank);
    let first_behind = ranked.partition_point(|(rank, _)| *rank < BEHIND);
    let behind = ranked.split_off(first_behind);
    let plain = |ranked: Vec<(usize, Box<dyn Inject>)>| ranked.into_iter().map(|r| r.1).collect();
    Ok(InjectedStrangers { ahead: plain(ranked), behind: plain(behind) })
}

/// Least rank of strangers that act after the effects.
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
