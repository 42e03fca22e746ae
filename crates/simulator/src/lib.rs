//! The truth side: an articulated arm on rapier with injected effects and simulated sensors.
//!
//! ```text
//! M(q) qdd + C(q, qd) qd + g(q) + effects = tau
//! ```
//!
//! Rapier solves the equations of motion in steps of first order; in those of second order ([`StepOrder`]), which replays
//! take, a tree of bodies of this crate does. The project's own dynamics is not used here, so that the code that makes a log
//! and the code that explains it check each other.

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
pub use mechanics::step_order::StepOrder;
pub use mechanics::transmission::Transmission;
pub use replay::forward::{ForwardReplay, Windows, replay_torque};
pub use replay::motion::{MotionReplay, replay_motion};
pub use run::arm_state::ArmState;
pub use run::effect_sizer::EffectSizer;
pub use run::laws::{ActingLaws, LawRow};
pub use run::simulate::{
    Simulation, arm, draw_hidden_effects, simulate, simulate_noise_free, simulate_noise_free_start,
    simulate_only,
};
pub use run::true_run::{TrueRow, TrueRun, simulate_truly};
pub use run::write::{LogFormat, truth_schema, write};
pub use sensors::{EffortSource, JointSensor, LinkEncoder, PositionSide, Sensors, VelocitySource};
pub use simulator::{Simulator, Stepping};
pub use strangers::kind::StrangerKind;
pub use strangers::spec::StrangerSpec;
pub use strangers::truth::StrangerTruth;
