mod excitation;
mod guess;
mod path;
mod quote;
mod text;

use std::path::PathBuf;

use document::Document;
use robot::Loaded;
use simulator::scenario::Scenario;

use self::excitation::Excitation;
use self::guess::{DriveGuess, drives};
use crate::error::CliError;
use crate::exit_status::ExitStatus;
use crate::input::PartArguments;
use crate::messages::warn;
use crate::output::{create_folder, display_path, print, table};

/// Rate of a control loop that the robot does not say (Hz), as the simulator has it.
const RATE_HZ: f64 = 500.0;

/// Length of the trial (s): an arm that runs away does so in its first seconds.
const TRIAL_S: f64 = 4.0;

/// Arguments of `robot init`.
#[derive(Debug, clap::Args)]
pub struct Arguments {
    /// A URDF or an MJCF
    file: PathBuf,
    #[command(flatten)]
    part: PartArguments,
    /// Folder for robot.toml and scenario.toml
    #[arg(long, value_name = "DIR")]
    out: PathBuf,
    /// Write over a robot.toml that is there
    #[arg(long)]
    force: bool,
}

/// Writes a robot.toml with what the file cannot say, guessed, and a scenario that moves the robot.
pub fn run(arguments: &Arguments) -> Result<ExitStatus, CliError> {
    let loaded = arguments.part.load(&arguments.file)?;
    let toml = arguments.out.join("robot.toml");
    if toml.exists() && !arguments.force {
        return Err(CliError::Exists { path: toml });
    }
    create_folder(&arguments.out)?;
    loaded.warnings.iter().for_each(|warning| warn(warning));
    let rate_hz = loaded.control.rate_hz.unwrap_or(RATE_HZ);
    let drives = drives(&loaded.robot, &loaded.control.gains, rate_hz);
    let driven = guess::with_rotors(&loaded.robot, &drives);
    let excitation = Excitation::within_limits(&driven);
    if !excitation.fits {
        warn(&"the limits of effort leave no room for the motion: its weight alone may reach them");
    }
    let model = path::relative_to(&arguments.out, &loaded.urdf_path);
    let described = text::robot_toml(&loaded, &model, &drives, rate_hz);
    let scenario = text::scenario_toml(&driven, &excitation);
    let files = [("robot.toml", described.as_bytes()), ("scenario.toml", scenario.as_bytes())];
    report::write_folder(&arguments.out, &files)?;
    try_out(arguments)?;
    print(&summary(arguments, &loaded, &drives))?;
    Ok(ExitStatus::Good)
}

/// Reads both files as `simulate` does and moves the arm for a few seconds; an arm that runs away is
/// a warning, as its files are there to be changed.
fn try_out(arguments: &Arguments) -> Result<(), CliError> {
    let scenario = Scenario::from_document(&Document::read(arguments.out.join("scenario.toml"))?)?;
    if let Err(error) = simulator::simulate_noise_free_start(&scenario, &[], TRIAL_S) {
        warn(&format!("the scenario does not run yet: {error}; other gains or rotors may help"));
    }
    Ok(())
}

fn summary(arguments: &Arguments, loaded: &Loaded, drives: &[DriveGuess]) -> String {
    let rows = loaded.robot.joint_names().zip(drives).map(|(name, drive)| {
        let short = |value| report::significant(value, 3);
        vec![name.to_owned(), short(drive.rotor), short(drive.gain.kp), short(drive.gain.kd)]
    });
    let header = ["joint", ">rotor (kg·m²)", ">kp (N·m/rad)", ">kd (N·m·s/rad)"];
    let at = |name: &str| display_path(&arguments.out.join(name));
    format!(
        "{}\n{}: replace what is called a guess in it\nplumbline simulate {} --out out\n",
        table(&header, rows),
        at("robot.toml"),
        at("scenario.toml")
    )
}
