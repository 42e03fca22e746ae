use std::collections::BTreeMap;

use logs::Run;
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::SeedableRng;
use rayon::prelude::*;

use crate::effects::spec::EffectSpec;
use crate::effects::truth::Truth;
use crate::error::SimulatorError;
use crate::run::follow::{ArmCauses, ControlRow, Following, follow, simulator};
use crate::run::hidden::draw_hidden;
use crate::run::log::{LogClock, draw_dropouts, log_of_rows};
use crate::scenario::check::{Scenario, ScenarioRun};
use crate::scenario::spec::Logged;
use crate::seed::mix_seed;
use crate::sensors::Sensors;
use crate::simulator::Simulator;
use crate::strangers::spec::StrangerSpec;
use crate::strangers::truth::StrangerTruth;

/// Number of the seed that dropouts are drawn from.
const DROPOUTS: u64 = 3;

/// The logs of a scenario and, apart from them, the truth about its effects.
#[derive(Debug, Clone, PartialEq)]
pub struct Simulation {
    /// One log per run.
    pub runs: Vec<Run>,
    /// Effects that were put in.
    pub truth: Vec<Truth>,
    /// Effects that were put in during one run alone, by the name of the run.
    pub truth_of_runs: BTreeMap<String, Vec<Truth>>,
    /// Strangers that were put in.
    pub strangers: Vec<StrangerTruth>,
}

/// Simulates every run of a scenario in parallel.
///
/// Every run draws from its own seed, so the result is the same for any number of threads.
///
/// `on_second` is called after every second of motion, from any thread.
///
/// # Errors
///
/// [`SimulatorError`] when the arm cannot be simulated, no effect could be drawn, or a joint ran
/// away.
pub fn simulate(
    scenario: &Scenario,
    on_second: &(dyn Fn() + Sync),
) -> Result<Simulation, SimulatorError> {
    simulate_only(scenario, &|_| true, on_second)
}

/// Simulates the runs of a scenario whose names are `wanted`, each as [`simulate`] does.
///
/// # Errors
///
/// As [`simulate`].
pub fn simulate_only(
    scenario: &Scenario,
    wanted: &dyn Fn(&str) -> bool,
    on_second: &(dyn Fn() + Sync),
) -> Result<Simulation, SimulatorError> {
    let effects = all_effects(scenario)?;
    let causes = ArmCauses { effects: &effects, strangers: scenario.strangers() };
    let runs: Vec<_> =
        scenario.runs().iter().enumerate().filter(|(_, run)| wanted(&run.name)).collect();
    let runs = runs
        .into_par_iter()
        .map(|(index, run)| simulate_run(scenario, causes, index, run, on_second));
    Ok(Simulation {
        runs: runs.collect::<Result<_, _>>()?,
        truth: effects.iter().map(EffectSpec::truth).collect(),
        truth_of_runs: truth_of_runs(scenario, wanted),
        strangers: scenario.strangers().iter().map(StrangerSpec::truth).collect(),
    })
}

/// What the `wanted` runs have in them beside the effects of the scenario.
fn truth_of_runs(
    scenario: &Scenario,
    wanted: &dyn Fn(&str) -> bool,
) -> BTreeMap<String, Vec<Truth>> {
    let has_own = |run: &&ScenarioRun| wanted(&run.name) && !run.effects.is_empty();
    let own =
        |run: &ScenarioRun| (run.name.clone(), run.effects.iter().map(EffectSpec::truth).collect());
    scenario.runs().iter().filter(has_own).map(own).collect()
}

/// Simulates the `wanted` runs of a scenario without sensor errors, with these effects and strangers
/// in place of the scenario's. Arms with and without one cause can so be compared. Effects of one run alone stay
/// in that run.
///
/// Effort source, side of the position, second encoders and rate of the log are the scenario's.
/// Noise, resolution, lag, jitter and lost rows are left out, and the logged velocity is the true one.
///
/// # Errors
///
/// [`SimulatorError`] when the arm cannot be simulated, or a joint ran away.
pub fn simulate_noise_free(
    scenario: &Scenario,
    wanted: &dyn Fn(&str) -> bool,
    effects: &[EffectSpec],
    strangers: &[StrangerSpec],
) -> Result<Vec<Run>, SimulatorError> {
    let causes = ArmCauses { effects, strangers };
    let runs: Vec<_> = scenario.runs().iter().filter(|run| wanted(&run.name)).collect();
    let runs =
        runs.into_par_iter().map(|run| follow_without_noise(scenario, causes, run, f64::INFINITY));
    runs.collect()
}

/// The first `longest_s` seconds of a scenario's first run, simulated as in [`simulate_noise_free`].
///
/// # Errors
///
/// As [`simulate_noise_free`].
pub fn simulate_noise_free_start(
    scenario: &Scenario,
    effects: &[EffectSpec],
    longest_s: f64,
) -> Result<Run, SimulatorError> {
    follow_without_noise(
        scenario,
        ArmCauses { effects, strangers: &[] },
        &scenario.runs()[0],
        longest_s,
    )
}

fn follow_without_noise(
    scenario: &Scenario,
    causes: ArmCauses<'_>,
    run: &ScenarioRun,
    longest_s: f64,
) -> Result<Run, SimulatorError> {
    Ok(log_of_rows(scenario, run, &rows_without_noise(scenario, causes, run, longest_s)?))
}

/// The rows of a log without sensor errors.
pub(crate) fn rows_without_noise(
    scenario: &Scenario,
    causes: ArmCauses<'_>,
    run: &ScenarioRun,
    longest_s: f64,
) -> Result<Vec<ControlRow>, SimulatorError> {
    let sensors = scenario.noise_free_sensors();
    let rows = follow_run(scenario, causes, sensors, run, longest_s, &|| {})?;
    Ok(rows.into_iter().step_by(scenario.rows_per_log()).collect())
}

/// The arm of a scenario with all its effects, for use with another controller. The sensors draw from
/// a seed that depends on `part` and differs from those of the scenario's runs.
///
/// # Errors
///
/// [`SimulatorError`] when the arm cannot be simulated or no effect could be drawn.
pub fn arm(scenario: &Scenario, part: u64) -> Result<Simulator, SimulatorError> {
    let effects = all_effects(scenario)?;
    let sensors = scenario.sensors(mix_seed(mix_seed(scenario.seed(), u64::MAX), part));
    let causes = ArmCauses { effects: &effects, strangers: scenario.strangers() };
    simulator(scenario.robot(), causes, sensors, scenario.stepping())
}

/// Draws the hidden effects of a scenario and states them in it. The result gives the same logs and
/// the same arm without drawing again.
///
/// # Errors
///
/// [`SimulatorError`] when no effect could be drawn.
pub fn draw_hidden_effects(scenario: &Scenario) -> Result<Scenario, SimulatorError> {
    Ok(scenario.with_effects(all_effects(scenario)?))
}

/// The stated and the drawn effects of a scenario.
fn all_effects(scenario: &Scenario) -> Result<Vec<EffectSpec>, SimulatorError> {
    let mut effects = scenario.effects().to_vec();
    effects.extend(draw_hidden(scenario)?);
    Ok(effects)
}

fn simulate_run(
    scenario: &Scenario,
    causes: ArmCauses<'_>,
    index: usize,
    run: &ScenarioRun,
    on_second: &(dyn Fn() + Sync),
) -> Result<Run, SimulatorError> {
    let seed = mix_seed(scenario.seed(), index as u64);
    let rows = follow_run(scenario, causes, scenario.sensors(seed), run, f64::INFINITY, on_second)?;
    let spec = &scenario.spec().sensors;
    let stepping = scenario.stepping();
    let period_s = stepping.steps_per_period.max(1) as f64 * stepping.step_s;
    let last_s = rows.last().map_or(0.0, |row| row.reading.time_s);
    let mut clock = LogClock {
        random: ChaCha8Rng::seed_from_u64(mix_seed(seed, 1)),
        jitter_s: 1e-3 * spec.time_jitter_ms,
        dropped_share: spec.dropped_share,
        shortest_s: 0.2 * period_s * scenario.rows_per_log() as f64,
        lost: spec.dropouts.map_or_else(Vec::new, |dropouts| {
            draw_dropouts(
                &dropouts,
                last_s,
                &mut ChaCha8Rng::seed_from_u64(mix_seed(seed, DROPOUTS)),
            )
        }),
    };
    let mut log = log_of_rows(scenario, run, &clock.thin(rows, scenario.rows_per_log()));
    if spec.velocity_logged == Logged::No {
        log.joints.iter_mut().for_each(|joint| joint.velocity = None);
    }
    Ok(log)
}

/// The rows of a run at the controller's rate, with exact times.
fn follow_run(
    scenario: &Scenario,
    causes: ArmCauses<'_>,
    sensors: Sensors,
    run: &ScenarioRun,
    longest_s: f64,
    on_second: &dyn Fn(),
) -> Result<Vec<ControlRow>, SimulatorError> {
    let robot = scenario.robot();
    let effects = [causes.effects, run.effects.as_slice()].concat();
    let causes = ArmCauses { effects: &effects, ..causes };
    let mut simulator = simulator(robot, causes, sensors, scenario.stepping())?;
    let servo = scenario.spec().control.servo;
    let following = Following { gains: scenario.gains(), robot, run, servo, longest_s };
    follow(&mut simulator, &following, on_second)
        .map_err(|fault| SimulatorError::Fault { run: run.name.clone(), fault })
}
