/// A joint that is held at a position.
#[derive(Debug, Clone, PartialEq)]
pub struct LockedJoint {
    /// Name of the joint.
    pub joint: String,
    /// The position (rad or m).
    pub position: f64,
    /// The joint that it mimics, where that decides its position.
    pub mimics: Option<String>,
}
