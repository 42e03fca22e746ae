use std::fmt;
use std::path::Path;
use std::process::Command;

use crate::submit_error::SubmitError;

/// A job of Slurm by its number, and its cluster where there are several.
#[derive(Debug, PartialEq, Eq)]
pub struct JobNumber {
    number: u64,
    cluster: Option<String>,
}

impl JobNumber {
    /// Hands a job to Slurm.
    ///
    /// # Errors
    ///
    /// [`SubmitError`] when there is no Slurm or it does not take the job.
    pub fn submit(script: &Path) -> Result<Self, SubmitError> {
        let output = Command::new("sbatch")
            .arg("--parsable")
            .arg(script)
            .output()
            .map_err(|error| SubmitError::NoSbatch { reason: error.to_string() })?;
        if !output.status.success() {
            let said = String::from_utf8_lossy(&output.stderr).trim().to_owned();
            let reason = if said.is_empty() { output.status.to_string() } else { said };
            return Err(SubmitError::Refused { script: script.to_owned(), reason });
        }
        let answer = String::from_utf8_lossy(&output.stdout).into_owned();
        Self::from_answer(&answer)
            .ok_or_else(|| SubmitError::NoNumber { script: script.to_owned(), answer })
    }

    /// From what `sbatch --parsable` prints: `17` or `17;cluster`.
    fn from_answer(answer: &str) -> Option<Self> {
        let (number, cluster) = match answer.trim().split_once(';') {
            Some((number, cluster)) => (number, Some(cluster.to_owned())),
            None => (answer.trim(), None),
        };
        Some(Self { number: number.parse().ok()?, cluster })
    }

    /// The command that shows where its tasks are.
    pub fn squeue(&self) -> String {
        let cluster =
            self.cluster.as_ref().map_or(String::new(), |cluster| format!(" -M {cluster}"));
        format!("squeue{cluster} -j {}", self.number)
    }
}

impl fmt::Display for JobNumber {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}", self.number)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_job_is_told_by_its_number() {
        let job = |answer| JobNumber::from_answer(answer).map(|job| job.squeue());
        assert_eq!(job("17\n").as_deref(), Some("squeue -j 17"));
        assert_eq!(job("17;lab\n").as_deref(), Some("squeue -M lab -j 17"));
        assert_eq!(job("Submitted batch job 17"), None);
        assert_eq!(job(""), None);
    }
}
