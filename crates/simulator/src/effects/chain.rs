use robot::Robot;

use crate::effects::mistake::Mistake;
use crate::effects::scenario_effect::chain_rank;
use crate::effects::spec::EffectSpec;
use crate::mechanics::inject::Inject;

/// Prepares effects, in the order of the chain from command to reading.
///
/// # Errors
///
/// The index of the first effect that the robot cannot have, with its mistake.
pub(crate) fn inject_all(
    effects: &[EffectSpec],
    robot: &Robot,
) -> Result<Vec<Box<dyn Inject>>, (usize, Mistake)> {
    let mut ranked = Vec::with_capacity(effects.len());
    for (index, effect) in effects.iter().enumerate() {
        let inject = effect.inject(robot).map_err(|mistake| (index, mistake))?;
        ranked.push((chain_rank(effect.kind()), inject));
    }
    ranked.sort_by_key(|(rank, _)| *rank);
    Ok(ranked.into_iter().map(|(_, inject)| inject).collect())
}
