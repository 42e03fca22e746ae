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
    /// Servos are asked for, and no joint has gains.
    #[error(
        "no joint of {robot} has a position loop: effort_source = {{ position_loop = ... }} in robot.toml was expected, or \
         kp_nm_per_rad and kd_nm_s_per_rad of its joints"
    )]
    NoPositionLoop {
        /// Name of the robot.
        robot: String,
    },
    /// A serialiser cannot write the file.
    #[error("the file cannot be written: {reason}")]
    Unwritable {
        /// What it says.
        reason: String,
    },
}
