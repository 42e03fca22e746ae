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

mod arm;
mod arm_generated;
mod arm_wam;
mod bench;
mod bodies;
mod by_joint;
mod chain;
mod corner;
mod dice;
mod drives;
mod electronics;
mod error;
mod ground;
mod make;
mod motions;
mod moving;
mod oracle;
mod postures;
mod recorded;
mod rigid;
mod robot_files;
mod sensors;
mod sheet;
mod spec;
mod store;
mod trial;
mod urdf_text;

pub use bench::{Bench, BenchWishes, draw_bench};
pub use corner::{ArmClass, Corner, EffortClass, MotionClass, Origin};
pub use error::PopulationError;
pub use oracle::JointNoise;
pub use recorded::{
    Law, PointMass, RecordedArm, RecordedTrial, Transplant, available, draw_recorded,
    point_mass_torque,
};
pub use robot_files::RobotFiles;
pub use sheet::{Cause, Knowledge, Role, Sheet, Strength, Unnamed};
pub use spec::{PopulationSpec, RecordedSpec};
pub use store::{Came, Kept, Remade, Store};
pub use trial::{make, make_any};

/// Version of all that logs and sheets follow from besides a [`PopulationSpec`]: draws, simulator, oracle.
pub const FORMAT: u32 = 1;
