//! The description of a robot: links, joints, inertias and actuators, for all other crates.
//!
//! ```text
//! tau = M(q) qdd + C(q, qd) qd + g(q) + (what the actuators add)
//! ```
//!
//! [`Link`] and [`Joint`] hold the rigid bodies, [`Actuator`] holds the terms of the drives.
//! [`Robot::load`] reads them from `robot.urdf` and `robot.toml`, or from an MJCF. The crate holds data and
//! computes no dynamics. [`Machine`] is the interface of a controller to an arm, simulated or real.

mod content;
mod error;
mod load;
mod loaded;
mod machine;
mod meshes;
mod misfit;
mod mjcf;
mod one_line;
mod range;
mod robot_toml;
mod structure;
mod urdf;
mod warning;
mod whole_robot;

pub use error::RobotError;
pub use load::LoadOptions;
pub use loaded::Loaded;
pub use machine::{Machine, MachineFault, Reading};
pub use meshes::folders::MeshFolders;
pub use meshes::packages::Packages;
pub use robot_toml::schema::description_schema;
pub use structure::actuator::{
    Actuator, CounterbalanceTerm, Coupling, FrictionWave, Ripple, SensingSide, Stribeck,
    TorqueSource, Warming,
};
pub use structure::control::{ControlSettings, PdGain};
pub use structure::inertia::{Inertia, InertiaDefect};
pub use structure::joint::{Joint, JointKind, Limits};
pub use structure::link::Link;
pub use structure::locked_joint::LockedJoint;
pub use structure::looks::{Looks, Shape, Visual};
pub use structure::part::JointSelection;
pub use structure::robot::Robot;
pub use structure::wide_inertia::WideInertia;
pub use warning::RobotWarning;
