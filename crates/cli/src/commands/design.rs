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
use crate::columns::{ColumnArguments, LengthArguments};
use crate::error::CliError;
use crate::input::{PartArguments, positive};
use crate::output::print;
use crate::progress::Line;

/// Rate of a motion where neither log nor robot says one (Hz).
const RATE_HZ: f64 = 500.0;

/// Arguments of `design`.
#[derive(Debug, clap::Args)]
pub struct Arguments {
    /// The robot that was diagnosed: a robot.urdf, or a robot.toml that names one
    #[arg(long, value_name = "FILE")]
    robot: PathBuf,
    #[command(flatten)]
    part: PartArguments,
    /// The diagnosis: its folder or its diagnosis.json
    #[arg(long, value_name = "DIR", required_unless_present = "separate")]
    diagnosis: Option<PathBuf>,
    /// The logs that were diagnosed; those that the diagnosis names when left out
    #[arg(long = "log", value_name = "FILE", num_args = 1.., requires = "diagnosis")]
    logs: Vec<PathBuf>,
    #[command(flatten)]
    columns: ColumnArguments,
    #[command(flatten)]
    length: LengthArguments,
    /// A cause to tell from that of --from, such as FR01@elbow or payload@hand, instead of what
    /// the diagnosis left open; also before there is a diagnosis
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
    let loaded = arguments.part.load(&arguments.robot)?;
    let robot = &next_motion::sown(&loaded.robot);
    let asked = asked(arguments, robot)?;
    let (question, logs) = match &arguments.diagnosis {
        None => (Question::without_logs(robot, asked), None),
        Some(path) => {
            let diagnosis = DiagnosisFile::read(path, robot)?;
            let logs = prepared(arguments, &diagnosis, &loaded)?;
            let question = Question {
                robot,
                goals: if asked.is_empty() { diagnosis.goals(robot)? } else { asked },
                findings: diagnosis.findings(robot)?,
                noise: diagnosis.noise(),
                cutoff_hz: diagnosis.cutoff_hz(),
            };
            if question.goals.is_empty() {
                return Err(DesignError::NothingOpen { path: path.clone() }.into());
            }
            (question, Some(logs))
        }
    };
    let settings = Settings { duration_s: arguments.duration_s, seed: arguments.seed };
    let line = Line::new();
    if !arguments.quiet {
        line.say("searching a motion");
    }
    let design = next_motion::design(&question, logs.as_ref(), &settings);
    line.finish();
    let design = design.map_err(DesignError::from)?;
    let useful = design.prospects.iter().any(|p| p.runs().is_some());
    let text = files::words(&design, robot, logs.as_ref());
    let Some(motion) = design.motion.as_ref().filter(|_| useful) else {
        if !arguments.quiet {
            print(&text)?;
        }
        return Ok(Outcome::Gap);
    };
    let rate_hz = rate_hz(&loaded, logs.as_ref());
    let written = files::write(arguments, &text, robot, (motion, rate_hz))?;
    if !arguments.quiet {
        print(&format!("{text}{written}"))?;
    }
    Ok(Outcome::Good)
}

/// The pair that is asked for, if any.
fn asked(arguments: &Arguments, robot: &Robot) -> Result<Vec<Goal>, CliError> {
    let (Some(one), Some(other)) = (&arguments.separate, &arguments.from) else {
        return Ok(Vec::new());
    };
    let [finding, rival] = [cause::typed(one, robot)?, cause::typed(other, robot)?];
    Ok(vec![Goal::Separate { finding, rival }])
}

/// The logs that were diagnosed, prepared as they were then.
fn prepared(
    arguments: &Arguments,
    diagnosis: &DiagnosisFile,
    loaded: &Loaded,
) -> Result<Prepared, CliError> {
    let named = diagnosis.logs();
    let paths = if arguments.logs.is_empty() { &named } else { &arguments.logs };
    let runs = arguments.columns.read_runs(paths, &loaded.robot, arguments.length)?;
    if let Some(other) = runs.iter().find(|run| !diagnosis.knows(&run.sha256)) {
        return Err(DesignError::OtherLog { path: other.source.clone() }.into());
    }
    let settings = PrepareSettings { cutoff_hz: Some(diagnosis.cutoff_hz()) };
    let mut prepared = prepare(&runs, &settings)?;
    centre_commands(&loaded.robot, &mut prepared.runs, loaded.control.rate_hz);
    Ok(prepared)
}

/// Rate at which the motion is written (Hz): that of the logs, or else of the controller.
fn rate_hz(loaded: &Loaded, logs: Option<&Prepared>) -> f64 {
    let of_logs = logs.and_then(|l| l.runs.iter().map(|run| run.rate_hz).reduce(f64::max));
    of_logs.or(loaded.control.rate_hz).unwrap_or(RATE_HZ)
}
