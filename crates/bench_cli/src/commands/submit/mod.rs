//! A campaign as an array job of Slurm.

pub mod array_job;
pub mod job_number;
pub mod sbatch_option;
pub mod submission;
