//! Messages `control_msgs/msg/JointTrajectoryControllerState`.
//!
//! ```text
//! header, joint_names, reference, feedback, error, output       (since ROS 2 Iron)
//! header, joint_names, desired, actual, error                   (before)
//! ```
//!
//! A point is `positions, velocities, accelerations, effort, time_from_start`. The feedback is what the joints did, the
//! reference what the trajectory asked for. A feedback without efforts has those of the output: the efforts commanded.

use crate::formats::bag::{cdr::Cdr, joint_message::JointMessage, joint_state::CUT};

/// Name of the message type.
pub(crate) const TYPE: &str = "control_msgs/msg/JointTrajectoryControllerState";

/// A `trajectory_msgs/msg/JointTrajectoryPoint` without its time.
struct Point {
    positions: Vec<f64>,
    velocities: Vec<f64>,
    accelerations: Vec<f64>,
    efforts: Vec<f64>,
}

/// Decodes a message in CDR, or gives the reason why it cannot be read.
pub(crate) fn decode(message: &[u8]) -> Result<JointMessage, String> {
    let mut cdr = Cdr::new(message).ok_or("it is not encoded as plain CDR")?;
    let (stamp_ns, joints) = cdr.stamped_names().ok_or(CUT)?;
    let mut next = || point(&mut cdr);
    let (reference, feedback) = (next().ok_or(CUT)?, next().ok_or(CUT)?);
    next().ok_or(CUT)?;
    let output = next().map(|output| output.efforts).filter(|found| found.len() == joints.len());
    let efforts = match feedback.efforts {
        measured if measured.is_empty() => output.unwrap_or_default(),
        measured => measured,
    };
    let channels = [
        ("position", feedback.positions),
        ("velocity", feedback.velocities),
        ("acceleration", feedback.accelerations),
        ("effort", efforts),
        ("desired_position", reference.positions),
        ("desired_velocity", reference.velocities),
        ("desired_acceleration", reference.accelerations),
    ];
    JointMessage::new(stamp_ns, joints, channels)
}

fn point(cdr: &mut Cdr) -> Option<Point> {
    let mut values = || cdr.sequence(Cdr::f64);
    let (positions, velocities) = (values()?, values()?);
    let (accelerations, efforts) = (values()?, values()?);
    // Seconds and nanoseconds from the start of the trajectory.
    cdr.i32()?;
    cdr.u32()?;
    Some(Point { positions, velocities, accelerations, efforts })
}
