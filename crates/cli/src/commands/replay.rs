use std::path::{Path, PathBuf};

use logs::{LogError, LogWarning, PrepareSettings, Prepared, PreparedRun};
use report::{Provenance, ReplayReport, ReplayedRun, ReplayedTorque, ReplayedWindow};
use robot::{Loaded, PdGain, Robot};
use simulator::{ForwardReplay, MotionReplay, SimulatorError, Windows};

use crate::columns::LogArguments;
use crate::commands::run::run_folder::EXTENDED;
use crate::diagnosed_input::DiagnosedInput;
use crate::error::CliError;
use crate::exit_status::ExitStatus;
use crate::input::{PartArguments, hashes_of, positive, provenance};
use crate::input_warnings::correct_runs;
use crate::output::{create_folder, display_path, print_answer, table};
use crate::quiet::Quiet;

/// Arguments of `replay`.
#[derive(Debug, clap::Args)]
pub struct Arguments {
    /// The robot whose simulation is looked at: a robot.urdf, an MJCF, or a robot.toml that names one
    #[arg(long, value_name = "FILE")]
    robot: Option<PathBuf>,
    /// A diagnosis, its folder or its diagnosis.json: its extended robot is looked at and its logs are read, where
    /// --robot and --log say nothing else
    #[arg(long, value_name = "DIR")]
    diagnosis: Option<PathBuf>,
    #[command(flatten)]
    part: PartArguments,
    /// Logs (CSV, Parquet, NumPy, MATLAB, HDF5, bags of ROS 2), one run each
    #[arg(long = "log", value_name = "FILE", required_unless_present = "diagnosis", num_args = 1..)]
    logs: Vec<PathBuf>,
    /// Folder for report.html, replay.json and the simulated motion and torque of every run
    #[arg(long, value_name = "DIR", default_value = "out/replay")]
    out: PathBuf,
    /// Lengths of time that the simulation is rolled forward, with commas between them
    #[arg(long, value_name = "MS", value_delimiter = ',', default_values_t = [50.0, 200.0, 1000.0], value_parser = positive, allow_negative_numbers = true)]
    window_ms: Vec<f64>,
    #[command(flatten)]
    reading: LogArguments,
    /// Print replay.json instead of the tables
    #[arg(long)]
    json: bool,
    /// Print nothing but errors, and the JSON if it is asked for
    #[arg(long)]
    quiet: bool,
}

/// Rolls the simulation forward under recorded torque, lets it follow the recorded motion, and
/// says how far both are from the record.
pub fn run(arguments: &Arguments) -> Result<ExitStatus, CliError> {
    let diagnosed = arguments.diagnosis.as_deref().map(DiagnosedInput::read).transpose()?;
    let robot_file = robot_file(arguments, diagnosed.as_ref())?;
    let loaded = arguments.part.load(&robot_file)?;
    let (paths, reading) = logs_of(arguments, diagnosed.as_ref())?;
    let given = reading.read_runs(&paths, &loaded.robot)?;
    let read = correct_runs(&loaded, &given);
    let prepared = logs::prepare(read.as_ref().unwrap_or(&given), &PrepareSettings::default())?;
    create_folder(&arguments.out)?;
    let mut provenance = provenance(&robot_file, &loaded, reading.map_file())?;
    provenance.files.extend(hashes_of(&given));
    let replays = Replays::new(&loaded, prepared, &arguments.window_ms, provenance, &|| ())?;
    replays.write(&arguments.out)?;
    let json = arguments.json.then(|| replays.report.json()).transpose()?;
    print_answer(Quiet(arguments.quiet), json.as_deref(), || replays.text(), &closing(arguments))?;
    Ok(ExitStatus::Good)
}

/// The robot of the command line, or the one that a diagnosis extended.
fn robot_file(
    arguments: &Arguments,
    diagnosed: Option<&DiagnosedInput>,
) -> Result<PathBuf, CliError> {
    match (&arguments.robot, diagnosed) {
        (Some(file), _) => Ok(file.clone()),
        (None, Some(input)) => Ok(input.folder().join(EXTENDED)),
        (None, None) => Err(CliError::NoRobot),
    }
}

/// The logs of the command line, or those that were diagnosed, and how they are read.
fn logs_of(
    arguments: &Arguments,
    diagnosed: Option<&DiagnosedInput>,
) -> Result<(Vec<PathBuf>, LogArguments), CliError> {
    let (own, reading) = (&arguments.logs, &arguments.reading);
    Ok(match diagnosed {
        None => (own.clone(), reading.clone()),
        Some(input) if own.is_empty() => (input.logs()?, input.reading(reading)?),
        Some(input) => (own.clone(), input.columns(reading)?),
    })
}

/// The simulation of a robot beside recorded runs.
pub struct Replays {
    /// What the page and `replay.json` tell.
    pub report: ReplayReport,
    robot: Robot,
    /// Each by the name of its files, with its record.
    runs: Vec<(String, PreparedRun, Replay)>,
}

impl Replays {
    /// Replays runs, rolled forward over each of some lengths of time; `begin` is called before each run.
    ///
    /// # Errors
    ///
    /// [`CliError`] for a robot that cannot be simulated, or a length that a run does not have.
    pub fn new(
        loaded: &Loaded,
        prepared: Prepared,
        windows_ms: &[f64],
        provenance: Provenance,
        begin: &dyn Fn(),
    ) -> Result<Self, CliError> {
        let warnings = clock_warnings(&prepared).map(ToString::to_string).collect();
        let mut runs: Vec<(String, PreparedRun, Replay)> = Vec::new();
        for record in prepared.runs {
            begin();
            let namesakes = runs.iter().filter(|(_, other, _)| other.name == record.name).count();
            let ending = if namesakes == 0 { String::new() } else { format!("_{}", namesakes + 1) };
            let name = record.name.replace(' ', "_") + &ending;
            let replay = Replay::new(windows_ms, loaded, &record)?;
            runs.push((name, record, replay));
        }
        let summary = |(name, record, replay): &(String, PreparedRun, Replay)| {
            replay.summary(&loaded.robot, name.clone(), record)
        };
        let report = ReplayReport {
            robot: loaded.robot.name().to_owned(),
            joints: loaded.robot.joint_names().map(str::to_owned).collect(),
            runs: runs.iter().map(summary).collect(),
            warnings,
            provenance,
        };
        Ok(Self { report, robot: loaded.robot.clone(), runs })
    }

    /// Writes the page, `replay.json`, and the simulated motion and torque of every run into a folder that is there.
    ///
    /// # Errors
    ///
    /// [`CliError`] for a file that cannot be written.
    pub fn write(&self, folder: &Path) -> Result<(), CliError> {
        self.runs.iter().try_for_each(|(name, _, replay)| replay.write(folder, name))?;
        let (page, json) = (self.report.page()?, self.report.json()?);
        let files = [("report.html", page.as_bytes()), ("replay.json", json.as_bytes())];
        Ok(report::write_folder(folder, &files)?)
    }

    /// A table of every run, what its columns mean, and what was done to the clocks of the logs.
    pub fn text(&self) -> String {
        let runs = self.report.runs.iter().zip(&self.runs);
        let mut text: String =
            runs.map(|(run, (_, _, replay))| text(&self.robot, run, replay)).collect();
        text.push_str(COLUMNS);
        self.report.warnings.iter().for_each(|w| text.push_str(&format!("warning: {w}\n")));
        text
    }
}

/// What was simulated of one record.
struct Replay {
    forward: Vec<ForwardReplay>,
    /// Where the robot has gains to follow a motion with.
    motion: Option<MotionReplay>,
}

impl Replay {
    fn new(
        windows_ms: &[f64],
        loaded: &Loaded,
        record: &PreparedRun,
    ) -> Result<Self, SimulatorError> {
        let robot = &loaded.robot;
        let windows = windows_ms.iter();
        let forward =
            windows.map(|ms| simulator::replay_torque(robot, record, Windows::of(1e-3 * ms)));
        let forward = forward.collect::<Result<_, _>>()?;
        let gains: Option<Vec<PdGain>> = loaded.control.gains.iter().copied().collect();
        let gains = gains.filter(|g| g.len() == robot.joint_count());
        let motion = gains.map(|gains| simulator::replay_motion(robot, &gains, record));
        Ok(Self { forward, motion: motion.transpose()? })
    }

    /// What a page tells of it.
    fn summary(&self, robot: &Robot, name: String, record: &PreparedRun) -> ReplayedRun {
        let window = |f: &ForwardReplay| ReplayedWindow {
            window_ms: (1e6 * f.window_s).round() / 1e3,
            drift_rms: f.drift_rms.clone(),
            tip_rms_m: experiment::tip_drift_rms_m(robot, record, f),
        };
        let torque = self.motion.as_ref().map(|motion| ReplayedTorque {
            error_rms_nm: motion.torque_error_rms.clone(),
            measured_rms_nm: measured_rms(record),
        });
        let ran_away = self.forward.iter().filter_map(|f| Some((f, f.runaways.first()?)));
        let remarks = ran_away.map(|(f, first)| {
            format!(
                "A joint ran away in {} of {} windows of {} ms, which are left out; the first: {first}",
                f.runaways.len(),
                f.starts.len(),
                milliseconds(f)
            )
        });
        ReplayedRun {
            name,
            windows: self.forward.iter().map(window).collect(),
            torque,
            remarks: remarks.collect(),
        }
    }

    fn write(&self, folder: &Path, name: &str) -> Result<(), LogError> {
        for forward in &self.forward {
            let window_ms = milliseconds(forward);
            let file = folder.join(format!("{name}_forward_{window_ms}ms.parquet"));
            logs::write_parquet(&file, &forward.motion)?;
        }
        match &self.motion {
            Some(motion) => {
                logs::write_parquet(&folder.join(format!("{name}_motion.parquet")), &motion.log)
            }
            None => Ok(()),
        }
    }
}

/// Length of the windows (ms), which is a whole number of samples.
fn milliseconds(forward: &ForwardReplay) -> String {
    ((1e6 * forward.window_s).round() / 1e3).to_string()
}

const NO_GAINS: &str =
    " no torque along the measured motion: that takes kp_nm_per_rad and kd_nm_s_per_rad of every
 joint in a robot.toml
";

/// What was done to the clocks of the logs.
fn clock_warnings(prepared: &Prepared) -> impl Iterator<Item = &LogWarning> {
    use LogWarning as W;
    let of_rows = |w: &&W| {
        matches!(w, W::Mended { .. } | W::Thinned { .. } | W::Resampled { .. } | W::Split { .. })
    };
    prepared.warnings.iter().filter(of_rows)
}

/// What the columns mean.
const COLUMNS: &str =
    "ms      drift after so long under the measured torque: simulated minus measured position,
        RMS over all such windows of the log (mrad or mm); of the tip, the origin of the last
        link, the distance in mm
torque  simulated minus measured along the measured motion, RMS, beside the RMS of the
        measured (N·m or N)
";

/// Where the files are.
fn closing(arguments: &Arguments) -> String {
    format!(
        "report                      {} (open it in a browser)\nsimulated motion and torque {}\n",
        display_path(&arguments.out.join("report.html")),
        display_path(&arguments.out)
    )
}

/// RMS of the measured effort by joint (N m or N).
fn measured_rms(record: &PreparedRun) -> Vec<f64> {
    let rms = |effort: &[f64]| {
        let squares = effort.iter().map(|tau| tau * tau);
        (squares.sum::<f64>() / record.time.len() as f64).sqrt()
    };
    record.joints.iter().map(|joint| rms(&joint.effort)).collect()
}

/// What came of a run: a row a joint and one of the tip.
fn text(robot: &Robot, run: &ReplayedRun, replay: &Replay) -> String {
    let forward = &replay.forward;
    let mut header = vec!["joint".to_owned()];
    header.extend(forward.iter().map(|f| format!(">{} ms", milliseconds(f))));
    header.extend(run.torque.iter().flat_map(|_| [">torque".to_owned(), ">measured".to_owned()]));
    let or_none = |text: Option<String>| text.unwrap_or_else(|| "-".to_owned());
    let mut rows: Vec<Vec<String>> = Vec::new();
    for (j, joint) in robot.joint_names().enumerate() {
        let mut row = vec![joint.to_owned()];
        let drift =
            |w: &ReplayedWindow| w.drift_rms.as_ref().map(|d| report::significant(1e3 * d[j], 3));
        row.extend(run.windows.iter().map(|window| or_none(drift(window))));
        if let Some(torque) = &run.torque {
            row.push(report::significant(torque.error_rms_nm[j], 3));
            row.push(report::significant(torque.measured_rms_nm[j], 3));
        }
        rows.push(row);
    }
    let tip = |w: &ReplayedWindow| w.tip_rms_m.map(|m| report::significant(1e3 * m, 3));
    let tip = run.windows.iter().map(|window| or_none(tip(window)));
    rows.push(std::iter::once("tip (mm)".to_owned()).chain(tip).collect());
    let header: Vec<&str> = header.iter().map(String::as_str).collect();
    let mut text = format!("{}\n{}", run.name, table(&header, rows));
    if run.torque.is_none() {
        text.push_str(NO_GAINS);
    }
    for replay in forward.iter().filter(|f| !f.runaways.is_empty()) {
        text.push_str(&format!(
            " a joint ran away in {} of {} windows of {} ms, which are left out; the first:\n  {}\n",
            replay.runaways.len(),
            replay.starts.len(),
            milliseconds(replay),
            replay.runaways[0]
        ));
    }
    text + "\n"
}
