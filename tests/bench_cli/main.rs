//! The program plumbline-bench: campaigns, figures, messages and exit codes, from the outside.
#![allow(clippy::unwrap_used, reason = "a helper that fails is a test that fails")]

#[cfg(target_os = "linux")]
#[path = "../cli/alarm.rs"]
mod alarm;
#[path = "../cli/arm.rs"]
#[allow(dead_code, reason = "the tests of plumbline use all of it")]
mod arm;
mod campaign;
mod campaigns;
mod cause_bench;
mod compare;
#[cfg(target_os = "linux")]
#[path = "../cli/disk.rs"]
mod disk;
#[cfg(target_os = "linux")]
#[path = "../cli/faults.rs"]
mod faults;
mod figure;
#[cfg(target_os = "linux")]
#[path = "../cli/io_faults.rs"]
mod io_faults;
#[cfg(target_os = "linux")]
#[path = "../cli/kills.rs"]
mod kills;
#[cfg(target_os = "linux")]
#[path = "../cli/limits.rs"]
mod limits;
#[cfg(target_os = "linux")]
mod loopback_slurm;
#[cfg(target_os = "linux")]
#[path = "../cli/named_files.rs"]
mod named_files;
#[cfg(target_os = "linux")]
#[path = "../cli/power_loss.rs"]
mod power_loss;
mod program;
mod replay_answers;
mod scenarios;
#[cfg(target_os = "linux")]
mod slurm;
#[cfg(target_os = "linux")]
mod sockets;
#[cfg(unix)]
mod submit;
mod times;
#[cfg(target_os = "linux")]
#[path = "../cli/undisturbed.rs"]
mod undisturbed;
#[cfg(target_os = "linux")]
mod writers;
