//! The truth side: an articulated arm on rapier into which effects are put, seen through its
//! sensors.
//!
//! ```text
//! M(q) qdd + C(q, qd) qd + g(q) + effects = tau
//! ```
//!
//! The equations of motion are rapier's: nothing here uses the project's own dynamics, so that
//! what explains a log and what made it check each other.

mod delay_line;
pub mod effects;
mod error;
mod mechanics;
mod replay;
mod run;
pub mod scenario;
mod seed;
mod sensors;
mod simulator;
pub mod strangers;

pub use effects::truth::Truth;
pub use error::SimulatorError;
pub use mechanics::inject::{Efforts, Inject, Moment};
pub use mechanics::plant::Plant;
pub use mechanics::transmission::Transmission;
pub use replay::forward::{ForwardReplay, Windows, replay_torque};
pub use replay::motion::{MotionReplay, replay_motion};
pub use run::effect_sizer::EffectSizer;
pub use run::simulate::{
    Simulation, arm, drawn, simulate, simulate_only, simulate_silent, simulate_silent_start,
};
pub use run::write::{LogFormat, write};
pub use sensors::{EffortSource, JointSensor, LinkEncoder, PositionSide, Sensors, VelocitySource};
pub use simulator::{Simulator, Stepping};
pub use strangers::kind::StrangerKind;
pub use strangers::spec::StrangerSpec;
pub use strangers::truth::StrangerTruth;
