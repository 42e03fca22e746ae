use std::collections::BTreeSet;
use std::num::NonZeroUsize;
use std::path::PathBuf;

use benchmark::{CampaignFolder, Part};
use cli::{display_path, print};
use report::quote_argument;

use crate::commands::submit::array_job::ArrayJob;
use crate::commands::submit::job_number::JobNumber;
use crate::commands::submit::sbatch_option::SbatchOption;
use crate::error::BenchError;
use crate::exit_status::BenchExitStatus;

/// Parts of a campaign where none are asked for: far below the 1000 that an array of Slurm has at
/// most as long as nobody has set another limit, and enough to keep a lab's nodes busy.
const PARTS: NonZeroUsize = NonZeroUsize::MIN.saturating_add(99);

/// Where the job lies in the folder of the campaign.
const SCRIPT: &str = "slurm/job.sh";

/// Arguments of `submit`.
#[derive(Debug, clap::Args)]
pub struct Arguments {
    /// The folder of a campaign that was planned, on a disk that the nodes share
    #[arg(value_name = "DIR")]
    folder: PathBuf,
    /// What starts the tasks
    #[arg(long, value_enum, default_value_t = Engine::Slurm)]
    engine: Engine,
    /// Parts of the campaign, a task each; those of which nothing is left have none
    #[arg(long, value_name = "N", default_value_t = PARTS)]
    parts: NonZeroUsize,
    /// Trials that a task makes at a time, and the processors that it asks for
    #[arg(long, value_name = "N", default_value_t = NonZeroUsize::MIN)]
    jobs: NonZeroUsize,
    /// An option of sbatch, such as --partition=short; may be given several times
    #[arg(long, value_name = "OPTION", allow_hyphen_values = true)]
    sbatch: Vec<SbatchOption>,
    /// Write the job, to be looked at or submitted by hand, and do not submit it
    #[arg(long)]
    dry_run: bool,
}

/// What starts the tasks of a campaign on other machines.
#[derive(Debug, Clone, Copy, PartialEq, Eq, clap::ValueEnum)]
enum Engine {
    /// An array job, begun anew where a node fails
    Slurm,
}

/// Writes the job that makes what is left, and submits it.
pub fn run(arguments: &Arguments) -> Result<BenchExitStatus, BenchError> {
    let folder = CampaignFolder::open(&arguments.folder)?;
    let left = folder.remaining(Part::WHOLE)?;
    if left.is_empty() {
        print("0 trials left, nothing is submitted\n")?;
        return Ok(BenchExitStatus::Good);
    }
    match arguments.engine {
        Engine::Slurm => to_slurm(arguments, &left)?,
    }
    Ok(BenchExitStatus::Good)
}

fn to_slurm(arguments: &Arguments, left: &[usize]) -> Result<(), BenchError> {
    let part = |&task: &usize| Part::of_task(task, arguments.parts).number();
    let numbers: BTreeSet<usize> = left.iter().map(part).collect();
    let tasks = numbers.len();
    let program = cli::program_file()?;
    let root = std::path::absolute(&arguments.folder)?;
    let script = ArrayJob {
        program: &program,
        folder: &root,
        numbers,
        parts: arguments.parts,
        jobs: arguments.jobs,
        options: &arguments.sbatch,
    }
    .script()?;
    report::write_folder(&arguments.folder, &[(SCRIPT, script.as_bytes())])?;

    let path = arguments.folder.join(SCRIPT);
    let said = format!("{} trials left, in {tasks} tasks", left.len());
    let [folder, job] = [&arguments.folder, &path].map(|path| quote_argument(&display_path(path)));
    if arguments.dry_run {
        return Ok(print(&format!("{said}. To submit them:\n  sbatch {job}\n"))?);
    }
    let number = JobNumber::submit(&path)?;
    Ok(print(&format!(
        "{said}, submitted as job {number}. To see how it goes on:\n  {}\n  \
         plumbline-bench status {folder}\nAt the end:\n  plumbline-bench merge {folder}\n",
        number.squeue()
    ))?)
}
