//! The program: messages, exit codes and files, from the outside.
#![allow(clippy::unwrap_used, reason = "a helper that fails is a test that fails")]

#[cfg(target_os = "linux")]
mod alarm;
mod another_engine;
mod arm;
mod at_limits;
mod bad_input;
#[cfg(unix)]
mod book;
mod commands;
mod compare;
mod completions;
mod design;
mod diagnose;
#[cfg(target_os = "linux")]
mod disk;
mod excerpt;
mod export;
#[cfg(target_os = "linux")]
mod faults;
mod files;
mod foreign_files;
mod help;
mod hostile_names;
mod impossible;
mod installed;
#[cfg(target_os = "linux")]
mod io_faults;
#[cfg(target_os = "linux")]
mod kills;
mod learn;
mod lerobot;
#[cfg(target_os = "linux")]
mod limits;
mod long_names;
#[cfg(target_os = "linux")]
mod named_files;
#[cfg(target_os = "linux")]
mod power_loss;
mod program;
mod remembered;
mod replay;
mod robot_init;
mod run;
mod schemas;
mod servo;
mod simulate;
#[cfg(target_os = "linux")]
mod sockets;
#[cfg(target_os = "linux")]
mod terminal;
mod track;
#[cfg(target_os = "linux")]
mod undisturbed;
mod view;
#[cfg(target_os = "linux")]
mod writers;
mod writing;
