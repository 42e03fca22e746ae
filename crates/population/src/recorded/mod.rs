//! Recorded logs of real arms as trials: as they are, and with a cause added to them.
//!
//! ```text
//! folder of logs -> arm -> logs, thinned and cut -> given and held out ----------> plain trial
//!                                                          \--> + law(q, qd, effort) -> transplant
//! ```

mod arm;
mod cut;
mod draw;
mod law;
mod point_mass;
mod signals;
mod size;
mod transplant;
mod trial;

pub use arm::{RecordedArm, available};
pub use law::Law;
pub use point_mass::{PointMass, point_mass_torque};
pub use transplant::Transplant;
pub use trial::{RecordedTrial, draw_recorded};
