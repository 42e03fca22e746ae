//! Recordings to look at: a moving arm and its signals in a file of the viewer rerun.
//!
//! ```text
//! Scene ---> Recorder::create      the arms, the names of the signals, the layout of the screen
//! Rows ----> Recorder::rows        blocks of consecutive samples, while a run goes on
//!            Recorder::event, ::further, ::document, ::bars
//!            Recorder::finish ---> Written
//! Contents <--- Contents::read     what a file holds, also one that was cut
//! ```
//!
//! The file is the truth: a run that is killed leaves what it had recorded up to two seconds
//! before. A viewer that listens may be shown the same while it is written ([`Live::On`]); it
//! can be slow or go away without harm to the file.
//!
//! Numbers come in SI units and radians. Positions, velocities and torques are shown in them,
//! tracking errors in mrad or mm.

mod arms;
mod colour;
mod contents;
mod disk;
mod error;
mod layout;
mod live;
mod pace;
mod plots;
mod properties;
mod recorder;
mod scene;
mod seen;
mod shapes;
mod signals;
mod sinks;
mod skeleton;

pub use contents::{Contents, Entity};
pub use error::RecordingError;
pub use recorder::{Bar, Recorder, Rows, Written};
pub use scene::{Arm, Level, Listener, Live, Quantity, Role, Scene, Signal};
