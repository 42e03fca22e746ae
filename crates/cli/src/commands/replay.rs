use std::path::PathBuf;

use logs::{ColumnMap, PrepareSettings, PreparedRun, ReadOptions, Run};
use robot::{Gain, Loaded, Robot};
use simulator::{ForwardReplay, MotionReplay};

use crate::Outcome;
use crate::error::CliError;
use crate::output::{create_folder, print, shown, table};

/// Arguments of `replay`.
#[derive(Debug, clap::Args)]
pub struct Arguments {
    /// The robot whose simulation is looked at: a robot.urdf, or a robot.toml that names one
    #[arg(long, value_name = "FILE")]
    robot: PathBuf,
    /// CSV or Parquet files, one run each
    #[arg(long = "log", value_name = "FILE", required = true, num_args = 1..)]
    logs: Vec<PathBuf>,
    /// Folder for the simulated motion and torque of every run
    #[arg(long, value_name = "DIR")]
    out: PathBuf,
    /// Lengths of time that the simulation is rolled forward
    #[arg(long, value_name = "MS", value_delimiter = ',', default_values_t = [50.0, 200.0, 1000.0])]
    window_ms: Vec<f64>,
    /// Names and units of columns that are called otherwise (TOML)
    #[arg(long, value_name = "FILE")]
    map: Option<PathBuf>,
    /// The effort is read from the columns `<joint>.COLUMN`
    #[arg(long, value_name = "COLUMN", default_value = "effort")]
    effort: String,
}

/// Rolls the simulation forward under recorded torque, lets it follow the recorded motion, and
/// says how far both are from the record.
pub fn run(arguments: &Arguments) -> Result<Outcome, CliError> {
    let loaded = Robot::load(&arguments.robot)?;
    let map = arguments.map.as_deref().map(ColumnMap::load).transpose()?;
    let options = ReadOptions { map: map.as_ref(), effort: &arguments.effort };
    let runs: Result<Vec<Run>, _> =
        arguments.logs.iter().map(|p| logs::read_run(p, &loaded.robot, &options)).collect();
    let prepared = logs::prepare(&runs?, &PrepareSettings::default())?;
    create_folder(&arguments.out)?;
    for record in &prepared.runs {
        replay(arguments, &loaded, record)?;
    }
    print(&format!("simulated motion and torque {}\n", shown(&arguments.out)))?;
    Ok(Outcome::Good)
}

fn replay(arguments: &Arguments, loaded: &Loaded, record: &PreparedRun) -> Result<(), CliError> {
    let robot = &loaded.robot;
    let stem = record.name.replace(' ', "_");
    let mut forward = Vec::new();
    for &window_ms in &arguments.window_ms {
        let replay = simulator::replay_torque(robot, record, 1e-3 * window_ms)?;
        let file = arguments.out.join(format!("{stem}_forward_{window_ms}ms.parquet"));
        logs::write_parquet(&file, &replay.motion)?;
        forward.push(replay);
    }
    let gains: Option<Vec<Gain>> = loaded.control.gains.iter().copied().collect();
    let motion = match gains.filter(|g| g.len() == robot.joint_count()) {
        Some(gains) => Some(simulator::replay_motion(robot, &gains, record)?),
        None => None,
    };
    if let Some(motion) = &motion {
        logs::write_parquet(&arguments.out.join(format!("{stem}_motion.parquet")), &motion.log)?;
    }
    print(&text(robot, record, &forward, motion.as_ref()))
}

fn text(
    robot: &Robot,
    record: &PreparedRun,
    forward: &[ForwardReplay],
    motion: Option<&MotionReplay>,
) -> String {
    let mut header = vec!["joint".to_owned()];
    header.extend(forward.iter().map(|f| format!(">{:.0} ms", 1e3 * f.window_s)));
    header.extend(motion.iter().flat_map(|_| [">torque".to_owned(), ">of".to_owned()]));
    let rows = robot.joint_names().enumerate().map(|(j, name)| {
        let mut row = vec![name.to_owned()];
        row.extend(forward.iter().map(|f| format!("{:.3e}", f.drift_rms[j])));
        if let Some(motion) = motion {
            let squares = record.joints[j].effort.iter().map(|tau| tau * tau);
            let rms = (squares.sum::<f64>() / record.time.len() as f64).sqrt();
            row.push(format!("{:.3}", motion.torque_error_rms[j]));
            row.push(format!("{rms:.3}"));
        }
        row
    });
    let header: Vec<&str> = header.iter().map(String::as_str).collect();
    let mut text = format!("{}\n{}", record.name, table(&header, rows));
    text.push_str(" ms: drift of the simulated from the measured position after so long under the measured torque, RMS (rad or m)\n");
    text.push_str(match motion {
        Some(_) => " torque: simulated minus measured along the measured motion, RMS, of the measured RMS (N m or N)\n",
        None => " the robot has no gains for every joint, so its simulation cannot follow the measured motion\n",
    });
    for replay in forward.iter().filter(|f| !f.runaways.is_empty()) {
        let fault = &replay.runaways[0];
        text.push_str(&format!(
            " {} of {} windows of {:.0} ms ran away and are left out, the first: {fault}\n",
            replay.runaways.len(),
            replay.windows,
            1e3 * replay.window_s
        ));
    }
    text + "\n"
}
