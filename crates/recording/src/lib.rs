//! Recordings to look at: a moving arm and its signals in a file of the viewer rerun.
//!
//! ```text
//! Scene ---> Recorder::create      the arms, the names of the signals, the layout of the screen
//! Rows ----> Recorder::rows        blocks of consecutive samples, while a run goes on
//!            Recorder::event, ::further, ::document, ::bars
//!            Recorder::finish ---> FinishedRecording
//! Contents <--- Contents::read     what a file holds, also one that was cut
//! ```
//!
//! The file is the truth: a run that is killed leaves what it had recorded up to two seconds
//! before. A viewer that listens may be shown the same while it is written ([`Live::On`]); it
//! can be slow or go away without harm to the file.
//!
//! Numbers come in SI units and radians. Positions, velocities and torques are shown in them,
//! tracking errors in mrad or mm.
//!
//! Without the feature `rerun` nothing is recorded ([`IS_BUILT`]), and half of the packages that a build takes are
//! left out.

#[cfg(feature = "rerun")]
mod arms;
#[cfg(feature = "rerun")]
mod bounding_box;
#[cfg(feature = "rerun")]
mod colour;
#[cfg(feature = "rerun")]
mod contents;
#[cfg(feature = "rerun")]
mod disk;
#[cfg(feature = "rerun")]
mod entities;
mod error;
#[cfg(feature = "rerun")]
mod live;
#[cfg(not(feature = "rerun"))]
mod no_recorder;
#[cfg(feature = "rerun")]
mod plots;
#[cfg(feature = "rerun")]
mod properties;
#[cfg(feature = "rerun")]
mod recorder;
#[cfg(feature = "rerun")]
mod row_pace;
mod rows;
mod scene;
#[cfg(feature = "rerun")]
mod screen_layout;
#[cfg(feature = "rerun")]
mod shapes;
#[cfg(feature = "rerun")]
mod signals;
#[cfg(feature = "rerun")]
mod sinks;
#[cfg(feature = "rerun")]
mod skeleton;

#[cfg(feature = "rerun")]
pub use contents::{Contents, Entity};
pub use error::RecordingError;
#[cfg(not(feature = "rerun"))]
pub use no_recorder::Recorder;
#[cfg(feature = "rerun")]
pub use recorder::Recorder;
pub use rows::{BarSeries, FinishedRecording, RowBlock};
pub use scene::{Arm, EventLevel, Listener, Live, Scene, SceneRole, SceneSignal, SignalQuantity};

/// Whether recordings are written: what the feature `rerun` says.
pub const IS_BUILT: bool = cfg!(feature = "rerun");
