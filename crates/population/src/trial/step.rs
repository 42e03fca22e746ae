use simulator::effects::EffectSpec;
use simulator::scenario::Scenario;
use simulator::simulate_noise_free_start;

use crate::error::PopulationError;

/// Longest step that is tried (ms).
const LONGEST_MS: f64 = 2.0;

/// Shortest step that is tried (ms).
const SHORTEST_MS: f64 = 0.1;

/// Tolerated error of the simulation, as a share of an encoder step.
const SHARE_OF_STEP: f64 = 0.1;

/// Share of the error that halving the step takes away at least: where joints break loose and come to rest it falls with the
/// first power of the step.
const HALVING_TAKES: f64 = 0.5;

/// Length of motion in which two steps are compared (s).
const COMPARED_S: f64 = 10.0;

/// The longest step up to `at_most_ms` that divides a period of control (ms).
pub(crate) fn whole_step_ms(period_ms: f64, at_most_ms: f64) -> f64 {
    period_ms / (period_ms / at_most_ms - 1e-9).ceil()
}

/// The longest step of the simulation (ms) whose error in position stays below a tenth of the encoder's step,
/// halved until it does:
///
/// ```text
/// error(h) = 2 max over samples and joints of |q_h - q_(h/2)| / encoder step of the joint
/// ```
///
/// at the beginning of the first run of the scenario; `with_step` gives the scenario in steps of a length.
pub(crate) fn step_ms(
    with_step: &dyn Fn(f64) -> Result<Scenario, PopulationError>,
    effects: &[EffectSpec],
    period_ms: f64,
    encoder_steps: &[f64],
) -> Result<f64, PopulationError> {
    let mut step = whole_step_ms(period_ms, LONGEST_MS);
    let mut coarse = positions(&with_step(step)?, effects);
    while step > 1.5 * SHORTEST_MS {
        let fine = positions(&with_step(0.5 * step)?, effects);
        if let (Some(coarse), Some(fine)) = (&coarse, &fine)
            && largest_error(coarse, fine, encoder_steps) < HALVING_TAKES * SHARE_OF_STEP
        {
            return Ok(step);
        }
        step *= 0.5;
        coarse = fine;
    }
    Ok(step)
}

/// Positions of every joint at the beginning of the first run; `None` where this step cannot be simulated.
fn positions(scenario: &Scenario, effects: &[EffectSpec]) -> Option<Vec<Vec<f64>>> {
    let run = simulate_noise_free_start(scenario, effects, COMPARED_S).ok()?;
    Some(run.joints.into_iter().map(|joint| joint.position).collect())
}

/// Largest distance between two motions, in encoder steps.
fn largest_error(a: &[Vec<f64>], b: &[Vec<f64>], steps: &[f64]) -> f64 {
    let joint = |((a, b), step): ((&Vec<f64>, &Vec<f64>), &f64)| {
        let far = a.iter().zip(b).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
        far / step.max(1e-9)
    };
    a.iter().zip(b).zip(steps).map(joint).fold(0.0, f64::max)
}
