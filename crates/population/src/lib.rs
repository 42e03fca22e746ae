//! Trials with the variety of workshops: an arm, its nominal model, its sensors, its motions and its faults, all
//! drawn from one seed, with the visibility of each cause to an oracle that knows the truth.
//!
//! ```text
//! seed --draw--> arm, nominal model, sensors, runs, causes, strangers --simulator--> logs
//!                                  \--> sheet.json: the truth, read by scoring alone
//! ```
//!
//! The crate belongs to the truth side and never uses the project's dynamics, effect columns or diagnosis.

mod arms;
mod bench;
mod corner;
mod damaged;
mod dice;
mod error;
mod hidden;
mod instruments;
mod log_kind;
mod motions;
mod moving;
mod oracle;
mod recorded;
mod rigid;
mod robot_files;
mod robot_shares;
mod sensors;
mod sheet;
mod spec;
mod store;
mod text_file;
mod trial;

pub use bench::{BenchWishes, LabBench, draw_bench};
pub use corner::{ArmClass, Corner, EffortClass, FieldFeature, MotionClass, Origin};
pub use damaged::{LogDamageSpec, damage_logs};
pub use error::PopulationError;
pub use instruments::Instruments;
pub use log_kind::LogKind;
pub use recorded::arm::{RecordedArm, available};
pub use recorded::law::AddedLaw;
pub use recorded::point_mass::{PointMass, point_mass_torque};
pub use recorded::transplant::Transplant;
pub use recorded::trial::{
    RecordedTrial, count_recorded_splits, draw_recorded_trial, read_recorded_split,
};
pub use robot_files::RobotFiles;
pub use robot_shares::RobotShares;
pub use sheet::{CauseRole, Knowledge, LogSpoiling, Strength, TrueCause, TrueStranger, TruthSheet};
pub use spec::{FORMAT, LogKindSpec, PopulationSpec, RecordedSpec, ServoShareSpec};
pub use store::{Came, Kept, Remade, Store};
pub use trial::again::sheet_again;
pub use trial::any::{make_any, make_recorded_split};
pub use trial::make::make;
