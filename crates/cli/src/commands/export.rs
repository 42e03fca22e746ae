use std::path::{Path, PathBuf};

use exchange::{Export, Format, QuantityFate};
use robot::{Link, Loaded};
use schemars::{JsonSchema, Schema};
use serde::Serialize;

use crate::diagnosed_input::DiagnosedInput;
use crate::error::CliError;
use crate::exit_status::ExitStatus;
use crate::input::PartArguments;
use crate::loss::{Loss, LossArguments};
use crate::output::{create_folder, display_path, keep_inputs, print, print_json, table};

/// Names under which an output folder has the robot with its findings, of a diagnosis and of a run.
const EXTENDED: [&str; 2] = ["extended.toml", "diagnosis/extended.toml"];

/// Name and version of the schema of what `--json` prints.
const SCHEMA: &str = "plumbline.export/1";

/// Arguments of `export`.
#[derive(Debug, clap::Args)]
pub struct Arguments {
    /// The output folder of diagnose, run or demo, or a robot.toml
    path: PathBuf,
    #[command(flatten)]
    part: PartArguments,
    /// Formats, with commas between them; where it is left out, all of a robot, and `actuator` for servos whose position
    /// loop robot.toml describes
    #[arg(long, value_enum, value_name = "FORMAT", value_delimiter = ',')]
    to: Vec<Target>,
    /// Folder for the files; that of the robot where it is left out
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    #[command(flatten)]
    loss: LossArguments,
    /// Print JSON
    #[arg(long)]
    json: bool,
}

/// A format that is asked for.
#[derive(Debug, Clone, Copy, PartialEq, Eq, clap::ValueEnum)]
enum Target {
    /// The format of ROS, the user's own file with what differs: extended.urdf
    Urdf,
    /// The format of MuJoCo: extended.xml
    Mjcf,
    /// The format of Gazebo: extended.sdf
    Sdf,
    /// A USD layer with the schemas of PhysX and Newton, for Isaac Sim and Isaac Lab: extended.usda
    Isaac,
    /// The servos alone: position actuators of MuJoCo (extended_actuator.xml), actuators of Isaac Lab
    /// (extended_actuator.py), parameters of BAM (extended_actuator.json)
    Actuator,
}

impl Target {
    fn formats(self) -> &'static [Format] {
        match self {
            Self::Urdf => &[Format::Urdf],
            Self::Mjcf => &[Format::Mjcf],
            Self::Sdf => &[Format::Sdf],
            Self::Isaac => &[Format::Isaac],
            Self::Actuator => &Format::ACTUATORS,
        }
    }
}

/// The JSON schema of what `--json` prints.
pub fn schema() -> Schema {
    report::written_schema::<Exports>(SCHEMA, "Plumbline export")
}

/// What is printed.
#[derive(Serialize, JsonSchema)]
struct Exports {
    schema: &'static str,
    robot: String,
    files: Vec<Written>,
    /// What was fitted without a name and is in the files, where the folder holds a diagnosis.
    fitted_without_a_name: Vec<String>,
    /// What is seen, too small to be a finding, and in the files, where the folder holds a diagnosis.
    negligible: Vec<String>,
    #[serde(skip_serializing_if = "Option::is_none")]
    loss: Option<Loss>,
}

/// A file that was written.
#[derive(Serialize, JsonSchema)]
struct Written {
    format: &'static str,
    /// None where the format has none of the robot.
    path: Option<String>,
    quantities: Vec<QuantityFate>,
}

/// Writes the robot in other formats and prints what became of every quantity, and what that costs on logs.
pub fn run(arguments: &Arguments) -> Result<ExitStatus, CliError> {
    let path = description_file(&arguments.path)?;
    let loaded = arguments.part.load(&path)?;
    let source = files::text(&loaded.urdf_path, files::KEPT_BYTES).map_err(|error| {
        CliError::Robot(robot::RobotError::Unreadable {
            path: loaded.urdf_path.clone(),
            reason: error.to_string(),
        })
    })?;
    let folder = arguments.out.clone().or_else(|| path.parent().map(Path::to_owned));
    let folder = folder.filter(|f| !f.as_os_str().is_empty()).unwrap_or_else(|| PathBuf::from("."));
    let mut exports: Vec<(&'static str, Option<String>, Export)> = vec![];
    for format in formats(arguments, &loaded) {
        let export = exchange::export(&loaded, &source, format)?;
        let name = format.file_name("extended");
        let path = (!export.text.is_empty()).then_some(name);
        exports.push((format.name(), path, export));
    }
    let files = exports.iter().filter_map(|(_, name, export)| Some((name.as_deref()?, export)));
    let files: Vec<(&str, &[u8])> =
        files.map(|(name, export)| (name, export.text.as_bytes())).collect();
    let names: Vec<&str> = files.iter().map(|(name, _)| *name).collect();
    create_folder(&folder)?;
    keep_inputs(&folder, &names, [loaded.urdf_path.as_path()])?;
    report::write_folder(&folder, &files)?;
    for (_, name, _) in &mut exports {
        *name = name.take().map(|name| display_path(&folder.join(name)));
    }
    let held =
        exports.iter().filter_map(|(format, path, export)| Some((*format, path.clone()?, export)));
    let loss = arguments.loss.measure(&path, &loaded, &arguments.part, held)?;
    let diagnosed = DiagnosedInput::read(&path.with_file_name("diagnosis.json")).ok();
    let diagnosed = diagnosed.filter(|_| path.ends_with("extended.toml"));
    let written =
        |(format, path, export): (_, _, Export)| Written { format, path, quantities: export.fates };
    let exports = Exports {
        schema: SCHEMA,
        robot: loaded.robot.name().to_owned(),
        files: exports.into_iter().map(written).collect(),
        fitted_without_a_name: diagnosed
            .as_ref()
            .map(|diagnosed| diagnosed.fitted_without_a_name())
            .unwrap_or_default(),
        negligible: diagnosed.map(|diagnosed| diagnosed.negligible()).unwrap_or_default(),
        loss,
    };
    if arguments.json {
        print_json(&exports)?;
    } else {
        print(&text(&exports))?;
    }
    Ok(ExitStatus::Good)
}

/// The formats that are asked for; all of a robot, and of its servos where it has some, where none is.
fn formats(arguments: &Arguments, loaded: &Loaded) -> Vec<Format> {
    if !arguments.to.is_empty() {
        return arguments.to.iter().flat_map(|target| target.formats()).copied().collect();
    }
    let is_servo = |link: &Link| link.actuator.position_loop.is_some();
    let servos: &[Format] =
        if loaded.robot.links().iter().any(is_servo) { &Format::ACTUATORS } else { &[] };
    [&Format::ALL, servos].concat()
}

/// The description of the robot in an output folder, or the file itself.
fn description_file(path: &Path) -> Result<PathBuf, CliError> {
    if !path.is_dir() {
        return Ok(path.to_owned());
    }
    let found = EXTENDED.iter().map(|name| path.join(name)).find(|file| file.exists());
    found.ok_or_else(|| CliError::NothingToExport { path: path.to_owned() })
}

fn text(exports: &Exports) -> String {
    let mut text = String::new();
    for file in &exports.files {
        let of = |word: &str| file.quantities.iter().filter(|q| q.fate.word() == word).count();
        let counts = ["exact", "approximated", "dropped"].map(|w| format!("{} {w}", of(w)));
        let place = match &file.path {
            Some(path) => path.clone(),
            None => format!("{}, no file: it has the law of none of the servos", file.format),
        };
        text.push_str(&format!("{place}: {}\n", counts.join(", ")));
        let rows = file.quantities.iter().map(|q| {
            vec![q.at.clone(), q.what.clone(), q.fate.word().to_owned(), q.fate.to_string()]
        });
        text.push_str(&table(&["where", "what", "fate", "how or why"], rows));
        text.push('\n');
    }
    let unnamed = [
        (
            "Fitted without a name",
            &exports.fitted_without_a_name,
            " plumbline diagnose --only-findings leaves them out.",
        ),
        ("Seen and negligible", &exports.negligible, ""),
    ];
    for (what, places, help) in unnamed.iter().filter(|(_, places, _)| !places.is_empty()) {
        let sentence = format!("{what}, and in the files above: {}.{help}", places.join("; "));
        let lines = report::wrap(&sentence, report::TERMINAL_WIDTH);
        text.push_str(&(lines.join("\n") + "\n"));
    }
    text + &exports.loss.as_ref().map(Loss::text).unwrap_or_default()
}
