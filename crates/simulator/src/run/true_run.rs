use logs::Run;
use rayon::prelude::*;

use crate::effects::spec::EffectSpec;
use crate::error::SimulatorError;
use crate::run::arm_state::ArmState;
use crate::run::follow::ArmCauses;
use crate::run::log::log_of_rows;
use crate::run::simulate::rows_without_noise;
use crate::scenario::check::Scenario;
use crate::strangers::spec::StrangerSpec;

/// A run without sensor errors, and what the arm did at each row of its log.
#[derive(Debug, Clone, PartialEq)]
pub struct TrueRun {
    /// Its log.
    pub log: Run,
    /// One per row of the log.
    pub rows: Vec<TrueRow>,
    /// Positions at which the arm was put at the start (rad or m).
    pub start_q: Vec<f64>,
    /// Time for which it was held there before the log (s).
    pub lead_in_s: f64,
}

/// What happened at one row of a log.
#[derive(Debug, Clone, PartialEq)]
pub struct TrueRow {
    /// Time since the start of the log (s).
    pub time_s: f64,
    /// What the joints did.
    pub state: ArmState,
    /// Efforts that the controller asked for (N m or N).
    pub command: Vec<f64>,
}

/// Simulates the `wanted` runs as [`simulate_noise_free`](crate::simulate_noise_free) does, and keeps what motors
/// and links did.
///
/// # Errors
///
/// [`SimulatorError`] when the arm cannot be simulated, or a joint ran away.
pub fn simulate_truly(
    scenario: &Scenario,
    wanted: &dyn Fn(&str) -> bool,
    effects: &[EffectSpec],
    strangers: &[StrangerSpec],
) -> Result<Vec<TrueRun>, SimulatorError> {
    let causes = ArmCauses { effects, strangers };
    let runs: Vec<_> = scenario.runs().iter().filter(|run| wanted(&run.name)).collect();
    let truly = |run: &crate::scenario::check::ScenarioRun| {
        let rows = rows_without_noise(scenario, causes, run, f64::INFINITY)?;
        let start = run.motion.at(0.0);
        let at_rest = start.qd.iter().all(|qd| qd.abs() <= 1e-9);
        let row = |row: &crate::run::follow::ControlRow| TrueRow {
            time_s: row.reading.time_s,
            state: row.state.clone(),
            command: row.command.clone(),
        };
        Ok(TrueRun {
            log: log_of_rows(scenario, run, &rows),
            rows: rows.iter().map(row).collect(),
            start_q: start.q,
            lead_in_s: if at_rest { run.lead_in_s } else { 0.0 },
        })
    };
    runs.into_par_iter().map(truly).collect()
}
