use catalogue::EffectKind;
use rand::RngExt;
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::SeedableRng;

use crate::effects::spec::EffectSpec;
use crate::error::SimulatorError;
use crate::run::effect_sizer::EffectSizer;
use crate::scenario::check::Scenario;
use crate::seed::mix_seed;

/// Draws the hidden effects of a scenario: kind, joint and size follow from its seed.
///
/// A size is drawn log-uniformly as a share of torque,
///
/// ```text
/// share = rms(tau - tau_without) / sqrt(rms(tau_without)^2 + noise^2)
/// ```
///
/// of the reported torque. Its noise counts, since a share of a wrist's tiny torque alone would be
/// invisible in any log. The share is taken at the effect's joint, or over all joints for an effect of
/// a link or of the whole arm. The effect's parameter is corrected until the simulated share is
/// within a tenth of the drawn one. An effect that cannot reach it at its joint is drawn again.
///
/// # Errors
///
/// [`SimulatorError::NothingDrawn`] after many draws, or the error of simulating the arm without
/// hidden effects.
pub(crate) fn draw_hidden(scenario: &Scenario) -> Result<Vec<EffectSpec>, SimulatorError> {
    let Some(hidden) = scenario.hidden() else { return Ok(Vec::new()) };
    let seed = hidden.seed.unwrap_or_else(|| mix_seed(scenario.seed(), u64::MAX));
    let mut random = ChaCha8Rng::seed_from_u64(seed);
    let count = random.random_range(hidden.count[0]..=hidden.count[1]);
    if count == 0 {
        return Ok(Vec::new());
    }
    // Late goals change the motion, and a log shows them only where its efforts are computed from goals.
    let has_goals = scenario.spec().control.servo.is_some();
    let is_drawn = |kind: &EffectKind| has_goals || *kind != EffectKind::GoalDelay;
    let all: Vec<EffectKind> = EffectKind::ALL.into_iter().filter(is_drawn).collect();
    let kinds = if hidden.from.is_empty() { &all } else { &hidden.from };
    let bench = EffectSizer::new(scenario)?;
    let mut drawn: Vec<EffectSpec> = Vec::with_capacity(count);
    for _ in 0..count {
        drawn.push(bench.draw(hidden, kinds, &drawn, &mut random)?);
    }
    Ok(drawn)
}
