use std::path::{Path, PathBuf};

use logs::Run;
use rand::RngExt;
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::SeedableRng;
use robot::{Loaded, Robot};
use simulator::effects::EffectSpec;
use simulator::scenario::{EngineSpec, RunSpec, Scenario, ScenarioSpec};
use simulator::{EffortSource, SimulatorError, StepOrder, simulate_noise_free, simulate_only};

use crate::bench::{BenchWishes, LabBench, draw_bench};
use crate::corner::{Corner, Origin};
use crate::error::PopulationError;
use crate::hidden::HiddenThings;
use crate::oracle::motion::SeenRun;
use crate::oracle::runs::{HELD_OUT, in_steps_of, scenario_of};
use crate::robot_files::RobotFiles;
use crate::sheet::{Knowledge, TruthSheet};
use crate::spec::PopulationSpec;
use crate::text_file::write_text;
use crate::trial::background::{Friction, draw_friction, effects};
use crate::trial::field::faults::FieldFaults;
use crate::trial::known::{NominalKnowledge, describe};
use crate::trial::log_draw::LogDraw;
use crate::trial::pilot::Pilot;
use crate::trial::seen::{COARSE_MS, Seen, Truths};
use crate::trial::servo::without_efforts;
use crate::trial::spoilt::log_damage::LogDamage;
use crate::trial::step::{step_ms, whole_step_ms};

/// Draws of a trial before it fails.
const TRIES: u64 = 8;

/// Tolerated excess over a joint's range, as a share of the range.
const OUT_OF_RANGE: f64 = 0.1;

/// Share of trials whose nominal model knows friction roughly.
const ROUGHLY_KNOWN: f64 = 0.25;

/// Draws a simulated trial from its seed and makes its files in a folder:
///
/// ```text
/// nominal/robot.{urdf,toml}  logs/*.parquet             the input of a diagnosis
/// held_out/held_out.parquet                             noise-free, for measuring predictions
/// truth/{robot.urdf,robot.toml,scenario.toml}           the true arm, to be simulated again
/// sheet.json                                            the truth; written last
/// ```
///
/// # Errors
///
/// [`PopulationError`] when no drawn arm can be simulated, or a file cannot be written.
pub fn make(
    spec: &PopulationSpec,
    seed: u64,
    folder: &Path,
) -> Result<TruthSheet, PopulationError> {
    let mut failed = None;
    for attempt in 0..TRIES {
        let mut random = ChaCha8Rng::seed_from_u64(seed);
        random.set_stream(attempt);
        match make_once(spec, seed, folder, &mut random) {
            Err(error) if is_of_the_draw(&error) => failed = Some(error),
            made_or_broken => return made_or_broken,
        }
    }
    Err(failed.unwrap_or(PopulationError::NoRun))
}

/// Whether another draw may succeed after this error: an arm ran away or left its range.
fn is_of_the_draw(error: &PopulationError) -> bool {
    match error {
        PopulationError::LeftItsRange { .. } => true,
        PopulationError::Simulator(error) => {
            matches!(**error, SimulatorError::Fault { .. } | SimulatorError::NoInertia { .. })
        }
        _ => false,
    }
}

/// One draw of a trial.
fn make_once(
    spec: &PopulationSpec,
    seed: u64,
    folder: &Path,
    random: &mut ChaCha8Rng,
) -> Result<TruthSheet, PopulationError> {
    let clean = random.random_bool(spec.clean);
    let log = LogDraw::new(spec, seed);
    let mut bench = draw_bench(&log.wishes(wishes(spec, random)), random)?;
    log.prepare(&mut bench)?;
    let model = if clean { Model::Right } else { Model::AsModelsAre };
    let shares = if clean { spec.robots.without_errors() } else { spec.robots };
    let faults = FieldFaults::draw(&shares, &mut bench, random)?;
    let draft = Draft::new((bench, faults, log), model, folder, seed, random)?;
    let [least, most] = spec.causes;
    let causes = if clean { 0 } else { random.random_range(least..=most) };
    let strangers = usize::from(!clean && random.random_bool(spec.strangers));
    let mut hidden = draft.hide(causes, strangers, random)?;
    draft.faults.hide(&mut hidden);
    if !clean {
        draft.log.add_causes(&draft.truth.robot, &mut hidden);
    }
    let step = draft.step_ms(&hidden)?;
    let spoilt = !clean && random.random_bool(spec.spoilt);
    let spoilt = spoilt.then(|| LogDamage::draw(&draft.truth.robot, random));
    let runs = (&draft.truth.robot, draft.bench.runs.len());
    let damage = if clean { None } else { draft.log.damage(runs, spoilt) };
    draft.make_logs(step, &hidden, damage, folder)
}

/// Refuses runs in which an arm left its range: it ran away or fell, and such logs are not kept.
fn in_range(robot: &Robot, runs: &[Run]) -> Result<(), PopulationError> {
    for (j, link) in robot.links().iter().enumerate() {
        let Some((low, high)) = link.joint.limits.position else { continue };
        let margin = OUT_OF_RANGE * (high - low);
        let beyond = |q: &f64| !(low - margin..=high + margin).contains(q);
        let all = runs.iter().flat_map(|run| &run.joints[j].position);
        if let Some(&found) = all.into_iter().find(|q| beyond(q)) {
            let joint = link.joint.name.clone();
            return Err(PopulationError::LeftItsRange { joint, found, range: [low, high] });
        }
    }
    Ok(())
}

/// Draws the wishes for a bench, with a total length of logs within the limit.
fn wishes(spec: &PopulationSpec, random: &mut ChaCha8Rng) -> BenchWishes {
    let ([fewest, most], [shortest, longest]) = (spec.logs, spec.log_s);
    let room = (spec.longest_s / shortest) as usize;
    let logs = random.random_range(fewest..=most.min(room).max(fewest));
    let longest = longest.min(spec.longest_s / logs as f64).max(shortest);
    BenchWishes {
        classes: spec.arms.clone(),
        motions: spec.motions.clone(),
        logs: [logs, logs],
        log_s: [shortest, longest],
        instruments: spec.instruments.clone(),
    }
}

/// How well the nominal model of a trial describes its arm.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Model {
    /// Bodies, rotors and friction are the arm's.
    Right,
    /// Bodies err by a few per cent, friction is absent, roughly known or a dummy value.
    AsModelsAre,
}

/// A trial before it is simulated.
struct Draft {
    bench: LabBench,
    faults: FieldFaults,
    log: LogDraw,
    seed: u64,
    truth: Loaded,
    truth_file: PathBuf,
    nominal: Loaded,
    nominal_files: RobotFiles,
    friction: Vec<Friction>,
}

impl Draft {
    fn new(
        (bench, faults, log): (LabBench, FieldFaults, LogDraw),
        model: Model,
        folder: &Path,
        seed: u64,
        random: &mut ChaCha8Rng,
    ) -> Result<Self, PopulationError> {
        let in_folder = |name: &str, files: &RobotFiles| {
            let folder = folder.join(name);
            std::fs::create_dir_all(&folder).map_err(PopulationError::of_folder(&folder))?;
            let file = files.write(&folder)?;
            Ok::<_, PopulationError>((Robot::load(&file)?, file))
        };
        let (truth, truth_file) = in_folder("truth", &bench.truth)?;
        let friction = faults.friction(draw_friction(&truth.robot, &bench.friction, random));
        let known = match model {
            _ if bench.sensors.effort == EffortSource::Link => NominalKnowledge::BodiesAlone,
            Model::Right => NominalKnowledge::Exactly,
            Model::AsModelsAre
                if random.random_bool(ROUGHLY_KNOWN) && !faults.states_friction() =>
            {
                NominalKnowledge::Roughly
            }
            Model::AsModelsAre => NominalKnowledge::AsDescribed,
        };
        let files = match model {
            Model::Right => &bench.truth,
            Model::AsModelsAre => &bench.nominal,
        };
        let (loaded, _) = in_folder("nominal", files)?;
        let nominal_files = describe(files, &loaded, &friction, known, random)?;
        let (nominal, _) = in_folder("nominal", &nominal_files)?;
        Ok(Self { bench, faults, log, seed, truth, truth_file, nominal, nominal_files, friction })
    }

    fn friction(&self) -> Vec<EffectSpec> {
        effects(&self.truth.robot, &self.friction)
    }

    fn period_ms(&self) -> f64 {
        1e3 / self.bench.control.rate_hz.or(self.truth.control.rate_hz).unwrap_or(500.0)
    }

    /// Step of the encoder of each joint, or its noise where that is larger.
    fn encoder_steps(&self) -> Vec<f64> {
        let sensors = &self.bench.sensors;
        let of = |name: &str| {
            let step = sensors.position_resolution_rad.get(name).copied().unwrap_or(0.0);
            step.max(sensors.position_noise_rad.get(name).copied().unwrap_or(0.0)).max(1e-7)
        };
        self.truth.robot.joint_names().map(of).collect()
    }

    fn scenario(&self, step_ms: f64, hidden: &HiddenThings) -> Result<Scenario, PopulationError> {
        let held_out = RunSpec { name: HELD_OUT.to_owned(), ..self.bench.held_out.clone() };
        let spec = ScenarioSpec {
            robot: self.truth_file.clone(),
            seed: self.seed >> 1,
            engine: EngineSpec { step_ms, joint_stops: false, order: StepOrder::Second },
            control: self.bench.control.clone(),
            sensors: self.log.sensors(&self.bench.sensors),
            effect: [self.friction(), hidden.causes.clone()].concat(),
            stranger: hidden.strangers.clone(),
            hidden: None,
            run: self.bench.runs.iter().cloned().chain([held_out]).collect(),
        };
        scenario_of(&spec)
    }

    /// Longest simulation step for the logs that encoders and springs allow (ms).
    fn step_ms(&self, hidden: &HiddenThings) -> Result<f64, PopulationError> {
        let with_step = |step| self.scenario(step, hidden);
        let effects = [self.friction(), hidden.causes.clone()].concat();
        step_ms(&with_step, &effects, self.period_ms(), &self.encoder_steps())
    }

    /// Simulation step for sizing causes (ms).
    fn coarse_ms(&self) -> f64 {
        whole_step_ms(self.period_ms(), COARSE_MS)
    }

    /// Draws the hidden causes, with sizes around the threshold of visibility.
    fn hide(
        &self,
        causes: usize,
        strangers: usize,
        random: &mut ChaCha8Rng,
    ) -> Result<HiddenThings, PopulationError> {
        if causes == 0 && strangers == 0 {
            return Ok(HiddenThings::default());
        }
        let scenario = self.scenario(self.coarse_ms(), &HiddenThings::default())?;
        let scenario = in_steps_of(&scenario, self.coarse_ms())?;
        let friction = self.friction();
        let pilot = Pilot::new(&scenario, &friction);
        Ok(HiddenThings::draw(&pilot, self.bench.class, causes, strangers, random))
    }

    /// Simulates the runs and writes all files.
    fn make_logs(
        &self,
        step: f64,
        hidden: &HiddenThings,
        damage: Option<LogDamage>,
        folder: &Path,
    ) -> Result<TruthSheet, PopulationError> {
        let scenario = self.scenario(step, hidden)?;
        let mut noisy = simulate_only(&scenario, &|name| name != HELD_OUT, &|| {})?;
        in_range(&self.truth.robot, &noisy.runs)?;
        let (nominal, friction) = (&self.nominal.robot, &self.friction[..]);
        let beside = |runs: &[SeenRun]| {
            self.faults.differences(&self.truth.robot, nominal, runs).collect::<Vec<_>>()
        };
        let seen =
            Truths { scenario: &scenario, nominal, friction, hidden, beside: &beside }.weigh()?;
        let effects = [self.friction(), hidden.causes.clone()].concat();
        let held_out =
            simulate_noise_free(&scenario, &|name| name == HELD_OUT, &effects, &hidden.strangers)?;
        let Seen { runs, noise, clean, scales, mut causes, mut strangers } = seen;
        let known = (&noise[..], &scales[..]);
        causes
            .extend(self.log.servo.and_then(|servo| servo.late_goals(&self.truth, &clean, known)));
        let robot = &self.truth.robot;
        strangers.extend(damage.iter().map(|d| d.true_stranger(robot, &clean, &scales)));
        strangers.extend(self.faults.strangers(&self.truth.robot, &runs, &scales));
        self.faults.spoil(&mut noisy.runs);
        let corner = self.corner(&noisy.runs, damage.as_ref());
        let logs = self.change_logs([noisy.runs, held_out], damage.as_ref(), folder)?;
        let joints = self.truth.robot.joint_names().map(str::to_owned).collect();
        let sheet = TruthSheet {
            seed: self.seed,
            corner,
            knowledge: Knowledge::Whole,
            joints,
            torque_rms: scales,
            causes,
            strangers,
        };
        for (name, runs) in ["logs", HELD_OUT].iter().zip(&logs) {
            write_runs(&folder.join(name), runs)?;
        }
        write_text(&folder.join("truth").join("scenario.toml"), &self.portable(&scenario))?;
        sheet.write(folder)?;
        Ok(sheet)
    }

    /// The logs and the held-out log as they are written: spoilt, as their description may be, and with their rows.
    fn change_logs(
        &self,
        [mut runs, mut held_out]: [Vec<Run>; 2],
        damage: Option<&LogDamage>,
        folder: &Path,
    ) -> Result<[Vec<Run>; 2], PopulationError> {
        let robot = &self.truth.robot;
        if let Some(damage) = damage {
            damage.spoil(robot, &mut runs);
            if let Some(files) = damage.describe(&self.nominal_files, &self.nominal, &runs)? {
                files.write(&folder.join("nominal"))?;
            }
        }
        if let Some(repetition) = self.log.repetition(robot) {
            repetition.spoil(robot, &mut runs);
        }
        let Some(servo) = &self.log.servo else { return Ok([runs, held_out]) };
        servo.follow(&mut held_out);
        Ok([runs, held_out].map(|runs| runs.into_iter().map(without_efforts).collect()))
    }

    /// The scenario with a path to the robot beside it, so that the folder can be moved.
    fn portable(&self, scenario: &Scenario) -> String {
        let file = self.truth_file.canonicalize().unwrap_or(self.truth_file.clone());
        scenario.self_contained_text().replace(&file.display().to_string(), "robot.toml")
    }

    fn corner(&self, runs: &[Run], damage: Option<&LogDamage>) -> Corner {
        let length = |run: &Run| run.time.last().unwrap_or(&0.0) - run.time.first().unwrap_or(&0.0);
        let sensors = self.log.sensors(&self.bench.sensors);
        let steps = sensors.position_resolution_rad.values();
        Corner {
            origin: Origin::Simulated,
            arm: self.bench.class.name().to_owned(),
            motion: self.bench.motion,
            effort: self.bench.effort,
            joints: self.truth.robot.joint_count(),
            encoder_step: steps.copied().fold(0.0, f64::max),
            rate_hz: sensors.log_rate_hz.unwrap_or(1e3 / self.period_ms()),
            logs: runs.len(),
            length_s: runs.iter().map(length).sum(),
            repeats: self.bench.repeats,
            field: self.faults.features.clone(),
            log_kinds: self.log.kinds(damage),
            goal_delay_ms: self.log.servo.map(|servo| servo.delay_ms),
        }
    }
}

pub(crate) fn write_runs(folder: &Path, runs: &[Run]) -> Result<(), PopulationError> {
    std::fs::create_dir_all(folder).map_err(PopulationError::of_folder(folder))?;
    for run in runs {
        logs::write_parquet(&folder.join(format!("{}.parquet", run.name)), run)?;
    }
    Ok(())
}
