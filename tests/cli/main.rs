//! The program: messages, exit codes and files, from the outside.
#![allow(clippy::unwrap_used, reason = "a helper that fails is a test that fails")]

mod arm;
mod bad_input;
#[cfg(unix)]
mod book;
mod campaign;
mod commands;
mod compare;
mod completions;
mod design;
mod diagnose;
mod excerpt;
mod export;
#[cfg(target_os = "linux")]
mod faults;
mod figure;
mod files;
mod foreign_files;
mod impossible;
mod learn;
mod lerobot;
#[cfg(target_os = "linux")]
mod loopback_slurm;
mod program;
mod replay;
mod robot_init;
mod run;
mod servo;
mod simulate;
#[cfg(target_os = "linux")]
mod slurm;
#[cfg(target_os = "linux")]
mod sockets;
#[cfg(unix)]
mod submit;
mod track;
mod trials;
mod trials_compare;
mod view;
mod writing;
