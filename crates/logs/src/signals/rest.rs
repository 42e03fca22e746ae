use crate::{
    runs::run::median,
    signals::{filtered::WIDE, prepared::Prepared},
};

/// Least and largest rest speed, as shares of the largest speed in the logs.
const REST_SHARES: [f64; 2] = [2e-4, 0.1];

/// Largest rest speed due to the difference between the filters, as a share of the largest speed.
const LARGEST_TAKEN: f64 = 1e-2;

/// Rest speed, in standard deviations of the velocity's noise.
const REST_OF_NOISE: f64 = 4.0;

/// Median of the absolute value of a normal variable, in standard deviations.
const MEDIAN_OF_NORMAL: f64 = 0.6745;

/// Speed below which each joint counts as at rest (rad/s or m/s): four standard deviations of
/// the noise of its velocity after the wide filter, but 0.02 to 10 per cent of its largest speed.
///
/// The noise is the larger of the noise of the joint's channels and the difference between its velocities after the
/// wide and the narrow filter. The difference includes the ringing of a filter where a joint stops, so it gives at most
/// 1 per cent of the largest speed. Where the difference is zero 1 per cent is taken in its place.
pub fn rest_speeds(prepared: &Prepared) -> Vec<f64> {
    let joints = prepared.runs.first().map_or(0, |r| r.joints.len());
    (0..joints).map(|j| rest_speed(prepared, j)).collect()
}

fn rest_speed(prepared: &Prepared, j: usize) -> f64 {
    let velocities = prepared.runs.iter().flat_map(|r| &r.joints[j].wide.qd);
    let largest = velocities.fold(0.0, |most: f64, v| most.max(v.abs()));
    let [low, high] = REST_SHARES.map(|share| share * largest);
    let cutoff_hz = WIDE * prepared.cutoff_hz;
    let known = prepared.noise.get(j).map_or(0.0, |noise| noise.velocity_rms(cutoff_hz));
    let difference = filter_difference(prepared, j);
    let difference = if difference > 0.0 { difference } else { largest };
    let speed =
        (REST_OF_NOISE * known).max((REST_OF_NOISE * difference).min(LARGEST_TAKEN * largest));
    speed.clamp(low, high).max(f64::MIN_POSITIVE)
}

/// Difference between the velocities after the wide and the narrow filter, as a standard deviation.
fn filter_difference(prepared: &Prepared, j: usize) -> f64 {
    let joints = prepared.runs.iter().map(|r| &r.joints[j]);
    let difference = joints.flat_map(|s| s.wide.qd.iter().zip(&s.qd)).map(|(w, n)| (w - n).abs());
    median(&difference.collect::<Vec<f64>>()) / MEDIAN_OF_NORMAL
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::signals::prepared::{PreparedJoint, PreparedRun, Wide};

    /// One joint that swings at 2 rad/s, with a velocity noise of `deviation` at a cut-off of four
    /// times and none at the other.
    fn swinging(deviation: f64) -> Prepared {
        let times: Vec<f64> = (0..20_000).map(|t| 0.002 * f64::from(t)).collect();
        let qd: Vec<f64> = times.iter().map(|t| 2.0 * t.sin()).collect();
        // Normal by Box & Muller 1958, of two sequences that fill the unit square evenly.
        let even = |t: usize, step: f64| (0.5 + step * t as f64).fract();
        let noise = |t: usize| {
            let (radius, turn) = (even(t, 0.754_877_666), even(t, 0.569_840_291));
            deviation * (-2.0 * radius.ln()).sqrt() * (std::f64::consts::TAU * turn).cos()
        };
        let wide: Vec<f64> = qd.iter().enumerate().map(|(t, v)| v + noise(t)).collect();
        let joint = PreparedJoint {
            q: vec![0.0; times.len()],
            qdd: vec![0.0; times.len()],
            wide: Wide { qd: wide, ..Wide::default() },
            effort: vec![0.0; times.len()],
            link: None,
            goal_effort: None,
            qd,
        };
        let run = PreparedRun {
            name: "swing".to_owned(),
            rate_hz: 500.0,
            time: times,
            session_start_s: 0.0,
            joints: vec![joint],
        };
        Prepared::exact(vec![run], 10.0)
    }

    #[test]
    fn a_joint_rests_below_four_standard_deviations_of_its_velocity_noise() {
        let [rest] = rest_speeds(&swinging(1e-3))[..] else { panic!("one joint") };
        assert!((rest / 4e-3 - 1.0).abs() < 0.02, "{rest}");
    }

    #[test]
    fn unknown_and_large_noise_count_as_one_per_cent_of_the_largest_speed() {
        let [still] = rest_speeds(&swinging(0.0))[..] else { panic!("one joint") };
        assert!((still / 0.02 - 1.0).abs() < 1e-3, "{still}");
        let [loud] = rest_speeds(&swinging(0.1))[..] else { panic!("one joint") };
        assert!((0.02..0.03).contains(&loud), "{loud}");
    }
}
