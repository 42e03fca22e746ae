//! Trials as workshops vary: an arm, a nominal model of it, its sensors, its motions and what is wrong with
//! it, all drawn from one seed, and what an oracle that knows the truth could see of each cause.
//!
//! ```text
//! seed --draw--> arm, nominal model, sensors, runs, causes, strangers --simulator--> logs
//!                                  \--> sheet.json: what is true, opened by scoring alone
//! ```
//!
//! All of it is on the truth side: nothing here uses the project's dynamics, its effects' columns or its
//! diagnosis.

mod arms;
mod bench;
mod corner;
mod dice;
mod error;
mod motions;
mod moving;
mod oracle;
mod recorded;
mod rigid;
mod robot_files;
mod sensors;
mod sheet;
mod spec;
mod store;
mod text_file;
mod trial;

pub use bench::{BenchWishes, LabBench, draw_bench};
pub use corner::{ArmClass, Corner, EffortClass, MotionClass, Origin};
pub use error::PopulationError;
pub use recorded::arm::{RecordedArm, available};
pub use recorded::law::Law;
pub use recorded::point_mass::{PointMass, point_mass_torque};
pub use recorded::transplant::Transplant;
pub use recorded::trial::{RecordedTrial, draw_recorded};
pub use robot_files::RobotFiles;
pub use sheet::{Cause, Knowledge, Role, Sheet, Strength, Unnamed};
pub use spec::{FORMAT, PopulationSpec, RecordedSpec};
pub use store::{Came, Kept, Remade, Store};
pub use trial::any::make_any;
pub use trial::make::make;
