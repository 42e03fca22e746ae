use std::collections::BTreeMap;
use std::io::{ErrorKind, Write};
use std::path::Path;

use logs::{Channels, LogError, Run};
use motion::State;
use rand::RngExt;
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::SeedableRng;
use rand_distr::{Distribution, Exp, Normal};
use rayon::prelude::*;
use robot::{Gain, Machine, MachineFault, Reading, Robot};
use serde::Serialize;

use crate::draw::draw_hidden;
use crate::effects::spec::EffectSpec;
use crate::error::SimulatorError;
use crate::inject::Inject;
use crate::scenario::check::{Scenario, ScenarioRun, injected};
use crate::scenario::spec::{DropoutSpec, Logged};
use crate::sensors::{EffortSource, Sensors};
use crate::simulator::{Simulator, Stepping};
use crate::strangers;
use crate::strangers::spec::StrangerSpec;
use crate::strangers::truth::StrangerTruth;
use crate::truth::Truth;

/// The part of a run's seed that its dropouts are drawn from.
const DROPOUTS: u64 = 3;

/// What a scenario gives: logs that hold no trace of what was put in, and apart from them what
/// was.
#[derive(Debug, Clone, PartialEq)]
pub struct Simulation {
    /// One log a run.
    pub runs: Vec<Run>,
    /// Effects that were put in.
    pub truth: Vec<Truth>,
    /// Strangers that were put in.
    pub strangers: Vec<StrangerTruth>,
}

/// What is put into an arm.
#[derive(Debug, Clone, Copy)]
pub(crate) struct PutIn<'a> {
    pub effects: &'a [EffectSpec],
    pub strangers: &'a [StrangerSpec],
}

/// How logs are written.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum LogFormat {
    /// Parquet, one `f64` column a signal.
    Parquet,
    /// Text, one row a line.
    Csv,
}

impl LogFormat {
    /// How the names of such files end.
    pub const fn extension(self) -> &'static str {
        match self {
            Self::Parquet => "parquet",
            Self::Csv => "csv",
        }
    }
}

/// Simulates every run of a scenario, side by side on all cores.
///
/// What comes out depends on the scenario alone, not on the number of threads: every run draws
/// from a seed of its own.
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
    let put_in = PutIn { effects: &effects, strangers: scenario.strangers() };
    let runs: Vec<_> =
        scenario.runs().iter().enumerate().filter(|(_, run)| wanted(&run.name)).collect();
    let runs = runs
        .into_par_iter()
        .map(|(index, run)| simulate_run(scenario, put_in, index, run, on_second));
    Ok(Simulation {
        runs: runs.collect::<Result<_, _>>()?,
        truth: effects.iter().map(EffectSpec::truth).collect(),
        strangers: scenario.strangers().iter().map(StrangerSpec::truth).collect(),
    })
}

/// Simulates the runs of a scenario whose names are `wanted` with exactly these effects and
/// strangers in place of its own, seen without error: arms with and without one cause can be
/// compared.
///
/// Effort source, side of the position, second encoders and rate of the log are the scenario's.
/// Noise, steps, lag, jitter and lost rows are left out, and velocity is logged as it is.
///
/// # Errors
///
/// [`SimulatorError`] when the arm cannot be simulated, or a joint ran away.
pub fn simulate_silent(
    scenario: &Scenario,
    wanted: &dyn Fn(&str) -> bool,
    effects: &[EffectSpec],
    strangers: &[StrangerSpec],
) -> Result<Vec<Run>, SimulatorError> {
    let put_in = PutIn { effects, strangers };
    let runs: Vec<_> = scenario.runs().iter().filter(|run| wanted(&run.name)).collect();
    let runs = runs.into_par_iter().map(|run| silent(scenario, put_in, run, f64::INFINITY));
    runs.collect()
}

/// The beginning of the first run of a scenario, so long (s) at most, as [`simulate_silent`] makes it.
///
/// # Errors
///
/// As [`simulate_silent`].
pub fn simulate_silent_start(
    scenario: &Scenario,
    effects: &[EffectSpec],
    longest_s: f64,
) -> Result<Run, SimulatorError> {
    silent(scenario, PutIn { effects, strangers: &[] }, &scenario.runs()[0], longest_s)
}

fn silent(
    scenario: &Scenario,
    put_in: PutIn<'_>,
    run: &ScenarioRun,
    longest_s: f64,
) -> Result<Run, SimulatorError> {
    let sensors = scenario.silent_sensors();
    let rows = followed(scenario, put_in, sensors, (run, longest_s), &|| {})?;
    let rows: Vec<Row> = rows.into_iter().step_by(scenario.rows_per_log()).collect();
    Ok(log(scenario, run, &rows))
}

/// The arm of a scenario with all its effects, for a controller of one's own; `part` sets the
/// seed of its sensors apart from those of the scenario's runs and of other parts.
///
/// # Errors
///
/// [`SimulatorError`] when the arm cannot be simulated or no effect could be drawn.
pub fn arm(scenario: &Scenario, part: u64) -> Result<Simulator, SimulatorError> {
    let effects = all_effects(scenario)?;
    let sensors = scenario.sensors(mixed(mixed(scenario.seed(), u64::MAX), part));
    let put_in = PutIn { effects: &effects, strangers: scenario.strangers() };
    simulator(scenario.robot(), put_in, sensors, scenario.stepping())
}

/// A scenario whose hidden effects are drawn once for all that it is used for: it gives the same
/// logs and the same arm.
///
/// # Errors
///
/// [`SimulatorError`] when no effect could be drawn.
pub fn drawn(scenario: &Scenario) -> Result<Scenario, SimulatorError> {
    Ok(scenario.with_effects(all_effects(scenario)?))
}

/// The effects that a scenario states, and those that it draws.
fn all_effects(scenario: &Scenario) -> Result<Vec<EffectSpec>, SimulatorError> {
    let mut effects = scenario.effects().to_vec();
    effects.extend(draw_hidden(scenario)?);
    Ok(effects)
}

/// Writes the logs, the resolved scenario and `truth.json` into a folder.
///
/// Every file appears whole or not at all. `truth.json` is the last to appear, and one of before
/// is the first to go: where there is one, it is that of the logs beside it.
///
/// # Errors
///
/// [`SimulatorError::Log`] when a file cannot be written.
pub fn write(
    folder: &Path,
    scenario: &Scenario,
    simulation: &Simulation,
    format: LogFormat,
) -> Result<(), SimulatorError> {
    let coded = simulation.truth.iter().map(|truth| Coded { code: truth.effect.code(), truth });
    let sealed = Sealed {
        seed: scenario.seed(),
        effects: coded.collect(),
        strangers: &simulation.strangers,
    };
    let truth = serde_json::to_string_pretty(&sealed).unwrap_or_default() + "\n";
    let truth_file = folder.join("truth.json");
    match std::fs::remove_file(&truth_file) {
        Err(error) if error.kind() != ErrorKind::NotFound => {
            return Err(LogError::Unwritable { path: truth_file, reason: error.to_string() }.into());
        }
        _ => {}
    }
    for run in &simulation.runs {
        let path = folder.join(format!("{}.{}", run.name, format.extension()));
        match format {
            LogFormat::Parquet => logs::write_parquet(&path, run)?,
            LogFormat::Csv => logs::write_csv(&path, run)?,
        }
    }
    let scenario_file = folder.join("scenario.toml");
    for (path, text) in [(&scenario_file, scenario.resolved()), (&truth_file, &truth)] {
        logs::replace_file(path, |file| Ok(file.write_all(text.as_bytes())?))?;
    }
    Ok(())
}

/// `truth.json`
#[derive(Serialize)]
struct Sealed<'a> {
    seed: u64,
    effects: Vec<Coded<'a>>,
    #[serde(skip_serializing_if = "<[_]>::is_empty")]
    strangers: &'a [StrangerTruth],
}

/// What was put in, and the code of its effect beside the name.
#[derive(Serialize)]
struct Coded<'a> {
    code: &'static str,
    #[serde(flatten)]
    truth: &'a Truth,
}

fn simulate_run(
    scenario: &Scenario,
    put_in: PutIn<'_>,
    index: usize,
    run: &ScenarioRun,
    on_second: &(dyn Fn() + Sync),
) -> Result<Run, SimulatorError> {
    let seed = mixed(scenario.seed(), index as u64);
    let rows = followed(scenario, put_in, scenario.sensors(seed), (run, f64::INFINITY), on_second)?;
    let spec = &scenario.spec().sensors;
    let stepping = scenario.stepping();
    let period_s = stepping.steps_per_period.max(1) as f64 * stepping.step_s;
    let last_s = rows.last().map_or(0.0, |row| row.reading.time_s);
    let mut clock = LogClock {
        random: ChaCha8Rng::seed_from_u64(mixed(seed, 1)),
        jitter_s: 1e-3 * spec.time_jitter_ms,
        dropped_share: spec.dropped_share,
        shortest_s: 0.2 * period_s * scenario.rows_per_log() as f64,
        lost: spec.dropouts.map_or_else(Vec::new, |dropouts| {
            lost(&dropouts, last_s, &mut ChaCha8Rng::seed_from_u64(mixed(seed, DROPOUTS)))
        }),
    };
    let mut log = log(scenario, run, &clock.thin(rows, scenario.rows_per_log()));
    if spec.velocity_logged == Logged::No {
        log.joints.iter_mut().for_each(|joint| joint.velocity = None);
    }
    Ok(log)
}

/// The rows of a run at the controller's rate, their times exact.
fn followed(
    scenario: &Scenario,
    put_in: PutIn<'_>,
    sensors: Sensors,
    (run, longest_s): (&ScenarioRun, f64),
    on_second: &dyn Fn(),
) -> Result<Vec<Row>, SimulatorError> {
    let robot = scenario.robot();
    let mut simulator = simulator(robot, put_in, sensors, scenario.stepping())?;
    let following = Following { gains: scenario.gains(), robot, run, longest_s };
    follow(&mut simulator, &following, on_second)
        .map_err(|fault| SimulatorError::Fault { run: run.name.clone(), fault })
}

/// A simulator with effects and strangers that were checked for the robot: what the drive makes of
/// commands, then the effects, then all other strangers.
pub(crate) fn simulator(
    robot: &Robot,
    put_in: PutIn<'_>,
    sensors: Sensors,
    stepping: Stepping,
) -> Result<Simulator, SimulatorError> {
    let PutIn { effects, strangers } = put_in;
    let injected: Vec<Box<dyn Inject>> =
        injected(effects, robot).map_err(|(index, mistake)| SimulatorError::Effect {
            effect: effects[index].kind(),
            key: mistake.key.to_owned(),
            found: mistake.found,
        })?;
    let around = strangers::injected(strangers, robot).map_err(|(index, mistake)| {
        SimulatorError::Stranger {
            stranger: strangers[index].kind(),
            key: mistake.key.to_owned(),
            found: mistake.found,
        }
    })?;
    let all = around.ahead.into_iter().chain(injected).chain(around.behind);
    Simulator::new(robot, all.collect(), sensors, stepping)
}

/// One row of a log, with the reference that was followed.
#[derive(Debug, Clone)]
pub(crate) struct Row {
    pub reading: Reading,
    /// What the encoders at the links say, where there are any.
    pub links: Vec<Option<f64>>,
    pub command: Vec<f64>,
    pub reference: State,
}

/// A motion and the controller that follows it.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Following<'a> {
    pub gains: &'a [Gain],
    pub robot: &'a Robot,
    pub run: &'a ScenarioRun,
    /// Only this much of the motion is followed (s).
    pub longest_s: f64,
}

/// Follows a motion with `tau = kp (q_ref - q) + kd (qd_ref - qd)`, within the torque limits.
///
/// A motion that starts at rest is held at its start for the lead-in, before time zero; any other
/// starts in motion at once.
pub(crate) fn follow(
    simulator: &mut Simulator,
    following: &Following<'_>,
    on_second: &dyn Fn(),
) -> Result<Vec<Row>, MachineFault> {
    let Following { gains, robot, run, longest_s } = *following;
    let period_s = simulator.period_s();
    let mut reference = run.motion.at(0.0);
    let at_rest = reference.qd.iter().all(|qd| qd.abs() <= 1e-9);
    let lead_in = if at_rest { (run.lead_in_s / period_s).round() as usize } else { 0 };
    simulator.start_moving(&reference.q, &reference.qd);
    simulator.count_down(lead_in);
    let count = (run.motion.duration_s().min(longest_s) / period_s).round() as usize + 1;
    let mut reading = Reading::zero(robot.joint_count());
    let mut command = vec![0.0; robot.joint_count()];
    let mut rows = Vec::with_capacity(count);
    for tick in 0..lead_in + count {
        let time_s = (tick as f64 - lead_in as f64) * period_s;
        if tick > lead_in {
            run.motion.sample(time_s, &mut reference);
        }
        simulator.read(&mut reading)?;
        feedback(gains, robot, &reference, &reading, &mut command);
        simulator.actuate(&command)?;
        let mut row = Reading::default();
        simulator.record(&reading, &mut row);
        let links = simulator.record_links(&reading);
        if tick >= lead_in {
            row.time_s = time_s;
            let (command, reference) = (command.clone(), reference.clone());
            rows.push(Row { reading: row, links, command, reference });
            if (time_s + period_s).floor() > time_s.floor() {
                on_second();
            }
        }
    }
    Ok(rows)
}

fn feedback(
    gains: &[Gain],
    robot: &Robot,
    reference: &State,
    reading: &Reading,
    command: &mut [f64],
) {
    for (i, (gain, link)) in gains.iter().zip(robot.links()).enumerate() {
        let limit = link.joint.limits.effort.unwrap_or(f64::INFINITY);
        let tau =
            gain.kp * (reference.q[i] - reading.q[i]) + gain.kd * (reference.qd[i] - reading.qd[i]);
        command[i] = tau.clamp(-limit, limit);
    }
}

/// What the clock of the log does to its rows.
struct LogClock {
    random: ChaCha8Rng,
    jitter_s: f64,
    dropped_share: f64,
    /// Least time between two stamps (s).
    shortest_s: f64,
    /// Stretches whose rows are lost, as start and end (s).
    lost: Vec<(f64, f64)>,
}

/// Starts and ends (s) of the dropouts of a log, its starts a Poisson process.
fn lost(dropouts: &DropoutSpec, last_s: f64, random: &mut ChaCha8Rng) -> Vec<(f64, f64)> {
    let mut lost = Vec::new();
    let Ok(between) = Exp::new(dropouts.per_minute / 60.0) else { return lost };
    let mut start_s = between.sample(random);
    while start_s <= last_s {
        lost.push((start_s, start_s + 1e-3 * dropouts.length_ms));
        start_s += between.sample(random);
    }
    lost
}

impl LogClock {
    /// Keeps every `every`-th row, loses some of them and shakes their stamps.
    fn thin(&mut self, rows: Vec<Row>, every: usize) -> Vec<Row> {
        let mut kept: Vec<Row> = Vec::with_capacity(rows.len() / every + 1);
        let jitter = Normal::new(0.0, self.jitter_s).ok().filter(|_| self.jitter_s > 0.0);
        for mut row in rows.into_iter().step_by(every) {
            if self.dropped_share > 0.0 && self.random.random::<f64>() < self.dropped_share {
                continue;
            }
            let time_s = row.reading.time_s;
            row.reading.time_s += jitter.map_or(0.0, |j| j.sample(&mut self.random));
            if self.lost.iter().any(|(start, end)| (*start..*end).contains(&time_s)) {
                continue;
            }
            if let Some(last) = kept.last() {
                row.reading.time_s = row.reading.time_s.max(last.reading.time_s + self.shortest_s);
            }
            kept.push(row);
        }
        kept
    }
}

/// The log: what sensors and controller say, nothing else.
fn log(scenario: &Scenario, run: &ScenarioRun, rows: &[Row]) -> Run {
    let asked_is_effort = scenario.spec().sensors.effort == EffortSource::Commanded;
    let column = |of: &dyn Fn(&Row) -> f64| rows.iter().map(of).collect::<Vec<f64>>();
    let joint = |(i, name): (usize, &str)| Channels {
        name: name.to_owned(),
        position: column(&|r| r.reading.q[i]),
        effort: column(&|r| r.reading.effort[i]),
        velocity: Some(column(&|r| r.reading.qd[i])),
        acceleration: None,
        desired_position: Some(column(&|r| r.reference.q[i])),
        desired_velocity: Some(column(&|r| r.reference.qd[i])),
        desired_acceleration: Some(column(&|r| r.reference.qdd[i])),
        commanded_effort: (!asked_is_effort).then(|| column(&|r| r.command[i])),
        link_position: rows.iter().map(|r| r.links[i]).collect(),
    };
    Run {
        name: run.name.clone(),
        source: Default::default(),
        sha256: String::new(),
        is_torn: false,
        mended: Vec::new(),
        time: column(&|r| r.reading.time_s),
        joints: scenario.robot().joint_names().enumerate().map(joint).collect(),
        extra: BTreeMap::new(),
    }
}

/// A seed of its own for every part of a whole (Steele, Lea & Flood 2014).
pub(crate) fn mixed(seed: u64, part: u64) -> u64 {
    let mut z = seed.wrapping_add(part.wrapping_add(1).wrapping_mul(0x9e37_79b9_7f4a_7c15));
    z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    z ^ (z >> 31)
}
