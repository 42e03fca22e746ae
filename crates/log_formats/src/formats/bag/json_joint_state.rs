//! Joint states in JSON, as Foxglove and scripts of one's own record them.
//!
//! ```json
//! {"header": {"stamp": {"sec": 1, "nanosec": 5}}, "name": ["elbow"], "position": [0.1], "velocity": [], "effort": [2]}
//! {"timestamp": {"sec": 1, "nsec": 5}, "joints": [{"name": "elbow", "position": 0.1, "effort": 2}]}
//! ```
//!
//! A message without a stamp has the time at which it was recorded.

use serde::Deserialize;

use crate::formats::bag::{joint_message::JointMessage, topic::Message};

#[derive(Deserialize)]
struct JsonMessage {
    header: Option<Header>,
    timestamp: Option<Stamp>,
    #[serde(default)]
    name: Vec<String>,
    #[serde(default)]
    position: Vec<f64>,
    #[serde(default)]
    velocity: Vec<f64>,
    #[serde(default)]
    effort: Vec<f64>,
    #[serde(default)]
    joints: Vec<JsonJoint>,
}

#[derive(Deserialize)]
struct Header {
    stamp: Option<Stamp>,
}

#[derive(Deserialize)]
struct Stamp {
    #[serde(alias = "secs")]
    sec: u32,
    #[serde(alias = "nsec", alias = "nsecs")]
    nanosec: u32,
}

#[derive(Deserialize)]
struct JsonJoint {
    name: String,
    position: Option<f64>,
    velocity: Option<f64>,
    acceleration: Option<f64>,
    effort: Option<f64>,
}

/// Decodes a message, or gives the reason why it cannot be read.
pub(crate) fn decode(message: &Message) -> Result<JointMessage, String> {
    let decoded: JsonMessage = serde_json::from_slice(message.data)
        .map_err(|error| format!("it is no joint state in JSON: {error}"))?;
    let stamp = decoded.header.and_then(|header| header.stamp).or(decoded.timestamp);
    let stamp_ns = match stamp {
        Some(stamp) => Some(i64::from(stamp.sec) * 1_000_000_000 + i64::from(stamp.nanosec)),
        None => message.recorded_ns,
    };
    let stamp_ns = stamp_ns.ok_or("it has no stamp")?;
    if decoded.joints.is_empty() {
        let channels = [
            ("position", decoded.position),
            ("velocity", decoded.velocity),
            ("effort", decoded.effort),
        ];
        return JointMessage::new(stamp_ns, decoded.name, channels);
    }
    let joints = &decoded.joints;
    let values = |of: fn(&JsonJoint) -> Option<f64>| joints.iter().filter_map(of).collect();
    let channels = [
        ("position", values(|joint| joint.position)),
        ("velocity", values(|joint| joint.velocity)),
        ("acceleration", values(|joint| joint.acceleration)),
        ("effort", values(|joint| joint.effort)),
    ];
    JointMessage::new(stamp_ns, joints.iter().map(|joint| joint.name.clone()).collect(), channels)
}
