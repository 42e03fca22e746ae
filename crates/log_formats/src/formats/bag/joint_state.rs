//! Messages `sensor_msgs/msg/JointState`.

use crate::formats::bag::{cdr::Cdr, joint_message::JointMessage};

/// Name of the message type.
pub(crate) const TYPE: &str = "sensor_msgs/msg/JointState";

/// Decodes a message in CDR, or gives the reason why it cannot be read.
pub(crate) fn decode(message: &[u8]) -> Result<JointMessage, String> {
    let mut cdr = Cdr::new(message).ok_or("it is not encoded as plain CDR")?;
    let (stamp_ns, joints) = cdr.stamped_names().ok_or(CUT)?;
    let mut values = || cdr.sequence(Cdr::f64).ok_or(CUT);
    let channels = [("position", values()?), ("velocity", values()?), ("effort", values()?)];
    JointMessage::new(stamp_ns, joints, channels)
}

/// The reason for a message whose fields cannot be decoded.
pub(crate) const CUT: &str = "it is cut off, or of another type";
