mod excitation;
mod guess;
mod quote;
mod text;

use std::path::PathBuf;

use document::Document;
use robot::Loaded;
use schemars::{JsonSchema, Schema};
use serde::Serialize;
use simulator::scenario::Scenario;

use self::excitation::Excitation;
use self::guess::{DriveGuess, drives};
use crate::error::CliError;
use crate::exit_status::ExitStatus;
use crate::input::PartArguments;
use crate::messages::warn;
use crate::output::{create_folder, display_path, print, print_json, table};
use crate::path::relative_to;
use crate::schema_text::{scenario_schema, schema_text};

/// Rate of a control loop that the robot does not say (Hz), as the simulator has it.
const RATE_HZ: f64 = 500.0;

/// Length of the trial (s): an arm that runs away does so in its first seconds.
const TRIAL_S: f64 = 4.0;

/// Name and version of the schema of what `--json` prints.
const SCHEMA: &str = "plumbline.robot_init/1";

/// Arguments of `robot init`.
#[derive(Debug, clap::Args)]
pub struct Arguments {
    /// A URDF or an MJCF
    pub file: PathBuf,
    /// Its joints and meshes
    #[command(flatten)]
    pub part: PartArguments,
    /// Folder for robot.toml and scenario.toml, with the schemas that editors check them with
    #[arg(long, value_name = "DIR", default_value = "out/robot")]
    pub out: PathBuf,
    /// Write over a robot.toml that is there
    #[arg(long)]
    pub force: bool,
    /// Print JSON instead of the text
    #[arg(long)]
    pub json: bool,
}

/// The JSON schema of what `--json` prints.
pub fn schema() -> Schema {
    report::written_schema::<Begun<'static>>(SCHEMA, "Plumbline robot init")
}

/// What was guessed and written, as `--json` prints it.
#[derive(Serialize, JsonSchema)]
struct Begun<'a> {
    schema: &'static str,
    /// The robot.toml that was written.
    robot: String,
    /// The scenario that was written.
    scenario: String,
    /// What is guessed, one entry a joint, in the order of the robot.
    joints: Vec<Guess<'a>>,
}

/// What is guessed of a joint.
#[derive(Serialize, JsonSchema)]
struct Guess<'a> {
    name: &'a str,
    /// Inertia of the rotor, reflected to the joint.
    rotor_inertia_kg_m2: f64,
    /// Gain of the position.
    kp_nm_per_rad: f64,
    /// Gain of the velocity.
    kd_nm_s_per_rad: f64,
}

/// Writes the files of [`Arguments`] and prints what was guessed.
pub fn run(arguments: &Arguments) -> Result<ExitStatus, CliError> {
    let written = write(arguments)?;
    written.warnings.iter().for_each(|warning| warn(warning));
    let begun = Begun::new(arguments, &written.loaded, &written.drives);
    if arguments.json {
        print_json(&begun)?;
    } else {
        print(&begun.text())?;
    }
    Ok(ExitStatus::Good)
}

/// A robot whose first files are written.
pub struct InitialisedRobot {
    loaded: Loaded,
    drives: Vec<DriveGuess>,
    /// What its owner should know, in sentences.
    pub warnings: Vec<String>,
}

/// Writes a robot.toml with what the file cannot say, guessed, and a scenario that moves the robot.
///
/// # Errors
///
/// [`CliError::Exists`] for a robot.toml that is there, and those of a file that cannot be read or written.
pub fn write(arguments: &Arguments) -> Result<InitialisedRobot, CliError> {
    let loaded = arguments.part.load(&arguments.file)?;
    let toml = arguments.out.join("robot.toml");
    if toml.exists() && !arguments.force {
        return Err(CliError::Exists { path: toml });
    }
    create_folder(&arguments.out)?;
    let mut warnings: Vec<String> = loaded.warnings.iter().map(ToString::to_string).collect();
    let rate_hz = loaded.control.rate_hz.unwrap_or(RATE_HZ);
    let drives = drives(&loaded.robot, &loaded.control.gains, rate_hz);
    let driven = guess::with_rotors(&loaded.robot, &drives);
    let excitation = Excitation::within_limits(&driven);
    if !excitation.fits {
        let heavy =
            "the limits of effort leave no room for the motion: its weight alone may reach them";
        warnings.push(heavy.to_owned());
    }
    let model = relative_to(&arguments.out, &loaded.urdf_path);
    let described = text::robot_toml(&loaded, &model, &drives, rate_hz);
    let scenario = text::scenario_toml(&driven, &excitation);
    let [of_robot, of_scenario] =
        [schema_text(&robot::description_schema())?, schema_text(&scenario_schema())?];
    let files = [
        ("robot.toml", described.as_bytes()),
        ("scenario.toml", scenario.as_bytes()),
        (text::ROBOT_SCHEMA, of_robot.as_bytes()),
        (text::SCENARIO_SCHEMA, of_scenario.as_bytes()),
    ];
    report::write_folder(&arguments.out, &files)?;
    warnings.extend(try_out(arguments)?);
    Ok(InitialisedRobot { loaded, drives, warnings })
}

/// Reads both files as `simulate` does and moves the arm for a few seconds; an arm that runs away is
/// a warning, as its files are there to be changed.
fn try_out(arguments: &Arguments) -> Result<Option<String>, CliError> {
    let scenario = Scenario::from_document(&Document::read(arguments.out.join("scenario.toml"))?)?;
    let tried = simulator::simulate_noise_free_start(&scenario, &[], TRIAL_S);
    let fails =
        |error| format!("the scenario does not run yet: {error}; other gains or rotors may help");
    Ok(tried.err().map(fails))
}

impl<'a> Begun<'a> {
    fn new(arguments: &Arguments, loaded: &'a Loaded, drives: &[DriveGuess]) -> Self {
        let at = |name: &str| display_path(&arguments.out.join(name));
        let guess = |(name, drive): (&'a str, &DriveGuess)| Guess {
            name,
            rotor_inertia_kg_m2: drive.rotor,
            kp_nm_per_rad: drive.gain.kp,
            kd_nm_s_per_rad: drive.gain.kd,
        };
        Self {
            schema: SCHEMA,
            robot: at("robot.toml"),
            scenario: at("scenario.toml"),
            joints: loaded.robot.joint_names().zip(drives).map(guess).collect(),
        }
    }

    fn text(&self) -> String {
        let short = |value| report::significant(value, 3);
        let rows = self.joints.iter().map(|joint| {
            let numbers =
                [joint.rotor_inertia_kg_m2, joint.kp_nm_per_rad, joint.kd_nm_s_per_rad].map(short);
            std::iter::once(joint.name.to_owned()).chain(numbers).collect()
        });
        let header = ["joint", ">rotor (kg·m²)", ">kp (N·m/rad)", ">kd (N·m·s/rad)"];
        format!(
            "{}\n{}: replace what is called a guess in it\nplumbline simulate {} --out out\n",
            table(&header, rows),
            self.robot,
            self.scenario
        )
    }
}
