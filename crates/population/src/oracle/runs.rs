use document::Document;
use logs::Run;
use robot::Robot;
use simulator::scenario::{Scenario, ScenarioSpec, SensorSpec};
use simulator::{EffortSource, TrueRun, simulate_only, simulate_truly};

use crate::error::PopulationError;
use crate::oracle::along::Sensing;
use crate::oracle::command_noise::CommandNoise;
use crate::oracle::motion::SeenRun;
use crate::oracle::noise::{OracleNoise, ReadingError};
use crate::rigid::mass_matrix;

/// Name of the run that takes no part in the diagnosis.
pub(crate) const HELD_OUT: &str = "held_out";

/// The runs of a scenario as an oracle knows them: without errors of the sensors, and what these are.
pub(crate) struct OracleRuns {
    pub sensing: Sensing,
    /// What the arm did.
    pub truly: Vec<TrueRun>,
    /// What the oracle looks at.
    pub seen: Vec<SeenRun>,
    /// Noise of the sensors of each joint.
    pub noise: Vec<OracleNoise>,
}

impl OracleRuns {
    /// Simulates the wanted runs of a scenario with all that it states; where the effort is a command, once more with
    /// the sensors as they are.
    pub fn new(
        scenario: &Scenario,
        wanted: &dyn Fn(&str) -> bool,
    ) -> Result<Self, PopulationError> {
        let robot = scenario.robot();
        let sensors = &scenario.spec().sensors;
        let truly = simulate_truly(scenario, wanted, scenario.effects(), scenario.strangers())?;
        let seen = truly.iter().map(|run| SeenRun::new(robot, &run.log)).collect();
        let mut noise = noise(sensors, robot);
        if sensors.effort == EffortSource::Commanded {
            let noisy = simulate_only(scenario, wanted, &|| {})?.runs;
            let silent: Vec<Run> = truly.iter().map(|run| run.log.clone()).collect();
            for (j, noise) in noise.iter_mut().enumerate() {
                noise.command = CommandNoise::measure(&noisy, &silent, j);
            }
        }
        let sensing = Sensing { effort: sensors.effort, side: sensors.position };
        Ok(Self { sensing, truly, seen, noise })
    }
}

/// The same scenario in steps of another length (ms), with logs that lose no row and whose clock is right.
pub(crate) fn in_steps_of(scenario: &Scenario, step_ms: f64) -> Result<Scenario, PopulationError> {
    let mut spec: ScenarioSpec = scenario.spec().clone();
    spec.robot = scenario.robot_file().to_owned();
    spec.engine.step_ms = step_ms;
    spec.sensors =
        SensorSpec { time_jitter_ms: 0.0, dropped_share: 0.0, dropouts: None, ..spec.sensors };
    scenario_of(&spec)
}

/// A scenario of values that were drawn.
pub(crate) fn scenario_of(spec: &ScenarioSpec) -> Result<Scenario, PopulationError> {
    let text = toml::to_string(spec)
        .map_err(|e| PopulationError::Unwritable { what: "scenario", reason: e.to_string() })?;
    Ok(Scenario::from_document(&Document::from_text("scenario.toml", &text)?)?)
}

/// Noise of the sensors of each joint, but for that of a command.
fn noise(sensors: &SensorSpec, robot: &Robot) -> Vec<OracleNoise> {
    let joint = |(name, inertia): (&str, f64)| {
        let of =
            |map: &std::collections::BTreeMap<String, f64>| map.get(name).copied().unwrap_or(0.0);
        OracleNoise::new(
            ReadingError {
                deviation: of(&sensors.effort_noise_nm),
                step: of(&sensors.effort_resolution_nm),
            },
            ReadingError {
                deviation: of(&sensors.position_noise_rad),
                step: of(&sensors.position_resolution_rad),
            },
            inertia,
        )
    };
    robot.joint_names().zip(inertias(robot)).map(joint).collect()
}

/// Inertia of each joint with all others held, drives included, in the middle of its range (kg m2 or kg).
fn inertias(robot: &Robot) -> Vec<f64> {
    let middle = |link: &robot::Link| {
        link.joint.limits.position.map_or(0.0, |(low, high)| 0.5 * (low + high))
    };
    let q: Vec<f64> = robot.links().iter().map(middle).collect();
    mass_matrix(robot, &q).diagonal().iter().copied().collect()
}
