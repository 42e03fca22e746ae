use std::path::PathBuf;

use benchmark::PredictionTimes;
use cli::{Line, PartArguments, Watch, display_path, print, provenance};
use report::ReportError;

use crate::commands::times::curves::{MadeUp, curves, machine};
use crate::commands::times::peers;
use crate::error::BenchError;
use crate::exit_status::BenchExitStatus;

/// Numbers of training points.
const POINTS: [usize; 6] = [100, 300, 1000, 3000, 10_000, 30_000];

/// Arguments of `times`.
#[derive(Debug, clap::Args)]
pub struct Arguments {
    /// The robot: a robot.urdf, or a robot.toml that names one
    #[arg(long, value_name = "FILE")]
    robot: PathBuf,
    #[command(flatten)]
    part: PartArguments,
    /// Folder for prediction_times.json and figure1.svg
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    /// Print the JSON instead of the table
    #[arg(long)]
    json: bool,
    /// Print nothing but errors, and the JSON if it is asked for
    #[arg(long)]
    quiet: bool,
}

/// Times one prediction against the number of training points, as in figure 1 of Nguyen-Tuong
/// & Peters 2010, for models of made-up points, beside other programs where there are any.
pub fn run(arguments: &Arguments) -> Result<BenchExitStatus, BenchError> {
    if let Some(out) = arguments.out.as_deref().filter(|out| out.exists() && !out.is_dir()) {
        return Err(ReportError::NotAFolder { path: out.to_owned() }.into());
    }
    let loaded = arguments.part.load(&arguments.robot)?;
    let watch = Watch::new((!arguments.quiet).then(Line::new))?;
    let robot = &loaded.robot;
    let mut remarks = Vec::new();
    let mut curves = curves(robot, MadeUp { points: &POINTS, seed: 0 }, &watch)?;
    if robot.joint_count() == peers::JOINTS {
        watch.begin("scikit-learn and NumPy");
        match peers::measure(&POINTS) {
            Ok(found) => curves.extend(found),
            Err(why) => remarks.push(why),
        }
    } else {
        remarks.push(format!("no peers: they are timed for {} joints only", peers::JOINTS));
    }
    watch.finish();
    if watch.is_stopped() {
        remarks.push("stopped: what was measured until then".to_owned());
    }
    let times = PredictionTimes {
        robot: robot.name().to_owned(),
        joints: robot.joint_count(),
        machine: machine(),
        curves,
        remarks,
        provenance: provenance(&arguments.robot, &loaded, None)?,
    };
    let json = times.json()?;
    if let Some(out) = &arguments.out {
        let figure = times.figure()?;
        let files =
            [("prediction_times.json", json.as_bytes()), ("figure1.svg", figure.as_bytes())];
        report::write_folder(out, &files)?;
    }
    match (arguments.quiet, arguments.json) {
        (_, true) => print(&cli::escape_json(&json))?,
        (true, false) => {}
        (false, false) => print(&text(arguments, &times))?,
    }
    Ok(BenchExitStatus::Good)
}

fn text(arguments: &Arguments, times: &PredictionTimes) -> String {
    let mut text = times.text();
    if let Some(out) = &arguments.out {
        text.push_str(&format!("\nfigure         {}\n", display_path(&out.join("figure1.svg"))));
    }
    text
}
