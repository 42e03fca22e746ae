use robot::PdGain;

use crate::runs::run::Channels;

/// Effort that a servo's position loop commands, for logs without effort (N m or N).
///
/// ```text
/// effort[k] = kp (goal[k] - q[k]) - kd qd[k]
/// qd[k]     = (q[k+1] - q[k-1]) / (t[k+1] - t[k-1])
/// ```
///
/// `goal` is `desired_position`. `qd` is the velocity column where the log has one. The difference is one-sided at the
/// first and the last sample. Without a goal there is no effort.
pub(crate) fn effort(gain: PdGain, time: &[f64], channels: &Channels) -> Vec<f64> {
    let q = &channels.position;
    let Some(goal) = &channels.desired_position else { return Vec::new() };
    let last = time.len().saturating_sub(1);
    let difference = |k: usize| {
        let (before, after) = (k.saturating_sub(1), (k + 1).min(last));
        let step = time[after] - time[before];
        if step > 0.0 { (q[after] - q[before]) / step } else { 0.0 }
    };
    let qd = |k: usize| channels.velocity.as_ref().map_or_else(|| difference(k), |qd| qd[k]);
    (0..time.len()).map(|k| gain.kp * (goal[k] - q[k]) - gain.kd * qd(k)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_effort_is_that_of_the_loop() {
        let channels = Channels {
            position: vec![0.0, 1.0, 4.0],
            desired_position: Some(vec![1.0, 1.0, 1.0]),
            ..Channels::default()
        };
        let gain = PdGain { kp: 10.0, kd: 2.0 };
        let time = [0.0, 1.0, 3.0];
        assert_eq!(effort(gain, &time, &channels), [8.0, -8.0 / 3.0, -33.0]);
        let channels = Channels { velocity: Some(vec![0.5; 3]), ..channels };
        assert_eq!(effort(gain, &time, &channels), [9.0, -1.0, -31.0]);
    }
}
