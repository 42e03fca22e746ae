/// Why a robot cannot be written.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum ExchangeError {
    /// The text that changes are written into is no XML.
    #[error("byte {at} of the URDF: {reason}")]
    Malformed {
        /// Where (bytes from the start).
        at: u64,
        /// What was found.
        reason: String,
    },
    /// The URDF names none of the joints of the robot.
    #[error("the URDF has no joint {joint}, which the robot has")]
    JointAbsent {
        /// Name of the joint.
        joint: String,
    },
}
