mod cause;
mod diagnosis_file;
mod error;
mod files;

use std::path::PathBuf;

use logs::{PrepareSettings, Prepared, centre_commands, prepare};
use next_motion::{Goal, Question, Settings};
use report::ReportError;
use robot::{Loaded, Robot};

use self::diagnosis_file::DiagnosisFile;
pub use self::error::DesignError;
use crate::Outcome;
use crate::error::CliError;
use crate::input::{ColumnArguments, positive};
use crate::output::print;
use crate::progress::Line;

/// Arguments of `design`.
#[derive(Debug, clap::Args)]
pub struct Arguments {
    /// The robot that was diagnosed: a robot.urdf, or a robot.toml that names one
    #[arg(long, value_name = "FILE")]
    robot: PathBuf,
    /// The diagnosis: its folder or its diagnosis.json
    #[arg(long, value_name = "DIR")]
    diagnosis: PathBuf,
    /// The logs that were diagnosed; those that the diagnosis names when left out
    #[arg(long = "log", value_name = "FILE", num_args = 1..)]
    logs: Vec<PathBuf>,
    #[command(flatten)]
    columns: ColumnArguments,
    /// A cause to tell from that of --from instead of what the diagnosis left open, such as
    /// FR01@elbow or payload@hand
    #[arg(long, value_name = "EFFECT@PLACE", requires = "from")]
    separate: Option<String>,
    /// The cause to tell it from
    #[arg(long, value_name = "EFFECT@PLACE", requires = "separate")]
    from: Option<String>,
    /// Length of the motion
    #[arg(long, value_name = "S", default_value_t = Settings::default().duration_s, value_parser = positive, allow_negative_numbers = true)]
    duration_s: f64,
    /// Seed of every random draw
    #[arg(long, default_value_t = Settings::default().seed)]
    seed: u64,
    /// Folder for the motion
    #[arg(long, value_name = "DIR")]
    out: PathBuf,
    /// Print nothing but errors
    #[arg(long)]
    quiet: bool,
}

/// Searches the motion that settles what a diagnosis left open, and writes it.
pub fn run(arguments: &Arguments) -> Result<Outcome, CliError> {
    if arguments.out.exists() && !arguments.out.is_dir() {
        return Err(ReportError::NotAFolder { path: arguments.out.clone() }.into());
    }
    let loaded = Robot::load(&arguments.robot)?;
    let robot = &loaded.robot;
    let diagnosis = DiagnosisFile::read(&arguments.diagnosis, robot)?;
    let question = Question {
        robot,
        goals: goals(arguments, &diagnosis, robot)?,
        findings: diagnosis.findings(robot)?,
        noise: diagnosis.noise(),
        cutoff_hz: diagnosis.cutoff_hz(),
    };
    let logs = prepared(arguments, &diagnosis, &loaded)?;
    let settings = Settings { duration_s: arguments.duration_s, seed: arguments.seed };
    let line = Line::new();
    if !arguments.quiet {
        line.say("searching a motion");
    }
    let design = next_motion::design(&question, &logs, &settings);
    line.finish();
    let design = design.map_err(DesignError::from)?;
    let useful = design.prospects.iter().any(|p| p.runs().is_some());
    let text = files::words(&design, &question, &logs);
    let Some(motion) = design.motion.as_ref().filter(|_| useful) else {
        if !arguments.quiet {
            print(&text)?;
        }
        return Ok(Outcome::Gap);
    };
    let written = files::write(arguments, &text, &question, motion, rate_hz(&logs))?;
    if !arguments.quiet {
        print(&format!("{text}{written}"))?;
    }
    Ok(Outcome::Good)
}

/// What the motion is wanted for.
fn goals(
    arguments: &Arguments,
    diagnosis: &DiagnosisFile,
    robot: &Robot,
) -> Result<Vec<Goal>, CliError> {
    if let (Some(one), Some(other)) = (&arguments.separate, &arguments.from) {
        let [finding, rival] = [cause::typed(one, robot)?, cause::typed(other, robot)?];
        return Ok(vec![Goal::Separate { finding, rival }]);
    }
    let goals = diagnosis.goals(robot)?;
    if goals.is_empty() {
        return Err(DesignError::NothingOpen { path: arguments.diagnosis.clone() }.into());
    }
    Ok(goals)
}

/// The logs that were diagnosed, prepared as they were then.
fn prepared(
    arguments: &Arguments,
    diagnosis: &DiagnosisFile,
    loaded: &Loaded,
) -> Result<Prepared, CliError> {
    let named = diagnosis.logs();
    let paths = if arguments.logs.is_empty() { &named } else { &arguments.logs };
    let runs = arguments.columns.read_runs(paths, &loaded.robot)?;
    if let Some(other) = runs.iter().find(|run| !diagnosis.knows(&run.sha256)) {
        return Err(DesignError::OtherLog { path: other.source.clone() }.into());
    }
    let settings = PrepareSettings { cutoff_hz: Some(diagnosis.cutoff_hz()) };
    let mut prepared = prepare(&runs, &settings)?;
    centre_commands(&loaded.robot, &mut prepared.runs, loaded.control.rate_hz);
    Ok(prepared)
}

/// Rate of the logs (Hz), at which the motion is written too.
fn rate_hz(logs: &Prepared) -> f64 {
    logs.runs.iter().map(|run| run.rate_hz).fold(0.0, f64::max)
}
