use robot::{Looks, Robot};

/// What a recording shows; given before the first row.
#[derive(Debug, Clone)]
pub struct Scene<'a> {
    /// Name of the recording in the viewer.
    pub title: &'a str,
    /// Joints and their order in every row.
    pub robot: &'a Robot,
    /// Shapes of its links; a link without one is drawn as a stick.
    pub looks: &'a Looks,
    /// The arms that move in the picture.
    pub arms: Vec<Arm<'a>>,
    /// The signals, each with one number a joint and row.
    pub signals: Vec<SceneSignal<'a>>,
}

/// One arm in the picture.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Arm<'a> {
    /// Name, such as `measured`.
    pub name: &'a str,
    /// The role `Actual` is drawn solid, every other one as a ghost in its colour. `Actual` and
    /// `Desired` leave the path of their tip behind: models may start anew again and again.
    pub role: SceneRole,
}

/// One signal of every joint.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SceneSignal<'a> {
    /// Decides the plot.
    pub quantity: SignalQuantity,
    /// Name in the legend, such as `measured`.
    pub name: &'a str,
    /// Decides the colour.
    pub role: SceneRole,
}

/// The role of an arm or a signal. It decides the colour ([`colours::Role`]).
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum SceneRole {
    /// Asked for.
    Desired,
    /// What happened, measured or applied.
    Actual,
    /// What the model as given predicts.
    Nominal,
    /// What a model with findings, or a learned one, predicts.
    Predicted,
    /// A difference.
    Error,
    /// One of several models side by side, in a colour of its own.
    Model(usize),
}

/// What a signal measures, for rotating joints and for sliding ones.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum SignalQuantity {
    /// Position (rad or m).
    Position,
    /// Velocity (rad/s or m/s).
    Velocity,
    /// Torque or force (N m or N).
    Torque,
    /// Part of the torque that a model does not explain (N m or N).
    Residual,
    /// Reference minus actual position (rad or m), shown in mrad or mm.
    Error,
}

#[cfg(feature = "rerun")]
impl SignalQuantity {
    /// Every quantity, in the order of the plots.
    pub(crate) const ALL: [Self; 5] =
        [Self::Position, Self::Velocity, Self::Torque, Self::Residual, Self::Error];

    /// Name of its column in the file.
    pub(crate) fn key(self) -> &'static str {
        match self {
            Self::Position => "position",
            Self::Velocity => "velocity",
            Self::Torque => "torque",
            Self::Residual => "residual",
            Self::Error => "error",
        }
    }

    /// Name and unit of its plot.
    pub(crate) fn title(self, kind: robot::JointKind) -> &'static str {
        match (self, kind.is_rotation()) {
            (Self::Position, true) => "position (rad)",
            (Self::Position, false) => "position (m)",
            (Self::Velocity, true) => "velocity (rad/s)",
            (Self::Velocity, false) => "velocity (m/s)",
            (Self::Torque, true) => "torque (N·m)",
            (Self::Torque, false) => "force (N)",
            (Self::Residual, true) => "residual torque (N·m)",
            (Self::Residual, false) => "residual force (N)",
            (Self::Error, true) => "error (mrad)",
            (Self::Error, false) => "error (mm)",
        }
    }

    /// What a number is multiplied by to be shown.
    pub(crate) fn scale(self) -> f64 {
        if self == Self::Error { 1e3 } else { 1.0 }
    }
}

/// Whether a running viewer is shown the recording while it is written.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Live {
    /// The file alone.
    Off,
    /// A viewer too, if one listens on 127.0.0.1:9876.
    On,
}

/// Who was shown the recording while it was written.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Listener {
    /// Nobody was asked for.
    NotAsked,
    /// Nobody listened on 127.0.0.1:9876.
    Nobody,
    /// A viewer listened.
    Viewer {
        /// Messages that it was too slow for; the file has them all.
        left_out: u64,
    },
}

/// How much an event matters.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum EventLevel {
    /// Worth knowing.
    Info,
    /// Worth a look.
    Warning,
    /// Something went wrong.
    Error,
}

#[cfg(feature = "rerun")]
impl EventLevel {
    pub(crate) fn label(self) -> &'static str {
        match self {
            Self::Info => rerun::TextLogLevel::INFO,
            Self::Warning => rerun::TextLogLevel::WARN,
            Self::Error => rerun::TextLogLevel::ERROR,
        }
    }
}
