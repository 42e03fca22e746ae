use logs::{Prepared, PreparedJoint};
use robot::{Robot, SensingSide};

use crate::thresholds::readiness::ReadinessThresholds;

/// Sum of squares of an encoder's motion (rad² or m², over all samples) that its noise alone may produce.
const NOISE_OF_REST: f64 = 1e-6;

/// Leaves out second encoders that do not follow their motor, and those of a robot whose first encoders are at the
/// links already. Warns once a joint.
pub(crate) fn without_idle_encoders(
    robot: &Robot,
    prepared: &mut Prepared,
    t: &ReadinessThresholds,
) -> Vec<String> {
    let mut warnings = Vec::new();
    for (j, link) in robot.links().iter().enumerate() {
        let joints = || prepared.runs.iter().map(|run| &run.joints[j]);
        if joints().all(|joint| joint.link.is_none()) {
            continue;
        }
        let (name, drive) = (&link.joint.name, &link.actuator);
        let slope = slope(joints()) / drive.transmission_ratio;
        let reason = if drive.sensing == SensingSide::Link {
            "the robot has its position measured at the link already".to_owned()
        } else if (slope - 1.0).abs() > t.second_encoder_mismatch {
            format!("it moves {slope:.2} times as far as its motor, about once was expected")
        } else {
            continue;
        };
        warnings.push(format!("{name}: its link_position is left out: {reason}"));
        prepared.runs.iter_mut().for_each(|run| run.joints[j].link = None);
    }
    warnings
}

/// Motion of the link per motion of its motor encoder, by least squares; one for a joint at rest.
fn slope<'a>(runs: impl Iterator<Item = &'a PreparedJoint>) -> f64 {
    let (mut across, mut own) = (0.0, 0.0);
    for joint in runs {
        let Some(link) = &joint.link else { continue };
        let middle = |x: &[f64]| x.iter().sum::<f64>() / x.len().max(1) as f64;
        let (a, b) = (middle(&joint.q), middle(&link.q));
        for (q, l) in joint.q.iter().zip(&link.q) {
            across += (q - a) * (l - b);
            own += (q - a).powi(2);
        }
    }
    if own > NOISE_OF_REST { across / own } else { 1.0 }
}
