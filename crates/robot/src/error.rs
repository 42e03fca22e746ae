use std::path::{Path, PathBuf};

use document::DocumentError;

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
    /// The mass of a link that moves is zero, or that of any link negative.
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
    /// The robot has too many joints.
    #[error(
        "robot {robot}: it has {found} joints that move, up to {most} were expected; keep some of them (--joints, or joints in a robot.toml)"
    )]
    TooManyJoints {
        /// Name of the robot.
        robot: String,
        /// Joints found.
        found: usize,
        /// Largest number of joints.
        most: usize,
    },
    /// The robot has no moving joint.
    #[error("robot {robot}: it has no moving joint, at least one was expected")]
    NoJoints {
        /// Name of the robot.
        robot: String,
    },
    /// Something is wrong inside a file.
    #[error("{}: {problem}", path.display())]
    InFile {
        /// The file.
        path: PathBuf,
        /// What is wrong with it.
        problem: Box<RobotError>,
    },
    /// The file holds nothing but white space.
    #[error("the file is empty, a URDF or a robot.toml was expected")]
    Empty,
    /// The file is larger than any robot description.
    #[error("the file has more than {limit} bytes, a URDF or a robot.toml was expected")]
    TooLarge {
        /// Largest size accepted (bytes).
        limit: u64,
    },
    /// The text is not XML, or not a URDF.
    #[error("line {line}: {reason}")]
    Malformed {
        /// Line in the file, from 1.
        line: usize,
        /// What was found and what was expected.
        reason: String,
    },
    /// A link or joint element cannot be read.
    #[error("line {line}: {element}: {reason}")]
    BadElement {
        /// The element, such as `link forearm`.
        element: String,
        /// Line in the file, from 1.
        line: usize,
        /// What was found and what was expected.
        reason: String,
    },
    /// Something in a `robot.toml` is not what was expected.
    #[error("{problem}")]
    InToml {
        /// What, and where it stands.
        problem: Box<DocumentError>,
    },
    /// A joint has an unsupported type.
    #[error(
        "joint {joint}: its type is {kind}, revolute, continuous, prismatic or fixed was \
         expected{}",
        of_base(kind)
    )]
    UnsupportedJoint {
        /// Name of the joint.
        joint: String,
        /// The type found.
        kind: &'static str,
    },
    /// Joints mimic one another in a ring.
    #[error(
        "joint {joint}: it mimics itself, directly or through others, a joint that moves by itself \
         was expected in the end"
    )]
    MimicLoop {
        /// Name of a joint of the ring.
        joint: String,
    },
    /// The axis of a moving joint has no direction.
    #[error("joint {joint}: its axis is (0, 0, 0), a direction was expected")]
    ZeroAxis {
        /// Name of the joint.
        joint: String,
    },
    /// A number lies outside of its range.
    #[error("{thing}: {quantity} is {value}, {expected} was expected")]
    OutOfRange {
        /// What the number belongs to, such as `joint elbow`.
        thing: String,
        /// The quantity, as the file calls it.
        quantity: &'static str,
        /// The value found.
        value: f64,
        /// The range, in words.
        expected: &'static str,
    },
    /// The position limits of a joint are the wrong way round.
    #[error("joint {joint}: its lower limit {lower} is above its upper limit {upper}")]
    LimitsReversed {
        /// Name of the joint.
        joint: String,
        /// Lower limit (rad or m).
        lower: f64,
        /// Upper limit (rad or m).
        upper: f64,
    },
    /// A link is the child of two joints: the URDF describes a closed chain.
    #[error(
        "link {link}: it is the child of joints {first} and {second}, one was expected: remove one of \
         the two to cut the closed chain open; the force that joint carries is then left out"
    )]
    TwoParents {
        /// Name of the link.
        link: String,
        /// The joint that claims it first.
        first: String,
        /// The joint that claims it again.
        second: String,
    },
    /// A link is its own ancestor.
    #[error(
        "link {link}: it is its own ancestor, a tree without loops was expected: remove a joint of the loop"
    )]
    Loop {
        /// Name of a link in the loop.
        link: String,
    },
    /// More than one link has no parent.
    #[error("links {first} and {second} both have no parent, one root was expected")]
    SeveralRoots {
        /// The first root.
        first: String,
        /// The second root.
        second: String,
    },
    /// A name is unknown.
    #[error("{place}: there is no {what} {name}, {hint}")]
    UnknownName {
        /// Where the name is used.
        place: String,
        /// `joint` or `link`.
        what: &'static str,
        /// The name.
        name: String,
        /// The nearest name, or the names there are.
        hint: String,
    },
    /// The robot differs from its URDF in something `robot.toml` has no key for.
    #[error("{thing}: its {quantity} differs from the URDF, robot.toml has no key for it")]
    NotDescribable {
        /// The joint or link.
        thing: String,
        /// What differs.
        quantity: &'static str,
    },
    /// The TOML writer refused a value.
    #[error("robot.toml cannot be written: {reason}")]
    Unwritable {
        /// What the writer said.
        reason: String,
    },
}

/// What to know of a type that only a base may have.
fn of_base(kind: &str) -> String {
    match kind {
        "floating" | "planar" => format!("; only a base may be {kind}, which is then held fixed"),
        _ => String::new(),
    }
}

impl RobotError {
    /// The same error, with the file it was found in.
    pub(crate) fn in_file(self, path: &Path) -> Self {
        Self::InFile { path: path.to_owned(), problem: Box::new(self) }
    }

    /// What a file is told that is neither a URDF nor a `robot.toml`.
    pub(crate) fn neither_xml_nor_toml(path: &Path) -> Self {
        let reason = "it is neither XML nor TOML, a URDF or a robot.toml was expected".to_owned();
        Self::Unreadable { path: path.to_owned(), reason }
    }

    /// A name that none of `known` is.
    pub(crate) fn unknown_name(
        place: impl Into<String>,
        what: &'static str,
        name: &str,
        known: &[&str],
    ) -> Self {
        let hint = match document::suggest(name, known.iter().copied()) {
            Some(nearest) => format!("did you mean {nearest}?"),
            None => format!("one of {} was expected", known.join(", ")),
        };
        Self::UnknownName { place: place.into(), what, name: name.to_owned(), hint }
    }
}
