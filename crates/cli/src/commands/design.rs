mod cause;
pub(crate) mod diagnosis_file;
mod files;
pub(crate) mod motion_design;

use std::path::PathBuf;

use logs::Run;
use next_motion::DesignSettings;
use robot::Loaded;

use self::diagnosis_file::DiagnosisFile;
use self::motion_design::{DesignSummary, MotionDesign, MotionRequest};
use crate::columns::LogArguments;
use crate::design_error::DesignError;
use crate::diagnosed_input::DiagnosedInput;
use crate::error::CliError;
use crate::exit_status::ExitStatus;
use crate::input::{PartArguments, positive};
use crate::output::{print, print_json, refuse_file};
use crate::progress::Line;

/// Arguments of `design`.
#[derive(Debug, clap::Args)]
pub struct Arguments {
    /// The robot: a robot.urdf, an MJCF, or a robot.toml that names one; the one that was diagnosed when left out
    #[arg(long, value_name = "FILE")]
    robot: Option<PathBuf>,
    #[command(flatten)]
    part: PartArguments,
    /// The diagnosis: its folder or its diagnosis.json
    #[arg(long, value_name = "DIR", required_unless_present = "separate")]
    diagnosis: Option<PathBuf>,
    /// The logs that were diagnosed; those that the diagnosis names when left out
    #[arg(long = "log", value_name = "FILE", num_args = 1.., requires = "diagnosis")]
    logs: Vec<PathBuf>,
    #[command(flatten)]
    reading: LogArguments,
    /// A cause to tell from that of --from, such as FR01@elbow or payload@hand, instead of what
    /// the diagnosis left open; also before there is a diagnosis
    #[arg(long, value_name = "EFFECT@PLACE", requires = "from")]
    separate: Option<String>,
    /// The cause to tell it from
    #[arg(long, value_name = "EFFECT@PLACE", requires = "separate")]
    from: Option<String>,
    /// Length of the motion
    #[arg(long, value_name = "S", default_value_t = DesignSettings::default().duration_s, value_parser = positive, allow_negative_numbers = true)]
    duration_s: f64,
    /// Seed of every random draw
    #[arg(long, default_value_t = DesignSettings::default().seed)]
    seed: u64,
    /// Folder for the motion
    #[arg(long, value_name = "DIR", default_value = "out/design")]
    out: PathBuf,
    /// Print JSON instead of the text
    #[arg(long)]
    json: bool,
    /// Print nothing but errors, and the JSON if it is asked for
    #[arg(long)]
    quiet: bool,
}

/// Searches the motion that settles what a diagnosis left open, and writes it.
pub fn run(arguments: &Arguments) -> Result<ExitStatus, CliError> {
    refuse_file(&arguments.out)?;
    let input = arguments.diagnosis.as_deref().map(DiagnosedInput::read).transpose()?;
    let robot_file = robot_file(arguments, input.as_ref())?;
    let part = input.as_ref().map(|input| input.part(&arguments.part));
    let loaded = part.as_ref().unwrap_or(&arguments.part).load(&robot_file)?;
    let read = |(path, input): (&PathBuf, &DiagnosedInput)| {
        let diagnosis = DiagnosisFile::read(path, &loaded.robot)?;
        let runs = read_diagnosed_runs(arguments, &diagnosis, input, &loaded)?;
        Ok::<_, CliError>((diagnosis, runs))
    };
    let diagnosed = arguments.diagnosis.as_ref().zip(input.as_ref()).map(read).transpose()?;
    let request = MotionRequest {
        loaded: &loaded,
        diagnosed: diagnosed.as_ref().map(|(diagnosis, runs)| (diagnosis, runs.as_slice())),
        separate: arguments.separate.as_deref().zip(arguments.from.as_deref()).map(<[_; 2]>::from),
        settings: DesignSettings { duration_s: arguments.duration_s, seed: arguments.seed },
    };
    let line = Line::new();
    if !arguments.quiet {
        line.say("searching a motion");
    }
    let motion_design = MotionDesign::new(&request);
    line.finish();
    let motion_design = match motion_design {
        Err(CliError::Design(nothing @ DesignError::NothingOpen { .. })) => {
            say(arguments, &DesignSummary::default(), || format!("{nothing}\n"))?;
            return Ok(ExitStatus::Good);
        }
        motion_design => motion_design?,
    };
    let written = motion_design.write(&arguments.out, &robot_file)?;
    let summary = motion_design.summary(written.as_ref().map(|_| arguments.out.as_path()));
    say(arguments, &summary, || {
        format!("{}{}", motion_design.text(), written.as_deref().unwrap_or_default())
    })?;
    Ok(if written.is_some() { ExitStatus::Good } else { ExitStatus::Gap })
}

/// Text or JSON on the standard output.
fn say(
    arguments: &Arguments,
    summary: &DesignSummary,
    text: impl FnOnce() -> String,
) -> Result<(), CliError> {
    match (arguments.json, arguments.quiet) {
        (true, _) => print_json(summary),
        (false, true) => Ok(()),
        (false, false) => print(&text()),
    }
}

/// The robot of the command line, or the one that was diagnosed.
fn robot_file(arguments: &Arguments, input: Option<&DiagnosedInput>) -> Result<PathBuf, CliError> {
    match (&arguments.robot, input) {
        (Some(file), _) => Ok(file.clone()),
        (None, Some(input)) => Ok(input.robot()?),
        (None, None) => Err(CliError::NoRobot),
    }
}

/// The logs that were diagnosed, read as they were then.
fn read_diagnosed_runs(
    arguments: &Arguments,
    diagnosis: &DiagnosisFile,
    input: &DiagnosedInput,
    loaded: &Loaded,
) -> Result<Vec<Run>, CliError> {
    let paths = if arguments.logs.is_empty() { input.logs()? } else { arguments.logs.clone() };
    let runs = input.reading(&arguments.reading)?.read_runs(&paths, &loaded.robot)?;
    match runs.iter().find(|run| !diagnosis.knows(&run.sha256)) {
        Some(other) => Err(DesignError::OtherLog { path: other.source.clone() }.into()),
        None => Ok(runs),
    }
}
