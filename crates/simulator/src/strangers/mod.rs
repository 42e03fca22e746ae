//! Effects outside the catalogue, one file each: they occur in workshops, but a diagnosis has no name
//! for them.

pub(crate) mod bump;
pub(crate) mod chain;
pub(crate) mod drive_dead_zone;
pub(crate) mod eccentric_encoder;
pub(crate) mod integrator_windup;
pub(crate) mod kind;
pub(crate) mod list;
pub(crate) mod magnet_well;
pub(crate) mod scenario_stranger;
pub(crate) mod snag;
pub(crate) mod soft_mount;
pub(crate) mod soft_wall;
pub(crate) mod spec;
pub(crate) mod speed_crosstalk;
pub(crate) mod square_drag;
pub(crate) mod tilting_bearing;
pub(crate) mod torque_dropout;
pub(crate) mod torque_rate_limit;
pub(crate) mod truth;

pub use drive_dead_zone::DriveDeadZone;
pub use eccentric_encoder::EccentricEncoder;
pub use integrator_windup::IntegratorWindup;
pub use kind::StrangerKind;
pub use magnet_well::MagnetWell;
pub use scenario_stranger::ScenarioStranger;
pub use snag::Snag;
pub use soft_mount::SoftMount;
pub use soft_wall::{Side, SoftWall};
pub use spec::StrangerSpec;
pub use speed_crosstalk::SpeedCrosstalk;
pub use square_drag::SquareDrag;
pub use tilting_bearing::TiltingBearing;
pub use torque_dropout::TorqueDropout;
pub use torque_rate_limit::TorqueRateLimit;
pub use truth::StrangerTruth;
