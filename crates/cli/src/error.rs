use std::borrow::Cow;
use std::io;
use std::path::{Path, PathBuf};

use diagnosis::DiagnosisError;
use document::{Coloring, DocumentError};
use exchange::ExchangeError;
use experiment::ExperimentError;
use files::shorten_words;
use learner::LearnerError;
use logs::{FormatError, LogError};
use report::ReportError;
use robot::RobotError;
use simulator::SimulatorError;

use crate::design_error::DesignError;
use crate::installed::is_of_package;
use crate::messages::{print_error, tell};

/// How to get the viewer of recordings, in the version that they are written for.
pub const VIEWER_INSTALLATION: &str =
    "pip install rerun-sdk==0.36.3, or cargo install rerun-cli --version 0.36.3 --locked";

/// Why a command did not run to its end.
#[derive(Debug, thiserror::Error)]
pub enum CliError {
    /// The robot cannot be used.
    #[error(transparent)]
    Robot(#[from] RobotError),
    /// A log or a column map cannot be used.
    #[error(transparent)]
    Log(#[from] LogError),
    /// The logs together cannot be diagnosed.
    #[error(transparent)]
    Diagnosis(#[from] DiagnosisError),
    /// The report cannot be made or written.
    #[error(transparent)]
    Report(#[from] ReportError),
    /// A scenario cannot be read.
    #[error(transparent)]
    Document(#[from] DocumentError),
    /// A scenario cannot be simulated.
    #[error(transparent)]
    Simulator(#[from] SimulatorError),
    /// A model cannot be learned.
    #[error(transparent)]
    Learner(#[from] LearnerError),
    /// A scenario cannot be run.
    #[error(transparent)]
    Experiment(Box<ExperimentError>),
    /// A model would be tested on what it was trained on.
    #[error(
        "{test}: it is the recording that {training} holds, a test needs a log that took no part in the training"
    )]
    TestedOnTraining {
        /// The log of the test.
        test: String,
        /// The log of the training or of the regression.
        training: String,
    },
    /// The robot with named effects is another one.
    #[error("{}: its joints are not those of {expected}", path.display())]
    OtherRobot {
        /// The file.
        path: PathBuf,
        /// Name of the robot.
        expected: String,
    },
    /// Ctrl-C cannot be listened to.
    #[error("Ctrl-C cannot be listened to: {reason}")]
    Signal {
        /// What the operating system said.
        reason: String,
    },
    /// The output folder cannot be made.
    #[error("{}: {reason}, a folder to write into was expected", path.display())]
    Folder {
        /// The folder.
        path: PathBuf,
        /// What was found.
        reason: String,
    },
    /// The output would lie over what it is made from.
    #[error("{}: it is read and would be written over, another folder for the output was expected", path.display())]
    OwnInput {
        /// The file.
        path: PathBuf,
    },
    /// The results are there, but a file beside them is not.
    #[error("{problem}; the comparison is whole")]
    Incomplete {
        /// The file and what is wrong with it.
        problem: String,
    },
    /// A folder cannot be looked into.
    #[error("{}: it cannot be listed ({reason}), the output folder of a command was expected", path.display())]
    Unlisted {
        /// The folder.
        path: PathBuf,
        /// What the operating system said.
        reason: String,
    },
    /// A folder holds nothing to look at.
    #[error("{}: a report.html or a recording (.rrd) was expected, found {found}", path.display())]
    NothingToView {
        /// The folder.
        path: PathBuf,
        /// The names in it.
        found: String,
    },
    /// There is no viewer for recordings.
    #[error("{recordings}: the program rerun that shows recordings is not on the PATH")]
    NoViewer {
        /// The names of the recordings.
        recordings: String,
    },
    /// A program that should open something did not start.
    #[error("{}: it cannot be opened: {reason}", path.display())]
    NotOpened {
        /// The file or program.
        path: PathBuf,
        /// What the operating system said.
        reason: String,
    },
    /// The robot with the findings cannot be described.
    #[error("the extended model cannot be written: {0}")]
    Extended(RobotError),
    /// The robot cannot be written in another format.
    #[error(transparent)]
    Exchange(#[from] ExchangeError),
    /// A folder holds no robot.
    #[error("{}: an extended.toml was expected, as diagnose, run and demo write it", path.display())]
    NothingToExport {
        /// The folder.
        path: PathBuf,
    },
    /// A robot has other joints than the one that it is compared with.
    #[error("{}: its joints are not those of {}, which were expected", path.display(), expected.display())]
    OtherJoints {
        /// The robot.
        path: PathBuf,
        /// The one that it is compared with.
        expected: PathBuf,
    },
    /// A log has none of the episodes that were asked for.
    #[error("{}: it has none of the episodes that --episodes asks for; a dataset of LeRobot that has them was expected", path.display())]
    NoEpisode {
        /// The log.
        path: PathBuf,
    },
    /// Nothing says which robot is meant.
    #[error("a robot was expected, as --robot FILE or as the one of --diagnosis DIR")]
    NoRobot,
    /// A file that may have been worked on is there.
    #[error("{}: it is there already", path.display())]
    Exists {
        /// The file.
        path: PathBuf,
    },
    /// A file has no joints to look at.
    #[error("{}: there is no column <joint>.position, at least one was expected", path.display())]
    NoJoints {
        /// The log.
        path: PathBuf,
    },
    /// No effect has this name.
    #[error("effect {name}: it is not in the catalogue, {hint}")]
    UnknownEffect {
        /// The name that was asked for.
        name: String,
        /// The nearest name, or what a name looks like.
        hint: String,
    },
    /// No motion can be designed.
    #[error(transparent)]
    Design(#[from] DesignError),
    /// A scenario is that of a figure.
    #[error("{}: it is a figure of a paper, the scenario of an arm or of tracking was expected", path.display())]
    Figure {
        /// The scenario.
        path: PathBuf,
    },
    /// The standard output cannot be written.
    #[error("the standard output cannot be written: {0}")]
    Output(#[from] io::Error),
}

impl From<ExperimentError> for CliError {
    fn from(error: ExperimentError) -> Self {
        Self::Experiment(Box::new(error))
    }
}

const KINDS_OF_FILES: &str = "a robot is a URDF, an MJCF or a robot.toml (--robot), a log is a table of numbers over time (--log)";

const LEFT_OUT: &str =
    "takes the joints that the log has, the others are locked at zero or as a robot.toml says";

const WITHOUT_EFFORT: &str = "takes the joints that have one; the others count as locked at zero or as a robot.toml says, which is right where they stood";

const NO_JOINT_STATES: &str = "sensor_msgs/msg/JointState and control_msgs/msg/JointTrajectoryControllerState in CDR are read, and joint states in JSON: record /joint_states, or write its positions and efforts as CSV and give a column map (--map)";

const DEGREES_OR_NORMALISED: &str = "in the column map: position = { column = \"...\", unit = \"deg\" } for degrees. Normalised positions are -100 to 100 over the range of the calibration from a to b (rad): scale = (b - a) / 200 and offset = (a + b) / 2, a list with one number a joint each, of position and desired_position";

const OTHERS_LOCKED: &str = "the other joints are locked at zero or as a robot.toml says";

const MAP: &str = "a column map (--map) says where a file with other names has its signals, and rate_hz in it the rate of a file without time; --effort picks the effort column";

/// What to do about a log.
fn of_log(log: &LogError) -> Option<&'static str> {
    match log {
        LogError::File(
            FormatError::NoColumn { path, .. } | FormatError::OtherKind { path, .. },
        ) if has_extension(path, &["urdf", "xml", "toml"]) => Some(KINDS_OF_FILES),
        LogError::JointAbsent { .. }
        | LogError::File(FormatError::NoColumn { .. })
        | LogError::NoNames { .. } => Some(MAP),
        LogError::File(FormatError::NoTopic { topic: None, .. }) => Some(NO_JOINT_STATES),
        LogError::File(FormatError::NoTopic { .. } | FormatError::SeveralTopics { .. }) => {
            Some("--topic NAME picks the topic whose joint states are read")
        }
        LogError::LooksLikeDegrees { .. } if log.may_be_normalised() => Some(DEGREES_OR_NORMALISED),
        LogError::LooksLikeDegrees { .. } => {
            Some("in the column map: position = { column = \"...\", unit = \"deg\" }")
        }
        LogError::OtherClock { .. } => {
            Some("a column map (--map) names the unit: time = { column = \"...\", unit = \"...\" }")
        }
        LogError::Impossible { .. } => {
            Some("take these rows out of the file, or record without what wrote them")
        }
        LogError::CutoffOutOfRange { .. } => {
            Some("leave --cutoff-hz out and the cut-off is chosen from the data")
        }
        _ => None,
    }
}

fn has_extension(path: &Path, extensions: &[&str]) -> bool {
    let own = path.extension().and_then(|e| e.to_str()).map(str::to_lowercase);
    own.is_some_and(|own| extensions.contains(&own.as_str()))
}

impl CliError {
    /// 2 for usage, 3 for data that cannot be used.
    pub fn exit_code(&self) -> u8 {
        match self {
            Self::UnknownEffect { .. }
            | Self::Output(_)
            | Self::Folder { .. }
            | Self::OwnInput { .. }
            | Self::TestedOnTraining { .. }
            | Self::NoViewer { .. }
            | Self::NotOpened { .. }
            | Self::Incomplete { .. }
            | Self::Exists { .. }
            | Self::NoRobot
            | Self::Signal { .. } => 2,
            Self::Learner(error) => match error {
                LearnerError::Log(LogError::Unwritable { .. })
                | LearnerError::Setting { .. }
                | LearnerError::Missing { .. }
                | LearnerError::Memory { .. } => 2,
                _ => 3,
            },
            Self::Design(error) => error.exit_code(),
            Self::Simulator(SimulatorError::Log(LogError::Unwritable { .. })) => 2,
            Self::Document(_) | Self::Simulator(_) => 3,
            Self::Experiment(error) => match **error {
                ExperimentError::NoModel { .. }
                | ExperimentError::NothingToLearnFrom { .. }
                | ExperimentError::Recording(_)
                | ExperimentError::Stage { .. }
                | ExperimentError::Learner(LearnerError::Log(LogError::Unwritable { .. }))
                | ExperimentError::Log(LogError::Unwritable { .. })
                | ExperimentError::Simulator(SimulatorError::Log(LogError::Unwritable {
                    ..
                })) => 2,
                _ => 3,
            },
            Self::Report(ReportError::Unreadable { .. }) => 3,
            Self::Report(_) | Self::Diagnosis(DiagnosisError::Setting { .. }) => 2,
            Self::Log(log) | Self::Diagnosis(DiagnosisError::Log(log)) => match log {
                LogError::CutoffOutOfRange { .. } | LogError::Unwritable { .. } => 2,
                _ => 3,
            },
            Self::Robot(_)
            | Self::Extended(_)
            | Self::Diagnosis(_)
            | Self::NoJoints { .. }
            | Self::Unlisted { .. }
            | Self::Exchange(_)
            | Self::Figure { .. }
            | Self::NoEpisode { .. }
            | Self::NothingToExport { .. }
            | Self::OtherJoints { .. }
            | Self::NothingToView { .. }
            | Self::OtherRobot { .. } => 3,
        }
    }

    /// What to do about it, where that can be said.
    pub fn help(&self) -> Option<Cow<'static, str>> {
        match self.log() {
            Some(LogError::JointAbsent { shared, .. }) if !shared.is_empty() => {
                Some(Cow::Owned(format!("--joints {} {LEFT_OUT}; {MAP}", shared.join(","))))
            }
            Some(LogError::EffortAbsent { others, .. }) => {
                Some(Cow::Owned(format!("--joints {} {WITHOUT_EFFORT}; {MAP}", others.join(","))))
            }
            Some(LogError::OtherCount { found, joints, .. }) => {
                let first = joints[..joints.len().min(*found)].join(",");
                let help = format!(
                    "--joints {first}, if these are the columns in their order; {OTHERS_LOCKED}"
                );
                Some(Cow::Owned(help))
            }
            _ => self.advice().map(Cow::Borrowed),
        }
    }

    /// The error in words, of a mistake in a TOML file with the place where it stands.
    pub fn words(&self) -> String {
        match self.mistake() {
            Some(error) => error.render(Coloring::Plain),
            None => shorten_words(&self.to_string()).into_owned(),
        }
    }

    /// The mistake in a log.
    fn log(&self) -> Option<&LogError> {
        match self {
            Self::Log(log) | Self::Diagnosis(DiagnosisError::Log(log)) => Some(log),
            _ => None,
        }
    }

    /// What to do about a kind of mistake.
    fn advice(&self) -> Option<&'static str> {
        if let Some(log) = self.log() {
            return of_log(log);
        }
        match self {
            Self::Learner(LearnerError::Missing { model, .. }) if model.starts_with("named") => {
                Some("plumbline diagnose writes extended.toml; give it with --named")
            }
            Self::Learner(LearnerError::Memory { .. }) => {
                Some("--points N, or a model -inducing, which takes all samples")
            }
            Self::NoViewer { .. } => Some(VIEWER_INSTALLATION),
            Self::Figure { .. } => Some("plumbline-bench figure draws it"),
            Self::NotOpened { .. } => Some("plumbline view --print names the files"),
            Self::Experiment(error) => {
                let lacks = matches!(**error, ExperimentError::NoModel { .. });
                lacks.then_some(
                    "plumbline learn and track write models; without --learned they are learned",
                )
            }
            Self::UnknownEffect { .. } => Some("plumbline explain lists every effect"),
            Self::NoJoints { .. } => {
                Some("give the robot with --robot, and --map if the columns have other names")
            }
            Self::Exists { .. } => Some("--force writes over it"),
            Self::Report(ReportError::NotAFolder { .. }) | Self::OwnInput { .. } => {
                Some("give --out another name")
            }
            // What is wrong with a name of a package says itself what to do.
            Self::Robot(RobotError::Unreadable { path, .. }) if is_of_package(path) => None,
            Self::Robot(RobotError::InFile { path, .. } | RobotError::Unreadable { path, .. }) => {
                (!has_extension(path, &["urdf", "xml", "toml"])).then_some(KINDS_OF_FILES)
            }
            _ => None,
        }
    }

    /// The mistake in a scenario, a column map or a robot.toml, which is shown where it stands.
    fn mistake(&self) -> Option<&DocumentError> {
        use ExperimentError as E;
        match self {
            Self::Document(error) | Self::Simulator(SimulatorError::Scenario(error)) => Some(error),
            Self::Log(LogError::Map { problem }) | Self::Robot(RobotError::InToml { problem }) => {
                Some(problem)
            }
            Self::Experiment(error) => match &**error {
                E::Document(error) | E::Simulator(SimulatorError::Scenario(error)) => Some(error),
                _ => None,
            },
            _ => None,
        }
    }

    /// Prints the error, and advice where there is any, on the standard error.
    pub fn print(&self) {
        if let Some(error) = self.mistake() {
            tell(&error.render(Coloring::Ansi));
            return;
        }
        print_error(self, self.help().as_deref());
    }
}
