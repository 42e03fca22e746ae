//! One file per command: its arguments and what it does.

pub mod compare;
pub mod completions;
pub mod demo;
pub mod design;
pub mod diagnose;
pub mod explain;
pub mod export;
pub mod learn;
pub mod log_columns;
pub mod log_info;
pub mod man;
pub mod replay;
pub mod robot_check;
pub mod robot_init;
pub mod run;
pub mod schema;
pub mod simulate;
pub mod track;
pub mod view;
