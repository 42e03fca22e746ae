use std::collections::BTreeSet;
use std::num::NonZeroUsize;
use std::path::{Path, PathBuf};

use benchmark::{BenchManifest, CampaignFolder, Part};
use cli::{display_path, print};
use report::quote_argument;

use crate::commands::submit::array_job::{ArrayJob, TaskKind};
use crate::commands::submit::job_number::JobNumber;
use crate::commands::submit::sbatch_option::SbatchOption;
use crate::error::BenchError;
use crate::exit_status::BenchExitStatus;

/// Parts of a campaign where none are asked for: far below the 1000 that an array of Slurm has at
/// most as long as nobody has set another limit, and enough to keep a lab's nodes busy.
const PARTS: NonZeroUsize = NonZeroUsize::MIN.saturating_add(99);

/// Where the job lies in the folder of the campaign, or of the answers.
const SCRIPT: &str = "slurm/job.sh";

/// Arguments of `submit`.
#[derive(Debug, clap::Args)]
pub struct Arguments {
    /// The folder of a campaign that was planned, or of a set of CauseBench, on a disk that the nodes share
    #[arg(value_name = "DIR")]
    folder: PathBuf,
    /// Of a set: the folder of an entrant's answers
    #[arg(long, value_name = "DIR", requires = "command")]
    answers: Option<PathBuf>,
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
    /// Of a set: the entrant's command. It answers those trials k of the manifest, counted from 0, for which k mod N is
    /// K - 1, where the variable CAUSE_BENCH_PART is K/N
    #[arg(last = true, value_name = "COMMAND", requires = "answers")]
    command: Vec<String>,
}

/// What starts the tasks of a campaign on other machines.
#[derive(Debug, Clone, Copy, PartialEq, Eq, clap::ValueEnum)]
enum Engine {
    /// An array job, begun anew where a node fails
    Slurm,
}

/// Writes the job that makes what is left, and submits it.
pub fn run(arguments: &Arguments) -> Result<BenchExitStatus, BenchError> {
    let left = match &arguments.answers {
        Some(answers) => BenchManifest::open(&arguments.folder)?.remaining(answers),
        None => CampaignFolder::open(&arguments.folder)?.remaining(Part::WHOLE)?,
    };
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
    let (folder, task) = match &arguments.answers {
        Some(answers) => (answers, TaskKind::Entrant { command: &arguments.command }),
        None => (&arguments.folder, TaskKind::Work { program: &program }),
    };
    let root = std::path::absolute(folder)?;
    let script = ArrayJob {
        task,
        folder: &root,
        numbers,
        parts: arguments.parts,
        jobs: arguments.jobs,
        options: &arguments.sbatch,
    }
    .script()?;
    report::write_folder(folder, &[(SCRIPT, script.as_bytes())])?;

    let path = folder.join(SCRIPT);
    let said = format!("{} trials left, in {tasks} tasks", left.len());
    if arguments.dry_run {
        let job = quote_argument(&display_path(&path));
        return Ok(print(&format!("{said}. To submit them:\n  sbatch {job}\n"))?);
    }
    let number = JobNumber::submit(&path)?;
    Ok(print(&format!(
        "{said}, submitted as job {number}. To see how it goes on:\n  {}\n{}",
        number.squeue(),
        what_comes_next(arguments)
    ))?)
}

/// The commands that follow what was submitted.
fn what_comes_next(arguments: &Arguments) -> String {
    let quoted = |path: &Path| quote_argument(&display_path(path));
    let folder = quoted(&arguments.folder);
    match &arguments.answers {
        Some(answers) => format!(
            "At the end:\n  plumbline-bench score {folder} {} --truth FILE\n",
            quoted(answers)
        ),
        None => format!(
            "  plumbline-bench status {folder}\nAt the end:\n  plumbline-bench merge {folder}\n"
        ),
    }
}
