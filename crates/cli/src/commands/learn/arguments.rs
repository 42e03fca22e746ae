use std::path::PathBuf;
use std::str::FromStr;

use dynamics::ColumnSet;
use learner::{ModelKind, PriorSpread, TrainSettings};

use crate::columns::LogArguments;
use crate::input::{RobotArguments, positive};

/// Models that are compared when none are named: the robot as described and the five of
/// Nguyen-Tuong & Peters 2010.
const MODELS: [ModelKind; 6] = [
    ModelKind::Cad,
    ModelKind::Rbd,
    ModelKind::Gp,
    ModelKind::GpRbd,
    ModelKind::GpRbdPrior,
    ModelKind::RbdKernel,
];

/// Arguments of `learn`.
#[derive(Debug, clap::Args)]
pub struct Arguments {
    #[command(flatten)]
    pub robot: RobotArguments,
    /// Logs (CSV, Parquet, NumPy, MATLAB, HDF5, bags of ROS 2) to learn from, one run each
    #[arg(long, value_name = "LOG", num_args = 1.., required = true)]
    pub train: Vec<PathBuf>,
    /// Files to measure the errors on, none of which is learned from
    #[arg(long, value_name = "LOG", num_args = 1.., required = true)]
    pub test: Vec<PathBuf>,
    /// Files for the parameters of the rigid bodies; those of --train when left out
    #[arg(long, value_name = "LOG", num_args = 1..)]
    pub regression: Vec<PathBuf>,
    /// The models, with commas between them: cad, rbd, rbd-consistent, gp, gp-rbd, gp-rbd-prior,
    /// gp-rbd-shared, rbd-kernel, rbd-kernel-joint, named, named-gp, and gp, gp-rbd, named-gp
    /// with -inducing
    #[arg(long, value_name = "MODEL", value_delimiter = ',', default_values_t = MODELS)]
    pub models: Vec<ModelKind>,
    /// Samples that a Gaussian process learns from, spread evenly over the logs
    #[arg(long, value_name = "N", default_value_t = TrainSettings::default().points)]
    pub points: usize,
    /// Points that stand for all samples in the models -inducing
    #[arg(long, value_name = "M", default_value_t = TrainSettings::default().inducing_points)]
    pub inducing_points: usize,
    /// What the rigid bodies are made of: the links alone (inertial), or rotors, friction and
    /// offsets of the joints as well (drives)
    #[arg(long, value_name = "WHICH", default_value = "inertial", value_parser = columns)]
    pub columns: ColumnSet,
    /// How sure the parameters of the rigid bodies are before the points are seen: as the
    /// regression (errors), as the points ask for (evidence), or to a share of their size
    /// (share=0.1)
    #[arg(long, value_name = "HOW", default_value = "errors", value_parser = prior)]
    pub prior: PriorSpread,
    /// The directions of motion are inputs of the Gaussian processes too
    #[arg(long)]
    pub directions: bool,
    /// The robot with named effects, extended.toml of a diagnosis, for the models named
    #[arg(long, value_name = "FILE")]
    pub named: Option<PathBuf>,
    /// Cut-off of the low-pass filter of all logs; chosen from the data when it is left out
    #[arg(long, value_name = "HZ", value_parser = positive, allow_negative_numbers = true)]
    pub cutoff_hz: Option<f64>,
    #[command(flatten)]
    pub reading: LogArguments,
    /// Folder for report.html, learning.json, figure.svg and the models
    #[arg(long, value_name = "DIR", default_value = "out/learn")]
    pub out: PathBuf,
    /// Print the JSON instead of the table
    #[arg(long)]
    pub json: bool,
    /// Print nothing but errors, and the JSON if it is asked for
    #[arg(long)]
    pub quiet: bool,
}

fn columns(text: &str) -> Result<ColumnSet, String> {
    match text {
        "inertial" => Ok(ColumnSet::INERTIAL),
        "drives" => Ok(ColumnSet::ALL),
        _ => Err("inertial or drives was expected".to_owned()),
    }
}

fn prior(text: &str) -> Result<PriorSpread, String> {
    match (text, text.strip_prefix("share=").map(f64::from_str)) {
        ("errors", _) => Ok(PriorSpread::StandardErrors),
        ("evidence", _) => Ok(PriorSpread::Evidence),
        (_, Some(Ok(share))) if share > 0.0 && share.is_finite() => Ok(PriorSpread::Share(share)),
        _ => Err("errors, evidence or share= with a positive number was expected".to_owned()),
    }
}
