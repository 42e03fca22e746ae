//! The motion log: runs, checks, resampling, filters and derivatives.
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

mod checks;
mod error;
mod info;
mod naming;
mod reading;
mod runs;
mod signals;
mod writing;

pub use error::LogError;
pub use info::{JointInfo, LogInfo, TimeGap, log_info};
pub use log_formats::{Excerpt, FormatError, LerobotDataset};
pub use naming::column_map::ColumnMap;
pub use naming::map_entry::MappedColumn;
pub use naming::unit::Unit;
pub use reading::options::ReadOptions;
pub use reading::presets::{Recognised, preset_names, recognise};
pub use reading::read::{read_run, read_run_until_damage, run_of_columns};
pub use runs::duplicate::{duplicate_of, is_repeat, without_repeats};
pub use runs::repair::Repair;
pub use runs::run::{Channel, Channels, Run, of_run};
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
pub use writing::whole_file::{WholeFile, sync_folder};
pub use writing::write::{replace_file, table_bytes, write_csv, write_parquet, write_table};
pub use writing::writer::LogWriter;
