//! The motion log: its files, checks, resampling, filters and derivatives.
//!
//! ```text
//! file -> read_run -> Run -> prepare -> q, qd, qdd, effort on a uniform clock
//! ```
//!
//! A run is one file, a bag of ROS 2 or an episode of a dataset of LeRobot, with the columns `time` (s) and, per joint,
//! `<joint>.position`, `.velocity`, `.acceleration`, `.effort`, `.desired_position`,
//! `.desired_velocity`, `.desired_acceleration`, `.commanded_effort` and, from a second
//! encoder, `.link_position` (SI units, radians). Only `time`, `position` and `effort` have to
//! be there. Columns are found by name, never by their place; a [`ColumnMap`] reads files that
//! use other names or units. A log is written as a whole by [`write_csv`] and [`write_parquet`], or while it
//! grows by a [`LogWriter`].
//!
//! After [`prepare`], `q`, `qd` and `qdd` have passed the same zero-phase [`LowPass`];
//! the effort has not, so that one filter can be applied to it and to every regressor
//! column alike.

mod agreement;
mod allowance;
mod array_numbers;
mod bag;
mod cdr;
mod choice;
mod clock;
mod collected;
mod column_map;
mod content;
mod csv_file;
mod cutoff;
mod damage;
mod degrees;
mod dialect;
mod differentiate;
mod duplicate;
mod error;
mod even_clock;
mod excerpt;
mod filter;
mod filtered;
mod fourier;
mod guarded;
mod held;
mod impossible;
mod info;
mod joint_state;
mod joint_states;
mod kind;
mod lattice;
mod lerobot;
mod link_lag;
mod list_column;
mod literal;
mod log_file;
mod map_entry;
mod map_pattern;
mod matlab_element;
mod matlab_file;
mod matlab_hdf5;
mod mcap_file;
mod mcap_record;
mod mend;
mod motion_band;
mod noise;
mod npy_header;
mod numeral;
mod numpy_array;
mod numpy_file;
mod parquet_file;
mod plan;
mod position_loop;
mod prepare;
mod prepared;
mod presets;
mod read;
mod readings;
mod rest;
mod run;
mod session;
mod sources;
mod spectrum;
mod sqlite_file;
mod sqlite_pages;
mod sqlite_record;
mod sqlite_table;
mod stretches;
mod table;
mod topic;
mod turns;
mod uniform;
mod unit;
mod unpacked;
mod warning;
mod whole_file;
mod write;
mod writer;

pub use agreement::Agreement;
pub use column_map::ColumnMap;
pub use differentiate::differentiate;
pub use duplicate::{distinct, duplicate_of, repeated};
pub use error::LogError;
pub use excerpt::Excerpt;
pub use filter::{LowPass, decimate};
pub use fourier::Fourier;
pub use held::centre_commands;
pub use info::{Gap, JointInfo, LogInfo, log_info};
pub use lerobot::Dataset;
pub use map_entry::MappedColumn;
pub use mend::Mend;
pub use noise::{ChannelNoise, JointNoise, NoiseSource};
pub use prepare::{PrepareSettings, prepare};
pub use prepared::{Prepared, PreparedJoint, PreparedLink, PreparedRun, Wide};
pub use presets::{Recognised, preset_names, recognised};
pub use read::{ReadOptions, read_run, read_run_until_damage, run_of_columns};
pub use rest::rest_speeds;
pub use run::{Channel, Channels, Run, of_run};
pub use stretches::{ENOUGH_SAMPLES, stretches};
pub use unit::Unit;
pub use warning::LogWarning;
pub use whole_file::{WholeFile, sync_folder};
pub use write::{replace_file, table_bytes, write_csv, write_parquet, write_table};
pub use writer::LogWriter;
