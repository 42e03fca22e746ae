use std::path::PathBuf;

/// Why a robot description cannot be used.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum RobotError {
    /// The file cannot be read.
    #[error("{}: {reason}", path.display())]
    Unreadable {
        /// The file.
        path: PathBuf,
        /// What the operating system said.
        reason: String,
    },
    /// A link's mass is zero or negative.
    #[error("link {link}: mass is {mass} kg, a positive number was expected")]
    MassNotPositive {
        /// Name of the link.
        link: String,
        /// The mass found.
        mass: f64,
    },
    /// A number that must be finite is not.
    #[error("{thing}: {quantity} is {value}, a finite number was expected")]
    NotFinite {
        /// What the number belongs to, such as `joint elbow`.
        thing: String,
        /// The quantity.
        quantity: &'static str,
        /// The value found.
        value: f64,
    },
    /// A link names a parent that does not come before it.
    #[error("link {link}: its parent has index {parent}, an index below {index} was expected")]
    ParentNotBefore {
        /// Name of the link.
        link: String,
        /// The parent's index found.
        parent: usize,
        /// The link's own index.
        index: usize,
    },
    /// Two joints or two links carry the same name.
    #[error("the name {name} is used by two {what}s, names must be unique")]
    DuplicateName {
        /// `joint` or `link`.
        what: &'static str,
        /// The name.
        name: String,
    },
    /// The robot has no moving joint.
    #[error("robot {robot}: it has no moving joint, at least one was expected")]
    NoJoints {
        /// Name of the robot.
        robot: String,
    },
}
