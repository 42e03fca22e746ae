//! What a robot is: links, joints, inertias and actuators, in the form every
//! other crate reads.
//!
//! ```text
//! tau = M(q) qdd + C(q, qd) qd + g(q) + (what the actuators add)
//! ```
//!
//! The terms of a rigid body come from [`Link`] and [`Joint`], what an actuator
//! adds from [`Actuator`]. [`Robot::load`] reads them from `robot.urdf` and
//! `robot.toml`, or from an MJCF. Data only: no dynamics is computed here. [`Machine`] is what a controller
//! sees of an arm, simulated or real.

mod actuator;
mod content;
mod control;
mod description;
mod description_file;
mod error;
mod inertia;
mod joint;
mod joint_entry;
mod link;
mod load;
mod looks;
mod lumping;
mod machine;
mod mesh;
mod mesh_kind;
mod misfit;
mod mjcf;
mod model;
mod packages;
mod part;
mod range;
mod urdf;
mod warning;
mod write;

pub use actuator::{
    Actuator, Counterbalance, Coupling, Ripple, SensingSide, Stribeck, TorqueSource, Warming, Wave,
};
pub use control::{ControlSettings, Gain};
pub use error::RobotError;
pub use inertia::{Inertia, InertiaDefect};
pub use joint::{Joint, JointKind, Limits};
pub use link::Link;
pub use load::{LoadOptions, Loaded, MeshFolders};
pub use looks::{Looks, Shape, Visual};
pub use machine::{Machine, MachineFault, Reading};
pub use model::Robot;
pub use packages::Packages;
pub use part::{LockedJoint, Part};
pub use warning::RobotWarning;
