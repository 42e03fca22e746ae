//! The motion log: runs, checks, resampling, filters and derivatives.
//!
//! ```text
//! file -> read_run -> Run -> prepare -> q, qd, qdd, effort on a uniform clock
//! ```
//!
//! A run is one file, one ROS 2 bag or one episode of a LeRobot dataset. Its columns are `time` (s) and, per joint,
//! `<joint>.position`, `.velocity`, `.acceleration`, `.effort`, `.desired_position`,
//! `.desired_velocity`, `.desired_acceleration`, `.commanded_effort` and, from a second
//! encoder, `.link_position` (SI units, radians). Only `time`, `position` and `effort` are
//! required. Columns are found by name, in any order; a [`ColumnMap`] reads files that
//! use other names or units. [`write_csv`] and [`write_parquet`] write a whole log, [`write_npz`] any columns;
//! a [`LogWriter`] writes one while it
//! is recorded.
//!
//! [`prepare`] applies the same zero-phase [`LowPass`] to `q`, `qd` and `qdd`. It does not filter
//! the effort, so that one filter can be applied later to the effort and to every regressor
//! column alike.

mod checks;
mod error;
mod info;
mod naming;
mod reading;
mod runs;
mod signals;
mod writing;

pub use checks::clocks::compare_clocks;
pub use error::LogError;
pub use info::{JointInfo, LogInfo, TimeGap, log_info};
pub use log_formats::{
    Excerpt, FormatError, LerobotDataset, check_parquet_nesting, files_of_run, is_there,
    name_of_run,
};
pub use naming::column_map::ColumnMap;
pub use naming::map_entry::MappedColumn;
pub use naming::unit::Unit;
pub use reading::options::ReadOptions;
pub use reading::overview::{ColumnOverview, FileOverview, file_overview};
pub use reading::presets::{Fitting, Recognised, preset_names, preset_table, recognise};
pub use reading::read::{read_run, read_run_until_damage, run_of_columns};
pub use runs::duplicate::{duplicate_of, is_repeat, without_repeats};
pub use runs::repair::Repair;
pub use runs::run::{Channel, Channels, GoalEffort, Run, of_run};
pub use runs::stretches::{ENOUGH_SAMPLES, thin_out};
pub use signals::agreement::Agreement;
pub use signals::differentiate::differentiate;
pub use signals::filter::{LowPass, decimate};
pub use signals::fourier_transform::FourierTransform;
pub use signals::held::centre_commands;
pub use signals::noise::{ChannelNoise, JointNoise, NoiseSource};
pub use signals::prepare::{PrepareSettings, prepare};
pub use signals::prepared::{Prepared, PreparedJoint, PreparedLink, PreparedRun, Wide};
pub use signals::rest::rest_speeds;
pub use signals::warning::LogWarning;
pub use writing::npz::write_npz;
pub use writing::whole_file::{WholeFile, sync_folder};
pub use writing::write::{
    replace_file, table_bytes, write_columns, write_csv, write_parquet, write_table,
};
pub use writing::writer::LogWriter;
