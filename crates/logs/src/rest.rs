use crate::Prepared;

/// Least and largest speed that counts as rest, as shares of the largest speed in the logs.
const REST_SHARES: [f64; 2] = [2e-4, 1e-2];

/// Share of the samples that a joint which rests now and then is at rest.
const RESTING: f64 = 0.05;

/// Speed that counts as rest, in the speed below which those samples are. Of a joint that
/// rests a quarter of the time they are a fifth of the resting ones, slower than a quarter
/// of the noise's standard deviation: four standard deviations are sixteen times that.
const REST_OF_NOISE: f64 = 16.0;

/// Speed below which each joint counts as at rest (rad/s or m/s): some times the noise of its
/// velocity, between 0.02 and 1 per cent of its largest speed.
pub fn rest_speeds(prepared: &Prepared) -> Vec<f64> {
    let joints = prepared.runs.first().map_or(0, |r| r.joints.len());
    (0..joints).map(|j| rest_speed(prepared, j)).collect()
}

fn rest_speed(prepared: &Prepared, j: usize) -> f64 {
    let all = prepared.runs.iter().flat_map(|r| &r.joints[j].wide.qd);
    let mut speeds: Vec<f64> = all.map(|v| v.abs()).collect();
    speeds.sort_by(f64::total_cmp);
    let largest = speeds.last().copied().unwrap_or(0.0);
    let noise = speeds.get((RESTING * speeds.len() as f64) as usize).copied().unwrap_or(0.0);
    let [low, high] = REST_SHARES.map(|share| share * largest);
    (REST_OF_NOISE * noise).clamp(low, high).max(f64::MIN_POSITIVE)
}
