use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::Path;
use std::time::{Duration, Instant};

use catalogue::EffectKind;
use diagnosis::{DiagnosisError, DiagnosisRun, Settings, Silent};
use experiment::{ExperimentError, robot_error};
use population::{Came, Origin, PopulationSpec, Remade, Store, TruthSheet};
use robot::{Loaded, Robot};

use crate::baselines::baseline::Baseline;
use crate::baselines::least_squares::least_squares;
use crate::disk_failure::is_of_the_disk;
use crate::error::BenchmarkError;
use crate::panel::answers::{Answers, Costs, HeldOut};
use crate::panel::judgement::Judgement;
use crate::panel::peak_memory::{peak_mb, restart_peak};
use crate::trial_folder::{HELD_OUT, LOGS, NOMINAL, read_runs};

/// A judged trial, and the entry of the store that had to be replaced for it.
#[derive(Debug, Clone, PartialEq)]
pub struct Judged {
    /// The judgement.
    pub judgement: Judgement,
    /// The entry of the store that was made again.
    pub remade: Option<Remade>,
}

/// Makes a trial of a population, diagnoses its logs through files, and only then opens its sheet.
///
/// ```text
/// task, seed --store or draw--> nominal/, logs/ --diagnose, least squares--> answers --\
///                          \--> held_out/ --errors of all models--> held out ------> Judgement
///                           \--> sheet.json ------------------------- opened last -/
/// ```
///
/// Simulated logs come from the store where there is one; all others are made in `folder`.
///
/// # Errors
///
/// [`BenchmarkError`] when the trial cannot be made, a file cannot be written or read, or the logs cannot be
/// diagnosed.
pub fn run(
    spec: &PopulationSpec,
    (task, seed): (usize, u64),
    folder: &Path,
    store: Option<&Store>,
) -> Result<Judged, BenchmarkError> {
    let start = Instant::now();
    let (folder, remade, made_s) = match (spec.origin(task), store) {
        (Origin::Simulated, Some(store)) => {
            let kept = store.trial(spec, seed)?;
            let seconds = if kept.came == Came::WasThere { 0.0 } else { seconds(start.elapsed()) };
            let remade = match kept.came {
                Came::Again(remade) => Some(remade),
                Came::WasThere | Came::Made => None,
            };
            (kept.folder, remade, seconds)
        }
        (origin, _) => {
            population::make_any(spec, origin, seed, folder)?;
            (folder.to_owned(), None, seconds(start.elapsed()))
        }
    };
    Ok(Judged { judgement: judge(&folder, &[], made_s)?, remade })
}

/// Judges a trial whose folder is made: nominal model, logs and, where there is one, a held-out log are read, the logs
/// are diagnosed without a look for some effects, and only then the sheet is opened. `logs_s` is the time that making
/// the logs took.
///
/// # Errors
///
/// [`BenchmarkError`] when a file cannot be read.
pub fn judge(
    folder: &Path,
    without: &[EffectKind],
    logs_s: f64,
) -> Result<Judgement, BenchmarkError> {
    let answers = answers(folder, without, logs_s)?;
    Ok(Judgement::new(&TruthSheet::open(folder)?, &answers))
}

/// The answers of diagnosis and plain least squares, from the nominal model and the logs alone.
fn answers(folder: &Path, without: &[EffectKind], logs_s: f64) -> Result<Answers, BenchmarkError> {
    let robot = nominal(folder)?;
    let rate_hz = robot.control.rate_hz;
    let held_out = match folder.join(HELD_OUT) {
        there if there.is_dir() => Some(read_runs(&there, &robot.robot)?),
        _ => None,
    };
    let error_of = |robot: &Robot| robot_error(robot, rate_hz, held_out.as_deref()?).ok();
    let nominal = error_of(&robot.robot);
    let given = match read_runs(&folder.join(LOGS), &robot.robot) {
        Ok(given) => given,
        Err(error) if is_of_the_disk(&error) => return Err(error),
        Err(BenchmarkError::Experiment(error)) => {
            let ExperimentError::Log(refusal) = &*error else { return Err((*error).into()) };
            // Logs that cannot be read are refused before anything is said of them. Where the folder lies is
            // no part of the answer.
            let why = refusal.to_string().replace(&format!("{}/", folder.display()), "");
            return Ok(answers_without_logs(why, nominal, logs_s));
        }
        Err(error) => return Err(error),
    };
    let without = without.to_vec();
    let settings = Settings { control_rate_hz: rate_hz, without, ..Settings::default() };
    restart_peak();
    let (diagnosed, diagnosis_s) =
        time(|| catch_panic(|| diagnosis::diagnose(&robot.robot, &given, &settings, &Silent)));
    let peak_memory_mb = peak_mb();
    let (plain, least_squares_s) = time(|| least_squares(&robot.robot, rate_hz, &given));
    let by_hand =
        |fitted: &Baseline| fitted.held_out_error(&robot.robot, rate_hz, held_out.as_deref()?).ok();
    // Who refuses the logs leaves the robot as it is.
    let extended = diagnosed.as_ref().map_or(&robot.robot, |outcome| &outcome.extended);
    Ok(Answers {
        held_out: HeldOut {
            nominal,
            extended: error_of(extended),
            least_squares: plain.as_ref().ok().and_then(by_hand),
        },
        least_squares: plain.map_or_else(|_| Vec::new(), |fitted| fitted.names),
        costs: Costs { logs_s, diagnosis_s, least_squares_s, peak_memory_mb },
        diagnosis: diagnosed.map(|outcome| outcome.diagnosis),
    })
}

/// The answer of a diagnosis, or in words why there is none. A panic counts as no answer.
fn catch_panic(
    diagnose: impl FnOnce() -> Result<DiagnosisRun, DiagnosisError>,
) -> Result<DiagnosisRun, String> {
    match catch_unwind(AssertUnwindSafe(diagnose)) {
        Ok(answer) => answer.map_err(|error| error.to_string()),
        Err(_) => Err("the program gave up".to_owned()),
    }
}

/// The answers to unreadable logs: no method names anything, and every robot stays as described.
fn answers_without_logs(why: String, nominal: Option<Vec<Option<f64>>>, logs_s: f64) -> Answers {
    Answers {
        diagnosis: Err(why),
        held_out: HeldOut { extended: nominal.clone(), least_squares: nominal.clone(), nominal },
        least_squares: Vec::new(),
        costs: Costs { logs_s, ..Costs::default() },
    }
}

/// The nominal model of a trial.
pub(crate) fn nominal(folder: &Path) -> Result<Loaded, BenchmarkError> {
    let files = ["robot.toml", "robot.urdf"].map(|name| folder.join(NOMINAL).join(name));
    let file = files.iter().find(|file| file.is_file()).unwrap_or(&files[0]);
    Ok(Robot::load(file)?)
}

fn time<T>(work: impl FnOnce() -> T) -> (T, f64) {
    let start = Instant::now();
    let result = work();
    (result, seconds(start.elapsed()))
}

fn seconds(time: Duration) -> f64 {
    time.as_secs_f64()
}
