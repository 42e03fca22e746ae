//! The truth side: an articulated arm on rapier into which effects are put, seen through its
//! sensors.
//!
//! ```text
//! M(q) qdd + C(q, qd) qd + g(q) + effects = tau
//! ```
//!
//! The equations of motion are rapier's: nothing here uses the project's own dynamics, so that
//! what explains a log and what made it check each other.

mod arm;
mod delay_line;
mod draw;
pub mod effects;
mod engine;
mod error;
mod inject;
mod plant;
mod recorded;
mod replay;
mod run;
pub mod scenario;
mod sensors;
mod simulator;
pub mod strangers;
mod truth;

pub use draw::Bench;
pub use error::SimulatorError;
pub use inject::{Efforts, Inject, Moment};
pub use plant::{Plant, Transmission};
pub use replay::{ForwardReplay, MotionReplay, Windows, replay_motion, replay_torque};
pub use run::{
    LogFormat, Simulation, arm, drawn, simulate, simulate_only, simulate_silent,
    simulate_silent_start, write,
};
pub use sensors::{EffortSource, JointSensor, LinkEncoder, PositionSide, Sensors, VelocitySource};
pub use simulator::{Simulator, Stepping};
pub use strangers::{StrangerKind, StrangerSpec, StrangerTruth};
pub use truth::Truth;
