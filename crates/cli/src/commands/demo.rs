use std::path::{Path, PathBuf};

use document::Document;
use experiment::Experiment;

use crate::commands::run::{Output, perform};
use crate::error::CliError;
use crate::exit_status::ExitStatus;

/// Files of the repository: where they are written, and what is in them.
type Sources = [(&'static str, &'static [u8]); 5];

/// The files of an arm: schema of its description, description, scenario of the arm, scenario of the demo, which is the last.
macro_rules! sources {
    ($robot:literal, $arm:literal) => {
        [
            ("robots/robot.schema.json", include_bytes!("../../../../robots/robot.schema.json")),
            (
                concat!("robots/", $robot, "/robot.urdf"),
                include_bytes!(concat!("../../../../robots/", $robot, "/robot.urdf")),
            ),
            (
                concat!("robots/", $robot, "/robot.toml"),
                include_bytes!(concat!("../../../../robots/", $robot, "/robot.toml")),
            ),
            (
                concat!("scenarios/arms/", $arm, ".toml"),
                include_bytes!(concat!("../../../../scenarios/arms/", $arm, ".toml")),
            ),
            (
                concat!("scenarios/demos/", $arm, ".toml"),
                include_bytes!(concat!("../../../../scenarios/demos/", $arm, ".toml")),
            ),
        ]
    };
}

/// An arm that the demo knows.
#[derive(Debug, Clone, Copy, PartialEq, Eq, clap::ValueEnum)]
enum Arm {
    /// Barrett WAM, seven joints
    Wam7,
    /// Universal Robots UR5e, six joints
    Ur5e,
    /// Franka Emika Panda, seven joints
    Panda,
    /// SO-101, five joints and a gripper
    So101,
}

impl Arm {
    fn words(self) -> &'static str {
        match self {
            Self::Wam7 => "A Barrett WAM",
            Self::Ur5e => "A UR5e",
            Self::Panda => "A Franka Emika Panda",
            Self::So101 => "An SO-101",
        }
    }

    /// The output folder where none is named, one an arm.
    fn folder(self) -> PathBuf {
        let name = match self {
            Self::Wam7 => "demo",
            Self::Ur5e => "demo_ur5e",
            Self::Panda => "demo_panda",
            Self::So101 => "demo_so101",
        };
        Path::new("out").join(name)
    }

    fn sources(self) -> Sources {
        match self {
            Self::Wam7 => sources!("wam7", "wam"),
            Self::Ur5e => sources!("ur5e", "ur5e"),
            Self::Panda => sources!("panda", "panda"),
            Self::So101 => sources!("so101", "so101"),
        }
    }
}

/// Arguments of `demo`.
#[derive(Debug, clap::Args)]
pub struct Arguments {
    #[command(flatten)]
    output: Output,
    /// The arm
    #[arg(long, value_enum, default_value = "wam7")]
    robot: Arm,
    /// Seed that the two effects are drawn from, and the noise of the sensors
    #[arg(long, value_parser = clap::value_parser!(u64).range(0..=i64::MAX as u64))]
    seed: Option<u64>,
}

/// Hides two effects in a simulated arm, finds them in its logs and measures what that gains.
pub fn run(arguments: &Arguments) -> Result<ExitStatus, CliError> {
    let out = arguments.output.out.clone().unwrap_or_else(|| arguments.robot.folder());
    let (source, sources) = (out.join("source"), arguments.robot.sources());
    report::write_folder(&source, &sources)?;
    let [.., (scenario, _)] = sources;
    let scenario = source.join(Path::new(scenario));
    let experiment = Experiment::from_document(&Document::read(&scenario)?, arguments.seed)?;
    arguments.output.leave(&introduction(arguments.robot));
    perform(&experiment, &scenario, &out, &arguments.output)
}

fn introduction(arm: Arm) -> String {
    format!(
        "{} is simulated with two effects hidden in it. What is wrong with the model of it is found\n\
         from the logs alone, and repaired; then the truth is opened.\n",
        arm.words()
    )
}
