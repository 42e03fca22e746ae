use std::path::PathBuf;

/// Why trials cannot be submitted to Slurm.
#[derive(Debug, thiserror::Error)]
pub enum SubmitError {
    /// A path cannot stand in a job.
    #[error(
        "{path:?}: a path in UTF-8 without line breaks and backslashes was expected, a job of Slurm can name no other"
    )]
    Path {
        /// The path.
        path: PathBuf,
    },
    /// There is no sbatch.
    #[error("sbatch: it cannot be started ({reason}), Slurm's program on the PATH was expected")]
    NoSbatch {
        /// What the operating system said.
        reason: String,
    },
    /// Slurm does not take the job.
    #[error("{}: sbatch does not take it: {reason}", script.display())]
    Refused {
        /// The job.
        script: PathBuf,
        /// What sbatch said.
        reason: String,
    },
    /// Slurm does not say which job it has become.
    #[error("{}: sbatch said {answer:?}, the number of a job was expected", script.display())]
    NoNumber {
        /// The job.
        script: PathBuf,
        /// What sbatch said.
        answer: String,
    },
}

impl SubmitError {
    /// What to do about it, where that can be said.
    pub fn help(&self) -> Option<&'static str> {
        let missing = matches!(self, Self::NoSbatch { .. });
        missing.then_some(
            "the job is in the folder, in slurm/job.sh: submit it with sbatch from a machine of the cluster",
        )
    }
}
